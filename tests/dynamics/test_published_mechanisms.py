"""Mechanisms with constraints at one state, against printed values, closed forms and Pinocchio."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest
import sympy as sp
from sympy.physics import mechanics

import built_in
import lagrangian as lg

STENCIL = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
"""Coefficients of the central difference of order 8."""


def derivative(f: Callable[[float], Any], h: float) -> Any:
    return sum(c * (f(k * h) - f(-k * h)) for k, c in STENCIL.items()) / h


def values(system: lg.System) -> dict[str, float]:
    return {p.name: float(p.value) for p in system.model.parameters if p.value is not None}


def test_andrews_squeezer_starts_as_printed() -> None:
    """Mazzia and Magherini, Test Set for IVP Solvers 2.4, part II, section 6: β″, Θ″, λ (with the other sign)."""
    system = built_in.system("andrews-squeezer")
    dyn = system.compile()
    q = np.array([system.model.settings["initial"].get(name, 0.0) for name in dyn.coordinates])
    v = np.zeros(7)
    printed = np.array([14222.4439199541138705911625887, -10666.8329399655854029433719415, 0, 0, 0, 0, 0])
    forces = np.array([98.5668703962410896057654982170, -6.12268834425566265503114393122, 0, 0, 0, 0])
    assert np.abs(dyn.forward(q, v) - printed).max() < 1e-10 * printed[0]
    assert np.abs(np.array(list(dyn.multipliers(q, v).values())) + forces).max() < 1e-11 * forces[0]
    assert max(map(abs, dyn.residual(q)["position"].values())) < 1e-16


def whipple(speed: float) -> np.ndarray:
    """The matrix of (lean, steer, lean', steer') about straight running at a speed, by differences of order 8."""
    system = built_in.system("whipple-bicycle")
    dyn, p = system.compile(), values(system)
    free = ("phi", "delta")

    def slope(name: str, h: float) -> Any:
        def motion(by: float) -> Any:
            place = {name: by} if name in free else {}
            rate = {"theta_r'": speed / p["r_r"], **({name: by} if name not in free else {})}
            q, v = dyn.assemble(place, rate, fixed=(*free, "theta_r"))
            return dyn.forward(q, v)[[dyn.coordinates.index(c) for c in free]]

        return derivative(motion, h)

    columns = [slope(name, 0.02) for name in (*free, "phi'", "delta'")]
    return np.block([[np.zeros((2, 2)), np.eye(2)], [np.array(columns).T]])


PRINTED = {
    0.0: [-5.53094371765393, -3.13164324790656, 3.13164324790656, 5.53094371765393],
    5.0: [
        -14.07838969279822,
        -0.775341882195845 - 4.46486771378823j,
        -0.775341882195845 + 4.46486771378823j,
        -0.322866429004087,
    ],
}


@pytest.mark.slow
@pytest.mark.parametrize("speed", PRINTED)
def test_a_bicycle_has_the_printed_eigenvalues(speed: float) -> None:
    """Meijaard, Papadopoulos, Ruina and Schwab, Proc. R. Soc. A 463 (2007) 1955-1982, table 2."""
    found = np.sort_complex(np.linalg.eigvals(whipple(speed)))
    assert np.abs(found - np.sort_complex(np.array(PRINTED[speed]))).max() < 1e-11


def test_a_disc_stays_upright_when_it_is_fast() -> None:
    """θ‴ = (m g r − K (K + m r²) Ω²/I) θ′/(I + m r²) near upright rolling: Neimark and Fufaev 1972, III.3.

    So it is stable where Ω² > m g r I/(K (K + m r²)), which is g/3r for a thin disc.
    """
    system = built_in.system("rolling-disc")
    dyn, p = system.compile(), values(system)
    m, r, I, K, g = (p[name] for name in "mrIKg")

    def matrix(spin: float) -> np.ndarray:
        def motion(name: str, by: float) -> Any:
            place = {"theta": by} if name == "theta" else {}
            rate = {"phi'": spin, **({name: by} if name != "theta" else {})}
            q, v = dyn.assemble(place, rate, fixed=("psi", "theta", "phi"))
            return dyn.forward(q, v)[[3, 2]]

        columns = [derivative(lambda by, n=n: motion(n, by), 0.01) for n in ("theta", "theta'", "psi'")]
        return np.vstack([[0, 1, 0], np.array(columns).T])

    critical = m * g * r * I / (K * (K + m * r * r))
    assert critical == pytest.approx(g / (3 * r))
    for factor in (0.5, 0.99, 1.01, 2.0):
        poles = np.linalg.eigvals(matrix(np.sqrt(factor * critical)))
        square = (m * g * r - K * (K + m * r * r) * factor * critical / I) / (I + m * r * r)
        squares = np.sort(np.real(poles**2))
        assert squares == pytest.approx(np.sort([0.0, square, square]), abs=1e-9)
        assert (poles.real.max() > 1e-6) == (factor < 1)


def test_the_force_on_a_knife_edge_is_that_of_a_free_body() -> None:
    """The knife carries m (v θ' + a θ''): mass times the acceleration of the centre of mass across the sleigh."""
    system = built_in.system("chaplygin-sleigh")
    dyn, p = system.compile(), values(system)
    for theta, v, rate in ((0.3, 1.2, 0.7), (-2.0, -0.4, 3.0), (1.0, 0.0, -1.0)):
        given = [v * np.cos(theta), v * np.sin(theta), rate]
        turning = dyn.forward([0, 0, theta], given)[2]
        assert turning == pytest.approx(-p["a"] * p["m"] * v * rate / (p["J"] + p["a"] ** 2 * p["m"]), rel=1e-13)
        force = p["m"] * (v * rate + p["a"] * turning)
        assert dyn.multipliers([0, 0, theta], given)["knife edge"] == pytest.approx(force, rel=1e-12, abs=1e-13)


@pytest.mark.slow
def test_a_ladder_leaves_the_wall_at_two_thirds_of_its_height() -> None:
    """The wall's force is m g (3/4) cos θ (3 sin θ − 2 sin θ₀): Goldstein's and every book's problem of the ladder."""
    system = built_in.system("ladder")
    dyn, p = system.compile(), values(system)
    m, g, l, start = p["m"], p["g"], p["l"], 1.1
    for theta in (1.1, 0.9, np.arcsin(2 / 3 * np.sin(start)), 0.5):
        rate = -np.sqrt(3 * g / l * (np.sin(start) - np.sin(theta)))
        q, v = dyn.assemble({"theta": theta}, {"theta'": rate}, fixed="theta")
        force = 0.75 * m * g * np.cos(theta) * (3 * np.sin(theta) - 2 * np.sin(start))
        assert dyn.multipliers(q, v)["wall"] == pytest.approx(force, rel=1e-12, abs=1e-11)


def four_bar_of_pinocchio(pin: Any, p: Mapping[str, float]) -> tuple[Any, Any]:
    """The example's linkage by relative angles about −y in the plane x, z, and its closure in the plane."""
    model = pin.Model()
    model.gravity.linear = np.array([0, 0, -p["g"]])
    parent, offset = 0, np.zeros(3)
    for k in (1, 2):
        joint = model.addJoint(
            parent, pin.JointModelRevoluteUnaligned(0.0, -1.0, 0.0), pin.SE3(np.eye(3), offset), f"{k}"
        )
        m, l = p[f"m{k}"], p[f"l{k}"]
        body = pin.Inertia(m, np.array([l / 2, 0, 0]), np.diag([0, m * l * l / 12, m * l * l / 12]))
        model.appendBodyToJoint(joint, body, pin.SE3.Identity())
        parent, offset = joint, np.array([l, 0, 0])
    m, l = p["m3"], p["l3"]
    rocker = model.addJoint(
        0, pin.JointModelRevoluteUnaligned(0.0, -1.0, 0.0), pin.SE3(np.eye(3), np.array([p["d"], 0, 0])), "3"
    )
    body = pin.Inertia(m, np.array([l / 2, 0, 0]), np.diag([0, m * l * l / 12, m * l * l / 12]))
    model.appendBodyToJoint(rocker, body, pin.SE3.Identity())
    ends = pin.SE3(np.eye(3), np.array([p["l2"], 0, 0])), pin.SE3(np.eye(3), np.array([l, 0, 0]))
    frame = pin.ReferenceFrame.LOCAL
    return model, pin.RigidConstraintModel(pin.ContactType.CONTACT_3D, model, parent, ends[0], rocker, ends[1], frame)


def test_a_four_bar_moves_as_in_pinocchio() -> None:
    """`constraintDynamics` of Carpentier, Budhiraja and Mansard, RSS 2021; its third row is idle in the plane."""
    pin = pytest.importorskip("pinocchio")
    system = built_in.system("four-bar")
    dyn = system.compile()
    model, closure = four_bar_of_pinocchio(pin, values(system))
    models, closures = pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
    models.append(closure)
    closures.append(closure.createData())
    data = model.createData()
    pin.initConstraintDynamics(model, data, models, closures)
    proximal = pin.ProximalSettings(1e-15, 1e-12, 100)
    rng = np.random.default_rng(2)
    to_relative = np.array([[1, 0, 0], [-1, 1, 0], [0, 0, 1]])
    for crank in (0.4, 1.0, 2.2, -1.3):
        q, v = dyn.assemble({"theta1": crank}, {"theta1'": rng.uniform(-2, 2)}, fixed="theta1")
        tau = rng.uniform(-5, 5)
        mine = dyn.forward(q, v, [tau])
        theirs = pin.constraintDynamics(
            model, data, to_relative @ q, to_relative @ v, np.array([tau, 0, 0]), models, closures, proximal
        )
        assert np.abs(to_relative @ mine - theirs).max() < 1e-11 * np.abs(theirs).max()


@pytest.mark.slow
def test_a_rolling_disc_moves_as_by_kanes_method() -> None:
    """φ″, θ″, ψ″ of the example against SymPy's `KanesMethod`, with the contact's rates as functions of φ′."""
    psi, theta, phi, u1, u2, u3 = mechanics.dynamicsymbols("psi theta phi u1 u2 u3")
    m, r, I, K, g = sp.symbols("m r I K g")
    N, H, L, D = (mechanics.ReferenceFrame(name) for name in "NHLD")
    H.orient_axis(N, N.z, psi)
    L.orient_axis(H, H.x, theta)
    D.orient_axis(L, L.y, phi)
    D.set_ang_vel(N, u3 * N.z + u2 * H.x + u1 * L.y)
    L.set_ang_vel(N, u3 * N.z + u2 * H.x)
    contact, centre = mechanics.Point("contact"), mechanics.Point("centre")
    contact.set_vel(N, 0)  # of the disc's matter there: it does not slip
    centre.set_pos(contact, r * L.z)
    centre.set_vel(N, D.ang_vel_in(N).cross(r * L.z))
    wheel = mechanics.RigidBody("disc", centre, D, m, (mechanics.inertia(L, I, K, I), centre))
    kinematic = [phi.diff() - u1, theta.diff() - u2, psi.diff() - u3]
    kane = mechanics.KanesMethod(N, [phi, theta, psi], [u1, u2, u3], kd_eqs=kinematic)
    active, inertial = kane.kanes_equations([wheel], [(centre, -m * g * N.z)])
    assert active is not None and inertial is not None
    system = built_in.system("rolling-disc")
    dyn, p = system.compile(), values(system)
    generator = np.random.default_rng(11)
    for _ in range(3):
        place, rate = generator.uniform(-0.8, 0.8, 5), generator.uniform(-3, 3, 3)
        still = dict(zip((u1, u2, u3), rate, strict=True))
        known = {psi: place[2], theta: place[3], phi: place[4]} | {s: p[s.name] for s in (m, r, I, K, g)}
        changes = [u.diff() for u in (u1, u2, u3)]
        equations = active + inertial
        matrix = equations.jacobian(changes).subs(still).subs(known)
        rest = equations.subs(dict.fromkeys(changes, 0)).subs(still).subs(known)
        expected = np.linalg.solve(np.array(matrix, float), -np.array(rest, float).ravel())
        roll = [p["r"] * rate[0] * np.cos(place[2]), p["r"] * rate[0] * np.sin(place[2])]
        found = dyn.forward(place, [*roll, rate[2], rate[1], rate[0]])
        assert found[[4, 3, 2]] == pytest.approx(expected, rel=1e-11, abs=1e-11)
