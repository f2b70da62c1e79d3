"""Forms in which classes hand in right answers, each beside a wrong answer in the same form.

Oracle: by hand, from the equations of the two small systems.
"""

from __future__ import annotations

import pytest
from small_systems import mass, rod

import lagrangian as lg

ROD = "(J + m r^2) phi'' + 2 m r r' phi' = M"
PUCK = "m r'' - m r phi'^2 + k (r - a) = 0"


def verdict(answer: str, of: lg.Derivation | None = None) -> bool:
    """Whether an answer is right."""
    return (of or mass()).check(answer).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("answer", "slip"),
    [
        pytest.param(
            "Instead of x I take h, the stretch: h = x - 2, so x = h + 2\nm h'' + b h' + k (h + 2) = F",
            ("(h + 2)", "h"),
            id="a new coordinate beside the old one",
        ),
        pytest.param(
            "$S$ = force of the spring $= kx$\n\n$$m\\ddot x = F - b\\dot x - S$$",
            ("- S", "+ S"),
            id="words between a name and its value",
        ),
        pytest.param(
            r"\[\underbrace{F - kx}_{P} - b\dot x = m\ddot x\]" "\n" r"\[m\ddot x = P - b\dot x\]",
            ("F - kx", "F + kx"),
            id="a name below a brace",
        ),
        pytest.param(
            r"\begin{align*}(E_x)\quad& m\ddot x + b\dot x + kx = F\end{align*}",
            ("+ kx", "- kx"),
            id="a label in brackets",
        ),
        pytest.param(
            r"\begin{align*}\text{Newton's law (3)}:\quad& m\ddot x + b\dot x + kx = F\end{align*}",
            ("+ kx", "- kx"),
            id="words and a colon",
        ),
        pytest.param(
            r"\[\begin{bmatrix} m\end{bmatrix}\ddot{\mathbf q} + \begin{bmatrix} b\dot x + kx\end{bmatrix}"
            r" = \begin{bmatrix} F\end{bmatrix}\]",
            ("+ kx", "- kx"),
            id="a bold column",
        ),
        pytest.param(
            "∂V/∂x = k x\nm x'' + b x' + ∂V/∂x = F", ("= k x", "= 2 k x"), id="a derivative without its energy"
        ),
        pytest.param("m x'' + b x' + ∂V/∂x = F\n∂V/∂x = k x", ("= k x", "= 2 k x"), id="a derivative below"),
        pytest.param(
            "q = {x};\nQ = {F - b x'[t]};\nV = k x[t]^2/2; T = m x'[t]^2/2;\n"
            "eom = Table[D[D[T - V, q[[i]]'[t]], t] - D[T - V, q[[i]][t]] == Q[[i]], {i, 1}] // Simplify",
            ("k x[t]^2/2", "k x[t]^2"),
            id="a table of Mathematica",
        ),
        pytest.param(
            "spring: Q_x = -k x, damper: Q_x = -b x', hand: Q_x = F\nT = m x'^2/2\nm x'' + b x' + k x = F",
            ("+ k x = F", "- k x = F"),
            id="forces element by element",
        ),
        pytest.param(
            "Linear, x = x_e + eta (F = 0): m eta'' + b eta' + k eta = 0\n\nm x'' + b x' + k x = F",
            ("+ k x = F", "- k x = F"),
            id="a linearization beside",
        ),
    ],
)
def test_forms_of_a_mass_on_a_spring(answer: str, slip: tuple[str, str]) -> None:
    assert answer.count(slip[0]) == 1
    assert verdict(answer)
    assert not verdict(answer.replace(*slip))


@pytest.mark.parametrize(
    ("answer", "slip"),
    [
        pytest.param(f"L_z = (J + m r^2) phi'\ndL_z/dt = M\n{PUCK}", ("= M", "= 2 M"), id="a momentum"),
        pytest.param(f"v = r'\n∂v/∂r' = 1\n{ROD}\n{PUCK}", ("2 m", "m"), id="a derivative of a rate"),
        pytest.param(
            f"J = m i^2\nm (i^2 + r^2) phi'' + 2 m r r' phi' = M\n{PUCK}", ("2 m", "m"), id="a radius of gyration"
        ),
    ],
)
def test_forms_of_a_puck_on_a_rod(answer: str, slip: tuple[str, str]) -> None:
    assert verdict(answer, rod())
    assert not verdict(answer.replace(*slip), rod())


def test_a_letter_of_a_parameter_may_be_a_momentum() -> None:
    """p = m r^2 phi' of an answer whose system calls a radius p."""
    s = lg.System("mass with a lever")
    x = s.coordinate("x")
    m, k = s.parameters("m k")
    s.parameter("p", description="a length that nothing uses")
    s.particle(m, at=s.point("C", (x, 0)), name="mass")
    s.spring(k, deflection=x)
    d = s.derive()
    assert d.check("p = m x'\np' = -k x").right
    assert d.check("$p = m\\dot x$\n$\\dot p = -kx$").right
    assert not d.check("p = m x'\np' = k x").right


def test_sine_and_cosine_at_once_in_julia() -> None:
    program = """function rod!(du, u, p, t)
    (; m, J, k, a, M) = p
    r, phi, v, w = u
    s, c = sincos(phi)
    du[1:2] .= (v, w)
    du[3] = r*w^2*(s^2 + c^2) - k*(r - a)/m
    du[4] = (M - 2m*r*v*w)/(J + m*r^2)
end"""
    assert verdict(program, rod())
    assert not verdict(program.replace("2m*r*v", "m*r*v"), rod())


def test_a_side_over_lines_with_signs_in_front_goes_on_to_its_equals_sign() -> None:
    answer = "m x''\n+ b x'\n- F\n= -k x"
    assert verdict(answer)
    found = mass().check(answer.replace("+ b", "- b"))
    assert [f.line.number for f in found.findings] == [1]
    assert not verdict(answer.replace("- F", "+ F"))
    assert verdict("m x'' + b x' + k x - F\n\n- F + m x'' + b x' + k x"), "two expressions, each of them zero"


def test_the_numbers_of_two_steps_are_no_factor() -> None:
    steps = "4. T = m x'^2/2\n"
    assert verdict(f"{steps}5./6. m x'' + b x' + k x = F")
    assert not verdict(f"{steps}5./6. m x'' - b x' + k x = F")
    assert not verdict("1./2. m x'' + b x' + k x = F"), "a half, as no step stands above it"


@pytest.mark.parametrize(
    "parts",
    [
        "Q_x = 2 F, Q_x = -F - b x'",
        "spring: Q_x = k x, damper: Q_x = -b x', push: Q_x = F - 2 k x",
        "damper: Q_x = b x', push: Q_x = F - 2 b x'",
        "Q_x = F, Q_x = -b x', Q_x = 0",
        "Q_x = F, Q_x = -b x' - k x\n∂V/∂x = k x",
    ],
)
def test_forces_of_elements_that_only_add_up_by_chance_are_wrong(parts: str) -> None:
    assert not verdict(f"{parts}\nm x'' + b x' + k x = F")


def test_a_derivative_that_is_given_twice_is_judged_twice() -> None:
    assert not verdict("∂V/∂x = k x\n∂V/∂x = 2 k x\nm x'' + b x' + ∂V/∂x = F")
    assert not verdict("m x'' + b x' + ∂V/∂x = F\n∂V/∂x = k x\n∂V/∂x = -k x")
