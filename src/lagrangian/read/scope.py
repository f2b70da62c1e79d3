"""The names that an expression may use, in any spelling."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import lru_cache

import sympy as sp

from lagrangian.errors import did_you_mean
from lagrangian.read.letters import foreign, key, normal, spelled, twin, undotted

_RATE_SUFFIXES = (
    ("_dot_dot", 2),
    ("dotdot", 2),
    ("_ddot", 2),
    ("_dot", 1),
    ("ddot", 2),
    ("dot", 1),
    ("_dd", 2),
    ("_d", 1),
)
_RATE_PREFIXES = (("dd", 2), ("d", 1))


class Scope(Mapping[str, sp.Basic]):
    """Names with their SymPy objects; a name is found in any of its spellings (`lagrangian.read.letters`)."""

    def __init__(self, names: Mapping[str, sp.Basic] | None = None) -> None:
        self._names: dict[str, sp.Basic] = {}
        self._by_key: dict[str, list[str]] = {}
        for name, value in (names or {}).items():
            self.add(name, value)

    def add(self, name: str, value: sp.Basic) -> None:
        """Add a name, or give it a new meaning."""
        name = normal(name)
        if name not in self._names:
            self._by_key.setdefault(key(name), []).append(name)
        self._names[name] = value

    def extended(self, names: Mapping[str, sp.Basic]) -> Scope:
        """Return a copy with more names."""
        return Scope({**self._names, **names})

    def __getitem__(self, name: str) -> sp.Basic:
        return self._names[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def meanings(self, written: str) -> tuple[list[str], int]:
        """Return the names that ``written`` can mean (none, one, or several) and its number of dots."""
        name = normal(written)
        if name in self._names:
            return [name], 0
        base, dots = undotted(written)
        if dots and base in self._names:
            return [base], dots
        found = self._by_key.get(key(base), [])
        same = [n for n in found if spelled(n) == spelled(base)]
        return (same if len(same) == 1 else list(found)), dots

    def hint(self, written: str) -> str | None:
        """Return a suggestion for an unknown name."""
        base, _ = undotted(written)
        for order, stem in rate_stems(base):
            if stem in self._names:
                return f"write {stem}{chr(39) * order} for the {'rate' if order == 1 else 'acceleration'} of {stem}"
        if base == "e":
            return "write exp(x) for e^x"
        if (odd := foreign(base)) is not None:
            latin = twin(base)
            if latin in self._names:
                return f"{odd}; write '{latin}' in Latin letters"
        return did_you_mean(base, self._names) or did_you_mean(spelled(base), self._names)


def rate_stems(name: str) -> tuple[tuple[int, str], ...]:
    """Return the orders and names that a spelled-out derivative can mean: ``x1_ddot`` is the acceleration of ``x1``."""
    return _rate_stems(str(name))


@lru_cache(maxsize=4_096)
def _rate_stems(name: str) -> tuple[tuple[int, str], ...]:
    return tuple(_found_rate_stems(name))


def _found_rate_stems(name: str) -> Iterator[tuple[int, str]]:
    for suffix, order in _RATE_SUFFIXES:
        if name.endswith(suffix) and len(name) > len(suffix):
            yield order, name.removesuffix(suffix)
    if (found := re.search(r"_?(d|dot_?)?dot_?", name)) is not None:  # theta_dot_1, thetaddot1
        for stem in (name[: found.start()] + name[found.end() :], name[: found.start()] + "_" + name[found.end() :]):
            yield 2 if found.group(1) else 1, stem
    for prefix, order in _RATE_PREFIXES:
        if name.startswith(prefix) and len(name) > len(prefix):
            yield order, name.removeprefix(prefix).removeprefix("_")
