"""The names of quantities: a letter for what it is, an index for what it belongs to, and its component.

A frame has the number of the coordinate that turns it, otherwise its own name. A body has the index of its frame; a
point keeps its name, and a joint, the origin of frame k, is O_k. Names of the system come first: where a symbol of the
system has a name already, its index ends with “own”.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from lagrangian.dynamics.axes import Axes, PlaceMotion
from lagrangian.dynamics.description import Description
from lagrangian.model import Model

COMPONENTS = ("x", "y", "z")
_DIGITS = re.compile(r"[^\W\d_]+_?(\d+)\Z")


def number_of(name: str) -> str:
    """The number at the end of a coordinate's name, otherwise the name itself."""
    found = _DIGITS.match(name)
    return found.group(1) if found else name


def component(k: int, index: str) -> tuple[str, ...]:
    """The parts of the index of a component: of x in v_x3, and of x and phi in v_x,phi."""
    return (f"{COMPONENTS[k]}{index}",) if index[:1].isdigit() else (COMPONENTS[k], index)


class Indices:
    """What the quantities of a description belong to: an index for all axes and places."""

    def __init__(self, d: Description) -> None:
        self.d = d
        model = d.model
        numbers = [number_of(c.name) for c in model.coordinates]
        self.coordinates = {
            c.symbol: n if numbers.count(n) == 1 else c.name for c, n in zip(model.coordinates, numbers, strict=True)
        }
        self._taken: set[str] = set()
        self.axes: dict[Axes, str] = {}
        for frame, axes in d.axes.items():
            self.axes.setdefault(axes, self._free(self._frame(model, frame)))
        self.places: dict[PlaceMotion, str] = {}
        self._place_points()
        for place, index in self.places.items():  # axes that carry a point without having been described
            if place.given is not None and place.given[0] is not d.motion.root and place.given[0] not in self.axes:
                self.axes[place.given[0]] = self._free(index)

    def _frame(self, model: Model, frame: object) -> str:
        angle = getattr(frame, "angle", None)
        turned_by = [c.symbol for c in model.coordinates if angle is not None and model.expand(angle).has(c.symbol)]
        if len(turned_by) == 1:
            return self.coordinates[turned_by[0]]
        name = getattr(frame, "name", None)
        return str(name) if name else str(len(self.axes) + 1)

    def _place_points(self) -> None:
        motion, model = self.d.motion, self.d.model
        origins = {self.d.places.get(frame.origin): axes for frame, axes in self.d.axes.items() if frame.origin}
        bodies: dict[PlaceMotion, str] = {}
        for body in model.bodies:
            place, frame = self.d.places[body.at], getattr(body, "frame", None)
            index = self.axes.get(self.d.axes[frame]) if frame is not None else None
            bodies.setdefault(place, index or _after_mass(body.mass) or body.name)
        named = {place: point.name for point, place in self.d.places.items() if point.name}
        for place in motion.places[1:]:
            if place in bodies:
                index = bodies[place]
            elif place in named:
                index = str(named[place])
            elif place in origins:
                index = f"O{self.axes[origins[place]]}"
            else:
                index = f"P{len(self.places) + 1}"
            while index in self.places.values():
                index += "a"
            self.places[place] = index

    def _free(self, index: str) -> str:
        while index in self._taken:
            index += "a"
        self._taken.add(index)
        return index


def _after_mass(mass: object) -> str:
    """The number of a mass: 3 of m3."""
    name = getattr(mass, "name", "")
    return number_of(name) if name and number_of(name) != name else ""


class FreeNames:
    """Names that are free: none is given twice, and none that the system has."""

    def __init__(self, taken: Iterable[str]) -> None:
        self._taken = set(taken)

    def take(self, base: str, *parts: str, last: str = "") -> str:
        """A name made of a letter and the parts of its index; "own" is added to the index until the name is free.

        ``last`` ends the name. Names are such that Python could have them, although names of elements may have spaces.
        """
        index = [part for p in parts if (part := re.sub(r"\W+", "", p))]
        while (name := "_".join([base, *index, *([last] if last else [])])) in self._taken:
            index.append("own")
        self._taken.add(name)
        return name
