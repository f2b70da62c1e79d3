"""Vectors and matrices of expressions: entries, lengths, diagonals, and the symbol that a value is."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, cast

import sympy as sp

from lagrangian.model.elements.answers import Rows


def entries_of(value: Any) -> tuple[sp.Expr, ...]:
    """The entries of a checked value: the components of a vector, or the one value."""
    return cast("tuple[sp.Expr, ...]", value) if isinstance(value, tuple) else (value,)


def main_symbol(value: sp.Expr) -> str:
    """The name of the symbol that a value is, or is the negative of; empty where it is neither."""
    main = -value if value.could_extract_minus_sign() else value
    return getattr(main, "name", "") if main.is_Symbol or main.is_Function else ""


def norm(components: Iterable[sp.Expr]) -> sp.Expr:
    """√(x² + y² + z²)."""
    return sp.sqrt(sp.Add(*(x**2 for x in components)))


def diagonal(entries: Sequence[sp.Expr]) -> Rows:
    """The square matrix with these entries on its diagonal."""
    return tuple(tuple(x if i == j else sp.S.Zero for j in range(len(entries))) for i, x in enumerate(entries))
