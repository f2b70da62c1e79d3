"""What stands once with twice its value is not called counted twice: a ½ is lost in an arm, a ratio or a square.

Oracle: by hand. A capstan J with the radius r lowers a hook M on a movable pulley, by r φ/2, and a spring k pulls from
the hook at a cart m at x:

    (J + M r²/4) φ̈ + c φ̇ − ½ M g r − ½ k r (x − ½ r φ) = τ,     m ẍ + b ẋ + k (x − ½ r φ) = 0
"""

from __future__ import annotations

from functools import cache

import pytest
from sympy import cos, sin

from lagrangian import Derivation, System


@cache
def capstan() -> Derivation:
    """A capstan, a hook on a movable pulley, and a cart."""
    sys = System("capstan")
    phi, x = sys.coordinates("phi x")
    J, M, r, m, k, b, c, g = sys.parameters("J M r m k b c g")
    tau = sys.inputs("tau")
    sys.rigid_body(0, J, at=sys.origin, frame=sys.frame(phi, name="drum"), name="drum")
    sys.particle(M, at=sys.point("H", (0, -r * phi / 2)), name="hook")
    sys.particle(m, at=sys.point("C", (x, 0)), name="cart")
    sys.spring(k, deflection=x - r * phi / 2, name="rope")
    sys.damper(b, deflection=x, name="wheels")
    sys.damper(c, deflection=phi, name="bearing")
    sys.gravity((0, -1), g)
    sys.torque(tau, on=phi, name="motor")
    return sys.derive()


DRUM = "(J + M r^2/4) phi'' + c phi' - M g r/2 - (r/2) k (x - r phi/2) = tau"
CART = "m x'' + b x' + k (x - r phi/2) = 0"
ENERGIES = """T = 1/2 J phi'^2 + 1/2 M (r phi'/2)^2 + 1/2 m x'^2
V = -M g r phi/2 + 1/2 k (x - r phi/2)^2
D = 1/2 b x'^2 + 1/2 c phi'^2
"""


def said(answer: str) -> list[tuple[str, str]]:
    """What is told of a wrong answer, and what is advised."""
    verdict = capstan().check(answer)
    assert not verdict.right
    return [(" ".join(str(m.what).split()), " ".join(str(m.why).split())) for m in verdict.mistakes]


def test_the_right_equations_and_energies_are_right() -> None:
    assert capstan().check(f"{DRUM}\n{CART}").right
    assert capstan().check(f"{ENERGIES}{DRUM}\n{CART}").right


def test_a_weight_with_twice_its_arm_is_counted_once() -> None:
    [(what, why)] = said(f"{DRUM.replace('M g r/2', 'M g r')}\n{CART}")
    assert what == "The weight of particle 'hook' stands with twice its value: -M*g*r should be -M*g*r/2."
    assert "½ is lost" in why


def test_a_weight_that_stands_in_two_terms_is_counted_twice() -> None:
    [(what, _)] = said(f"{DRUM.replace('M g r/2', 'M g r/2 - M g r/2')}\n{CART}")
    assert "twice" in what and "twice its value" not in what


@pytest.mark.parametrize(("load", "should"), [("2 L b", "L b"), ("L (2 b)", "L b")])
def test_a_force_at_twice_its_arm_is_not_counted_twice(load: str, should: str) -> None:
    sys = System("lever")
    phi = sys.coordinates("phi")
    J, b = sys.parameters("J b")
    L = sys.inputs("L")
    sys.rigid_body(0, J, at=sys.origin, frame=sys.frame(phi, name="bar"), name="bar")
    sys.force((0, L), at=sys.point("E", (b * cos(phi), b * sin(phi))), name="load")
    lever = sys.derive()
    assert lever.check(f"J phi'' = {should} cos(phi)").right
    for answer in (f"J phi'' = {load} cos(phi)", f"T = 1/2 J phi'^2\nV = 0\nXi = {load} cos(phi)"):
        [mistake] = lever.check(answer).mistakes
        assert "twice its value" in str(mistake.what) or "factor" in str(mistake.what), str(mistake.what)
        assert "counted twice" not in str(mistake.what) and "in V" not in str(mistake.why)
    [mistake] = lever.check(f"J phi'' = {should} cos(phi) + {should} cos(phi)").mistakes
    assert "is counted twice" in str(mistake.what)


def test_a_ratio_without_its_half_is_told_by_the_bracket() -> None:
    [(what, _)] = said(f"{DRUM}\n{CART.replace('k (x - r phi/2)', 'k (x - r phi)')}")
    assert what == "In line 2, k*(-r*phi + x) stands where k*(-r*phi/2 + x) belongs."


@pytest.mark.parametrize(
    ("right", "wrong", "told"),
    [
        ("1/2 b x'^2", "b x'^2", "The ½ of damper 'wheels' in D is missing."),
        ("1/2 c phi'^2", "c phi'^2", "The ½ of damper 'bearing' in D is missing."),
    ],
)
def test_the_half_of_a_damper_is_missing(right: str, wrong: str, told: str) -> None:
    [(what, _)] = said(ENERGIES.replace(right, wrong) + f"{DRUM}\n{CART}")
    assert what == told
    both = ENERGIES.replace(right, wrong).replace("-M g r phi/2", "M g r phi/2") + f"{DRUM}\n{CART}"
    words = [w for w, _ in said(both)]
    assert told in words, words


def test_half_a_damper_is_told_without_energies() -> None:
    [(what, why)] = said(f"{DRUM.replace('c phi', 'c/2 phi')}\n{CART}")
    assert what == "Damper 'bearing' stands with half its value: c*phi'/2 should be c*phi'."
    assert "D " not in why and "Ξ" not in why


@cache
def guided() -> Derivation:
    """A bar on a hinge, and one with its centre at (2 l cos φ, ½ l sin φ) that turns the other way."""
    sys = System("guided")
    phi = sys.coordinates("phi")
    m, l, k, g, p = sys.parameters("m l k g p")
    for name, x, angle in (("first", l / 2 * cos(phi), phi), ("second", 2 * l * cos(phi), -phi)):
        at = sys.point(f"G_{name}", (x, l / 2 * sin(phi)))
        sys.rigid_body(m, m * l**2 / 12, at=at, frame=sys.frame(angle, name=name), name=name)
    sys.gravity((0, -1), g)
    sys.spring(k, deflection=2 * l * cos(phi), rest=p, name="rubber")
    return sys.derive()


GUIDED = """(2/3 m l^2 + 15/4 m l^2 sin(phi)^2) phi'' + 15/4 m l^2 sin(phi) cos(phi) phi'^2 + m g l cos(phi)
  - 2 k l sin(phi) (2 l cos(phi) - p) = 0"""


@pytest.mark.slow
def test_a_wrong_number_is_told_as_it_stands_and_no_sign_is_blamed() -> None:
    assert guided().check(GUIDED).right
    both = GUIDED.replace("2/3", "1/6").replace("- 2 k", "+ 2 k")
    verdict = guided().check(both)
    words = [str(m.what) for m in verdict.mistakes]
    assert "What spring 'rubber' adds to the equations has the wrong sign." in words
    assert "The term l^2*m*phi''/6 of the equation of phi should be 2*l^2*m*phi''/3." in words, words


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        (
            "15/4 m l^2 sin(phi) cos(phi) phi'",
            "In the term 15*l^2*m*sin(phi)*cos(phi)*phi'/4 of the equation of phi, phi' stands once, and belongs there "
            "squared.",
        ),
        (
            "15/4 m l^2 sin(phi)^2 phi'^2",
            "In the term 15*l^2*m*sin(phi)^2*phi'^2/4 of the equation of phi, sin(phi) stands in place of cos(phi).",
        ),
    ],
)
def test_a_term_is_quoted_as_it_was_written(wrong: str, told: str) -> None:
    verdict = guided().check(GUIDED.replace("15/4 m l^2 sin(phi) cos(phi) phi'^2", wrong))
    assert str(verdict.mistakes[0].what) == told
    drum = DRUM.replace("M g r/2", "M g r/2 phi'")
    words = [str(m.what) for m in capstan().check(f"{drum}\n{CART}").mistakes]
    assert not any(x.startswith("In the term") and "phi'" not in x.split(" of the ")[0] for x in words), words


def test_a_torque_through_a_gear_lacks_no_damper_that_stands_in_the_equation() -> None:
    """The ratio in it is also that of the damper."""
    sys = System("gear")
    phi = sys.coordinates("phi")
    J, n, c = sys.parameters("J n c")
    tau = sys.inputs("tau")
    sys.kinetic(J * (n * phi.diff()) ** 2 / 2, name="wheel")
    sys.damper(c, deflection=n * phi, name="bearing")
    sys.torque(tau, on=phi, name="motor")
    gear = sys.derive()
    answer = "Xi = {}\nJ n^2 phi'' + c n^2 phi' = Xi"
    assert gear.check(answer.format("tau")).right
    verdict = gear.check(answer.format("n tau"))
    elements = {o.element for f in verdict.open_findings for d in f.differences for o in d.origins}
    assert not verdict.right and elements == {"torque 'motor'"}
