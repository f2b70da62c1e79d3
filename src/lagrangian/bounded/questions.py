"""Whole questions about a system, such as a derivation, which are counted if the system's expressions are hard.

Counting takes time, so questions about plain expressions are not counted: what they cost is bounded by their size.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import wraps
from typing import Any, ParamSpec, TypeVar

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.advice import Advice, Verb
from lagrangian.bounded.effort import CallCount, SpentError, is_counted
from lagrangian.bounded.sizes import TooLarge, each, size

P = ParamSpec("P")
T = TypeVar("T")

QUESTION = 6_000_000
"""The number of calls after which a question about a system with hard expressions is given up."""

PLAIN = 3_000
"""The total size above which expressions count as hard, whatever is in them."""

INSIDE = 12
"""The size of an argument of a function, a base of a high power or a case above which an expression is hard."""

HIGH = 6
"""A power of a sum is hard if its exponent has a larger numerator or denominator."""

MOST_GIVEN_UP = 30
"""The number of questions of a kind that are remembered as given up."""

NUMBERS = Advice(
    *("shorten the expressions, or use ", Verb("simulate"), ", ", Verb("linearize"), ", ", Verb("export")),
    " or, in Python, compile(), which do not need the written equations",
)
"""What helps if a question takes too many steps."""


def answered(
    doing: str, is_hard: Callable[..., bool], fix: str = NUMBERS, *, once: bool = False
) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Decorate a question about a system: it ends with `TooLarge` after `QUESTION` calls if ``is_hard`` says so.

    Questions inside a counted question share its count. ``doing`` is the subject of the error's sentence. With
    ``once`` one that was given up is not tried again: what is kept of the first try would let the second one come
    further. This is for questions about what does not change.
    """
    given_up: dict[object, None] = {}

    def decorate(question: Callable[P, T]) -> Callable[P, T]:
        @wraps(question)
        def asked(*args: P.args, **named: P.kwargs) -> T:
            if is_counted() or not is_hard(*args, **named):
                return question(*args, **named)
            asked_for = _key(args, named) if once else None
            if asked_for is not None and asked_for in given_up:
                raise TooLarge(f"{doing} takes more than {QUESTION} steps", fix=fix, code="E601")
            try:
                return CallCount(QUESTION, anywhere=False).run(lambda: question(*args, **named))
            except SpentError:
                pass
            if asked_for is not None:
                given_up[asked_for] = None
                while len(given_up) > MOST_GIVEN_UP:
                    del given_up[next(iter(given_up))]
            raise TooLarge(f"{doing} takes more than {QUESTION} steps", fix=fix, code="E601")

        return asked

    return decorate


def _key(args: tuple[Any, ...], named: dict[str, Any]) -> object:
    """What a question is about, to know it again; None for what may change."""
    try:
        key = QUESTION, tuple(tuple(x) if isinstance(x, list) else x for x in args), tuple(sorted(named.items()))
        hash(key)
    except TypeError:
        return None
    return key


def hard(expressions: Iterable[sp.Basic], plain: int = PLAIN) -> bool:
    """Whether SymPy may take long over expressions: long ones, high powers of sums, functions of sums or functions."""
    total = 0
    for expr in expressions:
        total += size(expr)
        if total > plain or any(_hard(node) for node in each(expr)):
            return True
    return False


def _hard(node: sp.Basic) -> bool:
    if isinstance(node, (AppliedUndef, sp.Derivative)) or not node.args:
        return False
    if isinstance(node, sp.Pow):
        base, exponent = node.args
        if not isinstance(exponent, sp.Rational):
            return size(exponent) > INSIDE
        return max(abs(exponent.p), exponent.q) > HIGH and size(base) > 1
    if isinstance(node, sp.log) and isinstance(node.args[0], sp.cosh):
        return False  # the co-energy of a coil that saturates; its cosh is asked by itself
    if isinstance(node, (sp.Function, sp.Piecewise, sp.Max, sp.Min)):
        most = 3 * INSIDE if isinstance(node, (sp.sin, sp.cos)) else INSIDE
        return max(size(a) for a in node.args) > most or any(_turns(part) for a in node.args for part in each(a))
    return False


def _turns(part: sp.Basic) -> bool:
    """Whether a part is a function, but not one of time alone."""
    return isinstance(part, sp.Function) and not isinstance(part, AppliedUndef)
