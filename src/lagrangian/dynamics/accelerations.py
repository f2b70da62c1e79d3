"""Forward dynamics by eliminating the velocity tape.

Gauss's principle: the accelerations minimize  ½ Σ H_ij v̇_i v̇_j + Σ g_i v̇_i  over all motions that the tape allows,
where H contains the inertias at the bodies' velocity nodes and g the missing forces at q̈ = 0. Going backwards over the
tape, a step v_i = Σ c_ij v_j is substituted (no division) and a rate is eliminated by minimizing (one reciprocal: its
pivot is a Schur complement of an inertia, positive wherever the mass matrix is positive definite). One pass forwards
then gives every q̈. The cost is linear in the tape's length for any fixed number of neighbours; with no tape between
the rates and H it is the sparse LDLᵀ of the mass matrix. The articulated-body algorithm is the special case of a chain
of joints.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from lagrangian.dynamics.tape import EliminationTape, Form
from lagrangian.dynamics.vectors import dot, rotated
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, jvp, vjp
from lagrangian.records import dataclass, field


class Quadratic:
    """A sparse symmetric H over nodes: the quadratic form ½ Σ_ij H_ij v_i v_j."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self.rows: dict[int, dict[int, int]] = {}

    def add(self, i: int, k: int, h: int) -> None:
        """Add h to H_ik and H_ki; on the diagonal, to H_ii once."""
        g = self.graph
        if h == g.zero:
            return
        row = self.rows.setdefault(i, {})
        total = g.add(row[k], h) if k in row else h
        if total == g.zero:
            del row[k]
            if k != i:
                del self.rows[k][i]
            return
        row[k] = total
        if k != i:
            self.rows.setdefault(k, {})[i] = total

    def couple(self, i: int, k: int, h: int) -> None:
        """Add the energy h v_i v_k: twice h on the diagonal where i is k."""
        self.add(i, k, self.graph.mul(self.graph.const(2.0), h) if i == k else h)

    def pop(self, i: int) -> dict[int, int]:
        """Remove row and column i; return the row."""
        row = self.rows.pop(i, {})
        for k in row:
            if k != i:
                del self.rows[k][i]
        return row

    def without(self, gone: Collection[int]) -> Quadratic:
        """A copy without the given rows and columns."""
        other = self.copy()
        for i in gone:
            other.pop(i)
        return other

    def copy(self) -> Quadratic:
        """An independent copy."""
        other = Quadratic(self.graph)
        other.rows = {i: dict(row) for i, row in self.rows.items()}
        return other


@dataclass
class Elimination:
    """The elimination of one tape: H, one or more linear terms, and how each rate is recovered."""

    graph: Graph
    tape: EliminationTape
    H: Quadratic
    g: dict[int, int]
    names: Mapping[int, str]
    found: list[tuple[int, int, Form]] = field(
        default_factory=list
    )  # (unknown, constant, form): unknown = constant + Σ

    def add_linear(self, i: int, x: int) -> None:
        """Add x to g_i."""
        total = self.graph.add(self.g.get(i, self.graph.zero), x)
        if total == self.graph.zero:
            self.g.pop(i, None)
        else:
            self.g[i] = total

    def substitute(self, i: int, form: Form) -> None:
        """Replace v_i by Σ_j c_j v_j: with y = row of i,  H_jk += c_j y_k,  H_jl += c_j h_ii c_l,  g_j += c_j g_i."""
        g, H = self.graph, self.H
        row = H.pop(i)
        linear = self.g.pop(i, g.zero)
        h = row.pop(i, g.zero)
        parents = list(form)
        for j in parents:
            self.add_linear(j, g.mul(form[j], linear))
            for k, y in row.items():
                if k not in form:
                    H.add(j, k, g.mul(form[j], y))
        full = {j: g.add(g.mul(form[j], h), row.get(j, g.zero)) for j in parents}  # z_j = c_j h_ii + y_j
        for n, j in enumerate(parents):
            H.add(j, j, g.mul(form[j], g.add(full[j], row.get(j, g.zero))))  # c_j (z_j + y_j)
            for k in parents[n + 1 :]:
                H.add(j, k, g.add(g.mul(form[j], full[k]), g.mul(form[k], row.get(j, g.zero))))  # c_j z_k + c_k y_j

    def substitute_pair(self, first: int, second: int, a: int, b: int, c: int, s: int) -> None:
        """Replace the rotated pair first = c a + s b, second = c b − s a, using c² + s² = 1.

        With u = s (h₁₁ − h₂₂) + 2 c h₁₂ the block becomes h_aa = h₁₁ − s u, h_bb = h₂₂ + s u, h_ab = c u − h₁₂.
        """
        g, H = self.graph, self.H
        one, two = H.pop(first), H.pop(second)
        h11, h22, h12 = one.pop(first, g.zero), two.pop(second, g.zero), one.pop(second, g.zero)
        u = g.add(g.mul(s, g.sub(h11, h22)), g.mul(g.mul(g.const(2.0), c), h12))
        su = g.mul(s, u)
        H.add(a, a, g.sub(h11, su))
        H.add(b, b, g.add(h22, su))
        H.add(a, b, g.sub(g.mul(c, u), h12))
        for k in dict.fromkeys((*one, *two)):
            x, y = rotated(g, one.get(k, g.zero), two.get(k, g.zero), c, s)
            H.couple(a, k, x)
            H.couple(b, k, y)
        x, y = rotated(g, self.g.pop(first, g.zero), self.g.pop(second, g.zero), c, s)
        self.add_linear(a, x)
        self.add_linear(b, y)

    def minimise(self, k: int, name: str) -> None:
        """Eliminate v̇_k by minimizing: v̇_k = −(g_k + Σ_i h_ki v̇_i)/h_kk,  H_ij −= h_ik h_kj/h_kk,  g_i −= h_ik
        g_k/h_kk."""
        g = self.graph
        row = self.H.pop(k)
        linear = self.g.pop(k, g.zero)
        pivot = row.pop(k, g.zero)
        if pivot == g.zero:
            raise no_inertia(name)
        self.eliminate(k, row, linear, g.div(g.one, pivot))

    def eliminate(self, k: int, row: Mapping[int, int], linear: int, inverse: int) -> None:
        """Eliminate v̇_k = −(linear + Σ_i row_i v̇_i) · inverse from the form."""
        g, H = self.graph, self.H
        weights = {i: g.mul(h, inverse) for i, h in row.items()}
        neighbours = list(row)
        for n, i in enumerate(neighbours):
            self.add_linear(i, g.neg(g.mul(weights[i], linear)))
            for j in neighbours[n:]:
                H.add(i, j, g.neg(g.mul(weights[i], row[j])))
        self.found.append((k, g.neg(g.mul(linear, inverse)), {i: g.neg(w) for i, w in weights.items()}))

    def exchange(self, t: int, rate: int, sign: int) -> None:
        """Use t = p ± rate as the unknown instead of its rate; then rate = ±(t − p)."""
        self.hand_over(t, rate, sign)
        self.minimise(t, self.names.get(rate, "?"))

    def hand_over(self, t: int, rate: int, sign: int) -> None:
        """Distribute what acts on a rate to t = p ± rate and to p."""
        g = self.graph
        form = {j: c for j, c in self.tape.forms[t].items() if j != rate}
        load = self.g.pop(rate, g.zero)
        turned = g.mul(sign, load)
        self.add_linear(t, turned)
        for j, c in form.items():
            self.add_linear(j, g.neg(g.mul(c, turned)))
        back = {t: sign, **{j: g.neg(g.mul(sign, c)) for j, c in form.items()}}
        self.found.append((rate, g.zero, back))

    def run(self, *, minimise: bool = True) -> None:
        """Process the tape backwards; without ``minimise`` the rates stay, and H over them is the mass matrix."""
        tape = self.tape
        done: set[int] = set()
        for i in reversed(tape.order):
            if i in done:
                continue
            if i in tape.exchanged and minimise:
                rate, sign = tape.exchanged[i]
                self.exchange(i, rate, sign)
                done.add(rate)
            elif i in tape.turned:
                first, a, b, c, s = tape.turned[i]
                self.substitute_pair(first, i, a, b, c, s)
                done.add(first)
                self.found += [(i, self.graph.zero, tape.forms[i]), (first, self.graph.zero, tape.forms[first])]
            elif i in tape.forms:
                self.substitute(i, tape.forms[i])
                self.found.append((i, self.graph.zero, tape.forms[i]))
            elif minimise:
                self.minimise(i, self.names.get(i, "?"))

    def accelerations(self, given: Mapping[int, int] | None = None, *, slopes: bool = False) -> dict[int, int]:
        """v̇ of every node, by one forward pass: v̇ = constant + Σ c_j v̇_j, the last eliminated node first.

        ``given`` are unknowns that were not eliminated; with ``slopes`` the constants are left out.
        """
        g = self.graph
        value: dict[int, int] = dict(given or {})
        for i, constant, form in reversed(self.found):
            terms = [g.mul(c, value[k]) for k, c in form.items()]
            total = g.zero if slopes else constant
            for x in terms:
                total = g.add(total, x)
            value[i] = total
        return value


def no_inertia(name: str) -> ModelError:
    """Return the error about a coordinate that moves no mass."""
    return ModelError(
        f"coordinate '{name}' moves no mass of its own: the mass matrix is singular",
        fix=f"give mass or inertia to what '{name}' moves, or leave the coordinate out",
        code="E201",
    )


def solve(
    graph: Graph,
    tape: EliminationTape,
    H: Quadratic,
    g: Mapping[int, int],
    rates: Sequence[int],
    names: Mapping[int, str],
) -> list[int]:
    """The accelerations q̈ of ``rates`` that follow from H and g along the tape.

    Raises `ModelError` that names the coordinate if a pivot is structurally zero.
    """
    solver = Elimination(graph, tape, H.copy(), dict(g), names)
    solver.run()
    value = solver.accelerations()
    return [value[r] for r in rates]


def condensed(graph: Graph, tape: EliminationTape, H: Quadratic, rates: Sequence[int]) -> list[list[int]]:
    """The mass matrix M over ``rates``, row after row: H after every step of the tape has been substituted.

    Links that move together are combined on the way, as composite bodies.
    """
    solver = Elimination(graph, tape, H.copy(), {}, {})
    solver.run(minimise=False)
    rows = solver.H.rows
    return [[rows.get(i, {}).get(k, graph.zero) for k in rates] for i in rates]


def by_columns(graph: Graph, H: Quadratic, rates: Sequence[int]) -> list[list[int]]:
    """The mass matrix M over ``rates``, row after row: its column j is Σ_ik (∂v_i/∂v) H_ik (∂v_k/∂v_j)."""
    g, n, seeds = graph, len(rates), list(H.rows)
    rows = [[g.zero] * n for _ in range(n)]
    for j, v in enumerate(rates):
        moved = dict(zip(seeds, jvp(g, seeds, {v: g.one}), strict=True))
        forces = [dot(g, list(H.rows[i].values()), [moved[k] for k in H.rows[i]]) for i in seeds]
        column = vjp(g, seeds, forces, list(rates))
        for i in range(j + 1):
            rows[i][j] = rows[j][i] = column[i]
    return rows
