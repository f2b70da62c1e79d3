"""Plays the animations of an SVG: the place of a point of an element at a share of the time, as a browser shows it."""

from __future__ import annotations

from xml.etree import ElementTree

import numpy as np

SVG = "{http://www.w3.org/2000/svg}"


def parsed(text: str) -> ElementTree.Element:
    return ElementTree.fromstring(text.partition("\n")[2] if text.startswith("<?xml") else text)


def value(animation: ElementTree.Element, share: float) -> np.ndarray:
    """The numbers of an animation at a share of its duration, on straight lines between its values."""
    rows = np.array(
        [[float(x) for x in row.replace(",", " ").split()] for row in animation.get("values", "").split(";")]
    )
    times = animation.get("keyTimes")
    at = np.linspace(0, 1, len(rows)) if times is None else np.array([float(x) for x in times.split(";")])
    assert len(at) == len(rows) and at[0] == 0 and at[-1] == 1 and (np.diff(at) > 0).all()
    return np.array([np.interp(share, at, column) for column in rows.T])


def matrix(element: ElementTree.Element, share: float) -> np.ndarray:
    """The transformation of an element: that of its attribute or, if there are any, the product of its animations."""
    found = np.eye(3)
    if text := element.get("transform"):
        x, y = (float(v) for v in text.removeprefix("translate(").removesuffix(")").split(","))
        found = np.array([[1, 0, x], [0, 1, y], [0, 0, 1.0]])
    for animation in element.findall(f"{SVG}animateTransform"):
        numbers = value(animation, share)
        if animation.get("additive") != "sum":
            found = np.eye(3)
        match animation.get("type"):
            case "translate":
                step = np.array([[1, 0, numbers[0]], [0, 1, numbers[1]], [0, 0, 1]])
            case "rotate":
                c, s = np.cos(np.radians(numbers[0])), np.sin(np.radians(numbers[0]))
                step = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
            case _:
                step = np.diag([numbers[0], numbers[1], 1.0])
        found = found @ step
    return found


def place(
    root: ElementTree.Element, shape: ElementTree.Element, point: tuple[float, float], share: float
) -> np.ndarray:
    """Where a point of a shape is seen in the picture at a share of the time."""
    parents = {child: parent for parent in root.iter() for child in parent}
    found = np.array([*point, 1.0])
    while shape in parents:
        found = matrix(shape, share) @ found
        shape = parents[shape]
    return found[:2]


def moving(root: ElementTree.Element, element: str) -> ElementTree.Element:
    """The group of an element in motion."""
    group = next(g for g in root.iter(f"{SVG}g") if g.get("class") == "moving")
    return next(g for g in group.iter(f"{SVG}g") if element in g.get("data-element", "").split(" "))
