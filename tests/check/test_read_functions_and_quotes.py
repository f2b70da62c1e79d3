"""Functions of programs without a name, equations in quotes, and state spaces that only a comment puts together.

Oracle: the accelerations of two carts, x1'' = (k x2r − F)/m1 and x2r'' = (F − k x2r) (1/m1 + 1/m2).
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian.errors import ParseError

FIRST, SECOND = "(k*y(2) - F)/m1", "(F - k*y(2))*(1/m1 + 1/m2)"
PYTHON = ", ".join(["y[2]", "y[3]", "(k*y[1] - F)/m1", "(F - k*y[1])*(1/m1 + 1/m2)"])
SPACE = """A = [0 0 1 0; 0 0 0 1; 0 k/m1 0 0; 0 -k*(1/m1+1/m2) 0 0];
B = [0; 0; -1/m1; 1/m1+1/m2];
"""
ROWS = ("m1*x1dd - k*x2r + F = 0", "m2*(x1dd + x2rdd) + k*x2r - F = 0")


def right(answer: str) -> bool:
    return derivation("lecture-3b").check(answer, hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "answer",
    [
        f"f = @(t,y) [y(3); y(4); {FIRST}; {SECOND}];",
        f"f=@(t,y)[y(3);\n  y(4);\n  {FIRST};\n  {SECOND}];\n[t,y] = ode45(f,[0 5],y0);",
        f"f = @(t,y) [y(3); y(4); ...\n  {FIRST}; ...\n  {SECOND}];",
        f"[t,y] = ode45(@(t,y) [y(3); y(4); {FIRST}; {SECOND}], [0 10], [0 1 0 0]);\nplot(t,y)",
        f"% y = [x2r x1 x2rdot x1dot]\nf = @(~,y) [y(3); y(4); {SECOND.replace('y(2)', 'y(1)')}; "
        f"{FIRST.replace('y(2)', 'y(1)')}];",
        "M = @(y) [m1, 0; m2, m2];\nh = @(y) [k*y(2) - F; F - k*y(2)];\nf = @(t,y) [y(3:4); M(y)\\h(y)];",
        "Mass = @(t,z) [m1, 0;\n  m2, m2];\nrhs = @(t,z) [k*z(2) - F;\n  F - k*z(2)];\n"
        "f = @(t,z) [z(3); z(4); Mass(t,z)\\rhs(t,z)];\n[tt,zz] = ode45(f, [0 2], [0 0.1 0 0]);",
        f"f = lambda t, y: [{PYTHON}]",
        "import numpy as np\nfrom scipy.integrate import solve_ivp\n"
        f"sol = solve_ivp(lambda t, y: np.array([{PYTHON}]), (0, 5), y0)",
        f"{SPACE}f = @(t,y) A*y + B*F;   % y = [x1; x2r; x1dot; x2rdot]",
    ],
)
def test_functions_without_a_name_give_the_rates_of_a_state(answer: str) -> None:
    assert right(answer)
    wrong = answer.replace("1/m1 + 1/m2", "1/m1 - 1/m2").replace("; 0 -k*(", "; 0 k*(").replace("[m1, 0;", "[m1, m2;")
    assert wrong != answer
    assert not right(wrong)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "answer",
    [
        "% z = [x1; x2r; x1d; x2rd], zdot = A*z + B*F\nSPACE",
        "% state z = [x1, x2r, x1', x2r']^T,  dz/dt = A*z + B*F\nSPACE",
        "SPACE% z' = A*z + B*F   with z = [x1; x2r; dx1; dx2r]",
        "% states z = (x1, x2r, x1_dot, x2r_dot)\nSPACE% dzdt = A*z + B*F",
        "% state vector: q = [x1 x2r x1d x2rd]'\n% qdot = A*q + B*F\nSPACE",
    ],
)
def test_a_comment_puts_a_state_space_together(answer: str) -> None:
    whole = answer.replace("SPACE", SPACE)
    assert right(whole)
    assert not right(whole.replace("-1/m1;", "1/m1;"))


def test_a_state_may_be_called_as_a_coordinate_that_the_code_does_not_use() -> None:
    assert right(f"% x = [x1; x2r; x1d; x2rd], xdot = A*x + B*F\n{SPACE}")


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "form",
    [
        'eq1 = "{}"\neq2 = "{}"',
        "eq1 = '{}';\neq2 = '{}';",
        'eqs = ["{}", "{}"]',
        'eqs = [\n  "{}",\n  "{}",\n]',
        '{{\n  "eq1": "{}",\n  "eq2": "{}"\n}}',
        'print("{}")\nprint("{}")',
        "eq1 = str2sym('{}');\neq2 = str2sym('{}');",
        "from sympy import sympify\neq1 = sympify('{}')\neq2 = sympify('{}')",
    ],
)
def test_equations_in_quotes(form: str) -> None:
    assert right(form.format(*ROWS))
    assert not right(form.format(ROWS[0].replace("+ F", "- F"), ROWS[1]))
    assert not right(form.format(ROWS[0], ROWS[1].replace("+ k", "- k")))


def test_energies_in_quotes_are_judged() -> None:
    energies = 'T = "m1*x1d**2/2 + m2*(x1d + x2rd)**2/2"\nV = "k*x2r**2/2"\n'
    rows = 'eq1 = "{}"\neq2 = "{}"'.format(*ROWS)
    assert right(energies + rows)
    assert not right(energies.replace("/2 + m2", "/2 - m2") + rows)
    assert "V" in derivation("lecture-3b").check(energies.replace("k*x2r**2/2", "k*x2r**2") + rows).to_text()


def test_a_text_in_quotes_is_no_formula() -> None:
    title = 'title = "carts on a spring - my answer"\nprint("the result is right")\nprint("x1 = ", x)\n'
    assert right(title + "\n".join(ROWS))
    with pytest.raises(ParseError):
        derivation("lecture-3b").check('T = "two carts"')


@pytest.mark.sampled(4)
@pytest.mark.parametrize("module", ["import sympy as sp", "import sympy as sm", "import sympy as symbolic"])
@pytest.mark.parametrize("call", ["simplify", "expand", "trigsimp"])
def test_what_a_module_rewrites_stands_for_itself(module: str, call: str) -> None:
    name = module.split()[-1]
    moved = f"{module}\nx = {name}.Matrix([x1, x1 + x2r])\nv = x.diff(t)\n"
    energies = f"T = m1*x1.diff(t)**2/2 + m2*{name}.{call}(v[1]**2)/2\nV = {name}.{call}(k*x2r**2/2)\n"
    assert right(moved + energies + "\n".join(ROWS))
    wrong = derivation("lecture-3b").check(moved + energies.replace("k*x2r", "k*x1") + "\n".join(ROWS))
    assert "not right" in wrong.to_text()
