"""Integrals f(q, t) = constant of rows: surfaces that the motion does not leave.

They are sought in this order. A row on positions is its own integral. A form is integrated if it is closed, perhaps
after multiplication by one of a few factors. Natani's method first integrates with all but two variables constant.
Finally, forms are restricted to a surface that was found. Whether a form is closed is decided at a generic point before
it is integrated. Every f is verified: df is a combination of the rows. Counts of operations bound all searches.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownVariableType=false
# pyright: reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import combinations
from typing import Any, cast

import sympy as sp
from sympy.integrals.manualintegrate import manualintegrate

from lagrangian import bounded
from lagrangian.derive.constraints.pfaffian import RowForm, Sheet
from lagrangian.derive.constraints.spans import GenericPoint, OutsideError
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, gradient, reached
from lagrangian.records import dataclass

MAX_ATTEMPTS = 60
"""The largest number of antiderivatives that SymPy computes for one system."""

MAX_FACTORS = 4
"""The largest number of factors with which a form is integrated."""

MAX_NODES = 500
"""A coefficient with more nodes is not converted to an expression."""

MAX_LENGTH = 200
"""No integral is sought for a form with more operations."""

TRIED = ("exact forms", "factors 1/a, x, 1/x, 1/(x y), 1/(x² + y²), factors of one variable", "Natani's method")
"""The methods that are tried, in words."""

AGAIN = 12
"""The number of points at which an integral is verified if this cannot be decided exactly."""

OneForm = tuple[sp.Expr, ...]
"""The coefficients of a form over the variables."""


@dataclass(frozen=True)
class Integral:
    """f(q, t) = constant: the expression f, the rows from which it follows, and the method that found it.

    ``level`` is 0 for a row on positions; otherwise None, because the initial values determine the constant.
    """

    expression: sp.Expr
    rows: tuple[str, ...]
    how: str
    level: sp.Expr | None = None


@dataclass(frozen=True, eq=False)
class Curl:
    """A form ω over some variables and its differential dω, as nodes; ``moving`` are the entries that are not 0."""

    graph: Graph
    columns: list[int]
    form: list[int]
    moving: list[int]
    slopes: list[list[int]]

    @classmethod
    def of(cls, sheet: Sheet, form: Sequence[int], columns: Sequence[int]) -> Curl:
        """Differentiate a form."""
        moving = [k for k, a in enumerate(form) if a != sheet.graph.zero]
        slopes = [gradient(sheet.graph, a, columns) for a in form]
        return cls(sheet.graph, list(columns), list(form), moving, slopes)

    def logarithmic(self, sheet: Sheet, factor: sp.Expr) -> list[int]:
        """d ln μ."""
        node = sheet.node(factor)
        return [self.graph.div(slope, node) for slope in gradient(self.graph, node, self.columns)]

    def _at(self, i: int, j: int) -> int:
        return self.graph.sub(self.slopes[j][i], self.slopes[i][j])

    def integrable(self, zero: Callable[[Sequence[int]], bool]) -> bool:
        """Whether ω ∧ dω = 0, which means that a factor exists."""
        g, form = self.graph, self.form
        for i, j, k in combinations(range(len(form)), 3):
            parts = [g.mul(form[i], self._at(j, k)), g.mul(form[j], self._at(k, i)), g.mul(form[k], self._at(i, j))]
            if not zero([g.add(g.add(parts[0], parts[1]), parts[2])]):
                return False
        return True

    def closed(self, zero: Callable[[Sequence[int]], bool], slope: Sequence[int]) -> bool:
        """Whether d(μω) = 0, given d ln μ: d ln μ ∧ ω + dω = 0."""
        g, form = self.graph, self.form
        for i, j in combinations(range(len(form)), 2):
            turned = g.sub(g.mul(slope[i], form[j]), g.mul(slope[j], form[i]))
            if not zero([g.add(turned, self._at(i, j))]):
                return False
        return True


class IntegralSearch:
    """The search for the integrals of a system, until all of them are found."""

    def __init__(self, sheet: Sheet, place: GenericPoint, kept: Sequence[RowForm], wanted: int) -> None:
        self.sheet, self.place, self.kept, self.wanted = sheet, place, kept, wanted
        self.found: list[Integral] = []
        self._rows, self._span = place.span(), place.span()
        for k, form in enumerate(kept):
            self._rows.take(k, form.coefficients)
        self._asked: dict[tuple[sp.Expr, sp.Symbol], sp.Expr | None] = {}
        names = {x: sp.Dummy(_named(x), positive=True) for x in sheet.variables.all}
        self._plain: dict[Any, Any] = dict(names)
        self._back: dict[Any, Any] = {letter: x for x, letter in names.items()}
        self.letters: tuple[sp.Symbol, ...] = tuple(names.values())

    @property
    def done(self) -> bool:
        """Whether all integrals are found."""
        return len(self.found) >= self.wanted

    # -- what is looked at --------------------------------------------------------------------------------------------

    def positions(self) -> None:
        """Take the rows on positions as integrals."""
        for form in self.kept:
            if form.position is not None:
                self._keep(self.sheet.expression(form.position), "given", level=sp.S.Zero)

    def look(self, rows: Sequence[Sequence[int]]) -> None:
        """Look for integrals of rows, one by one, then for integrals of the rows restricted to the surfaces found."""
        for row in rows:
            if self.done:
                return
            if Curl.of(self.sheet, row, self.sheet.columns).integrable(self._zero):
                form = self._read(row)
                if form is not None:
                    self._try(form, {})
        if self.done or not self.found:
            return
        forms = [form for row in rows if (form := self._read(row)) is not None]
        progress = True
        while progress and not self.done:
            progress = False
            for form in forms:
                for left, meaning in self._restricted(form):
                    progress = (not self.done and self._try(left, meaning)) or progress

    def _read(self, row: Sequence[int]) -> OneForm | None:
        """The row as expressions, each without variables on which it depends only in appearance."""
        plain: list[sp.Expr] = []
        for node in row:
            if len(reached(self.sheet.graph, [node])) > MAX_NODES:
                return None
            expr = cast("sp.Expr", self.sheet.expression(node).xreplace(self._plain))
            moved = self.place.nonzero(self.sheet.differential(node))
            idle = [x for x, moves in zip(self.letters, moved, strict=True) if not moves]
            still = _somewhere(expr, [x for x in idle if expr.has(x)])
            plain.append(expr if still is None else still)
        if sum(bounded.size(a) for a in plain) > MAX_LENGTH:
            return None
        return tuple(_shorter(a) for a in plain)

    def _try(self, form: OneForm, meaning: dict[Any, Any]) -> bool:
        answer = self._integrated(form, self.letters)
        if answer is None:
            return False
        f, how = answer
        return self._keep(cast("sp.Expr", f.subs(meaning).xreplace(self._back)), how)

    def _restricted(self, form: OneForm) -> Iterator[tuple[OneForm, dict[Any, Any]]]:
        """The form, restricted to each surface f = c that can be solved for a variable."""
        for integral in list(self.found):
            f = cast("sp.Expr", integral.expression.xreplace(self._plain))
            level = sp.Dummy("c", real=True) if integral.level is None else integral.level
            for k, x in enumerate(self.letters):
                slope = bounded.diff(f, x)
                if slope == 0 or slope.has(x) or (form[k] == 0 and not any(a.has(x) for a in form)):
                    continue
                value = bounded.cancel((level - f.subs(x, 0)) / slope)
                left = [
                    sp.S.Zero if j == k else bounded.cancel(a.subs(x, value) + form[k].subs(x, value) * value.diff(y))
                    for j, (a, y) in enumerate(zip(form, self.letters, strict=True))
                ]
                if any(left):
                    yield tuple(left), ({level: f} if integral.level is None else {})

    def _keep(self, f: sp.Expr, how: str, level: sp.Expr | None = None) -> bool:
        """Keep f if df is a combination of the rows and independent of the integrals found before."""
        for expr in (f,) if level is not None else (_tidied(f), f):
            try:
                differential = self.sheet.differential(self.sheet.node(expr))
                names = self._rows.made_of(differential)
                again = 0 if self.place.exact else AGAIN
                for _ in range(again if names else 0):  # one point is on one side of every kink
                    self.place.renew()
                    names = names if self._rows.made_of(differential) is not None else None
                if names and self._span.take(len(self.found), differential):
                    rows = tuple(self.kept[k].name for k in names)
                    self.found.append(Integral(expr, rows, how, level))
                    return True
            except (OutsideError, ModelError):  # a function that the graph or the field does not have
                continue
        return False

    # -- one form -----------------------------------------------------------------------------------------------------

    def _integrated(self, form: OneForm, variables: Sequence[sp.Symbol]) -> tuple[sp.Expr, str] | None:
        """f with df proportional to the form, and the method that found it."""
        curl = self._curl(form, variables)
        if not curl.moving or not curl.integrable(self._zero):
            return None
        tried = 0
        for factor, how, slope in self._factors(form, variables, curl):
            if curl.closed(self._zero, slope):
                f = self._potential(tuple(bounded.cancel(factor * a) for a in form), variables)
                tried += 1
                if f is not None:
                    return f, how
                if tried == MAX_FACTORS:
                    break
        for k in curl.moving:
            if (factor := self._single(form, variables, k, curl.moving)) is not None:
                f = self._potential(tuple(factor * a for a in form), variables)
                if f is not None:
                    return f, "exact after a factor of one variable"
        return self._natani(form, variables, curl.moving) if len(curl.moving) > 2 else None

    def _curl(self, form: OneForm, variables: Sequence[sp.Symbol]) -> Curl:
        return Curl.of(self.sheet, [self.sheet.node(a) for a in form], [self.sheet.node(x) for x in variables])

    def _factors(
        self, form: OneForm, variables: Sequence[sp.Symbol], curl: Curl
    ) -> Iterator[tuple[sp.Expr, str, list[int]]]:
        """The factors μ that may make a form closed, simple ones first, with d ln μ."""
        one = cast("sp.Expr", sp.S.One)
        used = [(k, x) for k, x in enumerate(variables) if k in curl.moving or any(a.has(x) for a in form)]
        singles: list[sp.Expr] = [one, *(1 / x**2 for _, x in used), *(1 / x for _, x in used), *(x for _, x in used)]
        pairs = [1 / (x * y) for (_, x), (_, y) in combinations(used, 2)]
        pairs += [1 / (x**2 + y**2) for (_, x), (_, y) in combinations(used, 2)]
        scales = [one, *(1 / form[k] for k in curl.moving)]
        slopes = {factor: curl.logarithmic(self.sheet, factor) for factor in (*singles, *pairs, *scales)}
        graph = self.sheet.graph
        for scale in scales:
            for factor in (*singles, *pairs):
                slope = [graph.add(a, b) for a, b in zip(slopes[scale], slopes[factor], strict=True)]
                yield scale * factor, "exact" if scale * factor == 1 else "exact after a factor", slope

    def _single(self, form: OneForm, variables: Sequence[sp.Symbol], k: int, moving: Sequence[int]) -> sp.Expr | None:
        """μ(x_k) with μ'/μ = (∂a_k/∂x_j − ∂a_j/∂x_k)/a_j, if this depends on x_k alone."""
        j = next((j for j in moving if j != k), None)
        if j is None:
            return None
        slope = (bounded.diff(form[k], variables[j]) - bounded.diff(form[j], variables[k])) / form[j]
        alone = self._without(slope, [x for i, x in enumerate(variables) if i != k])
        power = None if alone is None else self._antiderivative(alone, variables[k])
        if power is None:
            return None
        factor = bounded.simplify(sp.exp(power))
        curl = self._curl(form, variables)
        return factor if curl.closed(self._zero, curl.logarithmic(self.sheet, factor)) else None

    def _zero(self, nodes: Sequence[int]) -> bool:
        """Whether nodes are zero at a generic point."""
        left = [node for node in nodes if node != self.sheet.graph.zero]
        try:
            return not left or not any(self.place.nonzero(left))
        except OutsideError:
            return False

    def _without(self, expr: sp.Expr, gone: Sequence[sp.Symbol]) -> sp.Expr | None:
        """The expression without variables on which it depends only in appearance; None if it does depend on them."""
        seen = [x for x in gone if expr.has(x)]
        node = self.sheet.node(expr)
        slopes = gradient(self.sheet.graph, node, [self.sheet.node(x) for x in seen])
        return _somewhere(expr, seen) if self._zero(slopes) else None

    def _potential(self, form: OneForm, variables: Sequence[sp.Symbol]) -> sp.Expr | None:
        """f with ∂f/∂x_k = a_k, integrated over one variable after the other."""
        f = cast("sp.Expr", sp.S.Zero)
        for k, (a, x) in enumerate(zip(form, variables, strict=True)):
            rest = self._without(a - bounded.diff(f, x), variables[:k])
            if rest is None:
                return None
            if rest != 0:
                part = self._antiderivative(rest, x)
                if part is None:
                    return None
                f = f + part
        return f

    def _antiderivative(self, expr: sp.Expr, x: sp.Symbol) -> sp.Expr | None:
        if (expr, x) not in self._asked:
            self._asked[expr, x] = None if len(self._asked) >= MAX_ATTEMPTS else _antiderivative(expr, x)
        return self._asked[expr, x]

    def _natani(
        self, form: OneForm, variables: Sequence[sp.Symbol], moving: Sequence[int]
    ) -> tuple[sp.Expr, str] | None:
        """Integrate over two variables, others constant: u(x, y; z) = U; then dU + S dz, if S depends on U and z."""
        for i, j in combinations(moving, 2):
            two = tuple(a if k in (i, j) else cast("sp.Expr", sp.S.Zero) for k, a in enumerate(form))
            inner = self._integrated((two[i], two[j]), (variables[i], variables[j]))
            if inner is None:
                continue
            u, level = inner[0], sp.Dummy("U", positive=True)
            scale = bounded.diff(u, variables[i]) / form[i]
            for gone in (i, j):
                solutions = bounded.searched(partial(sp.solve, check=False), u - level, variables[gone])
                if not solutions:
                    continue
                left: list[sp.Expr] = []
                for k, x in enumerate(variables):
                    if k in (i, j):
                        continue
                    share = cast("sp.Expr", (scale * form[k] - bounded.diff(u, x)).subs(variables[gone], solutions[0]))
                    alone = self._without(share, (variables[i], variables[j]))
                    if alone is None:
                        break
                    left.append(alone)
                else:
                    others = [x for k, x in enumerate(variables) if k not in (i, j)]
                    outer = self._integrated((sp.S.One, *left), (level, *others))
                    if outer is not None:
                        return outer[0].subs(level, u), "Natani's method"
        return None


def _shorter(expr: sp.Expr) -> sp.Expr:
    found = bounded.searched(sp.trigsimp, expr, calls=100_000)
    return bounded.cancel(expr if found is None else cast("sp.Expr", found))


def _antiderivative(expr: sp.Expr, x: sp.Symbol) -> sp.Expr | None:
    """∫ expr dx as elementary functions, for generic values of the other symbols."""
    expr = bounded.expand(expr) if expr.is_polynomial(x) else bounded.cancel(bounded.together(expr))
    for routine in (manualintegrate, partial(sp.integrate, meijerg=False)):
        f = bounded.searched(routine, expr, x)
        if f is not None:
            f = f.replace(sp.Piecewise, _first_branch)
            if not f.has(sp.Integral, sp.I, sp.erf, sp.Ei, sp.Si, sp.Ci, sp.li):
                return cast("sp.Expr", f)
    return None


def _first_branch(*pieces: Any) -> sp.Expr:
    return pieces[0].expr


def _length(expr: sp.Expr) -> tuple[int, str]:
    return int(sp.count_ops(expr)), str(expr)


def _named(x: sp.Expr) -> str:
    return str(getattr(x, "func", x)) if x.args else str(x)


PLACES = ((0, 0), (sp.pi / 2, 1), (sp.pi / 4, 1), (sp.pi / 3, 2), (sp.Rational(1, 2), sp.Rational(1, 2)))
"""Values of a variable inside a sine and elsewhere at which an expression is simple."""


def _somewhere(expr: sp.Expr, idle: Sequence[sp.Symbol]) -> sp.Expr | None:
    """The expression with simple values for the ``idle`` variables, on which it does not depend; None if not finite."""
    angles = {x for part in expr.atoms(sp.sin, sp.cos, sp.tan) for x in part.free_symbols}
    for angle, value in PLACES if idle else ():
        there = expr.subs({x: angle if x in angles else value for x in idle})
        if not there.has(sp.nan, sp.zoo, sp.oo, -sp.oo):
            return there
    return None if idle else expr


def _tidied(f: sp.Expr) -> sp.Expr:
    """A shorter function with the same surfaces: without a factor, and exp(f) if f is a sum of logarithms."""
    joined = bounded.searched(partial(sp.logcombine, force=True), f)
    if isinstance(joined, sp.log):
        f = joined.args[0]
    elif joined is not None and f.has(sp.log):
        without = bounded.simplify(sp.exp(joined))
        f = f if without.has(sp.log) or without.has(sp.exp) else without
    shorter = min((f, bounded.expand(f), bounded.simplify(f)), key=_length)
    plain = shorter.primitive()[1]
    return -plain if plain.could_extract_minus_sign() else plain
