"""The programs of a model's constraints, beside those of `programs`; m rows in the order of `Mechanics.rows`.

multipliers        λ of every row, and how well it is determined
projection         the correction of a state x after which it satisfies its rows
correction         the same for q and v separately, with fixed coordinates: one step of an assembly
closing_terms      f, A, M and N, from which the same step on positions is made by dense matrices
residual           f of the rows on positions, and A v + a₀ of all
constraint_matrix  A, a₀ and γ
forward_dual       v̇ and λ by another route
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

from lagrangian.dynamics.accelerations import condensed
from lagrangian.dynamics.constrained import (
    Correction,
    drive,
    dual,
    gap,
    kept_by_steps,
    least,
    matrix,
    position_correction,
    position_rows,
    second_rates,
    velocity_correction,
)
from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.dynamics.notices import dependent_rows
from lagrangian.dynamics.programs import _matrix, _once, _program, _start, _vector, sketch
from lagrangian.dynamics.row_problem import RowSolution
from lagrangian.dynamics.tape import make_tape
from lagrangian.dynamics.vectors import minus, zeros
from lagrangian.errors import NoSuchEntry
from lagrangian.graph import Output, Program, Tangents, jvp, vjp
from lagrangian.model import Model


def multipliers(model: Model, *, redundant: Collection[str] = ()) -> Program:
    """q, v, u, p, t → ``lam`` (m,), the multipliers; ``margin``; and for every row ``margins``, ``skipped``, ``sizes``.

    A margin is sin² of the angle between a row and the span of those taken before it, measured by M⁻¹, in parts of its
    closure. ``margin`` is the smallest one, without the rows in ``redundant`` (names). A row whose margin is rounding
    gets the multiplier 0. ``skipped`` is its remaining residual, in the unit of its second rate; compare it with
    ``sizes``, the sum of the magnitudes that cancel there.

    Raises `DependentRow` for a row that depends on others in every position, and `ModelError` as `forward` does.
    """
    graph, _, m = _start(model)
    found = m.constrained
    counted = [x for row, x in zip(m.rows, found.margins, strict=True) if row.name not in redundant]
    outputs = {
        "lam": _vector([graph.select(c, x, graph.zero) for c, x in zip(found.regular, found.multipliers, strict=True)]),
        "margin": _number(least(graph, counted)),
        "margins": _vector(found.margins),
        "skipped": _vector(found.residuals),
        "sizes": _vector(found.sizes),
    }
    return _program(model, "multipliers", graph, outputs)


def divisors(model: Model) -> Program:
    """q, v, u, p, t → the terms of parameters that accelerations are divided by, named by rows: none may be 0."""
    graph, _, m = _start(model)
    named: dict[str, list[int]] = {}
    for name, node in m.constrained.divisors if m.rows else ():
        named.setdefault(name, []).append(node)
    return _program(model, "divisors", graph, {name: _vector(ids) for name, ids in named.items()})


def projection(model: Model) -> tuple[Program | None, Program | None]:
    """x, u, p, t → ``dx`` to be added to x: (on positions, on velocities); `constrained` has the formulas.

    ``gap`` is the largest |row| before the correction, divided by the row's scale; ``margin`` is as in `multipliers`.
    The first program is None without rows on positions. Both are None if every step of a run satisfies the rows
    without correction. They are in one graph, and share the elimination if all rows are on positions.
    """
    graph, _, m = _start(model, state=True)
    velocity = None if kept_by_steps(m) else velocity_correction(m)
    if velocity is None:
        return None, None
    rows = position_rows(m)
    position = position_correction(m, order=velocity[2] if len(rows) == len(m.rows) else None)

    def made(step: Correction, *, position: bool) -> Program:
        rest = zeros(graph, len(m.v) if position else len(m.q))
        dx = [*step[0], *rest] if position else [*rest, *step[0]]
        outputs = {"dx": _vector(dx), **_judged(model, m, step[1], position=position)}
        name = "position_projection" if position else "velocity_projection"
        return _program(model, name, graph, outputs, groups=("x",))

    return None if position is None else made(position, position=True), made(velocity, position=False)


def correction(model: Model, fixed: Collection[str] = (), *, position: bool = True) -> Program | None:
    """q, v, u, p, t → ``dq`` (or ``dv``): the least step that satisfies the rows to first order; ``gap``, ``margin``.

    The coordinates in ``fixed`` (names), or their rates, stay as they are. A row in which nothing else can move is
    skipped, and its margin is 0. None without rows. Raises `NoSuchEntry` for an unknown name.
    """
    graph, _, m = _start(model)
    names = [c.name for c in model.coordinates]
    for name in fixed:
        if name not in names:
            raise NoSuchEntry.among("no coordinate", name, names)
    held = [i for i, name in enumerate(names) if name in fixed]
    step = (position_correction if position else velocity_correction)(m, held)
    if step is None:
        return None
    outputs = {"dq" if position else "dv": _vector(step[0]), **_judged(model, m, step[1], position=position)}
    return _program(model, "position_correction" if position else "velocity_correction", graph, outputs)


def closing_terms(model: Model, fixed: Collection[str] = ()) -> Program:
    """q, v, u, p, t → ``f`` and ``A`` (rows, n) of the rows on positions, ``M`` (n, n), and ``N`` (n_q, n), q̇ = N v.

    Every coordinate in ``fixed`` (names) is a row of its own, q̇ᵢ = 0.
    """
    graph, _, m = sketch(model)
    units = {v: [graph.one if k == j else graph.zero for k in range(len(m.v))] for j, v in enumerate(m.v)}
    N = [units.get(rate) or vjp(graph, [rate], [graph.one], list(m.v)) for rate in m.motion.rates]
    rows = position_rows(m)
    held = [row for c, row in zip(model.coordinates, N, strict=True) if c.name in fixed]
    A = [*(vjp(graph, [row.rate], [graph.one], list(m.v)) for row in rows), *held]
    f = [*(row.residual or graph.zero for row in rows), *zeros(graph, len(held))]
    H = m.inertia(m.groupings[0])  # for one search, M need not be the cheapest
    M = condensed(graph, make_tape(graph, list(H.rows), m.v), H, m.v)
    outputs = {"f": _vector(f), "A": _matrix(A), "M": _matrix(M), "N": _matrix(N)}
    return _program(model, "closing_terms", graph, outputs)


@_once
def residual(model: Model) -> Program:
    """q, v, u, p, t → ``f`` of the rows on positions, in their order, and ``Av`` = A v + a₀ of all rows."""
    graph, _, m = _start(model)
    f = [row.residual for row in m.rows if row.residual is not None]
    return _program(model, "residual", graph, {"f": _vector(f), "Av": _vector([row.rate for row in m.rows])})


def changes(model: Model) -> Program:
    """q, v, u, p, t → "rows" (k, 2n): the changes (δq along the velocities, δv) that satisfy the constraints are 0 in
    every row, ∂f δq for the rows on positions, then A δv + ∂(A v)/∂q δq for all."""
    graph, _, m = _start(model)
    along = [jvp(graph, m.motion.rates, {v: graph.one}) for v in m.v]
    directions = [{q: x for q, x in zip(m.q, row, strict=True) if x != graph.zero} for row in along]
    directions += [{v: graph.one} for v in m.v]
    f = [row.residual for row in m.rows if row.residual is not None]
    kept = [*f, *(row.rate for row in m.rows)]
    columns = [Tangents(graph, direction)(kept) for direction in directions]
    ids = tuple(column[i] for i in range(len(kept)) for column in columns)
    return _program(model, "changes", graph, {"rows": Output(ids, (len(kept), len(directions)))})


@_once
def constraint_matrix(model: Model) -> Program:
    """q, v, u, p, t → ``A`` (m, n), ``a0`` (m,) and ``gamma`` (m,):  A v + a₀ = 0  and  A v̇ + γ = 0."""
    graph, _, m = _start(model)
    outputs = {
        "A": Output(tuple(x for row in matrix(m) for x in row), (len(m.rows), len(m.v))),
        "a0": _vector(drive(m)),
        "gamma": _vector(second_rates(m)),
    }
    return _program(model, "constraint_matrix", graph, outputs)


def pushed_bias(model: Model) -> Program:
    """q, v, u, p, t, lam → ``h`` = C v + G − Ξ − Aᵀλ: what is missing at rest, with the multipliers given."""
    graph, _, m = _start(model)
    lam = [graph.input("lam", r) for r in range(len(m.rows))]
    push = vjp(graph, [row.rate for row in m.rows], lam, list(m.v))
    made = _program(model, "pushed_bias", graph, {"h": _vector(minus(graph, m.bias(), push))})
    return replace(made, inputs={**made.inputs, "lam": tuple(row.name for row in m.rows)})


def forward_dual(model: Model) -> Program:
    """q, v, u, p, t → ``a`` and ``lam`` from dense matrices, the independent route to `forward` and `multipliers`."""
    graph, _, m = _start(model)
    a, lam = dual(m)
    return _program(model, "forward_dual", graph, {"a": _vector(a), "lam": _vector(lam)})


def _judged(model: Model, m: Mechanics, solution: RowSolution, *, position: bool) -> Mapping[str, Output]:
    """The gap before a correction, and the least margin of its rows, without those that others imply in any case."""
    repeated = dependent_rows(model)
    rows = position_rows(m) if position else m.rows
    values = [row.residual or m.graph.zero for row in rows] if position else [row.rate for row in rows]
    return {
        "gap": _number(gap(m, rows, values)),
        "margin": _number(
            least(m.graph, [x for row, x in zip(rows, solution.margins, strict=False) if row.name not in repeated])
        ),
    }


def _number(node: int) -> Output:
    return Output((node,), ())
