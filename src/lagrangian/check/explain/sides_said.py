"""Tells a wrong term of an equation on the side on which it stands: F r/R on the right-hand side, and not −F r/R.

Mistakes are found with everything on the left-hand side; there, and in an equation that is solved for its acceleration,
a term has another sign than where it was written.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TypeAlias, cast

import sympy as sp

from lagrangian.check.terms.sides import LEFT, on_side
from lagrangian.check.verdict import IS_MISSING, Finding, Mistake, TermDifference, Verdict
from lagrangian.page.formula import Left, Verbatim, text

Part: TypeAlias = "str | Left | Verbatim"

THE_TERM, IN_THE_TERM = "The term ", "In the term "
"""How sentences on a term of an equation begin."""
TERMS = (THE_TERM, IN_THE_TERM, " stands where ", " should be ", " it should be ")
"""The words before what stands, or should stand, in an equation."""
EQUATION = " of the equation of "
ON_LEFT, ON_RIGHT = "on the left-hand side", "on the right-hand side"


def with_sides(verdict: Verdict) -> Verdict:
    """The verdict, with the terms of its mistakes as they stand in the wrong equations."""
    roots = verdict.open_equations
    if not roots:
        return verdict
    if len(roots) < len(verdict.open_findings):
        roots = [f for f in roots if f.coordinate is not None]  # a term may stand in an energy and in no equation
    told = tuple(_on_side(m, roots) for m in verdict.mistakes)
    return replace(verdict, mistakes=told, alternatives=tuple(_on_side(m, roots) for m in verdict.alternatives))


def _on_side(mistake: Mistake, roots: list[Finding]) -> Mistake:
    """A mistake, with the term of which its first sentence speaks on its side."""
    parts = list(mistake.what.parts)
    coordinate = mistake.coordinate or _coordinate_in(parts)
    own = [f for f in roots if coordinate is not None and f.coordinate == coordinate]
    own = roots if not own and len(roots) == 1 and roots[0].coordinate is None else own
    begins = parts[0] if parts and isinstance(parts[0], str) else ""
    if len(own) != 1 or len(parts) < 3 or begins not in (THE_TERM, IN_THE_TERM) or not isinstance(parts[1], sp.Expr):
        return mistake
    end = next((k for k, x in enumerate(parts) if isinstance(x, str) and (". " in x or x.endswith("."))), len(parts))
    after = "".join(x for x in parts[2 : end + 1] if isinstance(x, str))
    written = sp.S.Zero if IS_MISSING in after and begins == THE_TERM else parts[1]
    line = own[0].line
    side, said = on_side(line, TermDifference("", parts[1], written, coordinate))
    inside, named = begins == IN_THE_TERM, EQUATION in after
    clear = named and side == LEFT and (inside or ON_LEFT in after)
    if clear or (not side and (named or len(roots) == 1)):
        return mistake
    if said.term != parts[1]:
        parts = [*_turned(parts[: end + 1]), *parts[end + 1 :]]
    where = f"In {line.title}{f', {side}' if side else ''}{':' if inside else ','} "
    return replace(mistake, what=text(where + begins[:1].lower() + begins[1:], *parts[1:]))


def _coordinate_in(parts: Sequence[Part]) -> str | None:
    """The coordinate whose equation a sentence on a term names."""
    found = (x for before, x in pairwise(parts) if isinstance(before, str) and before.endswith(EQUATION))
    return next((str(getattr(x, "func", x)) for x in found), None)


def _turned(parts: Sequence[Part]) -> Iterator[Part]:
    """A sentence with its terms as they are on the right-hand side."""
    before: Part = ""
    for part in parts:
        if isinstance(part, sp.Expr) and isinstance(before, str) and before.endswith(TERMS):
            yield cast("sp.Expr", -part)
        else:
            yield part.replace(ON_LEFT, ON_RIGHT) if isinstance(part, str) else part
        before = part
