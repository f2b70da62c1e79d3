"""Finds the two ends of a deflection in the geometry: the things whose distance or angle it is."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.model import DEFLECTION, Action, Element, Model, Words, time

GROUND: Words = ("the ground",)
MAX_QUANTITIES = 200
"""With more quantities no search is made, because the number of pairs grows with the square."""


def find_ends(model: Model, element: Element) -> tuple[Action, ...]:
    """The element's actions at each end; a bare deflection is resolved into the two things between which it lies.

    The deflection δ lies between A and B if a coordinate of B minus the same coordinate of A is δ, up to a constant:
    then +F acts on B and −F on A. If no pair fits, the deflection itself remains the only end.
    """
    ends = element.ends(model)
    if len(ends) != 1 or ends[0].on != DEFLECTION or ends[0].displacement is None:
        return ends
    whole = ends[0]
    quantities = list(_quantities(model))
    if len(quantities) > MAX_QUANTITIES:
        return ends
    ground = [(group, GROUND, sp.S.Zero) for group in dict.fromkeys(g for g, _, _ in quantities)]
    for group_b, on_b, b in quantities:
        for group_a, on_a, a in ground + quantities:
            if group_a == group_b and on_a != on_b and _constant(whole.displacement - b + a):
                if on_a == GROUND:
                    return (Action(whole.effort, bounded.diff(b, time), on_b, b),)
                return (
                    Action(whole.effort, bounded.diff(b, time), on_b, b),
                    Action(-whole.effort, bounded.diff(a, time), on_a, a),
                )
    return ends


def _constant(expr: sp.Expr) -> bool:
    return not bounded.expand(expr).has(AppliedUndef, time)


def _quantities(model: Model) -> Iterator[tuple[str, Words, sp.Expr]]:
    """Positions along each axis and directions: (kind, whose, value)."""
    seen: set[tuple[str, sp.Expr]] = set()
    for body in model.bodies:
        for axis, x in zip("xyz", model.position(body.at), strict=False):
            x = model.expand(x)
            if x.has(AppliedUndef) and (axis, x) not in seen:
                seen.add((axis, x))
                yield axis, (body.title,), x
    for body in model.bodies:
        frame = body.axes
        if frame is not None and frame.dimension == 2:
            angle = model.expand(frame.total_angle)
            if angle.has(AppliedUndef) and ("angle", angle) not in seen:
                seen.add(("angle", angle))
                yield "angle", (body.title,), angle
    for body in model.bodies:
        for x in model.position(body.at):
            for f in sorted(model.expand(x).atoms(sp.sin, sp.cos), key=sp.default_sort_key):
                angle = cast("sp.Expr", f.args[0])
                if angle.has(AppliedUndef) and ("angle", angle) not in seen:
                    seen.add(("angle", angle))
                    yield "angle", model.angle_words(angle), angle
