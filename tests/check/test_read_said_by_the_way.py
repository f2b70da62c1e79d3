"""What sheets say by the way: numbers below LaTeX, what a letter is with its value, definitions, forces in lists.

Oracle: small systems with equations by hand. Every form has a wrong twin.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg


@cache
def flap() -> lg.Derivation:
    """A flap on a torsion spring that is relaxed at theta0, with a damper and a motor."""
    s = lg.System("flap")
    theta = s.coordinate("theta")
    values = {"J": "0.5 kg m^2", "kappa": "3 N m", "d": "0.25 N m s", "theta0": "30 deg", "m": "2 kg", "a": "0.4 m"}
    J, kappa, d, theta0, m, a, g = (s.parameter(x, v) for x, v in [*values.items(), ("g", "9.81 m/s^2")])
    s.kinetic(J * theta.diff() ** 2 / 2, name="flap")
    s.potential(kappa * (theta - theta0) ** 2 / 2, name="spring")
    s.particle(m, at=s.point("C", (a * sp.sin(theta), -a * sp.cos(theta))), name="weight")
    s.gravity(direction=(0, -1), g=g)
    s.damper(d, deflection=theta)
    s.torque(s.input("M"), on=theta, name="motor")
    return s.derive()


FLAP = r"""$$(J + m a^2)\ddot\theta + d\dot\theta + \kappa(\theta - \theta_0) + m g a\sin\theta = M$$

Mit Zahlen (SI): 0,82·θ̈ + 0,25·θ̇ + 3·(θ − π/6) + 7,848·sin θ = M"""


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("now", "wrong"), [("0,82", "0,80"), ("+ 7,848", "− 7,848"), ("0,25·θ̇", "0,25·θ"), ("0,82·θ̈", "0,82")]
)
def test_numbers_in_a_line_below_latex_may_have_commas(now: str, wrong: str) -> None:
    assert flap().check(FLAP).right
    assert "line 3" in flap().check(FLAP).to_text()
    assert now in FLAP and not flap().check(FLAP.replace(now, wrong)).right


SHORT = """J th'' + m a^2 th'' + d th' + kappa (th - th0) + m g a sin(th) = M
th = theta, th0 = theta0 = 30 deg"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("value", ["30 deg", "pi/6", "30°", "0.5236 rad", "0.5236"])
def test_a_name_may_be_said_to_be_a_parameter_with_its_value(value: str) -> None:
    text = SHORT.replace("30 deg", value)
    verdict = flap().check(text)
    assert verdict.right and "another one" not in verdict.to_text()
    assert not flap().check(text.replace("(th - th0)", "(th + th0)"), hint=0).right
    assert not flap().check(text.replace("th0 = theta0", "th0 = 2 theta0"), hint=0).right


def test_another_value_is_told_as_an_assumption() -> None:
    verdict = flap().check(SHORT.replace("30 deg", "1.5"))
    assert verdict.right and "1.5" in verdict.to_text()
    assert flap().check(SHORT.replace("theta0 = 30 deg", "theta0"), hint=0).right


@cache
def lift() -> lg.Derivation:
    """A flap on a lift: a damper and a spring at the lift, a damper and a motor at the hinge, a force at the tip."""
    s = lg.System("lift with a flap")
    y, theta = s.coordinates("y theta")
    M, J, k, c, d, l = s.parameters("M J k c d l")
    s.particle(M, at=s.point("A", (0, y)), name="lift")
    s.kinetic(J * theta.diff() ** 2 / 2, name="flap")
    s.spring(k, deflection=y)
    s.damper(c, deflection=y, name="guide")
    s.damper(d, deflection=theta, name="hinge")
    s.torque(s.input("tau"), on=theta, name="motor")
    s.force(s.input("R"), deflection=y - l * sp.sin(theta), name="tip")
    return s.derive()


LISTED = """φ = θ
T = 1/2·M·ẏ² + 1/2·J·φ̇²
V = 1/2·k·y²
Kräfte:
- Führung: −c·ẏ in y
- Drehdämpfer: −d·φ̇ in φ
- Motor: +τ in φ
- Kraft R in P: Q_y = R, Q_φ = −R·l·cos φ

M·ÿ + c·ẏ + k·y = R
J·φ̈ + d·φ̇ = τ − R·l·cos φ"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("own", ["φ", "θ"])
@pytest.mark.parametrize("word", ["in", "auf", "on", "for"])
def test_a_force_behind_the_name_of_an_element_is_of_this_element_alone(own: str, word: str) -> None:
    text = LISTED.replace(" in y", f" {word} y").replace(" in φ", f" {word} φ")
    text = text.replace("φ = θ\n", "").replace("φ", own) if own == "θ" else text
    verdict = lift().check(text)
    assert verdict.right and verdict.to_text().count("a part of it") == 5


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("now", "wrong", "told"),
    [
        ("+τ in", "−τ in", "wrong sign"),
        ("−c·ẏ in", "+c·ẏ in", "wrong sign"),
        ("−d·φ̇ in", "−d·φ in", ""),
        ("Q_φ = −R", "Q_φ = R", "sign"),
        ("l·cos φ\n\n", "l·sin φ\n\n", ""),
    ],
)
def test_of_listed_forces_the_wrong_one_is_told(now: str, wrong: str, told: str) -> None:
    assert now in LISTED
    verdict = lift().check(LISTED.replace(now, wrong))
    bad = [f for f in verdict.findings if not f.status.right]
    assert not verdict.right and len(bad) == 1 and told in verdict.to_text()
    assert len(bad[0].differences) < 3


def test_what_a_list_leaves_out_is_told_except_dampers_in_the_equations() -> None:
    listed = LISTED.replace("- Drehdämpfer: −d·φ̇ in φ\n", "").replace("- Führung: −c·ẏ in y\n", "")
    assert lift().check(listed).right
    assert not lift().check(LISTED.replace("- Motor: +τ in φ\n", "")).right
    assert not lift().check(LISTED.replace("Kraft R in P: Q_y", "Kräfte: Q_y").replace("- Motor: +τ in φ\n", "")).right


BALANCE = """E = T + V with
T = 1/2 I y'^2 + 1/2 A θ'^2
V = 1/2 k y^2

where I is the whole mass M + 0, S stands for R l and A for J + 0 M.

dE/dt = I y' y'' + A θ' θ'' + k y y'

I y'' + c y' + k y = R
A θ'' + d θ' + S cos θ = τ""".replace(" + 0 M", " + J - J").replace(" + 0", " + M - M")


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "said",
    [
        "where I is the whole mass M + M - M, S stands for R l and A for J + J - J.",
        "Here S is R*l, A stands for J + J - J, and I for M + M - M.",
        "S steht für R·l, A für J + J - J und I für M + M - M",
        "where I denotes M + M - M and S is short for R l, A being J + J - J",
    ],
)
def test_a_list_of_definitions_may_say_its_verb_once(said: str) -> None:
    text = BALANCE.replace("where I is the whole mass M + M - M, S stands for R l and A for J + J - J.", said)
    assert said in text
    verdict = lift().check(text)
    assert verdict.right and "coordinates were read" not in verdict.to_text()
    for now, wrong in [
        ("J + J - J", "J + J"),
        ("M + M - M", "M + M"),
        ("R l", "2*R l"),
        ("R*l", "R*R"),
        ("R·l", "J·l"),
    ]:
        if now in said:
            assert not lift().check(text.replace(now, wrong), hint=0).right


def test_a_sum_of_energies_has_their_values_below_it() -> None:
    assert not lift().check(BALANCE.replace("+ k y y'", "- k y y'"), hint=0).right
    assert not lift().check(BALANCE.replace("V = 1/2 k y^2", "V = k y^2"), hint=0).right
    plain = "E = T + V\nT = M y'^2/2 + J θ'^2/2\nV = k y^2/2\ndE/dt = M y' y'' + J θ' θ'' + k y y'\n"
    rows = "M y'' + c y' + k y = R\nJ θ'' + d θ' + R l cos θ = τ"
    verdict = lift().check(plain + rows)
    assert verdict.right and "E = " not in verdict.to_text().split("Line by line")[0]


@cache
def bead() -> lg.Derivation:
    """A bead on a rail, drawn by a cord to a point at the distance h."""
    s = lg.System("bead")
    x = s.coordinate("x")
    m, k, h, a, b = s.parameters("m k h a b")
    s.particle(m, at=s.point("B", (x, 0)), name="bead")
    s.spring(k, deflection=sp.sqrt(x**2 + h**2) - a, name="cord")
    s.damper(b, deflection=x)
    s.force(s.input("F"), deflection=x)
    return s.derive()


BEAD = """S = k (sqrt(x^2+h^2) - a)
I write cos beta = x/sqrt(x^2+h^2), sin beta = h/sqrt(x^2+h^2).
m x'' = F - b x' - S cos beta
S sin beta x = h S cos beta"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "I write cos beta = x/sqrt(x^2+h^2), sin beta = h/sqrt(x^2+h^2).",
        "with sin beta = h/sqrt(x^2+h^2) and cos beta = x/sqrt(x^2+h^2)",
        "r = sqrt(x^2+h^2)\ncos beta = x/r\nsin beta = h/r",
    ],
)
def test_an_angle_given_by_cosine_and_sine_has_the_signs_of_both(said: str) -> None:
    text = BEAD.replace("I write cos beta = x/sqrt(x^2+h^2), sin beta = h/sqrt(x^2+h^2).", said)
    assert bead().check(text).right
    for now, wrong in [("- S cos beta", "+ S cos beta"), ("cos beta = x", "cos beta = 2 x"), ("h S cos", "h S sin")]:
        assert now in text and not bead().check(text.replace(now, wrong), hint=0).right
    exchanged = text.replace("cos beta = x", "cos beta = h").replace("sin beta = h", "sin beta = x")
    assert not bead().check(exchanged, hint=0).right
