"""What ties bodies together, beyond the rods, pins and tracks that carry them: strings, gears, surfaces.

A rod, a pin or a track leaves its body a few ways to move relative to what carries it, a body without any of them has
all. How fast a body moves in each of these ways is linear in the rates of the coordinates. Where such forms depend on
each other, their bodies are tied: m₁ and m₂ of Atwood's machine move with −ẋ and ẋ along their lines.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from lagrangian.derive.context import Context
from lagrangian.derive.reasons.holding import Holding
from lagrangian.derive.reasons.motion import Moving
from lagrangian.derive.sampling import Array, CompiledExpressions, States
from lagrangian.model import Body
from lagrangian.model.geometry import entries

NEAR = 1e-9
"""The relative size of what is rounding."""


def tied(context: Context, moving: Sequence[Moving], found: Sequence[Holding]) -> list[tuple[Body, ...]]:
    """The groups of bodies that something else ties together; a group of one is tied to its coordinates."""
    motions = _motions(context, moving)
    if motions is None:
        return []
    carriers = {h.body: h for h in found}
    ways = [(b, way) for b in context.model.bodies for way in _ways(motions, b, carriers.get(b))]
    groups: list[set[int]] = []
    for circuit in _circuits([way for _, way in ways]):
        joined = [g for g in groups if g & circuit]
        groups = [g for g in groups if not g & circuit] + [circuit.union(*joined)]
    bodies = context.model.bodies
    found_groups = (tuple(b for b in bodies if any(ways[k][0] is b for k in g)) for g in groups)
    return list(dict.fromkeys(found_groups))


class _Motions:
    """Places, velocities and turns of all bodies at a state, in the fixed axes; by the rate of every coordinate."""

    def __init__(self) -> None:
        self.velocity: dict[Body, Array] = {}
        """(coordinates, axes)."""
        self.turn: dict[Body, Array] = {}
        """(coordinates, 1 or 3); without rows for what has no axes."""
        self.points: dict[int, Array] = {}

    def carried(self, body: Body, carrier: Body | None) -> Array:
        """The velocity of a body relative to the place in another where it is, or to the ground."""
        if carrier is None:
            return self.velocity[body]
        arm = self.points[id(body.at)] - self.points[id(carrier.at)]
        return self.velocity[body] - self.velocity[carrier] - _cross(self.turn.get(carrier), arm)


def _cross(turn: Array | None, arm: Array) -> Array:
    """ω × r for every coordinate."""
    if turn is None:
        return np.zeros(1)
    if len(arm) == 2:
        return turn * np.array([-arm[1], arm[0]])
    return np.cross(turn, arm)


def _motions(context: Context, moving: Sequence[Moving]) -> _Motions | None:
    """All motions at the first state at which everything has a value; None if there is none."""
    model = context.model
    exprs = [x.raw() for m in moving for column in m.columns for x in column]
    axes = [m.body for m in moving if m.turning and m.body.axes is not None and m.body.axes.dimension == 3]
    exprs += [model.expand(x) for b in axes for x in entries(b.axes.rotation)]  # type: ignore[union-attr]
    points = [p for m in moving for p in m.body.at.with_parents()]
    exprs += [model.expand(x) for p in points for x in model.position(p)]
    values = CompiledExpressions(exprs).at(States(model, 1))
    whole = np.flatnonzero(np.isfinite(values).all(axis=0))
    if not len(whole):
        return None
    rest = values[:, whole[0]]

    def taken(count: int) -> Array:
        nonlocal rest
        first, rest = rest[:count], rest[count:]
        return first

    found, size, n = _Motions(), model.dimension, len(model.coordinates)
    for m in moving:
        width = len(m.velocity)
        (found.turn if m.turning else found.velocity)[m.body] = taken(n * width).reshape(n, width)
    for b in axes:
        found.turn[b] = found.turn[b] @ taken(9).reshape(3, 3).T
    for p in points:
        found.points[id(p)] = taken(size)
    return found


def _ways(motions: _Motions, body: Body, hold: Holding | None) -> Iterator[Array]:
    """How fast a body moves in the ways that its carrier leaves it, by the rate of every coordinate."""
    carrier = hold.carrier if hold is not None else None
    velocity = motions.carried(body, carrier)
    turn = motions.turn.get(body)
    if turn is not None and carrier is not None and carrier in motions.turn:
        turn = turn - motions.turn[carrier]
    if hold is None:
        yield from velocity.T
    elif hold.kind == "rod" and hold.at is not None:
        arm = motions.points[id(body.at)] - motions.points[id(hold.at)]
        _, _, across = np.linalg.svd(arm.reshape(1, -1))
        yield from (velocity @ across[1:].T).T
    elif hold.kind == "track":
        longest = velocity[np.argmax(np.abs(velocity).max(axis=1))]
        yield velocity @ (longest / np.linalg.norm(longest))
    if turn is not None:
        yield from _turns(turn, hold)


def _turns(turn: Array, hold: Holding | None) -> Iterator[Array]:
    """The ways to turn: one about a fixed axis, else one about every axis; none for what a track does not let turn."""
    values = np.linalg.svd(turn, compute_uv=False)
    rank = int((values > NEAR * max(values[0], NEAR)).sum()) if values[0] > NEAR else 0
    if hold is not None and rank <= 1:
        if rank:
            longest = turn[np.argmax(np.abs(turn).max(axis=1))]
            yield turn @ (longest / np.linalg.norm(longest))
        return
    yield from turn.T


def _circuits(ways: Sequence[Array]) -> Iterator[set[int]]:
    """The smallest sets of forms that depend on each other: every form with those of a basis that it is made of."""
    basis: list[int] = []
    for k, way in enumerate(ways):
        size = float(np.abs(way).max())
        if size < NEAR:
            yield {k}
            continue
        if not basis:
            basis.append(k)
            continue
        A = np.array([ways[i] / np.abs(ways[i]).max() for i in basis]).T
        made, *_ = np.linalg.lstsq(A, way / size, rcond=None)
        if np.abs(A @ made - way / size).max() > NEAR:
            basis.append(k)
        else:
            yield {k, *(i for i, c in zip(basis, made, strict=True) if abs(c) > NEAR)}
