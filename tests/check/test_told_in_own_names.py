"""What is wrong is told in the names that the answer defines, with its differences of angles in its own order.

Oracle: a crane's jib with a counterweight, a boom on a rocking base and two bars, with equations by hand.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.explain.in_own_names import OwnName, in_order, with_names
from lagrangian.model.names import moving_symbol


@cache
def jib() -> lg.Derivation:
    """A jib that turns, with a trolley at s and a counterweight at p + s/2."""
    s = lg.System("jib")
    phi, x = s.coordinates("phi s")
    J, m, n, p, d = s.parameters("J m n p d")
    rho = p + x / 2
    s.kinetic((J + m * x**2 + n * rho**2) * phi.diff() ** 2 / 2 + m * x.diff() ** 2 / 2 + n * (x.diff() / 2) ** 2 / 2)
    s.damper(d, deflection=x)
    s.torque(s.input("M"), on=phi)
    return s.derive()


@cache
def boom() -> lg.Derivation:
    """A pendulum whose pivot rocks at a given angle β = b sin Ω t about a point below it."""
    s = lg.System("boom")
    phi = s.coordinates("phi")
    m, a, H, b, Om, g = s.parameters("m a H b Omega g")
    beta = b * sp.sin(Om * s.t)
    x, y = -H * sp.sin(beta) + a * sp.sin(phi), H * sp.cos(beta) - a * sp.cos(phi)
    s.kinetic(m * (sp.diff(x, s.t) ** 2 + sp.diff(y, s.t) ** 2) / 2)
    s.potential(m * g * y)
    return s.derive()


def first(derivation: lg.Derivation, answer: str) -> str:
    """The first mistake that is told."""
    verdict = derivation.check(answer)
    assert not verdict.right
    return " ".join(str(verdict.mistakes[0].what).split())


JIB = """rho = p + s/2
(J + m s^2 + n rho^2) phi'' + 2 m s s' phi' + n rho s' phi' = M
(m + n/4) s'' - m s phi'^2 - n/2 rho phi'^2 = -d s'"""


@pytest.mark.slow
def test_a_term_is_told_in_the_names_of_the_answer() -> None:
    assert jib().check(JIB, hint=0).right
    told = first(jib(), JIB.replace("n/2 rho phi'^2", "n/2 m rho phi'^2"))
    assert "rho*phi'^2" in told and "p + s/2" not in told
    told = first(jib(), JIB.replace("n rho^2", "n rho"))
    assert "n*rho^2" in told and "2*p + s" not in told


def test_a_name_that_no_wrong_line_has_is_not_put_in() -> None:
    told = first(
        jib(),
        "rho = p + s/2\n" + JIB.split("\n", 1)[1].replace("n/2 rho phi'^2", "n/2 J phi'^2").replace("rho", "(p + s/2)"),
    )
    assert "rho" not in told


@pytest.mark.sampled(2)
@pytest.mark.parametrize("difference", ["phi - beta", "beta - phi"])
def test_a_difference_of_angles_keeps_the_order_of_the_answer(difference: str) -> None:
    sign = "" if difference == "phi - beta" else "-"
    row = (
        (
            f"beta = b sin(Omega t)\nm a^2 phi'' - m a H beta'' cos({difference}) "
            f"- {sign or '+'} m a H beta'^2 sin({difference}) + m g a sin(phi) = 0"
        )
        .replace("- + m", "- m")
        .replace("- - m", "+ m")
    )
    assert boom().check(row, hint=0).right
    verdict = boom().check(row.replace(f"cos({difference})", f"2 cos({difference})"))
    written = verdict.to_text()
    wanted = "φ − β" if difference == "phi - beta" else "β − φ"
    assert f"cos({wanted})" in written and "sin(Ω t)" not in written.partition("What went wrong")[2]


def test_what_a_formula_is_does_not_change() -> None:
    a, b, c, x = sp.symbols("a b c x")
    q, r = moving_symbol("q"), moving_symbol("r")
    names = [OwnName(r, a + b * sp.cos(q)), OwnName(x, c * a / 2)]
    for expr in (
        c * (a + b * sp.cos(q)) ** 2 * q.diff(),
        sp.expand((a + b * sp.cos(q)) * c) + a + b * sp.cos(q) + c,
        (2 * a + 2 * b * sp.cos(q)) / c - a - b * sp.cos(q),
        a**2 * c**2 * sp.sin(q),
        a * c * b / 4 + sp.cos(a * c / 2 + q),
    ):
        made = with_names(expr, names)
        assert made != expr
        assert sp.expand(made.subs({r: a + b * sp.cos(q), x: c * a / 2}) - expr) == 0


def test_the_whole_of_a_formula_is_not_replaced() -> None:
    a, b, x = sp.symbols("a b x")
    assert with_names(a + b, [OwnName(x, a + b)]) == a + b


def test_sines_in_the_other_order_have_the_same_value() -> None:
    a, b, c = sp.symbols("alpha beta c")
    for expr in (c * sp.sin(a - b), -3 * sp.sin(a - b) ** 2 + sp.cos(a - b), sp.sqrt(1 + sp.sin(a - b))):
        for order in ({("alpha", "beta")}, {("beta", "alpha")}):
            made = in_order(expr, order)
            values = {a: 0.3, b: 1.1, c: 2.0}
            assert abs(made.subs(values).evalf() - expr.subs(values).evalf()) < 1e-12


@pytest.mark.slow
def test_a_balance_without_energies_is_told_by_its_own_term() -> None:
    """R S for 2 R S, the arm of a rope at the top of a barrel: no energy of a body counts twice."""
    s = lg.System("barrel")
    x, u = s.coordinates("x s")
    M, m, R, J, W, a, alpha, k = s.parameters("M m R J J_w a alpha k")
    place = s.point("B", (x + u * sp.cos(alpha), u * sp.sin(alpha)))
    s.particle(M, at=s.point("C", (x, 0)), name="car")
    s.rigid_body(m, inertia=J, at=place, frame=s.frame(-u / R), name="barrel")
    s.kinetic(2 * W * u.diff() ** 2 / a**2, name="drum")
    s.gravity()
    s.spring(k=k, deflection=x, name="spring")
    s.force(s.input("tau"), deflection=2 * u / a)
    d = s.derive()
    answer = """(M + m) x'' + m s'' cos(alpha) + k x = 0
m (s'' + x'' cos(alpha)) R + J s''/R = 2 S R - m g R sin(alpha)
2 J_w s''/a = tau - S a
S = tau/a - 2 J_w s''/a^2"""
    assert d.check(answer).right
    (mistake,) = d.check(answer.replace("2 S R", "S R")).mistakes
    assert str(mistake.what) == "In line 2, on the right-hand side, R*S should be 2*R*S."


def test_a_rate_that_the_answer_never_writes_is_not_shown() -> None:
    """d is the factor of φ̈ on a base that rocks as given; nobody wrote ḋ."""
    s = lg.System("swing")
    phi = s.coordinates("phi")
    m, a, J, b, Om = s.parameters("m a J b Omega")
    d = J + m * a**2 + 2 * m * a * b * sp.cos(Om * s.t)
    s.kinetic(d * phi.diff() ** 2 / 2)
    s.potential(m * a * sp.cos(phi))
    derivation = s.derive()
    answer = "d = J + m a^2 + 2 m a b cos(Omega t)\nphi'' = (m a sin(phi) + {} m a b Omega sin(Omega t) phi')/d"
    assert derivation.check(answer.format("2"), hint=0).right
    told = first(derivation, answer.format(""))
    assert "counts half" in told and "d'" not in told and "Omega" in told, told
