"""Finds all equilibria in a box, the roots of h(q) = G(q) − Ξ(q, u) = 0 at q̇ = 0; with constraints see `rows`.

Damped Newton steps with the exact ∂h/∂q start from many points, in rounds, until every root was found several times and
a round finds nothing new. Directions on which h does not depend are held; roots that are not isolated form a family.
"""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.equilibria.box import MAX_EQUILIBRIA, Box, LeftOut, check_few, make_box
from lagrangian.equilibria.currents import SteadyCurrents, largest_charge
from lagrangian.equilibria.families import Family, split
from lagrangian.equilibria.orientations import SoughtOrientations
from lagrangian.equilibria.points import Equilibria, Equilibrium
from lagrangian.equilibria.roots import ENOUGH, EXACT, Forces, Search, distinct, starting_points
from lagrangian.equilibria.rows import LARGE, HeldForces, check_sizes
from lagrangian.errors import RunError
from lagrangian.graph import Graph, Output, Program
from lagrangian.linear.echelon import null_space, reduced
from lagrangian.linear.jacobians import QuickValues, values
from lagrangian.linear.linearize import TIMES, Linearizer
from lagrangian.linear.manifold import point_words
from lagrangian.linear.stability import Stability
from lagrangian.model import Model
from lagrangian.model.rows import named_conditions
from lagrangian.model.without_friction import check_no_friction
from lagrangian.records import dataclass, field
from lagrangian.values.values import Given, Named

_log = logging.getLogger(__name__)
Array = NDArray[np.float64]

ROUND = 256
"""The number of starting points in a round."""

ROUNDS = 16
MANY = 8
"""From this number of equilibria on, machine code is compiled for their verdicts."""

SINGULAR = 1e-13
"""An eigenvalue of M, in widths of the box, below this fraction of the largest counts as zero."""


def equilibria(
    model: Model,
    *,
    inputs: Named | None = None,
    params: Named | None = None,
    box: Mapping[Any, Any] | None = None,
    starts: int | None = None,
) -> Equilibria:
    """Return the equilibria of a model at constant inputs that a search from many points in a box finds.

    ``box``: coordinate → (low, high), numbers or text with units. By default it is (−π, π] for angles, and a few times
    the largest length among the parameters for lengths; equilibria outside a side are kept unless you gave that side.
    ``starts``: the number of starting points; by default as many as the search needs. If forces depend on time, only
    equilibria at all times are kept. Raises `RunError` for values and names that do not fit, and without ``starts`` for
    more isolated equilibria than a search finds all of.
    """
    if starts is not None and (type(starts) is not int or not 1 <= starts <= 1_000_000):
        raise RunError(f"starts must be a whole number from 1 (got {starts!r})", code="E501")
    check_no_friction(model, "its equilibria fill regions, and no search finds those")
    task = _prepared(model, inputs, params, box)
    _log.info("equilibria: searching the box")
    found, hits, count, sure = _sought(task, starts)
    isolated, families = split(task.search, found, task.box.low, task.box.high)
    if starts is None and not sure:
        check_few(model, task.box, isolated)
    if len(isolated) > MANY:
        task = replace(task, linearizer=Linearizer(model, QuickValues()))
    proper = [q for q in isolated if not task.is_singular(q)]
    _log.info("equilibria: the stability of %d", len(proper) + len(families))
    listed = [task.equilibrium(q, hits) for q in proper]
    listed += [task.equilibrium(f.root, hits, f) for f in families if not task.is_singular(f.root)]
    left_out = [q for q in isolated if task.is_singular(q)]
    kept = [e for e in listed if isinstance(e, Equilibrium)]
    kept.sort(key=lambda e: [round(e.at[n], 9) + 0.0 for n in task.box.names])
    return Equilibria(
        model=model,
        found=tuple(kept),
        box=task.box.sides,
        free=task.free,
        held={task.box.names[k]: float(task.search.base[k]) for k in task.held},
        starts=count,
        sure=sure,
        notes=_notes(task, kept, sure, left_out, Counter(e for e in listed if not isinstance(e, Equilibrium))),
    )


@dataclass(frozen=True, eq=False)
class _Task:
    """One search: the model with given inputs and parameters, its box, and the free directions."""

    model: Model
    box: Box
    search: Search
    free: tuple[dict[str, float], ...]
    held: list[int]
    linearizer: Linearizer
    u: Array
    p: Array
    steady: SteadyCurrents
    """The currents that are sought in place of charges."""

    held_forces: HeldForces | None = None

    orientations: SoughtOrientations = field(default_factory=SoughtOrientations)
    """The quaternions of floating frames."""

    def equilibrium(self, q: Array, hits: Mapping[bytes, int], family: Family | None = None) -> Equilibrium | LeftOut:
        """An equilibrium with its verdict, or why it is left out."""
        count = hits.get(q.tobytes(), 0)
        q, why = self.box.placed(self.orientations.signed(q[None])[0])
        if why or not self._rests_always(q):
            return why or "moving"
        q = self.without_rounding(q)
        x = np.concatenate(self.state(q))
        names = self.box.names
        return Equilibrium(
            at=dict(zip(self.linearizer.rates.inputs["x"], x.tolist(), strict=True)),
            inputs=dict(zip((i.name for i in self.model.inputs), self.u.tolist(), strict=True)),
            parameters=dict(zip((p.name for p in self.model.parameters), self.p.tolist(), strict=True)),
            residual=float(self.search.residual(q[None])[0]),
            stability=self._stability(x),
            starts=count,
            moves=() if family is None else tuple(names[k] for k in family.moving),
            dimension=0 if family is None else family.dimension,
            multipliers={} if self.held_forces is None else self.held_forces.multipliers(q),
        )

    def state(self, q: Array) -> tuple[Array, Array]:
        """q and v of what is sought."""
        return (q, self.orientations.resting(q)) if self.orientations else self.steady.state(q)

    def without_rounding(self, q: Array) -> Array:
        """A root with 0 where only rounding is left."""
        return np.where(np.abs(q) < 1e-14 * self.search.width, 0.0, q)

    def _stability(self, x: Array) -> Stability:
        try:
            return self.steady.verdict(self.linearizer.at_rest(x, self.u, self.p))
        except RunError as trouble:  # it is an equilibrium all the same
            return Stability("marginal", trouble.what)

    def is_singular(self, q: Array) -> bool:
        """Whether M is singular at q: then h = 0 says nothing, because these coordinates do not describe the
        neighbourhood."""
        at, v = self.state(q)
        M = self.linearizer.values(self.linearizer.mass, q=at, v=v, u=self.u, p=self.p, t=0.0)["M"]
        if not np.isfinite(M).all():
            return True
        if self.steady:
            M = self.steady.basis.T @ M @ self.steady.basis
        width = self._sizes(M)
        if self.linearizer.manifold is not None:
            try:
                tangent = self.linearizer.manifold.tangent(np.concatenate([q, v]), self.p, 0.0)
            except RunError:  # the verdict says that the constraints leave more than one way there
                return False
            width = np.array([width[k - len(q)] for k in tangent.kept[tangent.positions :]])
            M = tangent.speeds.T @ M @ tangent.speeds
        sized = np.linalg.eigvalsh(M * np.outer(width, width))
        if not len(sized):
            return False
        return bool(sized.min() < SINGULAR * np.abs(sized).max())

    def _sizes(self, M: Array) -> Array:
        """The sizes of changes by which M is judged: the widths of the box. A charge whose current is sought has none
        in the box; its size makes its inductance as large as the largest of the other entries."""
        sizes = np.array(self.orientations.widths(self.search.width), float)
        leading = self.steady.leading
        others = [k for k in range(len(sizes)) if k not in leading]
        largest = float((np.diag(M) * sizes**2)[others].max(initial=0.0)) if leading else 0.0
        for k in (k for k in leading if M[k, k] > 0):
            sizes[k] = np.sqrt((largest or 1.0) / M[k, k])
        return sizes

    def moves_no_mass(self, q: Array) -> str:
        """The coordinates that move no mass at q, as words for the middle of a sentence."""
        moved = dynamics.loose(self.model, q.tolist(), self.u.tolist(), self.p.tolist(), 0.0)
        return f" ({moved})" if moved else ""

    def _rests_always(self, q: Array) -> bool:
        program = self.linearizer.forces
        if not self.linearizer.rests_change:
            return True
        for t in TIMES:
            if self.held_forces is not None:
                if np.abs(self.held_forces(q[None], t)[0]).max(initial=0.0) > 1e3 * EXACT:
                    return False
                continue
            at, v = self.state(q)
            h = self.linearizer.values(program, q=at, v=v, u=self.u, p=self.p, t=t)["h"]
            if np.abs(h / self.search.scale[: len(h)]).max(initial=0.0) > 1e3 * EXACT:
                return False
        return True


def _prepared(model: Model, inputs: Named | None, params: Named | None, asked: Mapping[Any, Any] | None) -> _Task:
    linearizer = Linearizer(model)
    given = Given.of(model, linearizer.rates)
    u, p = given.input_values(inputs), given.parameter_values(params)
    program = linearizer.forces
    orientations = SoughtOrientations.of(model)
    steady = SteadyCurrents.of(linearizer, u, p)
    names = tuple(f"{name}'" if k in steady.leading else name for k, name in enumerate(program.inputs["q"]))
    charge = largest_charge(model, dict(zip(model.parameters, p.tolist(), strict=True)), u) if model.charges else None
    turning = _turning(linearizer, u, p, orientations)
    box = make_box(given, names, asked, turning, charge, orientations.entries)
    starts, held_forces = starting_points(64, box.low, box.high), None
    if linearizer.manifold is None:
        forces = _forces(program, u, p, steady, orientations)
    else:
        forces = held_forces = HeldForces.of(linearizer, _kernel, starts, u, p, _scale, orientations)
    h, K = forces(starts)
    check_sizes(model, h, p)
    scale, width = np.ones(h.shape[1]) if held_forces else _scale(h), box.high - box.low
    good = K[(K != 0).any(axis=(1, 2)) & (np.abs(h) < LARGE).all(axis=1)]
    directions, held = reduced(null_space((good / scale[:, None] * width).reshape(-1, len(width))) * width)
    seek = np.array([k for k in range(len(width)) if k not in held], np.int64)
    free = tuple({box.names[k]: float(x) for k, x in enumerate(row) if x} for row in directions)
    search = Search(forces, box.centre(), seek, scale, width, box.turns, last=bool(orientations))
    return _Task(model, box, search, free, held, linearizer, u, p, steady, held_forces, orientations)


def _turning(linearizer: Linearizer, u: Array, p: Array, orientations: SoughtOrientations) -> NDArray[np.bool_]:
    """The coordinates in which h, ∂h/∂q and M are periodic with a whole turn."""
    n = len(linearizer.forces.inputs["q"])
    source = np.random.default_rng(4)
    same, fixed = np.ones(n, bool), np.ones(n, bool)
    for _ in range(3):
        q = source.uniform(-1, 1, n)
        here = _all_forces(linearizer, q, u, p, orientations)
        if not np.isfinite(here).all():
            return np.zeros(n, bool)
        for k in range(n):
            for shift, found in ((2 * np.pi, same), (1.0, fixed)):
                there = _all_forces(linearizer, q + shift * (np.arange(n) == k), u, p, orientations)
                found[k] &= np.allclose(here, there, rtol=1e-9, atol=1e-9 * float(np.abs(here).max(initial=0.0)))
    return same & ~fixed


def _all_forces(linearizer: Linearizer, q: Array, u: Array, p: Array, orientations: SoughtOrientations) -> Array:
    groups = {"q": q, "v": orientations.resting(q), "u": u, "p": p, "t": 0.0}
    got = values(linearizer.forces, **groups)
    found = [got["h"], got["K"].ravel(), values(linearizer.mass, **groups)["M"].ravel()]
    if linearizer.manifold is not None:
        rows = linearizer.manifold.at(np.concatenate([q, orientations.resting(q)]), p, 0.0)
        found += [rows["f"], rows["A"].ravel()]
    return np.concatenate(found)


def _sought(task: _Task, asked: int | None) -> tuple[Array, dict[bytes, int], int, bool]:
    """Distinct roots, how many starts led to each, the number of starts, and whether that is enough."""
    search, box = task.search, task.box
    found = np.empty((0, len(search.base)))
    before, count, sure = -1, 0, False
    roots, hits = distinct(search, found)
    for _ in range(ROUNDS if asked is None else 1):
        many = ROUND if asked is None else asked
        q = starting_points(many, box.low, box.high, skip=count)
        if count == 0:
            q = np.concatenate([q, _corners(task)])
        q[:, task.held] = search.base[task.held]
        found = np.concatenate([found, task.orientations.signed(search.roots(q))])
        count += len(q)
        roots, hits = distinct(search, found)
        settled = asked is not None or len(roots) == before
        sure = settled and (not len(hits) or int(hits.min()) >= ENOUGH)
        if sure or task.box.listed(roots) > MAX_EQUILIBRIA or (count >= 4 * ROUND and _is_family(search, roots, count)):
            break
        before = len(roots)
    return roots, {r.tobytes(): int(n) for r, n in zip(roots, hits, strict=True)}, count, sure


def _is_family(search: Search, roots: Array, count: int) -> bool:
    """Whether many of the starts found different roots, and K is singular there."""
    if len(roots) <= count // 8:
        return False
    flat = [search.singular(q)[0] for q in roots[:16]]
    return sum(v.min() <= 1e-6 * max(v.max(), 1e-300) for v in flat) >= len(flat) // 2


def _corners(task: _Task) -> Array:
    """Angles at 0 or half a turn and all else at the centre: hanging and upright positions."""
    angles = [int(k) for k in np.flatnonzero(task.box.turns) if k in task.search.seek][:8]
    grid = np.array(list(product((0.0, np.pi), repeat=len(angles))))
    made = np.tile(task.box.centre(), (len(grid), 1))
    made[:, angles] = grid
    return made


def _notes(
    task: _Task, found: Sequence[Equilibrium], sure: bool, left_out: Sequence[Array], unlisted: Counter[str]
) -> tuple[str, ...]:
    """Notes that a reader should know besides the list."""
    listed = []
    if left_out:
        where = point_words(task.box.names, task.without_rounding(left_out[0])) + (
            " and elsewhere" if len(left_out) > 1 else ""
        )
        moved = task.moves_no_mass(left_out[0])
        listed.append(
            f"the mass matrix is singular at {where}{moved}: the coordinates fail there, so that position is left out"
        )
    for direction in task.free:
        names = list(direction)
        what = names[0] if len(names) == 1 else f"a shift of {', '.join(names)} together"
        so = "so any value will do; " if found else ""
        listed.append(f"no force depends on {what}{', ' if so else '; '}{so}{names[0]} is held fixed")
    coordinates = [c.name for c in task.model.coordinates]
    for k, what, d in zip(task.steady.leading, task.steady.named(coordinates), task.steady.directions, strict=True):
        alone = np.count_nonzero(d) == 1
        which = f"the charge {what}" if alone else f"a shift of the charges {what} together"
        listed.append(
            f"no force depends on {which}: what is sought is {'its' if alone else 'their'} steady "
            f"current {task.box.names[k]}"
        )
    listed += [task.box.words(why, count) for why, count in sorted(unlisted.items())]
    rows = [row.name for row in named_conditions(task.model) if not row.condition.on_positions]
    if rows:
        which = "the constraint" if len(rows) == 1 else "the constraints"
        said = ", ".join(f"'{name}'" for name in rows[:6])
        listed.append(f"{which} on velocities, {said}, can hold forces and fix no coordinate: equilibria form families")
    none = f"{'other ' if left_out else ''}equilibrium in the box{'' if task.box.given.any() else ' searched'}"
    if not found and task.held_forces is not None:
        listed.append(f"there is no {none} that satisfies the constraints")
    elif not found:
        h, _ = task.search.forces(starting_points(256, task.box.low, task.box.high))
        rows = zip(task.box.names, h.T, strict=True) if not task.orientations else ()  # whose h is along velocities
        one_sided = [n for n, row in rows if (row > 0).all() or (row < 0).all()]
        why = f": the force on {one_sided[0]} has one sign everywhere, nothing balances it" if one_sided else ""
        listed.append(f"there is no {none}{why}")
    elif not sure and not any(e.dimension for e in found):
        listed.append("some were found from few starts: there may be more; increase starts, or narrow the box")
    return tuple(listed)


def _scale(h: Array) -> Array:
    """The size of every entry of h over the starts; entries that are always 0 get the size of the others."""
    good = np.abs(h[(np.abs(h) < LARGE).all(axis=1)])
    size = np.median(good, axis=0) + 1e-3 * good.max(axis=0) if len(good) else np.zeros(h.shape[1])
    largest = float(size.max(initial=0.0)) or 1.0
    return np.where(size > 1e-12 * largest, size, largest)


def _kernel(program: Program, *names: str) -> machine.Kernel:
    """Some outputs in machine code, `LARGE` where they are not finite."""
    g = program.graph
    outputs = {
        name: Output(tuple(_guarded(g, i) for i in program.outputs[name].ids), program.outputs[name].shape)
        for name in names
    }
    return machine.compile(Program("rest", g, program.inputs, outputs, program.defaults))


def _forces(program: Program, u: Array, p: Array, steady: SteadyCurrents, orientations: SoughtOrientations) -> Forces:
    """h and K at rest, or with steady currents, in machine code; where they are not finite, h is `LARGE` and K is 0."""
    kernel = _kernel(program, "h", "K", *(["D"] if steady else []))

    def forces(z: Array) -> tuple[Array, Array]:
        q, v = (z, orientations.resting(z)) if orientations else steady.state(z)
        got = kernel(q, v, u, p, 0.0)
        h, K = np.array(got["h"]), np.array(got["K"])
        if steady:
            K = steady.slopes(K, np.array(got["D"]))
        if orientations:
            h, K = orientations.with_lengths(z, h, K)
        bad = (np.abs(h) >= LARGE).any(axis=1) | (np.abs(K) >= LARGE).any(axis=(1, 2))
        h[bad], K[bad] = LARGE, 0.0
        return h, K

    return forces


def _guarded(g: Graph, i: int) -> int:
    """The node if it is finite, else `LARGE`: a comparison with NaN is false."""
    limit = g.const(LARGE)
    return g.select(g.lt(g.abs(i), limit), i, limit)
