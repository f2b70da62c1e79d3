"""Mistakes of answers that put rolling in: they are told in the coordinates that the answer keeps."""

from __future__ import annotations

import pytest
from reels import reel

from lagrangian.check.verdict import Verdict

T = "T = 1/2 (M + m) x'^2 + 1/2 J x'^2/R^2 + m l x' psi' cos(psi) + 1/2 m l^2 psi'^2"
V = "V = -m g l cos(psi) + 1/2 k (x/R + psi)^2"
ALONG = "(M + m + J/R^2) x'' + m l cos(psi) psi'' - m l sin(psi) psi'^2 + k (x/R + psi)/R + c (x'/R + psi')/R = F"
ARM = "m l^2 psi'' + m l cos(psi) x'' + m g l sin(psi) + k (x/R + psi) + c (x'/R + psi') = 0"
TURN = "(J + (M + m) R^2) phi'' + m R l cos(psi) psi'' - m R l sin(psi) psi'^2 + k (phi + psi) + c (phi' + psi') = F R"
SWING = "m l^2 psi'' + m R l cos(psi) phi'' + m g l sin(psi) + k (phi + psi) + c (phi' + psi') = 0"


def _first(verdict: Verdict) -> str:
    assert not verdict.right
    return str(verdict.mistakes[0].what)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("force", ["F", "-F R", "F l"])
def test_a_force_without_its_arm_is_told_as_such(force: str) -> None:
    assert reel().check(f"x = R phi\nQ_phi = F R - c (phi' + psi')\n{TURN}\n{SWING}", hint=0).right
    wrong = TURN.replace("F R", force)
    told = _first(reel().check(f"x = R phi\nQ_phi = {force} - c (phi' + psi')\n{wrong}\n{SWING}"))
    assert "orce 'F'" in told
    assert "in place of Ξ" not in told and "no work" not in told
    assert {"F": "without its arm", "-F R": "wrong sign", "F l": "the factor is l; it should be R"}[force] in told


@pytest.mark.slow
def test_right_terms_of_what_rolls_are_not_called_wrong() -> None:
    """The band and the washer feel x/R + ψ: neither do these terms not belong there, nor is φ missing."""
    wrong = T.replace("1/2 J x'^2/R^2", "J x'^2/R^2")
    verdict = reel().check(f"phi = x/R\n{wrong}\n{V}\n{ALONG.replace('J/R^2', '2 J/R^2')}\n{ARM}")
    assert not verdict.right
    assert "does not belong" not in str(verdict) and "is missing." not in str(verdict.findings)
    assert "J ẋ²/R² should be J ẋ²/(2 R²)" in str(verdict)
    assert [f.status.right for f in verdict.findings] == [True, False, True, False, True]


@pytest.mark.slow
def test_a_wrong_relation_is_no_equation_of_motion() -> None:
    verdict = reel().check(f"phi = -x/R\n{T}\n{V.replace('x/R', '-x/R')}\n{ALONG}\n{ARM}")
    assert not verdict.right
    assert "the equation of x" not in str(verdict.findings[0]) and "φ = x/R" not in str(verdict)


def test_rows_of_one_matrix_keep_their_own_verdicts() -> None:
    matrix = (
        "x = R phi\n[[J + (M + m) R^2, m R l cos(psi)], [m R l sin(psi), m l^2]] [phi'', psi''] + "
        "[-m R l psi'^2 sin(psi) + k (phi + psi) + c (phi' + psi'), m g l sin(psi) + k (phi + psi) + c (phi' + psi')] "
        "= [F R, 0]"
    )
    verdict = reel().check(matrix)
    assert not verdict.right
    assert sorted(f.status.right for f in verdict.findings if f.line.kind == "equation")[:2] == [False, True]
    assert reel().check(matrix.replace("R l sin(psi), m l^2", "R l cos(psi), m l^2"), hint=0).right


@pytest.mark.slow
def test_a_height_may_be_counted_from_another_place() -> None:
    """The arm's mass is at R − l cos ψ above the floor; −l cos ψ, above the axle, is no mistake."""
    wrong = V.replace("-m g l", "m g l")
    low = ARM.replace("+ m g l", "- m g l")
    verdict = reel().check(f"phi = x/R\ny_N = -l cos(psi)\n{T}\n{wrong}\n{ALONG}\n{low}")
    assert "Line 2" not in _first(verdict) and "wrong sign" in _first(verdict)
    assert "from another place" in str(verdict)
