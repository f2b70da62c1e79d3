"""A mechanical system on the graph, independent of how it was described.

All programs are computed from the nodes of a `Mechanics`. The equations of motion by virtual work are

    r_i = Σ_b (inertial force − applied force) · ∂(velocity of b)/∂v_i = 0

which takes one reverse pass over the velocities, with the forces as cotangents.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from functools import cached_property

from lagrangian.dynamics.accelerations import Quadratic, by_columns, condensed, solve
from lagrangian.dynamics.axes import Accelerations
from lagrangian.dynamics.bodies import Bodies
from lagrangian.dynamics.dependent import Known, Repeated, without_dependent
from lagrangian.dynamics.drags import AttachedDrag, dragged_by
from lagrangian.dynamics.floating import Float, transported_momenta
from lagrangian.dynamics.inertia import AnyLink
from lagrangian.dynamics.motion import Motion
from lagrangian.dynamics.row_problem import AttachedRow, Problem, RowSolution
from lagrangian.dynamics.rows import Added, ConstraintRow, Drag
from lagrangian.dynamics.tape import make_tape, maximal_linear_nodes, moving_nodes
from lagrangian.dynamics.tensions import by_tensions
from lagrangian.dynamics.turned_rates import in_speeds_of_rows
from lagrangian.dynamics.vectors import bare, dot, minus, plus, zeros
from lagrangian.graph import Graph, count_operations, gradient, hessian, vjp
from lagrangian.model.spare import SpareRows
from lagrangian.records import dataclass, field

Pairs = list[tuple[int, int]]

SMALL = 12
"""Up to this many velocities, the elimination of the dense mass matrix is tried as well."""

DENSE = 24
"""Up to this many velocities, it is tried as well if there are rows."""

MANY = 100
"""Up to this many velocities, all ways along the tape are tried; above, only the one that is best for long chains."""


@dataclass
class Mechanics:
    """A mechanical system as nodes of ``graph``.

    ``names`` say what each velocity v moves; q̇ = ``motion.rates``; ``floats`` are the bodies that move by
    quasi-velocities. ``down`` is the acceleration of gravity in the fixed axes. ``efforts`` are (rate, effort) pairs:
    their power is Σ rate · effort, and Ξ_i = Σ effort · ∂rate/∂v_i. ``stores`` are the (rate, effort) pairs of the
    energies in ``potentials``. ``kinetics`` are kinetic co-energies that were given directly, ``losses`` the powers
    that dampers take. ``rows`` are the rows of constraints, ``spare`` the sets in which some are known to follow from
    others along the motion. ``drags`` are frictions whose normal forces are multipliers of rows. ``added`` is
    what each element added, by its title. ``known`` are the orders of elimination that other programs found.
    """

    graph: Graph
    motion: Motion
    bodies: Bodies
    names: tuple[str, ...]
    down: list[int]
    efforts: Pairs = field(default_factory=list)
    stores: Pairs = field(default_factory=list)
    potentials: list[int] = field(default_factory=list)
    kinetics: list[int] = field(default_factory=list)
    losses: list[int] = field(default_factory=list)
    rows: list[ConstraintRow] = field(default_factory=list)
    floats: tuple[Float, ...] = ()
    spare: tuple[SpareRows, ...] = ()
    drags: list[Drag] = field(default_factory=list)
    added: dict[str, Added] = field(default_factory=dict[str, Added])
    known: dict[tuple[str, ...], Known] = field(default_factory=dict)

    @property
    def q(self) -> tuple[int, ...]:
        """The coordinates."""
        return self.motion.q

    @property
    def v(self) -> tuple[int, ...]:
        """The velocities: rates of the coordinates, or quasi-velocities."""
        return self.motion.v

    @cached_property
    def links(self) -> list[AnyLink]:
        """The bodies as described."""
        return self.bodies.links

    @cached_property
    def groupings(self) -> list[list[AnyLink]]:
        """Equivalent arrangements of links, whose operations are counted."""
        return self.bodies.groupings()

    def cheapest(self, candidates: Iterable[list[int]]) -> list[int]:
        """The nodes that need the fewest operations, with hoisted parameters."""
        return min(candidates, key=lambda ids: count_operations(self.graph, ids, hoist=["p"]).operations)

    # -- what acts ----------------------------------------------------------------------------------------------

    def accelerations(self, vdot: Sequence[int], *, free: bool = False) -> Accelerations:
        """Accelerations for v̇ = vdot relative to free fall: the ground accelerates with −g.

        With ``free``, v̇ is chosen so that components vanish if possible (`Motion.free_rates`).
        """
        ground = [self.graph.neg(x) for x in self.down]
        return self.motion.accelerations(vdot, ground, self.motion.free_rates() if free else None)

    def raw_inertial(self, vdot: Sequence[int]) -> Pairs:
        """d/dt ∂T/∂v − ∂T/∂q of kinetic co-energies that were given directly, for the velocities."""
        return list(zip(self.v, self._lagrange(self.raw_kinetic, vdot), strict=True)) if self.kinetics else []

    def _lagrange(self, L: int, vdot: Sequence[int]) -> list[int]:
        """d/dt ∂L/∂v − Nᵀ ∂L/∂q, minus ad_uᵀ ∂L/∂u for quasi-velocities (`floating` has the formula)."""
        g, motion = self.graph, self.motion
        momenta = gradient(g, L, self.v)
        rates = motion.second_rate(momenta, vdot)
        forces = self.motion.along_velocities(gradient(g, L, self.q))
        if self.floats:
            forces = plus(g, forces, transported_momenta(g, self.floats, self.v, momenta))
        return minus(g, rates, forces)

    @property
    def raw_kinetic(self) -> int:
        """The sum of the kinetic co-energies that were given directly."""
        return self._sum(self.kinetics)

    def _sum(self, ids: Sequence[int]) -> int:
        total = self.graph.zero
        for x in ids:
            total = self.graph.add(total, x)
        return total

    def missing(self, acc: Accelerations, links: Sequence[AnyLink]) -> Pairs:
        """Pairs (velocity, missing force) for given accelerations: inertial minus applied, including weights."""
        inertial = [pair for link in links for pair in link.wrench(self.motion, acc)]
        return [*inertial, *self.raw_inertial(acc.vdot), *self._applied]

    @property
    def _applied(self) -> Pairs:
        return [(rate, self.graph.neg(effort)) for rate, effort in (*self.stores, *self.efforts)]

    @cached_property
    def dragged(self) -> Pairs:
        """The frictions whose normal forces are multipliers, with those multipliers, as (rate, effort) pairs."""
        if not self.drags:
            return []
        names = [row.name for row in self.rows]
        return self.dragged_by(dict(zip(names, self.constrained.multipliers, strict=True)))

    def dragged_by(self, multipliers: Mapping[str, int]) -> Pairs:
        """The same with multipliers that are given by the names of their rows."""
        return dragged_by(self.graph, self.drags, multipliers)

    def gathered(self, pairs: Pairs) -> list[int]:
        """Σ effort · ∂rate/∂v_i of (rate, effort) pairs."""
        g = self.graph
        total: dict[int, int] = {}
        for rate, effort in pairs:
            if effort != g.zero and rate != g.zero:
                total[rate] = g.add(total.get(rate, g.zero), effort)
        return vjp(g, list(total), list(total.values()), list(self.v))

    # -- what comes of it ---------------------------------------------------------------------------------------

    def inverse(self, vdot: Sequence[int], dragged: Pairs | None = None) -> list[int]:
        """The missing generalized forces M v̇ + C v + G − Ξ; ``dragged`` is `dragged` where λ is not solved for."""
        acc = self.accelerations(vdot)
        drags = [(rate, self.graph.neg(effort)) for rate, effort in (self.dragged if dragged is None else dragged)]
        return self.cheapest(self.gathered([*self.missing(acc, links), *drags]) for links in self.groupings)

    def bias(self) -> list[int]:
        """`inverse` at v̇ = 0."""
        return self.inverse(zeros(self.graph, len(self.v)))

    def inertia(self, links: Sequence[AnyLink]) -> Quadratic:
        """H over the velocity nodes: T = ½ Σ H_ik v_i v_k."""
        g, motion = self.graph, self.motion
        H = Quadratic(g)
        triples = [triple for link in links for triple in link.seeds(motion)]
        triples = [triple for triple in triples if g.zero not in triple]
        moving = set(moving_nodes(g, {i for pair in triples for i in pair[:2]}, self.v))
        for i, k, h in triples:
            if i in moving and k in moving:
                (i, si), (k, sk) = bare(g, i), bare(g, k)
                H.couple(i, k, h if si == sk else g.neg(h))
        if self.kinetics:
            nodes = maximal_linear_nodes(g, self.raw_kinetic, self.v)
            for (i, k), h in hessian(g, self.raw_kinetic, nodes).items():
                if i <= k:
                    H.add(nodes[i], nodes[k], h)
        return H

    def mass_matrix(self) -> list[list[int]]:
        """M, row after row, by columns or by condensing the tape, whichever is cheaper."""
        return self._mass_matrix

    @cached_property
    def _mass_matrix(self) -> list[list[int]]:
        g, n = self.graph, len(self.v)
        found = []
        for links in self.groupings:
            H = self.inertia(links)
            for rows in (by_columns(g, H, self.v), condensed(g, make_tape(g, list(H.rows), self.v), H, self.v)):
                found.append([x for row in rows for x in row])
        flat = self.cheapest(found)
        return [flat[i * n : (i + 1) * n] for i in range(n)]

    # -- energies -----------------------------------------------------------------------------------------------

    def kinetic(self) -> int:
        """T* of all bodies as described, plus the kinetic co-energies that were given directly."""
        g = self.graph
        total = self.raw_kinetic
        for link in self.links:
            for i, k, h in link.seeds(self.motion):
                total = g.add(total, g.mul(h, g.mul(i, k)))
        return total

    def potential(self) -> int:
        """V: the stored energies, and −m g·r for the mass of every link."""
        g, motion = self.graph, self.motion
        total = self._sum(self.potentials)
        if any(x != g.zero for x in self.down):
            for link in self.links:
                total = g.sub(total, dot(g, self.down, link.moment(motion)))
        return total

    def loss(self) -> int:
        """The power that dampers and friction take."""
        g = self.graph
        return self._sum([*self.losses, *(g.neg(g.mul(effort, rate)) for rate, effort in self.dragged)])

    def potential_force(self) -> list[int]:
        """G = ∂V/∂q, for the velocities."""
        g = self.graph
        return vjp(g, list(self.motion.rates), gradient(g, self.potential(), self.q), list(self.v))

    def inverse_from_lagrangian(self, vdot: Sequence[int], dragged: Pairs | None = None) -> list[int]:
        """d/dt ∂L/∂v − ∂L/∂q − Ξ of L = T − V, the independent route to `inverse`."""
        g = self.graph
        L = g.sub(self.kinetic(), self.potential())
        drags = self.dragged if dragged is None else dragged
        return minus(g, self._lagrange(L, vdot), self.gathered([*self.efforts, *drags]))

    # -- forward dynamics ---------------------------------------------------------------------------------------

    def forward(self) -> list[int]:
        """v̇, by the cheapest of the eliminations: along the tape or of the mass matrix, with either reference."""
        if self.rows:
            return self.constrained.vdot
        n = len(self.v)
        references = (True, False) if self.motion.free_rates() else (True,)
        found: list[list[int]] = []
        for links in self.groupings if n <= MANY else self.groupings[:1]:
            for free in references:
                found.append(self.along_tape(links, free=free, exchange=True))
                if n <= SMALL:
                    found.append(self.by_mass_matrix(links, free=free))
            if n <= MANY:
                found.append(self.along_tape(links, free=True, exchange=False))
        if (tensions := self.tensions_first()) is not None:
            found.append(tensions)
        return self.cheapest(found)

    def tensions_first(self) -> list[int] | None:
        """v̇ by the tensions of massless rods between point masses, or None where there is more than those."""
        if self.kinetics or self.floats:
            return None
        return by_tensions(self.motion, self.bodies.point_masses, self.down, self._linear(self._applied))

    def along_tape(self, links: Sequence[AnyLink], *, free: bool, exchange: bool) -> list[int]:
        """v̇ = reference + the result of the elimination of the tape."""
        g, H = self.graph, self.inertia(links)
        acc = self.accelerations(zeros(g, len(self.v)), free=free)
        linear = self._linear(self.missing(acc, links))
        tape = make_tape(g, list(dict.fromkeys((*H.rows, *linear))), self.v, H.rows if exchange else None)
        return plus(g, acc.vdot, solve(g, tape, H, linear, self.v, self._named))

    @property
    def _named(self) -> dict[int, str]:
        return dict(zip(self.v, self.names, strict=True))

    def by_mass_matrix(self, links: Sequence[AnyLink], *, free: bool) -> list[int]:
        """Solve M v̇ = −bias by LDLᵀ: the elimination with no tape between the rates and H."""
        g, H = self.graph, self._dense
        acc = self.accelerations(zeros(g, len(self.v)), free=free)
        linear = dict(zip(self.v, self.gathered(self.missing(acc, links)), strict=True))
        return plus(g, acc.vdot, solve(g, make_tape(g, self.v, self.v), H, linear, self.v, self._named))

    # -- with rows ----------------------------------------------------------------------------------------------

    @cached_property
    def constrained(self) -> RowSolution:
        """v̇ and λ subject to the rows, by the cheapest elimination; raises `ModelError` where rows contradict."""
        return self.settled[0]

    @cached_property
    def settled(self) -> tuple[RowSolution, Repeated]:
        """The solution, and the rows that say again, whatever the state, what others say."""
        return without_dependent(self.graph, self.rows, self.v, self.constrained_problems, self.known)

    def constrained_problems(self, rows: Sequence[ConstraintRow]) -> Iterator[Problem]:
        """The eliminations worth trying for accelerations subject to some of the rows."""
        zero, few = zeros(self.graph, len(self.v)), len(self.v) <= SMALL
        references = ((False, True) if few else (True,)) if self.motion.free_rates() else (False,)
        for links in self.distinct_groupings:
            for free in references:
                acc = self.accelerations(zero, free=free)
                asked = [pair for pair in self.row_accelerations(acc) if pair[0] in rows]
                yield from self.problems(links, self.missing(acc, links), asked, acc.vdot, drags=self.drags)

    @cached_property
    def distinct_groupings(self) -> list[list[AnyLink]]:
        """The groupings worth trying where there are rows: of large systems the bodies as they are."""
        kept: list[list[AnyLink]] = []
        for links in self.groupings if len(self.v) <= SMALL else self.groupings[:1]:
            if links not in kept:
                kept.append(links)
        return kept

    def row_accelerations(self, acc: Accelerations) -> list[tuple[ConstraintRow, int]]:
        """Every row with its γ: how fast it changes at given accelerations."""
        changes = self.motion.second_rate([row.rate for row in self.rows], acc.vdot)
        return [
            (row, change if row.acceleration is None else row.acceleration(acc))
            for row, change in zip(self.rows, changes, strict=True)
        ]

    def problems(
        self,
        links: Sequence[AnyLink],
        pairs: Pairs,
        rows: Sequence[tuple[ConstraintRow, int]],
        reference: Sequence[int],
        fixed: Container[int] = (),
        *,
        strict: bool = True,
        drags: Sequence[Drag] = (),
    ) -> Iterator[Problem]:
        """The eliminations worth trying: along the tape with and without exchanges, and of the mass matrix.

        ``pairs`` are the forces missing at ``reference``, ``rows`` come with what they are to change by, times −1; the
        velocities in ``fixed`` (numbers) stay as they are. ``drags`` are frictions that their multipliers press on.
        """
        H = self.inertia(links)
        attached = [AttachedRow.of(self.graph, row, value) for row, value in rows]
        names = [row.name for row, _ in rows]
        pressed = [AttachedDrag.of(self.graph, drag, names) for drag in drags]
        nodes = [a.node for a in (*attached, *pressed)]
        rates = [v for i, v in enumerate(self.v) if i not in fixed]
        for form, linear, exchange in self._ways(H, pairs):
            seeds = list(dict.fromkeys((*form.rows, *linear, *nodes)))
            tape = make_tape(self.graph, seeds, rates, {*form.rows, *nodes} if exchange else None)
            if exchange and not tape.exchanged:
                continue  # the next one is the same
            problem = Problem(
                self.graph,
                tape,
                form if len(rates) == len(self.v) else form.without(set(form.rows).difference(tape.order)),
                linear,
                attached,
                self.v,
                reference,
                self._named,
                self.motion.constant,
                strict,
                len(rows) > 1,  # of one row, −λ takes fewer operations
                [spare for spare in self.spare if set(names).issuperset(spare.names)],
                pressed,
            )
            yield from in_speeds_of_rows(problem)

    def _ways(self, H: Quadratic, pairs: Pairs) -> Iterator[tuple[Quadratic, dict[int, int], bool]]:
        """Forms of the inertia with their linear terms, and whether nodes are exchanged. M is made last."""
        linear = self._linear(pairs)
        yield H, linear, True
        yield H, linear, False
        if len(self.v) <= DENSE:
            yield self._dense, dict(zip(self.v, self.gathered(pairs), strict=True)), False

    @cached_property
    def _dense(self) -> Quadratic:
        """The mass matrix as a form over the rates."""
        H = Quadratic(self.graph)
        for i, row in enumerate(self.mass_matrix()):
            for k in range(i + 1):
                H.add(self.v[i], self.v[k], row[k])
        return H

    def _linear(self, pairs: Pairs) -> dict[int, int]:
        """The linear term over velocity nodes, those that depend on v alone."""
        g = self.graph
        moving = set(moving_nodes(g, [rate for rate, _ in pairs], self.v))
        linear: dict[int, int] = {}
        for rate, effort in pairs:
            if effort != g.zero and rate in moving:
                node, negative = bare(g, rate)
                linear[node] = g.add(linear.get(node, g.zero), g.neg(effort) if negative else effort)
        return linear
