"""Turns in the graph: rotation about any axis, and steps that swing."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.dynamics.vectors import Matrix
from lagrangian.graph import Graph
from lagrangian.records import dataclass


def along_axis(g: Graph, n: Sequence[int], angle: int) -> Matrix:
    """Rodrigues' rotation about the unit axis n: R = c 1 + s [n]× + (1 − c) n nᵀ."""
    c, s = g.cos(angle), g.sin(angle)
    rest = g.sub(g.one, c)
    hat = [[g.zero, g.neg(n[2]), n[1]], [n[2], g.zero, g.neg(n[0])], [g.neg(n[1]), n[0], g.zero]]
    return [
        [g.add(g.add(c if i == j else g.zero, g.mul(s, hat[i][j])), g.mul(rest, g.mul(n[i], n[j]))) for j in range(3)]
        for i in range(3)
    ]


@dataclass(frozen=True)
class Swing:
    """A step in the plane, ``length`` times the unit vector ``direction`` = (c, s) that turns with ``angle``.

    ``forwards`` says whether it turns counter-clockwise as the angle grows.
    """

    length: int
    direction: tuple[int, int]
    angle: int
    forwards: bool


def swing(g: Graph, step: Sequence[int]) -> Swing | None:
    """Recognise a step ±L (cos φ, ±sin φ) or ±L (sin φ, ±cos φ), or return None."""
    x, y = (_factored(g, component) for component in step)
    if x is None or y is None or x[0] != y[0]:
        return None
    (length, first, c), (_, second, s) = x, y
    one, two = g.nodes[first], g.nodes[second]
    if one[0] == two[0] or one[1] != two[1]:
        return None
    # (cos, sin) of one sign and (sin, cos) of two turn with φ, the others against it
    forwards = (one[0] == "cos") == ((c == first) == (s == second))
    return Swing(length, (c, s), one[1], forwards)


def _factored(g: Graph, x: int) -> tuple[int, int, int] | None:
    """(L, f, ±f) of ±L f with f a sine or cosine and L none."""
    negative = g.nodes[x][0] == "neg"
    bare = g.nodes[x][1] if negative else x
    node = g.nodes[bare]
    if node[0] in ("sin", "cos"):
        return g.one, bare, x
    if node[0] == "mul":
        for length, f in ((node[1], node[2]), (node[2], node[1])):
            if g.nodes[f][0] in ("sin", "cos") and g.nodes[length][0] not in ("sin", "cos"):
                return length, f, g.neg(f) if negative else f
    return None
