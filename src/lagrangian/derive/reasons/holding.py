"""What holds a body: one holder, with the bodies at its ends."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal, TypeAlias

from lagrangian.derive.algebra import Form
from lagrangian.derive.reasons.motion import Column
from lagrangian.model import Body, Element, Point, Words
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

HoldKind: TypeAlias = Literal["rod", "pin", "track", "rolling", "tie", "lever", "constraint", "unknown"]


@dataclass(frozen=True, eq=False)
class Holding(Brief):
    """What holds a body: its kind, and in words the thing at the other end.

    ``carrier`` is the body that holds it, None for the ground or a support; ``at`` the point of a pin or the pivot of a
    rod. ``along`` is the unit vector of a rod from there to the body, or the normal of a track in the plane, else
    empty. A "tie" leaves the body, and ``others`` with it, fewer ways to move than all other holders; a "lever" is a
    tie of bodies that stay in one line; a "constraint" is an ``element``. ``branch`` are the bodies whose constraint
    forces add up to the force of this holder, itself and all that hang on it, empty where it cannot be told from other
    forces. ``force`` is then the pull of the rod, or the push of the track along the normal.
    """

    body: Body
    kind: HoldKind
    on: Words = ()
    carrier: Body | None = None
    along: Column = ()
    at: Point | None = None
    others: tuple[Body, ...] = ()
    element: Element | None = None
    branch: tuple[Body, ...] = ()
    force: Form | None = None

    @property
    def bodies(self) -> tuple[Body, ...]:
        """All bodies that it acts on; their constraint forces contain it."""
        return (self.body, *((self.carrier,) if self.carrier is not None else ()), *self.others)

    @property
    def named(self) -> bool:
        """Whether its force has a letter."""
        return self.force is not None and not self.force.is_zero


def carried_by(found: Iterable[Holding], body: Body) -> tuple[Body, ...]:
    """The body itself and all bodies that hang on it."""
    listed, mine = list(found), [body]
    for b in mine:
        mine += [h.body for h in listed if h.carrier is b and h.body not in mine]
    return tuple(mine)
