"""The equations without multipliers: Sᵀ (d/dt ∂L/∂ξ̇ − ∂L/∂ξ − Ξ) = 0 with ξ̇ = S u + s₀.

S spans the motions that the rows allow, so Sᵀ Aᵀ = 0 and no multiplier is left. The rates are put in after L has been
differentiated, never before.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Form, OutOfReach, Term
from lagrangian.derive.context import Context, fit, fit_terms
from lagrangian.derive.forces import Contribution
from lagrangian.derive.lagrange import LeftSide
from lagrangian.derive.multiplier import Minimal, equality
from lagrangian.derive.multipliers.rows import RowForms
from lagrangian.derive.multipliers.speeds import Linear, Speeds, reduced_speeds
from lagrangian.model import Friction, time
from lagrangian.page.formula import EquationTerm, Heading, Item, Left, Name, Text, formula, text
from lagrangian.records import dataclass

MOST_DIVIDED = 2
"""Rows that are divided by what can vanish, after which the elimination is not shown any more."""


@dataclass(frozen=True, eq=False)
class Found:
    """The equations without multipliers, or the reason why there are none; and what the page says of them."""

    minimal: Minimal | None
    reason: Text | None
    items: tuple[Item, ...]


def without_multipliers(
    context: Context,
    rows: tuple[RowForms, ...],
    sides: tuple[LeftSide, ...],
    found: tuple[Contribution, ...],
    lengths: Mapping[sp.Expr, bool],
) -> Found:
    """Eliminate the multipliers where that needs no division by what can vanish; else say why not.

    ``lengths`` tells which coordinates are lengths.
    """
    if pressed := next((f for f in context.model.elements if isinstance(f, Friction) and f.pressed_by), None):
        whose = " and ".join(f"'{row}'" for row in pressed.pressing)
        held = "the one" if len(pressed.pressing) == 1 else "those"
        reason = text(f"The multipliers stay: {pressed.title} holds {held} of {whose}.")
        return Found(None, reason, (Heading(text(TITLE)), reason))
    try:
        rates = [c.rate for c in context.model.coordinates if lengths[c.symbol]]
        speeds = reduced_speeds(context, rows, rates, MOST_DIVIDED)
        if speeds.fails or speeds.open:
            return _refused(context, speeds)
        minimal = _Reduced(context, speeds, sides, found).minimal()
    except OutOfReach:
        reason = text("Without multipliers the equations would be too long to write out; those above are kept.")
        return Found(None, reason, (Heading(text(TITLE)), reason))
    return Found(minimal, None, tuple(_shown(context, minimal)))


NOTHING_LESS = Found(None, None, ())
"""Of a system without constraints."""

TITLE = "Equations without multipliers"


def _refused(context: Context, speeds: Speeds) -> Found:
    """Rule 4: the lines with what they divide by, and why they are not used."""
    items: list[Item] = [Heading(text(TITLE))]
    if not speeds.open:
        for line in speeds.lines:
            items += [formula(line.rate, fit(line.value), note=line.reason)]
    parts: list[str | Left] = []
    for divisor in speeds.fails:
        parts += [" or " if parts else "", fit(divisor), " = 0"]
    reason = text(
        "The rows cannot be solved for rates without dividing by what can vanish: that fails where ",
        *parts,
        ". So the equations with multipliers are kept, which hold everywhere.",
    )
    return Found(None, reason, (*items, reason))


class _Reduced:
    """Left- and right-hand sides along the speeds."""

    def __init__(
        self, context: Context, speeds: Speeds, sides: tuple[LeftSide, ...], found: tuple[Contribution, ...]
    ) -> None:
        self.context, self.algebra, self.speeds = context, context.algebra, speeds
        model = context.model
        self.rates: dict[sp.Expr, Linear] = {c.rate: speeds.rates[c.rate] for c in model.coordinates}
        forms = {v: x.form(context) for v, x in self.rates.items()}
        self.table: dict[sp.Expr, sp.Expr] = {}
        for c in model.coordinates:
            self.table[c.rate] = forms[c.rate].raw()
        for c in model.coordinates:
            self.table[c.acceleration] = self._put(forms[c.rate].total_derivative()).raw()
        self.left: list[dict[str, Form]] = []
        self.right: list[dict[str, Form]] = []
        for i, side in enumerate(sides):
            left = [(share.element.title, part) for share, part in side.parts]
            left += [(f.element.title, -f.virtual) for f in found if f.index == i and f.resists]
            right = [(f.element.title, f.virtual) for f in found if f.index == i and not f.resists]
            self.left.append(self._put_all(left))
            self.right.append(self._put_all(right))

    def _put_all(self, parts: Sequence[tuple[str, Form]]) -> dict[str, Form]:
        """The parts of a side by element, in the speeds."""
        found: dict[str, Form] = {}
        for title, form in parts:
            put = self._put(form)
            found[title] = found[title] + put if title in found else put
        return found

    def _put(self, form: Form) -> Form:
        """A form with the rates and accelerations in the speeds; a free rate stays as it is."""
        table = {k: x for k, x in self.table.items() if x != k}
        return self.algebra.form(cast("sp.Expr", bounded.replaced(form.raw(), table))) if table else form

    def minimal(self) -> Minimal:
        """All of it as data."""
        context, speeds = self.context, self.ordered()
        n = len(self.rates)
        S = [[x.slopes.get(u, self.algebra.total(())) for u in speeds] for x in self.rates.values()]
        lefts = [self._along(S, k, self.left) for k in range(len(speeds))]
        rights = [self._along(S, k, self.right) for k in range(len(speeds))]
        terms: list[tuple[EquationTerm, ...]] = []
        equations: list[sp.Eq] = []
        sides: list[tuple[tuple[sp.Expr, ...], tuple[sp.Expr, ...]]] = []
        for left, right in zip(lefts, rights, strict=True):
            one = tuple(EquationTerm(t.expr, t.kind, self._names(left, t.expr)) for t in self._terms(left))
            other = tuple(EquationTerm(t.expr, "input", self._names(right, t.expr)) for t in self._terms(right))
            terms.append(one + other)
            sides.append((tuple(t.expr for t in one), tuple(t.expr for t in other)))
            equations.append(equality(*(sp.Add(*side) for side in sides[-1])))
        total = self.algebra.total
        residuals = [total(a.values()) - total(b.values()) for a, b in zip(lefts, rights, strict=True)]
        return Minimal(
            tuple(speeds),
            self.speeds.meanings,
            sp.ImmutableMatrix(n, len(speeds), [x.expr() for row in S for x in row]),
            sp.ImmutableMatrix(n, 1, [x.rest.expr() for x in self.rates.values()]),
            {v: x.expr(context) for v, x in self.rates.items()},
            tuple(self.speeds.lines),
            tuple(equations),
            tuple(terms),
            tuple(sides),
            lambda: _accelerations(context, speeds, residuals),
        )

    def ordered(self) -> list[sp.Expr]:
        """Rates that stay free in the order of the coordinates, then the new speeds."""
        free = self.speeds.free
        return [u for u in free if u in self.rates] + [u for u in free if u not in self.rates]

    def _along(self, S: list[list[Form]], k: int, sides: list[dict[str, Form]]) -> dict[str, Form]:
        """Column k of S times the sides, by element."""
        found: dict[str, list[Form]] = {}
        for row, parts in zip(S, sides, strict=True):
            for title, form in parts.items() if row[k].parts else ():
                found.setdefault(title, []).append(row[k] * form)
        return {title: self.algebra.total(forms) for title, forms in found.items()}

    def _terms(self, parts: Mapping[str, Form]) -> list[Term]:
        return self.algebra.total(parts.values()).terms()

    def _names(self, parts: Mapping[str, Form], term: sp.Expr) -> tuple[str, ...]:
        """The elements behind a term."""
        keys = self.context.form(term).keys()
        return tuple(title for title, form in parts.items() if not form.restricted(keys).is_zero)


def _shown(context: Context, minimal: Minimal) -> Iterator[Item]:
    """How the rates were found, and the equations."""
    yield Heading(text(TITLE))
    yield text(
        "The rows are solved for rates, so that the speeds that are left can be chosen freely. Along them the "
        "constraints do no work and the multipliers drop out. The rates are substituted after ",
        Name("L"),
        " has been differentiated, never before.",
    )
    last = {line.rate: line.value for line in minimal.lines}
    changed = {v: x for v, x in minimal.rates.items() if v in last and last[v] != x}
    for line in minimal.lines:
        yield formula(line.rate, fit(line.value), note=line.reason, brief=line.rate not in changed)
    if changed:
        yield text("All together:")
    for rate, value in changed.items():
        yield formula(rate, fit(value), brief=True)
    for left, right in minimal.sides:
        yield formula(fit_terms(left), fit_terms(right), brief=True, boxed=True)


def _accelerations(context: Context, speeds: list[sp.Expr], residuals: list[Form]) -> Mapping[sp.Expr, sp.Expr]:
    """u̇_k = det(M with column k replaced by −h)/det M."""
    rates = [
        cast("sp.Expr", sp.Derivative(u.expr, (time, 2)) if isinstance(u, sp.Derivative) else sp.Derivative(u, time))
        for u in speeds
    ]
    M = [[r.diff(a) for a in rates] for r in residuals]
    h = [
        r - context.algebra.total([entry * context.algebra.form(a) for entry, a in zip(row, rates, strict=True)])
        for r, row in zip(residuals, M, strict=True)
    ]
    whole = _determinant(context, M).expr()
    solved: dict[sp.Expr, sp.Expr] = {}
    for k, a in enumerate(rates):
        replaced = [[*row[:k], -below, *row[k + 1 :]] for row, below in zip(M, h, strict=True)]
        solved[a] = _determinant(context, replaced).expr() / whole
    return solved


def _determinant(context: Context, rows: list[list[Form]]) -> Form:
    """By the first column."""
    if not rows:
        return context.algebra.number(1)
    pieces: list[Form] = []
    for i, row in enumerate(rows):
        if row[0].parts:
            minor = _determinant(context, [other[1:] for k, other in enumerate(rows) if k != i])
            pieces.append((row[0] * minor).scaled((-1) ** i))
    return context.algebra.total(pieces)
