"""Programs as an ordinary class hands them in: conditions, steps of solvers, classes, tables, functions of names.

Oracle: the equations of the cart with a pole and of the pendulum. Every form has wrong twins.
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import ParseError

FORCE = "F - b*v + m*l*omega**2*np.sin(theta)"
SOLVED = f"""A = np.array([[M + m, m*l*np.cos(theta)], [m*l*np.cos(theta), J + m*l**2]])
    r = np.array([{FORCE}, m*g*l*np.sin(theta)])
    a = np.linalg.solve(A, r)"""
CONDITION = f"""def rhs(t, s):
    x, theta, v, omega = s
    if t < 1:
        F = 5.0
    else:
        F = 0.0
    {SOLVED}
    return [v, omega, a[0], a[1]]

s = np.array([0, 0.1, 0, 0])
for k in range(5000):
    s = s + 1e-3*np.array(rhs(k*1e-3, s))
plt.plot(s[0], 'k--')
"""
OBJECT = (
    f"""class Cart:
    def __init__(self, M=1.0, mass=0.2, l=0.3, J=0.006, b=0.1, g=9.81):
        self.M, self.m = M, mass
        self.l, self.J, self.b, self.g = l, J, b, g

    def rhs(self, t, y, F=0):
        x, theta, v, omega = y
        {SOLVED.replace("    ", "        ")}
        return np.concatenate(([v, omega], a))
""".replace("m*", "self.m*")
    .replace(" b*", " self.b*")
    .replace("l*", "self.l*")
    .replace("*l", "*self.l")
)
OBJECT = OBJECT.replace("M + m", "self.M + self.m").replace("J + ", "self.J + ").replace("g*", "self.g*")
OBJECT = OBJECT.replace("self.self.", "self.").replace("*self.self.l", "*self.l")
TABLE = f"""import numpy as np
par = dict(M=1.0, m=0.2, l=0.3, J=0.006, b=0.1, g=9.81)
M, m, l, J, b, g = (par[k] for k in ("M", "m", "l", "J", "b", "g"))

def cart(x, theta, v, omega, F):
    {SOLVED}
    return v, omega, a[0], a[1]
"""
ALONE = f"""def acc(x, theta, v, omega, F=0.0):
    {SOLVED}
    return a
"""
STEPS = """% cart pole, Runge and Kutta
M = 1; m = 0.2; l = 0.3; J = 0.006; b = 0.1; g = 9.81; F = 0; N = 500;
f = @(t,z) [z(3); z(4); [M+m, m*l*cos(z(2)); m*l*cos(z(2)), J+m*l^2] ...
  \\ [F - b*z(3) + m*l*z(4)^2*sin(z(2)); m*g*l*sin(z(2))]];
h = 0.01; z = [0; 0.1; 0; 0]; Z = zeros(4, N);
for i = 1:N
    k1 = f(t, z);
    k2 = f(t + h, z + h*k1);
    z = z + h/2*(k1 + k2);
    Z(:, i) = z;
end
plot((1:N)*h, Z(2,:))
"""
SWITCHED = """function dz = cart(t, z, p)
  if t < p.t1, F = p.F0; else, F = 0; end
  switch p.mode
    case 1
      shown = 0;
    otherwise
      shown = 1;
  end
  th = z(2); v = z(3); w = z(4);  // the state
  if abs(th) > pi
     warning('fallen');
  end
  A = [p.M+p.m, p.m*p.l*cos(th); p.m*p.l*cos(th), p.J+p.m*p.l^2];
  r = [F - p.b*v + p.m*p.l*w^2*sin(th); p.m*p.g*p.l*sin(th)];
  dz = [v; w; A \\ r];
end
"""
STRUCT = """p = struct('M',1,'m',0.2,'l',0.3,'J',0.006,'b',0.1,'g',9.81);
MM = @(q) [p.M+p.m, p.m*p.l*cos(q(2)); p.m*p.l*cos(q(2)), p.J+p.m*p.l^2];
CC = @(q,qd) [p.b, -p.m*p.l*sin(q(2))*qd(2); 0 0];
GG = @(q) [0; -p.m*p.g*p.l*sin(q(2))];
f = @(t,z) [z(3:4); MM(z(1:2)) \\ ([1; 0]*F - CC(z(1:2),z(3:4))*z(3:4) - GG(z(1:2)))];
[t,z] = ode45(f,[0 5],[0;0.1;0;0]);
"""
PARTS = """MM = [M+m, m*l*cos(th); m*l*cos(th), J+m*l^2];
f = @(x, th, xd, thd, F) [F - b*xd + m*l*thd^2*sin(th); m*g*l*sin(th)];
rhs = @(t, z, F) [z(3); z(4); [M+m, m*l*cos(z(2)); m*l*cos(z(2)), J+m*l^2] \\ f(z(1), z(2), z(3), z(4), F)];
"""


def right(text: str, model: str = "cart-pole") -> bool:
    """Whether an answer is right; one that cannot be read is not."""
    try:
        return derivation(model).check(text, hint=0).right
    except ParseError:
        return False


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("program", "old", "new"),
    [
        (CONDITION, "F - b*v", "F + b*v"),
        (CONDITION, "        F = 5.0", "        b = -b"),
        (CONDITION, "    if t < 1:", "    b = -b if t < 1 else 2*b\n    if t < 1:"),
        (OBJECT, "F - self.b*v", "F + self.b*v"),
        (OBJECT, "= M, mass", "= M, 2*mass"),
        (TABLE, "omega**2", "omega"),
        (TABLE, "return v, omega, a[0], a[1]", "return v, omega, a[1], a[0]"),
        (ALONE, "omega**2", "v**2"),
        (ALONE, "theta, v, omega, F", "theta, omega, F"),
        (STEPS, "F - b*z(3)", "F - b*z(4)"),
        (SWITCHED, "F - p.b", "F + p.b"),
        (SWITCHED, "warning('fallen');", "w = 0;"),
        (STRUCT, "GG(z(1:2)))", "0*GG(z(1:2)))"),
        (PARTS, "F - b*xd", "F + b*xd"),
    ],
)
def test_what_a_program_of_a_class_computes_is_judged(program: str, old: str, new: str) -> None:
    assert old in program
    assert right(program)
    assert not right(program.replace(old, new))


RELATIVE = """def f(t, y, F):
    x1, x2_r, v1, v2_r = y
    a1, a2 = np.linalg.solve(np.array([[m1, 0], [0, m2]]), np.array([k*x2_r - F, F - k*x2_r]))
    return [v1, v2_r, a1, a2 - a1]
"""


def test_what_is_solved_for_may_be_an_absolute_acceleration() -> None:
    assert right(RELATIVE, "lecture-3b")
    for old, new in (("a2 - a1", "a2 + a1"), ("a2 - a1", "a2"), ("F - k", "F + k"), ("a1, a2 - a1", "a1 - a2, a2")):
        assert not right(RELATIVE.replace(old, new), "lecture-3b"), new


def test_what_is_not_carried_out_is_told() -> None:
    verdict = derivation("cart-pole").check(CONDITION)
    assert "Lines 3 to 6 were not carried out" in str(verdict)
    assert "Lines 13 to 14 were not carried out" in str(verdict)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "program",
    [
        "def acc(theta, omega):\n    return (-m*g*L*np.sin(theta) - b*omega)/(m*L**2)",
        "def thetadd(theta, thetad):\n    return -g/L*np.sin(theta) - b*thetad/(m*L**2)",
        'def swing(theta, w):\n    """the angular acceleration"""\n    return -g/L*np.sin(theta) - b*w/(m*L**2)',
        "def pendulum(theta, omega):\n    alpha = -g/L*np.sin(theta) - b*omega/(m*L**2)\n    return omega, alpha",
        "acc = @(theta, omega) -g/L*sin(theta) - b/(m*L^2)*omega;",
        "def step(theta, omega, dt):\n    a = acc(theta, omega)\n    return theta + dt*omega, omega + dt*a\n"
        "def acc(theta, omega):\n    return -g/L*np.sin(theta) - b*omega/(m*L**2)\nprint(acc(0.1, 0))",
    ],
)
def test_a_function_of_names_may_return_one_acceleration(program: str) -> None:
    assert right(program, "pendulum")
    assert not right(program.replace("- b", "+ b"), "pendulum")
    assert not right(program.replace("-g", "g").replace("-m*g", "m*g"), "pendulum")


def test_a_function_that_says_something_else_is_no_acceleration() -> None:
    for name in ("energy", "moment", "f", "lagrange"):
        assert not right(f"def {name}(theta, omega):\n    return -g/L*np.sin(theta) - b*omega/(m*L**2)", "pendulum")


def test_a_name_with_a_value_is_what_a_comment_says() -> None:
    program = STEPS.replace("b = 0.1", "c = 0.1  % c = b\n").replace("- b*z", "- c*z")
    assert right(program)
    assert not right(program.replace("c = b", "c = g"))


def test_a_comment_of_a_program_that_cannot_be_read_is_left_out() -> None:
    program = (
        "function dz = f(t, z)\n% L*thdd + g*sin*L = 0\nth = z(1);\ndz = [z(2); -g/L*sin(th) - b/(m*L^2)*z(2)];\nend"
    )
    assert right(program, "pendulum")
    wrong = derivation("pendulum").check(program.replace("-g", "g"))
    assert not wrong.right and [f.line.number for f in wrong.findings] == [4]


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "program",
    [
        "d = 0.02\ndef acc(theta, omega):\n    return -g/L*np.sin(theta) - d*omega/(m*L**2)",
        "d = 0.02;  % friction\nf = @(t, z) [z(2); -g/L*sin(z(1)) - d/(m*L^2)*z(2)];",
        "d = 0.02\nm L^2 theta'' + m g L sin theta + d theta' = 0",
    ],
)
def test_a_name_with_the_value_of_a_parameter_that_is_not_named_is_this(program: str) -> None:
    assert right(program, "pendulum")
    assert " was read as b" in str(derivation("pendulum").check(program))
    assert not right(program.replace("0.02", "0.3"), "pendulum")
    assert not right(program.replace("0.02", "1"), "pendulum")
    assert not right(program.replace("m*L**2", "m*L").replace("m*L^2", "m*L").replace("m L^2", "m L"), "pendulum")
    assert not right(program.replace("-g/L", "g/L").replace("+ m g", "- m g"), "pendulum")


def test_a_name_that_a_comment_says_to_be_something_else_is_no_parameter() -> None:
    program = "d = 0.02  # %\ndef acc(theta, omega):\n    return -g/L*np.sin(theta) - d*omega/(m*L**2)"
    assert right(program.replace("%", "friction of the hinge"), "pendulum")
    assert not right(program.replace("%", "mass of the string"), "pendulum")


SPACE = """A = [0 0 1 0; 0 0 0 1; -k_s/m_s, k_s/m_s, -b_s/m_s, b_s/m_s; k_s/m_u, -(k_s+k_t)/m_u, b_s/m_u, -b_s/m_u];
B = [0 0; 0 0; 0 1/m_s; k_t/m_u -1/m_u];
% x = [z_s; z_u; z_s'; z_u'], u = [z_r; F]
% xdot = A*x + B*u
"""
PRODUCT = """import numpy as np
A = np.array([[0, 0, 1, 0], [0, 0, 0, 1], [-k_s/m_s, k_s/m_s, -b_s/m_s, b_s/m_s],
              [k_s/m_u, -(k_s+k_t)/m_u, b_s/m_u, -b_s/m_u]])
B = np.array([[0, 0], [0, 0], [0, 1/m_s], [k_t/m_u, -1/m_u]])
# x = [z_s, z_u, z_s', z_u'], u = [z_r, F]
def f(t, x, u):
    return A @ x + B @ u
"""


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("program", "old", "new"),
    [
        (SPACE, "0 0 1 0;", "0 0 2 0;"),
        (SPACE, "-(k_s+k_t)", "-(k_s-k_t)"),
        (SPACE, "[z_r; F]", "[F; z_r]"),
        (SPACE, "[z_s; z_u; ", "[z_u; z_s; "),
        (PRODUCT, "0, 0, 1, 0", "0, 0, 2, 0"),
        (PRODUCT, "-(k_s+k_t)", "-(k_s-k_t)"),
        (PRODUCT, "[z_r, F]", "[F, z_r]"),
    ],
)
def test_matrices_of_a_state_space_are_judged(program: str, old: str, new: str) -> None:
    assert right(program, "quarter-car")
    assert old in program and not right(program.replace(old, new), "quarter-car")


EQUIVALENT = """W = [1, 0; 1, 1];
M = W.'*diag([m1, m2])*W;
K = [0, 0; 0, k];
% M*q'' + K*q = [0; 1]*F, q = [x1; x2]
"""


def test_an_equation_of_matrices_in_a_comment_is_judged_without_a_solver() -> None:
    assert right(EQUIVALENT, "two-carts")
    for old, new in (("1, 1];", "-1, 1];"), ("0, k", "0, 2*k"), ("[0; 1]", "[1; 1]"), ("[x1; x2]", "[x2; x1]")):
        assert old in EQUIVALENT and not right(EQUIVALENT.replace(old, new), "two-carts")


MOTOR = """def motor(t, y, u):
    i, theta, omega = y
    di = (u - R*i - K*omega)/L
    domega = (K*i - b*omega - m*g*l*np.sin(theta))/(J + m*l**2)
    return [di, omega, domega]
"""


def test_the_current_of_a_charge_may_be_part_of_a_state() -> None:
    assert right(MOTOR, "dc-motor")
    for old, new in (
        ("- R*i", "+ R*i"),
        ("K*i - b", "K*u - b"),
        ("[di, omega, ", "[di, i, "),
        ("i, theta,", "theta, i,"),
    ):
        assert old in MOTOR and not right(MOTOR.replace(old, new), "dc-motor")


CELLS = """syms r(t) theta(t) m k L_0 g R Rd Th Thd
x = r*sin(theta); y = -r*cos(theta);
L = m/2*(diff(x,t)^2 + diff(y,t)^2) - k/2*(r - L_0)^2 - m*g*y;
old = {diff(r,t), diff(theta,t), r, theta}; new = {Rd, Thd, R, Th};
Ls = subs(L, old, new);
eq1 = diff(subs(diff(Ls,Rd), new, old), t) - subs(diff(Ls,R), new, old) == 0
eq2 = diff(subs(diff(Ls,Thd), new, old), t) - subs(diff(Ls,Th), new, old) == 0
"""


@pytest.mark.slow
def test_lists_in_braces_may_be_put_in_for_others() -> None:
    assert right(CELLS, "elastic-pendulum")
    for old, new in (("{Rd, Thd, R,", "{Rd, Thd, 2*R,"), ("t) - subs(diff(Ls,Th)", "t) + subs(diff(Ls,Th)")):
        assert old in CELLS and not right(CELLS.replace(old, new), "elastic-pendulum")


CHAIN = "K = np.array([[k1+k2, -k2, 0], [-k2, k2+k3, -k3], [0, -k3, k3+k4]])"
ROWS = """k = [k1, k2, k3, k4]
m = [m1, m2, m3]
def rhs(t, y):
    x, v = y[:3], y[3:]
    xx = [0, *x, 0]
    a = []
    for i in range(3):
        f = k[i]*(xx[i] - xx[i+1]) + k[i+1]*(xx[i+2] - xx[i+1])
        a.append(f/m[i])
    a[1] += (F - b*(v[1] - v[2]))/m[1]
    a[2] += b*(v[1] - v[2])/m[2]
    return list(v) + a
"""
COUNTED = """k = [k1 k2 k3 k4]; m = [m1 m2 m3];
K = zeros(3); M = diag(m);
for i = 1:3
  K(i,i) = k(i) + k(i+1);
end
K(1,2) = -k(2); K(2,1) = -k(2); K(2,3) = -k(3); K(3,2) = -k(3);
C = b*[0 0 0; 0 1 -1; 0 -1 1];
A = [zeros(3) eye(3); -M\\K -M\\C];
B = [zeros(3,1); M\\[0; 1; 0]];
% xdot = A*x + B*F, x = [x1; x2; x3; v1; v2; v3]
"""
SAID = f"""import numpy as np
M = np.diag([m1, m2, m3])
{CHAIN}
C = np.array([[0, 0, 0], [0, b, -b], [0, -b, b]])
f = np.array([0, F, 0])
# M x'' + C x' + K x = f
"""
SUMMED = """import sympy as sp
t = sp.Symbol('t')
x = [sp.Function(f'x{i}')(t) for i in (1, 2, 3)]
m1, m2, m3, k1, k2, k3, k4, b, F = sp.symbols('m1 m2 m3 k1 k2 k3 k4 b F')
T = sum(mi*xi.diff(t)**2 for mi, xi in zip([m1, m2, m3], x))/2
V = k1*x[0]**2/2 + k2*(x[1]-x[0])**2/2 + k3*(x[2]-x[1])**2/2 + k4*x[2]**2/2
D = b*(x[2].diff(t) - x[1].diff(t))**2/2
for xi, Qi in zip(x, [0, F, 0]):
    print(T.diff(xi.diff(t)).diff(t) - T.diff(xi) + V.diff(xi) + D.diff(xi.diff(t)) - Qi, '= 0')
"""


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("program", "old", "new"),
    [
        (ROWS, "a[2] += b", "a[2] -= b"),
        (ROWS, "list(v) + a", "list(x) + a"),
        (COUNTED, "k(i) + k(i+1)", "k(i) - k(i+1)"),
        (COUNTED, "-M\\C]", "M\\C]"),
        (COUNTED, "[x1; x2; x3; ", "[x2; x1; x3; "),
        (SAID, "+ C x'", "- C x'"),
        (SAID, "[0, F, 0]", "[F, 0, 0]"),
        (SUMMED, "f'x{i}'", "f'x{4 - i}'"),
        (SUMMED, "x[2].diff(t) -", "x[2].diff(t) +"),
    ],
)
def test_rows_of_several_bodies_are_judged(program: str, old: str, new: str) -> None:
    assert old in program
    assert right(program, "three-masses")
    assert not right(program.replace(old, new), "three-masses")


IN_COMMENT = """% matrices of the cart, q = [x; theta], Mm*qdd + Cm*qd = f(t)
syms M m J l b g F theta theta_dot real
Mm = [M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2];
Cm = [b, -m*l*sin(theta)*theta_dot; 0, 0];
f = [F; m*g*l*sin(theta)];
"""
DESCRIPTOR = """% two carts, descriptor form E*z' = A*z + B*F, z = [q; q'], q = [x1; x2]
M = [m1 + m2, m2; m2, m2];
K = [0, 0; 0, k];
E = blkdiag(eye(2), M);
A = [zeros(2), eye(2); -K, zeros(2)];
B = [0; 0; 0; 1];
"""
MULTIPLIER = """% bob, q = [x; y], z = [q; qdot]
function dz = bob(t, z, m, g)
  x = z(1); y = z(2); xd = z(3); yd = z(4);
  A = [x, y];                      % A*qdot = 0
  X = [m, 0, -x; 0, m, -y; x, y, 0] \\ [0; -m*g; -xd^2 - yd^2];
  dz = [z(3:4); X(1:2)];
end
"""
HALVES = """function qdd = acc(q, v, M, m, l, J, b, g, F)
% q = [x theta], v = rates
  th = q(2); w = v(2);
  A = [M + m, m*l*cos(th); m*l*cos(th), J + m*l^2];
  B = [b, -m*l*sin(th)*w; 0, 0];
  qdd = A \\ ([F; m*g*l*sin(th)] - B*v(:));
end
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("example", "program", "old", "new"),
    [
        ("cart-pole", IN_COMMENT.replace("Mm*qdd + Cm*qd", "M*qdd + C*qd"), "[F; m*g", "[F; -m*g"),
        ("cart-pole", IN_COMMENT, "Cm = [b", "Cm = [-b"),
        ("two-carts", DESCRIPTOR, "-K", "K"),
        ("rod-pendulum", MULTIPLIER, "-m*g", "m*g"),
        ("cart-pole", HALVES, "B = [b", "B = [2*b"),
    ],
)
def test_matrices_of_comments_parts_of_states_and_whole_rates(example: str, program: str, old: str, new: str) -> None:
    assert old in program
    assert derivation(example).check(program, hint=0).right
    assert not derivation(example).check(program.replace(old, new), hint=0).right


def test_words_in_front_of_the_statement_of_a_row_of_a_table_are_labels() -> None:
    cart = "(M + m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + b x' = F"
    rows = f"| body | equation |\n|---|---|\n| cart x | {cart} |\n"
    rows += "| pole, turn | (J + m l^2) theta'' + m l x'' cos(theta) - m g l sin(theta) = 0 |"
    assert derivation("cart-pole").check(rows, hint=0).right
    assert not derivation("cart-pole").check(rows.replace("- m g l", "+ m g l"), hint=0).right


def test_a_direction_is_no_value() -> None:
    said = "$\\lambda$ is the force of the rod on the bob, positive in the direction of $x$.\n"
    rows = "$$m\\ddot x = \\lambda x$$\n$$m\\ddot y = \\lambda y - m g$$\n$$x^2 + y^2 = l^2$$"
    assert derivation("rod-pendulum").check(said + rows, hint=0).right
    assert not derivation("rod-pendulum").check(said + rows.replace("- m g", "+ m g"), hint=0).right
