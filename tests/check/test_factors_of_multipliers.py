"""Factors of a multiplier that do not fit each other: what words, a constraint or neither says of them."""

from __future__ import annotations

from functools import cache

import pytest
from sympy import cos, sin

from lagrangian import Derivation, System
from lagrangian.check.reading.said.senses import stated_senses


@cache
def wagon() -> Derivation:
    """A wagon on a slope, whose wheels a motor turns."""
    s = System("wagon on a slope")
    x = s.coordinate("x", description="wagon, up the slope")
    phi = s.coordinate("phi", description="wheels")
    M, J, R, alpha = s.parameters("M J R alpha")
    tau = s.input("tau")
    s.particle(M, at=s.point("P", (x * cos(alpha), x * sin(alpha))), name="wagon")
    s.kinetic(J * phi.diff() ** 2 / 2)
    s.gravity()
    s.torque(tau, on=phi)
    s.constraint(x - R * phi, name="no slip")
    return s.derive()


ALONG = "M x'' + M g sin(alpha) = lambda"
TURN = "J phi'' = tau - R lambda"
WRONG = TURN.replace("-", "+")


def findings(answer: str) -> list[bool]:
    return [f.status.right for f in wagon().check(answer).findings]


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("said", "right"),
    [
        ("Friction force lambda (uphill on the wagon).", [True, False]),
        ("lambda: friction force of the road, up the slope", [True, False]),
        ("The friction force lambda acts downhill on the wagon.", [False, True]),
        ("Reibungskraft lambda, hangaufwärts", [True, False]),
        ("lambda is the force on the road, downhill", [False, False]),
        ("lambda is what it is when the wagon rolls uphill.", [False, False]),
    ],
)
def test_words_say_which_sign_of_a_multiplier_is_wrong(said: str, right: list[bool]) -> None:
    assert findings(f"{said}\n{ALONG}\n{WRONG}") == right
    assert wagon().check(f"{said}\n{ALONG}\n{TURN}", hint=0).right


def test_of_two_lines_that_do_not_fit_neither_is_called_right() -> None:
    verdict = wagon().check(f"{ALONG}\n{WRONG}")
    (mistake,) = verdict.mistakes
    assert not verdict.right and [f.clash for f in verdict.findings] == ["line 2", "line 1"]
    assert "λ has the factor 1 in line 1, the equation of x, and R in line 2" in verdict.to_text().replace("\n", " ")
    assert str(mistake.what).endswith("the two are as 1 : -R: one of them has the wrong sign.")
    assert "Look at line 1, the equation of x, and line 2: they do not fit" in str(verdict)
    assert "not right together with line 2" in str(verdict) and "was read as" not in str(verdict)


@pytest.mark.slow
def test_a_constraint_says_which_factor_of_its_multiplier_is_wrong() -> None:
    rows = f"{ALONG}\n{TURN.replace('R ', '')}"
    assert findings(rows) == [False, False]
    assert findings(f"x' = R phi'\n{rows}") == [True, True, False]
    assert findings(f"phi' = x'/R\n{rows}") == [True, False, False]  # a force or a torque
    assert findings(f"x' = R phi'\n{ALONG}\n{WRONG}") == [True, False, False]  # its sign is a choice
    assert wagon().check(f"phi' = x'/R\n{ALONG}\n{TURN}", hint=0).right
    assert wagon().check(f"phi' = x'/R\n{ALONG.replace('lambda', 'lambda/R')}\n{TURN.replace('R ', '')}", hint=0).right


@pytest.mark.slow
def test_the_other_lines_say_which_sign_is_wrong() -> None:
    force = "lambda = (tau - J phi'')/R"
    assert findings(f"{ALONG}\n{WRONG}\n{force}")[:2] == [True, False]
    assert not wagon().check(f"{ALONG.replace('lambda', '-lambda')}\n{TURN}\n{force}", hint=0).right


@cache
def tractor() -> Derivation:
    """A tractor with a large and a small wheel."""
    s = System("tractor")
    x, phi, psi = s.coordinates("x phi psi")
    M, J, I, R, r = s.parameters("M J I R r")
    s.force((s.input("F"), 0), at=s.point("P", (x, 0)))
    s.kinetic((M * x.diff() ** 2 + J * phi.diff() ** 2 + I * psi.diff() ** 2) / 2)
    s.constraint(x - R * phi, name="large")
    s.constraint(x - r * psi, name="small")
    return s.derive()


@pytest.mark.slow
def test_of_several_multipliers_the_one_that_does_not_fit_is_told() -> None:
    rows = "M x'' = F + A - B\nJ phi'' = -R A\nI psi'' = r B"
    assert tractor().check(rows, hint=0).right
    verdict = tractor().check(rows.replace("= r B", "= -r B"))
    (mistake,) = verdict.mistakes
    assert [f.clash for f in verdict.findings] == ["line 3", "", "line 1"] and mistake.element == "constraint 'small'"
    assert "B has the factor -1 in line 1, the equation of x, and -r in line 3" in str(mistake.what)
    assert not tractor().check(rows.replace("- B", "+ B"), hint=0).right


@pytest.mark.parametrize(
    ("text", "senses"),
    [
        ("Let H and N be forces on the horse (H to the right, N upward).", {("H", "right", ""), ("N", "up", "")}),
        ("H = friction of the floor on the reel, taken positive to the LEFT", {("H", "left", "reel")}),
        ("K = N r    N: force of the yoke on the pin, upward", {("N", "up", "pin")}),
        ("friction force $H$ (to the right, on the wheel)", {("H", "right", "wheel")}),
        ("H acts not to the right", set[tuple[str, str, str]]()),
        ("N keeps it up; the wheel rolls to the right", set[tuple[str, str, str]]()),
    ],
)
def test_senses_in_words(text: str, senses: set[tuple[str, str, str]]) -> None:
    assert stated_senses(text, ["H", "N", "K"]) == senses
