"""A variant of a system: other letters, values, coordinates and attachments, and as many elements of each kind."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.coordinates import Carrier, Change, carried
from lagrangian.derive import derive
from lagrangian.errors import Error
from lagrangian.look.heading import head_picture
from lagrangian.look.hints import hints_of
from lagrangian.look.scenes import scene_of
from lagrangian.model import Element, Gravity, Model, Parameter, Spring
from lagrangian.model.names import moving_symbol
from lagrangian.records import dataclass
from lagrangian.values.dimensions import check_dimensions
from lagrangian.viewed import Brief
from lagrangian.worksheet.dice import Dice
from lagrangian.worksheet.letters import coordinate_letters, new_values, parameter_letters, relabelled
from lagrangian.worksheet.measure import Remeasured, remeasured
from lagrangian.worksheet.sides import Moved, both, moves, turns
from lagrangian.worksheet.told import MOVABLE, letters_of, named_by_words
from lagrangian.worksheet.worded import still_true

SMALLEST, LARGEST = 0.6, 1.7
"""The equations of a variant have at least, and at most, so many times the operations of the original's."""

ATTEMPTS = 8
"""So many choices of coordinates are tried before they are only renamed."""

LONG = 1_000
"""Of equations with more operations, which take long to derive, one choice is tried."""


@dataclass(frozen=True)
class SystemVariant(Brief):
    """A variant: its model, its changes in words, and whether they concern more than letters, values and coordinates.

    If ``substantial``, the solution of the original is wrong here, whatever its letters; otherwise it may be right in
    other letters or coordinates, and ``reason`` says why nothing is attached elsewhere.
    """

    model: Model
    changes: tuple[str, ...]
    substantial: bool
    reason: str = ""


def variant_of(model: Model, seed: int) -> SystemVariant:
    """Return the variant of a seed; the same seed gives the same variant.

    Every change is tried: it is made only if the variant can be derived, has equations of similar size, and is drawn as
    completely as the original. Raises `Error` if the original cannot be derived.
    """
    model = _running(model, "duration", "initial")
    search = _Search(model)
    moved = search.moved(Dice(seed, 1))
    base = model if moved is None else _lettered(model, {}, {}, {}, moved)
    turned, remade = _measured(base, seed, search, moved)
    names = parameter_letters(turned, Dice(seed, 3))
    values = new_values(turned, Dice(seed, 4))
    found = _lettered(turned, names, values, {}, None)
    changes = moved.what.split("; ") if moved is not None else []
    changes += [r.what for r in remade if r.what]
    changes.append("other letters and values")
    named = _named(found, f"{_title(model.name)}, variant {seed}")
    return SystemVariant(named, tuple(changes), moved is not None, "" if moved is not None else search.reason())


class _Search:
    """Looks for other places of elements, and counts why some are refused."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.size, self.undrawn = _size(model), _undrawn(model)
        self.used, self.alone, self.doubled = _letters(model), _alone(model), _doubled(model)
        self.attempts = ATTEMPTS if self.size <= LONG else 1
        self.refused: Counter[str] = Counter()
        self.tried = 0

    def fits(self, made: Model | None) -> bool:
        """Whether a system may be a variant; counts why not."""
        if made is None:
            why = "cannot be derived"
        elif (
            not SMALLEST * self.size <= _size(made) <= LARGEST * self.size
            or not self.used <= _letters(made)
            or _alone(made) > self.alone
            or _doubled(made) > self.doubled
        ):
            why = "changes the difficulty"
        elif _undrawn(made) > self.undrawn:
            why = "cannot be drawn"
        else:
            return True
        self.refused[why] += 1
        return False

    def moved(self, dice: Dice) -> Moved | None:
        """What is attached elsewhere or acts the other way round: one thing, or two; None if nothing can be."""
        places, sides = dice.shuffled(moves(self.model)), dice.shuffled(turns(self.model))
        chosen = self._first(places) or self._first(sides)
        if chosen is None or self.attempts == 1 or not dice.chance(0.6):
            return chosen
        more = [both(self.model, chosen, other) for other in dice.shuffled([*places, *sides]) if other is not chosen]
        return self._first([m for m in more if m is not None][:2]) or chosen

    def _first(self, options: Sequence[Moved]) -> Moved | None:
        self.refused["makes a description untrue"] += sum(m.described is None for m in options)
        self.tried += len(options)
        for move in [m for m in options if m.described is not None][: self.attempts]:
            made = _tried(lambda move=move: _lettered(self.model, {}, {}, {}, move))
            if not self.fits(made):
                continue
            if made is not None and not _alike(self.model, made):
                return move
            self.refused["leaves the equations as they are"] += 1
        return None

    def reason(self) -> str:
        """Why nothing is attached elsewhere."""
        if not any(isinstance(e, MOVABLE) for e in self.model.elements):
            return "it has no force, torque, spring or damper that could be elsewhere"
        why = [what for what, count in self.refused.items() if count]
        if not why:
            return "its forces, torques, springs and dampers can be attached nowhere else"
        tried = "the only other attachment" if self.tried == 1 else f"each of {self.tried} other attachments"
        return f"{tried} {' or '.join(why)}"


def _equations(model: Model) -> tuple[sp.Eq, ...]:
    """The equations of a model, which is derived once."""
    return model.remembered("equations", lambda: derive(model).equations)


def _alone(model: Model) -> int:
    """The number of coordinates that nothing but their own inertia concerns, no spring, force, gravity or neighbour."""
    names = {n for e in model.elements if isinstance(e, (*MOVABLE, Gravity)) for n in letters_of(e)}
    said = {x.symbol for x in (*model.parameters, *model.inputs) if x.name in names}
    own = {c.symbol for c in model.coordinates}
    found = [bounded.letters(e.lhs) | bounded.letters(e.rhs) for e in _equations(model)]
    return sum(not letters & said and len(letters & own) == 1 for letters in found)


def _doubled(model: Model) -> int:
    """The number of pairs of inputs that act at the same place, so that one of them would be enough."""
    sides = [e.lhs - e.rhs for e in _equations(model)]  # type: ignore[operator]
    rows = [[bounded.diff(side, u.symbol) for side in sides] for u in model.inputs]
    return sum(
        any(all(bounded.expand(a + sign * b) == 0 for a, b in zip(one, other, strict=True)) for sign in (1, -1))
        for one, other in combinations(rows, 2)
    )


def _letters(model: Model) -> set[Any]:
    """The parameters and inputs in the equations."""
    found = {s for e in _equations(model) for side in (e.lhs, e.rhs) for s in bounded.letters(side)}
    return found & {x.symbol for x in (*model.parameters, *model.inputs)}


def _title(name: str) -> str:
    """The name of a system without the part about its coordinates, which may be different in a variant."""
    kept = [x for x in name.split(", ") if not re.search(r"\b(relative|absolute)\b", x)]
    return ", ".join(kept) or name


def _measured(model: Model, seed: int, search: _Search, moved: Moved | None) -> tuple[Model, list[Remeasured]]:
    """The model in other coordinates, at least in other names; in as many as possible if nothing has moved."""
    sprung = moved is not None and any(isinstance(e, Spring) for e in moved.elements.values())
    for attempt in range(search.attempts):
        dice = Dice(seed, 2, attempt)
        names = coordinate_letters(model, dice)
        remade = remeasured(model, names, dice, keen=moved is None and attempt < 2, sprung=sprung)
        made = _tried(lambda r=remade: _in_coordinates(model, r))
        if made is not None and search.fits(made):
            return made, remade
    names = coordinate_letters(model, Dice(seed, 2, 0))
    plainly = [
        Remeasured(c, name := names.get(c.name, c.name), moving_symbol(name, positive=c.positive), c.description)
        for c in model.coordinates
    ]
    return _in_coordinates(_running(model, "duration"), plainly), plainly


def _running(model: Model, *kept: str) -> Model:
    """The model with only these settings of its runs."""
    return replace(model, settings={k: v for k, v in model.settings.items() if k in kept}, _memo={})


def _in_coordinates(model: Model, remade: Sequence[Remeasured]) -> Model:
    table = {r.coordinate.name: r.expression for r in remade if r.expression != r.coordinate.symbol}
    made = carried(model, table, name=model.name).model() if table else model
    plainly = {r.coordinate.name: r.name if r.expression.is_Function else None for r in remade}
    return _lettered(made, {}, {}, {r.name: r.description for r in remade}, None, plainly)


def _tried(make: Any) -> Model | None:
    """A model, or None if it cannot be described, derived or drawn."""
    try:
        made: Model = make()
        check_dimensions(made)
        _equations(made)
        return made
    except Error:
        return None


def _size(model: Model) -> int:
    """The operations of the equations."""
    return sum(bounded.operations(e) for e in _equations(model))


def _undrawn(model: Model) -> int:
    """How much of a model is not drawn; a model without a picture lacks the most."""
    picture = head_picture(model)
    if picture is None or picture.trouble:
        return 1_000
    return len(scene_of(model, hints_of(model))[0].missing)


def _alike(one: Model, other: Model) -> bool:
    """Whether two models with the same letters have the same equations, but for signs."""
    pairs = zip(_equations(one), _equations(other), strict=True)
    return all(_equal(a.lhs - a.rhs, b.lhs - b.rhs) for a, b in pairs)  # type: ignore[operator]


def _equal(a: sp.Expr, b: sp.Expr) -> bool:
    return bounded.expand(a - b) == 0 or bounded.expand(a + b) == 0


@dataclass(frozen=True, eq=False)
class _Lettering(Change):
    """No change of coordinates; parameters and inputs are replaced by others."""

    letters: Mapping[Any, Any] | None = None

    def put_in(self, expr: sp.Expr) -> sp.Expr:
        """The expression in the new letters."""
        return cast("sp.Expr", expr.xreplace(dict(self.letters or {})))


class _Letterer(Carrier):
    """Builds a description in other letters, with other values, words and places of elements."""

    def __init__(
        self,
        model: Model,
        change: _Lettering,
        names: Mapping[str, str],
        values: Mapping[str, float | None],
        words: Mapping[str, str],
        moved: Moved | None,
        said: Mapping[str, str | None],
    ) -> None:
        super().__init__(model, change, model.name)
        self.names, self.values, self.words, self.said = names, values, words, said
        self.moved = moved or Moved({}, "")
        self.now = {p.symbol: new for p in model.parameters if (new := values.get(p.name, p.value)) is not None}

    def declare(self) -> None:
        """Declare everything under its new name, with its new value."""
        for c in self.model.coordinates:
            words = self._described(c, self.words.get(c.name, c.description))
            self.builder.coordinate(c.name, description=words, unit=c.unit, positive=c.positive)
        for p in self.model.parameters:
            unit, value = self.moved.units.get(p.name, (p.unit, self.values.get(p.name, p.value)))
            words = self._described(p, p.description)
            self.builder.parameter(self.names.get(p.name, p.name), value, unit=unit, description=words)
        for u in self.model.inputs:
            name = self.names.get(u.name, u.name)
            self.builder.input(name, description=self._described(u, u.description), unit=u.unit)

    def _described(self, symbol: Any, words: str) -> str:
        """The description in the new letters, without what has become untrue of places and values."""
        words = (self.moved.described or {}).get(symbol.name, words)
        words = still_true(self.model, symbol if isinstance(symbol, Parameter) else None, words, self.now)
        return relabelled(words, self.said)

    def elements(self, element: Element) -> Iterator[Element]:
        """The element at its new place; one that is named after its letter has the new letter's name."""
        gone = id(element) in self.moved.elements and id(element) not in self.moved.turned
        for made in super().elements(self.moved.elements.get(id(element), element)):
            if gone and made.name != made.kind and named_by_words(self.model, element):
                made = made.named("")  # a name such as "table" tells its old place
            yield made.named(self.names[made.name]) if made.name in self.names else made

    def settle(self) -> None:
        """Keep the settings of runs, and the hints for the picture that name no letter."""
        self.builder.settings.update(self.model.settings)
        said = set(re.findall(r"\w+", str(dict(self.model.look))))
        if not said & {old for old, new in self.names.items() if old != new}:
            self.builder.look.update(self.model.look)


def _lettered(
    model: Model,
    names: Mapping[str, str],
    values: Mapping[str, float | None],
    words: Mapping[str, str],
    moved: Moved | None,
    measured: Mapping[str, str | None] | None = None,
) -> Model:
    """The model in other letters, with other values, descriptions of coordinates, and places of elements."""
    letters: dict[Any, Any] = {}
    for p in model.parameters:
        letters[p.symbol] = sp.Symbol(names.get(p.name, p.name))
    for u in model.inputs:
        letters[u.symbol] = moving_symbol(names.get(u.name, u.name))
    table = {c.symbol: c.symbol for c in model.coordinates}
    change = _Lettering(model.coordinates, model.coordinates, table, letters=letters)
    return _Letterer(model, change, names, values, words, moved, {**(measured or {}), **names}).built().model()


def _named(model: Model, name: str) -> Model:
    return replace(model, name=name, _memo={})
