"""Reactions of joints as outputs of ensembles: "reaction B" is |F| in the joint, "reaction B.x" a component."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.errors import ModelError
from lagrangian.graph import Program
from lagrangian.model import Model
from lagrangian.records import dataclass
from lagrangian.simulate.reaction import force_and_torque

Array = NDArray[np.float64]

WORD = "reaction "
"""What the name of such an output begins with."""

LETTERS = "xyz"


@dataclass(frozen=True)
class JointForce:
    """One number of the reaction of a joint: a component in the fixed axes, or with ``part`` "" the magnitude |F|."""

    joint: str
    part: str = ""

    @property
    def unit(self) -> str:
        """Its unit."""
        return "N*m" if self.part.startswith("torque") else "N"


def joint_force(model: Model, text: str) -> JointForce | None:
    """What a text asks for; None if it is not "reaction …".

    Raises `ModelError` for what is no joint of the model.
    """
    if not text.startswith(WORD):
        return None
    asked = text.removeprefix(WORD).strip()
    joint, dot, part = asked.rpartition(".")
    turns = ("torque",) if model.dimension == 2 else tuple(f"torque_{x}" for x in LETTERS)
    if dot and part in (*LETTERS[: model.dimension], *turns):
        try:
            return _checked(model, JointForce(joint, part))
        except ModelError:
            pass  # the name of a joint may have a dot in it
    return _checked(model, JointForce(asked))


def _checked(model: Model, asked: JointForce) -> JointForce:
    dynamics.check_joint(model, asked.joint)
    return asked


@dataclass(frozen=True)
class JointForces:
    """Computes numbers of one joint's reaction from the outputs of its ``program``; can be sent to another process.

    ``sign`` is that of `dynamics.ReactionProgram`; ``wanted`` are names with the parts that they ask for.
    """

    program: Program
    sign: int
    dimension: int
    wanted: tuple[tuple[str, str], ...]

    def __call__(self, answer: Mapping[str, Array]) -> dict[str, Array]:
        """The numbers by name, (n, S) each."""
        force, torque = force_and_torque(self.sign, self.dimension, answer)
        return {name: part_of(part, force, torque) for name, part in self.wanted}


def part_of(part: str, force: Array, torque: Array) -> Array:
    """A component of a force (…, d) or of a torque (…, 1 or 3), or with ``part`` "" the magnitude of the force."""
    if not part:
        return np.sqrt(np.sum(force**2, axis=-1))
    if part.startswith("torque"):
        return torque[..., 0 if part == "torque" else LETTERS.index(part[-1])]
    return force[..., LETTERS.index(part)]


def observed_joints(
    model: Model, asked: Mapping[str, JointForce], feedback: Mapping[Any, Any]
) -> tuple[JointForces, ...]:
    """What computes the requested numbers, one program for each joint."""
    joints: dict[str, list[tuple[str, str]]] = {}
    for name, of in asked.items():
        joints.setdefault(of.joint, []).append((name, of.part))
    found: list[JointForces] = []
    for joint, wanted in joints.items():
        made = dynamics.reaction(model, joint, None, None, feedback, state=True)
        found.append(JointForces(made.program, made.sign, model.dimension, tuple(wanted)))
    return tuple(found)
