"""Reference problems, described as systems: Kepler's orbit, the spring pendulum by Taylor's method in 20 digits."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
import sympy as sp
from run_systems import example

import lagrangian as lg


@pytest.mark.parametrize(("method", "close"), [("dop853", 1e-8), ("tsit5", 1e-8), ("DOP853", 1e-6)])
def test_keplers_orbit_closes(method: str, close: float) -> None:
    """Eccentricity 0.6, semi-major axis 1, μ = 1: the period is 2π, the start is the near end of the orbit."""
    s = lg.System("planet")
    x, y = s.coordinates("x y")
    s.particle(s.parameter("m", 1.0), at=s.origin + (x, y))
    s.potential(-1 / sp.sqrt(x**2 + y**2))
    e = 0.6
    start = {"x": 1 - e, "y'": np.sqrt((1 + e) / (1 - e))}
    run = s.simulate(2 * np.pi, initial=start, samples=9, method=method)
    assert run.y[:, -1] == pytest.approx(run.y[:, 0], abs=close)
    assert run["x"][4] == pytest.approx(-(1 + e), abs=close)  # half a period later: the far end
    momentum = run["m*(x*y' - y*x')"]
    assert momentum == pytest.approx(np.full(9, momentum[0]), rel=close)


@pytest.mark.slow
def test_the_spring_pendulum_to_ten_digits() -> None:
    """m r̈ = m r θ̇² + m g cos θ − k (r − L0), r θ̈ = −2 ṙ θ̇ − g sin θ, written by hand."""
    s = example("elastic-pendulum")
    p = {q.name: float(q.value or 0.0) for q in s.model.parameters}
    m, k, L0, g = (mpmath.mpf(p[name]) for name in ("m", "k", "L_0", "g"))
    start = [L0 + mpmath.mpf("0.1"), mpmath.mpf("0.7"), mpmath.mpf("0.2"), mpmath.mpf("-0.3")]

    def f(t: mpmath.mpf, x: list[mpmath.mpf]) -> list[mpmath.mpf]:
        r, a, v, w = x
        return [v, w, r * w * w + g * mpmath.cos(a) - k / m * (r - L0), (-2 * v * w - g * mpmath.sin(a)) / r]

    with mpmath.workdps(20):
        wanted = [float(x) for x in mpmath.odefun(f, 0, start, tol=mpmath.mpf(10) ** -14)(1)]
    run = s.simulate(1.0, initial=[float(x) for x in start], samples=3)
    assert run.y[:, -1] == pytest.approx(wanted, abs=1e-10)
