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


def rotated(g: Graph, x: int, y: int, c: int, s: int) -> tuple[int, int]:
    """(c x − s y, s x + c y); with x, y = K c, −K s or K s, K c and c² + s² = 1 that is (K, 0) or (0, K)."""
    if x != g.zero and y != g.zero:
        left, right, (cosine, flip), (sine, turn) = _factors(g, x), _factors(g, y), bare(g, c), bare(g, s)
        for one, other, along in ((cosine, sine, True), (sine, cosine, False)):
            if one in left[0] and other in right[0] and _less(left[0], one) == _less(right[0], other):
                K = g.one
                for factor in _less(left[0], one):
                    K = g.mul(K, factor)
                if along and (left[1] == flip) != (right[1] == turn):  # x = K c, y = −K s up to one sign
                    return (g.neg(K) if left[1] != flip else K), g.zero
                if not along and (left[1] == turn) == (right[1] == flip):  # x = K s, y = K c up to one sign
                    return g.zero, (g.neg(K) if left[1] != turn else K)
    return g.sub(g.mul(c, x), g.mul(s, y)), g.add(g.mul(s, x), g.mul(c, y))


def _factors(g: Graph, node: int) -> tuple[list[int], bool]:
    """The factors of a product, in order, and whether it has a minus sign."""
    node, negative = bare(g, node)
    found, waiting = list[int](), [node]
    while waiting:
        i = waiting.pop()
        if g.nodes[i][0] == "mul":
            waiting += [g.nodes[i][1], g.nodes[i][2]]
        else:
            found.append(i)
    return sorted(found), negative


def _less(factors: list[int], one: int) -> list[int]:
    """The factors without one of them."""
    at = factors.index(one)
    return factors[:at] + factors[at + 1 :]


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
