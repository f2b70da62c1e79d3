"""Values that users pass by name, as numbers or text with units, for coordinates, rates, inputs and parameters."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.advice import Advice, Argument
from lagrangian.errors import RunError, did_you_mean
from lagrangian.graph import Program
from lagrangian.model import Model
from lagrangian.page.plain import plain
from lagrangian.quantities.largest import SMALLER, too_large
from lagrangian.quantities.quantity import parse_quantity
from lagrangian.records import dataclass
from lagrangian.values.dimensions import NONE, RATE, SECOND, Dim, Dimensions, Mismatch, check_dimensions

Named = Mapping[Any, Any]
"""Values by name or by symbol; each is a number in SI units or text with a unit, such as "12 deg"."""


def key_name(key: object) -> str:
    """Return the name for a key: text as it is, a symbol (or its derivative) as it is written in model files."""
    return plain(key) if isinstance(key, sp.Basic) else str(key)


def _unit(dim: Dim) -> str:
    """Return a dimension as an SI unit; without dimension it is an angle or a number."""
    return "rad (or no unit)" if dim.known == NONE.known else str(dim)


def _example(dim: Dim | None) -> str:
    """A quantity of a dimension as it is written: ``10 s``; of an angle or a number ``0.3``."""
    if dim is None or dim.unknown:
        return "40 N/m"
    return "0.3" if dim.known == NONE.known else f"10 {dim}"


def number(value: object, what: str, dim: Dim | None = None) -> float:
    """Return a number in SI units from a number or from text with a unit; ``dim`` is the required dimension.

    Raises `RunError` if it is complex, not finite, too large to compute with, not a number, or has another dimension.
    """
    real = _number(value, what, dim)
    if not math.isfinite(real):
        raise RunError(f"{what} is {real}", fix="give a finite number", code="E502")
    if trouble := too_large(real):
        raise RunError(f"{what} {trouble}", fix=SMALLER, code="E101")
    return real


def _number(value: object, what: str, dim: Dim | None) -> float:
    """The same for numbers of any size, and for those that are not finite."""
    if isinstance(value, str):
        quantity = parse_quantity(value, what=what, example=_example(dim))
        found = Dim(quantity.dimension.exponents)
        if dim is not None and not dim.unknown and not quantity.is_bare and found.known != dim.known:
            raise RunError(
                f"{what} = {value!r} has the unit {_unit(found)}, but {_unit(dim)} is needed",
                fix="check the name and the unit, or give a number in SI units without a unit",
                code="E408",
            )
        return quantity.value
    if isinstance(value, (bool, bytes)) or not hasattr(value, "__float__") or isinstance(value, complex):
        raise RunError(
            f"{what} must be a real number (got {value!r:.40})",
            fix='a number in SI units, or text: "12 deg"',
            code="E501",
        )
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        raise RunError(
            f"{what} must be one real number (got {value!r:.40})", fix='a number, or text: "12 deg"', code="E501"
        ) from None


MOST_STATES = 1_000_000
"""The largest number of random states for a check."""


def check_sampling(states: object, seed: object) -> None:
    """Raise an error unless the number of random states and the seed are whole numbers in range."""
    for name, value, least, most in (("states", states, 1, MOST_STATES), ("seed", seed, 0, None)):
        whole = isinstance(value, (int, np.integer)) and not isinstance(value, bool)
        if not whole or int(value) < least or (most is not None and int(value) > most):  # type: ignore[call-overload]
            upper = f" to {most}" if most is not None else " or more"
            raise RunError(
                f"{name} must be a whole number, {least}{upper} (got {value!r:.40})", fix=f"{name}=1", code="E501"
            )


@dataclass(frozen=True)
class Group:
    """One group of the inputs of a program: its names, what an entry is called, and the dimensions."""

    noun: str
    names: tuple[str, ...]
    dims: tuple[Dim | None, ...]

    def values(self, given: Named | Sequence[float] | NDArray[Any] | None) -> dict[str, float]:
        """Return name → number for the given values; an array has a number for every entry, in order. Raises
        `RunError`."""
        if given is None:
            return {}
        if not isinstance(given, Mapping):
            return self._listed(given)
        found: dict[str, float] = {}
        for key, value in given.items():
            name = key_name(key)
            if name not in self.names:
                known = f"known: {', '.join(self.names[:12])}{', …' if len(self.names) > 12 else ''}"
                raise RunError(
                    f"there is no {self.noun} '{name[:64]}'", fix=did_you_mean(name, self.names) or known, code="E402"
                )
            if name in found:
                raise RunError(f"{self.noun} '{name}' is given twice, by name and by symbol", code="E404")
            found[name] = number(value, f"{self.noun} '{name}'", self.dims[self.names.index(name)])
        return found

    def _listed(self, given: Any) -> dict[str, float]:
        try:
            values = list(given)
        except TypeError:
            values = [given]
        if isinstance(given, (str, bytes)) or len(values) != len(self.names):
            raise RunError(
                f"{len(values)} values for {len(self.names)} of {self.noun}s: {', '.join(self.names)}",
                fix="give a mapping by name, or one number for each, in this order",
                code="E501",
            )
        return {name: number(v, f"{self.noun} '{name}'") for name, v in zip(self.names, values, strict=True)}


@dataclass(frozen=True, eq=False)
class Given:
    """The groups of a model: states (the group x of the program), inputs and parameters."""

    model: Model
    states: Group
    inputs: Group
    parameters: Group
    dimensions: Dimensions | None

    @classmethod
    def of(cls, model: Model, program: Program) -> Given:
        """The groups x, u, p of ``program``, with the dimensions that follow from the units of the model."""
        names = program.inputs["x"], program.inputs["u"], program.inputs["p"]
        groups = model.remembered(("given", *names), lambda: _groups(model, *names))
        return cls(model, *groups, check_dimensions(model))

    def parameter_values(self, given: Named | None) -> NDArray[np.float64]:
        """The value of every parameter: the given one, else the declared one. Raises `RunError` that lists those
        without a value."""
        values = {p.name: p.value for p in self.model.parameters} | self.parameters.values(given)
        missing = [name for name, value in values.items() if value is None]
        if missing:
            raise RunError(
                f"parameter '{missing[0]}' has no value. Missing: {', '.join(missing)}",
                fix=Advice("give ", Argument("params", "…", missing[0]), ", or a value where it is declared"),
                code="E401",
            )
        return np.array(list(values.values()), float)

    def input_values(self, given: Named | None) -> NDArray[np.float64]:
        """The constant value of every input, 0 if none is given."""
        values = dict.fromkeys(self.inputs.names, 0.0) | self.inputs.values(given)
        return np.array(list(values.values()), float)

    def dimension(self, expr: sp.Expr) -> Dim | None:
        """The dimension of an expression, None where it is not known."""
        return _dim(self.dimensions, expr)

    def time_value(self, given: object, what: str = "time") -> float:
        """Return a time in seconds."""
        return number(given, what, SECOND)


def _groups(
    model: Model, states: tuple[str, ...], inputs: tuple[str, ...], parameters: tuple[str, ...]
) -> tuple[Group, Group, Group]:
    """The groups x, u, p with these names and the dimensions of their entries."""
    dims = check_dimensions(model)
    moving = {c.name: _dim(dims, c.symbol) for c in model.coordinates}
    rates = {f"{name}'": None if d is None else d.times(RATE) for name, d in moving.items()}
    known = {**moving, **rates}
    return (
        Group("state", states, tuple(known.get(s) for s in states)),
        Group("input", inputs, tuple(_dim(dims, u.symbol) for u in model.inputs)),
        Group("parameter", parameters, tuple(_dim(dims, p.symbol) for p in model.parameters)),
    )


def _dim(dims: Dimensions | None, symbol: Any) -> Dim | None:
    if dims is None:
        return None
    try:
        found = dims.of(symbol)
    except Mismatch:
        return None
    return None if found is None or found.unknown else found
