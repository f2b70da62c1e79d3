"""Rounded numbers are right where they stand, however the sum is written, also beside a term that is wrong."""

from __future__ import annotations

from functools import cache

import pytest

from lagrangian import loads
from lagrangian.derivation import Derivation

LADDER = """
name = "ladder between wall and floor"
[coordinates]
psi = { description = "angle above the floor", unit = "rad" }
[parameters]
m = { value = "7 kg", description = "ladder" }
M = { value = "2.3 kg", description = "bucket on the ladder" }
l = { value = "1.3 m", description = "length" }
mw = { value = "0.8 kg", description = "slider on the wall" }
k = { value = "410 N/m", description = "spring at the foot" }
x0 = { value = "0.45 m", description = "free length" }
c = { value = "6 N*s/m", description = "damper at the foot" }
[inputs]
F = "N, on the foot, inwards"
[points]
G = ["l/2*cos(psi)", "l/2*sin(psi)"]
E = ["l/3*cos(psi)", "2*l/3*sin(psi)"]
W = ["0", "l*sin(psi)"]
A = ["l*cos(psi)", "0"]
[[frame]]
name = "bar"
angle = "psi"
[[rigid_body]]
name = "ladder"
mass = "m"
inertia = "m*l^2/12"
at = "G"
frame = "bar"
[[particle]]
name = "bucket"
mass = "M"
at = "E"
[[particle]]
name = "slider"
mass = "mw"
at = "W"
[[gravity]]
direction = [0, -1]
[[spring]]
name = "foot spring"
k = "k"
deflection = "l*cos(psi)"
rest = "x0"
[[damper]]
name = "foot damper"
b = "c"
deflection = "l*cos(psi)"
[[force]]
name = "push"
value = ["-F", "0"]
at = "A"
"""
HEAD = "Data: m = 7, M = 2.3, l = 1.3, mw = 0.8, k = 410, x0 = 0.45, c = 6, g = 9.81\n"
FORCE = "Xi = 1.3 F sin(psi) - 10.14 sin(psi)^2 psi'\n"


@cache
def ladder() -> Derivation:
    """The ladder."""
    return loads(LADDER).derive()


def inertias() -> tuple[float, float, float]:
    """The constant part of the inertia, the factor of cos², and the factor of sin ψ in V."""
    m, M, l, mw, g = 7, 2.3, 1.3, 0.8, 9.81
    return m * l**2 / 3 + M * l**2 / 9, (M / 3 + mw) * l**2, (m / 2 + 2 * M / 3 + mw) * g * l


def answer(digits: int, *, spring: str = "-", spoiled: str = "") -> str:
    """An answer with numbers of some digits; ``spring`` is the sign in the force of the spring."""
    a, b, w = (f"{x:.{digits}g}" for x in inertias())
    inertia = f"({spoiled or a} + {b} cos(psi)^2)"
    return (
        f"T = 1/2 {inertia} psi'^2\nV = {w} sin(psi) + 205 (1.3 cos(psi) - 0.45)^2\n{FORCE}"
        f"{inertia} psi'' - {b} sin(psi) cos(psi) psi'^2 + {w} cos(psi)"
        f" - 533 sin(psi) (1.3 cos(psi) {spring} 0.45) = 1.3 F sin(psi) - 10.14 sin(psi)^2 psi'\n"
    )


@pytest.mark.parametrize("digits", [3, 4, 5])
def test_a_rounded_number_is_right_also_with_an_identity(digits: int) -> None:
    """The right energy is written with sin² and cos², the answer has cos² alone."""
    assert ladder().check(HEAD + answer(digits)).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize("digits", [3, 4, 5])
def test_rounded_numbers_are_right_beside_a_wrong_term(digits: int) -> None:
    """Only the spring is wrong, and it is told with numbers."""
    verdict = ladder().check(HEAD + answer(digits, spring="+"))
    assert [(f.line.kind, f.status.right) for f in verdict.findings] == [
        ("T", True),
        ("V", True),
        ("Xi", True),
        ("equation", False),
    ]
    assert len(verdict.findings[-1].differences) == 1
    assert "239.85 sin" in str(verdict)
    assert "x₀" not in str(verdict)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("spoiled", ["4.376", "4.374", "4.38", "4.36", "4.3"])
def test_another_digit_stays_wrong(spoiled: str) -> None:
    """4.375 is right."""
    assert f"{inertias()[0]:.4g}" == "4.375"
    verdict = ladder().check(HEAD + answer(4, spoiled=spoiled))
    assert verdict.right == (spoiled == "4.38")


def test_no_letter_of_a_system_is_told_where_it_is_in_numbers() -> None:
    """A wrong number is told beside the right one."""
    verdict = ladder().check(HEAD + answer(4, spoiled="5.375"))
    assert not verdict.right
    assert "2.18761" in str(verdict)
