"""Finds the one wrong line among balances by what each takes of the equation of a coordinate: which bodies and forces.

Axle: J φ″ = S r − c φ̇;   board: M L²/3 (r/a) φ″ = F p − S a      the equation of φ is the first plus r/a of the second

Each line times its own factor is the share of some bodies and forces in the equation, and the forces that hold these
cancel in the sum of all. A line that is no such share, while the others are, is wrong; and where all are, and one force
does not cancel, the line is wrong in which its arm stands on the wrong side of a fraction line.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.constraints.eliminated import slope_of
from lagrangian.check.explain.candidates import ingredients_of
from lagrangian.check.explain.combined_rows import WrongTerm, is_mass
from lagrangian.check.explain.solved_forces import Balances
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import time

MOST_PIECES, MOST_TERMS = 5, 60
"""The most bodies of which all groups are compared with a line, and the most terms of a line."""


def wrong_share(truth: Reference, balances: Balances) -> tuple[int, WrongTerm] | None:
    """The place of the balance that is wrong, and the one term of it that is; None if that is not clear."""
    moving = [
        i for i, c in enumerate(truth.model.coordinates) if any(x.expr.has(c.acceleration) for x in balances.lines)
    ]
    if truth.derivation.multipliers or truth.values or len(moving) != 1:
        return None
    try:
        return _wrong(truth, balances, moving[0])
    except bounded.TooLarge:
        return None


def _wrong(truth: Reference, balances: Balances, i: int) -> tuple[int, WrongTerm] | None:
    bodies, forces = _pieces(truth, i)
    if not 0 < len(bodies) <= MOST_PIECES:
        return None
    acceleration = truth.model.coordinates[i].acceleration
    scales = [_scale(truth, x, balances.forces, acceleration, bodies, forces) for x in balances.lines]
    arms = [[slope_of(x.expr, f) or sp.S.Zero for f in balances.forces] for x in balances.lines]
    odd = [k for k, c in enumerate(scales) if c is None]
    if len(odd) > 1:
        return None
    sums = [
        sp.Add(*(c * arm[j] for c, arm in zip(scales, arms, strict=True) if c is not None))
        for j in range(len(balances.forces))
    ]
    if odd:
        [k] = odd
        needed = {bounded.cancel(-x / arm) for x, arm in zip(sums, arms[k], strict=True) if arm != 0}
        apart = [x for x, arm in zip(sums, arms[k], strict=True) if arm == 0]
        if len(needed) != 1 or 0 in needed or any(bounded.cancel(x) != 0 for x in apart):
            return None
        taken = [
            c * _known(truth, x, balances.forces) for c, x in zip(scales, balances.lines, strict=True) if c is not None
        ]
        term = _term(truth, balances, k, needed.pop(), sp.Add(*bodies, *forces, *(-x for x in taken)))
        return None if term is None else (k, term)
    left = [j for j, x in enumerate(sums) if bounded.cancel(x) != 0]
    if len(left) != 1:
        return None
    [j] = left
    terms = [
        (k, WrongTerm(arms[k][j] * cast("sp.Expr", balances.forces[j]), bounded.cancel(1 - sums[j] / c / arms[k][j])))
        for k, c in enumerate(scales)
        if c is not None and arms[k][j] != 0
    ]
    turned = [(k, x) for k, x in terms if _is_inverted(arms[k][j], x.factor)]
    return turned[0] if len(turned) == 1 else None


def _term(truth: Reference, balances: Balances, k: int, scale: sp.Expr, rest: sp.Expr) -> WrongTerm | None:
    """The one term of a balance that is wrong, where the others leave it ``rest`` of the equation."""
    known = _known(truth, balances.lines[k], balances.forces)
    more = _expanded(scale * known - rest)
    if more == 0 or len(sp.Add.make_args(more)) > 1:
        return None
    for term in sp.Add.make_args(known):
        part = bounded.cancel(more / (scale * term))
        if part.is_number and 1 - part > 0:
            return WrongTerm(term, 1 - part)
    return None


def _is_inverted(arm: sp.Expr, ratio: sp.Expr) -> bool:
    """Whether a factor of an arm, times a ratio, stands on the wrong side of a fraction line: 1/n for n."""
    powers = [x.as_base_exp() for x in sp.Mul.make_args(ratio)]
    held = dict(x.as_base_exp() for x in sp.Mul.make_args(arm))
    return bool(powers) and all(x.is_Symbol and abs(n) == 2 and held.get(x) == -n / 2 for x, n in powers)


def _pieces(truth: Reference, i: int) -> tuple[list[sp.Expr], list[sp.Expr]]:
    """What bodies, and what weights, springs and forces add to the left-hand side of the equation of ξ_i; those that
    add the same together."""
    s, c = ingredients_of(truth.derivation), truth.model.coordinates[i]
    energies = [T for e in truth.model.elements if (T := s.kinetic(e)) != 0]
    stored = [V for _, _, V in (*s.weights(), *s.springs())]
    acting = [share for e in truth.model.elements if (share := s.shares(e).get(i, sp.S.Zero)) != 0]
    bodies = [bounded.diff(T, c.rate, time) - bounded.diff(T, c.symbol) for T in energies]
    forces = [*(bounded.diff(V, c.symbol) for V in stored), *(-x for x in acting)]
    return _together(truth, bodies), _together(truth, forces)


def _together(truth: Reference, listed: Sequence[sp.Expr]) -> list[sp.Expr]:
    """Sums of what is the same."""
    count: dict[sp.Expr, int] = {}
    for x in listed:
        expr = _expanded(truth.put(x))
        count |= {expr: count.get(expr, 0) + 1} if expr != 0 else {}
    return [bounded.expand(n * x) for x, n in count.items() if bounded.expand(-x) not in count]


def _expanded(expr: sp.Expr) -> sp.Expr:
    """An expression, multiplied out, with cosines in place of squares of sines."""
    whole = bounded.expand(expr)
    squares = {
        x: 1 - sp.cos(x.base.args[0]) ** 2 for x in whole.atoms(sp.Pow) if isinstance(x.base, sp.sin) and x.exp == 2
    }
    return bounded.expand(cast("sp.Expr", whole.xreplace(squares))) if squares else whole


def _scale(
    truth: Reference,
    line: AnsweredLine,
    own: Sequence[sp.Basic],
    acceleration: sp.Expr,
    bodies: Sequence[sp.Expr],
    forces: Sequence[sp.Expr],
) -> sp.Expr | None:
    """The factor with which a line, but for forces of its own, is the share of some bodies and forces; None if it is
    of none, or if that holds a mass."""
    known = _known(truth, line, own)
    slope = bounded.diff(known, acceleration)
    if slope == 0 or len(sp.Add.make_args(known)) > MOST_TERMS:
        return None
    for size in range(1, len(bodies) + 1):
        for group in combinations(bodies, size):
            inertia = bounded.expand(sp.Add(*group))
            scale = bounded.cancel(bounded.diff(inertia, acceleration) / slope)
            letters = {x for x in bounded.letters(scale) if isinstance(x, sp.Symbol)}
            plain = len(sp.Add.make_args(scale)) == 1 and abs(scale.as_coeff_Mul()[0]) == 1
            if not plain or scale.has(sp.Derivative) or any(is_mass(truth, x) for x in letters):
                continue
            rest = {*sp.Add.make_args(bounded.expand(scale * known - inertia))} - {sp.S.Zero}
            for force in forces:
                terms = {*sp.Add.make_args(force)}
                rest = rest - terms if terms <= rest else rest
            if not rest:
                return scale
    return None


def _known(truth: Reference, line: AnsweredLine, own: Sequence[sp.Basic]) -> sp.Expr:
    """A line without forces of its own."""
    return _expanded(truth.expand(cast("sp.Expr", line.expr.xreplace(dict.fromkeys(own, sp.S.Zero)))))
