"""The derivative of an energy by a coordinate of the answer's own that replaces one of the system, u = f(s).

    ∂T/∂u̇ = (∂T/∂ṡ)/f'           ∂T/∂u = (∂T/∂s − (∂T/∂ṡ) ṡ f″/f')/f'

since u̇ = f' ṡ, so that ṡ = u̇/f' changes with u where u̇ is held. Where f holds several coordinates, nothing says here
which of them u replaces, and with it what is held: such a derivative has no value.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.model.names import time

Slope = Callable[[sp.Expr], sp.Expr]
"""The derivative of one energy by a coordinate or a rate of the system."""


def own_slope(meaning: sp.Expr, order: int, slope: Slope) -> sp.Expr | None:
    """The derivative by a coordinate (``order`` 0) or rate (1) of the answer's own that has this meaning; or None."""
    moving = list(meaning.atoms(AppliedUndef))
    if order > 1 or len(moving) != 1 or meaning.has(sp.Derivative):
        return None
    s = moving[0]
    first = cast("sp.Expr", meaning.diff(s))
    if bounded.is_zero(first):
        return None
    rate = cast("sp.Expr", s.diff(time))
    if order == 1:
        return slope(rate) / first
    second = cast("sp.Expr", first.diff(s))
    found = slope(s)
    return (found if second == 0 else found - slope(rate) * rate * second / first) / first
