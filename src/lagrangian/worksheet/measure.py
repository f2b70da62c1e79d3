"""Other ways to measure the coordinates of a variant: from the other side, the other way round, absolute or relative.

Each change comes with words for the sheet. A change is left out if its words cannot be made from those of the original.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

import sympy as sp

from lagrangian.derive.coordinates import MeasuredFrom, measured
from lagrangian.model import Coordinate, Model
from lagrangian.model.names import moving_symbol
from lagrangian.records import dataclass
from lagrangian.worksheet.dice import Dice
from lagrangian.worksheet.directions import positive_sense, says_direction, turned_round, turned_words

OPPOSITE = (
    (r"hanging(?: straight)? down", "pointing straight up"),
    (r"(?:pointing )?(?:straight up|upright)", "hanging straight down"),
)
"""What an angle is measured from, and what it is measured from on the other side."""

FROM = re.compile(r"(?P<head>[^,]+), (?:(?:up|down) )?from (?P<tail>[^,:;]+)$")
RELATIVE = re.compile(r"(?P<head>[^,]+), (?:relative to (?P<parent>[^,:;]+)|from (?P<from>[^,:;(]+) \(relative\))")
"""Descriptions of coordinates: "cart 1, from the wall", "rod 2, relative to rod 1"."""

SPRUNG = re.compile(r"relaxed|unstretched|\bspring\b", re.IGNORECASE)
"""Words of a description that say where a spring is relaxed."""


@dataclass(frozen=True)
class Remeasured:
    """One coordinate measured in another way: old = ``expression`` of new symbols, its description, what was done.

    ``to`` are the coordinates that it was measured from, or is measured from now.
    """

    coordinate: Coordinate
    name: str
    expression: sp.Expr
    description: str
    what: str = ""
    to: tuple[Any, ...] = ()


def remeasured(
    model: Model, names: Mapping[str, str], dice: Dice, *, keen: bool = False, sprung: bool = False
) -> list[Remeasured]:
    """Return the coordinates in new names, some of them measured in another way; as many as possible if ``keen``.

    At most one coordinate is changed from absolute to relative or back, because others refer to it. If a spring has
    moved (``sprung``), no coordinate gets the words of another about where it is relaxed.
    """
    kinds = measured(model)
    named = {c.symbol: names.get(c.name, c.name) for c in model.coordinates}
    symbols = {c.symbol: moving_symbol(named[c.symbol], positive=c.positive) for c in model.coordinates}
    chosen: dict[Any, Remeasured] = {}
    related = [r for c in model.coordinates if c.name in names for r in _related(model, c, kinds, symbols)]
    related = [r for r in related if not (sprung and SPRUNG.search(r.description))]
    fixed: set[Any] = set()
    if related and (dice.chance(0.7) or keen):
        one = dice.one(related)
        chosen[one.coordinate.symbol] = one
        fixed = set(one.to)  # it is measured from this one, which therefore stays as it was
    for c in model.coordinates:
        options = [] if c.symbol in fixed or c.name not in names else list(_turned(model, c, kinds, symbols))
        if c.symbol not in chosen and options and (dice.chance(0.6) or keen):
            chosen[c.symbol] = dice.one(options)
    plainly = {c.symbol: Remeasured(c, named[c.symbol], symbols[c.symbol], c.description) for c in model.coordinates}
    return [chosen.get(s, r) for s, r in plainly.items()]


def _turned(
    model: Model, c: Coordinate, kinds: Mapping[sp.Expr, MeasuredFrom], symbols: Mapping[Any, Any]
) -> Iterator[Remeasured]:
    """A coordinate with the other sense, or an absolute one from the opposite direction."""
    kind, new = kinds[c.symbol], symbols[c.symbol]
    name = new.func.__name__
    if not kind.known or c.positive:
        return
    referred = c.symbol in [k.to for s, k in kinds.items() if s != c.symbol]
    sense, what = positive_sense(model, c), f"{c.name} the other way round"
    if not referred and (words := turned_words(c.description, sense)) is not None:
        yield Remeasured(c, name, -new, words, what)
    if kind.to is not None or model.dimension != 2:
        return
    tail = FROM.fullmatch(c.description)
    if kind.angle and tail is not None:
        for pattern, opposite in OPPOSITE:
            if re.fullmatch(pattern, tail["tail"]):
                yield Remeasured(
                    c, name, new - sp.pi, f"{tail['head']}, from {opposite}", f"{c.name} from the other side"
                )
    if c.description and sense is not None and not referred and not says_direction(c.description):
        yield Remeasured(c, name, -new, f"{c.description}, positive {turned_round(sense)}", what)


def _related(
    model: Model, c: Coordinate, kinds: Mapping[sp.Expr, MeasuredFrom], symbols: Mapping[Any, Any]
) -> Iterator[Remeasured]:
    """A relative coordinate made absolute, or an absolute one relative to that of the body before it."""
    kind, new = kinds[c.symbol], symbols[c.symbol]
    name = new.func.__name__
    by_symbol = {x.symbol: x for x in model.coordinates}
    if c.positive or not kind.known or any(k.to == c.symbol for k in kinds.values()):
        return
    if kind.to is not None:
        parent = by_symbol.get(kind.to)  # type: ignore[arg-type]
        own = RELATIVE.match(c.description)
        above = FROM.fullmatch(parent.description) if parent is not None else None
        same = parent is not None and kinds[parent.symbol].angle == kind.angle and kinds[parent.symbol].to is None
        if own is not None and above is not None and same and parent is not None:
            words = f"{own['head']}, from {above['tail']}"
            bare = name.removesuffix("r")  # x2r is a name for what is relative
            name = name if bare in {s.func.__name__ for s in symbols.values()} or not bare else bare
            yield Remeasured(
                c, name, moving_symbol(name) - symbols[parent.symbol], words, f"{c.name} absolute", (parent.symbol,)
            )
        return
    listed = list(model.coordinates)
    before = [x for x in listed[: listed.index(c)] if kinds[x.symbol] == MeasuredFrom(kind.angle, None)]
    own = FROM.fullmatch(c.description)
    for parent in before[-1:]:
        above = FROM.fullmatch(parent.description)
        if own is None or above is None or own["head"] == above["head"]:
            continue
        if own["tail"].strip() in (above["tail"], f"{above['tail']} as well"):
            words, what = f"{own['head']}, relative to {above['head']}", f"{c.name} relative to {parent.name}"
            yield Remeasured(c, name, symbols[parent.symbol] + new, words, what, (parent.symbol,))
