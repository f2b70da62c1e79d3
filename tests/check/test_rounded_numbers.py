"""Right answers in numbers that are rounded, and the same with one digit more or less."""

from __future__ import annotations

from functools import cache

import mpmath
import pytest
import sympy as sp

from lagrangian import loads
from lagrangian.check.reference import truth_of
from lagrangian.derivation import Derivation
from lagrangian.derive.sampling import CompiledExpressions

SLOPE = """
name = "crate on a slope"
[coordinates]
x = "rack, up the slope"
y = "crate, up the slope"
[parameters]
m1 = "25 kg"
m2 = "140 kg"
k = "50000 N/m"
alpha = "12 deg"
g = "9.81 m/s^2"
[inputs]
F = "N, on the rack"
[[kinetic]]
value = "m1*x'^2/2 + m2*y'^2/2"
[[potential]]
value = "(m1*x + m2*y)*g*sin(alpha)"
[[spring]]
k = "k"
deflection = "x - y"
[[force]]
value = "F"
deflection = "x"
"""
STRUT = """
name = "rack and collar with a strut"
[coordinates]
x = { description = "rack, from the corner", unit = "m", positive = true }
s = { description = "collar, up a guide", unit = "m", positive = true }
[parameters]
m1 = "3 kg"
m2 = "2 kg"
l = "0.83 m"
beta = "25 deg"
d = "4 N*s/m"
g = "9.81 m/s^2"
[inputs]
F = "N, on the rack"
[[frame]]
name = "guide"
angle = "beta"
[points]
A = ["x", "0"]
B = { frame = "guide", offset = ["s", "0"] }
[[particle]]
mass = "m1"
at = "A"
[[particle]]
mass = "m2"
at = "B"
[[gravity]]
direction = [0, -1]
[[damper]]
b = "d"
deflection = "s"
[[force]]
value = ["F", "0"]
at = "A"
[[constraint]]
name = "strut"
between = ["A", "B"]
distance = "l"
"""
HELD = """x^2 + s^2 - 1.8126 x s = 0.6889
3 x'' = F + lambda (2 x - 1.8126 s)
2 s'' + 4 s' + 8.292 = lambda (2 s - 1.8126 x)"""
ROWS = "25 x'' + 50000 x - 50000 y = F - 50.990\n140 y'' - 50000 x + 50000 y = -285.546"
STATED = "m1 g sin(alpha) = 50.990, m2 g sin(alpha) = 285.546\n"


@cache
def slope() -> Derivation:
    """A rack that pushes a crate up a slope of 12°, whose sine is a root of roots."""
    return loads(SLOPE).derive()


@cache
def strut() -> Derivation:
    """A rack and a collar on a guide that a strut joins."""
    return loads(STRUT).derive()


@pytest.mark.sampled(2)
@pytest.mark.parametrize("head", ["", STATED])
def test_a_rounded_number_may_stand_for_a_root_of_roots(head: str) -> None:
    assert slope().check(head + ROWS, hint=0).right


@pytest.mark.sampled(10)
@pytest.mark.parametrize("other", ["50.987", "50.993", "50.890", "51.990", "60.990"])
@pytest.mark.parametrize("head", ["", STATED])
def test_another_digit_is_wrong(head: str, other: str) -> None:
    assert not slope().check(head + ROWS.replace("50.990", other), hint=0).right
    assert not slope().check(head + ROWS.replace("285.546", "285.549"), hint=0).right


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("right", "near"), [("50.990", "50.989"), ("50.990", "50.992"), ("285.546", "285.547")])
@pytest.mark.parametrize("head", ["", STATED])
def test_the_last_of_many_digits_may_be_off_and_is_told(head: str, right: str, near: str) -> None:
    """It is so where numbers were made from rounded numbers."""
    verdict = slope().check((head + ROWS).replace(right, near))
    assert verdict.right
    notes = " ".join(map(str, verdict.notes))
    assert f"{near} was read as {right}: its last digit is off" in notes
    assert not head or f", not {near}. Only the last digit is off" in notes


def test_the_last_of_few_digits_is_not_off() -> None:
    assert not slope().check(ROWS.replace("50.990", "50.98"), hint=0).right


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("right", "less"), [("8.292", "8.29"), ("0.6889", "0.689"), ("1.8126 ", "1.812616 ")])
def test_numbers_may_be_rounded_beside_multipliers(right: str, less: str) -> None:
    assert strut().check(HELD, hint=0).right
    assert strut().check(HELD.replace(right, less), hint=0).right


@pytest.mark.sampled(9)
@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("8.292", "8.291"),
        ("8.292", "8.293"),
        ("8.292", "8.28"),
        ("8.292", "8.192"),
        ("8.292", "7.292"),
        ("+ 8.292", "- 8.292"),
        ("0.6889", "0.6888"),
        ("1.8126 ", "1.8125 "),
        ("1.8126 ", "1.8127 "),
    ],
)
def test_another_digit_is_wrong_beside_multipliers(right: str, wrong: str) -> None:
    assert not strut().check(HELD.replace(right, wrong), hint=0).right


def test_roots_and_sines_of_whole_numbers_have_fifty_digits() -> None:
    exprs = [sp.sqrt(15) - sp.sqrt(3), sp.sqrt(sp.sqrt(5) + 1), sp.sin(2) / 3, sp.Integer(2) ** sp.Rational(1, 3)]
    states = truth_of(slope()).states
    for expr, found in zip(exprs, CompiledExpressions(exprs).exactly(states, 0), strict=True):
        with mpmath.workdps(50):
            assert abs(found - mpmath.mpf(str(sp.N(expr, 60)))) < mpmath.mpf(10) ** -45


def test_a_calculation_with_numbers_is_no_equation_of_motion() -> None:
    said = "mass of the crate: 25/3 + 140*0.95 = {}\n"
    rows = "25*x'' + 50000*(x - y) + 50.9903 = F\n140*y'' - 50000*(x - y) + 285.5459 = 0"
    derivation = slope()
    assert derivation.check(rows).right
    assert derivation.check(said.format("141.3333") + rows).right
    assert not derivation.check(said.format("151.3333") + rows).right


GATE = """
name = "gate with a strut"
[coordinates]
theta = "opening angle, from hanging down"
[parameters]
J = "5.2 kg*m^2"
a = "0.25 m"
b = "0.55 m"
L0 = "1.1 m"
k = "900 N/m"
c = "250 N*s/m"
[inputs]
M = "N*m"
[points]
A = ["a*sin(theta)", "-a*cos(theta)"]
B = ["0", "-b"]
[[kinetic]]
value = "J*theta'^2/2"
[[spring]]
k = "k"
between = ["A", "B"]
rest = "L0"
[[damper]]
b = "c"
between = ["A", "B"]
[[torque]]
value = "M"
on = "theta"
"""
OPENS = "5.2 theta'' + 123.75 (1 - 1.1/l) sin(theta) + 4.7266 sin(theta)^2/l^2 theta' = M"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "length",
    ["l^2 = 0.365 - 0.275 cos(theta)", "l = sqrt(0.365 - 0.275 cos(theta))", "l² = a² + b² - 2 a b cos(theta)"],
)
def test_numbers_are_rounded_beside_a_root_in_another_form(length: str) -> None:
    """The system has √((a sin θ)² + (b − a cos θ)²), and c (a b)² = 4.7265625."""
    gate = loads(GATE).derive()
    assert gate.check(f"{length}\n{OPENS}").right
    assert gate.check(f"{OPENS}\nwith {length}").right
    for slip in (("4.7266", "4.7276"), ("1.1/l", "1.2/l"), ("123.75 (1", "123.75 (2"), ("+ 4.7266", "- 4.7266")):
        assert not gate.check(f"{length}\n{OPENS.replace(*slip)}").right
    assert not gate.check(f"{length.replace('-', '+')}\n{OPENS}").right
