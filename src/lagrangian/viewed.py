"""How results show themselves: short where Python prints them, tuples as tables where a notebook does.

Their mappings are entered by name or symbol, and say which names there are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import fields
from typing import Any, Generic, TypeVar

from lagrangian.errors import NoSuchEntry

T = TypeVar("T")

LONGEST = 400
"""Characters of a repr."""

FIELD = 60
"""Characters of a field in a repr."""


def cut(text: str, most: int = LONGEST) -> str:
    """Return ``text`` in one line of at most ``most`` characters, its last one kept where it is a bracket."""
    line = " ".join(text.split())
    if len(line) <= most:
        return line
    end = line[-1] if line[-1] in ")]}>" else ""
    return f"{line[: most - 1 - len(end)]}…{end}"


class Entries(dict[Any, Any]):
    """A mapping of a result: its entries are found by symbol and by the symbol's name.

    ``what`` it is called; a key that is not there raises `NoSuchEntry`, a `KeyError` that lists the names.
    """

    def __init__(self, entries: dict[Any, Any], what: str) -> None:
        super().__init__({k: Entries(x, _name(k)) if type(x) is dict else x for k, x in entries.items()})
        self.what = what

    def _meant(self, key: object) -> Any:
        """The key of the same name, else None."""
        name = _name(key)
        return next((k for k in self if _name(k) == name), None)

    def __missing__(self, key: Any) -> Any:
        if (meant := self._meant(key)) is None:
            raise NoSuchEntry.among(f"{self.what} has no entry", _name(key), map(_name, self))
        return self[meant]

    def __contains__(self, key: object) -> bool:
        return super().__contains__(key) or self._meant(key) is not None

    def get(self, key: Any, default: Any = None) -> Any:
        """Return the entry, or ``default`` where there is none."""
        try:
            return self[key]
        except NoSuchEntry:
            return default

    def __reduce__(self) -> tuple[Any, ...]:
        return Entries, (dict(self), self.what)


def _name(key: object) -> str:
    """What a symbol is called, a rate with its primes."""
    primes = getattr(key, "derivative_count", 0)
    of = getattr(key, "expr", key) if primes else key
    return str(of).removesuffix("(t)") + "'" * primes


class Brief:
    """A dataclass whose repr names its fields and stays short: long values are cut, defaults and None left out.

    The mappings among its fields become `Entries`.
    """

    def __post_init__(self) -> None:
        for f in fields(self):  # type: ignore[arg-type]
            if f.repr and type(value := getattr(self, f.name)) is dict:
                object.__setattr__(self, f.name, Entries(value, f.name))

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "__repr__" not in vars(cls):  # or `dataclass` would write one
            cls.__repr__ = super(cls, cls).__repr__  # type: ignore[method-assign]

    def __repr__(self) -> str:
        values = [(f, getattr(self, f.name)) for f in fields(self) if f.repr]  # type: ignore[arg-type]
        shown = [f"{f.name}={cut(repr(x), FIELD)}" for f, x in values if x is not None and x is not f.default]
        return cut(f"{type(self).__name__}({', '.join(shown)})")


class Worded(Brief):
    """A dataclass that is read as text, in its repr too."""

    def __repr__(self) -> str:
        return cut(f"<{type(self).__name__}: {self}>")


class Viewed(tuple[T, ...], Generic[T]):
    """A tuple with a piece of HTML for notebooks, made when it is asked for."""

    _view: Callable[[], str]

    def __new__(cls, items: Iterable[T], view: Callable[[], str]) -> Viewed[T]:
        """Make the tuple."""
        made = super().__new__(cls, items)
        made._view = view
        return made

    def __getnewargs__(self) -> tuple[tuple[T, ...], Callable[[], str]]:
        """Return what a copy is made of."""
        return tuple(self), self._view

    def _repr_html_(self) -> str:
        return self._view()
