"""Linearization along a trajectory: δẋ = A(t) δx + B(t) δu, δy = C(t) δx + D(t) δu, at every stored time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian.errors import RunError, did_you_mean
from lagrangian.linear.jacobians import rates
from lagrangian.linear.manifold import Manifold, tangents
from lagrangian.linear.outputs import measured
from lagrangian.model import Model
from lagrangian.model.without_friction import check_no_friction
from lagrangian.records import dataclass
from lagrangian.values.values import Given, Named, key_name, number
from lagrangian.viewed import Brief, cut

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class MotionLinearization(Brief):
    """The linearization at the times ``t`` (S,) of a trajectory ``x`` (S, n) with inputs ``u`` (S, m).

    ``A`` (S, n, n), ``B`` (S, n, m), ``C`` (S, k, n), ``D`` (S, k, m); ``y`` (S, k) are the outputs. Names are in
    declared order. The inputs are treated as constants: a feedback that controlled the run does not contribute to A.

    With constraints ``states`` are independent ones, the same at all times, and n in A, B and C is their number;
    ``basis`` (S, all states, n) says how all states change with them. It is None without constraints.
    """

    model: Model
    t: Array
    x: Array
    u: Array
    y: Array
    A: Array
    B: Array
    C: Array
    D: Array
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    parameters: Mapping[str, float]
    basis: Array | None = None

    def __repr__(self) -> str:
        span = f", t = {self.t[0]:g} … {self.t[-1]:g} s" if len(self.t) else ""
        return cut(f"<{self.model.name}: linearization along a run, {len(self.t)} times{span}>")

    def __len__(self) -> int:
        """The number of times."""
        return len(self.t)

    def to_dict(self) -> dict[str, Any]:
        """Return plain data that can be written as JSON."""
        arrays = {name: getattr(self, name).tolist() for name in ("t", "x", "u", "y", "A", "B", "C", "D")}
        if self.basis is not None:
            arrays["basis"] = self.basis.tolist()
        names = {name: list(getattr(self, name)) for name in ("states", "inputs", "outputs")}
        return {"system": self.model.name, **names, "parameters": dict(self.parameters), **arrays}


def linearize_along(
    model: Model,
    trajectory: Any,
    *,
    inputs: Mapping[Any, Any] | None = None,
    params: Named | None = None,
    outputs: Any = None,
) -> MotionLinearization:
    """Return the linearization along a trajectory: a run, or a pair of times (S,) and states (S, n).

    A run has its own inputs and parameters. ``inputs``: name or symbol → number, text with a unit, or a value for each
    time (S,). Raises `RunError` for shapes, names and values that do not fit, for states that do not satisfy the
    constraints, and if no choice of independent states is one at all times.
    """
    check_no_friction(model, "there is no linearization along a run that changes between both")
    program = rates(model)
    given = Given.of(model, program)
    t, x, own_inputs, own_params = _taken(model, trajectory, program.inputs["x"])
    p = given.parameter_values({**own_params, **given.parameters.values(params)})
    u = _signals(given, {**own_inputs, **_by_name(inputs)}, len(t))
    kernel = machine.compile(program)
    found = kernel(x, u, p, t)
    y = measured(model, outputs, program)
    seen = machine.compile(y.program)(x, u, p, t)
    states, basis = program.inputs["x"], None
    if model.constraints:
        kept, basis = tangents(Manifold(model), t, x, p)
        states = tuple(states[k] for k in kept)
        found = {"A": found["A"][:, kept] @ basis, "B": found["B"][:, kept]}
        seen = {**seen, "C": seen["C"] @ basis}
    return MotionLinearization(
        model=model,
        t=t,
        x=x,
        u=u,
        y=seen["y"],
        A=found["A"],
        B=found["B"],
        C=seen["C"],
        D=seen["D"],
        states=states,
        inputs=program.inputs["u"],
        outputs=y.names,
        parameters=dict(zip(program.inputs["p"], p.tolist(), strict=True)),
        basis=basis,
    )


def _taken(
    model: Model, trajectory: Any, states: tuple[str, ...]
) -> tuple[Array, Array, dict[str, Any], dict[str, float]]:
    """The times, states (S, n), inputs and parameters of a trajectory."""
    if hasattr(trajectory, "t") and hasattr(trajectory, "y"):
        t, x = np.asarray(trajectory.t, float), np.ascontiguousarray(np.asarray(trajectory.y, float).T)
        own = {i.name: trajectory[i.symbol] for i in model.inputs} if hasattr(trajectory, "observe") else {}
        params = dict(getattr(trajectory, "params", {}))
    else:
        if not isinstance(trajectory, Sequence) or len(trajectory) != 2:
            raise RunError("a trajectory is a run, or a pair of times and states", fix="(t, x)", code="E501")
        try:
            t, x = (np.ascontiguousarray(np.asarray(part, float)) for part in trajectory)
        except (TypeError, ValueError):
            raise RunError("times and states must be arrays of real numbers", code="E501") from None
        own, params = {}, {}
    if t.ndim != 1 or not len(t) or x.shape != (len(t), len(states)):
        raise RunError(
            f"times have shape {t.shape}, states {x.shape}; (S,) and (S, {len(states)}) are needed",
            fix=f"states in the order {', '.join(states)}",
            code="E501",
        )
    if not (np.isfinite(t).all() and np.isfinite(x).all()):
        raise RunError("the trajectory has values that are not finite", code="E502")
    return t, x, own, params


def _by_name(inputs: Mapping[Any, Any] | None) -> dict[str, Any]:
    return {key_name(key): value for key, value in (inputs or {}).items()}


def _signals(given: Given, inputs: Mapping[str, Any], count: int) -> Array:
    """The inputs at every time: (S, m)."""
    names = given.inputs.names
    u = np.zeros((count, len(names)))
    for name, value in inputs.items():
        if name not in names:
            raise RunError(f"there is no input '{name[:64]}'", fix=did_you_mean(name, names), code="E402")
        k = names.index(name)
        if isinstance(value, np.ndarray | list | tuple):
            column = np.asarray(value, float)
            if column.shape != (count,) or not np.isfinite(column).all():
                raise RunError(f"input '{name}' needs {count} finite values (got {column.shape})", code="E501")
            u[:, k] = column
        else:
            u[:, k] = number(value, f"input '{name}'", given.inputs.dims[k])
    return u
