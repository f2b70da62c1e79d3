"""A report: the result of an analysis as data that `write` can lay out: words, formulas, tables, checks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Generic, TypeVar

from lagrangian.page.formula import Check, Item, Text
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief

M = TypeVar("M")
"""The model, whose symbols are used."""


@dataclass(frozen=True)
class Part(Brief):
    """A section of a report: its items in reading order, then its checks."""

    title: Text
    items: tuple[Item, ...] = ()
    checks: tuple[Check, ...] = ()


@dataclass(frozen=True)
class Report(Brief, Generic[M]):
    """A title, parts, and the model whose symbols and names the parts use.

    ``data`` is the content of the JSON format: only dictionaries, lists, text, numbers, true, false and null.
    """

    title: str
    model: M
    parts: tuple[Part, ...]
    data: Mapping[str, Any] = field(default_factory=dict[str, Any], repr=False)
