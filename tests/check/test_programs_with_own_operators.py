"""Programs that write the derivative by time and Lagrange's equations as functions of their own, and toolboxes.

Oracle: the equations of the cart with a pole, and of the double pendulum. Every program has wrong twins.
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import ParseError

HANDLE = """syms M m l J b g F real
syms x th v w a al real
vx = v + l*w*cos(th); vy = -l*w*sin(th);
T = M*v^2/2 + m*(vx^2+vy^2)/2 + J*w^2/2;
V = m*g*l*cos(th);
L = T - V;
dot_ = @(f) diff(f,x)*v + diff(f,th)*w + diff(f,v)*a + diff(f,w)*al;
eqx = dot_(diff(L,v)) - diff(L,x) + b*v - F == 0
eqt = dot_(diff(L,w)) - diff(L,th) == 0
"""
CHAIN = """syms t M m l J b g F real
syms x(t) th(t)
syms X TH XD THD real
T = M*XD^2/2 + m*((XD + l*THD*cos(TH))^2 + (l*THD*sin(TH))^2)/2 + J*THD^2/2;
V = m*g*l*cos(TH);
put = @(e) subs(e, [X TH XD THD], [x th diff(x,t) diff(th,t)]);
EL = @(q, qd, Q) diff(put(diff(T - V, qd)), t) - put(diff(T - V, q)) - put(Q);
eq1 = simplify(EL(X, XD, F - b*XD)) == 0
eq2 = simplify(EL(TH, THD, 0)) == 0
"""
FUNCTIONAL = """syms x(t) theta(t) M m l J b g F
T = M*diff(x,t)^2/2 + m*(diff(x + l*sin(theta),t)^2 + diff(l*cos(theta),t)^2)/2 + J*diff(theta,t)^2/2;
V = m*g*l*cos(theta);
L = T - V;
eqx = functionalDerivative(L, x) + F - b*diff(x,t) == 0
eqth = functionalDerivative(L, theta) == 0
"""
HESSIAN = """syms x theta v w vd wd M m l J b g F real
q = [x theta]; qd = [v w]; qdd = [vd; wd];   % v = x', w = theta'
T = M*v^2/2 + m*((v + l*w*cos(theta))^2 + l^2*w^2*sin(theta)^2)/2 + J*w^2/2;
V = m*g*l*cos(theta);
C = jacobian(gradient(T, qd), q)*qd.' - gradient(T, q);
eqs = hessian(T, qd)*qdd + C + gradient(V, q) == [F - b*v; 0]
"""
REPEATED = """syms M m l J b g F real
syms x th xd thd xdd thdd real
q = [x; th]; qd = [xd; thd]; qdd = [xdd; thdd];
p = [x + l*sin(th); l*cos(th)];
vp = jacobian(p, q)*qd;
L = 1/2*M*xd^2 + 1/2*m*(vp.'*vp) + 1/2*J*thd^2 - m*g*p(2);
P = jacobian(L, qd).';
eq = jacobian(P, q)*qd + jacobian(P, qd)*qdd - jacobian(L, q).' - [F - b*xd; 0];
eq = simplify(eq)
"""
COLUMNS = """syms m1 m2 L1 L2 g real
syms theta1 theta2 dtheta1 dtheta2 ddtheta1 ddtheta2 real
q = [theta1; theta2]; dq = [dtheta1; dtheta2]; ddq = [ddtheta1; ddtheta2];
m = [m1; m2];
p = [L1*sin(theta1), L1*sin(theta1) + L2*sin(theta2); -L1*cos(theta1), -L1*cos(theta1) - L2*cos(theta2)];
T = 0; V = 0;
for i = 1:2
    vi = jacobian(p(:,i), q)*dq;
    T = T + m(i)/2*(vi.'*vi);
    V = V + m(i)*g*p(2,i);
end
for i = 1:2
    P = diff(T - V, dq(i));
    eq(i) = jacobian(P, q)*dq + jacobian(P, dq)*ddq - diff(T - V, q(i));
end
simplify(eq.')
"""
MEANT = """syms m1 m2 L1 L2 g real
syms t1 t2 w1 w2 a1 a2 real
% t1 = theta1, t2 = theta2
D = @(f) diff(f,t1)*w1 + diff(f,t2)*w2 + diff(f,w1)*a1 + diff(f,w2)*a2;
x1 = L1*sin(t1); y1 = -L1*cos(t1);
x2 = x1 + L2*sin(t2); y2 = y1 - L2*cos(t2);
T = m1*(D(x1)^2 + D(y1)^2)/2 + m2*(D(x2)^2 + D(y2)^2)/2;
V = m1*g*y1 + m2*g*y2;
E1 = simplify(D(diff(T,w1)) - diff(T,t1) + diff(V,t1)) % = 0
E2 = simplify(D(diff(T,w2)) - diff(T,t2) + diff(V,t2)) % = 0
"""
HEAD = """from sympy import *
t = symbols('t')
M, m, l, J, b, g, F = symbols('M m l J b g F')
x = Function('x')(t); theta = Function('theta')(t)
"""
ADDED = f"""{HEAD}T = M*x.diff(t)**2/2
T += m*((x + l*sin(theta)).diff(t)**2 + (l*cos(theta)).diff(t)**2)/2
T += J*theta.diff(t)**2/2
L = T - m*g*l*cos(theta)
Q = {{x: F - b*x.diff(t), theta: 0}}
for q, f in Q.items():
    print(simplify(L.diff(q.diff(t)).diff(t) - L.diff(q) - f), '= 0')
"""
TABLE = f"""{HEAD}v = x.diff(t); w = theta.diff(t)
L = M*v**2/2 + m*(v**2 + 2*l*v*w*cos(theta) + l**2*w**2)/2 + J*w**2/2 - m*g*l*cos(theta)
Q = {{x: F - b*v, theta: 0}}
eqs = {{q: L.diff(q.diff(t)).diff(t) - L.diff(q) - Q[q] for q in (x, theta)}}
for q in eqs:
    print(simplify(eqs[q]))
"""
EULER = f"""{HEAD}from sympy.calculus.euler import euler_equations
v = x.diff(t); w = theta.diff(t)
L = M*v**2/2 + m*(v**2 + 2*l*v*w*cos(theta) + l**2*w**2)/2 + J*w**2/2 - m*g*l*cos(theta)
found = euler_equations(L, [x, theta], t)
eq1 = Eq(found[0].lhs, -F + b*v)
eq2 = found[1]
"""
DEFAULT = f"""{HEAD}def kinetic(mass, px, py=0):
    return mass*(px.diff(t)**2 + diff(py, t)**2)/2
L = kinetic(M, x) + kinetic(m, py=l*cos(theta), px=x + l*sin(theta)) + J*theta.diff(t)**2/2 - m*g*l*cos(theta)
D = b*x.diff(t)**2/2
def lagrange(q, Q=0):
    return Eq(diff(diff(L, q.diff(t)), t) - diff(L, q) + diff(D, q.diff(t)), Q)
print(lagrange(*[x, F]))
print(lagrange(theta))
"""


def right(text: str, example: str) -> bool:
    """Whether a program is accepted; one that cannot be read is not."""
    try:
        return derivation(example).check(text, hint=0).right
    except ParseError:
        return False


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("program", "changes"),
    [
        (HANDLE, ["+ b*v|- b*v", "diff(f,th)*w + |", "J*w^2/2|J*w^2", "diff(f,w)*al|diff(f,w)*a", "f,x)*v|f,x)*w"]),
        (CHAIN, ["F - b*XD|F + b*XD", "(l*THD*sin(TH))^2|(l*THD)^2", "diff(T - V, q)|diff(T + V, q)"]),
        (FUNCTIONAL, ["+ F - b|- F + b", "T - V;|T + V;", "+ J*|- J*"]),
        (
            HESSIAN,
            ["+ gradient(V|- gradient(V", "l*w*cos(theta)|l*w*sin(theta)", "v = x', w = theta'|w = x', v = theta'"],
        ),
        (REPEATED, ["l*cos(th)]|l*sin(th)]", "jacobian(P, q)*qd + |", "*qdd -|*qdd +", "F - b|F + b"]),
        (ADDED, ["T += J|T -= J", "F - b*x|F - b*theta", "T += J*theta.diff(t)**2/2\n|"]),
        (TABLE, ["2*l*v*w|l*v*w", "F - b*v|F", "- Q[q]|+ Q[q]"]),
        (EULER, ["-F + b|-F - b", "- m*g|+ m*g"]),
        (
            DEFAULT,
            ["+ diff(D|- diff(D", "px.diff(t)**2 +|px.diff(t)**2 -", "[x, F]|[x, -F]", "Q=0|Q=F", "(theta))|(x))"],
        ),
    ],
)
def test_operators_of_a_program_for_the_cart(program: str, changes: list[str]) -> None:
    assert right(program, "cart-pole")
    for change in changes:
        old, new = change.split("|")
        assert old in program
        assert not right(program.replace(old, new), "cart-pole")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("program", "changes"),
    [
        (COLUMNS, ["V = V + m(i)*g|V = V - m(i)*g", "m(i)/2|m(i)", "L2*sin(theta2);|L2*cos(theta2);"]),
        (
            MEANT,
            ["y1 - L2|y1 + L2", "- diff(T,t1)|+ diff(T,t1)", "V = m1*g*y1|V = m2*g*y1", "diff(f,w1)*a1|diff(f,w1)*a2"],
        ),
    ],
)
def test_operators_of_a_program_for_two_pendulums(program: str, changes: list[str]) -> None:
    assert right(program, "double-pendulum")
    for change in changes:
        old, new = change.split("|")
        assert old in program
        assert not right(program.replace(old, new), "double-pendulum")


SAID = """@ (M+m) x'' + m l cos(theta) theta'' - m l sin(theta) theta'^2 = F - b x'
@ (J + m l^2) theta'' + m l cos(theta) x'' = m g l sin(theta)
"""
SOLVED = (
    SAID.replace("@", "#")
    + """import numpy as np
def f(t, y, F):
    x, th, w, v = y
    A = np.array([[M + m, m*l*np.cos(th)], [m*l*np.cos(th), J + m*l**2]])
    rhs = np.array([F - b*w + m*l*v**2*np.sin(th), m*g*l*np.sin(th)])
    wd, vd = np.linalg.solve(A, rhs)
    return [w, v, wd, vd]
"""
)
MASS = (
    SAID.replace("@", "%")
    + """opts = odeset('RelTol', 1e-8, 'Mass', @(t,y) mass(t,y,p));
[t,y] = ode45(@(t,y) f(t,y,p), [0 5], [0;0.1;0;0], opts);
function dy = f(t, y, p)
  th = y(2); v = y(3); w = y(4);
  dy = [v; w; p.F - p.b*v + p.m*p.l*w^2*sin(th); p.m*p.g*p.l*sin(th)];
end
function A = mass(t, y, p)
  k = p.m*p.l*cos(y(2));
  A = [1 0 0 0; 0 1 0 0; 0 0 p.M+p.m k; 0 0 k p.J+p.m*p.l^2];
end
"""
)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("program", "changes"),
    [
        (SOLVED, ["+ m*l*v|- m*l*v", "F - b*w +|F + b*w +", "J + m*l**2|J - m*l**2", "[w, v, wd|[w, v, 2*wd"]),
        (MASS, ["p.F - p.b|p.F + p.b", "p.J+p.m|p.J-p.m", "*sin(th)]|*cos(th)]", "k = p.m|k = -p.m"]),
    ],
)
def test_what_a_program_computes_is_judged_beside_right_comments(program: str, changes: list[str]) -> None:
    assert right(program, "cart-pole")
    for change in changes:
        old, new = change.split("|")
        assert old in program
        assert not right(program.replace(old, new), "cart-pole")
    wrong = program.replace("theta'^2 = F", "theta'^2 = -F")
    assert not right(wrong, "cart-pole")


def test_what_is_not_carried_out_is_said_where_the_comments_alone_are_right() -> None:
    program = SAID.replace("@", "#") + "def f(t, y):\n    return np.linalg.solve(A[y > 0], y)\n"
    found = derivation("cart-pole").check(program)
    assert found.right
    assert "was not carried out" in found.to_text()


def test_a_name_that_a_comment_explains_is_known_where_a_program_is_carried_out() -> None:
    program = SAID.replace("@", "#") + TABLE.replace("J*w", "J_p*w") + "# J_p is the J of the question\n"
    assert right(program, "cart-pole")
    assert not right(program.replace("- m*g", "+ m*g"), "cart-pole")


@pytest.mark.slow
def test_a_coordinate_of_the_system_that_is_made_of_another_one_is_told() -> None:
    program = TABLE.replace("x = Function('x')(t)", "psi = Function('psi')(t); x = 2*psi").replace("{x:", "{psi:")
    program = program.replace("(x, theta)", "(psi, theta)").replace("F - b*v", "2*(F - b*v)")
    assert right(program, "cart-pole")
    assert not right(program.replace("l**2*w**2", "l*w**2"), "cart-pole")
    assert not right(program.replace("2*(F - b*v)", "F - b*v"), "cart-pole")


def test_a_table_of_parameters_is_given_by_name() -> None:
    program = """par = dict(L=1.0, m=0.5, b=0.1, g=9.81)
def acc(theta, omega, L, m, b, g):
    return -g/L*np.sin(theta) - b/(m*L**2)*omega
def rhs(t, z):
    theta, omega = z
    return [omega, acc(theta, omega, **par)]
"""
    assert right(program, "pendulum")
    assert not right(program.replace("(theta, omega, **", "(omega, theta, **"), "pendulum")
    assert not right(program.replace("dict(L", "dict(omega=2, L"), "pendulum")


@pytest.mark.slow
def test_a_mass_matrix_that_no_solver_gets_multiplies_nothing() -> None:
    assert right(MASS, "cart-pole")
    assert not right(MASS.replace(", opts);", ");"), "cart-pole")
    assert not right(MASS.replace("[t,y] =", "opts = odeset('RelTol', 1e-6);\n[t,y] =", 1), "cart-pole")
    assert right(MASS.replace("[t,y] =", "opts = odeset(opts, 'RelTol', 1e-6);\n[t,y] =", 1), "cart-pole")


IN_COLUMNS = """{said}
Mq = [M+m, m*l*cos(th); m*l*cos(th), J+m*l^2];
Cq = [-m*l*sin(th)*w^2 + b*xd; 0];
Gq = [0; -m*g*l*sin(th)];
qdd = Mq \\ ([F; 0] - Cq - Gq);
"""


@pytest.mark.parametrize(
    "said",
    [
        "% q = [x; th], qd = [xd; w]",
        "% state: x, th, xd, w",
        "% z = [x th xd w]'",
        "% velocities (xd, w) of (x, th)",
        "% q = [x, th]\n% v = [xd, w]",
    ],
)
def test_a_letter_in_a_list_of_rates_is_the_rate_in_its_place(said: str) -> None:
    cart = derivation("cart-pole")
    verdict = cart.check(IN_COLUMNS.format(said=said))
    assert verdict.right and all(f.line.number <= said.count("\n") + 5 for f in verdict.findings)
    for right, wrong in (("*w^2", "*w"), ("b*xd", "b*w"), ("-m*l*sin", "m*l*sin")):
        assert not cart.check(IN_COLUMNS.format(said=said).replace(right, wrong)).right
