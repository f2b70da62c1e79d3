"""The normal form against SymPy's own differentiation and high-precision evaluation at random points."""

from __future__ import annotations

import random
from dataclasses import dataclass
from fractions import Fraction

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from sympy.core.function import AppliedUndef
from sympy.physics.mechanics import dynamicsymbols

import lagrangian as lg
from lagrangian.derive.algebra import Algebra, Form, OutOfReach, equations
from lagrangian.derive.algebra.monomials import multiples, turn, whole
from lagrangian.errors import ModelError
from size import sized

t = dynamicsymbols._t
x, theta, phi = dynamicsymbols("x theta phi")
u = dynamicsymbols("u")
m, L, k, h, alpha, Omega, l0 = sp.symbols("m L k h alpha Omega l0")
SYMBOLS = (x, theta, phi, m, L, alpha)


@dataclass(frozen=True)
class Named:
    symbol: sp.Expr


@dataclass(frozen=True)
class Described:
    coordinates: tuple[Named, ...]


def algebra(*coordinates: sp.Expr) -> Algebra:
    return Algebra(Described(tuple(Named(c) for c in coordinates or (x, theta, phi))))


def value(expr: sp.Expr, seed: int = 0, digits: int = 40) -> sp.Expr:
    """The expression at a random state; every name has its own number, the same in every call with this seed."""

    def number(name: object) -> sp.Float:
        return sp.Float(random.Random(f"{seed} {name}").uniform(0.3, 1.7), digits)

    table = {a: number(a) for a in expr.atoms(sp.Derivative, AppliedUndef)}
    expr = expr.xreplace(table)
    return sp.N(expr.xreplace({s: number(s) for s in expr.free_symbols}), digits)


def same(a: sp.Expr, b: sp.Expr, seeds: int = 2) -> bool:
    for seed in range(seeds):
        left, right = value(sp.sympify(a), seed), value(sp.sympify(b), seed)
        if abs(left - right) > 1e-25 * (1 + abs(left)):
            return False
    return True


READ = [
    sp.sin(theta) ** 2 + sp.cos(theta) ** 2,
    sp.cos(theta) * sp.cos(phi) + sp.sin(theta) * sp.sin(phi),
    (m * sp.sin(theta) + L * sp.cos(phi) - x) ** 3,
    sp.sin(2 * theta - 3 * phi + alpha) * sp.cos(theta / 2) * sp.sin(theta / 3),
    sp.cos(Omega * t + alpha) * sp.sin(theta - Omega * t),
    sp.sin(theta + sp.pi / 3) + sp.cos(theta - sp.pi / 7) + sp.cos(theta + 2 * sp.pi / 3),
    sp.sin(sp.Rational(3, 10) + theta) * sp.cos(sp.Rational(123457, 99991) * theta),
    sp.sin(x / L) * sp.cos(x * theta) + sp.cos(sp.sin(theta)),
    1 / (m + L) + 1 / (2 * m + 2 * L) + m / (m * L),
    sp.sqrt(x**2 + h**2) * sp.cos(theta) + 1 / sp.sqrt(x**2 + h**2),
    (x**2 + h**2) ** sp.Rational(3, 2) + (x**2 + h**2) ** sp.Rational(-5, 2) + sp.sqrt(4 * x**2 + 4 * h**2),
    sp.sqrt(L**2 + h**2 - 2 * L * h * sp.cos(theta)),
    sp.exp(-x / L) * sp.tanh(theta) + sp.log(1 + x**2) + sp.atan2(x, h) + x**alpha,
    sp.tan(alpha) * sp.tan(theta) / sp.cos(theta),
    sp.Abs(x - l0) + sp.sign(theta) * sp.Max(x, h),
    sp.Piecewise((k * x, x > h), (0, True)),
    u * sp.cos(theta) + sp.Derivative(u, t) * x + sp.Derivative(theta, (t, 2)),
    sp.pi * x + sp.E * theta + sp.sqrt(2) * sp.sqrt(m),
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("expr", READ, ids=lambda e: str(e)[:40])
def test_form_keeps_the_value(expr: sp.Expr) -> None:
    form = algebra().form(expr)
    assert same(form.raw(), expr)
    assert same(form.expr(), expr)
    assert same(sp.Add(*[term.expr for term in form.terms()]), expr)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("expr", [e for e in READ if not e.has(sp.sign, sp.Abs, sp.Max)], ids=lambda e: str(e)[:40])
def test_derivatives_are_those_of_sympy(expr: sp.Expr) -> None:
    form = algebra().form(expr)
    for symbol in (x, theta, m, L, h):
        assert same(form.diff(symbol).expr(), sp.diff(expr, symbol)), symbol
    assert same(form.total_derivative().expr(), sp.diff(expr, t))


def test_kinks_differentiate_to_signs_without_complex_numbers() -> None:
    form = algebra().form(sp.Abs(x - l0) ** 3)
    assert same(form.diff(x).expr(), 3 * (x - l0) * sp.Abs(x - l0))


def test_second_time_derivative() -> None:
    expr = sp.sin(theta) * x + sp.sqrt(x**2 + h**2)
    twice = algebra().form(expr).total_derivative().total_derivative()
    assert same(twice.expr(), sp.diff(expr, t, 2))


def trigonometric() -> st.SearchStrategy[sp.Expr]:
    """Random polynomials in sines and cosines of whole combinations of angles, lengths and rates."""
    whole = st.integers(-2, 2)
    angle = st.tuples(whole, whole, st.integers(0, 1)).map(lambda k: k[0] * theta + k[1] * phi + k[2] * alpha)
    leaf = st.one_of(
        st.sampled_from([m, L, x, sp.Derivative(theta, t)]), angle.map(sp.sin), angle.map(sp.cos), whole.map(sp.Integer)
    )
    return st.recursive(
        leaf,
        lambda inner: st.one_of(st.tuples(inner, inner).map(sum), st.tuples(inner, inner).map(_times)),
        max_leaves=6,
    )


def _times(pair: tuple[sp.Expr, sp.Expr]) -> sp.Expr:
    return pair[0] * pair[1]


@sized(25, 4)
@given(trigonometric(), trigonometric())
def test_equal_expressions_have_one_form(a: sp.Expr, b: sp.Expr) -> None:
    ring = algebra()
    fa, fb = ring.form(a), ring.form(b)
    shuffled = sp.expand(sp.expand_trig(sp.expand(a * (a + b))))
    assert fa * (fa + fb) == ring.form(shuffled)
    assert (fa * fb - ring.form(sp.expand(a * b))).is_zero
    equal = sp.expand(sp.expand(a - b).rewrite(sp.exp)) == 0
    assert (fa == fb) == equal
    assert same((fa * fb + fa).expr(), a * b + a, 1)


@sized(25, 6)
@given(trigonometric())
def test_random_gradients(a: sp.Expr) -> None:
    form = algebra().form(a)
    assert same(form.diff(theta).expr(), sp.diff(a, theta), 1)
    assert same(form.total_derivative().expr(), sp.diff(a, t), 1)


def test_identities_are_decided() -> None:
    ring = algebra()
    zero = [
        sp.sin(theta) ** 2 + sp.cos(theta) ** 2 - 1,
        sp.cos(3 * theta) - 4 * sp.cos(theta) ** 3 + 3 * sp.cos(theta),
        sp.cos(theta) + sp.cos(theta + 2 * sp.pi / 3) + sp.cos(theta - 2 * sp.pi / 3),
        1 / (m + L) * (m + L) - 1,
        m / (m + L) + L / (m + L) - 1,
        1 / sp.cos(theta) - sp.cos(theta) - sp.sin(theta) ** 2 / sp.cos(theta),
        sp.sqrt(x**2 + h**2) - (x**2 + h**2) / sp.sqrt(x**2 + h**2),
        sp.Derivative(theta, t) * (m / (m * L) - 1 / L),
    ]
    for expr in zero:
        assert ring.form(expr).is_zero, expr
    for expr in (sp.sin(theta), 1 / (m + L) - 1 / (m + 2 * L), sp.sqrt(x**2 + h**2) - x):
        assert not ring.form(expr).is_zero, expr


def test_a_form_is_no_truth_value_and_no_key() -> None:
    form = algebra().form(x)
    with pytest.raises(TypeError, match="is_zero"):
        bool(form)
    with pytest.raises(TypeError):
        hash(form)


def test_keys_find_what_contributes_to_a_term() -> None:
    ring = algebra()
    spring, weight = ring.form(k * L**2 * theta), ring.form(m * h * L * sp.sin(theta))
    keys = ring.form((k + m) * theta).keys()
    assert not spring.restricted(keys).is_zero
    assert weight.restricted(keys).is_zero
    assert (spring + weight).restricted(ring.form(sp.sin(theta)).keys()) == weight


def test_opaque_parts_are_named() -> None:
    ring = algebra()
    assert ring.form(m * sp.cos(theta) / L).opaque() == ()
    assert ring.form(sp.exp(-x / L) * m).opaque() == (sp.exp(-x / L),)
    assert ring.form(sp.sqrt(x**2 + h**2)).opaque() == (sp.sqrt(h**2 + x**2),)


@pytest.mark.parametrize("expr", [sp.I * x, x + sp.oo, sp.zoo, sp.nan, sp.Pow(sp.S.Zero * x, -1, evaluate=False)])
def test_what_is_no_real_expression_is_refused(expr: sp.Expr) -> None:
    with pytest.raises(OutOfReach) as error:
        algebra().form(expr)
    assert isinstance(error.value, ModelError)


def test_huge_powers_stay_as_they_are() -> None:
    expr = (x + m) ** 5000 + x**1000
    form = algebra().form(expr)
    assert form.size == 2
    assert same(form.diff(x).expr(), sp.diff(expr, x))


def test_a_long_power_stays_and_a_long_product_is_refused() -> None:
    names = sp.symbols("a0:65")
    ring = algebra()
    assert ring.form(sp.Add(*names) ** 40).size == 1
    factors = [ring.form(sp.Add(*[n**i for n in names]) ** 2) for i in (1, 2)]
    with pytest.raises(OutOfReach, match="too long"):
        _ = factors[0] * factors[1]


def test_a_power_of_sines_stays_where_its_exponentials_are_too_many() -> None:
    """(m + L cos φ + sin x)^60 has three letters but five exponentials: up to C(64, 4) = 635 376 terms."""
    ring, expr = algebra(), x * (m + L * sp.cos(phi) + sp.sin(x)) ** 60
    form = ring.form(expr)
    assert form.size == 1 and len(ring.reader.left) == 1
    assert same(form.diff(x).expr(), sp.diff(expr, x))
    assert ring.form((sp.cos(x) + sp.sin(x)) ** 40).size > 1  # two exponentials


def test_decimals_are_read_exactly() -> None:
    ring = algebra()
    assert ring.form(sp.Float(9.81) * x) == ring.form(sp.Rational("9.81") * x)


def test_equations_are_those_of_sympy() -> None:
    X = x + L * sp.sin(theta)
    Y = -L * sp.cos(theta)
    T = [k * sp.diff(x, t) ** 2 / 2, m * (sp.diff(X, t) ** 2 + sp.diff(Y, t) ** 2) / 2]
    V = [m * h * Y]
    ring = algebra(x, theta)
    found = equations([ring.form(e) for e in T], [ring.form(e) for e in V], [x, theta], ring)
    lagrangian = sum(T) - sum(V)
    for q, form in zip((x, theta), found, strict=True):
        expected = sp.diff(sp.diff(lagrangian, sp.diff(q, t)), t) - sp.diff(lagrangian, q)
        assert isinstance(form, Form)
        assert same(form.expr(), expected)


MULTIPLES = st.fractions(min_value=-64, max_value=64, max_denominator=64).filter(bool)


@pytest.mark.slow
@given(st.dictionaries(st.integers(0, 6), MULTIPLES, max_size=5))
def test_multiples_of_angles_come_out_of_a_harmonic_as_they_went_in(multiples_of: dict[int, Fraction]) -> None:
    packed = whole(sum((k * turn(j) for j, k in multiples_of.items()), Fraction(0)))
    assert dict(multiples(packed)) == multiples_of


def test_halves_and_other_fractions_of_several_angles_stay_what_they_are() -> None:
    """V = cos((a + b)/2) + sin(6/5 + 3a/10): by hand −½ sin((a + b)/2) + (3/10) cos(6/5 + 3a/10) for a."""
    system = lg.System("halves")
    a, b = system.coordinates("a b")
    system.kinetic(a.diff() ** 2 / 2 + b.diff() ** 2 / 2)
    system.potential(sp.cos((a + b) / 2) + sp.sin(sp.Rational(6, 5) + sp.Rational(3, 10) * a))
    found = system.derive()
    half = sp.sin((a + b) / 2) / 2
    third = sp.Rational(3, 10) * sp.cos(sp.Rational(6, 5) + sp.Rational(3, 10) * a)
    by_hand = [a.diff(system.t, 2) - half + third, b.diff(system.t, 2) - half]
    for equation, expected in zip(found.equations, by_hand, strict=True):
        assert sp.expand_trig(equation.lhs - equation.rhs - expected).subs({a: 0.3, b: 0.8}).evalf() == pytest.approx(0)
    assert all(check.holds for check in found.verified)


def test_a_multiple_that_is_too_long_a_fraction_is_refused_not_mistaken() -> None:
    long = Fraction(2**40 + 1, 3**30)
    with pytest.raises(OutOfReach, match="too long a fraction"):
        multiples(whole(long + turn(1)))


@pytest.mark.parametrize("phase", [sp.pi / 7, 2 * sp.pi / 9, 3 * sp.pi / 11])
def test_parts_of_a_turn_without_roots_are_numbers(phase: sp.Expr) -> None:
    """cos π/7 is no expression of square roots; it stays as it is."""
    found = algebra().form(sp.cos(theta + phase)).expr()
    for at in (sp.Rational(3, 10), sp.Rational(17, 10)):
        value = sp.N((found - sp.cos(theta + phase)).subs(theta, at), 30)
        assert abs(value) < 1e-25
