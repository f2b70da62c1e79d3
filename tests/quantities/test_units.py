"""The units that are read, against NIST Special Publication 811; and slips of the pen, which are refused."""

import math
import pathlib
import re

import pytest

import lagrangian as lg
from lagrangian.errors import ParseError
from lagrangian.quantities.quantity import parse_quantity, si_unit
from lagrangian.quantities.units import COHERENT, TABLE, units

EXACT = 1e-15
SEVEN = 1e-6
"""Printed with seven digits there."""

NIST = {
    # A. Thompson, B. N. Taylor, Guide for the Use of the SI, NIST SP 811 (2008), appendix B.8 and tables 6 to 8
    "in": (0.0254, EXACT, "m"),
    "ft": (0.3048, EXACT, "m"),
    "yd": (0.9144, EXACT, "m"),
    "mi": (1609.344, EXACT, "m"),
    "nmi": (1852.0, EXACT, "m"),
    "g": (1e-3, EXACT, "kg"),
    "t": (1000.0, EXACT, "kg"),
    "lb": (4.535924e-1, SEVEN, "kg"),
    "lbm": (4.535924e-1, SEVEN, "kg"),
    "oz": (2.834952e-2, SEVEN, "kg"),
    "slug": (1.459390e1, SEVEN, "kg"),
    "min": (60.0, EXACT, "s"),
    "h": (3600.0, EXACT, "s"),
    "d": (86400.0, EXACT, "s"),
    "deg": (1.745329e-2, SEVEN, "rad"),
    "°": (1.745329e-2, SEVEN, "rad"),
    "arcmin": (2.908882e-4, SEVEN, "rad"),
    "arcsec": (4.848137e-6, SEVEN, "rad"),
    "rev": (6.283185, SEVEN, "rad"),
    "rpm": (1.047198e-1, SEVEN, "rad/s"),
    "mph": (4.4704e-1, EXACT, "m/s"),
    "knot": (5.144444e-1, SEVEN, "m/s"),
    "lbf": (4.448222, SEVEN, "N"),
    "kip": (4.448222e3, SEVEN, "N"),
    "kgf": (9.80665, EXACT, "N"),
    "dyn": (1e-5, EXACT, "N"),
    "bar": (1e5, EXACT, "Pa"),
    "atm": (1.01325e5, EXACT, "Pa"),
    "psi": (6.894757e3, SEVEN, "Pa"),
    "ksi": (6.894757e6, SEVEN, "Pa"),
    "mmHg": (1.333224e2, SEVEN, "Pa"),
    "erg": (1e-7, EXACT, "J"),
    "hp": (7.456999e2, SEVEN, "W"),
    "L": (1e-3, EXACT, "m^3"),
    "l": (1e-3, EXACT, "m^3"),
    "lbf*ft": (1.355818, SEVEN, "N*m"),
    "lbf*in": (1.129848e-1, SEVEN, "N*m"),
    "lbf/ft": (1.459390e1, SEVEN, "N/m"),
    "lbf/in": (1.751268e2, SEVEN, "N/m"),
    "ft/min": (5.08e-3, SEVEN, "m/s"),
    "km/h": (2.777778e-1, SEVEN, "m/s"),
    "W*h": (3.6e3, EXACT, "W*s"),
    "deg/s": (1.745329e-2, SEVEN, "rad/s"),
    "slug*ft^2": (1.355818, SEVEN, "kg*m^2"),
    "lb*ft^2": (4.214011e-2, SEVEN, "kg*m^2"),
    "L/min": (1.666667e-5, SEVEN, "m^3/s"),
    "kgf*m": (9.80665, EXACT, "N*m"),
    "kgf/cm^2": (9.80665e4, EXACT, "N/m^2"),
    "mph/s": (4.4704e-1, EXACT, "m/s^2"),
}

BASE_UNITS = {
    # SI brochure, table 4: the units with names of their own, in base units
    "Hz": "1/s",
    "N": "kg*m/s^2",
    "Pa": "kg/(m*s^2)",
    "J": "kg*m^2/s^2",
    "W": "kg*m^2/s^3",
    "C": "s*A",
    "V": "kg*m^2/(s^3*A)",
    "F": "s^4*A^2/(kg*m^2)",
    "Ω": "kg*m^2/(s^3*A^2)",
    "S": "s^3*A^2/(kg*m^2)",
    "Wb": "kg*m^2/(s^2*A)",
    "T": "kg/(s^2*A)",
    "H": "kg*m^2/(s^2*A^2)",
    "rad": "",
}

POWERS = {
    "p": -12,
    "n": -9,
    "µ": -6,
    "u": -6,
    "m": -3,
    "c": -2,
    "d": -1,
    "da": 1,
    "h": 2,
    "k": 3,
    "M": 6,
    "G": 9,
    "T": 12,
}

ONE = {"m", "kg", "s", "A", "K", "mol", "cd", *BASE_UNITS, "ohm"}

WORDS = {
    "m": "metre metres meter meters",
    "km": "kilometre kilometres kilometer kilometers",
    "cm": "centimetre centimetres centimeter centimeters",
    "mm": "millimetre millimetres millimeter millimeters",
    "kg": "kilogram kilograms",
    "g": "gram grams",
    "t": "tonne tonnes",
    "s": "second seconds",
    "min": "minute minutes",
    "h": "hour hours",
    "d": "day days",
    "deg": "degree degrees",
    "rev": "revolution revolutions turn turns",
    "rad": "radian radians",
    "in": "inch inches",
    "ft": "foot feet",
    "yd": "yard yards",
    "mi": "mile miles",
    "slug": "slugs",
    "knot": "knots",
    "N": "newton newtons",
    "kip": "kips",
    "dyn": "dyne dynes",
    "Pa": "pascal pascals",
    "J": "joule joules",
    "erg": "ergs",
    "W": "watt watts",
    "hp": "horsepower",
    "L": "litre litres liter liters",
    "A": "ampere amperes",
    "V": "volt volts",
    "ohm": "ohms",
    "S": "siemens",
    "F": "farad farads",
    "H": "henry henrys henries",
    "C": "coulomb coulombs",
    "T": "tesla teslas",
    "Wb": "weber webers",
    "K": "kelvin kelvins",
    "mol": "mole moles",
    "cd": "candela candelas",
    "Hz": "hertz",
}


@pytest.mark.parametrize("unit", NIST)
def test_factors_are_those_of_the_standard(unit: str) -> None:
    value, within, si = NIST[unit]
    quantity = parse_quantity(f"1 {unit}")
    assert quantity.value == pytest.approx(value, rel=within)
    assert si_unit(unit) == si
    assert quantity.dimension == parse_quantity(f"1 {si}").dimension


def test_every_unit_of_the_table_is_held_against_the_standard() -> None:
    """A symbol, a word for one, or a prefix before one."""
    words = {word: symbol for symbol, listed in WORDS.items() for word in listed.split()}
    held = set()
    for name, unit in units().items():
        symbol = words.get(name, name)
        if symbol in NIST or symbol in ONE:
            expected = NIST[symbol][0] if symbol in NIST else 1.0
        else:
            prefix = next(p for p in ("da", *POWERS) if symbol.startswith(p) and (symbol[len(p) :] in {*NIST, *ONE}))
            rest = symbol[len(prefix) :]
            expected = 10.0 ** POWERS[prefix] * (NIST[rest][0] if rest in NIST else 1.0)
        assert float(unit.factor) == pytest.approx(expected, rel=SEVEN), name
        held.add(name)
    assert held == {*units()}
    assert len(units()) > 250


def test_no_name_stands_twice_in_the_table() -> None:
    names = [name for symbols, words, *_ in TABLE for name in (*symbols.split(), *words.split())]
    prefixed = [p + s for symbols, _, _, _, prefixes in TABLE for s in symbols.split() for p in prefixes.split()]
    assert len({*names, *prefixed}) == len(names) + len(prefixed)


@pytest.mark.parametrize("unit", BASE_UNITS)
def test_units_with_names_of_their_own_are_these_products(unit: str) -> None:
    assert str(parse_quantity(f"1 {unit}").dimension) == BASE_UNITS[unit]
    assert si_unit(unit) is None
    assert unit in COHERENT


def test_turning() -> None:
    assert parse_quantity("60 rpm").value == pytest.approx(2 * math.pi, rel=1e-15)
    assert parse_quantity("1 rev/min").value == parse_quantity("1 rpm").value
    assert parse_quantity("50 Hz").value == 50.0


SLIPS = {
    # what people write: what they are told to write
    **{"gr": "write g", "gm": "write g", "gms": "write g", "Kg": "write kg", "KG": "write kg", "kgs": "write kg"},
    **{"Kgs": "write kg", "kilo": "write kg", "lbs": "write lb", "pound": "lbf (a force)", "ton": "write t (1000 kg)"},
    **{"ounce": "write oz", "Ohm": "write ohm", "OHM": "write ohm", "Sec": "write s", "sec": "write s"},
    **{"secs": "write s", "hr": "write h", "hrs": "write h", "mins": "write min", "msec": "write ms", "usec": "µs"},
    **{"yr": "365.25 d", "mtr": "write m", "mtrs": "write m", "M": "write m", "cms": "write cm", "CM": "write cm"},
    **{"MM": "write mm", "Mm": "write mm, or 1e6 m", "kms": "write km", "KM": "write km", "micron": "write µm"},
    **{"Deg": "write deg", "degs": "write deg", "Rad": "write rad", "rads": "write rad", "grad": "a gon is 0.9 deg"},
    **{"RPM": "write rpm", "rps": "write rev/s", "HZ": "write Hz", "hz": "write Hz", "kph": "write km/h"},
    **{"kmh": "write km/h", "mps": "write m/s", "fps": "write ft/s", "kt": "knot (a speed) or kN (a force)"},
    **{"Newton": "write N", "Newtons": "write N", "Nm": "write N*m", "NM": "write N*m", "Nms": "write N*m*s"},
    **{"KN": "write kN", "kp": "write kgf", "Mpa": "write MPa", "MPA": "write MPa", "KPa": "write kPa", "PSI": "psi"},
    **{
        "PA": "write Pa",
        "HP": "write hp",
        "PS": "735.49875 W",
        "kWh": "write kW*h",
        "Ah": "write A*h",
        "cal": "4.184 J",
    },
    **{"cc": "write cm^3", "gal": "3.785411784 L (US)", "amp": "write A", "amps": "write A", "Volt": "write V"},
    **{"Watts": "write watts", "gauss": "1e-4 T", "mho": "write S", "c": "299792458 m/s for the speed of light"},
    **{"u": "µ before a unit", "Å": "1e-10 m", "k": "1e3 for a thousand", "kgm2": "write kg*m^2", "s2": "write s^2"},
    **{"ftlb": "write ft*lbf", "Lbf": "write lbf", "Bar": "write bar", "metr": "Did you mean", "secnd": "Did you mean"},
    **{
        "Ws": "write W*s, or J",
        "kWs": "write kW*s, or kJ",
        "Pas": "write Pa*s",
        "As": "write A*s",
        "bars": "write bar",
    },
    **{"parsec": "lengths are in m, km", "ly": "lengths are in m, km", "Hzs": "write Hz", "mols": "write mol"},
    **{"foots": "write foot", "inchs": "write inch", "furlong": "lengths are in m, km", "slugg": "Did you mean 'slug'"},
}


@pytest.mark.parametrize("unit", SLIPS)
def test_a_slip_of_the_pen_is_refused_with_what_was_meant(unit: str) -> None:
    with pytest.raises(ParseError) as caught:
        parse_quantity(f"200 {unit}", what="parameter 'm'")
    assert caught.value.code == "E408"
    assert SLIPS[unit] in (caught.value.fix or "")
    assert caught.value.place is not None and caught.value.place.column == 5


def test_the_place_in_a_file_is_shown() -> None:
    text = 'name = "a"\n[coordinates]\nx = "cart"\n[parameters]\nm = { value = "200 gr", description = "mass" }\n'
    with pytest.raises(ParseError) as caught:
        lg.loads(text, name="a.toml")
    said = str(caught.value)
    assert said.startswith("a.toml:5:20: ")
    assert said.splitlines()[1:3] == ['5 | m = { value = "200 gr", description = "mass" }', "  |                    ^"]
    assert said.endswith("Fix: write g")


def test_the_si_value_stands_beside_any_other_unit() -> None:
    text = """name = "a"
    [coordinates]
    x = "cart"
    [parameters]
    m = "200 g"
    k = "4 kN/mm"
    b = "5 N*s/m"
    alpha = "30 deg"
    w = "60 rpm"
    r = "3 mm/m"
    F = "10 lbf"
    [points]
    A = ["x", "0"]
    [[particle]]
    mass = "m"
    at = "A"
    [[spring]]
    k = "k"
    deflection = "x"
    """
    page = lg.loads(text).derive().to_text()
    for shown in (
        "200 g (0.2 kg)",
        "4 kN/mm (4·10⁶ N/m)",
        "30 deg (0.5236 rad)",
        "60 rpm (6.283 rad/s)",
        "3 mm/m (0.003)",
    ):
        assert shown in page
    assert "10 lbf (44.48 N)" in page
    assert "5 N·s/m\n" in page


def test_the_manual_lists_the_table() -> None:
    page = (pathlib.Path(__file__).parents[2] / "docs" / "model-file.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| [\w, ]+ \| (.*) \|$", page.partition("## Units")[2], flags=re.M)
    listed = re.sub(r"\([^)]*\)", "", " ".join(rows)).replace(" or ", " ").replace(",", " ").replace(";", " ").split()
    assert {*listed} - {"units"} == {name for symbols, *_ in TABLE for name in symbols.split()} | {"knot"}


@pytest.mark.parametrize("text", ["W*s", "W s", "W·s"])
def test_a_watt_second_is_a_joule(text: str) -> None:
    assert parse_quantity(f"2 {text}").dimension == parse_quantity("2 J").dimension
    assert parse_quantity(f"2 {text}").value == 2.0
