"""Report: what an analysis says, as data that `write` can lay out: words, formulas, tables, checks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from lagrangian.derive import Check
from lagrangian.derive.formula import Item, Text
from lagrangian.viewed import Brief

if TYPE_CHECKING:
    from lagrangian.model import Model


@dataclass(frozen=True)
class Part(Brief):
    """A section of a report: items in reading order, then what was checked."""

    title: Text
    items: tuple[Item, ...] = ()
    checks: tuple[Check, ...] = ()


@dataclass(frozen=True)
class Report(Brief):
    """A title, parts, and the model whose letters and names the parts use.

    ``data`` is what JSON gives: dictionaries, lists, text, numbers, true, false and null alone.
    """

    title: str
    model: Model
    parts: tuple[Part, ...]
    data: Mapping[str, Any] = field(default_factory=dict, repr=False)
