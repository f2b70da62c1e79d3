"""Forward dynamics with rows: multipliers are unknowns of the same elimination.

To the form of `accelerations` every row c_r adds  λ_r (ċ_r + γ_r):  H[c_r, λ_r] = 1 and g[λ_r] = γ_r. Substitution
carries the entries of λ to the parents. Entries that cancel at a common ancestor vanish, so loops stay local. Two rules
say when a multiplier may be eliminated:

1. When all rates that its row reaches, its *support*, are eliminated. The pivot is then −a M_KK⁻¹ aᵀ, which is negative
   if the row is independent of those before it. Earlier it may vanish in ordinary configurations.
2. Together with a rate k whose coefficient a_k in the row consists of numbers and parameters alone, as long as no rate
   of the row is eliminated: v̇_k = −(γ + Σ a_j v̇_j)/a_k, and λ comes from the rate's own equation. The pair

       | h_kk  a_k |
       | a_k    0  |      has the determinant −a_k² and never fails, even if the rate has no inertia.

The λ of this form is −λ of `rows`, unless a problem is ``positive``: then g[λ_r] = −γ_r and H[c_r, λ_r] = −1.
"""

from __future__ import annotations

import heapq
from collections.abc import Mapping, Sequence

from lagrangian.dynamics.accelerations import Elimination, no_inertia
from lagrangian.dynamics.drags import Pressing
from lagrangian.dynamics.guard import Guard, Spared
from lagrangian.dynamics.massless import combine, eliminate_pair
from lagrangian.dynamics.row_problem import DependentRow, Problem, RowSolution
from lagrangian.dynamics.tape import Form
from lagrangian.records import dataclass, field

ROUNDING = 1e-12
"""A number below this is what is left of 0, such as cos of a rounded π/2: nothing is divided by it."""


@dataclass
class RowElimination(Elimination):
    """An elimination with rows. Multiplier r has the key −1 − r, so that it differs from all nodes."""

    problem: Problem = field(kw_only=True)
    spared: Mapping[int, Spared] = field(default_factory=dict[int, Spared], kw_only=True)
    support: dict[int, set[int]] = field(default_factory=dict[int, set[int]])
    sizes: dict[int, int] = field(default_factory=dict[int, int])
    divisors: list[tuple[str, int]] = field(default_factory=list[tuple[str, int]])
    bare: set[int] = field(default_factory=set[int])
    combining: bool = field(default=False, kw_only=True)
    combined: dict[int, int] = field(default_factory=dict[int, int])
    done: set[int] = field(default_factory=set[int])

    @classmethod
    def of(cls, problem: Problem, order: Sequence[int] = (), *, combining: bool = False) -> RowElimination:
        """The elimination of a problem before its first step.

        ``order``: the multipliers that will be eliminated by a pivot, if it is known from a trial. With ``combining``,
        rows are combined for rates without inertia of which nothing else can be said (`massless`).
        """
        made = cls(
            problem.graph,
            problem.tape,
            problem.H.copy(),
            dict(problem.linear),
            problem.names,
            problem=problem,
            spared=problem.spared(order),
            combining=combining,
        )
        made._attach()
        return made

    def __post_init__(self) -> None:
        """Record which unknowns use each entry, and which are minimised out: rates, and nodes that represent a rate."""
        tape, rows = self.tape, self.problem.rows
        self.place = {i: n for n, i in enumerate(tape.order)}
        gone = {rate for rate, _ in tape.exchanged.values()}
        self.leaves = {i for i in tape.order if (i not in tape.forms and i not in gone) or i in tape.exchanged}
        self.users = dict.fromkeys(tape.order, 0)
        for form in tape.forms.values():
            for k in form:
                self.users[k] += 1
        self.freed = [i for i in tape.order if not self.users[i]]
        self.guard = Guard(self.graph, {-1 - r: a.row.closure for r, a in enumerate(rows)}, self.spared)

    def _attach(self) -> None:
        for r, attached in enumerate(self.problem.rows):
            key = -1 - r
            negative, g = self.problem.positive, self.graph
            self.add_linear(key, g.neg(attached.value) if negative else attached.value)
            if attached.node in self.place:
                self.H.add(attached.node, key, g.neg(attached.sign) if negative else attached.sign)
            self.support[key] = self._reached(attached.node)
        for k, drag in enumerate(self.problem.drags):
            if drag.node in self.place:
                self.H.add(drag.node, self.problem.drag_key(k), self.graph.neg(drag.sign))
        carried = set[int]().union(*(self._reached(i) for i in self.problem.H.rows))
        self.bare = (self.leaves - carried) if self.support else set[int]()

    def _reached(self, node: int) -> set[int]:
        """The unknowns that a node depends on, without those that cancel."""
        g, forms, place = self.graph, self.tape.forms, self.place
        if node not in place:
            return set()
        weight = {node: g.one}
        waiting, found = [-place[node]], set[int]()
        while waiting:
            i = self.tape.order[-heapq.heappop(waiting)]
            c = weight.pop(i)
            if c == g.zero:
                continue
            if i in self.leaves or i not in forms:
                found.add(i)
                continue
            for k, inner in forms[i].items():
                if k not in weight:
                    weight[k] = g.zero
                    heapq.heappush(waiting, -place[k])
                weight[k] = g.add(weight[k], g.mul(c, inner))
        return found

    def too_early(self, i: int) -> bool:
        """Whether a rate without inertia of its own must wait: it has some only when all its rows are taken.

        With a part of them its pivot vanishes in ordinary configurations, as m l² sin² θ does.
        """
        return i in self.bare and any(i in support for support in self.support.values())

    # -- questions ----------------------------------------------------------------------------------------------

    def is_open(self, key: int) -> bool:
        """Whether a multiplier is still an unknown."""
        return key in self.support

    def ready_rows(self) -> list[int]:
        """The multipliers whose support is eliminated."""
        return [key for key, support in self.support.items() if not support]

    def paired(self, k: int) -> int | None:
        """The multiplier, of the shortest row, that may be eliminated together with the unknown k (rule 2)."""
        rows = self.H.rows
        found = [
            key
            for key, a in rows.get(k, {}).items()
            if key < 0 and key not in rows[key] and self.is_open(key) and self._divides(key, a)
        ]
        return min(found, key=lambda key: (len(rows[key]), -key), default=None)

    def _divides(self, key: int, a: int) -> bool:
        """Whether a coefficient is a number, or consists of parameters in a row without numbers as coefficients."""
        value = self.graph.value
        if (number := value(a)) is not None:
            return abs(number) > ROUNDING
        if not self.problem.constant([a]):
            return False
        return not any(i in self.leaves and value(c) is not None for i, c in self.H.rows[key].items())

    # -- steps --------------------------------------------------------------------------------------------------

    def add_linear(self, i: int, x: int) -> None:
        """Add x to g_i; for rows the magnitudes are summed too."""
        super().add_linear(i, x)
        if i < 0 and x != self.graph.zero:
            own = self.own(i)
            self.sizes[own] = self.graph.add(self.sizes.get(own, self.graph.zero), self.graph.abs(x))

    def take(self, i: int, *, pairs: bool) -> None:
        """Eliminate the next entry of the tape, with the multiplier that is paired with it."""
        if i in self.leaves:
            self._take_leaf(i, pairs=pairs)
        elif i in self.tape.turned:
            first, a, b, c, s = self.tape.turned[i]
            self.substitute_pair(first, i, a, b, c, s)
            self.found += [(x, self.graph.zero, self.tape.forms[x]) for x in (i, first)]
            self._close(i, first)
        else:
            self.substitute(i, self.tape.forms[i])
            self.found.append((i, self.graph.zero, self.tape.forms[i]))
            self._close(i)

    def _close(self, *nodes: int) -> None:
        self.done.update(nodes)
        for i in nodes:
            for k in self.tape.forms.get(i, ()):
                self.users[k] -= 1
                if not self.users[k]:
                    self.freed.append(k)

    def _take_leaf(self, i: int, *, pairs: bool) -> None:
        key = self.paired(i)
        name = self.names.get(i, "?")
        massless = i not in self.H.rows.get(i, {})
        if i in self.tape.exchanged:
            rate, sign = self.tape.exchanged[i]
            self.hand_over(i, rate, sign)
            self.done.add(rate)
            name = self.names.get(rate, "?")
        others: set[int] = set()
        if key is not None and (pairs or massless):
            others = self.support.pop(key) - self.done - {i}
            self._take_pair(i, key)
        elif massless and not self.problem.strict and not self.H.rows.get(i):
            self.g.pop(i, None)
            self.found.append((i, self.graph.zero, {}))
        elif self.combining and (massless or self.too_early(i)) and self._rows_on(i):
            self._combine(i)
        elif self.problem.strict and self.too_early(i):
            raise no_inertia(name)
        else:
            self.minimise(i, name)
        self._close(i)
        for support in self.support.values():
            if i in support:
                support.discard(i)
                support |= others

    def minimise(self, k: int, name: str) -> None:
        """Minimise v̇_k out, and add its magnitudes to the sizes of the rows."""
        g, row = self.graph, self.H.rows.get(k, {})
        if k in row:
            inverse = g.div(g.one, row[k])
            for key, a in row.items():
                if key < 0:
                    self.guard.gain(self.own(key), g.mul(g.mul(a, inverse), a))
        super().minimise(k, name)

    def take_row(self, key: int) -> None:
        """Eliminate a multiplier whose support is eliminated; its pivot gives the margin."""
        g = self.graph
        row, linear = self.H.pop(key), self.g.pop(key, g.zero)
        pivot = row.pop(key, g.zero)
        del self.support[key]
        own = self.own(key)
        if pivot != g.zero:
            self.eliminate(key, row, linear, self.guard.reciprocal(own, pivot, linear))
            return
        if self.problem.strict:
            raise DependentRow(self.problem.rows[-1 - own].row, linear)
        self.guard.leave_out(own, linear)
        self.found.append((key, g.zero, {}))

    def _take_pair(self, k: int, key: int) -> None:
        """v̇_k = −(γ + Σ a_j v̇_j)/a_k  and  λ = −(g_k + h_kk v̇_k + Σ h_kj v̇_j)/a_k."""
        g, H = self.graph, self.H
        own = dict(H.rows[k])
        a, h = own.pop(key), own.get(k, g.zero)
        row, value = H.pop(key), self.g.pop(key, g.zero)
        del row[k]
        if g.value(a) is None:
            self.divisors.append((self.problem.rows[-1 - self.own(key)].row.name, a))
        if h != g.zero:  # what leaves the other rows with this rate still belongs to their size
            inverse = g.div(g.one, h)
            for other, x in own.items():
                if other < 0:
                    self.guard.gain(self.own(other), g.mul(g.mul(x, inverse), x))
        self.guard.certain(self.own(key))
        over = g.neg(g.div(g.one, a))
        constant = g.mul(value, over)
        form: Form = {j: g.mul(x, over) for j, x in row.items()}
        load = self.g.get(k, g.zero)
        self.found.append((key, g.mul(load, over), {j: g.mul(x, over) for j, x in own.items()}))
        self.found.append((k, constant, form))
        if constant != g.zero:
            for j, x in own.items():
                self.add_linear(j, g.mul(x, constant))
        self.substitute(k, form)

    def own(self, key: int) -> int:
        """The row that a multiplier belongs to; a combined one belongs to that in whose place it is."""
        return self.combined.get(key, key)

    def _rows_on(self, k: int) -> list[int]:
        """The open multipliers that act on a rate."""
        return [key for key in self.H.rows.get(k, {}) if key < 0 and self.is_open(key)]

    def _combine(self, k: int) -> None:
        """Eliminate a rate without inertia with a combination of the rows that hold it."""
        old = self._rows_on(k)
        new = [self.problem.drag_key(len(self.problem.drags) + len(self.combined) + n) for n in range(len(old))]
        self.combined.update({key: self.own(row) for key, row in zip(new, old, strict=True)})
        reached = set[int]().union(*(self.support.pop(row) for row in old)) - {k}
        combine(self, k, old, new)
        self.support.update({key: set(reached) for key in new[1:]})
        self.guard.join([self.own(row) for row in old])
        self.guard.certain(self.own(new[0]))
        eliminate_pair(self, k, new[0])

    # -- result -------------------------------------------------------------------------------------------------

    def pressing(self) -> Pressing | None:
        """The equations of the multipliers that press on friction, after everything is eliminated."""
        g, problem = self.graph, self.problem
        if not problem.drags:
            return None
        forces = [problem.drag_key(k) for k in range(len(problem.drags))]
        keys = {row: -1 - row for drag in problem.drags for row in drag.rows}
        still = self.accelerations(dict.fromkeys(forces, g.zero))
        slopes: list[dict[int, int]] = []
        for force in forces:
            moved = self.accelerations({**dict.fromkeys(forces, g.zero), force: g.one}, slopes=True)
            slopes.append({row: problem.signed(moved[key]) for row, key in keys.items()})
        return Pressing.of(g, problem.drags, {row: problem.signed(still[key]) for row, key in keys.items()}, slopes)

    def solution(self) -> RowSolution:
        """The solution, after everything is eliminated."""
        g, problem, guard = self.graph, self.problem, self.guard
        pressing, forces = self.pressing(), dict[int, int]()
        if pressing is not None:
            normal = pressing.solved()
            forces = {
                problem.drag_key(k): g.mul(drag.factor, normal[drag.rows]) for k, drag in enumerate(problem.drags)
            }
        value = self.accelerations(forces)
        keys = [-1 - r for r in range(len(problem.rows))]
        return RowSolution(
            [g.add(x, value.get(v, g.zero)) for v, x in zip(problem.rates, problem.reference, strict=True)],
            [problem.signed(value[key]) for key in keys],
            [guard.margins[key] for key in keys],
            [g.neg(guard.skipped[key]) if problem.positive else guard.skipped[key] for key in keys],
            [self.sizes.get(key, g.zero) for key in keys],
            [guard.regular[key] for key in keys],
            self.divisors,
            pressing,
        )
