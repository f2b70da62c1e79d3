"""Vectors and matrices of graph nodes; what is zero by structure costs nothing."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.graph import Graph

Vector = list[int]
Matrix = list[list[int]]


def bare(g: Graph, node: int) -> tuple[int, bool]:
    """The node without its sign, and whether it had one."""
    n = g.nodes[node]
    return (n[1], True) if n[0] == "neg" else (node, False)


def plus(g: Graph, a: Sequence[int], b: Sequence[int]) -> Vector:
    """a + b."""
    return [g.add(x, y) for x, y in zip(a, b, strict=True)]


def minus(g: Graph, a: Sequence[int], b: Sequence[int]) -> Vector:
    """a − b."""
    return [g.sub(x, y) for x, y in zip(a, b, strict=True)]


def scaled(g: Graph, c: int, a: Sequence[int]) -> Vector:
    """c a."""
    return [g.mul(c, x) for x in a]


def dot(g: Graph, a: Sequence[int], b: Sequence[int]) -> int:
    """a · b."""
    total = g.zero
    for x, y in zip(a, b, strict=True):
        total = g.add(total, g.mul(x, y))
    return total


def cross(g: Graph, a: Sequence[int], b: Sequence[int]) -> Vector:
    """a × b."""
    return [
        g.sub(g.mul(a[1], b[2]), g.mul(a[2], b[1])),
        g.sub(g.mul(a[2], b[0]), g.mul(a[0], b[2])),
        g.sub(g.mul(a[0], b[1]), g.mul(a[1], b[0])),
    ]


def times(g: Graph, A: Matrix, x: Sequence[int]) -> Vector:
    """A x."""
    return [dot(g, row, x) for row in A]


def transposed(A: Matrix) -> Matrix:
    """Aᵀ."""
    return [list(column) for column in zip(*A, strict=True)]


def product(g: Graph, A: Matrix, B: Matrix) -> Matrix:
    """A B."""
    columns = transposed(B)
    return [[dot(g, row, column) for column in columns] for row in A]


def zeros(g: Graph, n: int) -> Vector:
    """n zeros."""
    return [g.zero] * n


def identity(g: Graph, n: int) -> Matrix:
    """The n×n identity."""
    return [[g.one if i == j else g.zero for j in range(n)] for i in range(n)]
