"""Constraints in derivations: multipliers, their sign and meaning, and the equations without them."""

import json
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

import numpy as np
import pytest
import sympy as sp
from sympy.physics.mechanics import KanesMethod, LagrangesMethod, Particle, Point, ReferenceFrame, dynamicsymbols

import constrained_systems
import lagrangian as lg
from lagrangian.derivation import Derivation

t = dynamicsymbols._t


@cache
def sleigh() -> lg.System:
    """Chaplygin's sleigh: a knife edge at (x, y), the centre of mass at a distance a from it."""
    s = lg.System("Chaplygin sleigh")
    x, y, theta = s.coordinates("x y theta")
    m, J, a = s.parameters("m J a", m=1.0, J=0.5, a=0.3)
    body = s.frame(theta, origin=s.point("P", (x, y)), name="B")
    s.rigid_body(m, J, at=body.point(a, 0), frame=body, name="sleigh")
    s.velocity_constraint(y.diff(t) * sp.cos(theta) - x.diff(t) * sp.sin(theta), name="knife edge")
    return s


@cache
def disc() -> lg.System:
    """A disc that rolls on a plane: contact at (x, y), heading psi, lean theta, spin phi."""
    s = lg.System("rolling disc")
    x, y, phi, theta, psi = s.coordinates("x y phi theta psi")
    m, r, I, K = s.parameters("m r I K", m=1.0, r=0.5, I=0.2, K=0.3)
    heading = s.frame(psi, axis=(0, 0, 1), origin=s.point("C", (x, y, 0)), name="A")
    lean = s.frame(theta, axis=(1, 0, 0), parent=heading, origin=heading.origin, name="B")
    spin = s.frame(phi, axis=(0, 1, 0), parent=lean, origin=lean.point(0, 0, r), name="D")
    s.rigid_body(m, (I, K, I), at=spin.origin, frame=spin, name="disc")
    s.gravity((0, 0, -1))
    s.velocity_constraint(x.diff(t) - r * sp.cos(psi) * phi.diff(t), name="along x")
    s.velocity_constraint(y.diff(t) - r * sp.sin(psi) * phi.diff(t), name="along y")
    return s


@cache
def pendulum() -> lg.System:
    return constrained_systems.pendulum_in_plane(weight=True)


@cache
def four_bar() -> lg.System:
    return constrained_systems.four_bar(weight=True)


@cache
def axle() -> lg.System:
    """Two wheels on one axle, with a motor and a damper: forces along the speeds too."""
    s = lg.System("two wheels on one axle")
    x, y, theta, left, right = s.coordinates("x y theta phi_l phi_r")
    m, J, w, r, wheel, b = s.parameters("m J w r I_w b", m=3.0, J=0.4, w=0.2, r=0.1, I_w=0.01, b=0.3)
    torque = s.input("tau")
    body = s.frame(theta, origin=s.point("P", (x, y)), name="B")
    s.rigid_body(m, J, at=body.origin, frame=body, name="cart")
    s.kinetic(wheel * (left.diff(t) ** 2 + right.diff(t) ** 2) / 2, name="wheels")
    s.generalized_force(left, torque - b * left.diff(t), name="motor")
    ahead = x.diff(t) * sp.cos(theta) + y.diff(t) * sp.sin(theta)
    s.velocity_constraint(ahead - w * theta.diff(t) - r * left.diff(t), name="left")
    s.velocity_constraint(ahead + w * theta.diff(t) - r * right.diff(t), name="right")
    s.velocity_constraint(y.diff(t) * sp.cos(theta) - x.diff(t) * sp.sin(theta), name="no sideways slip")
    return s


SYSTEMS: list[Callable[[], lg.System]] = [sleigh, disc, pendulum, four_bar, axle]


@cache
def derived(make: Callable[[], lg.System]) -> Derivation:
    return make().derive()


def residuals(d: Derivation) -> list[sp.Expr]:
    assert d.minimal is not None
    return [sp.expand(e.lhs - e.rhs) for e in d.minimal.equations]


def same(found: sp.Expr, expected: sp.Expr) -> bool:
    return sp.simplify(sp.expand(found - expected)) == 0


def test_the_sleigh_without_multipliers() -> None:
    """(J + a² m) θ̈ + a m v θ̇ = 0 and m v̇ − a m θ̇² = 0, with v = ẋ cos θ + ẏ sin θ. Source: Chaplygin, 1911."""
    s = sleigh()
    x, y, theta = s["x"], s["y"], s["theta"]
    m, J, a = (s[k] for k in ("m", "J", "a"))
    d = derived(sleigh)
    assert d.minimal is not None
    v = dynamicsymbols("v")
    assert d.minimal.speeds == (theta.diff(t), v)
    assert same(d.minimal.meanings[v], x.diff(t) * sp.cos(theta) + y.diff(t) * sp.sin(theta))
    assert d.minimal.rates[x.diff(t)] == v * sp.cos(theta)
    assert d.minimal.rates[y.diff(t)] == v * sp.sin(theta)
    first, second = residuals(d)
    assert same(first, (J + a**2 * m) * theta.diff(t, 2) + a * m * v * theta.diff(t))
    assert same(second, m * v.diff(t) - a * m * theta.diff(t) ** 2)


def test_the_force_on_the_knife_edge() -> None:
    """λ = m (v θ̇ + a θ̈) is the force on the body along the normal of the edge, by a free body."""
    s = sleigh()
    d = derived(sleigh)
    theta, v = s["theta"], dynamicsymbols("v")
    m, a = s["m"], s["a"]
    (known,) = d.multipliers.values()
    assert d.minimal is not None
    on_rows = {x.diff(t): d.minimal.rates[x.diff(t)] for x in d.coordinates}
    on_rows |= {x.diff(t, 2): sp.diff(d.minimal.rates[x.diff(t)], t) for x in d.coordinates}
    across = [-sp.sin(theta), sp.cos(theta)]
    push = sum(e * (eq.lhs.xreplace(on_rows) - eq.rhs) for e, eq in zip(across, d.equations, strict=False))
    assert same(push, m * (v * theta.diff(t) + a * theta.diff(t, 2)) - known.symbol)


def test_the_rolling_disc_without_multipliers() -> None:
    """The three equations of a disc on a plane, K about its axis and I about a diameter."""
    s = disc()
    m, r, I, K, g = (s[k] for k in ("m", "r", "I", "K", "g"))
    phi, theta, psi = (s[k] for k in ("phi", "theta", "psi"))
    d = derived(disc)
    sin, cos = sp.sin(theta), sp.cos(theta)
    spin, lean, turn = phi.diff(t), theta.diff(t), psi.diff(t)
    assert d.minimal is not None
    assert d.minimal.speeds == (spin, lean, turn)
    assert not d.minimal.meanings
    expected = (
        (K + m * r**2) * (spin.diff(t) + sin * turn.diff(t)) + (K + 2 * m * r**2) * cos * turn * lean,
        (I + m * r**2) * lean.diff(t)
        + (I - K - m * r**2) * sin * cos * turn**2
        - (K + m * r**2) * cos * spin * turn
        - m * g * r * sin,
        (I * cos**2 + (K + m * r**2) * sin**2) * turn.diff(t)
        + (K + m * r**2) * sin * spin.diff(t)
        + (2 * (K - I + m * r**2) * sin * turn + K * spin) * cos * lean,
    )
    assert all(same(a, b) for a, b in zip(residuals(d), expected, strict=True))


@pytest.mark.slow
def test_the_disc_solved_for_its_accelerations() -> None:
    """Cramer's rule on request: the solution satisfies the equations, at a random state."""
    d = derived(disc)
    assert d.minimal is not None
    solved = d.minimal.accelerations()
    assert list(solved) == [u.diff(t) for u in d.minimal.speeds]
    atoms = set().union(*(e.atoms(sp.Symbol, sp.core.function.AppliedUndef) for e in d.minimal.equations)) - {t}
    draw = np.random.default_rng(3)
    values = {u: sp.Float(draw.uniform(0.3, 1.2)) for u in d.minimal.speeds}
    values |= {x: sp.Float(draw.uniform(0.3, 1.2)) for x in sorted(atoms, key=str)}
    at = {u: float(x.subs(values)) for u, x in solved.items()}
    for equation in residuals(d):
        assert abs(equation.subs(at).subs(values)) < 1e-12


def test_the_tension_of_the_pendulum() -> None:
    """λ = −(m g cos θ + m l θ̇²): the rod pulls, so λ, which pushes the ends apart, is negative."""
    s = pendulum()
    d = derived(pendulum)
    known = d.multipliers["rod"]
    assert known.unit == "N"
    assert "tension" in str(known.words)
    m, g, length = (s[k] for k in ("m", "g", "l"))
    x, y = d.coordinates
    angle = dynamicsymbols("theta")
    moved = {x: length * sp.sin(angle), y: -length * sp.cos(angle)}
    equations = [*d.equations, *d.constraint_equations]
    unknown = [x.diff(t, 2), y.diff(t, 2), known.symbol]
    solved = sp.solve([e.lhs - e.rhs for e in equations], unknown, dict=True)[0]
    tension = solved[known.symbol].subs({q.diff(t): value.diff(t) for q, value in moved.items()}).subs(moved)
    values = {m: 1.3, g: 9.7, length: 0.8, angle.diff(t): 1.7, angle: 0.4}
    expected = -(1.3 * 9.7 * np.cos(0.4) + 1.3 * 0.8 * 1.7**2)
    assert float(tension.subs(values)) == pytest.approx(expected, rel=1e-12)


def test_no_fewer_speeds_for_the_pendulum() -> None:
    """Only x or y could be divided by, and both vanish somewhere: said, with the place where it fails."""
    d = derived(pendulum)
    assert d.minimal is None
    assert d.no_minimal is not None
    assert "x = 0" in str(d.no_minimal)
    assert "divided by x, which can vanish" in d.to_text(width=120)


@pytest.mark.slow
def test_multipliers_are_those_of_lagranges_method() -> None:
    """The four-bar against SymPy's `LagrangesMethod`: the same equations, its λ being ours with the other sign."""
    d = derived(four_bar)
    rows = sp.Matrix([x.rate for x in d.multipliers.values()])
    ours = list(d.multipliers.values())
    method = LagrangesMethod(d.L, list(d.coordinates), nonhol_coneqs=list(rows))
    equations = method.form_lagranges_equations()
    names = {theirs: -x.symbol for theirs, x in zip(method.lam_vec, ours, strict=True)}
    draw = np.random.default_rng(5)
    atoms = sorted({*equations.free_symbols, *d.coordinates, *(x.symbol for x in ours)} - {t}, key=str)
    values = {q.diff(t, k): draw.uniform(-1, 1) for q in d.coordinates for k in (2, 1)}
    values |= {x: draw.uniform(0.4, 1.6) for x in atoms}
    for mine, theirs in zip(d.equations, equations, strict=True):
        expected = float(theirs.xreplace(names).xreplace(values))
        assert float((mine.lhs - mine.rhs).xreplace(values)) == pytest.approx(expected, abs=1e-12)


@pytest.mark.slow
def test_a_skate_with_a_rider_by_kanes_method() -> None:
    """A knife edge with a swinging mass and a force: u̇ of the minimal equations against SymPy's `KanesMethod`."""
    s = lg.System("skate with a pendulum")
    x, y, theta, q = s.coordinates("x y theta q")
    m, J, M, length = s.parameters("m J M l", m=1.2, J=0.5, M=0.7, l=0.6)
    F = s.input("F")
    body = s.frame(theta, origin=s.point("P", (x, y)), name="B")
    s.rigid_body(m, J, at=body.origin, frame=body, name="skate")
    arm = s.frame(q, parent=body, origin=body.origin, name="arm")
    s.particle(M, at=arm.point(length, 0), name="rider")
    s.force(F * sp.Matrix([sp.cos(theta), sp.sin(theta)]), at=body.origin, name="push")
    s.velocity_constraint(x.diff(t) * sp.sin(theta) - y.diff(t) * sp.cos(theta), name="edge")
    d = s.derive()
    assert d.minimal is not None

    N = ReferenceFrame("N")
    B, A = ReferenceFrame("B"), ReferenceFrame("A")
    u1, u2, v = dynamicsymbols("u1 u2 v")
    B.orient_axis(N, N.z, theta)
    A.orient_axis(N, N.z, theta + q)
    B.set_ang_vel(N, u1 * N.z)
    A.set_ang_vel(N, (u1 + u2) * N.z)
    O, P = Point("O"), Point("P")
    O.set_vel(N, v * B.x)
    P.set_pos(O, length * A.x)
    P.v2pt_theory(O, N, A)
    skate = sp.physics.mechanics.RigidBody("skate", O, B, m, (J * sp.physics.mechanics.outer(B.z, B.z), O))
    rider = Particle("rider", P, M)
    kinematic = [theta.diff(t) - u1, q.diff(t) - u2, x.diff(t) - v * sp.cos(theta)]
    kane = KanesMethod(N, [theta, q, x], [u1, u2, v], kd_eqs=kinematic)
    fr, frstar = kane.kanes_equations([skate, rider], [(O, F * B.x)])
    values = {theta: 0.7, q: -0.4, F: 0.9, m: 1.2, J: 0.5, M: 0.7, length: 0.6}
    speeds = (0.8, -1.1, 0.6)
    expected = accelerations(fr + frstar, (u1, u2, v), speeds, values)
    found = accelerations(sp.Matrix(residuals(d)), d.minimal.speeds, speeds, values)
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-14)


def accelerations(equations: sp.Matrix, u: Sequence[sp.Expr], speeds: Sequence[float], values: Any) -> np.ndarray:
    """The rates of the speeds u that make the equations zero, at a state."""
    changes = [sp.Derivative(x, t).doit() for x in u]
    still = dict(zip(u, speeds, strict=True))
    matrix = equations.jacobian(changes).subs(still).subs(values)
    rest = equations.subs(dict.fromkeys(changes, 0)).subs(still).subs(values)
    return np.linalg.solve(np.array(matrix, float), -np.array(rest, float).ravel())


def test_two_wheels_on_one_axle() -> None:
    """Turns and numbers first: only parameters are divided by, and the force on the left wheel's spin is shared."""
    s = axle()
    d = derived(axle)
    assert d.minimal is not None
    theta, left, right = (s[k] for k in ("theta", "phi_l", "phi_r"))
    w, r, m, wheel, b = (s[k] for k in ("w", "r", "m", "I_w", "b"))
    assert d.minimal.speeds == (theta.diff(t), left.diff(t))
    assert same(d.minimal.rates[right.diff(t)], left.diff(t) + 2 * w * theta.diff(t) / r)
    forward = w * theta.diff(t, 2) + r * left.diff(t, 2)
    spins = wheel * (left.diff(t, 2) + right.diff(t, 2)).subs(
        right.diff(t, 2), left.diff(t, 2) + 2 * w * theta.diff(t, 2) / r
    )
    assert same(residuals(d)[1], m * r * forward + spins + b * left.diff(t) - s["tau"])


def test_every_term_is_known_by_its_constraint() -> None:
    """Terms with a multiplier have their kind and element, and `where` finds them."""
    d = derived(four_bar)
    terms = [x for row in d.terms for x in row if x.kind == "constraint"]
    assert len(terms) == 6
    assert {x.elements for x in terms} == {("pin 'loop'",)}
    (origin,) = d.where(terms[0].expr)
    assert (origin.element.name, origin.coordinate) == ("loop", "a")
    assert [row.column for row in d.ledger if row.element == "pin 'loop'"] == ["λ"]


@pytest.mark.sampled(5)
@pytest.mark.parametrize("make", SYSTEMS)
def test_everything_is_verified(make: Callable[[], lg.System]) -> None:
    """The equations, the rows, the multipliers and the equations without them, against what is compiled."""
    d = derived(make)
    found = d.verify(states=4)
    assert all(x.holds is not False for x in found), [x for x in found if x.holds is False]
    words = [str(x.what) for x in found]
    assert any("solve the equations and the rows together" in w for w in words)
    assert any("keep the rows" in w for w in words)
    assert (d.minimal is None) == (not any("without multipliers" in w for w in words))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("notation", ["lecture", "physics", "robotics"])
def test_every_format_shows_it(notation: Any) -> None:
    """The rows, the multiplier's meaning and the equations without it, in all formats and notations."""
    d = derived(sleigh)
    for page in (d.to_text(notation=notation), d.to_markdown(notation=notation), d.to_html(notation=notation)):
        assert "knife edge" in page
        assert "Equations without multipliers" in page
    assert r"\lambda" in d.to_latex(notation=notation)
    data = json.loads(json.dumps(d.to_dict(notation=notation)))
    (row,) = data["multipliers"]
    assert row["symbol"]["plain"] == "lambda_knife_edge"
    assert row["position"] is None
    assert len(data["minimal"]["equations"]) == 2


def test_a_velocity_constraint_stays_out_of_the_lagrangian() -> None:
    """The derivation says why."""
    page = " ".join(derived(sleigh).to_text().split())
    assert "is never put into" in page
    assert "is never put into" not in " ".join(derived(pendulum).to_text().split())


def test_rows_of_a_file() -> None:
    """Constraints described in a file are derived as those of Python."""
    s = lg.loads(
        """
name = "bead"
[coordinates]
x = {}
y = {}
[parameters]
m = 1.0
c = 2.0
[[particle]]
mass = "m"
at = ["x", "y"]
[[gravity]]
direction = [0, -1]
[[constraint]]
name = "wire"
expression = "y - c*x^2"
"""
    )
    d = s.derive()
    x, y = d.coordinates
    c = s["c"]
    assert d.multipliers["wire"].position == y - c * x**2
    assert d.minimal is not None
    assert d.minimal.speeds == (x.diff(t),)
    assert same(d.minimal.rates[y.diff(t)], 2 * c * x * x.diff(t))


def test_a_coordinate_without_mass_that_a_row_carries() -> None:
    """A wheel's angle without inertia is no mistake where rolling ties it to what moves."""
    s = lg.System("light wheel")
    x, phi = s.coordinates("x phi")
    m, r = s.parameters("m r", m=1.0, r=0.2)
    torque = s.input("tau")
    s.particle(m, at=s.point("P", (x, 0)))
    s.generalized_force(phi, torque)
    s.constraint(x - r * phi, name="rolls")
    d = s.derive()
    assert d.minimal is not None
    (equation,) = residuals(d)
    assert d.minimal.speeds == (phi.diff(t),)
    assert same(equation, m * r**2 * phi.diff(t, 2) - torque)


def test_a_constraint_that_moves_with_time() -> None:
    """A wire that is lifted: ẏ = tan β ẋ + A ω cos ωt, so s₀ is not zero, and the wire does work."""
    s = lg.System("bead on a wire that is lifted")
    x, y = s.coordinates("x y")
    m, beta, A, w = s.parameters("m beta A omega", m=1.0, beta=0.4, A=0.3, omega=2.0)
    g = s.parameter("g", 9.81)
    s.particle(m, at=s.point("P", (x, y)))
    s.gravity(g=g)
    s.constraint(y - sp.tan(beta) * x - A * sp.sin(w * s.t), name="wire")
    d = s.derive()
    assert d.minimal is not None
    assert same(d.minimal.s0[1], A * w * sp.cos(w * t))
    (equation,) = residuals(d)
    lifted = g - A * w**2 * sp.sin(w * t)
    assert same(equation, m * (1 + sp.tan(beta) ** 2) * x.diff(t, 2) + m * sp.tan(beta) * lifted)
    assert all(c.holds for c in d.verified)


def test_a_row_that_is_said_twice_has_one_multiplier() -> None:
    """The row that says nothing new is left out of the equations, and what is left is verified."""
    s = lg.System("twice")
    x, y = s.coordinates("x y")
    m, c = s.parameters("m c", m=1.0, c=0.5)
    s.particle(m, at=s.point("P", (x, y)))
    s.gravity()
    s.constraint(y - c * x, name="one")
    s.constraint(2 * y - 2 * c * x, name="two")
    d = s.derive()
    assert list(d.multipliers) == ["one"]
    assert all(check.holds for check in d.verified)


def test_names_of_new_speeds_and_multipliers_are_free() -> None:
    """A system that has v and lambda_edge gets u1 and lambda_edge_."""
    s = lg.System("sledge")
    x, y, theta = s.coordinates("x y theta")
    v, J, taken = s.parameters("v J lambda_edge", v=1.0, J=0.5, lambda_edge=2.0)
    body = s.frame(theta, origin=s.point("P", (x, y)), name="B")
    s.rigid_body(v * taken, J, at=body.origin, frame=body)
    s.velocity_constraint(x.diff(t) * sp.sin(theta) - y.diff(t) * sp.cos(theta), name="edge")
    d = s.derive()
    assert d.minimal is not None
    assert [str(u) for u in d.minimal.meanings] == ["u1(t)"]
    assert str(d.multipliers["edge"].symbol) == "lambda_edge_(t)"


def test_a_constraint_on_velocities_takes_no_coordinate_away() -> None:
    """It ties rates: a change to fewer coordinates is refused, with the reason."""
    with pytest.raises(lg.ModelError, match=r"ties rates.*every coordinate is still needed"):
        disc().in_coordinates({"x": "r*phi"})


@pytest.mark.parametrize("verb", ["hamiltonian", "routhian"])
def test_energies_alone_do_not_tell_a_constrained_motion(verb: str) -> None:
    """p_x of the sleigh would be kept without the force on its edge."""
    with pytest.raises(lg.ModelError, match="needs independent coordinates"):
        getattr(sleigh(), verb)()


@pytest.mark.slow
def test_a_rope_along_lines_is_an_atwood_machine() -> None:
    """The length of each part is |x|, whose rate has no curvature. T = 2 m₁ m₂ g/(m₁ + m₂), a textbook's."""
    s = lg.System("Atwood's machine with a rope")
    x1, x2 = s.coordinates("x1 x2")
    m1, m2, length = s.parameters("m1 m2 l", m1=3.0, m2=2.0, l=4.0)
    ends = [s.point(name, (k, x)) for k, (name, x) in enumerate((("A", x1), ("B", x2)))]
    for m, end in zip((m1, m2), ends, strict=True):
        s.particle(m, at=end)
    s.gravity()
    s.rope((ends[0], s.point("P", (0, 0)), s.point("Q", (1, 0)), ends[1]), length=length, name="rope")
    d = s.derive()
    assert not d.constraint_equations[0].lhs.has(x1.diff(t) ** 2, x2.diff(t) ** 2)
    assert all(check.holds for check in d.verify(states=20) if check.holds is not None)
    run = s.simulate(0.5, x1=-1.0, x2=-2.0)
    assert np.allclose(run["rope"], -2 * 3 * 2 * 9.81 / 5, rtol=1e-12)
    assert np.allclose(run["x1"], -1.0 - 9.81 / 5 * run.t**2 / 2, rtol=1e-10)


@pytest.mark.slow
def test_a_planetary_gear_has_the_ratios_of_its_wheels() -> None:
    """With the ring at rest the carrier turns by R_s/(2 (R_s + R_p)) of the sun, a planet by −R_s/(2 R_p): Willis."""
    s = lg.System("planetary gear")
    sun, planet, carrier = s.coordinates("sun planet carrier")
    Rs, Rp, Js, Jp, Jc = s.parameters("R_s R_p J_s J_p J_c")
    s.kinetic((Js * sun.diff(t) ** 2 + Jp * planet.diff(t) ** 2 + Jc * carrier.diff(t) ** 2) / 2)
    s.torque(s.input("M"), on=sun)
    s.velocity_constraint(Rs * sun.diff(t) + Rp * planet.diff(t) - (Rs + Rp) * carrier.diff(t), name="sun and planet")
    s.velocity_constraint((Rs + Rp) * carrier.diff(t) + Rp * planet.diff(t), name="planet and ring")
    minimal = s.derive().minimal
    assert minimal is not None
    ratios = zip((planet, carrier), (-Rs / (2 * Rp), Rs / (2 * (Rp + Rs))), strict=True)
    assert all(sp.cancel(minimal.rates[q.diff(t)] / sun.diff(t) - ratio) == 0 for q, ratio in ratios)
    (inertia,) = (sp.factor(sp.diff(e.lhs, sun.diff(t, 2))) for e in minimal.equations)
    assert sp.simplify(inertia - (Js + Jp * (Rs / (2 * Rp)) ** 2 + Jc * (Rs / (2 * (Rp + Rs))) ** 2)) == 0
    assert sp.count_ops(minimal.equations[0].lhs) < 25
