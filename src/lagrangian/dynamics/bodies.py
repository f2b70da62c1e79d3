"""Combines bodies to links, in every way that may be the cheapest.

Rigidly connected bodies form one link. Mass that a turn does not affect, because it is on the axis of the turn, may be
moved to the parent. The equations stay the same, but contain fewer numbers.
"""

from __future__ import annotations

from lagrangian.dynamics.axes import Axes, PlaceMotion
from lagrangian.dynamics.inertia import AnyLink, Inertia, Link, PlaneLink
from lagrangian.dynamics.motion import Motion
from lagrangian.dynamics.vectors import Matrix, Vector, plus, scaled, zeros

Plane = dict[tuple[Axes, PlaceMotion], PlaneLink]


class Bodies:
    """The mass of a motion. ``links`` are the bodies as described; `groupings` are equivalent arrangements."""

    def __init__(self, motion: Motion) -> None:
        self.motion = motion
        self._space: dict[tuple[Axes, PlaceMotion], Inertia] = {}
        self._plane: Plane = {}
        self._points: list[tuple[PlaceMotion, int]] = []

    def add_in_plane(self, axes: Axes, place: PlaceMotion, m: int, J: int) -> None:
        """Add a body in the plane: mass m, inertia J about its centre ``place``, turning with ``axes``."""
        self._put_in_plane(self._plane, axes, place, m, J)

    def add(self, axes: Axes, place: PlaceMotion, m: int, central: Matrix) -> None:
        """Add a body in space: mass m, centre of mass at ``place``, inertia ``central`` about it in ``axes``."""
        motion, g = self.motion, self.motion.graph
        home, turn = motion.base(axes)
        anchor, r = motion.anchor(place, home)
        matter = Inertia.of_body(g, m, zeros(g, 3), central).turned(g, turn).shifted(g, r)
        old = self._space.get((home, anchor))
        self._space[home, anchor] = matter if old is None else old.plus(g, matter)

    def add_point(self, place: PlaceMotion, m: int) -> None:
        """Add a point mass."""
        if self.motion.dimension == 2:
            self._points.append((place, m))
        else:
            self.add(place.axes, place, m, [zeros(self.motion.graph, 3) for _ in range(3)])

    def _put_in_plane(self, plane: Plane, axes: Axes, place: PlaceMotion, m: int, J: int) -> None:
        g = self.motion.graph
        anchor, r = self.motion.anchor(place, axes)
        h = scaled(g, m, r)
        about = g.add(J, g.add(g.mul(h[0], r[0]), g.mul(h[1], r[1])))
        old = plane.get((axes, anchor)) or PlaneLink(axes, anchor, g.zero, zeros(g, 2), g.zero)
        plane[axes, anchor] = old.plus(g, m, h, about)

    @property
    def links(self) -> list[AnyLink]:
        """The bodies as described, with point masses at their places."""
        space: list[AnyLink] = [Link(axes, place, matter) for (axes, place), matter in self._space.items()]
        plane = dict(self._plane)
        for place, m in self._points:
            self._put_in_plane(plane, self.motion.root, place, m, self.motion.graph.zero)
        return [*space, *plane.values()]

    @property
    def point_masses(self) -> dict[PlaceMotion, int]:
        """The mass at every place, if all bodies are point masses in the plane; else none."""
        g, found = self.motion.graph, dict[PlaceMotion, int]()
        for place, m in self._points if not (self._space or self._plane) else ():
            found[place] = g.add(found.get(place, g.zero), m)
        return found

    def groupings(self) -> list[list[AnyLink]]:
        """The arrangements that are worth counting."""
        if self.motion.dimension == 3:
            return [self._needles_moved()]
        swung = dict(self._plane)
        for place, m in self._points:
            axes = place.given[0] if place.given is not None else self.motion.root
            self._put_in_plane(swung, axes, place, m, self.motion.graph.zero)
        return [self.links, list(swung.values()), self._centres_moved(swung)]

    def _needles_moved(self) -> list[AnyLink]:
        """In space a turn about axis k does not affect m, h_k and Σ_kk: a needle of mass on the axis.

        Starting with the outermost link, it is moved to the link that carries the place on the axis.
        """
        motion, g = self.motion, self.motion.graph
        kept = dict(self._space)
        for axes in reversed(motion.axes):
            k = axes.axis
            if k is None or axes.parent is None:
                continue
            home, turn = motion.base(axes.parent)
            for place in [place for at, place in kept if at is axes]:
                if place.slide is not None or motion.base(place.axes)[0] is axes:
                    continue  # the place is not on the axis
                matter = kept[axes, place]
                needle, rest = Inertia.none(g), Inertia(g.zero, list(matter.h), [list(row) for row in matter.S])
                needle.m, needle.h[k], needle.S[k][k] = matter.m, matter.h[k], matter.S[k][k]
                rest.h[k] = rest.S[k][k] = g.zero
                kept[axes, place] = rest
                anchor, r = motion.anchor(place, home)
                if home is motion.root and anchor is motion.ground:
                    continue  # the ground carries it
                moved = needle.turned(g, turn).shifted(g, r)
                old = kept.get((home, anchor))
                kept[home, anchor] = moved if old is None else old.plus(g, moved)
        return [Link(axes, place, matter) for (axes, place), matter in kept.items()]

    def _centres_moved(self, links: Plane) -> list[AnyLink]:
        """In the plane a turn about a place does not affect m: the mass is moved to the link that carries the place."""
        motion, g = self.motion, self.motion.graph
        kept = dict(links)
        number = {place: n for n, place in enumerate(motion.places)}
        waiting = sorted({place for _, place in kept}, key=lambda place: number[place])
        while waiting:
            place = waiting.pop()
            if place is motion.ground or place.given is None:
                continue
            carrier = place.given[0]
            for axes in [axes for axes, at in kept if at is place and axes is not carrier]:
                link = kept[axes, place]
                kept[axes, place] = PlaneLink(axes, place, g.zero, link.h, link.J)
                anchor, r = motion.anchor(place, carrier)
                self._put_moved(kept, carrier, anchor, link.m, r)
                if anchor is not place and anchor not in waiting:
                    waiting = sorted({*waiting, anchor}, key=lambda at: number[at])
        return [link for link in kept.values() if {link.m, *link.h, link.J} != {g.zero}]

    def _put_moved(self, kept: Plane, axes: Axes, anchor: PlaceMotion, m: int, r: Vector) -> None:
        g = self.motion.graph
        h = scaled(g, m, r)
        old = kept.get((axes, anchor)) or PlaneLink(axes, anchor, g.zero, zeros(g, 2), g.zero)
        kept[axes, anchor] = old.plus(g, m, h, plus(g, [g.mul(h[0], r[0])], [g.mul(h[1], r[1])])[0])
