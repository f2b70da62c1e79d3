"""How long the equations would be, written out: counted before anything is multiplied out.

The support of a quantity is the set of functions of the motion in it, coefficients left aside: products of a harmonic
cos(Σ n_i q_i), of powers of coordinates that are lengths, and of rates. Supports of sums are unions, those of products
are all products, so one pass over the graph bounds T* from above. A function with r rates and ν angles or lengths makes
r (1 + ν) + ν terms of the equations of motion: each rate is differentiated in time once, with everything else.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from lagrangian.dynamics.describe import described
from lagrangian.dynamics.description import Inputs
from lagrangian.graph import Graph, operands, reached
from lagrangian.model import Model

MOST_TERMS = 1000
"""Terms of the equations of motion above which they are written in named quantities."""

MOST_UNDER_ROOT = 12
"""Functions of the motion above which the root, quotient or exponential of a sum counts as too long."""

Monomial: TypeAlias = tuple[tuple[tuple[int, int], ...], tuple[int, ...], tuple[int, ...]]
"""A function of the motion: the harmonic's (coordinate, multiple), the lengths, the rates, each in order."""

Support: TypeAlias = frozenset[Monomial]

ONE: Monomial = ((), (), ())
_NONE: Support = frozenset()
_CONSTANT: Support = frozenset([ONE])


class _TooManyError(Exception):
    """The equations may be too long: the count of their functions from above is."""


def is_long(model: Model, most: int = MOST_TERMS) -> bool:
    """Whether the equations of a model would have more than ``most`` terms, or too long a root or quotient."""
    return model.remembered(f"is_long {most}", lambda: _is_long(model, most))


def _is_long(model: Model, most: int) -> bool:
    graph = Graph()
    inputs = Inputs.of(graph, model)
    m, d = described(model, graph, inputs)
    try:
        supports = _Supports(graph, inputs, most)
        found: set[Monomial] = set()
        for body in model.bodies:
            place = d.places[body.at]
            for v in place.velocity:
                found |= supports.square(v)
            axes = d.axes[body.axes] if body.axes is not None else None
            omega = axes.omega if axes is not None else []
            for i, row in enumerate(body.tensor):
                for k, entry in enumerate(row):
                    if entry != 0:
                        found |= supports.product(supports.of(omega[i]), supports.of(omega[k]))
            if _terms(found) > most:
                return True
        return any(supports.is_steep(node) for node in reached(graph, m.potentials))
    except _TooManyError:
        return True


def _terms(found: set[Monomial]) -> int:
    """How many terms of the equations the functions of T* make."""
    total = 0
    for harmonic, lengths, rates in found:
        moving = len(harmonic) + len(set(lengths))
        total += len(rates) * (1 + moving) + moving
    return total


class _Supports:
    """The supports of the nodes of a graph."""

    def __init__(self, graph: Graph, inputs: Inputs, most: int) -> None:
        self.graph, self.most = graph, most
        self._q = {node: i for i, node in enumerate(inputs.q)}
        self._v = {node: i for i, node in enumerate(inputs.v)}
        self._known: dict[int, Support] = {}
        self._angles: dict[int, Mapping[int, int] | None] = {}

    def of(self, node: int) -> Support:
        """The support of a node. Raises `_TooManyError` where it is too large."""
        for i in reached(self.graph, [node], self._known):
            if i not in self._known:
                self._known[i] = self._made(i)
        return self._known[node]

    def square(self, node: int) -> Support:
        """The support of a square."""
        own = self.of(node)
        return self.product(own, own)

    def product(self, a: Support, b: Support) -> Support:
        """All products; cos a cos b holds cos(a + b) and cos(a − b)."""
        if len(a) * len(b) > 4 * self.most:
            raise _TooManyError
        found: set[Monomial] = set()
        for first, lengths, rates in a:
            for second, more, others in b:
                rest = tuple(sorted(lengths + more)), tuple(sorted(rates + others))
                found.add((_joined(first, second, 1), *rest))
                if first and second:
                    found.add((_joined(first, second, -1), *rest))
        return frozenset(found)

    def is_steep(self, node: int) -> bool:
        """Whether a node is the root, power, exponential or divisor of a sum that is long and moves."""
        n = self.graph.nodes[node]
        if n[0] in ("sqrt", "exp", "log", "pow"):
            return len(self.of(n[1])) > MOST_UNDER_ROOT
        return n[0] == "div" and len(self.of(n[2])) > MOST_UNDER_ROOT

    def _made(self, i: int) -> Support:
        node, known = self.graph.nodes[i], self._known
        op = node[0]
        if i in self._q:
            return frozenset([((), (self._q[i],), ())])
        if i in self._v:
            return frozenset([((), (), (self._v[i],))])
        if op in ("const", "input"):
            return _NONE if i == self.graph.zero else _CONSTANT
        if op in ("add", "sub"):
            return self._small(known[node[1]] | known[node[2]])
        if op == "neg":
            return known[node[1]]
        if op == "mul":
            return self._small(self.product(known[node[1]], known[node[2]]))
        if op in ("sin", "cos"):
            angle = self._angle(node[1])
            if angle is not None:
                return frozenset([(_normal(angle), (), ())])
        if op == "powi" and 0 < node[2] < 5:
            found = known[node[1]]
            for _ in range(node[2] - 1):
                found = self._small(self.product(found, known[node[1]]))
            return found
        inside = [known[k] for k in operands(node)]
        if all(s <= _CONSTANT for s in inside):
            return _CONSTANT
        return frozenset([((), (len(self._q) + i,), ())])  # a function of its own

    def _small(self, found: Support) -> Support:
        if len(found) > self.most:
            raise _TooManyError
        return found

    def _angle(self, node: int) -> Mapping[int, int] | None:
        """An angle as whole multiples of coordinates, what is constant left aside; None for anything else."""
        if node not in self._angles:
            self._angles[node] = self._multiples(node)
        return self._angles[node]

    def _multiples(self, i: int) -> Mapping[int, int] | None:
        node = self.graph.nodes[i]
        if i in self._q:
            return {self._q[i]: 1}
        if self.of(i) <= _CONSTANT:
            return {}
        if node[0] == "neg":
            inner = self._angle(node[1])
            return None if inner is None else {k: -n for k, n in inner.items()}
        if node[0] in ("add", "sub"):
            a, b = self._angle(node[1]), self._angle(node[2])
            if a is None or b is None:
                return None
            sign = 1 if node[0] == "add" else -1
            return {k: a.get(k, 0) + sign * b.get(k, 0) for k in {**a, **b}}
        if node[0] == "mul":
            for number, other in ((node[1], node[2]), (node[2], node[1])):
                value, inner = self.graph.value(number), self._angle(other)
                if value is not None and value.is_integer() and inner is not None:
                    return {k: int(value) * n for k, n in inner.items()}
        return None


def _normal(angle: Mapping[int, int]) -> tuple[tuple[int, int], ...]:
    """A harmonic with its first multiple positive: cos and sin of ±φ are one function here."""
    found = sorted((k, n) for k, n in angle.items() if n)
    sign = -1 if found and found[0][1] < 0 else 1
    return tuple((k, sign * n) for k, n in found)


def _joined(a: tuple[tuple[int, int], ...], b: tuple[tuple[int, int], ...], sign: int) -> tuple[tuple[int, int], ...]:
    total = dict(a)
    for k, n in b:
        total[k] = total.get(k, 0) + sign * n
    return _normal(total)
