"""A transducer: a conductor that moves in a magnet's field, as in a motor, a generator or a loudspeaker."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

import sympy as sp

from lagrangian import bounded
from lagrangian.model.elements.answers import ENERGY, REQUIRED, ActsOn, Entry, FieldKind, Measure
from lagrangian.model.elements.base import XI, Action, Level, Surroundings, Use
from lagrangian.model.elements.branch import CHARGE_ENTRY, THROUGH, CircuitBranch
from lagrangian.model.geometry import Frame, as_expr
from lagrangian.model.names import time
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class Transducer(CircuitBranch):
    """A winding in the field of a magnet: the effort k i on what it moves, and the voltage −k ẋ on its circuit.

    ``k`` is one constant for both: in N m/A for a motor that turns ``on`` an angle, equal to V s/rad of its back-emf;
    in N/A = V s/m (B l) for a voice coil ``on`` a displacement. It may depend on positions, and on the current that
    makes the field, as in a motor whose field winding is in series, k = K i. What one side gives the other takes,
    k i ẋ; nothing is stored. ``on`` is an expression in the coordinates or a frame in the plane; for a
    motor between two links it is the angle between them.
    """

    k: Any = None
    on: Any = None

    kind: ClassVar[str] = "transducer"
    plural = "Motors, generators and voice coils: windings in the field of a magnet."
    about = "A winding in the field of a magnet: the effort k i, and the back-emf k ẋ."
    entries: ClassVar[Mapping[str, Entry]] = {
        "charge": CHARGE_ENTRY,
        "k": Entry(
            FieldKind.EXPRESSION,
            "Its constant, N m/A or N/A; it may depend on positions, the current of its field and inputs.",
            REQUIRED,
        ),
        "on": Entry(
            FieldKind.FRAME_OR_ANGLE,
            "The angle or displacement that it drives, as an expression, or a frame.",
            REQUIRED,
        ),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "Ξ"
    because = (
        "it stores nothing: it hands the power of the circuit on to the motion, by an effort and a voltage in ",
        XI,
    )
    resists = False

    def __post_init__(self) -> None:
        if self.k is None or self.on is None:
            missing = "k" if self.k is None else "on"
            raise self._error(
                f"its {missing} is missing",
                fix="k=its constant [N m/A or N/A], on=the angle or displacement that it drives",
                code="E416",
            )
        self._set(k=as_expr(self.k, f"the constant of {self.title}", place=self.place))
        if not isinstance(self.on, Frame):
            self._set(on=as_expr(self.on, f"the on of {self.title}", place=self.place))
        elif self.on.dimension != 2:
            raise self._error(
                "a frame in space does not say about which axis it turns",
                fix="on=the angle of the joint that it drives",
                code="E414",
            )
        self._check_charge()

    def suggested_name(self) -> str:
        """The symbol of its constant."""
        return self.k.name if isinstance(self.k, sp.Symbol) else ""

    def uses(self) -> Iterator[Use]:
        """The charge; the constant, of positions, a field's current and inputs; what it drives, of positions."""
        yield from self.uses_of_charge()
        yield Use("k", "constant", self.k, Level.VELOCITY, inputs=True)
        if not isinstance(self.on, Frame):
            yield Use("on", "displacement", self.on, Level.POSITION)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """k i is an effort: J/[x]/A."""
        yield from self.measure_of_charge()
        along = self.on.total_angle if isinstance(self.on, Frame) else self.on
        unit = (*ENERGY, -1)
        yield Measure("constant", self.k, unit, along, -1)

    def frames(self) -> Iterator[tuple[str, Frame]]:
        """The frame that it turns, if it is given by one."""
        if isinstance(self.on, Frame):
            yield "on", self.on

    def acts_on(self) -> ActsOn:
        """The charge that flows through it, and what it drives."""
        return ActsOn((self.charge, self.on), "it does nothing: no coordinate moves what it drives", "on=an angle")

    def moved(self, model: Surroundings) -> sp.Expr:
        """What it drives: an angle [rad] or a displacement [m]."""
        return model.expand(self.on.total_angle if isinstance(self.on, Frame) else self.on)

    def works(self, model: Surroundings) -> tuple[Action, ...]:
        """k i on what it drives, −k ẋ on its circuit: together they do no work."""
        k, x, i = model.expand(self.k), self.moved(model), self.current(model)
        speed = bounded.diff(x, time)
        on = model.frame_words(self.on) if isinstance(self.on, Frame) else model.angle_words(x)
        target = self.on if isinstance(self.on, Frame) else None
        return (Action(k * i, speed, on, x, target), Action(-k * speed, i, THROUGH, self.flowed(model)))
