"""The description of a model as a section of a page: its symbols with their meaning, and its definitions."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.model import Model
from lagrangian.write.blocks import Items
from lagrangian.write.document import Block, Display, Inline, Section, TableBlock
from lagrangian.write.expression_tree import Math
from lagrangian.write.numerals import measured, unit
from lagrangian.write.quantities import Quantities


def system_section(model: Model) -> Section:
    """Return the section for a system that has not been derived."""
    return described(Items(model, "lecture", brief=False, full=False, details=False), model)


def described(items: Items, model: Model) -> Section:
    """The symbols of a model with their meaning and values, and its definitions."""
    blocks: list[Block] = []
    if not items.brief:
        rows = [tuple((cell,) if cell else () for cell in row) for row in _symbols(model, items.write)]
        header: tuple[Inline, ...] = (("symbol",), ("what it is",), ("value",))
        kept = 3 if any(row[2] for row in rows) else 2
        blocks.append(TableBlock(header[:kept], tuple(row[:kept] for row in rows)))
    for i, d in enumerate(model.definitions, 1):
        sides = (items.write.expressions(d.symbol), items.write.expressions(d.expression))
        note: Inline = ("definition",) if i == 1 else ()
        blocks.append(Display(sides, f"def-{i}", note=note))
    return Section("system", ("The system",), tuple(blocks))


def _symbols(model: Model, write: Quantities) -> Iterator[tuple[Math | str, str, str]]:
    """The symbols: coordinates, parameters with their values, inputs."""
    floating = {c.name for f in model.floating if f.floating is not None for c in f.floating.coordinates}
    for c in model.coordinates:
        words = f"{c.name}: {c.description}" if c.name in floating else c.description or "coordinate"
        yield write.expressions(c.symbol), words, f"[{unit(c.unit)}]" if c.unit else ""
    for p in model.parameters:
        value = "" if p.value is None else measured(p.value, p.unit)
        yield write.expressions(p.symbol), p.description or "parameter", value
    for i in model.inputs:
        yield write.expressions(i.symbol), i.description or "input", f"[{unit(i.unit)}]" if i.unit else ""
