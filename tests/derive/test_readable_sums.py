"""Sums of parameters as letters, and how deep and how scattered what is shown may be."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from sympy.physics.mechanics import dynamicsymbols

from lagrangian.derive.algebra import Algebra, Form, equations
from lagrangian.derive.algebra.factor import Flat
from lagrangian.derive.algebra.monomials import packed
from lagrangian.derive.algebra.sums import sums_in, with_sums
from size import sized

t = dynamicsymbols._t
sin, cos = sp.sin, sp.cos
a, b, c, m1, m2, m3, g = sp.symbols("a b c m1 m2 m3 g")
one, two = dynamicsymbols("theta1 theta2")


@dataclass(frozen=True)
class Named:
    symbol: sp.Expr


@dataclass(frozen=True)
class Described:
    coordinates: tuple[Named, ...]


def arm(relative: bool) -> tuple[Algebra, list[Form]]:
    """The lecture's two links with masses at a, a + b on the first and c on the second."""
    last = one + two if relative else two
    end = (a + b) * cos(one), (a + b) * sin(one)
    places = [(a * cos(one), a * sin(one)), end, (end[0] + c * cos(last), end[1] + c * sin(last))]
    T = [m * (x.diff(t) ** 2 + y.diff(t) ** 2) / 2 for m, (x, y) in zip((m1, m2, m3), places, strict=True)]
    V = [m * g * y for m, (_, y) in zip((m1, m2, m3), places, strict=True)]
    ring = Algebra(Described((Named(one), Named(two))), [*T, *V])
    return ring, equations([ring.form(e) for e in T], [ring.form(e) for e in V], [one, two], ring)


def depth(expr: sp.Expr) -> int:
    """Parentheses inside one another around sums; a sum that is an argument of a sine is none."""
    if isinstance(expr, sp.Add):
        return max(depth(x) for x in expr.args)
    if isinstance(expr, (sp.Mul, sp.Pow)):
        return max(depth(x) + isinstance(x, sp.Add) for x in expr.args)
    return 0


@pytest.mark.parametrize("relative", [False, True])
def test_the_lectures_arm_keeps_its_sum_of_lengths(relative: bool) -> None:
    _, found = arm(relative)
    for form in found:
        for term in form.terms():
            assert not term.expr.has(b) or term.expr.has(a + b)
            assert depth(term.expr) <= 2
    inertia = [term.expr for term in found[0].terms() if term.kind == "inertia"]
    for q, expr in zip((one, two), inertia, strict=True):
        assert expr.atoms(sp.Derivative) == {q.diff(t, 2)}
    gravity = next(term.expr for term in found[0].terms() if term.expr.has(cos(one)) and term.kind == "gravity")
    assert str(gravity / cos(one)) == "g*(a*m1 + (a + b)*(m2 + m3))"


SUMS = [
    ((a + b) * cos(one), {a: 1, b: 1}),
    (m1 * (a - b) ** 2 * one.diff(t) ** 2, {a: 1, b: -1}),
    (m1 * (a + b + c) ** 2 * one.diff(t) ** 2 / 2, {a: 1, b: 1, c: 1}),
    (m1 * (a**2 + b**2) * one, None),
    ((a + 2 * b) * one, None),
    (a + b, None),
    ((a + one) * cos(two), None),
]


@pytest.mark.parametrize(("expr", "expected"), SUMS, ids=[str(e) for e, _ in SUMS])
def test_sums_are_found_themselves_or_squared(expr: sp.Expr, expected: dict[Any, int] | None) -> None:
    ring = Algebra(Described((Named(one), Named(two))))
    found = sums_in(ring.form(expr), ring.generators)
    if expected is None:
        assert found == []
        return
    (base,) = found
    written = sp.Add(*[sp.Rational(v) * ring.generators.expr(n) for n, v in base.items()])
    wanted = sp.Add(*[v * s for s, v in expected.items()])
    assert sp.expand(written - wanted) == 0 or sp.expand(written + wanted) == 0


@sized(40, 8)
@given(st.dictionaries(st.tuples(*[st.integers(0, 3)] * 3), st.integers(-4, 4).filter(bool), min_size=2, max_size=9))
def test_sums_put_in_multiply_out_to_what_they_came_from(terms: dict[tuple[int, ...], int]) -> None:
    """Against SymPy's expansion."""
    ring = Algebra(Described((Named(one),)))
    generators = ring.generators
    index = [generators.index(s) for s in (a, b, m1)]
    flat: Flat = {int(packed(zip(index, e, strict=True))): Fraction(v) for e, v in terms.items()}
    sums = [
        {int(packed([(index[0], 1)])): Fraction(1), int(packed([(index[1], 1)])): Fraction(sign)} for sign in (1, -1)
    ]
    shown = with_sums(flat, sums, generators)

    def written(poly: Flat) -> sp.Expr:
        return sp.Add(*[sp.Rational(v.numerator, v.denominator) * generators.expr(m) for m, v in poly.items()])

    assert sp.expand(written(shown) - written(flat)) == 0
    assert len(shown) <= len(flat)


def test_terms_of_different_kinds_stay_apart() -> None:
    x = dynamicsymbols("x")
    speed = x.diff(t) ** 2 * (1 + 4 * c**2 * x**2)
    ring = Algebra(Described((Named(x),)), [m1 * speed / 2])
    assert str(ring.form(m1 * speed / 2).expr()) == "m1*(4*c**2*x(t)**2 + 1)*Derivative(x(t), t)**2/2"
    whole = ring.form(m1 * x.diff(t, 2) + b * x.diff(t) * (1 + 4 * c**2 * x**2) + 4 * m1 * c**2 * x * x.diff(t) ** 2)
    assert len(whole.terms()) == 3
    k, k3 = sp.symbols("k k3")
    assert [term.expr for term in ring.form(k3 * x**3 + k * x).terms()] == [k * x, k3 * x**3]


def test_accelerations_come_in_the_order_of_the_coordinates() -> None:
    x, length = dynamicsymbols("x l")
    ring = Algebra(Described((Named(x), Named(length), Named(one))))
    expr = m1 * length * one.diff(t, 2) * cos(one) + m1 * length.diff(t, 2) * sin(one) + (m1 + m2) * x.diff(t, 2)
    accelerations = [term.expr.atoms(sp.Derivative) for term in ring.form(expr).terms()]
    assert accelerations == [{q.diff(t, 2)} for q in (x, length, one)]
    first = ring.form(m1 * one.diff(t, 2) - m2 * x.diff(t, 2)).terms()[0].expr
    assert first == m1 * one.diff(t, 2)


def test_inputs_on_one_arm_are_added_first() -> None:
    F1, F2 = dynamicsymbols("F1 F2")
    ring = Algebra(Described((Named(one),)))
    assert [str(term.expr) for term in ring.form(-F1 * sin(one) - F2 * sin(one)).terms()] == [
        "-(F1(t) + F2(t))*sin(theta1(t))"
    ]
    assert [str(term.expr) for term in ring.form(a * F1 - a * F2).terms()] == ["a*(F1(t) - F2(t))"]
