"""Checks of models that have no derivation: laws that all equations of motion obey, at random states.

They are used for systems with floating frames, whose velocities are not the rates of their coordinates. Virtual work
and Lagrange's equations for quasi-velocities (see `dynamics.floating`) must give the same forces, forward dynamics must
solve them, and M, C and the energy must obey their laws.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.dynamics.christoffel import coriolis
from lagrangian.graph import Graph, Output, Program, jvp, reached, replaced
from lagrangian.model import Model
from lagrangian.page.formula import Check, Name, text
from lagrangian.records import dataclass
from lagrangian.values.dimensions import check_dimensions
from lagrangian.values.values import check_sampling
from lagrangian.verify.on_rows import OnRows
from lagrangian.verify.states import evaluated, random_states

TOLERANCE = 1e-9
"""The relative difference up to which two numbers count as equal: no more than rounding."""

RANK = 1e-11
"""The relative size under which a singular value is rounding."""

Array: TypeAlias = NDArray[np.float64]


@dataclass
class _Worst:
    """The largest differences found."""

    routes: float = 0.0
    solved: float = 0.0
    asymmetry: float = 0.0
    smallest: float = float("inf")
    skew: float = 0.0
    rates: float = 0.0
    power: float = 0.0
    compared: int = 0

    def note(self, name: str, value: float) -> None:
        """Keep the larger number; NaN is the worst and stays."""
        setattr(self, name, float(np.maximum(getattr(self, name), value)))


def verify_motion(model: Model, *, states: int = 50, seed: int = 1) -> tuple[Check, ...]:
    """Compare the programs of a model with each other at ``states`` random states.

    Raises `ModelError` if units do not agree, if a velocity moves no mass, or if no random state has finite forces.
    """
    check_sampling(states, seed)
    dims = check_dimensions(model)
    worst, timed, quadratic = _measured(model, states, seed), _reads_time(model), _is_quadratic(model)
    if not worst.compared:
        why = "not checked: no random position could be moved to where it satisfies the constraints"
        return (Check(text("the laws of motion hold where the constraints do"), None, why),)
    allowed = (" on every motion that the constraints allow",) if model.constraints else ()
    M, C, n = Name("M"), Name("C"), f"{states} random state{'s' if states != 1 else ''}"
    checks = [
        Check(
            text("virtual work and Lagrange's equations for quasi-velocities agree, two independent routes"),
            worst.routes < TOLERANCE,
            f"largest relative difference {worst.routes:.1e} at {n}",
        ),
        Check(
            text("the compiled accelerations solve the equations"),
            worst.solved < TOLERANCE,
            f"largest relative residual {worst.solved:.1e}",
        ),
        Check(text(M, " is symmetric"), worst.asymmetry < TOLERANCE, f"largest difference {worst.asymmetry:.1e}"),
        Check(
            text(M, " is positive definite", *allowed),
            worst.smallest > 0,
            f"smallest eigenvalue {worst.smallest:.2e}",
        ),
    ]
    if quadratic and not timed:  # Christoffel symbols require a quadratic T*
        skew = text("d", M, "/dt − 2", C, " is skew-symmetric")
        checks.append(Check(skew, worst.skew < TOLERANCE, f"{worst.skew:.1e}"))
    if quadratic and not timed and not _is_driven(model):
        checks.append(
            Check(
                text(C, " times the velocities is the force that they make"),
                worst.rates < TOLERANCE,
                f"largest relative difference {worst.rates:.1e}",
            )
        )
    checks.append(
        Check(
            text("power balance: the energy grows by the power of ", Name("Xi")),
            worst.power < TOLERANCE,
            f"largest relative difference {worst.power:.1e}",
        )
    )
    if dims is not None and not dims.loose:
        checks.append(Check(text("dimensions: the units of all elements fit together"), True, "all elements"))
    return tuple(checks)


def _measured(model: Model, states: int, seed: int) -> _Worst:
    forward, inverse = dynamics.forward(model), dynamics.inverse(model)
    second, bias = dynamics.inverse_from_lagrangian(model), dynamics.bias(model)
    potential_force = dynamics.potential_force(model)
    matrices, balance, rhs = _matrices(model, forward.inputs), _balance(model), dynamics.rhs(model)
    worst, onto = _Worst(), OnRows(model) if model.constraints else None
    multipliers = None if onto is None else dynamics.multipliers(model)
    for drawn in random_states(model, forward, states, seed):
        state = drawn if onto is None else onto.of(drawn)
        if state is None:
            continue  # no position near it satisfies the constraints
        worst.compared += 1
        by_work, by_energy = (np.array(evaluated(p, state)["r"]) for p in (inverse, second))
        got = {name: np.array(x) for name, x in evaluated(matrices, state).items()}
        n = len(model.velocities)
        M, Mdot, C = (got[k].reshape(n, n) for k in ("M", "Mdot", "C"))
        v, G = np.array(state["v"]), np.array(evaluated(potential_force, state)["G"])
        size = max(1.0, float(np.abs(M * np.array(state["a"])).max()), float(np.abs(G).max()))
        worst.note("routes", float(np.abs(by_work - by_energy).max()) / size)
        worst.note("asymmetry", float(np.abs(M - M.T).max() / np.abs(M).max()))
        allowed = np.eye(n) if onto is None else _allowed(np.array(evaluated(onto.matrix, state)["A"], float), n)
        moved = allowed.T @ (M + M.T) @ allowed / 2
        worst.smallest = float(np.minimum(worst.smallest, np.linalg.eigvalsh(moved).min(initial=np.inf)))
        skew = Mdot - 2 * C
        worst.note("skew", float(np.abs(skew + skew.T).max()) / max(1.0, float(np.abs(C).max())))
        without = np.array(evaluated(bias, state)["h"]) + got["Xi"] - G
        worst.note("rates", float(np.abs(C @ v - without).max()) / size)
        found = {**state, "a": list(evaluated(forward, state)["a"])}
        missing = np.array(evaluated(inverse, found)["r"])
        if onto is not None and multipliers is not None:
            A = np.array(evaluated(onto.matrix, state)["A"], float).reshape(-1, n)
            missing = missing - A.T @ np.array(evaluated(multipliers, state)["lam"], float)
        worst.note("solved", float(np.abs(missing).max()) / size)
        x = [*state["q"], *state["v"]]
        along = {**state, "x": x, "xdot": list(evaluated(rhs, {**state, "x": x})["xdot"])}
        power = {name: float(np.array(y)) for name, y in evaluated(balance, along).items()}
        worst.note("power", abs(power["hdot"] - power["P"]) / max(1.0, float(np.abs(G).max()), abs(power["P"])))
    return worst


def _allowed(A: Array, n: int) -> Array:
    """A basis of the velocities that the rows allow."""
    _, singular, turned = np.linalg.svd(A.reshape(-1, n))
    return turned[int((singular > RANK * singular.max(initial=0.0)).sum()) :].T


def _matrices(model: Model, names: Mapping[str, tuple[str, ...]]) -> Program:
    """q, v, u, p, t → M, Ṁ along the motion, C, and the applied forces Ξ."""
    g = Graph()
    inputs = dynamics.Inputs.of(g, model)
    m = dynamics.describe(model, g, inputs)
    M = [x for row in m.mass_matrix() for x in row]
    along = {**dict(zip(inputs.q, m.motion.rates, strict=True)), inputs.t: g.one}
    made = {"M": M, "Mdot": jvp(g, M, along), "C": [x for row in coriolis(m) for x in row]}
    made["Xi"] = m.gathered([*m.efforts, *m.dragged])
    return Program("matrices", g, names, {k: Output(tuple(ids), (len(ids),)) for k, ids in made.items()})


def _balance(model: Model) -> Program:
    """x, ẋ, u, p, t → the rate of the energy h along ẋ, and the supplied power P."""
    power = dynamics.power(model)
    g, names = power.graph, power.inputs["x"]
    rates = {g.input("x", i): g.input("xdot", i) for i in range(len(names))}
    (hdot,) = jvp(g, list(power.outputs["h"].ids), {**rates, g.input("t", 0): g.one})
    inputs = {**power.inputs, "xdot": tuple(f"d{name}" for name in names)}
    return Program("balance", g, inputs, {"hdot": Output((hdot,), ()), "P": power.outputs["P"]}, power.defaults)


def _is_driven(model: Model) -> bool:
    """Whether something moves while all velocities are 0: a motion that is prescribed adds forces beside C v."""
    g = Graph()
    inputs = dynamics.Inputs.of(g, model)
    kinetic = dynamics.describe(model, g, inputs).kinetic()
    (at_rest,) = replaced(g, [kinetic], dict.fromkeys(inputs.v, g.zero))
    if at_rest == g.zero:
        return False
    program = Program("at rest", g, dynamics.forward(model).inputs, {"T": Output((at_rest,), ())})
    states = random_states(model, dynamics.forward(model), 2, 1)
    return any(float(evaluated(program, state)["T"]) != 0 for state in states)


def _is_quadratic(model: Model) -> bool:
    """Whether the mass matrix depends on positions alone, and not on rates, as that of a coil that saturates does."""
    program = dynamics.mass_matrix(model)
    g = program.graph
    return set(reached(g, program.outputs["M"].ids)).isdisjoint(g.input("v", i) for i in range(len(model.velocities)))


def _reads_time(model: Model) -> bool:
    """Whether the kinetic energy depends on t itself: then C v does not contain all velocity terms."""
    g = Graph()
    inputs = dynamics.Inputs.of(g, model)
    m = dynamics.describe(model, g, inputs)
    return inputs.t in reached(g, [m.kinetic()])
