"""Forward dynamics of point masses on massless rods: the tensions first, the accelerations from them.

Rod k leads from a point P, which may be the ground, to a mass C at L n from it, n a unit vector that turns with φ̇, and
e is n turned by a quarter. The rod carries a tension along n, and what acts on its turn, τ, presses across it with
S = τ/L. With the inverse masses W of the points,

    f_k = T_k n_k + S_k e_k,        a_C = W_C (F_C + Σ ± f),
    n_k · (a_C − a_P) = −L φ̇²,      e_k · (a_C − a_P) = L φ̈.

The first of these lines has the matrix Bᵀ W B, where B says which rods end at which mass. It is positive definite
since every rod has a mass of its own at its end, and tridiagonal for a chain; a tree is eliminated from its tips
inwards. It is divided by masses and lengths, which are constant, and by those pivots, and by nothing else.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lagrangian.dynamics.accelerations import Elimination, Quadratic
from lagrangian.dynamics.axes import Axes, PlaceMotion
from lagrangian.dynamics.motion import Motion
from lagrangian.dynamics.tape import EliminationTape, Form, make_tape
from lagrangian.dynamics.vectors import Vector, bare, dot, minus, plus, scaled, times, zeros
from lagrangian.graph import Graph, count_operations
from lagrangian.records import dataclass, field

MEETING = 8
"""Up to this number of rods may meet at a mass: every two of them are coupled."""

Ends = list[tuple[int, "MassPoint"]]
"""The mass points at the ends of a rod: +1 with the one that it leads to, −1 with the one that it comes from."""

Drawn = dict[int, tuple[int, Form]]
"""Velocity → the spin of a rod and its form, in which the velocity has a factor ±1 and the others are spins."""


@dataclass(eq=False)
class MassPoint:
    """A point mass: W along x and y (0 where it cannot move), the forces on it, and v̇'s numbers of a point that is on
    no rod.
    """

    W: Vector
    force: Vector
    free: dict[int, int] = field(default_factory=dict[int, int])
    rods: list[tuple[int, int]] = field(default_factory=list[tuple[int, int]])


@dataclass(eq=False)
class Rod:
    """A massless rod of constant ``length``, which may be negative, along ``n``; τ is what acts on its turn."""

    axes: Axes
    ends: Ends
    length: int
    n: Vector
    torque: int

    def across(self, g: Graph) -> Vector:
        """e: n turned by a quarter."""
        return [g.neg(self.n[1]), self.n[0]]


class Framework:
    """Point masses on rods, recognised in a motion in the plane; ``rods`` come before those that hang on them."""

    def __init__(self, motion: Motion, down: Sequence[int]) -> None:
        self.motion, self.graph, self.down = motion, motion.graph, list(down)
        self.points: dict[PlaceMotion, MassPoint] = {}
        self.rods: list[Rod] = []
        self.subtracting = False  # whether the turn from one rod to the next is one angle

    # -- recognising --------------------------------------------------------------------------------------------

    def built(self, masses: Mapping[PlaceMotion, int]) -> bool:
        """Whether all masses are at ends of rods, or are carried along x, y or both by a velocity of their own."""
        motion, g = self.motion, self.graph
        for place in motion.places:
            if (m := masses.get(place)) is None:
                continue
            w = g.div(g.one, m)
            self.points[place] = point = MassPoint([w, w], zeros(g, 2))
            if not motion.constant([m]) or not (self._swung(place, point) or self._carried(place, point)):
                return False
        few = all(len(point.rods) <= MEETING for point in self.points.values())
        return few and len(self.points) == len(masses) and len({rod.axes for rod in self.rods}) == len(self.rods)

    def _swung(self, place: PlaceMotion, point: MassPoint) -> bool:
        g, parent = self.graph, place.parent
        if place.given is None or parent is None or place.slide is not None:
            return False
        axes, (x, y) = place.given
        if axes is self.motion.root or not self.motion.constant([x, y]):
            return False
        ends: Ends = [(1, point)]
        if parent in self.points:
            ends.append((-1, self.points[parent]))
        elif not self._rests(parent):
            return False
        if x == g.zero or y == g.zero:
            length, negative = bare(g, y if x == g.zero else x)
            n = [row[1 if x == g.zero else 0] for row in axes.turn]
            n = [g.neg(c) for c in n] if negative else n
        else:
            length = g.sqrt(dot(g, (x, y), (x, y)))
            n = times(g, axes.turn, [g.div(x, length), g.div(y, length)])
        for sign, end in ends:
            end.rods.append((sign, len(self.rods)))
        self.rods.append(Rod(axes, ends, length, n, g.zero))
        return True

    def _rests(self, place: PlaceMotion) -> bool:
        """Whether a place is fixed to the ground."""
        at: PlaceMotion | None = place
        while at is not None and at.slide is None and all(x == self.graph.zero for x in at.offset_rate):
            at = at.parent
        return at is None

    def _carried(self, place: PlaceMotion, point: MassPoint) -> bool:
        """Whether a mass moves along x, y or both, each with a velocity of its own."""
        g, motion = self.graph, self.motion
        if place.parent is None or place.slide is not None or not self._rests(place.parent):
            return False
        for k, rate in enumerate(place.offset_rate):
            if rate in motion.v:
                point.free[k] = motion.v.index(rate)
            elif rate == g.zero:
                point.W[k] = g.zero
            else:
                return False
        return True

    def loaded(self, linear: Mapping[int, int]) -> Drawn | None:
        """Distribute loads on nodes to points and rods; return how v̇ comes from the spins of rods.

        None where a velocity is neither a spin of a rod, nor added to one by a factor ±1, nor that of a carried point.
        """
        g, motion = self.graph, self.motion
        spins = {bare(g, rod.axes.own[0])[0]: rod for rod in self.rods}
        kept = {rate: (p, k) for place, p in self.points.items() for k, rate in enumerate(place.velocity)}
        kept.pop(g.zero, None)
        tape = make_tape(g, list(dict.fromkeys((*kept, *spins, *linear))), motion.v)
        drawn: Drawn = {}
        for spin in spins:
            form = tape.forms.get(spin, {spin: g.one})
            own = [i for i in form if i not in spins or i == spin]
            if len(own) != 1 or any(c not in (g.one, g.negative) for c in form.values()) or own[0] in drawn:
                return None
            drawn[own[0]] = spin, form
        free = [motion.v[i] for p in self.points.values() for i in p.free.values()]
        if len(spins) != len(self.rods) or sorted([*free, *drawn]) != sorted(motion.v):
            return None
        if any(
            x != g.zero for x in motion.second_rate([rod.axes.own[0] for rod in self.rods], zeros(g, len(motion.v)))
        ):
            return None
        self._distribute(tape, dict(linear), kept, spins, drawn)
        return drawn

    def _distribute(
        self,
        tape: EliminationTape,
        load: dict[int, int],
        kept: Mapping[int, tuple[MassPoint, int]],
        spins: Mapping[int, Rod],
        drawn: Drawn,
    ) -> None:
        g = self.graph
        for i in reversed(tape.order):
            if i in kept or i in spins or i not in load:
                continue
            x = load.pop(i)
            if i in tape.forms:
                for j, c in tape.forms[i].items():
                    load[j] = g.add(load.get(j, g.zero), g.mul(c, x))
                continue
            spin, form = drawn[i]
            x = g.mul(form[i], x)
            for j, c in form.items():
                if j != i:
                    load[j] = g.sub(load.get(j, g.zero), g.mul(c, x))
            load[spin] = g.add(load.get(spin, g.zero), x)
        for i, x in load.items():
            if i in kept:
                point, k = kept[i]
                point.force[k] = g.neg(x)
            elif i in spins:
                negative = bare(g, spins[i].axes.own[0])[1]
                spins[i].torque = x if negative else g.neg(x)

    # -- solving ------------------------------------------------------------------------------------------------

    def solved(self, drawn: Drawn) -> list[int]:
        """The tensions, L φ̈ of every rod from them, and v̇ from that."""
        g = self.graph
        press = [g.div(rod.torque, rod.length) for rod in self.rods]
        H, linear, turning = Quadratic(g), dict[int, int](), list[int]()
        for k, rod in enumerate(self.rods):
            rate, apart = rod.axes.own[0], self._apart(rod)
            linear[k] = g.add(g.mul(rod.length, g.mul(rate, rate)), dot(g, rod.n, apart))
            turning.append(dot(g, rod.across(g), apart))
        links: list[tuple[int, int, int]] = []  # T_k enters L φ̈ of rod j by a factor
        for point in self.points.values():
            for a, (s, j) in enumerate(point.rods):
                for t, k in point.rods[a:]:
                    nn, ne, en, ee = self._between(point.W, j, k, same=s == t)
                    H.add(j, k, nn)
                    links += [(j, k, en)] if j == k else [(j, k, en), (k, j, ne)]
                    for x, y, across in ((j, k, ne), (k, j, en))[: 1 if j == k else 2]:
                        linear[x] = g.add(linear[x], g.mul(across, press[y]))
                        turning[x] = g.add(turning[x], g.mul(ee, press[y]))
        solver = Elimination(g, EliminationTape(), H, linear, {})
        for k in reversed(range(len(self.rods))):
            solver.minimise(k, "?")
        T = solver.accelerations()
        for j, k, factor in links:
            turning[j] = g.add(turning[j], g.mul(factor, T[k]))
        return self._drawn(
            drawn,
            turning,
            [plus(g, scaled(g, T[k], rod.n), scaled(g, press[k], rod.across(g))) for k, rod in enumerate(self.rods)],
        )

    def _still(self, point: MassPoint) -> Vector:
        """The acceleration of a mass point without forces of rods, relative to free fall."""
        g = self.graph
        return [
            g.neg(d) if w == g.zero else g.mul(w, f) for w, f, d in zip(point.W, point.force, self.down, strict=True)
        ]

    def _apart(self, rod: Rod) -> Vector:
        """The difference of these accelerations between the ends of a rod."""
        g = self.graph
        start = self._still(rod.ends[1][1]) if len(rod.ends) == 2 else [g.neg(d) for d in self.down]
        return minus(g, self._still(rod.ends[0][1]), start)

    def _between(self, W: Vector, j: int, k: int, *, same: bool) -> Vector:
        """± n_j·W n_k, n_j·W e_k, e_j·W n_k and e_j·W e_k, negative where the point is at different ends."""
        g = self.graph
        one, other = self.rods[j], self.rods[k]
        if W[0] == W[1]:
            if j == k:
                return [W[0], g.zero, g.zero, W[0]]
            (a, b), (c, d) = one.n, other.n
            w = W[0] if same else g.neg(W[0])
            turn = turn_between(g, one.n, other.n) if self.subtracting else None
            cosine, sine = turn or (dot(g, one.n, other.n), g.sub(g.mul(a, d), g.mul(b, c)))
            along, across = g.mul(w, cosine), g.mul(w, sine)
            return [along, g.neg(across), across, along]
        total = [
            dot(g, u, [g.mul(w, x) for w, x in zip(W, v, strict=True)])
            for u in (one.n, one.across(g))
            for v in (other.n, other.across(g))
        ]
        return total if same else [g.neg(x) for x in total]

    def _drawn(self, drawn: Drawn, turning: Sequence[int], forces: Sequence[Vector]) -> list[int]:
        """v̇ from L φ̈ of the rods and their forces."""
        g, v = self.graph, self.motion.v
        spin: dict[int, int] = {}
        for rod, x in zip(self.rods, turning, strict=True):
            node, negative = bare(g, rod.axes.own[0])
            alpha = g.div(x, rod.length)
            spin[node] = g.neg(alpha) if negative else alpha
        value: dict[int, int] = {}
        for own, (node, form) in drawn.items():
            total = spin[node]
            for j, c in form.items():
                if j != own:
                    total = g.sub(total, g.mul(c, spin[j]))
            value[own] = g.mul(form[own], total)
        for point in self.points.values():
            still = self._still(point)
            for axis, i in point.free.items():
                a = g.add(still[axis], self.down[axis])
                for sign, k in point.rods:
                    push = g.mul(point.W[axis], forces[k][axis])
                    a = g.add(a, push) if sign == 1 else g.sub(a, push)
                value[v[i]] = a
        return [value[x] for x in v]


def turn_between(g: Graph, n: Vector, other: Vector) -> tuple[int, int] | None:
    """The cosine and the sine of the angle from a unit vector to another, or None where they are not (±cos, ±sin)."""
    first, second = direction(g, n), direction(g, other)
    if first is None or second is None:
        return None
    (a, back, quarters), (b, reverse, more) = first, second
    if back != reverse:
        angle = g.add(a, b)
    elif g.nodes[b][0] == "add" and a in g.nodes[b][1:]:
        angle = g.nodes[b][1] if g.nodes[b][2] == a else g.nodes[b][2]  # relative angles add up
    else:
        angle = g.sub(b, a)
    c, s = g.cos(angle), g.sin(angle)
    for _ in range((more - quarters) % 4 if not reverse else (quarters - more) % 4):
        c, s = g.neg(s), c
    return c, g.neg(s) if reverse else s


def direction(g: Graph, n: Vector) -> tuple[int, bool, int] | None:
    """(a, back, k) of n = (cos φ, sin φ) with φ = ±a + k π/2, minus where ``back``; None where n is no such vector."""
    (x, left), (y, below) = (bare(g, component) for component in n)
    kinds, angles = (g.nodes[x][0], g.nodes[y][0]), {g.nodes[x][1:2], g.nodes[y][1:2]}
    if len(angles) != 1 or kinds not in (("cos", "sin"), ("sin", "cos")):
        return None
    a = int(g.nodes[x][1])
    if kinds[0] == "cos":
        return a, left != below, 2 if left else 0
    return a, left == below, 3 if below else 1


def by_tensions(
    motion: Motion, masses: Mapping[PlaceMotion, int], down: Sequence[int], linear: Mapping[int, int]
) -> list[int] | None:
    """v̇ of point masses on rods under the loads ``linear`` (velocity node → minus the force), weights apart.

    None where the motion is not one of point masses on massless rods.
    """
    if motion.dimension != 2 or not masses:
        return None
    made = Framework(motion, down)
    drawn = made.loaded(linear) if made.built(masses) else None
    if drawn is None:
        return None
    found = [made.solved(drawn)]
    made.subtracting = True
    found.append(made.solved(drawn))
    counts = [count_operations(motion.graph, x, hoist=["p"]) for x in found]
    return min(zip(counts, found, strict=True), key=lambda pair: (pair[0].sincos, pair[0].operations))[1]
