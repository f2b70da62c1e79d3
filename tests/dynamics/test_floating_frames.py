"""Systems with floating frames: against Pinocchio, MuJoCo, closed forms and the laws of motion."""

import subprocess
import sys

import numpy as np
import pytest
import sympy as sp
from floating_trees import HUMANOID, QUADRUPED, mujoco_accelerations, pinocchio_model, states, system, turn
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import lagrangian as lg
from lagrangian import dynamics
from lagrangian.verify.motion import verify_motion
from size import rest_slow

TREES = {"body": [], "quadruped": QUADRUPED, "humanoid": HUMANOID}


def close(found, expected, tolerance):
    size = np.abs(expected).max(axis=-1, keepdims=True)
    assert (np.abs(found - expected) <= tolerance * size).all(), (np.abs(found - expected) / size).max()


@pytest.mark.parametrize("name", rest_slow(TREES, {"body"}))
def test_against_pinocchio(name):
    pin = pytest.importorskip("pinocchio")
    parents = TREES[name]
    s = system(parents, 3)
    q, v, u = states(s, 1000, 5)
    assert v.shape[1] == {"body": 6, "quadruped": 18, "humanoid": 30}[name]
    reference = pinocchio_model(pin, parents, 3)
    data = reference.createData()
    compiled = lg.loads(s.to_toml()).compile() if name == "quadruped" else s.compile()
    a = compiled.forward(q, v, u)
    close(a, np.array([pin.aba(reference, data, *x).copy() for x in zip(q, v, u, strict=True)]), 1e-9)
    few = slice(0, 20)
    q, v, u, a = q[few], v[few], u[few], v[few] * 2
    expected = np.array([pin.rnea(reference, data, *x).copy() for x in zip(q, v, a, strict=True)])
    close(compiled.inverse(q, v, a, u), expected - u, 1e-11)
    close(compiled.bias(q, v), np.array([pin.nle(reference, data, *x).copy() for x in zip(q, v, strict=True)]), 1e-11)
    weights = np.array([pin.computeGeneralizedGravity(reference, data, x).copy() for x in q])
    close(compiled.potential_force(q), weights, 1e-11)
    M = compiled.mass_matrix(q)
    for found, x in zip(M, q, strict=True):
        upper = np.triu(pin.crba(reference, data, x))
        assert np.abs(found - upper - np.triu(upper, 1).T).max() < 1e-12 * np.abs(upper).max()
    kinetic, potential = compiled.energies(q, v)
    assert kinetic == pytest.approx([pin.computeKineticEnergy(reference, data, *x) for x in zip(q, v, strict=True)])
    assert potential == pytest.approx([pin.computePotentialEnergy(reference, data, x) for x in q], rel=1e-9)


@pytest.mark.parametrize("name", rest_slow(TREES, {"body"}))
def test_against_mujoco(name):
    mujoco = pytest.importorskip("mujoco")
    parents = TREES[name]
    s = system(parents, 8)
    q, v, u = states(s, 1000, 9)
    close(s.compile().forward(q, v, u), mujoco_accelerations(mujoco, parents, 8, q, v, u), 1e-9)


def two_bodies(*, given=True):
    """Two floating bodies on a spring, a wheel in one, a slider, damping and driven forces of every kind.

    ``given``: with a kinetic energy that no body has.
    """
    s = lg.System("two bodies")
    k, b, mu, L = s.parameters("k b mu L", k=30.0, b=0.4, mu=0.1, L=0.8)
    F, tau, p = s.inputs("F tau p")
    base = s.floating_frame("base")
    phi = s.coordinate("phi")
    other = s.floating_frame("other")
    z = s.coordinate("z")
    wheel = s.frame(phi, axis=(0, sp.Rational(3, 5), sp.Rational(4, 5)), parent=base, origin=base.point(0.1, 0.2, 0))
    s.rigid_body(2, [[0.3, 0.01, 0], [0.01, 0.4, 0.02], [0, 0.02, 0.5]], base.point(0.05, 0, 0.1), base)
    s.rigid_body(1, (0.1, 0.2, 0.15), wheel.point(0, 0.1, 0.1), wheel)
    s.rigid_body(1.5, (0.2, 0.25, 0.3), other.origin, other)
    s.particle(0.7, base.point(0, 0, z))
    s.gravity(direction=(0, 0, -1))
    tip = s.point("tip", (0.3, 0, 0.1), frame=other)
    s.spring(k, between=(base.point(-0.2, 0, 0), tip), rest=0.4)
    s.damper(b, between=(base.origin, other.origin))
    s.spring(5, deflection=s["base_z"])
    s.damper(0.3, deflection=s["other_y"] - s["base_y"])
    s.dissipation(0.1 * s["base_wx"] ** 2 + 0.2 * s["other_vz"] ** 2)
    s.force((F, 0, 0.3 * s["base_wy"]), at=tip, axes=other, reaction=base.origin)
    s.torque((tau, 0, 1), on=other, reaction=base, axes=base)
    s.torque(tau, on=wheel, reaction=base)
    s.generalized_force(s["base_wz"], p)
    if not given:
        return s
    s.kinetic(0.3 * z.diff() ** 2 + mu * (s["base_x"].diff() ** 2 + s["base_y"].diff() ** 2) * (L + z) / L)
    return s


@pytest.mark.slow
def test_two_routes_and_the_laws_of_motion():
    checks = verify_motion(two_bodies().model, states=25)
    assert len(checks) == 7
    assert not [str(c.what) for c in checks if c.holds is False]


@pytest.mark.parametrize("name", rest_slow(["two", "quadruped"], {"two"}))
def test_every_kind_of_force_is_derived_in_quasi_velocities(name):
    s = two_bodies(given=False) if name == "two" else system(QUADRUPED, 3)
    d = s.derive()
    assert len(d.equations) == len(s.model.velocities) and [str(c.what) for c in d.verified if not c.holds] == []


@pytest.mark.slow
def test_a_wrong_law_does_not_pass(monkeypatch):
    from lagrangian.dynamics import christoffel, floating

    monkeypatch.setattr(floating, "transported", lambda g, u, f: list(f))
    model = two_bodies().model
    assert not verify_motion(model, states=2)[0].holds
    monkeypatch.setattr(christoffel, "bracket", lambda g, a, b: list(b))
    assert not all(c.holds for c in verify_motion(model, states=2)[4:6])


@pytest.mark.slow
def test_all_that_is_made_of_a_floating_system_is_verified():
    checks = two_bodies().verify(states=2)
    assert len(checks) == 33  # seven of the written lines, seven of the programs, nineteen of what is made of them
    assert not [str(c.what) for c in checks if c.holds is False]


def test_coriolis_is_christoffels_in_coordinates_that_are_independent():
    """The connection does not know by which velocities it is written.

    A body turned by yaw, pitch and roll q has ω = W(q) q̇. With C of the quasi-velocities, the forces C(u) u along ω
    are those of the angles, Wᵀ C u + Wᵀ M Ẇ q̇ = C_q q̇.
    """
    inertia = [[0.3, 0.01, 0.0], [0.01, 0.4, 0.02], [0.0, 0.02, 0.5]]
    free = lg.System("free")
    base = free.floating_frame("base")
    free.rigid_body(1, inertia, base.origin, base)
    turned = lg.System("turned")
    angles = turned.coordinates("yaw pitch roll")
    frame = None
    for angle, axis in zip(angles, ((0, 0, 1), (0, 1, 0), (1, 0, 0)), strict=True):
        frame = turned.frame(angle, axis=axis, parent=frame)
    turned.rigid_body(1, inertia, turned.origin + (0, 0, 0), frame)
    q, rates = np.array([0.3, -0.7, 1.1]), np.array([0.5, 0.4, -0.9])
    omega = sp.Matrix(frame.angular_velocity).doit()
    W = omega.jacobian([a.diff() for a in angles])
    Wdot = W.diff(free.t)
    values = {a.diff(): x for a, x in zip(angles, rates, strict=True)}
    values |= dict(zip(angles, q, strict=True))
    W, Wdot = (np.array(m.subs(values).evalf(), float) for m in (W, Wdot))
    own, other = free.compile(), turned.compile()
    u = np.array([0, 0, 0, *(W @ rates)])
    at = np.array([0, 0, 0, 0.1, 0.2, 0.3, 0.4])
    forces = (own.coriolis_matrix(at, u) @ u)[3:] + own.mass_matrix(at)[3:, 3:] @ Wdot @ rates
    assert W.T @ forces == pytest.approx(other.coriolis_matrix(q, rates) @ rates, abs=1e-12)


def on_a_base(floats):
    """A trunk with a bent limb of two joints; the trunk floats, or slides along x, y, z and turns by three angles."""
    s = lg.System("limb")
    if floats:
        base = s.floating_frame("base")
        origin = base.origin
    else:
        origin = s.origin + s.coordinates("x y z")
        base = None
        for angle, axis in zip(s.coordinates("yaw pitch roll"), ((0, 0, 1), (0, 1, 0), (1, 0, 0)), strict=True):
            base = s.frame(angle, axis=axis, parent=base, origin=origin)
    s.rigid_body(3, [[0.3, 0.01, 0], [0.01, 0.4, 0.02], [0, 0.02, 0.5]], base.point(0.05, -0.02, 0.1), base)
    hip, knee = s.coordinates("hip knee")
    upper = s.frame(hip, axis=(1, 0, 0), parent=base, origin=base.point(0.2, 0.1, -0.1))
    lower = s.frame(knee, axis=(0, 1, 0), parent=upper, origin=upper.point(0, 0, -0.3))
    s.rigid_body(1, (0.02, 0.03, 0.01), upper.point(0, 0.01, -0.15), upper)
    s.rigid_body(0.5, (0.01, 0.012, 0.005), lower.point(0.02, 0, -0.15), lower)
    s.gravity(direction=(0, 0, -1))
    s.spring(80, between=(s.origin + (0, 0, 1), lower.point(0, 0, -0.3)), rest=0.5)
    s.damper(0.5, between=(s.origin + (1, 0, 0), upper.origin))
    return s, base


@pytest.mark.slow
@pytest.mark.sampled(3)
@pytest.mark.parametrize("seed", range(3))
def test_the_motion_is_that_of_a_base_described_by_angles(seed):
    """v = Rᵀ ṙ and ω = W(q) q̇, so v̇ = Rᵀ r̈ − ω × v and ω̇ = W q̈ + Ẇ q̇; energies and points are the same."""
    free, _ = on_a_base(True)
    turned, frame = on_a_base(False)
    rng = np.random.default_rng(seed)
    q, rates = rng.uniform(-1, 1, 8), rng.uniform(-1, 1, 8)
    other = turned.compile()
    a = other.forward(q, rates)
    coordinates = [c.symbol for c in turned.model.coordinates]
    values = {c.diff(): x for c, x in zip(coordinates, rates, strict=True)}
    values |= dict(zip(coordinates, q, strict=True))
    W = sp.Matrix(frame.angular_velocity).doit().jacobian([c.diff() for c in coordinates[3:6]])
    W, Wdot, R = (np.array(m.subs(values).evalf(), float) for m in (W, W.diff(turned.t), frame.rotation))
    omega, velocity = W @ rates[3:6], R.T @ rates[:3]
    quaternion = Rotation.from_matrix(R).as_quat() * 1.7
    at, v = [*q[:3], *quaternion, *q[6:]], [*velocity, *omega, *rates[6:]]
    compiled = free.compile()
    expected = [*(R.T @ a[:3] - np.cross(omega, velocity)), *(W @ a[3:6] + Wdot @ rates[3:6]), *a[6:]]
    assert compiled.forward(at, v) == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert compiled.energies(at, v) == pytest.approx(other.energies(q, rates), rel=1e-12)
    assert compiled.rates(at, v)[:3] == pytest.approx(rates[:3], abs=1e-12)


def top(inertia):
    s = lg.System("top")
    base = s.floating_frame("base")
    s.rigid_body(2, inertia, base.origin, base)
    return s.compile()


def test_a_symmetric_top_free_of_torque_precesses_as_the_closed_form_says():
    """ω about the axis stays; the rest turns in body axes at Ω = (C − A)/A ω_z, while R I ω and the velocity stay.

    Source: L. D. Landau, E. M. Lifshitz, Mechanics, 3rd ed., §36, equations (36.5)-(36.7).
    """
    A, C, end = 0.3, 0.5, 7.0
    compiled, w = top((A, A, C)), np.array([0.4, 0.1, 2.0])
    start = np.array([0, 0, 0, 0, 0, 0, 1, 0.3, -0.2, 0.1, *w])
    run = solve_ivp(compiled.rhs, (0, end), start, method="DOP853", rtol=1e-12, atol=1e-13)
    q, v = run.y[:7, -1], run.y[7:, -1]
    c, s = np.cos((C - A) / A * w[2] * end), np.sin((C - A) / A * w[2] * end)
    assert v[3:] == pytest.approx([c * w[0] - s * w[1], s * w[0] + c * w[1], w[2]], abs=1e-10)
    R, inertia = turn(q[3:]), np.diag([A, A, C])
    assert np.linalg.norm(q[3:]) == pytest.approx(1, abs=1e-10)
    assert R @ inertia @ v[3:] == pytest.approx(inertia @ w, abs=1e-10)
    assert R @ v[:3] == pytest.approx([0.3, -0.2, 0.1], abs=1e-10)
    assert q[:3] == pytest.approx(end * np.array([0.3, -0.2, 0.1]), abs=1e-9)


@pytest.mark.slow
def test_energy_is_kept_and_a_quaternions_length_means_nothing():
    s = system(QUADRUPED, 4)
    compiled = s.compile()
    q, v, _ = states(s, 1, 1)
    x = np.concatenate([q[0], v[0]])
    run = solve_ivp(compiled.rhs, (0, 0.5), x, method="DOP853", rtol=1e-11, atol=1e-12)
    energies = compiled.energy(run.y[:19].T, run.y[19:].T)
    assert np.ptp(energies) < 1e-8 * np.abs(energies).max()
    longer = q.copy()
    longer[:, 3:7] *= -3.7
    for found, expected in (
        (compiled.forward(longer, v), compiled.forward(q, v)),
        (compiled.energy(longer, v), compiled.energy(q, v)),
        (compiled.potential_force(longer), compiled.potential_force(q)),
        (compiled.rates(longer, v)[:, :3], compiled.rates(q, v)[:, :3]),
        (compiled.rates(longer, v)[:, 3:7], -3.7 * compiled.rates(q, v)[:, 3:7]),
    ):
        assert found == pytest.approx(expected, rel=1e-12)


@pytest.mark.slow
def test_a_points_velocity_is_the_rate_of_its_position():
    s = two_bodies()
    compiled = s.compile()
    rng = np.random.default_rng(2)
    q, v = rng.normal(size=(5, 16)), rng.normal(size=(5, 14))
    found, step = compiled.point("tip", q, v), 1e-5
    ahead, behind = (compiled.point("tip", q + h * compiled.rates(q, v))["r"] for h in (step, -step))
    assert found["v"] == pytest.approx((ahead - behind) / (2 * step), abs=1e-8)
    assert np.einsum("nij,nj->ni", found["J"], v) == pytest.approx(found["v"], abs=1e-12)
    other = [turn(x) @ [0.3, 0, 0.1] for x in q[:, 11:15]]
    assert found["r"] == pytest.approx(q[:, 8:11] + np.array(other), abs=1e-12)


def test_names_and_order():
    s = two_bodies()
    compiled = s.compile()
    base = ("base_x", "base_y", "base_z", "base_qx", "base_qy", "base_qz", "base_qw")
    assert compiled.coordinates[:9] == (*base, "phi", "other_x")
    assert compiled.coordinates[-1] == "z"
    assert compiled.velocities[3:8] == ("base_wx", "base_wy", "base_wz", "phi'", "other_vx")
    program = dynamics.rhs(s.model)
    assert program.inputs["x"] == (*compiled.coordinates, *compiled.velocities)
    assert compiled.program("inverse").inputs["a"][5:7] == ("base_wz'", "phi''")
    assert [c.start for c in s.model.coordinates if c.start] == [1.0, 1.0]
    assert s["base_origin"] is s["base"].origin


@pytest.mark.slow
def test_exported_python_and_c_agree_with_the_engine(tmp_path):
    s = two_bodies()
    compiled = s.compile()
    s.export(tmp_path / "two.py")
    space = {}
    exec((tmp_path / "two.py").read_text(encoding="utf-8"), space)
    rng = np.random.default_rng(6)
    q, v, u = rng.normal(size=(5, 16)), rng.normal(size=(5, 14)), rng.normal(size=(5, 3))
    p = [30.0, 0.4, 0.1, 0.8, 9.81]
    assert space["two_forward"](q, v, u, p, 0.0) == pytest.approx(compiled.forward(q, v, u), rel=1e-10, abs=1e-10)
    assert space["two_rates"](q, v, u, p, 0.0) == pytest.approx(compiled.rates(q, v), rel=1e-12, abs=1e-12)
    assert {path.name for path in s.export(tmp_path / "two.c")} == {"two.c", "two.h"}
    assert "two_rates" in (tmp_path / "two.h").read_text(encoding="utf-8")


@pytest.mark.sampled(2)
@pytest.mark.parametrize("length", [0.0, 1e-170])
def test_a_quaternion_without_length_is_told(length):
    s = two_bodies()
    compiled = s.compile()
    rng = np.random.default_rng(6)
    q, v = rng.normal(size=(3, 16)), rng.normal(size=(3, 14))
    q[1, 3:7] = length / 2
    for call in (
        lambda: compiled.forward(q, v),
        lambda: compiled.rhs(0.0, np.concatenate([q, v], axis=-1)),
        lambda: compiled.energy(q, v),
        lambda: compiled.bias(q, v),
        lambda: compiled.point("base_origin", q, v),
    ):
        with pytest.raises(lg.RunError, match="base_qx, base_qy, base_qz, base_qw has the length"):
            call()


def test_what_does_not_fit_is_refused():
    s = lg.System("wrong")
    base = s.floating_frame("base")
    tau = s.input("tau")
    with pytest.raises(lg.ModelError, match="does not say about which axis"):
        s.torque(tau, on=base)
    with pytest.raises(lg.ModelError, match="entry of a quaternion"):
        s.generalized_force(s["base_qx"], tau)
    with pytest.raises(lg.ModelError, match="contains a rate, base_vx"):
        s.point("P", (s["base_vx"], 0, 0))
    with pytest.raises(lg.ModelError, match="holds a velocity, base_wx"):
        s.potential(s["base_wx"])
    with pytest.raises(lg.ModelError, match="contains an acceleration, base_wx'"):
        s.dissipation(s["base_wx"].diff())
    with pytest.raises(lg.ModelError, match="has 2 components"):
        s.point("Q", (0, 1))
    with pytest.raises(lg.ModelError, match="frame 'base' is defined twice"):
        s.floating_frame("base")
    s.coordinate("hull_qz")
    with pytest.raises(lg.ModelError, match="'hull_qz' is defined twice"):
        s.floating_frame("hull")
    with pytest.raises(lg.ModelError, match="nothing is named 'hull_x'"):
        s["hull_x"]
    with pytest.raises(lg.ModelError, match="axes must be a frame"):
        s.torque((0, 0, tau), on=base, axes="base")
    s.rigid_body(1, (1, 1, 1), base.origin, base)
    with pytest.raises(lg.ModelError, match="floats with a quaternion") as refused:
        s.derive(form="expanded")
    assert "yaw" in refused.value.fix


def test_a_velocity_that_moves_no_mass_is_named():
    s = lg.System("rod")
    base = s.floating_frame("base")
    s.particle(1, base.origin)
    s.particle(1, base.point(1, 0, 0))
    with pytest.raises(lg.ModelError, match="base_wx"):
        s.compile()


@pytest.mark.slow
def test_the_command_verifies_and_derives_given_energies_beside_floating_frames(tmp_path):
    file = tmp_path / "two.toml"
    two_bodies().save(file)

    def run(*arguments):
        command = [sys.executable, "-m", "lagrangian", *arguments]
        return subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=False)

    verified = run("verify", str(file), "--states", "5")
    assert verified.returncode == 0, verified.stderr
    assert verified.stdout.count("✓") + verified.stdout.count("– ") == 33
    derived = run("derive", str(file))
    assert derived.returncode == 0, derived.stderr
    assert "quasi-velocities" in derived.stdout and "✗" not in derived.stdout
