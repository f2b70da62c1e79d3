"""What is advised, and what is offered beside it, fits what is wrong in this answer.

Oracle: equations by hand of a tractor with a trailer, of a hoist with a bell, of a jib with a
counterweight, and of a roller on a belt.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.model import time

TRAIN_T = "T = M/2 (s' + e')^2 + m/2 s'^2"
TRAIN = f"""{TRAIN_T}
V = k e^2/2
Q_s = F
Q_e = F - b e'
(M + m) s'' + M e'' = F
M (s'' + e'') + b e' + k e = F
"""


@cache
def train() -> lg.Derivation:
    """A tractor at s + e pulls a trailer at s by a drawbar that is a spring."""
    s = lg.System("train")
    q, e = s.coordinates("s e")
    M, m, k, b = s.parameters("M m k b")
    tractor = s.point("tractor", (q + e, 0))
    s.particle(M, at=tractor, name="tractor")
    s.particle(m, at=s.point("trailer", (q, 0)), name="trailer")
    s.spring(k, deflection=e, name="drawbar")
    s.damper(b, deflection=e, name="drawbar damper")
    s.force((s.input("F"), 0), at=tractor, name="drive")
    return s.derive()


@cache
def bell() -> lg.Derivation:
    """A drum on a fixed axis lets down a carrier, on which a bell swings."""
    s = lg.System("bell")
    y, theta, phi = s.coordinates("y theta phi")
    m, J, h, k, c, d, g, r = s.parameters("m J h k c d g r")
    s.rigid_body(mass=m, inertia=J, at=s.point("drum", (0, 0)), frame=s.frame(phi, name="drum"), name="drum")
    s.particle(m, at=s.point("bell", (h * sp.sin(theta), -y - h * sp.cos(theta))), name="bell")
    s.gravity((0, -1), g=g)
    s.spring(k, deflection=y - r * phi, name="rope")
    s.damper(c, deflection=y, name="guide")
    s.damper(d, deflection=theta, name="hinge")
    return s.derive()


def words(derivation: lg.Derivation, answer: str) -> str:
    """The whole page on a wrong answer, in one line."""
    verdict = derivation.check(answer)
    assert not verdict.right
    return " ".join(verdict.to_text().split())


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("Q_s = F\nQ_e = F - b e'\n(M + m) s'' + M e'' = F", "Q_s = 0\nQ_e = F - b e'\n(M + m) s'' + M e'' = 0"),
        ("Q_e = F - b e'", "Q_e = -b e'"),
    ],
)
def test_what_is_missing_in_one_equation_need_not_be_counted_once(right: str, wrong: str) -> None:
    assert train().check(TRAIN).right
    said = words(train(), TRAIN.replace(right, wrong))
    assert "Force 'drive' is missing in the equation of" in said
    assert "count each once" not in said and "belongs in the equation of every coordinate that moves" in said
    assert "instead of what it adds there" not in said


def test_what_stands_nowhere_is_counted_once() -> None:
    said = words(train(), TRAIN.replace(" - b e'", "").replace(" + b e'", ""))
    assert "Damper 'drawbar damper' is missing." in said and "count each once" in said


BELL_T = "T = m/2 (y'^2 + h^2 theta'^2 - 2 h y' theta' sin(theta)) + J/2 phi'^2"
BELL = f"""{BELL_T}
V = k/2 (y - r phi)^2 - m g (y + h cos(theta))
Q_y = -c y'
Q_theta = -d theta'
Q_phi = 0
m y'' - m h theta'' sin(theta) - m h theta'^2 cos(theta) + k (y - r phi) - m g = -c y'
m h^2 theta'' - m h y'' sin(theta) + m g h sin(theta) = -d theta'
J phi'' - r k (y - r phi) = 0
"""


@pytest.mark.slow
def test_a_wrong_height_is_not_offered_as_a_wrong_kinetic_energy() -> None:
    assert bell().check(BELL).right
    wrong = BELL.replace("y + h cos(theta)", "y + h sin(theta)").replace("+ m g h sin(theta)", "- m g h cos(theta)")
    said = words(bell(), wrong)
    assert "Sine and cosine are exchanged in the weight" in said and "kinetic energy and the weight" not in said


def test_a_body_at_rest_lends_no_damper_its_velocity() -> None:
    verdict = bell().check(BELL.replace("Q_y = -c y'", "Q_y = 0").replace("m g = -c y'", "m g = 0"))
    assert [m.name for m in verdict.mistakes] == ["element_forgotten"]
    assert not any("whole velocity" in str(m.what) for m in verdict.alternatives)


@cache
def jib() -> lg.Derivation:
    """A trolley at s on a jib that turns, and a counterweight that a rope pulls out by half of that."""
    s = lg.System("jib")
    phi, q = s.coordinates("phi s")
    J, m, n, p, c = s.parameters("J m n p c")
    s.rigid_body(mass=m, inertia=J, at=s.point("axis", (0, 0)), frame=s.frame(phi, name="jib"), name="jib")
    for mass, r, name in ((m, q, "trolley"), (n, p + q / 2, "counterweight")):
        s.particle(mass, at=s.point(name, (r * sp.cos(phi), r * sp.sin(phi))), name=name)
    s.damper(c, deflection=phi, name="bearing")
    s.force(s.input("F"), deflection=q, name="winch")
    return s.derive()


JIB_T = "T = J/2 phi'^2 + m/2 (s'^2 + s^2 phi'^2) + n/2 (s'^2/4 + (p + s/2)^2 phi'^2)\n"
JIB_RATE = "d/dt dT/dphi' = (J + m s^2 + n (p + s/2)^2) phi'' + (2 m s + n (p + s/2)) s' phi'\n"
JIB_SLOPE = "dT/ds = (m s + n/2 (p + s/2)) phi'^2\n"
JIB = """(J + m s^2 + n (p + s/2)^2) phi'' + (2 m s + n (p + s/2)) s' phi' = -c phi'
(m + n/4) s'' - (m s + n/2 (p + s/2)) phi'^2 = F
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong", "said", "advice"),
    [
        ("+ n (p + s/2)) s'", "+ 2 n (p + s/2)) s'", "the factor 2 too much", "p + ½ s has the inner derivative ½"),
        ("n/2 (p + s/2)) phi'^2", "n (p + s/2)) phi'^2", "n (p + ½ s) φ̇²", "p + ½ s has the inner derivative ½"),
        ("(2 m s + n (p + s/2)) s' phi'", "n (p + s/2) s' phi'", "2 m s φ̇ ṡ is missing", "product rule"),
    ],
)
def test_the_rule_that_was_not_followed_in_a_derivative_is_named(
    right: str, wrong: str, said: str, advice: str
) -> None:
    whole = JIB_T + JIB_RATE + JIB_SLOPE + JIB
    assert jib().check(whole).right
    told = words(jib(), whole.replace(right, wrong))
    assert said in told and advice in told and "mind the signs" not in told and "A possible reason" not in told


@pytest.mark.parametrize(
    ("right", "wrong", "said", "advice"),
    [
        ("(2 m s + n", "(m s + n", "In the term m s φ̇ ṡ, the factor 2 is missing", "derivative of the square"),
        ("- (m s + n/2 (p + s/2))", "+ (m s + n/2 (p + s/2))", "+ m s) φ̇² has the wrong sign", "in a circle"),
        ("J + m s^2", "J + m s^2/3", "should be m s² φ̈", "m a² for a mass at the distance a"),
        (" = -c phi'", " = 0", "Damper 'bearing' is missing.", "which springs, dampers, weights and forces act"),
    ],
)
def test_equations_alone_are_told_without_energies(right: str, wrong: str, said: str, advice: str) -> None:
    assert jib().check(JIB).right
    told = words(jib(), JIB.replace(right, wrong))
    assert said in told and advice in told, told
    assert not any(x in told for x in ("∂", "T*", "kinetic energy", "count each once", "A possible reason"))


def test_a_formula_with_derivatives_of_energies_is_no_part_of_one() -> None:
    general = "D = c phi'^2\nd/dt dL/dq' - dL/dq + dD/dq' = Q\n"
    told = words(jib(), general + JIB.replace("c phi'", "2 c phi'"))
    assert "The ½ of damper 'bearing' in D is missing" in told, told


def test_beside_energies_a_derivative_is_a_possible_reason() -> None:
    told = words(jib(), JIB_T + JIB.replace("- (m s + n/2 (p + s/2))", "+ (m s + n/2 (p + s/2))"))
    assert "φ̇² has the wrong sign. A possible reason: ∂L/∂s has the wrong sign." in told, told


@cache
def belt() -> lg.Derivation:
    """A motor turns a roller through a gear; it rolls on a belt that is driven faster and faster, and it carries a
    damped wheel that is counted in the other sense."""
    s = lg.System("belt")
    x, phi, theta = s.coordinates("x phi theta")
    M, J, R, a, c, A = s.parameters("M J R a c A")
    n = s.parameter("n", unit="1")
    s.kinetic(M * x.diff() ** 2 / 2 + J * phi.diff() ** 2 / 2 + A * theta.diff() ** 2 / 2)
    s.velocity_constraint(x.diff() - R * phi.diff() - a * time, name="belt")
    s.damper(c, deflection=phi + theta, name="bearing")
    s.force(s.input("tau"), deflection=n * theta, name="motor")
    return s.derive()


BELT = """x' - R phi' = a t
M x'' = lambda
J phi'' + c (phi' + theta') = -R lambda
A theta'' + c (phi' + theta') = n tau
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong", "said", "advice"),
    [
        ("x' - R phi' = a t", "x' + R phi' = a t", "R φ̇ has the wrong sign", "Let one coordinate grow a little"),
        ("x' - R phi' = a t", "x' - R phi' = 0", "−a t is missing", "What is given in time counts as well"),
        ("= -R lambda", "= -lambda", "stands with the factor −1", "to fit the others, −R belongs there"),
        (
            "(phi' + theta')",
            "(phi' - theta')",
            "φ̇ − θ̇ in place of φ̇ + θ̇",
            "the sum of those that are counted in opposite",
        ),
        ("n tau", "tau", "the factor n is missing", "through a gear or a lever, with the ratio"),
    ],
)
def test_advice_on_what_rolls_and_turns(right: str, wrong: str, said: str, advice: str) -> None:
    assert belt().check(BELT).right
    told = words(belt(), BELT.replace(right, wrong))
    assert said in told and advice in told, told
    assert "without its arm" not in told and "Differentiate by time" not in told


def test_a_term_moved_with_its_sign_beside_a_right_force() -> None:
    moved = JIB.replace(" = -c phi'", " - c phi' = 0")
    told = words(jib(), f"Q_phi = -c phi'\nQ_s = F\n{moved}")
    assert "has the wrong sign" in told and "moved to the other side" in told, told


def test_a_small_angle_has_the_letter_of_the_system() -> None:
    told = words(
        bell(), BELL.replace("h cos(theta))\n", "h - h theta^2/2)\n").replace("m g h sin(theta)", "m g h theta")
    )
    assert "sin θ was replaced by θ, as if the motion were small" in told


@cache
def cart() -> lg.Derivation:
    """A cart, and a bar whose angle is called α, on a table that turns above ground that rubs on the bar."""
    s = lg.System("cart")
    x, alpha = s.coordinates("x alpha")
    M, J, l, k, d, w = s.parameters("M J l k d w")
    s.kinetic(M * x.diff() ** 2 / 2 + J * alpha.diff() ** 2 / 2)
    s.spring(k, deflection=l * sp.sin(alpha), name="return spring")
    s.dissipation(d * l**2 * (alpha.diff() + w) ** 2 / 2, name="ground")
    s.damper(d, deflection=x, name="track")
    s.force(s.input("P"), deflection=l * alpha, name="press")
    return s.derive()


CART = "V = k l^2 sin(alpha)^2/2\nM x'' + d x' = 0\nQ_alpha = P l - d l^2 (alpha' + w)\n"
CART += "J alpha'' + k l^2 sin(alpha) cos(alpha) = P l - d l^2 (alpha' + w)"


@pytest.mark.parametrize(
    ("right", "wrong", "said", "advice"),
    [
        ("sin(alpha)^2/2", "alpha^2/2", "sin α was replaced by α", "only near zero"),
        ("(alpha' + w)", "alpha'", "−d l² w of what", "what carries the body counts"),
        ("P l", "P l cos(alpha)", "l cos α; it should be l", "Where both agree, it counts whole"),
    ],
)
def test_advice_on_resistances_and_whole_forces(right: str, wrong: str, said: str, advice: str) -> None:
    assert cart().check(CART).right
    told = words(cart(), CART.replace(right, wrong))
    assert said in told and advice in told, told


@cache
def shutters() -> lg.Derivation:
    """A slide that carries two shutters, which turn alike, each in a hinge with friction."""
    s = lg.System("slide and two shutters")
    x, w = s.coordinates("x w")
    M, J, k, d = s.parameters("M J k d")
    s.kinetic(M * x.diff() ** 2 / 2 + 2 * J * w.diff() ** 2 / 2)
    s.spring(k, deflection=x, name="buffer")
    s.damper(d, deflection=w, name="left hinge")
    s.damper(d, deflection=w, name="right hinge")
    s.force(s.input("F"), deflection=x, name="drive")
    return s.derive()


@pytest.mark.parametrize(("above", "advice"), [("Q_w = -2 d w'\n", "stands in the equation as it is"), ("", "")])
def test_half_of_a_friction_is_of_step_6_and_of_no_derivative(above: str, advice: str) -> None:
    energies = "T = M/2 x'^2 + J w'^2\nV = k x^2/2\nQ_x = F\n"
    told = words(shutters(), f"{energies}{above}M x'' + k x = F\n2 J w'' = -d w'")
    assert "Coriolis" not in told and "d/dt of a product" not in told and "step 5" not in told, told
    assert "step 6" in told and advice in told, told
