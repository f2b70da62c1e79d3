"""Random choices that are the same for the same seed, on every machine and with every version of Python."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import TypeVar

from lagrangian.errors import ModelError

T = TypeVar("T")

MAX_SEED = 2**63
"""The largest seed."""


class Dice:
    """Choices from one seed; only `random.Random.random` is used, which Python promises not to change."""

    def __init__(self, *seeds: int) -> None:
        self._random = random.Random(":".join(map(str, seeds)))

    def chance(self, probability: float) -> bool:
        """Return True with the given probability."""
        return self._random.random() < probability

    def one(self, items: Sequence[T]) -> T:
        """Return one of the items, each with the same probability."""
        return items[int(self._random.random() * len(items))]

    def shuffled(self, items: Sequence[T]) -> list[T]:
        """Return the items in random order."""
        left, found = list(items), []
        while left:
            found.append(left.pop(int(self._random.random() * len(left))))
        return found


def checked_seed(seed: object) -> int:
    """Return a seed; raises `ModelError` if it is not a whole number, at least 0."""
    if isinstance(seed, bool) or not isinstance(seed, int) or not 0 <= seed < MAX_SEED:
        raise ModelError(f"a seed is a number from 0 (got {seed!r:.40})", fix="seed=1", code="E406")
    return seed
