"""What worked sheets and printed output hold beside the equations: columns, cases, labels, units, functions, powers.

Oracle: the equations of built-in systems. Each line stands beside right equations, which it leaves right, and beside
wrong ones, which it leaves wrong.
"""

from __future__ import annotations

import pytest

import lagrangian as lg
from student_answers import CART, POLE, right

BESIDE = {
    "columns": "dL/dx' = (M + m)*x' + m*l*theta'*cos(theta)      dL/dx = 0      Q_x = F - b*x'",
    "tab": "T = (M + m)*x'^2/2 + m*l*x'*theta'*cos(theta) + (J + m*l^2)*theta'^2/2\tV = m*g*l*cos(theta)",
    "vanishing": "Check: if J = b = 0 the second one reads l*theta'' + x''*cos(theta) = g*sin(theta), as in the book.",
    "set": "Setting b = 0 and theta = 0 gives (M + m) x'' = F.",
    "together": "With m = J = 0 I get M x'' + b x' = F, a cart alone.",
    "limit": "In the limit M -> oo only (J + m l^2) theta'' = m g l sin theta remains.",
    "conserved": "Without friction (b = 0) and force (F = 0) the momentum (M+m) x' + m l theta' cos theta is constant.",
    "motion": "For theta = 0, theta' = 0 the pole stands.",
    "power": "The power of all forces is P = F*x' - b*x'^2.",
    "rated": "v = x'\nP = F v - b v^2",
    "unit": "I_0 = J + m*l^2 [kg m^2]",
    "function": "F(x, theta) = M*x + m*l*sin(theta)",
    "printed": "T - V\n(M+m)*x'^2/2 + m*l*x'*theta'*cos(theta) + (J+m*l^2)*theta'^2/2 - m*g*l*cos(theta)\n",
}
"""Lines of a sheet beside the equations of the cart with a pole."""


@pytest.mark.sampled(16)
@pytest.mark.parametrize("kind", BESIDE)
def test_what_stands_beside_equations_leaves_them_right_or_wrong(kind: str) -> None:
    assert right(f"{BESIDE[kind]}\n{CART}\n{POLE}")
    assert right(f"{CART}\n{POLE}\n{BESIDE[kind]}")
    assert not right(f"{BESIDE[kind]}\n{CART}\n{POLE.replace('- m g', '+ m g')}")


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "beside",
    [
        BESIDE["columns"].replace("m*l*theta'", "m*theta'"),
        BESIDE["tab"].replace("V = m", "V = -m"),
        f"P = -{BESIDE['tab'].partition('V = ')[2]}",
        "theta'' = 0",
        "x' = theta'",
        "theta' = 0",
    ],
)
def test_what_is_wrong_beside_equations_is_not_right(beside: str) -> None:
    assert not right(f"{beside}\n{CART}\n{POLE}")


def test_a_special_case_is_no_answer() -> None:
    assert not right(f"{CART}\nIf J = 0 then m l^2 theta'' + m l x'' cos theta - m g l sin theta = 0")


@pytest.mark.parametrize("labels", [("q = x:", "q = theta:"), ("i = 1:", "i = 2:"), ("a) q = x\n", "b) q = theta\n")])
def test_a_letter_that_stands_for_each_coordinate_is_a_label(labels: tuple[str, str]) -> None:
    general = "d/dt(∂L/∂q') - ∂L/∂q = Q_q"
    assert right(f"{general}\n{labels[0]} {CART}\n{labels[1]} {POLE}")
    assert not right(f"{general}\n{labels[0]} {CART}\n{labels[1]} {POLE.replace('- m g', '+ m g')}")


TWO = "m1*x1'' - k*x2r = -F\nm2*(x1'' + x2r'') + k*x2r = F"


@pytest.mark.parametrize(("at_rest", "verdict"), [("x2r = F/k", True), ("x2r = 2*F/k", False), ("x1 = F/k", False)])
def test_a_position_at_rest_beside_equations_must_be_one(at_rest: str, verdict: bool) -> None:
    assert right(f"{TWO}\n{at_rest}", "lecture-3b") is verdict


def test_energies_of_rates_and_expressions_of_programs() -> None:
    listed = f"{CART.replace('= F', '- F')}\n{POLE.removesuffix(' = 0')}"
    assert right(f"{BESIDE['printed']}{listed}")
    assert not right(f"{BESIDE['printed']}{listed.replace('- m g', '+ m g')}")


COMET = """
name = "comet"
[coordinates]
r = { unit = "m", positive = true }
phi = "from perihelion"
[parameters]
m = "1 kg"
G = "1 m^3/s^2"
[points]
P = ["r*cos(phi)", "r*sin(phi)"]
[[particle]]
mass = "m"
at = "P"
[[potential]]
value = "-G*m/r"
"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize("beside", ["a_r = r'' - r*phi'^2", "G = K*M_0", "r = r_0", "phi' = r''"])
def test_a_wrong_line_beside_equations_without_small_motions_is_judged(beside: str) -> None:
    rows = "m*(r'' - r*phi'^2) + G*m/r^2 = 0\nr*phi'' + 2*r'*phi' = 0"
    assert lg.loads(COMET).derive().check(f"{rows}\n{beside}", hint=0).right is (beside != "phi' = r''")


@pytest.mark.parametrize(
    ("function", "use"),
    [
        ("g(x, theta) = x*cos(theta)", "g(x, theta)"),
        ("L(theta) = m*l*cos(theta)", "L(theta)/(m*l)*x"),
        ("l(x) = 2*x", "l(x)/2*cos(theta)"),
    ],
)
def test_a_function_of_coordinates_is_another_name_than_that_of_the_system(function: str, use: str) -> None:
    cart = CART.replace("+ b x'", f"+ b x' + {use} - x*cos(theta)")
    assert right(f"{function}\n{cart}\n{POLE}")
    assert not right(f"{function.replace('= ', '= 3*')}\n{cart}\n{POLE}")


def test_the_lagrangian_with_its_arguments_is_judged() -> None:
    lagrangian = "L(x, theta, x', theta') = (M+m)*x'^2/2 + m*l*x'*theta'*cos(theta) + (J+m*l^2)*theta'^2/2"
    assert right(f"{lagrangian} - m*g*l*cos(theta)\n{CART}\n{POLE}")
    assert not right(f"{lagrangian} + m*g*l*cos(theta)\n{CART}\n{POLE}")


RING = """
name = "bead on a circle"
[coordinates]
x = "to the right"
y = "upwards"
[parameters]
m = "1 kg"
R = "2 m"
g = "9.81 m/s^2"
[points]
P = ["x", "y"]
[[particle]]
mass = "m"
at = "P"
[[gravity]]
direction = [0, -1]
[[constraint]]
name = "circle"
expression = "x^2 + y^2 - R^2"
"""


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "beside",
    [
        "cos(beta) = x/R and sin(beta) = y/R",
        "N = 2*lambda*R",
        "-m*x''*δx - m*(y'' + g)*δy = 0\nx*δx + y*δy = 0",
        "δW = -m*g*δy",
    ],
)
def test_names_that_equations_with_multipliers_do_without_are_not_judged(beside: str) -> None:
    rows = "m*x'' = N*x/R\nm*y'' = -m*g + N*y/R\nx^2 + y^2 = R^2"
    ring = lg.loads(RING).derive()
    assert ring.check(f"{beside}\n{rows}", hint=0).right
    assert not ring.check(f"{beside}\n{rows.replace('-m*g', 'm*g')}", hint=0).right
    assert not ring.check(f"{beside}\n{rows.replace('N*y', 'N*x')}", hint=0).right


def test_the_principle_of_virtual_work_alone_is_no_answer() -> None:
    virtual = "-m*x''*δx - m*(y'' + g)*δy = 0\nx*δx + y*δy = 0\nx^2 + y^2 = R^2"
    assert not lg.loads(RING).derive().check(virtual, hint=0).right
    assert lg.loads(RING).derive().check(f"{virtual}\ny*x'' - x*(y'' + g) = 0", hint=0).right


def test_a_virtual_work_whose_zero_stands_on_the_line_below() -> None:
    work = "dW = (F - b x' - (M + m) x'') dx - m l x'' cos theta dtheta\n"
    work += "   - m l (theta'' cos theta - theta'^2 sin theta) dx - ((J + m l^2) theta'' - m g l sin theta) dtheta = 0"
    assert right(f"{work}\n{CART}\n{POLE}")
    assert not right(f"{work.replace('b x', '2 b x')}\n{CART}\n{POLE}")


def test_drawn_equations_without_a_blank_line_between_them_are_apart() -> None:
    first = [
        "           2",
        "          d            d",
        "(M + m)⋅ ───(x(t)) + b⋅──(x(t)) + H = F",
        "           2           dt",
        "         dt",
    ]
    second = [
        "            2",
        "⎛       2⎞ d",
        "⎝J + m⋅l ⎠⋅───(θ(t)) + K - m⋅g⋅l⋅sin(θ(t)) = 0",
        "             2",
        "           dt",
    ]
    own = "H = m*l*theta''*cos(theta) - m*l*theta'^2*sin(theta)\nK = m*l*x''*cos(theta)\n\n"
    assert right(own + "\n".join((*first, *second)))
    assert right(own + "\n".join((*second, *first)))
    assert not right(own + "\n".join((*first, *second)).replace("- m⋅g", "+ m⋅g"))
