"""Brackets behind a value that are no factor: the same rate in another spelling, a remark with a fraction.

Oracle: the equations of a mass on a spring and a damper, and of a turntable with a mass that slides on it. Every form
has a wrong twin.
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg


@cache
def sledge() -> lg.Derivation:
    """A mass on a spring and a damper."""
    s = lg.System("sledge")
    psi = s.coordinate("psi")
    m, k, c = s.parameters("m k c")
    s.particle(m, at=s.point("P", (psi, 0)))
    s.spring(k=k, deflection=psi)
    s.damper(b=c, deflection=psi)
    return s.derive()


@cache
def table() -> lg.Derivation:
    """A turntable with a mass that slides along a radius."""
    s = lg.System("turntable")
    phi, r = s.coordinates("phi r")
    J, m, k = s.parameters("J m k")
    frame = s.frame(phi, name="table")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=frame, name="table")
    s.particle(m, at=s.point("P", (r, 0), frame=frame))
    s.spring(k=k, deflection=r)
    s.torque(s.inputs("M"), on=phi)
    return s.derive()


GLOSSED = "x1 = ψ, x2 = RATE, n = k/m\nx1' = x2\nx2' = -n x1 - (c/m) x2"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "rate", ["ψ̇ (dψ/dt)", "psi' (= dpsi/dt)", "ψ' (dψ/dt)", "dψ/dt (= ψ')", "psi_dot (dpsi/dt)", "ψ̇ (psi')"]
)
def test_a_rate_in_brackets_behind_the_same_rate_is_said_twice(rate: str) -> None:
    written = GLOSSED.replace("RATE", rate)
    assert sledge().check(written).right, sledge().check(written).to_text()
    assert not sledge().check(written.replace("- (c/m)", "+ (c/m)"), hint=0).right
    assert not sledge().check(written.replace("(c/m) x2", "(c/m) x2²"), hint=0).right


@pytest.mark.parametrize("rate", ["ψ' (ψ')", "2 ψ' (dψ/dt)", "ψ' (d²ψ/dt²)", "ψ' (dψ/dt) ψ'"])
def test_brackets_behind_a_rate_that_say_more_are_no_gloss(rate: str) -> None:
    assert not sledge().check(GLOSSED.replace("RATE", rate), hint=0).right


@pytest.mark.parametrize("damping", ["c ψ' (dψ/dt)", "c (ψ') (dψ/dt)", "(dψ/dt) c ψ'"])
def test_a_rate_in_brackets_of_an_equation_is_a_factor(damping: str) -> None:
    assert not sledge().check(f"m ψ'' + k ψ + {damping} = 0", hint=0).right
    assert not sledge().check(f"m ψ'' + k ψ = -{damping}", hint=0).right


FAR = """D = J + m r²   (REMARK)
phi'' = (M - 2 m r r' phi') / D
r'' = r phi'² - (k/m) r"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("remark", ["determinant / m", "determinant/m", "denominator * 1/m"])
def test_a_remark_behind_a_gap_may_hold_a_fraction(remark: str) -> None:
    written = FAR.replace("REMARK", remark)
    assert table().check(written).right, table().check(written).to_text()
    assert "was not judged" in table().check(written).to_text()
    assert not table().check(written.replace("D = J + m r²", "D = J - m r²"), hint=0).right
    assert not table().check(written.replace("2 m r", "m r"), hint=0).right


def test_a_name_that_is_used_elsewhere_is_no_remark() -> None:
    wrong = FAR.replace("REMARK", "scale / m").replace("M - 2", "scale M - 2").replace("phi'' =", "scale = 2\nphi'' =")
    assert not table().check(wrong, hint=0).right
    assert not table().check(FAR.replace("REMARK", "r / m"), hint=0).right


NAMED = """[ J + m r²   0 ] [φ̈]   [ M - 2 m r r' φ' ]   [ u ]
[ 0          m ] [r̈] = [ m r φ'² - k r   ] = [ v ]

φ̈ = u/(J + m r²)
r̈ = v/m"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "written", [NAMED, "[J + m r², 0; 0, m] [φ''; r''] = [M - 2 m r r' φ'; m r φ'² - k r] = [u; v]"]
)
def test_names_in_a_column_behind_a_column_of_formulas_are_defined_by_it(written: str) -> None:
    solved = written if "φ̈" in written else f"{written}\nφ'' = u/(J + m r²)\nr'' = v/m"
    verdict = table().check(solved)
    assert verdict.right, verdict.to_text()
    for old, new in (("- k r", "+ k r"), ("- 2 m", "- m"), ("= u/", "= v/"), ("= v/m", "= 2 v/m")):
        assert old in solved
        assert not table().check(solved.replace(old, new), hint=0).right, new


def test_names_in_such_a_column_that_are_given_a_value_keep_it() -> None:
    wrong = f"u = M\n{NAMED}"
    assert not table().check(wrong, hint=0).right


@pytest.mark.parametrize("mark", ["r'' &:", r"\ddot r &:", "r: &"])
def test_a_row_of_latex_may_say_in_front_of_words_what_it_is_about(mark: str) -> None:
    written = rf"""\begin{{align*}}
{mark} \text{{ from the second equation }} \ddot r = r\dot\phi^2 - \tfrac{{k}}{{m}} r\\
\intertext{{and the first one is}}
(J + m r^2)\,\ddot\phi &= M - 2 m r\dot r\dot\phi
\end{{align*}}"""
    assert table().check(written).right, table().check(written).to_text()
    for old, new in (("- \\tfrac", "+ \\tfrac"), ("M - 2 m", "M - m"), ("r\\dot\\phi^2", "r\\dot\\phi")):
        assert old in written
        assert not table().check(written.replace(old, new), hint=0).right
