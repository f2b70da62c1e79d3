"""Energies in a letter that the system defines for something else: L = T − V, where L is the length of a rope."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy as sp
from lark import Token, Tree

from lagrangian.check.reading.nodes import Node, names_in, only_name
from lagrangian.check.reading.stated import ENERGY_NAMES, energy_of
from lagrangian.model import Model
from lagrangian.read.letters import find, undotted


def energy_of_definition(
    sides: Sequence[Tree], model: Model, moves: Callable[[Node], bool]
) -> tuple[str, Token] | None:
    """Return the energy that a statement gives a value whose name the system defines, "T" or "L", and the name.

    It is T − V, or squares of rates stand in it; what the system calls so has none. Without any it is the definition,
    as the system has it or otherwise, and an equation.
    """
    named = only_name(sides[0]) if len(sides) > 1 else None
    kind = ENERGY_NAMES.get(str(named[0])) if named is not None and not named[1] else None
    if named is None or kind not in ("T", "L"):
        return None
    found = find(str(named[0]), model.symbols)
    defined = [d for d in model.definitions if d.name in found]
    if len(found) != 1 or not defined or defined[0].expression.has(sp.Derivative):
        return None
    listed = (undotted(x)[0] for side in sides[1:] for x, _ in names_in(side))
    energies = {energy_of(x, model, lhs=True) for x in listed if not find(x, model.symbols)}
    if (kind == "L" and energies >= {"T", "V"}) or any(_has_squares(side, moves) for side in sides[1:]):
        return kind, named[0]
    return None


def _has_squares(side: Tree, moves: Callable[[Node], bool]) -> bool:
    """Whether a power of a rate stands in a side."""
    powers = (x for x in side.iter_subtrees() if x.data in ("power", "postfix") and len(x.children) > 1)
    return any(map(moves, powers))
