"""Pasted code around what programs print: what is typed states nothing unless it is an equation, and what is printed
counts.

Oracle: the equations of the cart with a pole and of the pendulum. Every form has a wrong twin, which stays wrong.
"""

import pytest

from built_in import derivation
from lagrangian import ParseError

X = "(M + m)*Derivative(x(t), (t, 2)) + b*Derivative(x(t), t) - F"
X = f"{X} - l*m*sin(theta(t))*Derivative(theta(t), t)**2 + l*m*cos(theta(t))*Derivative(theta(t), (t, 2))"
ANGLE = "(J + l**2*m)*Derivative(theta(t), (t, 2)) + l*m*cos(theta(t))*Derivative(x(t), (t, 2)) - g*l*m*sin(theta(t))"
PRINTED = f"Eq({X}, 0)\n\nEq({ANGLE}, 0)"
LATEX_X = (
    r"- F + b \frac{d}{d t} x{\left(t \right)} - l m \sin{\left(\theta{\left(t \right)} \right)} \left(\frac{d}{d t} "
    r"\theta{\left(t \right)}\right)^{2} + l m \cos{\left(\theta{\left(t \right)} \right)} \frac{d^{2}}{d t^{2}} "
    r"\theta{\left(t \right)} + \left(M + m\right) \frac{d^{2}}{d t^{2}} x{\left(t \right)} = 0"
)
LATEX_ANGLE = (
    r"- g l m \sin{\left(\theta{\left(t \right)} \right)} + l m \cos{\left(\theta{\left(t \right)} \right)} "
    r"\frac{d^{2}}{d t^{2}} x{\left(t \right)} + \left(J + l^{2} m\right) \frac{d^{2}}{d t^{2}} "
    r"\theta{\left(t \right)} = 0"
)
MAXIMA_X = "(M+m)*'diff(x,t,2)+l*m*cos(theta)*'diff(theta,t,2)-l*m*sin(theta)*'diff(theta,t,1)^2+b*'diff(x,t,1) = F"
MAXIMA_ANGLE = "(l^2*m+J)*'diff(theta,t,2)+l*m*cos(theta)*'diff(x,t,2)-g*l*m*sin(theta) = 0"
MAPLE_X = (
    "(M+m)*diff(x(t),t,t)+l*m*cos(theta(t))*diff(theta(t),t,t)-l*m*sin(theta(t))*diff(theta(t),t)^2 = F-b*diff(x(t),t)"
)
MAPLE_ANGLE = "(l^2*m+J)*diff(theta(t),t,t)+l*m*cos(theta(t))*diff(x(t),t,t)-g*l*m*sin(theta(t)) = 0"


def twins(written: str, old: str, new: str, name: str = "cart-pole") -> None:
    """An answer is right, and wrong with its pieces replaced."""
    assert old in written
    verdict = derivation(name).check(written)
    assert verdict.right, verdict.to_text()
    assert not derivation(name).check(written.replace(old, new), hint=0).right


@pytest.mark.parametrize(
    "session",
    [
        f"In [3]: xp, yp = x + l*sin(theta), l*cos(theta)\n   ...: Q = {{x: F - b*x.diff(t), theta: 0}}\n"
        f"   ...: for q in (x, theta):\n   ...:     v = q.diff(t)\n   ...:     print(Eq(L.diff(v).diff(t), Q[q]),"
        f" '\\n')\n\n{PRINTED}",
        f"Notebook, cell 4\n\nfor q, Q in ((x, F), (theta, 0)):\n    print(Eq(Lag.diff(q.diff(t)).diff(t), Q))\n\n"
        f"Out:\n\n{PRINTED}",
    ],
)
def test_loops_tuples_and_tables_state_nothing(session: str) -> None:
    twins(session, "l*m*cos", "l*m*sin")


def test_a_minus_that_begins_printed_latex_is_no_bullet() -> None:
    session = "[7]: print(latex(V))\n\n\\frac{g l m}{2}\n\n[8]: for e in eqs: print(latex(e))\n\n"
    session += f"{LATEX_X}\n{LATEX_ANGLE}"
    twins(session, "\n- g l m", "\ng l m")
    both = session.replace("\n- g l m", "\ng l m").replace("\n- F", "\nF")
    assert not derivation("cart-pole").check(both, hint=0).right
    said = " ".join(map(str, derivation("cart-pole").check(session).notes))
    assert "frac{g l m}{2}' was not judged" in said and "Lines 1 and 5 hold commands" in said


def test_a_bullet_that_may_be_a_minus_is_told() -> None:
    rows = "- (M+m) x'' + b x' + m l cos(theta) theta'' - m l sin(theta) theta'^2 = F\n"
    rows += "- (J + m l^2) theta'' + m l cos(theta) x'' - m g l sin(theta) = 0"
    said = [str(note) for note in derivation("cart-pole").check(rows).notes]
    assert "The sign at the beginning of lines was read as that of a list." in said
    twins(rows, "- m g l", "+ m g l")
    words = rows.replace("- (M", "- cart: (M").replace("- (J", "- pole: (J")
    assert not any("that of a list" in str(note) for note in derivation("cart-pole").check(words).notes)


def test_a_session_of_maxima_is_read() -> None:
    session = (
        f"(%i1) depends([x,theta],t)$\n(%i2) c:l*cos(theta)$  s:l*sin(theta)$\n"
        "(%i4) T:1/2*M*diff(x,t)^2+1/2*m*diff(x+s,t)^2+1/2*m*diff(c,t)^2+1/2*J*diff(theta,t)^2$  V:m*g*c$\n"
        "(%i6) el(q,f):=diff(diff(T-V,diff(q,t)),t)-diff(T-V,q)=f$\n"
        f"(%i7) el(x,F-b*diff(x,t));\n(%o7) {MAXIMA_X}\n(%i8) eq2: {MAXIMA_ANGLE};\n(%o8) {MAXIMA_ANGLE}"
    )
    twins(session, "-g*l*m", "+g*l*m")
    twins(session, "V:m*g*c", "V:-m*g*c")
    twins(session, "l*m*cos(theta)*'diff(theta", "l*m*sin(theta)*'diff(theta")


def test_procedures_of_ones_own_in_maple_are_commands() -> None:
    session = (
        '> restart: read "el.mpl":   # EL is the left-hand side\n> L := 1/2*(M+m)*diff(x(t),t)^2'
        "+m*l*cos(theta(t))*diff(x(t),t)*diff(theta(t),t)\n>     +1/2*(J+m*l^2)*diff(theta(t),t)^2"
        "-m*g*l*cos(theta(t)):\n> eq1 := EL(L,x(t)) = F-b*diff(x(t),t):  eq2 := EL(L,theta(t)) = 0:\n"
        f"> lprint(eq1);\n{MAPLE_X}\n> lprint(eq2);\n{MAPLE_ANGLE}"
    )
    twins(session, "-g*l*m", "+g*l*m")
    said = " ".join(map(str, derivation("cart-pole").check(session).notes))
    assert "commands of a program" in said


def test_an_equation_with_a_procedure_in_it_is_not_left_out() -> None:
    with pytest.raises(ParseError):
        derivation("cart-pole").check(f"> {MAPLE_X}\n> (l^2*m+J)*diff(theta(t),t,t) + GL(V,theta(t)) = 0;")


def test_a_right_side_that_is_printed_below_a_drawing_belongs_to_it() -> None:
    drawn = (
        '>>> pprint(lhs); print("= 0")\n\n'
        "      2                                      \n"
        " 2   d                                       \n"
        "L ⋅m⋅───(θ(t))                       d       \n"
        "       2                           b⋅──(θ(t))\n"
        "     dt          L⋅g⋅m⋅sin(θ(t))     dt      \n"
        "────────────── + ─────────────── + ──────────\n"
        "      2                 2              2     \n= 0"
    )
    twins(drawn, " + ───────────────", " - ───────────────", "pendulum")


@pytest.mark.parametrize("second", [r"\frac{\partial ^2}{\partial t^2}", r"\frac{\partial^{2}}{\partial t^{2}}"])
def test_rates_as_matlab_writes_them_in_latex_are_read(second: str) -> None:
    rows = (
        f"$$L^2\\,m\\,{second} \\theta \\left(t\\right)"
        "+b\\,\\frac{\\partial }{\\partial t} \\theta \\left(t\\right)"
        "+L\\,g\\,m\\,\\sin \\left(\\theta \\left(t\\right)\\right)=0$$"
    )
    twins(rows, "+L\\,g", "-L\\,g", "pendulum")


ENERGY = "1/2 M x'[t]^2 + 1/2 m (x'[t]^2 + 2 l x'[t] theta'[t] Cos[theta[t]] + l^2 theta'[t]^2) + 1/2 J theta'[t]^2"


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("stated", "of"),
    [
        (f"tt = {ENERGY};\nvv = m g l Cos[theta[t]];\nlag = tt - vv;", "lag"),
        (f"T = {ENERGY};\nV = m g l Cos[theta[t]];", "T - V"),
        (f"T = {ENERGY};\nV = m g l Cos[theta[t]];\neq[q_, Q_] := D[D[T, q'[t]], t] - D[T, q[t]] == Q;", "T - V"),
    ],
)
def test_what_is_differentiated_has_a_name_of_its_own(stated: str, of: str) -> None:
    lines = "\n".join(
        f"D[D[{of}, {q}'[t]], t] - D[{of}, {q}[t]] == {Q}" for q, Q in (("x", "F - b x'[t]"), ("theta", "0"))
    )
    cart = derivation("cart-pole")
    found = cart.check(f"{stated}\n{lines}")
    assert found.right and "Q_" not in str(found)
    assert not cart.check(f"{stated}\n{lines}".replace("m g l", "2 m g l"), hint=0).right
    assert not cart.check(f"{stated}\n{lines}".replace("F - b", "F + b"), hint=0).right


MODEL = """model Pole "on a cart"
  parameter Real M = 1, m = 0.2, l = 0.3, b = 0.1, g = 9.81, J = 0.006;
  input Real F;
  Real x(start = 0), theta(start = 0.1), v, omega "rate of the pole";
  Real s = sin(theta);
equation
  v = der(x);
  omega = der(theta);
  (M + m)*der(v) + m*l*cos(theta)*der(omega) - m*l*s*omega^2 + b*v = F;   // cart
  (J + m*l^2)*der(omega) + m*l*cos(theta)*der(v) = m*g*l*s;
end Pole;"""


def test_a_model_in_modelica_is_its_equations() -> None:
    cart = derivation("cart-pole")
    assert cart.check(MODEL, hint=0).right
    for old, new in (("= F;", "= -F;"), ("sin(theta)", "cos(theta)"), ("s*omega^2", "s*omega")):
        assert old in MODEL
        assert not cart.check(MODEL.replace(old, new), hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("stated", "calls"),
    [
        ("EL[q_] := D[D[T - V, q'[t]], t] - D[T - V, q[t]]", ("EL[x] == {}", "EL[theta] == 0")),
        (
            "EL[q_] := D[D[T - V, D[q, t]], t] - D[T - V, q]",
            ("e1 = EL[x[t]] == {}", "e2 = Simplify[EL[theta[t]]] == 0"),
        ),
        ("eq[q_, Q_] := D[D[T - V, q'[t]], t] - D[T - V, q[t]] == Q", ("eq[x, {}]", "eq[theta, 0]")),
    ],
)
def test_functions_that_differentiate_are_written_out_where_they_are_called(
    stated: str, calls: tuple[str, str]
) -> None:
    sheet = f"T = {ENERGY};\nV = m g l Cos[theta[t]];\n{stated};\n" + "\n".join(calls)
    cart = derivation("cart-pole")
    assert cart.check(sheet.format("F - b x'[t]")).right
    assert not cart.check(sheet.format("F + b x'[t]")).right
    assert not cart.check(
        sheet.format("F - b x'[t]").replace(" t] - D[", " t] + D[", 1).replace(", t]] - ", ", t]] + ")
    ).right


def test_a_capital_letter_twice_is_a_name_in_mathematica() -> None:
    rows = f"T = {ENERGY};\nV = m g l Cos[theta[t]];".replace("J theta", "JJ theta")
    rows += "\n(M + m) x''[t] + m l theta''[t] Cos[theta[t]] - m l theta'[t]^2 Sin[theta[t]] + b x'[t] == F"
    rows += "\n(JJ + m l^2) theta''[t] + m l x''[t] Cos[theta[t]] - m g l Sin[theta[t]] == 0"
    twins(f"(* JJ is the moment J of the pole *)\n{rows}", "- m g l Sin", "+ m g l Sin")


@pytest.mark.parametrize(
    ("said", "inertia", "damper"),
    [("", "jj", "b"), ("", "JJ", "b"), ("jj, cc are the constants J, b of the plan", "jj", "cc")],
)
def test_a_letter_twice_in_front_of_a_rate_is_a_name(said: str, inertia: str, damper: str) -> None:
    rows = f"(* {said} *)\n" + (
        f"M x''[t] + m x''[t] + m l theta''[t] Cos[theta[t]] - m l theta'[t]^2 Sin[theta[t]] + {damper} x'[t] == F\n"
        f"{inertia} theta''[t] + m l^2 theta''[t] + m l x''[t] Cos[theta[t]] - m g l Sin[theta[t]] == 0"
    )
    twins(rows, f"\n{inertia} theta", f"\n2 {inertia} theta")


def test_a_small_letter_twice_is_a_product_where_the_system_has_it() -> None:
    pendulum = derivation("pendulum")
    assert pendulum.check("m*L^2*theta'' + bb theta'/b + m*g*L*sin(theta) = 0").right
    assert not pendulum.check("m*L^2*theta'' + bb theta' + m*g*L*sin(theta) = 0").right
