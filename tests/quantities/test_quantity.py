"""Numbers with units against pint's own conversion and against values that others computed."""

import math
from functools import cache

import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from effort import at_most
from lagrangian.errors import ParseError
from lagrangian.quantities.quantity import parse_quantity, unit_dimension
from size import sized

CALLS = 100_000
"""Of Python functions, that any one of these takes at most."""


@pytest.mark.parametrize(
    ("text", "value", "unit", "dimension"),
    [
        ("40 N/m", 40.0, "N/m", "kg/s^2"),
        ("250 mm", 0.25, "mm", "m"),
        ("30 deg", math.pi / 6, "deg", ""),
        ("30°", math.pi / 6, "°", ""),
        ("-pi/4 rad", -math.pi / 4, "rad", ""),
        ("2*pi/3", 2 * math.pi / 3, "", ""),
        ("1/2 kg", 0.5, "kg", "kg"),
        ("½ kg", 0.5, "kg", "kg"),
        ("9.81 m/s²", 9.81, "m/s²", "m/s^2"),
        ("9.81 m s^-2", 9.81, "m s^-2", "m/s^2"),
        ("1e3", 1000.0, "", ""),
        ("10kg", 10.0, "kg", "kg"),
        ("5/s", 5.0, "1/s", "1/s"),
        ("5 1/s", 5.0, "1/s", "1/s"),
        ("3 kg m^2/s^2", 3.0, "kg m^2/s^2", "kg*m^2/s^2"),
        ("40 N/(m s)", 40.0, "N/(m s)", "kg/s^3"),
        ("36 km/h", 10.0, "km/h", "m/s"),
        ("60 rpm", 2 * math.pi, "rpm", "1/s"),
        ("1 inch", 0.0254, "inch", "m"),
        ("1 lbf", 4.4482216152605, "lbf", "kg*m/s^2"),
        ("4 m^(1/2)", 4.0, "m^(1/2)", "m^(1/2)"),
        ("5 µm", 5e-6, "µm", "m"),
        ("7 N·m", 7.0, "N·m", "kg*m^2/s^2"),
        ("12 V", 12.0, "V", "kg*m^2/(s^3*A)"),
    ],
)
def test_values(text: str, value: float, unit: str, dimension: str) -> None:
    quantity = parse_quantity(text)
    assert quantity.value == pytest.approx(value, rel=1e-15)
    assert (quantity.unit, str(quantity.dimension)) == (unit, dimension)


def test_exponents_of_the_base_units() -> None:
    assert unit_dimension("N/m") == (1, 0, -2, 0, 0, 0, 0)
    assert unit_dimension("V/K") == (1, 2, -3, -1, -1, 0, 0)
    assert unit_dimension("deg") == (0,) * 7


@cache
def registry() -> pint.UnitRegistry:
    """Made when it is asked for the first time: that takes as long as all other tests here."""
    return pint.UnitRegistry()


BAD = [
    ("", 1, "empty"),
    ("1,5 kg", 2, "use a decimal point: 1.5"),
    ("10 kgg", 4, "Did you mean 'kg'?"),
    ("10 Kg", 4, "write kg"),
    ("5 Nm", 3, "write N*m"),
    ("5 m2", 3, "write m^2"),
    ("kg", 1, "a number is expected first"),
    ("nan", 1, "finite number"),
    ("-inf m", 2, "finite number"),
    ("1e999 kg", 1, "too long"),
    ("1e308 km^20", 1, "too large"),
    ("5 6 kg", 3, "two numbers"),
    ("40 N/m s", 8, "needs parentheses"),
    ("20 degC", 4, "the zero of 'degC' is at 273.15 K"),
    ("20 °C", 4, "the zero of 'degC' is at 273.15 K"),
    ("5 deg F", 3, "a difference of one degree is 5/9 K"),
    ("5 °K", 3, "write K"),
    ("10 dB", 4, "is a logarithm of a ratio"),
    ("5 N-m", 4, "write * for a product: N*m"),
    ("5 ft-lbf", 5, "write * for a product: ft*lbf"),
    ("5 kg^99", 6, "exponent is too large"),
    ("5 kg^x", 6, "an exponent must be a number"),
    ("5 " + "(" * 10 + "m" + ")" * 10, 11, "nested more than 8 deep"),
    ("5 __import__('os')", 3, "found '_'"),
    ("5 m.s", 4, "write * for a product"),
    ("5 m*__class__", 5, "found '_'"),
    ("5 kg + 3 m", 6, "found '+'"),
    ("9**9**9", 2, "where a unit is expected"),
    ("10 m^9^9", 7, "found '^'"),
    ("5 (m", 3, "never closed"),
    ("1/0 kg", 3, "division by zero"),
    ("5*", 3, "the end"),
    ("5 [m]", 3, "found '['"),
    ("1 " + "m*" * 200, None, "characters"),
    ("5 mm:10 mm", 5, "this is a range of values"),
    ("5 lambda: 3", 9, "found ':'"),
]


@pytest.mark.parametrize(("text", "column", "fragment"), BAD, ids=[b[0][:20] for b in BAD])
def test_what_is_wrong_is_said_and_pointed_at(text: str, column: int | None, fragment: str) -> None:
    with pytest.raises(ParseError) as caught:
        parse_quantity(text, what="parameter 'm'")
    assert fragment in str(caught.value) and "parameter 'm'" in str(caught.value)
    if column is not None:
        assert caught.value.place is not None and caught.value.place.column == column


@sized(200, 20)
@given(
    st.one_of(
        st.text(max_size=20),
        st.lists(
            st.sampled_from([*"0123456789. */^()-+,", "kg", "m", "s", "pi", "deg", "e", "²", "½", "°"]), max_size=10
        ).map("".join),
    )
)
def test_any_text_gives_a_finite_value_or_a_parse_error(text: str) -> None:
    try:
        with at_most(CALLS):
            value = parse_quantity(text).value
    except ParseError as error:
        assert str(error)
    else:
        assert math.isfinite(value)


@sized(60, 15)
@given(
    st.integers(-1000, 1000),
    st.lists(
        st.tuples(st.sampled_from(["kg", "mm", "ms", "N", "lbf", "ft", "hour"]), st.integers(-3, 3)),
        min_size=1,
        max_size=4,
    ),
)
def test_products_of_units_agree_with_pint(number: int, factors: list[tuple[str, int]]) -> None:
    text = "*".join(f"{name}^{power}" for name, power in factors)
    there = registry().Quantity(float(number), "dimensionless")
    for name, power in factors:
        there = there * registry().Quantity(1.0, name) ** power
    assert parse_quantity(f"{number} {text}").value == pytest.approx(there.to_base_units().magnitude, rel=1e-12)
