"""Inputs that an answer calls by a name of its own, and values of inputs beside the equations."""

from functools import cache

import pytest

from lagrangian import Derivation, System


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
