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


def lamp() -> lg.System:
    """A body of 2 kg on a ball joint 0.5 m above its mass centre."""
    s = lg.System("lamp")
    shade = s.floating_frame("lamp")
    s.rigid_body(2.0, (0.1, 0.2, 0.3), at=shade.point(0, 0, -0.5), frame=shade)
    s.gravity((0, 0, -1), 9.81)
    s.ball((shade.origin, s.origin), name="hook")
    return s


@pytest.mark.slow
def test_a_lamp_on_a_ball_joint_hangs_or_stands_and_the_joint_bears_its_weight() -> None:
    """About x and y it swings with ω² = m g l/I, I = I_S + m l²; any turn about the vertical is as good."""
    rates = np.sqrt(9.81 / np.array([0.1 + 0.5, 0.2 + 0.5]))
    hangs, stands = lamp().equilibria(starts=64)
    for rest in (hangs, stands):
        assert rest.dimension == 1
        assert [rest[f"lamp_{k}"] for k in "xyz"] == pytest.approx([0, 0, 0], abs=1e-12)
        assert rest.multipliers["hook.z"] == pytest.approx(2 * 9.81, rel=1e-10)
        assert [rest.multipliers[f"hook.{k}"] for k in "xy"] == pytest.approx([0, 0], abs=1e-9)
    assert hangs.stability.stable is None and stands.stability.stable is False
    poles = lamp().linearize(hangs).poles
    assert sorted(np.abs(poles.imag))[::2] == pytest.approx([0.0, *np.sort(rates)], abs=1e-9)
    assert sorted(lamp().linearize(stands).poles.real)[-2:] == pytest.approx(np.sort(rates), abs=1e-9)


@pytest.mark.slow
def test_a_door_hangs_and_stands_on_its_axis_and_its_stable_rest_is_a_centre() -> None:
    """Two ball joints hold a floating leaf: ω² = m g_y r/I about the axis, g = 9.81 (0, 0.6, −0.8), r = √(0.5² + 0.1²).

    One of the six rows says again what the others say.
    """
    s = lg.System("door")
    leaf = s.floating_frame("leaf")
    s.rigid_body(3, (0.2, 0.4, 0.5), at=leaf.point(0.5, 0.1, 1), frame=leaf)
    s.gravity((0, 3, -4))
    s.ball((leaf.origin, s.origin), name="lower hinge")
    s.ball((leaf.point(0, 0, 2), s.origin + (0, 0, 2)), name="upper hinge")
    found = s.equilibria(starts=64)
    turned = sorted(2 * np.arctan2(rest["leaf_qz"], rest["leaf_qw"]) for rest in found)
    hanging = np.pi / 2 - np.arctan2(0.1, 0.5)
    assert turned == pytest.approx([hanging - np.pi, hanging], abs=1e-9)
    rate = np.sqrt(3 * 9.81 * 0.6 * np.hypot(0.5, 0.1) / (0.5 + 3 * 0.26))
    (centre,) = (rest for rest in found if rest["leaf_qz"] > 0)
    assert sorted(s.linearize(centre).poles.imag) == pytest.approx([-rate, rate], abs=1e-9)
    for rest in found:
        forces = [rest.multipliers[f"{end} hinge.z"] for end in ("lower", "upper")]
        assert sum(forces) == pytest.approx(3 * 9.81 * 0.8, rel=1e-10)


def test_floating_frames_beside_circuits_are_refused() -> None:
    system = plate()
    charge = system.coordinate("charge", unit="C")
    system.inductor(1e-3, charge)
    with pytest.raises(lg.RunError, match="a floating frame beside charges") as caught:
        system.equilibria()
    assert caught.value.code == "E202"
