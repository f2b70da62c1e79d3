"""The first wrong line is where a mistake was made: a position, a height or a part of an energy."""

from __future__ import annotations

from functools import cache

import pytest
from sympy import cos, sin

from lagrangian import Derivation, System
from lagrangian.check.verb import CheckedAnswer
from lagrangian.model import time


@cache
def crane() -> Derivation:
    """A trolley at r on a turning jib, and a weight on the other side at e + r/2."""
    sys = System("crane")
    psi, r = sys.coordinates("psi r")
    J, m, w, e = sys.parameters("J m m_c e")
    jib = sys.frame(psi)
    sys.rigid_body(1, J, at=sys.point("mast", (0, 0)), frame=jib, name="head")
    sys.particle(m, at=jib.point(r, 0), name="trolley")
    sys.particle(w, at=jib.point(-(e + r / 2), 0), name="weight")
    return sys.derive()


@cache
def dryer() -> Derivation:
    """A drum on feet turns a lump at the speed Ω; a ball runs in a ring."""
    sys = System("dryer")
    x, psi = sys.coordinates("x psi")
    M, m, b, e, R, k, g, Omega = sys.parameters("M m m_b e R k g Omega")
    axis = sys.point("axis", (x, 0))
    sys.particle(M, at=axis, name="drum")
    sys.particle(m, at=axis + (e * cos(Omega * time), e * sin(Omega * time)), name="lump")
    sys.particle(b, at=axis + (R * cos(psi), R * sin(psi)), name="ball")
    sys.gravity((0, -1), g)
    sys.spring(k, deflection=x)
    return sys.derive()


@cache
def wheels() -> Derivation:
    """A wheel that rolls, with a constraint of positions."""
    sys = System("wheel")
    x, phi = sys.coordinates("x phi")
    m, J, R, k = sys.parameters("m J R k")
    sys.rigid_body(m, J, at=sys.point("hub", (x, 0)), frame=sys.frame(-phi), name="wheel")
    sys.spring(k, deflection=x)
    sys.constraint(x - R * phi)
    return sys.derive()


def _told(verdict: CheckedAnswer, line: int) -> str:
    assert not verdict.right
    first = str(verdict.mistakes[0].what)
    assert first.startswith(f"Line {line} is not right"), first
    wrong = [f for f in verdict.findings if not f.status.right]
    assert wrong[0].line.number == line and not wrong[0].follows
    return " ".join(verdict.to_text().split())


def _crane(r_c: str) -> str:
    return f"r_c = {r_c}\nT = 1/2 J psi'^2 + 1/2 m (r'^2 + r^2 psi'^2) + 1/2 m_c (r'^2/4 + ({r_c})^2 psi'^2)"


@pytest.mark.slow
def test_a_wrong_distance_along_a_turning_jib() -> None:
    assert crane().check(_crane("e + r/2"), hint=0).right
    told = _told(crane().check(_crane("e - r/2")), 1)
    assert (
        "the component of the position of particle 'weight' along the x axis turned by ψ is e + ½ r, not e − ½ r"
        in told
    )


V = "V = 1/2 k x^2 + m_b g R {}(psi)"


@pytest.mark.sampled(2)
@pytest.mark.parametrize("more", ["", " + m g e sin(Omega t)"])
def test_a_wrong_height_that_no_other_line_names(more: str) -> None:
    """What depends on time alone may be left out of V, and does not hide the mistake."""
    assert dryer().check("h = R sin(psi)\n" + V.format("sin") + more, hint=0).right
    told = _told(dryer().check("h = R cos(psi)\n" + V.format("cos") + more), 1)
    assert "is R sin ψ, not R cos ψ" in told and "potential energy" in told


def test_a_wrong_position_of_what_is_moved_in_a_prescribed_way() -> None:
    T = (
        "T = 1/2 (M + m + m_b) x'^2 {} m e Omega x' {}(Omega t) + 1/2 m e^2 Omega^2 - m_b R x' psi' sin(psi) "
        "+ 1/2 m_b R^2 psi'^2"
    )
    right = "x_m = x + e cos(Omega t), y_m = e sin(Omega t)\n" + T.format("-", "sin")
    assert dryer().check(right, hint=0).right
    told = _told(dryer().check("x_m = x + e sin(Omega t), y_m = e cos(Omega t)\n" + T.format("+", "cos")), 1)
    assert "the x coordinate of particle 'lump' is x + e cos(Ω t), not x + e sin(Ω t)" in told
    assert "the y coordinate of particle 'lump' is e sin(Ω t), not e cos(Ω t)" in told


def test_a_part_of_an_energy_is_judged_by_its_name() -> None:
    right = "x = R phi\nT_rot = 1/2 J x'^2/R^2\nT = 1/2 m x'^2 + 1/2 J x'^2/R^2\nV = 1/2 k x^2\n"
    right += "(m + J/R^2) x'' + k x = 0"
    assert wheels().check(right, hint=0).right
    told = _told(wheels().check(right.replace("/R^2", "")), 2)
    assert "the kinetic energy of the rotation of rigid body 'wheel' is J ẋ²/(2 R²), not ½ J ẋ²" in told


def test_an_energy_without_its_translation_is_no_energy_of_the_rotation() -> None:
    """T_wheel is that of the whole wheel."""
    wrong = "x = R phi\nT_wheel = 1/2 J x'^2/R^2\nT = 1/2 J x'^2/R^2\nV = 1/2 k x^2"
    told = _told(wheels().check(wrong), 2)
    assert "the kinetic energy of rigid body 'wheel' is" in told


def test_two_terms_that_are_missing_are_no_term_in_place_of_another() -> None:
    """Nobody wrote −m_c e ψ̇ ṙ where m_c (e + r/2) ψ̇ ṙ is missing."""
    T = "T = 1/2 J psi'^2 + 1/2 m (r'^2 + r^2 psi'^2) + 1/2 m_c (r'^2/4 + (e + r/2)^2 psi'^2)"
    rate = "(J + m r^2 + m_c (e + r/2)^2) psi'' + 2 m r r' psi'"
    assert crane().check(f"{T}\nd/dt dL/dpsi' = {rate} + m_c (e + r/2) r' psi'", hint=0).right
    verdict = crane().check(f"{T}\nd/dt dL/dpsi' = {rate}")
    told = " ".join(verdict.to_text().split())
    assert not verdict.right and "the term m_c (e + ½ r) ψ̇ ṙ is missing" in told and "stands where" not in told


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ("1/2 m_c (r'^2 + (e + r/2)^2 psi'^2)", "the term ½ m_c ṙ² should be ⅛ m_c ṙ²."),
        ("1/2 m_c (r'^2/4 + (e^2 + r^2/4) psi'^2)", "the term ½ m_c e r ψ̇² is missing."),
        ("1/2 m_c (r'^2/4 + (e + r/2)^2 psi'^2 + r' psi')", "the term ½ m_c ψ̇ ṙ does not belong there."),
    ],
)
def test_two_formulas_in_different_arrangements_are_told_by_the_term_that_differs(written: str, told: str) -> None:
    T = "1/2 J psi'^2 + 1/2 m (r'^2 + r^2 psi'^2)"
    assert crane().check(f"T_w = 1/2 m_c (r'^2/4 + (e + r/2)^2 psi'^2)\nT = {T} + T_w", hint=0).right
    assert told in _told(crane().check(f"T_w = {written}\nT = {T} + T_w"), 1)


def test_so_is_the_factor_of_an_acceleration() -> None:
    total = "J + m r^2 + m_c (e^2 + r^2/4)"
    told = _told(crane().check(f"J_t = {total}\nT = 1/2 J_t psi'^2 + 1/2 (m + m_c/4) r'^2"), 1)
    assert "the factor of ψ̈" in told and "the term m_c e r is missing." in told


@cache
def trough() -> Derivation:
    """A trough that a crank drives by a spring; its guide damps it, and a damper joins it to a block."""
    sys = System("trough")
    x, y = sys.coordinates("x y")
    m, k, c, d, e, Omega = sys.parameters("m k c d e Omega")
    sys.particle(m, at=sys.point("trough", (x, 0)), name="trough")
    sys.particle(m, at=sys.point("block", (y, 0)), name="block")
    sys.spring(k, deflection=x, rest=e * sin(Omega * time), name="drive")
    sys.damper(c, deflection=x, name="guide")
    sys.damper(d, deflection=x - y, name="link")
    return sys.derive()


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("D", "told", "hint"),
    [
        (
            "1/2 c (x' - e Omega cos(Omega t))^2 + 1/2 d (x' - y')^2",
            "is taken as ẋ − e Ω cos(Ω t); it is ẋ.",
            "relative",
        ),
        ("c x'^2 + 1/2 d (x' - y')^2", "The ½ of damper 'guide' in D is missing.", "½ b (rate)²"),
        ("1/2 c x'^2 + 1/4 d (x' - y')^2", "Half of what damper 'link' adds to D is missing", "½ b (rate)²"),
        ("1/2 c x'^2 + 1/2 d x'^2", "damper 'link'", "damper"),
    ],
)
def test_what_is_wrong_in_the_function_of_the_dampers(D: str, told: str, hint: str) -> None:
    energies = "T = 1/2 m x'^2 + 1/2 m y'^2\nV = 1/2 k (x - e sin(Omega t))^2\nD = "
    assert trough().check(energies + "1/2 c x'^2 + 1/2 d (x' - y')^2", hint=0).right
    verdict = trough().check(energies + D)
    text = " ".join(verdict.to_text().split())
    assert not verdict.right and told in text and "twice." not in text.replace("counts twice.", "")
    assert hint in str(verdict.mistakes[0].why)


def test_hints_speak_of_no_derivative_of_an_energy_that_nobody_stated() -> None:
    row = "m x'' = -k (x - e sin(Omega t)) - c x' - d (x' - y'), m y'' = "
    assert trough().check(row + "d (x' - y')", hint=0).right
    verdict = trough().check(row + "d (x' - y') + m y'^2")
    assert not verdict.right and verdict.mistakes
    assert not any("∂" in str(x) for m in verdict.mistakes for x in (m.what, m.why))


@pytest.mark.slow
def test_one_mistake_is_not_told_as_a_quantity_said_wrongly_twice() -> None:
    s = System("ladder")
    psi, theta = s.coordinates("psi theta")
    J, m, n, a, b, e, d = s.parameters("J m n a b e d")
    inner, outer = e + a * cos(theta), e + b * cos(theta)
    s.kinetic(J * psi.diff() ** 2 / 2 + (m * inner**2 + n * outer**2) * psi.diff() ** 2 / 2)
    s.kinetic((m * a**2 + n * b**2) * theta.diff() ** 2 / 2)
    s.damper(d, deflection=psi, name="bearing")
    s.torque(s.input("tau"), on=psi)
    T = "T = J psi'^2/2 + m (a^2 theta'^2 + (e + a cos(theta))^2 psi'^2)/2"
    T += " + n (b^2 theta'^2 + (e + b cos(theta))^2 psi'^2)/2"
    answer = f"rho_1 = e + a cos(theta)\nrho_2 = e + b cos(theta)\n{T}\nQ_psi = tau - d psi'\nQ_theta = 0"
    derived = s.derive()
    assert derived.check(answer, hint=0).right
    verdict = derived.check(answer.replace("- d psi'", "+ d psi'"))
    assert "bearing" in str(verdict.mistakes[0].what) and "sign" in str(verdict.mistakes[0].what)
    assert all("rho" not in f.line.text for f in verdict.findings if not f.status.right)


def test_a_coordinate_in_place_of_another_is_not_it_where_the_answer_relates_them() -> None:
    s = System("roller")
    x = s.coordinates("x")
    m, J, r, g, alpha = s.parameters("m J r g alpha")
    s.kinetic((m + J / r**2) * x.diff() ** 2 / 2)
    s.potential(-m * g * x * sin(alpha))
    answer = "I took the angle phi instead of x. Since it rolls, x = r*phi.\n\n"
    answer += "T = (J + m*r^2)*phi'^2/2\nV = -m*g*r*phi*sin(alpha)\n"
    derived = s.derive()
    assert derived.check(answer, hint=0).right
    verdict = derived.check(answer.replace("sin(alpha)", "cos(alpha)"))
    wrong = [f.line.text for f in verdict.findings if not f.status.right]
    assert len(wrong) == 1
    assert wrong[0].startswith("V")


def test_a_moment_of_inertia_about_the_centre_beside_a_fixed_hinge_lacks_the_translation() -> None:
    """J = m l²/12 is right about the centre: what is missing is ½mv², and nothing was left out of a velocity."""
    s = System("hung rod")
    theta = s.coordinates("theta")
    m, el = s.parameters("m l")
    place = s.point("C", (el * sin(theta) / 2, -el * cos(theta) / 2))
    s.rigid_body(m, inertia=m * el**2 / 12, at=place, frame=s.frame(theta), name="rod")
    s.gravity()
    d = s.derive()
    answer = "J = m l^2/12\nT = 1/2 J theta'^2\nV = -m g l/2 cos(theta)\nJ theta'' + m g l/2 sin(theta) = 0"
    verdict = d.check(answer)
    assert str(verdict.mistakes[0].what) == "½mv² of rigid body 'rod' is missing."
    assert d.check(answer.replace("l^2/12", "l^2/3")).right
