"""From a Derivation to a Document: what is shown, in which order, in which notation."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.derive import Derivation, Step
from lagrangian.derive import formula as data
from lagrangian.dynamics import notices
from lagrangian.model import Model
from lagrangian.write.document import Block, Display, Document, Inline, Paragraph, Section, Table
from lagrangian.write.items import Items
from lagrangian.write.math import Math
from lagrangian.write.numerals import measured, unit
from lagrangian.write.quantities import Notation, Quantities


def lay_out(
    derivation: Derivation,
    *,
    notation: Notation = "lecture",
    brief: bool = False,
    full: bool = False,
    details: bool = False,
) -> Document:
    """Lay out a derivation.

    ``brief`` keeps each step's title and what the derivation marked for the one-page checklist; ``full`` writes out
    what would be summarised for its length; ``details`` puts that under collapsible summaries instead. Raises
    `ModelError` for an unknown notation.
    """
    return _Layout(derivation, notation, brief, full, details).document()


class _Layout(Items):
    def __init__(self, derivation: Derivation, notation: Notation, brief: bool, full: bool, details: bool) -> None:
        super().__init__(derivation.model, notation, brief=brief, full=full, details=details)
        self.derivation = derivation

    def document(self) -> Document:
        d = self.derivation
        sections = [Section("notices", ("Notices",), tuple(noticed(d.model)))]
        if not self.brief or d.model.definitions:
            sections.append(self.system())
        for step in d.steps:
            title = self.inline(data.text(step.title))
            sections.append(Section(f"step-{step.number}", title, tuple(self.step(step)), step.number))
        sections.append(Section("result", ("Result",), tuple(self.result())))
        if d.verified:
            sections.append(Section("verified", ("Verified",), (self.checks(d.verified),)))
        if notes := self.notes():
            sections.append(Section("notes", ("Notes",), notes))
        return Document(d.model.name, tuple(s for s in sections if s.blocks or s.number is not None), self.brief)

    # -- sections ---------------------------------------------------------------------------------------------------

    def system(self) -> Section:
        """What was described: the symbols with their meaning, and the definitions."""
        return described(self, self.derivation.model)

    def step(self, step: Step) -> Iterator[Block]:
        if not self.brief:
            yield Paragraph(self.inline(step.what), "what")
            yield Paragraph(self.inline(step.why), "why")
        yield from self.items(step.items, f"step-{step.number}")
        if step.checked and not self.brief:
            yield self.checks(step.checked)

    def result(self) -> Iterator[Block]:
        yield from self.items(self.derivation.result, "eq", terms=self.derivation.terms)

    def notes(self) -> tuple[Block, ...]:
        blocks: list[Block] = [] if self.brief else [Paragraph(self.inline(n), "note") for n in self.derivation.notes]
        if self.elided:
            words = "⟨n operations⟩ stands for an expression that is too long to read. "
            how = "It opens where it stands." if self.details else "The option “full” writes it out."
            blocks.append(Paragraph((words + how,), "note"))
        return tuple(blocks)


def system_section(model: Model, notation: Notation = "lecture") -> Section:
    """What was described, for a system that has no derivation yet."""
    return described(Items(model, notation, brief=False, full=False, details=False), model)


def described(items: Items, model: Model) -> Section:
    """The symbols of a model with their meaning and values, and its definitions."""
    blocks: list[Block] = []
    if not items.brief:
        rows = [tuple((cell,) if cell else () for cell in row) for row in _symbols(model, items.write)]
        header: tuple[Inline, ...] = (("symbol",), ("what it is",), ("value",))
        kept = 3 if any(row[2] for row in rows) else 2
        blocks.append(Table(header[:kept], tuple(row[:kept] for row in rows)))
    for i, d in enumerate(model.definitions, 1):
        sides = (items.write.expressions(d.symbol), items.write.expressions(d.expression))
        note: Inline = ("definition",) if i == 1 else ()
        blocks.append(Display(sides, f"def-{i}", note=note))
    return Section("system", ("The system",), tuple(blocks))


def noticed(model: Model) -> Iterator[Paragraph]:
    """What is to be known of the system, a paragraph each."""
    for notice in notices(model):
        yield Paragraph((f"{notice.where}: {notice.text}. [{notice.code}]",), "note")


def _symbols(model: Model, write: Quantities) -> Iterator[tuple[Math | str, str, str]]:
    """The symbols of the system: coordinates, parameters with their values, inputs."""
    for c in model.coordinates:
        yield write.expressions(c.symbol), c.description or "coordinate", f"[{unit(c.unit)}]" if c.unit else ""
    for p in model.parameters:
        value = "" if p.value is None else measured(p.value, p.unit)
        yield write.expressions(p.symbol), p.description or "parameter", value
    for i in model.inputs:
        yield write.expressions(i.symbol), i.description or "input", f"[{unit(i.unit)}]" if i.unit else ""
