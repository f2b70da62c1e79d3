"""What rules find that no built-in example needs: rods between sliders, driven circles, forces beside springs."""

from __future__ import annotations

import numpy as np
import pytest
from sympy import Expr, Rational, cos, sin, sqrt
from sympy.physics.mechanics import dynamicsymbols

import lagrangian as lg
from lagrangian.graph import evaluate
from lagrangian.page.placing import placed, places
from lagrangian.page.scene import Disc


def trammel() -> lg.System:
    s = lg.System("elliptic trammel")
    theta = s.coordinates("theta")
    m, l = s.parameters("m l", m="1 kg", l="1 m")
    s.particle(m, at=s.point("A", (l * cos(theta), 0)), name="a")
    s.particle(m, at=s.point("B", (0, l * sin(theta))), name="b")
    return s


def crank() -> lg.System:
    s = lg.System("crank and piston")
    phi = s.coordinates("phi")
    m, r, l = s.parameters("m r l", m="1 kg", r="0.3 m", l="1 m")
    s.particle(m, at=s.point("A", (r * cos(phi), r * sin(phi))), name="pin")
    s.particle(m, at=s.point("B", (r * cos(phi) + sqrt(l**2 - r**2 * sin(phi) ** 2), 0)), name="piston")
    return s


GOVERNOR = """
name = "governor"
[coordinates]
theta = "arms, from the vertical"
phi = "spindle"
[parameters]
m = "1 kg"
a = "0.3 m"
[[frame]]
name = "spindle"
axis = [0, 0, 1]
angle = "phi"
[points]
left = { frame = "spindle", offset = ["-a*sin(theta)", "0", "-a*cos(theta)"] }
right = { frame = "spindle", offset = ["a*sin(theta)", "0", "-a*cos(theta)"] }
sleeve = ["0", "0", "-2*a*cos(theta)"]
[[particle]]
name = "left"
mass = "m"
at = "left"
[[particle]]
name = "right"
mass = "m"
at = "right"
[[particle]]
name = "sleeve"
mass = "m"
at = "sleeve"
[[gravity]]
direction = [0, 0, -1]
"""


def governor() -> lg.System:
    return lg.loads(GOVERNOR)


def rods(picture: lg.Picture, q: np.ndarray) -> list[float]:
    """The drawn lengths of all rods [px] at coordinates."""
    program = picture.program
    groups = {"x": [*map(float, q), *[0.0] * len(q)], "u": [], "t": [0.0]}
    groups["p"] = [float(program.defaults[name]) for name in program.inputs["p"]]
    at = places(picture.scene, evaluate(program, groups)["r"])
    ends = [placed(part, at) for part in picture.scene.parts if part.kind == "rod"]
    return [float(np.hypot(*(b - a))) for (_, a), (_, b) in ends]


@pytest.mark.parametrize(("made", "count", "words"), [
    (trammel, 1, "A rod between cart a and block b."),
    (crank, 2, "A rod between the pin and the piston."),
    (governor, 4, "a rod between the left and the sleeve"),
])  # fmt: skip
def test_bodies_at_a_constant_distance_are_joined(made: object, count: int, words: str) -> None:
    picture = made().look()  # type: ignore[operator]
    assert words.lower() in picture.description.lower()
    q = np.array(list(picture.pose.values()))
    assert len(rods(picture, q)) == count
    if len(q) == 1:  # in the plane a rod is as long as it is
        assert rods(picture, q) == pytest.approx(rods(picture, q + 0.2), abs=1e-9)
        assert not any(p.kind == "measure" for p in picture.scene.parts)  # the coordinate is an angle, not a length


def test_the_governor_opens_its_arms() -> None:
    picture = governor().look()
    assert picture.pose["theta"] > 0.3
    balls = [p for p in picture.scene.parts if p.kind == "ball" and p.elements != ("sleeve",)]
    (ax, ay), (bx, by) = (picture.scene.seen(p.placement.at) for p in balls if p.placement.at is not None)
    assert np.hypot(ax - bx, ay - by) > 40


def test_a_point_that_is_driven_round_has_its_circle() -> None:
    s = lg.System("driven round")
    theta, t = s.coordinates("theta"), dynamicsymbols._t
    m, R, l, omega = s.parameters("m R l omega", m="1 kg", R="0.3 m", l="0.8 m", omega="3 rad/s")
    pivot = s.point("pivot", (R * cos(omega * t), R * sin(omega * t)))
    s.particle(m, at=pivot + (l * sin(theta), -l * cos(theta)))
    scene = s.look().scene
    circle = next(p for p in scene.parts if p.kind == "driven" and p.dashed)
    assert np.hypot(*circle.shape.commands[0][1]) == pytest.approx(0.3 * scene.scale)
    assert ("R",) in [label.names for label in scene.labels]
    assert not any(p.kind == "pin" for p in scene.parts)


def test_a_force_pulls_where_a_spring_leaves_no_room_to_push() -> None:
    s = lg.System("hanging mass")
    y, F = s.coordinates("y"), s.input("F")
    m, k = s.parameters("m k", m="1 kg", k="100 N/m")
    mass = s.point("P", (0, -y))
    s.particle(m, at=mass)
    s.spring(k, deflection=y)
    s.force((0, -F), at=mass)
    s.gravity(direction=(0, -1), g=9.81)
    scene = s.look().scene
    at = places(scene)
    spring = next(p for p in scene.parts if p.kind == "spring")
    arrow = [p for p in scene.parts if p.kind == "force"]
    low = max(float(x[1]) for _, x in placed(spring, at))
    assert all(float(y_) > low for p in arrow for _, x in placed(p, at) for y_ in x[1::2])


def test_a_hoop_that_turns_by_its_coordinate_is_a_wheel_and_the_coordinate_an_angle() -> None:
    s = lg.System("hoop")
    theta = s.coordinates("theta")
    M, R, J = s.parameters("M R J", M="1 kg", R="0.5 m", J="0.25 kg*m^2")
    hoop = s.frame(-theta)
    s.rigid_body(M, J, s.point("C", (R * theta, 0)), hoop, name="hoop")
    scene = s.look().scene
    wheel = next(p for p in scene.parts if p.kind == "wheel")
    centre, rim = (np.array(scene.positions[k]) for k in (wheel.placement.at, wheel.placement.towards))
    assert np.linalg.norm(rim - centre) == pytest.approx(0.5)
    assert not any(p.kind == "measure" for p in scene.parts)
    assert "rolling on a horizontal track" in scene.description


@pytest.mark.parametrize(("share", "drawn"), [(1, "hoop"), (Rational(1, 2), "wheel")])
def test_a_wheel_with_all_its_mass_on_the_rim_is_a_hoop(share: Expr, drawn: str) -> None:
    s = lg.System("rolling")
    x = s.coordinates("x")
    m, R = s.parameters("m R", m="1 kg", R="0.3 m")
    s.rigid_body(m, share * m * R**2, s.point("C", (x, 0)), s.frame(-x / R), name="round")
    (rim,) = [p for p in s.look().scene.parts if p.kind in ("hoop", "wheel") and isinstance(p.shape, Disc)]
    assert rim.kind == drawn and rim.filled == (drawn == "wheel")


@pytest.mark.parametrize("sense", [1, -1])
def test_a_yo_yo_hangs_on_a_string_that_leaves_it_where_the_rim_is_at_rest(sense: int) -> None:
    s = lg.System("yo-yo")
    y = s.coordinates("y")
    m, r, J = s.parameters("m r J", m="0.2 kg", r="0.02 m", J="0.0001 kg*m^2")
    s.rigid_body(m, J, s.point("C", (0, -y)), s.frame(sense * y / r), name="yo-yo")
    s.gravity(direction=(0, -1), g=9.81)
    picture = s.look()
    scene, at = picture.scene, places(picture.scene)
    (_, start), (_, end) = placed(next(p for p in scene.parts if p.kind == "rope"), at)
    wheel = next(p for p in scene.parts if p.kind == "wheel")
    centre = np.array(scene.seen(wheel.placement.at))
    # it falls with speed 1 and turns with sense/r: the rim is at rest at sense·r beside the centre, v = ω × r upward
    assert (start - centre) / scene.scale == pytest.approx([sense * 0.02, 0.0], abs=1e-6)
    assert end[0] == pytest.approx(start[0]) and end[1] < start[1] - 50
    assert "unwinding from a string" in picture.description
    assert not any(p.kind == "floor" for p in scene.parts)


def test_friction_of_a_gear_is_drawn_at_the_gear_that_turns_by_its_deflection() -> None:
    s = lg.System("gears")
    phi = s.coordinates("phi")
    m, J, r1, r2, b = s.parameters("m J r1 r2 b", m="1 kg", J="0.1 kg*m^2", r1="0.1 m", r2="0.3 m", b="0.1 N*m*s")
    s.rigid_body(m, J, at=s.origin, frame=s.frame(phi), name="pinion")
    s.rigid_body(m, J, at=s.point("O", (r1 + r2, 0)), frame=s.frame(-phi * r1 / r2), name="gear")
    s.damper(b, deflection=phi * r1 / r2)
    picture = s.look()
    assert picture.missing == ()
    ring = next(p for p in picture.scene.parts if p.kind == "damper")
    assert picture.scene.positions[ring.placement.at] == pytest.approx((0.4, 0.0))


def test_what_hangs_beside_a_cart_is_joined_to_it() -> None:
    s = lg.System("cart with an arm")
    x, theta = s.coordinates("x theta")
    M, m, l, d = s.parameters("M m l d", M="3 kg", m="1 kg", l="0.5 m", d="0.4 m")
    cart = s.point("cart", (x, 0))
    joint = s.point("joint", (d, 0), relative_to=cart)
    s.particle(M, at=cart, name="cart")
    s.particle(m, at=joint + (l * sin(theta), -l * cos(theta)))
    scene = s.look().scene
    bracket = next(p for p in scene.parts if p.kind == "rod" and p.elements == ("cart",))
    a, b = (np.array(scene.positions[k]) for k in (bracket.placement.at, bracket.placement.towards))
    assert b - a == pytest.approx([0.4, 0.0])


def test_a_floor_reaches_the_walls_that_springs_are_tied_to() -> None:
    s = lg.System("between walls")
    x = s.coordinates("x")
    m, k, c = s.parameters("m k c", m="1 kg", k="40 N/m", c="40 N/m")
    s.particle(m, at=s.point("P", (x, 0)))
    s.spring(k, deflection=x)
    s.spring(c, deflection=-x)
    scene = s.look().scene
    at = places(scene)
    floor = next(p for p in scene.parts if p.kind == "floor")
    (_, a), (_, b) = placed(floor, at)[:2]
    walls = [placed(p, at)[0][1] for p in scene.parts if p.kind == "wall"]
    assert len(walls) == 2
    assert (min(a[0], b[0]), max(a[0], b[0])) == pytest.approx((min(w[0] for w in walls), max(w[0] for w in walls)))
