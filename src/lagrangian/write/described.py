"""The description of a model as a section of a page: its symbols with their meaning, and its definitions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import TypeAlias

from lagrangian.model import Model
from lagrangian.model.elements.gravity import Gravity
from lagrangian.write.blocks import Items
from lagrangian.write.document import Block, Display, Inline, Section, TableBlock
from lagrangian.write.expression_tree import Math
from lagrangian.write.numerals import measured, unit
from lagrangian.write.quantities import Quantities


def system_section(model: Model) -> Section:
    """Return the section for a system that has not been derived."""
    return described(Items(model, "lecture", brief=False, full=False, details=False), model)


def described(items: Items, model: Model) -> Section:
    """The symbols of a model with their meaning and values, and its definitions; on the checklist, those symbols alone
    that nobody chose: the coordinates of floating frames."""
    blocks: list[Block] = []
    floating = {c.name for f in model.floating if f.floating is not None for c in f.floating.coordinates}
    symbols = [x for x in _symbols(model, items.write) if not items.brief or x[0] in floating]
    if symbols:
        listed = _together(symbols)
        rows = [tuple(cell if isinstance(cell, tuple) else (cell,) if cell else () for cell in row) for row in listed]
        header: tuple[Inline, ...] = (("symbol",), ("what it is",), ("value",))
        kept = 3 if any(row[2] for row in rows) else 2
        blocks.append(TableBlock(header[:kept], tuple(row[:kept] for row in rows)))
    for i, d in enumerate(model.definitions, 1):
        sides = (items.write.expressions(d.symbol), items.write.expressions(d.expression))
        note: Inline = ("definition",) if i == 1 else ()
        blocks.append(Display(sides, f"def-{i}", note=note))
    return Section("system", ("The system",), tuple(blocks))


LEAST = 5
"""Symbols from which those that differ by a number alone share a row."""

_Row: TypeAlias = "tuple[str, Math | str, str, str]"
"""The name of a symbol, the symbol, what it is, and its value."""


def _together(rows: Iterable[_Row]) -> Iterator[tuple[Inline | Math | str, str, str]]:
    """The rows, where many symbols that differ by a number alone, m1 to m20, share the first one's row."""
    listed = list(rows)
    groups: dict[tuple[str, str, str], list[_Row]] = {}
    for row in listed:
        stem = re.sub(r"\d+", "#", row[0], count=1)
        groups.setdefault((stem, *row[2:]), []).append(row)
    shared = {row[0]: group for group in groups.values() if len(group) >= LEAST for row in group}
    for name, symbol, words, value in listed:
        group = shared.get(name)
        if group is None:
            yield symbol, words, value
        elif group[0][0] == name:
            yield (symbol, ", …, ", group[-1][1], f" ({len(group)})"), words, value


def _symbols(model: Model, write: Quantities) -> Iterator[_Row]:
    """The symbols: coordinates, parameters with their values, inputs."""
    floating = {c.name for f in model.floating if f.floating is not None for c in f.floating.coordinates}
    for c in model.coordinates:
        words = f"{c.name}: {c.description}" if c.name in floating else c.description or "coordinate"
        yield c.name, write.expressions(c.symbol), words, f"[{unit(c.unit)}]" if c.unit else ""
    strengths = [e.g for e in model.elements if isinstance(e, Gravity)]
    for p in model.parameters:
        value = "" if p.value is None else measured(p.value, p.unit)
        words = p.description or ("gravitational acceleration" if p.symbol in strengths else "parameter")
        yield p.name, write.expressions(p.symbol), words, value
    for i in model.inputs:
        yield i.name, write.expressions(i.symbol), i.description or "input", f"[{unit(i.unit)}]" if i.unit else ""
