"""What pulls a body over a distance: a magnet or plate on the side to which it pulls; and shafts seen from the side."""

import numpy as np
import pytest

import lagrangian as lg
from built_in import picture
from lagrangian.page.placing import placed, places
from lagrangian.page.scene import Scene


def _middle(scene: Scene, **wanted: object) -> np.ndarray:
    parts = [p for p in scene.parts if all(getattr(p, key) == value for key, value in wanted.items())]
    return np.mean([n[-2:] for p in parts for _, n in placed(p, places(scene)) if n.size], axis=0)


def test_the_magnet_is_above_the_ball_and_the_plate_before_the_other_one() -> None:
    scene = picture("magnetic-levitation").scene
    magnet, ball = (_middle(scene, kind=kind, elements=(name,)) for kind, name in (("pull", "coil"), ("block", "ball")))
    assert magnet[1] < ball[1] - 40.0 and abs(magnet[0] - ball[0]) < 5.0
    scene = picture("capacitive-actuator").scene
    assert _middle(scene, kind="pull", role="ground")[0] > _middle(scene, kind="cart")[0] + 40.0
    assert sum(label.names == ("plates",) for label in scene.labels) == 2  # in the circuit, and where it pulls


@pytest.mark.parametrize("sign", [1, -1])
def test_a_coil_pulls_to_where_its_inductance_grows(sign: int) -> None:
    system = lg.System("solenoid")
    q, x = system.coordinate("q", unit="C"), system.coordinate("x")
    m, L, a = system.parameters("m L a")
    system.particle(m, at=system.point("plunger", (x, 0)))
    system.inductor(L * (1 + sign * x / a), q, name="coil")
    scene = system.look().scene
    assert (_middle(scene, kind="pull")[0] - _middle(scene, kind="cart")[0]) * sign > 30.0


def test_every_spring_and_loss_of_a_shaft_is_drawn_where_it_acts() -> None:
    system = lg.System("shaft")
    angles = system.coordinates("a b c")
    names = ("k1", "k2", "k0", "d1", "d2", "d3")
    k1, k2, k0, d1, d2, d3 = system.parameters(" ".join(names))
    frames = [system.frame(angle=x) for x in angles]
    for number, frame in enumerate(frames):
        system.rigid_body(1, at=system.origin, inertia=1, frame=frame, name=f"disc {number}")
    a, b, c = angles
    system.spring(k1, deflection=b - a, name="k1")
    system.spring(k2, deflection=c - b, name="k2")
    system.spring(k0, deflection=a, name="k0")
    for d, deflection, name in ((d1, b - a, "d1"), (d2, b, "d2"), (d3, c, "d3")):
        system.damper(d, deflection=deflection, name=name)
    found = system.look()
    assert not found.missing
    at = {name: _middle(found.scene, elements=(name,), role=role)[0] for name, role in zip(
        names, 3 * ["stiffness"] + 3 * ["damping"], strict=True)}  # fmt: skip
    left, middle, right = (_middle(found.scene, kind="disc", elements=(f"disc {n}",))[0] for n in range(3))
    assert at["k0"] < left < at["k1"] < middle < at["k2"] < right < at["d3"]
    assert left < at["d1"] < middle and abs(at["d2"] - middle) < 12.0


@pytest.mark.parametrize("sign", [1, -1])
def test_a_torque_on_a_shaft_turns_as_the_angle_does_or_against_it(sign: int) -> None:
    system = lg.System("shaft")
    frames = [system.frame(angle=x) for x in system.coordinates("a b")]
    for frame in frames:
        system.rigid_body(1, at=system.origin, inertia=1, frame=frame)
    system.torque(sign * system.input("tau"), on=frames[0])
    scene = system.look().scene
    tips = [next(p for p in scene.parts if p.kind == kind and p.solid) for kind in ("torque", "coordinate")]
    down = [p.shape.commands[0][1][1] - np.mean([n[1] for _, n in p.shape.commands[1:3]]) for p in tips]
    assert np.sign(down[0]) == sign * np.sign(down[1])


def test_what_moves_as_a_function_of_time_has_the_letters_of_that_motion() -> None:
    scene = picture("kapitza-pendulum").scene
    assert [x.names for x in scene.labels if x.role == "input"] == [("a", "omega")]


def test_time_is_no_letter_of_a_torque() -> None:
    system = lg.System("pendulum")
    theta = system.coordinate("theta")
    frame = system.frame(angle=theta)
    system.rigid_body(1, at=system.origin, inertia=1, frame=frame)
    system.torque(3 * system.t, on=frame)
    system.torque(2, on=frame, name="brake")
    assert [x.names for x in system.look().scene.labels if x.role == "input"] == [("brake",)]


def test_the_way_of_a_sliding_joint_is_measured_beside_what_slides() -> None:
    scene = picture("scara").scene
    arrow, shaft = (
        _middle(scene, kind="coordinate", elements=("d",)), _middle(scene, kind="link", elements=("shaft",))
    )  # fmt: skip
    assert abs(arrow[0] - shaft[0]) > 15.0
