"""Finds the names of accelerations that an answer gives twice: as a = y'', and by the equation that is solved for it.

a = y'', al = phi''
a = (F + m l al sin(phi))/M        y'' = …      an equation of motion, as al needs a
al = (a sin(phi) - g phi)/l        phi'' = …
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import cast

from lark import Tree

from lagrangian.check.reading.nodes import inside, names_in, only_name
from lagrangian.read.letters import key, undotted


def named_accelerations(given: Mapping[int, tuple[str, Sequence[Tree]]]) -> dict[int, str]:
    """Return the names that statements, by number, say to be an acceleration alone, where what another one says of a
    name needs this name, perhaps by further names.

    ``given`` are the names that statements define, and what they say.
    """
    alone = {i: rate for i, (_, x) in given.items() if len(x) == 1 and (rate := _rate(x[0])) is not None}
    means = {given[i][0]: rate for i, rate in sorted(alone.items(), reverse=True)}
    plain = {i: given[i][0] for i, rate in alone.items() if _order(rate, means) == 2}
    needs: dict[str, set[str]] = {}
    for i in given.keys() - plain.keys():
        name, sides = given[i]
        listed = (key(undotted(str(token))[0]) for side in sides for token, _ in names_in(side))
        needs.setdefault(name, set()).update(listed)
    return {i: name for i, name in plain.items() if _needs(name, needs)}


def _rate(side: Tree) -> tuple[str, int] | None:
    """The name that a side is alone, or the rate of one, and how often it is differentiated there."""
    side, order = inside(side), 0
    if side.data == "rate":
        side, order = inside(side.children[0]), cast("int", side.children[1])
    if (found := only_name(side)) is None:
        return None
    base, dots = undotted(found[0])
    return key(base), order + dots + found[1]


def _order(rate: tuple[str, int], means: Mapping[str, tuple[str, int]]) -> int:
    """How often a rate is one, with those of the names in it: a = v' with v = x'."""
    name, order = rate
    for _ in range(3):
        if name not in means:
            break
        name, more = means[name]
        order += more
    return order


def _needs(name: str, needs: Mapping[str, set[str]]) -> bool:
    """Whether the value of a name needs this name itself."""
    found, waiting = set[str](), list(needs.get(name, ()))
    while waiting:
        one = waiting.pop()
        if one == name:
            return True
        if one not in found:
            found.add(one)
            waiting += needs.get(one, ())
    return False
