"""A change of coordinates between two systems, as a user gives it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.coordinates import Change
from lagrangian.errors import ModelError, did_you_mean
from lagrangian.model import Model, as_expr, time
from lagrangian.page.plain import plain
from lagrangian.read import Scope, parse_expression


def given_change(a: Model, b: Model, given: Mapping[Any, Any]) -> tuple[Change, bool]:
    """Return the change {coordinate of one: expression in the other's}, and whether it expresses (B)'s coordinates in
    (A)'s.

    A coordinate that is not mentioned equals the one of the same name in the other system. Raises `ModelError`.
    """
    if not isinstance(given, Mapping):
        raise ModelError(
            f"a change of coordinates is a mapping (got {type(given).__name__})", fix='{"x2": "x1 + x2r"}', code="E406"
        )
    keys = [plain(k) if isinstance(k, sp.Basic) else str(k).strip() for k in given]
    for turned, old, new in ((False, a, b), (True, b, a)):
        names = {c.name for c in old.coordinates}
        if names.issuperset(keys):
            return _read(old, new, dict(zip(keys, given.values(), strict=True))), turned
    names = [c.name for m in (a, b) for c in m.coordinates]
    strange = next((k for k in keys if k not in names), keys[0])
    what = (
        f"there is no coordinate '{strange}'" if strange not in names else "the change mixes both systems' coordinates"
    )
    raise ModelError(
        what,
        fix=did_you_mean(strange, [n for n in names if n != strange])
        or "the keys are coordinates of one system, the values are made of the other's",
        code="E402",
    )


def _read(old: Model, new: Model, given: Mapping[str, Any]) -> Change:
    theirs = {c.name: c.symbol for c in new.coordinates}
    table: dict[AppliedUndef, sp.Expr] = {}
    for c in old.coordinates:
        if c.name in given:
            table[c.symbol] = _value(old, new, given[c.name], c.name)
        elif c.name in theirs:
            table[c.symbol] = theirs[c.name]
        else:
            raise ModelError(
                f"the change does not say what '{c.name}' of '{old.name}' is in '{new.name}'",
                fix=f"add {c.name} = an expression in {', '.join(theirs)}",
                code="E401",
            )
    return Change(old.coordinates, new.coordinates, table)


def _value(old: Model, new: Model, value: object, name: str) -> sp.Expr:
    what = f"what '{name}' is in '{new.name}'"
    scope = Scope({**{p.name: p.symbol for p in old.parameters}, **new.symbols})
    expr = parse_expression(value, scope, what=what) if isinstance(value, str) else as_expr(value, what)
    moving = {c.symbol for c in new.coordinates}
    constants = {p.symbol for m in (old, new) for p in m.parameters} | {time}
    constants |= {d.symbol for d in new.definitions if not d.moving}
    strange = [*sorted(expr.atoms(sp.Derivative), key=str), *sorted(expr.atoms(AppliedUndef) - moving, key=str)]
    strange += sorted(expr.free_symbols - constants, key=str)
    if strange:
        raise ModelError(
            f"{what} holds '{plain(strange[0])}'",
            fix=f"write it with {', '.join(c.name for c in new.coordinates)}, parameters and t",
            code="E402",
        )
    return expr
