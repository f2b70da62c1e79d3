"""Mistakes of answers that leave out φ or x where a body rolls: named in what is left, and at the line of the cause."""

from __future__ import annotations

import pytest
from reels import VALUES, reel, reel_with
from test_counted_together import ALONG, ARM

import lagrangian as lg

T = "T = 1/2 (M + m + J/R^2) x'^2 + 1/2 m l^2 psi'^2 + m l x' psi' cos(psi)"
V = "V = -m g l cos(psi) + 1/2 k (x/R + psi)^2"
D = "D = 1/2 c (x'/R + psi')^2"


def check(*lines: str) -> lg.CheckedAnswer:
    return reel().check("\n".join(lines))


@pytest.mark.slow
def test_right_lines_beside_a_wrong_energy_are_right() -> None:
    verdict = check("phi = x/R", T.replace("J/R^2", "2 J/R^2"), V, ALONG.replace("J/R^2", "2 J/R^2"), ARM)
    assert [f.status.right for f in verdict.findings] == [True, False, True, False, True]
    assert [f.follows for f in verdict.findings] == [False, False, False, True, False]
    assert verdict.mistakes[0].element == "rigid body 'reel'"
    assert "(2*J/R^2 + M + m)*x'^2/2 stands where (J/R^2 + M + m)*x'^2/2 belongs" in str(verdict.mistakes[0].what)
    assert "should be J ẋ²/(2 R²)" in str(verdict) and "does not belong" not in str(verdict)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("m g l sin(psi)", "m g sin(psi)"),
        ("+ c (x'/R + psi')", "- c (x'/R + psi')"),
        ("+ k (x/R + psi)", "- k (x/R + psi)"),
    ],
)
def test_the_term_that_is_wrong_is_named_alone(right: str, wrong: str) -> None:
    verdict = check("x = R phi", ALONG, ARM.replace(right, wrong))
    assert [f.status.right for f in verdict.findings] == [True, True, False]
    assert len(verdict.mistakes) == 1 and len(verdict.findings[-1].differences) == 1


@pytest.mark.slow
def test_a_wrong_deflection_is_told_in_the_letters_of_the_answer() -> None:
    along, arm = ALONG.replace("x/R + psi", "x/R - psi"), ARM.replace("+ k (x/R + psi)", "- k (x/R - psi)")
    verdict = check("phi = x/R", T, V.replace("x/R + psi", "x/R - psi"), along, arm)
    assert [f.follows for f in verdict.findings] == [False, False, False, True, True]
    assert "½ k (x/R − ψ)² should be ½ k (x/R + ψ)²" in str(verdict)
    assert "taken as ψ − x/R in place of x/R + ψ" in " ".join(str(verdict).split())


@pytest.mark.slow
def test_a_constant_in_an_energy_is_no_mistake() -> None:
    verdict = check("phi = x/R", T, V.replace("1/2 k", "k"))
    assert "cos" not in "".join(str(d.term) for f in verdict.findings for d in f.differences)
    lower = check("phi = x/R", "y = -l cos(psi)", T, V.replace("-m g l", "m g l"), ALONG, ARM)
    assert "lower is less" in str(lower) and "line 2" not in str(lower).split("What went wrong")[1]


TURNED = [x.replace("x/R", "-x/R").replace("x'/R", "-x'/R") for x in (V, D)]
ROWS = [
    ALONG.replace("+ k (x/R + psi)/R + c (x'/R + psi')/R", "- k (psi - x/R)/R - c (psi' - x'/R)/R"),
    ARM.replace("x/R + psi", "psi - x/R").replace("x'/R + psi'", "psi' - x'/R"),
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("above", [[T, *TURNED], TURNED, []])
def test_what_follows_from_a_wrong_sense_of_rolling_is_no_mistake_of_its_own(above: list[str]) -> None:
    verdict = check("phi = -x/R", *above, *ROWS)
    (mistake,) = verdict.mistakes
    assert str(mistake.what) == "Line 1 does not hold for rolling 1: the term -x/R has the wrong sign."
    assert [f.follows for f in verdict.findings if f.line.kind != "T"][1:] == [True] * len([*ROWS, *above[-2:]])
    assert check("phi = x/R", T, V, D, ALONG, ARM).right


@pytest.mark.slow
def test_another_mistake_beside_a_wrong_sense_of_rolling_is_told() -> None:
    verdict = check("phi = -x/R", T, *TURNED, ROWS[0], ROWS[1].replace("m g l", "m g"))
    assert [f.follows for f in verdict.findings if not f.status.right] == [False, True, True, True, False]
    assert len(verdict.mistakes) == 2 and "does not hold for rolling" in str(verdict.mistakes[0].what)


FORCED = (
    "(M + m) x'' + m l cos(psi) psi'' - m l sin(psi) psi'^2 = F + H\nJ phi'' + k (x/R + psi) + c (phi' + psi') = -R H"
)


@pytest.mark.slow
def test_a_coordinate_in_another_beside_a_multiplier_is_right_in_a_wrong_answer() -> None:
    assert check("phi = x/R", FORCED, ARM).right
    verdict = check("phi = x/R", FORCED, ARM.replace("m g l", "m g"))
    assert [f.status.right for f in verdict.findings] == [True, True, True, False]
    assert [len(f.differences) for f in verdict.findings] == [0, 0, 0, 1]
    wrong = check("phi = x/R", FORCED.replace("k (x/R", "k (x"), ARM)
    assert [f.status.right for f in wrong.findings] == [True, True, False, True]


@pytest.mark.slow
def test_right_lines_are_right_beside_one_that_nothing_explains() -> None:
    verdict = check("phi = x/R", ALONG.replace("m l cos(psi) psi''", "m l sin(2 psi) psi'' + 3 M J x"), ARM)
    assert [f.status.right for f in verdict.findings] == [True, False, True]


def test_a_square_keeps_its_constant() -> None:
    sys = lg.System("spring")
    s, (m, k, s0) = sys.coordinate("s"), sys.parameters("m k s0")
    sys.particle(m, at=sys.point("P", (s, 0)))
    sys.spring(k, deflection=s - s0)
    assert "½ k s² should be ½ k (s − s₀)²" in str(sys.derive().check("T = m s'^2/2\nV = k s^2/2"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ("-m g cos(psi)", "−m g cos ψ should be −m g l cos ψ"),
        ("m g l cos(psi)", "m g l cos ψ has the wrong sign"),
        ("0", "the term −m g l cos ψ is missing"),
    ],
)
def test_the_level_of_heights_is_no_part_of_a_mistake(wrong: str, said: str) -> None:
    verdict = check("x' = R phi'", f"V = {wrong} + 1/2 k (phi + psi)^2", FORCED, ARM)
    assert f"line 2 (V): {said}." in " ".join(str(verdict).split())


NUMBERS = """M + m + J/R^2 = 0.05 + 0.03 + 0.05 = 0.13, k/R = 0.02
0.13 x'' + 0.00045 psi'' cos(psi) - 0.00045 psi'^2 sin(psi) + 0.025 x' + 0.0005 psi' + x + 0.02 psi = F
0.00045 x'' cos(psi) + 0.00000675 psi'' + 0.0005 x' + 0.00001 psi' + 0.02 x + 0.0004 psi + 0.0044145 sin(psi) = 0"""


@pytest.mark.slow
def test_values_that_are_worked_out_stand_beside_equations_in_numbers() -> None:
    def judged(answer: str) -> tuple[bool, list[bool]]:
        verdict = reel_with(**VALUES).check(answer)
        return verdict.right, [f.status.right for f in verdict.findings]

    assert judged(NUMBERS) == (True, [True] * 3)
    assert judged(NUMBERS.replace("- 0.00045", "- 0.0009")) == (False, [True, False, True])
    assert judged(NUMBERS.replace("= 0.13,", "= 0.12,"))[0] is False
    assert judged(NUMBERS.replace("+ 0.05 =", "- 0.05 ="))[1][-2:] == [True, True]


def test_the_square_of_a_deflection_keeps_its_constant() -> None:
    sys = lg.System("block on a spring")
    s = sys.coordinate("s")
    m, k, s0 = sys.parameters("m k s0")
    sys.kinetic(m * s.diff() ** 2 / 2)
    sys.spring(k, deflection=s - s0)
    verdict = sys.derive().check("V = 1/2 k s^2\nm s'' + k s = 0")
    assert "½ k s² should be ½ k (s − s₀)²" in str(verdict)
