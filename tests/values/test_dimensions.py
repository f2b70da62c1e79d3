"""Units that fit and units that do not, found by solving for the dimensions."""

import pytest
from sympy import cos, sin

import lagrangian as lg
from lagrangian import ModelError
from lagrangian.values.dimensions import check_dimensions


def pendulum(**units: str) -> lg.System:
    given = {"m": "1 kg", "L": "0.5 m", "k": "40 N/m", "b": "2 N*s/m"} | units
    s = lg.System("pendulum")
    th = s.coordinates("theta")
    m, L, k, b = s.parameters("m L k b", **given)
    tau = s.input("tau", unit="N*m")
    s.particle(m, s.origin + (L * sin(th), -L * cos(th)))
    s.gravity()
    s.spring(k, deflection=L * th)
    s.damper(b, deflection=L * th)
    s.torque(tau, on=th)
    return s


def test_units_that_fit_are_accepted() -> None:
    assert check_dimensions(pendulum().model) is not None


def test_without_units_nothing_is_said() -> None:
    s = lg.System("bare")
    x = s.coordinates("x")
    s.particle(s.parameters("m"), s.origin + (x, 0))
    assert check_dimensions(s.model) is None


@pytest.mark.parametrize(
    ("units", "fragments"),
    [
        ({"m": "1 m"}, ["particle 'm'", "mass", "unit m", "kg"]),
        ({"L": "2 kg"}, ["position", "kg", "m"]),
        ({"k": "40 N*m"}, ["spring 'k'", "stiffness", "N/m"]),
        ({"b": "3 kg"}, ["damper 'b'", "damping", "N s/m"]),
    ],
)
def test_a_unit_that_does_not_fit_is_an_error_with_its_element(units: dict[str, str], fragments: list[str]) -> None:
    with pytest.raises(ModelError) as caught:
        pendulum(**units).derive()
    assert all(f in str(caught.value) for f in fragments), str(caught.value)


def test_a_sum_of_different_units_is_an_error() -> None:
    s = lg.System("sum")
    x = s.coordinate("x", unit="m")
    m, c = s.parameter("m", "1 kg"), s.parameter("c", "1 s")
    s.particle(m, s.origin + (x + c, 0))
    with pytest.raises(ModelError, match="position"):
        s.derive()


def test_a_bare_number_may_be_a_length() -> None:
    s = lg.System("numbers")
    th = s.coordinates("theta")
    m = s.parameter("m", "1 kg")
    s.particle(m, s.origin + (0.5 * sin(th), -0.5 * cos(th)))
    s.gravity()
    assert s.derive().equations


def test_half_a_length_is_a_length() -> None:
    def rod(L: str) -> lg.System:
        s = lg.System("rod")
        th = s.coordinates("theta")
        m, length = s.parameter("m", "1 kg"), s.parameter("L", L)
        s.rigid_body(m, m * length**2 / 12, at=s.origin + (length / 2 * cos(th), length / 2 * sin(th)), frame=th)
        s.gravity()
        return s

    assert "dimensions" in str(rod("1 m").derive().verified[-1].what)
    with pytest.raises(ModelError, match="kg"):
        rod("1 kg").derive()


def test_a_bare_stiffness_is_no_error_but_the_terms_are_not_compared() -> None:
    s = lg.System("bare stiffness")
    x = s.coordinate("x", unit="m")
    s.particle(s.parameter("m", "1 kg"), s.origin + (x, 0))
    s.potential(50 * x**2)
    assert not any("dimensions" in str(check.what) for check in s.derive().verified)


@pytest.mark.parametrize("unit", ["deg", "mm"])
def test_a_coordinate_in_another_unit_than_si_is_refused(unit: str) -> None:
    s = lg.System("degrees")
    x = s.coordinate("x", unit=unit)
    s.particle(s.parameters("m"), s.origin + (x, 0))
    with pytest.raises(ModelError, match=f"'x' has the unit {unit}"):
        s.derive()


def test_a_value_is_shown_in_the_unit_it_was_given_in() -> None:
    s = pendulum(L="250 mm")
    page = s.derive().to_text()
    assert "250 mm" in page and "0.25 mm" not in page


def test_an_angle_in_a_sine_may_be_a_ratio_of_lengths() -> None:
    s = lg.System("wheel")
    x = s.coordinate("x", unit="m")
    m, R = s.parameter("m", "1 kg"), s.parameter("R", "0.2 m")
    s.particle(m, s.origin + (x + R * sin(x / R), R * cos(x / R)))
    assert s.derive().equations


@pytest.mark.parametrize("mass", [None, "1 kg"])
def test_a_bare_number_for_a_length_is_refused_only_where_units_were_given(mass):
    """A pendulum of length 1 without a parameter for it: θ̈ + g sin θ = 0 after division by m."""
    system = lg.System("pendulum")
    theta = system.coordinates("theta")
    m = system.parameter("m", mass)
    system.particle(m, at=system.origin + (sin(theta), -cos(theta)))
    system.gravity()
    if mass is None:
        (equation,) = system.derive().equations
        assert (equation.lhs - m * (theta.diff().diff() + system["g"] * sin(theta))).expand() == 0
    else:
        with pytest.raises(lg.ModelError, match="a number has no unit: multiply by a parameter"):
            system.derive()


@pytest.mark.parametrize("kind", ["spring", "damper", "force"])
def test_a_deflection_of_terms_that_do_not_fit_is_refused_with_the_element(kind: str) -> None:
    s = lg.System("stretched")
    x = s.coordinates("x")
    m, k = s.parameters("m k", m="1 kg", k="1 N/m")
    s.particle(m, s.origin + (x, 0))
    getattr(s, kind)(k, deflection=x + m * x)
    with pytest.raises(ModelError, match=rf"{kind} 'k': the units inside its deflection, .* do not fit") as caught:
        check_dimensions(s.model)
    assert caught.value.code == "E408"


def test_a_unit_that_does_not_fit_in_a_named_point_of_a_file_is_shown_there() -> None:
    """The pin, which also has the point, comes far below."""
    text = """name = "m"
[coordinates]
phi = "crank"
x = "block"
[parameters]
m = "1 kg"
d = "2 m"
[points]
A = ["d*cos(phi)", "d + m*sin(phi)"]
B = ["x", 0]
[[particle]]
mass = "m"
at = "B"
[[pin]]
between = ["A", "B"]
"""
    with pytest.raises(lg.ModelError, match="point 'A': the units inside its position") as error:
        lg.loads(text).derive()
    assert error.value.place is not None and error.value.place.line == 9
