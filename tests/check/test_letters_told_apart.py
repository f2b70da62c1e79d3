"""Letters that differ from the system's by a mark alone are what the answer says that they are.

Oracle: a pendulum with its angle beta and a damper b at the pin, and its equation by hand.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verdict import Verdict


@cache
def flap() -> lg.Derivation:
    """A bob on a rod, with a spring and a damper at the pin."""
    s = lg.System("flap")
    beta = s.coordinate("beta")
    m, h, k, b = s.parameters("m l k b")
    s.particle(m, at=s.point("P", (h * sp.sin(beta), -h * sp.cos(beta))), name="bob")
    s.gravity()
    s.spring(k, deflection=beta, name="pin spring")
    s.damper(b, deflection=beta, name="pin damper")
    return s.derive()


LINES = """\
T = 1/2 m l^2 {d}^2
V = - m g l cos {q} + 1/2 k {q}^2{said}
m l^2 {dd} {sign} m g l sin {q} + k {q} + b {d} = 0"""

SAID = ["   (b_ stands for beta)", "\nwhere b_ is beta", "\nb_ = beta", "\nI write b_ for beta.", ", with b_ = beta"]


def told(verdict: Verdict) -> str:
    return " ".join(str(verdict).split())


@pytest.mark.parametrize("said", SAID)
@pytest.mark.parametrize(("d", "dd"), [("betad", "betadd"), ("b_d", "b_dd"), ("b_'", "b_''")])
def test_a_marked_letter_is_what_it_stands_for(said: str, d: str, dd: str) -> None:
    """Beside the damper b, b_ is the angle in all lines, and in no other sense."""
    verdict = flap().check(LINES.format(q="b_", said=said, d=d, dd=dd, sign="+"))
    assert verdict.right, told(verdict)
    assert "'b_' was read as beta, as you say." in told(verdict)


@pytest.mark.parametrize("said", SAID)
def test_only_the_wrong_line_is_blamed(said: str) -> None:
    verdict = flap().check(LINES.format(q="b_", said=said, d="betad", dd="betadd", sign="-"))
    assert not verdict.right
    assert [f.status.right for f in verdict.findings] == [True, True, False]
    assert verdict.mistake is not None and "wrong sign" in str(verdict.mistake.what)


def test_nothing_is_read_where_nothing_is_said() -> None:
    """b_ is b where no words say otherwise, and a formula is no declaration."""
    right = LINES.format(q="beta", said="", d="betad", dd="betadd", sign="+").replace("b betad", "b_ betad")
    assert flap().check(right).right
    wrong = LINES.format(q="b_", said="", d="betad", dd="betadd", sign="+")
    assert not flap().check(wrong).right
    assert not flap().check(f"{wrong}\nm b_ = beta + 1").right
