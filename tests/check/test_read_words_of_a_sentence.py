"""Words of a sentence in front of a definition, and words of a direction behind a formula, are no products.

Oracle: a bar that a crank moves, y = r cos φ, with J φ″ + m r² sin φ (φ″ sin φ + φ′² cos φ) + b r² φ′ sin²φ =
m g r sin φ, of which the letters b, a, r, m spell bar and arm; two drums with a weight between them, which hangs at
(r α − r β)/2.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.reading.prose.changing_words import changing_words

MOTION = "(J + m r² sin²φ)φ'' + m r² sin φ cos φ φ'² - m g r sin φ + b r² sin²φ φ' = 0"
DRUMS = "J alpha'' + r/2 (m y'' + k y - m g) = 0\nJ beta'' - r/2 (m y'' + k y - m g) = 0"


@cache
def crank() -> lg.Derivation:
    s = lg.System("crank with a bar")
    phi = s.coordinate("phi")
    m, r, _a, b, J, _k, g, _M = s.parameters("m r a b J k g M")
    s.particle(m, at=s.point("B", (0, r * sp.cos(phi))), name="bar")
    s.kinetic(J * phi.diff() ** 2 / 2, name="crank")
    s.gravity((0, -1), g)
    s.damper(b, deflection=r * sp.cos(phi), name="guide")
    return s.derive()


@cache
def drums() -> lg.Derivation:
    s = lg.System("two drums with a weight between them")
    alpha, beta = s.coordinates("alpha beta")
    m, J, r, k, g = s.parameters("m J r k g")
    for name, angle in (("left", alpha), ("right", beta)):
        s.kinetic(J * angle.diff() ** 2 / 2, name=f"{name} drum")
    s.particle(m, at=s.point("D", (0, -(r * alpha - r * beta) / 2)), name="weight")
    s.gravity((0, -1), g)
    s.spring(k, deflection=(r * alpha - r * beta) / 2)
    return s.derive()


LEADS = [
    "position of the bar     {}",
    "position of the bar {}",
    "at the bar {}",
    "from the arm {}",
    "the bar's height {}",
    "height of the bar: {}",
    "bar position {}",
    "crank arm: {}",
    "{} for the bar",
    "{}           needle bar",
    "am Arm {}",
]


@pytest.mark.parametrize("lead", LEADS)
def test_words_of_a_sentence_are_not_split(lead: str) -> None:
    verdict = crank().check(f"{lead.format('y = r cos φ')}\nT = ½ J φ'² + ½ m y'²\n{MOTION}")
    told = verdict.to_text()
    assert verdict.right and "b a r" not in told and "a r m" not in told, told


@pytest.mark.sampled(4)
@pytest.mark.parametrize("lead", LEADS)
def test_a_wrong_definition_behind_them_is_told(lead: str) -> None:
    verdict = crank().check(f"{lead.format('y = r sin φ')}\nT = ½ J φ'² + ½ m y'²\n{MOTION}")
    told = verdict.to_text()
    assert not verdict.right and "the y coordinate of the bar" in told.replace("particle 'bar'", "the bar"), told
    assert "b a" not in told


@pytest.mark.parametrize("product", ["mgr", "mrg", "rmg"])
def test_products_that_stand_in_mathematics_stay_products(product: str) -> None:
    answer = f"With the {product} term of the weight:\n{MOTION.replace('m g r', product)}"
    assert crank().check(answer).right
    assert not crank().check(answer.replace(product + " sin", "2" + product + " sin")).right


def test_a_word_with_letters_of_the_system_is_a_product_in_a_formula() -> None:
    s = lg.System("mass with a weight")
    x = s.coordinate("x")
    m, g, a, r = s.parameters("m g a r")
    s.kinetic(m * x.diff() ** 2 / 2, name="mass")
    s.generalized_force(x, m * g * a * r, name="weight")
    right = s.derive().check("We move the arm term: x'' m = mgar\nof the mgar term")
    assert right.right


DIRECTIONS = [
    "down",
    "upwards",
    "to the right",
    "uphill",
    "left",
    "inwards",
    "counter-clockwise",
    "down the slope",
    "pointing down",
    "nach unten",
    "vers le bas",
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("way", DIRECTIONS)
def test_words_of_a_direction_behind_a_formula_are_no_factors(way: str) -> None:
    verdict = drums().check(f"Weight: y = (r alpha - r beta)/2 {way}, omega = (r alpha' + r beta')/2.\n{DRUMS}")
    assert verdict.right and way not in verdict.to_text()
    assert drums().check(f"y = r/2 (alpha - beta) {way}\n{DRUMS}").right
    wrong = drums().check(f"y = r (alpha - beta) {way}\n{DRUMS}")
    assert not wrong.right and way not in wrong.to_text()


@pytest.mark.sampled(4)
@pytest.mark.parametrize("way", [r"\text{ down}", r"\quad\text{to the right}", r"\;\text{upwards},"])
def test_words_of_a_direction_in_latex(way: str) -> None:
    rows = r"\[J \ddot\alpha + \frac r2 P = 0\]\[J \ddot\beta - \frac r2 P = 0\]\[P = m \ddot y + k y - m g\]"
    assert drums().check(rf"\[y = \frac{{r\alpha - r\beta}}{{2}} {way}\]{rows}").right
    assert not drums().check(rf"\[y = \frac{{r\alpha - r\beta}}{{3}} {way}\]{rows}").right


def test_a_name_that_is_a_word_of_a_direction_is_a_factor() -> None:
    s = lg.System("mass on a spring")
    x = s.coordinate("x")
    m, down = s.parameters("m down")
    s.kinetic(m * x.diff() ** 2 / 2, name="mass")
    s.spring(down, deflection=x, name="spring")
    assert s.derive().check("m x'' = -x down").right
    assert not s.derive().check("m x'' = -x").right


def test_long_texts_of_such_words_are_read() -> None:
    assert crank().check("at the bar of the arm " * 1500 + f"\n{MOTION}").right
    assert not crank().check("y = r cos φ " + "down " * 5000 + f"\n{MOTION}").mistakes


def test_rolling_without_slipping_changes_no_equation() -> None:
    for words in ("rolling without slipping", "(without sliding)", "it rolls, without skidding"):
        assert not [*changing_words(f"u = R theta is the way of the disc {words}")]
    assert [*changing_words("m x'' = F, without the weight")]
