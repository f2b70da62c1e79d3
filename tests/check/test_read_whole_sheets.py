"""Sheets as people write them: intermediate steps, checks, sketches and remarks beside the equations of motion.

Oracle: the equations of the cart with a pole and of other examples, in the grammar of model files. What stands beside
them changes no verdict unless it is understood and false; every answer has a wrong twin, which is not accepted.
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import ParseError, System
from student_answers import CART, POLE, right

BOTH = f"{CART}\n{POLE}\n"


@pytest.mark.parametrize(
    "step",
    [
        "∂T/∂x' = (M + m) x' + m l theta' cos theta   =>   d/dt = (M + m) x'' + m l theta'' cos theta"
        " - m l theta'^2 sin theta",
        "∂L/∂x' = (M+m) x' + m l theta' cos theta    d/dt → (M+m) x'' + m l theta'' cos theta"
        " - m l theta'^2 sin theta    ∂L/∂x = 0",
        "dT/dx' = (M+m) x' + m l theta' cos theta -> (M+m) x'' + m l theta'' cos theta"
        " - m l theta'^2 sin theta;  dV/dx = 0",
    ],
)
def test_a_derivative_that_names_nothing_is_that_of_its_line(step: str) -> None:
    assert right(f"{step}\n\n{BOTH}")
    wrong = step[: step.rfind("theta'^2")] + "2 " + step[step.rfind("theta'^2") :]
    assert not right(f"{wrong}\n\n{BOTH}")


@pytest.mark.parametrize("first", ["d/dt: ", "d/dt = ", "d/dt → "])
@pytest.mark.parametrize("second", ["      ", "d/dt: "])
@pytest.mark.parametrize("gap", ["", "\n"])
def test_as_many_derivatives_as_there_are_above_are_those_of_each(first: str, second: str, gap: str) -> None:
    step = (
        "∂T/∂x' = (M + m) x' + m l theta' cos theta\n∂T/∂theta' = (J + m l^2) theta' + m l x' cos theta\n"
        f"{gap}{first}(M + m) x'' + m l theta'' cos theta - m l theta'^2 sin theta\n"
        f"{second}(J + m l^2) theta'' + m l x'' cos theta - m l x' theta' sin theta"
    )
    assert right(f"{step}\n\n{BOTH}")
    for slip in ("theta'^2 sin", "x' theta' sin"):
        assert not right(f"{step.replace(slip, f'2 {slip}')}\n\n{BOTH}")


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "aside",
    [
        "Check: b = 0 ⇒ (M + m) x'' = F. OK!",
        "Special case: J = 0 => l theta'' + x'' cos theta = g sin theta, fine",
        "all masses are constant (ṁ = 0!)",
        "Sketch: wall |--b--[M]--> F, the pole (m) stands on [M]--|",
        "the rest of the terms: (J + m l^2) theta'' + m l x'' cos theta",
    ],
)
def test_what_stands_beside_complete_equations_decides_nothing(aside: str) -> None:
    assert right(f"{aside}\n\n{BOTH}")
    assert not right(f"{aside}\n\n{BOTH.replace('b x', '2 b x')}")
    assert not right(f"{aside}\n\n{CART}")


def test_the_rate_of_a_constant_is_not_zero_by_another_name() -> None:
    assert not right(f"all is constant (ẋ = 0!)\n\n{BOTH}")
    with pytest.raises(ParseError, match="does not change"):
        derivation("cart-pole").check("m' = 0")


def test_a_letter_in_brackets_beside_numbers_is_a_label() -> None:
    assert right(f"(S) {CART}\n(2) {POLE}")
    assert not right(f"(S) {CART}\n(2) {POLE.replace('- m g', '+ m g')}")


def test_a_velocity_in_components_is_compared_with_its_position() -> None:
    place = "p = [x + l sin theta; l cos theta]\n"
    rate = "ṗ = [x' + l theta' cos theta; -l theta' sin theta]\n|ṗ|² = x'^2 + l^2 theta'^2 + 2 l x' theta' cos theta\n"
    assert right(f"{place}{rate}\n{BOTH}")
    assert not right(f"{place}{rate.replace('-l theta', 'l theta')}\n{BOTH}")


@pytest.mark.slow
def test_more_new_names_than_are_tried_stand_for_the_coordinates_in_order() -> None:
    s = System("row of masses")
    q = s.coordinates("x1 x2 x3 x4")
    m, k, c = s.parameters("m k c")
    for a, b in zip((0, *q[:3]), q, strict=True):
        s.kinetic(m * b.diff() ** 2 / 2)
        s.spring(k, deflection=b - a)
    s.damper(c, deflection=q[3])
    rows = "\n".join(
        (
            "mz̈₁ = -kz₁ + k(z₂ - z₁)",
            "mz̈₂ = -k(z₂ - z₁) + k(z₃ - z₂)",
            "mz̈₃ = -k(z₃ - z₂) + k(z₄ - z₃)",
            "mz̈₄ = -k(z₄ - z₃) - cż₄",
        )
    )
    row = s.derive()
    assert row.check(rows, hint=0).right
    assert not row.check(rows.replace("k(z₃ - z₂)\n", "k(z₂ - z₃)\n"), hint=0).right


def test_a_damper_called_d_is_no_derivative() -> None:
    s = System("pendulum with a damper")
    phi = s.coordinates("phi")
    J, d, k, Omega = s.parameters("J d k Omega")
    s.kinetic(J * phi.diff() ** 2 / 2)
    s.damper(d, deflection=phi)
    s.spring(k * Omega**2, deflection=phi)
    pendulum = s.derive()
    assert pendulum.check("Jφ̈ + dφ̇ + kΩ² φ = 0", hint=0).right
    assert not pendulum.check("Jφ̈ + dφ̈ + kΩ² φ = 0", hint=0).right


@pytest.mark.slow
def test_the_slopes_of_a_lagrangian_with_multipliers_have_them() -> None:
    s = System("bead on a circle")
    x, y = s.coordinates("x y")
    m, r = s.parameters("m r")
    s.particle(m, at=s.origin + (x, y))
    s.gravity()
    s.constraint(x**2 + y**2 - r**2)
    sheet = (
        "L = m (x'^2 + y'^2)/2 - m g y + λ (x^2 + y^2 - r^2)\n"
        "∂L/∂x = 2 λ x\n∂L/∂y = -m g + 2 λ y\n"
        "m x'' - 2 λ x = 0\nm y'' + m g - 2 λ y = 0\nx^2 + y^2 = r^2"
    )
    bead = s.derive()
    assert bead.check(sheet, hint=0).right
    assert not bead.check(sheet.replace("-m g + 2 λ y", "m g + 2 λ y"), hint=0).right
    own = "x = r cos β, y = r sin β\nT = m r^2 β'^2/2\nV = m g r sin β + m g r\nm r^2 β'' + m g r cos β = 0"
    assert bead.check(own, hint=0).right
    assert not bead.check(own.replace("r^2 β'^2/2", "r^2 β'^2"), hint=0).right
    assert not bead.check(own.replace("m g r sin β", "2 m g r sin β"), hint=0).right
    assert not bead.check(own.replace("m r^2 β'' +", "m r^2 β'' -"), hint=0).right


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "said", [" with J_A = J + m l^2", ",  J_A = J + m l^2", ", where J_A = J + m l^2 (about the pin)"]
)
def test_what_goes_on_below_a_letter_that_is_explained_belongs_to_the_equation(said: str) -> None:
    first = "1/2 (M + m) x'^2 + m l x' theta' cos theta"
    above = f"T = {first} + 1/2 J_A theta'^2{said}\n  = {first}"
    assert right(f"{above} + 1/2 (J + m l^2) theta'^2")
    assert not right(f"{above} + 1/2 (J - m l^2) theta'^2")


def test_signs_between_words_in_front_of_a_definition_are_no_mathematics() -> None:
    said = "Moment from the hinge force + acceleration of the centre gives with Steiner Jh = J + m l^2:\n"
    rows = f"{CART}\nJh theta'' + m l x'' cos(theta) - m g l sin(theta) = 0"
    assert right(said + rows)
    assert not right(said.replace("+ m l^2", "+ 2 m l^2") + rows)
