"""Derivatives and generalized forces in coordinates of an answer's own, and with constraints put in.

Oracle: the equations of a slider in a turning table and of a Scotch yoke, by hand. Every form has a wrong twin.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp
from small_systems import pendulum

import lagrangian as lg
from built_in import derivation


@cache
def table() -> lg.Derivation:
    """A slider at the place s of a slot, at the distance h from the axle of a table that a motor turns."""
    s = lg.System("slider in a turntable")
    phi, u = s.coordinates("phi s")
    J, m, h, k, b, d = s.parameters("J m h k b d")
    tau = s.inputs("tau")
    frame = s.frame(phi, name="table")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=frame, name="table")
    s.particle(m, at=frame.point(u, h), name="slider")
    s.spring(k, deflection=u)
    s.damper(b, deflection=u)
    s.damper(d, deflection=phi)
    s.torque(tau, on=frame)
    return s.derive()


@cache
def yoke() -> lg.Derivation:
    """A crank's pin in the slot of a yoke that pushes against a force P."""
    s = lg.System("Scotch yoke")
    theta, x = s.coordinates("theta x")
    J, M, r, d = s.parameters("J M r d")
    P, tau = s.inputs("P tau")
    crank = s.frame(theta, name="crank")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=crank, name="crank")
    at = s.point("yoke", (x, 0))
    s.particle(M, at=at, name="yoke")
    s.damper(d, deflection=theta)
    s.torque(tau, on=crank)
    s.force((-P, 0), at=at)
    s.constraint(x - r * sp.cos(theta), name="pin")
    return s.derive()


TURNED = """\
u = -s
T = 1/2*J*phi'^2 + 1/2*m*(u' + h*phi')^2 + 1/2*m*u^2*phi'^2
dT/du' = m*(u' + h*phi')
d/dt(dT/du') = m*u'' + m*h*phi''
dT/du = m*u*phi'^2
(J + m*h^2 + m*u^2)*phi'' + m*h*u'' + 2*m*u*u'*phi' + d*phi' = tau
m*u'' + m*h*phi'' - m*u*phi'^2 + b*u' + k*u = 0
"""


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("now", "wrong"),
    [
        ("dT/du' = m*(u' + h*phi')", "dT/du' = m*(u' - h*phi')"),
        ("= m*u'' + m*h*phi''\n", "= m*u'' - m*h*phi''\n"),
        ("dT/du = m*u*phi'^2", "dT/du = -m*u*phi'^2"),
    ],
)
def test_an_energy_is_differentiated_by_a_coordinate_of_the_answers_own(now: str, wrong: str) -> None:
    assert table().check(TURNED, hint=0).right
    assert now in TURNED and not table().check(TURNED.replace(now, wrong), hint=0).right


@pytest.mark.slow
def test_a_coordinate_that_is_no_sum_of_others_changes_its_rate() -> None:
    """With s = u²: ∂T/∂u and d/dt ∂T/∂u' hold the squares of rates that the chain rule gives."""
    text = """\
s = u^2
T = 1/2*J*phi'^2 + 1/2*m*(2*u*u' - h*phi')^2 + 1/2*m*u^4*phi'^2
d/dt dT/du' = 4*m*u^2*u'' + 8*m*u*u'^2 - 2*m*h*u*phi'' - 2*m*h*u'*phi'
dT/du = 4*m*u*u'^2 - 2*m*h*u'*phi' + 2*m*u^3*phi'^2
4*m*u^2*u'' + 4*m*u*u'^2 - 2*m*h*u*phi'' - 2*m*u^3*phi'^2 + 4*b*u^2*u' + 2*k*u^3 = 0
(J + m*h^2 + m*u^4)*phi'' - m*h*(2*u*u'' + 2*u'^2) + 4*m*u^3*u'*phi' + d*phi' = tau
"""
    assert table().check(text, hint=0).right
    assert not table().check(text.replace("8*m*u*u'^2", "4*m*u*u'^2"), hint=0).right


def test_a_derivative_by_a_coordinate_of_which_nothing_says_what_it_replaces_is_not_judged_and_told() -> None:
    rows = """(J + m*h^2 + m*s^2)*phi'' - m*h*s'' + 2*m*s*s'*phi' + d*phi' = tau
m*s'' - m*h*phi'' - m*s*phi'^2 + b*s' + k*s = 0"""
    found = table().check(f"w = s + 2*h\nd/dt(dL/dw') = m*w'' - m*h*phi''\n{rows}")
    assert found.right and any("nothing says which coordinate w replaces" in str(note) for note in found.notes)


PUT_IN = """\
x = r cos(theta)
T = J theta'^2/2 + M r^2 theta'^2 sin(theta)^2/2
∂T/∂theta' = (J + M r^2 sin(theta)^2) theta'
Q_theta = tau - d theta' + P r sin(theta)
(J + M r^2 sin(theta)^2) theta'' + M r^2 theta'^2 sin(theta) cos(theta) = tau - d theta' + P r sin(theta)
"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("now", "wrong"),
    [
        ("theta' + P r sin(theta)\n(J", "theta' - P r sin(theta)\n(J"),
        ("∂T/∂theta' = (J + M", "∂T/∂theta' = (J - M"),
    ],
)
def test_forces_and_derivatives_with_the_constraint_put_in(now: str, wrong: str) -> None:
    assert yoke().check(PUT_IN, hint=0).right
    assert now in PUT_IN and not yoke().check(PUT_IN.replace(now, wrong), hint=0).right


def test_a_force_with_the_constraint_put_in_is_not_that_beside_another_coordinates() -> None:
    """Where Ξ_x is stated, x is a coordinate, and P belongs to its equation alone."""
    rows = "J theta'' = tau - d theta' - lambda r sin(theta)\nM x'' = -P - lambda\nx = r cos(theta)"
    assert yoke().check(f"Q_theta = tau - d theta'\nQ_x = -P\n{rows}", hint=0).right
    assert not yoke().check(f"Q_theta = tau - d theta' + P r sin(theta)\nQ_x = -P\n{rows}", hint=0).right


def test_a_force_where_a_coordinate_of_the_answers_own_replaces_another() -> None:
    """A mass on a moving cart, the spring's length w in place of its place z: the damper pulls at w alone."""
    s = lg.System("relative")
    y, z = s.coordinates("y z")
    m, M, k, b = s.parameters("m M k b")
    F = s.inputs("F")
    s.particle(M, at=s.point("cart", (y, 0)), name="cart")
    s.particle(m, at=s.point("seat", (z, 0)), name="seat")
    s.spring(k, deflection=z - y)
    s.damper(b, deflection=z - y)
    s.force(F, deflection=y)
    d = s.derive()
    rows = "(M + m)*y'' + m*w'' = F\nm*(y'' + w'') + b*w' + k*w = 0"
    assert d.check(f"w = z - y\nQ_y = F\n{rows}", hint=0).right
    assert not d.check(f"w = z - y\nQ_y = F - b*w'\n{rows}", hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    ["V = -k*s^2   <- crossed out", "V = k*s^2  (crossed out, the half is missing)", "V = k*s^2  // durchgestrichen"]
    + ["V = k*s^2   ← wrong, see below", "V = k*s^2   (scrap that)", "V = k*s^2  # wrong factor, corrected below"],
)
def test_a_line_that_a_remark_calls_crossed_out_is_not_judged(said: str) -> None:
    rows = """(J + m*h^2 + m*s^2)*phi'' - m*h*s'' + 2*m*s*s'*phi' + d*phi' = tau
m*s'' - m*h*phi'' - m*s*phi'^2 + b*s' + k*s = 0"""
    found = table().check(f"{said}\nV = k*s^2/2\n{rows}")
    assert found.right and any("crossed out" in str(note) for note in found.notes)
    assert not table().check(f"{said}\nV = k*s^2\n{rows}", hint=0).right
    assert not table().check(f"{said.split()[0]} = k*s^2   (the wrong one is below)\n{rows}", hint=0).right


def test_terms_crossed_out_in_a_sum_keep_their_signs() -> None:
    text = r"m \ddot s \cancel{{}- m h} \cancel{{}+ m h} - m h \ddot\varphi - m s \dot\varphi^2 + b \dot s + k s = 0"
    other = r"(J + m h^2 + m s^2) \ddot\varphi - m h \ddot s + 2 m s \dot s \dot\varphi + d \dot\varphi = \tau"
    assert table().check(f"${text}$\n\n${other}$", hint=0).right
    assert not table().check(f"${text.replace('{{}+', '{{}-')}$\n\n${other}$", hint=0).right


@cache
def arms() -> lg.Derivation:
    """Two arms, the second by its angle relative to the first, in a horizontal plane."""
    s = lg.System("arms")
    p, r = s.coordinates("phi psi")
    m, M, a, k, c = s.parameters("m M a k c")
    first = s.frame(p, name="first")
    end = first.point(a, 0)
    s.particle(M, at=end, name="elbow")
    second = s.frame(r, parent=first, origin=end, name="second")
    s.particle(m, at=second.point(a, 0), name="hand")
    s.spring(k, deflection=r)
    s.damper(c, deflection=r)
    return s.derive()


ABSOLUTE = """\
theta = phi + psi
T = M a^2 phi'^2/2 + m a^2 (phi'^2 + theta'^2 + 2 phi' theta' cos(theta - phi))/2
∂T/∂phi' = (M + m) a^2 phi' + m a^2 theta' cos(theta - phi)
∂T/∂theta' = m a^2 theta' + m a^2 phi' cos(theta - phi)
∂T/∂phi = m a^2 phi' theta' sin(theta - phi)
∂T/∂theta = -m a^2 phi' theta' sin(theta - phi)
Q_2 = -c (theta' - phi')
(M + m) a^2 phi'' + m a^2 theta'' cos(theta - phi) - m a^2 theta'^2 sin(theta - phi) - k (theta - phi) = -Q_2
m a^2 theta'' + m a^2 phi'' cos(theta - phi) + m a^2 phi'^2 sin(theta - phi) = -k (theta - phi) - c (theta' - phi')
"""


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("now", "wrong"),
    [
        ("∂T/∂phi' = (M + m) a^2 phi' + m", "∂T/∂phi' = (M + 2 m) a^2 phi' + m"),
        ("∂T/∂phi = m", "∂T/∂phi = -m"),
        ("∂T/∂theta = -m", "∂T/∂theta = m"),
        ("Q_2 = -c", "Q_2 = c"),
    ],
)
def test_derivatives_beside_an_absolute_angle_hold_it(now: str, wrong: str) -> None:
    """With θ held, ∂T/∂φ' is another one than with ψ held: all derivatives of an answer are in its own coordinates."""
    found = arms().check(ABSOLUTE)
    assert found.right and "it follows from the energies above" in found.to_text()
    assert now in ABSOLUTE and not arms().check(ABSOLUTE.replace(now, wrong), hint=0).right


@pytest.mark.slow
def test_a_numbered_force_may_be_that_of_a_coordinate_of_the_answers_own() -> None:
    """Instead of s, u = s/h: the power b s'² is Q_2 u' with Q_2 = −h b s'."""
    rows = """\
u = s/h
Q_1 = tau - d*phi'
Q_2 = -b*h^2*u'
(J + m*h^2 + m*h^2*u^2)*phi'' - m*h^2*u'' + 2*m*h^2*u*u'*phi' + d*phi' = tau
m*h^2*(u'' - phi'' - u*phi'^2) + b*h^2*u' + k*h^2*u = 0
"""
    assert table().check(rows, hint=0).right
    assert not table().check(rows.replace("Q_2 = -b*h^2", "Q_2 = b*h^2"), hint=0).right
    assert not table().check(rows.replace("Q_2 = -b*h^2", "Q_s = -b*h^2"), hint=0).right


@pytest.mark.slow
def test_equations_side_by_side_in_one_row_are_two() -> None:
    rows = r"""\begin{align}
  Q_\varphi &= \tau - d \dot\varphi & Q_s &= -b \dot s
\end{align}
\begin{align}
  (J + m h^2 + m s^2) \ddot\varphi - m h \ddot s + 2 m s \dot s \dot\varphi &= Q_\varphi \\
  m \ddot s - m h \ddot\varphi - m s \dot\varphi^2 + k s &= Q_s
\end{align}"""
    found = table().check(rows)
    assert found.right and [f.line.name for f in found.findings if f.line.kind == "Xi"] == ["phi", "s"]
    wrong = table().check(rows.replace(r"-b \dot s", r"b \dot s"))
    assert next(str(f.status) for f in wrong.findings if f.line.kind == "Xi") == "right" and not wrong.right


@pytest.mark.parametrize("called", ["Lagrangian L = T - V", "5) Lagrangian L = T - V", "Lagrangian: L = T - V"])
def test_an_energy_by_its_name_and_its_letter_is_stated_once(called: str) -> None:
    energies = "T = 1/2*J*phi'^2 + 1/2*m*((s' - h*phi')^2 + s^2*phi'^2)\nV = 1/2*k*s^2"
    kinds = [f.line.kind for f in table().check(f"{energies}\n{called}").findings]
    assert kinds == ["T", "V", "L"]


def test_what_stands_before_a_stated_force_is_no_minus() -> None:
    text = "- Q_phi = tau - d*phi'\n- Q_s = -b*s'\n\nT = 1/2*J*phi'^2 + 1/2*m*((s' - h*phi')^2 + s^2*phi'^2)"
    assert [str(f.status) for f in table().check(text).findings] == ["right"] * 3
    assert [str(f.status) for f in table().check(text.replace("-b*s'", "b*s'")).findings][1] == "wrong"


CARTS = """\
X2 = x1 + x2
T = 1/2*m1*x1'^2 + 1/2*m2*X2'^2
V = 1/2*k*(X2 - x1)^2
∂L/∂x1 = k*(X2 - x1), ∂L/∂X2 = -k*(X2 - x1)
∂L/∂X2' = m2*X2'
Q_x1 = -F, Q_X2 = F
m1*x1'' - k*(X2 - x1) = -F
m2*X2'' + k*(X2 - x1) = F
"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize("without", ["X2 = x1 + x2\n", "T = 1/2*m1*x1'^2 + 1/2*m2*X2'^2\nV = 1/2*k*(X2 - x1)^2\n", ""])
def test_a_definition_of_the_system_takes_the_place_of_a_coordinate(without: str) -> None:
    """Ξ_x1 is 0 with the relative x2, and −F with the absolute X2."""
    text, judge = CARTS.replace(without, ""), derivation("two-carts")
    assert judge.check(text, hint=0).right
    for now, wrong in (("Q_x1 = -F", "Q_x1 = F"), ("Q_X2 = F", "Q_X2 = -F"), ("∂L/∂X2 = -k", "∂L/∂X2 = k")):
        assert now in text and not judge.check(text.replace(now, wrong), hint=0).right


GAMMA = "m l^2 gamma'' + b gamma' - m g l cos gamma = -M"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "phi = 90° - gamma, so sin phi = cos gamma, cos phi = sin gamma, phi' = -gamma'.",
        "phi = pi/2 - gamma, so that cos phi = sin gamma.",
        "gamma = angle below the horizontal, phi = 90° - gamma, cos(phi) = sin(gamma), sin(phi) = cos(gamma)",
        "phi + gamma = 90°, thus cos phi = sin gamma",
    ],
)
def test_functions_of_an_own_angle_beside_how_it_is_counted(said: str) -> None:
    assert pendulum().check(f"{said}\n\n{GAMMA}").right
    for was, now in (
        ("cos phi = sin", "cos phi = -sin"),
        ("cos phi = sin", "cos phi = cos"),
        ("= -gamma'", "= gamma'"),
    ):
        assert was not in said or not pendulum().check(f"{said.replace(was, now)}\n\n{GAMMA}").right
    assert not pendulum().check(f"{said}\n\n{GAMMA.replace('- m g l cos', '- m g l sin')}").right
    assert not pendulum().check(f"{said}\n\n{GAMMA.replace('= -M', '= M')}").right
