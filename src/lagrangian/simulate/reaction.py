"""Reactions as numbers: the force and the torque that a joint has on one side."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.codes import Code
from lagrangian.dynamics import ReactionProgram
from lagrangian.errors import Notice
from lagrangian.model import Model
from lagrangian.model.rows import named_conditions
from lagrangian.records import dataclass
from lagrangian.simulate.drift import DEPENDENT
from lagrangian.viewed import Brief

Array = NDArray[np.float64]

FREE = 1e-9
"""A velocity of a joint below this part of the largest one is rounding."""


@dataclass(frozen=True, eq=False)
class Reaction(Brief):
    """What a joint or a constraint does to one side, at every state: a force and a torque.

    ``force`` [N], shape ``(..., d)``, acts on ``on`` at the point ``at``; ``torque`` [N m] about that point has the
    shape ``(..., 3)`` in space and ``(...)`` in the plane, positive counter-clockwise. Both are in the fixed axes, or
    in those of the frame that was asked for. ``notices`` say where forces are not determined. ``numpy.asarray`` of a
    reaction is its force.
    """

    force: Array
    torque: Array
    on: str
    at: str
    notices: tuple[Notice, ...] = ()

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Array:
        return np.array(self.force, dtype=dtype) if dtype is not None or copy else self.force


def worked_out(model: Model, made: ReactionProgram, answer: Mapping[str, Array]) -> Reaction:
    """The reaction from the outputs of its program."""
    d = model.dimension
    force, torque = force_and_torque(made.sign, d, answer)
    notices = _not_unique(model, np.asarray(answer["margins"])) if "margins" in answer else ()
    return Reaction(force, torque[..., 0] if d == 2 else torque, made.on, made.at, notices)


def force_and_torque(sign: int, dimension: int, answer: Mapping[str, Array]) -> tuple[Array, Array]:
    """The force (..., d) and the torque (..., 1 or 3) from a reaction's program, in the axes that were asked for."""
    wrench = sign * np.asarray(answer["wrench"]) + 0.0  # no −0
    if "twists" in answer:
        wrench = across(wrench, np.asarray(answer["twists"]))
    force, torque = wrench[..., :dimension], wrench[..., dimension:]
    if "R" not in answer:
        return force, torque
    back = np.swapaxes(np.asarray(answer["R"]), -1, -2)
    turned = torque if dimension == 2 else np.einsum("...ij,...j->...i", back, torque)
    return np.einsum("...ij,...j->...i", back, force), turned


def across(wrench: Array, twists: Array) -> Array:
    """The part of forces and torques that has no power on what a joint allows.

    The columns of ``twists`` are what each velocity moves: the joint itself in the first rows, then the other joints,
    which must rest. A coordinate that moves several joints at once leaves none of them free on its own.
    """
    others, own = twists[..., wrench.shape[-1] :, :], twists[..., : wrench.shape[-1], :]
    twists = own @ _resting(others) if others.shape[-2] else own
    sizes = np.linalg.norm(twists, axis=-2, keepdims=True)
    largest = np.max(sizes, axis=-1, keepdims=True, initial=0.0)
    counted = sizes > FREE * np.maximum(largest, np.max(np.abs(own), axis=(-1, -2), keepdims=True, initial=0.0))
    directions = np.where(counted, twists / np.where(counted, sizes, 1.0), 0.0)
    left, singular, _ = np.linalg.svd(directions, full_matrices=False)
    basis = np.where((singular > FREE)[..., None, :], left, 0.0)
    along = np.einsum("...ki,...k->...i", basis, np.broadcast_to(wrench, (*basis.shape[:-2], wrench.shape[-1])))
    return wrench - np.einsum("...ki,...i->...k", basis, along)


def _resting(others: Array) -> Array:
    """The projector on the velocities that leave the other joints at rest, (..., n, n)."""
    sizes = np.linalg.norm(others, axis=-1, keepdims=True)
    rows = np.where(sizes > 0, others / np.where(sizes > 0, sizes, 1.0), 0.0)
    _, singular, right = np.linalg.svd(rows, full_matrices=False)
    moved = np.where((singular > FREE)[..., None], right, 0.0)
    return np.eye(others.shape[-1]) - np.swapaxes(moved, -1, -2) @ moved


def _not_unique(model: Model, margins: Array) -> tuple[Notice, ...]:
    """The notice that rows depend on each other, so that they share their force in more than one way."""
    least = margins.reshape(-1, margins.shape[-1]).min(axis=0)
    names = [row.name for row, margin in zip(named_conditions(model), least, strict=True) if margin < DEPENDENT]
    if not names:
        return ()
    listed = ", ".join(f"'{name}'" for name in names)
    text = f"{listed} say again what other constraints say: the sum of their forces is right, but not the share of each"
    return (Notice(Code.E508, "constraints", text),)
