"""What the entries of states are in functions of a program that return accelerations alone, or residuals.

accel(q, qd)                       qdd = A\\b, of two columns
acc = f(z)                         the same of one column, [q; qd] or [q1, qd1, q2, …]
res = f(q, v, a)                   [M a1 + …; J a2 + …], which is 0; also f(x, xd, xdd, phi, …)
res = f(t, y, yp)                  [yp(1) − y(2); m yp(2) + k y(1)], which is 0
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import permutations
from typing import Any, cast

import sympy as sp

from lagrangian.check.reading.carried_out.evaluator import Evaluator
from lagrangian.check.reading.carried_out.moving_names import MovingNames
from lagrangian.check.reading.carried_out.values import TIME, OwnFunction, State, Value
from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.shortened import AnswerScope
from lagrangian.model import Model
from lagrangian.records import dataclass

ACCELERATES = re.compile(r"acc|dd|pp\b|rhs|eom|dyn|motion|forward|ode|deriv|_tt|punktpunkt|beschl", re.IGNORECASE)
"""Names of functions that return accelerations, and of their results."""

Motion = tuple[list[tuple[sp.Expr, sp.Expr]], dict[sp.Symbol, sp.Expr]]
"""Pairs of what is equal, q̈ and its value, and what the entries of the states are."""


@dataclass(frozen=True, eq=False)
class Layouts:
    """Finds which coordinates and rates the entries of states are; ``comments`` are the entries that these list, and
    ``rated`` the coordinate whose rate a name is."""

    run: Evaluator
    model: Model
    scope: AnswerScope
    comments: Callable[[str], dict[int, str]]
    rated: Callable[[str], str | None]

    def of_accelerations(self, f: OwnFunction, states: Sequence[State], rates: Sequence[sp.Expr]) -> Motion | None:
        """The accelerations that a function returns, one for each coordinate, perhaps above multipliers; None if it may
        be something else."""
        n = len(self.model.coordinates)
        rates, more = rates[:n], rates[n:]
        solved = any(x.free_symbols & self.run.solved.keys() for x in rates)
        named = any(map(ACCELERATES.search, (f.name, f.out or "")))
        if len(rates) != n or not states or not (solved or named):
            return None
        if len(more) > len(self.model.constraints) or not set(more) <= self.run.solved.keys():
            return None
        if any(x in state.entries.values() for state in states for x in rates):
            return None  # the rate of a state
        first, *others = states
        if others and all(k <= n for state in states[:2] for k in state.entries):
            second, *others = others
            places = {(0, k): first.entry(k + 1) for k in range(n)} | {(1, k): second.entry(k + 1) for k in range(n)}
            found = self._named(places, self._said(first) | {n + k: x for k, x in self._said(second).items()}, n)
        else:
            found = next(filter(None, self._of_one(first, n)), None)
        if found is None or any(k > len(self.model.inputs) for x in others for k in x.entries):
            return None
        order, table = found
        for other in others:
            table |= {x: sp.Symbol(self.model.inputs[k - 1].name) for k, x in other.entries.items()}
        return [(sp.Function(q)(TIME).diff(TIME, 2), x) for q, x in zip(order, rates, strict=True)], table

    def _of_one(self, state: State, n: int) -> Iterator[tuple[list[str], dict[sp.Symbol, sp.Expr]] | None]:
        """A column of coordinates above their rates, and one of pairs of them."""
        if not n < max(state.entries, default=0) <= 2 * n:
            return
        said = self._said(state)
        for place in (lambda order, k: order * n + k, lambda order, k: 2 * k + order):
            places = {(order, k): place(order, k) + 1 for order in (0, 1) for k in range(n)}
            listed = {order * n + k + 1: said[at] for (order, k), at in places.items() if at in said}
            yield self._named({key: state.entry(at) for key, at in places.items()}, listed, n)

    def _said(self, state: State) -> dict[int, str]:
        """The names of the entries of a state, in the program or in a comment."""
        own = {k: name for k, x in state.entries.items() if (name := self.run.aliases.get(x))}
        return self.comments(state.name) | own

    def _named(
        self, places: dict[tuple[int, int], sp.Symbol], said: dict[int, str], n: int
    ) -> tuple[list[str], dict[sp.Symbol, sp.Expr]] | None:
        """The coordinates in their order, and what the entries are; None if what is ``said`` of them is something else.

        Names that say nothing are those of the coordinates that are left, in the order of the system.
        """
        coordinates = [c.name for c in self.model.coordinates]
        found: dict[int, str] = {}
        for k, name in said.items():
            order, q = self._meaning(name)
            if order is None or q is None:
                continue
            if order != (k - 1) // n or found.get((k - 1) % n, q) != q:
                return None
            found[(k - 1) % n] = q
        left = [q for q in coordinates if q not in found.values()]
        if len(found) + len(left) != n:
            return None
        order_of = [found[k] if k in found else left.pop(0) for k in range(n)]
        moving = [sp.Function(q)(TIME) for q in order_of]
        return order_of, {x: moving[k].diff(TIME, order) if order else moving[k] for (order, k), x in places.items()}

    def _meaning(self, name: str) -> tuple[int | None, str | None]:
        """Whether a name is one of a coordinate or of its rate, and of which."""
        coordinates = {c.name for c in self.model.coordinates}
        meant = [x for x in self.scope.meanings(name)[0] if x in coordinates]
        if len(meant) == 1:
            return 0, meant[0]
        twice = [s for k, s in spelled_rates(name) if k == 2 and set(self.scope.meanings(s)[0]) & coordinates]
        if twice:
            return 2, self.scope.meanings(twice[0])[0][0]
        stem = self.rated(name)
        of = [x for x in self.scope.meanings(stem)[0] if x in coordinates] if stem else []
        return (1, of[0]) if of else (None, None)

    def of_sums(self, given: Mapping[str, Value], rates: Sequence[sp.Expr]) -> Motion | None:
        """The equations of a function of accelerations that is 0, in letters or in a third column."""
        states = [x for x in given.values() if isinstance(x, State)]
        solved = any(x.free_symbols & self.run.solved.keys() for x in rates)
        if solved or any(x in s.entries.values() for x in rates for s in states):
            return None
        n, table = len(self.model.coordinates), dict[sp.Symbol, sp.Expr]()
        if states:
            free = [State(k) if isinstance(x, sp.Symbol) and x != TIME else x for k, x in given.items()]
            columns = [x for x in free if isinstance(x, State) and not self.scope.meanings(x.name)[0]][:3]
            others = [x for x in states if x not in columns]
            if len(columns) < 3 or any(k > n for x in columns for k in x.entries):
                return None
            said = {order * n + k: x for order in range(3) for k, x in self._said(columns[order]).items()}
            places = {(order, k): columns[order].entry(k + 1) for order in range(3) for k in range(n)}
            named = self._named(places, said, n)
            if named is None or any(k > len(self.model.inputs) for x in others for k in x.entries):
                return None
            inputs = {x: sp.Symbol(self.model.inputs[k - 1].name) for s in others for k, x in s.entries.items()}
            table = named[1] | inputs
        moving = [MovingNames(self.model, self.scope).order(cast("sp.Expr", x.xreplace(table))) == 2 for x in rates]
        return ([(cast("sp.Expr", sp.S.Zero), x) for x in rates], table) if sum(moving) >= n else None

    def of_residuals(self, states: Sequence[State], rates: Sequence[sp.Expr]) -> Motion | None:
        """The equations of a function of a state and of its rates that is 0; what has no rate there is a multiplier."""
        for y, yp in permutations(states, 2):
            pairs = {r: pair for r in rates if (pair := _rate_and_state(r, yp, y)) is not None}
            rate_of = dict(pairs.values())
            used = {k for k, x in yp.entries.items() if any(r.has(x) for r in rates)}
            if not rate_of or not used <= {*rate_of, *rate_of.values()}:
                continue
            names = self._said(y)
            coordinates = [c.name for c in self.model.coordinates]
            if len(rate_of) != len(coordinates) and not all(i in names for i in rate_of):
                continue
            table: dict[sp.Symbol, sp.Expr] = {}
            for k, (i, j) in enumerate(sorted(rate_of.items())):
                q: Any = sp.Function(names.get(i) or coordinates[k])(TIME)
                table |= {y.entry(i): q, y.entry(j): q.diff(TIME)}
                table |= {yp.entry(i): q.diff(TIME), yp.entry(j): q.diff(TIME, 2)}
            left = {k: x for k, x in y.entries.items() if x not in table and any(r.has(x) for r in rates)}
            table |= {x: sp.Symbol(names.get(k, f"lambda_{k}")) for k, x in left.items()}
            return [(cast("sp.Expr", sp.S.Zero), x) for x in rates if x not in pairs], table
        return None


def _rate_and_state(expr: sp.Expr, yp: State, y: State) -> tuple[int, int] | None:
    """The places i and j of yp(i) − y(j), of either sign; None for anything else."""
    parts = sp.Add.make_args(expr)
    for sign in (1, -1):
        rate = [k for k, x in yp.entries.items() if sign * x in parts]
        state = [k for k, x in y.entries.items() if -sign * x in parts]
        if len(parts) == 2 and len(rate) == len(state) == 1:
            return rate[0], state[0]
    return None
