"""Where parts lie, against complex numbers: with y downward, multiplying by i turns clockwise on the screen."""

import cmath

import numpy as np
import pytest

from hand_scenes import TURN, carts, pendulum
from lagrangian.page.ground import laid_out
from lagrangian.page.palette import DARK, LIGHT
from lagrangian.page.placing import axes, inside, placed, places
from lagrangian.page.scene import Disc, Path, Placement, Scaling, ScenePart, Trace

AT = np.array([[10.0, 20.0], [13.0, 24.0], [10.0, 20.0]])
CURVE = Path((("M", (1, 0)), ("C", (0, 1, 2, 0.5, -1, -2)), ("Z", ())))


def test_places_are_those_of_the_scenes_own_formula() -> None:
    scene = pendulum()
    assert places(scene) == pytest.approx(np.array([scene.seen(i) for i in range(2)]))
    assert places(scene)[1] == pytest.approx([115 + 150 * np.sin(TURN), 62 + 150 * np.cos(TURN)])


def test_places_of_many_poses_are_those_of_each() -> None:
    scene = carts()
    poses = np.random.default_rng(1).normal(size=(3, 5, 4, 2))
    found = places(scene, poses)
    assert found.shape == (3, 5, 4, 2)
    assert found[2, 4, 3] == pytest.approx([30 + 130 * poses[2, 4, 3, 0], 100 - 130 * poses[2, 4, 3, 1]])


@pytest.mark.parametrize(("scaling", "x", "y"), [("none", 1, 1), ("along", 5, 1), ("both", 5, 5)])
def test_a_part_towards_an_anchor_is_turned_and_scaled(scaling: Scaling, x: float, y: float) -> None:
    unit = (3 + 4j) / 5
    drawn = placed(ScenePart(CURVE, "body", Placement(0, 1, scaling)), AT)
    assert [letter for letter, _ in drawn] == ["M", "C", "Z"]
    for (_, got), (_, own) in zip(drawn, CURVE.commands, strict=True):
        wanted = [10 + 20j + unit * (x * a + 1j * y * b) for a, b in zip(own[::2], own[1::2], strict=True)]
        assert got == pytest.approx(np.array([z for w in wanted for z in (w.real, w.imag)]))


def test_shifts_move_both_ends() -> None:
    origin, x, y = axes(Placement(0, 1, "along", (1, -2), (4, 0)), AT)
    assert origin == pytest.approx([11, 18])
    assert x == pytest.approx([6, 6])
    assert y == pytest.approx([-(0.5**0.5), 0.5**0.5])


def test_anchors_at_one_place_have_a_direction_all_the_same() -> None:
    origin, x, y = axes(Placement(0, 2), AT)
    assert (origin.tolist(), x.tolist(), y.tolist()) == ([10, 20], [1, 0], [0, 1])
    _, x, _ = axes(Placement(0, 2, "along"), AT)
    assert x.tolist() == [0, 0]


def test_a_part_without_anchors_lies_in_the_picture() -> None:
    ((letter, numbers),) = placed(ScenePart(Disc((5, 6), 7), "body"), AT)
    assert (letter, numbers.tolist()) == ("O", [5, 6, 7])


def test_the_radius_of_a_disc_follows_its_rim() -> None:
    ((_, numbers),) = placed(ScenePart(Disc((0, 0), 1), "body", Placement(0, 1, "both")), AT)
    assert numbers == pytest.approx([10, 20, 5])


def test_a_trace_goes_from_anchor_to_anchor() -> None:
    drawn = placed(ScenePart(Trace((0, 1), True, ((1, 1), (0, 0))), "body"), AT)
    assert [(letter, numbers.tolist()) for letter, numbers in drawn] == [("M", [11, 21]), ("L", [13, 24]), ("Z", [])]


def test_many_poses_at_once_are_placed_like_each_alone() -> None:
    scene = carts()
    poses = places(scene, np.random.default_rng(2).normal(size=(6, 4, 2)))
    for part in scene.parts:
        together = placed(part, poses)
        for k in range(6):
            for (letter, got), (alone, wanted) in zip(together, placed(part, poses[k]), strict=True):
                assert letter == alone
                assert got[k] == pytest.approx(wanted)


def test_what_lies_inside_a_shape() -> None:
    at = places(carts())
    cart = placed(carts().parts[1], at)
    assert inside((160, 100), cart)
    assert not inside((190, 100), cart)
    disc = placed(ScenePart(Disc((0, 0), 5), "body", Placement(0)), at)
    assert inside((33, 103), disc)
    assert not inside((34, 104), disc)


def test_turning_by_the_y_axis_is_clockwise_on_the_screen() -> None:
    _, x, y = axes(Placement(0, 1), AT)
    assert complex(*y) == pytest.approx(complex(*x) * cmath.exp(0.5j * cmath.pi))


def luminance(colour: str) -> float:
    """Relative luminance, https://www.w3.org/TR/WCAG22/#dfn-relative-luminance."""
    channels = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


@pytest.mark.parametrize("palette", [LIGHT, DARK], ids=["light", "dark"])
def test_letters_of_every_role_can_be_read(palette) -> None:
    for colour in palette.lines.values():
        low, high = sorted((luminance(colour), luminance(palette.paper)))
        assert (high + 0.05) / (low + 0.05) >= 4.5
    low, high = sorted((luminance(palette.line("body")), luminance(palette.body)))
    assert (high + 0.05) / (low + 0.05) >= 7


def test_a_part_in_a_plane_in_space_has_oblique_axes_and_one_side() -> None:
    at = np.array([[10.0, 20.0], [40.0, 25.0], [5.0, -10.0]])
    square = Path((("M", (0.0, 0.0)), ("L", (2.0, 0.0)), ("L", (1.0, 1.0))))
    place = Placement(0, 1, across=2)
    drawn = [numbers.tolist() for _, numbers in placed(ScenePart(square, "body", place), at)]
    assert drawn == [[10.0, 20.0], [70.0, 30.0], [35.0, -5.0]]
    seen = placed(ScenePart(square, "body", place, facing=True), at)  # y is counter-clockwise from x on the screen
    assert [numbers.tolist() for _, numbers in seen] == drawn
    behind = placed(ScenePart(square, "body", Placement(0, 2, across=1), facing=True), at)
    assert all(numbers.tolist() == [10.0, 20.0] for _, numbers in behind)


def test_a_grid_reaches_two_squares_beyond_where_bodies_go() -> None:
    """Squares of 1 m by 1 m from the origin, 4 along x and 2 along y; a body goes to x = 9.5 m."""
    strokes = [((i / 4, 0), (i / 4, 1)) for i in range(5)] + [((0, i / 2), (1, i / 2)) for i in range(3)]
    shape = Path(tuple((letter, spot) for ends in strokes for letter, spot in zip("ML", ends, strict=True)))
    grid = ScenePart(shape, "thin", Placement(0, 1, across=2), kind="grid")
    positions = np.array([[[0, 0, 0], [4, 0, 0], [0, 2, 0], [x, 1, 0.3]] for x in (1.0, 9.5)])
    made = laid_out(grid, positions, (3,))
    assert isinstance(made.shape, Path)
    spots = np.array([numbers for _, numbers in made.shape.commands]) * (4, 2)
    assert (spots.min(axis=0).tolist(), spots.max(axis=0).tolist()) == ([-1, -1], [12, 3])
    assert laid_out(grid, positions[:1] + 1e4, (3,)).shape != shape and len(made.shape.commands) == 2 * (14 + 5)
    far = laid_out(grid, positions * (1e4, 1, 1), (3,))
    assert isinstance(far.shape, Path) and len(far.shape.commands) < 200
