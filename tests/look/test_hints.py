"""What a picture is told besides the model: pose, kinds, lines, shapes, and what is hidden."""

from math import pi

import numpy as np
import pytest

import built_in
import lagrangian as lg
from lagrangian.look.cast import CHOICES
from lagrangian.look.hints import hints_of
from lagrangian.look.outlines import LINES
from lagrangian.model.hints import BODY_KINDS, LINE_KINDS
from lagrangian.page.placing import places
from lagrangian.page.scene import Trace

CART_POLE = built_in.system("cart-pole")


def with_hints(text: str, name: str = "cart-pole") -> lg.System:
    return lg.loads(built_in.system(name).to_toml() + "\n[look]\n" + text)


def traces(system: lg.System, kind: str) -> list[np.ndarray]:
    """The corners [m] of parts of a kind, in the pose."""
    scene = system.look().scene
    found = [p.shape for p in scene.parts if p.kind == kind]
    assert all(isinstance(x, Trace) for x in found)
    return [np.array([scene.positions[a] for a in x.anchors]) for x in found if isinstance(x, Trace)]


def test_the_words_of_the_model_are_those_of_the_picture() -> None:
    assert set(BODY_KINDS) == set(CHOICES)
    assert set(LINE_KINDS) == set(LINES)


def test_a_pose_of_the_file_is_drawn_and_an_argument_overrides_it() -> None:
    system = with_hints('pose = { theta = "20 deg" }')
    assert system.look().pose["theta"] == pytest.approx(20 * pi / 180)
    assert system.look(pose={"theta": 0.3}).pose["theta"] == 0.3
    assert system.look(pose={system["x"]: 0.1}).pose["theta"] == pytest.approx(20 * pi / 180)


def test_the_view_of_the_file_and_of_the_arguments() -> None:
    system = with_hints('view = { azimuth = "90 deg" }', "spinning-top")
    assert hints_of(system.model).azimuth == pytest.approx(pi / 2)
    assert hints_of(system.model, azimuth="10 deg").azimuth == pytest.approx(pi / 18)
    assert hints_of(built_in.system("spinning-top").model).azimuth is None


def test_kinds_are_drawn_and_what_does_not_suit_is_told() -> None:
    drawn = {p.kind for p in with_hints('kinds = { cart = "ball" }').look().scene.parts if "cart" in p.elements}
    usual = {p.kind for p in CART_POLE.look().scene.parts if "cart" in p.elements}
    assert drawn != usual
    picture = CART_POLE.look(kinds={"cart": "link"})
    assert any("'cart' cannot be drawn as 'link'" in x for x in picture.missing)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["cart-pole", "lecture-1", "rolling-disc", "four-bar"])
@pytest.mark.parametrize("kind", BODY_KINDS)
def test_every_body_takes_every_kind_or_says_why_not(name: str, kind: str) -> None:
    system = built_in.system(name)
    for body in system.model.bodies:
        picture = system.look(kinds={body.name: kind})
        assert np.isfinite(np.array(list(places(picture.scene)))).all()


def test_what_is_hidden_is_not_drawn() -> None:
    shown = {x for p in CART_POLE.look().scene.parts for x in p.elements}
    hidden = {x for p in CART_POLE.look(hide=["b"]).scene.parts for x in p.elements}
    assert "b" in shown and "b" not in hidden


def test_a_box_lies_in_the_axes_of_its_body() -> None:
    """Corners: r + R(φ)(±w/2, ±h/2), where φ = −θ turns the pole counter-clockwise."""
    system = with_hints('pose = { x = 0.0, theta = 0.3 }\n[[look.shape]]\nframe = "pole"\nbox = ["4 cm", 0.5]')
    (corners,) = traces(system, "shape")
    c, s = np.cos(-0.3), np.sin(-0.3)
    centre = 0.3 * np.array([np.sin(0.3), np.cos(0.3)])
    box = np.array([(-0.02, -0.25), (0.02, -0.25), (0.02, 0.25), (-0.02, 0.25)])
    assert np.allclose(corners, centre + box @ np.array([[c, -s], [s, c]]).T, atol=1e-12)


def test_the_angle_of_a_body_with_a_shape_of_its_own_stays_at_its_joint() -> None:
    def label(system_hints: dict) -> np.ndarray:
        scene = CART_POLE.look(pose={"theta": 0.5}, **system_hints).scene
        (found,) = [x for x in scene.labels if x.names == ("theta",)]
        joint = scene.seen(
            next(p.placement.at for p in scene.parts if "cart" in p.elements and p.placement.at is not None)
        )
        return np.array(found.centre) - np.array(joint)

    own = {"kinds": {"pole": "none"}, "shapes": [{"frame": "pole", "box": [0.05, 0.6]}]}
    assert np.linalg.norm(label(own) - label({})) < 60


def test_a_line_runs_through_its_points() -> None:
    text = 'pose = { x = 0.0, theta = 0.3 }\n[[look.line]]\nthrough = ["origin", "cart", "pole"]'
    (line,) = traces(with_hints(text), "string")
    assert np.allclose(line, [(0, 0), (0, 0), (0.3 * np.sin(0.3), 0.3 * np.cos(0.3))], atol=1e-12)


def test_a_wall_at_rest_is_hatched() -> None:
    arm = lg.loads(built_in.system("lecture-1").to_toml())
    arm.point("A", (-1, 0))
    arm.point("B", (1, 0))
    picture = arm.look(lines=[{"through": ["A", "B"], "kind": "wall"}])
    (wall,) = [p for p in picture.scene.parts if p.kind == "wall" and not p.elements and p.outline == 2.0]
    assert len(wall.shape.commands) > 10  # type: ignore[union-attr]


def test_a_shape_of_hostile_size_is_left_out_and_told() -> None:
    for size in (1e9, 1e200):
        picture = CART_POLE.look(shapes=[{"frame": "pole", "box": [size, 1.0]}])
        assert any("many times as large" in x for x in picture.missing)
        assert max(picture.scene.size) < 2000


WRONG = [
    {"pose": {"theta": "1 m"}},
    {"pose": {"phi": 1}},
    {"pose": {"theta'": 1}},
    {"kinds": {"cart": "box "}},
    {"kinds": {"carp": "box"}},
    {"azimuth": "up"},
    {"azimuth": 1e9},
    {"elevation": float("nan")},
    {"elevation": True},
    {"trail": ["nowhere"]},
    {"trail": "pole"},
    {"hide": [3]},
    {"lines": [{"through": ["cart"]}]},
    {"lines": [{"through": ["cart", "pole"], "kind": "rainbow"}]},
    {"lines": [{"thrugh": ["cart", "pole"]}]},
    {"lines": [3]},
    {"shapes": [{"frame": "pole"}]},
    {"shapes": [{"frame": "pole", "box": [1, 0]}]},
    {"shapes": [{"frame": "pole", "box": [1, "1 kg"]}]},
    {"shapes": [{"frame": "pole", "box": [1, float("inf")]}]},
    {"shapes": [{"frame": "pole", "points": [[0, 0]]}]},
    {"shapes": [{"frame": "pole", "points": [[0, 0], [1, 2, 3]]}]},
    {"shapes": [{"box": [1, 1]}]},
    {"shapes": [{"frame": "pole", "box": [1, 1]}] * 1001},
]


@pytest.mark.parametrize("hints", WRONG)
def test_a_hint_that_makes_no_sense_is_refused(hints: dict) -> None:
    with pytest.raises(lg.Error) as caught:
        CART_POLE.look(**hints)
    assert caught.value.code
