"""What energies gain from a change is what a changed energy, written out, has more than the right one."""

from __future__ import annotations

from functools import cache
from itertools import combinations

import pytest
import sympy as sp

from built_in import derivation
from effort import at_most
from lagrangian import bounded
from lagrangian.check.explain.candidates import ingredients_of
from lagrangian.check.explain.changes import pool
from lagrangian.check.explain.changes.gains import Gains
from lagrangian.check.explain.changes.ring import Sum, minus, scaled
from lagrangian.check.explain.changes.sites import Sites
from lagrangian.check.explain.misconceptions.base import half_square, put
from lagrangian.check.reference import truth_of
from lagrangian.model import Gravity

SYSTEMS = ("cart-pole", "double-pendulum", "lecture-3b", "spinning-top")


@cache
def sites(name: str) -> Sites:
    return Sites(ingredients_of(derivation(name)))


def written(name: str, new: sp.Expr, old: sp.Expr) -> Sum:
    """A difference of two formulas, written out."""
    ring = sites(name).ring
    return minus(ring.of(sp.expand(new)), ring.of(sp.expand(old)))


@pytest.mark.parametrize("name", SYSTEMS)
def test_of_another_position(name: str) -> None:
    at = sites(name)
    s, ring, gains = at.of, at.ring, Gains(at)
    for b in s.bodies:
        position = [bounded.expand(x) for x in s.position(b)]
        pieces = [(c, p) for c, x in enumerate(position) for p in sp.Add.make_args(x) if s.moves(p)]
        for c, p in pieces:
            shift = scaled(ring.of(p), -2)
            moved = [x - 2 * p if k == c else x for k, x in enumerate(position)]
            speeds = tuple(s.rate(x) for x in moved)
            T = written(name, half_square(s.expand(b.mass), speeds), s.translation(b))
            assert gains.of_speed(b, {c: ring.rate(shift)}) == T
            heights = [e for e in at.model.elements if isinstance(e, Gravity)]
            V = sum((s.expand(2 * b.mass * e.g * e.direction[c] * p) for e in heights), sp.S.Zero)
            assert gains.of_height(b, {c: shift}) == ring.moving(ring.of(sp.expand(V)))


@pytest.mark.parametrize("name", SYSTEMS)
def test_of_other_rates(name: str) -> None:
    at = sites(name)
    gains = Gains(at)
    for v, w in combinations(at.of.v, 2):
        for x, other in ((v, v + w), (w, w - v), (v, -v)):
            changed = put(at.of.T, {x: other})
            assert gains.of_rate(at.of.T, x, other) == written(name, changed, at.of.T)


def test_of_a_rate_in_a_root() -> None:
    at = sites("cart-pole")
    v = at.of.v[0]
    energy = sp.sqrt(1 + v**2) + v**2
    assert Gains(at).of_rate(energy, v, 2 * v) == written("cart-pole", put(energy, {v: 2 * v}), energy)


def test_of_another_angular_velocity() -> None:
    at = sites("acrobot")
    ring, body = at.ring, [b for b in at.of.bodies if b.axes is not None][-1]
    [(axis, right)] = [(k, w) for k, w in enumerate(at.of.omega(body)) if w != 0]
    for other in (2 * right, right + at.of.v[0], sp.S.Zero):
        new = at.of.rotating(body, tuple(other if k == axis else w for k, w in enumerate(at.of.omega(body))))
        found = Gains(at).of_turning(body, axis, minus(ring.of(other), ring.of(right)))
        assert found == written("acrobot", new, at.of.rotation(body))


@pytest.mark.slow
def test_the_changes_of_a_system_take_few_calls() -> None:
    """Of Python's functions: where each changed energy is written out, more than half as many again."""
    model = derivation("double-pendulum")
    truth_of(model).W  # noqa: B018 - this belongs to no change
    pool._changes_of.cache_clear()  # pyright: ignore[reportPrivateUsage]
    with at_most(250_000):
        pool._changes_of(model)  # pyright: ignore[reportPrivateUsage]
