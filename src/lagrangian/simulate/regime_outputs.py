"""What ensembles observe of systems with dry friction: in every regime with the equations of that regime."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp

from lagrangian import dynamics
from lagrangian.graph import Program
from lagrangian.model import Model
from lagrangian.records import dataclass
from lagrangian.simulate.integrating import remembered
from lagrangian.simulate.joint_forces import JointForce, JointForces, observed_joints


@dataclass(frozen=True)
class RegimeOutputs:
    """The programs of the observed ``expressions`` and of the reactions of ``joints``, regime by regime."""

    model: Model
    expressions: Mapping[str, sp.Expr]
    joints: Mapping[str, JointForce]
    feedback: Mapping[Any, Any]

    def programs(self, modes: dynamics.Modes) -> tuple[Program, tuple[JointForces, ...]]:
        """The program of the expressions in a regime, and what computes the reactions there."""
        model = dynamics.regime(self.model, modes)
        key = (
            "observed",
            tuple(self.expressions.items()),
            tuple(self.joints.items()),
            frozenset(self.feedback.items()),
        )
        return remembered(
            model,
            key,
            lambda: (
                dynamics.observe_closed(model, self.expressions, self.feedback),
                observed_joints(model, self.joints, self.feedback),
            ),
        )
