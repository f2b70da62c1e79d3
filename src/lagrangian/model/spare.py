"""Rows of constraints that follow from others along a motion, although not in every position."""

from __future__ import annotations

from lagrangian.records import dataclass


@dataclass(frozen=True)
class SpareRows:
    """A set of rows, by name, of which ``count`` follow from the others along the motion."""

    names: tuple[str, ...]
    count: int
