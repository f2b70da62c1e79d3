"""Sides with names of parts that nothing explains, T = T_1 + T_2 = … or m x'' = F_s = -k x, which are told and not
judged where another side has none of them."""

from __future__ import annotations

import re
from collections.abc import Sequence

import sympy as sp
from lark import Tree
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading.answer import AnswerLine, Kind
from lagrangian.check.reading.line_forms import listed_names
from lagrangian.check.reading.meaning import Meaning
from lagrangian.check.reading.names import Names, Value
from lagrangian.check.reading.nodes import has_matrix, start_of
from lagrangian.check.reading.placeholders import ENERGIES, displacements, is_placeholder, is_slope
from lagrangian.quantities.source import Source

_PARTS = "TVUEKPW"
"""The letters with which names of a part of an energy begin."""

_INSIDE = "JIΘΩ"
"""The capital letters that stand for inertias and speeds in an energy; small ones stand for speeds and positions."""

_FORCES = "FMNQRS"
"""The letters with which names of forces and moments begin."""

_VECTOR = re.compile("\u27e8vector (.*)\u27e9")


def tells(kind: Kind, value: Value, after: Sequence[Value], names: Names) -> bool:
    """Whether a side of an energy is to be judged: not T_1 + T_2 or m (x'^2 + y'^2)/2 with names of parts, speeds and
    inertias that the answer does not explain, if another side after it has none of them, or if it consists of nothing
    else."""
    if kind not in ENERGIES or not isinstance(value, sp.Expr):
        return True
    new = _new_in(value, names)
    usual = all(str(x)[0] in _PARTS + _INSIDE or str(x)[0].islower() for x in new)
    if new and usual and any(isinstance(x, sp.Expr) and not _new_in(x, names) for x in after):
        return False
    whole = bounded.letters(value)
    return not new or not all(str(x)[:1] in _PARTS for x in new) or bool(whole - new)


def without_parts(values: list[Value], sides: list[Tree], reader: Meaning) -> tuple[list[Value], list[Tree]]:
    """The values and sides of an equation without those of forces that nothing explains, between others."""
    if len(values) < 3:
        return values, sides
    new = [_new_in(x, reader.names) if isinstance(x, sp.Expr) else set[sp.Basic]() for x in values]
    usual = [all(str(x)[0] in _PARTS + _FORCES for x in names) for names in new]
    drop = [not new[0] and not new[-1] and bool(n) and u for n, u in zip(new, usual, strict=True)]
    for side, value in [(s, v) for s, v, out in zip(sides, values, drop, strict=True) if out]:
        left_out(side, value, reader)
    kept = [k for k, out in enumerate(drop) if not out]
    return [values[k] for k in kept], [sides[k] for k in kept]


def left_out(side: Tree, value: sp.Expr, reader: Meaning) -> None:
    """Tell that a side is not judged, and because of which names."""
    text, at = reader.source.text, start_of(side)
    begin, end = text.rfind("=", 0, at) + 1, text.find("=", at)
    written = " ".join((text[begin:] if end < 0 else text[begin:end]).split())
    new = _new_in(value, reader.names)
    listed = [u.name for u in reader.names.unknown.values() if u.symbol in new]
    reader.names.notes.setdefault(f"'{written}' was not judged: nothing says what {listed_names(listed)}.")


def tell_general(source: Source, new: Sequence[str], names: Names) -> None:
    """Tell that a statement is not judged, and because of which names."""
    written = " ".join(source.text.split())
    names.notes.setdefault(f"'{written}' was not judged: nothing says what {listed_names(new)}.")


def tell_vectors(values: Sequence[Value], sides: Sequence[Tree], reader: Meaning) -> list[AnswerLine]:
    """Tell that an equation with a matrix that is written out is not judged, because of the matrices that are not
    given; a general form without any, M q'' + h = f, says nothing of the system. It gives no lines."""
    held = set[sp.Basic]().union(*(bounded.atoms(x, AppliedUndef) for x in values if isinstance(x, sp.Expr)))
    vectors = sorted(m[1] for x in held if (m := _VECTOR.fullmatch(str(x.func))) is not None)
    if vectors and any(map(has_matrix, sides)):
        tell_general(reader.source, vectors, reader.names)
    return []


def _new_in(value: sp.Expr, names: Names) -> set[sp.Basic]:
    """The names in an expression that neither the system nor the answer explains."""
    return {x for x in bounded.letters(value) if names.is_unknown(x)}


def why_not_judged(value: sp.Expr) -> str | None:
    """Why a line with energies or variations that have no value is not judged; None if it holds nothing else."""
    held = bounded.atoms(value, AppliedUndef)
    if all(is_placeholder(x) for x in held):
        return None
    if any(x.func.__name__.startswith("\u27e8vector ") for x in held):
        return "it is a vector"
    if {x for x in held if is_placeholder(x)} <= displacements(value).keys():
        return "it is of virtual displacements"
    return "it is a general form" if any(is_slope(x) for x in held) else "an energy in it has no value"
