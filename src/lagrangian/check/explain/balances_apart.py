"""Leaves balances of bodies unjudged that are right together alone: m ÿ = N, and N + m g in the line of another body.

A line with forces of the answer's own can be put right by what these are taken to be: N may hold a weight. Newton's
laws of the bodies tell which mass and which weight a body has.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.check.all_forces import letters_of_gravity
from lagrangian.check.constraints.eliminated import slope_of, unknown_in
from lagrangian.check.explain.combined_rows import is_mass
from lagrangian.check.explain.free_bodies import Balance, free_bodies, proportional
from lagrangian.check.explain.known_forces import plain_scale
from lagrangian.check.explain.right_balances import marked
from lagrangian.check.explain.solved_forces import MOST_FORCES, MOST_LINES, NEAR, place_of
from lagrangian.check.explain.wrong_balance import NAME, clashing, disagreeing
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Status, Verdict
from lagrangian.derive.sampling import SETS, Array, CompiledExpressions
from lagrangian.errors import listed
from lagrangian.model import Gravity, Kinetic
from lagrangian.page.formula import text

WHY = "no single body has these masses and weights. Check which mass and which weight each body has."


def with_balances_apart(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict without the findings that call balances right that only are so together, with a note on them.

    Two lines or more that share a force are so if one has a mass or a weight of no body with its accelerations, and the
    others have none of these that fits, either.
    """
    held = {place_of(f.line) for f in verdict.findings if f.status.right and f.line.kind == "equation"}
    constants = unknown_in(truth, [x for x in lines if not x.expr.has(AppliedUndef)])  # positions at rest
    forces = unknown_in(truth, lines) - constants
    rows = [x for x in lines if x.kind == "equation" and x.expr.has(*forces)] if forces else []
    if truth.derivation.multipliers or any(isinstance(e, Kinetic) for e in truth.model.elements):
        return verdict  # a constraint may be put in, or a mass has no body
    if len(forces) > MOST_FORCES or not 1 < len(rows) <= MOST_LINES or not held & set(map(place_of, rows)):
        return verdict
    if any(slope_of(x.expr, f) is None for x in rows for f in forces if x.expr.has(f)):
        return verdict
    fits = _Fits(truth, rows, forces)
    own = {id(x): fits.of(x) for x in rows}
    apart = [x for x in rows if own[id(x)] is not True]
    linked = [
        x
        for x in apart
        if any(y is not x and _share(x, y, forces) and False in (own[id(x)], own[id(y)]) for y in apart)
    ]
    wrong = {place_of(f.line) for f in verdict.findings if f.status is Status.WRONG}
    blamed = {place_of(f.line) for f in verdict.open_findings}
    unseen = [x for x in linked if place_of(x) not in wrong]
    if len({x.number for x in unseen}) < 2 or not any(own[id(x)] is False for x in unseen):
        return verdict
    fitting = [x for x in rows if place_of(x) in blamed and own[id(x)] is True]
    if fitting and any(m.name == NAME for m in verdict.mistakes):
        return _all_doubtful([x for x in rows if x in (*linked, *fitting)], forces, verdict)
    if blamed & set(map(place_of, linked)) and any(m.name == NAME for m in verdict.mistakes):
        return verdict  # that line is told
    told = set(map(place_of, unseen)) & held
    findings = tuple(f for f in verdict.findings if place_of(f.line) not in told)
    numbers = listed([str(k) for k in sorted({x.number for x in unseen})])
    why = "one by one: together they are right, but" if verdict.right else "by themselves:"
    note = text(f"Lines {numbers} were not judged {why} {WHY}")
    return replace(verdict, findings=findings, notes=(*verdict.notes, note)) if told else verdict


def _all_doubtful(lines: Sequence[AnsweredLine], forces: set[sp.Basic], verdict: Verdict) -> Verdict:
    """The verdict with several lines of which one at least is wrong, in place of one that is the balance of a body."""
    told = (disagreeing(lines, sorted(forces, key=str)),)
    findings = marked(verdict.findings, (), [clashing(x, lines) for x in lines], ())
    return replace(verdict, findings=findings, mistakes=told, alternatives=())


def _share(one: AnsweredLine, other: AnsweredLine, forces: set[sp.Basic]) -> bool:
    return any(one.expr.has(f) and other.expr.has(f) for f in forces)


class _Fits:
    """Compares the masses and the weights in lines with those of the bodies.

    On which body another force acts is not compared: one at a joint may be counted to either of two bodies.
    """

    def __init__(self, truth: Reference, rows: Sequence[AnsweredLine], forces: set[sp.Basic]) -> None:
        self.truth = truth
        self.bodies = free_bodies(truth)
        self.none = dict.fromkeys(forces, np.zeros(truth.states.size))
        self.gravity = sorted(letters_of_gravity(truth), key=str)
        self.weighed = len(self.gravity) == 1 and any(x.expr.has(*self.gravity) for x in rows)
        masses = {p.symbol for p in truth.model.parameters if is_mass(truth, p.symbol)}
        self.masses = frozenset[sp.Basic](masses)

    def of(self, line: AnsweredLine) -> bool | None:
        """Whether a line has the masses and the weights of some bodies; None if none of these has its accelerations."""
        compiled = CompiledExpressions([line.expr])
        slopes = compiled.slopes(self.bodies.accelerations).at(self.truth.states, self.none)
        weight = compiled.slopes(self.gravity).at(self.truth.states, self.none) if self.gravity else None
        if not np.isfinite(slopes).all() or (weight is not None and not np.isfinite(weight).all()):
            return None
        alike = [b for b in self.bodies.balances if proportional(b.slopes, slopes)]
        scales = [(b, plain_scale(self.truth, _ratio(slopes, b.slopes))) for b in alike]
        known = [(b, scale) for b, scale in scales if scale is not None]
        if any(self._weighs(b, scale, weight) for b, scale in known if not self._swaps(scale)):
            return True
        return False if known else None

    def _swaps(self, scale: sp.Expr) -> bool:
        """Whether a factor is one mass over another."""
        return all(x.free_symbols & self.masses for x in scale.as_numer_denom())

    def _weighs(self, balance: Balance, scale: sp.Expr, weight: Array | None) -> bool:
        """Whether the weights of a line are those of a balance, times a factor; without any, they are in its forces."""
        if weight is None or not self.weighed:
            return True
        loads = [x for e, x in balance.loads.items() if isinstance(e, Gravity)]
        whole = np.sum(loads, axis=0) if loads else np.zeros(self.truth.states.size)
        g = self.truth.states.of(self.gravity[0])
        factor = CompiledExpressions([scale]).at(self.truth.states)[0]
        return bool(np.abs(weight[0] * g + factor * whole).max() <= NEAR * (1 + np.abs(whole * factor).max()))


def _ratio(slopes: Array, of: Array) -> Array:
    """The multiple of some slopes that others are, by the set of parameters."""
    one, other = (x.reshape(len(x), SETS, -1).transpose(1, 0, 2).reshape(SETS, -1) for x in (slopes, of))
    return np.array((one * other).sum(axis=1) / (other * other).sum(axis=1))
