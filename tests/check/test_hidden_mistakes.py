"""Mistakes behind what is left out of answers: words, comments, general equations, names that nothing uses."""

import pytest

import lagrangian as lg
from built_in import derivation

ROWS = """(M + m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + b x' = F
m l x'' cos(theta) + (J + m l^2) theta'' - m g l sin(theta) = 0"""
CART = lg.example("cart-pole").derive()
CARTS = lg.example("lecture-3b").derive()


def told(answer: str) -> list[str]:
    """The notes on an answer that is right."""
    found = CART.check(answer)
    assert found.right
    return [str(note) for note in found.notes]


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("∂V/∂theta = -m g l sin(theta)", "∂V/∂theta = m g l sin(theta)"),
        ("dT/dtheta = -m l x' theta' sin(theta)", "dT/dtheta = 0"),
        ("∂T/∂x' = (M + m) x' + m l theta' cos(theta)", "∂T/∂x' = M x' + m l theta' cos(theta)"),
        ("dD/dx' = b x'", "dD/dx' = 2 b x'"),
    ],
)
def test_a_derivative_of_an_energy_that_no_line_states_is_judged(right: str, wrong: str) -> None:
    assert told(f"{right}\n{ROWS}") == []
    found = CART.check(f"{wrong}\n{ROWS}")
    assert not found.right and found.first_wrong is not None and found.first_wrong.line.number == 1


def test_equations_use_the_derivatives_that_an_answer_gives() -> None:
    """J φ̈ + ∂V/∂φ = M says nothing by itself: with a wrong ∂V/∂φ above or below it, the motion is wrong."""
    rows = "(M + m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + b x' = F\n"
    rows += "m l x'' cos(theta) + (J + m l^2) theta'' + ∂V/∂theta = 0\n"
    right, wrong = "∂V/∂theta = -m g l sin(theta)\n", "∂V/∂theta = -m g l cos(theta)\n"
    assert CART.check(right + rows).right and CART.check(rows + right).right
    for answer, line in ((wrong + rows, 1), (rows + wrong, 2)):
        found = CART.check(answer)
        assert found.status.name == "WRONG" and line in {f.line.number for f in found.findings if not f.status.right}


@pytest.mark.parametrize(
    ("right", "wrong", "energy"),
    [
        ("d/dt(dL/dx') - dL/dx = F - b x'", "d/dt(dL/dx') - dL/dx = 2 F - b x'", "L"),
        ("d/dt(∂T/∂x') - ∂T/∂x + ∂V/∂x + ∂D/∂x' = F", "d/dt(∂T/∂x') - ∂T/∂x + ∂V/∂x + ∂D/∂x' = 2 F", "D, T and V"),
    ],
)
def test_equations_with_energies_that_no_line_states_are_told_where_they_do_not_hold(
    right: str, wrong: str, energy: str
) -> None:
    assert told(f"{right}\n{ROWS}") == []
    (note,) = told(f"{wrong}\n{ROWS}")
    assert wrong in note and f"no line states {energy}" in note


def test_general_equations_are_not_told() -> None:
    assert told(f"d/dt(dL/dtheta') - dL/dtheta = Xi_theta\nd/dt(dT/dx') + dV/dx = Q_x\n{ROWS}") == []


def test_lagranges_equation_with_a_momentum_is_no_slope_of_the_lagrangian() -> None:
    law = "p_th = (J + m l^2) theta' + {} m l x' cos(theta)\nd(p_th)/dt = dL/dtheta\n"
    assert told(law.format("") + ROWS) == []
    (note,) = told(law.format("2") + ROWS)
    assert "d(p_th)/dt = dL/dtheta" in note and "does not hold" in note


def test_slopes_by_names_of_an_answers_own_are_told() -> None:
    (note,) = told(f"u = l sin(theta)\n∂V/∂u = m g\n{ROWS}")
    assert "∂V/∂u = m g" in note and "not judged" in note


@pytest.mark.parametrize(
    "said",
    ["(negative)", ", negative", "(doubled, two motors)", "less the weight", "with the opposite sign", "(minus)"],
)
def test_words_behind_an_equation_that_may_change_it_are_told(said: str) -> None:
    assert any("Words on line 1 may change" in x for x in told(ROWS.replace("= F", f"= F {said}")))


@pytest.mark.slow
def test_a_force_is_right_with_another_coordinate_only_where_the_equations_use_that() -> None:
    force = "Q_theta = -(F - b x') l cos(theta)"
    assert not CART.check(f"w = x + l sin(theta)\n{force}\n{ROWS}", hint=0).right
    rows = "x2 = x1 + x2r\nm1 x1'' = k (x2 - x1) - F\nm2 x2'' = F - k (x2 - x1)"
    assert CARTS.check(f"Q_1 = -F\nQ_2 = F\n{rows}", hint=0).right
    assert not CARTS.check(f"Q_1 = F\nQ_2 = F\n{rows}", hint=0).right


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("L = T - V", "L = T + V"),
        ("L = -V + T", "L = V"),
        ("(D, V) = (b*x'^2/2, m*g*l*cos(theta))", "(D, V) = (b*x'^2, m*g*l*cos(theta))"),
        ("v' = x''\nx'' = v'", "x'' = v'\nv' = F/M"),
    ],
)
def test_formulas_of_the_lagrangian_energies_in_pairs_and_two_values_of_a_rate_are_judged(
    right: str, wrong: str
) -> None:
    assert CART.check(f"{right}\n{ROWS}", hint=0).right
    assert not CART.check(f"{wrong}\n{ROWS}", hint=0).right


def test_a_matrix_that_no_equation_uses_is_told() -> None:
    assert any("no equation uses this matrix M" in x for x in told(f"{ROWS}\nM = [M, 0; 0, J]"))


@pytest.mark.parametrize("mark", ["#", "//", "%"])
def test_an_equation_of_motion_in_a_comment_is_told(mark: str) -> None:
    assert told(f"{mark} the equations of the cart\n{ROWS}") == []
    (note,) = told(f"{ROWS}\n{mark} (M + m) x'' = F")
    assert "(M + m) x'' = F" in note and "comment" in note


ENERGIES = """T = 1/2 (M + m) x'^2 + m l x' theta' cos(theta) + 1/2 (J + m l^2) theta'^2
V = m g l cos(theta)"""
WRONG_ROWS = ROWS.replace("+ b x'", "- b x'")


def commented(rows: str, mark: str) -> str:
    """Equations in comments."""
    return "\n".join(f"{mark} {row}" for row in rows.splitlines())


@pytest.mark.sampled(3)
@pytest.mark.parametrize("mark", ["#", "%", "//", "##  and"])
def test_equations_that_only_comments_state_are_read(mark: str) -> None:
    (first, *_) = told(f"{ENERGIES}\n{commented(ROWS, mark)}")
    assert "was read, though it is a comment" in first
    assert not CART.check(f"{ENERGIES}\n{commented(WRONG_ROWS, mark)}", hint=0).right
    assert not CART.check(commented(WRONG_ROWS, mark), hint=0).right
    assert told(f"{ROWS}\n{commented(WRONG_ROWS, mark)}")  # where a line states them, a comment is none


def test_comments_in_brackets_behind_lines_and_over_several_lines_are_read() -> None:
    for rows, is_right in ((ROWS, True), (WRONG_ROWS, False)):
        above, below = rows.splitlines()
        over = above.replace(" - m l theta'^2", "\n#    - m l theta'^2")
        assert CART.check(f"{ENERGIES}\n(* the result:\n{rows} *)", hint=0).right == is_right
        assert CART.check(f"{ENERGIES}   # {above}\n# and {below}", hint=0).right == is_right
        assert CART.check(f"{ENERGIES}\n# of x:\n#  {over}\n# of theta:\n#  {below}", hint=0).right == is_right
    assert not CART.check(f"{ENERGIES}\n# ddx = (F - b*dx)/(M + m)", hint=0).right


def test_accelerations_that_a_function_returns_are_judged() -> None:
    program = """def accelerations(x, theta, xd, thetad, F):
    A = np.array([[M + m, m*l*np.cos(theta)], [m*l*np.cos(theta), J + m*l**2]])
    f = np.array([F - b*xd + m*l*np.sin(theta)*thetad**2, m*g*l*np.sin(theta)])
    return np.linalg.solve(A, f)"""
    assert CART.check(program, hint=0).right
    assert not CART.check(program.replace("F - b*xd", "F + b*xd"), hint=0).right
    assert not CART.check(f"# T = 1/2*M*x'^2\n{program}".replace("m*g*l*", "-m*g*l*"), hint=0).right


def test_matrices_that_no_equation_uses_lack_it() -> None:
    """A position that nothing uses takes nothing away from T* and V."""
    matrix, column = "A = [M + m, m l cos(theta); m l cos(theta), J + m l^2]", "f = [F + b x'; m g l sin(theta)]"
    for said in (matrix, column, f"{matrix}\n{column}"):
        assert CART.check(f"{ENERGIES}\n{said}", hint=0).status == "incomplete"
    assert told(f"{ENERGIES}\nr_1 = (x, 0)")
    assert not CART.check(f"{ENERGIES}\n{matrix}\n{column}\nA q'' = f", hint=0).right


def test_a_comment_that_cannot_be_read_refuses_no_answer_that_can() -> None:
    rows = "M = [m1, 0; m2, m2];\nf = [k*x2r - F; F - k*x2r];\n"
    answer = f"% carts: M(q)*qdd = f\nT = m1*x1d^2/2 + m2*(x1d + x2rd)^2/2;\nV = k*x2r^2/2;\n{rows}qdd = M\\f;\n"
    assert derivation("lecture-3b").check(answer, hint=0).right
    assert not derivation("lecture-3b").check(answer.replace("F - k", "F + k"), hint=0).right
