"""The result of a comparison, and its text, which follows the lecture's comparison of its examples 3A and 3B."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.compare.motions import comparison_method
from lagrangian.compare.pictures import PicturePair, pictures
from lagrangian.compare.rows import ComparedSystem, Difference, EquationRow, ParameterDifference, Rewritten
from lagrangian.compare.words import commas, recipe, row_data, summed, symbols, within
from lagrangian.coordinates import Change
from lagrangian.derive.context import fit, fit_terms
from lagrangian.model import Model
from lagrangian.model.names import moving_symbol
from lagrangian.page.formula import Check, Formula, Heading, Item, Left, Matrix, Name, Table, Text, formula, text
from lagrangian.page.plain import plain
from lagrangian.page.report import Part, Report
from lagrangian.records import dataclass
from lagrangian.viewed import cut
from lagrangian.write.written import Written

MAX_JACOBIAN_SIZE = 8
"""J is written out for at most this many coordinates."""
MAX_TABLE_OPERATIONS = 30
"""Quantities with at most this many operations in total are shown side by side in a table."""


@dataclass(frozen=True, eq=False)
class Comparison(Written):
    """The result of comparing two systems.

    ``change`` expresses the coordinates ξ of ``source`` in the coordinates η of ``into``, and ``J`` = ∂ξ/∂η: each row
    of ``into`` is Σ J_ij · (row i of ``source``, rewritten). ``rows`` contains this for every equation of ``into``,
    ``back`` for the opposite direction. ``same`` is true if the equations describe the same motion and no parameter has
    different values. If the coordinates cannot be matched, ``change`` is None and ``why`` gives the reason. ``motions``
    are the checks of systems with constraints, which have no rows; ``source`` may then have more coordinates.
    """

    a: ComparedSystem
    b: ComparedSystem
    source: ComparedSystem
    into: ComparedSystem
    same: bool
    equations_same: bool
    change: Change | None = None
    J: sp.ImmutableMatrix | None = None
    assumed: bool = False
    rewritten: tuple[Rewritten, ...] = ()
    rows: tuple[EquationRow, ...] = ()
    back: tuple[EquationRow, ...] = ()
    energies: tuple[Check, ...] = ()
    forces: tuple[Check, ...] = ()
    differences: tuple[Difference, ...] = ()
    parameters: tuple[ParameterDifference, ...] = ()
    why: Text | None = None
    motions: tuple[Check, ...] = ()

    def look(self) -> PicturePair:
        """Return the schematics of both systems side by side, in the same pose where the coordinates correspond."""
        return pictures(self.source, self.into, self.change)

    def report(self) -> Report[Model]:
        """Return the report."""
        return comparison_report(self)

    def __repr__(self) -> str:
        """Name the two systems and the verdict; ``print`` shows the whole result."""
        a, b = self.a.derivation.model.name, self.b.derivation.model.name
        return cut(f"<Comparison of {a!r} and {b!r}: {'the same' if self.same else 'they differ'}>")

    def __bool__(self) -> bool:
        """Whether the systems are the same, so that you can write ``assert lg.compare(a, b)``."""
        return self.same


def comparison_report(found: Comparison) -> Report[Model]:
    """Return the report of a comparison."""
    shown = _Shown(found)
    parts = [Part(text("What was found"), (shown.verdict(), *shown.remarks()))]
    parts.append(Part(text("Side by side"), tuple(shown.side_by_side())))
    if found.motions:
        parts.append(Part(text("One set of coordinates in the other"), tuple(shown.change())))
        bound = any(side.derivation.model.constraints for side in (found.source, found.into))
        words = comparison_method(found.source.tag, found.into.tag, bound=bound)
        parts.append(Part(text("Motions"), (words,), tuple(shown.check(c) for c in found.motions)))
    elif found.change is not None:
        parts.append(Part(text("One set of coordinates in the other"), tuple(shown.change())))
        parts.append(Part(text("Let's compare"), tuple(shown.compared()), shown.checks(found.rows)))
        if found.back:
            parts.append(Part(text("The other way round"), tuple(shown.back()), shown.checks(found.back)))
        checks = tuple(shown.check(c) for c in (*found.energies, *found.forces))
        parts.append(Part(text("Energies and forces"), tuple(shown.forces()), checks))
    if found.differences or found.parameters:
        parts.append(Part(text("Where they differ"), tuple(shown.differences())))
    model = found.into.derivation.model
    title = f"{found.a.derivation.model.name} (A) and {found.b.derivation.model.name} (B), compared"
    return Report(title, model, tuple(parts), comparison_data(found))


class _Shown:
    """The parts of the report; a symbol with different meanings in (A) and (B) gets the letter of its system."""

    def __init__(self, found: Comparison) -> None:
        self.found = found
        self.names: dict[str, dict[sp.Basic, sp.Expr]] = {"A": {}, "B": {}}
        if found.change is None:
            return
        taken = {str(n) for s in (found.a, found.b) for n in s.derivation.model.symbols}
        new = {c.name for c in found.change.new}
        for c, _ in found.change.replaced:
            if c.name in new:
                for side in (found.source, found.into):
                    name = c.name + side.letter
                    while name in taken:
                        name += "_"
                    self.names[side.tag][c.symbol] = moving_symbol(name)

    # -- letters ------------------------------------------------------------------------------------------------

    def expr(self, side: ComparedSystem, expr: sp.Expr) -> sp.Expr:
        """An expression of one system, with its symbols made distinct."""
        return cast("sp.Expr", expr.xreplace(self.names[side.tag])) if self.names[side.tag] else expr

    def left(self, side: ComparedSystem, item: Any) -> Any:
        """Any side of a formula."""
        if isinstance(item, sp.Expr):
            return self.expr(side, item)
        if isinstance(item, Matrix):
            return Matrix(tuple(tuple(self.left(side, x) for x in row) for row in item.rows))
        parts = getattr(item, "terms", None)
        return fit_terms(tuple(self.left(side, t) for t in parts)) if parts is not None else item

    def text(self, words: Text) -> Text:
        """Words about the coordinates in which both are written."""
        names = self.names[self.found.into.tag]
        return Text(tuple(p if isinstance(p, str) else within(p, names) for p in words.parts))

    def check(self, check: Check) -> Check:
        """A check with the symbols of the report."""
        return replace(check, what=self.text(check.what))

    def checks(self, rows: Sequence[EquationRow]) -> tuple[Check, ...]:
        """The checks of rows."""
        return tuple(self.check(r.check) for r in rows)

    # -- parts --------------------------------------------------------------------------------------------------

    def verdict(self) -> Text:
        """The first sentence."""
        found = self.found
        if found.why is not None:
            return found.why
        if found.same:
            return text(
                "(A) and (B) describe the same motion: every equation of one is a sum of equations of the other."
            )
        if found.equations_same:
            return text("(A) and (B) have the same equations, but not the same values of their parameters.")
        wrong = [r.label for r in found.rows if not r.holds]
        return text(
            f"(A) and (B) do not describe the same motion: {', '.join(wrong)} cannot be obtained from the other set."
        )

    def remarks(self) -> list[Item]:
        """Remarks that are needed to understand the rest."""
        found, items = self.found, []
        if found.assumed and found.change is not None:
            named = not found.change.replaced
            what = (
                "coordinates of the same name were taken to be the same" if named else "most places agree in this way"
            )
            items.append(text(f"The two do not put everything in the same places; {what}."))
        if found.equations_same and found.differences:
            items.append(text("They count the same forces in different places; see at the end."))
        if first := next(iter(found.differences), None):
            items += [] if found.equations_same else [text("The first difference. ", *self.difference(first))]
        return items

    def side_by_side(self) -> list[Item]:
        """Coordinates, T*, V and Ξ of both systems."""
        sides = (self.found.a, self.found.b)
        forces = [list(s.derivation.Xi.values()) for s in sides]
        rows: list[tuple[Name, list[sp.Expr | None]]] = [
            (Name("T*"), [self.expr(s, s.derivation.T) for s in sides]),
            (Name("V"), [self.expr(s, s.derivation.V) for s in sides]),
        ]
        for i in range(max(map(len, forces))):
            cells = [self.expr(s, x[i]) if i < len(x) else None for s, x in zip(sides, forces, strict=True)]
            rows.append((Name("Xi", str(i + 1)), cells))
        if max(bounded.operations(x) for _, cells in rows for x in cells if x is not None) <= MAX_TABLE_OPERATIONS:
            table = [(text("coordinates"), *(text(*self.listed(s)) for s in sides))]
            table += [(text(n), *(text("none") if x is None else text(x) for x in cells)) for n, cells in rows]
            return [Table((text(""), text("(A)"), text("(B)")), tuple(table))]
        items: list[Item] = []
        for k, side in enumerate(sides):
            items.append(Heading(text(f"({side.tag}) {side.derivation.model.name}")))
            items.append(text("Coordinates ", *self.listed(side), "."))
            items += [formula(name, fit(x)) for name, cells in rows if (x := cells[k]) is not None]
        return items

    def listed(self, side: ComparedSystem) -> list[Left | str]:
        """The coordinates of one system."""
        return commas([self.expr(side, q) for q in side.derivation.coordinates])

    def change(self) -> list[Item]:
        """ξ = φ(η) and J."""
        found = self.found
        source, into, change = found.source, found.into, found.change
        assert change is not None and found.J is not None
        items: list[Item] = []
        if not change.replaced:
            items.append(text("Both use the same coordinates."))
            return items
        items.append(text(f"The coordinates of ({source.tag}), in those of ({into.tag}):"))
        for c in change.old:
            items.append(
                formula(self.expr(source, c.symbol), self.expr(into, change.table[c.symbol]))
                if c.symbol != change.table[c.symbol]
                else text(self.expr(into, c.symbol), " is the same in both.")
            )
        if len(change.old) <= MAX_JACOBIAN_SIZE:
            rows = tuple(tuple(self.expr(into, x) for x in found.J.row(i)) for i in range(found.J.rows))
            items.append(text(f"One row for each coordinate of ({source.tag}), one column for each of ({into.tag}):"))
            items.append(formula(Name("J"), Matrix(rows)))
        return items

    def equations(self, side: ComparedSystem) -> list[Item]:
        """The equations of motion of one system, labelled 1a, 2a."""
        items: list[Item] = [Heading(text(f"({side.tag}) {side.derivation.model.name}"))]
        boxed = [f for f in side.derivation.result if isinstance(f, Formula) and f.boxed]
        for i, f in enumerate(boxed):
            items.append(formula(*(self.left(side, x) for x in f.sides), note=text(side.label(i))))
        return items

    def compared(self) -> list[Item]:
        """Each equation of one set in the coordinates of the other, and their sums."""
        found = self.found
        items = [*self.equations(found.source), *self.equations(found.into)]
        same = not (found.change and found.change.replaced)
        if not same:
            terms = self.listed(found.into)
            items.append(Heading(text(f"({found.source.tag}) in the coordinates of ({found.into.tag})")))
            for r in found.rewritten:
                items.append(text(f"Write {r.source} in terms of ", *terms, ":"))
                sides = (fit_terms(tuple(self.expr(found.into, t) for t in part)) for part in (r.left, r.right))
                items.append(formula(*sides, note=text(r.label)))
        else:
            labels = ", ".join(f"{r.label} is {r.source}" for r in found.rewritten)
            items.append(text(f"Nothing has to be rewritten: {labels}."))
        items.append(Heading(text("Row by row")))
        return [*items, *self.row_by_row(found.rows, found.into)]

    def row_by_row(self, rows: Sequence[EquationRow], side: ComparedSystem) -> list[Item]:
        """First the rows that match directly, then those that have to be added, written out."""
        boxed = [f for f in side.derivation.result if isinstance(f, Formula) and f.boxed]
        alone: list[Item] = []
        added: list[Item] = []
        for row, equation in zip(rows, boxed, strict=True):
            factors = [f for f in row.factors if f != 0]
            if len(factors) == 1 or not row.holds:
                alone.append(self.text(row.words))
                if not row.holds:
                    alone.append(self.text(text(f"The remainder of {row.label}: ", fit(row.rest), ".")))
                continue
            added.append(self.recipe(row, first=not added))
            sides = tuple(self.left(side, x) for x in equation.sides)
            added.append(formula(*sides, note=text(f"matches {row.label}")))
        return [*alone, *added]

    def recipe(self, row: EquationRow, *, first: bool) -> Text:
        """The instruction: "Now add B-1 and B-2:"."""
        words = recipe(row.factors, row.of)
        start = str(words[0])
        start = f"Now, {start[0].lower()}{start[1:]}" if first else start
        return self.text(text(start, *words[1:], ":"))

    def back(self) -> list[Item]:
        """The direction of the second list of rows."""
        source, into = self.found.source, self.found.into
        return [text(f"And the equations of ({source.tag}) from those of ({into.tag}):")]

    def forces(self) -> list[Item]:
        """Ξ_η = Jᵀ Ξ_ξ in words."""
        source, into = self.found.source, self.found.into
        return [
            text(
                f"With the coordinates of ({into.tag}) substituted in ({source.tag}), ",
                Name("T*"),
                " and ",
                Name("V"),
                " are compared as they stand. A virtual displacement does the same work in either set, so the "
                f"generalized forces of ({into.tag}) are those of ({source.tag}) times ",
                Name("J"),
                " transposed.",
            )
        ]

    def differences(self) -> list[Item]:
        """All differences, in the order of the steps; then the parameters."""
        found = self.found
        items: list[Item] = [text(*self.difference(d)) for d in found.differences]
        valued = [p for p in found.parameters if not p.missing]
        if valued:
            header = (text("parameter"), text("in (A)"), text("in (B)"))
            rows = tuple((text(sp.Symbol(p.name)), text(f"{p.a:g}"), text(f"{p.b:g}")) for p in valued)
            items.append(Table(header, rows))
        for tag, other in (("A", "B"), ("B", "A")):
            missing = [p.name for p in found.parameters if p.missing == tag]
            if missing:
                items.append(text(f"Parameters of ({other}) that ({tag}) does not have: ", *symbols(missing), "."))
        return items

    def difference(self, d: Difference) -> list[str | Left]:
        """One difference in words."""
        into = self.found.into
        name: list[str | Left] = [f"Step {d.step}, ", Name(d.quantity)]
        if d.coordinate is not None:
            names = [plain(q) for q in into.derivation.coordinates]
            index = names.index(d.coordinate)
            symbol = self.expr(into, into.derivation.coordinates[index])
            name = [f"Step {d.step}, ", Name("Xi", str(index + 1)), " of ", symbol]
        if self.found.change is None:
            only, title = ("A", d.element_a) if d.element_a else ("B", d.element_b)
            return [*name, f": only ({only}) has {title}."]
        pieces: list[str | Left] = [*name, ": "]
        for k, (tag, title, value) in enumerate((("A", d.element_a, d.a), ("B", d.element_b, d.b))):
            pieces.append(", " if k else "")
            if title is None:
                pieces.append(f"({tag}) has no such element")
            elif value == 0:
                pieces.append(f"{title} of ({tag}) contributes nothing")
            else:
                pieces += [f"({tag}) has ", fit(self.expr(into, value)), f" from {title}"]
        if d.element_a and d.element_b and d.a != 0 != d.b:
            pieces += ["; (A) minus (B) begins with ", fit(self.expr(into, d.term))]
        return [*pieces, "."]


def comparison_data(found: Comparison) -> dict[str, Any]:
    """Return a comparison as plain data; expressions are text in the grammar of model files."""
    change = found.change
    return {
        "same": found.same,
        "equations_same": found.equations_same,
        "systems": {
            s.tag: {
                "name": s.derivation.model.name,
                "coordinates": [c.name for c in s.derivation.model.coordinates],
                "rows": [s.label(i) for i in range(len(s.derivation.coordinates))],
            }
            for s in (found.a, found.b)
        },
        "why": None if found.why is None else str(found.why),
        "change": None
        if change is None
        else {
            "of": found.source.tag,
            "in": found.into.tag,
            "coordinates": {c.name: plain(change.table[c.symbol]) for c in change.old},
            "assumed": found.assumed,
        },
        "J": None if found.J is None else [[plain(x) for x in found.J.row(i)] for i in range(found.J.rows)],
        "rewritten": [
            {"label": r.label, "of": r.source, "equation": f"{summed(r.left)} = {summed(r.right)}"}
            for r in found.rewritten
        ],
        "rows": [row_data(r) for r in found.rows],
        "back": [row_data(r) for r in found.back],
        "checks": [
            {"what": str(c.what), "holds": c.holds, "figure": c.figure}
            for c in (*found.energies, *found.forces, *found.motions)
        ],
        "differences": [
            {
                "step": d.step,
                "quantity": d.quantity,
                "coordinate": d.coordinate,
                "A": {"element": d.element_a, "contribution": plain(d.a)},
                "B": {"element": d.element_b, "contribution": plain(d.b)},
                "term": plain(d.term),
            }
            for d in found.differences
        ],
        "parameters": [{"name": p.name, "A": p.a, "B": p.b, "missing": p.missing or None} for p in found.parameters],
    }
