"""A generalized force lacks the arm (or the direction) that converts the force."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, letters, put
from lagrangian.model import Element
from lagrangian.page.formula import Text, text

STEP = 6
WHY = text("Ξ = F·∂r/∂ξ: a force counts with how far its point moves for each unit of ξ, for an angle with its arm.")


WHY_RATIO = text(
    "A force or a torque counts with how far what it acts on moves or turns for each unit of ξ: through a gear or a "
    "lever, with the ratio."
)
"""For a factor that is no length."""


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Replace every contribution of a force by the force itself; drop its angle; drop each length.

    What is left without the whole arm is the force itself; where more is left, one factor of the arm is missing.
    """
    for element in s.acting:
        if element.resists:
            continue
        shares = s.shares(element)
        efforts = list(dict.fromkeys(s.expand(a.effort) for a in s.actions(element)))
        bare = [sign * e for e in efforts for sign in (1, -1)]
        for i, x in shares.items():
            armed = x not in bare and any(_has_arm(x, e) for e in efforts)
            others: dict[sp.Expr, sp.Symbol | None] = dict.fromkeys(bare if armed else ())
            for p in letters(x):
                if not (y := bounded.expand(x / p)).has(p):
                    others.setdefault(y, None if y in bare else p)
            for other, factor in others.items():
                ratio = bounded.cancel(x / other) if other in bare else sp.S.One
                named = ratio if factor is None and ratio.is_Symbol and ratio in s.ratios else factor
                if other != x:
                    what = _what(element, ("the equation of ", s.q[i]), named)
                    why = WHY_RATIO if named in s.ratios else None
                    yield Variant(what=what, Xi={i: other - x}, element=element, coordinate=i, why=why)
        for p in _lengths(shares):
            changed = {i: bounded.expand(x / p) for i, x in shares.items() if x.has(p)}
            if len(changed) > 1:
                whole = all(x in bare for x in changed.values())
                what = _what(element, ("the equations",), None if whole else p)
                yield Variant(what=what, Xi={i: c - shares[i] for i, c in changed.items()}, element=element)


def _has_arm(share: sp.Expr, effort: sp.Expr) -> bool:
    """Whether a force is multiplied by more than a direction, sines and cosines."""
    arm = put(bounded.cancel(share / effort), dict.fromkeys(share.atoms(sp.sin, sp.cos), sp.S.One))
    return not arm.is_number


def _what(element: Element, where: tuple[str | sp.Expr, ...], factor: sp.Expr | None) -> Text:
    """What was done: the whole arm left out, or one factor of it."""
    if factor is None:
        return text(f"What {element.title} adds to ", *where, " comes without its arm.")
    return text(f"In what {element.title} adds to ", *where, ", the factor ", factor, " is missing.")


def _lengths(shares: dict[int, sp.Expr]) -> list[sp.Symbol]:
    return [p for x in shares.values() for p in letters(x) if not bounded.expand(x / p).has(p)][:1]
