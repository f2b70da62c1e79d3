"""Constraints as answers write them: integrated, x = r φ for ẋ = r φ̇, or with their multipliers in L = T* − V + λ f or
in the generalized forces, Q_r = −b ṙ − S."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.rows import factors_of
from lagrangian.check.stated import left_sides
from lagrangian.check.verdict import AnsweredLine, Status, Verdict
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.model import time
from lagrangian.model.rows import pressing_rows, rows_of
from lagrangian.records import dataclass

_IMPLIED = "what multipliers in L or Ξ say"
"""The name of the equations that an answer does not write, but that L or Ξ with multipliers says."""


def with_rates(truth: Reference, line: AnsweredLine) -> AnsweredLine:
    """A line f(q, t) = 0 as ḟ = 0, if ḟ is a sum of the rows of the velocity constraints: x − r φ for ẋ − r φ̇.

    A constraint on positions is not taken this way: r = 2 R has the rate of r = R.
    """
    rows = [row.rate for row in rows_of(truth.model) if row.position is None]
    places = {c.symbol for c in truth.model.coordinates}
    constants = {time, *(p.symbol for p in truth.model.parameters)}
    held = line.expr.atoms(AppliedUndef)
    if not rows or line.kind != "equation" or line.expr.has(sp.Derivative) or not held:
        return line
    if held - places or line.expr.free_symbols - constants:
        return line
    rate = bounded.diff(line.expr, time)
    P, W = (CompiledExpressions(x).at(truth.states) for x in ([rate], list(map(truth.expand, rows))))
    return replace(line, expr=rate) if bool(factors_of(truth, P, W)[1][0]) else line


@dataclass(frozen=True)
class Unfolded:
    """An answer with L and Ξ without multipliers, the constraints f = 0 of L, and the equations that follow from L;
    ``pushes`` are the right equations with the multipliers of a Ξ."""

    lines: tuple[AnsweredLine, ...]
    constraints: tuple[AnsweredLine, ...] = ()
    equations: tuple[AnsweredLine, ...] = ()
    pushes: tuple[AnsweredLine, ...] = ()

    def judged(self, check: Callable[[Sequence[AnsweredLine]], Verdict]) -> Verdict:
        """The verdict on the answer; L is wrong if its constraints are, L and Ξ if their λ is not that of the
        equations."""
        alone = not any(line.kind == "equation" for line in self.lines)
        verdict = check([*self.lines, *self.constraints, *(self.equations if alone else ())])
        later = [*(() if alone else self.equations), *self.pushes]
        if later and verdict.right:  # afterwards: L and Ξ make up for no missing equation
            whole = check([*self.lines, *self.constraints, *self.equations, *self.pushes])
            verdict = verdict if whole.right else whole
        said = [f for f in verdict.findings if f.line.name == _IMPLIED and not f.status.right]
        bad = {(f.line.number, f.line.text) for f in said}
        kept = [f for f in verdict.findings if f.line.name != _IMPLIED]
        wrong = [f.line.kind in ("L", "Xi") and (f.line.number, f.line.text) in bad for f in kept]
        found = [replace(f, status=Status.WRONG) if x else f for f, x in zip(kept, wrong, strict=True)]
        return replace(verdict, findings=tuple(found))


def unfolded(truth: Reference, lines: Sequence[AnsweredLine]) -> Unfolded:
    """The answer with each L = T* − V + λ f as T* − V, with f = 0 and d/dt ∂L/∂ξ̇ − ∂L/∂ξ = Ξ beside it.

    Only if f depends on positions; a λ that presses on friction, of which these equations also depend, is left in L.
    A Ξ with multipliers loses these in the same way.
    """
    if pressing_rows(truth.model):
        return Unfolded(tuple(lines))
    lines, pushes = _without_pushes(truth, lines)
    return replace(_without_multipliers_in_L(truth, lines), pushes=pushes)


def _without_pushes(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> tuple[tuple[AnsweredLine, ...], tuple[AnsweredLine, ...]]:
    """The lines with each Ξ without multipliers, and for each of these the right equation with its multipliers."""
    places = {c.name: row for c, row in zip(truth.model.coordinates, truth.rows, strict=True)}
    forces = [m.symbol for m in truth.derivation.multipliers.values()]
    kept: list[AnsweredLine] = []
    pushes: list[AnsweredLine] = []
    for line in lines:
        names = bounded.letters(line.expr) - truth.names | {*forces}
        row = places.get(str(line.name)) if line.kind == "Xi" else None
        by_others = any(set(d.variables) - {time} for d in line.expr.atoms(sp.Derivative))
        own = sorted((x for x in names if line.expr.has(x)), key=str) if row is not None and not by_others else []
        slopes = [bounded.diff(line.expr, x) for x in own]
        if row is None or not own or any(f.has(*own, sp.Derivative) for f in slopes):
            kept.append(line)
            continue
        pushed = sp.Add(*[x * f for x, f in zip(own, slopes, strict=True)])
        left = cast("sp.Expr", row.xreplace(dict.fromkeys(forces, sp.S.Zero)))
        kept.append(replace(line, expr=cast("sp.Expr", line.expr.xreplace(dict.fromkeys(own, sp.S.Zero)))))
        pushes.append(replace(line, kind="equation", name=_IMPLIED, expr=left - pushed))
    return tuple(kept), tuple(pushes)


def _without_multipliers_in_L(truth: Reference, lines: Sequence[AnsweredLine]) -> Unfolded:
    """The answer with L = T* − V + λ f as T* − V, and what it says."""
    stated = [line for line in lines if line.kind == "L"]
    if len(stated) != 1:
        return Unfolded(tuple(lines))
    model, L = truth.model, stated[0].expr
    own = sorted(bounded.letters(L) - truth.names, key=str)
    slopes = [cast("sp.Expr", L.diff(x)) for x in own]
    if not own or any(f.has(sp.Derivative, *own) for f in slopes):
        return Unfolded(tuple(lines))
    without = cast("sp.Expr", L.xreplace(dict.fromkeys(own, sp.S.Zero)))
    pushed = [sp.Add(*[x * f.diff(c.symbol) for x, f in zip(own, slopes, strict=True)]) for c in model.coordinates]
    follow = [a - b - c for a, b, c in zip(left_sides(truth, without), truth.Xi, pushed, strict=True)]

    def implied(exprs: Sequence[sp.Expr]) -> tuple[AnsweredLine, ...]:
        return tuple(replace(stated[0], kind="equation", name=_IMPLIED, expr=x) for x in exprs)

    pushing = dict(zip((c.name for c in model.coordinates), pushed, strict=True))
    kept: list[AnsweredLine] = []
    for x in lines:
        if x.kind == "slope" and x.name in pushing and x.expr.has(*own):  # ∂L/∂x = … + 2 λ x
            kept.append(replace(x, expr=x.expr - pushing[x.name]))
        else:
            kept.append(replace(x, expr=without) if x.kind == "L" else x)
    return Unfolded(tuple(kept), implied(slopes), implied(follow))
