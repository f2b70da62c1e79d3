"""Equilibria of systems with constraints: h(q) = Aᵀλ and f(q) = 0 at rest.

λ is eliminated: with h and Aᵀ relative to the size of h, P = 1 − Aᵀ (Aᵀ)⁺ takes out what the constraints can hold, and

    P h = 0,  f = 0          with the slopes  P ∂(h − Aᵀλ)/∂q,  ∂f/∂q,    λ = (Aᵀ)⁺ h

are sought in q alone (variable projection with the slope of Kaufman, BIT 15 (1975) 49–57, which is exact where P h
vanishes). Rows on velocities have multipliers and no f.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lagrangian.codegen import Kernel
from lagrangian.equilibria.orientations import SoughtOrientations
from lagrangian.errors import RunError
from lagrangian.linear.linearize import Linearizer
from lagrangian.linear.manifold import Manifold
from lagrangian.model import Model
from lagrangian.model.rows import named_conditions
from lagrangian.records import dataclass

Array = NDArray[np.float64]

LARGE = 1e100
"""The value that replaces one that is not finite."""

DEPENDENT = 1e-10
"""A singular value of Aᵀ below this fraction of the largest counts as zero."""


@dataclass(frozen=True, eq=False)
class HeldForces:
    """What the constraints do not hold at rest: q (N, n) → P h and f (N, m + rows on positions), and their slopes.

    h has m entries, one for each velocity. ``bias``, ``rows`` and ``pushed`` are compiled; ``size`` is the size of h,
    ``gap`` that of f. Where frames float, rows for the lengths of their quaternions follow (`SoughtOrientations`).
    """

    names: tuple[str, ...]
    bias: Kernel
    rows: Kernel
    pushed: Kernel
    u: Array
    p: Array
    size: Array
    gap: Array
    orientations: SoughtOrientations

    @classmethod
    def of(
        cls,
        linearizer: Linearizer,
        kernel: Callable[..., Kernel],
        q: Array,
        u: Array,
        p: Array,
        scale: Callable[[Array], Array],
        orientations: SoughtOrientations,
    ) -> HeldForces:
        """The forces of a model with constraints, their sizes from the positions q (N, n).

        Raises `RunError` if constraints ask for motion, so that nothing rests.
        """
        manifold = linearizer.manifold
        assert manifold is not None
        names = tuple(row.name for row in named_conditions(linearizer.model))
        programs = (kernel(linearizer.forces, "h"), kernel(manifold.rows, "f", "Av", "F", "A"))
        made = cls(names, *programs, kernel(linearizer.pushed, "h", "K"), u, p, np.ones(1), np.ones(0), orientations)
        rows = made.rows(q, orientations.resting(q), u, p, 0.0)
        made._check(manifold, np.asarray(rows["Av"]))
        return replace(made, size=scale(made._bias(q, 0.0)), gap=scale(np.asarray(rows["f"])))

    def _check(self, manifold: Manifold, drive: Array) -> None:
        """Raise an error if a row moves with time, or asks for rates at rest."""
        moving = np.abs(np.where(np.abs(drive) < LARGE, drive, 0.0)).max(axis=0, initial=0.0) > 0
        if manifold.moves_with_time or moving.any():
            which = next((f"'{name}'" for name, moves in zip(self.names, moving, strict=True) if moves), "")
            raise RunError(
                f"system '{manifold.model.name}' has no equilibria: the constraint {which or 'moves with time,'} "
                f"{'asks for motion, ' if which else ''}so that nothing stays at rest",
                fix="linearize about a motion with operating_point=True, or leave that constraint out",
                code="E521",
            )

    def __call__(self, q: Array, t: float = 0.0) -> tuple[Array, Array]:
        """P h and f with their slopes, relative to their sizes; `LARGE` and 0 where they are not finite."""
        bias = self._bias(q, t)
        found, left, pushes = self._held(q, t, bias)
        lam = np.einsum("srn,sn->sr", pushes, left)
        h = bias / self.size
        K = np.asarray(self.pushed(q, self.orientations.resting(q), self.u, self.p, t, lam)["K"]) / self.size[:, None]
        onto = np.eye(h.shape[1]) - np.einsum("sir,srk->sik", self._load(found), pushes)
        value = np.concatenate([np.einsum("sik,sk->si", onto, h), found["f"] / self.gap], axis=1)
        slope = np.concatenate([np.einsum("sik,skj->sij", onto, K), found["F"] / self.gap[:, None]], axis=1)
        if self.orientations:
            value, slope = self.orientations.with_lengths(q, value, slope)
        bad = ~(np.abs(value) < LARGE).all(axis=1) | ~(np.abs(slope) < LARGE).all(axis=(1, 2))
        for raw in (bias, *found.values(), K * self.size[:, None]):
            bad |= ~(np.abs(raw).reshape(len(q), -1) < LARGE).all(axis=1)
        value[bad], slope[bad] = LARGE, 0.0
        return value, slope

    def multipliers(self, q: Array) -> dict[str, float]:
        """λ of every row at one position, the shortest if rows depend on each other."""
        _, h, pushes = self._held(q[None], 0.0, self._bias(q[None], 0.0))
        lam = pushes[0] @ h[0]
        lam[np.abs(lam) <= 1e-12 * np.abs(lam).max(initial=0.0)] = 0.0
        return dict(zip(self.names, (lam + 0.0).tolist(), strict=True))

    def _bias(self, q: Array, t: float) -> Array:
        found = self.bias(q, self.orientations.resting(q), self.u, self.p, t)
        return np.asarray(found["h"] if isinstance(found, dict) else found)

    def _load(self, found: dict[str, Array]) -> Array:
        """Aᵀ relative to the size of h; 0 where it is not finite."""
        A = np.where(np.abs(found["A"]) < LARGE, found["A"], 0.0)
        return np.swapaxes(A, 1, 2) / self.size[:, None]

    def _held(self, q: Array, t: float, bias: Array) -> tuple[dict[str, Array], Array, Array]:
        """The rows, ``bias`` h relative to its size, and (Aᵀ)⁺."""
        found = {name: np.array(x) for name, x in self.rows(q, self.orientations.resting(q), self.u, self.p, t).items()}
        h = np.where(np.abs(bias) < LARGE, bias, 0.0) / self.size
        return found, h, np.asarray(np.linalg.pinv(self._load(found), rcond=DEPENDENT), float)


def check_sizes(model: Model, h: Array, p: Array) -> None:
    """Raise `RunError` if the forces h (N, n) are at no start numbers below `LARGE`; ``p`` are the parameters."""
    if not h.size or (np.abs(h) < LARGE).all(axis=1).any():
        return
    k = int(np.argmax(np.abs(p))) if len(p) else 0
    most = f": parameter '{model.parameters[k].name}' is {p[k]:g}" if len(p) else ""
    raise RunError(
        f"the forces of system '{model.name}' are nowhere in the box finite and below {LARGE:g}{most}",
        fix="check the power of ten and the unit of the values; look for roots of negative numbers and divisions by 0",
        code="E503",
    )
