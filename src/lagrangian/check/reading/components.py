"""Names of the components of points that an answer gives as pairs or triples: xS and yS, x_S or S_x of S = (…, …)."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator
from itertools import islice
from typing import cast

import sympy as sp
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.read.letters import key

MOST = 40
"""The most points of an answer."""
_POINT = re.compile(
    r"(?<![\w*/^+=−-])(?P<name>[A-Z]\d?)[ \t]{0,9}+[=:][ \t]{0,9}+[(\[]"
    r"(?=[^()\[\],;=\n]{0,80}(?:\([^()\n]{0,80}\)[^()\[\],;=\n]{0,80}){0,6},)"
)
"""A point and where it is: S = (x + e sin theta, e cos theta)."""
_AXES = "xyz"
_FORMS = (
    re.compile(r"(?P<of>[^\W\d_]\w{0,12})_(?P<axis>[xyz])"),
    re.compile(r"(?P<axis>[xyz])_?(?P<of>[A-Z]\d?)"),
    re.compile(r"(?P<of>[A-Z]\d?)(?P<axis>[xyz])"),
)

_SEGMENT = re.compile(
    r"(?:^|[.:;,][ \t]|(?<!\w)(?:where|with|and|let|wobei|mit|und|sei)[ \t])[ \t]*"
    r"(?!KE|PE|TE|OK|CM)(?P<name>[A-Z]{2})[ \t]++"
    r"(?:is|be|denotes|means|stands[ \t]for|ist|sei|bezeichnet)(?!\w)",
    re.MULTILINE | re.IGNORECASE,
)
"""A length between two points, which words say: AB denotes …"""


def component_names(text: str, known: Callable[[str], bool]) -> Iterator[str]:
    """The names of components of points, which are no products xS = x S, where the system has no such name."""
    for name in dict.fromkeys(m["name"] for m in islice(_POINT.finditer(text), MOST)):
        if not known(name):
            yield from (f"{axis}{name}" for axis in _AXES)


def is_component(written: str, points: Collection[str]) -> bool:
    """Whether a name is that of a component of one of some points, given by their keys."""
    return any((m := form.fullmatch(written)) is not None and key(m["of"]) in points for form in _FORMS)


def has_entries(matrix: str, defined: Collection[str]) -> bool:
    """Whether an answer defines entries of a matrix, M11 of M, given by their keys: then a bold M is no mass."""
    return any(x.startswith(matrix) and x[len(matrix) :].isdigit() for x in defined)


def component_of(written: str, matrix: Callable[[str], object]) -> sp.Expr | None:
    """The component of a column of the answer that a name means: S_x, x_S or xS of S = (…, …); None for others."""
    for form in _FORMS:
        found = form.fullmatch(written)
        column = None if found is None else matrix(found["of"])
        if found is None or not isinstance(column, MatrixBase) or column.shape not in ((2, 1), (3, 1)):
            continue
        at = _AXES.index(found["axis"])
        return cast("sp.Expr", column[at, 0]) if at < len(column) else None
    return None


def segments(text: str) -> Iterator[str]:
    """The names of lengths between two points that words introduce, which are no products: AB is the distance …"""
    return (m["name"] for m in _SEGMENT.finditer(text) if m["name"].isupper())
