"""Matrices that programs enter one by one, inputs and states by index, and columns of SymPy that are differentiated.

Oracle: the equations of the cart with a pole. Every form has a wrong twin, which stays wrong.
"""

import pytest

from built_in import derivation
from lagrangian import ParseError

MATLAB = """function dz = f(t, z)
x = z(1); th = z(2); v = z(3); w = z(4);
A = zeros(2);
A(1,1) = M + m;
A(1,2) = m*l*cos(th);
A(2,1) = A(1,2);
A(2,2) = J + m*l^2;   % about the hinge
f(1,1) = F - b*v + m*l*sin(th)*w^2;
f(2,1) = m*g*l*sin(th);
qdd = A\\f;
dz = [v; w; qdd(1); qdd(2)];
end"""
PYTHON = """def f(t, z):
    x, th, v, w = z
    A = np.zeros((2, 2))
    A[0, 0] = M + m
    A[0, 1] = A[1, 0] = m*l*np.cos(th)
    A[1, 1] = J + m*l**2
    f = np.zeros(2)
    f[0] = F - b*v + m*l*np.sin(th)*w**2
    f[1] = m*g*l*np.sin(th)
    a = np.linalg.solve(A, f)
    return [v, w, a[0], a[1]]"""
INPUTS = """function dx = f(t, z, u)
% z = [x; theta; xdot; thetadot], u = [F; 0]
v = z(3);
w = z(4);
r1 = u(1) - b*v + m*l*sin(z(2))*w^2;
r2 = m*g*l*sin(z(2));
m11 = M + m;  m12 = m*l*cos(z(2));  m22 = J + m*l^2;
d = m11*m22 - m12^2;
dx = [v; w; (m22*r1 - m12*r2)/d; (m11*r2 - m12*r1)/d];
end"""
SYMPY = """import sympy as sp
t = sp.Symbol('t')
x = sp.Function('x')(t)
th = sp.Function('theta')(t)
r = sp.Matrix([x + l*sp.sin(th), l*sp.cos(th)])
v = r.diff(t)
T_pole = sp.simplify(m*(v.T*v)[0]/2) + J*th.diff(t)**2/2
V = m*g*r[1]
L = T_pole + M*x.diff(t)**2/2 - V
e1 = L.diff(x.diff(t)).diff(t) - L.diff(x) + b*x.diff(t) - F
e2 = L.diff(th.diff(t)).diff(t) - L.diff(th)"""


def accepted(written: str) -> bool:
    """Whether an answer is right; one that cannot be read is not."""
    try:
        return derivation("cart-pole").check(written, hint=0).right
    except ParseError:
        return False


@pytest.mark.sampled(16)
@pytest.mark.parametrize(
    ("written", "old", "new"),
    [
        (MATLAB, "A(2,1) = A(1,2)", "A(2,1) = -A(1,2)"),
        (MATLAB, "A = zeros(2);\n", ""),
        (MATLAB, "qdd = A\\f", "qdd = inv(A)*f"),
        (MATLAB, "f(2,1) = m", "f(2,1) = -m"),
        (PYTHON, "f[0] = F - b", "f[0] = F + b"),
        (PYTHON, "A[0, 1] = A[1, 0]", "A[0, 1]"),
        (PYTHON, "A[1, 1] = J", "A[1, 1] = 2*J"),
        (INPUTS, "u(1) - b*v", "u(1) + b*v"),
        (INPUTS, "u(1) - b*v", "u(2) - b*v"),
        (SYMPY, "l*sp.cos(th)]", "-l*sp.cos(th)]"),
        (SYMPY, "m*(v.T*v)[0]/2", "m*(v.T*v)[0]"),
        (SYMPY.replace("(v.T*v)[0]", "(v.T @ v)[0, 0]"), "m*g*r[1]", "m*g*r[0]"),
        (SYMPY.replace("(v.T*v)[0]", "(v[0]**2 + v[1]**2)"), "v[0]**2", "v[1]**2"),
        (SYMPY.replace("r.diff(t)", "sp.diff(r, t)"), "M*x.diff(t)**2/2", "M*x.diff(t)**2"),
    ],
)
def test_programs_that_enter_matrices_and_columns(written: str, old: str, new: str) -> None:
    assert old in written and accepted(written)
    same = old in ("A = zeros(2);\n", "qdd = A\\f")
    assert accepted(written.replace(old, new)) == same


def test_entries_of_which_some_are_missing_make_no_matrix() -> None:
    lacking = MATLAB.replace("A(2,1) = A(1,2);\n", "")
    assert not accepted(lacking) and not accepted(lacking.replace("A = zeros(2);\n", ""))
