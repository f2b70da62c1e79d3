"""How the values of a sweep are written, and what is told where they cannot be read."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lagrangian.errors import ParseError
from lagrangian.read.sweep_values import parse_spread, parse_values
from size import sized


def numbers(text: str) -> list[float]:
    return [n.value for n in parse_spread(text).numbers]


def test_ranges_lists_and_distributions() -> None:
    s = parse_spread("k=10:100:50")
    assert (s.name, s.kind, s.count, s.log, numbers("k=10:100:50")) == ("k", "range", 50, False, [10, 100])
    assert parse_spread("k=10:100:50:log").log
    assert numbers("m2=1kg:3 kg:20") == [1, 3]
    assert numbers("x = 10 mm : 50mm : 5") == [0.01, 0.05]
    assert numbers("theta1=-30deg:0:7")[0] == pytest.approx(-0.5235987755982988)
    assert numbers("k=10,20,40") == [10, 20, 40]
    assert parse_spread("theta1'=1").name == "theta1'"
    assert parse_spread("m2~normal(1,0.1)").kind == "normal"
    assert parse_spread("m2=uniform(1 kg, 2kg)").drawn
    assert parse_values("m2", "~lognormal(0, 0.1)").kind == "lognormal"
    assert parse_values("m2", "1:2:3").name == "m2"


@pytest.mark.parametrize(
    ("text", "message", "caret"),
    [
        ("k", "not a name with values", 0),
        ("=3", "not a name with values", 0),
        ("k=", "no value is given", 2),
        ("k=1:2", "three parts", 2),
        ("k=1:2:3:4:5", "three parts", 2),
        ("k=1:2:0", "at least 2 values", 6),
        ("k=1:2:x", "the number of values", 6),
        ("k=1:2:2.5", "the number of values", 6),
        ("k=1:2:999999999", "too many", 6),
        ("k=1:2:5:cube", "unknown spacing 'cube'", 8),
        ("k=-1:2:5:log", "of the same sign", 2),
        ("k=1 kg:2 m:5", "are units of different quantities", 2),
        ("k=10:50 mm:5", "some of the numbers have a unit", 2),
        ("k=1,two,3", "found 'two'", 4),
        ("k=1:__import__:3", "found", 4),
        ("k~gauss(1,2)", "unknown distribution 'gauss'", 2),
        ("k~3", "not a distribution", 2),
        ("k~normal(1,0.1", "never closed", 8),
        ("k~normal(1)", "takes 2 numbers", 9),
        ("k~normal(1,-0.1)", "standard deviation is negative", 11),
        ("k~uniform(2,1)", "not below", 10),
        ("k~lognormal(1 kg,0.1)", "no unit", 12),
        ("k=nan", "finite number", 2),
        ("k=1:inf:3", "finite number", 4),
        ("", "empty", None),
    ],
)
def test_what_cannot_be_read(text: str, message: str, caret: int | None) -> None:
    with pytest.raises(ParseError, match=message) as caught:
        parse_spread(text)
    if caret is not None:
        lines = str(caught.value).splitlines()
        assert lines[1] == f" | {text}"
        assert lines[2] == " | " + " " * caret + "^"
    assert "Fix: " in str(caught.value) or caret is None


@sized(300, 60)
@given(st.text(alphabet="k=~:,.0123456789 normaluifg()-+e'\"_[]{}*/\\\n\tθ", max_size=40))
def test_any_text_is_read_or_refused_with_one_kind_of_error(text: str) -> None:
    try:
        parse_spread(text)
    except ParseError as error:
        assert str(error)
