"""D and D2 as operators that differentiate by time, and der of Modelica.

Oracle: the equations of the pendulum and of the cart with a pole in the grammar of model files; each has a wrong twin.
"""

import pytest

from built_in import derivation
from lagrangian import ParseError

PENDULUM = "m*L^2*D(D(theta)) + b*D(theta) + m*g*L*sin(theta) = 0"


def right(written: str, name: str = "pendulum") -> bool:
    """Whether an answer is judged right."""
    return derivation(name).check(written, hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "written",
    [
        PENDULUM,
        f"{PENDULUM}\nwhere D is d/dt",
        f"{PENDULUM}, where D() is the time derivative.",
        f"D(z) = dz/dt\n{PENDULUM}",
        "m*L^2*D2(theta) + b*D(theta) + m*g*L*sin(theta) = 0\nwhere D(z) = dz/dt and D2(z) = d²z/dt²",
        "m*L^2*D(D(theta))(t) + b*D(theta)(t) + m*g*L*sin(theta(t)) = 0;",
        "m*L^2*(D@@2)(theta)(t) + b*D(theta)(t) + m*g*L*sin(theta(t)) = 0;",
        "D(m*L^2*D(theta)) + b*D(theta) + m*g*L*sin(theta) = 0",
        "T = m*L^2*D(theta)^2/2\ndT/dD(theta) = m*L^2*D(theta)\n"
        "m*L^2*D2(theta(t)) + b*D(theta(t)) + m*g*L*sin(theta) = 0",
        "w = D(theta)\nm*L^2*D(w) + b*w + m*g*L*sin(theta) = 0",
        "m*L^2*der(w) = -b*w - m*g*L*sin(theta);\n/* with w = der(theta) */",
        "der(theta) = w;\nm*L^2*der(w) = -b*w - m*g*L*sin(theta); // Modelica",
    ],
)
def test_operators_differentiate_by_time(written: str) -> None:
    assert right(written)
    wrong = written.replace("m*g*L", "m*g")
    assert wrong != written
    assert not right(wrong)


def test_a_name_of_the_answer_is_no_operator() -> None:
    assert not right("D = b\nm*L^2*D(D(theta)) + D(theta) + m*g*L*sin(theta) = 0")


def test_a_bracket_behind_an_unknown_d_is_not_taken_for_a_derivative() -> None:
    with pytest.raises(ParseError):
        right("m*L^2*theta'' + D(theta' - 0) + m*g*L*sin(theta) = 0")


@pytest.mark.parametrize("weight", ["{} m g l sin theta", "m {} g l sin theta"])
def test_a_factor_in_front_of_a_name_of_the_system_is_no_number_with_a_unit(weight: str) -> None:
    """2 m d²/dt² is no metre times a day squared, and 2 m g no metre times a gram."""
    rows = "2 M d^2x/dt^2 + 2 m d^2x/dt^2 + 2 m l cos theta θ'' - 2 m l sin theta (∂θ/∂t)² + 2 b ∂x/∂t = 2 F\n"
    rows += "2 J ∂²θ/∂t² + 2 m l² ∂²θ/∂t² + 2 m l cos theta d^2x/dt^2 = "
    judge = derivation("cart-pole")
    assert judge.check(rows + weight.format(2), hint=0).right
    assert not judge.check(rows + weight.format(3), hint=0).right
