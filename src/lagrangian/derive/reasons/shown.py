"""Shared by the parts of the page: shortened formulas, the names of components, and lists in words."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Form
from lagrangian.derive.reasons.motion import Moving
from lagrangian.derive.reasons.result import Reasoning
from lagrangian.model import Body
from lagrangian.page.formula import Elided, Left, Name, Terms

AXES = ("x", "y", "z")

SHORT = 80
"""The operations above which a line of a single mass is summarized."""

LONG = 160
"""The operations above which a sum over the whole system is summarized."""

MOST_LISTED = 8
"""With more bodies, the page has no lines for each, only the sums and numbers."""

MOST_SUMMED = 10
"""With more coordinates, the page has no lines for each, only what is compared."""

MOST_ELIMINATED = 24
"""The operations of a constraint force up to which it is shown without its acceleration."""

SUM = Name("sum")
MASS, PLACE, FORCE = sp.Symbol("m_i"), Name("r", "i"), Name("R", "i")


def short(why: Reasoning, form: Form, longest: int = SHORT) -> Left:
    """A form as a sum of readable terms, or its summary if it is too long to read."""
    terms = tuple(t.expr for t in why.context.terms(form))
    operations = bounded.operations(*terms)
    if operations <= longest:
        return Terms(terms)
    return Elided(sp.Add(*terms, evaluate=False), operations, terms)


def component(name: str, why: Reasoning, m: Moving, axis: int, dots: int = 0) -> Name:
    """R_x2, Γ_2 or ẍ_2: a component of a body's vector, with the body's index."""
    index = index_of(why, m.body, name)
    if len(m.velocity) == 1:
        return Name(name, index, dots)
    letter = AXES[axis]
    return Name(name, f"{letter}{index}" if len(index) <= 2 else f"{letter} {index}", dots)


def index_of(why: Reasoning, body: Body, name: str) -> str:
    """The index of a body's quantities; the force on the only body needs none."""
    alone = len(why.derived.model.bodies) == 1 and name not in AXES and name != "phi"
    return "" if alone else why.index[body]


def capital(words: str) -> str:
    """The words with a capital first letter."""
    return words[:1].upper() + words[1:]


def and_(words: Sequence[str]) -> str:
    """``a``, ``a and b``, ``a, b and c``."""
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]
