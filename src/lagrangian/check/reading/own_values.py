"""Records the values that an answer gives its own names, in their order, and which of them it uses."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


class OwnValues:
    """The values that an answer gives its own names, in their order, and which of them it uses."""

    def __init__(self) -> None:
        self._values: dict[str, list[tuple[int, Any]]] = {}
        self._used: set[tuple[str, int]] = set()
        self.rates: list[tuple[str, int, Any, int]] = []
        """The rates that statements give names: the name, the order, the value and the number of the statement."""

    def define(self, base: str, value: Any, statement: int) -> None:
        """Record that a statement gives a name its value."""
        self._values.setdefault(base, []).append((statement, value))

    def use(self, base: str) -> None:
        """Record that the value that a name has now is used."""
        self._used.add((base, len(self._values.get(base, ()))))

    @contextmanager
    def unrecorded(self) -> Iterator[None]:
        """While this lasts, looking at a value uses it not."""
        used = set(self._used)
        try:
            yield
        finally:
            self._used = used

    def unused(self) -> Iterator[tuple[str, int, Any, Any]]:
        """Each name that is used, with two values of which one is used nowhere: (name, statement, above, value)."""
        for base, given in self._values.items():
            for k in range(1, len(given)):
                if (base, k) in self._used and (base, k + 1) in self._used:
                    continue
                if not any((base, n) in self._used for n in range(1, len(given) + 1)):
                    continue
                (_, above), (at, value) = given[k - 1 : k + 1]
                yield base, at, above, value
