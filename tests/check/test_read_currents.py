"""The current of a charge is read without a word: i is q̇, in right answers, in wrong ones and as a state.

Oracle: by hand, a motor that turns a wheel against a damper:

    L q̈ + R q̇ + K φ̇ = u,   J φ̈ + b φ̇ = K q̇
"""

from functools import cache

import pytest

from lagrangian import Derivation, System

COIL, WHEEL = "L i' + R i + K phi' = u", "J phi'' + b phi' = K i"


@cache
def motor() -> Derivation:
    """A motor with an inductor, whose wheel a damper brakes."""
    sys = System("motor")
    q = sys.coordinate("q", "charge through the motor")
    phi = sys.coordinate("phi", "wheel; its rate is the speed w")
    L, R, K, J, b = sys.parameters("L R K J b", L=0.002, R=1.5, K=0.05, J=0.002, b=0.01)
    sys.kinetic(J * phi.diff() ** 2 / 2)
    sys.damper(b, deflection=phi)
    sys.inductor(L, charge=q)
    sys.resistor(R, charge=q)
    sys.transducer(K, charge=q, on=phi)
    sys.voltage_source(sys.input("u"), charge=q)
    return sys.derive()


@pytest.mark.parametrize(
    "written",
    [
        f"{COIL}\n{WHEEL}",
        "L*idot + R*i + K*phidot = u\nJ*phiddot + b*phidot = K*i\n[i is the current, idot its derivative]",
        "x1 = phi, x2 = phi', x3 = i\nx1' = x2\nx2' = (K x3 - b x2)/J\nx3' = (u - R x3 - K x2)/L",
        "L q'' + R q' + K phi' = u\nJ phi'' + b phi' = K i\ni = q'",
        "i' = (u - R*i - K*w)/L\nphi' = w\nw' = (K*i - b*w)/J",
        "q' = i\nL i' + R i + K w = u\nJ w' + b w = K i",
        "U = u  [V]\nU - R i - L di/dt = K phi'\nJ phi'' + b phi' = K i",
        "L i_a' + R i_a + K phi' = u\nJ phi'' + b phi' = K i_a",
        r"$$L\dot{i} + R i + K\dot\varphi = u$$ $$J\ddot\varphi + b\dot\varphi = K i$$",
    ],
)
def test_the_letter_of_a_current_is_the_rate_of_the_charge(written: str) -> None:
    assert motor().check(written, hint=0).right


def test_a_mistake_beside_a_current_is_named_alone() -> None:
    verdict = motor().check(f"{COIL.replace('+ K', '- K')}\n{WHEEL.replace('+ b', '- b')}")
    assert [f.status.right for f in verdict.findings] == [False, False]
    assert len(verdict.mistakes) == 2
    assert "'i' was read as q'." in verdict.to_text()
    assert [f.status.right for f in motor().check(f"{COIL.replace('+ K', '- K')}\n{WHEEL}").findings] == [False, True]
    w = "J w' - b w = K i\nL i' + R i + K w = u"
    assert [f.status.right for f in motor().check(w).findings] == [False, True]


def test_a_letter_of_a_speed_is_read_beside_a_mistake() -> None:
    verdict = motor().check("J v' - b v = K i\nL i' + R i + K v = u")
    assert [f.status.right for f in verdict.findings] == [False, True]
    assert "b φ̇ has the wrong sign" in verdict.to_text().replace("−", "")


def test_a_current_is_one_of_the_coordinates_beside_one_of_the_answer() -> None:
    """psi = 2 phi in place of phi, and q, of which only the current is written: Q_psi is Ξ_phi/2."""
    rows = "L i' + R i + K psi'/2 = u\nJ psi''/4 = K i/2 - b psi'/4"
    assert motor().check(f"psi = 2 phi\nQ_psi = K i/2 - b psi'/4\n{rows}", hint=0).right
    assert not motor().check(f"psi = 2 phi\nQ_psi = K i - b psi'/2\n{rows}", hint=0).right


def test_a_letter_that_the_answer_explains_is_no_current() -> None:
    below = "L q'' + R q' + K phi' = u\nJ phi'' + b phi' = i q'"
    assert motor().check(f"{below}\ni = K", hint=0).right
    assert not motor().check(f"{below}\ni = 2 K", hint=0).right
    assert motor().check("L q'' + i q' + K phi' = u\nJ phi'' + b phi' = K q'", hint=0).right  # i is R
