"""Runs and ensembles of constrained systems start on their constraints; what moved is told."""

import math

import numpy as np
import pytest

import built_in
import lagrangian as lg
from lagrangian.errors import RunError
from lagrangian.integrate.status import RunStatus


def bob() -> lg.System:
    s = lg.System("pendulum in x, y")
    x, y = s.coordinates("x y")
    m, length = s.parameters("m l", m="1 kg", l="2 m")
    at = s.point("P", (x, y))
    s.particle(m, at=at)
    s.gravity()
    s.constraint(between=(at, s.origin), distance=length, name="rod")
    return s


def test_a_rough_guess_is_moved_and_told() -> None:
    run = bob().simulate(2.0, x=0.5, y=-1.7)
    assert run.success and run["x**2 + y**2"] == pytest.approx(np.full(1001, 4.0), abs=1e-12)
    assert run["x"][0] / run["y"][0] == pytest.approx(-0.5 / 1.7)
    (notice,) = run.notices
    assert notice.code == "E303" and "y from -1.7 to -1.91" in str(notice) and "x from 0.5 to 0.564" in str(notice)


def test_of_what_was_moved_the_given_values_are_named() -> None:
    """x' was given and becomes smaller; y' and others that follow are counted."""
    s = bob()
    run = s.simulate(0.1, x=1.2, y=-1.6, initial={"x'": 1.0})
    (notice,) = run.notices
    assert "x' from 1 to 0.64" in str(notice) and "and 1 more" in str(notice)


def test_an_exact_start_is_left_alone_and_nothing_is_said() -> None:
    run = bob().simulate(1.0, x=2.0, y=0.0)
    assert run.notices == () and run["x"][0] == 2.0


def test_fixed_coordinates_stay_to_the_last_digit() -> None:
    run = bob().simulate(1.0, x=0.3, y=-1.0, fixed="x")
    assert run["x"][0] == 0.3 and run["y"][0] == pytest.approx(-math.sqrt(4 - 0.09))


def test_fixed_is_read_from_the_file_and_written_to_it() -> None:
    s = lg.loads(bob().to_toml() + '\n[simulate]\nduration = "1 s"\ninitial = { x = 0.3, y = -1 }\nfixed = ["x"]\n')
    assert s.simulate()["x"][0] == 0.3
    assert lg.loads(s.to_toml()).simulate()["x"][0] == 0.3


@pytest.mark.slow
def test_every_run_of_an_ensemble_starts_on_its_constraints() -> None:
    s = bob()
    x = np.array([0.1, 0.5, 1.0])
    runs = s.ensemble(1.0, x=x, y=-1.5, fixed=["x"], outputs=["x", "x**2 + y**2"], reduce=None, times=11)
    assert runs["x"][:, 0] == pytest.approx(x, abs=0)
    assert runs["x**2 + y**2"] == pytest.approx(np.full((3, 11), 4.0), abs=1e-11)
    alone = s.simulate(1.0, x=0.5, y=-1.5, fixed=["x"], samples=11)
    assert runs["x"][1] == pytest.approx(alone["x"], abs=1e-12)


@pytest.mark.slow
def test_lengths_that_vary_have_starts_of_their_own() -> None:
    runs = bob().sweep(1.0, {"l": [1.0, 2.0, 3.0]}, initial={"x": 0.3, "y": -1}, outputs=["x**2 + y**2"])
    assert runs["final x**2 + y**2"] == pytest.approx([1.0, 4.0, 9.0])


def test_a_run_that_cannot_close_fails_alone() -> None:
    runs = bob().sweep(1.0, {"x": [0.3, 5.0]}, initial={"y": -1}, fixed="x", outputs=["x"])
    assert runs.status.tolist() == [0, RunStatus.OPEN]
    assert np.isnan(runs["final x"][1]) and "satisfies the constraints" in runs.failures()[0].reason


def test_one_run_that_cannot_close_is_an_error_that_says_what_holds_it_open() -> None:
    with pytest.raises(RunError, match="E304") as caught:
        bob().simulate(1.0, x=5.0, y=-1.0, fixed="x")
    assert "do not hold x fixed" in str(caught.value)


@pytest.mark.parametrize(("fixed", "said"), [("z", "no coordinate 'z'"), (["x'"], "no coordinate")])
def test_what_cannot_be_held_is_said(fixed: object, said: str) -> None:
    with pytest.raises(RunError, match=said):
        bob().simulate(1.0, x=2.0, fixed=fixed)  # type: ignore[arg-type]


def test_a_system_without_constraints_takes_no_fixed_coordinates() -> None:
    with pytest.raises(RunError, match="has no constraints"):
        built_in.system("pendulum").simulate(1.0, theta=0.2, fixed="theta")


def test_a_radius_of_zero_is_refused() -> None:
    s = lg.System("wheel")
    x, phi = s.coordinates("x phi")
    r = s.parameter("r", "0.3 m")
    s.kinetic(x.diff() ** 2 / 2 + s.parameter("J", "1 kg*m^2") * phi.diff() ** 2 / 2)
    s.velocity_constraint(r * phi.diff(), name="locked")
    assert s.simulate(1.0, initial={"x'": 1.0})["x"][-1] == pytest.approx(1.0)
    with pytest.raises(RunError, match=r"'locked'.* is 0"):
        s.simulate(1.0, params={"r": 0.0})


def test_a_rod_whose_ends_coincide_gets_a_direction() -> None:
    run = bob().simulate(1.0)
    assert run.success and run["x**2 + y**2"] == pytest.approx(np.full(1001, 4.0), abs=1e-12)
    runs = bob().ensemble(1.0, x=[0.0, 1.0], outputs=["x**2 + y**2"])
    assert runs.success and runs["final x**2 + y**2"] == pytest.approx([4.0, 4.0])
