"""Changes of angular velocities in space: a part of a component, and sine and cosine of an angle in all components.

ω = (θ̇, ψ̇ + Ω sin θ, Ω cos θ) where a rotor turns with ψ̇ in a gimbal: ψ̇ alone in place of ψ̇ + Ω sin θ is one mistake.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.changes.change import LocalChange, Site, Words, made
from lagrangian.check.explain.changes.sites import Sites
from lagrangian.check.explain.misconceptions.base import partner, put
from lagrangian.derive.sampling import CompiledExpressions, States
from lagrangian.page.formula import Name

MOST_PARTS = 9
"""An angular velocity with more parts is not changed part by part."""
SMALL = 1e-9
"""What is larger at a random state is not 0."""


class TurningChanges:
    """All changes of the angular velocities of bodies in space, and of sines and cosines in T*."""

    def __init__(self, sites: Sites) -> None:
        self.sites = sites
        self.s = sites.of

    def changes(self) -> Iterator[LocalChange]:
        """All of them; those whose sums would be too long are left out."""
        turning = {b: self._components(b) for b in self.s.bodies if len(self.s.omega(b)) == 3}
        for b, omega in turning.items():
            yield from self._parts(b, omega)
        every = [x for omega in turning.values() for x in omega]
        for angle in dict.fromkeys(a for x in every for a in self.s.angles(x)):
            words: Words = (Name("T*"),)
            yield from self._exchanged(None, self.s.T, angle, every, words, 1.3)
            for b, omega in turning.items():
                words = (f"the kinetic energy of the rotation of {b.title}",)
                yield from self._exchanged(b, self.s.rotation(b), angle, omega, words, 1.5)

    def _components(self, b: Any) -> tuple[sp.Expr, ...]:
        """ω along the axes of the body or, if these turn about an axis of symmetry, along those in which they do."""
        frame, own = b.frame, self.s.omega(b)
        if frame.parent is None or frame.axis is None:
            return own
        turn, J = sp.Matrix(frame.local_rotation), sp.Matrix(b.inertia)
        apart = [x for x in sp.Matrix(turn * J - J * turn).flat() if x != 0]
        if not self._vanish(apart) or any(bounded.trigsimp(x) != 0 for x in apart):
            return own
        before, rate = frame.parent.angular_velocity, self.s.rate(self.s.expand(frame.angle))
        return tuple(self.s.expand(x) + n * rate for x, n in zip(before, frame.axis, strict=True))

    def _vanish(self, exprs: Sequence[sp.Expr]) -> bool:
        """Whether all expressions are 0 at random states; where they are not, nothing has to be simplified."""
        values = CompiledExpressions(exprs).at(States(self.s.model, 1))
        return not np.isfinite(values).all() or bool(np.abs(values).max(initial=0.0) < SMALL)

    def _parts(self, b: Any, omega: Sequence[sp.Expr]) -> Iterator[LocalChange]:
        """A part of a component left out, with the wrong sign, or with the cosine for the sine."""
        every = [(c, p) for c, x in enumerate(omega) for p in sp.Add.make_args(bounded.expand(x)) if p != 0]
        turned = f"the angular velocity of {b.title}"
        for c, part in every if 1 < len(every) <= MOST_PARTS else ():
            whole: Words = ("the component ", omega[c], f" of {turned}") if omega[c] != part else (turned,)
            instead: list[tuple[sp.Expr, str, float]] = [(sp.S.Zero, "turning_part_left_out", 1.4)]
            if omega[c] != part:
                instead.append((-part, "turning_part_sign", 1.5))
            for f in sorted(part.atoms(sp.sin, sp.cos), key=sp.default_sort_key):
                instead += [(g * put(part, {f: partner(f)}), "turning_function", 1.6) for g in (1, -1)]
            for other, kind, cost in instead:
                changed = tuple(x - part + other if k == c else x for k, x in enumerate(omega))
                written = other if kind == "turning_function" else None
                T = self.sites.difference(self.s.rotating(b, changed), self.s.rotation(b))
                site = Site(words=whole, brief=(turned,), step=2, element=b)
                if T:
                    yield made(kind, cost, site, {"T": T}, part, written)

    def _exchanged(
        self,
        b: Any,
        old: sp.Expr,
        angle: sp.Expr,
        omega: tuple[sp.Expr, ...] | list[sp.Expr],
        words: Words,
        cost: float,
    ) -> Iterator[LocalChange]:
        """The sine and the cosine of an angle exchanged, with what they stand beside in all components if it is one."""
        sine, cosine = sp.sin(angle), sp.cos(angle)
        parts = [p for x in omega for p in sp.Add.make_args(bounded.expand(x)) if p.has(sine, cosine)]
        beside = {put(p, {sine: sp.S.One, cosine: sp.S.One}) for p in parts}
        if not (any(p.has(sine) for p in parts) and any(p.has(cosine) for p in parts)):
            return
        times = beside.pop() if len(beside) == 1 else sp.S.One
        T = self.sites.difference(put(old, {sine: cosine, cosine: sine}), old)
        if T:
            site = Site(words=words, brief=words, step=2, element=b)
            yield made("components_exchanged", cost, site, {"T": T}, times * cosine, times * sine)
