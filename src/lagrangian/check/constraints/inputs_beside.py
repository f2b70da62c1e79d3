"""Inputs and parameters in answers for systems with constraints: values of inputs beside the equations, other names."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.constraints.constrained import expanded, unknown_names
from lagrangian.check.names.results import results_in
from lagrangian.check.places import gives_input
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Verdict
from lagrangian.page.formula import Text, text
from lagrangian.page.plain import plain


def judged_with_inputs(
    truth: Reference, lines: Sequence[AnsweredLine], judge: Callable[[Sequence[AnsweredLine]], Verdict]
) -> Verdict:
    """The verdict on lines without those that give an input a value; where the system lacks a name, with the input
    or parameter that the answer does not name in its place, if more lines are right then."""
    given = [x for x in lines if x.kind == "equation" and bounded.letters(x.expr) <= truth.names]
    given = [x for x in given if gives_input(truth, x.expr)]
    lines = [replace(x, kind="statement") if any(x is y for y in given) else x for x in lines]
    best = judge(lines)
    for put, note in () if best.right else _named(truth, lines):
        found = judge(put)
        if found.right_lines > best.right_lines:
            best = replace(found, notes=(note, *found.notes))
    told = [text(f"'{x.text}' was not judged: it is about one value of an input.") for x in given]
    return replace(best, notes=(*told, *best.notes))


def _named(truth: Reference, lines: Sequence[AnsweredLine]) -> Iterator[tuple[list[AnsweredLine], Text]]:
    """The lines with every unknown name as the only input that they do not name or, if they name all, as the only
    parameter, if they have one name too many."""
    model = truth.model
    free: list[sp.Expr] = [u.symbol for u in model.inputs if not any(x.expr.has(u.symbol) for x in lines)]
    lacking = {p.symbol for p in model.parameters} - truth.values.keys()
    free = free or [s for s in lacking if not any(x.expr.has(s) for x in lines)]
    equations = [x for x in lines if x.kind == "equation"]
    results = results_in(model, truth.names, equations).values()
    unknown = unknown_names(expanded(truth), [x for x in equations if x not in results])
    if len(free) != 1 or len(unknown) != len(truth.derivation.multipliers) + 1:
        return
    for s in unknown:
        put = [replace(x, expr=cast("sp.Expr", x.expr.xreplace({s: free[0]}))) for x in lines]
        yield put, text(f"'{plain(s)}' was read as ", free[0], ".")
