"""SymPy's searches, which are abandoned after a number of calls."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any, TypeVar, cast

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.functions.elementary.hyperbolic import HyperbolicFunction
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from lagrangian.bounded.effort import CallCount, SpentError, count_operations, uncounted
from lagrangian.bounded.irreducible import product
from lagrangian.bounded.sizes import MAX_OPERATIONS, TERMS, each, size, terms

T = TypeVar("T")

CALLS = 300_000
"""The number of calls after which a search of SymPy is abandoned; textbook examples need less than a tenth."""

PROOFS = 10_000
"""The number of calls after which the sign of an argument is left undecided; x² + 1 takes a hundredth of it."""

BRIEF, FEW, LOW = 40, 16, 4
"""The size, the terms and the exponents up to which a search for a common factor is short without being counted."""

PRICE = 5_000
"""The operations that such a search counts as, about what it takes."""


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
    return expr if _is_product(expr) else _found(sp.cancel, expr)


def together(expr: sp.Expr) -> sp.Expr:
    """Return an expression over one denominator, or unchanged if that takes too long."""
    return expr if _is_product(expr) else _found(sp.together, expr)


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
    """What a search found, the calls that it counts as, and whether these are still to be counted by whoever asks."""

    def __init__(self, found: Any, calls: int, *, counted: bool = False) -> None:
        self.found, self.calls, self.counted = found, calls, counted


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
    if routine in (sp.cancel, sp.together) and _is_brief(expr):
        return _Result(uncounted(lambda: routine(expr)), PRICE, counted=True)
    found, calls = _counted(routine, (expr,), CALLS)
    if found is None:
        raise _GivenUpError
    return _Result(found, calls)


def _is_brief(expr: sp.Expr) -> bool:
    """Whether a common factor of an expression is found soon: it is short, and its powers are low."""
    if size(expr) > BRIEF or terms(expr) > FEW:
        return False
    return all(isinstance(x, _SUMS) or _is_letter(x) or (isinstance(x, sp.Pow) and _is_low(x)) for x in each(expr))


def _is_low(power: sp.Pow) -> bool:
    """Whether the exponent of a power is a small whole number."""
    return isinstance(power.exp, sp.Integer) and abs(power.exp.p) <= LOW


def _is_product(expr: sp.Expr) -> bool:
    """Whether an expression is a product of letters, and so a quotient without common factors."""
    factors = expr.args if isinstance(expr, sp.Mul) else (expr,)
    bases = [x.args[0] if isinstance(x, sp.Pow) and isinstance(x.args[1], sp.Integer) else x for x in factors]
    return all(_is_letter(x) or (isinstance(x, (sp.sin, sp.cos)) and _is_letter(x.args[0])) for x in bases)


def _is_letter(node: sp.Basic) -> bool:
    """Whether a node is a number, a letter, or a function of time or its rate."""
    function = node.expr if isinstance(node, sp.Derivative) else node
    own = isinstance(function, AppliedUndef) and all(isinstance(x, sp.Symbol) for x in function.args)
    return own or isinstance(node, (sp.Symbol, sp.Rational))


_SUMS: tuple[Any, ...] = (sp.Add, sp.Mul, sp.sin, sp.cos)
