"""Programs for reactions: what a joint, or a constraint, does to the bodies that it joins.

A joint of a tree has no row. It is released: everything that hangs on it gets a virtual velocity w and a virtual
angular velocity about the joint, both 0, and

    r = Σ (inertial force − applied force − force of the rows) · ∂(velocity)/∂w

is the force and torque that the joint must have. What it leaves free it cannot push: r is taken across the velocities
that the joint can have while all other joints rest, which belong to what acts on the coordinates themselves.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.dynamics.describe import described
from lagrangian.dynamics.description import Description
from lagrangian.dynamics.feedback import with_feedback
from lagrangian.dynamics.inertia import Inertia, Link, PlaneLink
from lagrangian.dynamics.joint_names import ClosureSide, Held, JointSide, joint_side
from lagrangian.dynamics.mechanics import Mechanics
from lagrangian.dynamics.observe import Observed
from lagrangian.dynamics.parts import Parts, RigidPart
from lagrangian.dynamics.places import named_place
from lagrangian.dynamics.programs import _matrix, _program, _vector
from lagrangian.dynamics.row_actions import crossed, row_actions
from lagrangian.dynamics.vectors import Vector, minus, plus, zeros
from lagrangian.errors import ModelError
from lagrangian.graph import Output, Program, jvp, replaced, vjp
from lagrangian.model import Frame, Model
from lagrangian.model.elements.conditions import NoSlip, Stated
from lagrangian.model.elements.friction import Stuck
from lagrangian.model.joint_texts import asked_joint
from lagrangian.model.rows import named_conditions, rows_of
from lagrangian.records import dataclass


@dataclass(frozen=True)
class ReactionProgram:
    """The program of a reaction: ``wrench`` (force, then torque), and what it is of.

    ``twists`` are the velocities that each v gives to a joint, a column each, and below them those of all other joints;
    ``R`` the axes that were asked for; ``margins`` those of the constraints' rows. ``sign`` is −1 for the inner side;
    ``at`` the point that the torque is about.
    """

    program: Program
    sign: int
    on: str
    at: str


def reaction(
    model: Model,
    asked: Any,
    on: Any = None,
    axes: Any = None,
    feedback: Mapping[Any, sp.Expr] | None = None,
    *,
    state: bool = False,
) -> ReactionProgram:
    """q, v (or x), u, p, t → the reaction of the joint or constraint ``asked``, on the side ``on``, in a frame's axes.

    A text may say all three: "B on rod 1 in axes of rod 2".

    Raises `ModelError` for what is no joint, for a side that it does not have, and where an element does not say on
    which bodies it acts.
    """
    asked, on, axes = _taken_apart(model, asked, on, axes)
    seen = Observed(model, state=state)
    frame = None if axes is None else named_place(model, axes, Frame)
    what = joint_side(Parts(seen.description), asked, on)
    outputs: dict[str, Output] = {}
    if isinstance(what, ClosureSide):
        outputs["wrench"] = _vector(_of_rows(seen, what))
    else:
        wrench, twists = _of_joint(seen, asked, on)
        outputs["wrench"] = _vector(wrench)
        size = len(twists[0])
        kept = [i for i in range(size) if i < len(wrench) or any(column[i] != seen.graph.zero for column in twists)]
        outputs["twists"] = Output(tuple(column[i] for i in kept for column in twists), (len(kept), len(twists)))
    own = [not isinstance(named.element, Stuck) for named in named_conditions(model)]
    if any(own):
        margins = zip(seen.mechanics.constrained.margins, own, strict=True)
        outputs["margins"] = _vector([margin for margin, kept in margins if kept])
    if frame is not None:
        outputs["R"] = _matrix(seen.mechanics.motion.rotation(seen.description.axes[frame]))
    if state:
        program = with_feedback(seen, outputs, feedback or {}, "reaction")
    else:
        program = _program(model, "reaction", seen.graph, outputs)
    return ReactionProgram(program, what.sign, what.on, what.at)


def check_joint(model: Model, asked: Any) -> JointSide:
    """The joint and the side that are meant, by name or by a text such as "B on rod 1 in axes of rod 2".

    Raises `ModelError` for what is no joint and no constraint with forces at points, and for what is no frame.
    """
    asked, on, axes = _taken_apart(model, asked, None, None)
    if axes is not None:
        named_place(model, axes, Frame)
    return joint_side(Parts(Observed(model).description), asked, on)


def _taken_apart(model: Model, asked: Any, on: Any, axes: Any) -> tuple[Any, Any, Any]:
    """A joint, its side and axes; a text may say all three."""
    if not isinstance(asked, str):
        return asked, on, axes
    things = (*model.constraints, *model.bodies, *model.points, *model.frames)
    found = asked_joint(asked, {"origin", *(x.name for x in things if x.name)})
    for said, given in ((found.on, on), (found.axes, axes)):
        if said is not None and given is not None and said != given:
            raise ModelError(f"'{asked[:64]}' says '{said[:64]}', and {given!r:.64} is given besides", code="E404")
    return found.joint, on if found.on is None else found.on, axes if found.axes is None else found.axes


# -- constraints ------------------------------------------------------------------------------------------------


def _of_rows(seen: Observed, closure: ClosureSide) -> Vector:
    """The sum of what a constraint's rows do to one side: the force at its point, and the torque about it."""
    d, g = seen.description, seen.graph
    force, torque = zeros(g, d.motion.dimension), zeros(g, 1 if d.motion.dimension == 2 else 3)
    for named, row in zip(named_conditions(d.model), seen.mechanics.rows, strict=True):
        if named.element is not closure.element:
            continue
        for action in row_actions(d, named.condition, seen.multiplier(row.name)):
            if action.side != closure.side:
                continue
            if isinstance(action.target, Frame):
                if not isinstance(named.condition, NoSlip):  # the force at the contact has no torque about it
                    torque = plus(g, torque, action.vector)
            else:
                force = plus(g, force, action.vector)
    return [*force, *torque]


# -- joints of a tree -------------------------------------------------------------------------------------------


def _of_joint(seen: Observed, asked: Any, on: Any) -> tuple[Vector, list[Vector]]:
    """Force and torque on the outer part, and the velocities of the joint, for every v that moves it."""
    model, g = seen.model, seen.graph
    for element in model.elements:
        _check_says_where(model, element)
    turns = 1 if model.dimension == 2 else 3
    w = [g.input("w", i) for i in range(model.dimension + turns)]
    kept: list[_Released] = []

    def release(d: Description) -> None:
        parts = Parts(d)
        held = joint_side(parts, asked, on)
        assert isinstance(held, Held)
        kept.append(_Released(d, parts, held.part))
        kept[0].release(w)

    m, _ = described(model, g, seen.inputs, release)
    own = kept[0]
    total = own.inertial(m, seen.vdot)
    dragged = m.dragged_by({row: seen.multiplier(row) for drag in m.drags for row in drag.rows})
    pairs = [pair for pair in (*m.stores, *m.efforts, *dragged) if g.zero not in pair]
    applied = vjp(g, [rate for rate, _ in pairs], [effort for _, effort in pairs], w)
    total = minus(g, minus(g, total, applied), own.of_rows(seen))
    still = dict.fromkeys(w, g.zero)
    columns = [jvp(g, [*own.twist, *own.others], {v: g.one}) for v in m.v]
    return replaced(g, total, still), [replaced(g, column, still) for column in columns]


class _Released:
    """A part of a description that is released, with everything that hangs on it."""

    def __init__(self, d: Description, parts: Parts, part: RigidPart) -> None:
        self.d, self.parts, self.part, self.motion, self.g = d, parts, part, d.motion, d.graph
        self.outer = parts.outer(part)
        self.twist = self._twist(part)
        heavy = {p for body in parts.bodies.values() for p in parts.chain(body)} - {parts.ground, part}
        self.others = [x for other in sorted(heavy, key=parts.label) for x in self._twist(other)]

    def release(self, w: list[int]) -> None:
        """Add the virtual velocities to those of every place and frame that hangs on the joint."""
        n, motion = self.motion.dimension, self.motion
        force, turn = w[:n], w[n:]
        for place, native in self.parts.natives.items():
            if native in self.outer:
                change = plus(self.g, force, self._carried(turn, motion.between(self.part.anchor, place)))
                place.velocity = plus(self.g, place.velocity, motion.turned(change, motion.root, place.axes))
        for frame, axes in self.d.axes.items():
            if self.parts.of_frame(frame) in self.outer:
                axes.omega = plus(self.g, axes.omega, motion.turned(turn, motion.root, axes))

    def _carried(self, omega: Vector, r: Vector) -> Vector:
        """ω × r."""
        g = self.g
        if len(r) == 2:
            return [g.neg(g.mul(omega[0], r[1])), g.mul(omega[0], r[0])]
        return crossed(self.d, omega, r)

    def _twist(self, part: RigidPart) -> Vector:
        """Velocity and angular velocity of a part at its joint, relative to what carries it, in the fixed axes."""
        motion, g, at = self.motion, self.g, part.anchor
        carrier = self.parts.carrier(part)
        assert carrier is not None
        slip = zeros(g, motion.dimension)
        if self.parts.natives[at] == part:
            below = carrier.anchor
            spin = self._omega(carrier)
            there = plus(g, self._fixed(below), self._carried(spin, motion.between(below, at)))
            slip = minus(g, self._fixed(at), there)
        return [*slip, *minus(g, self._omega(part), self._omega(carrier))]

    def _fixed(self, place: Any) -> Vector:
        return self.motion.turned(place.velocity, place.axes, self.motion.root)

    def _omega(self, part: RigidPart) -> Vector:
        axes = self.parts.axes[part.turning]
        return self.motion.turned(axes.omega, axes, self.motion.root)

    def inertial(self, m: Mechanics, vdot: Vector) -> Vector:
        """The inertial forces less the weights of all bodies that are released, and their torque about the joint."""
        motion, g, n = self.motion, self.g, self.motion.dimension
        acc = m.accelerations(vdot)
        total = zeros(g, n + (1 if n == 2 else 3))
        for body in self.d.model.bodies:
            if self.parts.bodies[body.name] not in self.outer:
                continue
            link = self._link(body)
            efforts = [effort for _, effort in link.wrench(motion, acc)]
            force = motion.turned(efforts[:n], link.axes, motion.root)
            torque = motion.turned(efforts[n:], link.axes, motion.root)
            total = self._added(total, force, torque, link.place)
        return total

    def _added(self, total: Vector, force: Vector, torque: Vector, place: Any) -> Vector:
        arm = self.motion.between(self.part.anchor, place)
        return plus(self.g, total, [*force, *plus(self.g, torque, crossed(self.d, arm, force))])

    def _link(self, body: Any) -> Link | PlaneLink:
        d, g = self.d, self.g
        place, frame, mass = d.places[body.at], getattr(body, "frame", None), d.node(body.mass)
        if self.motion.dimension == 2:
            inertia = g.zero if frame is None else d.node(body.inertia[0, 0])
            return PlaneLink(self.motion.root if frame is None else d.axes[frame], place, mass, zeros(g, 2), inertia)
        central = [zeros(g, 3) for _ in range(3)] if frame is None else [d.nodes(r) for r in body.inertia.tolist()]
        axes = place.axes if frame is None else d.axes[frame]
        return Link(axes, place, Inertia.of_body(g, mass, zeros(g, 3), central))

    def of_rows(self, seen: Observed) -> Vector:
        """What the rows' multipliers do to the bodies that are released."""
        d, g = self.d, self.g
        n = self.motion.dimension
        nothing = zeros(g, n)
        total = zeros(g, n + (1 if n == 2 else 3))
        for named, row in zip(named_conditions(d.model), seen.mechanics.rows, strict=True):
            for action in row_actions(d, named.condition, seen.multiplier(row.name)):
                if isinstance(action.target, Frame):
                    if self.parts.of_frame(action.target) in self.outer:
                        total = plus(g, total, [*nothing, *action.vector])
                    continue
                place = d.places[action.target]
                if self.parts.natives[place] in self.outer:
                    total = self._added(total, action.vector, zeros(g, len(total) - n), place)
        return total


# -- what an element must say -----------------------------------------------------------------------------------


def _check_says_where(model: Model, element: Any) -> None:
    """Raise an error for an element that acts on coordinates in a way that leaves open on which bodies."""
    if element.kind in ("kinetic", "potential"):
        raise ModelError(
            f"{element.title} does not say on which bodies it acts, so the reactions of joints are not determined",
            fix="describe the bodies, the gravity and the springs themselves",
            element=element.title,
            code="E412",
        )
    coordinates = [c.symbol for c in model.coordinates]
    if element.ledger == "λ":
        stated = [row for row in rows_of(model) if row.element is element and isinstance(row.condition, Stated)]
        stated = [row for row in stated if getattr(row.condition, "between", None) is None]
        exprs = [(row.rate, [c.rate for c in model.coordinates]) for row in stated]
    else:
        between = getattr(element, "between", None)
        deflection = getattr(element, "deflection", None) if between is None else None
        target = getattr(element, "on", None)
        given = deflection if deflection is not None else target
        exprs = [(model.expand(given), coordinates)] if isinstance(given, sp.Expr) else []
    for expr, moved in exprs:
        slopes = [bounded.diff(expr, x) for x in moved]
        if any(slope.has(*coordinates) for slope in slopes):
            raise ModelError(
                f"{element.title} acts on coordinates by {expr}, which does not say at which points",
                fix="give it between=(P, Q), so that the reactions of joints are determined",
                element=element.title,
                code="E412",
            )
