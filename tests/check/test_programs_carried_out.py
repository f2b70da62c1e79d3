"""Programs that derive or solve equations are carried out on symbols, and nothing of them is executed."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation
from effort import at_most
from lagrangian.check.reading.carried_out.stated import carried_out
from lagrangian.check.reading.file_text import decode_answer

SYMPY = '''import sympy as sp
from sympy.physics.mechanics import dynamicsymbols
M, m, l, J, b, g, F = sp.symbols("M m l J b g F")
t = sp.Symbol("t")
x, th = dynamicsymbols("x theta")
r = sp.Matrix([x + l*sp.sin(th), l*sp.cos(th)])
v = r.diff(t)
T = M*x.diff(t)**2/2 + m*sp.simplify(v.dot(v))/2 + J*th.diff(t)**2/2
V = m*g*r[1]
L = T - V

def lagrange(q, Q):
    """Left minus right."""
    return sp.simplify(L.diff(q.diff(t)).diff(t) - L.diff(q) - Q)

eqs = [lagrange(q, Q) for q, Q in zip([x, th], [F - b*x.diff(t), 0])]
for e in eqs:
    print(sp.expand(e), "= 0")
'''

IN_AN_EQUATION = """from sympy import *
t = symbols('t')
M, m, l, J, b, g, F = symbols('M m l J b g F')
x = Function('x')(t)
th = Function('theta')(t)
xp, yp = x + l*sin(th), l*cos(th)
T = M*x.diff(t)**2/2 + m*(xp.diff(t)**2 + yp.diff(t)**2)/2 + J*th.diff(t)**2/2
V = m*g*yp
L = T - V
print(Eq(L.diff(x.diff(t)).diff(t) - L.diff(x), F - b*x.diff(t)))
print(Eq(L.diff(th.diff(t)).diff(t) - L.diff(th), 0))
"""

SOLVE_IVP = """import numpy as np
from scipy.integrate import solve_ivp

p = dict(M=1.0, m=0.2)
M, m, l, J, b, g = 1.0, 0.2, 0.3, 0.006, 0.1, 9.81

def rhs(t, z, F):
    x, th, xd, thd = z
    A = np.array([[M + m, m*l*np.cos(th)], [m*l*np.cos(th), J + m*l**2]])
    f = np.array([F - b*xd + m*l*thd**2*np.sin(th), m*g*l*np.sin(th)])
    acc = np.linalg.solve(A, f)
    return [xd, thd, acc[0], acc[1]]

sol = solve_ivp(rhs, (0, 5), [0, 0.1, 0, 0], args=(0.0,))
"""

MATLAB = r"""function dz = cartpole(t, z, p, F)
% z = [x; theta; xdot; thetadot]
th = z(2); thd = z(4);
A = [p.M + p.m          p.m*p.l*cos(th);
     p.m*p.l*cos(th)    p.J + p.m*p.l^2];      % mass matrix
f = [F - p.b*z(3) + p.m*p.l*thd^2*sin(th); ...
     p.m*p.g*p.l*sin(th)];
qdd = A\f;
dz = [z(3); thd; qdd(1); qdd(2)];
end
"""

ANONYMOUS = r"""M = 1; m = 0.2; l = 0.3; J = 0.006; b = 0.1; g = 9.81;
Mass = @(z) [M+m, m*l*cos(z(2)); m*l*cos(z(2)), J+m*l^2];
right = @(t,z) [F - b*z(3) + m*l*z(4)^2*sin(z(2)); m*g*l*sin(z(2))];
f = @(t,z) [z(3); z(4); Mass(z)\right(t,z)];
[tt, zz] = ode45(f, [0 5], [0 0.1 0 0]);
"""

ENTRIES = r"""function dx = rates(t, x)
x1 = x(1); th = x(2); v = x(3); w = x(4);
F = force(t);
A = zeros(2);
A(1,1) = M + m;
A(1,2) = m*l*cos(th);
A(2,1) = m*l*cos(th);
A(2,2) = J + m*l^2;
f(1,1) = F - b*v + m*l*w^2*sin(th);
f(2,1) = m*g*l*sin(th);
qdd = A\f;
dx = [v; w; qdd(1); qdd(2)];
end
"""

SYMBOLIC = r"""syms x(t) theta(t) M m l J b g F
xp = x + l*sin(theta); yp = l*cos(theta);
T = M*diff(x,t)^2/2 + m*(diff(xp,t)^2 + diff(yp,t)^2)/2 + J*diff(theta,t)^2/2;
V = m*g*yp;
L = T - V;
eq1 = diff(diff(L, diff(x,t)), t) - diff(L, x) == F - b*diff(x,t)
eq2 = diff(diff(L, diff(theta,t)), t) - diff(L, theta) == 0
"""

IN_LETTERS = r"""syms M m l J b g F real
syms x th xd thd xdd thdd real
T = M*xd^2/2 + m*(xd^2 + 2*l*xd*thd*cos(th) + l^2*thd^2)/2 + J*thd^2/2;
L = T - m*g*l*cos(th);
q = [x th]; qd = [xd thd]; qdd = [xdd thdd];
p = jacobian(L, qd);                              % momenta
dp = (jacobian(p, q)*qd.' + jacobian(p, qd)*qdd.').';
eom = simplify(dp - jacobian(L, q) - [F - b*xd, 0])
% eom(1) = (M + m)*xdd + m*l*thdd*cos(th) - m*l*thd^2*sin(th) + b*xd - F
"""

IN_STEPS = SOLVE_IVP.replace(
    "def rhs(t, z, F):", "def F(t):\n    return 3*np.sin(t)  # an example\n\ndef rhs(t, z):"
).replace("F - b*xd +", "F(t) - b*xd +")

ADDED_UP = IN_AN_EQUATION.replace("T = M*x.diff(t)**2/2 + m*", "T = M*x.diff(t)**2/2\nT += m*")

OPEN = r"""A = [M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2];
f = [F - b*xd + m*l*thetad^2*sin(theta); ...
     m*g*l*sin(theta)];
acc = A\f;   % acc(1) = xdd, acc(2) = thetadd
"""

COMPARED = (
    IN_AN_EQUATION.replace("print(Eq(", "e1 = Eq(", 1)
    .replace("print(Eq(", "e2 = Eq(", 1)
    .replace("F - b*x.diff(t)))", "F - b*x.diff(t))")
    .replace(", 0))", ", 0)")
)
COMPARED += "print(simplify(LagrangesMethod(L, [x, th]).form_lagranges_equations() - Matrix([e1.lhs, e2.lhs])))\n"

QUOTED = """T = "1/2*M*xd**2 + 1/2*m*(xd**2 + 2*l*xd*thetad*cos(theta) + l**2*thetad**2) + 1/2*J*thetad**2"
eq1 = "(M + m)*xdd + m*l*thetadd*cos(theta) - m*l*thetad**2*sin(theta) = F - b*xd"
eq2 = "m*l*xdd*cos(theta) + (J + m*l**2)*thetadd - m*g*l*sin(theta) = 0"
"""

PROGRAMS = {
    "SymPy with a function of its own": (SYMPY, "L.diff(q) - Q", "L.diff(q) + Q"),
    "equations that are printed": (IN_AN_EQUATION, "F - b*x.diff(t)", "F + b*x.diff(t)"),
    "a function for solve_ivp": (SOLVE_IVP, "F - b*xd", "F + b*xd"),
    "a function in MATLAB": (MATLAB, "p.J + p.m*p.l^2", "p.J - p.m*p.l^2"),
    "a column behind a stroke": (MATLAB.replace("A\\f", "A\\[f(1); f(2)]"), "p.J + p.m*p.l^2", "p.J - p.m*p.l^2"),
    "anonymous functions": (ANONYMOUS, "m*g*l*sin", "-m*g*l*sin"),
    "entry by entry": (ENTRIES, "f(2,1) = m", "f(2,1) = -m"),
    "symbols of MATLAB": (SYMBOLIC, "V = m*g*yp", "V = -m*g*yp"),
    "accelerations in the open": (OPEN, "F - b*xd", "F + b*xd"),
    "compared with what another computes": (COMPARED, "F - b*x.diff(t)", "F + b*x.diff(t)"),
    "rates in letters": (IN_LETTERS, "- m*g*l*cos", "+ m*g*l*cos"),
    "an input by a function": (IN_STEPS, "F(t) - b*xd", "F(t) + b*xd"),
    "a sum in steps": (ADDED_UP, "T += m", "T += 2*m"),
    "formulas in quotes": (QUOTED, "- m*g*l", "+ m*g*l"),
}


@pytest.mark.sampled(16)
@pytest.mark.parametrize(("text", "right", "wrong"), PROGRAMS.values(), ids=PROGRAMS)
def test_what_a_program_computes_is_judged(text: str, right: str, wrong: str) -> None:
    assert right in text
    assert derivation("cart-pole").check(text).right
    assert not derivation("cart-pole").check(text.replace(right, wrong)).right


def test_a_state_space_may_have_any_matrix() -> None:
    """The linear model of a cart on a spring: any letter may be that of the matrix."""
    sys = lg.System("cart")
    x = sys.coordinate("x")
    m, k, b = sys.parameters("m k b")
    sys.particle(m, at=sys.point("P", (x, 0)))
    sys.spring(k, deflection=x)
    sys.damper(b, deflection=x)
    for name in ("A", "G"):
        said = f"{name} = [0 1; -k/m -b/m];\nf = @(t,y) {name}*y;\n"
        assert "x'' = -b*x'/m - k*x/m" in str(carried_out(said, sys.model))
        assert sys.derive().check(said).right
        assert not sys.derive().check(said.replace("-b/m", "b/m")).right


def test_statements_stand_on_the_lines_of_the_program() -> None:
    found = carried_out(IN_AN_EQUATION, derivation("cart-pole").model)
    assert found is not None
    made = found.text
    lines = made.split("\n")
    assert (
        lines[6].startswith("T = ")
        and lines[9].endswith("= F - b*x'")
        and len(lines) == len(IN_AN_EQUATION.split("\n"))
    )


@pytest.mark.slow
def test_rates_of_a_state_are_what_its_entries_say_and_not_their_names() -> None:
    swapped = MATLAB.replace("dz = [z(3); thd;", "dz = [thd; z(3);")
    assert not derivation("cart-pole").check(swapped).right


def test_an_equation_that_is_used_for_another_is_none() -> None:
    found = carried_out(SYMPY.replace("print(", "late = ("), derivation("cart-pole").model)
    assert found is None or "p = " not in found.text


def test_comments_with_accelerations_are_read_beside_the_program() -> None:
    comment = "# printed: (M + m)*x'' + m*l*cos(theta)*theta'' - m*l*sin(theta)*theta'**2 + b*x' - F = 0\n"
    found = carried_out(f"{IN_AN_EQUATION}# output, sorted by hand\n{comment}", derivation("cart-pole").model)
    assert found is not None
    made = found.text
    assert made.split("\n")[-2] == comment[1:].strip("\n") and made.split("\n")[-3] == ""


def test_a_program_that_is_carried_out_is_told() -> None:
    verdict = derivation("cart-pole").check(SYMPY)
    assert any("carried out on symbols" in str(note) for note in verdict.notes)


def test_a_notebook_is_its_cells_and_what_they_show() -> None:
    cells = [
        {"cell_type": "markdown", "source": ["The cart:\n", "\n", "$(M+m)\\ddot x + m l\\ddot\\theta\\cos\\theta"]},
        {
            "cell_type": "code",
            "source": "m l cos(theta) x'' + (J + m l^2) theta'' - m g l sin(theta) = 0",
            "outputs": [],
        },
    ]
    cells[0]["source"].append(" - m l\\dot\\theta^2\\sin\\theta = F - b\\dot x$")  # type: ignore[attr-defined]
    shown = {"output_type": "execute_result", "execution_count": 3, "data": {"text/latex": ["$\\displaystyle x$"]}}
    cells[1]["outputs"] = [shown, {"output_type": "error"}, 4, {"data": 5}]
    text = decode_answer(json.dumps({"cells": [*cells, 7], "nbformat": 4}).encode(), "answer.ipynb")
    assert text.startswith("The cart:\n\n$(M+m)") and "Out[3]: $\\displaystyle x$" in text
    assert decode_answer(b'{"cells": [', "answer.ipynb") == '{"cells": ['
    assert decode_answer(b'{"cells": 3}', "answer.ipynb") == '{"cells": 3}'
    right = text.replace("Out[3]: $\\displaystyle x$", "")
    assert derivation("cart-pole").check(right).right


HOSTILE = {
    "commands": "import os\nos.system('touch {here}')\nopen('{here}', 'w').write('x')\n" + IN_AN_EQUATION,
    "imports": "__import__('os').system('touch {here}')\nimport sympy\n" + IN_AN_EQUATION,
    "a tower of powers": "import sympy as sp\nx = 10\n" + "x = x**12\n" * 40,
    "a long range": "import sympy as sp\nx = 1\nfor k in range(10**9):\n    x = x + k\n",
    "loops in loops": "import sympy as sp\n"
    + "".join(f"{' ' * k}for a{k} in range(60):\n" for k in range(8))
    + " " * 8
    + "x = 1\n",
    "a function that calls itself": "import sympy as sp\ndef f(x):\n    return f(x) + f(x)\ny = f(1)\n",
    "doubling": "import sympy as sp\nx = sp.Symbol('x')\n" + "x = x*x + x\n" * 60,
    "signs": "import sympy as sp\nx = " + "-" * 9000 + "1\n",
    "dots": "import sympy as sp\nx = sp" + ".a" * 9000 + "\n",
    "sums": "import sympy as sp\nx = " + "a+" * 9000 + "a\n",
    "brackets": "import sympy as sp\nx = " + "(" * 9000 + "1" + ")" * 9000 + "\n",
    "derivatives": "import sympy as sp\nt = sp.Symbol('t')\nx = sp.Function('x')(t)\ny = x\n"
    + "y = (y*y).diff(t)\n" * 60,
    "matrices": "import sympy as sp\nA = sp.zeros(8, 8)\n" + "A = A*A + A\n" * 3000,
    "MATLAB in brackets": "function dx = f(t, x)\n" + "dx = [" * 3000 + "\n",
    "no end of a string": "function dx = f(t, x)\ndx = 'abc\n" * 300,
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE)
def test_a_hostile_program_is_not_executed_and_ends(text: str, tmp_path: Path) -> None:
    here = tmp_path / "made"
    with at_most(8_000_000):
        carried_out(text.replace("{here}", str(here)), derivation("cart-pole").model)
    assert not here.exists()


@pytest.mark.parametrize(
    "text", ["x'' = 0", "Dear sir, from here on it is easy: x'' = F/m", "import of the result: x = 1"]
)
def test_other_texts_are_no_programs(text: str) -> None:
    assert carried_out(text, derivation("cart-pole").model) is None


BOOM = """import sympy as sp
t, u = sp.symbols("t u")
m, L, g, c = sp.symbols("m L g c")
th = sp.Function("theta")(t)
def speed2(u):
    v = sp.Matrix([u*sp.sin(th), -u*sp.cos(th)]).diff(t)
    return v.dot(v)
T = sp.integrate(m/L*speed2(u)/2, (u, 0, L))
V = sp.integrate(-m/L*g*u*sp.cos(th), (u, 0, L))
lagrange = T - V
print(sp.Eq(lagrange.diff(th.diff(t)).diff(t) - lagrange.diff(th), 0))
"""


def test_integrals_along_a_body_are_worked_out() -> None:
    sys = lg.System("thin rod on a pin")
    theta = sys.coordinate("theta")
    m, length, g = sys.parameters("m L g")
    sys.kinetic(m * length**2 * theta.diff() ** 2 / 6)
    sys.potential(-m * g * length * sp.cos(theta) / 2)
    judge = sys.derive()
    assert judge.check(BOOM).right
    assert not judge.check(BOOM.replace("(u, 0, L))\nV", "(u, 0, L/2))\nV")).right
    assert not judge.check(BOOM.replace("g*u*sp.cos", "g*u**2*sp.cos")).right
    none = BOOM.replace("speed2(u)/2", "speed2(u)/2/(u + L)")
    assert carried_out(none, judge.model) is None


IN_COMMENT = """% cart with a pole, state [x theta xd thetad]
A = @(q) [M + m, m*l*cos(q(2)); m*l*cos(q(2)), J + m*l^2];
h = @(q,v) [b*v(1) - m*l*v(2)^2*sin(q(2));
            -m*g*l*sin(q(2))];
B = [1; 0];
% equations of motion: A(q)*qdd + h(q,v) = B*F
"""
OF_MATRICES = """Mq = [M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2];
Dq = [b -m*l*thetad*sin(theta); 0 0];
fq = [F; m*g*l*sin(theta)];
% Mq*qdd + Dq*qd = fq
Ass = [zeros(2) eye(2); zeros(2) -Mq\\Dq];
"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize("program", [IN_COMMENT, OF_MATRICES])
def test_an_equation_of_matrices_in_a_comment_is_carried_out(program: str) -> None:
    judge = derivation("cart-pole")
    assert judge.check(program).right
    for right, wrong in (("m*g*l", "2*m*g*l"), ("J + m*l^2", "J - m*l^2"), ("B*F", "-B*F"), ("+ Dq*qd", "- Dq*qd")):
        assert right not in program or not judge.check(program.replace(right, wrong)).right
    turned = "% q = [theta; x]\n" + program
    assert not judge.check(turned).right


@pytest.mark.slow
@pytest.mark.parametrize("shown", ['print(sp.expand(left), "=", Q)', 'print(f"{sp.expand(left)} = {Q}")'])
def test_two_sides_that_are_printed_with_an_equals_sign_are_an_equation(shown: str) -> None:
    program = SYMPY.partition("def lagrange")[0]
    program += (
        "for q, Q in zip([x, th], [F - b*x.diff(t), 0*m]):\n    left = L.diff(q.diff(t)).diff(t) - L.diff(q)\n    "
    )
    cart = derivation("cart-pole")
    assert cart.check(program + shown).right
    assert not cart.check(program.replace("F - b", "F + b") + shown).right
    assert not cart.check(program.replace("F - b*x.diff(t)", "0*m") + shown).right


@pytest.mark.slow
def test_an_energy_that_a_loop_completes_is_not_judged_before() -> None:
    """What is wrong is told by what the program computes, where this leaves fewer lines wrong than its text."""
    s = lg.System("two on an arm")
    phi, u = s.coordinates("phi s")
    m, k, c, J = s.parameters("m k c J")
    s.kinetic(J * phi.diff() ** 2 / 2, name="arm")
    for name, sign in (("one", 1), ("other", -1)):
        place = s.point(f"P{name}", (sign * u * sp.cos(phi), sign * u * sp.sin(phi)))
        s.particle(m, at=place, name=name)
    s.spring(k=k, deflection=u, name="spring")
    s.damper(b=c, deflection=u, name="damper")
    program = """from sympy import *
t = symbols('t')
m, k, c, J = symbols('m k c J')
phi, s = Function('phi')(t), Function('s')(t)
T = J*phi.diff(t)**2/2
for sign in (1, -1):
    pos = Matrix([sign*s*cos(phi), sign*s*sin(phi)])
    vel = pos.diff(t)
    T += m/2*vel.dot(vel)
V = k*s**2/2
Q_phi = 0
Q_s = -2*c*s.diff(t)
for q, Q in ((phi, Q_phi), (s, Q_s)):
    print(simplify((T - V).diff(q.diff(t)).diff(t) - (T - V).diff(q) - Q))
# 2*m*s'' - 2*m*s*phi'**2 + k*s + 2*c*s' = 0
"""
    derivation = s.derive()
    assert derivation.check(program.replace("2*c", "c")).right
    (mistake,) = derivation.check(program).mistakes
    assert "amper" in str(mistake.what)


def test_parameters_may_be_taken_from_a_table_in_a_list_of_names() -> None:
    program = """import numpy as np
def rhs(t, z, F, P):
    x, th, xd, thd = z
    M, m, l, J, b, g = (P[n] for n in ("M", "m", "l", "J", "b", "g"))
    A = np.array([[M + m, m*l*np.cos(th)], [m*l*np.cos(th), J + m*l**2]])
    f = np.array([F - b*xd + m*l*thd**2*np.sin(th), m*g*l*np.sin(th)])
    acc = np.linalg.solve(A, f)
    return [xd, thd, acc[0], acc[1]]
"""
    cart = derivation("cart-pole")
    assert cart.check(program).right
    assert not cart.check(program.replace("F - b", "F + b")).right
    assert not cart.check(program.replace('("M", "m", ', '("m", "M", ')).right
