"""Programs that work with their own functions, loops and simplifications are read to the equations that they say.

Oracle: by hand, a cart on a spring with a pendulum:

    (M + m) ẍ + m l θ̈ cos θ − m l θ̇² sin θ + k x = F,   m l² θ̈ + m l ẍ cos θ + m g l sin θ + b θ̇ = 0
"""

from functools import cache

import pytest
import sympy as sp

from lagrangian import Derivation, ParseError, System


@cache
def cart() -> Derivation:
    """A cart on a spring with a pendulum, whose hinge has friction, driven by a force on the cart."""
    sys = System("cart with a pendulum")
    x, theta = sys.coordinates("x theta")
    M, m, l, k, b, g = sys.parameters("M m l k b g", M=2, m=0.7, l=0.6, k=30, b=0.2, g=9.81)
    hinge = sys.point("A", (x, 0))
    sys.particle(M, at=hinge)
    sys.particle(m, at=sys.point("B", (x + l * sp.sin(theta), -l * sp.cos(theta))))
    sys.gravity(direction=(0, -1), g=g)
    sys.spring(k, deflection=x)
    sys.damper(b, deflection=theta)
    sys.generalized_force(x, sys.input("F"))
    return sys.derive()


def accepted(written: str) -> bool:
    """Whether an answer is judged right; one that is refused is not."""
    try:
        return cart().check(written, hint=0).right
    except ParseError:
        return False


SETUP = """import sympy as sp
t = sp.Symbol('t')
M, m, l, k, b, g, F = sp.symbols('M m l k b g F')
x = sp.Function('x')(t)
th = sp.Function('theta')(t)
xd, thd = x.diff(t), th.diff(t)
xb, yb = x + l*sp.sin(th), -l*sp.cos(th)
T = sp.simplify(M*xd**2/2 + m*(xb.diff(t)**2 + yb.diff(t)**2)/2)
L = T - k*x**2/2 - m*g*yb
"""
EQUATIONS = {
    "simplified": """eq1 = sp.simplify(L.diff(xd).diff(t) - L.diff(x) - F)
eq2 = sp.simplify(L.diff(thd).diff(t) - L.diff(th) + b*thd)
print(eq1, '= 0')
print(eq2, '= 0')""",
    "expanded": """eom_x = sp.expand(sp.diff(sp.diff(L, xd), t) - sp.diff(L, x) - F)  # = 0
eom_th = (sp.diff(sp.diff(L, thd), t) - sp.diff(L, th) + b*thd).simplify()  # = 0""",
    "of all names": """from sympy import *
e1 = simplify(L.diff(xd).diff(t) - L.diff(x) - F)
e2 = simplify(diff(L, thd).diff(t) - diff(L, th) + b*thd)""",
    "Eq": """eq1 = sp.Eq(sp.simplify(L.diff(xd).diff(t) - L.diff(x)), F)
eq2 = sp.Eq(sp.simplify(L.diff(thd).diff(t) - L.diff(th)), -b*thd)""",
    "lambda": """EL = lambda q: sp.diff(sp.diff(L, q.diff(t)), t) - sp.diff(L, q)
eq1 = sp.simplify(EL(x) - F)
eq2 = sp.simplify(EL(th) + b*thd)""",
    "function": """def lagrange(q, Q):
    # the equation of one coordinate
    p = sp.diff(L, q.diff(t))
    return sp.simplify(p.diff(t) - sp.diff(L, q) - Q)

eq1 = lagrange(x, F)
eq2 = lagrange(th, -b*thd)""",
    "loop": """for q, Q in zip([x, th], [F, -b*thd]):
    print(sp.simplify(L.diff(q.diff(t)).diff(t) - L.diff(q) - Q))""",
    "table": """fric = b*thd
Q = {x: F, th: -fric}
for q in Q:
    print(sp.simplify(L.diff(q.diff(t)).diff(t) - L.diff(q) - Q[q]))""",
    "list": "eqs = [sp.simplify(L.diff(q.diff(t)).diff(t) - L.diff(q) - Q) for q, Q in [(x, F), (th, -b*thd)]]",
    "places": """qs = [x, th]
Qs = [F, -b*thd]
eqs = []
for i in range(len(qs)):
    e = sp.diff(L, qs[i].diff(t)).diff(t) - sp.diff(L, qs[i]) - Qs[i]
    eqs.append(sp.simplify(e))""",
}


@pytest.mark.sampled(12)
@pytest.mark.parametrize("equations", EQUATIONS.values(), ids=EQUATIONS)
def test_a_program_of_sympy_says_its_equations(equations: str) -> None:
    assert accepted(f"{SETUP}{equations}")
    assert not accepted(f"{SETUP}{equations.replace('b*thd', '2*b*thd')}")
    assert not accepted(f"{SETUP}{equations.replace(' - L.diff(', ' + L.diff(').replace(' - sp.diff(', ' + sp.diff(')}")
    assert not accepted(f"{SETUP.replace('- k*x', '+ k*x')}{equations}")
    assert not accepted(f"{SETUP.replace('sin(th)', 'cos(th)')}{equations}")


def test_an_energy_that_a_program_simplifies_is_stated() -> None:
    bare = (
        SETUP.replace("sp.", "")
        .replace("\nL =", "\nT = simplify(expand(T0))\nL =")
        .replace("T = simplify(M", "T0 = expand(M")
    )
    assert accepted(f"{bare}{EQUATIONS['of all names']}")
    assert not accepted(f"{bare.replace('- k*x', '+ k*x')}{EQUATIONS['of all names']}")


HANDLES = """A = @(t,z) [M+m, m*l*cos(z(2)); m*l*cos(z(2)), m*l^2];
f = @(t,z) [F - k*z(1) + m*l*z(4)^2*sin(z(2));
            -m*g*l*sin(z(2)) - b*z(4)];
"""
SOLVED = {
    "named": f"{HANDLES}odefun = @(t,z) [z(3); z(4); A(t,z)\\f(t,z)];\n[tt,zz] = ode45(odefun, [0 2], [0 0.1 0 0]);",
    "in place": f"{HANDLES}[t,z] = ode45(@(t,z) [z(3); z(4); A(t,z)\\f(t,z)], [0 2], [0; 0.1; 0; 0]);",
    "other letters": """A = @(th) [M+m, m*l*cos(th); m*l*cos(th), m*l^2];
f = @(x,th,w) [F - k*x + m*l*w^2*sin(th); -m*g*l*sin(th) - b*w];
dz = @(t,z) [z(3); z(4); A(z(2))\\f(z(1),z(2),z(4))];
sol = ode45(dz, [0 1], [0;0;0;0]);""",
    "Python": """A = lambda z: np.array([[M+m, m*l*np.cos(z[1])], [m*l*np.cos(z[1]), m*l**2]])
def h(z):
    return np.array([F - k*z[0] + m*l*z[3]**2*np.sin(z[1]), -m*g*l*np.sin(z[1]) - b*z[3]])

def f(t, z):
    acc = np.linalg.solve(A(z), h(z))
    return [z[2], z[3], acc[0], acc[1]]""",
}


@pytest.mark.sampled(6)
@pytest.mark.parametrize("program", SOLVED.values(), ids=SOLVED)
def test_matrices_that_functions_of_a_program_return(program: str) -> None:
    assert accepted(program)
    assert not accepted(program.replace("-m*g*l", "m*g*l"))
    assert not accepted(program.replace("+ m*l*", "- m*l*"))
    assert not accepted(program.replace("M+m", "M"))


def test_a_function_of_other_letters_has_what_it_is_called_with() -> None:
    assert not accepted(SOLVED["other letters"].replace("z(1),z(2),z(4)", "z(2),z(1),z(4)"))


def test_what_only_resembles_a_function_stays() -> None:
    rows = "(M + m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + k x = F"
    row = "m l^2 theta'' + m l x'' cos(theta) + m g l sin(theta) + b theta' = 0"
    assert accepted(f"large x -> no limit, M = m -> M(x'' + 0) is not used\n{rows}\n{row}")
    assert not accepted(f"large x -> no limit\n{rows}\n{row.replace('+ b', '- b')}")
