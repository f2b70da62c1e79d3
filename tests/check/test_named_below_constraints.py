"""Lines with a multiplier below the constraint: which are right, which are wrong, and which only follow."""

import pytest
import sympy as sp

import lagrangian as lg


@pytest.fixture(scope="module")
def bead() -> lg.Derivation:
    """A bead on a parabolic wire that is fixed to a cart."""
    s = lg.System("bead on a wire")
    X, x, y = s.coordinates("X x y")
    M, m, a, F = *s.parameters("M m a"), s.inputs("F")
    s.particle(M, at=s.point("A", (X, 0)), name="cart")
    s.particle(m, at=s.point("B", (X + x, y)), name="bead")
    s.gravity()
    s.force(F, deflection=X, name="pull")
    s.constraint(y - a * x**2, name="wire")
    return s.derive()


CART = "(M + m) X'' + m x'' = F"
BEAD = "m X'' + m x'' = -2 a x λ"
ELIMINATED = f"""{CART}
{BEAD}
m y'' + m g = λ
y = a x^2, y' = 2 a x x', y'' = 2 a x'^2 + 2 a x x''
λ = m g + 2 m a x'^2 + 2 m a x x''
m X'' + m x'' + 2 a x (m g + 2 m a x'^2 + 2 m a x x'') = 0"""


@pytest.mark.slow
def test_a_multiplier_that_is_eliminated_follows_from_the_constraint(bead: lg.Derivation) -> None:
    """λ = … below the equation with λ is what follows from it, and no definition that is put in above."""
    right = bead.check(ELIMINATED)
    assert right.right and str(right.findings[-2].note) == "the force of the constraint"
    verdict = bead.check(ELIMINATED.replace("2 a x'^2 + ", "").replace("2 m a x'^2 + ", ""))
    (mistake,) = verdict.mistakes
    assert str(mistake.what).startswith("Line 4 is not the second derivative of constraint 'wire'")
    wrong = [(f.line.number, f.follows) for f in verdict.findings if not f.status.right]
    assert wrong == [(4, False), (5, True), (6, True)]
    slip = bead.check(ELIMINATED.replace("λ = m g +", "λ = 2 m g +"))
    assert [f.line.number for f in slip.findings if not f.status.right and not f.follows] == [5]


def test_a_multiplier_takes_up_no_mistake_of_the_line_that_comes_first(bead: lg.Derivation) -> None:
    verdict = bead.check(f"{CART}\nm x'' = -2 a λ\nm y'' + m g = λ\ny = a x^2")
    assert [f.status.right for f in verdict.findings] == [True, False, True, True]
    told = [str(m.what) for m in verdict.mistakes]
    assert told[0] == "X'' is missing in the equation of x." and len(told) == 2
    assert told[1].startswith(
        "The multiplier lambda stands with the factor -2*a in the equation of x; to fit the others"
    )


@pytest.fixture(scope="module")
def strut() -> lg.Derivation:
    """A roller on a floor and a collar on an inclined guide, joined by a strut."""
    s = lg.System("strut")
    x, u = s.coordinates("x u")
    m, M, el, beta, F = *s.parameters("m M l beta"), s.inputs("F")
    a = s.point("A", (x, 0))
    b = s.point("B", (u * sp.cos(beta), u * sp.sin(beta)))
    s.particle(m, at=a, name="roller")
    s.particle(M, at=b, name="collar")
    s.gravity()
    s.force(F, deflection=x, name="pull")
    s.constraint(distance=el, between=(a, b), name="strut")
    return s.derive()


STRUT = """f = x^2 + u^2 + 2 x u cos(beta) - l^2
m x'' - 2 λ (x + u cos(beta)) = F
M u'' + M g sin(beta) - 2 λ (u + x cos(beta)) = 0
x^2 + u^2 + 2 x u cos(beta) = l^2"""


@pytest.mark.slow
def test_the_wrong_term_of_a_squared_distance_is_named(strut: lg.Derivation) -> None:
    right = STRUT.replace("+ 2 x u", "- 2 x u").replace("x + u cos", "x - u cos").replace("u + x cos", "u - x cos")
    assert strut.check(right).right
    verdict = strut.check(STRUT)
    (mistake,) = verdict.mistakes
    assert str(mistake.what) == (
        "Line 1 is not constraint 'strut': the term 2*u*x*cos(beta) has the wrong sign. "
        "The factors of the multiplier follow from it."
    )
    assert [(f.line.number, f.status.right, f.follows) for f in verdict.findings] == [
        (1, False, False), (2, False, True), (3, False, True), (4, False, True)
    ]  # fmt: skip
    assert not verdict.notes
    chain = strut.check(STRUT.replace("l^2\nm x''", "l^2 = 0\nm x''"))
    assert [f.line.number for f in chain.findings] == [1, 2, 3, 4] and chain.mistakes == verdict.mistakes


def test_the_number_of_a_term_of_the_second_derivative_is_named(strut: lg.Derivation) -> None:
    rows = "m x'' = F + λ (x - u cos(beta))\nM u'' + M g sin(beta) = λ (u - x cos(beta))\n"
    last = "x'' (x - u cos(beta)) + u'' (u - x cos(beta)) + x'^2 + u'^2 - 2 x' u' cos(beta) = 0"
    assert strut.check(rows + last).right
    (mistake,) = strut.check(rows + last.replace("- 2 x'", "- x'")).mistakes
    assert str(mistake.what) == (
        "Line 3 is not the second derivative of constraint 'strut': in the term -cos(beta)*u'*x', the factor 2 "
        "is missing."
    )


@pytest.mark.slow
def test_a_wrong_relation_of_virtual_displacements_is_the_mistake(strut: lg.Derivation) -> None:
    """What is reduced with it follows; another sign that is right stays right."""
    lines = """virtual displacements: (x - u cos(beta)) dx + (u - x cos(beta)) du = 0
so du = dx (x - u cos(beta))/(u - x cos(beta))
(F - m x'') (u - x cos(beta)) - (M u'' + M g sin(beta)) (x - u cos(beta)) = 0"""
    verdict = strut.check(lines)
    (mistake,) = verdict.mistakes
    assert str(mistake.what) == (
        "Line 2 does not hold for the virtual displacements that constraint 'strut' allows: "
        "what multiplies δx has the wrong sign beside what multiplies δu."
    )
    assert [(f.status.right, f.follows) for f in verdict.findings] == [(True, False), (False, False), (False, True)]
    right = lines.replace("du = dx", "du = -dx").replace("- (M u''", "+ (M u''")
    assert strut.check(right).right
    other = strut.check(lines.replace("(F - m x'')", "(F - 2 m x'')"))
    assert [f.line.number for f in other.findings if not f.status.right and not f.follows] == [2, 3]


def test_a_wrong_term_of_virtual_displacements_is_named(strut: lg.Derivation) -> None:
    lines = """(x - u cos(beta)) δx + (u + x cos(beta)) δu = 0
(F - m x'') (u + x cos(beta)) + (M u'' + M g sin(beta)) (x - u cos(beta)) = 0"""
    verdict = strut.check(lines)
    assert "x*cos(beta)*u' has the wrong sign" in str(verdict.mistakes[0].what), verdict.mistakes[0].what
    assert [(f.status.right, f.follows) for f in verdict.findings] == [(False, False), (False, True)]


@pytest.fixture(scope="module")
def press() -> lg.Derivation:
    """A knee at the angle alpha drives a ram at the depth y = 2 l cos alpha; a rack and its pinion stand beside it."""
    s = lg.System("press")
    alpha, x, y = s.coordinates("alpha x y")
    I, M, l_, d, m, J, R, k = s.parameters("I M l d m J R k")
    P = s.inputs("P")
    s.kinetic(I * alpha.diff() ** 2 / 2, name="knee")
    s.particle(M, at=s.point("ram", (0, -y)), name="ram")
    s.particle(m, at=s.point("C", (x, 0)), name="rack")
    s.kinetic(J * x.diff() ** 2 / (2 * R**2), name="pinion")
    s.spring(k=k, deflection=x - l_ * sp.sin(alpha), name="spring")
    s.gravity()
    s.damper(b=d, deflection=y, name="guide")
    s.force(-P, deflection=y, name="work")
    s.constraint(y - 2 * l_ * sp.cos(alpha), name="lower end")
    return s.derive()


PUT_IN = """(I + 4 M l^2 sin(alpha)^2) alpha'' + 4 M l^2 sin(alpha) cos(alpha) alpha'^2 + 4 d l^2 sin(alpha)^2 alpha' \
+ 2 M g l sin(alpha) - k l cos(alpha) (x - l sin(alpha)) = 2 P l sin(alpha)
(m + J/R^2) x'' + k (x - l sin(alpha)) = 0"""


@pytest.mark.slow
def test_what_is_reduced_with_a_wrong_rate_follows(press: lg.Derivation) -> None:
    rate = "y' = -2 l sin(alpha) alpha', δy = -2 l sin(alpha) δalpha"
    assert press.check(f"{rate}\n{PUT_IN}").right
    half = PUT_IN.replace("4 M", "M").replace("4 d", "d").replace("2 M", "M").replace("2 P", "P")
    verdict = press.check(f"{rate.replace('2 l', 'l')}\n{half}")
    told = [str(m.what) for m in verdict.mistakes]
    assert len(told) == 1 and told[0].startswith("Line 1 is not the first derivative of constraint 'lower end'")
    assert all(f.status.right or f.follows or f.line.number == 1 for f in verdict.findings)
    other = press.check(f"{rate.replace('2 l', 'l')}\n{half.replace('P l', 'P')}")
    assert [f.line.number for f in other.findings if not f.status.right and not f.follows] == [1, 2]


def test_what_is_reduced_with_a_wrong_acceleration_follows(press: lg.Derivation) -> None:
    start = "y = 2 l cos(alpha), y' = -2 l sin(alpha) alpha'\ny'' = -2 l sin(alpha) alpha''\n"
    verdict = press.check(start + PUT_IN.replace("+ 4 M l^2 sin(alpha) cos(alpha) alpha'^2 ", ""))
    assert [f.line.number for f in verdict.findings if not f.status.right and not f.follows] == [2]
    assert [f.line.number for f in verdict.findings if f.follows] == [3]


def test_names_of_multipliers_and_angles_are_no_products(press: lg.Derivation) -> None:
    """lambda is no l a m b d a, al is alpha, and K of positions alone is a force."""
    rows = """K = k (x - l sin(al))
I al'' - K l cos(al) = 2 l sin(al) lambda
(m + J/R^2) x'' + K = 0
M y'' - M g + P + d y' = lambda"""
    verdict = press.check(rows)
    assert verdict.right and not any("Products" in str(n) for n in verdict.notes)
    wrong = press.check(rows.replace("- M g", "+ M g"))
    assert [f.line.number for f in wrong.findings if not f.status.right] == [4]


def test_a_pinion_beside_its_rack_is_part_of_a_sum(press: lg.Derivation) -> None:
    said = "T_rack = (m + J/R^2) x'^2/2\nT_ram = M y'^2/2\n"
    wrong = PUT_IN.replace("+ k (x", "- k (x")
    assert not any(f.line.kind == "definition" and not f.status.right for f in press.check(said + wrong).findings)
    bad = press.check(said.replace("J/R^2", "J/R") + wrong)
    assert [f.line.number for f in bad.findings if f.line.kind == "definition" and not f.status.right] == [1]
