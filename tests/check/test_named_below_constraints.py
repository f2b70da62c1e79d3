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
        "The multiplier lambda stands with the factor 2*a in the equation of x; beside the others"
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
