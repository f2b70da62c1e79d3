"""The motion of axes and places, computed along their parents on the graph.

In space every vector is stored in the axes in which it is known, so a turn about a fixed axis costs four products. In
the plane all vectors are in the fixed axes, and a turn is just an angle. The classes are the same in both cases: `Axes`
turn relative to their parent, and a `PlaceMotion` is offset from its parent in some axes.

    ω = Rᵀ ω_parent + w           α = Rᵀ α_parent + (Rᵀ ω_parent) × w + ẇ
    v = v_parent + ω × r + ṙ      a = a_parent + α × r + ω × (ω × r) + 2 ω × ṙ + r̈

Accelerations are relative to the fixed axes, with components in the body's axes. They depend on the acceleration of the
ground: gravity g has the same effect as a ground that accelerates with −g.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lagrangian.dynamics.axes import Accelerations, Axes, PlaceMotion
from lagrangian.dynamics.rotations import swing
from lagrangian.dynamics.vectors import (
    Matrix,
    Vector,
    bare,
    cross,
    identity,
    minus,
    plus,
    product,
    scaled,
    times,
    transposed,
    zeros,
)
from lagrangian.graph import Graph, Tangents, jvp, operands, reached, vjp


class Motion:
    """Axes and places over coordinates q and velocities v with q̇ = rates(q, v); ``dimension`` is 2 or 3.

    ``root`` are the fixed axes, and ``ground`` is the origin. Parents must be added first.
    """

    def __init__(
        self,
        graph: Graph,
        dimension: int,
        q: Sequence[int],
        v: Sequence[int],
        rates: Sequence[int],
        t: int | None = None,
    ) -> None:
        self.graph, self.dimension = graph, dimension
        self.q, self.v, self.rates, self.t = tuple(q), tuple(v), tuple(rates), t
        self._along = dict(zip(self.q, self.rates, strict=True))
        if t is not None:
            self._along[t] = graph.one
        self._rates = Tangents(graph, self._along)
        self._fixed: dict[int, bool] = {}
        self._swings: dict[tuple[int, int], Axes] = {}
        self._moving = {*self.q, *self.v, *((t,) if t is not None else ())}
        spin = 1 if dimension == 2 else 3
        self.root = Axes(None, identity(graph, dimension), zeros(graph, spin), None, zeros(graph, spin), 0, True)
        none = zeros(graph, dimension)
        self.ground = PlaceMotion(None, self.root, none, none, none, None, none)
        self.axes: list[Axes] = [self.root]
        self.places: list[PlaceMotion] = [self.ground]
        self._rotation: dict[Axes, Matrix] = {self.root: self.root.turn}

    # -- rates --------------------------------------------------------------------------------------------------

    def rate(self, ids: Sequence[int]) -> Vector:
        """The total time derivative of nodes that depend on q and t."""
        return self._rates(ids)

    def second_rate(self, ids: Sequence[int], vdot: Sequence[int]) -> Vector:
        """The total time derivative of nodes that depend on q, v and t, at v̇ = vdot."""
        return jvp(self.graph, ids, {**self._along, **dict(zip(self.v, vdot, strict=True))})

    def along_velocities(self, slopes: Sequence[int]) -> Vector:
        """∂/∂π_k = Σ_j ∂q̇_j/∂v_k ∂/∂q_j of something whose slopes by the coordinates are given."""
        return vjp(self.graph, list(self.rates), slopes, list(self.v))

    # -- building -----------------------------------------------------------------------------------------------

    def turned_axes(self, parent: Axes, turn: Matrix, own: Vector, axis: int | None = None) -> Axes:
        """Add axes in space turned by R = ``turn`` from ``parent``, with angular velocity ``own`` relative to it (own
        axes)."""
        g = self.graph
        omega = plus(g, times(g, transposed(turn), parent.omega), own)
        made = Axes(parent, turn, own, axis, omega, parent.depth + 1, all(w == g.zero for w in own))
        self.axes.append(made)
        return made

    def turned_about(self, parent: Axes, axis: int, angle: int) -> Axes:
        """Add axes in space turned about the parent's coordinate axis 0, 1 or 2 by ``angle``."""
        g = self.graph
        c, s = g.cos(angle), g.sin(angle)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turn = identity(g, 3)
        turn[i][i], turn[i][j], turn[j][i], turn[j][j] = c, g.neg(s), s, c
        own = zeros(g, 3)
        own[axis] = self.rate([angle])[0]
        return self.turned_axes(parent, turn, own, axis)

    def plane_axes(self, parent: Axes, angle: int) -> Axes:
        """Add axes in the plane turned from the fixed axes by ``angle`` (the sum over the parents)."""
        g = self.graph
        c, s = g.cos(angle), g.sin(angle)
        own = self.rate([angle])
        made = Axes(parent, [[c, g.neg(s)], [s, c]], own, None, own, parent.depth + 1)
        self.axes.append(made)
        return made

    def place(self, parent: PlaceMotion, axes: Axes, offset: Sequence[int]) -> PlaceMotion:
        """Add a place at ``offset``, in ``axes``, from ``parent``."""
        g = self.graph
        if self.dimension == 2:
            step = times(g, axes.turn, offset)
            change = self.rate(step)
            made = PlaceMotion(parent, self.root, step, change, plus(g, parent.velocity, change))
            made.given = (axes, list(offset)) if axes is not self.root else self._carried(step)
        else:
            change = self.rate(offset)
            carried = plus(g, self.turned(parent.velocity, parent.axes, axes), cross(g, axes.omega, offset))
            made = PlaceMotion(parent, axes, list(offset), change, plus(g, carried, change))
        self.places.append(made)
        return made

    def _carried(self, step: Sequence[int]) -> tuple[Axes, Vector]:
        """The axes that carry a step of constant length, and the step in them; the root if there are none."""
        g = self.graph
        found = swing(g, step)
        if found is None or not self.constant([found.length]):
            return self.root, list(step)
        c, s = found.direction
        if (c, s) not in self._swings:
            rate = self.rate([found.angle])[0]
            own = [rate if found.forwards else g.neg(rate)]
            made = Axes(self.root, [[c, g.neg(s)], [s, c]], own, None, own, 1)
            self.axes.append(made)
            self._swings[c, s] = made
        return self._swings[c, s], [found.length, g.zero]

    def floating(self, position: Sequence[int], axes: Axes, velocity: Sequence[int]) -> PlaceMotion:
        """Add a place at ``position`` (fixed axes) whose velocity has the components ``velocity`` in ``axes``."""
        none = zeros(self.graph, self.dimension)
        made = PlaceMotion(self.ground, axes, none, none, list(velocity), list(velocity), list(position))
        self.places.append(made)
        return made

    # -- using --------------------------------------------------------------------------------------------------

    def turned(self, x: Sequence[int], source: Axes, target: Axes) -> Vector:
        """The vector x, with components in ``source``, converted to ``target``; in the plane all vectors are in the
        root."""
        if source is target or self.dimension == 2:
            return list(x)
        g = self.graph
        down: list[Axes] = []
        up = source
        while up is not target:
            if up.depth >= target.depth and up.parent is not None:
                x = times(g, up.turn, x)
                up = up.parent
            else:
                assert target.parent is not None
                down.append(target)
                target = target.parent
        for axes in reversed(down):
            x = times(g, transposed(axes.turn), x)
        return list(x)

    def rotation(self, axes: Axes) -> Matrix:
        """R from ``axes`` to the fixed axes."""
        if self.dimension == 2:
            return axes.turn
        chain: list[Axes] = []
        at = axes
        while at not in self._rotation:
            chain.append(at)
            assert at.parent is not None
            at = at.parent
        for below in reversed(chain):
            assert below.parent is not None
            self._rotation[below] = product(self.graph, self._rotation[below.parent], below.turn)
        return self._rotation[axes]

    def position(self, place: PlaceMotion) -> Vector:
        """The position of a place relative to the origin, in the fixed axes."""
        chain: list[PlaceMotion] = []
        at = place
        while at.position is None:
            chain.append(at)
            assert at.parent is not None
            at = at.parent
        for below in reversed(chain):
            assert below.parent is not None and below.parent.position is not None
            below.position = plus(self.graph, below.parent.position, self._step(below))
        assert place.position is not None
        return place.position

    def _step(self, place: PlaceMotion) -> Vector:
        """The offset of a place in the fixed axes."""
        if place.slide is not None:
            assert place.position is not None
            return place.position
        return times(self.graph, self.rotation(place.axes), place.offset)

    def between(self, start: PlaceMotion, end: PlaceMotion) -> Vector:
        """r_end − r_start in the fixed axes; steps that both have in common cancel before anything is computed."""
        above: set[PlaceMotion] = set()
        at: PlaceMotion | None = start
        while at is not None:
            above.add(at)
            at = at.parent
        common = end
        while common not in above:
            assert common.parent is not None
            common = common.parent
        return minus(self.graph, self._from(common, end), self._from(common, start))

    def _from(self, common: PlaceMotion, place: PlaceMotion) -> Vector:
        total = zeros(self.graph, self.dimension)
        while place is not common:
            total = plus(self.graph, self._step(place), total)
            assert place.parent is not None
            place = place.parent
        return total

    def accelerations(
        self, vdot: Sequence[int], ground: Sequence[int], free: Mapping[int, int] | None = None
    ) -> Accelerations:
        """All accelerations for v̇ = vdot, with the ground accelerating at ``ground`` (fixed axes).

        ``free`` (from `free_rates`) maps velocities to their numbers; their v̇ is instead chosen so that the component
        of α or a that they drive vanishes. This is possible because the equations are linear in v̇, and leaves fewer
        terms.
        """
        found = Accelerations(list(vdot), {}, {self.ground: list(ground)})
        free = free or {}
        if self.dimension == 2:
            turning = self.second_rate([a.own[0] for a in self.axes], vdot)
            found.alpha = {a: [x] for a, x in zip(self.axes, turning, strict=True)}
            changes = self.second_rate([x for p in self.places for x in p.offset_rate], vdot)
            for n, place in enumerate(self.places):
                if place.parent is not None:
                    found.a[place] = plus(self.graph, found.a[place.parent], changes[2 * n : 2 * n + 2])
            return found
        self._alphas(vdot, found, free)
        changes = self.second_rate([x for p in self.places for x in (p.slide or p.offset_rate)], vdot)
        for n, place in enumerate(self.places):
            if place.parent is not None:
                a = self._acceleration(place, found)
                driven = place.slide or place.offset_rate
                found.a[place] = self._settled(a, driven, changes[3 * n : 3 * n + 3], found, free)
        return found

    def _settled(
        self, a: Vector, driven: Vector, change: Sequence[int], found: Accelerations, free: Mapping[int, int]
    ) -> Vector:
        """a + change, component by component, or 0 if the velocity that drives it is free: then v̇ = ∓a."""
        g, total = self.graph, []
        for x, drive, c in zip(a, driven, change, strict=True):
            driver, negative = bare(g, drive)
            if driver in free:
                found.vdot[free[driver]] = x if negative else g.neg(x)
                total.append(g.zero)
            else:
                total.append(g.add(x, c))
        return total

    def free_rates(self) -> dict[int, int]:
        """Velocities that drive only one component of one thing (such as a joint's own rotation) → their number."""
        if self.dimension == 2:
            return {}
        entries = [x for axes in self.axes for x in axes.own]
        entries += [x for place in self.places for x in (place.slide or place.offset_rate)]
        number = {v: i for i, v in enumerate(self.v)}
        alone: dict[int, int] = {}
        mixed: list[int] = []
        for x in entries:
            driver, _ = bare(self.graph, x)
            if driver in number:
                alone[driver] = alone.get(driver, 0) + 1
            else:
                mixed.append(x)
        shared = set(reached(self.graph, mixed))
        return {v: number[v] for v, count in alone.items() if count == 1 and v not in shared}

    def _alphas(self, vdot: Sequence[int], found: Accelerations, free: Mapping[int, int]) -> None:
        """α = Rᵀ α_parent + (Rᵀ ω_parent) × w + ẇ."""
        g = self.graph
        changes = self.second_rate([w for a in self.axes for w in a.own], vdot)
        found.alpha[self.root] = zeros(g, 3)
        for n, axes in enumerate(self.axes):
            if axes.parent is None:
                continue
            back = transposed(axes.turn)
            carried = times(g, back, found.alpha[axes.parent])
            gyro = cross(g, times(g, back, axes.parent.omega), axes.own)
            total = plus(g, carried, gyro)
            found.alpha[axes] = self._settled(total, axes.own, changes[3 * n : 3 * n + 3], found, free)

    def _acceleration(self, place: PlaceMotion, found: Accelerations) -> Vector:
        """a_parent + A r + 2 ω × ṙ (r̈ is to come),  A = [α]× + [ω]×²; of a floating place  a_ground + ω × v."""
        g = self.graph
        axes, parent = place.axes, place.parent
        assert parent is not None
        total = self.turned(found.a[parent], parent.axes, axes)
        if place.slide is not None:
            return plus(g, total, cross(g, axes.omega, place.slide))
        if any(x != g.zero for x in place.offset):
            total = plus(g, total, times(g, self.spin(axes, found), place.offset))
        if any(x != g.zero for x in place.offset_rate):
            total = plus(g, total, scaled(g, g.const(2.0), cross(g, axes.omega, place.offset_rate)))
        return total

    def spin(self, axes: Axes, found: Accelerations) -> Matrix:
        """A = [α]× + ω ωᵀ − |ω|² 1: the acceleration of a point fixed in ``axes`` at r is A r."""
        g = self.graph
        x, y, z = axes.omega
        ax, ay, az = found.alpha[axes]
        xx, yy, zz = g.mul(x, x), g.mul(y, y), g.mul(z, z)
        xy, xz, yz = g.mul(x, y), g.mul(x, z), g.mul(y, z)
        return [
            [g.neg(g.add(yy, zz)), g.sub(xy, az), g.add(xz, ay)],
            [g.add(xy, az), g.neg(g.add(xx, zz)), g.sub(yz, ax)],
            [g.sub(xz, ay), g.add(yz, ax), g.neg(g.add(xx, yy))],
        ]

    # -- questions ----------------------------------------------------------------------------------------------

    def constant(self, ids: Sequence[int]) -> bool:
        """Whether nodes depend only on parameters and numbers."""
        nodes, known = self.graph.nodes, self._fixed
        stack = list(ids)
        while stack:
            i = stack[-1]
            node = nodes[i]
            waiting = [k for k in operands(node) if k not in known]
            if i not in known and waiting:
                stack.extend(waiting)
                continue
            known[i] = node[:2] != ("input", "u") and i not in self._moving and all(known[k] for k in operands(node))
            stack.pop()
        return all(known[i] for i in ids)

    def base(self, axes: Axes) -> tuple[Axes, Matrix]:
        """The nearest axes above (or these) that move relative to their parent, and R from ``axes`` to them."""
        g = self.graph
        turn = identity(g, 3)
        while axes.steady and axes.parent is not None:
            turn = product(g, axes.turn, turn)
            axes = axes.parent
        return axes, turn

    def anchor(self, place: PlaceMotion, axes: Axes) -> tuple[PlaceMotion, Vector]:
        """The farthest place above that is at rest relative to ``place`` in ``axes``, and r from there, in ``axes``.

        In space ``axes`` must be a `base`.
        """
        g = self.graph
        r = zeros(g, self.dimension)
        while place.parent is not None and place.slide is None:
            if self.dimension == 2:
                assert place.given is not None
                home, step = place.given
            else:
                home, turn = self.base(place.axes)
                step = times(g, turn, place.offset)
            if home is not axes or not self.constant(step):
                break
            r = plus(g, r, step)
            place = place.parent
        return place, r
