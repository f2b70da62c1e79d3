"""Calls elements without a name by the letters of their value: torque P a, and not torque 1, which no student knows."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.model import Model
from lagrangian.page.formula import Item, Left, Text, Verbatim, text

MOST = 6
"""The most operations of a value by which an element is called."""
VALUES = ("value", "b", "k")
"""What holds the value of a force, a damper and a spring."""


def called_by_letters(items: Iterable[Item], model: Model) -> tuple[Item, ...]:
    """The items of a report, in whose sentences elements that were numbered have the letters of their values."""
    table = _letters(model)
    if not table:
        return tuple(items)
    titles = "|".join(map(re.escape, table))
    form = re.compile(rf"\b({titles})\b(?![\d'])", re.IGNORECASE)
    return tuple(_put(x, form, table) if isinstance(x, Text) else x for x in items)


def _put(item: Text, form: re.Pattern[str], table: dict[str, sp.Expr]) -> Text:
    def parts() -> Iterator[str | Verbatim | Left]:
        for part in item.parts:
            if not isinstance(part, str):
                yield part
                continue
            at = 0
            for match in form.finditer(part):
                yield f"{part[at : match.start()]}{match[1].rpartition(' ')[0]} "
                yield table[match[1].lower()]
                at = match.end()
            yield part[at:]

    return text(*(x for x in parts() if x != ""), brief=item.brief)


def _letters(model: Model) -> dict[str, sp.Expr]:
    """The values of the elements that have a number and no name, by their titles, where each has another one."""
    found = dict[str, sp.Expr]()
    for e in model.elements:
        if e.name != e.title or not e.name.rpartition(" ")[2].isdigit():
            continue
        values: list[Any] = [v for x in VALUES if isinstance(v := getattr(e, x, None), sp.Expr)]
        if len(values) == 1 and values[0].free_symbols and bounded.operations(values[0]) <= MOST:
            value = values[0]
            found[e.title] = -value if value.could_extract_minus_sign() else value
    every = list(found.values())
    return {title: value for title, value in found.items() if every.count(value) == 1}
