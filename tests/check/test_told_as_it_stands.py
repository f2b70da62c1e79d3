"""What is exchanged, counted too often or missing is told as the answer has it.

Oracle: a wheel on a hub, a door on a hub and a cart on wheels, by hand; answers with one mistake.
"""

import pytest
import sympy as sp
from test_true_explanations import told

import lagrangian as lg


@pytest.fixture(scope="module")
def wheel_on_hub() -> lg.Derivation:
    """A wheel that a motor turns against a hub, which two jets push; a door that swings from its rim."""
    s = lg.System("hub")
    p, w, b = s.coordinates("p w b")
    J, K, R, l, d, m, A = s.parameters("J K R l d m A")
    P, tau = s.input("P"), s.input("tau")
    s.kinetic(J * p.diff() ** 2 / 2 + K * (p.diff() + w.diff()) ** 2 / 2)
    s.kinetic(m * ((R + l * sp.cos(b)) ** 2 * p.diff() ** 2 + l**2 * b.diff() ** 2) / 2 + A * b.diff() ** 2 / 2)
    s.torque(tau, on=w, name="motor")
    s.damper(d, deflection=w, name="bearing")
    s.generalized_force(p, 2 * P * R)
    return s.derive()


HUB = """T = J/2 p'^2 + {wheel} + m/2 ((R + l cos b)^2 p'^2 + l^2 b'^2) + A/2 b'^2
Q_p = {hub}
Q_w = {motor}"""
RIGHT_HUB = {"wheel": "K/2 (p' + w')^2", "hub": "2 P R", "motor": "tau - d w'"}


def test_a_rate_in_a_given_energy_is_told_as_it_was_written(wheel_on_hub: lg.Derivation) -> None:
    assert wheel_on_hub.check(HUB.format(**RIGHT_HUB), hint=0).right
    words = told(wheel_on_hub, HUB.format(**RIGHT_HUB | {"wheel": "K/2 w'^2"}))
    assert words == "In T*, w' stands in place of p' + w'.", words
    words = told(wheel_on_hub, HUB.format(**RIGHT_HUB | {"wheel": "K/2 (2 p' + w')^2"}))
    assert words == "In T*, 2*p' + w' stands in place of p' + w'.", words


def test_what_is_in_the_right_force_as_well_is_not_in_another_in_its_place(wheel_on_hub: lg.Derivation) -> None:
    words = told(wheel_on_hub, HUB.format(**RIGHT_HUB | {"hub": "2 P R - tau + d w'"}))
    assert "in place of" not in words and words.count("is counted in Q_p as well") == 2, words
    words = told(wheel_on_hub, HUB.format(**RIGHT_HUB | {"hub": "2 P R + tau", "motor": "-d w'"}))
    assert words == "Torque 'motor' is counted in Q_p in place of Q_w.", words


def test_a_wrong_arm_is_no_second_share_of_a_force(wheel_on_hub: lg.Derivation) -> None:
    words = told(wheel_on_hub, HUB.format(**RIGHT_HUB | {"hub": "2 P (R + l)"}))
    assert "twice" not in words and "the factor is R + l; it should be R" in words, words
    words = told(wheel_on_hub, HUB.format(**RIGHT_HUB | {"hub": "4 P R"}))
    assert "stands with twice its value: 4*R*P should be 2*R*P" in words, words
    words = told(wheel_on_hub, HUB.format(**RIGHT_HUB | {"hub": "2 P R + 2 P R"}))
    assert "is counted twice" in words, words
    verdict = wheel_on_hub.check(HUB.format(**RIGHT_HUB | {"hub": "P R"}))
    assert not any("factor" in str(m.what) for m in verdict.alternatives), verdict.to_text()


@pytest.fixture(scope="module")
def door() -> lg.Derivation:
    """A hub with a door on a hinge across its axis."""
    s = lg.System("door")
    p, b = s.coordinates("p b")
    J, m, R, l, A = s.parameters("J m R l A")
    rho = R + l * sp.cos(b)
    place = s.point("C", (rho * sp.cos(p), rho * sp.sin(p), l * sp.sin(b)))
    hub = s.frame(p, name="hub", axis=(0, 0, 1))
    leaf = s.frame(-b, name="leaf", axis=(0, 1, 0), parent=hub)
    s.kinetic(J * p.diff() ** 2 / 2)
    s.rigid_body(m, inertia=(A, A, A), at=place, frame=leaf, name="leaf")
    return s.derive()


DOOR = "T = J/2 p'^2 + m/2 ({}l^2 b'^2) + {} + A/2 b'^2"
MOVES, TURNS = "(R + l cos b)^2 p'^2 + ", "A/2 p'^2"


def test_of_the_motion_of_a_centre_only_what_is_missing_is_said_to_be(door: lg.Derivation) -> None:
    assert door.check(DOOR.format(MOVES, TURNS), hint=0).right
    words = told(door, DOOR.format("", TURNS))
    assert "½mv²" not in words and "what the swing of that centre with p' adds to J is missing" in words, words


def test_of_a_rotation_with_several_rates_one_is_missing(door: lg.Derivation) -> None:
    words = told(door, DOOR.format(MOVES, "0"))
    assert words == "What the rotation of rigid body 'leaf' with p' adds to T* is missing.", words


def test_a_sine_for_a_cosine_in_a_sum_is_told_with_the_sum(door: lg.Derivation) -> None:
    words = told(door, DOOR.format(MOVES.replace("cos", "sin"), TURNS))
    assert words == "In T*, R + l*sin(b) stands in place of R + l*cos(b).", words
    words = told(door, DOOR.format(MOVES.replace("cos b", "sin(2 b)"), TURNS))
    assert "l*sin(b) stands" not in words, words


@pytest.mark.slow
def test_a_divisor_that_stands_once_for_twice_is_missing_and_no_factor_too_much() -> None:
    s = lg.System("cart")
    x = s.coordinates("x")
    M, J, R, k = s.parameters("M J R k")
    s.kinetic(M * x.diff() ** 2 / 2)
    s.kinetic(J * (x.diff() / R) ** 2 / 2, name="wheels")
    s.spring(k=k, deflection=x)
    cart = s.derive()
    energy = "T = M/2 x'^2 + J/2 {}\nV = k/2 x^2"
    assert cart.check(energy.format("x'^2/R^2"), hint=0).right
    words = told(cart, energy.format("x'^2/R"))
    assert "one divisor R is missing" in words, words
    words = told(cart, energy.format("x'^2 R/R^2 R^2"))
    assert "one divisor R is missing" not in words, words
