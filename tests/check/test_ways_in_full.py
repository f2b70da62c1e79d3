"""A way that is halved by a rope is taken in full by all that moves along it: one mistake, and not one for each term.

Oracle: by hand, a winch draws the rope r φ into the loop in which a block hangs; the block rises by ½ r φ and turns by
½ r φ/a. A load hangs from it on a spring and is guided by a damper between both.
"""

from __future__ import annotations

import pytest
from small_systems import loop

ROWS = """(J + (m + {inertia}) ({n} r)^2) phi'' + {n} m g r + {k} {n} r ({n} r phi - w) + c {n} r ({n} r phi' - w') = u
M w'' - k ({n} r phi - w) - c ({n} r phi' - w') + M g = 0"""


def rows(n: str, *, inertia: str = "I/a^2", k: str = "k") -> str:
    return ROWS.format(n=n, inertia=inertia, k=k)


@pytest.mark.slow
@pytest.mark.parametrize("inertia", ["I/a^2", "I/(4 a^2)"])
def test_a_way_in_full_is_one_mistake(inertia: str) -> None:
    """The second: the block turns as it should."""
    assert loop().check(rows("1/2")).right
    verdict = loop().check(rows("1", inertia=inertia))
    assert not verdict.right
    [mistake] = verdict.mistakes
    assert str(mistake.what) == "The way of rigid body 'block' is taken as r*phi; it is r*phi/2."
    assert mistake.name == "way_in_full"


def test_another_factor_in_one_element_is_no_way_in_full() -> None:
    for answer in (
        rows("1/2", k="2 k"),
        rows("3"),
        rows("1/2").replace("1/2 m g r", "m g r"),
    ):
        verdict = loop().check(answer)
        assert not verdict.right
        assert not any(m.name == "way_in_full" for m in verdict.mistakes)
