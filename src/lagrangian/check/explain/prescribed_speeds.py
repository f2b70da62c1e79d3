"""The speed of a prescribed motion as an answer states it, where the motion then seems to be left out.

x_O' = a                     of x_O = a t²/2: then all terms with a cancel
v² = (a + l φ̇ cos φ)² + …    the same in a speed that nothing judges
v_x = a t + l φ̇ cos φ        it is there, but the equations are without what it adds
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, put
from lagrangian.check.reading import Answer, AnswerLine
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, Verdict, inserted
from lagrangian.model import time
from lagrangian.page.formula import text
from lagrangian.records import dataclass

FORGOTTEN = "base_motion_forgotten"
"""The name of the mistake that a prescribed motion is missing in velocities."""
WHY_ACCELERATION = text("That is its acceleration: its velocity is what it has gained since the start.")
WHY_SPEED = text("A velocity is d/dt of a position, also of one that is prescribed in time.")
WHY_LOST = text("In d/dt ∂ℒ/∂ξ̇ the velocities that are prescribed are differentiated, too: what grows with time stays.")
MOST = 50
"""The most lines of an answer that are looked at."""


@dataclass(frozen=True, eq=False)
class StatedSpeed:
    """What a line says that the speed of a prescribed motion is."""

    line: AnswerLine
    expr: sp.Expr
    alone: bool
    """Whether the line says nothing else."""


def with_prescribed_speeds(truth: Reference, answer: Answer, verdict: Verdict) -> Verdict:
    """The verdict in which a prescribed motion is not called missing where the answer states its speed: that speed is
    wrong, or what it adds to the equations got lost."""
    if not any(m.name == FORGOTTEN for m in verdict.mistakes):
        return verdict
    s = Ingredients(truth.derivation)
    right = list(dict.fromkeys(truth.put(v) for v in _carrying(s)))
    stated = [x for x in _stated(truth, s, answer.lines[:MOST]) if x.expr.free_symbols - {time} and x.expr != 0]
    if not right or not stated:
        return verdict
    wrong = [x for x in stated if not any(bounded.expand(x.expr - sign * v) == 0 for v in right for sign in (1, -1))]
    letters = frozenset[sp.Basic]().union(*(v.free_symbols for v in right)) | {time}
    if any(not x.expr.free_symbols <= letters for x in wrong) or (not wrong and all(x.alone for x in stated)):
        return verdict
    told = _of_speed(right, wrong[0].expr) if wrong else _of_loss()
    told = [replace(told, element=m.element) if m.name == FORGOTTEN else m for m in verdict.mistakes]
    first = next((x for x in wrong if x.alone), None)
    if first is None or len(told) > 1:
        return replace(verdict, mistakes=tuple(told))
    return _from(first, replace(verdict, mistakes=tuple(told), alternatives=()))


def _from(first: StatedSpeed, verdict: Verdict) -> Verdict:
    """The verdict, with a line that says a wrong speed, from which the wrong ones below follow."""
    number = first.line.place.line or 0
    if any(f.line.number <= number for f in verdict.findings if f.is_open):
        return verdict
    line = AnsweredLine("definition", first.expr, number, None, first.line.text)
    below = [replace(f, follows=True) if f.is_open else f for f in verdict.findings]
    notes = tuple(x for x in verdict.notes if not str(x).startswith(f"'{first.line.text}' was not judged"))
    return replace(verdict, findings=tuple(inserted(below, Finding(line, Status.WRONG))), notes=notes)


def _carrying(s: Ingredients) -> Iterator[sp.Expr]:
    """The components of velocities where all coordinates are at rest, as far as the same holds at every position."""
    still = dict.fromkeys(s.v, sp.S.Zero)
    for body in s.bodies:
        for component in s.velocity(body):
            v = bounded.expand(sp.sympify(put(component, still)))
            if v != 0 and not s.moves(v):
                yield v


def _stated(truth: Reference, s: Ingredients, lines: Sequence[AnswerLine]) -> Iterator[StatedSpeed]:
    """What lines say of it: x_O' = a of a name of their own, and what is left of speeds where all rates are 0."""
    still: Any = dict.fromkeys(s.v, sp.S.Zero)
    moving = [*s.q, *s.v, *s.a]
    for line in lines:
        value = truth.expand(line.rhs)
        if line.kind == "equation" and isinstance(line.lhs, sp.Derivative) and not line.lhs.has(*moving):
            if line.lhs.derivative_count == 1 and not bounded.atoms(value, AppliedUndef):
                yield StatedSpeed(line, value, True)
        elif line.kind == "definition" and (line.name or "").startswith("v") and not value.has(*s.q, *s.v, *s.a):
            if not bounded.atoms(value, AppliedUndef):
                yield StatedSpeed(line, value, True)
        elif line.kind == "definition" and value.has(*s.v) and not value.has(*s.a):
            rest = bounded.expand(put(value, still))
            if rest.is_Pow and rest.args[1] == 2:
                yield StatedSpeed(line, cast("sp.Expr", rest.args[0]), False)
            elif value.diff(s.v[0], 2) == 0 and all(value.diff(v, 2) == 0 for v in s.v):
                yield StatedSpeed(line, rest, False)


def _of_speed(right: Sequence[sp.Expr], written: sp.Expr) -> Mistake:
    """A prescribed speed that is wrong."""
    meant = next((v for v in right if bounded.expand(bounded.diff(v, time) - written) == 0), None)
    why = WHY_SPEED if meant is None else WHY_ACCELERATION
    what = text("The velocity of the prescribed motion is ", meant or right[0], ", not ", written, ".")
    return Mistake("prescribed_motion", what, why, 2, brief=text("A prescribed motion is not right."))


def _of_loss() -> Mistake:
    """What a right prescribed speed adds to the equations is missing."""
    what = text("The prescribed motion is in your velocities, but what it adds to the equations is missing.")
    return Mistake(FORGOTTEN, what, WHY_LOST, 5, brief=text("What a prescribed motion adds is missing."))
