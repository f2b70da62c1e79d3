"""Of several explanations of one answer, that comes first which the answer shows as it is written.

Oracle: a head on a tilting column, a roller in a drum and an unbalance on a spring, by hand; answers with one mistake.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.errors import ParseError
from lagrangian.model import time

T = "T = (J + M a^2) theta'^2/2 + m ((s' - h theta')^2 + s^2 theta'^2)/2"
V = "V = M*g*a*cos(theta) + m*g*(s*cos(theta) - h*sin(theta))"
ROLLER = "T = I psi'^2/2 + m (R - r)^2 phi'^2/2 + J {}/2\nV = -m g (R - r) cos(phi)"


@cache
def column() -> lg.Derivation:
    """A head that slides along a tilting column, beside its axis."""
    s = lg.System("column")
    q, th = s.coordinates("s theta")
    M, a, J, m, h = s.parameters("M a J m h")
    centre = s.point("C", (a * sp.sin(th), a * sp.cos(th)))
    head = s.point("H", (q * sp.sin(th) + h * sp.cos(th), q * sp.cos(th) - h * sp.sin(th)))
    s.rigid_body(M, J, at=centre, frame=s.frame(-th, name="column"), name="column")
    s.particle(m, at=head, name="head")
    s.gravity()
    return s.derive()


@cache
def drum() -> lg.Derivation:
    """A roller in a turning drum."""
    s = lg.System("drum")
    psi, phi = s.coordinates("psi phi")
    I, J, R, r, m, b = s.parameters("I J R r m b")
    M = s.inputs("M")
    centre = s.point("C", ((R - r) * sp.sin(phi), -(R - r) * sp.cos(phi)))
    s.rigid_body(m, I, at=s.origin, frame=s.frame(psi, name="drum"), name="drum")
    s.rigid_body(m, J, at=centre, frame=s.frame((R * psi - (R - r) * phi) / r, name="roll"), name="roll")
    s.gravity()
    s.damper(b, deflection=psi, name="axle")
    s.torque(M, on=psi, name="motor")
    return s.derive()


@cache
def unbalance() -> lg.Derivation:
    """A machine on a spring, with a mass that is carried around."""
    s = lg.System("machine")
    y = s.coordinates("y")
    m, u, e, Omega, k = s.parameters("m u e Omega k")
    s.kinetic(m * y.diff() ** 2 / 2)
    s.particle(u, at=s.point("U", (0, y + e * sp.sin(Omega * time))), name="unbalance")
    s.spring(k, deflection=y)
    return s.derive()


def said(system: lg.Derivation, answer: str) -> list[str]:
    """What is said of a wrong answer, its best explanation first."""
    verdict = system.check(answer)
    assert not verdict.right
    return [" ".join(str(m.what).split()) for m in verdict.mistakes]


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("weight", "told"),
    [
        ("M*g*2*a*cos(theta)", "is taken twice as far out"),
        ("M g (2 a) cos(theta)", "is taken twice as far out"),
        ("2*M*g*a*cos(theta)", "stands with twice its value"),
        ("M*g*a/2*cos(theta)", "is taken half as far out"),
        ("M*g*0.5*a*cos(theta)", "is taken half as far out"),
        ("1/2*M*g*a*cos(theta)", "counts half"),
    ],
)
def test_a_number_beside_the_arm_is_of_the_height(weight: str, told: str) -> None:
    answer = f"{T}\n{V.replace('M*g*a*cos(theta)', weight)}"
    assert told in said(column(), answer)[0]


@pytest.mark.parametrize(
    ("weight", "told"),
    [(r"M g \frac{a}{2} \cos\theta", "taken half as far out"), (r"\frac{M g a}{2} \cos\theta", "counts half")],
)
def test_so_it_is_in_latex(weight: str, told: str) -> None:
    sheet = (
        r"\[T = \frac12 (J + M a^2) \dot\theta^2 + \frac12 m ((\dot s - h\dot\theta)^2 + s^2\dot\theta^2)\]"
        rf"\[V = {weight} + m g (s\cos\theta - h\sin\theta)\]"
    )
    assert told in said(column(), sheet)[0]


def test_a_sign_of_rates_is_told_of_the_one_that_has_a_factor() -> None:
    assert column().check(f"{T}\n{V}").right
    told = said(column(), f"{T.replace('- h', '+ h')}\n{V}")[0]
    assert told == "In the velocity of particle 'head', the sign of theta' against s' is wrong."


def test_sines_are_exchanged_in_the_weights_alone() -> None:
    wrong = "V = M*g*a*sin(theta) + m*g*(s*sin(theta) - h*cos(theta))"
    assert said(column(), f"{T}\n{wrong}")[0] == "Sine and cosine are exchanged in the weights."


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("omega", "told"),
    [
        ("(R psi' + (R - r) phi')/r", "(R - r)*phi'/r has the wrong sign."),
        ("(R psi' - R phi')/r", "R*phi'/r stands where (R - r)*phi'/r belongs."),
        ("(R psi' - (R - r) phi')/r + phi'", "the term phi' does not belong there."),
        ("(R - r) phi'/r", "the term -R*psi'/r is missing."),
    ],
)
@pytest.mark.parametrize("before", ["r omega = r ({})", "omega = {}"])
def test_it_is_said_in_which_rate_an_angular_velocity_is_wrong(omega: str, told: str, before: str) -> None:
    """Also where ω stands in no other line: it was not judged then."""
    answer = f"{before.format(omega)}\n{ROLLER.format('(' + omega + ')^2')}"
    [what] = said(drum(), answer)
    assert what.startswith("Line 1 is not right: the angular velocity of rigid body 'roll' is ") and what.endswith(told)
    right = "(R psi' - (R - r) phi')/r"
    verdict = drum().check(f"{before.format(right)}\n{ROLLER.format('(' + right + ')^2')}\nQ_psi = M - b psi'")
    assert verdict.right and verdict.findings[0].status.right


def test_a_name_of_the_answers_own_is_put_in_where_rolling_says_what_it_is() -> None:
    rows = (
        "(I + J R^2/r^2) psi'' - J R (R - r)/r^2 phi'' = M - b psi'\n"
        "(m + J/r^2) (R - r)^2 phi'' - J R (R - r)/r^2 psi'' + m g (R - r) sin(phi) = 0"
    )
    energies = ROLLER.format("omega^2")
    assert drum().check(f"r omega = R psi' - (R - r) phi'\n{energies}\n{rows}").right
    wrong = drum().check(f"r omega = R psi' - (R - r) phi'\n{energies.replace('I psi', '2 I psi')}\n{rows}")
    assert [f.line.number for f in wrong.findings if not f.status.right] == [2]


def test_a_body_that_turns_with_one_rate_alone_is_quoted_without_a_sign() -> None:
    told = said(drum(), ROLLER.format("((R - r) phi'/r)^2"))[0]
    assert told == "Rigid body 'roll' turns with (R - r)*phi'/r alone."


@pytest.mark.slow
@pytest.mark.parametrize(
    "wrong",
    ["m2*(a^2*u'^2 + b^2*w'^2 + 2*a*b*u'*w'*cos(w))", "m2*((a*u' + b*w'*cos(w))^2 + (b*w'*sin(w))^2)"],
)
def test_a_particle_does_not_turn_but_one_rate_stands_for_the_sum_in_its_velocity(wrong: str) -> None:
    """Two rods without mass, w counted from the first: m₂ has (a u̇)² + b² (u̇ + ẇ)² + 2 a b u̇ (u̇ + ẇ) cos w."""
    s = lg.System("two rods")
    u, w, a, b = s.coordinate("u"), s.coordinate("w"), s.parameter("a"), s.parameter("b")
    knee = s.origin + (a * sp.sin(u), -a * sp.cos(u))
    s.particle(s.parameter("m1"), at=knee, name="m1")
    s.particle(s.parameter("m2"), at=knee + (b * sp.sin(u + w), -b * sp.cos(u + w)), name="m2")
    s.gravity((0, -1))
    right = "m2*(a^2*u'^2 + b^2*(u' + w')^2 + 2*a*b*u'*(u' + w')*cos(w))"
    assert s.derive().check(f"T = m1*a^2*u'^2/2 + {right}/2").findings[0].status.right
    told = said(s.derive(), f"T = m1*a^2*u'^2/2 + {wrong}/2")
    assert told[0] == "In the velocity of particle 'm2', w' alone stands in place of the sum of the rates."


def test_a_missing_term_with_a_moment_of_inertia_belongs_to_a_rotation() -> None:
    energies = ROLLER.format("(R psi' - (R - r) phi')^2/r^2")
    verdict = drum().check(
        f"{energies}\n(I + J R^2/r^2) psi'' - J R (R - r)/r^2 phi'' = M - b psi'\n"
        "m (R - r)^2 phi'' - J R (R - r)/r^2 psi'' + m g (R - r) sin(phi) = 0"
    )
    assert not verdict.right
    told, why = str(verdict.mistakes[0].what), str(verdict.mistakes[0].why)
    assert told.endswith("of the equation of phi is missing. It belongs to the rotation of rigid body 'roll'.")
    assert "fixed point" not in why


@pytest.mark.parametrize("constant", ["const", "const."])
def test_a_constant_that_is_called_so_changes_no_energy(constant: str) -> None:
    assert column().check(f"{T}\n{V} + {constant}").right
    wrong = column().check(f"{T.replace('- h', '+ h')} + {constant}\n{V}")
    assert [f.status.right for f in wrong.findings] == [False, True]
    with pytest.raises(ParseError):
        column().check(f"{T}\n{V.replace('M*g*a', 'const*M*g*a')}")


@pytest.mark.parametrize(
    ("term", "told", "why"),
    [
        ("- u e Omega sin(Omega t)", "the factor Omega is missing", "inner derivative Omega"),
        ("+ u e Omega^2 sin(Omega t)", "has the wrong sign", "minus the sine"),
    ],
)
def test_a_slip_is_told_in_the_derivative_in_which_it_was_made(term: str, told: str, why: str) -> None:
    sheet = (
        "T = m y'^2/2 + u (y' + e Omega cos(Omega t))^2/2\nV = k y^2/2\n"
        "dT/dy' = (m + u) y' + u e Omega cos(Omega t)\nd/dt(dT/dy') = (m + u) y'' {0}\n(m + u) y'' {0} + k y = 0"
    )
    assert unbalance().check(sheet.format("- u e Omega^2 sin(Omega t)")).right
    verdict = unbalance().check(sheet.format(term))
    [mistake] = verdict.mistakes
    assert str(mistake.what).startswith("In d/dt(∂T*/∂y')") and told in str(mistake.what)
    assert why in str(mistake.why)


def test_an_own_lagrangian_is_no_reason_where_nobody_wrote_one() -> None:
    rows = "(m + u) y'' - u e Omega^2 sin(Omega t) {} k y = 0"
    assert unbalance().check(rows.format("+")).right
    told = said(unbalance(), rows.format("-"))[0]
    assert "has the wrong sign" in told and "T* + V" not in told
    lagrangian = "L = m y'^2/2 + u (y' + e Omega cos(Omega t))^2/2 + k y^2/2"
    assert "T* + V" in said(unbalance(), lagrangian)[0] or "wrong sign" in said(unbalance(), lagrangian)[0]


@pytest.mark.slow
def test_balances_are_judged_as_they_stand_beside_what_was_solved_from_them() -> None:
    sheet = (
        "m (R - r) phi'' = f - m g sin(phi)\n"
        "J omega' = r f,  r omega = R psi' - (R - r) phi'\n"
        "I psi'' = M - b psi' {sign} R f\n"
        "m (R - r) phi'' = J/r^2 (R psi'' - (R - r) phi'') - m g sin(phi)\n"
        "I psi'' = M - b psi' {sign} R J/r^2 (R psi'' - (R - r) phi'')"
    )
    assert drum().check(sheet.format(sign="-")).right
    told = said(drum(), sheet.format(sign="+"))
    assert told == ["In line 3, on the right-hand side, R*f has the wrong sign."]
