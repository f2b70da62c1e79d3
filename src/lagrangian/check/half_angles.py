"""Roots that are sines or cosines of half an angle: √(2 + 2 sin θ) is 2 sin(θ/2 + π/4) where the system has the latter.

As 1 − cos 2α = 2 sin² α and 1 + cos 2α = 2 cos² α, the root is that function where it is positive. It is taken so if it
has one sign at all ordinary states and where the coordinates are 0: √(1 − cos θ) is no √2 sin(θ/2) for θ < 0.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.sampling import CompiledExpressions, States
from lagrangian.records import dataclass

LONGEST = 40
"""The largest number of operations of what stands below a root, and of an angle."""
MOST = 12
"""The most functions of half angles of a system."""


@dataclass(frozen=True)
class HalfAngle:
    """A ``square`` 1 ± cos 2α, by its function ``of`` the whole angle, and its positive ``root``."""

    of: sp.Expr
    square: sp.Expr
    root: sp.Expr

    def factor(self, base: sp.Expr) -> sp.Expr | None:
        """What the square is multiplied by in an expression; None if this is no multiple of it."""
        number = cast("sp.Expr", base.xreplace({self.of: sp.S.Zero}))
        fits = number != 0 and all(_is_positive(x) for x in sp.Mul.make_args(number))
        return number if fits and bounded.expand(base - number * self.square) == 0 else None


def _is_positive(factor: sp.Expr) -> bool:
    """Whether a factor is a positive number, a constant or a power of one."""
    of = factor.args[0] if factor.is_Pow else factor
    return bool(of.is_positive or of.is_Symbol)


def half_angles(exprs: Iterable[sp.Expr], states: States, q: Sequence[sp.Expr]) -> tuple[HalfAngle, ...]:
    """The functions of half a coordinate in expressions that have one sign at all ordinary states."""
    found: dict[sp.Expr, HalfAngle] = {}
    listed = {f for e in exprs for f in bounded.atoms(e, sp.sin, sp.cos)}
    for f in sorted(listed, key=sp.default_sort_key)[:MOST]:
        angle = cast("sp.Expr", f.args[0])
        if not any(angle.coeff(x) in (sp.S.Half, -sp.S.Half) for x in q) or bounded.operations(angle) > LONGEST:
            continue
        for made in (sp.sin, sp.cos):
            own = cast("sp.Expr", made(angle))
            square = 1 + (1 if made is sp.cos else -1) * cast("sp.Expr", sp.cos(bounded.expand(2 * angle)))
            of = bounded.atoms(square, sp.sin, sp.cos)
            rest = cast("sp.Expr", own.xreplace(dict.fromkeys(q, sp.S.Zero)))
            values = CompiledExpressions([own, rest]).at(states).flatten()
            if len(of) == 1 and ((values > 0).all() or (values < 0).all()):
                sign = 1 if values[0] > 0 else -1
                found[square] = HalfAngle(cast("sp.Expr", next(iter(of))), square, sign * sp.sqrt(2) * own)
    return tuple(found.values())


def with_half_angles(expr: sp.Expr, halves: Sequence[HalfAngle]) -> sp.Expr:
    """The expression with the roots of such squares as the functions of half the angle."""
    table: dict[sp.Basic, sp.Expr] = {}
    for f in bounded.atoms(expr, sp.Pow) if halves else ():
        base, exponent = cast("tuple[sp.Expr, Any]", f.args)
        if not (isinstance(exponent, sp.Rational) and exponent.q == 2) or bounded.operations(base) > LONGEST:
            continue
        for half in halves:
            if (number := half.factor(base)) is not None:
                table[f] = sp.powdenest(number**exponent, force=True) * half.root ** (2 * exponent)
                break
    return cast("sp.Expr", expr.xreplace(table)) if table else expr
