"""Matrices that programs print, and comments beside them that say how they belong together.

Oracle: the equations of the cart with a pole and of the motor in the grammar of model files. Every form has a wrong
twin, which stays wrong.
"""

import re

import pytest

from built_in import derivation
from lagrangian import ParseError
from lagrangian.quantities.units import joined

ROWS_BY_HAND = (
    "(M + m)*x'' + m*l*cos(theta)*theta'' - m*l*sin(theta)*theta'^2 = F - b*x'",
    "(J + m*l^2)*theta'' + m*l*cos(theta)*x'' - m*g*l*sin(theta) = 0",
)
SHOWN = """>> A_mat

A_mat =

[        M + m, l*m*cos(theta)]
[l*m*cos(theta),    J + m*l^2]

>> n_vec

n_vec =

 b*dx - l*m*sin(theta)*dtheta^2
              -g*l*m*sin(theta)

>> % A_mat*[ddx; ddtheta] + n_vec = [F; 0]
"""
ENTERED = """% cart with a pole, q = [x; theta], A(q)*qdd + n(q,qd) = p
A = [M + m, m*l*cos(theta); ...
     m*l*cos(theta), J + m*l^2];
n = [b*xd - m*l*thetad^2*sin(theta); ...   % damper first
     -m*g*l*sin(theta)];
p = [F; 0];
"""
ARRAYS = """# cart with a pole: M(q) qdd = p, q = [x, theta]
import numpy as np
from numpy import sin, cos
Mq = np.array([[M + m, m*l*cos(theta)],
               [m*l*cos(theta), J + m*l**2]])
p = np.array([F - b*xd + m*l*thetad**2*sin(theta),
              m*g*l*sin(theta)])
# qdd = np.linalg.solve(Mq, p)      xd, thetad: velocities
"""
ROWS = """>> eoms    % each row == 0

eoms =

 (M + m)*d2x + l*m*cos(theta)*d2theta - l*m*sin(theta)*dtheta^2 + b*dx - F
        (J + m*l^2)*d2theta + l*m*cos(theta)*d2x - g*l*m*sin(theta)

% dx, d2x: first and second derivative
"""
MAXIMA = """(%i9)  /* xp, tp = velocities, xpp, tpp = accelerations */
       eq_x;
(%o9)  (M+m)*xpp+m*l*cos(theta)*tpp-m*l*sin(theta)*tp^2+b*xp=F
(%i10) eq_theta;
(%o10) (J+m*l^2)*tpp+m*l*cos(theta)*xpp-g*m*l*sin(theta)=0
"""
MAPLE = """> sol := solve({eq1, eq2}, {diff(x(t),t,t), diff(theta(t),t,t)}):
# with xdd, tdd = second, xd, td = first time derivatives, N the common denominator

N := (M + m)*(J + m*l^2) - m^2*l^2*cos(theta)^2;

xdd := ((J + m*l^2)*(F - b*xd + m*l*td^2*sin(theta)) - m*l*cos(theta)*m*g*l*sin(theta))/N;

tdd := ((M + m)*m*g*l*sin(theta) - m*l*cos(theta)*(F - b*xd + m*l*td^2*sin(theta)))/N;
"""
SOLVED = ARRAYS.replace("# qdd = np.linalg.solve(Mq, p)   ", "qdd = np.linalg.solve(Mq, p)   #")
INVERTED = ARRAYS.replace("np.linalg.solve(Mq, p)", "np.linalg.inv(Mq) @ p")
DETERMINANT = "((M + m)*(J + m*l^2) - m^2*l^2*cos(theta)^2)"
PRINTED = f""">> qdd

qdd =

 ((J + m*l^2)*(F - b*dx + m*l*dtheta^2*sin(theta)) - m^2*l^2*g*cos(theta)*sin(theta))/{DETERMINANT}
      ((M + m)*m*g*l*sin(theta) - m*l*cos(theta)*(F - b*dx + m*l*dtheta^2*sin(theta)))/{DETERMINANT}
"""
TURNED = """% q = [theta; x], A(q)*qdd + n(q, qd) = p
A = [J + m*l^2, m*l*cos(theta); m*l*cos(theta), M + m];
n = [-m*g*l*sin(theta); b*xd - m*l*thetad^2*sin(theta)];
p = [0; F];
"""

COMPACT = """>> A = simplify(jacobian(lhs, qdd))
A =
[M + m, l*m*cos(theta)]
[l*m*cos(theta), J + m*l^2]
>> rest = simplify(lhs - A*qdd)
rest =
 b*xp - l*m*sin(theta)*thetap^2
 -g*l*m*sin(theta)
% qdd = [x''; theta''], xp = x', thetap = theta', equations: A*qdd + rest = [F; 0]
"""
UNDERLINED = """M_ = [M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2]
C_ = [b, -m*l*theta'*sin(theta); 0, 0]
f = [F; m*g*l*sin(theta)]

M_ q'' + C_ q' = f

i.e.

[M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2]*[x''; theta''] + C_*[x'; theta'] = [F; m*g*l*sin(theta)]
"""
MOTOR = """% generalized coordinates [theta; q]
M = [J + m*l^2, 0; 0, L];
C = [b, -K; K, R];
f = [-m*g*l*sin(theta); u];
% M*qdd + C*qd + 0*q = f
"""
STATES = """function dz = motor(t, z)
  % z = [i; theta; w], i = q'
  i = z(1); theta = z(2); w = z(3);
  di = (u - R*i - K*w)/L;
  dw = (K*i - b*w - m*g*l*sin(theta))/(J + m*l^2);
  dz = [di; w; dw];
end
"""


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("written", "old", "new"),
    [
        (COMPACT, " b*xp", " -b*xp"),
        (UNDERLINED, "= [F; m*g*l*sin(theta)]\n", "= [F; -m*g*l*sin(theta)]\n"),
        (MOTOR, "[theta; q]", "[q; theta]"),
        (STATES, "K*i - b", "K*i + b"),
    ],
    ids=["compact", "underlined", "motor", "states"],
)
def test_names_of_columns_and_states(written: str, old: str, new: str) -> None:
    name = "dc-motor" if "K" in written else "cart-pole"
    assert old in written
    verdict = derivation(name).check(written)
    assert verdict.right, verdict.to_text()
    assert not derivation(name).check(written.replace(old, new), hint=0).right


@pytest.mark.sampled(12)
@pytest.mark.parametrize(
    ("written", "old", "new"),
    [
        (SHOWN, " b*dx", "-b*dx"),
        (ENTERED, "J + m*l^2", "J"),
        (ARRAYS, "m*g*l", "m*l"),
        (SOLVED, "F - b", "F + b"),
        (INVERTED, "m*g*l", "-m*g*l"),
        (ROWS, "- F", "+ F"),
        (MAXIMA, "+b*xp", "+b*tp"),
        (MAPLE, "cos(theta)^2", "sin(theta)^2"),
        (PRINTED, "F - b", "F + b"),
        (TURNED, "q = [theta; x]", "q = [x; theta]"),
    ],
    ids=["shown", "entered", "arrays", "solved", "inverted", "rows", "maxima", "maple", "printed", "turned"],
)
def test_matrices_of_programs(written: str, old: str, new: str) -> None:
    assert derivation("cart-pole").check(written, hint=0).right
    assert old in written
    assert not derivation("cart-pole").check(written.replace(old, new), hint=0).right


def test_a_list_of_states_says_what_they_are() -> None:
    said = """States: i (current), theta, w = theta'. With

  D = K*i - b*w - m*g*l*sin(theta), N = J + m*l^2

  i'     = (u - R*i - K*w)/L
  theta' = w
  w'     = D/N
"""
    assert derivation("dc-motor").check(said, hint=0).right
    wrong = derivation("dc-motor").check(said.replace("K*i - b", "K*i + b"))
    assert not wrong.right
    assert "as the words say" not in wrong.to_text()


@pytest.mark.sampled(4)
@pytest.mark.parametrize("unit", [r"\mathrm{Nms}", r"\,\mathrm{kgm^2/s}", r"\,\text{Nms/rad}"])
def test_units_without_a_sign_between_them(unit: str) -> None:
    row = r"m L^2\ddot\theta+b\dot\theta+mgL\sin\theta=0"
    values = rf"$m=1\,\mathrm{{kg}}$, $L=0.5\,\mathrm{{m}}$, $b=0.02{unit}$, $g=9.81\,\mathrm{{m/s^2}}$"
    written = rf"\[{row}\] With {values}: \[0.25\ddot\theta+0.02\dot\theta+4.905\sin\theta=0\]"
    assert derivation("pendulum").check(written, hint=0).right
    assert not derivation("pendulum").check(written.replace("4.905", "4.509"), hint=0).right


def test_a_unit_that_may_have_a_prefix_is_not_taken_apart() -> None:
    assert [joined(x) for x in ("Nms", "kgm", "Nmm", "ms", "kNm")] == [("N", "m", "s"), ("kg", "m"), (), (), ()]
    values = "m = 1 kg, L = 0.5 m, b = 0.02 Nms\n"
    row = "m*L^2*theta'' + b*theta' + m*g*L*sin(theta) = 0"
    assert derivation("pendulum").check(values + row, hint=0).right


def test_the_rate_of_a_column_is_no_single_quantity() -> None:
    wrong = "r = [x; theta]\nr'' = 3*x'\n"
    with pytest.raises(ParseError, match="a single quantity cannot equal a matrix"):
        derivation("cart-pole").check(wrong)
    verdict = derivation("cart-pole").check(wrong + "\n".join(ROWS_BY_HAND))
    assert verdict.right and "Line 2 could not be read" in verdict.to_text()


HEAD = """def rhs(t, y):
    x, theta, xd, thetad = y
    A = np.array([[M+m, m*l*np.cos(theta)], [m*l*np.cos(theta), J+m*l**2]])
    r = np.array([F - b*xd + m*l*np.sin(theta)*thetad**2, m*g*l*np.sin(theta)])
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("end", "right"),
    [
        ("acc = np.linalg.solve(A, r)\n    return [xd, thetad, acc[0], acc[1]]", True),
        ("xdd, thetadd = np.linalg.solve(A, r)\n    return [xd, thetad, xdd, thetadd]", True),
        ("acc = np.linalg.inv(A) @ r\n    return np.concatenate(([xd, thetad], acc))", True),
        ("acc = np.linalg.solve(A, -r)\n    return [xd, thetad, acc[0], acc[1]]", False),
        ("acc = np.linalg.solve(A, r)\n    return [xd, thetad, acc[1], acc[0]]", False),
        ("thetadd, xdd = np.linalg.solve(A, r)\n    return [xd, thetad, xdd, thetadd]", False),
    ],
)
def test_accelerations_that_a_function_solves_for_are_read(end: str, right: bool) -> None:
    assert derivation("cart-pole").check(f"{HEAD}    {end}\n", hint=0).right == right


def test_the_order_of_the_states_is_that_of_the_accelerations() -> None:
    turned = HEAD.replace("x, theta, xd, thetad = y", "theta, x, thetad, xd = y")
    assert not derivation("cart-pole").check(f"{turned}    acc = np.linalg.solve(A, r)\n    return acc\n", hint=0).right


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["acc", "qdd"])
def test_accelerations_below_velocities_are_the_rest_of_the_state(name: str) -> None:
    written = f"""function dy = rhs(t, y)
  x = y(1); theta = y(2); xd = y(3); thetad = y(4);
  A = [M+m, m*l*cos(theta); m*l*cos(theta), J+m*l^2];
  r = [F - b*xd + m*l*sin(theta)*thetad^2; m*g*l*sin(theta)];
  {name} = A\\r;
  dy = [xd; thetad; {name}];
end
"""
    judge = derivation("cart-pole")
    assert judge.check(written, hint=0).right
    assert not judge.check(written.replace("; m*g*l*", "; -m*g*l*"), hint=0).right
    assert not judge.check(written.replace("dy = [xd; thetad", "dy = [thetad; xd"), hint=0).right


OF_STATES = """function dz = rhs(t, z)
  % z = [x; theta; x'; theta']
  A = [M+m, m*l*cos(z(2)); m*l*cos(z(2)), J+m*l^2];
  r = [F - b*z(3) + m*l*sin(z(2))*z(4)^2; m*g*l*sin(z(2))];
"""
IN_JULIA = OF_STATES.replace("dz = rhs(t", "rhs!(dz").replace("z)", "z, p, t)", 1).replace("%", "#")
IN_PYTHON = """def rhs(t, y):
    x, theta, xd, thetad = y
    A = np.array([[M + m, m*l*np.cos(theta)], [m*l*np.cos(theta), J + m*l**2]])
    r = np.array([F - b*xd + m*l*np.sin(theta)*thetad**2, m*g*l*np.sin(theta)])
"""


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    "program",
    [
        f"{OF_STATES}dz = [z(3:4); A\\r];\nend",
        f"{OF_STATES}q = z(1:2); v = z(3:end);\nsol = A\\r;\ndz = [v; sol];\nend",
        f"{OF_STATES}dz = zeros(4, 1);\ndz(1:2) = z(3:4);\ndz(3:4) = inv(A)*r;\nend",
        f"{IN_JULIA}dz[1:2] .= z[3:4]\na = A \\ r\ndz[3] = a[1]\ndz[4] = a[2]\nend",
        f"{IN_PYTHON}    return np.concatenate(([xd, thetad], np.linalg.solve(A, r)))",
        f"{IN_PYTHON}    v = y[2:]\n    return np.r_[v, np.linalg.inv(A) @ r]",
    ],
)
def test_programs_slice_states_and_solve_in_lists(program: str) -> None:
    verdict = derivation("cart-pole").check(program)
    assert verdict.right and "0 = 0" not in verdict.to_text()
    assert not derivation("cart-pole").check(program.replace("m*g*l", "-m*g*l"), hint=0).right
    turned = re.sub(r"(?<!d)z([(\[])3:(?:4|end)", r"z\g<1>1:2", program)
    turned = turned.replace("y[2:]", "y[:2]").replace("[xd, thetad]", "[thetad, xd]")
    assert not derivation("cart-pole").check(turned, hint=0).right


MASSES = "[[M + m, m*l*cos(theta)], [m*l*cos(theta), J + m*l**2]]"
FORCES = "[[F - b*x' + m*l*theta'**2*sin(theta)], [m*g*l*sin(theta)]]"
OF_MATLAB = MASSES.replace("], [", "; ").replace("[[", "[").replace("]]", "]").replace("**", "^")
COLUMN = FORCES.replace("], [", "; ").replace("[[", "[").replace("]]", "]").replace("**", "^")


@pytest.mark.parametrize(
    "session",
    [
        f"In [5]: LM.mass_matrix\nOut[5]: Matrix({MASSES})\n\nIn [6]: LM.forcing\nOut[6]:\nMatrix({FORCES})",
        f">>> KM.mass_matrix\nMatrix({MASSES})\n>>> print(KM.forcing)\nMatrix({FORCES})",
        f"M = {OF_MATLAB};\nr = {COLUMN};\nacc = M\\r;",
    ],
)
def test_the_value_of_a_name_may_stand_below_it_and_accelerations_have_any_name(session: str) -> None:
    assert derivation("cart-pole").check(session, hint=0).right
    assert not derivation("cart-pole").check(session.replace("m*g*l", "m*l"), hint=0).right


@pytest.mark.parametrize(
    "form", ["In [5]: A\nOut[5]: Matrix({})\nIn [6]: f\nOut[6]: Matrix({})", "masses: {}\nforces: {}"]
)
def test_matrices_without_an_equation_are_not_wrong(form: str) -> None:
    verdict = derivation("cart-pole").check(form.format(MASSES, FORCES))
    assert verdict.status.name == "INCOMPLETE" and not verdict.findings


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "said",
    [
        "In [7]: # kinematics: x' = v, theta' = w; mass_matrix*[v', w'] = forcing",
        ">>> kde\n[v - x', w - theta']\n>>> # KM.mass_matrix * [v', w'] = KM.forcing",
        "In [7]: KM.kindiffdict()\nOut[7]: {x': v, theta': w}\n# mass_matrix * Matrix([v', w']) = forcing",
        "In [7]: KM.kindiffdict()\nOut[7]: {Derivative(x(t), t): v(t), Derivative(theta(t), t): w(t)}\n"
        "# mass_matrix * Matrix([v', w']) = forcing",
    ],
)
def test_speeds_of_kane_are_named_beside_the_matrices(said: str) -> None:
    forces = FORCES.replace("x'", "v").replace("theta'", "w")
    written = f"In [5]: mprint(simplify(KM.mass_matrix))\nMatrix({MASSES})\n"
    written += f"In [6]: mprint(KM.forcing)\nMatrix({forces})\n{said}"
    judge = derivation("cart-pole")
    assert judge.check(written, hint=0).right
    assert not judge.check(written.replace("b*v", "b*w"), hint=0).right


SOLVED = """function dz = odefun(t, z, p)
x = z(1); theta = z(2);
dx = z(3); dtheta = z(4);
MM = [M + m, m*l*cos(theta); ...
      m*l*cos(theta), J + m*l^2];
rhs = [F - b*dx + m*l*sin(theta)*dtheta^2; m*g*l*sin(theta)];
acc = MM\\rhs;   % ddx, ddtheta
dz = [dx; dtheta; acc];
end
"""
TOOLKIT = (
    f"""using ModelingToolkit: t_nounits as t, D_nounits as D
@parameters M m l
eqs = [
    {ROWS_BY_HAND[0].replace("=", "~")},
    {ROWS_BY_HAND[1].replace("=", "~")},
]
""".replace("x''", "D(D(x))")
    .replace("theta''", "D(D(θ))")
    .replace("theta'", "D(θ)")
    .replace("x'", "D(x)")
)
MODELICA = (
    f"""model Cart
  Real x, theta, v, w;
equation
  der(x) = v;
  der(theta) = w;
  {ROWS_BY_HAND[0]};
  {ROWS_BY_HAND[1]};
end Cart;
""".replace("x''", "der(v)")
    .replace("theta''", "der(w)")
    .replace("theta'", "w")
    .replace("x'", "v")
)


@pytest.mark.parametrize("program", [SOLVED, TOOLKIT, MODELICA])
def test_functions_of_matlab_and_models_of_julia_and_modelica_are_read(program: str) -> None:
    assert derivation("cart-pole").check(program, hint=0).right
    assert not derivation("cart-pole").check(program.replace("m*g*l", "2*m*g*l"), hint=0).right


def test_a_name_for_a_rate_in_a_state_is_no_product() -> None:
    program = """function dz = f(t, z)
x = z(1); y = z(2); theta = z(3);
dx = z(4); dy = z(5); dtheta = z(6);
dz = [dx; z(5); dtheta; -(b*dx + (F1 + F2)*sin(theta))/m; ((F1 + F2)*cos(theta) - b*dy)/m - g; L*(F1 - F2)/J];
end"""
    assert derivation("planar-quadrotor").check(program, hint=0).right
    assert not derivation("planar-quadrotor").check(program.replace("b*dy", "2*b*dy"), hint=0).right
