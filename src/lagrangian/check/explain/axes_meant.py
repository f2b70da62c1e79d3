"""Which axes the components v_x and v_y of an answer are along: fixed ones, or those of a table that turns."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from lagrangian.check.explain.meant import axes_of
from lagrangian.check.explain.said_wrongly import in_names_of, right_quantities
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine


def along_turned_axes(truth: Reference, lines: Sequence[AnsweredLine]) -> frozenset[int]:
    """The definitions, by identity, of components along x, y or z that mean axes that turn.

    Several belong together, none of them has a sine or a cosine or is right along fixed axes, and one is right along
    axes that turn.
    """
    groups: dict[str, list[AnsweredLine]] = {}
    for line in lines:
        if line.kind == "definition" and (of := axes_of(line.name or "")) is not None:
            groups.setdefault(of, []).append(line)
    return frozenset(id(x) for same in groups.values() if _is_turned(truth, same) for x in same)


def _is_turned(truth: Reference, same: Sequence[AnsweredLine]) -> bool:
    """Whether components that belong together mean axes that turn."""
    values = [in_names_of(truth, x) for x in same]
    if len({x.name for x in same}) < 2 or any(x is None or x.has(sp.sin, sp.cos) for x in values):
        return False
    if any(q.kind == "component" for x in same for q in right_quantities(truth, x)):
        return False
    return any(q.kind == "along" for x in same for q in right_quantities(truth, x, turned=True))
