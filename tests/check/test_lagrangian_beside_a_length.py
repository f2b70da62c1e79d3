"""L is the Lagrangian of an answer if it has squares of rates, also where the system calls a length L."""

from functools import cache

import pytest

import lagrangian as lg

SWING = """
name = "swing with a rubber band"
[coordinates]
phi = "swing"
[parameters]
m = "2 kg"
a = "1.5 m"
k = "30 N/m"
[inputs]
Q = "N*m"
[define]
L = "2*a*sin(phi/2)"
[points]
P = ["a*sin(phi)", "-a*cos(phi)"]
[[particle]]
name = "seat"
mass = "m"
at = "P"
[[spring]]
name = "band"
k = "k"
deflection = "L"
[[torque]]
name = "motor"
value = "Q"
on = "phi"
"""
ROW = "m a^2 phi'' + k a^2 sin(phi) = Q"
LINES = {
    "L = 1/2 m a^2 phi'^2 - 2 k a^2 sin(phi/2)^2": True,
    "L = 1/2 m a^2 phi'^2 + 2 k a^2 sin(phi/2)^2": False,
    "L = 2 a sin(phi/2)": True,
    "L = 2 a cos(phi/2)": False,
    "T = 1/2 m a^2 phi'^2\nV = 1/2 k (2 a sin(phi/2))^2\nL = T - V": True,
    "T = 1/2 m a^2 phi'^2\nV = 1/2 k (2 a sin(phi/2))^2\nL = T + V": False,
}
TEX = r"""\[ \mathcal L = \tfrac12 m a^2 \dot\phi^2 - 2 k a^2 \sin^2\frac{\phi}{2} \]
\[ \frac{\partial\mathcal L}{\partial\phi} = -k a^2 \sin\phi \]
\[ m a^2\ddot\phi + k a^2\sin\phi = Q \]
"""


@cache
def swing() -> lg.Derivation:
    return lg.loads(SWING).derive()


@pytest.mark.parametrize(("line", "right"), LINES.items())
def test_what_l_is_shows_in_its_value(line: str, right: bool) -> None:
    verdict = swing().check(f"{line}\n{ROW}")
    assert verdict.right == right, str(verdict)
    own = [f for f in verdict.findings if f.line.text.startswith("L =")]
    assert all(f.status.right == right for f in own), str(verdict)


def test_a_script_letter_is_the_lagrangian() -> None:
    verdict = swing().check(TEX)
    assert verdict.right, str(verdict)
    wrong = swing().check(TEX.replace("- 2 k a^2", "+ 2 k a^2"))
    assert next(f.line.number for f in wrong.findings if not f.status.right and not f.follows) == 1
