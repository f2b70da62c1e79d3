"""Derivatives of energies that an answer gives without the energy: ∂V/∂φ = m g l sin φ, then J φ̈ + ∂V/∂φ = M.

Such a line says what the derivative is, and is compared with ours; the lines that use it are equations with its value.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.general import SlopeNamed, slopes_of
from lagrangian.check.reading import is_placeholder
from lagrangian.check.reading.placeholders import is_force
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import time

_KINDS = {("T", True): "T-p", ("T", False): "T-slope", ("V", False): "V-slope", ("D", True): "D-slope"}
"""The kind of a line by its energy, and whether it is differentiated by a rate."""

Given = dict[tuple[str, tuple[Any, ...]], sp.Expr]
"""The values of derivatives, by the energy and by what it is differentiated."""


def with_given_slopes(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines with such derivatives as values; as they are where constraints hold, whose multipliers have names of
    the answer's own, and where none is given."""
    if truth.derivation.multipliers:
        return tuple(lines)
    given: Given = {}
    said: dict[int, AnsweredLine] = {}
    for k, line in enumerate(lines):
        found = _value(truth, line)
        if found is not None:
            given.setdefault((found[0].kind, found[0].orders), found[1])
            said[k] = _compared(truth, line, *found)
    return tuple(said[k] if k in said else _put(truth, line, given) for k, line in enumerate(lines))


def _value(truth: Reference, line: AnsweredLine) -> tuple[SlopeNamed, sp.Expr] | None:
    """The derivative that a line gives a value, and this value; None of another line."""
    if line.kind != "statement" or line.name is not None or line.sides is None or line.beside:
        return None
    for alone, other in (line.sides, line.sides[::-1]):
        form, slope = next(iter(slopes_of(truth, alone).items()), (None, None))
        if slope is None or form is None or time in slope.orders or (slope.kind, _by_rate(truth, slope)) not in _KINDS:
            continue
        value = (other != 0 or slope.kind == "T") and _is_value(truth, other)  # ∂V/∂φ = 0 is a condition of rest
        if alone in (form, -form) and value:
            return slope, other if alone == form else -other
    return None


def _by_rate(truth: Reference, slope: SlopeNamed) -> bool:
    """Whether an energy is differentiated by a rate."""
    return any(slope.orders == (c.rate,) for c in truth.model.coordinates)


def _is_value(truth: Reference, value: sp.Expr) -> bool:
    """Whether an expression is in names of the system, its definitions among them, without accelerations and inputs."""
    accelerations = [c.acceleration for c in truth.model.coordinates]
    inputs = [u.symbol for u in truth.model.inputs]
    held = any(is_placeholder(x) for x in bounded.atoms(value, AppliedUndef))
    plain = value if bounded.letters(value) <= truth.names else truth.expand(value)  # l stands for R - r
    return not held and bounded.letters(plain) <= truth.names and not plain.has(*accelerations, *inputs)


def _compared(truth: Reference, line: AnsweredLine, slope: SlopeNamed, value: sp.Expr) -> AnsweredLine:
    """A line that gives a derivative, as one that differentiates our energy."""
    by = next(c for c in truth.model.coordinates if slope.orders in ((c.symbol,), (c.rate,)))
    right = bounded.expand(slope.right)
    left, other = (right, value) if slope.kind == "T" else (value, right)
    kind = _KINDS[slope.kind, _by_rate(truth, slope)]
    return replace(line, kind=kind, name=by.name, expr=left - other, sides=(left, other))


def _put(truth: Reference, line: AnsweredLine, given: Mapping[tuple[str, tuple[Any, ...]], sp.Expr]) -> AnsweredLine:
    """A line that uses given derivatives, and no quantity without a value, as an equation."""
    if line.kind != "statement" or line.name is not None or line.beside:
        return line
    used = slopes_of(truth, line.expr)
    if not any((x.kind, x.orders) in given for x in used.values()):
        return line
    table = {form: given.get((x.kind, x.orders), x.right) for form, x in used.items()}
    expr = cast("sp.Expr", line.expr.xreplace(table))
    valueless = [x for x in bounded.atoms(expr, AppliedUndef) if is_placeholder(x) and not is_force(x)]
    if valueless or not expr.has(*[c.acceleration for c in truth.model.coordinates]):
        return line
    sides = None if line.sides is None else tuple(cast("sp.Expr", x.xreplace(table)) for x in line.sides)
    return replace(line, kind="equation", expr=expr, sides=cast("Any", sides))
