"""A second relation of a name that follows from the others is no definition in a circle."""

import pytest
from small_systems import rod

RIGHT = """J*phi'' + r*(A + B) = M
m*r'' = m*r*phi'^2 - k*(r - a)
A = (P - k*r)/2
B = (P + k*r)/2
and P = A + B is what the rod hands on,
P = m*r*phi'' + 2*m*r'*phi'
"""
ANSWERS = {
    RIGHT: True,
    RIGHT.replace("+ 2*m", "- 2*m"): False,
    RIGHT.replace("P = A + B", "P = A - B"): False,
    RIGHT.replace("B = (P + k*r)/2", "B = (P - k*r)/2"): False,
    "\n".join(RIGHT.splitlines()[-1:] + RIGHT.splitlines()[:-1]): True,
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("answer", "right"), ANSWERS.items())
def test_a_sum_of_parts_is_compared_with_the_whole(answer: str, right: bool) -> None:
    verdict = rod().check(answer)
    assert (verdict.right and all(f.status.right for f in verdict.findings)) == right, str(verdict)
