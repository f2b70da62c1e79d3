"""Computes many sums of products of coefficients at a time."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from lagrangian.codegen.ir import Function, Value

Maybe = Value | None  # a coefficient; None is 0
Side = Callable[[int], Maybe]  # index → coefficient


class Sums:
    """The inner sums ``Σ_{0<j<n} left_j right_{n−j}`` of many pairs of series.

    With several runs side by side, each sum is computed separately, lane by lane. With a single run, vectors hold as
    many sums as the machine has lanes, because the speed of such code is limited by the number of instructions.
    """

    def __init__(self, f: Function) -> None:
        self.f = f
        self.sides: list[tuple[Side, Side]] = []
        self.packed = f.lanes == 1 and f.module.target.lanes > 1
        self._vectors: dict[tuple[int, int, int], Value] = {}  # (first pair, side, index) → coefficients
        self._found: dict[int, Maybe] = {}

    def add(self, left: Side, right: Side) -> int:
        """Add a pair; return its number."""
        self.sides.append((left, right))
        return len(self.sides) - 1

    def begin(self, n: int) -> None:
        """Declare that all coefficients below n are known."""
        self._found.clear()
        if not self.packed or n < 2:
            return
        width = self.f.module.target.lanes
        wide = self.f.widened(width)
        for first in range(0, len(self.sides), width):
            group = range(first, min(first + width, len(self.sides)))
            old = range(2, n - 1)
            chains: list[Value | None] = [None, None]
            for k, j in enumerate([*old, *([1, n - 1] if n > 2 else [1])]):  # the newest coefficients last
                a, b = self._vector(wide, group, 0, j), self._vector(wide, group, 1, n - j)
                total = chains[k % 2]
                chains[k % 2] = a * b if total is None else wide.fma(a, b, total)
            total = chains[0] if chains[1] is None else _some(chains[0]) + chains[1]
            for lane, pair in enumerate(group):
                self._found[pair] = Value(self.f, wide.lane(_some(total), lane))

    def _vector(self, wide: Function, group: range, side: int, j: int) -> Value:
        """Coefficient j of one side of a group of pairs."""
        key = (group.start, side, j)
        if key not in self._vectors:
            zero = self.f.constant(0.0)
            given = [self.sides[pair][side](j) for pair in group]
            names = [zero if x is None else x.name for x in given]
            self._vectors[key] = wide.gathered(names + [zero] * (wide.lanes - len(names)))
        return self._vectors[key]

    def inner(self, pair: int, n: int) -> Maybe:
        """The sum of a pair."""
        if n < 2:
            return None
        if not self.packed:
            left, right = self.sides[pair]
            return _dot(self.f, [(left(j), right(n - j)) for j in range(1, n)])
        return self._found[pair]


def _dot(f: Function, pairs: Sequence[tuple[Maybe, Maybe]]) -> Maybe:
    """Σ a b without zero terms, in two chains that overlap."""
    chains: list[Maybe] = [None, None]
    kept = [(a, b) for a, b in pairs if a is not None and b is not None]
    for k, (a, b) in enumerate(kept):
        total = chains[k % 2]
        chains[k % 2] = a * b if total is None else f.fma(a, b, total)
    first, second = chains
    return first if second is None else _some(first) + second


def _some(x: Maybe) -> Value:
    assert x is not None
    return x
