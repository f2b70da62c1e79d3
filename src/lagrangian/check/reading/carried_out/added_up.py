"""The pieces of an energy that a program adds up in several lines: T = …, T += …; each stands where it is added."""

from __future__ import annotations

import re
from collections.abc import Iterable

import sympy as sp

from lagrangian.check.reading.carried_out.values import Shown
from lagrangian.check.reading.carried_out.written import written

_PIECE = re.compile(r"[^\W\d]\w*_added\d+")


def is_piece(name: str | None) -> bool:
    """Whether a name is that of such a piece, which the program does not have."""
    return name is not None and _PIECE.fullmatch(name) is not None


def pieces(name: str, stated: Iterable[Shown]) -> list[tuple[int, str]]:
    """What a program says of an energy, with its lines: each piece that it adds, and the whole as their sum.

    None where it adds nothing, or not to all terms that were there before.
    """
    found = dict[int, sp.Expr]()
    before = frozenset[sp.Basic]()
    for one in stated:
        if one.name != name:
            continue
        if not isinstance(one.value, sp.Expr):
            return []
        terms = frozenset(sp.Add.make_args(one.value))
        if not before <= terms:
            return []
        if terms != before:
            found[one.line] = sp.Add(found.get(one.line, sp.S.Zero), *(terms - before))
        before = terms
    if len(found) < 2:
        return []
    names = {line: f"{name}_added{line}" for line in found}
    whole = max(found), f"{name} = {' + '.join(names.values())}"
    return [*((line, f"{names[line]} = {written(value)}") for line, value in found.items()), whole]
