"""Programs for the position of a point and the orientation of a frame, with their velocities and Jacobians."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from lagrangian.dynamics.describe import described
from lagrangian.dynamics.description import Description, Inputs
from lagrangian.dynamics.programs import _matrix, _program, _vector
from lagrangian.dynamics.vectors import zeros
from lagrangian.errors import ModelError, did_you_mean
from lagrangian.graph import Graph, Output, Program, jvp
from lagrangian.model import Frame, Model, Point


def point_program(model: Model, point: Point) -> Program:
    """q, v, u, p, t → position r and velocity ṙ of a point, shape (d,), and J with ṙ = J v + ∂r/∂t, shape (d, n).

    ``bias`` is r̈ at v̇ = 0, so that r̈ = J v̇ + bias. All are in the fixed axes.

    Raises `ModelError` for a point of another system.
    """
    _own(model, point, "point")
    graph, inputs, d = _described(replace(model, points=(*model.points, point), _memo={}))
    motion, place = d.motion, d.places[point]
    velocity = motion.turned(place.velocity, place.axes, motion.root)
    outputs = {"r": _vector(motion.position(place)), "v": _vector(velocity)}
    outputs["J"] = _matrix(_slopes(graph, velocity, inputs))
    bias = motion.second_rate(velocity, zeros(graph, len(inputs.v)))
    return _program(model, "point", graph, {**outputs, "bias": _vector(bias)})


def frame_program(model: Model, frame: Frame) -> Program:
    """q, v, u, p, t → rotation R of a frame, (d, d), its angular velocity ω, and J with ω = J v + ω_t.

    R converts components in the frame to components in the fixed axes. ω and J are in the fixed axes, with shapes (3,)
    and (3, n) in space, () and (n,) in the plane. ``bias`` is ω̇ at v̇ = 0,
    so that ω̇ = J v̇ + bias. Raises `ModelError` for a frame of another system.
    """
    _own(model, frame.origin, "frame")
    graph, inputs, d = _described(replace(model, frames=(*model.frames, frame), _memo={}))
    motion, axes = d.motion, d.axes[frame]
    omega = motion.turned(axes.omega, axes, motion.root)
    rows = _slopes(graph, omega, inputs)
    bias = motion.second_rate(omega, zeros(graph, len(inputs.v)))
    outputs = {"R": _matrix(motion.rotation(axes))}
    if model.dimension == 2:
        outputs |= {"omega": Output((omega[0],), ()), "J": _vector(rows[0]), "bias": Output((bias[0],), ())}
    else:
        outputs |= {"omega": _vector(omega), "J": _matrix(rows), "bias": _vector(bias)}
    return _program(model, "frame", graph, outputs)


def _described(model: Model) -> tuple[Graph, Inputs, Description]:
    graph = Graph()
    inputs = Inputs.of(graph, model)
    return graph, inputs, described(model, graph, inputs)[1]


def _slopes(graph: Graph, rates: list[int], inputs: Inputs) -> list[list[int]]:
    """∂rate/∂v, with a row for each rate."""
    columns = [jvp(graph, rates, {v: graph.one}) for v in inputs.v]
    return [[column[i] for column in columns] for i in range(len(rates))]


def _own(model: Model, point: Point, kind: str) -> None:
    """Raise an error for anything that depends on the origin of another system."""
    at = point
    while at.parent is not None:
        at = at.parent
    if at is not model.origin:
        raise ModelError(
            f"the {kind} belongs to another system than '{model.name}'",
            fix=f'take one of the system that was compiled: system["name"], or what system.{kind}(…) returned',
            code="E412",
        )


def named_place(model: Model, asked: Any, kind: type[Point] | type[Frame]) -> Any:
    """The point or frame that is requested, by name or as an object; raises `ModelError` if there is none."""
    if isinstance(asked, kind):
        return asked
    what = kind.__name__.lower()
    known: Iterable[Any] = (model.origin, *model.points) if kind is Point else model.frames
    table = {x.name: x for x in known if x.name}
    if isinstance(asked, str) and asked in table:
        return table[asked]
    if not isinstance(asked, str):
        raise ModelError(
            f"a {what} must be given by name, or be the object itself (got {type(asked).__name__})",
            fix=f'{what}("name", q), or the {what} that the description returned',
            code="E406",
        )
    fix = did_you_mean(asked, table) or f"{what}s: {', '.join(table) or 'none has a name'}"
    raise ModelError(f"there is no {what} '{asked[:64]}'", fix=fix, code="E412")
