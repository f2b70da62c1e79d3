"""Quantities that the system defines by one coordinate, called and differentiated as functions of it: after
ℓ(θ) = √(a² + d² − 2 a d cos θ), ℓ(θ) is ℓ and no product, and dℓ/dθ is no fraction."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING

from sympy.core.function import AppliedUndef

from lagrangian.check.reading.arguments import apart_from, differentiated, value_stated, written
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

if TYPE_CHECKING:
    from lagrangian.check.reading.names import Names

_WORD = re.compile(r"\\?[^\W\d_](?:_\{\w{1,20}\}|[^\W_]|_(?=\w)){0,24}")
_STATED = re.compile(
    r"(?:\A|[\n,;:$&=({\[]|\\quad|\\qquad|[^\W\d_]{2})\s{0,3}(?P<name>\\?[^\W\d_]\w{0,24})\s{0,3}"
    r"(?:\\left\s?)?\(\s?(?P<of>\\?[^\W\d_]\w{0,24})\s?(?:\\right\s?)?\)\s{0,3}&?\s{0,3}=(?!=)"
)
"""A function that is stated; what stands before it is no factor."""
_CALLED = re.compile(r"(?<![\w\\])(?P<name>\\?[^\W\d_]\w{0,24})(?:\\left)?\((?P<of>\\?[^\W\d_]\w{0,24})(?:\\right)?\)")
"""A name with another one right behind it in brackets."""
_MOST = 100
"""The largest number of functions that are looked for."""


def called_definitions(text: str, names: Names) -> frozenset[str]:
    """Return the quantities of the system that an answer states with the coordinate by which it is defined, ℓ(θ), or
    that it has with it where it states them without: m ρ(s)² with ρ = a + s cos β."""
    found: set[str] = set()
    called = (m for m in islice(_CALLED.finditer(text), _MOST) if _is_stated(m["name"], m["of"], text))
    for match in (*islice(_STATED.finditer(text), _MOST), *called):
        name, of = written(match["name"]), written(match["of"])
        coordinate = _coordinate_of(name, names)
        if coordinate is not None and _symbol(of, names) == coordinate:
            found.add(f"{name}({of})")
    return frozenset(found)


def _is_stated(name: str, of: str, text: str) -> bool:
    """Whether an answer says what a name is, with a letter in its value."""
    value = value_stated(name, text)
    return value is not None and written(of) in {written(x) for x in _WORD.findall(value)}


def with_slopes_of_definitions(text: TracedText, names: Names, *, latex: bool) -> TracedText:
    """Return an answer in which dℓ/dθ, the slope of a quantity that the system defines by θ, is written ∂ℓ/∂θ."""
    if not any(d.moving for d in names.model.definitions):
        return text
    edits: list[Edit] = []
    for top, of in islice(_functions(text.text, names), _MOST):
        new = rf"\frac{{\partial {top}}}{{\partial {of}}}" if latex else f"∂{top}/∂{of}"
        for form in differentiated(written(top), of):
            edits += [(*m.span(), apart_from(text.text, m, new)) for m in re.finditer(form, text.text)]
    return text.edited(apart(sorted(edits)))


def _functions(text: str, names: Names) -> Iterator[tuple[str, str]]:
    """The quantities that are functions of one coordinate, and this, as they are written."""
    words = dict.fromkeys(x for m in _WORD.finditer(text) for x in (m[0], m[0].lstrip("\\").removeprefix("d")) if x)
    coordinates = {x: symbol for x in words if (symbol := _symbol(written(x), names)) in names.moving_symbols}
    for top in words:
        coordinate = _coordinate_of(written(top), names)
        if coordinate is not None:
            yield from ((top, of) for of, symbol in coordinates.items() if symbol == coordinate)


def _symbol(name: str, names: Names) -> object:
    meant, dots = names.scope.meanings(name)
    return names.scope[meant[0]] if len(meant) == 1 and not dots else None


def is_defined_by_one(name: str, names: Names) -> bool:
    """Whether the system defines a quantity by one coordinate."""
    return _coordinate_of(name, names) is not None


def _coordinate_of(name: str, names: Names) -> object:
    """The only coordinate by which the system defines a quantity; None of any other name."""
    symbol = _symbol(name, names)
    if not isinstance(symbol, AppliedUndef) or symbol in names.moving_symbols:
        return None
    within = names.model.expand(symbol).atoms(AppliedUndef)
    return within.pop() if len(within) == 1 and within <= names.moving_symbols else None
