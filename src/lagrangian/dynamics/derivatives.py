"""Derivatives of the dynamics: ∂a/∂(q, v, u, p) and M⁻¹ of the accelerations a, ∂r/∂(q, v, u, p) and M of the forces r.

a(q, v, u, p) solves r(q, v, a, u, p) = 0, where r = M a + h is linear in a. Therefore

    ∂a/∂x = −M⁻¹ D,        D = ∂r/∂x at a held constant

D is computed forwards, by columns, or backwards, by rows, from an r whose accelerations are *inputs* of the graph.
Their values are substituted afterwards: if they were nodes from the beginning, the graph would simplify with them, as
in a + (−b) → a − b, and what is held constant would be bypassed. M⁻¹ comes from the elimination that gives a, with a
unit load for each velocity; D is multiplied by it, or each column of D is a load itself. Instead of r, the conditions
for the minimum that the elimination finds can be differentiated, node by node of the tape. All ways are counted, and
the cheapest is returned: r in chains, the conditions in trees with many branches.

Derivatives with respect to q are along the velocities: column k is the rate of change for q̇ = N(q) e_k. Without
floating frames N = 1, and these are the partial derivatives; with a floating frame there are six columns for its
seven coordinates.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lagrangian.dynamics.constrained_derivatives import constrained_slopes
from lagrangian.dynamics.floating import bracket
from lagrangian.dynamics.mechanics import MANY, Mechanics
from lagrangian.dynamics.programs import _matrix, _program, _start, _vector
from lagrangian.dynamics.recorded import RecordedElimination
from lagrangian.dynamics.row_problem import Problem
from lagrangian.dynamics.vectors import Matrix, Vector, dot, plus, product, scaled, transposed, zeros
from lagrangian.errors import ModelError, did_you_mean
from lagrangian.graph import Graph, Output, Program, Tangents, count_operations, jvp, replaced, vjp
from lagrangian.model import Model
from lagrangian.records import dataclass

VARIED = ("q", "v", "u")
"""The groups with respect to which derivatives are taken unless others are named."""

Direction = dict[int, int]
"""A direction in which the inputs of a graph are varied: input node → its tangent."""


@dataclass(frozen=True)
class Directions:
    """The directions of all columns of a derivative, group after group; ``groups``: output name → number of columns."""

    groups: dict[str, int]
    columns: list[Direction]

    @property
    def varied(self) -> list[int]:
        """The inputs that any direction varies."""
        return list(dict.fromkeys(x for column in self.columns for x in column))

    def split(self, of: str, matrix: Matrix) -> dict[str, Output]:
        """The columns of a matrix, one output for each group: ``a_q`` for ``of`` = "a"."""
        found: dict[str, Output] = {}
        first = 0
        for name, count in self.groups.items():
            flat = [x for row in matrix for x in row[first : first + count]]
            found[f"{of}_{name}"] = Output(tuple(flat), (len(matrix), count))
            first += count
        return found


PARAMETER = "parameter "
"""What precedes the name of a parameter that is called as a group is, such as q."""


def parameters_in(model: Model, wrt: Sequence[str]) -> tuple[str, ...]:
    """The parameters among the names of ``wrt``.

    Raises `ModelError` for a name that is neither a group nor a parameter, coordinate, velocity or input, and for one
    that is given twice.
    """
    known = [p.name for p in model.parameters]
    single = singles(model)
    for at, name in enumerate(wrt):
        if name not in VARIED and name.removeprefix(PARAMETER) not in known and name not in single:
            if any(name == c.name for c in model.coordinates):
                raise ModelError(
                    f"'{name}' belongs to a floating frame, whose coordinates change along its velocities alone",
                    fix="'q' gives the derivatives along all velocities",
                    code="E402",
                )
            others = ", ".join([*known, *single][:12]) or "none"
            raise ModelError(
                f"there is nothing called '{name[:64]}' to differentiate with respect to",
                fix=did_you_mean(name, [*known, *single]) or f"use 'q', 'v', 'u' and single names: {others}",
                code="E402",
            )
        if name in wrt[:at]:
            raise ModelError(f"'{name}' is given twice in wrt", fix="name it once", code="E404")
    return tuple(name for name in wrt if name not in VARIED and name not in single)


def singles(model: Model) -> dict[str, tuple[str, int]]:
    """The coordinates, velocities and inputs that can be named one by one: name → group and place."""
    found = {c.name: ("q", i) for i, c in enumerate(model.coordinates) if not model.floating}
    if model.floating:
        floating = {c.name for f in model.floating if f.floating is not None for c in f.floating.coordinates}
        found = {c.name: ("q", i) for i, c in enumerate(model.coordinates) if c.name not in floating}
    found |= {v.name: ("v", i) for i, v in enumerate(model.velocities)}
    return found | {u.name: ("u", i) for i, u in enumerate(model.inputs)}


def directions_of(model: Model, wrt: Sequence[str]) -> tuple[Graph, Mechanics, Directions]:
    """A new graph with a model's mechanics, and the directions that ``wrt`` names."""
    named = parameters_in(model, wrt)
    g, _, m = _start(model)
    groups: dict[str, int] = {}
    columns: list[Direction] = []
    if "q" in wrt:
        groups["q"] = len(m.v)
        for v in m.v:
            along = zip(m.q, jvp(g, m.motion.rates, {v: g.one}), strict=True)
            columns.append({q: x for q, x in along if x != g.zero})
    if "v" in wrt:
        groups["v"] = len(m.v)
        columns += [{v: g.one} for v in m.v]
    if "u" in wrt and model.inputs:
        groups["u"] = len(model.inputs)
        columns += [{g.input("u", k): g.one} for k in range(len(model.inputs))]
    if named:
        groups["p"] = len(named)
        order = [p.name for p in model.parameters]
        columns += [{g.input("p", order.index(name.removeprefix(PARAMETER))): g.one} for name in named]
    known = singles(model)
    if alone := [known[name] for name in wrt if name in known and name not in VARIED]:
        groups["s"] = len(alone)
        places = {"q": m.q, "v": m.v, "u": [g.input("u", k) for k in range(len(model.inputs))]}
        columns += [{places[group][k]: g.one} for group, k in alone]
    return g, m, Directions(groups, columns)


def _by_columns(g: Graph, r: Sequence[int], directions: Directions) -> Matrix:
    """∂r along every direction, one forward pass a column; rows of the matrix belong to r."""
    return transposed([Tangents(g, column)(r) for column in directions.columns]) or [[] for _ in r]


def _by_rows(g: Graph, r: Sequence[int], directions: Directions) -> Matrix:
    """The same, one backward pass a row."""
    varied = directions.varied
    found: Matrix = []
    for x in r:
        slope = dict(zip(varied, vjp(g, [x], [g.one], varied), strict=True))
        found.append([dot(g, [slope[i] for i in column], list(column.values())) for column in directions.columns])
    return found


@dataclass(frozen=True)
class SolvedForward:
    """Accelerations a = reference + x, the elimination from which x and M⁻¹ come, and x of every node of its tape."""

    problem: Problem
    factors: RecordedElimination
    x: dict[int, int]

    @classmethod
    def of(cls, problem: Problem) -> SolvedForward:
        """Eliminate a problem without rows, and solve it for its own loads."""
        factors = RecordedElimination.of(problem)
        return cls(problem, factors, factors.answer(problem.linear))

    @property
    def graph(self) -> Graph:
        """The graph of everything."""
        return self.problem.graph

    @property
    def velocities(self) -> Sequence[int]:
        """The velocities v."""
        return self.problem.rates

    @property
    def a(self) -> Vector:
        """The accelerations."""
        return plus(self.graph, self.problem.reference, [self.x[v] for v in self.velocities])

    def along(self, loads: Sequence[int]) -> Vector:
        """−M⁻¹ loads."""
        value = self.factors.answer(dict(zip(self.velocities, loads, strict=True)))
        return [value[v] for v in self.velocities]

    def inverse_inertia(self) -> Matrix:
        """M⁻¹; of two entries that are equal by symmetry the one that takes fewer operations is used for both."""
        g, n = self.graph, len(self.velocities)
        columns = [self.along([g.negative if i == k else g.zero for i in range(n)]) for k in range(n)]
        above = [[columns[max(i, k)][min(i, k)] for k in range(n)] for i in range(n)]
        below = [[columns[min(i, k)][max(i, k)] for k in range(n)] for i in range(n)]
        return min((above, below), key=lambda rows: cost_of(g, [x for row in rows for x in row]))

    def along_conditions(self, directions: Directions) -> Matrix:
        """∂a along the directions, from the conditions for the minimum that the elimination finds.

        On the tape x_i = Σ_j c_ij x_j, and φ_i = g_i + (H x)_i + Σ_k c_ki φ_k, which is 0 for the velocities. A
        direction δ loads node i with δg_i + Σ_j δH_ij x_j and with δc_ki φ_k, and shifts it by Σ_j δc_ij x_j.
        """
        g, forms, H = self.graph, self.problem.tape.forms, self.problem.H.rows
        gathered = self._gathered()
        ends = [*self.problem.reference, *self.problem.linear.values()]
        ends += [x for row in (*H.values(), *forms.values()) for x in row.values()]
        columns: Matrix = []
        for column in directions.columns:
            slope = dict(zip(ends, Tangents(g, column)(ends), strict=True))
            loads = {i: slope[x] for i, x in self.problem.linear.items()}
            for i, row in H.items():
                change = dot(g, [slope[h] for h in row.values()], [self.x[k] for k in row])
                loads[i] = g.add(loads.get(i, g.zero), change)
            shifts: dict[int, int] = {}
            for k, form in forms.items():
                shifts[k] = dot(g, [slope[c] for c in form.values()], [self.x[i] for i in form])
                for i, c in form.items():
                    loads[i] = g.add(loads.get(i, g.zero), g.mul(slope[c], gathered[k]))
            value = self.factors.answer(loads, shifts)
            columns.append(
                [g.add(slope[r], value[v]) for r, v in zip(self.problem.reference, self.velocities, strict=True)]
            )
        return transposed(columns) or [[] for _ in self.velocities]

    def _gathered(self) -> dict[int, int]:
        """φ of every node: what acts on it and on all that hangs on it, at the solution."""
        g, H = self.graph, self.problem.H.rows
        found: dict[int, int] = {}
        for k in reversed(self.problem.tape.order):
            row = H.get(k, {})
            own = g.add(self.problem.linear.get(k, g.zero), dot(g, list(row.values()), [self.x[i] for i in row]))
            found[k] = g.add(found.get(k, g.zero), own)
            for i, c in self.problem.tape.forms.get(k, {}).items():
                found[i] = g.add(found.get(i, g.zero), g.mul(c, found[k]))
        return found


def cost_of(g: Graph, ids: Sequence[int]) -> int:
    """The number of operations for each state; those of parameters alone are not counted."""
    return count_operations(g, ids, hoist=["p"]).operations


def _solutions(m: Mechanics) -> Iterator[tuple[bool, SolvedForward]]:
    """The eliminations worth trying, and whether each is of the mass matrix itself."""
    few = len(m.v) <= MANY
    for links in m.groupings if few else m.groupings[:1]:
        for free in (True, False) if few and m.motion.free_rates() else (True,):
            acc = m.accelerations(zeros(m.graph, len(m.v)), free=free)
            for problem in m.problems(links, m.missing(acc, links), [], acc.vdot):
                yield not problem.tape.forms, SolvedForward.of(problem)


def cheapest_solutions(m: Mechanics) -> list[tuple[SolvedForward, Matrix]]:
    """The solution with the fewest operations for a and M⁻¹, along the tape and of the mass matrix, with M⁻¹."""
    best: dict[bool, tuple[int, SolvedForward, Matrix]] = {}
    for dense, solution in _solutions(m):
        Minv = solution.inverse_inertia()
        cost = cost_of(m.graph, [*solution.a, *(x for row in Minv for x in row)])
        if dense not in best or cost < best[dense][0]:
            best[dense] = cost, solution, Minv
    return [(solution, Minv) for _, solution, Minv in best.values()]


def candidates(m: Mechanics, directions: Directions) -> Iterator[tuple[Vector, Matrix, Matrix]]:
    """a, M⁻¹ and ∂a along the directions, in every way that is counted."""
    g, n = m.graph, len(m.v)
    held = [g.input("a", i) for i in range(n)]
    r = m.inverse(held)
    ways = [_by_rows(g, r, directions), _by_columns(g, r, directions)]
    for solution, Minv in cheapest_solutions(m):
        values = dict(zip(held, solution.a, strict=True))
        width = len(directions.columns)
        for k, D in enumerate(ways):
            flat = replaced(g, [x for row in D for x in row], values)
            slopes = [flat[i * width : (i + 1) * width] for i in range(n)]
            found = [product(g, Minv, _negative(g, slopes)), _answers(solution, slopes)]
            if k == 0 and solution.problem.tape.forms:
                found.append(solution.along_conditions(directions))
            for matrix in found:
                yield solution.a, Minv, _with_single_entries(g, matrix, Minv, slopes)


def _negative(g: Graph, matrix: Matrix) -> Matrix:
    return [[g.neg(x) for x in row] for row in matrix]


def _answers(solution: SolvedForward, D: Matrix) -> Matrix:
    """−M⁻¹ D, column by column."""
    return transposed([solution.along(column) for column in transposed(D)]) or D


def _with_single_entries(g: Graph, matrix: Matrix, Minv: Matrix, D: Matrix) -> Matrix:
    """−M⁻¹ D in which every column with one entry in D, such as that of a motor, is that entry times one of M⁻¹."""
    columns = transposed(matrix)
    for k, column in enumerate(transposed(D)):
        entries = [i for i, x in enumerate(column) if x != g.zero]
        if len(entries) == 1:
            (i,) = entries
            columns[k] = [g.neg(g.mul(column[i], row[i])) for row in Minv]
    return transposed(columns) or matrix


def derivatives(model: Model, wrt: Sequence[str] = VARIED) -> Program:
    """q, v, u, p, t → "a" (n,), "Minv" = M⁻¹ = ∂a/∂Ξ (n, n), and ∂a/∂x for every x named in ``wrt``.

    ``wrt`` contains "q", "v", "u" and names of parameters, for the outputs "a_q" and "a_v" (n, n), "a_u" (n, number of
    inputs) and "a_p" (n, number of parameters named, in that order), and names of single coordinates, velocities and
    inputs, for "a_s". "a_q" is along the velocities. With constraints "Minv" is ∂a/∂Ξ (`constrained_derivatives`).
    Raises `ModelError` for other names, and as `forward`.
    """
    graph, m, directions = directions_of(model, wrt)
    ways = [constrained_slopes(m, directions.columns)] if m.rows else candidates(m, directions)
    found = [{"a": _vector(a), **directions.split("a", slopes), "Minv": _matrix(Minv)} for a, Minv, slopes in ways]
    outputs = min(found, key=lambda outputs: cost_of(graph, [i for x in outputs.values() for i in x.ids]))
    return _program(model, "derivatives", graph, outputs)


def inverse_derivatives(model: Model, wrt: Sequence[str] = VARIED) -> Program:
    """q, v, a, u, p, t → "r" (n,), "M" = ∂r/∂a (n, n), and ∂r/∂x as "r_q", "r_v", "r_u", "r_p"; see `derivatives`."""
    graph, m, directions = directions_of(model, wrt)
    r = m.inverse([graph.input("a", i) for i in range(len(m.v))])
    M = _matrix(m.mass_matrix())
    found = [
        {"r": _vector(r), **directions.split("r", slopes), "M": M}
        for slopes in (_by_rows(graph, r, directions), _by_columns(graph, r, directions))
    ]
    outputs = min(found, key=lambda outputs: cost_of(graph, [i for x in outputs.values() for i in x.ids]))
    return _program(model, "inverse_derivatives", graph, outputs, groups=("q", "v", "a"))


def tangent(model: Model) -> Program:
    """q, v, u, p, t → "qdot" = N v and how it varies: "N", "Nq" = ∂(N v)/∂q, "back" = N⁺ with N⁺ N = 1, and "ad".

    "ad" is the matrix of ad_v, w ↦ [v, w]: variations δq = N ξ have the rate ξ̇ = δv − ad_v ξ. Its entries are 0 but
    for floating frames.
    """
    g, _, m = _start(model)
    rates, n = list(m.motion.rates), len(m.v)
    N = transposed([jvp(g, rates, {v: g.one}) for v in m.v])
    Nq = transposed([jvp(g, rates, {q: g.one}) for q in m.q])
    back = transposed(N)
    ad = [zeros(g, n) for _ in range(n)]
    for at in m.floats:
        e = m.q[at.orientation]
        over = g.div(g.const(4.0), dot(g, e, e))  # the columns of N that turn have the length |e|/2
        for i in at.turning:
            back[i] = scaled(g, over, back[i])
        own = at.velocities
        for k in own:
            unit = [g.one if i == k else g.zero for i in own]
            for i, x in zip(own, bracket(g, [m.v[j] for j in own], unit), strict=True):
                ad[i][k] = x
    outputs = {"qdot": _vector(rates), "N": _matrix(N), "Nq": _matrix(Nq), "back": _matrix(back), "ad": _matrix(ad)}
    return _program(model, "tangent", g, outputs)
