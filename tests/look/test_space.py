"""Pictures of systems in space: the axis of every angle, what is told, and what no description changes."""

import itertools
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from built_in import SOME, SPACE, picture
from lagrangian.examples import names
from lagrangian.look.hints import Hints
from lagrangian.look.holds import Motions
from lagrangian.look.kinematics import Kinematics
from lagrangian.look.labels import Ink, crosses
from lagrangian.look.scenes import scene_of
from lagrangian.look.space_measures import floating_coordinates
from lagrangian.look.space_solids import across, nearest
from lagrangian.look.space_turns import axis_now, spins_of
from lagrangian.page.placing import axes, places
from lagrangian.page.scene import Scene


@pytest.mark.slow
def test_examples_in_space_are_listed() -> None:
    assert [name for name in names() if built_in.system(name).model.dimension == 3] == list(SPACE)


def axis_by_sympy(model, coordinate: int, q: np.ndarray, frame: int, stage: Kinematics) -> np.ndarray:  # type: ignore[no-untyped-def,type-arg]
    """ω/q̇ of a frame from the symbolic derivative of its rotation: (∂R/∂q) Rᵀ."""
    given = stage.frames[frame]
    R = model.expand(given.rotation, constants=True) if hasattr(given.rotation, "free_symbols") else given.rotation
    values = {c.symbol: x for c, x in zip(model.coordinates, q, strict=True)}
    values |= {p.symbol: p.value for p in model.parameters}
    symbol = model.coordinates[coordinate].symbol
    W = np.array((sp.Matrix(R).diff(symbol) * sp.Matrix(R).T).subs(values).evalf(), dtype=float)
    return np.array([W[2, 1], W[0, 2], W[1, 0]])


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", [x for x in SPACE if x not in ("spherical-pendulum", "bead-on-hoop")])
def test_the_axis_of_an_angle_is_that_of_the_symbolic_rotation(name: str) -> None:
    model = built_in.system(name).model
    stage = Kinematics(model)
    motions = Motions(stage)
    q = np.random.default_rng(2).uniform(0.2, 1.0, len(model.coordinates))
    views = stage.views([q], stage.parameters())
    spins = spins_of(motions, floating_coordinates(model))
    assert spins
    for spin in spins[:8]:
        assert spin.frame is not None
        expected = axis_by_sympy(model, spin.coordinate, q, spin.frame, stage)
        assert axis_now(spin, views) == pytest.approx(expected, abs=1e-9)


def test_the_axes_of_a_spherical_pendulum() -> None:
    """phi turns about the vertical, theta about the horizontal line across the plane of the swing."""
    stage = Kinematics(built_in.system("spherical-pendulum").model)
    found = {s.coordinate: s for s in spins_of(Motions(stage), frozenset())}
    theta, phi = 0.7, 0.4
    views = stage.views([np.array([theta, phi])], stage.parameters())
    assert axis_now(found[1], views) == pytest.approx([0, 0, 1])
    # r = (sin θ cos φ, sin θ sin φ, −cos θ): r × ∂r/∂θ = (sin φ, −cos φ, 0)
    assert axis_now(found[0], views) == pytest.approx([np.sin(phi), -np.cos(phi), 0])


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", SPACE)
def test_every_coordinate_is_drawn_or_told(name: str) -> None:
    model = built_in.system(name).model
    scene, _ = scene_of(model)
    short = (f"coordinate platform_{x} is not drawn, because it is too short here" for x in "xy")  # it stands centred
    allowed = {"angles of the legs are not drawn", *short} if name == "stewart-platform" else set[str]()
    assert {x.split(":")[0] for x in scene.missing} == allowed
    drawn = {e for part in scene.parts if part.kind == "coordinate" for e in part.elements}
    wanted = {c.name for i, c in enumerate(model.coordinates) if i not in floating_coordinates(model)}
    if name == "stewart-platform":
        wanted = {x for x in wanted if x.startswith("l")}
    assert wanted <= drawn


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", SPACE)
def test_no_label_meets_another(name: str) -> None:
    scene = picture(name).scene
    for one, two in itertools.combinations(scene.labels, 2):
        (a, b, w, h), (c, d, u, v) = one.box, two.box
        assert a + w <= c or c + u <= a or b + h <= d or d + v <= b, (one.names, two.names)


LINKS = """
name = "two links"
coordinates = { a = "upper link", b = "lower link" }
parameters = { l = "1 m", m = "1 kg", J = "0.1 kg*m^2", j = "0.01 kg*m^2" }

[[frame]]
name = "first"
axis = [0, -1, 0]
angle = "a"

[[frame]]
name = "second"
axis = [0, -1, 0]
angle = "b"
PARENT

[points]
elbow = { frame = "first", offset = ["l", "0", "0"] }
c1 = { frame = "first", offset = ["l/2", "0", "0"] }
c2 = { from = "elbow", frame = "second", offset = ["l/2", "0", "0"] }

[[rigid_body]]
name = "upper"
mass = "m"
inertia = ["j", "J", "J"]
at = "c1"
frame = "first"

[[rigid_body]]
name = "lower"
mass = "m"
inertia = ["j", "J", "J"]
at = "c2"
frame = "second"
"""


def test_absolute_and_relative_angles_give_the_same_bodies(tmp_path: Path) -> None:
    """The second angle counts from the first link, or from the fixed axes."""
    scenes: list[Scene] = []
    for parent, b in (('parent = "first"', 0.4), ("", 0.9)):
        file = tmp_path / "links.toml"
        file.write_text(LINKS.replace("PARENT", parent))
        view = {"azimuth": 0.6, "elevation": 0.4}
        scenes.append(scene_of(lg.load(file).model, Hints(pose={"a": 0.5, "b": b}, **view))[0])  # type: ignore[arg-type]
    kinds = [sorted((p.kind, p.elements, p.role) for p in s.parts if p.kind != "hinge" and p.moves) for s in scenes]
    assert kinds[0] == kinds[1]
    bodies = [[s.positions[k] for k in s.handles] for s in scenes]
    assert np.array(bodies[0]) == pytest.approx(np.array(bodies[1]))


def test_a_disc_in_space_is_the_ellipse_of_its_circle() -> None:
    """The seen area of a disc is that of the disc times the cosine between its axis and the eye."""
    scene, _ = scene_of(built_in.system("rolling-disc").model, Hints(azimuth=0.6, elevation=0.4))
    rims = [p for p in scene.parts if p.kind == "wheel" and p.facing and len(p.placement.__dict__) and p.outline == 1.2]
    assert rims
    at = places(scene)
    model = built_in.system("rolling-disc").model
    radius = next(p.value for p in model.parameters if p.name == "r")
    assert radius is not None
    eye = np.cross(np.array(scene.view[0]), -np.array(scene.view[1]))
    place = rims[0].placement
    assert place.at is not None and place.towards is not None and place.across is not None
    o, u, v = (np.array(scene.positions[k]) for k in (place.at, place.towards, place.across))
    normal = np.cross(u - o, v - o) / radius**2
    _, x, y = axes(place, at)
    seen = x[0] * y[1] - x[1] * y[0]
    assert abs(seen) == pytest.approx(scene.scale**2 * radius**2 * abs(normal @ eye))
    assert np.linalg.norm(normal) == pytest.approx(1.0)


def test_a_given_view_is_kept() -> None:
    scene, _ = scene_of(built_in.system("robot-arm").model, Hints(azimuth=0.0, elevation=0.0))
    assert np.array(scene.view) == pytest.approx(np.array([[0, 1, 0], [0, 0, -1]]), abs=1e-12)


def test_nearest_places_of_two_lines_against_a_grid() -> None:
    rng = np.random.default_rng(4)
    grid = np.linspace(0, 1, 201)
    for _ in range(20):
        a, b, c, d = rng.normal(size=(4, 2))
        s, t, gap = nearest((a, b), (c, d))
        one, two = a + np.outer(grid, b - a), c + np.outer(grid, d - c)
        least = np.linalg.norm(one[:, None] - two[None], axis=-1).min()
        assert gap == pytest.approx(np.linalg.norm(a + s * (b - a) - c - t * (d - c)))
        assert gap <= least + 1e-12 and gap >= least - 0.03


def test_vectors_across_an_axis_are_right_handed() -> None:
    for n in np.random.default_rng(5).normal(size=(10, 3)):
        n = n / np.linalg.norm(n)
        u, v = across(n)
        assert np.array([u, v, n]) @ np.array([u, v, n]).T == pytest.approx(np.eye(3))
        assert np.cross(u, v) == pytest.approx(n)


def test_lines_that_meet_a_box_are_known() -> None:
    assert crosses((0.0, 0.0, 2.0, 2.0), (-1.0, 1.0), (3.0, 1.0))
    assert not crosses((0.0, 0.0, 2.0, 2.0), (-1.0, 3.0), (3.0, 3.0))


def test_a_link_with_its_joint_in_the_middle_reaches_both_of_its_ends() -> None:
    """A beam in space that is hinged at its middle, and has a rod at either end."""
    s = lg.System("mobile")
    tilt, one, two = s.coordinates("tilt one two")
    m, J = s.parameters("m J", m="1 kg", J="0.1 kg*m^2")
    pivot = s.point("pivot", (0, 0, 0))
    frame = s.frame(tilt, axis=(0, 1, 0), name="beam")
    s.rigid_body(m, (J, J, J), at=s.point("middle", (0.01, 0, 0), relative_to=pivot, frame=frame), frame=frame)
    for name, q, x in (("left", one, -0.5), ("right", two, 0.5)):
        end = s.point(name, (x, 0, 0), relative_to=pivot, frame=frame)
        own = s.frame(q, axis=(0, 1, 0), parent=frame, name=f"{name}_rod")
        at = s.point(f"{name}_centre", (0, 0, -0.3), relative_to=end, frame=own)
        s.rigid_body(m, (J, J, J), at=at, frame=own, name=f"{name}_rod")
    s.gravity(direction=(0, 0, -1))
    scene = s.look().scene
    links = [part.placement for part in scene.parts if part.kind == "link" and "rod" not in str(part.elements)]
    ends = [(scene.positions[x.at or 0], scene.positions[x.towards or 0]) for x in links]
    assert max(np.linalg.norm(np.subtract(a, b)) for a, b in ends) == pytest.approx(1.0)


def test_ink_is_found_where_lines_are_drawn() -> None:
    """A box with a line through its middle part has ink under it, one whose surroundings no line meets has none."""
    random = np.random.default_rng(7)
    lines, boxes = random.uniform(0, 200, (12, 2, 2)), random.uniform(0, 190, (200, 4)) * (1, 1, 0, 0) + (0, 0, 14, 9)
    found = Ink(lines).under(boxes) > 0
    for (x, y, w, h), inked in zip(boxes.tolist(), found, strict=True):
        inner, outer = (x + 3, y + 3, w - 6, h - 6), (x - 3, y - 3, w + 6, h + 6)
        met = [any(crosses(box, tuple(a), tuple(b)) for a, b in lines.tolist()) for box in (inner, outer)]
        assert met[0] <= inked <= met[1]
    assert 20 < found.sum() < 180 and not Ink(np.zeros((0, 2, 2))).under(boxes + 5).any()


def test_a_floating_body_has_arrows_to_its_place() -> None:
    """Three arrows, one after another from the origin of the fixed axes: x, y and z of the body's origin."""
    s = lg.System("satellite")
    base = s.floating_frame("base")
    m, J = s.parameters("m J", m="10 kg", J="2 kg*m^2")
    s.rigid_body(m, (J, J, 2 * J), at=base.origin, frame=base, name="hull")
    picture = s.look()
    assert picture.missing == ()
    labels = {x for label in picture.scene.labels if label.role == "coordinate" for x in label.names}
    assert labels == {"base_x", "base_y", "base_z"}
    assert all(picture.pose[name] * picture.scene.scale > 50 for name in labels)


def test_a_limb_that_turns_freely_hangs_on_a_ball() -> None:
    system = lg.System("pendulum on a ball joint")
    m, L, J, Jz = system.parameters("m L J J_z", m=1.0, L=0.5, J=0.02, J_z=0.004)
    limb = system.ball_frame("limb", origin=system.point("shoulder", (0, 0, 1)))
    system.rigid_body(m, (J, J, Jz), at=limb.point((0, 0, -L)), frame=limb, name="arm")
    system.gravity(direction=(0, 0, -1))
    scene = system.look().scene
    (ball,) = [part for part in scene.parts if part.kind == "ball joint"]
    assert ball.placement.at is not None and scene.positions[ball.placement.at] == (0.0, 0.0, 1.0)


def test_a_limb_in_a_ball_joint_is_not_called_hinged() -> None:
    system = lg.System("limb on a boom")
    m, L, J = system.parameters("m L J", m=1.0, L=0.5, J=0.02)
    boom = system.frame(system.coordinate("phi"), axis=(0, 0, 1))
    system.rigid_body(m, (J, J, J), at=boom.point((L, 0, 1)), frame=boom, name="boom")
    limb = system.ball_frame("limb", parent=boom, origin=boom.point((2 * L, 0, 1)))
    system.rigid_body(m, (J, J, J), at=limb.point((0, 0, -L)), frame=limb, name="arm")
    tip = limb.point((0, 0, -2 * L))
    system.rigid_body(m, (J, J, J), at=tip, frame=limb, name="foot")
    words = system.look().description.lower()
    assert words.startswith("a boom hinged on the ground; an arm on a ball joint on the boom; a foot ")
    assert words.count("hinged") == 1


def test_the_advice_for_a_length_that_is_too_short_draws_it() -> None:
    advice = [x.partition("[look] ")[2] for x in picture("stewart-platform").missing if "too short" in x]
    assert advice == ['pose = { platform_x = "0.2 m" }', 'pose = { platform_y = "0.2 m" }']
    there = built_in.system("stewart-platform").look(pose={"platform_x": 0.2, "platform_y": 0.2})
    assert not any("too short" in x for x in there.missing)


def test_a_torque_in_space_is_labelled_by_its_input_and_never_by_time() -> None:
    system = lg.System("rotor")
    psi, tau, W = system.coordinates("psi"), system.input("tau"), system.parameter("W", 1)
    J = system.parameter("J", 1)
    rotor = system.frame(psi, axis=(0, 0, 1), parent=system.frame(W * system.t, axis=(1, 0, 0)))
    system.rigid_body(0.5, (J, J, J), at=system.origin, frame=rotor)
    system.torque((0, 0, tau), on=rotor, axes=rotor)
    labels = {name for label in system.look().scene.labels for name in label.names}
    assert "tau" in labels and "t" not in labels
