"""Inputs as functions of time, and events: what an integrator needs besides a right-hand side."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import RunError
from lagrangian.graph import Program
from lagrangian.records import dataclass

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Signals:
    """Inputs as piecewise linear functions of time, the same for every run.

    On ``[knots[k], knots[k+1])`` it is ``u(t) = start[k] + slope[k]·(t − knots[k])``; the last piece has no end.
    ``knots`` (K,) increase strictly and begin no later than the run; ``start`` and ``slope`` are (K, nu). A step never
    crosses a knot, so that a method keeps its order where an input jumps or bends.
    """

    knots: Array
    start: Array
    slope: Array

    def checked(self, count: int, begin: float) -> Signals:
        """Return the same signals as float64 arrays in C order, or raise `RunError` for shapes that do not fit."""
        knots, start, slope = (np.ascontiguousarray(a, float) for a in (self.knots, self.start, self.slope))
        if knots.ndim != 1 or not len(knots) or np.any(~np.isfinite(knots)) or np.any(np.diff(knots) <= 0):
            raise RunError(
                "the knots of the inputs must increase strictly", code="E501", fix="sort them and give each only once"
            )
        wanted = (len(knots), count)
        for name, array in (("start", start), ("slope", slope)):
            if array.shape != wanted:
                raise RunError(f"{name} of the inputs has shape {array.shape}, needed is {wanted}", code="E501")
            if not np.all(np.isfinite(array)):
                raise RunError(f"{name} of the inputs holds a value that is not finite", code="E502")
        if knots[0] > begin:
            raise RunError(
                f"the inputs begin at t = {knots[0]:g}, the run at {begin:g}", code="E501", fix="add an earlier knot"
            )
        return Signals(knots, start, slope)


@dataclass(frozen=True)
class Events:
    """Functions g of time and state whose zeros are events, over the groups x, u, p, t of the right-hand side.

    ``program`` has the output ``g`` (ne,) and, if any event resets the state, ``after`` (ne, nx): the state after event
    k. ``direction``: +1 if g rises, −1 if it falls, 0 both. ``terminal``: the run ends there. ``reset``: the state is
    replaced by ``after[k]``, and the integration restarts.
    """

    program: Program
    direction: tuple[int, ...]
    terminal: tuple[bool, ...]
    reset: tuple[bool, ...]

    def checked(self, rates: Program) -> Events:
        """Return the same events, or raise `RunError` if they do not fit the right-hand side ``rates``."""
        outputs, size = self.program.outputs, len(rates.inputs["x"])
        for group, names in self.program.inputs.items():
            if names and tuple(names) != tuple(rates.inputs.get(group, ("t",) if group == "t" else ())):
                raise RunError(
                    f"group '{group}' of the events is not that of the right-hand side",
                    code="E501",
                    fix="name the same entries in the same order",
                )
        if "g" not in outputs or len(outputs["g"].shape) != 1:
            raise RunError("the program of the events needs an output 'g' of shape (number of events,)", code="E501")
        count = outputs["g"].shape[0]
        lengths = {len(self.direction), len(self.terminal), len(self.reset)}
        if lengths != {count}:
            raise RunError(f"{count} events need as many directions, terminals and resets", code="E501")
        if any(d not in (-1, 0, 1) for d in self.direction):
            raise RunError("the direction of an event is -1, 0 or 1", code="E501")
        if any(self.reset) and ("after" not in outputs or outputs["after"].shape != (count, size)):
            raise RunError(f"events that reset need an output 'after' of shape ({count}, {size})", code="E501")
        return self
