"""The rigid parts of a moving system and the joints that hold them, read from its points and frames.

Places that keep their distances in the same axes belong to one part. A part is held where its first place, its
*anchor*, meets the part that carries it: a pin where the anchor belongs to the carrier, a slider or a free place where
the anchor moves by itself.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from typing import Any, NamedTuple

from lagrangian.dynamics.axes import Axes, PlaceMotion
from lagrangian.dynamics.description import Description
from lagrangian.dynamics.vectors import Vector, times
from lagrangian.model import Frame


class RigidPart(NamedTuple):
    """A rigid part: what tells its axes from others, and its anchor."""

    turning: Hashable
    anchor: PlaceMotion


class Parts:
    """The parts of a description, and the joints between them."""

    def __init__(self, d: Description) -> None:
        self.d, self.motion = d, d.motion
        self._turning: dict[Axes, Hashable] = {}
        self.axes: dict[Hashable, Axes] = {}
        self.ground = RigidPart(self.turning(self.motion.root), self.motion.ground)
        self.bodies = {body.name: self.of_body(body) for body in d.model.bodies}
        self.natives = {place: self.native(place) for place in self.motion.places}
        self.known = {self.ground, *self.bodies.values(), *self.natives.values()}

    def turning(self, axes: Axes) -> Hashable:
        """What axes have in common that turn alike: in the plane their rate, in space the turns from the root."""
        found = self._turning.get(axes)
        if found is None:
            if self.motion.dimension == 2:
                found = axes.own[0]
            else:
                home = self.motion.base(axes)[0]
                turn = tuple(x for row in home.turn for x in row)
                found = ("root",) if home.parent is None else (self.turning(home.parent), turn)
            self._turning[axes] = found
            self.axes.setdefault(found, axes)
        return found

    def _step(self, place: PlaceMotion) -> tuple[Axes, Vector]:
        """The axes in which a place was measured from its parent, and the step in them."""
        if self.motion.dimension == 2:
            assert place.given is not None
            return place.given
        home, turn = self.motion.base(place.axes)
        return home, times(self.motion.graph, turn, place.offset)

    def anchor(self, place: PlaceMotion, turning: Hashable) -> PlaceMotion:
        """The farthest place above that keeps its distance from a place in given axes."""
        while place.parent is not None and place.slide is None:
            home, step = self._step(place)
            if self.turning(home) != turning or not self.motion.constant(step):
                break
            place = place.parent
        return place

    def native(self, place: PlaceMotion) -> RigidPart:
        """The part that a place belongs to."""
        if place.parent is None:
            return self.ground
        axes = place.axes if place.slide is not None else self._step(place)[0]
        turning = self.turning(axes)
        return RigidPart(turning, self.anchor(place, turning))

    def of_body(self, body: Any) -> RigidPart:
        """The part of a body; a point mass belongs to its place."""
        place = self.d.places[body.at]
        frame = getattr(body, "frame", None)
        if frame is None:
            return self.native(place)
        turning = self.turning(self.d.axes[frame])
        return RigidPart(turning, self.anchor(place, turning))

    def of_frame(self, frame: Frame) -> RigidPart:
        """The part that turns with a frame: that of its first body, else that of its origin."""
        for body in self.d.model.bodies:
            if getattr(body, "frame", None) is frame:
                return self.bodies[body.name]
        turning = self.turning(self.d.axes[frame])
        place = self.d.places.get(frame.origin, self.motion.ground)
        return RigidPart(turning, self.anchor(place, turning))

    def carrier(self, part: RigidPart) -> RigidPart | None:
        """The part that a part hangs on; None for the ground."""
        at, turning = part.anchor, part.turning
        if part == self.ground:
            return None
        if self.natives[at] == part:  # its anchor moves by itself
            if at.parent is None or at.slide is not None:
                return self.ground
            rail = RigidPart(turning, self.anchor(at.parent, turning))
            return rail if rail != part and rail in self.known else self.natives[at.parent]
        axes = self.axes[turning].parent
        while axes is not None and self.turning(axes) != self.natives[at].turning:
            held = RigidPart(self.turning(axes), self.anchor(at, self.turning(axes)))
            if held != part and held in self.known:
                return held
            axes = axes.parent
        return self.natives[at]

    def chain(self, part: RigidPart) -> Iterator[RigidPart]:
        """A part, what carries it, and so on down to the ground."""
        seen: set[RigidPart] = set()
        at: RigidPart | None = part
        while at is not None and at not in seen:
            seen.add(at)
            yield at
            at = self.carrier(at)

    def outer(self, part: RigidPart) -> set[RigidPart]:
        """A part and everything that hangs on it."""
        return {other for other in self.known if part in self.chain(other)}

    def same_place(self, place: PlaceMotion) -> PlaceMotion:
        """The first of the places that lie on each other."""
        zero = self.motion.graph.zero
        while place.parent is not None and place.slide is None and all(x == zero for x in place.offset):
            place = place.parent
        return place

    def held_at(self, place: PlaceMotion) -> list[RigidPart]:
        """The parts with mass, or with something that has mass hanging on them, that are held at a place."""
        here = self.same_place(place)
        heavy = {p for part in self.bodies.values() for p in self.chain(part)} - {self.ground}
        found = [part for part in self.known if part in heavy and self.same_place(part.anchor) is here]
        return sorted(found, key=lambda part: self.label(part))

    def names(self, part: RigidPart) -> list[str]:
        """The bodies that are a part."""
        return [name for name, own in self.bodies.items() if own == part]

    def label(self, part: RigidPart) -> str:
        """A part by the names of its bodies, or of what hangs on it."""
        if part == self.ground:
            return "the ground"
        own = self.names(part)
        if own:
            return " and ".join(f"'{name}'" for name in own)
        hung = [name for name, other in self.bodies.items() if part in self.chain(other)]
        return "what carries " + " and ".join(f"'{name}'" for name in hung) if hung else "a part without mass"
