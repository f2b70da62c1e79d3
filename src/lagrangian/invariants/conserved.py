"""Finds conserved quantities: momenta of ignorable coordinates, total momenta, energy; each is proved and observed in a
run."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import bounded, dynamics, integrate
from lagrangian import codegen as machine
from lagrangian.assembly.assemble import consistent
from lagrangian.errors import ModelError, RunError, listed
from lagrangian.invariants.conserved_quantities import Conserved, ConservedQuantities, condition
from lagrangian.invariants.lagrangian_form import LagrangianForm
from lagrangian.invariants.symmetries import Symmetry, symmetries
from lagrangian.linear.jacobians import rates, values
from lagrangian.model import Model, is_hard
from lagrangian.page.formula import Name, Text, text
from lagrangian.page.plain import plain
from lagrangian.simulate.integrating import projection
from lagrangian.values.values import Given, Named

_log = logging.getLogger(__name__)
Array = NDArray[np.float64]

SWINGS = 20.0
"""The length of a run, in periods of the fastest pole at its start."""

TRIES = 5
"""The number of random initial states that are tried until a run reaches its end."""

MAX_STEPS = 1_000_000
MAX_OPERATIONS = 200_000_000_000
"""What a run may take, about twenty seconds; counted, so that every machine and every load gives the same answer."""


@bounded.answered("the search for conserved quantities", is_hard)
def conserved_quantities(model: Model, *, params: Named | None = None, seed: int = 1) -> ConservedQuantities:
    """Return the conserved quantities of a model.

    Each is proved: the normal form of its rate along any motion is 0. If all parameters have values, each is also
    evaluated along a run from a random initial state (``seed``), with the integrator in machine code. ``params`` are
    values in that run; a parameter that is 0 there also vanishes from the formulas, such as a damping that is
    neglected.
    """
    program = rates(model)
    given = Given.of(model, program)
    chosen = given.parameters.values(params)
    vanishing = [p for p in model.parameters if chosen.get(p.name) == 0]
    system = LagrangianForm.of(model, [p.symbol for p in vanishing])
    if vanishing and (light := [plain(q) for q, p in zip(system.q, system.momenta, strict=True) if p.is_zero]):
        raise ModelError(
            f"coordinate '{light[0]}' moves no mass where {' = '.join(p.name for p in vanishing)} = 0",
            fix="keep a mass or an inertia for it",
            code="E201",
        )
    _log.info("conserved: searching for symmetries")
    listed = [_described(system, s, ()) for s in symmetries(system, {})]
    known = {plain(c.expression) for c in listed}
    if model.inputs:
        zero = {u.symbol: sp.S.Zero for u in model.inputs}
        for symmetry in symmetries(system, zero):
            need = tuple(u.name for u in model.inputs if symmetry.rate.raw().has(u.symbol))
            found = _described(system, symmetry, need)
            if need and plain(found.expression) not in known:
                listed.append(found)
    _log.info("conserved: watching %d along a run", len(listed))
    numbers = all(p.value is not None or p.name in chosen for p in model.parameters)
    watched, run = (
        _watched(model, program, listed, given.parameter_values(params), seed) if listed and numbers else (listed, None)
    )
    return ConservedQuantities(model, tuple(watched), _missed(system, watched), run, tuple(p.name for p in vanishing))


def _described(system: LagrangianForm, symmetry: Symmetry, need: tuple[str, ...]) -> Conserved:
    expression = symmetry.conserved.expr()
    direction = {q: d.expr() for q, d in zip(system.q, symmetry.direction, strict=True) if d.parts}
    name, kind, reason = _words(system, symmetry, direction)
    steady = tuple(u.name for u in system.moved_by(symmetry.conserved) if u.name not in need)
    if system.rows:
        holds = "do no work" if symmetry.kind == "energy" else "do not push along that"
        reason = Text((*reason.parts, f", and the constraints {holds}"))
    if need or steady:
        reason = Text((*reason.parts, f", {condition(need, steady)}"))
    return Conserved(name, kind, expression, direction, need, reason, while_constant=steady)


def _words(system: LagrangianForm, symmetry: Symmetry, direction: Mapping[Any, sp.Expr]) -> tuple[str, str, Text]:
    L, Xi = Name("L"), Name("Xi")
    coordinates = list(direction)
    if symmetry.kind == "energy":
        name = "energy T* + V" if system.is_total else "h = Σ ξ̇ ∂L/∂ξ̇ − L"
        return name, "energy", text(L, " does not contain time, and ", Xi, " supplies and takes no power")
    if symmetry.kind == "momentum":
        (q,) = coordinates
        return (
            f"momentum of {plain(q)}",
            "momentum",
            text(q, " is ignorable: ", L, " contains its rate but not ", q, " itself, and no ", Xi, " acts on it"),
        )
    moved: list[Any] = []
    for q, d in direction.items():
        moved += [", " if moved else "", "δ", q, " = ", d]
    words = text(L, " does not change when all move by ", *moved, ", and ", Xi, " does no work on that")
    if symmetry.kind == "screw":
        names = listed([plain(q) for q in coordinates])
        words = Text((*words.parts, ", while time moves by δt = ", -symmetry.time))
        return f"energy and momentum of {names}", "mixed", words
    if symmetry.kind == "shift":
        return f"total momentum of {listed([plain(q) for q in coordinates])}", "total momentum", words
    skew = all(symmetry.turn.get((j, i)) == -c for (i, j), c in symmetry.turn.items())
    what = "angular momentum" if skew else "momentum of a direction"
    return f"{what} of {listed([plain(q) for q in coordinates])}", "turn", words


def _missed(system: LagrangianForm, found: Sequence[Conserved]) -> tuple[Text, ...]:
    """Why the momenta of ignorable coordinates and the energy are not conserved, if they are not."""
    kept = {q for c in found if c.kind == "momentum" for q in c.direction}
    listed: list[Text] = []
    L = Name("L")
    for k, (q, slope, force) in enumerate(zip(system.q, system.slopes, system.forces, strict=True)):
        if q not in kept and slope.is_zero and not system.momenta[k].is_zero:
            pushing = [name for name, A, _ in system.pushes_of_rows if not A[k].is_zero]
            parts: list[Any] = [L, " does not contain ", q, ", but its momentum changes"]
            if not force.is_zero or not pushing:
                parts += [" at the rate ", force.expr(), *((", and also",) if pushing else ())]
            parts += [f" because {_constraints(pushing)} along ", q] if pushing else []
            listed.append(text(*parts))
    if not any(c.kind in ("energy", "mixed") for c in found):
        driving = [name for name, _, a0 in system.pushes_of_rows if not a0.is_zero]
        parts = ["the energy changes"]
        if not system.power.is_zero or not driving:
            parts += [" at the rate ", system.power.expr(), *((", and also",) if driving else ())]
        parts += [f" because {_constraints(driving)} what it moves"] if driving else []
        for u in system.moved_by(system.energy):
            parts += [", and at ", (-system.lagrangian.diff(u.symbol)).expr(), " times the rate of ", u.symbol]
            parts.append(" if that changes")
        listed.append(text(*parts))
    return tuple(listed)


def _constraints(names: Sequence[str]) -> str:
    shown = ", ".join(f"'{name}'" for name in names[:4])
    return f"the constraint {shown} pushes" if len(names) == 1 else f"the constraints {shown} push"


def _watched(
    model: Model, program: Any, listed: list[Conserved], p: Array, seed: int
) -> tuple[list[Conserved], float | None]:
    """The quantities with their drift along runs: a run with constant inputs, and a run without inputs."""
    watched, longest = list(listed), None
    for driven in (True, False):
        mine = [k for k, c in enumerate(watched) if bool(c.while_zero) != driven]
        if not mine:
            continue
        source = np.random.default_rng(seed)
        u = source.uniform(-1, 1, len(model.inputs)) if driven else np.zeros(len(model.inputs))
        run = _run(model, program, u, p, source)
        if run is None:
            continue
        times, states = run
        longest = max(longest or 0.0, float(times[-1]))
        for k in mine:
            watched[k] = replace(watched[k], drift=_drift(model, watched[k], times, states, u, p))
    return watched, longest


def _run(model: Model, program: Any, u: Array, p: Array, source: np.random.Generator) -> tuple[Array, Array] | None:
    """Times and states of a run from a random initial state that reaches its end, or None."""
    n = len(model.coordinates)
    rhs = dynamics.rhs(model)
    rows = None if not model.constraints else projection(model, rhs, project=True)
    solver = integrate.Solver(rhs, "dop853", projection=rows)
    max_steps = min(MAX_STEPS, MAX_OPERATIONS // (len(rhs.graph.nodes) * solver.method.cost))
    for _ in range(TRIES):
        x = np.concatenate([source.uniform(0.3, 1.0, n), source.uniform(-0.5, 0.5, len(program.inputs["x"]) - n)])
        if model.constraints:
            try:
                x = np.concatenate(consistent(model, x[:n], x[n:], p))
            except RunError:
                continue
        found = values(program, x=x, u=u, p=p, t=0.0)
        if not all(np.isfinite(a).all() for a in found.values()):
            continue
        fastest = float(np.abs(np.linalg.eigvals(found["A"])).max())
        length = float(np.clip(2 * np.pi * SWINGS / max(fastest, 1e-3), 0.1, 100.0))
        times = np.linspace(0, length, 201)
        run = solver.solve(x, times, u=u, p=p, rtol=1e-12, atol=1e-13, max_steps=max_steps)
        if int(np.ravel(run.status)[0]) == 0:
            return times, np.asarray(run.states).reshape(len(times), -1)
    return None


def _drift(model: Model, quantity: Conserved, times: Array, states: Array, u: Array, p: Array) -> float:
    """The largest change of a quantity along a run, relative to the largest sum of the sizes of its terms."""
    terms = sp.Add.make_args(bounded.expand(quantity.expression))
    asked = {"Q": quantity.expression} | {f"term {k}": cast("sp.Expr", term) for k, term in enumerate(terms)}
    kernel = machine.compile(dynamics.observe(model, asked))
    got = kernel(np.ascontiguousarray(states), u, p, times)
    sizes = np.sum([np.abs(got[name]) for name in asked if name != "Q"], axis=0)
    change = float(np.abs(got["Q"] - got["Q"][0]).max())
    size = float(sizes.max())
    return change / size if size else change
