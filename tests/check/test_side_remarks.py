"""Remarks beside right and complete equations decide nothing: checks, special cases, positions at rest.

Oracle: the equations of the cart with a pole, and the special cases that follow from them. Beside a wrong equation, and
where a remark states an energy, explains a name or repeats all equations, it is judged as ever.
"""

from __future__ import annotations

import pytest
import sympy as sp

from built_in import derivation
from lagrangian import System
from student_answers import CART, POLE, right

WRONG_POLE = POLE.replace("- m g", "+ m g")

REMARKS = [
    "Probe: mit x ≡ 0 (Wagen fest) bleibt (J + m l²) θ̈ = m g l sin θ ✓",
    "Special case m = 0: the cart alone, M x'' + b x' = F",
    "Sonderfall θ = 0:\n(M + m) x'' + b x' = F",
    "\nEquilibrium without F (x' = x'' = 0 etc.):\nm g l sin(theta_0) = 0\n",
    "If M goes to infinity then x = l*theta and you get a fixed pivot.",
    "Setting b = 0 and F = 0 gives (M + m) x' + m l theta' cos theta = p_0 = const.",
    "Without friction (F = b = 0) and theta = 0: (M + m) x' = const",
    "Remark: without the pole (m = J = 0) the cart obeys M x'' = F - b x'.",
    "At the greatest speed x' = w, x'' = theta'' = 0 we get b w = F",
    "(check: l -> 0 gives theta = 0 and then\n(M + m) x'' + b x' = F . OK, one dof)",
    "\n## Plausibility\n\n- `theta = 0`: `(M + m)*x'' + b*x' = F`\n- `M = 0`, `m = 0`: `J*theta'' = 0`",
]


TOLD = (
    "was not judged: it is a remark beside the equations.",
    "was not judged: it says that something is constant.",
    "was not judged: it lacks terms of a right equation, which may be 0 in a special case.",
    "' is right at constant rates",
    "' is right for ",
)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("remark", REMARKS)
def test_a_remark_does_not_make_right_equations_wrong(remark: str) -> None:
    verdict = derivation("cart-pole").check(f"{CART}\n{POLE}\n{remark}\n")
    assert verdict.right
    momentum = [f for f in verdict.findings if str(f.note) == "the generalized momentum of x"]
    assert momentum or any(x in str(note) for note in verdict.notes for x in TOLD)
    assert not any(str(note).startswith("Right if ") for note in verdict.notes)


def test_remarks_in_latex_are_taken_off_with_their_formulas() -> None:
    cart = r"(M + m)\ddot x + m l \ddot\theta\cos\theta - m l\dot\theta^2\sin\theta + b\dot x = F"
    pole = r"(J + m l^2)\ddot\theta + m l\ddot x\cos\theta - m g l\sin\theta = 0"
    said = r"F\"ur $x\equiv 0$ folgt $(J + m l^2)\ddot\theta = m g l\sin\theta$, das Pendel."
    case = "Special case $x = 0$ (cart fixed):\n$$J\\ddot\\theta = m l(g\\sin\\theta - l\\ddot\\theta)$$"
    assert right(f"$${cart}$$\n$${pole}$$\n{said}\n{case}\n")
    assert not right(f"$${cart}$$\n$${pole.replace('- m g', '+ m g')}$$\n{said}\n{case}\n")


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    "answer",
    [
        f"{CART}\n{WRONG_POLE}\nCheck: for theta = 0 (M + m) x'' = F - b x'",
        f"{CART}\n{POLE}\nNote:\n{WRONG_POLE}\n{CART}",
        f"{CART}\n{POLE}\nNote: V = - m g l cos theta",
        f"{CART}\n{POLE}\nRemark: Q_x = F + b x'",
        f"{CART}\n{POLE}\nResult for m = 0.2 kg, M = 1 kg, l = 0.3 m, J = 0.006 kg m^2:\n{WRONG_POLE}",
        f"Note: u = 2 x\n{CART.replace('x', 'u')}\n{POLE.replace('x', 'u')}",
        f"For the cart: {CART}\nFor the pole: {WRONG_POLE}\nSpecial case M = 0: {POLE}",
        f"{CART}\n{POLE}\nV = m g l cos theta + 1, for theta = 0 this is m g l + 1, T = m x'^2",
    ],
)
def test_what_is_no_remark_is_judged(answer: str) -> None:
    assert not right(answer)


def test_a_constraint_is_no_remark() -> None:
    wheel = derivation("wheel-on-incline")
    equations = "(m + J/r^2) x'' = m g sin(beta)\nJ phi'' = r S\nm x'' = m g sin(beta) - S\n"
    assert wheel.check(f"{equations}Check: phi' = x'/r, because it rolls", hint=0).right
    assert wheel.check(f"{equations}Check: for beta = 0 nothing drives it, x'' = 0", hint=0).right
    assert not wheel.check(f"{equations}Check: phi' = -x'/r, because it rolls", hint=0).right


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "remark",
    [
        "Initial conditions: everything at rest at t = 0.",
        "t = 0: x = 0, x' = 0",
        "Anfangsbedingungen: x = 0, x' = 0 für t = 0",
        "Equilibrium: x = 0",
        "Linearized about x = 0: cos(x) = 1",
    ],
)
def test_a_case_is_no_constraint(remark: str) -> None:
    rows = "m x'' = 2 lam x\nm y'' + m g = 2 lam y\nx^2 + y^2 = l^2"
    pendulum = derivation("rod-pendulum")
    assert pendulum.check(f"{rows}\n\n{remark}", hint=0).right
    assert not pendulum.check(f"{rows.replace('m g', '2 m g')}\n\n{remark}", hint=0).right
    assert not pendulum.check(f"{rows.replace('= l^2', '= 2 l^2')}\n\n{remark}", hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "remark",
    [
        "If theta is held at zero the first one gives (M + m) x'' + b x' = F.",
        "With the pole clamped: (M + m) x'' + b x' = F",
        "When the cart is fixed, the pole alone: (J + m l^2) theta'' = m g l sin theta",
    ],
)
def test_a_special_case_in_words_must_be_one(remark: str) -> None:
    assert right(f"{CART}\n{POLE}\n{remark}")
    assert not right(f"{CART}\n{POLE}\n{remark.replace('m)', '2 m)').replace('= m g', '= 2 m g')}")
    assert not right(f"{CART}\n{POLE}\n{remark.replace('+ b', '- b').replace('= m g', '= -m g')}")
    assert not right(f"{CART}\n{WRONG_POLE}\n{remark}")


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "remark",
    [
        "For small theta without gravity: (J + m l^2) theta'' + m l x'' = 0, so the pole drifts.",
        "Without gravity: (J + m l^2) theta'' + m l x'' cos theta = 0.",
        "For small angles and no friction, (M + m) x'' + m l theta'' = F",
        "Ohne Reibung: (M + m) x'' + m l theta'' cos theta - m l theta'^2 sin theta = F",
    ],
)
def test_a_sentence_that_leaves_out_a_force_lacks_terms_alone(remark: str) -> None:
    assert right(f"{CART}\n{POLE}\n{remark}")
    assert not right(f"{CART}\n{POLE}\n{remark.replace('+ m l', '- m l')}")
    assert not right(f"{CART}\n{POLE}\n{remark.replace('m l', '2 m l')}")
    assert not right(f"{CART}\n{WRONG_POLE}\n{remark}")
    assert not right(f"{remark.split(':')[0]}:\n{CART}\n{POLE.replace('- m g l sin theta', '')}")


def test_units_beside_equations_are_a_remark() -> None:
    units = "5. units: m l theta'' = kg * m * 1/s^2 = N, b x' = kg/s m/s = N, J theta'' = kg m^2/s^2 = N m"
    assert right(f"{CART}\n{POLE}\n{units}")
    assert not right(f"{CART}\n{WRONG_POLE}\n{units}")
    assert not right(f"{CART}\n{POLE}\nunits: (J + m l^2) theta'' + 2 m l x'' cos theta = m g l sin theta")
    assert not right(f"{CART}\n{POLE}\ncheck: (M + m) x'' + 2 m l theta'' cos theta = F")


def test_a_case_of_a_constant_beside_an_equilibrium_is_a_remark() -> None:
    sys = System("block on a slope")
    x, phi = sys.coordinates("x phi")
    m, beta, g, b, J = sys.parameters("m beta g b J")
    sys.kinetic(m * x.diff() ** 2 / 2 + J * phi.diff() ** 2 / 2)
    sys.potential(-m * g * x * sp.sin(beta) - b * sp.cos(phi))
    block = sys.derive()
    row = r"$$m\ddot x = m g\sin\beta,\quad J\ddot\varphi + b\sin\varphi = 0$$"
    case = r"Check: for $\beta=0$ and no friction $x=$ const., $\varphi=0$ is an equilibrium."
    assert block.check(f"{row}\n{case}", hint=0).right
    bare = case.replace("$x=$ const., ", "")
    assert block.check(f"{row}\n{bare}", hint=0).right
    assert not block.check(f"{row.replace('+ b', '- b')}\n{bare}", hint=0).right


def test_what_a_name_is_in_a_special_case_is_not_said_of_all_motions() -> None:
    sys = System("board on a roller")
    x, phi = sys.coordinates("x phi")
    m, J, R, k = sys.parameters("m J R k")
    s = sys.define("s", x - R * phi)
    sys.kinetic((m * x.diff() ** 2 + J * phi.diff() ** 2) / 2)
    sys.spring(k, deflection=s)
    board = sys.derive()
    answer = "With s = x - R phi:\nm x'' + k s = 0\nJ phi'' - k R s = 0"
    for remark in ("", "If the roller is held at x = 0 (s = -R phi), it swings.", "For x = 0, s = -R phi."):
        assert board.check(f"{answer}\n{remark}", hint=0).right
        assert not board.check(f"{answer.replace('- k R s', '+ k R s')}\n{remark}", hint=0).right
    assert not board.check(answer.replace("x - R", "x + R"), hint=0).right


def test_a_product_without_a_sign_is_no_condition() -> None:
    s = System("disc")
    phi = s.coordinates("phi")
    J, k = s.parameters("J k")
    s.kinetic(J * phi.diff() ** 2 / 2)
    s.spring(k, deflection=phi)
    derived = s.derive()
    assert derived.check("J phi'' = -k phi\nCheck: at rest with phi = 0", hint=0).right
    assert not derived.check("Disc about its axle:   phi'' = k phi\n\nJ phi'' = -k phi", hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "remark",
    [
        "If theta is held at zero the first one gives (M + m) x'' + b x' = F.",
        "Special case theta = 0, theta' = 0: (M + m) x'' + b x' = F",
        "At rest with F = 0: theta = 0",
    ],
)
def test_a_remark_beside_a_wrong_equation_is_not_wrong(remark: str) -> None:
    wrong = POLE.replace("m l^2", "m l")
    assert wrong != POLE
    verdict = derivation("cart-pole").check(f"{CART}\n{wrong}\n{remark}")
    assert [f.line.number for f in verdict.findings if not f.status.right] == [2]
    assert "squared" in str(verdict.mistakes[0].what)
    alone = derivation("cart-pole").check(f"{wrong}\n{remark}")
    assert not alone.right


def test_an_equation_with_a_force_that_another_line_solves_for_is_about_every_motion() -> None:
    s = System("weight on a table")
    y = s.coordinates("y")
    m, g, k = s.parameters("m g k")
    s.particle(m, at=s.point("P", (0, y)))
    s.gravity((0, -1), g)
    s.spring(k, deflection=y)
    answer = "m y'' = N - m g - k y\nN = m y'' + m g + k y\nm y'' + m g = -k y"
    assert s.derive().check(answer).right
    assert not s.derive().check(answer.replace("= N - m g - k y", "= N")).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "I first had {}, because I counted x to the left.",
        "- At first I had {} (wrong sign)",
        "Originally I wrote {}, but the bob hangs below.",
        "Zuerst hatte ich {}, weil ich θ anders zählte.",
        "(we had first {}, then we corrected it because of the sign)",
    ],
)
def test_a_sentence_that_takes_back_what_stood_there_is_not_judged(said: str) -> None:
    verdict = derivation("cart-pole").check(f"{CART}\n{POLE}\n\n{said.format(WRONG_POLE)}")
    assert verdict.right and any("taken back" in str(note) for note in verdict.notes)
    assert not right(f"{CART}\n{WRONG_POLE}\n\n{said.format(POLE)}")
    assert not right(f"{CART}\n{POLE}\nFirst I wrote T = m x'^2. Then V = - m g l cos theta")


@pytest.mark.parametrize(
    "said",
    [
        "We first put T = 5 M x'^2, which is not wrong.",
        "We first put T = 5 M x'^2, which isn't at all wrong.",
        "First we put T = 5 M x'^2, but without the pole.",
        "Originally I wrote T = 5 M x'^2, but without the pole.",
        "I first had T = 5 M x'^2, because the cart is heavy.",
        f"First we got {CART.replace('= F', '= 7 F')}, instead of a force balance",
    ],
)
def test_a_sentence_about_a_first_step_is_judged(said: str) -> None:
    assert "= 7 F" in said or "T = " in said
    assert not derivation("cart-pole").check(f"{said}\n{CART}\n{POLE}").right


def test_an_energy_that_is_stated_again_is_taken_back() -> None:
    whole = "T = 1/2 (M+m) x'^2 + m l x' theta' cos(theta) + 1/2 (J + m l^2) theta'^2"
    said = "Originally I wrote T = 5 M x'^2, but without the pole."
    assert derivation("cart-pole").check(f"{said}\n{whole}\n{CART}\n{POLE}").right
    assert not derivation("cart-pole").check(f"{said}\n{whole.replace('1/2 (M', '(M')}\n{CART}\n{POLE}").right


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "remark",
    [
        "There is no spring, so the result is (M + m) x'' + b x' = F",
        "With no friction in the hinge, the final equation: (J + m l^2) theta'' = m g l sin(theta)",
        "Without friction: (M + m) x'' = F",
        "Check: (M + m) x'' + m l theta'' = F",
        "height above the unit mark: V = m g h\nwith h = - l cos(theta)",
        "unit mass, T = m A^2\nA = l theta'",
    ],
)
def test_words_of_a_force_or_a_unit_hide_no_wrong_line(remark: str) -> None:
    assert not right(f"{CART}\n{POLE}\n{remark}")
