"""What a model file says of the inputs of its runs, carried over: expressions of old coordinates in the new ones."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from lagrangian.coordinates.change import Change
from lagrangian.errors import ModelError
from lagrangian.model import Model
from lagrangian.page.plain import plain
from lagrangian.read import Scope, parse_expression


def carried_signals(model: Model, change: Change, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the inputs by name; a feedback such as ``-k*x2`` is written in the new coordinates, all else stays."""
    return {name: _carried(model, change, name, value) for name, value in given.items()}


def _carried(model: Model, change: Change, name: str, value: Any) -> Any:
    if not isinstance(value, str):
        return value
    try:
        expr = parse_expression(value, Scope(model.symbols), what=f"input '{name}'")
    except ModelError:  # a number with a unit, which no coordinate changes; what is neither, a run refuses
        return value
    written = change.put_in(expr)
    return value if written == expr else plain(written)
