"""Random states to compare residuals at, and the comparison."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator

from kane_route import Residual, State


def states(
    coordinates: Iterable[str], parameters: Iterable[str], inputs: Iterable[str], *, count: int = 20, seed: int = 1
) -> Iterator[State]:
    """States of order one: angles and places from −2 to 2, parameters positive, every number its own."""
    pick = random.Random(seed)
    names, constants, signals = list(coordinates), list(parameters), list(inputs)
    for _ in range(count):
        q, v, a = ({n: pick.uniform(-2, 2) for n in names} for _ in range(3))
        p = {n: pick.uniform(0.3, 2.5) for n in constants}
        yield State(q, v, a, p, {n: pick.uniform(-3, 3) for n in signals}, pick.uniform(0, 3))


def worst(one: Residual, other: Residual, at: Iterable[State]) -> float:
    """The largest difference of two residuals, row by row, relative to the size of the rows."""
    largest = 0.0
    for state in at:
        ours, theirs = one(state), other(state)
        assert len(ours) == len(theirs)
        size = max(abs(x) for x in theirs)
        for x, y in zip(ours, theirs, strict=True):
            largest = max(largest, abs(x - y) / max(abs(y), 1e-3 * size))
    return largest
