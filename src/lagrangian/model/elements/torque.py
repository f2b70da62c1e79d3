"""A torque on an angle or on a frame, with or without reaction."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

import sympy as sp

from lagrangian import bounded
from lagrangian.model.elements.answers import ANGLE, ENERGY, REQUIRED, ActsOn, Entry, FieldKind, Measure
from lagrangian.model.elements.base import XI, Action, Element, Level, Surroundings, Use
from lagrangian.model.elements.vectors import entries_of, main_symbol
from lagrangian.model.geometry import Frame, as_expr, as_vector, is_listed
from lagrangian.model.names import time
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class Torque(Element):
    """A torque [N m]: Ξ_i = Σ τ·∂φ/∂ξ_i.

    It acts ``on`` an angle (an expression in the coordinates) or a frame; the opposite torque acts on the angle or
    frame ``reaction``, by default the ground. On a frame in space, a scalar acts about the frame's own axis; a vector
    has three components in the axes of the frame ``axes``, by default the fixed axes.
    """

    value: Any
    on: Any = None
    reaction: Any = None
    axes: Any = None

    kind: ClassVar[str] = "torque"
    plural = "Torques."
    about = "A torque on an angle or on a frame."
    entries: ClassVar[Mapping[str, Entry]] = {
        "value": Entry(
            FieldKind.EXPRESSION_OR_VECTOR, "The torque; in space it may be a vector in the fixed axes.", REQUIRED
        ),
        "on": Entry(FieldKind.FRAME_OR_ANGLE, "The angle it turns, as an expression, or a frame.", REQUIRED),
        "reaction": Entry(FieldKind.FRAME_OR_ANGLE, "The angle or frame that feels its opposite."),
        "axes": Entry(FieldKind.FRAME, "The frame whose axes the three components are given in."),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "Ξ"
    because = ("it acts from outside and may do work: no potential, so it is in ", XI)
    resists = False

    def __post_init__(self) -> None:
        if self.on is None:
            raise self._error(
                "it acts on nothing",
                fix="write on=angle (an expression such as theta1 + theta2) or on=frame",
                code="E412",
            )
        for key in ("on", "reaction"):
            target = getattr(self, key)
            if target is not None and not isinstance(target, Frame):
                self._set(**{key: as_expr(target, f"the angle in {key} of {self.title}", place=self.place)})
        if self.on is self.reaction or (not isinstance(self.on, Frame) and self.on == self.reaction):
            raise self._error(
                "it acts and reacts on the same angle, so it does nothing",
                fix="leave reaction out, or name another angle",
                code="E410",
            )
        if is_listed(self.value):
            self._vector()
        elif isinstance(self.on, Frame) and self.on.floating is not None:
            raise self._error(
                f"frame '{self.on.name}' turns freely, so a single value does not say about which axis the torque acts",
                fix="give three components: torque((tx, ty, tz), on=frame, axes=frame)",
                code="E414",
            )
        elif self.axes is not None:
            raise self._error("axes are for a torque with three components", fix="leave axes out", code="E412")
        else:
            self._set(value=as_expr(self.value, f"the value of {self.title}", place=self.place))

    def _vector(self) -> None:
        value = as_vector(self.value, f"the value of {self.title}", place=self.place)
        targets = [t for t in (self.on, self.reaction) if t is not None]
        if len(value) != 3 or any(not isinstance(t, Frame) or t.dimension == 2 for t in targets):
            raise self._error(
                "a vector torque has three components and acts on frames in space",
                fix="write torque((tx, ty, tz), on=frame), or give one value on an angle",
                code="E414",
            )
        if self.axes is not None and not isinstance(self.axes, Frame):
            raise self._error("axes must be a frame", fix="write axes=frame, or leave it out", code="E412")
        self._set(value=value)

    def suggested_name(self) -> str:
        """The symbol of its value."""
        return main_symbol(self.value) if isinstance(self.value, sp.Expr) else ""

    def uses(self) -> Iterator[Use]:
        """The value (of coordinates, rates, inputs, parameters, time); angles (of coordinates and time)."""
        for v in entries_of(self.value):
            yield Use("value", "value", v, Level.VELOCITY, inputs=True)
        for key in ("on", "reaction"):
            angle = getattr(self, key)
            if angle is not None and not isinstance(angle, Frame):
                yield Use(key, f"angle in {key}", angle, Level.POSITION)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """Components in N m = J; angles."""
        for value in entries_of(self.value):
            yield Measure("value", value, ENERGY)
        for key in ("on", "reaction"):
            if isinstance(angle := getattr(self, key), sp.Expr):
                yield Measure(f"angle ({key})", angle, ANGLE)

    def acts_on(self) -> ActsOn:
        """What it turns, and the target of the opposite torque."""
        return ActsOn(
            tuple(target for target in (self.on, self.reaction) if target is not None),
            "it does nothing: no coordinate turns what it acts on",
            "on=an angle that moves, such as theta1 + theta2, or on=the frame of a body",
        )

    def frames(self) -> Iterator[tuple[str, Frame]]:
        """The frames that it turns, and the one in whose axes it is given."""
        for key in ("on", "reaction", "axes"):
            if isinstance(getattr(self, key), Frame):
                yield key, getattr(self, key)

    def works(self, model: Surroundings) -> tuple[Action, ...]:
        """The torque on its angle, and the opposite torque on the angle of the reaction."""
        actions: list[Action] = []
        for sign, target in ((1, self.on), (-1, self.reaction)):
            if target is not None:
                actions.extend(self._actions(model, sign, target))
        return tuple(actions)

    def _actions(self, model: Surroundings, sign: int, target: sp.Expr | Frame) -> Iterator[Action]:
        if not isinstance(target, Frame):
            angle = model.expand(target)
            yield Action(sign * model.expand(self.value), bounded.diff(angle, time), model.angle_words(angle), angle)
            return
        on = model.frame_words(target)
        if target.dimension == 2:
            angle = model.expand(target.total_angle)
            yield Action(sign * model.expand(self.value), bounded.diff(angle, time), on, angle, target)
            return
        if isinstance(self.value, tuple):
            # components of ω in the fixed axes: R ω_body
            omega = target.in_fixed_axes(target.angular_velocity)
            efforts = entries_of(self.value if self.axes is None else self.axes.in_fixed_axes(self.value))
        else:
            # about the axis of the frame that is acted on: n·ω, both turned into the fixed axes
            assert self.on.axis is not None
            axis, spin = self.on.in_fixed_axes(self.on.axis), target.in_fixed_axes(target.angular_velocity)
            omega, efforts = (sp.Add(*(n * w for n, w in zip(axis, spin, strict=True))),), (self.value,)
        for effort, rate in zip(efforts, omega, strict=True):
            if effort != 0:
                yield Action(sign * model.expand(effort), model.expand(rate), on, None, target)
