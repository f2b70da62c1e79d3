"""Expressions that share parts are evaluated as each one alone, whatever is known of their parts."""

from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy as sp

from built_in import derivation
from effort import at_most
from lagrangian import bounded
from lagrangian.bounded import sizes
from lagrangian.bounded.effort import CallCount
from lagrangian.derive.sampling import DIGITS, CompiledExpressions, States


def test_parts_that_were_seen_before() -> None:
    model = derivation("cart-pole").model
    q, w = model.coordinates
    sine, third = sp.sin(w.symbol), sp.Rational(1, 3)
    exprs = [
        third * sine + q.rate,
        (third * sine + q.rate) ** 2 * sp.Rational(2, 7),
        sp.sqrt(15) * sine - third,
        q.acceleration * (third * sine + q.rate) + sp.sin(2),
        third * sine + q.rate,
    ]
    states = States(model, 2)
    together = CompiledExpressions(exprs)
    for expr, values, k in zip(exprs, together.at(states), range(len(exprs)), strict=True):
        assert np.array_equal(values, CompiledExpressions([expr]).at(states)[0])
        assert together.exactly(states, 1)[k] == CompiledExpressions([expr]).exactly(states, 1)[0]


def test_an_expression_that_was_seen_before_is_not_looked_through_again() -> None:
    T = sp.Symbol("met_only_here") * derivation("double-pendulum").T  # no other that is equal is compared with it
    compiled = CompiledExpressions([T])
    size, slope_size = bounded.size(T), sizes.slope_size(T)
    with at_most(40):
        assert compiled.node(T) == compiled.ids[0]
        assert (bounded.size(T), sizes.slope_size(T)) == (size, slope_size)


def test_several_values_of_a_symbol_at_once_are_as_one_after_the_other() -> None:
    model = derivation("cart-pole").model
    q, w = model.coordinates
    states = States(model, 2)
    compiled = CompiledExpressions(
        [sp.sin(w.symbol) * q.rate + sp.Rational(1, 3), w.symbol**3, sp.Integer(2), q.symbol]
    )
    own = [{w.symbol: states.of(w.symbol) * k} for k in (1.5, -2.0)] + [{}, {q.rate: states.of(w.symbol)}]
    found = compiled.at_each(states, own)
    assert found.shape == (4, 4, states.size)
    for k, instead in enumerate(own):
        assert np.array_equal(found[:, k], compiled.at(states, instead))


def test_the_same_expressions_share_their_graph_and_values_follow_the_states() -> None:
    model = derivation("cart-pole").model
    x, theta = (c.symbol for c in model.coordinates)
    exprs, states = [x * sp.sin(theta) + 5, x**3], States(model, 2)
    first = CompiledExpressions(exprs)
    values, slopes = first.at(states), first.slopes([x, theta]).at(states)
    again = CompiledExpressions(exprs)
    assert again.graph is first.graph and np.array_equal(again.at(states), values)
    again.at(states)[:] = 0.0  # a copy
    assert np.array_equal(first.at(states), values) and np.array_equal(again.slopes([x, theta]).at(states), slopes)
    states.fix(x, 2 * states.of(x))
    assert np.allclose(again.at(states)[1], 8 * values[1])


def test_what_is_counted_makes_its_own_graph() -> None:
    expr = sp.Symbol("counted_only_here") ** 2 + 1
    own = CompiledExpressions([expr])
    with at_most(1_000):
        assert CallCount(1_000, anywhere=True).run(lambda: CompiledExpressions([expr])).graph is not own.graph


@pytest.mark.parametrize("argument", [sp.S.Half, -sp.S.Half, sp.Rational(1, 3), sp.Integer(2)])
@pytest.mark.parametrize("function", [sp.sin, sp.cos, sp.exp, sp.tan])
def test_functions_of_numbers_have_fifty_digits(function: Callable[[Any], Any], argument: Any) -> None:
    """cos ½ too, whose argument a double represents exactly. Oracle: mpmath."""
    states = States(derivation("cart-pole").model, 1)
    found = CompiledExpressions([3 * function(argument)]).exactly(states, 0)[0]
    with mpmath.workdps(DIGITS):
        meant = 3 * getattr(mpmath, function.__name__)(mpmath.mpf(int(argument.p)) / int(argument.q))
        assert abs(found - meant) < 1e-45
