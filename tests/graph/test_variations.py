"""Slopes as numbers are those of the graph's own tangents."""

from __future__ import annotations

import numpy as np
import pytest

from lagrangian.graph import Graph, Valuation, jvp
from lagrangian.graph.graph import UNARY
from lagrangian.graph.variations import Variations


def test_the_slopes_of_every_operation_are_those_of_its_tangents() -> None:
    g = Graph()
    a, b, c = (g.input("q", k) for k in range(3))
    ids = [g.unary(name, g.mul(a, b)) for name in UNARY]
    ids += [getattr(g, name)(a, g.sin(b)) for name in ("add", "sub", "mul", "div", "min", "max", "pow", "atan2")]
    ids += [g.mul(a, a), g.div(c, a), g.div(a, c), g.sub(c, a), g.neg(b), g.powi(a, 3), g.abs(g.sub(a, b)), c, g.one]
    ids += [g.select(g.lt(a, b), g.mul(a, c), g.cos(b))]
    places = [[0.3, 0.8, 1.7], [0.9, 0.4, 0.6]]
    valuations = [Valuation(g, {"q": q}) for q in places]
    varied = Variations(g, valuations, [a, b])
    found = np.concatenate([varied(ids[:5]), varied(ids)[:, :, 5:]], axis=2)
    for k, valuation in enumerate(valuations):
        for n, direction in enumerate((a, b)):
            wanted = valuation(jvp(g, ids, {direction: g.one}))
            np.testing.assert_allclose(found[k, n], wanted, rtol=1e-13, atol=1e-15)


def test_what_does_not_move_has_no_slope_where_another_one_is_infinite() -> None:
    """√x at 0, by x and by y."""
    g = Graph()
    x, y = g.input("q", 0), g.input("q", 1)
    root = g.add(g.sqrt(x), y)
    assert Variations(g, [Valuation(g, {"q": [0.0, 1.0]})], [x, y])([root]).ravel() == pytest.approx([np.inf, 1.0])
