"""Reads the shapes of pictures back: those of SVG, at any instant of an animation, and those of TikZ.

A shape is the list of its points, right + i down [px]; of a circle, its centre and its radius. Between two values of an
animation, a player goes on straight lines; transforms of one group are applied in turn, the last one first.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

Leaf: TypeAlias = "list[complex]"
"""The points of a shape, or the centre and the radius of a circle."""

Matrix: TypeAlias = NDArray[np.float64]
"""A transform of the plane, 3 × 3."""

_NUMBER = re.compile(r"-?\d+(?:\.\d+)?|-?\.\d+")
_SVG = "{http://www.w3.org/2000/svg}"
_TIKZ = re.compile(r"\(([-\d.]+),([-\d.]+)\)|circle\[radius=([\d.]+)\]")


def shapes_of(svg: str) -> list[Leaf]:
    """Return the shapes of a picture at rest, in the order in which they are painted."""
    root = ElementTree.fromstring(svg.encode())
    return [leaf for group in root.findall(f"{_SVG}g") for leaf in _leaves(group, 0.0, np.eye(3))]


def frames_of(svg: str, shares: Iterable[float], corner: tuple[float, float]) -> Iterator[list[Leaf]]:
    """Yield the shapes of an animation at shares of its duration, without its trails and its line of time.

    ``corner`` [px] is the place that its upper left corner shows.
    """
    root = ElementTree.fromstring(svg.encode())
    (whole,) = (group for group in root.findall(f"{_SVG}g") if "transform" in group.attrib)
    moved = [group for group in whole if group.get("class") != "still"]
    view = _transform("translate", corner) @ _transform("translate", _numbers(whole.attrib["transform"]))
    for share in shares:
        yield [leaf for group in moved for leaf in _leaves(group, share, view)]


def tikz_shapes(text: str) -> list[Leaf]:
    """Return the shapes of a TikZ picture, in the order in which they are painted."""
    drawn = [line.partition("] ")[2] for line in text.splitlines() if line.startswith(r"\path[")]
    return [
        [complex(float(r), 0.0) if r else complex(float(x), float(y)) for x, y, r in _TIKZ.findall(line)]
        for line in drawn[1:]  # the first is the frame
    ]


def _leaves(element: Element, share: float, view: Matrix) -> Iterator[Leaf]:
    """The shapes in an element at a share of the duration; ``view`` places its axes."""
    if written := element.get("transform"):
        view = view @ _transform("translate", _numbers(written))
    for kind, values in _animated(element, "animateTransform", share):
        view = view @ _transform(kind, values)
    tag = element.tag.removeprefix(_SVG)
    if tag in ("path", "circle") and "opacity" not in element.attrib:  # trails are transparent
        now = dict(_animated(element, "animate", share))
        if tag == "path":
            x = now.get("d") or _numbers(element.get("d", ""))
            yield [_seen(view, a, b) for a, b in zip(x[::2], x[1::2], strict=True)]
        else:
            cx, cy, r = ((now.get(name) or [float(element.get(name, "0"))])[0] for name in ("cx", "cy", "r"))
            yield [_seen(view, cx, cy), complex(r * abs(np.linalg.det(view)) ** 0.5)]
    for inner in element:
        yield from _leaves(inner, share, view)


def _animated(element: Element, tag: str, share: float) -> Iterator[tuple[str, list[float]]]:
    """What the animations of an element say at a share of the duration: the attribute or the kind, and numbers."""
    for found in element.findall(f"{_SVG}{tag}"):
        rows = [_numbers(written) for written in found.attrib["values"].split(";")]
        given = found.get("keyTimes")
        at = [float(x) for x in given.split(";")] if given else np.linspace(0.0, 1.0, len(rows))
        values = [float(np.interp(share, at, column)) for column in zip(*rows, strict=True)]
        yield found.get("type") or found.attrib["attributeName"], values


def _transform(kind: str, values: Sequence[float]) -> Matrix:
    """The matrix of a transform of SVG."""
    made = np.eye(3)
    if kind == "translate":
        made[:2, 2] = values
    elif kind == "rotate":
        c, s = np.cos(np.radians(values[0])), np.sin(np.radians(values[0]))
        made[:2, :2] = [[c, -s], [s, c]]
    else:
        made[0, 0], made[1, 1] = values
    return made


def _seen(view: Matrix, x: float, y: float) -> complex:
    right, down, _ = view @ (x, y, 1.0)
    return complex(right, down)


def _numbers(written: str) -> list[float]:
    return [float(x) for x in _NUMBER.findall(written)]
