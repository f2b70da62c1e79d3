"""Descriptions with fewer coordinates: a surface f(q, t) = constant makes one of them superfluous."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownVariableType=false
# pyright: reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.derive.constraints.integrals import Integral
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

ANGLES = ("theta", "alpha", "beta", "phi", "psi", "gamma")
"""Names for a new angle, in the order in which they are tried."""


LONGEST, LONGEST_CIRCLE = 400, 200
"""The sizes of a surface above which no simple way is expected, and no circle."""


@dataclass(frozen=True)
class Proposal(Brief):
    """Coordinates as functions of others, so that ``integral`` is always satisfied; ``new`` is an added coordinate."""

    integral: Integral
    written: tuple[tuple[sp.Expr, sp.Expr], ...]
    new: sp.Expr | None = None


def proposals(integrals: Sequence[Integral], coordinates: Sequence[sp.Expr], time: sp.Symbol) -> tuple[Proposal, ...]:
    """Return for every surface a simple way to leave a coordinate out, if one is found.

    A coordinate in which f is linear, with a constant coefficient, is expressed by the others. On a circle
    (x − a)² + (y − b)² = r² an angle replaces both: x = a + r sin θ, y = b − r cos θ.
    """
    found: list[Proposal] = []
    used: set[sp.Expr] = set()
    taken = {str(getattr(q, "name", q.func)) for q in coordinates}
    for integral in integrals:
        free = [q for q in coordinates if q not in used]
        made = next(_ways(integral, free, coordinates, time, taken), None)
        if made is not None:
            found.append(made)
            used |= {q for q, _ in made.written}
            taken |= {str(made.new.func)} if made.new is not None else set[str]()
    return tuple(found)


def _ways(
    integral: Integral, free: Sequence[sp.Expr], coordinates: Sequence[sp.Expr], time: sp.Symbol, taken: set[str]
) -> Iterator[Proposal]:
    f = integral.expression
    length = bounded.size(f)
    if length > LONGEST:
        return
    level = integral.level if integral.level is not None else sp.Symbol("c")
    moving = f.atoms(AppliedUndef)
    turned = _within_functions(f)  # in these f is not a polynomial
    free = [q for q in free if q in moving and q not in turned]
    bent = _in_powers(f)
    for q in free:
        if q in bent:  # its slope has q, too
            continue
        slope = bounded.diff(f, q)
        if slope != 0 and not slope.has(*coordinates, time):
            value = bounded.expand(bounded.cancel((level - f.subs(q, 0)) / slope))
            yield Proposal(integral, ((q, value),))
    if integral.level != 0:
        return
    name = next((name for name in ANGLES if name not in taken), None)
    if name is None:
        return
    for x, y, a, b, r in _circles(f, length, free, coordinates):
        angle = sp.Function(name, real=True)(time)
        written = ((x, a + r * sp.sin(angle)), (y, b - r * sp.cos(angle)))
        yield Proposal(integral, written, angle)


def _within_functions(f: sp.Expr) -> set[sp.Basic]:
    """The functions of time in the arguments of others, such as the angles of sines; every part is seen once."""
    found, seen = set[sp.Basic](), set[tuple[sp.Basic, bool]]()
    open_parts: list[tuple[sp.Basic, bool]] = [(f, False)]
    while open_parts:
        entry = node, within = open_parts.pop()
        if entry in seen:
            continue
        seen.add(entry)
        if isinstance(node, AppliedUndef):
            found |= {node} if within else set[sp.Basic]()
        else:
            open_parts += [(part, within or isinstance(node, sp.Function)) for part in node.args]
    return found


def _in_powers(f: sp.Expr) -> set[sp.Basic]:
    """The functions of time in the bases of squares, roots and quotients."""
    return {q for power in f.atoms(sp.Pow) for q in power.atoms(AppliedUndef)}


def _circles(
    f: sp.Expr, length: int, free: Sequence[sp.Expr], coordinates: Sequence[sp.Expr]
) -> Iterator[tuple[sp.Expr, ...]]:
    """x, y, centre and radius of circles f = 0 whose radius depends on no other variable; f has ``length`` operations.

    A distance, √((x − a)² + (y − b)²) = r, is squared.
    """
    roots = [p for p in f.atoms(sp.Pow) if p.exp == sp.Rational(1, 2)]
    for x, y in combinations(free, 2):
        own = [p for p in roots if p.has(x, y)]
        surface, radius, size = f, None, length
        if own:
            radius = own[0] - f
            if len(own) > 1 or radius.has(x, y):
                continue
            surface = own[0].base - radius**2
            size = bounded.size(surface)
        found = _circle(surface, x, y, radius) if size <= LONGEST_CIRCLE else None
        if found is not None and not found[2].has(*coordinates):
            yield x, y, *found


def _circle(f: sp.Expr, x: sp.Expr, y: sp.Expr, radius: sp.Expr | None) -> tuple[sp.Expr, sp.Expr, sp.Expr] | None:
    """Centre and radius of the circle f = 0 in the plane of x and y; the radius is found if it is not known."""
    u, v = sp.symbols("u v", real=True)
    try:
        plane = sp.Poly(f.xreplace({x: u, y: v}), u, v)
    except sp.PolynomialError:
        return None
    scale = plane.coeff_monomial(u**2)
    if plane.total_degree() != 2 or scale == 0 or plane.coeff_monomial(u * v) != 0:
        return None
    if bounded.cancel(plane.coeff_monomial(v**2) - scale) != 0:
        return None
    a, b = (bounded.cancel(-plane.coeff_monomial(w) / (2 * scale)) for w in (u, v))
    square = bounded.cancel(a**2 + b**2 - plane.coeff_monomial(1) / scale)
    if square.is_number and not square.is_positive:
        return None
    return a, b, radius or cast("sp.Expr", sp.powdenest(sp.sqrt(sp.factor(square)), force=True))
