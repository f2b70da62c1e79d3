"""Coordinates that an answer counts from the same place where the wheel rolls, and small habits of students' sheets."""

from __future__ import annotations

import pytest
from reels import reel

from built_in import derivation
from lagrangian import System

ALONG = "(M + m + J/R^2) x'' + m l cos(psi) psi'' - m l sin(psi) psi'^2 + k (x/R + psi)/R + c (x'/R + psi')/R = F"
ARM = "m l^2 psi'' + m l cos(psi) x'' + m g l sin(psi) + k (x/R + psi) + c (x'/R + psi') = 0"


@pytest.mark.parametrize("said", ["phi = x/R", "x = R phi", "x'' = R phi''", ""])
def test_an_angle_may_be_counted_from_where_the_wheel_starts(said: str) -> None:
    verdict = reel().check(f"{said}\n{ALONG}\n{ARM}")
    assert verdict.right and any("so that" in str(note) for note in verdict.notes)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("k (x/R + psi)/R", "k (x + psi)/R"),
        ("k (x/R + psi)/R", "k (psi - x/R)/R"),
        ("k (x/R + psi)/R", "k (x/R + psi)"),
    ],
)
def test_a_wrong_deflection_stays_wrong(right: str, wrong: str) -> None:
    assert right in ALONG
    assert not reel().check(f"phi = x/R\n{ALONG.replace(right, wrong)}\n{ARM}", hint=0).right
    assert not reel().check(f"phi = -x/R\n{ALONG}\n{ARM}", hint=0).right


def test_an_energy_in_small_numbers_stands_beside_equations_in_numbers() -> None:
    sys = System("s")
    s = sys.coordinate("s")
    m, k, b = sys.parameters("m k b", m="0.2 kg", k="3 N/m", b="0.1 N*s/m")
    sys.particle(m, at=sys.point("P", (s, 0)))
    sys.spring(k, deflection=s)
    sys.damper(b, deflection=s)
    numbers = "0.2 s'' + 0.1 s' + 3 s = 0"
    for V, right in (("1.5 s²", True), ("3/2 s^2", True), ("2.5 s²", False), ("3 s^2", False)):
        assert sys.derive().check(f"T = 0.1 s'^2\nV = {V}\n{numbers}", hint=0).right is right


CART = "(M + m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + b x' = F"
POLE = "U x'' cos(theta) + (J + U l) theta'' - U g sin(theta) = 0"


def test_products_in_a_list_of_notation_are_no_letters_of_the_system() -> None:
    pole = derivation("cart-pole")
    notation = "In my notation: mu = M + m (everything), U = m l (unbalance), B = J + m l^2."
    assert pole.check(f"{notation}\n{CART}\n{POLE}", hint=0).right
    assert not pole.check(f"{notation.replace('U = m l', 'U = m g')}\n{CART}\n{POLE}", hint=0).right


def test_what_a_letter_means_may_stand_behind_its_equation() -> None:
    pole = derivation("cart-pole")
    forces = "M x'' = F - b x' - N       N: force of the pole on the cart, to the left"
    said = "N = m (x'' + l theta'' cos(theta) - l theta'^2 sin(theta))"
    turn = "(J + m l^2) theta'' + m l x'' cos theta = m g l sin theta"
    assert pole.check(f"{forces}\n{said}\n{turn}", hint=0).right
    assert not pole.check(f"{forces.replace('- N ', '+ N ')}\n{said}\n{turn}", hint=0).right


JULIA = """function cart!(du, u, p, t)
    M, m, l, J, b, g = p
    x, θ, v, w = u
    A = [M + m  m*l*cos(θ)
         m*l*cos(θ)  J + m*l^2]
    f = [F - b*v + m*l*w^2*sin(θ), m*g*l*sin(θ)]
    acc = A \\ f
    du[1] = v
    du[2] = w
    du[3] = acc[1]
    du[4] = acc[2]
end
"""


def test_a_function_of_julia_may_unpack_its_parameters() -> None:
    assert derivation("cart-pole").check(JULIA, hint=0).right
    assert not derivation("cart-pole").check(JULIA.replace("F - b*v", "F + b*v"), hint=0).right
