"""Finds the two ends of a deflection in the geometry: the things whose distance or angle it is."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.derive.sample import Sampler
from lagrangian.model import DEFLECTION, Action, Element, Model, Words, time

GROUND: Words = ("the ground",)
MAX_QUANTITIES = 200
"""With more quantities no search is made, because the number of pairs grows with the square."""

CLOSE = 1e-7
"""Differences of changes below this are rounding: then the expressions themselves decide."""


def find_ends(model: Model, element: Element) -> tuple[Action, ...]:
    """The element's actions at each end; a bare deflection is resolved into the two things between which it lies.

    The deflection δ lies between A and B if a coordinate of B minus the same coordinate of A is δ, up to a constant:
    then +F acts on B and −F on A. If no pair fits, the deflection itself remains the only end.
    """
    ends = element.ends(model)
    whole = ends[0] if len(ends) == 1 else None
    if whole is None or whole.on != DEFLECTION or (deflection := whole.displacement) is None:
        return ends
    quantities = list(_quantities(model))
    if len(quantities) > MAX_QUANTITIES:
        return ends
    ground = [(group, GROUND, sp.S.Zero) for group in dict.fromkeys(g for g, _, _ in quantities)]
    changes = _changes(model, [deflection, *(x for _, _, x in ground + quantities)])
    for (group_b, on_b, b), change_b in zip(quantities, changes[1 + len(ground) :], strict=True):
        for (group_a, on_a, a), change_a in zip(ground + quantities, changes[1:], strict=True):
            if group_a != group_b or on_a == on_b or not _near(changes[0] + change_a, change_b):
                continue  # numbers tell most pairs apart, and to expand their difference takes long
            if _constant(deflection - b + a):
                if on_a == GROUND:
                    return (Action(whole.effort, bounded.diff(b, time), on_b, b),)
                return (
                    Action(whole.effort, bounded.diff(b, time), on_b, b),
                    Action(-whole.effort, bounded.diff(a, time), on_a, a),
                )
    return ends


def _changes(model: Model, exprs: list[sp.Expr]) -> list[float]:
    """How much each of the expressions changes between two random states with the same parameters."""
    sampler = Sampler(model, exprs)
    first, second = sampler.draw(1), sampler.draw(2)
    second.update((s, value) for s, value in first.items() if not (s == time or isinstance(s, AppliedUndef)))
    return [y - x for x, y in zip(sampler.at(first), sampler.at(second), strict=True)]


def _near(a: float, b: float) -> bool:
    """Whether two numbers may be the same but for rounding; a number that is not finite may be any."""
    return not abs(a - b) > CLOSE * max(abs(a), abs(b), 1.0)


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
