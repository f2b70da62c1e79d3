"""Vector-Jacobian and Hessian-vector products of accelerations, and derivatives by single names."""

import numpy as np
import pytest

import built_in
import lagrangian as lg
from constrained_systems import four_bar


def satellite() -> lg.System:
    """A floating body with an arm on it."""
    s = lg.System("satellite")
    hull = s.floating_frame("hull")
    s.rigid_body(s.parameter("M", 5.0), (0.8, 0.9, 1.2), at=hull.point(0.1, 0, 0.2), frame=hull)
    angle, torque = s.coordinate("angle"), s.input("torque")
    arm = s.frame(angle, axis=(0, 1, 0), parent=hull, origin=hull.origin)
    s.rigid_body(1, (0.1, 0.1, 0.02), at=arm.point(0, 0, 0.5), frame=arm)
    s.torque(torque, on=angle)
    s.gravity(direction=(0, 0, -1), g=9.81)
    return s


def test_a_pullback_is_the_transposed_product() -> None:
    dyn = built_in.system("cart-pole").compile()
    rng = np.random.default_rng(1)
    q, v, u, w = (rng.normal(size=(3, n)) for n in (2, 2, 1, 2))
    wrt = ("q", "v", "u", "m")
    d, g = dyn.derivatives(q, v, u, wrt=wrt), dyn.pullback(q, v, u, w, wrt=wrt)
    np.testing.assert_allclose(g.a, d.a, rtol=1e-12)
    for found, matrix in ((g.q, d.a_q), (g.v, d.a_v), (g.u, d.a_u)):
        np.testing.assert_allclose(found, np.einsum("si,sij->sj", w, matrix), rtol=1e-11, atol=1e-12)
    np.testing.assert_allclose(g.p["m"], np.einsum("si,si->s", w, d.a_p["m"]), rtol=1e-11)
    assert not g.sparsity["w_q"][0] and g.sparsity["w_q"][1]  # where the cart is does not matter


def test_a_hessian_product_is_symmetric_and_the_slope_of_the_pullback() -> None:
    dyn = built_in.system("cart-pole").compile()
    rng = np.random.default_rng(2)
    q, v, u, w, dq, dv, eq, ev = (rng.normal(size=n) for n in (2, 2, 1, 2, 2, 2, 2, 2))
    H = dyn.hessian_product(q, v, u, w, dq, dv)
    other = dyn.hessian_product(q, v, u, w, eq, ev)
    assert H.q @ eq + H.v @ ev == pytest.approx(other.q @ dq + other.v @ dv, rel=1e-11)
    h = 1e-6
    ends = [dyn.pullback(q + s * h * dq, v + s * h * dv, u, w) for s in (1, -1)]
    for name in ("q", "v", "u"):
        slope = (getattr(ends[0], name) - getattr(ends[1], name)) / (2 * h)
        np.testing.assert_allclose(getattr(H, name), slope, rtol=1e-6, atol=1e-7)
    with pytest.raises(lg.RunError, match="no accelerations"):
        _ = H.a


@pytest.mark.slow
@pytest.mark.parametrize("floating", [True, False])
def test_floating_frames_and_constraints_have_pullbacks(floating: bool) -> None:
    system = satellite() if floating else four_bar()
    dyn = system.compile()
    rng = np.random.default_rng(3)
    n = len(dyn.velocities)
    q, v = rng.normal(size=len(dyn.coordinates)), rng.normal(size=n)
    if not floating:
        q, v = dyn.assemble(q, v)
    u, w, dq, dv = (rng.normal(size=k) for k in (len(dyn.inputs), n, n, n))
    d, g = dyn.derivatives(q, v, u), dyn.pullback(q, v, u, w)
    for found, matrix in ((g.q, d.a_q), (g.v, d.a_v), (g.u, d.a_u)):
        np.testing.assert_allclose(found, w @ matrix, rtol=1e-9, atol=1e-9)
    H, h = dyn.hessian_product(q, v, u, w, dq, dv), 1e-6
    ends = [dyn.pullback(q + s * h * dyn.rates(q, dq), v + s * h * dv, u, w) for s in (1, -1)]
    np.testing.assert_allclose(H.q, (ends[0].q - ends[1].q) / (2 * h), rtol=1e-5, atol=1e-5)
    np.testing.assert_allclose(H.v, (ends[0].v - ends[1].v) / (2 * h), rtol=1e-5, atol=1e-5)


def test_single_names_are_columns() -> None:
    system = built_in.system("cart-pole")
    dyn = system.compile()
    q, v, u = [0.3, 0.4], [0.2, -0.5], [1.5]
    every = dyn.derivatives(q, v, u)
    one = dyn.derivatives(q, v, u, wrt=["theta", "theta'", "F", "m"])
    np.testing.assert_allclose(one["theta"], every.a_q[:, 1], rtol=1e-12)
    np.testing.assert_allclose(one["theta'"], every.a_v[:, 1], rtol=1e-12)
    np.testing.assert_allclose(one["F"], every["F"], rtol=1e-12)
    np.testing.assert_allclose(every[system["theta"]], every.a_q[:, 1])
    np.testing.assert_allclose(one["m"], one.a_p["m"])
    g = dyn.pullback(q, v, u, [1.0, 0.0], wrt="theta")
    assert g["theta"] == pytest.approx(every.a_q[0, 1])
    with pytest.raises(lg.Error, match="no entry"):
        one["x"]


def test_parameters_called_as_groups_are_asked_for_by_symbol() -> None:
    """ẍ = −(q/u) x − v ẋ/u with parameters q, v, u."""
    system = lg.System("letters")
    x = system.coordinate("x")
    q, v, u = system.parameter("q", 3.0), system.parameter("v", 0.5), system.parameter("u", 2.0)
    system.particle(u, at=system.origin + (x, 0))
    system.spring(q, deflection=x)
    system.damper(v, deflection=x)
    dyn = system.compile()
    d = dyn.derivatives([0.4], [0.7], wrt=["q", q, v, u])
    assert d.a_q[0, 0] == pytest.approx(-1.5)
    assert d.a_p["q"][0] == pytest.approx(-0.2)
    assert d.a_p["v"][0] == pytest.approx(-0.35)
    assert d.a_p["u"][0] == pytest.approx((3 * 0.4 + 0.5 * 0.7) / 4)


def test_what_does_not_fit_is_said() -> None:
    dyn = built_in.system("cart-pole").compile()
    with pytest.raises(lg.RunError, match="its last axis must have 2 entries"):
        dyn.pullback([0, 0], [0, 0], None, [1.0])
    with pytest.raises(lg.ModelError, match="nothing called 'thera'") as caught:
        dyn.pullback([0, 0], [0, 0], None, [1.0, 0.0], wrt="thera")
    assert "theta" in str(caught.value)
    with pytest.raises(lg.RunError, match="w must consist of numbers"):
        dyn.pullback([0, 0], [0, 0], None, ["a", "b"])
    with pytest.raises(lg.Error, match=r"nan|finite|NaN"):
        dyn.pullback([0, 0], [0, 0], None, [np.nan, 0.0])
    with pytest.raises(lg.ModelError, match="belongs to a floating frame"):
        satellite().compile().derivatives([0] * 6 + [1, 0], [0] * 7, wrt="hull_x")
