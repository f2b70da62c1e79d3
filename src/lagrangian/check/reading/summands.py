"""The summands of a side as they are written, each with its factors: ½, m r² and (ẋ/r)² of ½ (m r²) (ẋ/r)².

SymPy multiplies a product out of its factors and adds equal terms; which of them stood there tells what was meant.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

import sympy as sp
from lark import Tree
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.answer import Factors, Summands
from lagrangian.check.reading.meaning import Meaning
from lagrangian.check.reading.nodes import Node, inside

MOST_SUMMANDS = 40
"""Longer sums are not looked at as they are written."""


def summands(side: Tree, reader: Meaning) -> Summands:
    """Return the summands of a side that was read; the first of each term is the term as a whole. None of a matrix, nor
    of a sum that is too long."""
    terms = [*_terms(side)]
    if len(terms) > MOST_SUMMANDS:
        return ()
    found: list[tuple[Factors, ...]] = []
    for sign, term in terms:
        whole = _factors(term, reader)
        if whole is None:
            return ()
        inner = [*_inner(term, reader)][:MOST_SUMMANDS]
        signed = [(sp.S.NegativeOne, *x) if sign < 0 else x for x in (whole, *inner)]
        found.append(tuple(signed))
    return tuple(found)


def negative(found: Summands) -> Summands:
    """Return the summands with the other sign."""
    return tuple(tuple((sp.S.NegativeOne, *x) for x in term) for term in found)


def _terms(side: Node) -> Iterator[tuple[int, Tree]]:
    """The terms of a sum with their signs."""
    tree = inside(side)
    if tree.data not in ("sum", "signed"):
        yield 1, tree
        return
    sign, first, *rest = tree.children
    for mark, term in ((sign, first), *zip(rest[::2], rest[1::2], strict=True)):
        own = -1 if mark is not None and str(mark) == "-" else 1
        yield from ((own * s, t) for s, t in _terms(term))


def _children(term: Tree) -> list[tuple[bool, Tree]]:
    """The factors of a term, and whether each stands below the bar."""
    if term.data != "product":
        return [(False, term)]
    first, *rest = term.children
    pairs = zip(rest[::2], rest[1::2], strict=True)
    return [(False, cast("Tree", first)), *((str(o) == "/", cast("Tree", c)) for o, c in pairs)]


def _factors(term: Tree, reader: Meaning) -> Factors | None:
    """The values of the factors of a term; None if one is a matrix."""
    values = [(below, reader.value(x)) for below, x in _children(term)]
    if any(isinstance(x, MatrixBase) for _, x in values):
        return None
    return tuple(1 / x if below else x for below, x in values)


def _inner(term: Tree, reader: Meaning) -> Iterator[Factors]:
    """The terms of the first bracket with a sum that is a factor of a term, each times the other factors."""
    factors = _children(term)
    for k, (below, factor) in enumerate(factors):
        parts = [*_terms(factor)] if not below else []
        if len(parts) < 2:
            continue
        others = _factors(term, reader) or ()
        for sign, part in parts:
            own = _factors(part, reader)
            if own is not None:
                yield (*others[:k], sp.Integer(sign), *own, *others[k + 1 :])
        return
