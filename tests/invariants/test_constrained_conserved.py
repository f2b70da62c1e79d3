"""Conserved quantities of systems with constraints, and the forms that such systems do not have."""

import pytest
import sympy as sp

import lagrangian as lg
from constrained_systems import G, cart_pole, disc, rod, sleigh
from lagrangian.dynamics import canonical
from lagrangian.errors import ModelError


def names(system, **options):
    return {c.name: c for c in system.conserved_quantities(**options)}


def test_a_rod_takes_the_momenta_and_leaves_the_energy() -> None:
    found = rod().conserved_quantities()
    assert [c.kind for c in found] == ["energy"]
    assert found[0].drift is not None and found[0].drift < 1e-9
    assert "the constraints do no work" in str(found[0].reason)
    said = [str(why).replace("(t)", "") for why in found.missed]
    assert any("x, but its momentum changes because the constraint 'rod' pushes along x" in why for why in said)


@pytest.mark.slow
def test_a_ball_in_a_bowl_keeps_its_angular_momentum() -> None:
    s = lg.System("bowl")
    m, l = s.parameter("m", 1.5), s.parameter("l", 0.8)
    x, y, z = (s.coordinate(n) for n in "xyz")
    s.particle(m, at=s.origin + (x, y, z))
    s.gravity((0, 0, -1), s.parameter("g", G))
    s.constraint(x**2 + y**2 + z**2 - l**2, name="bowl")
    found = s.conserved_quantities()
    assert sorted(c.kind for c in found) == ["energy", "turn"]
    turn = next(c for c in found if c.kind == "turn")
    ratio = sp.simplify(turn.expression / (m * (x * y.diff() - y * x.diff())))
    assert ratio.is_number and ratio != 0
    assert all(c.drift is not None and c.drift < 1e-9 for c in found)


@pytest.mark.slow
def test_a_constraint_that_moves_with_time_drives() -> None:
    s = lg.System("driven")
    x, y = s.coordinate("x"), s.coordinate("y")
    s.particle(s.parameter("m", 1.0), at=s.origin + (x, y))
    s.constraint(x - sp.sin(sp.Symbol("t")), name="drive")
    found = s.conserved_quantities()
    assert [c.name for c in found] == ["momentum of y"]
    assert any("the energy changes because the constraint 'drive' pushes" in str(why) for why in found.missed)


@pytest.mark.slow
def test_rows_on_velocities_take_momenta_as_well() -> None:
    assert "energy" in {c.kind for c in disc()[0].conserved_quantities()}
    found = sleigh().conserved_quantities()
    assert [c.name for c in found] == ["momentum of theta"]  # the edge lies below the centre of mass
    said = [str(why).replace("(t)", "") for why in found.missed]
    assert any("y, but its momentum changes because the constraint 'edge' pushes" in why for why in said)


@pytest.mark.slow
def test_redundant_coordinates_lose_no_quantity() -> None:
    plain = names(cart_pole(redundant=False), params={"b": 0})
    found = names(cart_pole(redundant=True), params={"b": 0})
    assert "energy T* + V" in plain and "energy T* + V" in found
    assert any(c.kind == "momentum" for c in plain.values())
    assert any(c.kind == "total momentum" for c in found.values())


@pytest.mark.parametrize("verb", ["hamiltonian", "routhian"])
def test_forms_of_independent_coordinates_are_refused(verb: str) -> None:
    with pytest.raises(ModelError, match="the constraints 'rod' leave those of system 'rod' dependent") as error:
        getattr(rod(), verb)()
    assert error.value.code == "E202"


def test_momenta_of_dependent_coordinates_are_not_integrated() -> None:
    with pytest.raises(ModelError, match="leave its momenta dependent"):
        canonical(rod().model, {})
