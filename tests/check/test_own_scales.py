"""Multipliers in a scale of an answer's own hide no wrong inertia, and no letter of a mass is a unit."""

import pytest

import lagrangian as lg


@pytest.fixture(scope="module")
def wheel() -> lg.Derivation:
    s = lg.System("wheel")
    x, phi = s.coordinates("x phi")
    m, J, R = s.parameters("m J R", m="2 kg", J="0.3 kg*m^2", R="0.4 m")
    tau = s.input("tau")
    s.kinetic((m * x.diff() ** 2 + J * phi.diff() ** 2) / 2)
    s.torque(tau, on=phi)
    s.constraint(x - R * phi, name="roll")
    return s.derive()


MOTION = "(J + m*R^2)*phi'' = tau\n"


@pytest.mark.parametrize("line", ["m*R*phi'' = F", "m*x'' = F", "m*R^2*phi'' = M_F", "x'' = F/m", "F = m*R*phi''"])
def test_a_name_in_one_line_alone_may_be_the_force_in_a_scale(wheel: lg.Derivation, line: str) -> None:
    assert wheel.check(MOTION + line, hint=0).right


@pytest.mark.sampled(3)
@pytest.mark.parametrize("line", ["(J + 2*m*R^2)*phi'' = M_P", "(J + m*R)*phi'' = F", "J*x'' = F"])
def test_a_name_in_one_line_alone_takes_up_no_wrong_inertia(wheel: lg.Derivation, line: str) -> None:
    for answer in (MOTION + line, line):
        assert not wheel.check(answer, hint=0).right


@pytest.mark.sampled(2)
@pytest.mark.parametrize("wrong", ["(J + 2 m R^2) phi'' = tau\nm x'' = F", "2 m x'' = F\nJ phi'' = tau - F R"])
def test_the_letter_of_a_mass_beside_other_letters_is_no_unit(wheel: lg.Derivation, wrong: str) -> None:
    """With m = 2 kg, 2 metres would be as much as m."""
    assert not wheel.check(wrong, hint=0).right
    assert wheel.check(wrong.replace("2 m", "m"), hint=0).right
