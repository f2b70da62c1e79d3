"""The names of symbols: which are allowed, and the common symbol of time."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache
from typing import TypeGuard, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.errors import ModelError, Place

time = sp.Symbol("t")
"""The symbol of time, on which SymPy's ``dynamicsymbols`` depend."""


@lru_cache(maxsize=4_000)
def moving_symbol(name: str, *, positive: bool = False) -> AppliedUndef:
    """Return the function of time ``name(t)``, equal to SymPy's ``dynamicsymbols(name)``; ``positive`` ones are > 0.

    It is made once for all systems: SymPy takes long to see that two functions which were made apart are equal.
    """
    assumed = {"positive": True} if positive else {}
    return cast("AppliedUndef", sp.Function(name, **assumed)(time))


def multiplier_symbol(name: str) -> sp.Symbol:
    """The symbol of a row's multiplier λ in expressions of a run. No symbol of a user can have its name."""
    return sp.Symbol(f"λ({name})", real=True)


FUNCTIONS = frozenset(
    [
        "sin",
        "cos",
        "tan",
        "asin",
        "acos",
        "atan",
        "atan2",
        "sinh",
        "cosh",
        "tanh",
        "asinh",
        "acosh",
        "atanh",
        "exp",
        "log",
        "ln",
        "sqrt",
        "abs",
        "sign",
        "min",
        "max",
        "piecewise",
    ]
)
"""The functions in expressions, which cannot be names of symbols."""

RESERVED = FUNCTIONS | {"t", "pi"}
"""Names that already have a meaning: time, the number π, the functions."""

MAX_LENGTH = 64
_IDENTIFIER = re.compile(r"[^\W\d]\w*\Z")


def is_text(value: object) -> TypeGuard[str]:
    """Whether a value is text, as its annotation says; users may pass anything."""
    return isinstance(value, str)


def titled(kind: str, name: object) -> str:
    """A thing in words: ``spring 'k'``, or ``spring 2`` if that is the name that it got by its number."""
    if not is_text(name) or not name:
        return kind
    before, _, number = name.rpartition(" ")
    return name if before == kind and number.isdigit() else f"{kind} '{name}'"


def check_name(name: str, what: str, *, place: Place | None = None) -> str:
    """Return ``name`` in its normal form (NFKC) or raise `ModelError`.

    A name is a letter (of any script) or underscore, followed by letters, digits and underscores, at most 64
    characters. ``what`` is the kind of thing that has the name (``"parameter"``).
    """
    if not is_text(name):
        raise ModelError(f"the name of a {what} must be text (got {type(name).__name__})", place=place, code="E702")
    shown = name if len(name) <= MAX_LENGTH else name[: MAX_LENGTH - 1] + "…"
    if len(name) > MAX_LENGTH:
        raise ModelError(
            f"the name '{shown}' has {len(name)} characters",
            place=place,
            fix=f"use at most {MAX_LENGTH}",
            code="E702",
        )
    name = unicodedata.normalize("NFKC", name)
    if not _IDENTIFIER.match(name):
        raise ModelError(
            f"{what} name {shown!r} is not an identifier",
            place=place,
            fix="use a letter, then letters, digits and underscores",
            code="E702",
        )
    if name in RESERVED:
        meaning = {"t": "time", "pi": "the number 3.14159…"}.get(name, "a function")
        raise ModelError(
            f"'{name}' is reserved: it means {meaning}",
            place=place,
            fix=f"choose another name for the {what}, such as '{name}_1'",
            code="E403",
        )
    return name
