"""Checks the arguments of a solver: arrays of the right shapes, or an error with a remedy."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.codegen.arguments import InputGroup, numbers
from lagrangian.errors import RunError
from lagrangian.graph import Program, reached

from .guards import guards
from .methods.jets import KINKS
from .methods.method import Method
from .methods.printer import UNROLLED

Array = NDArray[np.float64]

EXPANDED = 400
"""The largest number of operations of a right-hand side that is expanded in series."""

FAR = 1e15
"""The largest number of steps of fixed length between two stop points."""


def finite(array: Array, what: str, names: Sequence[str] = ()) -> Array:
    """The array in C order, if every number in it is finite."""
    if not np.all(np.isfinite(array)):
        where = np.argwhere(~np.isfinite(array))[0]
        entry = f"'{names[where[-1]]}' " if names else ""
        run = f" of run {where[0]}" if array.ndim == 2 else ""
        raise RunError(f"{what} {entry}is {array[tuple(where)]}{run}", code="E502", fix="give finite numbers")
    return np.ascontiguousarray(array)


def rows(group: InputGroup, given: Any, what: str) -> Array:
    """One row for all runs, or one for each run: (n,) or (N, n)."""
    array = group.array(given)
    if array.ndim > 2:
        raise RunError(f"{what} has {array.ndim} axes", code="E501", fix=f"one row, or (runs, {len(group.entries)})")
    return finite(array, what, group.entries)


def instants(given: Any) -> Array:
    """Requested times: at least two, strictly increasing."""
    times = finite(numbers(given, "times"), "a requested time")
    if times.ndim != 1 or len(times) < 2:
        raise RunError(
            f"times has shape {times.shape}", code="E501", fix="give at least two times: the start and the end"
        )
    if np.any(np.diff(times) <= 0):
        k = int(np.argmax(np.diff(times) <= 0))
        raise RunError(
            f"times must increase: {times[k]:g} is followed by {times[k + 1]:g}",
            code="E501",
            fix="sort them and give each only once",
        )
    return times


def number(given: Any, what: str, *, infinite: bool = False) -> float:
    """A number greater than zero."""
    array = numbers(given, what)
    value = float(array) if array.ndim == 0 else math.nan
    if math.isnan(value) or (math.isinf(value) and not infinite) or value <= 0:
        raise RunError(f"{what} must be a number greater than 0 (got {given!r:.40})", code="E501")
    return value


def whole(given: Any, what: str) -> int:
    """A whole number, at least 1."""
    if isinstance(given, bool) or not isinstance(given, (int, np.integer)) or given < 1:
        raise RunError(f"{what} must be a whole number, at least 1 (got {given!r:.40})", code="E501")
    return min(int(given), 2**62)


def step_length(step: Any, times: Array) -> float:
    """The length of a fixed step, if time has enough resolution for it."""
    length = number(step, "step")
    if (times[-1] - times[0]) / length > FAR:
        raise RunError(f"a step of {length:g} is too short for a run of {times[-1] - times[0]:g}", code="E501")
    return length


def tolerances(rtol: Any, atol: Any, size: int) -> tuple[float, Array]:
    """The relative tolerance, and the absolute one of each entry."""
    relative = number(rtol, "rtol")
    absolute = numbers(atol, "atol")
    if absolute.ndim == 0:
        absolute = np.full(size, float(absolute))
    if absolute.shape != (size,):
        raise RunError(f"atol has shape {absolute.shape}", code="E501", fix=f"one number, or one an entry: ({size},)")
    if not np.all(np.isfinite(absolute)) or np.any(absolute <= 0):
        raise RunError("atol must be greater than 0", code="E501")
    return relative, np.ascontiguousarray(absolute)


def suits(method: Method, program: Program) -> None:
    """Raise an error if a method that expands the motion cannot be used for a right-hand side."""
    if not method.expands:
        return
    nodes = [program.graph.nodes[i] for i in reached(program.graph, program.ids)]
    guarding, conditions = guards(program)
    live = set(reached(program.graph, program.ids)) - guarding - conditions
    kinks = sorted({program.graph.nodes[i][0] for i in live} & KINKS)
    if kinks:
        raise RunError(
            f"method '{method.name}' needs a smooth right-hand side, and '{program.name}' has {', '.join(kinks)}",
            code="E501",
            fix="use method 'dop853'",
        )
    if len(program.inputs["x"]) > UNROLLED or len(nodes) > EXPANDED:
        raise RunError(
            f"'{program.name}' is too long for method '{method.name}': {len(nodes)} operations",
            code="E501",
            fix="use method 'dop853'",
        )


def lanes_wanted(lanes: int | None) -> None:
    """Raise an error unless there is code for this number of lanes."""
    if lanes is not None and (type(lanes) is not int or lanes not in (1, 2, 4, 8, 16)):
        raise RunError(f"lanes must be 1, 2, 4, 8 or 16 (got {lanes!r})", code="E501")


def threads_wanted(threads: int | None) -> None:
    """Raise an error unless the number of threads is valid."""
    if threads is not None and (type(threads) is not int or threads < 1):
        raise RunError(f"threads must be a whole number, at least 1 (got {threads!r})", code="E501")
