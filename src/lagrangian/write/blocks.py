"""Converts words, formulas and tables to the blocks of a Document, in one notation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import sympy as sp

from lagrangian.model import Model
from lagrangian.page import formula as data
from lagrangian.page.formula import Check, EquationTerm
from lagrangian.write.document import (
    Block,
    Boxed,
    CheckLine,
    CheckLines,
    Details,
    Display,
    HeadingBlock,
    Inline,
    Paragraph,
    TableBlock,
)
from lagrangian.write.expression import NamedSymbol
from lagrangian.write.expression_tree import Addition, Math, Number, Tagged
from lagrangian.write.numerals import figures
from lagrangian.write.quantities import Notation, Quantities
from lagrangian.write.unicode_math import unicode

DETAILS_OPERATIONS = 4000
"""An elided expression with more operations is left out of the collapsible details, too; ``full`` writes it."""

SET_OPERATIONS = 800
"""An elided expression with more operations is set as plain text in its details, not as mathematics."""


class Items:
    """Lays out the items of a step of a derivation, or of a part of a report, for one model.

    ``brief`` keeps only what is marked for the one-page checklist. ``full`` writes out what would be summarized because
    of its length; ``details`` puts it under collapsible summaries instead. Raises `ModelError` for an unknown notation.
    """

    def __init__(
        self,
        model: Model,
        notation: Notation,
        *,
        brief: bool,
        full: bool,
        details: bool,
        named: Sequence[NamedSymbol] = (),
    ) -> None:
        self.brief, self.details = brief, details
        self.write = Quantities(model, notation, full=full, named=named)
        self.whole = self.write if full else Quantities(model, notation, full=True, named=named)
        spoken = (*model.coordinates, *model.parameters, *model.inputs)
        self.given = frozenset(x.description for x in spoken if x.description)
        self.elided = False
        self.names = {e.title: e.name for e in model.elements}

    def items(
        self, items: Iterable[data.Item], anchor: str, *, terms: Sequence[Sequence[EquationTerm]] = ()
    ) -> Iterator[Block]:
        """The blocks for the given items; consecutive boxed formulas share a box."""
        box: list[Display] = []
        boxed: list[data.Formula] = []
        count, number = 0, 0
        for item in items:
            kept = not self.brief or getattr(item, "brief", False)
            if not kept:
                continue
            sides: tuple[Math, ...] = ()
            if isinstance(item, data.Formula):
                count += 1
                sides = self.write.formula(item)
                if item.boxed:
                    known = terms[number] if number < len(terms) else ()
                    number += 1
                    boxed.append(item)
                    box.append(Display(self.tagged(item, sides, known), f"{anchor}-{number}", number, self.note(item)))
                    continue
            if box:
                yield Boxed(tuple(box))
                yield from self.hidden_boxes(boxed)
                box, boxed = [], []
            match item:
                case data.Formula():
                    if len(sides) > 1 or len(item.sides) == 1:  # x₁ = x₁ would say nothing
                        yield Display(sides, f"{anchor}-f{count}", None, self.note(item))
                        yield from self.hidden(item)
                case data.Text():
                    yield Paragraph(self.inline(item))
                case data.Heading():
                    yield HeadingBlock(self.inline(item.text))
                case data.Table():
                    header = tuple(self.inline(h) for h in item.header)
                    yield TableBlock(header, tuple(tuple(self.inline(c) for c in row) for row in item.rows))
        if box:
            yield Boxed(tuple(box))
            yield from self.hidden_boxes(boxed)

    def note(self, item: data.Formula) -> Inline:
        """The note beside a formula."""
        return self.inline(item.note) if item.note is not None else ()

    def inline(self, item: data.Text | data.Formula) -> Inline:
        """Words and mathematics within a line."""
        return self.write.inline(item, given=self.given)

    def checks(self, checks: Sequence[Check]) -> CheckLines:
        """The checks; on the checklist, all checks that hold share one line."""
        if self.brief and all(c.holds for c in checks):
            return CheckLines((CheckLine((f"{len(checks)} checks hold",), True, ""),))
        return CheckLines(tuple(CheckLine(self.inline(c.what), c.holds, figures(c.figure)) for c in checks))

    # -- elided expressions, and the origin of terms
    # ---------------------------------------------------------------------

    def hidden_boxes(self, boxed: Iterable[data.Formula]) -> Iterator[Block]:
        """The full text of boxed formulas that are shown in a summarized form."""
        for item in boxed:
            yield from self.hidden(item)

    def hidden(self, item: data.Formula) -> Iterator[Block]:
        """The full text of a summarized formula, under a summary."""
        longest = max((n for side in item.sides for n in operations(side)), default=0)
        if not longest or self.write.full:
            return
        self.elided = True
        if self.details and longest <= DETAILS_OPERATIONS:
            sides = self.whole.formula(item)
            yield Details((f"written out: {longest} operations",), (Display(sides, ""),), longest > SET_OPERATIONS)

    def tagged(self, item: data.Formula, sides: tuple[Math, ...], known: Sequence[EquationTerm]) -> tuple[Math, ...]:
        """Mark each term of an equation of motion with the elements that contribute to it."""
        origin = {
            term.expr: (self.spoken(term.elements), term.kind, tuple(self.names.get(t, t) for t in term.elements))
            for term in known
        }
        if not origin or len(sides) != len(item.sides):
            return sides
        made: list[Math] = []
        for side, shown in zip(item.sides, sides, strict=True):
            exprs = _terms(side) if self.write.full or not isinstance(side, data.Elided) else ()
            pairs = shown.terms if isinstance(shown, Addition) else ((False, shown),)
            if len(pairs) != len(exprs) or shown == Number("0"):
                made.append(shown)
                continue
            tagged = tuple(
                (minus, Tagged(math, *origin[e]) if e in origin else math)
                for (minus, math), e in zip(pairs, exprs, strict=True)
            )
            made.append(Addition(tagged) if isinstance(shown, Addition) else tagged[0][1])
        return tuple(made)

    def spoken(self, titles: Iterable[str]) -> tuple[str, ...]:
        """Titles of elements as lines of text, with symbols as in the formulas."""
        return tuple("".join(x if isinstance(x, str) else unicode(x) for x in self.write.words(t)) for t in titles)


def element_titles(model: Model) -> dict[str, str]:
    """Return the title of every element by its name, as terms of the equations say where they come from."""
    items = Items(model, "lecture", brief=False, full=False, details=True)
    titles = items.spoken(e.title for e in model.elements)
    return dict(zip((e.name for e in model.elements), titles, strict=True))


def _terms(side: data.Left) -> tuple[sp.Expr, ...]:
    match side:
        case data.Terms(terms):
            return tuple(t for t in terms if isinstance(t, sp.Expr))
        case data.Elided(_, _, terms):
            return terms
        case sp.Expr():
            return (side,)
    return ()


def operations(side: data.Left) -> Iterator[int]:
    """The numbers of operations of the elided expressions in one side of a formula."""
    match side:
        case data.Elided():
            yield side.operations
        case data.Matrix(rows):
            for row in rows:
                for entry in row:
                    yield from operations(entry)
        case data.Terms(parts) | data.Product(parts) | data.Square(_, parts):
            for part in parts:
                yield from operations(part)
        case data.Minus(of) | data.Total(of) | data.Variation(of):
            yield from operations(of)
