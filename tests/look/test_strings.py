"""Strings over pulleys: found from the motion alone, drawn with the same length in every position, never invented."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from sympy import Expr, cos, sin

import built_in
import lagrangian as lg
from lagrangian.graph import evaluate
from lagrangian.page.placing import placed, places

Place = tuple[object, object]


def hanging(
    coordinates: str, places_of: object, *, carts: dict[str, str] | None = None, down: tuple[int, int] = (0, -1)
) -> lg.System:
    """Particles at places that are made from coordinates and parameters, by name, under gravity."""
    s = lg.System("string")
    q = s.coordinates(coordinates)
    q = q if isinstance(q, tuple) else (q,)
    values = {"l": "2 m", "k": "1 m", "R": "0.2 m", "d": "1.5 m", "h": "0.4 m", "alpha": "0.5 rad", "beta": "0.9 rad"}
    p = dict(zip(values, s.parameters(" ".join(values), **values), strict=True))
    for name, place in places_of(p, *q).items():  # type: ignore[operator]
        at = s.point(name, place)
        if not name.startswith("hub"):
            s.particle(s.parameter(f"m_{name}", "1 kg"), at=at, name=name)
    s.gravity(direction=down, g=9.81)
    return s


def plain(p: dict[str, Expr], x: Expr) -> dict[str, Place]:
    return {"a": (0, -x), "b": (0, -(p["l"] - x))}


def without_length(p: dict[str, Expr], x: Expr) -> dict[str, Place]:
    return {"a": (-p["R"], -x), "b": (p["R"], x)}


def table(p: dict[str, Expr], x: Expr) -> dict[str, Place]:
    return {"block": (x - p["l"], 0), "load": (0, -x)}


def table_without_length(p: dict[str, Expr], x: Expr) -> dict[str, Place]:
    return {"block": (x, 0), "load": (0, -x)}


def between(p: dict[str, Expr], x: Expr) -> dict[str, Place]:
    return {"block": (x, 0), "left": (-p["d"], x - p["h"]), "right": (p["d"], -x - p["h"])}


def inclines(p: dict[str, Expr], x: Expr) -> dict[str, Place]:
    far = p["l"] - x
    return {
        "a": (-x * cos(p["alpha"]), -x * sin(p["alpha"])),
        "b": (far * cos(p["beta"]), -far * sin(p["beta"])),
    }


def double(p: dict[str, Expr], x: Expr, y: Expr) -> dict[str, Place]:
    hub = -(p["l"] - x)
    return {"a": (0, -x), "hub": (0, hub), "b": (0, hub - y), "c": (0, hub - (p["k"] - y))}


def double_without_length(p: dict[str, Expr], x: Expr, y: Expr) -> dict[str, Place]:
    return {"a": (-p["d"], -x), "hub": (p["d"], x), "b": (p["d"] - p["R"], x - y), "c": (p["d"] + p["R"], x + y)}


def swinging(p: dict[str, Expr], r: Expr, theta: Expr) -> dict[str, Place]:
    return {"ball": (r * sin(theta), -r * cos(theta)), "weight": (-p["d"], r)}


def loop(p: dict[str, Expr], x: Expr) -> dict[str, Place]:
    return {"a": (0, -x), "b": (p["R"], -(p["l"] - x) / 2)}


STRUNG = {
    "plain Atwood": ("x", plain, 1),
    "Atwood without a length": ("x", without_length, 1),
    "block on a table": ("x", table, 1),
    "block on a table without a length": ("x", table_without_length, 1),
    "block between two loads": ("x", between, 2),
    "two inclines": ("x", inclines, 1),
    "double Atwood": ("x y", double, 2),
    "double Atwood without a length": ("x y", double_without_length, 2),
    "swinging Atwood": ("r theta", swinging, 1),
    "loop": ("x", loop, 1),
}


def drawn(picture: lg.Picture, q: np.ndarray) -> float:
    """The length of everything that is drawn as a string, at coordinates [px]."""
    program, scene = picture.program, picture.scene
    groups = {"x": [*map(float, q), *[0.0] * len(q)], "u": [], "t": [0.0]}
    groups["p"] = [float(program.defaults[name]) for name in program.inputs["p"]]
    at = places(scene, evaluate(program, groups)["r"])
    total = 0.0
    for part in scene.parts:
        if part.kind == "rope":
            (_, a), (_, b) = placed(part, at)
            total += float(np.linalg.norm(b - a))
    return total


@pytest.mark.parametrize("name", STRUNG)
def test_a_string_keeps_its_length_in_the_picture(name: str) -> None:
    coordinates, places_of, strings = STRUNG[name]
    picture = hanging(coordinates, places_of).look()
    assert picture.missing == ()
    assert picture.description.lower().count("a string from") == strings
    q = np.array(list(picture.pose.values()))
    lengths = [drawn(picture, q + step) for step in (0.0, 0.07, -0.05)]
    assert lengths[0] > 100
    assert lengths == pytest.approx([lengths[0]] * 3, abs=1e-6)


@pytest.mark.parametrize("name", STRUNG)
def test_a_string_leaves_its_pulleys_as_a_tangent(name: str) -> None:
    """Every straight part begins or ends on a rim at a right angle to the radius; a swing begins at an axle."""
    coordinates, places_of, _ = STRUNG[name]
    scene = hanging(coordinates, places_of).look().scene
    at = places(scene)
    rims = [placed(p, at)[0][1] for p in scene.parts if p.kind == "pulley" and p.filled]
    for part in scene.parts:
        if part.kind != "rope":
            continue
        (_, a), (_, b) = placed(part, at)
        e = (b - a) / np.linalg.norm(b - a)
        found = [
            (x, y, r) for x, y, r in rims for end in (a, b)
            if abs(np.hypot(end[0] - x, end[1] - y) - r) < 1e-6 and abs((end - (x, y)) @ e) < 1e-6
        ]  # fmt: skip
        axle = any(np.hypot(a[0] - x, a[1] - y) < 1e-6 for x, y, _ in rims)
        assert found or axle


def test_lengths_that_are_known_are_drawn_to_scale() -> None:
    picture = hanging("x", plain).look()
    scene = picture.scene
    blocks = sorted(part.placement.shift[1] for part in scene.parts if part.kind == "block")
    assert blocks == pytest.approx([0.0, 0.0])
    assert 0.3 < picture.pose["x"] / 2.0 < 0.7


def test_the_built_in_swinging_mass_has_two_pulleys_and_its_string() -> None:
    kinds = Counter(part.kind for part in built_in.picture("swinging-atwood").scene.parts if part.filled)
    assert kinds["pulley"] == 2


@pytest.mark.parametrize("written", [double, double_without_length])
def test_a_moving_pulley_without_a_point_is_found(written: object) -> None:
    """It is midway between the ends of its string: where the model names it, both pictures have the same strings."""

    def written_out(p: dict[str, Expr], x: Expr, y: Expr) -> dict[str, Place]:
        return {key: place for key, place in written(p, x, y).items() if key != "hub"}  # type: ignore[operator]

    picture = hanging("x y", written_out).look()
    assert picture.missing == ()
    kinds = [Counter(part.kind for part in x.scene.parts) for x in (picture, hanging("x y", written).look())]
    assert kinds[0]["rope"] == kinds[1]["rope"] >= 4
    assert kinds[0]["pulley"] == kinds[1]["pulley"]
    q = np.array(list(picture.pose.values()))
    assert drawn(picture, q + 0.05) == pytest.approx(drawn(picture, q), abs=1e-6)


def test_the_string_over_a_pulley_on_a_cart_is_told_with_the_line_that_helps() -> None:
    def carried(p: dict[str, Expr], x: Expr, y: Expr) -> dict[str, Place]:
        return {"cart": (x, 0), "block": (x + y, p["h"]), "load": (x + p["d"], p["h"] - y), "hub": (x + p["d"], p["h"])}

    s = hanging("x y", carried)
    (said,) = s.look().missing
    assert "over a pulley on cart" in said and "[[look.line]]" in said
    assert s.look(lines=[{"through": ["block", "hub", "load"], "kind": "string"}]).missing == ()


def train(p: dict[str, Expr], x: Expr) -> dict[str, Place]:
    return {"a": (x, 0), "b": (x + p["d"], 0)}


def mirrored(p: dict[str, Expr], x: Expr) -> dict[str, Place]:
    return {"a": (-x, 0), "b": (x, 0)}


def lift(p: dict[str, Expr], x: Expr) -> dict[str, Place]:
    return {"a": (0, x), "b": (p["d"], x)}


def uneven(p: dict[str, Expr], x: Expr) -> dict[str, Place]:
    return {"a": (0, -x), "b": (p["d"], 1.3 * x)}


@pytest.mark.parametrize("places_of", [train, mirrored, lift, uneven])
def test_what_no_string_can_move_has_none(places_of: object) -> None:
    picture = hanging("x", places_of).look()
    assert "string" not in picture.description
    assert not {"rope", "pulley"} & {part.kind for part in picture.scene.parts}


def test_without_gravity_nothing_hangs() -> None:
    s = lg.System("two blocks")
    x = s.coordinates("x")
    s.particle(s.parameter("m", "1 kg"), at=s.point("a", (0, -x)))
    s.particle(s.parameter("M", "1 kg"), at=s.point("b", (1, x)))
    assert "string" not in s.look().description
