"""Random right answers are right, random wrong ones wrong: Hypothesis over combinations, factors, identities, slips."""

from functools import cache

import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

from lagrangian import System
from lagrangian.check import AnsweredLine, Status, check
from lagrangian.derivation import Derivation
from size import sized


@cache
def arm() -> tuple[Derivation, tuple[sp.Expr, ...], tuple[sp.Symbol, ...]]:
    """Two masses on two rods, relative angles, a spring and a motor between the rods; the rows are SymPy's own."""
    s = System("two rods")
    a, b = s.coordinates("a b")
    m, M, L, k, g = symbols = s.parameters("m M L k g")
    tau = s.input("tau")
    elbow = s.origin + (L * sp.sin(a), -L * sp.cos(a))
    tip = elbow + (L * sp.sin(a + b), -L * sp.cos(a + b))
    s.particle(m, at=elbow)
    s.particle(M, at=tip)
    s.gravity(g=g)
    s.spring(k, deflection=b)
    s.torque(tau, on=a + b, reaction=a)
    t = dynamicsymbols._t
    T = sum(w / 2 * sum(x.diff(t) ** 2 for x in p.position) for w, p in ((m, elbow), (M, tip)))
    V = k * b**2 / 2 + g * (m * elbow.position[1] + M * tip.position[1])
    rows = LagrangesMethod(T - V, [a, b]).form_lagranges_equations()
    return s.derive(), (rows[0], rows[1] - tau), symbols


def lines(rows: list[sp.Expr]) -> list[AnsweredLine]:
    return [AnsweredLine("equation", r, i) for i, r in enumerate(rows, 1)]


WHOLE = st.integers(-3, 3)
SHAPES = [lambda e: e, sp.expand, sp.expand_trig, lambda e: sp.expand(sp.expand_trig(e)), lambda e: e.rewrite(sp.cos)]


@sized(25, 2)
@given(WHOLE, WHOLE, WHOLE, WHOLE, st.sampled_from(range(len(SHAPES))), st.sampled_from(range(5)))
def test_combinations_with_factors_in_other_identities(p: int, q: int, r: int, s: int, shape: int, by: int) -> None:
    derivation, rows, symbols = arm()
    mixed = [p * rows[0] + q * rows[1] * symbols[by], r * rows[0] / symbols[by] + s * rows[1]]
    verdict = check(derivation, lines([SHAPES[shape](x) for x in mixed]))
    assert verdict.right == (p * s - q * r != 0), verdict
    assert verdict.status is not Status.WRONG


@sized(25, 2)
@given(
    st.integers(0, 1),
    st.integers(0, 40),
    st.sampled_from([sp.Integer(2), sp.Rational(1, 10**6), sp.Rational(-1, 10**12), sp.Rational(1, 3)]),
    st.sampled_from([1, -2, 5]),
)
def test_one_slip_in_one_term_is_wrong(row: int, term: int, slip: sp.Rational, factor: int) -> None:
    derivation, rows, _ = arm()
    written = sp.Add.make_args(sp.expand(rows[row]))
    wrong = list(rows)
    wrong[row] = factor * (rows[row] - slip * written[term % len(written)])
    verdict = check(derivation, lines(wrong))
    assert verdict.status is Status.WRONG
    assert verdict.first_wrong is not None and verdict.first_wrong.line.number == row + 1
    assert verdict.findings[1 - row].status is Status.RIGHT
