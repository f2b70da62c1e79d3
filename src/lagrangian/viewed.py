"""How results are displayed: short in Python's repr, and tuples as tables in notebooks.

The mappings of results accept names or symbols as keys, and an error lists the names that exist.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import fields
from functools import cache
from typing import Any, Generic, TypeVar

from lagrangian.errors import NoSuchEntry

T = TypeVar("T")

LONGEST = 400
"""The largest number of characters of a repr."""

FIELD = 60
"""The largest number of characters of one field in a repr."""


def cut(text: str, most: int = LONGEST) -> str:
    """Return ``text`` as one line of at most ``most`` characters; a closing bracket at its end stays."""
    line = " ".join(text.split())
    if len(line) <= most:
        return line
    end = line[-1] if line[-1] in ")]}>" else ""
    return f"{line[: most - 1 - len(end)]}…{end}"


class Entries(dict[Any, Any]):
    """A mapping of a result: its entries are found by symbol or by the name of the symbol.

    ``what`` is the name of the mapping in messages. An unknown key raises `NoSuchEntry`, a `KeyError` that lists the
    names.
    """

    def __init__(self, entries: dict[Any, Any], what: str) -> None:
        super().__init__({k: Entries(x, _name(k)) if type(x) is dict else x for k, x in entries.items()})
        self.what = what

    def _meant(self, key: object) -> Any:
        """The key with the same name, or None."""
        name = _name(key)
        return next((k for k in self if _name(k) == name), None)

    def __missing__(self, key: Any) -> Any:
        if (meant := self._meant(key)) is None:
            raise NoSuchEntry.among(f"{self.what} has no entry", _name(key), map(_name, self))
        return self[meant]

    def __contains__(self, key: object) -> bool:
        return super().__contains__(key) or self._meant(key) is not None

    def get(self, key: Any, default: Any = None) -> Any:
        """Return the entry, or ``default`` if there is none."""
        try:
            return self[key]
        except NoSuchEntry:
            return default

    def __reduce__(self) -> tuple[Any, ...]:
        return Entries, (dict(self), self.what)


def _name(key: object) -> str:
    """The name of a symbol; that of a rate ends in primes."""
    primes = getattr(key, "derivative_count", 0)
    of = getattr(key, "expr", key) if primes else key
    return str(of).removesuffix("(t)") + "'" * primes


class Brief:
    """A dataclass with a short repr that names its fields: long values are cut, defaults and None are omitted.

    Mappings among its fields become `Entries`.
    """

    def __post_init__(self) -> None:
        for name in _shown(type(self)):
            if type(value := getattr(self, name)) is dict:
                object.__setattr__(self, name, Entries(value, name))

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "__repr__" not in vars(cls):  # otherwise `dataclass` would write one
            cls.__repr__ = super(cls, cls).__repr__  # type: ignore[method-assign]

    def __repr__(self) -> str:
        values = [(f, getattr(self, f.name)) for f in fields(self) if f.repr]  # type: ignore[arg-type]
        shown = [f"{f.name}={cut(repr(x), FIELD)}" for f, x in values if x is not None and x is not f.default]
        return cut(f"{type(self).__name__}({', '.join(shown)})")


@cache
def _shown(cls: type) -> tuple[str, ...]:
    """The fields of a data class that its repr shows; every object that is made asks for them."""
    return tuple(f.name for f in fields(cls) if f.repr)


class Worded(Brief):
    """A dataclass whose repr is its text."""

    def __repr__(self) -> str:
        return cut(f"<{type(self).__name__}: {self}>")


class Viewed(tuple[T, ...], Generic[T]):
    """A tuple with HTML for notebooks, which is made when it is needed."""

    _view: Callable[[], str]

    def __new__(cls, items: Iterable[T], view: Callable[[], str]) -> Viewed[T]:
        """Make the tuple."""
        made = super().__new__(cls, items)
        made._view = view
        return made

    def __getnewargs__(self) -> tuple[tuple[T, ...], Callable[[], str]]:
        """Return the arguments from which a copy is made."""
        return tuple(self), self._view

    def _repr_html_(self) -> str:
        return self._view()
