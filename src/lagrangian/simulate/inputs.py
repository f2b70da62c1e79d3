"""The inputs of a run: constants, tables, expressions of time and state, or Python functions, by name.

Expressions are compiled into the equations; constants and tables are piecewise linear signals. A Python function is
called at every evaluation, which is slow.
"""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import read
from lagrangian.advice import Advice, Argument
from lagrangian.codegen.arguments import numbers
from lagrangian.errors import ModelError, ParseError, RunError, did_you_mean
from lagrangian.integrate.scipy_methods import Interval
from lagrangian.model import Input, Model
from lagrangian.quantities.largest import SMALLER, too_large
from lagrangian.records import dataclass, field
from lagrangian.values.dimensions import Dim
from lagrangian.values.values import key_name, number

Array = NDArray[np.float64]
Given = float | str | sp.Expr | tuple[Any, ...] | Callable[[float, Array], float]
"""An input: a number, text, an expression, a table (times, values[, "hold" or "linear"]), or a function f(t, x)."""

_CALL = re.compile(r"[^\W\d]\w*\s*\(")

HOLD, LINEAR = "hold", "linear"
MAX_KNOTS = 1_000_000


@dataclass(frozen=True, eq=False)
class SampledInput:
    """A signal given by values at times: each held until the next (``hold``), or joined by straight lines."""

    times: Array
    values: Array
    hold: bool

    def at(self, t: Array, *, left: bool = False) -> Array:
        """The signal at times ``t``; at a jump, ``left`` selects the value before it."""
        if not self.hold:
            return np.interp(t, self.times, self.values)
        place = np.searchsorted(self.times, t, side="left" if left else "right") - 1
        return self.values[np.clip(place, 0, len(self.values) - 1)]


Source = float | SampledInput | Callable[[float, Array], float]


@dataclass(frozen=True, eq=False)
class InputSignals:
    """All inputs of a model: ``feedback`` by symbol; the others, in order, are ``free``, each with a source.

    ``size`` is the number of states [q; v], of which Python functions get a copy. ``stops`` are the times at which
    conditions that depend only on time switch.
    """

    feedback: dict[Any, sp.Expr] = field(default_factory=dict)
    free: tuple[Input, ...] = ()
    sources: tuple[Source, ...] = ()
    size: int = 0
    stops: Array = field(default_factory=lambda: np.empty(0))

    @property
    def calls_python(self) -> bool:
        """Whether an input is a Python function."""
        return any(callable(s) for s in self.sources)

    @property
    def constant(self) -> bool:
        """Whether all free inputs are constant and no step has to end at a given time."""
        return not len(self.stops) and all(isinstance(s, float) for s in self.sources)

    def knots(self, start: float, end: float) -> Array:
        """``start``, then the times before ``end`` at which a table bends or jumps, or a condition in time switches."""
        listed = [self.stops, *(s.times for s in self.sources if isinstance(s, SampledInput))]
        inside = [times[(times > start) & (times < end)] for times in listed]
        return np.concatenate([[start], np.unique(np.concatenate([*inside, np.empty(0)]))])

    def pieces(self, start: float, end: float) -> tuple[Array, Array, Array]:
        """Knots (K,), values (K, nu) and slopes (K, nu) of the signals at them: u = value + slope (t − knot)."""
        knots = self.knots(start, end)
        value, slope = np.zeros((len(knots), len(self.free))), np.zeros((len(knots), len(self.free)))
        ends = np.append(knots[1:], max(end, knots[-1]))
        wide = np.where(ends > knots, ends - knots, 1.0)
        for k, source in enumerate(self.sources):
            if isinstance(source, SampledInput):
                value[:, k] = source.at(knots)
                slope[:, k] = 0.0 if source.hold else (source.at(ends, left=True) - value[:, k]) / wide
            elif not callable(source):
                value[:, k] = source
        return knots, value, slope

    def legs(self, start: float, end: float) -> list[Interval]:
        """The intervals between knots, each with u(t, x)."""
        knots, value, slope = self.pieces(start, end)
        ends = [*knots[1:], end]
        asked = tuple(k for k, s in enumerate(self.sources) if callable(s))
        return [
            Interval(float(e), self._along(float(k), v, s), asked)
            for k, e, v, s in zip(knots, ends, value, slope, strict=True)
        ]

    def _along(self, knot: float, value: Array, slope: Array) -> Callable[[float, Array], Array]:
        called = [(k, s) for k, s in enumerate(self.sources) if callable(s)]
        bent = bool(slope.any())
        if not called and not bent:
            return lambda t, x: value

        def u(t: float, x: Array) -> Array:
            now = value + slope * (t - knot)
            for k, function in called:
                now[k] = _asked(self.free[k].name, function, t, np.array(x[: self.size]))
            return now

        return u

    def at(self, t: Array, x: Array) -> Array:
        """The free inputs at times (S,) and states (S, nx), shape (S, nu); at a jump, the value after it."""
        found = np.zeros((len(t), len(self.free)))
        for k, source in enumerate(self.sources):
            if isinstance(source, SampledInput):
                found[:, k] = source.at(t)
            elif callable(source):
                found[:, k] = [
                    _asked(self.free[k].name, source, float(s), np.array(y[: self.size]))
                    for s, y in zip(t, x, strict=True)
                ]
            else:
                found[:, k] = source
        return found


def _asked(name: str, function: Callable[[float, Array], Any], t: float, x: Array) -> float:
    """The result of a Python function as one finite number."""
    answer = function(t, x)
    try:
        real = float(answer)
    except (TypeError, ValueError):
        shape = getattr(answer, "shape", None)
        got = f"an array of shape {shape}" if shape else f"{type(answer).__name__} {answer!r:.40}"
        raise RunError(
            f"input '{name}' gave {got} at t = {t:.6g}", fix="return one real number: lambda t, x: …", code="E503"
        ) from None
    if not math.isfinite(real):
        raise RunError(f"input '{name}' is {real} at t = {t:.6g}", fix="return a finite number", code="E502")
    return real


def driving(
    model: Model,
    given: Mapping[Any, Any] | None,
    fallback: Mapping[str, Any],
    dims: Mapping[str, Dim | None] | None = None,
) -> InputSignals:
    """The inputs of a run from those given by name or symbol, else ``fallback`` from the model file, else 0.

    ``dims`` are the required dimensions of the inputs, by name. Raises `RunError` or `ModelError` for unknown names,
    tables that do not fit, and functions that cannot be called.
    """
    inputs = {u.name: u for u in model.inputs}
    named: dict[str, Any] = dict(fallback)
    for key, value in _items(given):
        name = key_name(key)
        if name not in inputs:
            known = f"inputs: {', '.join(inputs)}" if inputs else "the system has no inputs"
            raise RunError(f"there is no input '{name[:64]}'", fix=did_you_mean(name, inputs) or known, code="E402")
        named[name] = value
    feedback: dict[Any, sp.Expr] = {}
    free: list[Input] = []
    sources: list[Any] = []
    for name, u in inputs.items():
        source = _source(model, u, (dims or {}).get(name), named.get(name, 0.0))
        if isinstance(source, sp.Expr):
            feedback[u.symbol] = source
        else:
            free.append(u)
            sources.append(source)
    return InputSignals(feedback, tuple(free), tuple(sources), len(model.coordinates) + len(model.velocities))


def _items(given: Mapping[Any, Any] | None) -> list[tuple[Any, Any]]:
    if given is None:
        return []
    if not isinstance(given, Mapping):
        raise RunError(
            f"inputs must be a mapping from inputs to signals (got {type(given).__name__})",
            fix=Advice(Argument("inputs", "2.0", "tau")),
            code="E501",
        )
    return list(given.items())


def _source(model: Model, u: Input, dim: Dim | None, given: Any) -> Source | sp.Expr:
    """Convert a signal to its kind of source."""
    what = f"input '{u.name}'"
    if isinstance(given, str):
        return _text(model, what, given, dim)
    if isinstance(given, sp.Expr) and not given.is_number:
        return given
    if isinstance(given, (tuple, list)):
        return _table(what, given)
    if callable(given) and not hasattr(given, "__float__"):
        return _function(what, given)
    return number(given, what)


def _text(model: Model, what: str, text: str, dim: Dim | None) -> float | sp.Expr:
    """Read an expression in the names of the model or, if it is not one, a number with a unit; a call is never a
    unit."""
    try:
        expr = read.parse_expression(text, read.Scope(model.symbols), what=what)
    except ModelError as trouble:
        if _CALL.search(text):
            raise
        try:
            return number(text, what, dim)
        except ParseError:
            raise trouble from None
    return number(float(expr), what) if expr.is_number else expr


def _function(what: str, given: Callable[..., Any]) -> Callable[[float, Array], float]:
    try:
        inspect.signature(given).bind(0.0, np.zeros(1))
    except TypeError:
        raise RunError(
            f"{what}: the function cannot be called with (t, x)", fix="lambda t, x: …", code="E503"
        ) from None
    except ValueError:  # a builtin without a signature
        return given
    return given


def _table(what: str, given: Sequence[Any]) -> SampledInput:
    """Read (times, values) or (times, values, "hold" | "linear")."""
    kind = given[2] if len(given) == 3 else LINEAR
    if len(given) not in (2, 3) or kind not in (HOLD, LINEAR):
        raise RunError(
            f"{what}: a table is (times, values) or (times, values, 'hold'|'linear')",
            fix="(times, values, 'hold') keeps each value until the next time",
            code="E501",
        )
    times, values = (np.array(numbers(a, f"{what}: {of}")) for a, of in zip(given, ("times", "values"), strict=False))
    if times.ndim != 1 or times.shape != values.shape or not 1 <= len(times) <= MAX_KNOTS:
        raise RunError(
            f"{what}: times have shape {times.shape}, values {values.shape}",
            fix="give one value for each time",
            code="E501",
        )
    for label, array in (("time", times), ("value", values)):
        if not np.all(np.isfinite(array)):
            place = int(np.flatnonzero(~np.isfinite(array))[0])
            raise RunError(f"{what}: {label} number {place + 1} is {array[place]}", code="E502")
        if trouble := too_large(float(array[np.abs(array).argmax()])):
            raise RunError(f"{what}: a {label} {trouble}", fix=SMALLER, code="E101")
    if np.any(np.diff(times) <= 0):
        place = int(np.flatnonzero(np.diff(times) <= 0)[0])
        raise RunError(
            f"{what}: the times do not increase ({times[place]:g} is followed by {times[place + 1]:g})",
            fix="for a jump use 'hold'",
            code="E501",
        )
    return SampledInput(times, values, kind == HOLD)


def check_covers(drive: InputSignals, start: float, end: float) -> None:
    """Raise an error for tables that do not cover the run; the last value of a ``hold`` table continues."""
    for u, source in zip(drive.free, drive.sources, strict=True):
        if isinstance(source, SampledInput):
            late = source.times[0] > start
            if late or (not source.hold and source.times[-1] < end):
                raise RunError(
                    f"input '{u.name}': the table covers {source.times[0]:g} to {source.times[-1]:g} s, "
                    f"the run {start:g} to {end:g} s",
                    fix="extend the table" + ("" if late else ", or hold its last value with 'hold'"),
                    code="E501",
                )
