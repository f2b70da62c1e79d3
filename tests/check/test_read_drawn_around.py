"""What is drawn around equations is no part of them: boxes, rules, headings between rules, arrows.

Oracle: by hand, a mass on a spring, m ẍ + k x = F, whose T* has the rate e of nothing else.
"""

from __future__ import annotations

from functools import cache

import pytest

import built_in
from lagrangian import Derivation, ParseError, System


@cache
def spring() -> Derivation:
    """A mass on a spring, and a damper with the letter d."""
    sys = System("spring")
    x = sys.coordinates("x")
    m, k, d = sys.parameters("m k d")
    sys.particle(m, at=sys.point("A", (x, 0)))
    sys.spring(k, deflection=x)
    sys.damper(d, deflection=x)
    sys.generalized_force(x, sys.input("F"))
    return sys.derive()


def right(answer: str) -> bool:
    """Whether an answer is judged right; one that is refused is not."""
    try:
        return spring().check(answer, hint=0).right
    except ParseError:
        return False


DRAWN = [
    "+-----------+\n| {} |\n+-----------+",
    "   +===========+\n   |  {}  |\n   +===========+",
    "*************\n* {} *\n*************",
    "#############\n# {} #\n#############",
    "-------------\n| {} |\n-------------",
    "--- output (lhs = rhs) ---\n{}",
    "=== RESULT (x = way) ===\n{}\n=========",
    "*** {} ***",
    "===== {}",
    "{}   --------",
    "so that\n   -> {}",
    "T = 1/2 m x'^2\n d/dt dT/dx': m x''\n    -> {}",
    "==> {}",
    "--> {}",
    "k x is the spring force ->\n{}",
    "{} ->",
    "{} =>",
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("drawn", DRAWN)
def test_frames_and_arrows_are_no_part_of_an_equation(drawn: str) -> None:
    assert right(drawn.format("m x'' + d x' + k x = F"))
    assert right(drawn.format("m*x'' = F - d*x' - k*x"))
    assert not right(drawn.format("m x'' + d x' - k x = F"))


def test_bullets_of_one_list_are_no_minus_where_others_have_none() -> None:
    answer = "T = 1/2 m x'^2\nV = 1/2 k x^2\n\n- dT/dx' = m x'\n- dV/dx = {} x\n\nm x'' + d x' + k x = F"
    assert right(answer.format("k"))
    assert not right(answer.format("-k"))
    assert right("V = 1/2 k x^2\n\n- m x'' - d x' - k x = -F")


BARRED = """M = | M+m   m l cos(theta) |
    | m l cos(theta)   J+m l^2 |
f = | F - b x' + m l theta'^2 sin(theta) |
    | m g l sin(theta) |
M q'' = f"""
SLASHED = r"""/ M+m             m l cos(theta) \ / x''     \   / F - b x' + m l theta'^2 sin(theta) \
|                                | |         | = |                                     |
\ m l cos(theta)         J+m l^2 / \ theta'' /   \ m g l sin(theta)                    /"""
ENTRIES = (
    "M11 = M+m, M12 = M21 = m l cos theta, M22 = J+m l^2, f1 = F - b x' + m l theta'^2 sin theta, f2 = m g l sin theta"
)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "answer", [BARRED, SLASHED, SLASHED.translate(str.maketrans("/\\", "||")), f"{ENTRIES}, with M q'' = f."]
)
def test_matrices_between_bars_and_slashes_are_read(answer: str) -> None:
    judge = built_in.derivation("cart-pole")
    assert judge.check(answer, hint=0).right
    assert not judge.check(answer.replace("m g l", "m g"), hint=0).right


def test_a_matrix_of_two_lines_may_have_its_arguments_behind_its_name() -> None:
    answer = """M(q) q'' + C(q,q') q' + g(q) = B F
M(q) = [ M+m        m l cos θ ]
       [ m l cos θ  J + m l²  ]
C(q,q') = [ b   -m l θ' sin θ ]
          [ 0        0        ]
g(q) = [0; -m g l sin θ],   B = [1; 0]"""
    cart = built_in.derivation("cart-pole")
    assert cart.check(answer, hint=0).right
    for old, new in (("J + m l²", "J - m l²"), ("b   -m", "b   m"), ("[1; 0]", "[1; 1]")):
        assert old in answer and not cart.check(answer.replace(old, new), hint=0).right
