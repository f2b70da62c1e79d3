"""Every body is attached to what moves it, or `Picture.missing` says what does not show and the line that helps."""

from __future__ import annotations

import re

import numpy as np
import pytest
from sympy import Expr, cos, sin

import built_in
import lagrangian as lg
from built_in import SOME, picture
from lagrangian.examples import names
from lagrangian.page.placing import placed, places
from lagrangian.page.scene import Scene, ScenePart

MOVE = "move together is not drawn"
MARKS = {"centre", "coordinate", "measure", "reference", "force", "torque", "gravity", "angle", "axis"}
"""Kinds of parts that hold nothing: marks, arrows and thin lines."""


def made(coordinates: str, places_of: object, *, bodies: str | None = None, gravity: bool = True) -> lg.System:
    """Particles of 1 kg at named places that are made from parameters and coordinates."""
    s = lg.System("unfamiliar")
    q = s.coordinates(coordinates)
    q = q if isinstance(q, tuple) else (q,)
    L, h = s.parameters("L h", L="2 m", h="0.5 m")
    found = places_of(L, h, *q)  # type: ignore[operator]
    for name, place in found.items():
        at = s.point(name.upper(), place)
        if bodies is None or name in bodies.split():
            s.particle(s.parameter(f"m_{name}", "1 kg"), at=at, name=name)
    if gravity:
        s.gravity(direction=(0, -1) if len(place) == 2 else (0, 0, -1), g=9.81)  # type: ignore[possibly-undefined]
    return s


def hole(L: Expr, h: Expr, r: Expr, phi: Expr) -> dict[str, tuple[Expr, ...]]:
    return {"disc": (r * cos(phi), r * sin(phi), 0 * r), "load": (0 * r, 0 * r, r - L)}  # type: ignore[dict-item]


def carried(L: Expr, h: Expr, x: Expr, s: Expr) -> dict[str, tuple[Expr, ...]]:
    return {"cart": (x, 0 * x), "block": (x + s, h), "load": (x + L, h - s)}  # type: ignore[dict-item]


def train(L: Expr, h: Expr, x: Expr) -> dict[str, tuple[Expr, ...]]:
    return {"first": (x, 0 * x), "second": (x + L, 0 * x)}  # type: ignore[dict-item]


def pantograph(L: Expr, h: Expr, x: Expr) -> dict[str, tuple[Expr, ...]]:
    return {"slow": (x, 0 * x), "fast": (2 * x, h)}  # type: ignore[dict-item]


def mirrored(L: Expr, h: Expr, a: Expr) -> dict[str, tuple[Expr, ...]]:
    return {"left": (-h - L * sin(a), -L * cos(a)), "right": (h + L * sin(a), -L * cos(a))}


TIED = {
    "mass on a table, string through a hole": ("r phi", hole, {"disc", "load"}),
    "block on a cart with a pulley on it": ("x s", carried, {"block", "load"}),
    "two cars with a coupling": ("x", train, {"first", "second"}),
    "two carts on a lever": ("x", pantograph, {"slow", "fast"}),
    "two mirrored arms": ("a", mirrored, {"left", "right"}),
}
"""Systems whose bodies move together through something that has no mass."""


def said_of(found: lg.Picture) -> list[set[str]]:
    """The bodies that each message about a missing connection names."""
    return [
        set(re.findall(r"\w+", message.split(" is not drawn")[0]))
        for message in found.missing
        if MOVE in message or "string from" in message
    ]


@pytest.mark.parametrize("name", TIED)
def test_what_moves_together_is_drawn_together_or_told(name: str) -> None:
    coordinates, places_of, bodies = TIED[name]
    found = made(coordinates, places_of).look()
    drawn = "string from" in found.description
    assert drawn or any(bodies <= said for said in said_of(found))
    for message in found.missing:
        assert "[[look.line]]" in message or "[points]" in message or "[look]" in message


def test_the_line_that_a_message_gives_helps() -> None:
    s = made("x", pantograph)
    (message,) = s.look().missing
    listed = re.findall(r'"(\w+)"', message)
    assert listed == ["slow", "fast", "string", "rod"]
    assert s.look(lines=[{"through": listed[:2], "kind": "rod"}]).missing == ()


def test_gears_without_radii_are_told_and_with_them_drawn() -> None:
    for named in (False, True):
        s = lg.System("gears")
        phi = s.coordinates("phi")
        J, m, a, b = s.parameters("J m a b", J="0.01 kg*m^2", m="1 kg", a="0.1 m", b="0.3 m")
        gap = a + b if named else s.parameter("D", "0.4 m")
        s.rigid_body(m, J, at=s.point("A", (0, 0)), frame=s.frame(phi), name="pinion")
        s.rigid_body(m, J, at=s.point("B", (gap, 0)), frame=s.frame(-phi * a / b), name="wheel")
        said = [x for x in s.look().missing if MOVE in x]
        assert bool(said) is not named
        assert named or ("pinion" in said[0] and "wheel" in said[0])


def test_free_bodies_need_nothing_that_holds_them() -> None:
    s = made("x y u v", lambda L, h, x, y, u, v: {"a": (x, y), "b": (u, v)}, gravity=False)
    assert s.look().missing == ()


def corners(part: ScenePart, at: np.ndarray) -> np.ndarray:
    """The corners of a part on the screen, (n, 2) px; of a disc, points of its circle."""
    found: list[np.ndarray] = []
    for letter, numbers in placed(part, at):
        if letter == "O":
            turn = np.linspace(0, 2 * np.pi, 25)
            found.append(numbers[:2] + float(numbers[2]) * np.stack([np.cos(turn), np.sin(turn)], axis=1))
        else:
            found.append(found[0][:1] if letter == "Z" and found else numbers.reshape(-1, 2))
    return np.concatenate(found) if found else np.zeros((0, 2))


def apart(points: np.ndarray, path: np.ndarray) -> float:
    """The least distance [px] of points from the line through the corners of a path."""
    a, e = path[:-1], np.diff(path, axis=0)
    square = np.maximum((e**2).sum(axis=1), 1e-12)
    t = np.clip(((points[:, None] - a) * e).sum(axis=2) / square, 0, 1)
    return float(np.linalg.norm(points[:, None] - a - t[:, :, None] * e, axis=2).min(initial=np.inf))


def held(scene: Scene, body: str) -> bool:
    """Whether something that is no mark, and not the body itself, touches the outline of a body."""
    at = places(scene)
    own = [part for part in scene.parts if body in part.elements and part.role == "body"]
    mine = np.concatenate([corners(part, at) for part in own])
    reach = max(part.outline for part in own) / 2
    kinds = {part.kind for part in own}
    for part in scene.parts:
        other = corners(part, at)
        if part.kind in MARKS or not len(other) or (body in part.elements and part.kind in kinds):
            continue
        near = reach + part.outline / 2 + 4.0
        inside = (other > mine.min(axis=0)).all(axis=1) & (other < mine.max(axis=0)).all(axis=1)
        if inside.any() or apart(mine, other) < near or (len(mine) > 1 and apart(other, mine) < near):
            return True
    return False


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", names())
def test_nothing_is_missing_from_examples(name: str) -> None:
    assert not [x for x in picture(name).missing if MOVE in x or "turns" in x]


@pytest.mark.thinned(2)
@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", names())
def test_bodies_of_examples_touch_what_holds_them(name: str) -> None:
    """The same asked of the drawing alone, without any rule of mechanics: no body hangs in the air."""
    scene, model = picture(name).scene, built_in.system(name).model
    for body in model.bodies:
        if body.name == "ball" and name == "magnetic-levitation":
            continue  # what holds it is a magnet
        place = [model.expand(r) for r in model.position(body.at)]
        own = sum(any(r.has(c.symbol) for r in place) for c in model.coordinates)
        assert own >= model.dimension or held(scene, body.name), body.name
