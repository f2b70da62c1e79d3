"""Energies of spring laws: exact where the law has kinks, and an end to every search."""

import mpmath
import pytest
import sympy as sp

import lagrangian as lg
from lagrangian import ModelError, bounded
from lagrangian.model.antiderivatives import antiderivative
from lagrangian.read import parse_expression

k, c, x = sp.symbols("k c delta")

KINKED = [
    "k*delta*abs(delta)",
    "delta^2*sign(delta)",
    "max(k*delta, 0)",
    "min(k*delta, c*delta)",
    "k*delta + c*delta^3*abs(delta) - 2*sign(delta)",
    "k*max(delta - 1/2, 0)",
    "k*delta*abs(2*delta + 1)^3",
    "max(delta, c) + min(delta^2, 2*delta^2)",
    "sqrt(abs(delta))*sign(delta)",
    "piecewise(delta < 0, k*delta, 2*k*delta)",
    "piecewise(delta < -1, -k, delta <= 1/3, k*delta, delta^2)",
    "(k*delta - c)*sign(3*delta - 1)",
    "k*sqrt(abs(delta))*sign(delta)",
    "k*abs(delta)^(3/2)*sign(delta)",
    "k*delta*sqrt(abs(delta))",
    "k*delta*sqrt(abs(delta))*sign(delta)",
    "k*sqrt(abs(c*delta))*sign(c*delta)",
    "k*max(delta, 2*delta)*sign(delta)",
    "k*sqrt(abs(delta - 1/3))*sign(delta - 1/3)",
    "k*delta*sqrt(abs(2*delta + 1))*sign(2*delta + 1) + c*delta",
]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("law", KINKED)
@pytest.mark.parametrize("signs", [(1.3, 0.7), (-0.6, 1.1)])
def test_a_law_with_kinks_has_the_energy_that_its_area_is(law: str, signs: tuple[float, float]) -> None:
    """Against the area under the law by quadrature, split where it may bend."""
    values = dict(zip((k, c), signs, strict=True))
    expr = parse_expression(law, {"k": k, "c": c, "delta": x})
    energy = antiderivative(expr, x)
    assert energy is not None and not energy.has(sp.Integral)

    pull, stored = (sp.lambdify(x, e.subs(values), "mpmath") for e in (expr, energy))
    bends = [-1, -0.5, 0, 1 / 3, 0.5, *signs]
    for end in (-2.2, -0.8, 0.25, 0.9, 2.6):
        low, high = sorted((0.0, end))
        places = sorted({low, high, *(b for b in bends if low < b < high)})
        area = mpmath.quad(pull, places) * (1 if end > 0 else -1)
        assert float(stored(end)) == pytest.approx(float(area), abs=1e-9), (law, end)


@pytest.mark.parametrize(
    ("law", "energy"),
    [
        ("k*delta*abs(delta)", k * sp.Abs(x) ** 3 / 3),
        ("delta^2*sign(delta)", sp.Abs(x) ** 3 / 3),
        ("k*sqrt(abs(delta))*sign(delta)", 2 * k * sp.Abs(x) ** sp.Rational(3, 2) / 3),
        ("max(k*delta, 0)", x * sp.Max(0, k * x) / 2),
        ("k*max(delta, 0)", k * sp.Max(0, x) ** 2 / 2),
        ("k*delta + c*delta^3", k * x**2 / 2 + c * x**4 / 4),
    ],
)
def test_energies_read_as_a_book_writes_them(law: str, energy: sp.Expr) -> None:
    assert antiderivative(parse_expression(law, {"k": k, "c": c, "delta": x}), x) == energy


@pytest.mark.slow
def test_a_search_ends_after_a_number_of_calls() -> None:
    """1/(1 + δ⁹⁷) has 97 logarithms: the search for them is given up, and the spring says so."""
    assert antiderivative(1 / (1 + x**97), x) is None
    system = lg.System("hard")
    q = system.coordinate("q")
    system.particle(1, at=system.origin + (q, 0))
    with pytest.raises(ModelError, match="no closed form was found for the integral of its law") as caught:
        system.spring(deflection=q, law=lambda d: 1 / (1 + d**97))
    assert caught.value.fix is not None and "energy" in caught.value.fix


def test_calls_are_counted_and_not_time() -> None:
    def climb(n: int) -> int:
        return 0 if n == 0 else 1 + climb(n - 1)

    assert bounded.searched(climb, 50, calls=60) == 50
    assert bounded.searched(climb, 50, calls=40) is None


@pytest.mark.parametrize("law", ["k*sqrt(abs(delta))*sign(delta)", "k*sqrt(abs(delta - 1/3))*sign(delta - 1/3)"])
def test_a_spring_that_softens_from_its_kink_is_derived_and_run(law: str) -> None:
    """The pull grows like a root and jumps in slope: the equation holds the law itself, and no impulse."""
    system = lg.System("root")
    q, k = system.coordinate("q"), system.parameter("k", 2)
    system.particle(1, at=system.origin + (q, 0))
    expr = parse_expression(law, {"k": k, "delta": x})
    system.spring(deflection=q, law=lambda d: expr.subs(x, d))
    derivation = system.derive()
    assert all(check.holds for check in derivation.verified)
    left = derivation.equations[0].lhs - derivation.equations[0].rhs
    for place in (-1.3, 0.2, 0.9):
        values = {q.diff(sp.Symbol("t"), 2): 0, q: place, k: 2}
        assert float(left.subs(values)) == pytest.approx(float(expr.subs({k: 2, x: place})))
    run = system.simulate(1.0, q=0.9, samples=5)
    assert run.success and float(run.audit) < 1e-6


@pytest.mark.parametrize("value", ["k*q*sign(q)", "k*sign(q)"])
def test_an_energy_that_jumps_is_refused_in_the_words_of_its_reader(value: str) -> None:
    system = lg.System("jump")
    q, k = system.coordinate("q"), system.parameter("k", 2)
    system.particle(1, at=system.origin + (q, 0))
    system.potential(parse_expression(value, {"k": k, "q": q}))
    with pytest.raises(ModelError, match="jumps") as caught:
        system.derive()
    assert "DiracDelta" not in str(caught.value) and "abs(x) for x*sign(x)" in str(caught.value)
