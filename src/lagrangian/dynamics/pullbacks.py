"""Vector-Jacobian products of the accelerations, w·∂a/∂(q, v, u, p), and their derivatives along a direction.

a solves r(q, v, a, u, p) = 0, which is linear in a, so that with λ = M⁻¹ w

    wᵀ ∂a/∂x = −λᵀ ∂r/∂x        at a held constant:

one more solution of the elimination and one backward pass, whatever the number of columns. It is compared with the
backward pass through the elimination itself, and the shorter one is returned; with constraints only the latter is made.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from lagrangian.dynamics.derivatives import VARIED, Directions, cheapest_solutions, cost_of, directions_of
from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.dynamics.programs import _program, _vector
from lagrangian.dynamics.vectors import Vector, dot
from lagrangian.graph import Output, Program, Tangents, jvp, replaced, vjp
from lagrangian.model import Model


def _ways(m: Mechanics, w: Sequence[int], varied: list[int]) -> Iterator[tuple[Vector, Vector]]:
    """a and wᵀ ∂a/∂(varied inputs)."""
    g = m.graph
    a = m.forward()
    yield a, vjp(g, a, w, varied)
    if m.rows:
        return
    held = [g.input("a", i) for i in range(len(m.v))]
    r = m.inverse(held)
    for solution, _ in cheapest_solutions(m):
        slopes = vjp(g, r, solution.along(w), varied)
        yield solution.a, replaced(g, slopes, dict(zip(held, solution.a, strict=True)))


def _shortest(m: Mechanics, w: Sequence[int], directions: Directions) -> tuple[Vector, Vector]:
    """a, and wᵀ ∂a along every direction."""
    g, varied = m.graph, directions.varied
    found: list[tuple[Vector, Vector]] = []
    for a, slopes in _ways(m, w, varied):
        slope = dict(zip(varied, slopes, strict=True))
        along = [dot(g, [slope[x] for x in column], list(column.values())) for column in directions.columns]
        found.append((a, along))
    return min(found, key=lambda pair: cost_of(g, [*pair[0], *pair[1]]))


def _split(directions: Directions, of: str, row: Sequence[int]) -> dict[str, Output]:
    """One output for each group of directions."""
    found: dict[str, Output] = {}
    first = 0
    for name, count in directions.groups.items():
        found[f"{of}_{name}"] = _vector(row[first : first + count])
        first += count
    return found


def _inputs(model: Model, program: Program, more: Sequence[str]) -> Program:
    """The program with the group w after v, and the directions after it."""
    rates = tuple(v.name for v in model.velocities)
    names = {
        "w": tuple(f"weight of {name}'" for name in rates),
        "dq": tuple(f"change along {name}" for name in rates),
        "dv": tuple(f"change of {name}" for name in rates),
    }
    ordered = {group: program.inputs[group] for group in ("q", "v")} | {group: names[group] for group in more}
    return replace(program, inputs={**ordered, **{k: x for k, x in program.inputs.items() if k not in ordered}})


def pullback(model: Model, wrt: Sequence[str] = VARIED) -> Program:
    """q, v, w, u, p, t → "a" and w·∂a/∂x as "w_q", "w_v" (n,), "w_u", "w_p", "w_s"; see `derivatives` for ``wrt``."""
    graph, m, directions = directions_of(model, wrt)
    a, row = _shortest(m, [graph.input("w", i) for i in range(len(m.v))], directions)
    made = _program(model, "pullback", graph, {"a": _vector(a), **_split(directions, "w", row)})
    return _inputs(model, made, ("w",))


def hessian_product(model: Model, wrt: Sequence[str] = VARIED) -> Program:
    """q, v, w, dq, dv, u, p, t → the change of w·∂a/∂x along q̇ = N(q) dq and dv, by the names of `pullback`."""
    graph, m, directions = directions_of(model, wrt)
    n = len(m.v)
    _, row = _shortest(m, [graph.input("w", i) for i in range(n)], directions)
    moved = jvp(graph, m.motion.rates, {v: graph.input("dq", i) for i, v in enumerate(m.v)})
    direction = {q: x for q, x in zip(m.q, moved, strict=True) if x != graph.zero}
    direction |= {v: graph.input("dv", i) for i, v in enumerate(m.v)}
    changed = Tangents(graph, direction)(row)
    made = _program(model, "hessian_product", graph, _split(directions, "w", changed))
    return _inputs(model, made, ("w", "dq", "dv"))
