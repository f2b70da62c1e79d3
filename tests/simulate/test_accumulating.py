"""A ball whose impacts accumulate keeps what it reached, in an ensemble as alone."""

from __future__ import annotations

import numpy as np
import sympy as sp

import lagrangian as lg


def test_impacts_that_accumulate_keep_what_was_reached() -> None:
    s = lg.System("ball")
    y = s.coordinate("y")
    s.particle(s.parameter("m", 1.0), at=s.origin + (0, y))
    e, g = s.parameter("e", 0.5), 9.81
    s.gravity()
    bounce = lg.event(y, direction=-1, reset={y.diff(): -e * y.diff()}, name="bounce")
    values = np.array([0.3, 0.5, 1.0])
    runs = s.ensemble(3.0, initial={y: 1.0}, params={e: values}, events=bounce, outputs=["max y", "final y"])
    assert list(runs.status) == [-4, -4, 0]
    still = np.sqrt(2 / g) * (1 + values[:2]) / (1 - values[:2])  # √(2h/g) (1 + 2e + 2e² + …)
    np.testing.assert_allclose(runs["reached"][:2], still, rtol=1e-6)
    np.testing.assert_allclose(runs["max y"][:2], 1.0, rtol=1e-12)
    np.testing.assert_allclose(runs["final y"][:2], 0.0, atol=1e-9)
    assert runs.counts["the end was reached"] == 1
    assert len(runs.failures()) == 2


def test_more_events_than_allowed_are_a_failure_and_not_a_motion_that_is_over() -> None:
    s = lg.System("oscillator")
    x = s.coordinate("x")
    s.particle(1.0, at=s.origin + (x, 0))
    s.spring(1.0, deflection=x)
    w = s.parameter("w", 1.0)
    events = lg.event(sp.sin(w * s.t), name="beat")
    runs = s.ensemble(3.0, x=1.0, params={w: [1000.0, 12000.0]}, events=events, outputs=["min x"])
    assert list(runs.status) == [0, -9]
    np.testing.assert_allclose(runs["min x"][0], np.cos(3.0), rtol=1e-6)
    assert np.isnan(runs["min x"][1])  # reduced over the first 2.6 s it would look like a result
    assert "the limit on the number of events was reached" in str(runs.failures()[0])
