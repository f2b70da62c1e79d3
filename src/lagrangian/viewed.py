"""Tuples that a notebook shows as a table."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Generic, TypeVar

T = TypeVar("T")


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
