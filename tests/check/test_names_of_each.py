"""What stands far behind a term is a statement of its own, and a name may have a value for each of several bodies.

Oracle: a puck on a spring along a turning rod, whose speeds along and across the rod are r' and r φ'.
"""

from __future__ import annotations

import pytest
from small_systems import rod

ROD = "(J + m r^2) phi'' + 2 m r r' phi' = M\nm r'' - m r phi'^2 + k (r - a) = 0"


@pytest.mark.parametrize(
    ("above", "right"),
    [
        ("spring      - k d r'        d = r - a\n", True),
        ("rod:  J phi' phi''      v = r phi'\n", True),
        ("puck: speed across the rod     v = r phi'\nrod: speed of its tip at a     v = a phi'\n", True),
        ("puck:  m r r'          v = r phi'\nrod tip:  J phi'      v = a phi'\n", True),
    ],
)
def test_a_definition_far_behind_a_term_is_read_apart(above: str, right: bool) -> None:
    assert rod().check(above + ROD).right is right


@pytest.mark.parametrize(("factor", "right"), [("", True), ("2 ", False)])
def test_a_definition_far_behind_a_term_is_used_as_it_is(factor: str, right: bool) -> None:
    answer = f"spring      - k d r'        d = {factor}r - a\n" + ROD.replace("k (r - a)", "k d")
    assert rod().check(answer).right is right


def test_a_name_with_two_values_that_equations_use_is_not_taken_apart() -> None:
    answer = "puck: v = r phi'\nrod: v = a phi'\n" + ROD.replace("m r phi'^2", "m v phi'")
    assert not rod().check(answer.replace("v = a phi'", "v = 2 r phi'")).right
