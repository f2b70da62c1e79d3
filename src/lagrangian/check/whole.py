"""Whether an answer gives a whole: the energies of some bodies alone are none, right as they may be."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.meant import kinds_of
from lagrangian.check.verdict import AnsweredLine, Status, Verdict
from lagrangian.page.formula import Name, text

WHOLE = frozenset(["equation", "left", "T", "L", "p", "p-rate"])
"""The kinds of lines from which the motion follows, or that hold all of T*."""


def only_parts(verdict: Verdict, lines: Sequence[AnsweredLine], *, unjudged: bool, matrices: bool) -> Verdict:
    """A right verdict as an incomplete one, with a note, if an answer has neither the whole T* or L nor an equation,
    but the kinetic energies of parts of the system, or something that was not judged.

    V, D or a force without such parts is the answer to a question about it. ``matrices``: of mass or with inputs, which
    no equation uses: they would be in the equations.
    """
    kinds = {f.line.kind for f in verdict.findings}
    unused = matrices and not kinds & {"equation", "left"}
    if not verdict.right or not (unused or (not kinds & WHOLE and (unjudged or any(map(_is_part, lines))))):
        return verdict
    more = () if kinds & WHOLE else (", the whole T* or ", Name("L"))
    note = text("No line states an equation of motion", *more, ".")
    return replace(verdict, status=Status.INCOMPLETE, notes=(*verdict.notes, note))


def _is_part(line: AnsweredLine) -> bool:
    """Whether a definition may be a part of T*: by its name, or as it has the square of a rate."""
    rates = bounded.atoms(line.expr, sp.Derivative) if line.kind == "definition" else set[sp.Basic]()
    squares = (p.base for p in bounded.atoms(line.expr, sp.Pow) if p.exp.is_number and p.exp % 2 == 0)
    return bool(rates) and (kinds_of(line.name or "") == ("kinetic",) or any(base.has(*rates) for base in squares))
