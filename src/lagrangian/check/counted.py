"""Answers that count coordinates of the system from another place or in another direction, and say so in words.

    x from the position at rest      x of the answer is x − x₀, where x₀ solves the equations at rest
    s positive upwards               it is −s, if s of the system grows downwards
    θ from the horizontal            it is π/2 − θ, θ + π/2 or θ − π/2, if θ = 0 is vertical

The answer is judged with the same system in these coordinates, under the same letters.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from itertools import islice, product
from typing import Any, TypeAlias, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.constraints.stated_senses import sign_along
from lagrangian.check.coordinates.rest import position_at_rest
from lagrangian.check.reading.answer import StatedCoordinates
from lagrangian.check.reference import Reference, truth_of
from lagrangian.check.verdict import Status, Verdict
from lagrangian.coordinates import changed
from lagrangian.derive import Derived, derive
from lagrangian.errors import ModelError, ParseError
from lagrangian.model import Model
from lagrangian.model.names import moving_symbol
from lagrangian.model.symbols import Coordinate
from lagrangian.page.formula import Text, text

MOST = 8
"""The most systems that are tried for an answer."""
MOST_KEPT = 8
"""The most of them that are kept for a system."""

Table: TypeAlias = dict[str, sp.Expr]
"""The coordinates of an answer, by the names of those of the system whose letters they have, in terms of these."""


def judged_as_counted(
    derivation: Derived,
    said: StatedCoordinates,
    judge: Callable[[Derived], Verdict],
    glance: Callable[[Derived], Verdict],
) -> Verdict:
    """The verdict on an answer with the coordinates as it says that it counts them, if that makes it right, or if no
    more is wrong by it; ``glance`` judges without seeking mistakes."""
    found: Verdict | None = None
    failed: ParseError | None = None
    try:
        found = judge(derivation)
    except ParseError as error:
        failed = error
    if not said or (found is not None and found.right):
        return _found(found, failed)
    table, other = _likeliest(derivation, said, glance)
    try:
        verdict = None if other is None else judge(other)
    except ParseError:
        verdict = None
    if verdict is None or (found is not None and not _is_better(verdict, found)):
        return _found(found, failed)
    change = {c.symbol: table[c.name] for c in derivation.model.coordinates if c.name in table}
    status = Status.OTHER_COORDINATES if verdict.status in _SAME else verdict.status
    notes = (_told(change), *verdict.notes)
    return replace(verdict, status=status, notes=notes, change={**verdict.change, **change})


def _likeliest(
    derivation: Derived, said: StatedCoordinates, glance: Callable[[Derived], Verdict]
) -> tuple[Table, Derived | None]:
    """The coordinates of an answer that its words allow and in which the fewest lines are wrong."""
    tables = list(_tables(truth_of(derivation), said))
    systems = [(table, other) for table in tables if (other := _system(derivation, table)) is not None]
    if len(systems) < 2:
        return systems[0] if systems else ({}, None)
    amounts: list[tuple[int, int, int]] = []
    for k, (_, other) in enumerate(systems):
        try:
            amounts.append((*_amount(glance(other)), k))
        except ParseError:
            continue
    return systems[min(amounts)[-1]] if amounts else ({}, None)


_SAME = (Status.RIGHT, Status.EQUIVALENT)


def _found(verdict: Verdict | None, failed: ParseError | None) -> Verdict:
    if verdict is None:
        assert failed is not None
        raise failed
    return verdict


def _is_better(one: Verdict, other: Verdict) -> bool:
    """Whether a verdict is right, or finds no more lines wrong, and no more terms in them."""
    return one.right or _amount(one) <= _amount(other)


def _amount(verdict: Verdict) -> tuple[int, int]:
    wrong = [f for f in verdict.findings if f.status is Status.WRONG]
    return len(wrong), sum(len(f.differences) for f in wrong)


def _told(change: Mapping[Any, sp.Expr]) -> Text:
    parts: list[Any] = []
    for letter, value in change.items():
        parts += ["your ", letter, " is ", value, ", "]
    return text("Counted as you write, ", *parts[:-1], " in the letters of the system.")


def _tables(truth: Reference, said: StatedCoordinates) -> Iterator[Table]:
    """What the coordinates of an answer may be in those of the system; none that are the same."""
    model = truth.model
    table: Table = {}
    places = position_at_rest(truth) if said.rest else {}
    for c in model.coordinates:
        value: sp.Expr = c.symbol
        if c.name in said.rest:
            value -= places.get(c.symbol, sp.S.Zero)
        signs = {sign_along(model, c, way, "") for of, way in said.ways if of == c.name}
        value = -value if signs == {-1} else value
        if value != c.symbol:
            table[c.name] = value
    turned = [(c, others) for c in model.coordinates for others in [_from_axis(model, c, said)] if others]
    for chosen in islice(product(*(others for _, others in turned)), MOST):
        own = {c.name: other for (c, _), other in zip(turned, chosen, strict=True)}
        if made := table | own:
            yield made


def _from_axis(model: Model, c: Coordinate, said: StatedCoordinates) -> list[sp.Expr]:
    """What an angle may be that is counted from the axis that words name; nothing if it is counted so in the system."""
    axes = {axis for of, axis in said.axes if of == c.name}
    own = _axis_at_zero(model, c) if len(axes) == 1 else None
    if own is None:
        return []
    axis, x = axes.pop(), c.symbol
    if (axis == "horizontal") != (own == "horizontal"):
        return [sp.pi / 2 - x, x + sp.pi / 2, x - sp.pi / 2]
    if {axis, own} == {"upright", "hanging"}:
        return [sp.pi - x, x + sp.pi]
    return []


def _axis_at_zero(model: Model, c: Coordinate) -> str | None:
    """The axis along which what an angle turns is where all coordinates are 0; None if that is not one for all."""
    if model.dimension != 2:
        return None
    zero = {x.symbol: sp.S.Zero for x in model.coordinates}
    found = set[str]()
    for body in model.bodies:
        arm: list[float] = []
        for x in model.position(body.at):
            second = bounded.diff(bounded.diff(model.expand(x, constants=True), c.symbol), c.symbol)
            value = cast("sp.Expr", second.xreplace(cast("Any", zero)))
            value = cast("sp.Expr", value.xreplace({p: sp.Rational(3, 10) for p in value.free_symbols}))
            arm.append(-float(value) if value.is_number else float("nan"))
        across, along = arm
        if across == along == 0:
            continue
        if across != 0 and along != 0:  # also where one is unknown
            return None
        found.add("horizontal" if across else "upright" if along > 0 else "hanging")
    return found.pop() if len(found) == 1 else None


def _system(derivation: Derived, table: Table) -> Derived | None:
    """The derivation of the same system in other coordinates under the same letters; None if there is none."""
    model = derivation.model

    def made() -> tuple[Derived | None]:
        letters = {f"of{k}_counted": value for k, value in enumerate(table.values())}
        back = {name: moving_symbol(of) for name, of in zip(table, letters, strict=True)}
        try:
            return (derive(changed(changed(model, letters), back, name=model.name)),)
        except ModelError:
            return (None,)

    return model.recent("counted otherwise", tuple(table.items()), made, MOST_KEPT)[0]
