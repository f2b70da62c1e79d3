"""A description in which it is known of frictions whether they slip or stick: nothing in it jumps any more."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from lagrangian.errors import ModelError, NoSuchEntry
from lagrangian.model.builder import Builder
from lagrangian.model.elements import Element, Friction, VelocityConstraint
from lagrangian.model.rows import pressed_rows

SIDES = (1, -1)


def in_regime(builder: Builder, modes: Mapping[Any, Any]) -> None:
    """Change frictions of a description (a copy) as ``modes`` say: 1 or −1 slips in that sense, 0 sticks.

    Keys are frictions and rows that press on them, for which the mode is the sign of the multiplier, ±1. Frictions that
    are not mentioned stay as they are. Raises `NoSuchEntry` for other names, and `ModelError` for other modes.
    """
    model = builder.model()
    rows = pressed_rows(model)
    given = {getattr(key, "name", key): mode for key, mode in modes.items()}
    names = [*(f.name for f in model.frictions), *rows]
    for name, mode in given.items():
        if name not in names:
            raise NoSuchEntry.among("no friction, or row that presses on one,", str(name), names)
        allowed = SIDES if name in rows else (*SIDES, 0)
        if isinstance(mode, bool) or mode not in allowed:
            raise ModelError(
                f"'{name}' cannot have the mode {mode!r:.40}",
                fix=f"{' or '.join(map(str, allowed))}: the sign of the multiplier"
                if name in rows
                else "1 or -1 while it slips in that sense, 0 while it sticks",
                code="E406",
            )
    known = {f.name: f for f in model.frictions}
    made: list[Element] = []
    for element in builder.elements:
        if not isinstance(element, Friction) or element.name not in given or element.name not in known:
            made.append(element)
            continue
        friction, mode = known[element.name], int(given[element.name])
        if mode:
            made.append(_slipping(element.pressed(friction.pressed_by), mode, given))
        else:
            name = friction.name if builder.is_free(friction.name) else f"{friction.name} sticks"
            made.append(VelocityConstraint(expression=friction.rate(model), name=name, place=friction.place))
    builder.exchange(made)


def _slipping(friction: Friction, sense: int, given: Mapping[Any, Any]) -> Friction:
    slipping = friction.slipping(sense)
    if len(friction.pressing) != 1:
        return slipping
    (row,) = friction.pressing
    if row not in given:
        raise ModelError(
            f"'{row}' presses on it, and the sign of its multiplier decides on the friction",
            element=friction.title,
            place=friction.place,
            fix=f"regime({{'{friction.name}': {sense}, '{row}': 1}}), or -1",
            code="E401",
        )
    return slipping.on_side(int(given[row]))
