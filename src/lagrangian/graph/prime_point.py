"""An expression graph at a random point of a prime field: whether something is zero, decided without rounding.

A rank found by floating-point numbers needs a tolerance, and one found by fractions needs numbers that grow. Here every
number is whole and below a prime P, and what is not fixed is drawn at random. What is zero for all values is 0; what is
not is 0 with a probability of about its degree / P < 1e-15. Functions become random numbers too, tied together by the
relations that the functions have:

* sin and cos: a sum of angles is a product of points of the circle c² + s² = 1. An argument is written as a rational
  combination Σ r_k b_k; b_k / (common denominator of the r_k) has a random point.
* exp, sinh, cosh, tanh: the same with random numbers in the place of points.
* √x and x^(p/q): a root in the field. Where x has none, everything is drawn again.
* log and the arcs: random. Their derivatives are algebraic, and the graph knows them.

By Ax's theorem exponentials of arguments that are independent over the rationals are algebraically independent, so this
is a generic point (J. Ax, On Schanuel's conjectures, Annals of Mathematics 93, 1971, 252-268). Whether arguments,
logarithms and arcs are independent is itself decided by a rank in the field; where they are not, the answer is
`NotAlgebraic`.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from math import lcm

from lagrangian.graph.autodiff import gradient
from lagrangian.graph.graph import CONDITIONS, Graph, Node, operands
from lagrangian.graph.prime_field import (
    PRIMES,
    QUARTER_DEGREES,
    Circle,
    Echelon,
    added,
    half_turn,
    multiple,
    random_angle,
    root,
)
from lagrangian.graph.program import reached
from lagrangian.graph.to_sympy import number
from lagrangian.records import dataclass

MAX_DRAWS = 500
"""Draws after which a root is given up: nine independent square roots are squares together in one of 512."""

MAX_ROOT = 12
"""The largest q of an exponent p/q that is read as a root."""

ANGLES = frozenset({"sin", "cos", "tan"})
EXPONENTIALS = frozenset({"exp", "sinh", "cosh", "tanh"})
ARCS = frozenset({"asin", "acos", "atan", "atan2"})
TRANSCENDENTAL = ARCS | {"log", "asinh", "acosh", "atanh"}


@dataclass(frozen=True)
class NotAlgebraic:
    """The result if a graph contains something that no field has; ``operation`` names it."""

    operation: str


class _OutsideError(Exception):
    """An operation that does not exist in the field."""


class _AgainError(Exception):
    """Something is not defined at this point, so another point is drawn."""


class PrimePoint:
    """A random point of a prime field, at which nodes of a graph are evaluated.

    ``numbers`` are input nodes that stand for exact numbers, because the constants of a graph are doubles (numbers that
    are added to it later count, too); ``pi`` is the input node for π. Any other constant stands for the shortest
    fraction or decimal that equals the double. The values of nodes stay the same until `draws` changes: then a root did
    not exist, a new point was drawn, and all earlier values are invalid.
    """

    def __init__(
        self, graph: Graph, numbers: Mapping[int, Fraction] | None = None, pi: int | None = None, *, seed: int = 1
    ) -> None:
        self.graph, self.draws = graph, 0
        self._numbers: Mapping[int, Fraction] = {} if numbers is None else numbers
        self._pi, self._seed = pi, seed
        self._forms: dict[int, dict[int, Fraction]] = {}
        self._parts: dict[int, int] = {}  # base → the common denominator of its multiples
        self._bases: dict[int, None] = {}
        self._logs: dict[int, None] = {}
        self._proved: tuple[int, int] = (1, 1)  # how many bases and logs are known to be independent
        self._start()

    def values(self, ids: Sequence[int]) -> list[int] | NotAlgebraic:
        """The values of nodes, between 0 and `prime`, or the reason why they have none."""
        why = "division by zero"
        for _ in range(MAX_DRAWS):
            try:
                found = self._at(ids)
                self._prove()
            except _AgainError as error:
                why = str(error)
                self.draws += 1
                self._start()
            except _OutsideError as error:
                return NotAlgebraic(str(error))
            else:
                return found
        return NotAlgebraic(why)

    # -- drawing ----------------------------------------------------------------------------------------------------

    def _start(self) -> None:
        self.prime = PRIMES[self.draws // 8 % len(PRIMES)]
        self._draw = random.Random(f"{self._seed} {self.draws}")
        self._value: dict[int, int] = {}
        self._circle: dict[int, Circle] = {}
        self._scale: dict[int, int] = {}
        self._angle: dict[int, Circle] = {}

    def _some(self) -> int:
        return self._draw.randrange(2, self.prime)

    def _inverse(self, x: int) -> int:
        if x == 0:
            raise _AgainError("division by zero")
        return pow(x, -1, self.prime)

    def _root(self, x: int, q: int, operation: str) -> int:
        found = root(x, q, self.prime)
        if found is None:
            raise _AgainError(operation)
        return found

    def _at(self, ids: Sequence[int]) -> list[int]:
        nodes, value = self.graph.nodes, self._value
        for i in reached(self.graph, ids, value):
            if i not in value:
                value[i] = self._node(i, nodes[i]) % self.prime
        return [value[i] for i in ids]

    # -- one node ---------------------------------------------------------------------------------------------------

    def _node(self, i: int, node: Node) -> int:
        op, value = node[0], self._value
        if op == "const":
            return self._fraction(_exact(node[1]))
        if op == "input":
            return self._fraction(self._numbers[i]) if i in self._numbers else self._some()
        if op == "add":
            return value[node[1]] + value[node[2]]
        if op == "sub":
            return value[node[1]] - value[node[2]]
        if op == "mul":
            return value[node[1]] * value[node[2]]
        if op == "neg":
            return -value[node[1]]
        if op == "div":
            return value[node[1]] * self._inverse(value[node[2]])
        if op == "powi":
            return self._power(value[node[1]], node[2])
        if op == "sqrt":
            return self._root(value[node[1]], 2, "a square root")
        return self._function(i, node)

    def _function(self, i: int, node: Node) -> int:
        op = node[0]
        if op == "pow":
            return self._broken_power(node)
        if op in ANGLES:
            c, s = self._angle_of(node[1])
            return c if op == "cos" else s if op == "sin" else s * self._inverse(c)
        if op in EXPONENTIALS:
            e = self._exponential(node[1])
            back = self._inverse(e)
            half = pow(2, -1, self.prime)
            if op == "exp":
                return e
            if op == "tanh":
                return (e - back) * self._inverse(e + back)
            return (e + back) * half if op == "cosh" else (e - back) * half
        if op in TRANSCENDENTAL:
            self._logs[i] = None
            return self._some()
        raise _OutsideError("a condition" if op in CONDITIONS or op == "select" else op)

    def _fraction(self, x: Fraction) -> int:
        return x.numerator * self._inverse(x.denominator % self.prime)

    def _power(self, x: int, n: int) -> int:
        return pow(x if n >= 0 else self._inverse(x), abs(n), self.prime)

    def _broken_power(self, node: Node) -> int:
        exponent = self.graph.value(node[2])
        if exponent is None and node[2] in self._numbers:
            exponent = float(self._numbers[node[2]])
        if exponent is None:
            raise _OutsideError("a power with an exponent that is not a number")
        broken = Fraction(exponent).limit_denominator(MAX_ROOT)
        if abs(float(broken) - exponent) > 4e-16 * abs(exponent):
            raise _OutsideError(f"the power {exponent:g}")
        return self._power(self._root(self._value[node[1]], broken.denominator, "a root"), broken.numerator)

    # -- sines and exponentials -------------------------------------------------------------------------------------

    def _angle_of(self, a: int) -> Circle:
        if a not in self._angle:
            point = (1, 0)
            for base, r in self._form(a).items():
                parts = self._common(base, r)
                point = added(point, multiple(self._base_point(base, parts), int(r * parts), self.prime), self.prime)
            self._angle[a] = point
        return self._angle[a]

    def _exponential(self, a: int) -> int:
        e = 1
        for base, r in self._form(a).items():
            if self.graph.nodes[base][0] in TRANSCENDENTAL or base == self._pi:
                raise _OutsideError("the exponential of a logarithm, an arc or π")
            parts = self._common(base, r)
            if base not in self._scale:
                self._scale[base] = self._some()
            e = e * self._power(self._scale[base], int(r * parts)) % self.prime
        return e

    def _common(self, base: int, r: Fraction) -> int:
        """The denominator in which multiples of a base are counted."""
        self._bases[base] = None
        parts = lcm(self._parts.get(base, QUARTER_DEGREES if base == self._pi else 1), r.denominator)
        if parts != self._parts.get(base):
            known = base in self._circle or base in self._scale
            self._parts[base] = parts
            if known:
                raise _AgainError("an angle's fraction")
        return parts

    def _base_point(self, base: int, parts: int) -> Circle:
        if base not in self._circle:
            op = self.graph.nodes[base][0]
            if base == self._pi:
                point = half_turn(parts, self.prime)
                if point is None:
                    raise _OutsideError(f"the angle π/{parts // QUARTER_DEGREES or parts}")
            elif op in TRANSCENDENTAL:
                if op not in ARCS or parts != 1:
                    raise _OutsideError(f"the sine of a part of {op}")
                point = self._arc_point(self.graph.nodes[base])
            else:
                point = random_angle(self._draw, self.prime)
            self._circle[base] = point
        return self._circle[base]

    def _arc_point(self, node: Node) -> Circle:
        """The cosine and the sine of an arc function, computed from its argument."""
        (a, *more) = self._at(operands(node))
        if node[0] in ("asin", "acos"):
            other = self._root((1 - a * a) % self.prime, 2, "a square root")
            return (other, a) if node[0] == "asin" else (a, other)
        x = more[0] if more else 1
        scale = self._inverse(self._root((x * x + a * a) % self.prime, 2, "a square root"))
        return x * scale % self.prime, a * scale % self.prime

    def _form(self, a: int) -> dict[int, Fraction]:
        """A node as a rational combination of base nodes; the base 1 counts numbers."""
        forms = self._forms
        for i in self._linear(a):
            if i not in forms:
                forms[i] = self._combination(i)
        return forms[a]

    def _linear(self, a: int) -> list[int]:
        """The nodes of which ``a`` consists by sums and products, operands first."""
        seen: set[int] = set()
        stack = [a]
        while stack:
            i = stack.pop()
            if i in seen:
                continue
            seen.add(i)
            if i not in self._forms and self.graph.nodes[i][0] in ("add", "sub", "neg", "mul", "div"):
                stack += operands(self.graph.nodes[i])
        return sorted(seen)

    def _combination(self, i: int) -> dict[int, Fraction]:
        node, forms, one = self.graph.nodes[i], self._forms, self.graph.one
        op = node[0]
        if op == "const":
            return {one: _exact(node[1])} if node[1] else {}
        if i in self._numbers:
            return {one: self._numbers[i]}
        if op in ("add", "sub"):
            total = dict(forms[node[1]])
            for base, r in forms[node[2]].items():
                total[base] = total.get(base, Fraction(0)) + (r if op == "add" else -r)
            return {base: r for base, r in total.items() if r}
        if op == "neg":
            return {base: -r for base, r in forms[node[1]].items()}
        if op in ("mul", "div"):
            a, b = forms[node[1]], forms[node[2]]
            if set(b) == {one}:
                factor = b[one] if op == "mul" else 1 / b[one]
                return {base: r * factor for base, r in a.items()}
            if op == "mul" and set(a) == {one}:
                return {base: r * a[one] for base, r in b.items()}
        return {i: Fraction(1)}

    # -- independence -----------------------------------------------------------------------------------------------

    def _prove(self) -> None:
        """Check that bases, and logarithms and arcs, have no linear relation with constant coefficients."""
        logs = list(self._logs)
        bases = [b for b in self._bases if b not in (self.graph.one, self._pi)]
        if all(self.graph.nodes[b][0] == "input" for b in bases):
            bases = []  # independent already
        if len(bases) > self._proved[0]:
            self._independent([[b] for b in bases], "angles or exponents that depend on each other")
        if len(logs) > self._proved[1]:
            inputs = [i for i in reached(self.graph, logs) if self.graph.nodes[i][0] == "input"]
            inputs = [i for i in inputs if i not in self._numbers and i != self._pi]
            rows = [gradient(self.graph, log, inputs) for log in logs]
            self._independent(rows, "logarithms or arcs that depend on each other")
        self._proved = max(self._proved[0], len(bases)), max(self._proved[1], len(logs))

    def _independent(self, rows: Iterable[Sequence[int]], otherwise: str) -> None:
        """Compare functions at as many points as there are functions: c·f = 0 everywhere only if the rank is
        smaller."""
        functions = [list(row) for row in rows]
        columns: list[list[int]] = [[] for _ in functions]
        for k in range(len(functions) + 1):
            point = PrimePoint(self.graph, self._numbers, self._pi, seed=self._seed * 1000 + k)
            point._proved = (1 << 60, 1 << 60)
            for column, function in zip(columns, functions, strict=True):
                column += self._same_prime(point, function)
        echelon = Echelon(PRIMES[0])
        if not all(echelon.take(k, column) for k, column in enumerate(columns)):
            raise _OutsideError(otherwise)

    def _same_prime(self, point: PrimePoint, ids: Sequence[int]) -> list[int]:
        found = point.values(ids)
        if isinstance(found, NotAlgebraic):
            raise _OutsideError(found.operation)
        if point.prime != PRIMES[0]:
            raise _OutsideError("roots that are too many")
        return found


def _exact(x: float) -> Fraction:
    """The shortest fraction or decimal that equals this double."""
    if x.is_integer():
        return Fraction(x)
    if x != x or x in (float("inf"), float("-inf")):
        raise _OutsideError("infinity")
    exact = number(x)
    return Fraction(int(exact.p), int(exact.q))  # type: ignore[attr-defined]
