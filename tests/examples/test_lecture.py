"""The lecture's four examples, equation for equation."""

from __future__ import annotations

import unicodedata

import pytest
import sympy as sp
from derived import derivation
from sympy import Rational, cos, sin, symbols
from sympy.physics.mechanics import dynamicsymbols

g = sp.Symbol("g")
half = Rational(1, 2)


def same(one: sp.Expr, other: sp.Expr) -> bool:
    return sp.expand(one - other) == 0


def vanishes(expr: sp.Expr) -> bool:
    """Whether a polynomial in sines and cosines is 0: sin² = 1 − cos² leaves one way to write it."""
    whole = sp.expand(expr, trig=True)
    even = whole.replace(
        lambda e: e.is_Pow and e.exp.is_Integer and isinstance(e.base, sp.sin),
        lambda e: (1 - cos(e.base.args[0]) ** 2) ** (e.exp // 2) * e.base ** (e.exp % 2),
    )
    return sp.expand(even) == 0


def rates(names: str) -> list[sp.Expr]:
    """Coordinates, their rates and their accelerations, in a row."""
    q = list(dynamicsymbols(names + " _")[:-1])
    t = dynamicsymbols._t
    return [*q, *[x.diff(t) for x in q], *[x.diff(t, 2) for x in q]]


def test_example_1() -> None:
    d = derivation("lecture-1")
    m, L_m, k, L_k, b, L_b = symbols("m L_m k L_k b L_b")
    theta, rate, acceleration = rates("theta")
    (tau,) = rates("tau")[:1]
    assert same(d.T, half * m * (L_m * rate) ** 2)
    assert same(d.V, half * k * (L_k * theta) ** 2 - m * g * L_m * cos(theta))
    assert same(d.L, d.T - d.V)
    assert same(d.Xi[theta], tau - b * L_b**2 * rate)
    (equation,) = d.equations
    assert same(
        equation.lhs, m * L_m**2 * acceleration + b * L_b**2 * rate + k * L_k**2 * theta + m * g * L_m * sin(theta)
    )
    assert equation.rhs == tau


def two_link(relative: bool) -> tuple[sp.Expr, sp.Expr]:
    """T* and V as the lecture sets them up: squares of the rates of x and y, each mass's m g y."""
    L_a, L_b, L_c, *masses = symbols("L_a L_b L_c m1 m2 m3")
    one, two = dynamicsymbols("theta1 theta2")
    last = one + two if relative else two
    x2, y2 = (L_a + L_b) * cos(one), (L_a + L_b) * sin(one)
    places = [(L_a * cos(one), L_a * sin(one)), (x2, y2), (x2 + L_c * cos(last), y2 + L_c * sin(last))]
    t = dynamicsymbols._t
    T = sum(half * m * (x.diff(t) ** 2 + y.diff(t) ** 2) for m, (x, y) in zip(masses, places, strict=True))
    return T, sum(m * g * y for m, (_, y) in zip(masses, places, strict=True))


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("name", "relative"), [("lecture-2", True), ("lecture-2-absolute", False)])
def test_example_2(name: str, relative: bool) -> None:
    d = derivation(name)
    T, V = two_link(relative)
    t = dynamicsymbols._t
    (tau,) = rates("tau")[:1]
    Xi = (0, tau) if relative else (-tau, tau)
    assert tuple(d.Xi.values()) == Xi
    assert vanishes(d.T - T)
    assert vanishes(d.V - V)
    for q, equation, xi in zip(dynamicsymbols("theta1 theta2"), d.equations, Xi, strict=True):
        left = (T - V).diff(q.diff(t)).diff(t) - (T - V).diff(q)
        assert vanishes(equation.lhs - left)
        assert equation.rhs == xi


def test_example_3a() -> None:
    d = derivation("lecture-3a")
    m1, m2, k = symbols("m1 m2 k")
    x1, x2, v1, v2, a1, a2 = rates("x1 x2")
    (F,) = rates("F")[:1]
    assert same(d.T, half * m1 * v1**2 + half * m2 * v2**2)
    assert same(d.V, half * k * (x1 - x2) ** 2)
    assert tuple(d.Xi.values()) == (-F, F)
    assert same(d.equations[0].lhs, m1 * a1 + k * (x1 - x2))
    assert same(d.equations[1].lhs, m2 * a2 - k * (x1 - x2))
    assert [e.rhs for e in d.equations] == [-F, F]


def test_example_3b() -> None:
    d = derivation("lecture-3b")
    m1, m2, k = symbols("m1 m2 k")
    _, x2r, v1, v2r, a1, a2r = rates("x1 x2r")
    (F,) = rates("F")[:1]
    assert same(d.T, half * m1 * v1**2 + half * m2 * (v1 + v2r) ** 2)
    assert same(d.V, half * k * x2r**2)
    assert tuple(d.Xi.values()) == (0, F)
    assert same(d.equations[0].lhs, (m1 + m2) * a1 + m2 * a2r)
    assert same(d.equations[1].lhs, m2 * a1 + m2 * a2r + k * x2r)
    assert [e.rhs for e in d.equations] == [0, F]


def test_the_file_of_the_design_is_example_3b() -> None:
    ours, lecture = derivation("two-carts"), derivation("lecture-3b")
    rename = {dynamicsymbols("x2"): dynamicsymbols("x2r")}
    for one, other in zip(ours.equations, lecture.equations, strict=True):
        assert same(one.lhs.subs(rename) - one.rhs.subs(rename), other.lhs - other.rhs)


@pytest.mark.parametrize(
    ("name", "printed"),
    [
        ("lecture-1", ["½ m L_m² θ̇²", "m L_m² θ̈ + b L_b² θ̇ + k L_k² θ + m g L_m sin θ = τ"]),
        ("lecture-3a", ["½ k (x₁ − x₂)²", "m₁ ẍ₁ + k (x₁ − x₂) = −F", "m₂ ẍ₂ − k (x₁ − x₂) = F"]),
        ("lecture-3b", ["½ m₁ ẋ₁² + ½ m₂ (ẋ₁ + ẋ_2r)²", "(m₁ + m₂) ẍ₁ + m₂ ẍ_2r = 0", "m₂ ẍ₁ + m₂ ẍ_2r + k x_2r = F"]),
    ],
)
def test_the_page_reads_as_the_lecture_does(name: str, printed: list[str]) -> None:
    page = unicodedata.normalize("NFD", derivation(name).to_text(brief=True))
    for line in printed:
        assert unicodedata.normalize("NFD", line) in page
