"""What a program does that is not carried out, and could change what is judged, is not left out in silence.

Oracle: the equation of the pendulum. Every program has a twin that is right, or wrong, by the same form.
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import ParseError

RHS = """def rhs(t, z):
    theta, omega = z
    return [omega, -g/L*np.sin(theta) - b/(m*L**2)*omega]
"""
JULIA = """function f!(du, u, p, t)
    theta, omega = u
    du[1] = omega
    du[2] = -g/L*sin(theta) - b/(m*L^2)*omega
end
"""


def right(text: str) -> bool:
    """Whether a program is accepted; one that cannot be read is not."""
    try:
        return derivation("pendulum").check(text, hint=0).right
    except ParseError:
        return False


@pytest.mark.parametrize("head", ["if True", "while on", "for k in range(1000)", "try"])
def test_a_function_in_a_branch_ends_for_itself(head: str) -> None:
    behind = "except Exception:\n    pass\n" if head == "try" else ""
    assert right(f"{RHS}{head}:\n    def f(x):\n        return x\n{behind}")
    assert not right(f"{RHS}{head}:\n    def rhs(t, z):\n        return [z[1], g*z[0]]\n{behind}")
    assert not right(f"{RHS}{head}:\n    return\n{behind}")


@pytest.mark.parametrize("line", ["s = s + s", "s = [*s, *s]", "s.extend(s)", 's = f"{s}{s}"'])
def test_lists_and_texts_grow_within_bounds(line: str) -> None:
    start = '"ab"' if "f" in line else "[1, 2]"
    assert right(f"{RHS}s = {start}\nfor k in range(60):\n    {line}\n")


def test_two_strokes_in_julia_divide() -> None:
    assert right(JULIA.replace("b/(m", "b//(m"))
    assert not right(JULIA.replace("b/(m", "b//(2*m"))
    assert not right(JULIA.replace("*omega\n", "*omega // 2\n"))
