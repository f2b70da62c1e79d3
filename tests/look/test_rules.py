"""The rules of pictures: what is drawn as what, where coordinates count from, and labels that meet nothing."""

from collections import Counter
from itertools import combinations

import numpy as np
import pytest
from sympy import cos, sin

import built_in
import lagrangian as lg
from built_in import SOME, SPACE, picture
from lagrangian.examples import names
from lagrangian.look.board import Board
from lagrangian.look.holds import Motions
from lagrangian.look.kinematics import Kinematics
from lagrangian.look.labels import crosses, placed_labels
from lagrangian.look.scenes import PLANE
from lagrangian.look.velocities import complement
from lagrangian.page.scene import Scene

IN_THE_PLANE = [name for name in names() if name not in SPACE]

UNDRAWN = {"planar-quadrotor": ("force 'drag' is not drawn, because it is nothing at rest",)}
"""What is not drawn of an example, as its picture says."""


def _kinds(scene: Scene, *wanted: str) -> Counter[str]:
    return Counter(part.kind for part in scene.parts if part.kind in wanted)


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", IN_THE_PLANE)
def test_nothing_of_an_example_in_the_plane_is_left_out(name: str) -> None:
    assert picture(name).missing == UNDRAWN.get(name, ())


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", IN_THE_PLANE)
def test_every_coordinate_has_a_label(name: str) -> None:
    system = built_in.system(name)
    labels = {x for label in picture(name).scene.labels if label.role == "coordinate" for x in label.names}
    assert labels == {c.name for c in system.model.coordinates}


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", names())
def test_no_label_meets_another(name: str) -> None:
    boxes = [(label.names, label.box) for label in picture(name).scene.labels]
    for (first, (x, y, w, h)), (second, (a, b, c, d)) in combinations(boxes, 2):
        apart = x + w <= a or a + c <= x or y + h <= b or b + d <= y
        assert apart, f"{first} meets {second}"
    for part in picture(name).scene.parts:
        if part.kind == "leader":
            (_, a), (_, b) = part.shape.commands
            assert not any(crosses(box, a, b) for _, box in boxes)


@pytest.mark.parametrize(
    ("absolute", "relative"),
    [
        ("double-pendulum", "double-pendulum-relative"),
        ("triple-pendulum", "triple-pendulum-relative"),
        ("lecture-2-absolute", "lecture-2"),
        ("lecture-3a", "lecture-3b"),
    ],
)
def test_two_sets_of_coordinates_show_the_same_bodies(absolute: str, relative: str) -> None:
    kinds = ("ball", "rod", "cart", "spring", "link", "pin", "joint", "force", "torque", "floor")
    first, second = (picture(name).scene for name in (absolute, relative))
    assert _kinds(first, *kinds) == _kinds(second, *kinds)


def _arc_ends(scene: Scene, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Where the arc of a coordinate begins and where its arrow ends."""
    arcs = [p for p in scene.parts if p.kind == "coordinate" and name in p.elements]
    bow, arrow = (next(p for p in arcs if p.solid is solid) for solid in (False, True))
    return np.array(bow.shape.commands[0][1]), np.array(arrow.shape.commands[0][1])


def _towards(scene: Scene, joint: np.ndarray, spot: np.ndarray) -> float:
    """The angle, counter-clockwise from x, in which a spot of the picture is seen from a point of the system [m]."""
    at = np.array(scene.origin) + scene.scale * (np.array(scene.view) @ joint)
    d = spot - at
    return float(np.arctan2(-d[1], d[0]))


def test_an_absolute_angle_counts_from_the_fixed_direction_and_a_relative_one_from_the_rod_before_it() -> None:
    pose = {"theta1": 0.4, "theta2": 0.7}
    for name, first in (("double-pendulum", 0.0), ("double-pendulum-relative", 0.4)):
        system = built_in.system(name)
        scene = system.look(pose=pose).scene
        L1 = system.model.values[system["L1"]]
        joint = np.array([L1 * np.sin(0.4), -L1 * np.cos(0.4)])
        start, end = _arc_ends(scene, "theta2")
        assert _towards(scene, joint, start) == pytest.approx(-np.pi / 2 + first, abs=1e-9)
        assert _towards(scene, joint, end) == pytest.approx(-np.pi / 2 + first + 0.7, abs=1e-9)


def test_points_that_are_added_are_seen_as_if_they_had_been_there() -> None:
    """Only their own places are computed, and in one system all of them at once for comparison."""
    known = Kinematics(built_in.system("crane").model)
    q, p = np.array([0.3, 1.2, 0.4]), known.parameters()
    before = known.views([q], p)
    for parent in (1, 2):
        known.add(parent, (0.2, parent * known.model.parameters[0].symbol), None)
    grown, whole = known.views([q], p, known=before), known.views([q], p)
    for name in ("r", "J", "rt", "R", "RJ"):
        assert np.array_equal(getattr(grown, name), getattr(whole, name))
    assert grown.r.shape[1] == before.r.shape[1] + 2


def test_a_relative_length_is_measured_from_the_other_body() -> None:
    scene = picture("lecture-3b").scene
    carts = sorted(
        scene.seen(p.placement.at, p.placement.shift)[0] for p in scene.parts if p.kind == "cart" and p.layer == 20
    )
    arrow = next(p for p in scene.parts if p.kind == "coordinate" and "x2r" in p.elements and not p.solid)
    head = next(p for p in scene.parts if p.kind == "coordinate" and "x2r" in p.elements and p.solid)
    assert arrow.shape.commands[0][1][0] == pytest.approx(carts[0])
    assert head.shape.commands[0][1][0] == pytest.approx(carts[1])


def test_an_absolute_length_does_not_go_on_where_another_one_ends() -> None:
    """In the pose of the relative model, the second cart rests where the first one is seen."""
    scene = built_in.system("lecture-3a").look(pose={"x1": 0.72, "x2": 1.44}).scene
    spots = {x.elements[0]: x.shape.commands for x in scene.parts if x.kind == "coordinate" and not x.solid}
    heights = [spots[name][0][1][1] for name in ("x1", "x2")]
    assert abs(heights[0] - heights[1]) > 10


def test_a_wheel_has_its_radius_and_touches_its_floor() -> None:
    system = built_in.system("rolling-cylinder")
    scene = system.look().scene
    wheel = next(p for p in scene.parts if p.kind == "wheel" and p.placement.scaling == "both")
    centre, rim = (np.array(scene.positions[k]) for k in (wheel.placement.at, wheel.placement.towards))
    R = system.model.values[system["R"]]
    assert np.linalg.norm(rim - centre) == pytest.approx(R)
    floor = next(p for p in scene.parts if p.kind == "floor")
    (_, a), (_, b) = floor.shape.commands[:2]
    foot = np.array(scene.seen(floor.placement.at, floor.placement.shift))
    e = (np.array(b) - np.array(a)) / np.linalg.norm(np.array(b) - np.array(a))
    d = np.array(scene.seen(wheel.placement.at, wheel.placement.shift)) - foot - np.array(a)
    assert abs(d[0] * e[1] - d[1] * e[0]) == pytest.approx(R * scene.scale, abs=1e-6)


def test_a_system_in_python_without_values_is_drawn() -> None:
    s = lg.System("rod on a cart")
    x, th = s.coordinates("x theta")
    M, m, L, k = s.parameters("M m L k")
    cart = s.point("cart", (x, 0))
    s.particle(M, at=cart)
    s.particle(m, at=cart + (L * sin(th), -L * cos(th)))
    s.spring(k, deflection=x)
    s.gravity(direction=(0, -1), g=9.81)
    found = s.look(pose={th: 0.5}, kinds={"M": "box"})
    assert found.missing == ()
    assert _kinds(found.scene, "cart", "block", "rod", "spring", "wall")["cart"] == 0
    assert "block" in {p.kind for p in found.scene.parts}


@pytest.mark.parametrize(
    ("named", "code"),
    [
        ({"pose": {"alpha": 1}}, "E402"),
        ({"pose": {"theta1'": 1}}, "E402"),
        ({"kinds": {"m1": "car"}}, "E402"),
        ({"kinds": {"m9": "cart"}}, "E412"),
        ({"trail": ["P9"]}, "E412"),
        ({"hide": ["nothing"]}, "E412"),
        ({"azimuth": "north"}, "E406"),
        ({"elevation": float("nan")}, "E406"),
    ],
)
def test_a_wrong_request_is_told(named: dict, code: str) -> None:
    with pytest.raises(lg.Error) as caught:
        built_in.system("double-pendulum").look(**named)
    assert caught.value.code == code


def test_a_long_chain_is_no_coil_and_its_letters_do_not_meet() -> None:
    system, x, y = lg.System("chain"), 0, 0
    l, m = system.parameters("l m", l="0.1 m", m="1 kg")
    for i, angle in enumerate(system.coordinates(" ".join(f"a{i}" for i in range(20)))):
        x, y = x + l * sin(angle), y - l * cos(angle)
        system.particle(m, at=system.point(f"P{i}", (x, y)))
    scene = system.look().scene
    assert 2.0 < max(scene.pose.values()) - min(scene.pose.values()) < 2.4
    assert not scene.missing and len(scene.labels) == 60
    for (a, b, w, h), (c, d, u, v) in combinations([label.box for label in scene.labels], 2):
        assert a + w <= c or c + u <= a or b + h <= d or d + v <= b


@pytest.mark.slow
def test_letters_without_room_are_left_out_and_told() -> None:
    stage = Kinematics(built_in.system("pendulum").model)
    board = Board(stage, Motions(stage), np.array([0.5]), stage.parameters(), PLANE)
    for k in range(200):
        board.wish((f"name{k}",), (0.0, 0.0), (1.0, 0.0), "stiffness" if k else "coordinate", (f"spring {k}",))
    found = placed_labels(board)
    assert found[0].names == ("name0",) and 10 < len(found) < 200
    (words,) = board.missing
    assert words.startswith("there is no room for the letters name") and f"and {196 - len(found)} more" in words
    for one, two in combinations(found, 2):
        (a, b, w, h), (c, d, u, v) = one.box, two.box
        assert a + w <= c or c + u <= a or b + h <= d or d + v <= b


@pytest.mark.parametrize(("d", "rank"), [(3, 2), (40, 0), (40, 31), (40, 40), (60, 7)])
def test_what_is_at_right_angles_to_columns(d: int, rank: int) -> None:
    """Columns of very different sizes, more than they span: rows as many as are missing, at right angles."""
    rng = np.random.default_rng(d + rank)
    columns = rng.normal(size=(d, rank)) @ rng.normal(size=(rank, 50)) * 10.0 ** rng.integers(-3, 3, 50)
    rows = complement(columns)
    assert rows.shape == (d - rank, d)
    np.testing.assert_allclose(rows @ rows.T, np.eye(d - rank), atol=1e-13)
    np.testing.assert_allclose(rows @ columns / max(1.0, np.abs(columns).max()), 0, atol=1e-12)
