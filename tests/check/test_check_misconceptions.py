"""Mistakes made by hand are named; every misconception is a file with a name, words, and systems to be made in."""

import re
from collections import Counter
from pathlib import Path

import pytest
import sympy as sp
from small_systems import loop

import built_in
import lagrangian as lg
from built_in import derivation as derived
from lagrangian.check import Status, explained
from lagrangian.check.explain import candidates, constraint_slips, misconceptions, said_words, say, special_cases
from lagrangian.check.explain.misconceptions import MISCONCEPTIONS, Ingredients
from size import also_in_full, cases

PENDULUM_R = "m*r'' - m*r*theta'^2 + k*(r - L_0) - m*g*cos(theta) = 0"
PENDULUM_THETA = "m*r^2*theta'' + 2*m*r*r'*theta' + m*g*r*sin(theta) = 0"
CART = "(M + m)*x'' + b*x' + m*l*cos(theta)*theta'' - m*l*sin(theta)*theta'^2 = F"
POLE = "(J + m*l^2)*theta'' + m*l*cos(theta)*x'' - m*g*l*sin(theta) = 0"
BODY = "m_s*z_s'' + k_s*(z_s - z_u) + b_s*(z_s' - z_u') = F"
WHEEL = "m_u*z_u'' + k_s*(z_u - z_s) + b_s*(z_u' - z_s') + k_t*(z_u - z_r) = -F"
DISK1 = "J1*phi1'' + b*(phi1' - phi2') + k*(phi1 - phi2) = tau"
M1 = "m1*x1'' + k1*x1 + k2*(x1 - x2) = 0"
M2 = "m2*x2'' + k2*(x2 - x1) + k3*(x2 - x3) + b*(x2' - x3') = F"
M3 = "m3*x3'' + k3*(x3 - x2) + b*(x3' - x2') + k4*x3 = 0"
SWING = "m*L_m^2*theta'' + b*L_b^2*theta' + k*L_k^2*theta"
PARENT = "(m1 + m2)*x1'' + m2*x2r'' = 0"
CHILD = "m2*x1'' + m2*x2r'' + k*x2r = F"
HEIGHT = "m1*g*L_a*sin(theta1) + m2*g*(L_a + L_b)*sin(theta1)"

BY_HAND = [
    ("elastic-pendulum", [PENDULUM_R.replace("(r - L_0)", "r"), PENDULUM_THETA], "rest_forgotten"),
    ("elastic-pendulum", [PENDULUM_R, PENDULUM_THETA.replace("+ 2*", "+ ")], "coriolis_half"),
    ("elastic-pendulum", [PENDULUM_R, "m*r^2*theta'' + m*g*r*sin(theta) = 0"], "product_rule"),
    ("elastic-pendulum", [PENDULUM_R.replace(" - m*r*theta'^2", ""), PENDULUM_THETA], "gradient_forgotten"),
    ("elastic-pendulum", [PENDULUM_R.replace("- m*r*theta'^2", "+ m*r*theta'^2"), PENDULUM_THETA], "gradient_sign"),
    ("elastic-pendulum", [PENDULUM_R, "m*r*theta'' + 2*m*r'*theta' + m*g*cos(theta) = 0"], "sine_for_cosine"),
    ("cart-pole", [CART.replace(" - m*l*sin(theta)*theta'^2", ""), POLE], "product_rule"),
    ("cart-pole", [CART, POLE.replace("(J + m*l^2)", "J")], "translation_forgotten"),
    ("cart-pole", [CART, POLE.replace("(J + m*l^2)", "m*l^2")], "rotation_forgotten"),
    ("cart-pole", [CART, POLE.replace("(J + m*l^2)", "(J + 2*m*l^2)")], "inertia_about_pivot"),
    ("cart-pole", [CART, POLE.replace("- m*g", "+ m*g")], "gravity_sign"),
    ("cart-pole", ["M*x'' + b*x' = F", POLE], "carried_mass_forgotten"),
    ("cart-pole", [CART.replace("+ b", "- b"), POLE], "damper_sign"),
    ("cart-pole", [CART, POLE.replace("= 0", "= F")], "input_everywhere"),
    (
        "cart-pole",
        ["(M + m)*x'' + b*x' + m*l*theta'' = F", "(J + m*l^2)*theta'' + m*l*x'' - m*g*l*theta = 0"],
        "small_angle",
    ),
    ("quarter-car", [BODY, WHEEL.replace("= -F", "= 0")], "reaction_forgotten"),
    ("quarter-car", [BODY, WHEEL.replace("= -F", "= F")], "reaction_sign"),
    (
        "quarter-car",
        [BODY.replace("(z_s' - z_u')", "z_s'"), WHEEL.replace("(z_u' - z_s')", "z_u'")],
        "damper_to_ground",
    ),
    ("quarter-car", [BODY.replace("(z_s - z_u)", "z_s"), WHEEL.replace("(z_u - z_s)", "z_u")], "spring_to_ground"),
    (
        "quarter-car",
        [BODY.replace("(z_s - z_u)", "(z_s + z_u)"), WHEEL.replace("(z_u - z_s)", "(z_u + z_s)")],
        "spring_other_pair",
    ),
    ("wedge", ["(M + m)*x'' + m*cos(alpha)*s'' = F", "m*s'' - m*g*sin(alpha) = 0"], "coupling_forgotten"),
    (
        "wedge",
        ["(M + m)*x'' + m*cos(alpha)*s'' = F", "m*s'' + m*cos(alpha)*x'' - m*g*cos(alpha) = 0"],
        "sine_for_cosine",
    ),
    ("wedge", ["M*x'' = F", "m*s'' - m*g*sin(alpha) = 0"], "relative_speed"),
    ("rolling-cylinder", ["m*x'' = m*g*sin(alpha)"], "rotation_forgotten"),
    ("rolling-cylinder", ["(J/R + m)*x'' = m*g*sin(alpha)"], "arm_not_squared"),
    ("two-disk-shaft", [DISK1, "J2*phi2'' + b*(phi2' - phi1') + k*(phi2 - phi1) = 0"], "element_forgotten"),
    ("three-masses", [M1.replace("= 0", "= F"), M2.replace("= F", "= 0"), M3], "force_wrong_equation"),
    ("three-masses", [M1, M2.replace("k3", "k2"), M3.replace("k3", "k2")], "parameter_swapped"),
    ("three-masses", [M1, M2, M3.replace(" + k4*x3", "")], "element_forgotten"),
    ("lecture-1", [SWING + " - m*g*L_m*sin(theta) = tau"], "gravity_sign"),
    ("lecture-1", [SWING.replace("b*L_b^2", "b") + " + m*g*L_m*sin(theta) = tau"], "damper_arm"),
    ("lecture-1", [SWING + " + m*g*L_m*cos(theta) = tau"], "sine_for_cosine"),
    ("lecture-1", [SWING + " + m*g*sin(theta) = tau"], "gravity_arm"),
    ("lecture-1", [SWING + " + 2*m*g*L_m*sin(theta) = tau"], "element_twice"),
    ("lecture-1", [SWING.replace("m*L_m^2", "2*m*L_m^2") + " + m*g*L_m*sin(theta) = tau"], "half_forgotten"),
    ("lecture-1", [SWING + " + m*g*L_m*sin(theta) = -tau"], "force_sign"),
    ("lecture-2", ["Xi_theta1 = -tau", "Xi_theta2 = tau"], "counted_without_work"),
    ("lecture-2", ["V = " + HEIGHT + " + m3*g*L_c*sin(theta1 + theta2)"], "height_relative"),
    ("lecture-2", ["V = " + HEIGHT + " + m3*g*((L_a + L_b)*sin(theta1) + L_c*sin(theta2))"], "wrong_angle"),
    ("lecture-3b", [PARENT.replace("= 0", "= -F"), CHILD], "counted_without_work"),
    ("lecture-3b", [PARENT.replace("(m1 + m2)", "m1"), CHILD], "carried_mass_forgotten"),
    ("lecture-3b", [PARENT.replace(" = 0", " - k*x2r = 0"), CHILD], "spring_on_carrier"),
    ("lecture-3b", [PARENT, CHILD.replace("+ k", "- k")], "spring_sign"),
    ("lecture-3b", ["T = m1*x1'^2/2 + m2*x2r'^2/2"], "relative_speed"),
    ("lecture-3b", ["T = m1*x1'^2/2 + m2*(x1'^2 + x2r'^2)/2"], "cross_term_forgotten"),
    ("lecture-3b", ["L = m1*x1'^2/2 + m2*(x1' + x2r')^2/2 + k*x2r^2/2"], "spring_sign"),
    ("two-disk-shaft", ["D = b*(phi1' - phi2')^2/2"], "element_forgotten"),
]


NAMES = [f"{n}-{m}-{k}" for k, (n, _, m) in enumerate(BY_HAND)]


@pytest.mark.thinned(2)
@pytest.mark.sampled(12)
@also_in_full
@pytest.mark.parametrize(
    ("name", "lines", "mistake"), cases(BY_HAND, BY_HAND[::3]), ids=cases(NAMES, NAMES[::3])
)  # one mistake in three by default
def test_a_mistake_made_by_hand_is_named(name: str, lines: list[str], mistake: str) -> None:
    verdict = derived(name).check("\n".join(lines))
    assert not verdict.right
    assert verdict.mistake is not None and verdict.mistake.name == mistake, verdict.to_text()


def test_two_mistakes_at_once_are_both_named() -> None:
    verdict = derived("lecture-1").check("m*L_m^2*theta'' - b*L_b^2*theta' + k*L_k^2*theta - m*g*L_m*sin(theta) = tau")
    assert {m.name for m in verdict.mistakes} == {"gravity_sign", "damper_sign"}


def test_a_wrong_term_of_the_answers_own() -> None:
    right = "m*L^2*(sin(theta)^2 + cos(theta)^2)*theta'' + b*theta' + m*g*L*sin(theta) = 0"
    assert derived("pendulum").check(right).right
    wrong = "m*L^2*sin(theta)^2*theta'' - m*L^2*cos(theta)^2*theta'' + b*theta' + m*g*L*sin(theta) = 0"
    verdict = derived("pendulum").check(wrong)
    assert verdict.mistake is not None and verdict.mistake.name == "sign_of_a_term"
    assert "cos(theta)^2" in str(verdict.mistake.what)


def test_a_system_that_is_too_long_is_told_by_its_terms(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(candidates, "LONGEST_SYSTEM", 3)
    pendulum = lg.example("pendulum").derive()  # of its own: what was found in a shared one is remembered
    verdict = pendulum.check("m*L^2*theta'' - b*theta' + m*g*L*sin(theta) = 0")
    assert verdict.mistake is not None and verdict.mistake.name in ("sign_of_a_term", "wrong_sign")
    assert "too long" in str(verdict.notes[-1])
    assert verdict.first_wrong is not None and verdict.first_wrong.differences[0].kind == "sign"
    assert not pendulum.check("m*L^2*theta'' + b*theta' - m*g*L*sin(theta) = 0").right


def test_every_misconception_is_a_file_with_words() -> None:
    folder = Path(misconceptions.__file__).parent
    files = {p.stem for p in folder.glob("*.py")} - {"__init__", "base", "ends"}
    names = [m.__name__.rsplit(".", 1)[1] for m in MISCONCEPTIONS]
    assert len(names) >= 30
    assert sorted(names) == sorted(files)
    for module in MISCONCEPTIONS:
        assert module.__doc__ and 0 <= module.STEP <= 6 and len(str(module.WHY)) > 30, module


LECTURE = ("d/dt ∂L/∂ξ̇ − ∂L/∂ξ = Ξ", "d/dt ∂L/∂ξ̇", "∂L/∂ξ̇", "∂L/∂ξ", "Ξ = F·∂r/∂ξ", "Ξ = Σ F·∂r/∂ξ", "unit of ξ", "ξ_i")
"""Formulas of the lecture that hold for all systems and give no term away."""
GIVEN_AWAY = re.compile("[½²·+]|[a-zA-Zθφξ][\u0307\u0308′″]|\\d")


def test_no_reason_is_a_correction() -> None:
    """A hint of level 2 tells the reason too: in words, and with no formula but the lecture's own."""
    reasons = [str(m.WHY) for m in MISCONCEPTIONS if m.__name__.rsplit(".", 1)[1] != "small_angle"]
    reasons += [kind.why for kind in say.KINDS.values()] + list(say.WHY_PART.values())
    reasons += [str(t) for t in (*constraint_slips.WHY, special_cases.WHY_RATES, *said_words.WHY.values())]
    for reason in reasons:
        words = reason
        for formula in LECTURE:
            words = words.replace(formula, "")
        assert GIVEN_AWAY.search(words) is None, reason


def on_a_turntable() -> lg.Derivation:
    """A mass on a spring on a table that turns at a given rate, in coordinates that turn with it."""
    system = lg.System("turntable")
    x, y = system.coordinates("x y")
    m, k, speed = system.parameters("m k Omega")
    c, s = sp.cos(speed * system.t), sp.sin(speed * system.t)
    system.particle(m, at=system.point("P", (x * c - y * s, x * s + y * c)))
    system.spring(k, deflection=x)
    return system.derive()


@pytest.mark.slow
def test_every_misconception_can_be_made_in_some_example() -> None:
    made: Counter[str] = Counter()
    chosen = [
        "lecture-1",
        "lecture-3b",
        "cart-pole",
        "elastic-pendulum",
        "kapitza-pendulum",
        "quarter-car",
        "lecture-2",
        "planar-quadrotor",
        "magnetic-levitation",
    ]
    for derivation in (*map(derived, chosen), on_a_turntable(), loop()):
        ingredients = Ingredients(derivation)
        for module in MISCONCEPTIONS:
            for variant in module.wrong(ingredients):
                made[module.__name__.rsplit(".", 1)[1]] += 1
                assert str(variant.what).strip()
    assert not {m.__name__.rsplit(".", 1)[1] for m in MISCONCEPTIONS} - set(made)


@pytest.mark.slow
def test_mistakes_are_tried_up_to_a_number_of_operations(monkeypatch: pytest.MonkeyPatch) -> None:
    """The likelier ones first; where the operations are spent, the answer is told so."""
    monkeypatch.setattr(candidates, "WORK", 300)
    candidates.effects_of.cache_clear()
    checked = built_in.system("double-pendulum").check("m1*theta1'' = 0\nm2*theta2'' = 0")
    candidates.effects_of.cache_clear()
    assert "too long for all well-known mistakes to be tried" in " ".join(checked.to_text().split())


def test_mistakes_are_not_sought_where_none_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    sought: list[str] = []
    of_mistakes = explained.mistakes
    monkeypatch.setattr(explained, "mistakes", lambda *args: sought.append("") or of_mistakes(*args))
    wrong = f"{CART}\n{POLE.replace('(J + m*l^2)', 'J')}"
    told = derived("cart-pole").check(wrong, hint=0)
    assert told.status is Status.WRONG and not told.mistakes and not sought
    assert told.to_dict() == {"right": False, "verdict": "wrong", "hint": 0}
    assert derived("cart-pole").check(wrong, hint=1).mistakes and sought
