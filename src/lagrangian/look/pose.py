"""The pose in which a system is drawn: angles that can be told apart, and lengths that show how things are held."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Mapping
from math import pi

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.assembly.assemble import seen_position
from lagrangian.errors import RunError
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.model import Spring
from lagrangian.values.values import Given

Array = NDArray[np.float64]

FIRST, RELATIVE, STEP = 32 * pi / 180, 35 * pi / 180, 26 * pi / 180
"""The first angle, angles counted from another body, and by how much an absolute angle exceeds the one before it."""

SPAN = 130 * pi / 180, 210 * pi / 180
"""How far absolute angles and relative ones turn in all at most: more of them take smaller steps, so that no long chain
is drawn as a coil."""

SMALL = 7 * pi / 180
"""The angle of a body on springs."""

STRETCHED = 1.15
"""The length of a spring that is drawn, relative to its rest length."""


class Pose:
    """The coordinates in which a system is drawn.

    ``q`` are the values, with 0 for those in ``slides``, which are set in pixels when the scale is known. ``angles``
    are the coordinates that turn something.
    """

    def __init__(self, motions: Motions, p: Array, asked: Mapping[str, float]) -> None:
        self.motions, self.stage, self.p = motions, motions.stage, p
        self.names = [c.name for c in self.stage.model.coordinates]
        self.asked = dict(asked)
        initial = dict(self.stage.model.settings.get("initial") or {})
        self.start = Given.of(self.stage.model, self.stage.program(())).states.values(initial) if initial else {}
        self.slides = [i for i in range(len(self.names)) if self._slides(i)]
        self.angles = [i for i in range(len(self.names)) if i not in self.slides and self._turns(i)]
        self.q = self._chosen()

    # -- which ----------------------------------------------------------------------------------------------------

    def _slides(self, i: int) -> bool:
        """Whether a coordinate moves something along a line in proportion, and is no telescope's or track's length."""
        holds = self.motions.holds
        if any(h.along == i and h.how in (HoldKind.TELESCOPE, HoldKind.TRACK, HoldKind.WIRE) for h in holds):
            return False
        even = self.motions.even
        return any(h.how is HoldKind.SLIDE and i in h.moving and even(h.point, h.holder, i) for h in holds)

    def _turns(self, i: int) -> bool:
        """Whether a coordinate turns a frame, a rod or a telescope."""
        lengths = (HoldKind.TELESCOPE, HoldKind.TRACK, HoldKind.WIRE)
        if any(h.along == i and h.how in lengths for h in self.motions.holds):
            return False
        if any(i in self.motions.turns(k) for k in range(len(self.stage.frames))):
            return True
        return any(
            i in h.moving and i != h.along and h.how in (HoldKind.ROD, HoldKind.TELESCOPE, HoldKind.TRACK)
            for h in self.motions.holds
        )

    def _alone(self, i: int) -> bool:
        """Whether something is turned by this angle and no other: then the angle is absolute."""
        others = set(self.angles) - {i}
        for k in range(len(self.stage.frames)):
            turning = set(self.motions.turns(k))
            if i in turning and not turning & others:
                return True
        return any(
            i in h.moving and i != h.along and not set(h.moving) & others
            for h in self.motions.holds
            if h.how in (HoldKind.ROD, HoldKind.TELESCOPE)
        )

    # -- values ---------------------------------------------------------------------------------------------------

    def _chosen(self) -> Array:
        q = np.array([c.start for c in self.stage.model.coordinates], float)
        step, relative = self._steps()
        last = FIRST - step
        first = True
        for i, name in enumerate(self.names):
            if name in self.asked:
                q[i] = self.asked[name]
            elif self.start and any(
                row.on_positions for e in self.stage.model.constraints for row in e.conditions(self.stage.model)
            ):
                q[i] = self.start.get(name, q[i])
            elif i in self.angles and not self._floats(name):
                if self._sprung(i):
                    q[i] = SMALL
                elif first or self._alone(i):
                    last += step
                    q[i] = last
                else:
                    q[i] = relative
                first = False
            elif i not in self.slides:
                q[i] = self._length(i, name, float(q[i]))
        return q

    def _steps(self) -> tuple[float, float]:
        """By how much absolute angles differ, and how large relative ones are [rad]."""
        angles, turns = set(self.angles), self.motions.turns
        alone = sum(self._alone(i) for i in angles)
        moved = [h.moving for h in self.motions.holds] + [turns(k) for k in range(len(self.stage.frames))]
        longest = max((len(angles & set(which)) for which in moved), default=0)
        return min(STEP, SPAN[0] / max(1, alone - 1)), min(RELATIVE, SPAN[1] / max(1, longest))

    def _sprung(self, i: int) -> bool:
        """Whether an angle turns a body about its own centre, which is free, in a system with springs."""
        model, holds = self.stage.model, self.motions.holds
        if not any(isinstance(e, Spring) for e in model.elements) or self.stage.dimension == 3:
            return False
        free = (HoldKind.FREE, HoldKind.SLIDE)
        bodies = [b for b in model.bodies if b.axes is not None and holds[self.stage.index(b.at)].how in free]
        return any(self.motions.turns(self.stage.frames.index(b.axes)) == (i,) for b in bodies if b.axes is not None)

    def _floats(self, name: str) -> bool:
        floats = [f.floating for f in self.stage.model.floating if f.floating is not None]
        return any(name == c.name for f in floats for c in f.coordinates)

    def _length(self, i: int, name: str, otherwise: float) -> float:
        """The value of a length: a little more than a spring's rest length, else the start of a run."""
        symbol = self.stage.model.coordinates[i].symbol
        for element in self.stage.model.elements:
            if isinstance(element, Spring) and element.deflection == symbol and element.rest != 0:
                value = self.stage.value(element.rest, np.zeros(len(self.names)), self.p)
                if value > 0:
                    return STRETCHED * value
        if self.start.get(name):
            return float(self.start[name])
        telescope = any(h.along == i and h.how is not HoldKind.FREE for h in self.motions.holds)
        return 1.0 if telescope or self.stage.model.coordinates[i].positive else otherwise

    def closed(self, q: Array) -> Array:
        """The nearest coordinates that satisfy the constraints; ``q`` itself where none were found."""
        if not self.stage.model.constraints:
            return q
        fixed = tuple(name for name in self.stage.model.settings.get("fixed", ()) if name in self.names)
        for held in (fixed, ()) if fixed else ((),):
            try:
                return seen_position(self.stage.model, q, self.p, held)
            except RunError:
                continue
        return q


def up_axis(motions: Motions) -> Array:
    """The unit vector that points up in space: against gravity, otherwise z."""
    for element in motions.stage.model.elements:
        if element.kind == "gravity":
            values = [float(x) if sp.sympify(x).is_number else 0.0 for x in getattr(element, "direction")]  # noqa: B009
            size = float(np.linalg.norm(values))
            if size > 0.5 and len(values) == 3:
                return -np.array(values) / size
    return np.array([0.0, 0.0, 1.0])


def view_of(motions: Motions, azimuth: float, elevation: float) -> Array:
    """The projection of space onto the screen, (2, 3): x to the right, y downward.

    The eye looks from the direction that is ``azimuth`` about the vertical and ``elevation`` above the floor.
    """
    return views_of(motions, np.array([azimuth]), np.array([elevation]))[0]


def views_of(motions: Motions, azimuths: Array, elevations: Array) -> Array:
    """Several such projections, (n, 2, 3)."""
    up = up_axis(motions)
    x = np.array([1.0, 0.0, 0.0]) if abs(up[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    x = x - (x @ up) * up
    x /= np.linalg.norm(x)
    y = np.cross(up, x)
    sine, cosine = np.sin(azimuths)[:, None], np.cos(azimuths)[:, None]
    right, forward = cosine * y - sine * x, cosine * x + sine * y
    above = np.cos(elevations)[:, None] * up - np.sin(elevations)[:, None] * forward
    return np.stack([right, -above], axis=1)
