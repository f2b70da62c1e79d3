"""The layout of a derivation: what is shown, in what order and notation, in every format.

`lay_out` makes a Document, and `write` renders it. All functions here take a `Derivation`.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping

from lagrangian.derive.data import named_symbols, to_dict
from lagrangian.derive.derived import Derived, Step
from lagrangian.model import Model
from lagrangian.page import formula as data
from lagrangian.page.report import Report
from lagrangian.write import html_page, latex, markdown, text
from lagrangian.write.blocks import Items
from lagrangian.write.described import described
from lagrangian.write.document import Block, Document, Paragraph, Section
from lagrangian.write.quantities import Notation


def lay_out(
    derivation: Derived,
    *,
    notation: Notation = "lecture",
    brief: bool = False,
    full: bool = False,
    details: bool = False,
    drawn: bool = False,
    described: bool = False,
    linked: bool = False,
) -> Document:
    """Lay out a derivation.

    ``brief`` keeps only the titles of steps and what is marked for the one-page checklist. ``full`` writes out what
    would be summarized because of its length; ``details`` puts it under collapsible summaries instead. ``drawn`` puts
    the picture at the head, and ``described`` says in words what is seen in it. ``linked`` adds the page on why the
    equations hold, to which every step has a link. Raises `ModelError` for an unknown notation.
    """
    layout = _Layout(derivation, notation, brief, full, details)
    layout.reasoning = derivation.reasoning if linked and not brief else None
    return layout.document(drawn=drawn, described=described)


SEE: Mapping[int, tuple[int, str]] = {
    0: (3, "the constraint forces do no work"),
    1: (2, "equations (2) and (3)"),
    2: (4, "equations (7) to (9)"),
    3: (5, "equations (10) and (11)"),
    4: (5, "equations (10) to (12)"),
    5: (4, "equations (4) to (8)"),
    6: (5, "equation (12)"),
}
"""For every step, the part of the page on why the equations hold that it rests on, and that part in words."""


class _Layout(Items):
    def __init__(self, derivation: Derived, notation: Notation, brief: bool, full: bool, details: bool) -> None:
        named = named_symbols(derivation)
        super().__init__(derivation.model, notation, brief=brief, full=full, details=details, named=named)
        self.derivation = derivation
        self.reasoning: Report[Model] | None = None
        self.from_masses = not derivation.model.floating and all(
            e.ledger != "T*" or e in derivation.model.bodies for e in derivation.model.elements
        )

    def document(self, *, drawn: bool, described: bool) -> Document:
        d = self.derivation
        picture = d.picture if drawn or described else None
        notices = list(self.noticed())
        if picture is not None and picture.trouble:
            notices.append(Paragraph((f"picture: {picture.trouble}",), "note"))
        sections = [Section("notices", ("Notices",), tuple(notices))]
        if described and picture is not None and picture.description:
            sections.insert(0, Section("seen", ("What it looks like",), (Paragraph((picture.description,)),)))
        if not self.brief or d.model.definitions or d.model.floating:
            sections.append(self.system())
        for step in d.steps:
            title = self.inline(data.text(step.title))
            sections.append(Section(f"step-{step.number}", title, tuple(self.step(step)), step.number))
            if d.constraint_step and step.number == d.constraint_step.number:
                named = self.inline(data.text(d.constraint_step.title))
                sections.append(Section("constraints", named, tuple(self.step(d.constraint_step, "constraints"))))
        sections.append(Section("result", ("Result",), tuple(self.result())))
        if d.verified:
            sections.append(Section("verified", ("Verified",), (self.checks(d.verified),)))
        sections += self.reasons()
        if notes := self.notes():
            sections.append(Section("notes", ("Notes",), notes))
        kept = tuple(s for s in sections if s.blocks or s.number is not None)
        return Document(d.model.name, kept, self.brief, picture if drawn else None, d.form == "structured")

    # -- sections ---------------------------------------------------------------------------------------------------

    def system(self) -> Section:
        """The description: the symbols with their meaning, and the definitions."""
        return described(self, self.derivation.model)

    def noticed(self) -> Iterator[Paragraph]:
        """The notices of the system, a paragraph each."""
        for notice in self.derivation.notices:
            yield Paragraph((f"{notice.where}: {notice.text}. [{notice.code}]",), "note")

    def step(self, step: Step, anchor: str = "") -> Iterator[Block]:
        if not self.brief:
            yield Paragraph(self.inline(step.what), "what")
            yield Paragraph(self.inline(step.why), "why")
            if not anchor and self.from_masses:
                yield self.see(step.number)
        yield from self.items(step.items, anchor or f"step-{step.number}")
        if step.checked and not self.brief:
            yield self.checks(step.checked)

    def see(self, number: int) -> Paragraph:
        """The line of a step that leads to the page on why the equations hold."""
        part, words = SEE[number]
        if self.reasoning is None:
            return Paragraph((f"--why shows the reason: {words}",), "see")
        return Paragraph((f"why: {words}, for this system",), "see", f"why-{part}")

    def reasons(self) -> Iterator[Section]:
        """The page on why the equations hold, part by part."""
        if self.reasoning is None:
            return
        words = "The lecture's equations (1) to (12), carried out on this system: where the constraint forces go."
        yield Section("why", ("Why Lagrange's equations hold",), (Paragraph((words,), "what"),))
        for k, part in enumerate(self.reasoning.parts, 1):
            blocks = list(self.items(part.items, f"why-{k}"))
            blocks += [self.checks(part.checks)] if part.checks else []
            yield Section(f"why-{k}", self.inline(part.title), tuple(blocks), minor=True)

    def result(self) -> Iterator[Block]:
        d = self.derivation
        yield from self.items(d.result, "eq", terms=d.terms if d.minimal is None else (*d.terms, *d.minimal.terms))

    def notes(self) -> tuple[Block, ...]:
        blocks: list[Block] = [] if self.brief else [Paragraph(self.inline(n), "note") for n in self.derivation.notes]
        if self.elided:
            words = "⟨n operations⟩ stands for an expression that is too long to read. "
            how = "It opens where it stands." if self.details else "The option “full” writes it out."
            blocks.append(Paragraph((words + how,), "note"))
        return tuple(blocks)


# -- every format ----------------------------------------------------------------------------------------------------


def to_text(
    derivation: Derived,
    *,
    notation: Notation = "lecture",
    brief: bool = False,
    full: bool = False,
    width: int = 80,
) -> str:
    """Return the derivation as Unicode text of at most ``width`` columns, unless a single symbol is longer.

    Raises `ModelError` for an unknown notation and for a width below 40.
    """
    return text.page(lay_out(derivation, notation=notation, brief=brief, full=full), width)


def to_markdown(
    derivation: Derived,
    *,
    notation: Notation = "lecture",
    brief: bool = False,
    full: bool = False,
    described: bool = False,
) -> str:
    """Return the derivation as Markdown. Raises `ModelError` for an unknown notation."""
    return markdown.page(lay_out(derivation, notation=notation, brief=brief, full=full, described=described))


def to_latex(derivation: Derived, *, notation: Notation = "lecture", brief: bool = False, full: bool = False) -> str:
    """Return the derivation as a complete LaTeX article. Raises `ModelError` for an unknown notation."""
    return latex.page(lay_out(derivation, notation=notation, brief=brief, full=full, drawn=True))


def to_html(derivation: Derived, *, notation: Notation = "lecture", brief: bool = False, full: bool = False) -> str:
    """Return the derivation as a self-contained HTML page. Raises `ModelError` for an unknown notation."""
    page = lay_out(derivation, notation=notation, brief=brief, full=full, details=True, drawn=True, linked=True)
    return html_page.page(page, "equations of motion")


def to_html_fragment(derivation: Derived) -> str:
    """Return the checklist of a derivation as a piece of HTML for a notebook."""
    return html_page.fragment(lay_out(derivation, brief=True, details=True, drawn=True))


def section_to_html(derivation: Derived, anchor: str) -> str:
    """Return one section of a derivation's page, such as ``step-6``, as a piece of HTML for a notebook."""
    page = lay_out(derivation, details=True)
    return html_page.fragment(Document(page.title, tuple(s for s in page.sections if s.anchor == anchor)))


def steps_to_html(derivation: Derived) -> str:
    """Return the steps of a derivation, without its description and its result, as a piece of HTML for a notebook."""
    page = lay_out(derivation, details=True)
    return html_page.fragment(Document(page.title, tuple(s for s in page.sections if s.anchor.startswith("step-"))))


def to_json(derivation: Derived, *, notation: Notation = "lecture", brief: bool = False, full: bool = False) -> str:
    """Return `to_dict` as JSON text."""
    return (
        json.dumps(to_dict(derivation, notation=notation, brief=brief, full=full), ensure_ascii=False, indent=1) + "\n"
    )


FORMATS: Mapping[str, Callable[..., str]] = {
    "text": to_text,
    "markdown": to_markdown,
    "latex": to_latex,
    "html": to_html,
    "json": to_json,
}
"""The writer for each format: ``FORMATS[name](derivation, notation=…, brief=…, full=…) -> str``."""
