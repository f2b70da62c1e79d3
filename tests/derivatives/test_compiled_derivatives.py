"""`Compiled.derivatives`, `linearized` and `step`: shapes, names, batches, and difference quotients."""

import numpy as np
import pytest

import built_in
import lagrangian as lg

q, v, u = np.array([0.3, 0.4]), np.array([0.2, -0.5]), np.array([1.5])


def satellite() -> lg.System:
    """A floating body with an arm on it."""
    s = lg.System("satellite")
    hull = s.floating_frame("hull")
    s.rigid_body(5, (0.8, 0.9, 1.2), at=hull.point(0.1, 0, 0.2), frame=hull)
    angle, torque = s.coordinate("angle"), s.input("torque")
    arm = s.frame(angle, axis=(0, 1, 0), parent=hull, origin=hull.origin)
    s.rigid_body(1, (0.1, 0.1, 0.02), at=arm.point(0, 0, 0.5), frame=arm)
    s.torque(torque, on=angle)
    s.gravity(direction=(0, 0, -1), g=9.81)
    return s


@pytest.fixture(scope="module")
def cart() -> lg.Compiled:
    return built_in.system("cart-pole").compile()


def test_the_result_names_its_arrays(cart: lg.Compiled) -> None:
    d = cart.derivatives(q, v, {"F": 1.5}, wrt=("q", "v", "u", "m"))
    assert np.allclose(d.a, cart.forward(q, v, u), rtol=1e-13)
    assert (d.a_q.shape, d.a_v.shape, d.a_u.shape, d.Minv.shape) == ((2, 2), (2, 2), (2, 1), (2, 2))
    assert np.allclose(d.a_u[:, 0], d.Minv[:, 0], rtol=1e-13)  # the force acts on the cart alone
    assert np.allclose(d.Minv @ cart.mass_matrix(q), np.eye(2), atol=1e-13)
    h = 1e-6
    m = next(p.value for p in built_in.system("cart-pole").model.parameters if p.name == "m")
    ends = [cart.forward(q, v, u, {"m": m + s * h}) for s in (1, -1)]
    assert np.allclose(d.a_p["m"], (ends[0] - ends[1]) / (2 * h), atol=1e-7)
    assert not d.sparsity["a_q"][:, 0].any() and d.sparsity["a_q"][:, 1].all()  # where the cart is does not matter
    assert "a_q (2, 2)" in repr(d)


def test_batches_equal_single_calls(cart: lg.Compiled) -> None:
    rng = np.random.default_rng(1)
    Q, V, U = rng.normal(size=(3, 5, 2)), rng.normal(size=(3, 5, 2)), rng.normal(size=(5, 1))
    many = cart.derivatives(Q, V, U)
    assert many.a_q.shape == (3, 5, 2, 2)
    A, B = cart.linearized(Q, V, U)
    for i in np.ndindex(3, 5):
        one = cart.derivatives(Q[i], V[i], U[i[1]])
        for name in ("a", "a_q", "a_v", "a_u", "Minv"):
            assert np.allclose(getattr(many, name)[i], getattr(one, name), rtol=1e-12, atol=1e-12)
        assert np.allclose(A[i], cart.linearized(Q[i], V[i], U[i[1]])[0], atol=1e-12)
    assert B.shape == (3, 5, 4, 1)


def test_inverse_dynamics(cart: lg.Compiled) -> None:
    a = np.array([0.7, -0.2])
    d = cart.derivatives(q, v, u, a=a, wrt=("q", "v", "u", "g"))
    assert np.allclose(d.r, cart.inverse(q, v, a, u), rtol=1e-13)
    assert np.allclose(d.M, cart.mass_matrix(q), rtol=1e-13)
    assert np.allclose(d.r_u, [[-1], [0]])
    forward = cart.derivatives(q, v, u)
    at = cart.derivatives(q, v, u, a=forward.a)
    assert np.allclose(-np.linalg.solve(at.M, at.r_q), forward.a_q, atol=1e-12)
    assert np.allclose(-np.linalg.solve(at.M, at.r_v), forward.a_v, atol=1e-12)
    assert set(d.r_p) == {"g"}


def test_linearized_is_the_linearization_about_an_equilibrium(cart: lg.Compiled) -> None:
    wanted = built_in.system("cart-pole").linearize({"theta": 0.0})
    A, B = cart.linearized([0.0, 0.0], [0.0, 0.0])
    assert np.allclose(A, wanted.A, atol=1e-12) and np.allclose(B, wanted.B, atol=1e-12)


@pytest.mark.parametrize("method", ["euler", "midpoint", "rk4"])
def test_a_step_of_a_floating_system_has_the_derivatives_of_the_discrete_map(method: str) -> None:
    dyn, h, dt = satellite().compile(), 1e-6, 0.05
    at = np.array([0.1, 0.2, 0.3, 0.2, -0.3, 0.5, 1.1, 0.4])  # the quaternion need not have length 1
    w = np.array([0.3, -0.2, 0.5, 0.7, -0.4, 0.6, 0.9])
    x1, A, B = dyn.step(at, w, [0.3], dt, method=method, derivatives=True)
    assert np.array_equal(x1, dyn.step(at, w, [0.3], dt, method=method))

    def back(x: np.ndarray) -> np.ndarray:
        """A small change of x₁ along the velocities, by solving N ξ = δq."""
        N = np.stack([dyn.rates(x1[:8], e) for e in np.eye(7)], axis=-1)
        return np.concatenate([np.linalg.lstsq(N, x[:8])[0], x[8:]])

    for k, e in enumerate(np.eye(15)):
        dq, dv, du = dyn.rates(at, e[:7]), e[7:14], e[14:]
        ends = [dyn.step(at + s * dq, w + s * dv, 0.3 + s * du, dt, method=method) for s in (h, -h)]
        wanted = back((ends[0] - ends[1]) / (2 * h))
        assert np.allclose((A if k < 14 else B)[:, k % 14], wanted, atol=2e-8)


def test_short_steps_of_a_floating_system_tend_to_its_linear_model() -> None:
    dyn = satellite().compile()
    at, w = np.array([0, 0, 0, 0.1, 0.2, -0.3, 0.9, 0.4]), np.linspace(0.2, 0.8, 7)
    A, B = dyn.linearized(at, w, [0.3])
    errors = []
    for dt in (1e-3, 5e-4):
        _, one, input_ = dyn.step(at, w, [0.3], dt, derivatives=True)
        errors.append(max(np.abs((one - np.eye(14)) / dt - A).max(), np.abs(input_ / dt - B).max()))
    assert errors[0] < 0.05 and errors[1] == pytest.approx(errors[0] / 2, rel=0.05)  # of first order


def test_steps_are_those_of_the_method(cart: lg.Compiled) -> None:
    x = np.concatenate([q, v])

    def f(x: np.ndarray) -> np.ndarray:
        return cart.rhs(0.0, x, u)

    dt = 0.02
    assert np.allclose(cart.step(q, v, u, dt, method="euler"), x + dt * f(x), atol=1e-15)
    k1 = f(x)
    k2 = f(x + dt / 2 * k1)
    k3 = f(x + dt / 2 * k2)
    wanted = x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + f(x + dt * k3))
    assert np.allclose(cart.step({"x": 0.3, "theta": 0.4}, v, {"F": 1.5}, dt), wanted, atol=1e-15)
    x1, A, B = cart.step(np.tile(q, (4, 1)), v, u, dt, derivatives=True)
    assert x1.shape == (4, 4) and A.shape == (4, 4, 4) and B.shape == (4, 4, 1)


def test_without_inputs_there_are_no_columns() -> None:
    dyn = built_in.system("double-pendulum").compile()
    d = dyn.derivatives(q, v)
    assert d.a_u.shape == (2, 0) and dyn.linearized(q, v)[1].shape == (4, 0)
    assert dyn.step(q, v, None, 0.01, derivatives=True)[2].shape == (4, 0)


def test_what_does_not_fit_is_said(cart: lg.Compiled) -> None:
    with pytest.raises(lg.ModelError, match="nothing called 'mass'"):
        cart.derivatives(q, v, wrt=("q", "mass"))
    with pytest.raises(lg.RunError, match="a_u was not computed"):
        _ = cart.derivatives(q, v, wrt="q").a_u
    with pytest.raises(KeyError, match="a_p has no entry"):
        _ = cart.derivatives(q, v, wrt=("q", "m")).a_p["L"]
    with pytest.raises(lg.Error, match="has no 'ddq_dq'"):
        _ = cart.derivatives(q, v).ddq_dq  # type: ignore[attr-defined]
    with pytest.raises(lg.RunError, match="3"):
        cart.derivatives([1, 2, 3], v)
    with pytest.raises(lg.RunError, match="last axis must have 2"):
        cart.step([1, 2, 3], v, u, 0.1)
    with pytest.raises(lg.RunError, match="each of x, theta"):
        cart.step({"x": 1.0}, v, u, 0.1)
    with pytest.raises(lg.RunError, match="theta must consist of numbers"):
        cart.step({"x": 1.0, "theta": "a"}, v, u, 0.1)
    for wrt in (None, ("q", 3)):
        with pytest.raises(lg.RunError, match="wrt must be names"):
            cart.derivatives(q, v, wrt=wrt)  # type: ignore[call-overload]
    with pytest.raises(lg.RunError, match="no method 'rk5'"):
        cart.step(q, v, u, 0.1, method="rk5")
    with pytest.raises(lg.RunError, match="finite number of seconds"):
        cart.step(q, v, u, float("nan"))
    with pytest.raises(lg.ModelError, match="mass"):
        cart.derivatives(q, v, p={"m": -1.0})


@pytest.mark.slow
def test_allowed_changes_of_a_linkage_at_rest_have_the_poles_of_its_linear_model() -> None:
    """Tᵀ A T about a rest has the eigenvalues of `System.linearize`, which finds its states by another route."""
    system = built_in.system("four-bar")
    dyn, rest = system.compile(), system.equilibria()[0]
    at = [rest.at[name] for name in dyn.coordinates]
    still = np.zeros(len(at))
    T = dyn.allowed_changes(at, still)
    A, _ = dyn.linearized(at, still)
    assert T.shape == (6, 2) and np.allclose(T.T @ T, np.eye(2), atol=1e-12)
    assert np.allclose(A @ T, T @ (T.T @ A @ T), atol=1e-8 * np.abs(A).max())  # changes stay allowed
    wanted = np.sort_complex(system.linearize(rest).poles)
    assert np.allclose(np.sort_complex(np.linalg.eigvals(T.T @ A @ T)), wanted, rtol=1e-8, atol=1e-8)


@pytest.mark.slow
def test_a_step_of_a_linkage_has_the_derivatives_of_the_discrete_map() -> None:
    dyn = built_in.system("four-bar").compile()
    n = len(dyn.coordinates)
    at, w = dyn.assemble(None, {dyn.velocities[0]: 2.0}, fixed=dyn.coordinates[0])
    x0, h = np.concatenate([at, w]), 1e-3
    x1, A, _ = dyn.step(at, w, None, h, derivatives=True)
    eps = 1e-6
    for k, e in enumerate(np.eye(2 * n)):
        ends = [dyn.step((x0 + s * eps * e)[:n], (x0 + s * eps * e)[n:], None, h) for s in (1, -1)]
        assert np.allclose(A[:, k], (ends[0] - ends[1]) / (2 * eps), rtol=1e-6, atol=1e-6)
    T0, T1 = dyn.allowed_changes(at, w), dyn.allowed_changes(x1[:n], x1[n:])
    assert np.allclose(T1 @ (T1.T @ A @ T0), A @ T0, atol=1e-9)  # a step keeps allowed changes allowed
    both = dyn.allowed_changes(np.stack([at, x1[:n]]), np.stack([w, x1[n:]]))
    assert both.shape == (2, 2 * n, 2) and np.allclose(both[1] @ both[1].T, T1 @ T1.T, atol=1e-10)


def test_without_constraints_every_change_is_allowed(cart: lg.Compiled) -> None:
    assert np.array_equal(cart.allowed_changes(np.zeros((3, 2)), v), np.broadcast_to(np.eye(4), (3, 4, 4)))
    with pytest.raises(lg.RunError, match="3"):
        built_in.system("four-bar").compile().allowed_changes([0, 0], [0, 0, 0])


def test_under_constraints_forces_along_the_rows_change_nothing() -> None:
    dyn = built_in.system("four-bar").compile()
    at, w = dyn.assemble({"theta2": 1.0} if "theta2" in dyn.coordinates else None)
    d = dyn.derivatives(at, w)
    A = dyn.constraint_matrix(at)
    assert np.abs(d.Minv).max() > 0.1
    assert np.allclose(d.Minv @ A.T, 0, atol=1e-9) and np.allclose(d.Minv, d.Minv.T, atol=1e-9)
    h = 1e-6
    for k, e in enumerate(np.eye(len(at))):  # a is defined beside the constraints, too
        ends = [dyn.forward(at + s * h * e, w) for s in (1, -1)]
        assert np.allclose(d.a_q[:, k], (ends[0] - ends[1]) / (2 * h), rtol=1e-5, atol=1e-5)
