"""Which statement defines a name that several give a value: none that leads back to the name, if there is another.

S1 = (P − A)/2, S2 = (P + A)/2, P = S1 + S2, P = m g − m y''      P is m g − m y'', and the sum is compared with it
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from lark import Tree

from lagrangian.check.reading.nodes import names_in
from lagrangian.read.letters import key, undotted

MOST = 60
"""The most names that are followed."""


def first_without_circles(
    listed: Iterable[tuple[object, int]], sides: Callable[[int], Sequence[Tree]]
) -> dict[str, int]:
    """The statement that defines each name: the first one that is ``listed`` for it and does not lead back to it.

    ``sides`` are those of a statement that say what its name is. Where all lead back, the first one counts.
    """
    given: dict[str, dict[int, None]] = {}
    for written, at in listed:
        given.setdefault(key(undotted(str(written))[0]), {})[at] = None
    first = {name: next(iter(places)) for name, places in given.items()}

    def uses(at: int) -> set[str]:
        return {key(undotted(str(x))[0]) for side in sides(at) for x, _ in names_in(side)}

    def leads_back(name: str, at: int) -> bool:
        seen, left = set[str](), list(uses(at) - {name})
        while left and len(seen) < MOST:
            other = left.pop()
            if other in seen or other not in first:
                continue
            seen.add(other)
            used = uses(first[other])
            if name in used:
                return True
            left += used
        return False

    for name, places in given.items():
        if len(places) > 1:
            first[name] = next((at for at in places if not leads_back(name, at)), first[name])
    return first
