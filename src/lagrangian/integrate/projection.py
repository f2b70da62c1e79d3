"""Projection: constraint rows that a motion must satisfy, the steps that restore them, and the drift.

A method satisfies f(q, t) = 0 and A(q, t) v + a₀ = 0 only to its tolerance. After a step the state is projected: one
Newton step on positions (more if the residual stays above `CLOSED`), then a linear step on velocities. Two programs,
which are made elsewhere, compute the corrections.
"""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import RunError
from lagrangian.graph import Graph, Output, Program, copied, replaced
from lagrangian.records import dataclass

Array = NDArray[np.float64]

CLOSED = 1e-12
"""The largest residual of a position row, divided by its scale, that needs no further step."""

MORE_STEPS = 8
"""The largest number of further steps on positions: usually 0 for a step of a run, a few for a start."""

ROUNDING = 2.0**-43
"""Up to this residual times √margin, in the largest entry of the state or 1, a correction is no sign of a step's
error."""


NEARLY_DEPENDENT = 1e-6
"""Below this margin, a correction is no sign of a step's error, because it grows as 1/√margin."""

BREAKS = 1e-6
"""Above this residual, divided by the row's scale, the state after an event or a correction violates the row."""


@dataclass(frozen=True)
class Projection:
    """The programs that project states onto their rows, over the groups x, u, p, t of the right-hand side.

    ``position`` and ``velocity`` (None where there are no such rows) have the outputs ``dx`` (nx,), which is added
    to x, and ``gap`` (), the largest residual of a row at x over its scale. ``velocity`` is evaluated at corrected
    positions and does not change them. ``margin`` (), in either, says how far the rows are from being dependent.
    With ``corrects=False`` nothing is changed, and the residuals are only measured. ``spare``: some rows are left out
    because they follow from others; a run in which one of them no longer holds has failed.
    """

    position: Program | None
    velocity: Program | None
    corrects: bool = True
    spare: bool = False

    def checked(self, rates: Program) -> Projection:
        """Return the projection; raise `RunError` if it does not fit the right-hand side ``rates``."""
        size = len(rates.inputs["x"])
        for program in self.programs:
            for group, names in program.inputs.items():
                if names and tuple(names) != tuple(rates.inputs.get(group, ("t",) if group == "t" else ())):
                    raise RunError(
                        f"group '{group}' of '{program.name}' is not that of the right-hand side",
                        code="E501",
                        fix="name the same entries in the same order",
                    )
            shapes = {name: output.shape for name, output in program.outputs.items()}
            if shapes.get("dx") != (size,) or shapes.get("gap") != () or shapes.get("margin", ()) != ():
                raise RunError(
                    f"'{program.name}' has outputs {shapes}, and a projection needs 'dx' ({size},) and 'gap' ()",
                    code="E501",
                    fix="'margin' () may be added",
                )
        if not self.programs:
            raise RunError("a projection needs a program for positions, or one for velocities", code="E501")
        return self

    @property
    def programs(self) -> tuple[Program, ...]:
        """The programs that are not None."""
        return tuple(p for p in (self.position, self.velocity) if p is not None)

    @property
    def approach(self) -> Program | None:
        """The step on positions: ``dx`` (nx,) and ``gap`` (); None without rows on positions."""
        if self.position is None or not self.corrects:
            return None
        return replace(self.position, outputs={name: self.position.outputs[name] for name in ("dx", "gap")})

    @property
    def joint(self) -> bool:
        """Whether one program can have both steps, which then share what they compute: they are in the same graph."""
        found = self.approach
        return found is not None and self.velocity is not None and found.graph is self.velocity.graph

    def landing(self, rates: Program, *, joint: bool = False) -> Program:
        """The step after it: ``dx`` (nx,) and the outputs `SEEN`, about the state before and after that step.

        ``joint``: with the step on positions, too, as ``dq`` (nx,).
        """
        graph = rates.graph if all(p.graph is rates.graph for p in self.programs) else Graph()
        position, velocity = (None if p is None else _outputs(p, graph) for p in (self.position, self.velocity))
        size = len(rates.inputs["x"])
        rest = position["gap"][0] if position else graph.zero
        dx, gap, left = [graph.zero] * size, graph.zero, graph.zero
        if velocity:
            gap = left = velocity["gap"][0]
        if velocity and self.corrects:
            dx = velocity["dx"]
            moved = {graph.input("x", i): graph.add(graph.input("x", i), d) for i, d in enumerate(dx)}
            (left,) = replaced(graph, [gap], moved)
        margins = [found["margin"][0] for found in (velocity, position) if found and "margin" in found]
        seen = {"rest": rest, "gap": gap, "left": left, **({"margin": margins[0]} if margins else {})}
        outputs = {"dx": Output(tuple(dx), (size,)), **{name: Output((i,), ()) for name, i in seen.items()}}
        if joint and position:
            outputs["dq"] = Output(tuple(position["dx"]), (size,))
        defaults = {k: v for program in self.programs for k, v in program.defaults.items()}
        return Program(f"{rates.name} projection", graph, {**rates.inputs, "t": ("t",)}, outputs, defaults)


BRANCHING = 1e-3
"""A run that comes to a margin below this has come to a position where a linkage can branch."""

LATELY = 0.01
"""The least margin belongs to the end of a run if it is in this last part of it."""


def at_branch(margin: float, margin_time: float, t: float, rtol: float = 1.0) -> bool:
    """Whether the least ``margin`` of a run up to ``t`` is small, and was reached lately.

    At the margin δ², rounding ε is a noise of ε/δ³ in the accelerations; small is also where that exceeds ``rtol``.
    """
    small = max(BRANCHING, (float(np.finfo(float).eps) / rtol) ** (2 / 3))
    return margin < small and t - margin_time <= LATELY * t


SEEN = ("rest", "gap", "left", "margin")
"""Outputs of `Projection.landing` beside ``dx``: the residuals of positions, those of velocities, those of velocities
after the step, and the margin if there is one."""


def _outputs(program: Program, graph: Graph) -> dict[str, list[int]]:
    """The nodes of a program's outputs in a graph."""
    own = program.graph is graph
    return {n: list(o.ids) if own else copied(program.graph, o.ids, graph) for n, o in program.outputs.items()}


@dataclass
class Drift:
    """The drift of N runs from their rows, (N,) each: the largest residuals, divided by the rows' scales.

    ``position`` and ``velocity``: at the ends of steps, ``…_before`` and ``…_after`` the projection; equal
    without correction. ``start_…``: of the given initial states. ``reset_…``: of the states right after events that
    change the state. ``margin``: the least one, +∞ if there is none, at the time ``margin_time``.
    """

    position_before: Array
    position_after: Array
    velocity_before: Array
    velocity_after: Array
    start_position: Array
    start_velocity: Array
    reset_position: Array
    reset_velocity: Array
    margin: Array
    margin_time: Array

    @classmethod
    def of_rows(cls, rows: Array) -> Drift:
        """Make it from an array (N, 10) with one row for each run, in the order of the fields."""
        return cls(*np.ascontiguousarray(rows.T))

    @staticmethod
    def blank(count: int) -> Array:
        """Rows of runs that have not begun."""
        rows = np.zeros((count, len(DRIFT)))
        rows[:, MARGIN], rows[:, MARGIN_TIME] = np.inf, np.nan
        return rows


DRIFT = tuple(field.name for field in fields(Drift))
"""The numbers that are recorded for a run, in order."""

START, RESET, MARGIN, MARGIN_TIME = (
    DRIFT.index(name) for name in ("start_position", "reset_position", "margin", "margin_time")
)
