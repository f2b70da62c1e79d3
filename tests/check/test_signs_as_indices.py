"""Indices that are signs, m_+, m_-, a perpendicular v, F_*: each is a name of the answer's own."""

import pytest
from small_systems import rod

PLAIN = """J_+*phi'' + 2*m*r*r'*phi' = M_-
m*r'' = F_- + m*r*phi'^2
J_+ = J + m*r^2, M_- = M, F_- = -k*(r - a)
"""
LATEX = r"""\[ J_+\,\ddot\varphi + 2m_{+}\,r\,v_\perp\,\dot\varphi = M_\parallel,
 \qquad m\ddot r - F_* = m r\dot\varphi^2 \]
where
\[ J_+=J+mr^2,\quad m_{+}=m,\quad v_\perp=\dot r,\quad M_\parallel = M,\quad F_* = k(a-r) \]
"""
ANSWERS = {
    PLAIN: True,
    PLAIN.replace("J_+ = J + m", "J_+ = J - m"): False,
    PLAIN.replace("F_- = -k", "F_- = k"): False,
    LATEX: True,
    LATEX.replace("J_+=J+", "J_+=J-"): False,
    LATEX.replace("v_\\perp=\\dot r", "v_\\perp=-\\dot r"): False,
    "(J + m*r^2)*phi'' + 2*m*r*r'*phi' = M\nm*r'' - m*r*phi'^2 + k*r-k*a = 0": True,
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("answer", "right"), ANSWERS.items())
def test_an_index_may_be_a_sign(answer: str, right: bool) -> None:
    verdict = rod().check(answer)
    assert verdict.right == right, str(verdict)


def test_two_signs_are_two_names() -> None:
    verdict = rod().check(LATEX.replace("J_+=J+mr^2", "J_-=J+mr^2,\\quad J_+=J-mr^2"))
    assert not verdict.right
