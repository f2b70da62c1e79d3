"""Which numbers of a description its author wrote as decimals: expressions are exact, so that 9.81 is 981/100 in them,
and pages show it as it was written."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import wraps
from types import FunctionType
from typing import Any, TypeVar, cast

import sympy as sp

C = TypeVar("C", bound=type)

_describing: ContextVar[set[sp.Rational] | None] = ContextVar("decimals", default=None)


def noted(number: sp.Expr) -> sp.Expr:
    """Return a number that was written as a decimal; the description that is being made remembers it."""
    if (found := _describing.get()) is not None and isinstance(number, sp.Rational) and number.q != 1:
        found.add(cast("sp.Rational", sp.Rational(abs(int(number.p)), int(number.q))))
    return number


@contextmanager
def noting(found: set[sp.Rational]) -> Generator[None]:
    """Meanwhile, decimals belong to a description; those that it noted are added to ``found``."""
    token = _describing.set(found)
    try:
        yield
    finally:
        _describing.reset(token)


def describes(cls: C) -> C:
    """Decorate a class whose public methods describe a system: its ``_builder`` remembers the decimals in arguments."""
    for name, method in list(vars(cls).items()):
        if isinstance(method, FunctionType) and not name.startswith("_"):
            setattr(cls, name, _noting(method))
    return cls


def _noting(method: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(method)
    def call(self: Any, *given: Any, **named: Any) -> Any:
        with noting(self._builder.decimals):
            return method(self, *given, **named)

    return call
