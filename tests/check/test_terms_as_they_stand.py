"""Terms are told as they stand in an answer: in its sums, its signs and its sense, and by no sum that nobody wrote.

Oracle: a crane drum on a ramp, a roller that an arm carries around a sun gear, and a beam with a hanging bob, by hand;
answers with one mistake.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

import lagrangian as lg


@cache
def ramp() -> lg.Derivation:
    """A hoop that rolls down a ramp, with a bead off its centre; the place of the centre is counted from the ramp."""
    s = lg.System("ramp")
    q = s.coordinates("q")
    M, I, m, a, h, beta, k, g = s.parameters("M I m a h beta k g")
    centre = s.point("C", (a * q, a))
    bead = s.point("B", (a * q - h * sp.sin(q), a - h * sp.cos(q)))
    s.rigid_body(M, I, at=centre, frame=s.frame(-q, name="hoop"), name="hoop")
    s.particle(m, at=bead, name="bead")
    s.gravity((sp.sin(beta), -sp.cos(beta)), g)
    s.spring(k, deflection=2 * a * q, name="band")
    return s.derive()


@cache
def gear() -> lg.Derivation:
    """An arm that carries a wheel around a fixed sun; grease brakes the wheel."""
    s = lg.System("gear")
    psi = s.coordinates("psi")
    A, m, I, S, p, c = s.parameters("A m I S p c")
    M = s.inputs("M")
    turned = (S + p) / p * psi
    hub = s.point("H", ((S + p) * sp.cos(psi), (S + p) * sp.sin(psi)))
    s.rigid_body(0, A, at=s.origin, frame=s.frame(psi, name="arm"), name="arm")
    s.rigid_body(m, I, at=hub, frame=s.frame(turned, name="wheel"), name="wheel")
    s.damper(c, deflection=turned, name="grease")
    s.torque(M, on=psi, name="motor")
    return s.derive()


@cache
def beam() -> lg.Derivation:
    """A beam on a hinge with a bob on a thread at its end."""
    s = lg.System("beam")
    u, w = s.coordinates("u w")
    I, m, b, d, g = s.parameters("I m b d g")
    s.rigid_body(0, I, at=s.origin, frame=s.frame(u, name="beam"), name="beam")
    s.particle(m, at=s.point("P", (d * sp.sin(w) - b * sp.cos(u), -b * sp.sin(u) - d * sp.cos(w))), name="bob")
    s.gravity((0, -1), g)
    return s.derive()


def said(system: lg.Derivation, answer: str) -> list[str]:
    """What is said of a wrong answer, its best explanation first."""
    verdict = system.check(answer)
    assert not verdict.right
    return [" ".join(str(m.what).split()) for m in verdict.mistakes]


HOOP = "T = (I + M a^2 + m (a^2 + h^2 - 2 a h cos(q))) q'^2/2\n"


def test_the_sign_of_a_weight_is_told_by_its_term() -> None:
    right = HOOP + "V = -(M + m) g a q sin(beta) - m g h cos(q + beta) + 2 k a^2 q^2"
    assert not ramp().check(right).mistakes
    told = said(ramp(), right.replace("-(M", "(M"))
    assert told == ["In line 2 (V), a*g*(M + m)*q*sin(beta) has the wrong sign."]


def test_a_term_that_is_missing_is_no_sum_that_nobody_wrote() -> None:
    told = said(ramp(), "T = (I + M a^2 + m (a^2 + h^2)) q'^2/2")
    assert told[0].endswith("of the kinetic energy of particle 'bead' is missing.") and "place" not in told[0]


def test_an_angular_velocity_is_told_in_the_sense_that_is_nearest() -> None:
    told = said(gear(), "omega_w = S/p psi'\nT = A psi'^2/2 + m (S + p)^2 psi'^2/2 + I (S/p)^2 psi'^2/2")
    assert "angular velocity of rigid body 'wheel' is (S + p)*psi'/p, not S*psi'/p" in told[0] or (
        "is psi' + S*psi'/p, not S*psi'/p" in told[0]
    ), told


def test_of_a_moment_without_its_ratio_the_ratio_is_missing() -> None:
    told = said(gear(), "l = S + p\nQ_psi = M - c l/p psi'")
    assert told == ["In what damper 'grease' adds to the equation of psi, the factor l/p is missing."]
    (difference,) = gear().check("l = S + p\nQ_psi = M - c l/p psi'").findings[-1].differences
    assert str(difference.term).count("S") == 0


def test_functions_in_place_of_each_other_have_no_sign_of_ours() -> None:
    told = said(beam(), "T = (I + m b^2) u'^2/2 + m d^2 w'^2/2 + m b d cos(u - w) u' w'")
    assert told[0].endswith(", cos(u - w) stands in place of sin(u - w).")


def test_a_difference_of_shortened_names_keeps_their_order() -> None:
    s = lg.System("beam")
    th, ph = s.coordinates("theta phi")
    m, b, d = s.parameters("m b d")
    s.particle(m, at=s.point("P", (d * sp.sin(ph) - b * sp.cos(th), -b * sp.sin(th) - d * sp.cos(ph))), name="bob")
    verdict = s.derive().check("T = m b^2 thd^2/2 + m d^2 phd^2/2 + m b d sin(th - ph) thd phd/2")
    words = " ".join(verdict.to_text().split())
    assert "The term m b d θ̇ φ̇ sin(θ − φ) of" in words and "sin(φ − θ)" not in words, words


def test_a_rate_in_an_energy_is_told_without_a_sign_that_both_have() -> None:
    s = lg.System("disc")
    u, w = s.coordinates("u w")
    m, I, b = s.parameters("m I b")
    hub = s.point("H", (b * sp.cos(u), b * sp.sin(u)))
    s.rigid_body(m, I, at=hub, frame=s.frame(-w, name="disc"), name="disc")
    told = said(s.derive(), "T = m b^2 u'^2/2 + I (u' + w')^2/2")
    assert "is w', not u' + w'" in told[0], told


def test_no_second_choice_is_made_in_a_place_that_a_line_states_rightly() -> None:
    lines = """x_B = a q - h sin(q)
y_B = a - h cos(q)
T = (I + M a^2 + m (a^2 + h^2 - 2 a h cos(q))) q'^2/2
V = -M g a q sin(beta) + m g (a q sin(beta) - h cos(q + beta)) + 2 k a^2 q^2"""
    verdict = ramp().check(lines)
    every = [str(m.what) for m in verdict.alternatives]
    assert not verdict.right and not any("height of particle 'bead'" in x for x in every), every


def test_two_ends_of_a_damper_have_no_voltage() -> None:
    s = lg.System("carts")
    x, y = s.coordinates("x y")
    m, M, c = s.parameters("m M c")
    s.particle(m, at=s.point("A", (x, 0)), name="first")
    s.particle(M, at=s.point("B", (y, 0)), name="second")
    s.damper(c, deflection=x - y, name="buffer")
    verdict = s.derive().check("Q_x = -c (x' - y')\nQ_y = -c (x' - y')")
    assert "ppos" in str(verdict.mistakes[0].why) and "voltage" not in verdict.to_text()


def test_what_stands_in_the_equation_is_not_said_to_stand_in_a_dissipation_function() -> None:
    lines = "Q_psi = M\n(A + m (S + p)^2 + I (S + p)^2/p^2) psi'' + c (S + p)^2/p^2 psi' = M"
    verdict = gear().check(lines)
    assert verdict.right and str(verdict.findings[0].note) == "without the dampers, which stand in the equation"


def test_a_wrong_acceleration_in_balances_belongs_to_no_energy() -> None:
    lines = "a_Cx = a q''\na_Bx = (a - h cos(q)) q'' - h sin(q) q'^2\na_By = h sin(q) q'' + h cos(q) q'^2"
    row = """
I q'' + M a a_Cx + m (a - h cos(q)) a_Bx + m h sin(q) a_By = (M + m) g a sin(beta) - m g h sin(q + beta) - 4 k a^2 q"""
    assert ramp().check((lines + row).replace("- h sin(q) q'^2", "+ h sin(q) q'^2")).right
    words = ramp().check(lines + row).to_text()
    assert "It concerns the bead." in words and "co-energy" not in words, words


def test_a_term_of_an_equation_comes_from_its_element_without_another_step() -> None:
    row = "(I + M a^2 + m (a^2 + h^2 - 2 a h cos(q))) q'' {} m a h sin(q) q'^2 - (M + m) g a sin(beta)"
    row += " + m g h sin(q + beta) + 4 k a^2 q = 0"
    assert ramp().check(row.format("+")).right
    verdict = ramp().check(row.format("-"))
    words = verdict.to_text()
    assert "belongs to step 5" in words and "It comes from the bead." in words, words
    first = str(verdict.mistakes[0].what)
    assert not any(first.startswith(str(m.what)) for m in verdict.alternatives)
