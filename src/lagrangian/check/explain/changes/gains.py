"""What energies gain from another motion of a body, as sums: only what differs is multiplied out.

½ m |v + d|² − ½ m v² = m (v + ½ d)·d, so that neither the old nor the new energy is written out again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import sympy as sp

from lagrangian.check.explain.changes.ring import Sum, TooLong, add, minus, plus, put, scaled, times
from lagrangian.check.explain.changes.sites import Sites
from lagrangian.check.explain.misconceptions.base import put as replaced
from lagrangian.model import Gravity

HALF = Fraction(1, 2)


class Gains:
    """What the energies of bodies gain; None stands for a sum that is too long."""

    def __init__(self, sites: Sites) -> None:
        self.sites = sites
        self.s = sites.of
        self.ring = sites.ring
        self._plain: dict[tuple[sp.Expr, Any], bool] = {}

    def of_speed(self, b: Any, more: Mapping[int, Sum]) -> Sum | None:
        """What ½mv² of a body gains if the components of its velocity gain ``more``."""
        return self._of_squares(self.s.expand(b.mass), self.s.velocity(b), more)

    def of_square(self, mass: sp.Expr, speed: Sum, number: Fraction | int = HALF) -> Sum | None:
        """½ m v², or another number of m v²."""
        try:
            return times(scaled(self.ring.of(mass), number), times(speed, speed))
        except TooLong:
            return None

    def of_turning(self, b: Any, axis: int, more: Sum) -> Sum | None:
        """What ½Jω² of a body that turns about one axis gains if its angular velocity does."""
        return self._of_squares(self.s.expand(b.inertia[axis, axis]), self.s.omega(b), {axis: more})

    def _of_squares(self, mass: sp.Expr, velocity: Sequence[sp.Expr], more: Mapping[int, Sum]) -> Sum | None:
        try:
            total: Sum = {}
            for c, d in more.items():
                add(total, times(plus(self.ring.of(velocity[c]), scaled(d, HALF)), d))
            return times(self.ring.of(mass), total)
        except TooLong:
            return None

    def of_height(self, b: Any, more: Mapping[int, Sum]) -> Sum:
        """What m g h of a body gains if its position does; what does not move is left out."""
        total: Sum = {}
        for gravity in self.sites.model.elements:
            if isinstance(gravity, Gravity):
                down = {c: n for c, n in enumerate(gravity.direction) if n != 0 and more.get(c)}
                h = plus(*[times(self.ring.of(-n), more[c]) for c, n in down.items()])
                add(total, times(self.ring.of(self.s.expand(b.mass * gravity.g)), h) if h else h)
        return self.ring.moving(self.ring.fold(total))

    def of_rate(self, energy: sp.Expr, rate: Any, instead: sp.Expr) -> Sum | None:
        """What an energy gains with ``instead`` in place of a rate everywhere."""
        try:
            old = self.ring.of(energy)
            if self._is_plain(energy, rate):
                return minus(put(old, self.ring.atom(rate), self.ring.of(instead)), old)
            return minus(self.ring.of(self.s.expand(replaced(energy, {rate: instead}))), old)
        except TooLong:
            return None

    def _is_plain(self, energy: sp.Expr, rate: Any) -> bool:
        """Whether a rate stands in no root and below no fraction line of an energy."""
        if (energy, rate) not in self._plain:
            own, held = self.ring.atom(rate), self.ring.of(energy)
            inside = {a for m in held for a, e in m if (e < 0 if a == own else self.ring.atoms[a].has(rate))}
            self._plain[energy, rate] = not inside
        return self._plain[energy, rate]
