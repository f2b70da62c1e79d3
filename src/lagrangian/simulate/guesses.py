"""The unknowns of a fit or an optimization: their names, guesses and bounds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.errors import RunError, did_you_mean
from lagrangian.model import Model
from lagrangian.page.formula import Check, Text, Verbatim, text
from lagrangian.values.values import Given, key_name, number

Array = NDArray[np.float64]
Bounds = tuple[Array, Array]


def guessed(given: Any, what: str = "parameters") -> dict[str, Any]:
    """Name → first guess, None where none is given; raises `RunError` for what names nothing."""
    if isinstance(given, (str, sp.Basic)):
        given = [given]
    if isinstance(given, Mapping):
        found = {key_name(key): value for key, value in given.items()}
        count = len(given)
    elif isinstance(given, Sequence) and all(isinstance(x, (str, sp.Basic)) for x in given):
        found = {key_name(key): None for key in given}
        count = len(given)
    else:
        raise RunError(
            f"{what} must be names, or a mapping from names to first guesses (got {given!r:.60})",
            fix="such as ['m1', 'L1'], or {'m1': 0.8, 'L1': 1.2}",
            code="E501",
        )
    if not found:
        raise RunError(f"{what} names nothing", fix="such as ['m1', 'L1']", code="E401")
    if len(found) < count:
        raise RunError(f"a name is given twice in {what}", fix="name each once", code="E404")
    return found


def by_key(given: Any, what: str) -> dict[str, Any]:
    """A mapping with names as keys, empty for None; raises `RunError` for anything else."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise RunError(
            f"{what} must be a mapping from names to values (got {type(given).__name__})",
            fix="such as {'m1': 0.8}",
            code="E501",
        )
    return {key_name(key): value for key, value in given.items()}


def limits(bounds: Any, names: Sequence[str], owners: Sequence[str], given: Given) -> Bounds:
    """Lower and upper bounds of unknowns from a mapping name → (low, high), in which None is no bound.

    ``names`` are those of the unknowns, ``owners`` those of the parameters or states that they belong to.
    """
    low, high = np.full(len(names), -np.inf), np.full(len(names), np.inf)
    if bounds is None:
        return low, high
    if not isinstance(bounds, Mapping):
        raise RunError(
            f"bounds must be a mapping from names to (low, high) (got {type(bounds).__name__})",
            fix="such as {'m1': (0, None)}",
            code="E501",
        )
    for key, pair in bounds.items():
        name = key_name(key)
        places = [i for i, owner in enumerate(owners) if name in (owner, names[i])]
        if not places:
            fix = did_you_mean(name, names) or f"unknowns: {', '.join(names[:12])}"
            raise RunError(f"bounds: '{name[:64]}' is not an unknown", fix=fix, code="E402")
        if not isinstance(pair, (tuple, list)) or len(pair) != 2:
            raise RunError(
                f"the bounds of '{name}' must be two values (got {pair!r:.40})",
                fix="(low, high), with None where there is no bound",
                code="E501",
            )
        ends = [_end(x, name, given, side) for x, side in zip(pair, (-np.inf, np.inf), strict=True)]
        if not ends[0] < ends[1]:
            raise RunError(f"the bounds of '{name}' are empty: {ends[0]:g} to {ends[1]:g}", code="E501")
        for i in places:
            low[i], high[i] = ends
    return low, high


def _end(value: Any, name: str, given: Given, none: float) -> float:
    if value is None or (isinstance(value, float) and value == none):
        return none
    return quantity_value(value, name, given, f"a bound of '{name}'")


def quantity_value(value: Any, name: str, given: Given, what: str) -> float:
    """A number for a parameter, state or input, in its unit."""
    for group in (given.parameters, given.states, given.inputs):
        if name in group.names:
            return number(value, what, group.dims[group.names.index(name)])
    return number(value, what)


def check_inside(names: Sequence[str], values: Array, bounds: Bounds) -> None:
    """Raise `RunError` for a guess outside its bounds."""
    for name, x, low, high in zip(names, values, *bounds, strict=True):
        if not low <= x <= high:
            raise RunError(
                f"the first guess of '{name}', {x:g}, is not between its bounds {low:g} and {high:g}",
                fix="give a guess inside: a mapping from names to guesses",
                code="E501",
            )


def lettered(model: Model, name: str) -> Text:
    """An unknown as it is written in formulas: a symbol, with the number of its run or of its value: θ[0]."""
    base, bracket, rest = name.partition("[")
    symbols = {**model.symbols, **{v.name: v.symbol for v in model.velocities}}
    return text(symbols.get(base, Verbatim(base)), Verbatim(bracket + rest))


def checks_data(checks: Sequence[Check]) -> list[dict[str, Any]]:
    """The checks of a result as data."""
    return [{"what": str(c.what), "holds": c.holds, "figure": c.figure} for c in checks]
