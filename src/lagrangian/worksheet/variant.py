"""A variant of a system: other letters, values, coordinates and attachments, and as many elements of each kind."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.coordinates import Carrier, Change, carried
from lagrangian.derive import derive
from lagrangian.errors import Error
from lagrangian.look.heading import head_picture
from lagrangian.look.hints import hints_of
from lagrangian.look.scenes import scene_of
from lagrangian.model import Element, Model
from lagrangian.model.names import moving_symbol
from lagrangian.records import dataclass
from lagrangian.values.dimensions import check_dimensions
from lagrangian.viewed import Brief
from lagrangian.worksheet.dice import Dice
from lagrangian.worksheet.letters import coordinate_letters, new_value, parameter_letters, relabelled
from lagrangian.worksheet.measure import Remeasured, remeasured
from lagrangian.worksheet.sides import Moved, moves

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
    other letters or coordinates.
    """

    model: Model
    changes: tuple[str, ...]
    substantial: bool


def variant_of(model: Model, seed: int) -> SystemVariant:
    """Return the variant of a seed; the same seed gives the same variant.

    Every change is tried: it is made only if the variant can be derived, has equations of similar size, and is drawn as
    completely as the original. Raises `Error` if the original cannot be derived.
    """
    model = _running(model, "duration", "initial")
    size = _size(model)
    attempts = ATTEMPTS if size <= LONG else 1
    undrawn = _undrawn(model)

    def fits(made: Model) -> bool:
        return SMALLEST * size <= _size(made) <= LARGEST * size and _undrawn(made) <= undrawn

    dice = Dice(seed, 1)
    base, moved = model, None
    for move in moves(model, dice)[:attempts]:
        made = _tried(lambda move=move: _lettered(model, {}, {}, {}, move))
        if made is not None and fits(made) and not _alike(model, made):
            base, moved = made, move
            break
    turned, remade = _measured(base, seed, fits, attempts)
    names = parameter_letters(turned, Dice(seed, 3))
    dice = Dice(seed, 4)
    values = {p.name: new_value(p, dice) for p in turned.parameters}
    found = _lettered(turned, names, values, {}, None)
    changes = [moved.what] if moved is not None else []
    changes += [r.what for r in remade if r.what]
    changes.append("other letters and values")
    return SystemVariant(_named(found, f"{_title(model.name)}, variant {seed}"), tuple(changes), moved is not None)


def _title(name: str) -> str:
    """The name of a system without the part about its coordinates, which may be different in a variant."""
    kept = [x for x in name.split(", ") if not re.search(r"\b(relative|absolute)\b", x)]
    return ", ".join(kept) or name


def _measured(model: Model, seed: int, fits: Any, attempts: int) -> tuple[Model, list[Remeasured]]:
    """The model in other coordinates, at least in other names."""
    for attempt in range(attempts):
        dice = Dice(seed, 2, attempt)
        names = coordinate_letters(model, dice)
        remade = remeasured(model, names, dice)
        made = _tried(lambda r=remade: _in_coordinates(model, r))
        if made is not None and fits(made):
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
        derive(made)
        return made
    except Error:
        return None


def _size(model: Model) -> int:
    """The operations of the equations."""
    return sum(bounded.operations(e) for e in derive(model).equations)


def _undrawn(model: Model) -> int:
    """How much of a model is not drawn; a model without a picture lacks the most."""
    picture = head_picture(model)
    if picture is None or picture.trouble:
        return 1_000
    return len(scene_of(model, hints_of(model))[0].missing)


def _alike(one: Model, other: Model) -> bool:
    """Whether two models with the same letters have the same equations, but for signs."""
    pairs = zip(derive(one).equations, derive(other).equations, strict=True)
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
        self.moved = moved.elements if moved is not None else {}
        self.told = moved.described if moved is not None else {}
        self._vague = {n for e in model.elements if id(e) in self.moved for n in _letters_of(e)}

    def declare(self) -> None:
        """Declare everything under its new name, with its new value."""
        for c in self.model.coordinates:
            words = self.words.get(c.name, c.description)
            self.builder.coordinate(
                c.name,
                description=relabelled(words, self.said, other_values=bool(self.names)),
                unit=c.unit,
                positive=c.positive,
            )
        for p in self.model.parameters:
            value = self.values.get(p.name, p.value)
            name = self.names.get(p.name, p.name)
            self.builder.parameter(name, value, unit=p.unit, description=self._described(p))
        for u in self.model.inputs:
            name = self.names.get(u.name, u.name)
            self.builder.input(name, description=self._described(u), unit=u.unit)

    def _described(self, symbol: Any) -> str:
        """The description in the new letters, without the parts that name a place that something has left."""
        if symbol.name in self.told:
            return self.told[symbol.name]
        if symbol.name in self._vague:
            return ""
        return relabelled(symbol.description, self.said, other_values=bool(self.names))

    def elements(self, element: Element) -> Iterator[Element]:
        """The element at its new place; one that is named after its letter has the new letter's name."""
        for made in super().elements(self.moved.get(id(element), element)):
            if id(element) in self.moved and made.kind not in made.name and made.name.isalpha() and len(made.name) > 2:
                made = made.named("")  # a name such as "table" tells its old place
            yield made.named(self.names[made.name]) if made.name in self.names else made

    def settle(self) -> None:
        """Keep the settings of runs, and the hints for the picture that name no letter."""
        self.builder.settings.update(self.model.settings)
        said = set(re.findall(r"\w+", str(dict(self.model.look))))
        if not said & {old for old, new in self.names.items() if old != new}:
            self.builder.look.update(self.model.look)


def _letters_of(element: Element) -> set[str]:
    """The parameters and inputs of an element that has moved, whose descriptions may name its old place."""
    values = [getattr(element, key, None) for key in ("k", "b", "value")]
    listed = [x for v in values for x in (v if isinstance(v, tuple) else (v,)) if isinstance(x, sp.Expr)]
    return {getattr(s, "name", None) or s.func.__name__ for x in listed for s in _symbols(x)}


def _symbols(expr: sp.Expr) -> set[Any]:
    return expr.free_symbols | expr.atoms(sp.core.function.AppliedUndef)


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
