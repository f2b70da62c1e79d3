"""Rows that follow from others along a motion: which sets they form, and how many are spare."""

import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from lagrangian import dynamics
from lagrangian.assembly import spare as spare_module
from lagrangian.assembly.assemble import consistent
from lagrangian.assembly.spare import check_slopes, parts, spare_rows
from redundant_systems import START, plate_on_cranks


def spare(system, start, rates=None):
    """The sets of rows with spare ones at a start, as (names, count)."""
    model = system.model
    q = np.array([float(start.get(c.name, 0.0)) for c in model.coordinates])
    v = np.array([float((rates or {}).get(v.name, 0.0)) for v in model.velocities])
    p = np.array([x.value for x in model.parameters], float)
    q, v = consistent(model, q, v, p)
    return [(set(found.names), found.count) for found in spare_rows(model, q, v, p)]


CRANKS = {f"p{k}.{axis}" for k in range(3) for axis in "xy"}


def test_one_of_the_six_rows_of_a_plate_on_three_equal_cranks_is_spare():
    """m − rank = 6 − 5, and the redundant forces are along the cranks: every row has a share of them."""
    assert spare(plate_on_cranks(), START) == [(CRANKS, 1)]


def test_a_start_in_the_flat_position_asks_where_the_motion_goes():
    """There one more row depends on the others, and antiparallel positions branch off, of full rank."""
    flat = {"x": 0.6}
    turning = {"a1'": 1.0, "a2'": 1.0, "a3'": 1.0, "y'": 0.6}
    assert spare(plate_on_cranks(), flat, turning) == [(CRANKS, 1)]


@pytest.mark.slow
def test_cranks_of_different_lengths_have_no_spare_row():
    lengths = (0.6, 0.6, 0.6003)
    start = {"a1": 1.0, "a2": 1.0, "a3": 1.0, "x": 0.3, "y": 0.5}
    assert spare(plate_on_cranks(lengths), start) == []


@pytest.mark.slow
def test_two_loops_that_have_nothing_in_common_are_two_sets():
    s = lg.System("two plates")
    for side in ("left", "right"):
        plate_on_cranks(system=s, side=side)
    start = {f"{side}_{name}": value for side in ("left", "right") for name, value in START.items()}
    names = [{f"{side} {row}" for row in CRANKS} for side in ("left", "right")]
    assert spare(s, start) == [(names[0], 1), (names[1], 1)]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "stewart-platform", "rolling-disc", "andrews-squeezer"])
def test_built_in_mechanisms_without_repeated_rows_have_none(name):
    system = built_in.system(name)
    assert spare(system, {c.name: c.start for c in system.model.coordinates}) == []


def test_the_null_vectors_of_a_matrix_tell_its_parts():
    """Rows 0, 1, 2 with r0 + r1 = r2, rows 4, 5 proportional, row 3 alone; in any units."""
    rng = np.random.default_rng(0)
    a, b, c, d = rng.standard_normal((4, 9))
    A = np.array([a, b, a + b, c, d, -2 * d]) * 10.0 ** rng.uniform(-3, 3, (6, 1))
    assert sorted(parts(A)) == [[0, 1, 2], [4, 5]]


def test_rows_of_an_expression_given_in_two_ways_are_spare():
    """√(x² + y²) = 1 and x² + y² = 1 have parallel gradients where they hold, not where they do not."""
    s = lg.System("rod twice")
    x, y = s.coordinates("x y")
    s.particle(1.0, at=s.origin + (x, y))
    s.constraint(sp.sqrt(x**2 + y**2) - 1, name="root")
    s.constraint(x**2 + y**2 + (x**2 + y**2 - 1) * x - 1, name="square")
    assert spare(s, {"x": 1.0, "y": 0.1}) == [({"root", "square"}, 1)]


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("law", "start"),
    [
        (lambda x, y: x**2, {"x": 0.0, "y": 1.0}),
        (lambda x, y: x**2, {"x": 0.3, "y": 1.0}),
        (lambda x, y: (x**2 + y**2 - 1) ** 2, {"x": 0.3, "y": 0.9}),
        (lambda x, y: x * y, {"x": 0.0, "y": 0.0}),
    ],
)
def test_a_row_without_a_slope_is_named(law, start):
    """x² = 0 has the gradient 2 x, which is 0 where it holds; x y = 0 has none at the crossing."""
    s = lg.System("wall")
    x, y = s.coordinates("x y")
    s.particle(1.0, at=s.origin + (x, y))
    s.constraint(law(x, y), name="wall")
    with pytest.raises(lg.RunError, match="'wall' has no slope") as caught:
        s.simulate(1.0, initial=start)
    assert caught.value.code == "E309"
    with pytest.raises(lg.RunError, match="'wall' has no slope"):
        s.ensemble(1.0, initial={name: [value, value] for name, value in start.items()})


@pytest.mark.slow
def test_a_slope_that_is_small_everywhere_is_one():
    s = lg.System("wall")
    x, y = s.coordinates("x y")
    s.particle(1.0, at=s.origin + (x, y))
    s.constraint(1e-9 * (x + y**2), name="wall")
    assert s.simulate(0.1, x=-1.0, y=1.0).success


def test_slopes_are_checked_without_what_moves_a_state_onto_its_rows(monkeypatch):
    """Corrections are long eliminations; the size of a row needs only A, and at one place no machine code."""
    monkeypatch.setattr(dynamics, "correction", lambda *_, **__: pytest.fail("a correction was made"))
    monkeypatch.setattr(spare_module, "kernel_of", lambda *_: pytest.fail("machine code was made"))
    model = plate_on_cranks().model
    check_slopes(model, np.full(len(model.coordinates), 0.3), np.array([x.value for x in model.parameters], float))
