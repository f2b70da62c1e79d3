"""Among balances of single bodies the wrong one is told by what each takes of the equation, and no energy is blamed.

Oracle: by hand, a winch with a gear; see `small_systems`.
"""

from __future__ import annotations

import pytest
from small_systems import winch

ANSWER = """N is the force in the rope, tau the torque of the gear on the shaft.
weight: m r φ'' = m g - N
drum: J φ'' = N r - n tau + F a/r - c φ'
shaft: I n φ'' = tau - B
(m r² + J + n² I) φ'' = m g r - n B + F a/r - c φ'"""


@pytest.mark.parametrize(
    ("right", "wrong", "last", "line"),
    [
        ("- n tau", "- tau/n", "(m r² + J + I) φ'' = m g r - B + F a/r - c φ'", 3),
        ("J φ'' =", "2 J φ'' =", "(m r² + 2 J + n² I) φ'' = m g r - n B + F a/r - c φ'", 3),
    ],
)
def test_the_wrong_balance_alone_is_told(right: str, wrong: str, last: str, line: int) -> None:
    assert winch().check(ANSWER).right
    *rows, _ = ANSWER.split("\n")
    verdict = winch().check("\n".join([*rows, last]).replace(right, wrong))
    said = " ".join(str(verdict).split())
    assert not verdict.right and f"Look at line {line}: that is the first that is not right" in said, said
    assert "do not fit each other" not in said and "energy" not in said.partition("What went wrong")[2]
