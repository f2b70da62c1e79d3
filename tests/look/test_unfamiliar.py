"""Textbook systems that are no built-in examples, drawn by the general rules."""

from __future__ import annotations

from collections import Counter
from itertools import combinations
from math import sqrt

import numpy as np
import pytest
from sympy import Expr, cos, pi, sin

import lagrangian as lg
from lagrangian.graph import evaluate
from lagrangian.page.placing import placed, places
from lagrangian.page.scene import ScenePart

PLAIN = {"m": "1 kg", "M": "2 kg", "J": "0.02 kg*m^2", "l": "1 m", "r": "0.1 m", "h": "0.4 m", "d": "0.8 m",
         "k": "50 N/m", "c": "3 N*s/m", "w": "3 rad/s", "e": "0.1 m"}  # fmt: skip


def start(name: str, coordinates: str) -> tuple[lg.System, dict[str, Expr], tuple[Expr, ...]]:
    s = lg.System(name)
    q = s.coordinates(coordinates)
    p = dict(zip(PLAIN, s.parameters(" ".join(PLAIN), **PLAIN), strict=True))
    return s, p, q if isinstance(q, tuple) else (q,)


def moved(picture: lg.Picture, step: float = 0.0, t: float = 0.0) -> list[tuple[ScenePart, list[np.ndarray]]]:
    """Every part with its numbers on the screen, at coordinates beside the pose and a time."""
    program = picture.program
    q = [x + step for x in picture.pose.values()]
    groups = {"x": [*q, *[0.0] * len(q)], "u": [0.0] * len(program.inputs["u"]), "t": [t]}
    groups["p"] = [float(program.defaults[name]) for name in program.inputs["p"]]
    at = places(picture.scene, evaluate(program, groups)["r"])
    return [(part, [n for _, n in placed(part, at)]) for part in picture.scene.parts]


def coupled_pendulums() -> lg.System:
    """Two pendulums with a spring between (Taylor, Classical Mechanics, 11.4), the second one without a parent."""
    s, p, (a, b) = start("coupled pendulums", "a b")
    s.point("B", (p["d"], 0))
    one = s.point("P", (p["l"] * sin(a), -p["l"] * cos(a)))
    two = s.point("Q", (p["d"] + p["l"] * sin(b), -p["l"] * cos(b)))
    for at in (one, two):
        s.particle(p["m"], at=at)
    s.spring(p["k"], between=(one, two), rest=p["d"])
    s.gravity(direction=(0, -1), g=9.81)
    return s


def half_car() -> lg.System:
    """Bounce and pitch on two axles (Rao, Mechanical Vibrations, 5.4): the deflections are those of small angles."""
    s, p, (z, a, front, rear) = start("half car", "z a front rear")
    body = s.frame(a)
    centre = s.point("C", (0, z))
    s.point("Bf", (p["d"], 0), relative_to=centre, frame=body)
    s.point("Br", (-p["l"], 0), relative_to=centre, frame=body)
    s.rigid_body(p["M"], p["J"], at=centre, frame=body, name="body")
    for name, x, y in (("F", p["d"], front), ("R", -p["l"], rear)):
        s.particle(p["m"], at=s.point(name, (x, y - p["h"])), name=name)
        s.spring(p["k"], deflection=z + x * a - y, name=f"spring {name}")
        s.spring(p["k"], deflection=y, name=f"tyre {name}")
    return s


def rotor() -> lg.System:
    """A machine with an unbalance that turns at a given rate (Rao, 3.7)."""
    s, p, (y,) = start("unbalance", "y")
    turn = p["w"] * s.t
    s.particle(p["M"], at=s.point("H", (0, y)), name="housing")
    s.particle(p["m"], at=s.point("U", (p["e"] * cos(turn), y + p["e"] * sin(turn))), name="unbalance")
    s.spring(p["k"], deflection=y)
    return s


def hole() -> lg.System:
    """A mass on a table, joined through a hole to one that hangs (Goldstein, 1.19 of the second edition)."""
    s, p, (rho, phi) = start("hole", "rho phi")
    s.particle(p["m"], at=s.point("P", (rho * cos(phi), rho * sin(phi), 0)), name="disc")
    s.particle(p["M"], at=s.point("Q", (0, 0, rho - 2 * p["l"])), name="load")
    s.gravity(direction=(0, 0, -1), g=9.81)
    return s


def reaction_wheel() -> lg.System:
    """A pendulum that a wheel at its end swings up (Spong, Corke, Lozano, Automatica 37, 2001)."""
    s, p, (a, b) = start("reaction wheel", "a b")
    arm = s.frame(a)
    wheel = s.frame(b, parent=arm)
    s.rigid_body(p["m"], p["J"], at=s.point("C", (0, -p["h"]), frame=arm), frame=arm, name="arm")
    s.rigid_body(p["M"], p["J"], at=s.point("W", (0, -p["l"]), frame=arm), frame=wheel, name="wheel")
    s.gravity(direction=(0, -1), g=9.81)
    return s


def bead_on_rod() -> lg.System:
    """A bead on a turning rod, with a spring (Marion and Thornton, example 7.11)."""
    s, p, (a, x) = start("bead", "a x")
    rod = s.frame(a)
    s.rigid_body(p["M"], p["J"], at=s.point("O", (0, 0)), frame=rod, name="rod")
    s.particle(p["m"], at=s.point("P", (x, 0), frame=rod), name="bead")
    s.spring(p["k"], deflection=x - p["h"])
    return s


def disk_with_pendulum() -> lg.System:
    """A pendulum on the axle of a rolling disk (Landau and Lifshitz, §5, problem 2, with a disk for the slider)."""
    s, p, (x, a) = start("disk", "x a")
    s.rigid_body(p["M"], p["J"], at=s.point("A", (x, p["r"])), frame=s.frame(-x / p["r"]), name="disk")
    s.particle(p["m"], at=s.point("P", (x + p["l"] * sin(a), p["r"] - p["l"] * cos(a))), name="bob")
    s.gravity(direction=(0, -1), g=9.81)
    return s


def hoist() -> lg.System:
    """A load on a string over a pulley, whose other end is tied to the ground by a spring (Rao, problem 2.6)."""
    s, p, (a,) = start("hoist", "a")
    s.rigid_body(p["M"], p["J"], at=s.point("O", (0, 0)), frame=s.frame(-a), name="pulley")
    s.particle(p["m"], at=s.point("P", (p["r"], -p["r"] * a - p["h"])), name="load")
    s.spring(p["k"], deflection=p["r"] * a)
    s.damper(p["c"], deflection=p["r"] * a)
    s.gravity(direction=(0, -1), g=9.81)
    return s


def geared_arm() -> lg.System:
    """An arm that a motor drives through a pair of gears (Spong, Hutchinson, Vidyasagar, Robot Modeling, 7.1)."""
    s, p, (a,) = start("geared arm", "a")
    n = s.parameter("n", 4)
    s.rigid_body(p["M"], p["J"], at=s.point("O", (-p["d"], 0)), frame=s.frame(-n * a), name="motor")
    s.particle(p["m"], at=s.point("P", (p["l"] * sin(a), -p["l"] * cos(a))), name="load")
    s.gravity(direction=(0, -1), g=9.81)
    return s


SYSTEMS = {
    "geared arm": (geared_arm, {"gear": 1, "rod": 1, "wheel": 2}),
    "hoist": (hoist, {"rope": 2, "spring": 1, "damper": 1, "wheel": 2}),
    "coupled pendulums": (coupled_pendulums, {"rod": 2, "spring": 1}),
    "half car": (half_car, {"spring": 4, "link": 2}),
    "unbalanced rotor": (rotor, {"ball": 1, "block": 1}),
    "string through a hole": (hole, {"rope": 2, "hole": 1}),
    "reaction wheel": (reaction_wheel, {"wheel": 2}),
    "bead on a rod": (bead_on_rod, {"beam": 2, "ball": 1}),
    "disk with a pendulum": (disk_with_pendulum, {"rod": 1, "wheel": 2}),
}


@pytest.mark.parametrize("name", SYSTEMS)
def test_an_unfamiliar_system_is_drawn_whole(name: str) -> None:
    made, kinds = SYSTEMS[name]
    picture = made().look()
    assert picture.missing == ()
    found = Counter(part.kind for part in picture.scene.parts)
    assert {kind: found[kind] for kind in kinds} == kinds


def test_rods_of_pendulums_keep_their_lengths_and_their_angles_are_arcs() -> None:
    picture = coupled_pendulums().look()
    for step in (0.0, 0.4):
        rods = [n for part, n in moved(picture, step) if part.kind == "rod"]
        assert [np.hypot(*(b - a)) for a, b in rods] == pytest.approx([picture.scene.scale] * 2)
    assert "on a curve" not in picture.description


def test_springs_of_a_half_car_reach_from_the_body_to_the_wheels() -> None:
    picture = half_car().look(pose={"a": 0})
    for part, numbers in moved(picture):
        if part.kind == "spring":
            (x0, _), (x1, _) = numbers[0], numbers[-1]
            assert x0 == pytest.approx(x1, abs=1e-6)


def test_an_unbalance_goes_round_on_its_housing() -> None:
    picture = rotor().look()
    for t in (0.0, pi / 6, pi / 3):
        spots = {part.kind: n[0] for part, n in moved(picture, 0.1, float(t)) if part.kind in ("ball", "block")}
        centre = next(n[0] for part, n in moved(picture, 0.1) if part.kind == "driven" and part.solid and len(n) == 1)
        far = np.hypot(*(spots["ball"][:2] - centre[:2]))
        assert far == pytest.approx(0.1 * picture.scene.scale)


def test_a_string_through_a_hole_keeps_its_length_in_space() -> None:
    picture = hole().look()
    view = np.array(picture.scene.view)
    up = np.linalg.norm(view @ [0, 0, 1])
    hanging = [max(np.hypot(*(n[1] - n[0])) for part, n in moved(picture, step) if part.kind == "rope")
               for step in (0.0, 0.2)]  # fmt: skip
    assert hanging[0] - hanging[1] == pytest.approx(0.2 * up * picture.scene.scale)
    assert "a string from the disc through a hole to the load" in picture.description.lower()


def test_a_reaction_wheel_has_the_radius_of_its_inertia() -> None:
    picture = reaction_wheel().look()
    radii = [n[2] for part, numbers in moved(picture) for n in numbers if part.kind == "wheel" and len(n) == 3]
    assert radii == pytest.approx([sqrt(2 * 0.02 / 2) * picture.scene.scale])


def test_both_ends_of_a_hoist_move_alike_and_its_string_touches_the_rim() -> None:
    picture = hoist().look()
    radius = 0.1 * picture.scene.scale
    ends: dict[float, list[float]] = {}
    for step in (0.0, 0.3):
        parts = moved(picture, step)
        (wheel,) = [n[0] for part, n in parts if part.kind == "wheel" and len(n) == 1]
        ropes = sorted(([n[0], n[1]] for part, n in parts if part.kind == "rope"), key=lambda rope: rope[0][0])
        assert [rope[0][0] - wheel[0] for rope in ropes] == pytest.approx([-radius, radius])
        assert [rope[0][1] - wheel[1] for rope in ropes] == pytest.approx([0.0, 0.0], abs=1e-6)
        ends[step] = [float(rope[1][1]) for rope in ropes]
    left, right = (ends[0.3][i] - ends[0.0][i] for i in (0, 1))
    assert right == pytest.approx(0.3 * radius) and left == pytest.approx(-0.3 * radius)
    assert "a string from the load to the rim of the pulley" in picture.description.lower()


def test_the_pitch_circles_of_a_geared_arm_meet_in_the_ratio_of_the_turns() -> None:
    picture = geared_arm().look()
    (wheel,) = [n[0] for part, n in moved(picture) if part.kind == "wheel" and len(n) == 1]
    (circle,) = [
        np.concatenate([x.reshape(-1, 2)[-1:] for x in n]) for part, n in moved(picture) if part.kind == "gear"
    ]
    spots = np.unique(circle.round(6), axis=0)  # evenly spaced on the circle
    centre = spots.mean(axis=0)
    radius = np.hypot(*(spots[0] - centre))
    assert radius == pytest.approx(4 * wheel[2], rel=0.02)
    assert np.hypot(*(centre - wheel[:2])) == pytest.approx(radius + wheel[2], rel=0.02)
    assert "a gear between the motor and the rod of the load" in picture.description.lower()


@pytest.mark.parametrize("name", SYSTEMS)
def test_no_label_of_an_unfamiliar_system_meets_another(name: str) -> None:
    boxes = [label.box for label in SYSTEMS[name][0]().look().scene.labels]
    for (x, y, w, h), (a, b, c, d) in combinations(boxes, 2):
        assert x + w <= a or a + c <= x or y + h <= b or b + d <= y


def test_a_rod_lies_before_the_disk_on_whose_axle_it_hangs() -> None:
    kinds = [part.kind for part in disk_with_pendulum().look().scene.parts]
    assert kinds.index("rod") > kinds.index("wheel")


def test_a_ceiling_that_time_moves_has_a_double_arrow() -> None:
    for shaken in (False, True):
        s, p, (y,) = start("ceiling", "y")
        s.particle(p["m"], at=s.point("P", (0, -p["h"] - y)))
        s.spring(p["k"], deflection=y - (p["e"] * sin(p["w"] * s.t) if shaken else 0))
        assert sum(part.kind == "driven" for part in s.look().scene.parts) == (4 if shaken else 0)
