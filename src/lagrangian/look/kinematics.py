"""Where everything is: positions of points and orientations of frames as numbers, and how each coordinate moves them.

The rules of a picture ask what is constant and what is parallel. They ask it of numbers at random states, which is fast
and does not depend on how an expression is written.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.dynamics import Inputs, placed
from lagrangian.dynamics.vectors import plus, times
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, Output, Program, Valuation, jvp
from lagrangian.graph.variations import Variations
from lagrangian.model import Frame, Model, Point
from lagrangian.records import dataclass

Array = NDArray[np.float64]

STATES = 3
"""The number of random states at which a rule is asked."""


KEPT = 16
"""Of so many states the values of nodes are kept."""

LARGEST = 1e30
"""Positions [m] beyond this are not drawn."""


@dataclass(frozen=True)
class Views:
    """What a stage looks like at some states: the first axis of every array is the state.

    ``r`` (states, points, d) are positions, ``J`` (states, points, d, n) their derivatives by the coordinates, ``rt``
    (states, points, d) by time; ``R`` (states, frames, d, d) are the rotations of frames, ``RJ`` (…, n) their slopes.
    """

    r: Array
    J: Array
    rt: Array
    R: Array
    RJ: Array
    p: Array
    """The parameters at these states."""
    q: Sequence[Array]
    """The coordinates."""
    t: float


class Kinematics:
    """The points and frames of a model, in a fixed order: ``points`` begin with the origin, the named ones follow."""

    def __init__(self, model: Model) -> None:
        self.model, self.dimension = model, model.dimension
        self.graph = Graph()
        self.inputs = Inputs.of(self.graph, model, state=True)
        self.described, _ = placed(model, self.graph, self.inputs)
        places, axes = self.described.places, self.described.axes
        places.setdefault(model.origin, self.described.motion.ground)
        found = sorted(places, key=lambda p: p.serial)
        self.points: list[Point] = [model.origin, *(p for p in found if p is not model.origin)]
        self.frames: list[Frame] = sorted(axes, key=lambda f: f.serial)
        self._index = {id(p): k for k, p in enumerate(self.points)}
        motion = self.described.motion
        self._nodes: list[list[int]] = [list(motion.position(places[p])) for p in self.points]
        self._parameters: Array | None = None
        self._valuations: dict[tuple[bytes, bytes, float, float], Valuation] = {}
        self._variations: dict[Any, Variations] = {}

    # -- points -------------------------------------------------------------------------------------------------

    def index(self, point: Point) -> int:
        """The number of a point."""
        return self._index[id(point)]

    def add(self, parent: int, offset: Sequence[Any], frame: Frame | None = None) -> int:
        """Add a point at ``offset`` from another, along the axes of ``frame``, and return its number."""
        components: tuple[sp.Expr, ...] = tuple(sp.sympify(x) for x in offset)
        point = Point(None, self.points[parent], components, frame)
        d = self.described
        axes = d.motion.root if frame is None else d.axes[frame]
        step = times(self.graph, d.motion.rotation(axes), d.nodes(components))
        self.points.append(point)
        self._index[id(point)] = len(self.points) - 1
        self._nodes.append(plus(self.graph, self._nodes[parent], step))
        return len(self.points) - 1

    def fixed(self, r: Sequence[float]) -> int:
        """Add a point at rest at ``r`` [m] in the fixed axes, and return its number."""
        return self.add(0, [sp.Float(float(x), 17) for x in r])

    # -- numbers ------------------------------------------------------------------------------------------------

    def program(self, anchors: Sequence[int]) -> Program:
        """x = [q; v], u, p, t → positions r [m] of anchors, shape (anchors, d)."""
        ids = [i for k in anchors for i in self._nodes[k]]
        return self._program({"r": Output(tuple(ids), (len(anchors), self.dimension))})

    def _program(self, outputs: dict[str, Output]) -> Program:
        m = self.model
        names = {
            "x": (*(c.name for c in m.coordinates), *(v.name for v in m.velocities)),
            "u": tuple(u.name for u in m.inputs),
            "p": tuple(p.name for p in m.parameters),
            "t": ("t",),
        }
        return Program("picture", self.graph, names, outputs, {p.name: p.value for p in m.parameters})

    def positions(self, q: Array, p: Array, first: int = 0) -> Array:
        """The positions (points, d) of all points from number ``first`` on, at a state."""
        nodes = [i for node in self._nodes[first:] for i in node]
        return np.array(self._at(q, p)(nodes), float).reshape(-1, self.dimension)

    def views(self, states: Sequence[Array], p: Array, *, t: float = 0.0, known: Views | None = None) -> Views:
        """Positions, rotations and their derivatives at coordinates q, one array for each state.

        ``known`` are the views of the first points at the same states: only the others are computed.
        """
        first = 0 if known is None else known.r.shape[1]
        frames = self.frames if known is None else []
        d, n, count, turns = self.dimension, len(self.inputs.q), len(self.points) - first, len(frames)
        motion = self.described.motion
        r = [i for node in self._nodes[first:] for i in node]
        rotations = [motion.rotation(self.described.axes[f]) for f in frames]
        flat = [*r, *(x for rows in rotations for row in rows for x in row)]
        values = np.array([self._at(q, p, t=t)(flat) for q in states])
        slots = self._varied(states, p, t)(flat)
        size = count * d
        many = len(states)
        places = (
            values[:, :size].reshape(many, count, d),
            np.moveaxis(slots[:, :n, :size].reshape(many, n, count, d), 1, -1),
            slots[:, n, :size].reshape(many, count, d),
        )
        if known is not None:
            r_all, J_all, rt_all = (
                np.concatenate(x, axis=1) for x in zip((known.r, known.J, known.rt), places, strict=True)
            )
            return Views(r_all, J_all, rt_all, known.R, known.RJ, p, states, t)
        return Views(
            *places,
            values[:, size:].reshape(many, turns, d, d),
            np.moveaxis(slots[:, :n, size:].reshape(many, n, turns, d, d), 1, -1),
            p,
            states,
            t,
        )

    def random_views(self) -> Views:
        """The stage at random states, with random parameters where these give numbers, otherwise the given ones."""
        rng = np.random.default_rng(3)
        given = self.parameters()
        states = [self._whole(rng.uniform(0.4, 1.3, len(self.inputs.q))) for _ in range(STATES)]
        for parameters in (given * rng.uniform(0.8, 1.25, len(given)), given):
            views = self.views(states, parameters, t=0.37)
            sizes = np.abs([np.abs(views.r).max(initial=0.0), np.abs(views.J).max(initial=0.0)])
            if np.isfinite(sizes).all() and sizes.max() < LARGEST:
                return views
        raise ModelError(
            f"the positions of system '{self.model.name}' are infinite, or have no value, at ordinary coordinates",
            fix="check the expressions of its points",
            code="E402",
        )

    def parameters(self) -> Array:
        """The declared values of the parameters; those without one differ, and angles are half a radian."""
        if self._parameters is None:
            offsets = [x for point in self.points for x in point.offset] + [f.angle for f in self.frames]
            inside = {s for x in offsets for f in x.atoms(sp.sin, sp.cos) for s in f.args[0].free_symbols}
            values = [
                p.value if p.value is not None else 0.5 if p.symbol in inside else max(0.35, 0.88**n)
                for n, p in enumerate(self.model.parameters)
            ]
            self._parameters = np.array(values, float)
        return self._parameters.copy()

    def _whole(self, q: Array) -> Array:
        """The coordinates with unit quaternions."""
        names = [c.name for c in self.model.coordinates]
        for frame in self.model.floating:
            assert frame.floating is not None
            k = names.index(frame.floating.orientation[0].name)
            q[k : k + 4] /= np.linalg.norm(q[k : k + 4])
        return q

    def _at(self, q: Array, p: Array, *, u: float = 0.0, t: float = 0.0) -> Valuation:
        """The values of all nodes at a state at rest; those of the last few states are kept."""
        key = q.tobytes(), p.tobytes(), u, t
        found = self._valuations.pop(key, None)
        if found is None:
            x = [*map(float, q), *[0.0] * len(self.inputs.v)]
            groups = {"x": x, "u": [u] * len(self.inputs.u), "p": [float(v) for v in p], "t": [t]}
            found = Valuation(self.graph, groups)
        self._valuations[key] = found  # the last one used is last
        if len(self._valuations) > KEPT:
            del self._valuations[next(iter(self._valuations))]
        return found

    def _varied(self, states: Sequence[Array], p: Array, t: float) -> Variations:
        """The derivatives of nodes by the coordinates and by time at states; those of the last few lists are kept."""
        key = tuple(q.tobytes() for q in states), p.tobytes(), t
        found = self._variations.pop(key, None)
        if found is None:
            at = [self._at(q, p, t=t) for q in states]
            found = Variations(self.graph, at, (*self.inputs.q, self.inputs.t))
        self._variations[key] = found
        if len(self._variations) > KEPT:
            del self._variations[next(iter(self._variations))]
        return found

    def evaluated(self, expressions: Sequence[sp.Expr], q: Array, p: Array, *, u: float = 0.0) -> Array:
        """The values of expressions in coordinates, parameters and inputs at rest at t = 0, with every input ``u``."""
        nodes = [self.described.node(self.model.expand(x)) for x in expressions]
        return np.array(self._at(q, p, u=u)(nodes), float)

    def value(self, expression: Any, q: Array, p: Array, *, u: float = 0.0) -> float:
        """The value of one expression; see `evaluated`."""
        return float(self.evaluated([sp.sympify(expression)], q, p, u=u)[0])

    def slopes(self, expression: sp.Expr, q: Array, p: Array, *, t: float = 0.0) -> Array:
        """∂(expression)/∂q (n,) at a state."""
        return self._slopes(expression, self.inputs.q, q, p, t)

    def rate_slopes(self, expression: sp.Expr, q: Array, p: Array) -> Array:
        """∂(expression)/∂v (m,) of an expression that is linear in the rates, at a state."""
        return self._slopes(expression, self.inputs.v, q, p)

    def _slopes(self, expression: sp.Expr, seeds: Sequence[int], q: Array, p: Array, t: float = 0.0) -> Array:
        node = self.described.node(self.model.expand(expression))
        return np.array(self._at(q, p, t=t)([jvp(self.graph, [node], {s: self.graph.one})[0] for s in seeds]))
