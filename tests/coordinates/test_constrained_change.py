"""Constraints go along with a change of coordinates: the same rows, in the new letters."""

import numpy as np
import pytest

import lagrangian as lg
from constrained_systems import disc, rod
from lagrangian.errors import ModelError


def test_a_rod_in_polar_coordinates_holds_the_radius() -> None:
    old, new = rod().compile(), rod().in_coordinates({"x": "s*sin(a)", "y": "-s*cos(a)"})
    assert len(new.model.constraints) == 1
    c = new.compile()
    a, s = (c.coordinates.index(name) for name in ("a", "s"))
    q, v = np.zeros(2), np.zeros(2)
    q[a], q[s], v[a] = 0.4, 1.5, 0.7
    found = c.forward(q, v)
    assert found[a] == pytest.approx(-9.81 / 1.5 * np.sin(0.4), rel=1e-13) and abs(found[s]) < 1e-13
    there = [1.5 * np.sin(0.4), -1.5 * np.cos(0.4)], [1.5 * 0.7 * np.cos(0.4), 1.5 * 0.7 * np.sin(0.4)]
    assert c.multipliers(q, v)["rod"] == pytest.approx(old.multipliers(*there)["rod"], rel=1e-13)
    tension = 2.0 * (9.81 * np.cos(0.4) + 1.5 * 0.7**2)
    assert c.multipliers(q, v)["rod"] == pytest.approx(-tension, rel=1e-13)


def test_a_body_that_rolls_goes_along() -> None:
    system, _ = disc()
    new = system.in_coordinates({"psi": "psi + phi"})
    (floor,) = new.model.constraints
    (body,) = new.model.bodies
    assert floor.body.frame is body.frame and floor.body.at is body.at  # type: ignore[attr-defined]
    p = system.compile(), new.compile()
    source = np.random.default_rng(1)
    q, v = source.uniform(0.2, 0.9, 5), source.uniform(-1, 1, 5)
    q[:2] = 0.0
    q, v = p[1].assemble(q, v)
    onto = np.eye(5)
    onto[2, 4] = 1.0
    assert np.abs(onto @ p[1].forward(q, v) - p[0].forward(onto @ q, onto @ v)).max() < 1e-11
    ours, theirs = p[1].multipliers(q, v), p[0].multipliers(onto @ q, onto @ v)
    assert all(ours[name] == pytest.approx(theirs[name], rel=1e-10) for name in theirs)


def test_a_fixed_coordinate_cannot_be_replaced() -> None:
    s = lg.loads(rod().to_toml() + '\n[simulate]\ninitial = { x = 0.1 }\nfixed = ["x"]\n')
    assert s.in_coordinates({"y": "2*z"}).model.settings["fixed"] == ["x"]
    with pytest.raises(ModelError, match="'x', which \\[simulate\\] holds fixed") as error:
        s.in_coordinates({"x": "2*z"})
    assert error.value.code == "E210"


@pytest.mark.slow
def test_a_system_in_other_coordinates_is_the_same_system() -> None:
    there = rod().in_coordinates({"x": "2*z"})
    assert rod().compare(there) and there.compare(rod())
