"""Springs, dampers, friction and forces along a deflection: what they tie together."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import itertools
from typing import Any, Literal

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.cast import Player
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.look.turning import Turn
from lagrangian.model import Element
from lagrangian.records import dataclass

Array = NDArray[np.float64]
Way = Literal["points", "slides", "joint", "arm", "telescope", "stop", "unknown"]


@dataclass(frozen=True)
class Tie:
    """An element along a deflection, and what it ties together.

    ``points``: two points. ``slides``: one or two sliding bodies by their points (``a`` is None for the ground), where
    ``sign`` tells on which side of ``b`` a positive deflection pulls. ``joint``: turns ``b`` against turn ``a``.
    ``stop``: the point ``b`` and the ground, along the coordinate axis number ``axis``. ``arm``: a lever of length
    ``arm`` on turn ``b``. ``telescope``: the point ``b``, along the line of its holder.
    """

    element: Element
    way: Way
    a: int | Turn | None = None
    b: int | Turn | None = None
    sign: float = 1.0
    arm: sp.Expr | None = None
    axis: int = 0


class Resolver:
    """Finds what a deflection ties together, from its slopes ∂δ/∂q at random states."""

    def __init__(self, motions: Motions, parts: list[Player], turns: list[Turn]) -> None:
        self.motions, self.parts, self.turns = motions, parts, turns
        self.p = motions.views.p
        self._places: dict[tuple[int, int, sp.Expr], int] = {}

    def resolve(self, element: Element) -> Tie:
        """What an element ties together."""
        between = getattr(element, "between", None)
        stage = self.motions.stage
        if between:
            return Tie(element, "points", stage.index(between[0]), stage.index(between[1]))
        return self.along(element, getattr(element, "deflection"))  # noqa: B009

    def along(self, element: Element, deflection: Any) -> Tie:
        """What a deflection ties together."""
        first, second = self.motions.slopes(deflection)
        if np.abs(first - second).max(initial=0.0) > 1e-7 * max(1.0, np.abs(first).max(initial=0.0)):
            bent = self._slides(element, np.concatenate([first, second]), self.motions.views.J[:2])
            g = self.motions.stage.slopes(deflection, np.zeros(len(first)), self.p)
            return bent or self._small(element, g) or Tie(element, "unknown")
        g = first
        slides = self._slides(element, g, self.motions.views.J[:1])
        if slides is not None:
            return slides
        rules = (self._telescope, self._joint, self._stop, self._small, self._on_body)
        found = (rule(element, g) for rule in rules)
        return next((tie for tie in found if tie is not None), Tie(element, "unknown"))

    def _stop(self, element: Element, g: Array) -> Tie | None:
        """A point whose displacement along an axis it is, as long as all coordinates are small."""
        stage = self.motions.stage
        if stage.dimension == 3 or not g.any():
            return None
        J = stage.views([np.zeros(len(g))], self.p).J[0]
        for k in range(1, len(self.motions.holds)):
            for axis in (1, 0):
                for sign in (1.0, -1.0):
                    if np.allclose(g, sign * J[k, axis], atol=1e-9):
                        return Tie(element, "stop", None, k, sign, None, axis)
        return None

    def _small(self, element: Element, g: Array) -> Tie | None:
        """Two points of bodies whose distance along an axis it is, as long as all coordinates are small."""
        stage = self.motions.stage
        if stage.dimension == 3 or not np.isfinite(g).all() or not g.any():
            return None
        at_zero = stage.views([np.zeros(len(g))], self.p)
        r, J = at_zero.r[0], at_zero.J[0]
        spots = list(dict.fromkeys(k for part in self.parts for k in (part.point, *part.points)))
        found: list[tuple[float, int, int, float]] = []
        for a, b in itertools.combinations(spots, 2):
            for axis in (1, 0):
                for sign in (1.0, -1.0):
                    if np.allclose(g, sign * (J[b, axis] - J[a, axis]), atol=1e-9):
                        found.append((float(abs(r[b, 1 - axis] - r[a, 1 - axis])), a, b, sign))
        if not found:
            return None
        _, a, b, sign = min(found)
        return Tie(element, "points", a, b, sign)

    def driven(self, element: Element, deflection: sp.Expr) -> Tie:
        """What moves by a multiple of an expression, such as a cart by the angle of its motor."""
        tie = self.along(element, deflection)
        if tie.way != "unknown":
            return tie
        g = self.motions.slopes(deflection)[0]
        for part in self.parts:
            slope = self._slope_of(part, self.motions.views.J[:1])
            if slope is not None and (ratio := _ratio(g, slope)) is not None:
                return Tie(element, "slides", None, part.point, float(np.sign(ratio)))
        return tie

    def _on_body(self, element: Element, g: Array) -> Tie | None:
        """A place on a rigid body whose small displacement along an axis it is: y − a θ, a beside the centre.

        ∂δ/∂q = ±(∂r/∂q of the centre + offset · ∂φ/∂q), where φ is the angle of the body.
        """
        stage, zero = self.motions.stage, np.zeros(len(g))
        if stage.dimension == 3:
            return None
        at_zero = stage.views([zero], self.p)
        for part in self.parts:
            for axis, sign in ((1, 1.0), (1, -1.0), (0, 1.0), (0, -1.0)) if part.frame is not None else ():
                assert part.frame is not None
                J = at_zero.J[0, part.point, axis]
                ratio = _ratio(sign * g - J, self.motions.angle_slopes(part.frame)) if J.any() else None
                if ratio is None:
                    continue
                offset = self._offset(element, part, axis, sign, ratio)
                key = (part.point, axis, offset)
                if key not in self._places:
                    R = at_zero.R[0, part.frame]
                    place = [offset * (float(R[0, i]) if axis else -float(R[1, i])) for i in (0, 1)]
                    self._places[key] = stage.add(part.point, place, stage.frames[part.frame])
                return Tie(element, "stop", None, self._places[key], sign, None, axis)
        return None

    def _offset(self, element: Element, part: Player, axis: int, sign: float, ratio: float) -> sp.Expr:
        """How far beside the centre a place on a body is: a parameter, otherwise its value at the given parameters."""
        named = self.motions.named(abs(ratio))
        if named is not None:
            return named if ratio > 0 else -named
        stage = self.motions.stage
        zero, p = np.zeros(len(stage.inputs.q)), stage.parameters()
        g = stage.slopes(getattr(element, "deflection"), zero, p)  # noqa: B009
        assert part.frame is not None
        found = _ratio(sign * g - stage.views([zero], p).J[0, part.point, axis], self.motions.angle_slopes(part.frame))
        return sp.Float(found or 0.0, 17)

    def _slope_of(self, part: Player, J: Array) -> Array | None:
        """e · ∂r/∂q, at one state after the other, of a body that slides on something in the direction e."""
        hold = self.motions.holds[part.point]
        if part.direction is None or hold.how is not HoldKind.SLIDE:
            return None
        return np.concatenate([part.direction @ at[part.point] for at in J])

    def _slides(self, element: Element, g: Array, J: Array) -> Tie | None:
        slopes = [(part, s) for part in self.parts if (s := self._slope_of(part, J)) is not None]
        for part, s in slopes:
            for sign in (1.0, -1.0):
                if np.allclose(g, sign * s, atol=1e-8):
                    return Tie(element, "slides", None, part.point, sign)
        for i, (one, s1) in enumerate(slopes):
            for two, s2 in slopes[i + 1 :]:
                assert one.direction is not None and two.direction is not None
                cosine = float(one.direction @ two.direction)
                if abs(abs(cosine) - 1.0) > 1e-9:
                    continue
                difference = cosine * s2 - s1
                for sign in (1.0, -1.0):
                    if np.allclose(g, sign * difference, atol=1e-8):
                        return Tie(element, "slides", one.point, two.point, sign)
        return None

    def _telescope(self, element: Element, g: Array) -> Tie | None:
        moving = np.flatnonzero(np.abs(g) > 1e-9)
        if len(moving) != 1 or abs(abs(g[moving[0]]) - 1.0) > 1e-9:
            return None
        for hold in self.motions.holds:
            if hold.how in (HoldKind.TELESCOPE, HoldKind.TRACK) and hold.along == moving[0]:
                return Tie(element, "telescope", hold.holder, hold.point, float(np.sign(g[moving[0]])))
        return None

    def _joint(self, element: Element, g: Array) -> Tie | None:
        if not g.any():
            return None
        ratios = [(turn, ratio) for turn in self.turns if (ratio := _ratio(g, turn.slopes)) is not None]
        for turn, ratio in ratios:
            if abs(abs(ratio) - 1.0) < 1e-9:
                return Tie(element, "joint", None, turn, float(np.sign(ratio)))
        for turn, ratio in ratios:
            if turn.joint != turn.tip:
                arm = self.motions.named(abs(ratio)) or sp.Float(abs(ratio), 17)
                return Tie(element, "arm", None, turn, float(np.sign(ratio)), arm)
        for i, one in enumerate(self.turns):
            for two in self.turns[i + 1 :]:
                ratio = _ratio(g, two.slopes - one.slopes)
                if ratio is not None and abs(abs(ratio) - 1.0) < 1e-9:
                    return Tie(element, "joint", one, two, float(np.sign(ratio)))
        return None


def _ratio(g: Array, slopes: Array) -> float | None:
    """c with g = c · slopes, if there is one."""
    square = float(slopes @ slopes)
    if square < 1e-18:
        return None
    c = float(g @ slopes) / square
    return c if abs(c) > 1e-9 and np.allclose(g, c * slopes, atol=1e-8 * max(1.0, abs(c))) else None
