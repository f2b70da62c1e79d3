"""Reactions as numbers: the force and the torque that a joint has on one side."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.codes import Code
from lagrangian.dynamics import ReactionProgram
from lagrangian.errors import Notice
from lagrangian.model import Model
from lagrangian.model.rows import named_conditions
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
    wrench, d = made.sign * np.asarray(answer["wrench"]), model.dimension
    if "twists" in answer:
        wrench = across(wrench, np.asarray(answer["twists"]))
    force, torque = wrench[..., :d], wrench[..., d:]
    if "R" in answer:
        back = np.swapaxes(np.asarray(answer["R"]), -1, -2)
        force = np.einsum("...ij,...j->...i", back, force)
        torque = torque if d == 2 else np.einsum("...ij,...j->...i", back, torque)
    notices = _not_unique(model, np.asarray(answer["margins"])) if "margins" in answer else ()
    return Reaction(force, torque[..., 0] if d == 2 else torque, made.on, made.at, notices)


def across(wrench: Array, twists: Array) -> Array:
    """The part of forces and torques that has no power on any of the velocities in the columns of ``twists``."""
    sizes = np.linalg.norm(twists, axis=-2, keepdims=True)
    largest = np.max(sizes, axis=-1, keepdims=True, initial=0.0)
    counted = sizes > FREE * largest
    directions = np.where(counted, twists / np.where(counted, sizes, 1.0), 0.0)
    left, singular, _ = np.linalg.svd(directions, full_matrices=False)
    basis = np.where((singular > FREE)[..., None, :], left, 0.0)
    along = np.einsum("...ki,...k->...i", basis, np.broadcast_to(wrench, (*basis.shape[:-2], wrench.shape[-1])))
    return wrench - np.einsum("...ki,...i->...k", basis, along)


def _not_unique(model: Model, margins: Array) -> tuple[Notice, ...]:
    """The notice that rows depend on each other, so that they share their force in more than one way."""
    least = margins.reshape(-1, margins.shape[-1]).min(axis=0)
    names = [row.name for row, margin in zip(named_conditions(model), least, strict=True) if margin < DEPENDENT]
    if not names:
        return ()
    listed = ", ".join(f"'{name}'" for name in names)
    text = f"{listed} say again what other constraints say: the sum of their forces is right, but not the share of each"
    return (Notice(Code.E508, "constraints", text),)
