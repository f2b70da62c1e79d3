"""What turns at the rate of a torque or a damper, such as a drum with a motor and a bearing: one rate for all."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions import Ingredients
from lagrangian.model import Body, Damper, Element, RigidBody


def shafts(s: Ingredients) -> Iterator[tuple[Any, sp.Expr, sp.Expr, list[tuple[Element, sp.Expr]]]]:
    """What has a kinetic energy ½ J ω², with ω, J and the elements that act at the same rate, each with its effort
    along ω; the effort of a damper is −b ω, and told as b."""
    acting = [(e, rate, effort) for e in s.acting if (found := _action(s, e)) is not None for rate, effort in [found]]
    for owner in s.model.elements:
        if isinstance(owner, Body) and not isinstance(owner, RigidBody):
            continue
        if not isinstance(owner, Body) and owner.kind != "kinetic":
            continue
        energy = s.rotation(owner) if isinstance(owner, RigidBody) else s.kinetic(owner)
        for rate in dict.fromkeys(rate for _, rate, _ in acting):
            J = bounded.cancel(2 * energy / rate**2) if energy != 0 else sp.S.Zero
            if J == 0 or J.has(*s.v, *s.q):
                continue
            same = [(e, effort) for e, x, effort in acting if bounded.expand(x - rate) == 0]
            other = [(e, effort) for e, x, effort in acting if bounded.expand(x + rate) == 0]
            same += [(e, effort if isinstance(e, Damper) else -effort) for e, effort in other]
            yield owner, rate, J, same
            break


def _action(s: Ingredients, element: Element) -> tuple[sp.Expr, sp.Expr] | None:
    """The one rate at which an element acts, and its effort; b of a damper."""
    actions = s.actions(element)
    if len(actions) != 1:
        return None
    rate = s.expand(actions[0].rate)
    if rate == 0 or not rate.has(*s.v):
        return None
    if isinstance(element, Damper):
        return None if element.b is None else (rate, s.expand(element.b))
    effort = s.expand(actions[0].effort)
    return None if effort.has(*s.v) else (rate, effort)
