"""Jobs, and the arguments of a request, checked: names, kinds and sizes."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from typing import Any, TypeAlias

from lagrangian.errors import Error, did_you_mean

MAX_ENTRIES = 1000
"""The largest number of entries in a mapping or list of a request."""

MAX_NAME = 200
"""The largest number of characters of a name."""


Part: TypeAlias = Callable[[Any], None]
"""What a job calls with each part of its answer that is ready early."""

Task: TypeAlias = Callable[[dict[str, Any], Part], Any]
"""A job: takes the arguments of a request, and returns what can be written as JSON."""


class LargeModel(Error):
    """A model that is derived only if that is asked for expressly."""

    anyway = True


class Arguments:
    """The arguments of one request; every kind of value has a method."""

    def __init__(self, given: Mapping[str, Any], known: Collection[str]) -> None:
        for name in given:
            if name not in known:
                fix = did_you_mean(name[:64], list(known)) or f"known: {', '.join(known)}"
                raise Error(f"unknown argument '{name[:64]}'", fix=fix, code="E405")
        self._given = given

    def text(self, name: str, default: str | None = None) -> str:
        """Return a text."""
        value = self._given.get(name, default)
        if value is None:
            raise Error(f"the argument '{name}' is missing", fix=f'"{name}": "…"', code="E401")
        if not isinstance(value, str):
            raise self._wrong(name, "a text")
        return value

    def title(self, name: str, default: str) -> str:
        """Return a short text in one line, such as the name of a file."""
        return " ".join(self.text(name, default).split())[:MAX_NAME] or default

    def truth(self, name: str) -> bool:
        """Return true or false; false if it is missing."""
        value = self._given.get(name, False)
        if not isinstance(value, bool):
            raise self._wrong(name, "true or false")
        return value

    def whole(self, name: str, default: int, least: int, most: int) -> int:
        """Return a whole number from ``least`` to ``most``."""
        value = self._given.get(name, default)
        if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
            raise self._wrong(name, f"a whole number from {least} to {most}")
        return value

    def value(self, name: str) -> float | str | None:
        """Return a number, or a text such as "10 s"; None if it is missing."""
        value = self._given.get(name)
        if value is None or _is_value(value):
            return value
        raise self._wrong(name, 'a number or a text such as "10 s"')

    def values(self, name: str) -> dict[str, float | str]:
        """Return a mapping from names to numbers or texts; empty if it is missing."""
        found = self._given.get(name, {})
        if not isinstance(found, dict) or len(found) > MAX_ENTRIES or not all(map(_is_value, found.values())):
            raise self._wrong(name, 'numbers or texts by name: {"m": 2, "k": "40 N/m"}')
        return found

    def tables(self, name: str, least: int, most: int) -> list[dict[str, Any]]:
        """Return a list of mappings."""
        found = self._given.get(name)
        if not isinstance(found, list) or not least <= len(found) <= most:
            raise self._wrong(name, f"a list of {least} to {most} entries")
        if not all(isinstance(entry, dict) for entry in found):
            raise self._wrong(name, "a list of objects")
        return found

    def texts(self, name: str, most: int) -> list[str]:
        """Return a list of texts; empty if it is missing."""
        found = self._given.get(name, [])
        if not isinstance(found, list) or len(found) > most or not all(isinstance(x, str) for x in found):
            raise self._wrong(name, f"a list of at most {most} texts")
        return found

    def number(self, name: str) -> float:
        """Return a finite number."""
        value = self._given.get(name)
        if not isinstance(value, (int, float)) or isinstance(value, bool) or not math.isfinite(value):
            raise self._wrong(name, "a finite number")
        return float(value)

    def _wrong(self, name: str, wanted: str) -> Error:
        kind = {dict: "an object", list: "a list", str: "a text", bool: "true or false", type(None): "nothing"}
        got = self._given.get(name)
        said = kind.get(type(got)) or str(got)[:40]
        return Error(f"the argument '{name}' must be {wanted} (got {said})", fix=f"give {wanted}", code="E406")


def _is_value(value: Any) -> bool:
    if isinstance(value, str):
        return True
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
