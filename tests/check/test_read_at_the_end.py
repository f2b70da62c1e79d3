"""Amounts with units, lists of letters, cut forces called Q, and rates that are all zero, around right equations.

Oracle: a hoist with an elastic rope, by hand.
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg


@cache
def hoist() -> lg.Derivation:
    """A drum with a motor that lifts a load on an elastic rope, with the values of the sheet."""
    s = lg.System("hoist")
    phi, y = s.coordinates("phi y")
    values = {"J": "0.8 kg*m^2", "m": "90 kg", "r": "0.15 m", "k": "30 kN/m", "b": "200 N*s/m", "g": "9.81 m/s^2"}
    J, m, r, k, b, g = (s.parameter(name, value=value) for name, value in values.items())
    s.kinetic(J * phi.diff() ** 2 / 2, name="drum")
    s.particle(m, at=s.point("P", (0, y)), name="load")
    s.gravity((0, -1), g)
    s.spring(k, deflection=r * phi - y)
    s.damper(b, deflection=r * phi - y)
    s.force(s.input("tau"), deflection=phi, name="motor")
    return s.derive()


EQUATIONS = """J phi'' + b r (r phi' - y') + k r (r phi - y) = tau
m y'' - b (r phi' - y') - k (r phi - y) + m g = 0
"""


@pytest.mark.parametrize("amount", ["29 mm", "2.9 cm", "0.029 m", "0.0294 m", "0.0294"])
def test_what_a_calculation_amounts_to_may_have_a_unit_of_letters_of_the_system(amount: str) -> None:
    said = f"{EQUATIONS}The rope is then stretched by m g/k = {amount}."
    assert hoist().check(said).right
    assert not hoist().check(said.replace("9 mm", "8 mm").replace("2.9 cm", "2.8 cm").replace("0.029", "0.039")).right


def test_a_number_of_masses_is_no_length() -> None:
    assert not hoist().check(f"{EQUATIONS}m g = 2 m").right


@pytest.mark.parametrize("mark", ["-", "*", "–"])
def test_a_list_of_letters_in_words_has_bullets(mark: str) -> None:
    said = f"{mark} The rate of the drum is `w = phi'`.\n{mark} y is the height of the load, upwards.\n\n"
    equations = EQUATIONS.replace("phi''", "w'").replace("phi'", "w")
    assert hoist().check(f"{said}{equations}").right
    assert not hoist().check(f"{said}{equations.replace('b r', '2 b r')}").right


def test_rates_that_are_all_zero_are_one_motion() -> None:
    verdict = hoist().check(f"{EQUATIONS}Check: with phi'' = phi' = 0 the drum stands.")
    assert verdict.right, verdict.to_text()
    assert not hoist().check(f"{EQUATIONS}phi'' = y''").right


@cache
def press() -> lg.Derivation:
    """A motor that turns a crank through a gear, one freedom."""
    s = lg.System("geared crank")
    phi = s.coordinate("phi")
    J, Jm, n, c = s.parameters("J Jm n c")
    s.kinetic(J * phi.diff() ** 2 / 2, name="crank")
    s.kinetic(Jm * (n * phi.diff()) ** 2 / 2, name="motor")
    s.damper(c, deflection=phi)
    s.force(s.input("tau"), deflection=n * phi, name="torque")
    return s.derive()


@pytest.mark.parametrize(
    ("motor", "is_right"), [("Q = n tau - n^2 Jm phi''", True), ("Q = n tau + n^2 Jm phi''", False)]
)
def test_a_moment_called_q_that_balances_share_is_no_generalized_force(motor: str, is_right: bool) -> None:
    said = f"crank: J phi'' = Q - c phi'\nmotor: {motor}\nso (J + n^2 Jm) phi'' + c phi' = n tau"
    assert press().check(said).right is is_right


def test_the_generalized_force_stays_one() -> None:
    assert press().check("Q = n tau - c phi'\n(J + n^2 Jm) phi'' = Q").right
    assert not press().check("Q = n tau + c phi'\n(J + n^2 Jm) phi'' = Q").right


@cache
def slider() -> lg.Derivation:
    """A mass whose names spell a word: m, a, s."""
    s = lg.System("slider")
    x = s.coordinate("s")
    m, a, M = s.parameters("m a M")
    s.particle(m + M, at=s.point("P", (x, 0)), name="slider")
    s.spring(a, deflection=x)
    return s.derive()


@pytest.mark.parametrize("said", ["(M = mass of the load)", "M = mass of one load, m = mass of the slider"])
def test_a_mass_of_something_is_no_product(said: str) -> None:
    assert slider().check(f"Task 5, result only {said}\n(m + M) s'' + a s = 0").right
    assert not slider().check(f"Task 5, result only {said}\n(m + M) s'' + 2 a s = 0").right
    assert not slider().check("M = m a s s\n(m + M) s'' + a s = 0").right
