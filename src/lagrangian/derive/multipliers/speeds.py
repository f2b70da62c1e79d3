"""Fewer speeds: rows solved for rates, ξ̇ = S u + s₀, line by line, and never by what can vanish unless it is said.

In this order, until no row is left:

1. a coefficient that is a number: the row is solved for that rate, rates of lengths first; then one that is made of
   parameters, of a length;
2. two coefficients a, b with a² + b² constant are a turn: the new speed u = (b ξ̇_j − a ξ̇_k)/√(a² + b²), together
   with the row, gives both rates;
3. a coefficient made of parameters, of an angle;
4. else the row is divided by its simplest coefficient, which can vanish: the line says where.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Form
from lagrangian.derive.context import Context
from lagrangian.derive.multiplier import SpeedLine
from lagrangian.derive.multipliers.rows import RowForms
from lagrangian.model.names import moving_symbol
from lagrangian.page.formula import text
from lagrangian.records import dataclass, field


@dataclass(eq=False)
class Linear:
    """Σ coefficient · speed + rest, speeds by their symbols."""

    slopes: dict[sp.Expr, Form]
    rest: Form

    def without(self, speed: sp.Expr, value: Linear) -> Linear:
        """This with ``value`` in the place of a speed."""
        factor = self.slopes.get(speed)
        if factor is None:
            return self
        slopes = {s: f for s, f in self.slopes.items() if s != speed}
        for s, f in value.slopes.items():
            added = f * factor
            slopes[s] = reduced(slopes[s] + added if s in slopes else added)
        return Linear({s: f for s, f in slopes.items() if not f.is_zero}, self.rest + value.rest * factor)

    def expr(self, context: Context) -> sp.Expr:
        """As a readable expression."""
        return self.form(context).expr()

    def form(self, context: Context) -> Form:
        """As one form."""
        return context.algebra.total([*(f * context.algebra.form(s) for s, f in self.slopes.items()), self.rest])


@dataclass(eq=False)
class Speeds:
    """What an elimination found: every rate in the speeds that stay free, new ones with their meanings."""

    rates: dict[sp.Expr, Linear]
    free: list[sp.Expr]
    meanings: dict[sp.Expr, sp.Expr] = field(default_factory=dict[sp.Expr, sp.Expr])
    lines: list[SpeedLine] = field(default_factory=list[SpeedLine])
    open: int = 0

    @property
    def fails(self) -> list[sp.Expr]:
        """What the lines divide by that can vanish."""
        return [line.fails for line in self.lines if line.fails is not None]


def reduced_speeds(context: Context, rows: Sequence[RowForms], lengths: Sequence[sp.Expr], most_divided: int) -> Speeds:
    """Solve the rows; ``lengths`` are the rates of coordinates that are lengths.

    After ``most_divided`` divisions by what can vanish the rows that are left stay ``open``.
    """
    return _Elimination(context, rows, lengths).run(most_divided)


class _Elimination:
    def __init__(self, context: Context, rows: Sequence[RowForms], lengths: Sequence[sp.Expr]) -> None:
        self.context, self.algebra = context, context.algebra
        self.lengths = set(lengths)
        rates: list[sp.Expr] = [c.rate for c in context.model.coordinates]
        one, zero = self.algebra.number(1), self.algebra.total(())
        self.rows: list[tuple[str, Linear]] = []
        for row in rows:
            slopes = {v: slope for v, slope in zip(rates, row.slopes, strict=True) if not slope.is_zero}
            self.rows.append((row.row.name, Linear(slopes, row.drive)))
        self.found = Speeds({v: Linear({v: one}, zero) for v in rates}, list(rates))

    def run(self, most_divided: int) -> Speeds:
        """Solve row after row, the easiest first."""
        while self.rows:
            self.rows = [(name, row) for name, row in self.rows if row.slopes]
            if not any(rule() for rule in (self._number, self._parameter_of_length, self._turn, self._parameter)):
                if not self.rows or len(self.found.fails) == most_divided:
                    break
                self._divided()
        self.found.open = len(self.rows)
        return self.found

    # -- the rules --------------------------------------------------------------------------------------------------

    def _number(self) -> bool:
        return self._solved(lambda f, _: f.is_number, "its coefficient is a number")

    def _parameter_of_length(self) -> bool:
        return self._solved(
            lambda f, v: v in self.lengths and not (f.moves or f.turns), "its coefficient does not move"
        )

    def _parameter(self) -> bool:
        return self._solved(lambda f, _: not f.moves, "its coefficient does not move")

    def _solved(self, fits: Callable[[Form, sp.Expr], bool], why: str) -> bool:
        """Solve the first row that has a coefficient that fits; of several, that of a length, then of the last rate."""
        for k, (name, row) in enumerate(self.rows):
            order = {v: i for i, v in enumerate(self.found.free)}
            fitting = [v for v, f in row.slopes.items() if fits(f, v)]
            if not fitting:
                continue
            speed = max(fitting, key=lambda v: (v in self.lengths, -order[v] if v in self.lengths else order[v]))
            value = self._value(row, speed)
            reason = text(f"by '{name}', solved for ", speed, f": {why}")
            self._use(k, speed, value, SpeedLine(speed, value.expr(self.context), reason))
            return True
        return False

    def _turn(self) -> bool:
        """Two coefficients that are a turn: a new speed at right angles to the row."""
        for k, (name, row) in enumerate(self.rows):
            for j, i in _pairs(list(row.slopes)):
                a, b = row.slopes[j], row.slopes[i]
                square = a * a + b * b
                if square.moves or not (a.turns or b.turns or a.moves or b.moves):
                    continue
                length = self.algebra.form(cast("sp.Expr", sp.powdenest(sp.sqrt(square.expr()), force=True)))
                self._turned(k, name, row, (j, i), length)
                return True
        return False

    def _turned(self, k: int, name: str, row: Linear, pair: tuple[sp.Expr, sp.Expr], length: Form) -> None:
        """ξ̇_j = (b u − a rest)/ρ,  ξ̇_i = (−a u − b rest)/ρ with the row divided by ρ = √(a² + b²)."""
        j, i = pair
        inverse = self.algebra.form(1 / length.expr())
        a, b = row.slopes[j] * inverse, row.slopes[i] * inverse
        meaning = Linear({j: b, i: -a}, self.algebra.total(()))
        if meaning.expr(self.context).could_extract_minus_sign():
            meaning = Linear({j: -b, i: a}, meaning.rest)
        c, d = meaning.slopes[j], meaning.slopes[i]
        speed = self._new_name()
        self.context.algebra.generators.add_speed(speed)
        others = Linear({v: f for v, f in row.slopes.items() if v not in pair}, row.rest)
        left = {v: f * inverse for v, f in others.slopes.items()}
        rest = others.rest * inverse
        self.found.meanings[speed] = self._in_rates(meaning)
        self.found.free.insert(min(map(self.found.free.index, pair)), speed)
        if j in self.lengths or i in self.lengths:
            self.lengths.add(speed)
        values: list[tuple[sp.Expr, Linear]] = []
        for v, along, across in ((j, c, a), (i, d, b)):
            value = Linear({speed: along, **{o: -(f * across) for o, f in left.items()}}, -(rest * across))
            values.append((v, Linear({s: f for s, f in value.slopes.items() if not f.is_zero}, value.rest)))
        del self.rows[k]
        new = text(
            "a new speed that '" + name + "' leaves free; the squares of its two coefficients add up to a constant, so "
            "that nothing is divided by what can vanish"
        )
        self.found.lines.append(SpeedLine(speed, meaning.expr(self.context), new))
        for v, value in values:
            self._put(v, value, SpeedLine(v, value.expr(self.context), text(f"by '{name}' and this speed")))

    def _divided(self) -> None:
        """Divide the first row by its simplest coefficient and say where that fails."""
        name, row = self.rows[0]
        speed = min(row.slopes, key=lambda v: (row.slopes[v].size, v not in self.lengths))
        over = self._over(row.slopes[speed])
        value = self._value(row, speed)
        factors = sp.Mul.make_args(over.expr())
        divisor = sp.Mul(*(f for f in factors if self.algebra.form(f).moves))
        reason = text(f"by '{name}', divided by ", divisor, ", which can vanish")
        line = SpeedLine(speed, value.expr(self.context), reason, divisor)
        by = row.slopes[speed]
        rest = Linear({v: -f for v, f in row.slopes.items() if v != speed}, -row.rest)
        others = [(other, _scaled(linear, by, speed, rest)) for other, linear in self.rows[1:]]
        self._put(speed, value, line)
        self.rows = others

    def _over(self, form: Form) -> Form:
        """What stands over a form's denominators."""
        under = self.algebra.generators.denominators(form)
        return form * self.algebra.monomial(under) if under else form

    # -- putting in -------------------------------------------------------------------------------------------------

    def _value(self, row: Linear, speed: sp.Expr) -> Linear:
        """What a row says of one of its speeds."""
        inverse = -self.algebra.form(1 / row.slopes[speed].expr())
        return Linear({s: reduced(f * inverse) for s, f in row.slopes.items() if s != speed}, row.rest * inverse)

    def _use(self, k: int, speed: sp.Expr, value: Linear, line: SpeedLine) -> None:
        del self.rows[k]
        self._put(speed, value, line)

    def _put(self, speed: sp.Expr, value: Linear, line: SpeedLine) -> None:
        """Put a value in the place of a speed, everywhere."""
        self.rows = [(name, row.without(speed, value)) for name, row in self.rows]
        self.found.rates = {v: x.without(speed, value) for v, x in self.found.rates.items()}
        self.found.free.remove(speed)
        self.found.lines.append(line)

    def _in_rates(self, meaning: Linear) -> sp.Expr:
        """A new speed in rates of coordinates: earlier new speeds in it are written out."""
        expr = meaning.expr(self.context)
        if not self.found.meanings:
            return expr
        return self.context.readable(cast("sp.Expr", expr.xreplace(self.found.meanings)))

    def _new_name(self) -> sp.Expr:
        """v for the first new speed, then u1, u2, …; names that the system has are passed over."""
        taken = {*self.context.model.symbols, *(str(s.func) for s in self.found.meanings)}
        return moving_symbol(next(name for name in _names() if name not in taken))


def reduced(form: Form) -> Form:
    """A quotient of parameters after common factors are cancelled; anything else as it is."""
    algebra = form.algebra
    if form.moves or form.turns or not algebra.generators.denominators(form):
        return form
    return algebra.form(bounded.cancel(bounded.together(form.expr())))


def _scaled(row: Linear, by: Form, speed: sp.Expr, value: Linear) -> Linear:
    """A row times ``by``, with ``value`` in the place of ``by`` · speed: nothing is divided."""
    if (factor := row.slopes.get(speed)) is None:
        return row
    times = Linear({s: f * by for s, f in row.slopes.items() if s != speed}, row.rest * by)
    return Linear({**times.slopes, speed: factor}, times.rest).without(speed, value)


def _names() -> Iterator[str]:
    yield "v"
    k = 0
    while True:
        k += 1
        yield f"u{k}"


def _pairs(speeds: Sequence[sp.Expr]) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    for k, a in enumerate(speeds):
        for b in speeds[k + 1 :]:
            yield a, b
