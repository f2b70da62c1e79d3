"""What programs set around equations: comments in brackets, prompts, names of lists, fields, diagonals, slices.

Oracle: the equations of the cart with a pole and of the pendulum in the grammar of model files. Every form has a wrong
twin, which stays wrong.
"""

import pytest
import sympy as sp
from small_systems import pendulum

from built_in import derivation
from lagrangian import ParseError, System

MATRICES = "MM = [M + m,             m*l*cos(theta);\n      m*l*cos(theta),    J + m*l^2];\n"
RIGHT_SIDE = "f = [F - b*x' + m*l*theta'^2*sin(theta);\n     m*g*l*sin(theta)];\n"


def right(written: str, name: str = "cart-pole") -> bool:
    """Whether an answer is judged right."""
    return derivation(name).check(written, hint=0).right


def twins(written: str, old: str, new: str, name: str = "cart-pole") -> None:
    """An answer is right, and wrong with one of its pieces replaced."""
    assert old in written
    assert right(written, name)
    assert not right(written.replace(old, new), name)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("first", "last"),
    [
        ("", " (* B is b *)"),
        ("(* La = 1/2 m l^2 theta'[t]^2 *)\n", "\n(* B = b *)"),
        ("(* two\n lines = long *)\n", "\n(* B = b *)"),
        ("eqs = ", "   (* B = b, E = J *)"),
    ],
)
def test_comments_of_mathematica_are_no_part_of_equations(first: str, last: str) -> None:
    rows = "{(M + m) x''[t] + m l Cos[theta[t]] theta''[t] - m l Sin[theta[t]] theta'[t]^2 + B x'[t] == F,\n"
    rows += " (J + m l^2) theta''[t] + m l Cos[theta[t]] x''[t] - m g l Sin[theta[t]] == 0}"
    twins(f"{first}{rows}{last}", "- m g l", "+ m g l")


def test_a_comment_inside_an_equation_is_left_out() -> None:
    twins("m L^2 theta''[t] + (* damping *) b theta'[t] + m g L Sin[theta[t]] == 0", "+ m g", "- m g", "pendulum")


def test_a_result_that_matlab_shows_is_an_equation() -> None:
    shown = (
        ">> EL = simplify(diff(p,t) - diff(Lag,theta) - Q)\n\nEL =\n\nm*L^2*diff(theta(t), t, t) + b*diff(theta(t), t)"
    )
    twins(f"{shown} + L*g*m*sin(theta(t))\n\n>> % so EL = 0 is the equation of motion", "+ L*g", "- L*g", "pendulum")


def test_matrices_in_several_lines_that_end_with_semicolons() -> None:
    twins(f"% q = [x; theta]\n{MATRICES}{RIGHT_SIDE}qdd = MM\\f;", "m*g*l", "-m*g*l")
    twins(f"{MATRICES}{RIGHT_SIDE}MM*[x''; theta''] = f", "l^2", "l")


def test_an_equation_of_matrices_may_stand_in_a_comment_alone() -> None:
    columns = "% MM*phidd + DD*phid + h = [F; 0],  phi = [x; theta]"
    rest = "h = [-m*l*theta'^2*sin(theta); -m*g*l*sin(theta)];\n"
    twins(f"{MATRICES}DD = diag([b 0]);\n{rest}{columns}", "diag([b 0])", "diag([0 b])")


def test_fields_of_parameters_and_slices_of_states() -> None:
    program = "% z = [theta; w]\ndz(1:1) = z(2:2);\ndz(2) = -(p.b*z(2) + p.m*p.g*p.L*sin(z(1)))/(p.m*p.L^2);"
    twins(program, "p.b*z(2) +", "p.b*z(2) -", "pendulum")


@pytest.mark.parametrize("unit", ["kg m²", "kg m^2", "kg*m^2"])
def test_units_behind_numbers_are_units_where_only_that_is_right(unit: str) -> None:
    model = derivation("pendulum").model
    m, length, b, g = (float(model.values[next(p.symbol for p in model.parameters if p.name == x)]) for x in "mLbg")
    row = f"{m * length**2:.6g} {unit} · theta'' + {b:.6g} N m s · theta' + {m * g * length:.6g} N m · sin(theta) = 0"
    twins(row, "· sin", "· cos", "pendulum")


def test_units_behind_numbers_are_no_products_of_parameters_and_degrees_belong_to_their_number() -> None:
    row = "(2 kg + 0.01 kg m²/(0.1 m)²)·ẍ − 2 kg·9.81 m/s²·sin 20° = 0"
    twins(row, "0.1 m", "0.2 m", "rolling-cylinder")
    wrong = derivation("rolling-cylinder").check(row.replace("sin 20°", "cos 20°")).to_text()
    assert "should be" in wrong or "sin(" in wrong
    assert "0.349" not in wrong
    assert derivation("rolling-cylinder").check("2 m x'' − 2 m g sin(alpha) + 2 J/R^2 x'' = 0", hint=0).right


@pytest.mark.parametrize(
    "row",
    [
        "5 x'' + cos 30° s'' = F\ncos(30°) x'' + s'' = 9.81 sin 30°",
        "5 x'' + sqrt(3)/2 s'' = F\nsqrt(3)/2 x'' + s'' = 9.81/2",
        r"\[5\ddot x + \cos 30^\circ\,\ddot s = F\] \[\cos 30^{\circ}\ddot x + \ddot s = 9.81\sin30\,^\circ\]",
    ],
    ids=["degrees", "roots", "LaTeX"],
)
def test_angles_in_degrees_are_exact(row: str) -> None:
    twins(row, "9.81", "9.18", "wedge")


def test_a_dash_in_front_of_a_label_is_that_of_a_list() -> None:
    said = "- inertia about pivot: J_A = m L^2\n- eq. of motion:\n\n  J_A theta'' + b theta' + m g L sin theta = 0"
    twins(said, "m L^2", "m L", "pendulum")


def test_a_sentence_ends_behind_a_definition() -> None:
    said = "I used the angle from the left side, psi = theta + pi/2. It is nicer.\n\n"
    twins(f"{said}m L^2 psi'' + b psi' - m g L cos psi = 0", "- m g", "+ m g", "pendulum")


def test_mathematics_in_words_between_rows_is_read() -> None:
    text = "\\begin{align}\n\\intertext{With $M_t = M+m$ and $I = J + m\\ell^2$, $\\ell = l$:}\n"
    text += "M_t\\,\\ddot{x} "
    text += "+ ml\\left(\\ddot\\theta\\cos\\theta - \\dot\\theta^2\\sin\\theta\\right) &= F - b\\dot{x}\\\\\n"
    text += "I\\ddot\\theta + ml\\,\\ddot{x}\\cos\\theta - mgl\\sin\\theta &= 0\n\\end{align}"
    twins(text, "I = J + m", "I = J - m")


def test_momenta_and_slopes_in_letters_are_judged_as_such() -> None:
    steps = "L = T - V\ndL/dxdot = (M+m)*xdot + m*l*thetadot*cos(theta)\n"
    steps += "d/dt(dL/dxdot) = (M+m)*xddot + m*l*thetaddot*cos(theta) - m*l*thetadot^2*sin(theta)\ndL/dx = 0\n"
    steps += "(M+m)*xddot + m*l*thetaddot*cos(theta) - m*l*thetadot^2*sin(theta) = F - b*xdot\n"
    steps += "(J+m*l^2)*thetaddot + m*l*xddot*cos(theta) - m*g*l*sin(theta) = 0"
    twins(steps, "dL/dxdot = (M+m)*xdot", "dL/dxdot = M*xdot")
    twins(steps, "dL/dx = 0", "dL/dx = b")


def test_a_name_a_few_words_and_its_value() -> None:
    said = "With I_A the moment of inertia m*L^2, we get  I_A*theta'' + b*theta' + m*g*L*sin(theta) = 0"
    twins(said, "m*L^2", "m*L", "pendulum")


@pytest.mark.parametrize("said", ["% w: speed of the rod (theta')", "w is the angular velocity (theta')."])
def test_a_name_with_its_rate_in_brackets(said: str) -> None:
    twins(f"{said}\nm*L^2*w' + b*w + m*g*L*sin(theta) = 0", "theta')", "theta'')", "pendulum")


@pytest.mark.parametrize(
    ("said", "new"), [("The rod's speed w is theta'.", "theta''"), ("w = theta', the angular velocity.", "theta''")]
)
def test_a_sentence_that_says_what_a_rate_is_called(said: str, new: str) -> None:
    twins(f"{said}\nm*L^2*w' + b*w + m*g*L*sin(theta) = 0", "theta'", new, "pendulum")
    assert right("The speed is theta'.\nm*L^2*theta'' + b*theta' + m*g*L*sin(theta) = 0", "pendulum")


def test_a_value_that_is_denoted_by_a_name() -> None:
    twins("Denote m L^2 by A.\nA theta'' + b theta' + m g L sin theta = 0", "m L^2", "m L", "pendulum")


def test_two_names_that_a_sentence_calls_rates() -> None:
    said = "where omega is the angular velocity and alpha is the angular acceleration"
    row = "m*L^2*alpha + b*omega + m*g*L*sin(theta) = 0"
    assert right(f"{row}\n{said}", "pendulum")
    with pytest.raises(ParseError, match="what is 'alpha'"):
        right(f"{row.replace('+ m*g', '- m*g')}\n{said}", "pendulum")


def test_names_that_words_call_accelerations_are_rates_where_that_is_right() -> None:
    rows = "(M + m)*a1 + m*l*a2*cos(theta) - m*l*theta'^2*sin(theta) + b*x' = F\n"
    rows += "(J + m*l^2)*a2 + m*l*a1*cos(theta) - m*g*l*sin(theta) = 0\n(a1, a2: accelerations of cart and pole)"
    assert right(rows)
    with pytest.raises(ParseError, match="what is 'a1'"):
        right(rows.replace("- m*g", "+ m*g"))


@pytest.mark.parametrize(
    ("row", "name"),
    [
        ("m L w' + b w + m g L cos theta = 0", "w"),
        ("m L*al + b theta' + m g L sin theta = 0", "al"),
        ("Mine psi = theta + the angle of that, as drawn\n\nm L psi'' + b psi' + m g L cos psi = 0", "psi"),
    ],
)
def test_a_name_that_moves_and_that_nothing_explains_is_asked_about(row: str, name: str) -> None:
    with pytest.raises(ParseError, match=f"cannot be read: what is '{name}'"):
        right(row, "pendulum")
    assert right("m L^2 w' + b w + m g L sin theta = 0", "pendulum")  # it can only be θ'


def test_the_end_of_an_equation_in_a_comment_gives_no_name_its_meaning() -> None:
    row = "xdd = (F - b*xd - m*l*thetadd*cos(theta) + m*l*thetad^2*sin(theta))/(M + m);\n"
    rows = row + "thetadd = (m*g*l*sin(theta) - m*l*xdd*cos(theta))/(J + m*l^2);"
    comment = "% cart: (M + m)*xdd + m*l*thetadd*cos(theta) - m*l*thetad^2*sin(theta) + b*xd = F\n"
    twins(comment + rows, "b*xd -", "b*xd +")
    assert right("% - v = x'\n" + rows.replace("xd ", "v "))


def test_maple_indexes_parameters_in_brackets() -> None:
    system = System("two masses")
    x, y = system.coordinates("x y")
    m1, m2, k_a = system.parameters("m1 m2 k_a")
    system.kinetic((m1 * x.diff() ** 2 + m2 * y.diff() ** 2) / 2)
    system.spring(k_a, deflection=y - x)
    masses = system.derive()
    rows = "eq1 := m[1]*diff(x(t), t, t) = k[a]*(y(t) - x(t));\neq2 := m[2]*diff(y(t), t, t) = -k[a]*(y(t) - x(t));"
    assert masses.check(rows, hint=0).right
    assert not masses.check(rows.replace("m[2]", "m[1]"), hint=0).right
    assert not masses.check(rows.replace("= k[a]", "= -k[a]"), hint=0).right


def test_a_letter_is_what_a_program_declares_it_as() -> None:
    s = System("slope")
    x = s.coordinates("x")
    m, g, alpha, k = s.parameters("m g alpha k")
    s.kinetic(m * x.diff() ** 2 / 2)
    s.potential(-m * g * x * sp.sin(alpha))
    s.spring(k, deflection=x)
    program = "m, g, al, c = sp.symbols('m g alpha k')\nV = -m*g*x*sp.sin(al) + c*x**2/2\nT = m*x'**2/2\n"
    d = s.derive()
    assert d.check(program, hint=0).right
    assert not d.check(program.replace("sin(al)", "sin(c)"), hint=0).right
    assert not d.check(program.replace("'m g alpha k'", "'m alpha g k'"), hint=0).right
    rates = "z = dynamicsymbols('x')\nzd = dynamicsymbols('x', 1)\n"
    assert d.check(rates + program.replace("x'", "zd").replace("m*g*x", "m*g*z").replace("c*x", "c*z"), hint=0).right


CALLS = ["diff(diff(L, {v}), 't')", 'diff(diff(L, {v}), "t")', "diff(L, {v}, 't')", "D(D(L, '{v}'), 't')"]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("call", CALLS)
def test_what_is_differentiated_by_may_be_a_text_in_quotes(call: str) -> None:
    sheet = "L = 1/2*m*l^2*phid^2 + m*g*l*cos(phi)\n" + f"{call.format(v='phid')} - diff(L, phi) = M - b*phid"
    assert pendulum().check(sheet, hint=0).right
    assert not pendulum().check(sheet.replace("g*l*cos", "g*l*sin"), hint=0).right
    assert not pendulum().check(sheet.replace("- b*phid", "+ b*phid"), hint=0).right


PROGRAM = """from sympy import *
t, m, l, g, b, M = symbols('t m l g b M')
phi = Function('phi')(t)
phid = diff(phi, 't')
L = m*l**2*phid**2/2 + m*g*l*cos(phi)
print(diff(diff(L, phid), 't') - diff(L, phi) + b*phid - M)
"""
MATLAB = """syms m l g b M phi(t)
phid = diff(phi, 't');
L = m*l^2*phid^2/2 + m*g*l*cos(phi);
eq1 = diff(diff(L, phid), 't') - diff(L, phi) == M - b*phid
"""


@pytest.mark.parametrize("program", [PROGRAM, MATLAB])
def test_a_program_that_differentiates_by_a_text_in_quotes(program: str) -> None:
    assert pendulum().check(program, hint=0).right
    assert not pendulum().check(program.replace("cos(phi)", "sin(phi)"), hint=0).right
    assert not pendulum().check(program.replace("b*phid", "2*b*phid"), hint=0).right
