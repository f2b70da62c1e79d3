r"""An inertia that depends on the position, with a name that only a chain of energies gives, and slopes with primes.

Oracle: a piston that a flywheel drives (a Scotch yoke), a mast that lifts a weight, a cam below a follower, and a rack
with its pinion, by hand. Every right form has wrong twins.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp
from small_systems import mass, rack, rod

import lagrangian as lg


@cache
def yoke() -> lg.Derivation:
    """A flywheel that moves a piston on a spring: x = r cos θ."""
    s = lg.System("yoke")
    theta = s.coordinate("theta")
    J, m, r, k, c = s.parameters("J m r k c")
    s.kinetic(J * theta.diff() ** 2 / 2, name="flywheel")
    s.particle(m, at=s.point("P", (r * sp.cos(theta), 0)), name="piston")
    s.spring(k, deflection=r * sp.cos(theta), name="spring")
    s.damper(c, deflection=theta, name="bearing")
    s.torque(s.input("tau"), on=theta, name="motor")
    return s.derive()


@cache
def mast() -> lg.Derivation:
    """A mast that a winch raises, with a weight on a pulley: h = 2 b sin(α/2)."""
    s = lg.System("mast")
    alpha = s.coordinate("alpha")
    m, M, l, b, g = s.parameters("m M l b g")
    s.kinetic(m * l**2 * alpha.diff() ** 2 / 6, name="mast")
    s.particle(M, at=s.point("W", (0, 2 * b * sp.sin(alpha / 2))), name="weight")
    s.gravity(direction=(0, -1), g=g)
    s.potential(m * g * l * sp.sin(alpha) / 2, name="weight of the mast")
    s.torque(s.input("u"), on=alpha, name="winch")
    return s.derive()


@cache
def cam() -> lg.Derivation:
    """A cam below a follower on a spring: y = −e cos φ."""
    s = lg.System("cam")
    phi = s.coordinate("phi")
    J, m, e, k, h, g = s.parameters("J m e k h g")
    s.kinetic(J * phi.diff() ** 2 / 2, name="cam")
    s.particle(m, at=s.point("P", (0, -e * sp.cos(phi))), name="follower")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=h - e * sp.cos(phi), name="spring")
    s.torque(s.input("M"), on=phi, name="motor")
    return s.derive()


YOKE = r"""\[ T=\tfrac12\left[J+mr^2\sin^2\theta\right]\dot\theta^2=\tfrac12I(\theta)\dot\theta^2 \]
\[ V=\tfrac12kr^2\cos^2\theta \]
$\frac{d}{dt}(I\dot\theta)-\frac12I'\dot\theta^2+V'=\Xi$ with $I'=2mr^2\sin\theta\cos\theta$ and $\Xi=\tau-c\dot\theta$.
Hence $I\ddot\theta+\frac12I'\dot\theta^2+V'=\Xi$:
\[ (J+mr^2\sin^2\theta)\ddot\theta+mr^2\sin\theta\cos\theta\,\dot\theta^2-kr^2\sin\theta\cos\theta+c\dot\theta=\tau \]
"""
PLAIN = """\
T = 1/2 (J + m r^2 sin(theta)^2) theta'^2 = 1/2 I(theta) theta'^2
V = 1/2 k r^2 cos(theta)^2
Q = tau - c theta'
I' = 2 m r^2 sin(theta) cos(theta)
I theta'' + 1/2 I' theta'^2 + V' = Q
(J + m r^2 sin(theta)^2) theta'' + m r^2 sin(theta) cos(theta) theta'^2 - k r^2 sin(theta) cos(theta) + c theta' = tau
"""
SLOPED = r" with $I'=2mr^2\sin\theta\cos\theta$ and"
"""What a line says of the slope of I."""


def _judged(d: lg.Derivation, answer: str) -> bool:
    return d.check(answer, hint=0).right


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("now", "instead"),
    [
        ("", ""),
        (r"I(\theta)", "I"),
        (SLOPED, " with"),
        (r"I'=2m", r"I'(\theta)=2m"),
        (r"\dot\theta^2 \]", r"\dot\theta^2,\quad I=J+mr^2\sin^2\theta \]"),
        (r"\frac{d}{dt}(I\dot\theta)", r"\frac{d}{dt}\frac{\partial T}{\partial\dot\theta}"),
        (r"I\ddot\theta+\frac12I'\dot\theta^2+V'=\Xi", r"\ddot\theta=\frac{\Xi-\frac12I'\dot\theta^2-V'}{I}"),
    ],
)
def test_a_chain_says_what_an_inertia_is_and_primes_beside_it_are_slopes(now: str, instead: str) -> None:
    assert now in YOKE and _judged(yoke(), YOKE.replace(now, instead) if now else YOKE)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("now", "wrong"),
    [
        (r"I\ddot\theta+\frac12I'", r"I\ddot\theta-\frac12I'"),
        (r"I\ddot\theta+\frac12I'", r"I\ddot\theta+I'"),
        (r")-\frac12I'", r")+\frac12I'"),
        (r"+V'=\Xi$ with", r"-V'=\Xi$ with"),
        (r"I'=2m", r"I'=m"),
        (r"[J+mr^2", r"[J+2mr^2"),
        (r"(J+mr^2", r"(J+2mr^2"),
        (r"\dot\theta^2 \]", r"\dot\theta^2,\quad I=J+mr^2\cos^2\theta \]"),
    ],
)
def test_wrong_forms_stay_wrong(now: str, wrong: str) -> None:
    assert now in YOKE and not _judged(yoke(), YOKE.replace(now, wrong))
    assert not _judged(yoke(), YOKE.replace(now, wrong).replace(SLOPED, " with")) or now == "I'=2m"


def test_the_line_of_a_wrong_sign_is_told() -> None:
    found = yoke().check(YOKE.replace(r"I\ddot\theta+\frac12I'", r"I\ddot\theta-\frac12I'"), hint=0)
    assert [f.line.number for f in found.findings if not f.status.right] == [4]


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("now", "instead"),
    [
        ("", ""),
        ("'", "' "),
        ("I(theta)", "I"),
        ("I' ", "I'(theta) "),
        ("I' ", "dI/dtheta "),
        ("1/2 (J + m r^2 sin(theta)^2) theta'^2 = 1/2 I(theta)", "1/2 I theta'^2 = 1/2 (J + m r^2 sin(theta)^2)"),
        ("I theta'' + 1/2 I' theta'^2 + V' = Q", "d/dt(I theta') = 1/2 I' theta'^2 - V' + Q"),
        ("I theta'' + 1/2 I' theta'^2 + V' = Q", "I theta' theta'' + 1/2 I' theta'^3 + V' theta' = Q theta'"),
    ],
)
def test_the_same_holds_where_rates_have_primes(now: str, instead: str) -> None:
    assert now in PLAIN and _judged(yoke(), PLAIN.replace(now, instead) if now else PLAIN)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("now", "wrong"),
    [("+ 1/2 I'", "- 1/2 I'"), ("+ 1/2 I'", "+ I'"), ("+ V' =", "- V' ="), ("I' = 2", "I' = 1"), ("1/2 I(", "I(")],
)
def test_wrong_signs_and_factors_are_wrong_where_rates_have_primes(now: str, wrong: str) -> None:
    assert now in PLAIN and not _judged(yoke(), PLAIN.replace(now, wrong))


def test_a_rate_of_an_inertia_and_of_an_energy_stays_one() -> None:
    result = PLAIN.splitlines()[-1]
    inertia = "I = J + m r^2 sin(theta)^2\nV = 1/2 k r^2 cos(theta)^2\n"
    power = "I theta' theta'' + 1/2 I' theta'^2 + V' = (tau - c theta') theta'\n"
    balance = (
        "I theta'' + I' theta' - m r^2 sin(theta) cos(theta) theta'^2 - k r^2 sin(theta) cos(theta) + c theta' = tau\n"
    )
    for line in (power, balance):
        assert _judged(yoke(), inertia + line + result)
        assert not _judged(yoke(), inertia + line.replace("+ 1/2 I'", "- 1/2 I'").replace("+ I'", "- I'") + result)


def test_a_velocity_without_its_rate_is_no_slope() -> None:
    result = "(J + m e^2 sin(phi)^2) phi'' + m e^2 sin(phi) cos(phi) phi'^2 + m g e sin(phi) = M - k e sin(phi) h"
    result += " + k e^2 sin(phi) cos(phi)\n"
    motion = "y = -e cos(phi)\ny' = e sin(phi) phi'\nT = 1/2 J phi'^2 + 1/2 m y'^2\nV = m g y + 1/2 k (h + y)^2\n"
    assert _judged(cam(), motion + result)
    assert not _judged(cam(), motion.replace("e sin(phi) phi'", "e sin(phi)") + result)


ALONE = r"""$T=\frac12(J+mr^2\sin^2\theta)\dot\theta^2=\frac12\,B\,\dot\theta^2$ and $V=\frac12kr^2\cos^2\theta$. Then

$B\ddot\theta+\frac12B'\dot\theta^2+V'=\tau-c\dot\theta$
"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["B", r"\Theta", "B_e", r"M_{\rm eff}", r"m_{\mathrm{red}}"])
@pytest.mark.parametrize("slope", ["{}'", r"\frac{{d{}}}{{d\theta}}", r"\frac{{\partial {}}}{{\partial\theta}}"])
def test_names_without_what_they_depend_on(name: str, slope: str) -> None:
    answer = ALONE.replace("B'", slope.format("@")).replace("B", "@").replace("@", name)
    assert _judged(yoke(), answer)
    assert not _judged(yoke(), answer.replace(r"+\frac12", r"-\frac12"))


def test_a_rate_with_a_dot_is_no_slope() -> None:
    assert _judged(yoke(), ALONE.replace(r"B'\dot\theta^2", r"\dot B\dot\theta"))
    assert not _judged(yoke(), ALONE.replace(r"B'\dot", r"\dot B\dot"))


def test_slopes_in_the_steps_before_an_equation() -> None:
    steps = "dL/dtheta' = I theta'\nd/dt(dL/dtheta') = I theta'' + I' theta'^2\ndL/dtheta = 1/2 I' theta'^2 - V'\n"
    head, _, result = PLAIN.partition("Q = ")
    answer = head + steps + "Q = " + result
    assert _judged(yoke(), answer)
    for now, wrong in (("^2 - V'", "^2 + V'"), ("= 1/2 I' theta'^2 -", "= I' theta'^2 -"), ("'' + I'", "'' + 1/2 I'")):
        assert now in answer and not _judged(yoke(), answer.replace(now, wrong))


def test_a_speed_of_the_answer_has_a_rate() -> None:
    answer = PLAIN.replace("I theta'' + 1/2 I' theta'^2 + V' = Q", "w = theta'\nI w' + 1/2 I' w^2 + V' = Q")
    assert "w'" in answer and _judged(yoke(), answer)
    for now, wrong in (("+ 1/2 I' w", "- 1/2 I' w"), ("+ V'", "- V'")):
        assert now in answer and not _judged(yoke(), answer.replace(now, wrong))


def test_a_letter_of_an_energy_may_be_a_position_or_a_speed() -> None:
    for answer in ("V = x'\nm V' = F - b V - k x\n", "V = x\nm x'' + b V' + k V = F\n"):
        assert _judged(mass(), answer)
        assert not _judged(mass(), answer.replace("- b V", "+ b V").replace("+ b V'", "- b V'"))


MAST = """\
T = ½·(m·l²/3 + M·b²·cos²(α/2))·α̇² = ½·J(α)·α̇²
U = m·g·l/2·sin α + 2·M·g·b·sin(α/2)
J·α̈ + ½·J'·α̇² + U' = u
J' = −M·b²·cos(α/2)·sin(α/2)
U' = m·g·l/2·cos α + M·g·b·cos(α/2)
(m·l²/3 + M·b²·cos²(α/2))·α̈ − ½·M·b²·cos(α/2)·sin(α/2)·α̇² + m·g·l/2·cos α + M·g·b·cos(α/2) = u
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["J", "J_eff", "Theta"])
def test_slopes_that_lines_state_are_judged(name: str) -> None:
    answer = MAST.replace("J", name)
    assert _judged(mast(), answer)
    for now, wrong in (("+ ½·J'", "− ½·J'"), ("J' = −M", "J' = M"), ("U' = m·g·l/2", "U' = m·g·l"), ("+ U'", "− U'")):
        assert now in MAST and not _judged(mast(), answer.replace(now.replace("J", name), wrong.replace("J", name)))


CAM = r"""$$T=\frac12\left(J+me^2\sin^2\varphi\right)\dot\varphi^2=:\frac12\Theta(\varphi)\dot\varphi^2$$
$$V=-mge\cos\varphi+\frac k2(h-e\cos\varphi)^2$$
$$\Theta(\varphi)\ddot\varphi+\tfrac12\Theta'(\varphi)\dot\varphi^2+V'(\varphi)=M$$
$$(J+me^2\sin^2\varphi)\ddot\varphi+me^2\sin\varphi\cos\varphi\dot\varphi^2+mge\sin\varphi+ke\sin\varphi(h-e\cos\varphi)=M$$
"""


@pytest.mark.parametrize("alone", [False, True])
def test_a_function_is_called_with_its_coordinate_or_alone(alone: bool) -> None:
    answer = CAM.replace(r"'(\varphi)", "'") if alone else CAM
    assert _judged(cam(), answer)
    assert not _judged(cam(), answer.replace(r"+\tfrac12\Theta", r"-\tfrac12\Theta"))
    assert not _judged(cam(), answer.replace("+V'", "-V'"))


RACK = """\
T = 1/2 m x'^2 + 1/2 J (x'/R)^2 = 1/2 m_red x'^2
V = 1/2 k (x - d)^2 = 1/2 c_F (x - d)^2
m_red x'' + c_F (x - d) = M/R
"""


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("now", "wrong"),
    [
        ("m_red x''", "2 m_red x''"),
        ("+ c_F", "- c_F"),
        ("(x'/R)^2", "x'^2/R"),
        ("1/2 c_F", "c_F"),
        ("= M/R", "= M/R\nm_red = m + J/R"),
    ],
)
def test_a_mass_and_a_stiffness_of_a_chain(now: str, wrong: str) -> None:
    assert _judged(rack(), RACK) and _judged(rack(), RACK + "m_red = m + J/R^2\n")
    assert now in RACK and not _judged(rack(), RACK.replace(now, wrong))


def test_a_chain_may_go_on_in_another_line() -> None:
    answer = PLAIN.replace(" = 1/2 I(theta)", "\n  = 1/2 I(theta)")
    assert _judged(yoke(), answer)
    assert not _judged(yoke(), answer.replace("+ 1/2 I'", "- 1/2 I'"))


def test_a_slope_of_an_energy_beside_an_acceleration() -> None:
    answer = "T = 1/2 m x'^2\nV = 1/2 k x^2\nm x'' + V' = F - b x'\nm x'' + b x' + k x = F\n"
    assert _judged(mass(), answer)
    assert _judged(mass(), answer.replace("m x'' + V' = F - b x'", "m x' x'' + V' = (F - b x') x'"))
    assert not _judged(mass(), answer.replace("+ V'", "- V'"))
    assert not _judged(mass(), answer.replace("m x'' + V' = F - b x'", "m x' x'' + V' = F - b x'"))


def test_a_slope_by_one_of_two_coordinates() -> None:
    answer = "I = J + m r^2\nI phi'' + I' phi' = M\nm r'' - 1/2 I' phi'^2 + k (r - a) = 0\n"
    assert _judged(rod(), answer)
    for now, wrong in (("- 1/2 I'", "+ 1/2 I'"), ("- 1/2 I'", "- I'"), ("+ I' phi'", "- I' phi'")):
        assert now in answer and not _judged(rod(), answer.replace(now, wrong))
