"""SymPy's searches, which are abandoned after a number of calls."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any, TypeVar, cast

import sympy as sp
from sympy.functions.elementary.hyperbolic import HyperbolicFunction
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from lagrangian.bounded.effort import CallCount, SpentError, count_operations
from lagrangian.bounded.irreducible import product
from lagrangian.bounded.sizes import MAX_OPERATIONS, TERMS, size, terms

T = TypeVar("T")

CALLS = 300_000
"""The number of calls after which a search of SymPy is abandoned; textbook examples need less than a tenth."""

PROOFS = 10_000
"""The number of calls after which the sign of an argument is left undecided; x² + 1 takes a hundredth of it."""


def searched(routine: Callable[..., T], *arguments: Any, calls: int = CALLS) -> T | None:
    """Return the result of one of SymPy's routines, or None if it makes more than ``calls`` calls."""
    return _counted(routine, arguments, calls)[0]


def _counted(routine: Callable[..., T], arguments: Sequence[Any], calls: int) -> tuple[T | None, int]:
    """The same, and how many calls it made."""
    counted = CallCount(calls, anywhere=True)
    try:
        return counted.run(lambda: routine(*arguments)), counted.limit - counted.left
    except SpentError:
        if counted.outer is not None and counted.outer.left < 0:
            raise  # the question within which it was searched is given up, too
        return None, calls
    except RecursionError:
        return None, calls


def is_zero(value: Any) -> bool:
    """Whether a value is zero. Of one with variables SymPy is not asked: the proof that it vanishes may take long."""
    return bool(value == 0 or (value.is_number and value.is_zero))


def absolute(function: Callable[..., Any], argument: sp.Expr) -> sp.Expr:
    """Return abs or sign of a real number, unevaluated if SymPy would split it into real and imaginary parts."""
    value = searched(function, argument, calls=PROOFS)
    split = value is None or value.has(sp.re, sp.im, sp.arg, sp.conjugate)
    return cast("sp.Expr", function(argument, evaluate=False) if split else value)


def cancel(expr: sp.Expr) -> sp.Expr:
    """Return a quotient without common factors, or the expression unchanged if the search takes too long."""
    return _found(sp.cancel, expr)


def together(expr: sp.Expr) -> sp.Expr:
    """Return an expression over one denominator, or unchanged if that takes too long."""
    return _found(sp.together, expr)


def simplify(expr: sp.Expr) -> sp.Expr:
    """Return the expression as SymPy simplifies it, or unchanged if that takes too long."""
    return _found(sp.simplify, expr)


def trigsimp(expr: sp.Expr) -> sp.Expr:
    """Return an expression with fewer sines and cosines, or unchanged if SymPy searches too long."""
    return _found(sp.trigsimp, expr) if expr.has(*_TURNING) else expr


_TURNING: tuple[Any, ...] = (TrigonometricFunction, HyperbolicFunction, sp.exp)


def factored(expr: sp.Expr) -> sp.Expr | None:
    """Return an expression as a product, or None if the search takes too long; sums that have no factors but letters
    need none."""
    if (found := product(expr)) is not None:
        return found
    try:
        return _searched_once(sp.factor, expr)
    except _GivenUpError:
        return None


def _found(routine: Callable[[Any], Any], expr: sp.Expr) -> sp.Expr:
    if not expr.args:
        return expr
    if terms(expr) > TERMS or size(expr) > MAX_OPERATIONS:
        return expr
    try:
        return _searched_once(routine, expr)
    except _GivenUpError:
        return expr


class _GivenUpError(Exception):
    """A search was given up: how far it came may depend on what was counted around it, so this is not kept."""


class _Result:
    """What a search found, how many calls it made, and whether these were counted by whoever asked first."""

    def __init__(self, found: Any, calls: int) -> None:
        self.found, self.calls, self.counted = found, calls, False


def _searched_once(routine: Callable[[Any], Any], expr: sp.Expr) -> sp.Expr:
    """The result of a search, kept: the same is sought in many lines and in many answers.

    In a question that is counted it counts each time, so that the end does not depend on what was asked before.
    """
    kept = _kept(routine, expr)
    if kept.counted:
        count_operations(kept.calls)
    kept.counted = True
    return cast("sp.Expr", kept.found)


@lru_cache(maxsize=2_000)
def _kept(routine: Callable[[Any], Any], expr: sp.Expr) -> _Result:
    found, calls = _counted(routine, (expr,), CALLS)
    if found is None:
        raise _GivenUpError
    return _Result(found, calls)
