"""Nothing that an answer says is lost in silence: what is not judged is told, and what cannot be read is refused.

Oracle: the equation of the pendulum, m L² θ̈ + b θ̇ + m g L sin θ = 0; with something more on a side it is not right.
"""

import pytest

from built_in import derivation
from lagrangian import ParseError
from lagrangian.check.reading.hypertext import without_tags
from lagrangian.check.reading.traced_text import TracedText

LEFT = "m L² θ'' + b θ' + m g L sin θ"


def judged_right(written: str, name: str = "pendulum") -> bool:
    """Whether an answer is judged right; one that is refused is not."""
    try:
        return derivation(name).check(written).right
    except ParseError:
        return False


@pytest.mark.parametrize("behind", ["| : 5 = 3 b", "| - 3 b = 7 θ'", "<- b = 0", "← b = 0"])
def test_a_side_behind_a_stroke_or_an_arrow_stays(behind: str) -> None:
    assert not judged_right(f"{LEFT} {behind}")
    assert judged_right(f"{LEFT} = 0 {behind.split('=')[0]}")


@pytest.mark.parametrize(
    "written",
    ["θ' <b g> x", "x < b and y > 0", "x <i t> y", "x < sub > 2 < /sub> 3", "a <b g=0> c", "m <b/2> u < / b > v"],
)
def test_comparisons_are_no_tags(written: str) -> None:
    assert without_tags(TracedText(written)).text == written


def test_tags_are_taken_off() -> None:
    written = """<p class="a b">x<sub>1</sub> <b style='c'>y</b><br/><td align=center>z<br /><span id="q" lang="de">"""
    assert without_tags(TracedText(written)).text.split() == ["x_1", "y", "z"]
    assert not judged_right("m L² θ'' + b θ' <b g> + m g L sin θ = 0")
