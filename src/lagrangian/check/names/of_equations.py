"""Names that only call an equation whose other side is 0: g1 = m x'' + k x - F, h2 = …, each used nowhere else."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lagrangian.check.reading import Unknown
from lagrangian.check.verdict import AnsweredLine


def without_names_of_equations(lines: Sequence[AnsweredLine], asked: Sequence[Unknown]) -> list[AnsweredLine] | None:
    """The lines with 0 for unknown names that stand alone on the left of one line each; None if one does not."""
    found = list(lines)
    for name in asked:
        inside = [k for k, line in enumerate(found) if line.expr.has(name.symbol)]
        if len(inside) != 1:
            return None
        line = found[inside[0]]
        if line.kind != "equation" or line.text.partition("=")[0].strip() != name.name:
            return None
        found[inside[0]] = replace(line, expr=line.expr.subs(name.symbol, 0))
    return found
