"""Programs whose functions return accelerations or residuals, and names that comments or subs give to coordinates.

Oracle: the equations of the cart with a pole, and of a wheel that rolls. Every form has a wrong twin.
"""

from __future__ import annotations

import re

import pytest
from test_forces_between_bodies import wheel

from built_in import derivation
from lagrangian import ParseError, System

COLUMNS = """function qdd = accel(q, qd, F, p)
th = q(2);
A = [p.M+p.m, p.m*p.l*cos(th); p.m*p.l*cos(th), p.J+p.m*p.l^2];
qdd = A\\[F - p.b*qd(1) + p.m*p.l*qd(2)^2*sin(th); p.m*p.g*p.l*sin(th)];
end"""
SEVERAL = """function [xdd, thdd] = accel(x, th, xd, thd, F)
D = (M+m)*(J+m*l^2) - m^2*l^2*cos(th)^2;
r1 = F - b*xd + m*l*thd^2*sin(th);
r2 = m*g*l*sin(th);
xdd = ((J+m*l^2)*r1 - m*l*cos(th)*r2)/D;
thdd = ((M+m)*r2 - m*l*cos(th)*r1)/D;
end"""
UNPACKED = """def accelerations(state, F):
    x, theta, v, omega = state
    A = np.array([[M+m, m*l*np.cos(theta)], [m*l*np.cos(theta), J+m*l**2]])
    f = np.array([F - b*v + m*l*omega**2*np.sin(theta), m*g*l*np.sin(theta)])
    return np.linalg.solve(A, f)"""
PAIRS = """def rhs(z, F):
    x, v, theta, omega = z
    A = np.array([[M+m, m*l*np.cos(theta)], [m*l*np.cos(theta), J+m*l**2]])
    f = np.array([F - b*v + m*l*omega**2*np.sin(theta), m*g*l*np.sin(theta)])
    return np.linalg.solve(A, f)"""
ENTRIES = """function acc = eom(t, z)
% z = [x; theta; xdot; thetadot]
th = z(2); v = z(3); w = z(4);
A = [M+m, m*l*cos(th); m*l*cos(th), J+m*l^2];
acc = A\\[F - b*v + m*l*w^2*sin(th); m*g*l*sin(th)];
end"""
HANDLES = """A = @(q) [M+m, m*l*cos(q(2)); m*l*cos(q(2)), J+m*l^2];
h = @(q,qd,F) [F - b*qd(1) + m*l*qd(2)^2*sin(q(2)); m*g*l*sin(q(2))];
qdd = @(q,qd,F) A(q)\\h(q,qd,F);"""
ARRAYS = """import numpy as np
def qdd(q, qd, F):
    H = np.array([[M+m, m*l*np.cos(q[1])],[m*l*np.cos(q[1]), J+m*l**2]])
    h = np.array([m*l*np.sin(q[1])*qd[1]**2 - b*qd[0], m*g*l*np.sin(q[1])])
    return np.linalg.inv(H) @ (h + np.array([F, 0]))"""
RESIDUAL = """function res = cart_res(t, y, yp, p)
theta = y(2); v = y(3); omega = y(4);
res = [ yp(1) - v;
        yp(2) - omega;
        (p.M+p.m)*yp(3) + p.m*p.l*cos(theta)*yp(4) - p.m*p.l*omega^2*sin(theta) + p.b*v - p.F(t);
        p.m*p.l*cos(theta)*yp(3) + (p.J+p.m*p.l^2)*yp(4) - p.m*p.g*p.l*sin(theta) ];
end"""


def right(text: str, model: str = "cart-pole") -> bool:
    """Whether an answer is right; one that cannot be read is not."""
    try:
        return derivation(model).check(text, hint=0).right
    except ParseError:
        return False


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("program", "old", "new"),
    [
        (COLUMNS, "- p.b*qd(1)", "- p.b*qd(2)"),
        (COLUMNS, "qd(2)^2*sin", "qd(2)*sin"),
        (SEVERAL, "- m*l*cos(th)*r2", "+ m*l*cos(th)*r2"),
        (SEVERAL, "[xdd, thdd]", "[thdd, xdd]"),
        (UNPACKED, "v, omega = state", "omega, v = state"),
        (PAIRS, "omega**2", "v**2"),
        (ENTRIES, "v = z(3); w = z(4)", "v = z(4); w = z(3)"),
        (HANDLES, "m*g*l*sin", "m*g*sin"),
        (ARRAYS, "[F, 0]", "[0, F]"),
        (RESIDUAL, "yp(2) - omega", "yp(2) + omega"),
        (RESIDUAL, "+ p.b*v", "- p.b*v"),
        (RESIDUAL, "cos(theta)*yp(3)", "cos(theta)*yp(4)"),
    ],
)
def test_a_function_may_return_accelerations_or_residuals(program: str, old: str, new: str) -> None:
    assert old in program
    assert right(program)
    assert not right(program.replace(old, new))


def test_a_function_that_returns_something_else_says_nothing_of_accelerations() -> None:
    more = "\ndef energies(z):\n    return [M*z[2]**2/2, m*g*l*np.cos(z[1])]\n"
    assert right(UNPACKED + more)
    assert not right(UNPACKED.replace("F - b*v", "F + b*v") + more)


LOOP = """from sympy import *
from sympy.physics.mechanics import dynamicsymbols
x, th = dynamicsymbols('x theta')
xd, thd = dynamicsymbols('x theta', 1)
M, m, l, J, b, g, F = symbols('M m l J b g F')
L = M*xd**2/2 + m*(xd**2 + 2*l*xd*thd*cos(th) + l**2*thd**2)/2 + J*thd**2/2 - m*g*l*cos(th)
t = dynamicsymbols._t
eqs = []
for q, qd, Q in [(x, xd, F - b*xd), (th, thd, 0)]:
    eqs.append(simplify(L.diff(qd).diff(t) - L.diff(q) - Q))
for eq in eqs:
    print(eq, "= 0")"""
SHOWN = """syms M m l J b g F x th xd thd xdd thdd real
q = [x; th]; qd = [xd; thd]; qdd = [xdd; thdd];
T = 1/2*(M+m)*xd^2 + m*l*xd*thd*cos(th) + 1/2*(J+m*l^2)*thd^2;
V = m*g*l*cos(th);
p = jacobian(T, qd).';
lhs = jacobian(p, qd)*qdd + jacobian(p, q)*qd - jacobian(T, q).' + jacobian(V, q).';
rhs = [F - b*xd; 0];
lhs
eqs = lhs == rhs"""
SOLVED = """syms M m l J b g F real
syms u w ud wd udd wdd % u is x, w is theta
eq1 = (M+m)*udd + m*l*wdd*cos(w) - m*l*wd^2*sin(w) + b*ud == F;
eq2 = (J+m*l^2)*wdd + m*l*udd*cos(w) - m*g*l*sin(w) == 0;
[A, B] = equationsToMatrix([eq1, eq2], [udd, wdd]);
acc = A\\B;"""
PUT = """syms M m l J b g F real
syms x(t) theta(t)
T = 1/2*(M+m)*diff(x,t)^2 + m*l*diff(x,t)*diff(theta,t)*cos(theta) + 1/2*(J+m*l^2)*diff(theta,t)^2;
V = m*g*l*cos(theta);
syms p pd pdd a ad add
Ts = subs(T, [diff(x,t) diff(theta,t) x theta], [pd ad p a]);
Vs = subs(V, theta, a);
eq1 = (M+m)*pdd + m*l*cos(a)*add + diff(diff(Ts,pd),a)*ad + b*pd == F;
eq2 = diff(Ts,ad,2)*add + m*l*cos(a)*pdd + diff(diff(Ts,ad),a)*ad - diff(Ts,a) + diff(Vs,a) == 0;"""


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("program", "old", "new"),
    [
        (LOOP, "F - b*xd", "F + b*xd"),
        (SHOWN, "[F - b*xd; 0]", "[F; -b*thd]"),
        (SOLVED, "+ b*ud", "- b*ud"),
        (SOLVED, "u is x, w is theta", "u is theta, w is x"),
        (PUT, "- diff(Ts,a)", "+ diff(Ts,a)"),
        (PUT, "[pd ad p a]", "[pd ad a p]"),
    ],
)
def test_programs_in_letters_of_their_own(program: str, old: str, new: str) -> None:
    assert old in program
    assert right(program)
    assert not right(program.replace(old, new))


def test_a_comment_in_names_of_the_program_is_not_read_as_one_of_the_system() -> None:
    comment = "    # F_x = M*x'' + N\n"
    said = UNPACKED.replace("    A = np", f"    F_x = F - b*v\n{comment}    A = np", 1)
    assert right(said)
    assert not right(said.replace("F - b*v + m*l", "F - b*v - m*l"))


CONSTRAINED = """MM = @(q) [M + m, 0; 0, J];
h = @(q, qd, F) [F - k*q(1); 0*qd(1)];
W = [1; -R];
lam = @(q, qd, F) -(W'*(MM(q)\\W)) \\ (W'*(MM(q)\\h(q, qd, F)));
qdd = @(q, qd, F) MM(q)\\(h(q, qd, F) + W*lam(q, qd, F));"""


@pytest.mark.slow
def test_a_multiplier_may_be_eliminated_by_matrices() -> None:
    assert wheel().check(CONSTRAINED, hint=0).right
    for old, new in (
        ("[1; -R]", "[1; R]"),
        ("F - k*q(1)", "F + k*q(1)"),
        ("lam = @(q, qd, F) -", "lam = @(q, qd, F) "),
    ):
        assert old in CONSTRAINED and not wheel().check(CONSTRAINED.replace(old, new), hint=0).right


COUNTED = """syms x theta dx dtheta ddx ddtheta M m l J b g F real
q = [x theta]; dq = [dx dtheta]; ddq = [ddx ddtheta];
T = 1/2*(M+m)*dx^2 + m*l*dx*dtheta*cos(theta) + 1/2*(J+m*l^2)*dtheta^2;
L = T - m*g*l*cos(theta);
Q = [F - b*dx, 0];
for i = 1:numel(q)
  eq(i) = jacobian(diff(L,dq(i)),[q dq])*[dq ddq].' - diff(L,q(i)) - Q(i);
end
simplify(eq)"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize("last", ["simplify(eq)", ""])
def test_loops_of_matlab_over_numbers_are_carried_out(last: str) -> None:
    program = COUNTED.replace("simplify(eq)", last)
    assert right(program)
    for old, new in (("- Q(i)", "+ Q(i)"), ("- diff(L,q(i))", "+ diff(L,q(i))"), ("1:numel(q)", "1:1")):
        assert old in program and not right(program.replace(old, new))


LISTED = """syms p pd pdd q qd qdd real   % x, x', x'', theta, theta', theta''
T = M*pd^2/2 + m*(pd^2 + 2*l*pd*qd*cos(q) + l^2*qd^2)/2 + J*qd^2/2;
V = m*g*l*cos(q);
eq1 = diff(T,pd,pd)*pdd + diff(T,pd,qd)*qdd + diff(T,pd,q)*qd == F - b*pd;
eq2 = diff(T,qd,pd)*pdd + diff(T,qd,qd)*qdd + diff(T,qd,q)*qd - diff(T,q) + diff(V,q) == 0;"""


@pytest.mark.slow
def test_a_comment_lists_what_declared_symbols_are() -> None:
    assert right(LISTED)
    python = LISTED.replace(
        "syms p pd pdd q qd qdd real   %", "p, pd, pdd, q, qd, qdd = symbols('p pd pdd q qd qdd')  #"
    )
    python = f"from sympy import *\nM, m, l, J, g, b, F = symbols('M m l J g b F')\n{python}".replace("^", "**")
    assert right(re.sub(r"(eq. =) (.+) == (.+);", r"\1 Eq(\2, \3)", python))
    assert not right(LISTED.replace("F - b*pd", "F + b*pd"))
    assert not right(LISTED.replace("x, x', x'', theta, theta', theta''", "theta, theta', theta'', x, x', x''"))
    assert not right(LISTED.replace("x, x', x'',", "x, x',"))


TYPED = """def residuals(x, xd, xdd, theta, thetad, thetadd, F):
    e1 = (M + m)*xdd + m*l*cos(theta)*thetadd - m*l*sin(theta)*thetad**2 + b*xd - F
    e2 = (J + m*l**2)*thetadd + m*l*cos(theta)*xdd - m*g*l*sin(theta)
    return e1, e2"""
X, ANGLE = (line.partition("=")[2].strip().replace("**", "^") for line in TYPED.split("\n")[1:3])


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "form",
    [
        TYPED,
        TYPED.replace("e1", "r1").replace("e2", "r2"),
        TYPED.replace("return e1, e2", "eqs = [e1, e2]\n    return eqs"),
        f"F1 = {X};\nF2 = {ANGLE};\nsol = vpasolve([F1 F2], [xdd thetadd]);",
        f"g1 = {X}\ng2 = {ANGLE}\nprint(solve([Eq(g1, 0), Eq(g2, 0)], [xdd, thetadd]))",
        f"Both r_x and r_th are zero.\nr_x = {X}\nr_th = {ANGLE}",
        f"% residuals\nh1 = {X};\nh2 = {ANGLE};",
        f"res = zeros(2, 1);\nres(1) = {X};\nres(2) = {ANGLE};",
        f"The expressions A and B are zero.\nA = {X}\nB = {ANGLE}",
        f"def residuals(x, xd, xdd, theta, thetad, thetadd, F):\n    return [{X}, {ANGLE}]".replace("^", "**"),
        f"res = @(x, theta, xd, thetad, xdd, thetadd) [{X}; {ANGLE}];",
    ],
)
def test_a_wrong_line_of_what_is_zero_is_told_as_an_equation(form: str) -> None:
    assert right(form)
    verdict = derivation("cart-pole").check(form.replace("- m*g*l", "+ m*g*l"))
    first, second = verdict.findings
    assert first.status.right and not second.status.right and not verdict.right
    assert {m.name for m in verdict.mistakes} == {"gravity_sign"}
    said = " ".join(str(verdict).split())
    assert "m g l sin θ has the wrong sign" in said and "−m g l" not in said  # as it is written


def test_what_is_zero_holds_a_constraint_too() -> None:
    lines = "(M + m)*xdd + k*x - F - lam", "J*phidd + lam*R", "xd - R*phid"
    program = "% all residuals are zero\n" + "".join(f"r{k} = {x};\n" for k, x in enumerate(lines, 1))
    made = wheel()
    assert made.check(program, hint=0).right
    assert len(made.check(program).findings) == 3
    assert not made.check(program.replace("xd - R", "xd + R"), hint=0).right


def test_names_that_something_uses_are_no_equations() -> None:
    made = derivation("cart-pole")
    program = f"r1 = xdd + l*cos(theta)*thetadd\nM*xdd + m*r1 - m*l*sin(theta)*thetad^2 + b*xd - F = 0\n{ANGLE} = 0"
    assert made.check(program, hint=0).right
    assert not made.check(program.replace("+ b*xd", "- b*xd"), hint=0).right
    forces = f"{X} = 0\n{ANGLE} = 0\nN1 = M*xdd + b*xd - F  % what the pole bears; it is zero at rest\n"
    assert len(made.check(forces).findings) == 2  # no third equation


MOVED = """function res = eom(t, q, qd, qdd)
th = q(2);
res = zeros(2,1);
res(1) = (M + m)*qdd(1) + m*l*cos(th)*qdd(2) - m*l*sin(th)*qd(2)^2 + b*qd(1) - F;
res(2) = (J + m*l^2)*qdd(2) + m*l*cos(th)*qdd(1) - m*g*l*sin(th);
end"""
GIVEN = """def residual(q, v, a):
    theta = q[1]
    xdd, thdd = a
    return [(M + m)*xdd + m*l*cos(theta)*thdd - m*l*sin(theta)*v[1]**2 + b*v[0] - F,
            (J + m*l**2)*thdd + m*l*cos(theta)*xdd - m*g*l*sin(theta)]"""


@pytest.mark.parametrize(("program", "old", "new"), [(MOVED, "qd(1) - F", "qd(1) + F"), (GIVEN, "v[0]", "v[1]")])
def test_what_is_zero_may_be_a_function_of_three_columns(program: str, old: str, new: str) -> None:
    assert old in program
    assert right(program)
    assert not right(program.replace(old, new))
    second = derivation("cart-pole").check(program.replace("- m*g*l", "+ m*g*l")).findings[1]
    assert not second.status.right and second.line.number == 5


TOGETHER = """Mass = [M+m, 0; 0, J];
G = [1, -R];
sol = [Mass, -G'; G, 0] \\ [F - k*x; 0; 0];   % [xdd; phidd; lambda]"""
UNNAMED = TOGETHER.replace(" \\ [", "\\[").partition("   %")[0]
SCALARS = """import numpy as np
def accelerations(x, phi, xd, phid, F):
    \"\"\"x'', phi'' and the multiplier of x - R*phi = 0\"\"\"
    A = np.array([[M + m, 0, -1], [0, J, R], [1, -R, 0]])
    return np.linalg.solve(A, np.array([F - k*x, 0, 0]))"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("program", [TOGETHER, UNNAMED, SCALARS, f"% q = [x; phi]\n{UNNAMED}"])
def test_accelerations_and_multipliers_are_solved_for_together(program: str) -> None:
    assert wheel().check(program, hint=0).right
    for old, new in (("F - k*x", "F + k*x"), ("1, -R", "1, R"), ("0, J", "0, 2*J")):
        assert old in program
        assert not wheel().check(program.replace(old, new), hint=0).right


def test_a_hessian_matrix_is_carried_out() -> None:
    program = """syms M m l J b g F x th xd thd xdd thdd real
T = M/2*xd^2 + m/2*(xd^2 + 2*l*xd*thd*cos(th) + l^2*thd^2) + J/2*thd^2;
MM = hessian(T, [xd; thd]);
eom = MM*[xdd; thdd] + [b*xd - F - m*l*thd^2*sin(th); -m*g*l*sin(th)]"""
    assert right(program)
    assert not right(program.replace("J/2", "J"))


@pytest.mark.slow
def test_named_accelerations_are_fewer_where_constraints_are_put_in() -> None:
    sys = System("wheel that pulls a box")
    x, phi, y = sys.coordinates("x phi y")
    M, m, J, R, k = sys.parameters("M m J R k")
    axle = sys.point("axle", (x, R))
    body = sys.rigid_body(m, J, at=axle, frame=sys.frame(-phi), name="wheel")
    sys.particle(M, at=sys.point("box", (y, 0)), name="box")
    sys.spring(k, deflection=y - x)
    sys.force((sys.input("F"), 0), at=axle)
    sys.rolling(body, at=sys.point("contact", (x, 0)), along=(1, 0))
    made = sys.derive()
    program = """function [xdd, ydd] = fcn(F, x, y, xd, yd)
s = k*(y - x);
xdd = (F + s)/(m + J/R^2);
ydd = -s/M;
end"""
    assert made.check(program).right
    assert not made.check(program.replace("F + s", "F - s")).right
    assert not made.check(program.replace("m + J/R^2", "m")).right


def test_rates_of_a_state_that_a_comment_lists_are_solved_for() -> None:
    program = """% E*xdot = A0*x + B0*u, x = [x1; x2r; x1dot; x2rdot]
E  = [1 0 0 0; 0 1 0 0; 0 0 m1+m2 m2; 0 0 m2 m2];
A0 = [0 0 1 0; 0 0 0 1; 0, 0, 0, 0; 0, -k, 0, 0];
B0 = [0; 0; 0; 1];
xdot = E\\(A0*[x1; x2r; x1d; x2rd] + B0*F);"""
    carts = derivation("lecture-3b")
    assert carts.check(program).right
    assert not carts.check(program.replace("0, -k", "0, k")).right
    assert not carts.check(program.replace("m1+m2 m2;", "m1 m2;")).right
    assert not carts.check(program.replace("0 0 1 0; 0 0 0 1; 0, 0", "0 0 2 0; 0 0 0 1; 0, 0")).right
