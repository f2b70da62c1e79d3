"""Parts of T* and V that are listed under names of their own and never added up: each is judged, and L is their T − V.

Oracle: a block on a slope, with a roller behind it on a spring, by hand.
"""

from __future__ import annotations

import pytest
import sympy as sp

import lagrangian as lg


@pytest.fixture(scope="module")
def pulled() -> lg.Derivation:
    """A block that is pulled down a slope, and a roller that it pulls by a spring."""
    system = lg.System("block and roller")
    x, s = system.coordinates("x s")
    m, M, J, r, k, b = system.parameters("m M J r k b")
    F = system.inputs("F")
    system.particle(m, at=system.point("B", (x * sp.cos(b), -x * sp.sin(b))), name="block")
    centre = system.point("R", (s * sp.cos(b), -s * sp.sin(b)))
    system.rigid_body(M, J, at=centre, frame=system.frame(-s / r, name="turned"), name="roller")
    system.gravity()
    system.spring(k, deflection=x - s, name="spring")
    system.force(F, deflection=x, name="pull")
    return system.derive()


ROWS = """
m x'' + k (x - s) = F + m g sin(b)
(M + J/r^2) s'' - k (x - s) = M g sin(b)
"""
RIGHT = """
T_block = 1/2 m x'^2
T_roller = 1/2 M s'^2 + 1/2 J (s'/r)^2
V_s = 1/2 k (x - s)^2
V_g = -(m x + M s) g sin(b)
L = T - V
"""


def wrong(found: lg.CheckedAnswer) -> list[int]:
    """The lines that are wrong of their own."""
    return [f.line.number for f in found.findings if not f.status.right and not f.follows]


def test_parts_that_are_right_are_added_up(pulled: lg.Derivation) -> None:
    found = pulled.check(RIGHT + ROWS)
    assert found.right, found.to_text()
    assert [f.line.number for f in found.findings] == [2, 3, 4, 5, 6, 8, 9], found.to_text()
    assert "was not judged" not in found.to_text()


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("right", "slip", "line"),
    [
        ("1/2 m x'^2", "m x'^2", 2),
        (" + 1/2 J (s'/r)^2", "", 3),
        ("(s'/r)^2", "s'^2", 3),
        ("(x - s)^2", "(x + s)^2", 4),
        ("-(m x + M s) g", "(m x + M s) g", 5),
    ],
)
def test_the_part_that_is_wrong_is_told_and_what_follows_follows(
    pulled: lg.Derivation, right: str, slip: str, line: int
) -> None:
    answer = RIGHT.replace(right, slip)
    found = pulled.check(answer)
    assert not found.right and wrong(found) == [line], found.to_text()
    assert next(f for f in found.findings if f.line.kind == "L").follows
    assert all(f.line.text in answer for f in found.findings), "only what was written is judged"
    assert all(f.status.right for f in found.findings if f.line.number not in (line, 6)), found.to_text()


def test_a_list_that_lacks_a_body_is_no_whole(pulled: lg.Derivation) -> None:
    """It may be what the answer says of this body alone; what it says of L needs the other."""
    answer = RIGHT.replace("T_block = 1/2 m x'^2\n", "T_1 = 1/2 M s'^2\n").replace("T_roller =", "T_2 =")
    found = pulled.check(answer.replace("1/2 M s'^2 + 1/2 J", "1/2 J") + ROWS)
    assert found.right, found.to_text()


def test_energies_of_rotations_alone_are_no_whole(pulled: lg.Derivation) -> None:
    more = "T_rot1 = 0\nT_rot2 = 1/2 J (s'/r)^2\nL = 1/2 m x'^2 + 1/2 M s'^2 + 1/2 J (s'/r)^2 - V"
    assert pulled.check("V = 1/2 k (x - s)^2 - (m x + M s) g sin(b)\n" + more + ROWS).right


def test_another_name_of_the_lagrangian_is_read(pulled: lg.Derivation) -> None:
    found = pulled.check(RIGHT.replace("L = T", "L_g = T") + "dL_g/dx' = m x'\ndL_g/ds' = M s'\n")
    assert not found.right and wrong(found) == [8], found.to_text()


def test_derivatives_of_a_wrong_energy_follow_from_it(pulled: lg.Derivation) -> None:
    energies = "T = 1/2 m x'^2 + 1/2 M s'^2 + 1/2 J s'^2/r^2\nV = 1/2 k (x + s)^2 - (m x + M s) g sin(b)\n"
    slopes = "∂V/∂x = k (x + s) - m g sin(b)\n∂T/∂s' = M s' + J s'/r^2\n∂V/∂s = k (x + s) - M g sin(b)\n"
    found = pulled.check(energies + slopes)
    assert wrong(found) == [2], found.to_text()
    assert [f.status.right for f in found.findings] == [True, False, False, True, False], found.to_text()
    constant = energies.replace("(x + s)^2", "(x - s)^2 + m g r") + slopes.replace("(x + s) - m", "(x - s) - m")
    found = pulled.check(constant.replace("k (x + s) - M", "-k (x - s) - M"))
    assert all(f.status.right for f in found.findings), found.to_text()


@pytest.fixture(scope="module")
def pendulum() -> lg.Derivation:
    """A bob on a rod on a cart."""
    system = lg.System("cart and bob")
    x, phi = system.coordinates("x phi")
    M, m, l = system.parameters("M m l")
    system.particle(M, at=system.point("A", (x, 0)), name="cart")
    system.particle(m, at=system.point("B", (x + l * sp.sin(phi), -l * sp.cos(phi))), name="bob")
    system.gravity()
    return system.derive()


def test_rates_of_a_wrong_place_follow_from_it(pendulum: lg.Derivation) -> None:
    places = "x_B = x - l sin(phi)\ny_B = -l cos(phi)\nx_B' = x' - l cos(phi) phi'\ny_B' = l sin(phi) phi'\n"
    speed = "v^2 = x'^2 + l^2 phi'^2 - 2 l x' phi' cos(phi)\n"
    found = pendulum.check(f"{places}{speed}T = 1/2 M x'^2 + 1/2 m v^2\nV = -m g l cos(phi)\n")
    told = {f.line.number: (f.status.right, f.follows) for f in found.findings}
    assert told[1] == (False, False) and told[6] == (False, True), found.to_text()
    assert told[3] == (False, True) and told[2][0] and told[4][0], found.to_text()


@pytest.fixture(scope="module")
def discs() -> lg.Derivation:
    """Two discs on a shaft with a coupling that damps."""
    system = lg.System("discs")
    theta, phi = system.coordinates("theta phi")
    J, I, c, k = system.parameters("J I c k")
    tau = system.inputs("tau")
    system.rigid_body(0, J, at=system.origin, frame=system.frame(theta, name="left"), name="first")
    system.rigid_body(0, I, at=system.origin, frame=system.frame(phi, name="right"), name="second")
    system.spring(k, deflection=theta - phi, name="shaft")
    system.damper(c, deflection=theta - phi, name="coupling")
    system.torque(tau, on=theta, name="motor")
    return system.derive()


ENERGY = "L = 1/2 J th'^2 + 1/2 I ph'^2 - 1/2 k (th - ph)^2\n"
FORCES = "Q_th = tau - c (th' - ph')\nQ_ph = c (th' - ph')\n"
TURNING = "J th'' + k (th - ph) = tau - c (th' - ph')\nI ph'' + k (ph - th) = c (th' - ph')\n"


def test_forces_of_shortened_coordinates_are_judged(discs: lg.Derivation) -> None:
    found = discs.check(ENERGY + FORCES + TURNING)
    assert found.right and [f.line.kind for f in found.findings[1:3]] == ["Xi", "Xi"], found.to_text()
    found = discs.check(ENERGY + FORCES.replace("Q_ph = c", "Q_ph = -c") + TURNING)
    assert not found.right and wrong(found) == [3], found.to_text()


@pytest.mark.parametrize("letter", ["Q", "Xi"])
def test_a_shortened_force_lacks_its_dampers_only_where_they_stand_elsewhere(discs: lg.Derivation, letter: str) -> None:
    forces = FORCES.replace(" - c (th' - ph')", "").replace("Q_", f"{letter}_")
    found = discs.check(ENERGY + forces + TURNING.replace(" = tau - c (th' - ph')", " + c (th' - ph') = tau"))
    assert found.right, found.to_text()
    found = discs.check(ENERGY + forces + TURNING.replace(" = tau - c (th' - ph')", " = tau"))
    assert not found.right and wrong(found) == [2], found.to_text()


def test_one_shortened_force_may_be_that_of_one_element(discs: lg.Derivation) -> None:
    assert discs.check(f"{ENERGY}Q_th = -c (th' - ph')\n{TURNING}").right


PROGRAM = """from sympy import *
t = symbols('t')
M, m, l, g = symbols('M m l g')
x = Function('x')(t)
phi = Function('phi')(t)
xB = x + l*sin(phi)
yB = -l*cos(phi)
T = M/2*x.diff(t)**2
T += m/2*(xB.diff(t)**2 + yB.diff(t)**2)
V = m*g*yB
L = T - V
for q in (x, phi):
    print(L.diff(q.diff(t)).diff(t) - L.diff(q))
"""


@pytest.mark.parametrize(("right", "slip", "line"), [(" + yB.diff(t)**2", "", 9), ("T = M/2*", "T = M*", 8)])
def test_a_sum_of_a_program_is_wrong_where_the_wrong_piece_is_added(
    pendulum: lg.Derivation, right: str, slip: str, line: int
) -> None:
    assert pendulum.check(PROGRAM).right
    found = pendulum.check(PROGRAM.replace(right, slip))
    assert not found.right and wrong(found) == [line], found.to_text()
    assert "added8" not in found.to_text() and "added9" not in found.to_text()


def test_a_program_that_adds_to_what_is_there_otherwise_is_judged_as_a_whole(pendulum: lg.Derivation) -> None:
    program = PROGRAM.replace("T = M/2", "T = 5*M/2").replace("T += m/2*", "T += -2*M*x.diff(t)**2 + m/2*")
    assert pendulum.check(program).right


def test_a_line_that_is_not_judged_is_quoted_as_it_was_typed(discs: lg.Derivation) -> None:
    answer = f"{ENERGY}A = (J th, I ph)\n{TURNING}"
    assert "'A = (J th, I ph)' was not judged" in " ".join(discs.check(answer).to_text().split())
    own = "Let A(th) = J + I cos(th),  A' = dA/dth = I sin(th)\n"
    told = " ".join(discs.check(own + ENERGY + TURNING).to_text().split())
    assert "slope" not in told and "∂A" not in told, told
