"""Inputs and parameters that an answer calls by names of its own, and values of inputs beside the equations."""

from functools import cache

import pytest

from built_in import derivation
from lagrangian import Derivation, System
from lagrangian.check import Status


@cache
def cart() -> Derivation:
    sys = System("cart")
    x = sys.coordinate("x")
    m, c, k = sys.parameters("m c k", m="2 kg", c="1 N*s/m", k="30 N/m")
    sys.kinetic(m * x.diff() ** 2 / 2)
    sys.spring(k, deflection=x)
    sys.damper(c, deflection=x)
    sys.force(sys.input("F"), deflection=x)
    return sys.derive()


@cache
def winch() -> Derivation:
    """A load on a rope from a driven drum."""
    sys = System("winch")
    y, phi = sys.coordinates("y phi")
    m, J, r, g = sys.parameters("m J r g")
    sys.kinetic((m * y.diff() ** 2 + J * phi.diff() ** 2) / 2)
    sys.potential(-m * g * y)
    sys.torque(-sys.input("M"), on=phi)
    sys.constraint(y - r * phi, name="rope")
    return sys.derive()


ROPE = "m y'' = m g - S\nJ φ'' = r S - {}\ny = r φ"


@pytest.mark.sampled(2)
@pytest.mark.parametrize("said", ["motor(t) = 8 + 2 sin(3 t)\n", "motor = 8 + 2*sin(3*t)\n"])
def test_a_value_of_time_alone_may_be_the_only_input(said: str) -> None:
    name = said.split(" =", maxsplit=1)[0]
    push = f"{said}m x'' + c x' + k x = {name}"
    verdict = cart().check(push)
    assert verdict.right and "'motor' was read as F, with the value that you give it." in str(verdict)
    for wrong in (push.replace("= m", "= -m"), push.replace("+ c x'", ""), f"{push} + F", said.replace("motor", "F")):
        assert wrong != push and not cart().check(wrong, hint=0).right
    assert winch().check(said + ROPE.format(name), hint=0).right
    assert not winch().check(said + ROPE.format(f"r {name}"), hint=0).right


def test_a_value_of_time_alone_is_no_parameter() -> None:
    assert not cart().check("kk = 30 + sin(t)\nm x'' + c x' + kk x = F", hint=0).right


@pytest.mark.slow
def test_an_input_has_another_name_beside_a_multiplier() -> None:
    verdict = winch().check(ROPE.format("M_mot"))
    assert verdict.right and "'M_mot' was read as M." in str(verdict)
    assert not winch().check(ROPE.format("r M_mot"), hint=0).right
    assert not winch().check(ROPE.format("M + M_mot"), hint=0).right


def test_the_value_of_an_input_stands_beside_equations_with_a_multiplier() -> None:
    assert winch().check("M(t) = 8 + 2 sin(3 t)\n" + ROPE.format("M"), hint=0).right
    assert not winch().check("M = r S\n" + ROPE.format("2 M"), hint=0).right
    assert not winch().check("M = 0\n" + ROPE.replace(" - {}", ""), hint=0).right


ROD = "m_b*x'' = 2*lambda*x\nm_b*y'' = 2*lambda*y - m_b*g\nx^2 + y^2 = l^2\n"


@pytest.mark.sampled(2)
@pytest.mark.parametrize("energies", ["", "T = m_b*(x'^2 + y'^2)/2\nV = m_b*g*y\n"])
def test_a_parameter_beside_multipliers_may_have_another_name(energies: str) -> None:
    rod, sheet = derivation("rod-pendulum"), energies + ROD
    assert rod.check(sheet).right
    for old, new in (
        ("m_b*x''", "2*m_b*x''"),
        ("y - m_b*g", "y + m_b*g"),
        ("y - m_b*g", "y - m*g"),
        ("T = m", "T = 2*m"),
    ):
        assert old not in sheet or not rod.check(sheet.replace(old, new)).right


def test_an_inertia_is_no_force_that_is_eliminated() -> None:
    verdict = derivation("rod-pendulum").check(f"T = m_b*(x'^2 + y'^2)/2\n{ROD}".replace("- m_b*g", "+ m_b*g"))
    assert not verdict.right
    assert verdict.findings[0].status is Status.RIGHT
