"""What is said of moments of inertia: they are no pieces of a way, and their terms belong to the rotation of a body."""

from __future__ import annotations

from typing import Any

import sympy as sp

from lagrangian.check.explain.changes.change import Site, Words
from lagrangian.model import Model, RigidBody

OMEGA = "ω is how fast the body itself turns against the fixed axes: with relative angles the sum of the rates."
OMEGA_OF_ROLLING = "ω is how fast the body itself turns against the fixed axes."


def inertias(model: Model) -> set[Any]:
    """The masses and moments of inertia: no pieces of a way, which would have a direction."""
    return {x for b in model.bodies for x in (b.mass, *(b.inertia if isinstance(b, RigidBody) else ()))}


def of_rotation(model: Model, site: Site) -> Words:
    """To the rotation of which body the term of an equation belongs, by the moment of inertia in it; nothing if it is
    that of several, or if the term has none."""
    term = site.words[1] if site.single and site.rows else None
    if not isinstance(term, sp.Expr):
        return ()
    above = sp.fraction(term)[0]  # of what is divided by J, no term is J's
    turning = [b for b in model.bodies if isinstance(b, RigidBody)]
    found = [b for b in turning if any(x.is_Symbol and above.has(x) for x in b.inertia)]
    return (f" It belongs to the rotation of {found[0].title}.",) if len(found) == 1 else ()


def why_omega(right: Any) -> str:
    """Why an angular velocity is wrong: one that is no sum of rates, as of what rolls, has no relative angles."""
    parts = sp.Add.make_args(right) if isinstance(right, sp.Expr) else ()
    plain = all(isinstance(x, sp.Derivative) or isinstance(-x, sp.Derivative) for x in parts)
    return OMEGA if plain else OMEGA_OF_ROLLING
