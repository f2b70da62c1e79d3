"""Twelve states for a floating frame instead of thirteen: changes of its quaternion by small turns about its own axes.

A quaternion e of any length changes along its orientation by δe = ½ e ∘ (δθ, 0) = N(e) δθ, so that δx = Z δξ with

    δξ = (δp, δθ, …; δv, δω, …)        Z⁺ Z = 1        N⁺ = 4/|e|² Nᵀ

and the change of the length of e, which nothing depends on, is left out. With ẋ = f(x), along the motion,

    δξ̇ = Z⁺ (∂f/∂x Z − Ż) δξ

where Ż, that of N(e), is 0 at rest. δp is in the fixed axes, and for an unturned frame δθ are roll, pitch and yaw.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lagrangian.linear.jacobians import Arrays
from lagrangian.model import Model
from lagrangian.records import dataclass

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class FloatingStates:
    """The minimal states of a model with quaternions: their names, Z as ``basis``, Z⁺ as ``back``, and Z⁺ Ż."""

    names: tuple[str, ...]
    basis: Array
    back: Array
    transport: Array

    @classmethod
    def at(cls, model: Model, x: Array, xdot: Array) -> FloatingStates:
        """Those at a state x, which moves with ẋ."""
        names = [*(c.name for c in model.coordinates), *(v.name for v in model.velocities)]
        quaternions = {
            f.floating.orientation[0].name: f.floating.orientation[0].name.removesuffix("_qx")
            for f in model.floating
            if f.floating is not None
        }
        kept: list[str] = []
        columns: list[Array] = []
        back: list[Array] = []
        rates: list[Array] = []
        i = 0
        while i < len(names):
            width = 4 if names[i] in quaternions else 1
            own = _turns(x[i : i + 4]) if width == 4 else np.eye(1)
            moved = _turns(xdot[i : i + 4]) if width == 4 else np.zeros((1, 1))
            inverse = 4 / (x[i : i + 4] @ x[i : i + 4]) * own.T if width == 4 else own
            for block, target in ((own, columns), (inverse.T, back), (moved, rates)):
                wide = np.zeros((len(names), block.shape[1]))
                wide[i : i + width] = block
                target.extend(wide.T)
            kept += _turn_names(model, quaternions[names[i]]) if width == 4 else [names[i]]
            i += width
        Z, inverse = np.array(columns).T, np.array(back)
        return cls(tuple(kept), Z, inverse, inverse @ np.array(rates).T)

    def reduced(self, found: Arrays) -> Arrays:
        """ẋ, A and B of the minimal states."""
        return {
            "xdot": self.back @ found["xdot"],
            "A": self.back @ found["A"] @ self.basis - self.transport,
            "B": self.back @ found["B"],
        }


def _turns(e: Array) -> Array:
    """N(e) with ė = N(e) ω: ½ e ∘ (ω, 0), shape (4, 3)."""
    x, y, z, w = e
    return 0.5 * np.array([[w, -z, y], [z, w, -x], [-y, x, w], [-x, -y, -z]])


def _turn_names(model: Model, frame: str) -> list[str]:
    """``hull_rx``, ``hull_ry``, ``hull_rz``, with more underscores if the model has such names."""
    taken = {*model.symbols, *(c.name for c in model.coordinates), *(v.name for v in model.velocities)}
    line = "_"
    while any(f"{frame}{line}r{axis}" in taken for axis in "xyz"):
        line += "_"
    return [f"{frame}{line}r{axis}" for axis in "xyz"]
