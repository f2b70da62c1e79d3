"""Terms that differ are told as they were written, against the right ones, in the scale of what was written.

Oracle: equations by hand of a cylinder in a turning drum, of a sleeve on a tilted arm, and of three masses.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg

DRUM = "J psi'' + m R (R psi'' - (R - r) phi'')/2 + b psi' = M"


@cache
def drum() -> lg.Derivation:
    """A cylinder rolls in a drum that turns."""
    s = lg.System("drum")
    psi, phi = s.coordinates("psi phi")
    J, R, r, m, b, g = s.parameters("J R r m b g")
    s.kinetic(J * psi.diff() ** 2 / 2)
    s.kinetic(m * (R - r) ** 2 * phi.diff() ** 2 / 2 + m * (R * psi.diff() - (R - r) * phi.diff()) ** 2 / 4)
    s.potential(-m * g * (R - r) * sp.cos(phi))
    s.damper(b, deflection=psi)
    s.torque(s.input("M"), on=psi)
    return s.derive()


@cache
def sleeve() -> lg.Derivation:
    """A sleeve on a tilted arm that turns, and a mass that hangs on it by a spring."""
    s = lg.System("sleeve")
    psi, x, y = s.coordinates("psi x y")
    J, m, n, e, a, k, c, b = s.parameters("J m n e alpha k c b")
    radius = e + x * sp.cos(a)
    s.kinetic(J * psi.diff() ** 2 / 2 + m * (x.diff() ** 2 + radius**2 * psi.diff() ** 2) / 2 + n * y.diff() ** 2 / 2)
    s.spring(k, deflection=x, name="inner")
    s.spring(c, deflection=y - x, name="outer")
    s.damper(b, deflection=y - x, name="between")
    s.torque(s.input("tau"), on=psi)
    return s.derive()


def told(derivation: lg.Derivation, answer: str) -> list[str]:
    """The entries of the list, each without its origin."""
    verdict = derivation.check(answer)
    assert not verdict.right
    _, _, found = " ".join(verdict.to_text().split()).partition("Term by term ")
    return [x.split(". ")[0].rstrip(".") for x in found.lstrip("─ ").split("line ")[1:]]


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("row", "said"),
    [
        ("3 (R - r) phi''/2 - R psi''/2 + g sin(phi)/2 = 0", "½ g sin φ should be g sin φ"),
        ("(R - r) phi'' - (R psi'' - (R - r) phi'')/2 + m g sin(phi) = 0", "m g sin φ should be g sin φ"),
        ("3 m (R - r) phi''/2 - R psi''/2 + m g sin(phi) = 0", "−½ R ψ̈ should be −½ m R ψ̈"),
        ("3 m R^2 phi''/2 - m R (R - r) psi''/2 + m g (R - r) sin(phi) = 0", "should be (3/2) m (R − r)² φ̈"),
    ],
)
def test_the_scale_is_the_one_in_which_most_terms_are_right(row: str, said: str) -> None:
    (found,) = told(drum(), f"{DRUM}\n{row}")
    assert found.startswith("2: ") and said in found


ARM = "(J + m (e + x cos(alpha))^2) psi'' + 2 m (e + x cos(alpha)) cos(alpha) psi' x' = tau"
SLIDE = "m x'' - m (e + x cos(alpha)) cos(alpha) psi'^2 + k x - c (y - x) - b (y' - x') = 0"
LOAD = "n y'' + c (y - x) + b (y' - x') = 0"


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("right", "wrong", "said"),
    [
        (" cos(alpha) psi'^2", " psi'^2", ["2: −m (e + x cos α) ψ̇² should be −m (e + x cos α) ψ̇² cos α"]),
        ("2 m (e + x cos(alpha)) cos(alpha) psi' x'", "0", ["1: the term 2 m (e + x cos α) ψ̇ ẋ cos α is missing"]),
        ("- c (y - x) - b", "+ c (y - x) - b", ["2: c (y − x) has the wrong sign"]),
        ("- c (y - x) - b", "+ c x - b", ["2: the term −c y is missing"]),
        (
            "k x - c (y - x) - b (y' - x')",
            "k x",
            ["2: the term c (x − y) is missing", "2: the term b (ẋ − ẏ) is missing"],
        ),
        ("c (y - x) + b (y' - x') = 0", "c (y - x) + b y = 0", ["3: b y should be −b (ẋ − ẏ)"]),
    ],
)
def test_terms_are_those_that_were_written(right: str, wrong: str, said: list[str]) -> None:
    answer = f"{ARM}\n{SLIDE}\n{LOAD}"
    assert right in answer
    assert sorted(told(sleeve(), answer.replace(right, wrong))) == sorted(said)


def test_a_square_is_told_as_another_square() -> None:
    energy = "T = J psi'^2/2 + m (R - r)^2 phi'^2/2 + m (R psi' - r phi')^2/4"
    assert told(drum(), energy) == ["1 (T*): ¼ m (R ψ̇ − r φ̇)² should be ¼ m (R ψ̇ − (R − r) φ̇)²"]


def test_of_several_terms_with_the_same_letters_the_odd_one_is_told() -> None:
    arm = "T = J psi'^2/2 + n y'^2/2 + m (x'^2 + (e + x cos(alpha))^2 psi'^2)/2 + m x'^2/8"
    assert told(sleeve(), arm) == ["1 (T*): the term ⅛ m ẋ² does not belong there"]
    assert told(sleeve(), arm.replace("m (x'^2 +", "m (x'^2/2 +")) == ["1 (T*): ⅛ m ẋ² should be ¼ m ẋ²"]


def test_a_part_of_a_product_is_told_alone() -> None:
    row = "m (R - r) (3 (R - r) phi''/2 - R psi''/2 + g sin(phi) + R psi' phi') = 0"
    assert told(drum(), f"{DRUM}\n{row}") == ["2: the term m R (R − r) ψ̇ φ̇ does not belong there"]


def test_an_energy_in_two_forms_is_told_once() -> None:
    square = "m (R psi' - (R - r) phi')^2/4"
    forms = f"T = J psi'^2/2 + m (R - r)^2 phi'^2 + {square} = (J + m R^2/2) psi'^2/2 + 5 m (R - r)^2 phi'^2/4"
    assert told(drum(), f"{forms} - m R (R - r) psi' phi'/2") == ["1 (T*): m (R − r)² φ̇² should be ½ m (R − r)² φ̇²"]


def test_the_equations_of_a_matrix_are_named() -> None:
    rows = "M = [[J + m R^2/2, -m R (R - r)/2], [-m R (R - r)/2, m (R - r)^2]]\nM [psi''; phi''] = [M - b psi'; 0]"
    rows = rows.replace("M = ", "A = ").replace("M [", "A [").replace("; 0]", "; m g (R - r) sin(phi)]")
    found = told(drum(), rows)
    assert found == [
        "1: m (R − r)² should be (3/2) m (R − r)²",
        "2, the equation of φ, on the right-hand side: m g (R − r) sin φ has the wrong sign",
    ]


@cache
def mast() -> lg.Derivation:
    """Two balls on a boom that leans from a mast, and a damper across it."""
    s = lg.System("mast")
    psi, theta = s.coordinates("psi theta")
    J, m, n, e, a, b, d = s.parameters("J m n e a b d")
    for mass, arm in ((m, a), (n, b)):
        out = e + arm * sp.cos(theta)
        s.kinetic(mass * (arm**2 * theta.diff() ** 2 + out**2 * psi.diff() ** 2) / 2)
    s.kinetic(J * psi.diff() ** 2 / 2)
    s.damper(d, deflection=a * sp.sin(theta))
    return s.derive()


BOOM = "(m a^2 + n b^2) theta'' + (m a (e + a cos(theta)) + n b (e + b cos(theta))) sin(theta) psi'^2"
MAST = "(J + m (e + a cos(theta))^2 + n (e + b cos(theta))^2) psi''"
MAST += " - 2 (m a (e + a cos(theta)) + n b (e + b cos(theta))) sin(theta) psi' theta' = 0"
SUM = "(m a (e + a cos θ) + b n (e + b cos θ))"
ACROSS = " + d a^2 cos(theta)^2 theta' = 0"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong", "said"),
    [
        ("+ (m a (", "- (m a (", f"−{SUM} ψ̇² sin θ has the wrong sign"),
        (
            "sin(theta) psi'^2",
            "cos(theta) psi'^2",
            f"ψ̇² cos θ should be {SUM} ψ̇² sin θ",
        ),
        (
            "sin(theta) psi'^2",
            "sin(theta) psi'^2/2",
            f"½ {SUM} ψ̇² sin θ should be {SUM} ψ̇² sin θ",
        ),
        ("cos(theta)^2 theta'", "theta'", "a² d θ̇ should be a² d θ̇ cos²θ"),
    ],
)
def test_what_belongs_there_has_the_form_of_what_was_written(right: str, wrong: str, said: str) -> None:
    answer = f"{MAST}\n{BOOM}{ACROSS}"
    assert mast().check(answer).right
    (found,) = told(mast(), answer.replace(right, wrong))
    assert found.startswith("2: ") and said in found, found


def test_a_slope_of_the_energies_is_told_by_what_each_element_adds() -> None:
    """Without the inner derivative −½ R of the spring's deflection; the weight of the block is right."""
    s = lg.System("hoist")
    theta, x = s.coordinates("theta x")
    J, R, M, m, k, g = s.parameters("J R M m k g")
    s.kinetic((J + M * R**2 / 4) * theta.diff() ** 2 / 2 + m * x.diff() ** 2 / 2)
    s.potential(-M * g * R * theta / 2 - m * g * x)
    s.spring(k, deflection=x - R * theta / 2)
    row = "(J + M R^2/4) theta'' - M g R/2 - k (x - R theta/2) = 0\nm x'' - m g + k (x - R theta/2) = 0"
    found = told(s.derive(), f"∂L/∂theta = M g R/2 + k (x - R theta/2)\n{row}")
    assert found == ["1 (∂ℒ/∂ξ of θ): k (x − ½ R θ) should be ½ k R (x − ½ R θ)"]
