"""Describes in the lecture's words how rows of one set add up to a row of the other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import sympy as sp

from lagrangian.compare.rows import EquationRow
from lagrangian.page.formula import Left, Text, show, text
from lagrangian.page.plain import plain

Factors = Iterable[sp.Expr]
Labels = Iterable[str]


def combination(label: str, factors: Factors, of: Labels, *, holds: bool) -> Text:
    """The whole sentence: "Add B-1 and B-2: matches 1r."."""
    pieces = _pieces(factors, of)
    ends = "matches" if holds else "does not match"
    if len(pieces) == 1 and pieces[0][0] == 1:
        return text(f"Equation {pieces[0][1]} {ends} {label}.")
    return text(*recipe(factors, of), f": {ends} {label}.")


def recipe(factors: Factors, of: Labels) -> tuple[str | Left, ...]:
    """The instruction for the rows: "Add B-1 and B-2"."""
    pieces = _pieces(factors, of)
    plus = [(f, n) for f, n in pieces if not f.could_extract_minus_sign()]
    minus = [(-f, n) for f, n in pieces if f.could_extract_minus_sign()]
    if len(pieces) == 1:
        factor, name = pieces[0]
        return (f"Equation {name}",) if factor == 1 else (f"Equation {name} times ", *_factor(factor))
    if not minus:
        return ("Add ", *_listed(plus))
    if plus:
        return ("From ", *_listed(plus, plus=True), " subtract ", *_listed(minus))
    return ("Add ", *_listed(minus), " and change the signs")


def equality(label: str, factors: Factors, of: Labels) -> Text:
    """The same as an equation: "1r = B-1 + B-2"."""
    parts: list[str | Left] = [f"{label} = "]
    for k, (f, name) in enumerate(_pieces(factors, of)):
        minus = f.could_extract_minus_sign()
        size = -f if minus else f
        parts.append((" − " if minus else " + ") if k else "−" if minus else "")
        parts += [name] if size == 1 else [*_factor(size), f" ({name})"]
    return text(*parts)


def _pieces(factors: Factors, of: Labels) -> list[tuple[sp.Expr, str]]:
    return [(f, name) for f, name in zip(factors, of, strict=True) if f != 0]


def _factor(factor: sp.Expr) -> list[str | Left]:
    return ["(", factor, ")"] if factor.is_Add else [factor]


def _listed(pieces: list[tuple[sp.Expr, str]], *, plus: bool = False) -> list[str | Left]:
    parts: list[str | Left] = []
    for k, (factor, name) in enumerate(pieces):
        if k:
            parts.append(" plus " if plus else " and " if k == len(pieces) - 1 else ", ")
        parts += [name] if factor == 1 else [*_factor(factor), f" times {name}"]
    return parts


def within(part: Any, names: Mapping[sp.Basic, sp.Expr]) -> Any:
    """A symbol, also inside ∂…/∂…, with its name in the report."""
    if isinstance(part, sp.Basic):
        return part.xreplace(names)
    by = getattr(part, "by", None)
    return type(part)(part.of, by.xreplace(names)) if isinstance(by, sp.Basic) else part


def commas(exprs: Sequence[Left]) -> list[Left | str]:
    """Expressions separated by commas."""
    parts: list[Left | str] = []
    for e in exprs:
        parts += [", ", e] if parts else [e]
    return parts


def symbols(names: Sequence[str]) -> list[Left | str]:
    """Names as symbols, separated by commas."""
    return commas([sp.Symbol(n) for n in names])


def row_data(row: EquationRow) -> dict[str, Any]:
    """A row as plain data."""
    factors = {name: plain(f) for f, name in zip(row.factors, row.of, strict=True) if f != 0}
    words = "".join(show(p) for p in row.words.parts)
    return {
        "row": row.label,
        "factors": factors,
        "words": words,
        "holds": row.holds,
        "figure": row.check.figure,
        "rest": plain(row.rest),
    }


def summed(terms: Sequence[sp.Expr]) -> str:
    """A sum in the grammar of model files."""
    return " + ".join(plain(t) for t in terms).replace("+ -", "- ") or "0"
