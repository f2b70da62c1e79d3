"""Lists what a robot's file has besides mechanics, so that nothing is left out in silence."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.read.robots.markup import Tag

NAMED = frozenset({"name"})
"""Attributes that say nothing of the mechanics."""


def left_out(root: Tag) -> Iterator[str]:
    """The elements and attributes that were not asked for, with how many there are and the line of the first."""
    found: dict[str, list[int]] = {}
    _collect(root, found)
    for what, lines in found.items():
        where = f"line {lines[0]}" if len(lines) == 1 else f"{len(lines)} times, first in line {lines[0]}"
        yield f"{what} ({where})"


def _collect(root: Tag, found: dict[str, list[int]]) -> None:
    waiting = [root]
    for tag in waiting:
        if not tag.read:
            found.setdefault(f"<{tag.name[:40]}>", []).append(tag.place.line or 0)
            continue
        for key in tag.attributes:
            if key not in tag.seen | NAMED and not key.startswith("xmlns"):
                found.setdefault(f"'{key[:40]}' of <{tag.name[:40]}>", []).append(tag.place.line or 0)
        waiting.extend(tag.children)
