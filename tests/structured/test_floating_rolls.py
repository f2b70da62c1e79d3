"""A ball that floats, is held on an inclined plane, and rolls: constraints in quasi-velocities."""

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg


def ball() -> lg.System:
    s = lg.System("ball on an inclined plane")
    frame = s.floating_frame("ball")
    m, r = s.parameters("m r", m=2.0, r=0.1)
    inertia = sp.Rational(2, 5) * m * r**2
    body = s.rigid_body(m, (inertia, inertia, inertia), at=frame.origin, frame=frame, name="ball")
    s.gravity((sp.sin(sp.Rational(1, 5)), 0, -sp.cos(sp.Rational(1, 5))))
    s.rolling(body, at=frame.origin + (0, 0, -r), along=[(1, 0, 0), (0, 1, 0)], name="roll")
    s.constraint(s["ball_z"] - r, name="floor")
    return s


def test_speeds_in_rates_are_the_rates_by_speeds_turned_round() -> None:
    """ṗ = R v and ė = ½ e ∘ (ω, 0), put into v and ω in the rates, give v and ω again, whatever the length of e."""
    floating = ball().model.floating[0].floating
    assert floating is not None
    x, y, z, w = floating.quaternion
    a, b, c = floating.angular_velocity
    turning = [w * a + y * c - z * b, w * b + z * a - x * c, w * c + x * b - y * a, -(x * a + y * b + z * c)]
    moved = floating.rotation * sp.Matrix(floating.velocity)
    rates = [*moved, *(value / 2 for value in turning)]
    table = {coordinate.rate: rate for coordinate, rate in zip(floating.coordinates, rates, strict=True)}
    values = {symbol: sp.Rational(k + 2, 7) for k, symbol in enumerate((*floating.position, *floating.quaternion))}
    for speed, value in floating.in_rates.items():
        assert sp.expand(value.xreplace(table).xreplace(values) - speed) == 0


@pytest.mark.slow
def test_a_ball_that_floats_is_derived_and_rolls() -> None:
    """ẍ = 5/7 g sin α, the friction is 2/7 m g sin α; five coordinates are reached by three speeds (design §7)."""
    s = ball()
    derivation = s.derive()
    assert derivation.constraints is not None
    assert derivation.constraints.verdict == "nonholonomic by 2: #DDOF = 3, #GC = 5, growth (3, 5)"
    assert derivation.steps[0].expressions["GC"] == 5 and derivation.steps[0].expressions["DDOF"] == 3
    assert all(check.holds for check in derivation.verify(states=20) if check.holds is not None)
    run = s.simulate(1.0, initial={"ball_z": 0.1})
    pull = 9.81 * np.sin(0.2)
    assert np.allclose(run["ball_x"], 5 / 7 * pull * run.t**2 / 2, rtol=1e-9, atol=1e-12)
    assert np.allclose(run["roll.1"], -2 / 7 * 2 * pull, rtol=1e-9)
    assert np.allclose(run["floor"], 2 * 9.81 * np.cos(0.2), rtol=1e-9)
