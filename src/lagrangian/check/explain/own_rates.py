"""What an equation has wrong that says the rate of a length of the system: l̇ = a d sin θ θ̇/(2 l) for a d sin θ θ̇/l.

All that moves with this rate is wrong then: the energy of a body that does, and the force of a damper.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.apart import told_apart
from lagrangian.check.explain.misconceptions import Ingredients
from lagrangian.check.explain.quantities import Effect, Sayable, damped, quantities_of, weight_along
from lagrangian.check.explain.said_wrongly import InWords, SaidWrongly, put, told
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake
from lagrangian.model import Damper
from lagrangian.read.letters import key

LONGEST = 80
"""The most operations of such an equation."""


def wrong_rates(truth: Reference, wrong: Sequence[AnsweredLine]) -> list[AnsweredLine]:
    """The wrong rates of places of the answer's own, ẏ = …, and of lengths that the system has a name for."""
    own = [x.kind == "identity" and x.name not in truth.model.symbols for x in wrong]
    return [x for x, is_own in zip(wrong, own, strict=True) if is_own or next(_said(truth, x), None) is not None]


def said_of_length(truth: Reference, line: AnsweredLine) -> Iterator[SaidWrongly]:
    """What such an equation may have wrong: the rate in energies and dampers, and in the arms of weights as well."""
    s = quantities_of(truth).of
    for symbol, right, written in _said(truth, line):
        owner = next((b for b in s.bodies if _along(truth, s, b, right)), None)
        of = Sayable("component", owner, ("rate of ", symbol), right, lambda _: Effect())
        for weights in (False, True):
            effect = put(truth, _effect(truth, s, right, written, weights=weights))
            if effect.T != 0 or any(effect.Xi) or any(effect.left):
                yield SaidWrongly(line, effect, partial(_in_words, s, of, right, written))


def of_rate(truth: Reference, findings: Sequence[Finding]) -> tuple[Mistake, ...]:
    """What is wrong in the first wrong line, if it is such an equation and all below have the rate by its name."""
    first = next((f.line for f in findings if f.is_open), None)
    found = None if first is None else next(said_of_length(truth, first), None)
    return () if found is None else (found.mistake,)


def _said(truth: Reference, line: AnsweredLine) -> Iterator[tuple[sp.Expr, sp.Expr, sp.Expr]]:
    """The name of a length in such an equation, its rate, and what is written for it."""
    s, coordinates = quantities_of(truth).of, truth.model.coordinates
    held = [*(c.acceleration for c in coordinates), *(u.symbol for u in truth.model.inputs)]
    if line.kind != "equation" or line.sides is None or bounded.operations(line.expr) > LONGEST or line.expr.has(*held):
        return
    for d in truth.model.definitions:
        right = s.rate(s.expand(d.symbol)) if d.moving and key(d.name) in line.names else sp.S.Zero
        for one, other in (line.sides, line.sides[::-1]) if right != 0 else ():
            written = truth.expand(other)
            known = written.has(*s.v) and bounded.letters(written) <= truth.names
            if known and zero_everywhere(truth, truth.put(truth.expand(one) - right)):
                yield d.symbol, right, written
                return


def _along(truth: Reference, s: Ingredients, body: object, rate: sp.Expr) -> list[tuple[int, int]]:
    """The axes along which a body moves with a rate, each with its sense."""
    signs = ((axis, v, sign) for axis, v in enumerate(s.velocity(body)) for sign in (1, -1) if v != 0)
    return [(axis, sign) for axis, v, sign in signs if zero_everywhere(truth, truth.put(v - sign * rate))]


def _effect(truth: Reference, s: Ingredients, right: sp.Expr, written: sp.Expr, *, weights: bool) -> Effect:
    """What another rate adds to the energies of the bodies, the forces of the dampers and the moments of the weights
    that move with it."""
    T, D, Xi, left = sp.S.Zero, sp.S.Zero, [sp.S.Zero] * len(s.v), [sp.S.Zero] * len(s.v)
    arms = [bounded.diff(written, v) - bounded.diff(right, v) for v in s.v]
    for b in s.bodies:
        for axis, sign in _along(truth, s, b, right):
            T += s.expand(b.mass) * (written**2 - right**2) / 2
            weight = sign * weight_along(s, b, axis) if weights else sp.S.Zero
            left = [x - weight * arm for x, arm in zip(left, arms, strict=True)]
    for d in (e for e in s.acting if isinstance(e, Damper) and e.b is not None):
        if any(zero_everywhere(truth, truth.put(s.expand(d.rate(s.model)) - sign * right)) for sign in (1, -1)):
            own = damped(s, s.expand(d.b), written, right)
            D, Xi = D + own.D, [x + y for x, y in zip(Xi, own.Xi, strict=True)]
    return Effect(T=T, Xi=tuple(Xi), left=tuple(left), D=D)


def _in_words(s: Ingredients, of: Sayable, right: sp.Expr, written: sp.Expr) -> InWords:
    words = told(of, [right], [written], (right,), (written,))
    return replace(words, apart=told_apart(s, right, written) if written.is_Add or right.is_Add else ())
