"""No answer is right by one of two things that it says: names with two values, and values beside an equation.

Oracle: by hand, two carts with the relative coordinate, and a pendulum m L² θ̈ + b θ̇ + m g L sin θ = 0.
"""

import pytest

from built_in import derivation
from lagrangian import ParseError

FIRST, SECOND = "(m1+m2)*x1'' + m2*x2r'' = 0", "m2*(x1''+x2r'') + k*x2r = F"


@pytest.mark.parametrize(
    "written",
    [
        f"f = F - k*x1\nf = F - k*x2r\n{FIRST}\nm2*(x1''+x2r'') = f",
        "m1*x1'' = S\nm2*(x1''+x2r'') = F - k*x2r\nS = k*x2r - F\nS = k*x2r + F",
        f"M = m1 + m2\nM*x1'' + m2*x2r'' = 0\nM = m1 - m2\n{SECOND}",
        f"omega = x1'\n(m1+m2)*omega' + m2*x2r'' = 0\nomega = x1'/2\n{SECOND}",
        "q = x1'' + x2r''\nm1*x1'' = k*x2r - F\nm2*q + k*x2r = F\nq = x1''",
        "M = [m1+m2, m2; m2, m2]\nM q'' + K q = f\nK = [0 0;0 k]\nf=[0;F]\nf=[F;0]",
        f"{FIRST}\nm2*(x1''+x2r'') + k*x2r = F*h\nh = 1\nh = 2",
    ],
)
def test_a_name_with_two_values_is_not_right_by_the_one_that_fits(written: str) -> None:
    verdict = derivation("lecture-3b").check(written)
    assert verdict.status.value == "wrong", verdict.to_text()
    assert len({f.line.number for f in verdict.findings if not f.status.right}) == 1


@pytest.mark.parametrize(
    "written",
    [
        f"v = x1'\nT_1 = m1*v^2/2\nv = x1' + x2r'\nT_2 = m2*v^2/2\nT = T_1 + T_2\n{FIRST}\n{SECOND}",
        f"M = m1 + m2\nM = m2 + m1\nM*x1'' + m2*x2r'' = 0\n{SECOND}",
        f"q = x1'' + x2r''\nm2*q + k*x2r = F\nq = (F - k*x2r)/m2\n{FIRST}",
    ],
)
def test_a_name_may_be_used_again_and_said_in_another_way(written: str) -> None:
    assert derivation("lecture-3b").check(written, hint=0).right


def test_a_number_beside_the_formula_of_a_name_is_told() -> None:
    written = "w = sqrt(g/L)\nθ'' + b/(m*L^2)*θ' + w^2*sin(θ) = 0\nw = 4.4294"
    verdict = derivation("pendulum").check(written)
    assert verdict.right
    assert "'w = 4.4294' was not judged: the value that is used is another one." in map(str, verdict.notes)


@pytest.mark.parametrize("values", ["m1 = 1, m2 = 2: {}", "with m1 = 1 kg and m2 = 2 kg we get {}"])
@pytest.mark.parametrize("equation", ["x1'' - 5", "m2*x2r'' - k*x1", "ẍ1 - 5"])
def test_an_equation_beside_a_list_of_values_is_not_passed_over(values: str, equation: str) -> None:
    try:
        verdict = derivation("lecture-3b").check(f"{values.format(equation)}\n{FIRST}\n{SECOND}")
    except ParseError as error:
        assert error.place is not None and error.place.line == 1
    else:
        assert not verdict.right or any(
            x in str(n) for n in verdict.notes for x in ("not judged", "not read", "not be read")
        )


def test_a_force_that_only_an_unused_definition_names_is_not_eliminated() -> None:
    right = "(m1 + m2 + J/R^2)*x'' = (m1-m2)*g"
    assert not derivation("atwood").check(f"{right}\nS1 = m1*(g + x'')\nm2*x'' = S2 - m2*g\nS1=S2", hint=0).right
    assert derivation("atwood").check("m1*x''=m1*g-S1\nm2*x''=S2-m2*g\nJ*x''/R^2=S1-S2", hint=0).right


ROWS = "w0 = sqrt(k/m2)\n(m1+m2)*x1'' + m2*x2r'' = 0\nm2*(x1''+x2r'') + m2 w0^2 x2r = F\n\n"


@pytest.mark.parametrize(
    ("number", "holds"),
    [
        ("sqrt(8000/37) = 14.7 rad/s", True),
        ("sqrt(8000/37) = 14.704", True),
        ("sqrt(8000/37) = 15 1/s", True),
        ("sqrt(8000/37) = 14.8 rad/s", False),
        ("sqrt(8000/37) = 14.71", False),
        ("sqrt(8000/27) = 14.7", False),
        ("sqrt(9) = 4", False),
    ],
)
def test_the_number_that_a_formula_gives_may_be_rounded(number: str, holds: bool) -> None:
    assert derivation("lecture-3b").check(f"{ROWS}With the numbers w0 = {number}").right is holds


def test_a_multiple_of_delta_may_be_defined() -> None:
    first = "2δ = b/(J + m l²)"
    pole = "theta'' + m l x''/(J + m l²) cos theta - m g l/(J + m l²) sin theta = 0"
    cart = "x'' + m l/(M + m) theta'' cos theta - m l/(M + m) theta'^2 sin theta + 2δẋ = F/(M + m)"
    sheet = f"Divided by M + m, with 2δ = b/(M + m):\n\n{cart}\n{pole}"
    assert derivation("cart-pole").check(sheet).right
    assert not derivation("cart-pole").check(sheet.replace("2δẋ", "δẋ")).right
    assert not derivation("cart-pole").check(sheet.replace("2δ = b", "2δ = 2 b")).right
    assert not derivation("cart-pole").check(sheet.replace("2δ = b/(M + m)", first)).right
