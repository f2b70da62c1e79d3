"""Arguments of a program that are a d and the first letters of a coordinate: its rate, where no other one is meant."""

import pytest
from small_systems import rod

PROGRAM = """def acc(r, phi, dr, dp, m, J, k, a, M):
    om = dp                       # angular velocity
    ddr = r*om**2 - k*(r - a)/m
    ddp = (M - 2*m*r*dr*om)/(J + m*r**2)
    return ddr, ddp
"""
ANSWERS = {
    PROGRAM: True,
    PROGRAM.replace("r*om**2", "-r*om**2"): False,
    PROGRAM.replace("om = dp", "om = 2*dp"): False,
    PROGRAM.replace("om = dp", "om = dr").replace("dr*om", "dp*om"): False,
    PROGRAM.replace("dr, dp, m", "dp, dr, m"): True,
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("program", "right"), ANSWERS.items())
def test_the_rate_of_a_coordinate_by_its_first_letter(program: str, right: bool) -> None:
    verdict = rod().check(program)
    assert verdict.right == right, str(verdict)
