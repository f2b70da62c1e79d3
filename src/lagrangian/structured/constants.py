"""The constants in which masses, inertias and lengths enter T* and the weights.

T* − V = Σ_j μ_j f_j, where the μ_j are products of parameters and the f_j functions of the motion alone. Some f_j
depend on others, f_d = Σ_b X_db f_b with numbers X, because cos² + sin² = 1 or because two bodies move in the same way.
So the motion depends on C_b = μ_b + Σ_d X_db μ_d alone, and on every one of them. The X are read off values of the f_j
at random points of a prime field, where nothing is rounded: nothing has to be multiplied out. Armstrong, Khatib and
Burdick found such constants of the PUMA 560 by hand (The explicit dynamic model and inertial parameters of the PUMA 560
arm, IEEE Int. Conf. on Robotics and Automation 1986, 510-518).
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TypeAlias

import sympy as sp

from lagrangian.graph import Graph, NotAlgebraic, PrimePoint, operands, reached, to_sympy
from lagrangian.graph.prime_field import Echelon
from lagrangian.model import Gravity
from lagrangian.structured.listing import Listing

MOST_CONSTANTS = 48
"""The number of constants above which they are not written."""

MOST_PRODUCTS = 300
"""The number of products of parameters above which constants are not sought."""

LARGEST_FACTOR = 24
"""The largest numerator and denominator of a factor X that is recognized."""

Product: TypeAlias = tuple[int, ...]
"""A product of parameters: their nodes, in order, one as often as its power says."""

Parted: TypeAlias = dict[Product, int]
"""A node as Σ μ f: the node of f by μ."""


def constants(found: Listing) -> tuple[sp.Expr, ...]:
    """The constants of T* and of the weights, those of T* first; none where there are very many, or where T* is no
    polynomial in the parameters."""
    g, m = found.graph, found.mechanics
    parts = _Parts(g, found.description.inputs.p)
    try:
        whole = parts.sum([parts.of(m.kinetic()), parts.of(g.neg(_weights(found)))])
    except _NotFoundError:
        return ()
    ordered = sorted((x for x in whole if g.value(whole[x]) is None), key=lambda x: (len(x), x))
    shares = _shares(g, [whole[x] for x in ordered])
    if shares is None:
        return ()
    inertial = _inertial(found)
    return tuple(
        parts.written([(ordered[k], Fraction(1)), *((ordered[j], x) for j, x in share.items())], inertial, found)
        for k, share in shares.items()
    )


def _weights(found: Listing) -> int:
    """Σ m g h of all bodies."""
    g, total = found.graph, found.graph.zero
    for element in (e for e in found.model.elements if isinstance(e, Gravity)):
        for b, height in zip(found.bodies, found.heights[element.title], strict=True):
            total = g.add(total, g.mul(found.description.node(b.body.mass * element.g), height))
    return total


def _inertial(found: Listing) -> set[sp.Basic]:
    """The parameters in masses and inertias."""
    bodies = (b.body for b in found.bodies)
    exprs = [x for body in bodies for x in (body.mass, *(entry for row in body.tensor for entry in row))]
    return set[sp.Basic]().union(*(sp.sympify(x).free_symbols for x in exprs))


class _NotFoundError(Exception):
    """A node is no polynomial in the parameters, or has too many products."""


class _Parts:
    """The nodes of a graph as polynomials in its parameters, with coefficients that depend on the motion alone."""

    def __init__(self, graph: Graph, parameters: Sequence[int]) -> None:
        self.graph, self.known = graph, dict[int, Parted]()
        self._free = set(parameters)

    def of(self, node: int) -> Parted:
        """A node as Σ μ f. Raises `_NotFoundError`."""
        g, order = self.graph, reached(self.graph, [node])
        moves: dict[int, bool] = {}
        holds: dict[int, bool] = {}
        for i in order:
            inside = operands(g.nodes[i])
            moves[i] = any(moves[k] for k in inside) or (g.nodes[i][0] == "input" and i not in self._free)
            holds[i] = any(holds[k] for k in inside) or i in self._free
        for i in order:
            if i in self.known:
                continue
            if not holds[i]:
                self.known[i] = {(): i}
            elif i in self._free:
                self.known[i] = {(i,): g.one}
            else:
                self.known[i] = self._made(i, moving=moves[i])
        return self.known[node]

    def sum(self, parted: Sequence[Parted]) -> Parted:
        """Σ of several; products that cancel are left out. Raises `_NotFoundError` where they are very many."""
        total: Parted = {}
        for each in parted:
            for product, f in each.items():
                total[product] = self.graph.add(total.get(product, self.graph.zero), f)
        if len(total) > MOST_PRODUCTS:
            raise _NotFoundError
        return {product: f for product, f in total.items() if f != self.graph.zero}

    def _made(self, i: int, *, moving: bool) -> Parted:
        g, node = self.graph, self.graph.nodes[i]
        op, inside = node[0], [self.known[k] for k in operands(node)]
        if op in ("add", "sub"):
            return self.sum([inside[0], inside[1] if op == "add" else self._times(inside[1], {(): g.negative})])
        if op == "neg":
            return self._times(inside[0], {(): g.negative})
        if op == "mul":
            return self._times(*inside)
        if op == "powi" and 0 < node[2] < 5:
            power = inside[0]
            for _ in range(node[2] - 1):
                power = self._times(power, inside[0])
            return power
        if op == "div" and set(inside[1]) == {()}:
            return {product: g.div(f, inside[1][()]) for product, f in inside[0].items()}
        if moving:
            raise _NotFoundError
        return {(i,): g.one}  # a root of parameters, for example

    def _times(self, a: Parted, b: Parted) -> Parted:
        if len(a) * len(b) > MOST_PRODUCTS**2:
            raise _NotFoundError
        g = self.graph
        return self.sum([{tuple(sorted(x + y)): g.mul(f, h)} for x, f in a.items() for y, h in b.items()])

    def written(self, terms: Sequence[tuple[Product, Fraction]], inertial: set[sp.Basic], found: Listing) -> sp.Expr:
        """Σ x μ in SymPy, where masses with one factor stand together: (m₄ + m₅ + m₆) a₃²."""
        symbols = dict(zip(found.description.inputs.p, (p.symbol for p in found.model.parameters), strict=True))
        groups: dict[sp.Expr, list[sp.Expr]] = {}
        for product, x in terms:
            factors = [to_sympy(self.graph, node, symbols) for node in product]
            own = [f for f in factors if f in inertial]
            rest = sp.Mul(*[f for f in factors if f not in inertial])
            size = sp.Rational(abs(x.numerator), x.denominator)
            groups.setdefault(size * rest, []).append(sp.Mul(*own) if x > 0 else -sp.Mul(*own))
        return sp.Add(*[_product(factor, sums) for factor, sums in groups.items()])


def _product(factor: sp.Expr, sums: Sequence[sp.Expr]) -> sp.Expr:
    """factor · Σ, with a minus sign in front where all terms have one."""
    if all(x.could_extract_minus_sign() for x in sums):
        factor, sums = -factor, [-x for x in sums]
    total = sp.Add(*sums)
    return sp.Mul(factor, total, evaluate=not factor.is_Number or factor == 1 or len(sums) == 1)


def _shares(g: Graph, functions: Sequence[int]) -> dict[int, dict[int, Fraction]] | None:
    """The functions that are independent, each with those that depend on it and how: f_d = Σ_b X_db f_b.

    A constant adds nothing to any motion, so the function 1 is the first of the independent ones, and left out.
    """
    columns = [g.one, *functions]
    echelon: Echelon | None = None
    seed = 0
    while True:
        seed += 1
        point = PrimePoint(g, seed=seed)
        row = point.values(columns)
        if isinstance(row, NotAlgebraic) or seed > 4 * MOST_CONSTANTS:
            return None
        echelon = echelon or Echelon(point.prime)
        if point.prime != echelon.p:
            continue
        if not echelon.take(seed, row):
            break
        if len(echelon) > MOST_CONSTANTS + 1:
            return None
    shares: dict[int, dict[int, Fraction]] = {}
    for pivot, row in sorted(echelon.reduced().items()):
        found = {k - 1: _fraction(x, echelon.p) for k, x in enumerate(row) if x and k != pivot}
        if any(x is None for x in found.values()):
            return None
        if pivot:
            shares[pivot - 1] = {k: x for k, x in found.items() if x is not None}
    return shares


def _fraction(x: int, p: int) -> Fraction | None:
    """The small fraction that a number of the field is."""
    for below in range(1, LARGEST_FACTOR + 1):
        above = x * below % p
        above = above - p if above > p // 2 else above
        if abs(above) <= LARGEST_FACTOR:
            return Fraction(above, below)
    return None
