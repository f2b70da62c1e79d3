"""Points, frames and expressions of a compiled system, against SymPy's own derivatives of what was described."""

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from lagrangian import ModelError, RunError


@pytest.fixture(scope="module")
def arm() -> dict:
    """A cart with a link on it, in the plane."""
    s = lg.System("cart and link")
    x, theta = s.coordinates("x theta")
    m, M, L = s.parameters("m M L", m=2, M=3, L=0.7)
    F = s.input("F")
    pivot = s.origin + (x, 0)
    link = s.frame(theta, origin=pivot, name="link")
    tip = link.point(0, -L, name="tip")
    middle = link.point(0, -L / 2)
    s.particle(M, at=pivot)
    s.particle(m, at=tip)
    s.gravity()
    s.force((F, 0), at=pivot)
    return {"s": s, "dyn": s.compile(), "x": x, "theta": theta, "L": L, "F": F, "middle": middle, "link": link}


Q, V = np.array([[0.3, 0.4], [-0.2, 1.1]]), np.array([[0.5, -2.0], [0.1, 0.3]])


def test_a_point_of_a_frame_has_a_name(arm: dict) -> None:
    s = arm["s"]
    assert s["tip"] in s.model.points
    np.testing.assert_allclose(
        s.simulate(0.1, theta=0.2, samples=2).points["tip"][0], [0.7 * np.sin(0.2), -0.7 * np.cos(0.2)]
    )
    with pytest.raises(ModelError, match="twice"):
        arm["link"].point(1, 1, name="tip")


def test_any_point_can_be_asked_for(arm: dict) -> None:
    dyn, L = arm["dyn"], 0.7
    for asked, r in (("tip", L), (arm["s"]["tip"], L), (arm["middle"], L / 2)):
        found = dyn.point(asked, Q, V)
        c, s = np.cos(Q[:, 1]), np.sin(Q[:, 1])
        np.testing.assert_allclose(found["r"], np.stack([Q[:, 0] + r * s, -r * c], -1))
        np.testing.assert_allclose(found["v"], np.stack([V[:, 0] + r * c * V[:, 1], r * s * V[:, 1]], -1))
        np.testing.assert_allclose(found["J"] @ V[..., None], found["v"][..., None])
    np.testing.assert_array_equal(dyn.point("origin", Q)["r"], np.zeros((2, 2)))


def test_the_bias_of_a_point_is_its_acceleration_at_constant_rates(arm: dict) -> None:
    """r = (x + L sin θ, −L cos θ): r̈ = J q̈ + L θ̇² (−sin θ, cos θ)."""
    found, L = arm["dyn"].point("tip", Q, V), 0.7
    c, s, w = np.cos(Q[:, 1]), np.sin(Q[:, 1]), V[:, 1]
    np.testing.assert_allclose(found["bias"], np.stack([-L * s * w**2, L * c * w**2], -1))
    np.testing.assert_array_equal(arm["dyn"].frame("link", Q, V)["bias"], np.zeros(2))


def test_the_bias_of_points_and_frames_that_float_is_their_acceleration() -> None:
    """Difference quotients of v and ω along a motion of constant quasi-velocities, whose own rates are zero."""
    s = lg.System("body")
    body = s.floating_frame("body")
    s.rigid_body(2, (1, 2, 3), body.origin, body)
    turned = s.frame(s.coordinate("q"), axis=(0, 1, 0), parent=body, origin=body.point(1, 0, 0), name="arm")
    s.rigid_body(1, (1, 1, 1), turned.point(0, 0, 1), turned)
    dyn, tip = s.compile(), turned.point(0.3, 0.2, 0.5)
    q, v = np.array([0.1, 0.2, 0.3, 0.1, -0.2, 0.3, 0.9, 0.4]), np.array([0.3, -0.5, 0.2, 0.7, 0.4, -0.6, 0.8])
    h = 1e-5
    ahead, behind = (q + sign * h * dyn.rates(q + sign * h / 2 * dyn.rates(q, v), v) for sign in (1, -1))
    for name, call, asked in (("v", dyn.point, tip), ("omega", dyn.frame, "arm")):
        slope = (call(asked, ahead, v)[name] - call(asked, behind, v)[name]) / (2 * h)
        np.testing.assert_allclose(call(asked, q, v)["bias"], slope, rtol=1e-7, atol=1e-8)


def test_a_frame_in_the_plane(arm: dict) -> None:
    for asked in ("link", arm["link"]):
        found = arm["dyn"].frame(asked, Q, V)
        c, s = np.cos(Q[:, 1]), np.sin(Q[:, 1])
        np.testing.assert_allclose(found["R"], np.stack([np.stack([c, -s], -1), np.stack([s, c], -1)], -2))
        np.testing.assert_allclose(found["omega"], V[:, 1])
        np.testing.assert_allclose(found["J"], [[0, 1], [0, 1]])


def test_a_frame_in_space_turns_with_the_rate_of_its_rotation() -> None:
    s = lg.System("two turns")
    a, b = s.coordinates("a b")
    first = s.frame(a, axis=(0, 0, 1))
    second = s.frame(b, axis=(1, 1, 0), parent=first, name="second")
    s.rigid_body(1, (1, 2, 2.5), at=s.origin, frame=second)
    dyn, h = s.compile(), 1e-6
    q, v = np.array([0.4, -0.7]), np.array([1.3, 0.6])
    found = dyn.frame("second", q, v)
    R, omega = found["R"], found["omega"]
    change = (dyn.frame(second, q + h * v)["R"] - dyn.frame(second, q - h * v)["R"]) / (2 * h)
    spin = change @ R.T  # ω× in the fixed axes
    np.testing.assert_allclose(omega, [spin[2, 1], spin[0, 2], spin[1, 0]], atol=1e-8)
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-14)
    np.testing.assert_allclose(found["J"] @ v, omega)
    wanted = np.array(second.rotation.subs({a: 0.4, b: -0.7}), float)
    np.testing.assert_allclose(R, wanted, atol=1e-14)
    assert dyn.frame("second", np.stack([q, q, q]))["omega"].shape == (3, 3)


def test_expressions_are_evaluated_in_batches(arm: dict) -> None:
    dyn, x, theta = arm["dyn"], arm["x"], arm["theta"]
    np.testing.assert_allclose(dyn.evaluate(x + sp.sin(theta), Q), Q[:, 0] + np.sin(Q[:, 1]))
    np.testing.assert_allclose(dyn.evaluate("L*theta' + F + t", Q, V, u=[2.0], t=3.0), 0.7 * V[:, 1] + 5.0)
    np.testing.assert_allclose(dyn.evaluate(arm["L"] * x, Q[0], p={"L": 2.0}), 0.6)
    assert dyn.evaluate("x", Q[0]).shape == ()
    found = dyn.evaluate(sp.Matrix([[x, theta], [theta.diff(), 1]]), Q, V)
    assert found.shape == (2, 2, 2)
    np.testing.assert_allclose(found[1], [[-0.2, 1.1], [0.3, 1.0]])
    np.testing.assert_allclose(dyn.evaluate([x, theta], Q), Q)


def test_accelerations_are_those_of_the_equations(arm: dict) -> None:
    dyn = arm["dyn"]
    wanted = dyn.forward(Q, V, [4.0])
    np.testing.assert_allclose(
        dyn.evaluate([arm["x"].diff(sp.Symbol("t"), 2), arm["theta"].diff(sp.Symbol("t"), 2)], Q, V, [4.0]), wanted
    )
    np.testing.assert_allclose(dyn.evaluate("theta''", Q, V, {"F": 4.0}), wanted[:, 1])


def test_code_is_made_once_for_an_expression(arm: dict) -> None:
    dyn = arm["s"].compile()
    for _ in range(3):
        dyn.evaluate(arm["x"] ** 2, Q)
        dyn.point("tip", Q)
        dyn.frame("link", Q)
    assert len(dyn._seen) == 3


def test_what_is_not_there_is_said(arm: dict) -> None:
    dyn = arm["dyn"]
    other = lg.System("other")
    for call, said in (
        (lambda: dyn.point("tipp", Q), "Did you mean 'tip'"),
        (lambda: dyn.point(None, Q), "must be given by name, or be the object itself"),
        (lambda: dyn.point(other.origin + (1, 2), Q), "another system"),
        (lambda: dyn.point(arm["link"], Q), "Frame"),
        (lambda: dyn.frame("lnk", Q), "Did you mean 'link'"),
        (lambda: dyn.frame(other.frame(1), Q), "another system"),
        (lambda: dyn.evaluate("x + y", Q), "y"),
        (lambda: dyn.evaluate(sp.Symbol("zz"), Q), "unknown symbol 'zz'"),
        (lambda: dyn.evaluate([], Q), "at least one"),
        (lambda: dyn.evaluate(sp.Matrix(2, 0, []), Q), "a matrix to evaluate has no entries"),
    ):
        with pytest.raises(ModelError, match=said):
            call()
    with pytest.raises(RunError, match="has 3 values"):
        dyn.evaluate("x", [1.0, 2.0, 3.0])
