"""On which side of an equation a term is told to stand, so that its sign is the one that belongs in what was written.

x'' = (F - k x)/m     on the right-hand side, the term −d ẋ/m is missing
m x'' = F - k x       on the right-hand side, the term −d ẋ is missing
m x'' + k x = F       the term d ẋ is missing
m x'' - F = -k x      with everything on the left-hand side, the term d ẋ is missing

A term that was written is sought on both sides, multiplied out; one that is not there stands where those stand that
have its letters.
"""

from __future__ import annotations

import re
from dataclasses import replace
from functools import lru_cache
from typing import cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.verdict import AnsweredLine, TermDifference
from lagrangian.model import time
from lagrangian.page.formula import Left
from lagrangian.read.letters import key

LEFT, RIGHT = "with everything on the left-hand side", "on the right-hand side"
WRONG_SIGN = " has the wrong sign"
"""What is said behind a term of which the sign is wrong."""
_ACCELERATION = re.compile(r"\w(?:dd|ddot)\b")
"""An acceleration as programs call it."""
_WRITTEN_OUT = re.compile(r"\w[ ]?[-+−*/·(]|\b(?:sin|cos|sqrt|frac)|\d[ ]?[A-Za-z]")
"""What a side has that is more than a name."""


def on_side(line: AnsweredLine, difference: TermDifference) -> tuple[str, TermDifference]:
    """Where a term of an equation is told to stand ("" where that is clear), and the difference with its signs there.

    The difference is given with everything on the left.
    """
    if line.kind not in ("equation", "identity") or line.sides is None:
        return "", difference
    flipped = RIGHT, replace(difference, term=-difference.term, written=-difference.written)
    left, right = line.sides
    here, there = (_terms(side) for side in line.sides)
    if difference.kind == "extra" and _is_put_in(line) and difference.written in here - there:
        return "", replace(difference, kind="missing", written=sp.S.Zero)
    if difference.written != 0:
        own, turned = _terms(difference.written), _terms(-difference.written)
        stands = own <= here, turned <= there
        if stands[0] != stands[1]:
            return ("", difference) if stands[0] else flipped
    if _is_moving(difference.term) and _ACCELERATION.search(line.text.partition("=")[0]):
        return "", difference  # on the side of the accelerations, M qdd = f - K q
    names = _names(difference.written if difference.written != 0 else difference.term)
    near_left, near_right = (any(_names(x) == names for x in side) for side in (here, there))
    if not near_left and not near_right and difference.written == 0:
        acting = _inputs(difference.term, line.sides)
        near_left, near_right = (any(x in acting for y in side for x in y.args) for side in (here, there))
    if near_right and not near_left:
        return flipped
    alone = len(sp.Add.make_args(left)) == 1
    signed = alone and len(there) == 1 and right.could_extract_minus_sign()
    solved = right != 0 and isinstance(left, (sp.Symbol, sp.Derivative, AppliedUndef))
    if (near_left and not near_right) or not (signed or solved or len(there) > 1):
        return "", difference
    if not alone:
        return LEFT, difference
    rates = left.has(sp.Derivative)
    return ("", difference) if rates and _accelerates(difference.term, difference.coordinate) else flipped


def _is_put_in(line: AnsweredLine) -> bool:
    """Whether the left side of a line is the derivative of what a name is, and was not written: d/dt r = (…)."""
    left = line.text.partition("=")[0].removeprefix("d/dt").strip()
    return line.kind == "identity" and "d/d" not in left and _WRITTEN_OUT.search(left) is None


def differs(d: TermDifference) -> tuple[str | Left, ...]:
    """How a term differs, in words."""
    match d.kind:
        case "missing":
            return ("the term ", d.term, " is missing")
        case "extra":
            return ("the term ", d.term, " does not belong there")
        case "sign":
            return (d.written, WRONG_SIGN)
        case _:
            return (d.written, " should be ", d.term)


@lru_cache(maxsize=500)
def _terms(side: sp.Expr) -> frozenset[sp.Expr]:
    """The terms of one side, multiplied out, with fractions for decimals."""
    exact = cast(
        "sp.Expr", bounded.expand(side).xreplace({x: sp.Rational(str(x)) for x in bounded.atoms(side, sp.Float)})
    )
    return frozenset(cast("tuple[sp.Expr, ...]", sp.Add.make_args(exact)))


def _names(term: sp.Expr) -> frozenset[str]:
    """The names in a term, and its sines and cosines."""
    moving = {x.func.__name__ for x in term.atoms(AppliedUndef)}
    names = frozenset(map(key, moving | {str(x) for x in term.free_symbols if x != time}))
    return names | {str(f.func) for f in term.atoms(sp.sin, sp.cos)}


def _inputs(term: sp.Expr, sides: tuple[sp.Expr, sp.Expr]) -> set[sp.Expr]:
    """The factors of a term that are functions of time of which no rate stands in an equation: F of F R."""
    moving = {d.expr for x in sides for d in x.atoms(sp.Derivative)}
    return {x for x in sp.Mul.make_args(term) if isinstance(x, AppliedUndef) and x not in moving}


def _is_moving(term: sp.Expr) -> bool:
    """Whether a term holds an acceleration."""
    return any(d.derivative_count > 1 for d in term.atoms(sp.Derivative) if isinstance(d, sp.Derivative))


def _accelerates(term: sp.Expr, coordinate: str | None) -> bool:
    """Whether a term holds the acceleration of a coordinate."""
    found = (d for d in term.atoms(sp.Derivative) if d.derivative_count > 1)
    return any(getattr(d.expr.func, "__name__", None) == coordinate for d in found)
