"""Functions of one variable along a piece of a motion: bounds of their first and second derivatives there.

The bounds hold in the ball |a − v| ≤ R in which the argument stays (see `lagrangian.graph.bounds`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeAlias

from lagrangian.graph.graph import Graph
from lagrangian.records import dataclass


@dataclass(frozen=True, slots=True)
class Along:
    """The bounds for a node along a piece of a motion, as nodes; ``free`` if R and S are smaller than d and K imply."""

    v: int
    d: int
    R: int
    S: int
    K: int
    free: bool = False


@dataclass(frozen=True, slots=True)
class Slopes:
    """A function at the centre of a node: value, derivative, and bounds of |f′| and |f″| in the range of the node.

    ``within``: a bound of |f| everywhere, if there is one.
    """

    v: int
    slope: int
    first: int
    second: int
    within: float | None = None


def greatest(g: Graph, a: Along) -> int:
    """The largest |a|."""
    return g.add(g.abs(a.v), a.R)


def smallest(g: Graph, a: Along) -> int:
    """The smallest |a|, or 0 if a may be 0."""
    return above(g, g.sub(g.abs(a.v), a.R))


def above(g: Graph, x: int) -> int:
    """max(x, 0)."""
    return g.max(x, g.zero)


Rule: TypeAlias = "Callable[[Graph, Along], Slopes]"


def _sin(g: Graph, a: Along) -> Slopes:
    s, c = g.sin(a.v), g.cos(a.v)
    first, second = (g.min(g.one, g.add(g.abs(x), a.R)) for x in (c, s))
    return Slopes(s, c, first, second, 1.0)


def _cos(g: Graph, a: Along) -> Slopes:
    s, c = g.sin(a.v), g.cos(a.v)
    first, second = (g.min(g.one, g.add(g.abs(x), a.R)) for x in (s, c))
    return Slopes(c, g.neg(s), first, second, 1.0)


def _tan(g: Graph, a: Along) -> Slopes:
    v = g.tan(a.v)
    least = above(g, g.sub(g.abs(g.cos(a.v)), a.R))
    first = g.div(g.one, g.mul(least, least))
    return Slopes(v, g.add(g.one, g.mul(v, v)), first, g.div(g.mul(g.const(2.0), first), least))


def _exp(g: Graph, a: Along) -> Slopes:
    v = g.exp(a.v)
    most = g.exp(g.add(a.v, a.R))  # v e^R would be 0 if v is so small that it underflows
    return Slopes(v, v, most, most)


def _log(g: Graph, a: Along) -> Slopes:
    first = g.div(g.one, above(g, g.sub(a.v, a.R)))
    return Slopes(g.log(a.v), g.div(g.one, a.v), first, g.mul(first, first))


def _sqrt(g: Graph, a: Along) -> Slopes:
    v = g.sqrt(a.v)
    least = above(g, g.sub(a.v, a.R))
    first = g.div(g.const(0.5), g.sqrt(least))
    return Slopes(v, g.div(g.const(0.5), v), first, g.div(g.mul(g.const(0.5), first), least))


def _arc(name: str, sign: float) -> Rule:
    """asin and acos: 1/√(1 − a²), a/√(1 − a²)³."""

    def rule(g: Graph, a: Along) -> Slopes:
        most = greatest(g, a)
        room = above(g, g.sub(g.one, g.mul(most, most)))
        first = g.div(g.one, g.sqrt(room))
        here = g.div(g.const(sign), g.sqrt(g.sub(g.one, g.mul(a.v, a.v))))
        return Slopes(g.unary(name, a.v), here, first, g.div(g.mul(most, first), room))

    return rule


def _atan(g: Graph, a: Along) -> Slopes:
    least = smallest(g, a)
    first = g.div(g.one, g.add(g.one, g.mul(least, least)))
    here = g.div(g.one, g.add(g.one, g.mul(a.v, a.v)))
    second = g.mul(g.mul(g.const(2.0), g.min(greatest(g, a), g.one)), first)
    return Slopes(g.atan(a.v), here, first, second, math.pi / 2)


def _sinh(g: Graph, a: Along) -> Slopes:
    most = greatest(g, a)
    return Slopes(g.sinh(a.v), g.cosh(a.v), g.cosh(most), g.sinh(most))


def _cosh(g: Graph, a: Along) -> Slopes:
    most = greatest(g, a)
    return Slopes(g.cosh(a.v), g.sinh(a.v), g.sinh(most), g.cosh(most))


def _tanh(g: Graph, a: Along) -> Slopes:
    v = g.tanh(a.v)
    edge = g.tanh(smallest(g, a))
    first = g.sub(g.one, g.mul(edge, edge))
    second = g.mul(g.mul(g.const(2.0), g.min(greatest(g, a), g.one)), first)
    return Slopes(v, g.sub(g.one, g.mul(v, v)), first, second, 1.0)


def _asinh(g: Graph, a: Along) -> Slopes:
    least = smallest(g, a)
    square = g.add(g.one, g.mul(least, least))
    first = g.div(g.one, g.sqrt(square))
    here = g.div(g.one, g.sqrt(g.add(g.one, g.mul(a.v, a.v))))
    return Slopes(g.asinh(a.v), here, first, g.mul(g.min(greatest(g, a), g.one), first))


def _acosh(g: Graph, a: Along) -> Slopes:
    low = g.max(g.sub(a.v, a.R), g.one)
    room = g.sub(g.mul(low, low), g.one)
    first = g.div(g.one, g.sqrt(room))
    here = g.div(g.one, g.sqrt(g.sub(g.mul(a.v, a.v), g.one)))
    return Slopes(g.acosh(a.v), here, first, g.div(g.mul(greatest(g, a), first), room))


def _atanh(g: Graph, a: Along) -> Slopes:
    most = greatest(g, a)
    first = g.div(g.one, above(g, g.sub(g.one, g.mul(most, most))))
    here = g.div(g.one, g.sub(g.one, g.mul(a.v, a.v)))
    return Slopes(g.atanh(a.v), here, first, g.mul(g.mul(g.const(2.0), most), g.mul(first, first)))


FUNCTIONS: dict[str, Rule] = {
    "sin": _sin, "cos": _cos, "tan": _tan, "exp": _exp, "log": _log, "sqrt": _sqrt, "asin": _arc("asin", 1.0),
    "acos": _arc("acos", -1.0), "atan": _atan, "sinh": _sinh, "cosh": _cosh, "tanh": _tanh, "asinh": _asinh,
    "acosh": _acosh, "atanh": _atanh,
}  # fmt: skip
"""Functions of one variable, with the function that bounds their derivatives in the range of the argument."""
