"""Sessions of programs: prompts, commands, lists of expressions and solutions as Jupyter, SymPy, Mathematica and Maple
print them.

Oracle: the equations of the cart with a pole and of the pendulum, in the spelling that these programs print. Every form
has a wrong twin, which stays wrong.
"""

import pytest

from built_in import derivation
from lagrangian import ParseError

X = "F - b*Derivative(x(t), t) - (M + m)*Derivative(x(t), (t, 2)) - l*m*cos(theta(t))*Derivative(theta(t), (t, 2))"
X = f"{X} + l*m*sin(theta(t))*Derivative(theta(t), t)**2"
ANGLE = "(J + l**2*m)*Derivative(theta(t), (t, 2)) + l*m*cos(theta(t))*Derivative(x(t), (t, 2)) - g*l*m*sin(theta(t))"
PENDULUM = "L**2*m*Derivative(theta(t), (t, 2)) + L*g*m*sin(theta(t)) + b*Derivative(theta(t), t)"
SOLVED = "(-L*g*m*sin(theta(t)) - b*Derivative(theta(t), t))/(L**2*m)"
MATHEMATICA = "(b Derivative[1][theta][t])/(m L^2) + Derivative[2][theta][t] + (g Sin[theta[t]])/L == 0"
SWING = "m L^2 theta''[t] + b theta'[t] + m g L Sin[theta[t]]"


def right(written: str, name: str) -> bool:
    """Whether an answer is judged right."""
    return derivation(name).check(written, hint=0).right


def twins(written: str, name: str, old: str = "l*m*cos", new: str = "l*m*sin") -> None:
    """An answer is right, and wrong with one of its pieces replaced."""
    assert old in written
    assert right(written, name)
    assert not right(written.replace(old, new), name)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "session",
    [
        f"In [8]: LM.form_lagranges_equations()\nOut[8]: \nMatrix([\n[{X}],\n[  {ANGLE}]])",
        f"In [1]: from sympy.physics.mechanics import *\n\nIn [2]: LM = LagrangesMethod(Lag, [x, theta], forcelist=fl,"
        f" frame=N)\n\nOut[3]: Matrix([[{X}], [{ANGLE}]])",
        f"N = ReferenceFrame('N'); P = Point('P'); P.set_vel(N, x.diff(t)*N.x)\nLM = LagrangesMethod(T - V, [x, theta],"
        f"\n    forcelist=[(P, (F - b*x.diff(t))*N.x)],\n    frame=N)\nMatrix([[{X}], [{ANGLE}]])",
        f"%matplotlib inline\nimport sympy as sp\nsp.init_printing()\n"
        f"eqs = sp.Matrix([\n    [{X}],\n    [{ANGLE}],\n])",
        f"eqs = [\n  {X},\n  {ANGLE},\n]\n# all of them are zero",
        f"residuals = ({X},\n             {ANGLE})",
        f">>> pprint(eqs)\n>>> [print(e) for e in eqs]\n>>> print(Eq({X}, 0))\n>>> display(Eq(0, {ANGLE}))",
        f"eq1 = simplify({X})\nprint(Eq({X}, 0)); print(Eq({ANGLE}, 0))\nplt.plot(t, sol.y[0], label='x')",
        f"plot(t, x, 'r'); xlabel('t'); legend(['x'])\n{X} = 0\n{ANGLE} = 0",
        f"for e in LM.eom: display(simplify(e))\n{X} = 0\n{ANGLE} = 0",
    ],
)
def test_commands_of_sympy_state_nothing(session: str) -> None:
    twins(session, "cart-pole")


@pytest.mark.parametrize(
    "session",
    [
        f"In[9]:= InputForm[eom]\n\nOut[9]//InputForm= \n{{{MATHEMATICA}}}",
        f"In[3]:= eom // FullSimplify\n\nOut[3]= {SWING} == 0",
        "In[4]:= TeXForm /@ eqs\nOut[4]//TeXForm=\nm L^2 \\theta ''(t)+b \\theta '(t)+m g L \\sin (\\theta (t))=0",
        f"Simplify[{SWING} == 0]",
        f'Needs["VariationalMethods`"]\neqn = EulerEquations[lag, theta[t], t];\n{SWING} == 0',
        f"sol = NDSolve[{{eqn, theta[0] == 1}}, theta, {{t, 0, 10}}]\n{SWING} == 0",
        "{{theta''[t] -> -((b theta'[t] + m g L Sin[theta[t]])/(m L^2))}}",
        "eqs = {m \\[Theta]''[t] L^2 + b \\[Theta]'[t] ==\n  -m g L Sin[\\[Theta][t]]}",
    ],
)
def test_inputs_and_outputs_of_mathematica(session: str) -> None:
    old, new = ("g Sin", "2 g Sin") if "(g Sin" in session else ("m g L", "m g")
    twins(session, "pendulum", old, new)


@pytest.mark.parametrize(
    "session",
    [
        f"In [5]: sol = solve(eq, theta.diff(t, 2))\nIn [6]: sol\nOut[6]: {{Derivative(theta(t), (t, 2)): {SOLVED}}}",
        f"sol = solve([eq1], [thetadd], dict=True)\n{{thetadd: {SOLVED}}}",
        f"from sympy.physics.mechanics import dynamicsymbols ... In[12]: print(LM.eom)\nMatrix([[{PENDULUM}]])",
        f"> restart; with(Physics):\n> L := T - V;\n{PENDULUM} = 0",
    ],
)
def test_solutions_and_single_rows(session: str) -> None:
    twins(session, "pendulum", "L*g*m", "g*m")


CART = "(M + m)*{0}(x) + m*l*cos(θ)*{0}(θ) - m*l*sin(θ)*{1}(θ)^2 ~ F - b*{1}(x)"
POLE = "1//2*2(J + m*l^2)*{0}(θ) + m*l*cos(θ)*{0}(x) ~ m*g*l*sin(θ)"
OF_JULIA = "@variables x(t) θ(t)\nD = Differential(t)\n"
IN_JULIA = [x.replace("{0}(x)", "D(D(x))").replace("{0}(θ)", "D(D(θ))").replace("{1}", "D") for x in (CART, POLE)]
IN_MAPLE = [
    x.replace("{0}(x)", "diff(x(t), t$2)").replace("{0}(θ)", "diff(θ(t), t$2)").replace(" ~ ", " = ")
    for x in (CART.replace("{1}(x)", "diff(x(t), t)").replace("{1}(θ)", "diff(θ(t), t)"), POLE.replace("//", "/"))
]


@pytest.mark.parametrize(
    "session",
    [
        f"{OF_JULIA}eqs = [\n  {IN_JULIA[0]},\n  {IN_JULIA[1]}\n]\n@named sys = ODESystem(eqs, t)",
        f"julia> D = Differential(t)\njulia> eqs = [{IN_JULIA[0]}\n  {IN_JULIA[1]}]",
        f"{OF_JULIA}eq1 = {IN_JULIA[0]}\neq2 = {IN_JULIA[1]}".replace("D(", "Dt(").replace("D =", "Dt ="),
        f"> eqs := [ {IN_MAPLE[0]},\n  {IN_MAPLE[1]} ];",
        f"> ode := {{{IN_MAPLE[0]},\n>  {IN_MAPLE[1]}}};",
    ],
)
def test_lists_of_equations_of_julia_and_maple(session: str) -> None:
    twins(session, "cart-pole", "m*g*l", "m*g")


def test_sets_of_equations_in_the_latex_of_programs() -> None:
    rows = (
        "\\left\\{m l \\cos (\\theta (t)) \\theta ''(t)+(m+M) x''(t)+b x'(t)-m l \\theta '(t)^2 \\sin (\\theta (t))=F,"
    )
    rows += "\\left(J+m l^2\\right) \\theta ''(t)+m l \\cos (\\theta (t)) x''(t)=m g l \\sin (\\theta (t))\\right\\}"
    twins(f"In[2]:= TeXForm[eqs]\n\nOut[2]//TeXForm= {rows}", "cart-pole", "+b x'", "-b x'")


def test_a_note_says_which_lines_hold_commands() -> None:
    checked = derivation("pendulum").check(f"N = ReferenceFrame('N')\nplot(t, x)\n{PENDULUM} = 0")
    assert "Lines 1 and 2 hold commands of a program" in " ".join(checked.to_text().split())


@pytest.mark.parametrize(
    "command",
    ["sol = solve([m*L**2*theta.diff(t, 2) - b*theta.diff(t)], [w])", "add_row(m*L*theta'' + b*theta', k=2)"],
)
def test_an_equation_of_motion_in_a_command_is_never_left_out(command: str) -> None:
    with pytest.raises(ParseError):
        derivation("pendulum").check(f"{PENDULUM} = 0\n{command}")
    assert "could not be read" in derivation("pendulum").check(f"{command}\n{PENDULUM} = 0").to_text()


def test_a_name_that_a_command_sets_has_no_value() -> None:
    with pytest.raises(ParseError, match="weight"):
        right("weight = get_weight(m, g, units='SI')\nm*L**2*theta'' + b*theta' + weight*L*sin(theta) = 0", "pendulum")


NOTEBOOK = r"""```python
theta = dynamicsymbols('theta')
P = Matrix([L*sin(theta), -L*cos(theta), 0])
v = P.diff(t)
V = m*g*P[1]
T = simplify(m/2*v.dot(v))
T
```
Out[2]: $\displaystyle \frac{L^{2} m \dot{\theta}^{2}}{2}$

```python
expand(LM.eom)
```
Out[3]: $\displaystyle L^{2} m \ddot{\theta} + L g m \sin{\left(\theta \right)} + b \dot{\theta}$

(this must be zero)
"""


@pytest.mark.parametrize(
    ("old", "new"),
    [("m*g*P[1]", "m*g*P[0]"), (r"{L^{2} m", r"{L m"), ("+ b", "- b")],
    ids=["entry", "value of a name", "zero"],
)
def test_what_a_notebook_shows_belongs_to_its_cell(old: str, new: str) -> None:
    twins(NOTEBOOK, "pendulum", old, new)


def test_a_column_times_itself_is_a_sum_of_squares() -> None:
    code = NOTEBOOK.replace("simplify(m/2*v.dot(v))\nT\n", "m/2*v.dot(v)\n").partition("Out[2]")[0].replace("`", "")
    rows = "\nL**2*m*theta'' + L*g*m*sin(theta) + b*theta' = 0"
    twins(code.replace("python", "") + rows, "pendulum", "m/2*v", "m*v")


ROWS = (
    "'diff(x,t,2)*(M+m) + l*m*cos(theta)*'diff(theta,t,2) - l*m*sin(theta)*('diff(theta,t))^2 + b*'diff(x,t) = F",
    "(J+l^2*m)*'diff(theta,t,2) + l*m*cos(theta)*'diff(x,t,2) - g*l*m*sin(theta) = 0",
)
IN_MAPLE = [
    x.replace("'", "").replace("x,t,2", "x(t), t$2").replace("theta,t,2", "theta(t), t$2").replace(",t)", "(t), t)")
    for x in ROWS
]


@pytest.mark.parametrize(
    "session",
    [
        f"[%i4] eqs;\n[%o4] [{ROWS[0]}, {ROWS[1]}]",
        f"> eqs := {{eq1, eq2}};\n\neqs := {{{IN_MAPLE[0]},\n  {IN_MAPLE[1]}}}",
        f"Answer: [{ROWS[0]},\n  {ROWS[1]}]".replace("'diff", "diff"),
    ],
)
def test_lists_of_equations_may_have_labels_names_and_several_lines(session: str) -> None:
    twins(session, "cart-pole")


def test_what_is_called_like_a_momentum_and_balances_forces_is_a_left_hand_side() -> None:
    kinetic = "(M + m)*x.diff(t)**2/2 + m*l*cos(theta)*x.diff(t)*theta.diff(t) + (J + m*l**2)*theta.diff(t)**2/2"
    session = f">>> T = {kinetic}\n>>> V = m*g*l*cos(theta)\n>>> L = T - V\n"
    session += ">>> p1 = L.diff(x.diff(t)).diff(t) - L.diff(x) - F + b*x.diff(t)\n"
    session += ">>> p2 = L.diff(theta.diff(t)).diff(t) - L.diff(theta)\n"
    session += f">>> print(expand(p1), '= 0')\n{X} = 0\n>>> print(expand(p2), '= 0')\n{ANGLE} = 0"
    twins(session, "cart-pole")
    momentum = "p1 = (M + m)*x' + m*l*cos(theta)*theta'"
    twins(f"{momentum}\n{X} = 0\n{ANGLE} = 0", "cart-pole", momentum, momentum.replace("cos", "sin"))


def test_what_is_derived_by_a_rate_that_a_program_spells_and_expanded_is_judged() -> None:
    kinetic = "1/2*(M+m)*diff(x,t)^2 + m*l*cos(theta)*diff(x,t)*diff(theta,t) + 1/2*(J+m*l^2)*diff(theta,t)^2"
    session = f"(%i2) T: {kinetic}$\n(%i3) V: m*g*l*cos(theta)$\n(%i4) L: T-V$\n"
    session += "(%i5) expand(diff(diff(L,diff(x,t)),t)-diff(L,x)) = F-b*diff(x,t);\n"
    session += "(%i6) simplify(diff(diff(L,diff(theta,t)),t)-diff(L,theta)) = 0;"
    twins(session, "cart-pole", "F-b*", "F+b*")
    twins(session, "cart-pole", "$\n(%i3)", "*2$\n(%i3)")
    lines = derivation("cart-pole").check(session).findings
    assert [x.line.kind for x in lines] == ["T", "V", "L", "equation", "equation"]


@pytest.mark.parametrize("gap", ["\n", "\n \n"])
def test_a_function_of_time_that_matlab_shows_calls_an_equation(gap: str) -> None:
    shown = PENDULUM.replace("Derivative(theta(t), (t, 2))", "diff(theta(t), t, t)").replace("Derivative", "diff")
    shown = shown.replace("**", "^")
    session = f">> eq1 = simplify(diff(diff(L,dth),t) - diff(L,theta)) == -b*dth\n\neq1(t) ={gap}{shown} == 0"
    verdict = derivation("pendulum").check(session)
    assert verdict.right and "eq1" not in verdict.to_text() and "not read" not in verdict.to_text()
    assert not right(session.replace("+ L*g", "- L*g"), "pendulum")
