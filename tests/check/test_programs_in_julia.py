"""Functions of Julia that return rates of a state, with multipliers, parameters by name and letters with dots.

Oracle: the equations of the pole on a cart and of a disk that rolls, as derived; each program with one wrong sign is
wrong.
"""

from __future__ import annotations

import pytest

import lagrangian as lg
from built_in import derivation
from lagrangian.check.verdict import Status

BODY = """    A = [M + m         m*l*cos(θ)
         m*l*cos(θ)   J + m*l^2]
    r = [F(t) - b*v + m*l*sin(θ)*ω^2, m*g*l*sin(θ)]
"""
IN_PLACE = f"""using DifferentialEquations
function pole!(du, u, p, t)
    x, θ, v, ω = u
    (; M, m, l, J, b, g) = p
{BODY}    a = A \\ r
    du[1] = v; du[2] = ω
    du[3] = a[1]
    du[4] = a[2]
end
"""
WHOLE = f"""Base.@kwdef struct Par
    M = 1.0; m = 0.2
end
function pole!(du, u::Vector{{Float64}}, (p, F), t)
    x, θ, v, ω = u
    @unpack M, m, l, J, b, g = p   # parameters
{BODY}    a, α = A \\ r
    du .= (v, ω, a, α)
    return nothing
end
"""
RETURNED = f"""function pole(u, p, t)
    x, θ, v, ω = u
    M, m, l, J, b, g = p
{BODY}    a = A \\ r
    [v; ω; a]
end
"""
DOTTED = """function pole!(du, u, p, t)
    x, θ, ẋ, θ̇ = u
    D = (M + m)*(J + m*l^2) - (m*l*cos(θ))^2
    f1 = F(t) - b*ẋ + m*l*sin(θ)*θ̇^2
    f2 = m*g*l*sin(θ)
    du[1:2] .= u[3:4]
    du[3] = ((J + m*l^2)*f1 - m*l*cos(θ)*f2)/D
    du[4] = ((M + m)*f2 - m*l*cos(θ)*f1)/D
end
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("program", [IN_PLACE, WHOLE, RETURNED, DOTTED])
def test_functions_of_julia_are_carried_out(program: str) -> None:
    judge = derivation("cart-pole")
    verdict = judge.check(program)
    assert verdict.right and "carried out" in verdict.to_text()
    wrong = program.replace("m*g*l", "-m*g*l")
    assert wrong != program and not judge.check(wrong, hint=0).right


@pytest.mark.slow
def test_the_line_of_a_wrong_acceleration_is_that_where_it_is_computed() -> None:
    verdict = derivation("cart-pole").check(DOTTED.replace("(J + m*l^2)*f1 - ", "(J + m*l^2)*f1 + "))
    assert [f.line.number for f in verdict.findings if f.status is Status.WRONG] == [7]


@pytest.fixture(scope="module")
def disk() -> lg.Derivation:
    s = lg.System("rolling disk")
    x, phi = s.coordinates("x phi")
    m, J, R = s.parameters("m J R", m=1.0, J=0.1, R=0.3)
    s.kinetic((m * x.diff() ** 2 + J * phi.diff() ** 2) / 2)
    s.force(s.input("F"), deflection=x)
    s.velocity_constraint(x.diff() - R * phi.diff(), name="rolling")
    return s.derive()


ROLLING = """function disk!(du, u, p, t)
    x, φ, v, ω = u
    A = [m  0  -1
         0  J   R
         1 -R   0]
    a = A \\ [F(t), 0, 0]
    du .= [v, ω, a[1], a[2]]
end
# a[3] = H
"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize("solved", ["a", "acc"])
def test_unknowns_beside_the_accelerations_are_multipliers(disk: lg.Derivation, solved: str) -> None:
    program = ROLLING.replace("    a =", f"    {solved} =").replace("a[", f"{solved}[")
    verdict = disk.check(program)
    assert verdict.right and "'H' was read as" in verdict.to_text()
    assert not disk.check(program.replace("J   R\n", "J  -R\n"), hint=0).right
    assert not disk.check(program.replace("1 -R", "1  R"), hint=0).right


@pytest.mark.slow
def test_rates_of_positions_that_are_positions_are_wrong() -> None:
    verdict = derivation("cart-pole").check(DOTTED.replace("u[3:4]", "u[1:2]"))
    assert not verdict.right and "does not agree" in " ".join(verdict.to_text().split())


def test_values_of_parameters_stand_below_by_their_names() -> None:
    values = """p = (M=1.0, m=0.2, l=0.5, J=0.0, b=0.1, g=9.81)
sol = solve(ODEProblem(pole!, [0.0, 0.1, 0.0, 0.0], (0.0, 5.0), p), Tsit5())
"""
    judge = derivation("cart-pole")
    assert judge.check(IN_PLACE + values, hint=0).right
    assert not judge.check(IN_PLACE.replace("- b*v", "+ b*v") + values, hint=0).right


def test_names_that_python_keeps_for_itself_are_names_in_julia() -> None:
    program = DOTTED.replace("f1", "as").replace("f2", "lambda")
    judge = derivation("cart-pole")
    assert judge.check(program, hint=0).right
    assert not judge.check(program.replace("- b*ẋ", "+ b*ẋ"), hint=0).right


@pytest.mark.slow
def test_values_in_tuples_and_by_conditions() -> None:
    program = """M, m, l = 1.0, 0.2, 0.3
J, b, g = 0.006, 0.1, 9.81
F(t) = t < 1 ? 20.0 : 0.0
function massmatrix(θ)
    [M + m        m*l*cos(θ);
     m*l*cos(θ)   J + m*l^2]
end
function pole!(du, u, _, t)
    x, θ, v, ω = u
    du[1:2] = [v, ω]
    du[3:4] = massmatrix(θ) \\ [F(t) - b*v + m*l*sin(θ)*ω^2, m*g*l*sin(θ)]
end"""
    cart = derivation("cart-pole")
    assert cart.check(program, hint=0).right
    assert cart.check(program.replace("F(t) = t < 1 ? 20.0 : 0.0\n", "").replace("F(t)", "F"), hint=0).right
    for old, new in (("F(t) -", "-F(t) -"), ("J + m", "J - m"), ("[v, ω]", "[ω, v]")):
        assert not cart.check(program.replace(old, new), hint=0).right


@pytest.mark.slow
@pytest.mark.parametrize("example", ["push(t) = 8 + 2sin(3t)\n", "push(t) = 5.0\n"])
def test_a_function_of_time_alone_is_the_input_that_a_program_does_not_name(example: str) -> None:
    program = example + IN_PLACE.replace("F(t)", "push(t)")
    pole = derivation("cart-pole")
    assert pole.check(program).right
    assert not pole.check(program.replace("push(t) - b", "push(t) + b")).right
    assert not pole.check(program.replace("push(t) - b", "2*push(t) - b")).right
    assert not pole.check(program.replace("push(t) - b", "push(t)^2 - b")).right


@pytest.mark.slow
def test_one_function_of_time_whose_name_may_be_a_force_is_the_input_with_a_note() -> None:
    pole = derivation("cart-pole")
    said = "'push(t)' was read as F, with the value that you give it."
    program = "push(t) = 5.0\n" + IN_PLACE.replace("F(t)", "push(t)")
    assert said in pole.check(program).to_text()
    for name in ("damping", "height", "friction"):
        assert not pole.check(program.replace("push", name), hint=0).right
        assert not pole.check(program.replace("push", name).replace("= 5.0", "= 8 + 2sin(3t)"), hint=0).right
    assert not pole.check(program.replace("push", "offset"), hint=0).right
    two = "motor(t) = 3.0\n" + program
    assert pole.check(two, hint=0).right
    assert not pole.check(two.replace("push(t) - b", "push(t) + motor(t) - b"), hint=0).right
    assert not pole.check(two.replace("push(t) - b", "push(t) - b").replace("m*g*l", "motor(t) + m*g*l"), hint=0).right


SEVERAL = """function pole!(du, u, p, t)
    x, θ, v, ω = u
    M, m, l, J, b, g = p
    s, c = sin(θ), cos(θ)
    D = (M + m)*(J + m*l^2) - (m*l*c)^2
    f1, f2 = F(t) - b*v + m*l*s*ω^2, m*g*l*s
    du[1] = v; du[2] = ω
    du[3] = ((J + m*l^2)*f1 - m*l*c*f2)/D
    du[4] = ((M + m)*f2 - m*l*c*f1)/D
end
"""


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "program",
    [
        SEVERAL,
        SEVERAL.replace("s, c = sin(θ), cos(θ)", "c, s = cos(θ), sin(θ)"),
        SEVERAL.replace("s, c = sin(θ), cos(θ)", "s, c = sin(θ), cos(θ)  # both"),
        SEVERAL.replace("s, c = sin(θ), cos(θ)", "s, c, n = sin(θ), cos(θ), 2"),
        SEVERAL.replace("s, c = sin(θ), cos(θ)", "s , c  =  sin(1.0*(θ)), cos(θ)"),
        SEVERAL.replace("s, c = sin(θ), cos(θ)", "s, c = sin(u[2]), cos(u[2])"),
    ],
)
def test_several_values_at_once_are_given_in_their_order(program: str) -> None:
    pole = derivation("cart-pole")
    assert pole.check(program).right
    assert not pole.check(program.replace("m*g*l", "-m*g*l"), hint=0).right


@pytest.mark.parametrize("several", ["s, c = cos(θ), sin(θ)", "c, s = sin(θ), cos(θ)", "s, c = sin(θ), sin(θ)"])
def test_several_values_in_another_order_are_wrong(several: str) -> None:
    assert not derivation("cart-pole").check(SEVERAL.replace("s, c = sin(θ), cos(θ)", several), hint=0).right
