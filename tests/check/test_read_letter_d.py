"""The letter d in front of what moves is a factor where a constant has this name, and the sign of a rate elsewhere.

Oracle: a pendulum on a pivot with two dampers, m l² θ″ + 2 c θ′ + m g l sin θ = 0, with c called d, D, dt or b.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verdict import Verdict
from lagrangian.errors import ParseError


@cache
def pendulum(damping: str) -> lg.Derivation:
    s = lg.System("pendulum with two dampers")
    theta = s.coordinate("theta")
    m, l, g = s.parameters("m l g")
    c = s.parameter(damping)
    s.particle(m, at=s.point("B", (l * sp.sin(theta), -l * sp.cos(theta))), name="bob")
    s.gravity((0, -1), g)
    s.damper(c, deflection=theta, name="left")
    s.damper(c, deflection=theta, name="right")
    return s.derive()


def judged(answer: str, damping: str = "d") -> Verdict:
    return pendulum(damping).check(answer)


RIGHT = [
    ("d", "ml^2 θ'' + 2dθ' + mgl sinθ = 0"),
    ("d", "ml^2 θ'' = -2 dθ' - mgl sinθ"),
    ("d", "m*l^2*theta'' + 2dtheta' + m*g*l*sin(theta) = 0"),
    ("d", "m*l^2*thetadd + 2dthetad + m*g*l*sin(theta) = 0"),
    ("d", "m*l^2*thetaddot + 2*dthetadot + m*g*l*sin(theta) = 0"),
    ("d", "m l^2 θ'' + 2d dθ/dt + m g l sinθ = 0"),
    ("d", "m l^2 d²θ/dt² + 2ddθ/dt + m g l sinθ = 0"),
    ("d", "ω = θ'\nml^2 ω' + 2dω + mgl sinθ = 0"),
    ("d", "ω = θ'\nml^2 dω/dt + 2dω + mgl sinθ = 0"),
    ("d", "x = l sinθ, dx = l cosθ dθ.\nml^2 θ'' + 2dθ' + mgl sinθ = 0"),
    ("d", "ml^2 ddθ + 2d dθ + mgl sinθ = 0"),
    ("d", r"\[ml^2\ddot\theta + 2d\theta' + mgl\sin\theta = 0\]"),
    ("D", "ml^2 θ'' + 2Dθ' + mgl sinθ = 0"),
    ("dt", "ml^2 θ'' + 2dtθ' + mgl sinθ = 0"),
    ("dt", "ml^2 d²θ/dt² + 2dt dθ/dt + mgl sinθ = 0"),
    ("b", "ml^2 ddθ + 2b dθ + mgl sinθ = 0"),
    ("b", "ml^2 ddθ + 2bdθ + mgl sinθ = 0"),
    ("b", "ml^2 θ'' + 2bdθ/dt + mgl sinθ = 0"),
    ("b", "l^2 md²θ/dt² + 2bdθ/dt + mgl sinθ = 0"),
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("damping", "answer"), RIGHT)
def test_a_damping_of_this_name_is_a_factor(damping: str, answer: str) -> None:
    assert judged(answer, damping).right


def once(answer: str) -> str:
    """The answer with one damper in place of two."""
    last = answer.rindex("2 d" if "2 d" in answer else "2*d" if "2*d" in answer else "2d" if "2d" in answer else "2")
    return answer[:last] + "1*" + answer[last + 1 :].lstrip("*")


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("damping", "answer"), [(damping, once(answer)) for damping, answer in RIGHT])
def test_one_damper_alone_stays_wrong(damping: str, answer: str) -> None:
    assert not judged(answer, damping).right


def test_the_damping_of_an_acceleration_stays_wrong() -> None:
    assert not judged("ml^2 θ'' + 2dθ'' + mgl sinθ = 0").right


def test_what_is_wrong_is_told_with_the_damping() -> None:
    told = judged("ml^2 θ'' + dθ' + mgl sinθ = 0").to_text()
    assert "d θ̇" in told and "dθ as d θ" in told


def test_other_terms_are_told_where_the_letter_is_open() -> None:
    """A d in front of a velocity of the answer's own is a factor beside marks of rates: only the weight is wrong."""
    told = judged("ω = θ'\nml^2 ω' + 2dω + mg sinθ = 0").to_text()
    assert "m g sin θ should be m g l sin θ" in told and "2 θ̈" not in told and told.count("line 2:") == 1


def test_long_words_of_the_letter_are_read_in_time() -> None:
    with pytest.raises(ParseError):
        judged("ml^2 θ'' + 2dθ' + mgl sinθ = 0\n" + "d" * 20_000 + "θ'/dt = 1")
