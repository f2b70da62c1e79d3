"""Converts the inputs of a run in a model file from old coordinates to new ones."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from lagrangian.coordinates.change import Change
from lagrangian.errors import ModelError
from lagrangian.model import Model
from lagrangian.page.plain import plain
from lagrangian.read import Scope, parse_expression


def carried_signals(model: Model, change: Change, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the inputs by name; a feedback such as ``-k*x2`` is converted to the new coordinates, others stay the
    same."""
    return {name: _carried(model, change, name, value) for name, value in given.items()}


def _carried(model: Model, change: Change, name: str, value: Any) -> Any:
    if not isinstance(value, str):
        return value
    try:
        expr = parse_expression(value, Scope(model.symbols), what=f"input '{name}'")
    except ModelError:  # a number with a unit; anything else is refused when the system runs
        return value
    written = change.put_in(expr)
    return value if written == expr else plain(written)
