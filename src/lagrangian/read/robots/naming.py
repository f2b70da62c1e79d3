"""Identifiers for the names of a robot's file, each of them once, and what became of names that are none."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from itertools import chain, count

from lagrangian.model.names import RESERVED
from lagrangian.read.letters import spelled, twin

LONGEST = 48
"""The largest length of an identifier made from a name; prefixes such as ``Ixx_`` come on top of it."""


class Identifiers:
    """The names given so far, and ``changed``: those of the file that had to be changed, with what they became."""

    def __init__(self) -> None:
        self._taken = {form for name in ("origin", "g", *RESERVED) for form in _forms(name)}
        self.changed: dict[str, str] = {}
        self._given: dict[str, str] = {}

    def known(self, name: str) -> str:
        """The identifier that a name of the file was given, for the names of what belongs to it."""
        return self._given.get(name) or identifier(name)

    def unused(self, name: str) -> str:
        """The name if it is free, or nothing."""
        return "" if self._taken & _forms(name) else name

    def reserve(self, *names: str) -> None:
        """Keep names for something else."""
        for name in names:
            self._taken.update(_forms(name))

    def of(self, name: str, *, also: str = "", ends: Sequence[str] = ("",)) -> str:
        """An identifier for a name of the file; ``also`` is appended if the name is taken by another thing.

        With each of ``ends`` it makes names, which are free, too.
        """
        base = identifier(name)
        made = self.free(base, base + also if also else "", ends=ends)
        self._given[name] = made
        if made != name:
            self.changed[name] = made
        return made

    def free(self, *wanted: str, ends: Sequence[str] = ("",)) -> str:
        """The first of these names that is free with each of ``ends``, or the last of them with a number."""
        tries = [name for name in wanted if name]
        numbered = (f"{tries[-1]}_{number}" for number in count(2))
        name = next(
            name for name in chain(tries, numbered) if not any(self._taken & _forms(name + end) for end in ends)
        )
        self.reserve(*(name + end for end in ends))
        return name


def identifier(name: str) -> str:
    """A name made of letters, digits and underscores: ``left-arm 2`` → ``left_arm_2``, ``2nd`` → ``_2nd``."""
    text = re.sub(r"\W+", "_", unicodedata.normalize("NFKC", name.strip()))
    text = text if text.strip("_") else "part"
    return (f"_{text}" if text[0].isdigit() else text)[:LONGEST]


def _forms(name: str) -> set[str]:
    """The spellings that look alike: names that share one are not told apart."""
    return {spelled(name), twin(name)}
