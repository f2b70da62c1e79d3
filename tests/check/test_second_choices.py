"""Second choices are told where they may be true and say something else; elements are called as a student knows them.

Oracle: by hand. A lever turned by θ, with a bob on it and a spring, on a carriage at x:

    T = ½ J θ̇² + ½ m (ẋ² − 2 R ẋ θ̇ sin θ + R² θ̇²),     V = ½ k a² sin²θ + m g R sin θ,     Ξ_θ = F l
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp
from sympy import cos, sin

from lagrangian import CheckedAnswer, Derivation, System
from lagrangian.check import AnsweredLine, Finding, Mistake, Status, TermDifference, Verdict
from lagrangian.check.explain.second_choices import fitting
from lagrangian.page.formula import text

KINETIC = "T = J theta'^2/2 + m (x'^2 - 2 R x' theta' sin(theta) + R^2 theta'^2)/2\n"
POTENTIAL = "V = k a^2 sin(theta)^2/2 + m g R sin(theta)\n"
OF_ANGLE = "(J + m R^2) theta'' - m R x'' sin(theta) + k a^2 sin(theta) cos(theta) + m g R cos(theta) = F l\n"
OF_CARRIAGE = "m x'' - m R theta'' sin(theta) - m R theta'^2 cos(theta) = 0\n"
m, m_u, i, x = sp.symbols("m m_u i x")


@cache
def lever() -> Derivation:
    """A lever with a bob and a spring on a carriage."""
    sys = System("lever")
    theta, along = sys.coordinates("theta x")
    J, k, a, l, mass, g, R = sys.parameters("J k a l m g R")
    sys.kinetic(J * theta.diff() ** 2 / 2, name="reel")
    sys.spring(k, deflection=a * sin(theta), name="return spring")
    sys.force(sys.input("F"), deflection=l * theta, name="push")
    sys.particle(mass, at=sys.point("P", (along + R * cos(theta), R * sin(theta))), name="bob")
    sys.gravity(direction=(0, -1), g=g)
    return sys.derive()


def checked(answer: str) -> CheckedAnswer:
    """The verdict on an answer for the lever."""
    return lever().check(answer)


def mistake(name: str, element: str | None, *words: object, step: int = 5) -> Mistake:
    """A mistake with some words."""
    return Mistake(name, text(*words), text("."), step, element)  # type: ignore[arg-type]


def others(told: Mistake, more: Mistake, *findings: Finding) -> list[str]:
    """The names of the second choices that are left."""
    return [m.name for m in fitting(Verdict(Status.WRONG, findings, (told,), (more,))).alternatives]


def test_right_answer() -> None:
    """The lines of this module."""
    assert checked(KINETIC + POTENTIAL + OF_ANGLE + OF_CARRIAGE).right


@pytest.mark.slow
def test_sign_of_a_product_of_functions() -> None:
    """The sign of k a² sin θ cos θ: exchanging both functions changes nothing."""
    found = checked(OF_ANGLE.replace("+ k a^2", "- k a^2") + OF_CARRIAGE)
    assert not found.right
    assert found.mistakes[0].name == "spring_sign"
    assert found.alternatives == ()


def test_same_letters() -> None:
    """m for m_u in an equation, and in one of its terms."""
    told = mistake("letter", None, "In the terms with ", x, ", ", m, " stands in place of ", m_u, ".")
    again = mistake("letter", "particle 'ball'", "In the term ", m_u * x**2, ", ", m, " stands in place of ", m_u, ".")
    assert others(told, again) == []
    assert others(told, mistake("letter", None, "In ", x, ", ", i, " stands in place of ", x, ".")) == ["letter"]


def test_factor_that_is_missing() -> None:
    """The factor i of a torque, in one equation and in Ξ; of another torque it is another mistake."""
    words = ("In what the torque adds, the factor ", i, " is missing.")
    assert others(mistake("force_arm", "torque 'grass'", *words), mistake("lost", "torque 'grass'", *words)) == []
    assert others(mistake("force_arm", "torque 'a'", *words), mistake("lost", "torque 'b'", "No ", x, ".")) == ["lost"]


def test_nothing_is_written() -> None:
    """Where a term is missing, no sign and no function in it is wrong."""
    line = AnsweredLine("equation", x, 1)
    lacks = Finding(line, Status.WRONG, differences=(TermDifference("missing", x, sp.S.Zero, None),))
    turned = Finding(line, Status.WRONG, differences=(TermDifference("sign", x, -x, None),))
    told, sign = mistake("term_forgotten", None, "One."), mistake("wrong_sign", "spring", "Two ", m, ".")
    assert others(told, sign, lacks) == []
    assert others(told, sign, turned) == ["wrong_sign"]


def test_energy_that_is_right() -> None:
    """No mistake was made in T* if the line of T* is right."""
    told = mistake("spring_sign", "spring", "One.")
    other = mistake("half_forgotten", "bob", "The kinetic energy lacks ", m, ".", step=2)
    energy = AnsweredLine("T", x, 1)
    assert others(told, other, Finding(energy, Status.RIGHT)) == []
    assert others(told, other, Finding(energy, Status.WRONG)) == ["half_forgotten"]


def test_second_reason_in_a_right_line() -> None:
    """A second reason in the velocity is not told beside a right velocity."""
    said = (
        "Line 2 is wrong. A possible reason: one.",
        " Or: ",
        "In the velocity of the bob along y, ",
        x,
        " is wrong.",
    )
    line = AnsweredLine("definition", x, 1, "v")
    right = Finding(line, Status.RIGHT, text("the velocity of the bob"))
    found = fitting(Verdict(Status.WRONG, (right,), (mistake("speed", None, *said),)))
    assert str(found.mistakes[0].what) == said[0]
    found = fitting(Verdict(Status.WRONG, (), (mistake("speed", None, *said),)))
    assert "Or: In the velocity" in str(found.mistakes[0].what)


def test_called_by_its_name() -> None:
    """An energy of a thing is called by its name alone."""
    found = checked(KINETIC.replace("J theta'^2/2", "J theta'^2") + POTENTIAL)
    assert "The kinetic energy of the reel counts twice." in found.to_text()
    assert "it concerns the reel." in found.to_text()


def test_one_of_two() -> None:
    """Two equal springs, of which one is missing, are called together."""
    sys = System("hung mass")
    y = sys.coordinates("y")
    mass, k = sys.parameters("m k")
    sys.particle(mass, at=sys.point("P", (0, y)))
    for name in ("left spring", "right spring"):
        sys.spring(k, deflection=y, name=name)
    said = sys.derive().check("T = 1/2 m y'^2\nV = 1/2 k y^2").to_text()
    assert "One of the springs 'left spring' and 'right spring' is missing." in said


def test_term_that_is_left_over() -> None:
    """Who forgets −∂T*/∂θ leaves a term over that the right equation does not have."""
    wrong = OF_ANGLE.replace("sin(theta) + k", "sin(theta) - m R x' theta' cos(theta) + k")
    found = checked(KINETIC + POTENTIAL + wrong + OF_CARRIAGE)
    assert not found.right
    said = str(found.mistakes[0].what)
    assert "is left over" in said
    assert "is missing. A possible reason" not in said


def test_lines_are_told_apart() -> None:
    """Names that are defined in one line are told in the table, and what stands below is not called above."""
    found = checked("x_P = x + R cos(theta), y_P = R sin(theta)\n" + KINETIC + POTENTIAL + OF_ANGLE + OF_CARRIAGE)
    assert "line 1 (x_P)" in found.to_text()
    below = OF_ANGLE.replace("J +", "2 J +") + KINETIC.replace("J theta'^2/2", "J theta'^2")
    below += POTENTIAL.replace("m g R sin", "m g R cos")
    assert "only because of the lines above" not in checked(below).to_text().partition("\nline 2")[0]
