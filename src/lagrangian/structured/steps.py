"""Steps 2 to 6 of the lecture for a listing: the same steps, in quantities that are defined once."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby

import sympy as sp

from lagrangian.derive import NamedQuantity, QuantityKind, Step
from lagrangian.derive.circuits import nothing_stored, reason_of, step_two
from lagrangian.derive.energies import lagrangian_step, potential_step
from lagrangian.derive.lagrange import SUMMED, left_hand_sides_step
from lagrangian.derive.multipliers.step import by_multipliers, constraint_step
from lagrangian.model import Element, Gravity, Inductor, MutualInductance
from lagrangian.page.formula import (
    Formula,
    Heading,
    Item,
    Left,
    Minus,
    Name,
    Partial,
    Product,
    Square,
    Terms,
    Text,
    Total,
    formula,
    text,
)
from lagrangian.structured.families import Families
from lagrangian.structured.floating import along, laws, left_side, moved_by, quasi_velocities
from lagrangian.structured.listing import Listing
from lagrangian.structured.predict import is_long
from lagrangian.structured.writing import ListingWriter

FROM_BEFORE = "A velocity follows from that of the frame before it, so each line needs only the one above."
"""How velocities are found."""

ORDER: tuple[QuantityKind, ...] = (
    "turn",
    "velocity",
    "vertical",
    "height",
    "length",
    "constraint",
    "momentum",
    "acceleration",
    "force",
)
"""The kinds of quantities in the order in which the steps introduce them."""

HEADINGS = {
    "turn": "Sines and cosines",
    "velocity": "Velocities",
    "vertical": "The upward direction in the axes of the frames",
    "height": "Heights",
    "length": "Lengths of springs and dampers",
    "constraint": "Forces of the constraints",
    "momentum": "Momenta",
    "acceleration": "Accelerations",
    "force": "Forces",
}


MOST_ON_A_PAGE = 40
"""The number of definitions up to which the one-page checklist has them; it says where they are if there are more."""


class ListedSteps:
    """The steps of a listing; ``write`` has its names, ``units`` those of multipliers."""

    def __init__(self, found: Listing, write: ListingWriter, units: Mapping[str, str]) -> None:
        self.found, self.write, self.model = found, write, found.model
        self.families = Families(found.model)
        self.flat = self.model.dimension == 2
        self.T = [self._kinetic(k) for k in range(len(found.bodies))]
        self.V = [(element, self._potential(element)) for element in self.model.elements if element.ledger == "V"]
        self.given = {title: write(node) for title, node in found.given.items()}
        self.total_T = sp.Add(*[value for _, value in self.T], *self.given.values())
        self.total_V = sp.Add(*[value for _, value in self.V])
        self.multipliers = {tie.row.name: tie.known(write, units) for tie in found.ties}
        self.sections = self._sections()
        self.brief = len(self.definitions()) <= MOST_ON_A_PAGE

    def _sections(self) -> dict[QuantityKind, list[NamedQuantity]]:
        """The quantities by kind, vectors in the order x, y, z, each quantity after those that it needs.

        A part without a meaning of its own stands before the first that needs it.
        """
        kinds: dict[QuantityKind, list[NamedQuantity]] = {kind: [] for kind in ORDER}
        known: dict[sp.Basic, NamedQuantity] = {q.symbol: q for q in self.write.quantities.values()}
        needs = {x: sorted(q.expression.free_symbols & known.keys(), key=str) for x, q in known.items()}
        first: dict[tuple[str, str, bool], int] = {}
        for node, q in sorted(self.write.quantities.items()):
            first.setdefault(_group(q), node)
        ordered = sorted(known.values(), key=lambda q: (first[_group(q)], _alphabetic(q)))
        used = self._first_used([q.symbol for q in ordered])
        where = self._section_of(needs, used)
        done: set[sp.Basic] = set()

        def put(symbol: sp.Basic) -> None:
            if symbol not in done:
                done.add(symbol)
                for needed in needs[symbol]:
                    put(needed)
                kinds[where[symbol]].append(known[symbol])

        for symbols in used.values():
            for symbol in symbols:
                put(symbol)
        for kind in ORDER:
            for q in ordered:
                if where[q.symbol] == kind:
                    put(q.symbol)
        return kinds

    def _first_used(self, known: Sequence[sp.Basic]) -> dict[QuantityKind, list[sp.Basic]]:
        """What the energies and the rows of constraints need, by the section that precedes them."""
        rows = [x for row in self.multipliers.values() for x in (row.position, row.rate) if x is not None]
        values: dict[QuantityKind, list[sp.Expr]] = {
            "velocity": [*(x for _, x in self.T), *self.given.values()],
            "length": [x for _, x in self.V],
            "constraint": [*rows, *(self.write(x) for x in self.found.pushes)],
        }
        found: dict[QuantityKind, list[sp.Basic]] = {}
        for kind, exprs in values.items():
            symbols = set[sp.Basic]().union(*(x.free_symbols for x in exprs))
            found[kind] = [x for x in known if x in symbols]
        return found

    def _section_of(
        self, needs: Mapping[sp.Basic, Sequence[sp.Basic]], used: Mapping[QuantityKind, Iterable[sp.Basic]]
    ) -> dict[sp.Basic, QuantityKind]:
        """The section of every quantity: that of its kind, or an earlier one in which something needs it."""
        place: dict[sp.Basic, int] = {}
        for q in self.write.quantities.values():
            place[q.symbol] = len(ORDER) - 1 if q.kind == "shared" else ORDER.index(q.kind)
        for kind, symbols in used.items():
            for symbol in symbols:
                place[symbol] = min(place[symbol], ORDER.index(kind))
        for _, q in sorted(self.write.quantities.items(), reverse=True):  # operands have lower numbers
            for needed in needs[q.symbol]:
                place[needed] = min(place[needed], place[q.symbol])
        return {symbol: ORDER[k] for symbol, k in place.items()}

    def definitions(self) -> tuple[NamedQuantity, ...]:
        """All quantities, each after those that it needs."""
        return tuple(q for kind in ORDER for q in self.sections[kind])

    def lines(self, kind: QuantityKind) -> Iterator[Item]:
        """The definitions of a kind under their heading; several turns share a line."""
        listed = self.sections[kind]
        if not listed:
            return
        yield Heading(text(HEADINGS[kind]))
        if kind == "turn":
            yield self._in_one_line(self.families([[formula(q.symbol, q.expression)] for q in listed]))
            return
        blocks: list[list[Item]] = []
        for of, group in groupby(listed, key=lambda q: (q.of, q.inward)):
            for k, q in enumerate(group):
                note = text(self._belongs(q)) if k == 0 and of[0] else None
                blocks.append([formula(q.symbol, q.expression, note=note, brief=self.brief)])
        yield from self.families(blocks)

    def _in_one_line(self, items: Iterable[Item]) -> Text:
        """Short definitions one after the other."""
        parts: list[str | Left] = []
        for item in items:
            assert isinstance(item, Formula)
            told = () if item.note is None else (" (", *item.note.parts, ")")
            parts += [", " if parts else "", item.sides[0], " = ", item.sides[1], *told]
        return text(*parts, ".", brief=self.brief)

    def _belongs(self, q: NamedQuantity) -> str:
        return f"{q.of} and all that hangs on it" if q.inward else q.of

    # -- step 2 -------------------------------------------------------------------------------------------------------

    def _kinetic(self, index: int) -> tuple[Left, sp.Expr]:
        """½ m v² + ½ ω·J ω of a body: as it is shown, and as an expression."""
        b, body = self.found.bodies[index], self.found.bodies[index].body
        v, omega = [self.write(x) for x in b.velocity], [self.write(x) for x in b.omega]
        shown: list[Left] = []
        value = body.mass / 2 * sp.Add(*[x**2 for x in v])
        if any(x != 0 for x in v) and body.mass != 0:
            shown.append(Square(body.mass / 2, tuple(x for x in v if x != 0)))
        for i, row in enumerate(body.tensor):
            for k, entry in enumerate(row):
                value += entry * omega[i] * omega[k] / 2
                share = entry / 2 if i == k else entry
                if k < i or share == 0 or 0 in (omega[i], omega[k]):
                    continue
                shown.append(Square(share, (omega[i],)) if i == k else share * omega[i] * omega[k])
        return (shown[0] if len(shown) == 1 else Terms(tuple(shown))) if shown else sp.S.Zero, value

    def kinetic(self) -> Step:
        """T* = Σ ½ m v² + ½ ω·J ω, in the velocities of the frames and points."""
        where = (
            "All vectors have their components in the fixed axes."
            if self.flat
            else "The components of a vector are along the axes of the frame that it belongs to: those of frame k turn "
            "with it. A second index names another frame along whose axes the vector is resolved."
        )
        items: list[Item] = [
            text(
                "Written out in the coordinates these equations may be too long to read. So every quantity that a "
                "person would name gets a name, and is defined once. "
                if is_long(self.model)
                else "Every quantity that a person would name gets a name, and is defined once. ",
                where,
            ),
            *self.lines("turn"),
            *self.lines("velocity"),
            Heading(text("Energies")),
        ]
        names = [Name("T*", b.index) for b in self.found.bodies]
        lines = zip(names, self.found.bodies, self.T, strict=True)
        items += self.families(
            [formula(name, shown, note=text(b.body.title), brief=self.brief)] for name, b, (shown, _) in lines
        )
        reasons = [
            text(n, f": {b.body.title} has mass and moves") for n, b in zip(names, self.found.bodies, strict=True)
        ]
        for element in (e for e in self.model.elements if e.title in self.given):
            names.append(Name("T*", element.name))
            items.append(formula(names[-1], self.given[element.title], note=text(element.title), brief=self.brief))
            coil = isinstance(element, Inductor | MutualInductance)
            reasons.append(text(names[-1], f": {element.title} {reason_of(element) if coil else 'was given'}"))
        items.append(formula(Name("T*"), _summed(names), brief=True))
        return Step(
            2,
            "Kinetic co-energy",
            *step_two(self.model, "½ωᵀJω", FROM_BEFORE),
            tuple(items),
            {"T": self.total_T},
            tuple(reasons),
        )

    # -- step 3 -------------------------------------------------------------------------------------------------------

    def _potential(self, element: Element) -> sp.Expr:
        if isinstance(element, Gravity):
            heights = self.found.heights[element.title]
            pairs = zip(self.found.bodies, heights, strict=True)
            return sp.Add(*[b.body.mass * element.g * self.write(h) for b, h in pairs])
        return sp.Add(*[self.write(x) for x in self.found.mechanics.added[element.title].potentials])

    def potential(self) -> Step:
        """V = Σ m g h + the energies of springs."""
        items: list[Item] = [
            *self.lines("vertical"),
            *self.lines("height"),
            *self.lines("length"),
            Heading(text("Energies")),
        ]
        names: list[Name] = []
        reasons: list[Text] = []
        lines: list[list[Item]] = []
        for element, value in self.V:
            if isinstance(element, Gravity):
                many = len(self.found.heights) > 1
                for b, node in zip(self.found.bodies, self.found.heights[element.title], strict=True):
                    names.append(Name("V", f"{b.index} {element.name}" if many else b.index))
                    height = self.write(node)
                    weight = Product((b.body.mass * element.g, height)) if height != 0 else height
                    lines.append([formula(names[-1], weight, note=text(b.body.title), brief=self.brief)])
                    reasons.append(text(names[-1], f": {element.title} pulls on {b.body.title}: mgh"))
            else:
                names.append(Name("V", element.name))
                lines.append([formula(names[-1], value, note=text(element.title), brief=self.brief)])
                reasons.append(text(names[-1], f": {element.title} {element.stored}"))
        items += self.families(lines)
        total: Left = _summed(names) if names else sp.S.Zero
        if not names:
            items = [nothing_stored(self.model)]
        items.append(formula(Name("V"), total, brief=True))
        return potential_step(self.model, items, self.total_V, reasons)

    # -- step 4 -------------------------------------------------------------------------------------------------------

    def lagrangian(self) -> Step:
        """L = T* − V."""
        return lagrangian_step(self.total_T - self.total_V)

    # -- the constraints ----------------------------------------------------------------------------------------------

    def constraints(self) -> Step | None:
        """The rows of the constraints, their multipliers, and what they add to each equation; None without any."""
        if not self.found.ties:
            return None
        known = self.multipliers.values()
        added = zip(moved_by(self.model).values(), (self.write(x) for x in self.found.pushes), strict=True)
        return constraint_step(self.found.ties, known, [row.rate for row in known], added, self.lines("constraint"))

    # -- step 5 -------------------------------------------------------------------------------------------------------

    def left_hand_sides(self) -> Step:
        """Momenta, accelerations and forces, their sums inwards, and three short lines for every coordinate."""
        by_xi = Partial(Name("L"), Name("xi", "i", 1))
        law = Terms((Total(by_xi), Minus(Partial(Name("L"), Name("xi", "i")))))
        by_rows = by_multipliers() if self.found.ties else ()
        quasi, moved = quasi_velocities(self.model), moved_by(self.model)
        some = any(symbol not in quasi for symbol in moved.values())
        items: list[Item] = [
            formula(law, Terms((Name("Xi", "i"), *by_rows)), note=SUMMED, brief=True)
            if by_rows
            else formula(law, Name("Xi", "i"), brief=some)
        ]
        items += [*laws(self.model)] if self.model.floating else []
        items += self._reason()
        items += [*self.lines("momentum"), *self.lines("acceleration"), *self.lines("force")]
        shown: dict[str, dict[sp.Expr, sp.Expr]] = {"momenta": {}, "gradients": {}, "left_hand_sides": {}}
        blocks: list[list[Item]] = []
        for i, (speed, symbol) in enumerate(moved.items()):
            momentum, slope = self.write(self.found.momenta[i]), self.write(self.found.gradients[i])
            by_rate, by_place = Partial(Name("L"), speed.symbol), Partial(Name("T*"), symbol)
            row = self.write(self.found.rows[i])
            whole: Left = Terms((Total(by_rate), Minus(Partial(Name("L"), symbol))))
            if symbol in quasi:
                by_place, whole = along(speed), left_side(symbol, *quasi[symbol])
            block: list[Item] = [Heading(text(f"Equation {i + 1}: ", symbol)), formula(by_rate, momentum)]
            block += [formula(by_place, slope)] if slope != 0 or symbol not in quasi else []
            blocks.append([*block, formula(whole, row, brief=symbol not in quasi)])
            shown["momenta"][symbol], shown["gradients"][symbol] = momentum, slope
            shown["left_hand_sides"][symbol] = row
        items += self.families(blocks)
        reasons = [
            text(f"equation {i + 1}: all that moves with ", symbol, ": its inertia, springs and weights")
            for i, symbol in enumerate(moved.values())
        ]
        return left_hand_sides_step(items, shown, reasons)

    def _reason(self) -> Iterator[Item]:
        """Why the left-hand side of a coordinate is a force on what moves with it."""
        if not self.model.bodies:
            return
        turning = "" if self.flat else " For a body that turns the same holds with Jω̇ + ω × Jω in the place of ma."
        by_rate, by_place = Partial(Name("v"), Name("xi", "", 1)), Partial(Name("v"), Name("xi"))
        yield text(
            "The derivative of mv·",
            by_rate,
            " in time is ma·",
            by_rate,
            " + mv·",
            Total(by_rate),
            ", and ",
            Total(by_rate),
            " = ",
            by_place,
            ". So the second part is ∂T*/∂ξ, which Lagrange's equation takes away again, and of every mass only ma·",
            by_rate,
            f" is left: its force of inertia, along the velocity that the rate gives it.{turning}",
        )
        yield text(
            "A rate moves everything that hangs on its joint. So momenta and forces are summed from the outside "
            "inwards; a sum is marked with ⁺: it belongs to what is named and to all that hangs on it."
        )
        if any(isinstance(e, Gravity) for e in self.model.elements):
            yield text(
                "Accelerations are measured against free fall: the ground itself is accelerated upwards with g, and no "
                "weight is left to be added (the same as −∂L/∂ξ of the potential energy of weights)."
            )


def _summed(names: Sequence[Name]) -> Left:
    """The sum of energies; of many the first and the last."""
    return Terms(tuple(names) if len(names) <= MOST_SUMMED else (names[0], names[1], Name("…"), names[-1]))


MOST_SUMMED = 9
"""Energies that are written in their sum one by one."""


def _alphabetic(q: NamedQuantity) -> tuple[str, str]:
    """Cosine and sine of one angle side by side, components of one vector from x to z."""
    letter, _, index = str(q.symbol).partition("_")
    return (index, letter) if q.kind == "turn" else (letter, index)


def _group(q: NamedQuantity) -> tuple[str, str, bool]:
    """What the components of one vector have in common."""
    return "" if q.kind == "turn" else str(q.symbol)[:1], q.of, q.inward
