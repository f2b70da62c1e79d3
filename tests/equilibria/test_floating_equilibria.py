"""Equilibria of floating frames: a quadrotor that hovers, a plate on springs, and what is refused."""

import numpy as np
import pytest

import lagrangian as lg


def hovering(*, thrust: float) -> lg.System:
    """A body of 0.8 kg whose thrust pushes along its own z, with torques about its axes."""
    s = lg.System("quadrotor")
    body, F = s.floating_frame("body"), s.input("F")
    s.rigid_body(0.8, (0.005, 0.006, 0.009), at=body.origin, frame=body)
    s.gravity(direction=(0, 0, -1), g=9.81)
    s.force((0, 0, thrust * F), at=body.origin, axes=body)
    return s


def plate() -> lg.System:
    """A plate on four upright springs without length, 1 m by 0.8 m apart: z = −m g/4k, whatever else."""
    s = lg.System("plate")
    top, k = s.floating_frame("top"), s.parameter("k", 400.0)
    s.rigid_body(2.0, (0.1, 0.12, 0.2), at=top.origin, frame=top)
    s.gravity(direction=(0, 0, -1), g=9.81)
    for i, (x, y) in enumerate(((0.5, 0.4), (0.5, -0.4), (-0.5, 0.4), (-0.5, -0.4))):
        s.spring(k, between=(s.origin + (x, y, 0), top.point(x, y, 0)), name=f"k{i}")
    return s


@pytest.mark.slow
def test_a_quadrotor_hovers_upright_at_any_place_and_heading() -> None:
    found = hovering(thrust=1.0).equilibria(inputs={"F": 0.8 * 9.81})
    assert len(found) == 1
    (rest,) = found
    assert {name for direction in found.free for name in direction} == {"body_x", "body_y", "body_z"}
    assert rest.dimension == 1
    assert rest.moves == ("body_qz", "body_qw")
    assert [rest[f"body_q{k}"] for k in "xyzw"] == pytest.approx([0, 0, 0, 1], abs=1e-9)
    linear = hovering(thrust=1.0).linearize(rest)
    assert linear.A.shape == (12, 12)
    assert linear.kind == "rest"


@pytest.mark.slow
def test_a_plate_on_springs_rests_level_and_turned_over_about_each_axis() -> None:
    """With springs along gravity and without length at rest, half a turn about each axis balances as well.

    About the level one the heave frequency is √(4k/m), and roll and pitch have K = 4k y², 4k x².
    """
    system = plate()
    found = system.equilibria()
    turned = {tuple(np.round([rest[f"top_q{k}"] for k in "xyzw"], 9) + 0.0) for rest in found}
    assert turned == {(0, 0, 0, 1), (0, 0, 1, 0), (0, 1, 0, 0), (1, 0, 0, 0)}
    for rest in found:
        assert rest["top_z"] == pytest.approx(-2 * 9.81 / 1600, rel=1e-9)
        assert rest["top_x"] == pytest.approx(0, abs=1e-12)
    level = next(rest for rest in found if rest["top_qw"] == 1)
    shifted = [1600 / 2] * 3  # x, y and z alike, because springs without length pull by k in every direction
    turns = [1600 * 0.16 / 0.1, 1600 * 0.25 / 0.12, 1600 * (0.16 + 0.25) / 0.2]
    poles = np.sort(np.abs(system.linearize(level).poles.imag))[::2]
    np.testing.assert_allclose(poles, np.sort(np.sqrt([*shifted, *turns])), rtol=1e-7)
    assert not [rest for rest in found if rest is not level and rest.stability.stable is not False]
    assert "Each was found from 5 starts" in found.to_text()


@pytest.mark.slow
def test_a_body_that_falls_has_no_equilibrium() -> None:
    found = hovering(thrust=1.0).equilibria(starts=64)
    assert len(found) == 0
    assert any("no equilibrium" in note for note in found.notes)


def test_floating_frames_under_constraints_are_refused() -> None:
    system = plate()
    system.constraint(system["top_x"], name="wall")
    with pytest.raises(lg.RunError, match="beside constraints or charges") as caught:
        system.equilibria()
    assert caught.value.code == "E202"
