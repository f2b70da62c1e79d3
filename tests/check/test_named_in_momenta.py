"""The rate of a name that is a momentum, ṗ_φ = …, is judged and explained as d/dt (∂L/∂φ̇).

Oracle: by hand, a puck on a spring along a rod that a motor turns:

    m r̈ − m r φ̇² + k (r − a) = 0,    (J + m r²) φ̈ + 2 m r ṙ φ̇ = M
"""

from __future__ import annotations

import pytest
from small_systems import rod

from lagrangian import ParseError

ENERGIES = "T = 1/2 m (r'^2 + r^2 phi'^2) + 1/2 J phi'^2\nV = 1/2 k (r - a)^2"
MOMENTA = "p_r = m r'\np_phi = (J + m r^2) phi'"
FIRST = "m r'' - m r phi'^2 + k (r - a) = 0"


def sheet(rate: str, equation: str) -> str:
    """A sheet by momenta, with the rate of one of them and the equation of φ."""
    return "\n".join([ENERGIES, MOMENTA, "p_r' = m r''", rate, FIRST, equation])


RIGHT = "(J + m r^2) phi'' + 2 m r r' phi'"
WRONG = {
    "(J + m r^2) phi''": "In d/dt(∂L/∂phi'), the term 2*m*r*phi'*r' is missing.",
    "(J + m r^2) phi'' + m r r' phi'": "In d/dt(∂L/∂phi')",
    "m r^2 phi'' + 2 m r r' phi'": "In d/dt(∂L/∂phi'), the term J*phi'' is missing.",
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize("left", ["p_phi'", "d/dt p_phi", "dp_phi/dt"])
@pytest.mark.parametrize("written", WRONG)
def test_a_wrong_rate_of_a_momentum_is_explained_in_its_line(left: str, written: str) -> None:
    verdict = rod().check(sheet(f"{left} = {written}", f"{written} = M"))
    wrong = [(f.line.number, f.follows) for f in verdict.findings if not f.status.right]
    assert wrong == [(6, False), (8, True)]
    (mistake,) = verdict.mistakes
    assert str(mistake.what).startswith(WRONG[written])


def test_right_rates_of_momenta_are_right() -> None:
    verdict = rod().check(sheet(f"p_phi' = {RIGHT}", f"{RIGHT} = M"))
    assert verdict.right and all(f.status.right for f in verdict.findings)


def test_a_balance_of_a_momentum_is_an_equation_of_motion() -> None:
    verdict = rod().check("\n".join([ENERGIES, MOMENTA, "p_r' = m r phi'^2 - k (r - a)", "p_phi' = M"]))
    assert verdict.right


def test_the_rate_of_a_wrong_momentum_is_not_told_as_a_derivative() -> None:
    momenta = MOMENTA.replace("(J + m r^2) phi'", "(J + 2 m r^2) phi'")
    verdict = rod().check("\n".join([ENERGIES, momenta, "p_phi' = (J + 2 m r^2) phi'' + 4 m r r' phi'", FIRST]))
    assert not verdict.right
    assert not any("d/dt" in str(m.what) for m in verdict.mistakes)


def test_both_of_two_wrong_balances_are_told() -> None:
    """Newton along the rod without the centripetal term, and half of the Coriolis term across it."""
    lines = ["along: m r'' = -k (r - a)", "across: m (r phi'' + r' phi') = N", "rod: J phi'' = M - r N"]
    verdict = rod().check("\n".join(lines))
    assert [(f.line.number, f.status.right) for f in verdict.findings] == [(1, False), (2, False), (3, True)]
    first, second = (str(m.what) for m in verdict.mistakes)
    assert first == "In line 1, on the right-hand side, the term m*r*phi'^2 is missing."
    assert second == "In line 2, m*phi'*r' should be 2*m*phi'*r'."


SLOPES = "phi is cyclic, and p_phi = {of}/∂phi' only changes by M."
BALANCES = "p_phi' = M with p_phi = (J + m r^2) phi'\np_r' = m r phi'^2 - k (r - a) with p_r = m r'\n"


@pytest.mark.parametrize("of", ["∂T", "∂L", "∂ℒ"])
@pytest.mark.parametrize("more", ["", "L = T - V\n", "For M = 0: p_phi = const.", "Free: M = 0 → p_phi = const."])
def test_a_momentum_is_a_slope_of_an_energy_that_the_answer_does_not_give(of: str, more: str) -> None:
    whole = f"{more if more[:1] == 'L' else ''}{SLOPES.format(of=of)}\n\n{BALANCES}{more if more[:1] == 'F' else ''}"
    assert rod().check(whole).right
    for was, now in (
        ("= M with", "= -M with"),
        ("(J + m r^2)", "(J + 2 m r^2)"),
        ("m r phi'^2", "m phi'^2"),
        ("= m r'", "= J r'"),
    ):
        assert was in whole and not rod().check(whole.replace(was, now)).right


def test_a_momentum_of_which_only_the_slope_is_said_is_not_known() -> None:
    with pytest.raises(ParseError, match="p_phi"):
        rod().check(f"{SLOPES.format(of='∂T')}\n\np_phi' = M\n{FIRST}")


@pytest.mark.parametrize("left", ["d/dt[[{J}] phi']", "d/dt [ [{J}] phi' ]", "d/dt{{[{J}] phi'}}", "d/dt[{J} phi']"])
def test_brackets_in_brackets_behind_a_derivative(left: str) -> None:
    for inertia, right in (("J + m r^2", True), ("J + m r", False), ("J - m r^2", False)):
        grouped = f"({inertia})" if "[{" not in left.replace("[{J} ", "") else inertia
        assert rod().check(f"{FIRST}\n{left.format(J=grouped)} = M").right is right
