"""What verification says of systems that hold time."""

import pytest
from sympy import cos, sin

import lagrangian as lg


@pytest.mark.slow
def test_a_mass_matrix_that_holds_time_is_checked_with_time_held() -> None:
    """A pendulum whose length grows, L = L0 + c t: M = m L², so that Ṁ alone is not 2C."""
    system = lg.System("growing pendulum")
    theta = system.coordinates("theta")
    m, L0, c = system.parameters("m L0 c")
    L = L0 + c * system.t
    system.particle(m, at=system.origin + (L * sin(theta), -L * cos(theta)))
    system.gravity()
    said = {str(check.what): check.holds for check in system.derive().verified}
    assert said["dM/dt − 2C is skew-symmetric; t itself, which stands in M, is held"] is True
    assert all(said.values())
