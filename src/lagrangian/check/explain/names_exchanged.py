"""Tells what is wrong in names of the answer's own: one that stands for another one, or with the wrong sign, in a line
that was solved with them, and one of an acceleration whose force or moment is missing.

θ̈ = (M₂₂ r₂ − M₁₂ r₁)/Δ                  M₂₂ r₂ should be M₁₁ r₂
a_x = …, a_y = …;  J ψ̈ + m a_y b = τ      the moment −m a_x h is missing
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import cast

import numpy as np
import sympy as sp

from lagrangian.check.explain.combined_rows import is_mass
from lagrangian.check.explain.in_own_names import OwnName, own_names
from lagrangian.check.explain.terms_alone import term_mistake
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, TermDifference, Verdict
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model.names import moving_symbol
from lagrangian.page.formula import text
from lagrangian.records import dataclass

NAME = "letter"
"""The name of the mistake."""
MOST_NAMES = 10
"""The most names of an answer that are tried."""
FEWEST, MOST_LETTERS = 2, 14
"""The fewest terms in which a line differs that lacks one of several, and the most letters of masses and arms."""
NEAR = 1e-9
"""The relative size of what is rounding."""
WHY = text("The solution of two linear equations takes each row with what the other one has before the other unknown.")

WHY_MOMENT = text("Every component of mass times acceleration counts: in a sum of moments each with its own arm.")


@dataclass(frozen=True, eq=False)
class _Product:
    """A product of two names as it stands, and as it should be, both in the line times what it is divided by."""

    written: sp.Expr
    right: sp.Expr


def with_names_exchanged(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer without an explanation, in which every wrong line is solved for an acceleration in
    names of the answer's own, with the one product of them that is another; or one line lacks mass times a name."""
    roots = verdict.open_findings
    if verdict.mistakes or not roots or truth.derivation.multipliers:
        return verdict
    if len(roots) == 1 and (term := _left_out(truth, roots[0], verdict.findings)) is not None:
        blamed = replace(roots[0], differences=(TermDifference("missing", term, sp.S.Zero, None),), elements=())
        findings = tuple(blamed if f is roots[0] else f for f in verdict.findings)
        mistake = replace(term_mistake(blamed, blamed.differences[0]), why=WHY_MOMENT)
        return replace(verdict, findings=findings, mistakes=(mistake,), alternatives=(), sure=True)
    used = [*(x for x in lines if x.kind == "equation"), *(f.line for f in roots)]
    names = [x for x in own_names(truth, lines, used) if not x.given][:MOST_NAMES]
    told: list[Mistake] = []
    for f in roots:
        found = _product(truth, f, names)
        if found is None:
            return verdict
        sign = found.right == -found.written
        tail = (" has the wrong sign.",) if sign else (" should be ", found.right, ".")
        what = text(f"In {f.line.title}, ", found.written, *tail)
        brief = text(f"A name in {f.line.title} is not the right one.")
        told.append(Mistake("sign_of_a_term" if sign else NAME, what, WHY, 5, None, f.coordinate, brief))
    return replace(verdict, mistakes=tuple(told), alternatives=(), sure=True)


def _left_out(truth: Reference, finding: Finding, findings: Sequence[Finding]) -> sp.Expr | None:
    """Mass times an acceleration that a right line names, and an arm, without which alone an equation does not hold;
    None if there is none, or several."""
    line, moving = finding.line, [c.acceleration for c in truth.model.coordinates]
    said = [f.line for f in findings if f.line.kind == "definition" and f.status.right and f.line.name]
    own = [x for x in said if x.expr.has(*moving)][:MOST_NAMES]
    if line.kind != "equation" or len(finding.differences) < FEWEST or not own:
        return None
    states, given = truth.states, [p.symbol for p in truth.model.parameters if p.symbol not in truth.values]
    exprs = [line.expr, *(truth.expand(truth.put(x.expr)) for x in own), *given[:MOST_LETTERS]]
    wrong, *values = CompiledExpressions(exprs).at(states, truth.accelerations)
    if not np.isfinite(wrong).all():
        return None
    named, letters = values[: len(own)], list(zip(given, values[len(own) :], strict=False))
    masses = [(p, x) for p, x in letters if is_mass(truth, p)]
    levers = [(cast("sp.Expr", sp.S.One), np.ones_like(wrong)), *letters]
    found = [
        cast("sp.Expr", -sign * mass * arm * moving_symbol(str(n.name)))
        for n, x in zip(own, named, strict=True)
        for mass, size in masses
        for arm, length in levers
        for sign in (1, -1)
        if _same(wrong, sign * size * length * x)
    ]
    return found[0] if len(found) == 1 else None


def _product(truth: Reference, finding: Finding, names: Sequence[OwnName]) -> _Product | None:
    """The one product of two names of a solved line that puts it right as another; None if there is none, or several
    that are not the same."""
    line = finding.line
    moving = [c.acceleration for c in truth.model.coordinates if line.expr.has(c.acceleration)]
    if line.kind != "equation" or len(moving) != 1 or len(names) < 2:
        return None
    states = truth.states
    compiled = CompiledExpressions([line.expr, *(truth.expand(truth.put(x.value)) for x in names)])
    wrong, *values = compiled.at(states, truth.accelerations)
    slope = CompiledExpressions([line.expr]).slopes(moving).at(states)[0]
    if not all(np.isfinite(x).all() for x in (wrong, slope, *values)) or np.ptp(slope) > NEAR * np.abs(slope).max():
        return None
    rest = -wrong / slope  # by what the acceleration that is written is too large
    every = [(cast("sp.Expr", n.symbol), x) for n, x in zip(names, values, strict=True)]
    own = [pair for pair, n in zip(every, names, strict=True) if n.key in line.names]
    found = {str((p.written, p.right)): p for p in _exchanged(rest, own, every)}
    return next(iter(found.values())) if len(found) == 1 else None


def _exchanged(
    rest: Array, own: Sequence[tuple[sp.Expr, Array]], every: Sequence[tuple[sp.Expr, Array]]
) -> Iterator[_Product]:
    """The products A C of names in a line, divided by a name of it or by nothing, that as B C or −A C put it right."""
    one = (cast("sp.Expr", sp.S.One), np.ones_like(rest))
    for below, under in (*own, one):
        lacking = rest * under
        for beside, factor in own:
            for written, value in own:
                if below in (written, beside):
                    continue
                for sign in (1, -1):
                    for right, other in (*every, (-written, -value)):
                        product = sign * factor * (value - other)
                        if right not in (written, below, beside) and _same(lacking, product):
                            yield _Product(sign * written * beside, sign * right * beside)


def _same(one: Array, other: Array) -> bool:
    return bool(np.abs(one - other).max() <= NEAR * 1e2 * np.abs(one).max())
