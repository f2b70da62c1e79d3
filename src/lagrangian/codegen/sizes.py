"""The sizes of the blocks of a kernel, and the operands of an array in machine code."""

from __future__ import annotations

from lagrangian.records import dataclass

Array = tuple[str, str, str]
"""Operands of an array: address, stride from state to state, stride from entry to entry."""


@dataclass(frozen=True)
class Sizes:
    """The numbers of values in the blocks.

    Inputs by group, hoisted inputs by group, shared slots, outputs by array, scratch.
    """

    groups: tuple[int, ...]
    hoisted: tuple[int, ...]
    shared: int
    outputs: tuple[int, ...]
    scratch: int

    def work(self, lanes: int, own_shared: bool) -> int:
        """The number of doubles of work space that ``batch`` needs, with its blocks one after another."""
        blocks = sum(self.groups) + sum(self.outputs) + self.scratch
        if own_shared:
            blocks += sum(self.hoisted) + self.shared
        return lanes * max(1, blocks)
