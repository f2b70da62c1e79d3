"""The equations of motion as linear functions of inertial parameters: Σ_k Y_k(q, v, v̇) π_k = Ξ − ∂V/∂q of springs, ….

Bodies that are fixed to each other share one set of parameters, about a point that is fixed to them (for a link the
point of its joint) and along the axes of their frame: m, the first moments m c and the inertia J, ten in space and four
in the plane. With the acceleration a of that point (against free fall, so that weight is contained) and ω, α,

    f = m a + α × m c + ω × (ω × m c),        n = J α + ω × J ω + m c × a

are linear in them, and Y_k collects f · ∂v/∂q̇_i + n · ∂ω/∂q̇_i of parameter k alone. Source: M. Gautier, W. Khalil,
Direct calculation of minimum set of inertial parameters of serial robots, IEEE Trans. Robot. Autom. 6 (1990) 368-373.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

import sympy as sp

from lagrangian.dynamics.axes import Accelerations, Axes, PlaceMotion
from lagrangian.dynamics.describe import described
from lagrangian.dynamics.description import Description, Inputs
from lagrangian.dynamics.mechanics import Mechanics, Pairs
from lagrangian.dynamics.programs import forward
from lagrangian.dynamics.vectors import Vector, cross, plus, times
from lagrangian.graph import Graph
from lagrangian.model import Body, Frame, Model, Point, time
from lagrangian.records import dataclass, field

SPATIAL = ("m", "mx", "my", "mz", "Jxx", "Jyy", "Jzz", "Jxy", "Jxz", "Jyz")
PLANAR = ("m", "mx", "my", "J")


@dataclass
class Rigid:
    """What moves as one: its ``bodies``, their ``frame`` and the point ``about`` which its parameters are.

    ``values`` are its parameters in the symbols of the model.
    """

    frame: Frame | None
    about: Point
    bodies: list[Body] = field(default_factory=list[Body])
    values: dict[str, sp.Expr] = field(default_factory=dict[str, sp.Expr])


def rigids(model: Model) -> list[Rigid]:
    """The bodies of a model, those together that are fixed to each other."""
    found: dict[tuple[int, int], Rigid] = {}
    for body in model.bodies:
        frame = body.axes or body.at.frame
        about, offset = _carrier(model, body.at, frame)
        group = found.setdefault((id(frame), id(about)), Rigid(frame, about))
        group.bodies.append(body)
        for name, value in _values(model, body, frame, offset).items():
            group.values[name] = group.values.get(name, sp.S.Zero) + value
    return list(found.values())


def _carrier(model: Model, at: Point, frame: Frame | None) -> tuple[Point, list[sp.Expr]]:
    """The point next to the joint that is fixed to ``at`` in a frame, and the way from it to ``at`` in its axes."""
    way: list[sp.Expr] = [sp.S.Zero] * model.dimension
    moving = [c.symbol for c in model.coordinates]
    while frame is not None and at.frame is frame and at.parent is not None:
        step = [model.expand(x) for x in at.offset]
        if any(x.has(time, *moving) for x in step):
            break
        way, at = [x + y for x, y in zip(way, step, strict=True)], at.parent
    return at, way


def _values(model: Model, body: Body, frame: Frame | None, c: list[sp.Expr]) -> dict[str, sp.Expr]:
    """The parameters of a body about a point, by the parallel axis theorem: J + m (c² 1 − c cᵀ)."""
    m = cast("sp.Expr", sp.sympify(body.mass))
    found: dict[str, sp.Expr] = {"m": m}
    if frame is None:
        return found
    found |= {f"m{axis}": m * x for axis, x in zip("xyz", c, strict=False)}
    square = sum((x**2 for x in c), sp.S.Zero)
    size = 1 if model.dimension == 2 else 3
    J = body.tensor or [[sp.S.Zero] * size] * size
    if model.dimension == 2:
        return {**found, "J": J[0][0] + m * square}
    for name in SPATIAL[4:]:
        i, k = ("xyz".index(axis) for axis in name[1:])
        found[name] = J[i][k] + m * ((square if i == k else sp.S.Zero) - c[i] * c[k])
    return found


@dataclass(frozen=True)
class Columns:
    """The columns of Y as nodes over q, v, v̇ (the input group "a"), p and t, with the parameter of each."""

    graph: Graph
    inputs: Inputs
    parameters: list[tuple[Rigid, str]]
    nodes: list[Vector]
    groups: dict[str, tuple[str, ...]]


def columns(model: Model) -> Columns:
    """The columns of all inertial parameters of a model."""
    graph = Graph()
    inputs = Inputs.of(graph, model)
    m, d = described(model, graph, inputs)
    acc = m.accelerations([graph.input("a", i) for i in range(len(m.v))])
    names = forward(model).inputs
    groups = {"q": names["q"], "v": names["v"], "a": tuple(x.rate for x in model.velocities), "p": names["p"]}
    made = Columns(graph, inputs, [], [], {**groups, "t": names["t"]})
    for rigid in rigids(model):
        motion = _Motion(m, d, acc, rigid)
        for name, pairs in motion.wrenches():
            made.parameters.append((rigid, name))
            made.nodes.append(m.gathered([pair for pair in pairs if graph.zero not in pair]))
    return made


class _Motion:
    """The motion of a rigid part in its own axes (in the plane in the fixed ones)."""

    def __init__(self, m: Mechanics, d: Description, acc: Accelerations, rigid: Rigid) -> None:
        self.g, self.rigid = m.graph, rigid
        place: PlaceMotion = d.places[rigid.about]
        self.axes: Axes = d.axes[rigid.frame] if rigid.frame is not None else place.axes
        self.v = m.motion.turned(place.velocity, place.axes, self.axes)
        self.a = m.motion.turned(acc.a[place], place.axes, self.axes)
        self.flat = m.motion.dimension == 2
        self.omega, self.alpha = list(self.axes.omega), list(acc.alpha.get(self.axes, []))
        self.along = m.motion.rotation(self.axes) if self.flat else None

    def wrenches(self) -> Iterator[tuple[str, Pairs]]:
        """Force and moment of every parameter alone, each on the velocity that it belongs to."""
        yield "m", list(zip(self.v, self.a, strict=True))
        if self.rigid.frame is None:
            return
        for k, axis in enumerate("xy" if self.flat else "xyz"):
            force, moment = self._first_moment(k)
            yield f"m{axis}", [*zip(self.v, force, strict=True), *zip(self.omega, moment, strict=True)]
        if self.flat:
            yield "J", list(zip(self.omega, self.alpha, strict=True))
            return
        for name in SPATIAL[4:]:
            yield name, list(zip(self.omega, self._inertia(name), strict=True))

    def _first_moment(self, k: int) -> tuple[Vector, Vector]:
        g = self.g
        if self.along is not None:
            x, y = self.along[0][k], self.along[1][k]
            (w,), (alpha,) = self.omega, self.alpha
            square = g.mul(w, w)
            force = [
                g.sub(g.neg(g.mul(alpha, y)), g.mul(square, x)),
                g.sub(g.mul(alpha, x), g.mul(square, y)),
            ]
            return force, [g.sub(g.mul(x, self.a[1]), g.mul(y, self.a[0]))]
        unit = [g.one if i == k else g.zero for i in range(3)]
        swung = cross(g, self.omega, cross(g, self.omega, unit))
        return plus(g, cross(g, self.alpha, unit), swung), cross(g, unit, self.a)

    def _inertia(self, name: str) -> Vector:
        g = self.g
        i, k = ("xyz".index(axis) for axis in name[1:])
        J = [[g.one if {r, c} == {i, k} and (i != k or r == c) else g.zero for c in range(3)] for r in range(3)]
        return plus(g, times(g, J, self.alpha), cross(g, self.omega, times(g, J, self.omega)))
