"""The unit of a multiplier of an expression: λ f is an energy, λ c a power; and that of the gap of a row."""

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.values.multiplier_units import units_of_gaps, units_of_multipliers


def bead(units: bool = True) -> lg.System:
    """A bead in x and y, and a wheel, with expressions of several units."""
    s = lg.System("bead")
    if units:
        x, y, phi = (s.coordinate(name, unit=unit) for name, unit in (("x", "m"), ("y", "m"), ("phi", "rad")))
        m, r, J = s.parameters("m r J", m="1 kg", r="0.5 m", J="0.1 kg*m^2")
    else:
        (x, y, phi), (m, r, J) = s.coordinates("x y phi"), s.parameters("m r J")
    P = s.point("P", (x, y))
    s.particle(m, P)
    s.rigid_body(m, J, at=s.origin, frame=s.frame(phi))
    s.constraint(x**2 + y**2 + r**2, name="circle")
    s.constraint(x - r * phi, name="wheel")
    s.constraint(sp.sin(phi) - 3, name="angle")
    s.constraint(between=(P, s.origin), distance=r, name="rod")
    s.velocity_constraint(y.diff() * sp.cos(phi) - x.diff() * sp.sin(phi), name="edge")
    return s


def test_a_multiplier_has_the_unit_of_energy_by_its_row() -> None:
    """J/m² = N/m, J/m = N, N m for a pure number, and W/(m/s) = N for a row on velocities; a rod says it itself."""
    assert units_of_multipliers(bead().model) == {"circle": "N/m", "wheel": "N", "angle": "N m", "edge": "N"}
    assert units_of_gaps(bead().model) == {"circle": "m^2", "wheel": "m", "angle": "", "rod": "m"}


def test_without_units_nothing_is_said() -> None:
    assert units_of_multipliers(bead(units=False).model) == {}
    assert units_of_gaps(bead(units=False).model) == {"rod": "m"}


def test_the_derivation_says_the_unit() -> None:
    d = lg.example("chaplygin-sleigh").derive()
    assert d.multipliers["knife edge"].unit == "N"
    assert "[N] is the generalized force per unit of" in str(d)


def test_a_gap_is_told_with_its_unit() -> None:
    """x² + y² + r² is r² = 0.25 m² at least, so that the nearest position misses by this."""
    s = lg.System("bead")
    x, y = s.coordinates("x y")
    r = s.parameter("r", "0.5 m")
    s.particle(s.parameter("m", "1 kg"), s.point("P", (x, y)))
    s.constraint(x**2 + y**2 + r**2, name="circle")
    with pytest.raises(lg.RunError, match=r"E304.*open in the nearest position: 'circle' by 0\.25 m\^2\)"):
        s.simulate(0.1, x=0.3)
