"""Answers copied from programs, web pages and documents, in other languages, with labels and with drawn matrices.

Oracle: the equations of the pendulum and of the cart with a pole, in the grammar of model files.
"""

import pytest

from built_in import derivation
from lagrangian import ParseError, loads
from lagrangian.check.reading import parse_answer

PLAIN = "m L² θ'' + b θ' + m g L sin θ = 0"
MIXED, PUSH, WEIGHT = "m*l*cos(theta)", "F - b*x' + m*l*theta'^2*sin(theta)", "m*g*l*sin(theta)"
TURNTABLE = """
name = "turntable"
[coordinates]
x = ""
y = ""
[parameters]
m = 1
W = 2
k = 30
[points]
P = ["x*cos(W*t) - y*sin(W*t)", "x*sin(W*t) + y*cos(W*t)"]
[[particle]]
mass = "m"
at = "P"
[[spring]]
k = "k"
deflection = "x"
"""


def right(system: str, written: str) -> None:
    verdict = derivation(system).check(written)
    assert verdict.right, verdict.to_text()


@pytest.mark.parametrize(
    "written",
    [
        "m*L**2*theta_ddot + b*theta_dot + m*g*L*np.sin(theta) = 0",
        "m*L**2*thetadd = -b*thetad - m*g*L*math.sin(theta)",
        "m*np.square(L)*theta.diff(t, 2) + b*theta.diff(t) + m*g*L*sp.sin(theta) = 0",
        "m*pow(L, 2)*theta(t).diff(t).diff(t) + b*theta(t).diff(t) + m*g*L*sp.sin(theta(t)) = 0",
        "m*L^2*diff(theta(t), t$2) + b*diff(theta(t), t) + m*g*L*sin(theta(t)) = 0;",
        "m*L^2*(D@@2)(theta)(t) + b*D(theta)(t) + m*g*L*sin(theta(t)) = 0",
        "m*L^2*D2theta + b*Dtheta + m*g*L*sin(theta) = 0",
        "dT/dDtheta = m*L^2*Dtheta\nm*L^2*DDtheta + b*Dtheta + m*g*L*sin(theta) = 0",
        "m L^2 Derivative[2][θ][t] + b Derivative[1][θ][t] + m g L Sin[θ[t]] == 0",
        r"m L^2 \[Theta]''[t] + b \[Theta]'[t] + m g L Sin[\[Theta][t]] == 0",
        "m*L^2*der(der(theta)) + b*der(theta) + m*g*L*sin(theta) = 0",
        "m*L^2*theta'' + b*theta' + m*g*L*sin(theta) ~ 0",
        "$ m L^2 dot.double(theta) + b dot(theta) + m g L sin(theta) = 0 $",
        "The equation is $ frac(2, 2) m L^2 dot.double(theta) + b dot(theta) = - m g L sin theta $.",
        "theta = dynamicsymbols('theta')\neq1 := m*L**2*theta.diff().diff(t) + b*theta.diff(t) + m*g*L*sin(theta) = 0",
        "$ T = 1/2 m L^2 dot(theta)^2 $\n"
        "$ dif/(dif t) (partial T)/(partial dot(theta)) + b dot(theta) + m g L sin theta = 0 $",
    ],
)
def test_the_spellings_of_programs(written: str) -> None:
    right("pendulum", written)


@pytest.mark.parametrize(
    "written",
    [
        "m L^2 ddot θ + b dot θ + m g L sinθ = 0",
        "m L^2 ddot theta + b dot theta + m g L sin theta = 0",
        "m L² θ¨ + b θ˙ = −m g L sin θ\nT = ½ m L² θ˙²",
        "<p>m L<sup>2</sup> &theta;&#776; + b&middot;&theta;&#775; + <i>m g L</i> sin&nbsp;&theta; = 0</p>",
        "<div>T = &frac12; m L<sup>2</sup>&theta;&#775;<sup>2</sup><br/>m L² θ'' + b θ' + m g L sin(&theta;) = 0</div>",
        "m\u202fL²\u2009θ'' + b\u3000θ' + m g L sin\u00a0θ = 0",
        "𝑚𝐿²𝜃'' + 𝑏𝜃' + ｍ＊ｇ＊Ｌ＊ｓｉｎ（θ） ＝ ０",
        "m L² ¨θ + b˙θ = −m g L sin θ",
        "(m L²) θ'' + b θ' + (m g L) senθ = 0",
        r"m L^2 \ddot\theta + b \dot theta + m*g*L*sin(theta) = 0",
        r"ad a) mL^2\ddot\theta + b\dot\theta + mgL\sin\theta = 0.",
        r"(ii) \Rightarrow mL^2\ddot\theta + b\dot\theta + mgL\sen\theta = 0",
        "m L² θ'' + b θ' + m g L sen θ = 0",
        "m L² θ'' + b θ' + mgL senθ = 0",
        "mL²θ'' + bθ' + mgLsenθ = 0",
        "m L² θ'' + b θ' + m g L tg θ cosθ = 0",
        "m*L²*θ'' + b*θ' + m*g*L*Sen(θ) = 0",
    ],
)
def test_dots_and_functions_as_they_are_copied(written: str) -> None:
    right("pendulum", written)


@pytest.mark.parametrize(
    "before",
    [
        *("ad a) ", "ad b) ", "zu 1) ", "zu (1): ", "zu 1: ", "to (ii) ", "Eq. 3: ", "Teil a) ", "θ: ", "a) θ: "),
        *("Exercise 3 c)   ", "Problem 2. b) ", "Aufgabe 4 a) ", "Task 3) "),
        *("θ) ", "b) ", "(i)  ⇒  ", "(ii)  ⇒  ", "(iii) => ", "(1) ⇒ from (2): ", "(i) ⇒ eq θ: "),
    ],
)
@pytest.mark.parametrize("behind", ["", "."])
def test_labels_in_front(before: str, behind: str) -> None:
    right("pendulum", f"{before}{PLAIN}{behind}")


def test_words_that_explain_a_definition() -> None:
    right("pendulum", f"φ = θ : angle from the vertical\n{PLAIN.replace('θ', 'φ')}")


def test_a_vector_of_kinematics_is_left_out_and_said_and_an_equation_is_not() -> None:
    verdict = derivation("pendulum").check(f"a = (L θ'') e_t - (L θ'^2) e_n\n{PLAIN}")
    assert verdict.right
    assert "Line 1" in str(verdict.notes[0]) and "not read" in str(verdict.notes[0])
    with pytest.raises(ParseError):
        derivation("pendulum").check(f"{PLAIN}\nF = (m L θ'') e_t")


@pytest.mark.parametrize(
    "written",
    [
        "(M + m) x'' + m l theta'' cos theta\n    + b x' - m l theta'^2 sin theta = F\n"
        "(J + m l^2) theta''\n    + m l x'' cos theta - m g l sin theta = 0",
        "(M + m) x'' + m l theta'' cos theta\n- m l theta'^2 sin theta + b x' = F\n"
        "(J + m l^2) theta'' + m l x'' cos theta\n- m g l sin theta = 0",
        f"[ M+m      m l cosθ ] [ẍ]   [ {PUSH}  ]\n[ m l cosθ  J+m l²  ] [θ̈] = [ {WEIGHT}   ]",
        f"⎡ M+m       m l cosθ ⎤ ⎡ẍ⎤   ⎡{PUSH}⎤\n⎣ m l cosθ  J+m l²   ⎦ ⎣θ̈⎦ = ⎣{WEIGHT}  ⎦",
        f"[M+m {MIXED}; {MIXED} J+m*l^2]*[x''; theta''] = [{PUSH}; {WEIGHT}]",
        f"[M+m  {MIXED}\n {MIXED} J+m*l^2]*[x''\n theta''] = [{PUSH}\n {WEIGHT}]",
        f"A = [M+m {MIXED}; {MIXED} J+m*l^2];\nA*[x''; theta''] = [{PUSH}; {WEIGHT}]",
        f"Matrix([[M+m, {MIXED}], [{MIXED}, J+m*l**2]]) @ np.array([x'', theta'']) = np.array([{PUSH}, {WEIGHT}])",
        r"\begin{bmatrix} M+m & ml\cos\theta \\ ml\cos\theta & J+ml^2 \end{bmatrix}"
        "\n"
        r"\begin{bmatrix} \ddot x \\ \ddot\theta \end{bmatrix}"
        "\n=\n"
        r"\begin{bmatrix} F - b\dot x + ml\dot\theta^2\sin\theta \\ mgl\sin\theta \end{bmatrix}",
    ],
)
def test_broken_lines_and_drawn_matrices(written: str) -> None:
    right("cart-pole", written)


def test_blanks_in_brackets_remain_products_where_the_shape_wants_them() -> None:
    answer = parse_answer("[x''; theta''] = [m g; b x']", derivation("cart-pole").model)
    assert [str(line.rhs) for line in answer.lines] == ["g*m", "b*Derivative(x(t), t)"]


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "written",
    [
        "ad a) m L² θ'' + b θ' + m g L sin θ = m",
        "m L² θ'' + b θ' + m g L tg θ = 0",
        "<p><sup>1</sup>/<sub>2</sub> m L² θ'' + b θ' + m g L sin θ = 0</p>",
        "m*L^2*D2theta + b*D2theta + m*g*L*sin(theta) = 0",
        "dT/dDtheta = m*L*Dtheta\nm*L^2*DDtheta + b*Dtheta + m*g*L*sin(theta) = 0",
        "m L^2 ddot θ + b ddot θ + m g L sinθ = 0",
        "m L² ¨θ + b ¨θ + m g L sin θ = 0",
        "m L² θ''\n + b θ' = 0\nm L²\n + m g L sin θ = 0",
    ],
)
def test_what_is_wrong_stays_wrong(written: str) -> None:
    assert not derivation("pendulum").check(written, hint=0).right


def test_raised_and_lowered_numbers_of_a_page_are_a_fraction() -> None:
    half = "<sup>1</sup>/<sub>2</sub>", "<sup><i>m</i></sup>&frasl;<sub>2</sub> <i>m</i><sup>-1</sup>"
    for x in half:
        written = f"<li>Pendulum: {x} <i>m</i> <i>L</i><sup>2</sup> θ̈ + {x} (b θ̇ + m g L sin θ) = 0</li>"
        assert derivation("pendulum").check(written, hint=0).right


def test_a_name_that_nothing_explains_is_asked_about() -> None:
    with pytest.raises(ParseError, match="what is 'L_2'") as caught:
        derivation("pendulum").check("<p>m L<sub>2</sub> θ'' + b θ' + m g L sin θ = 0</p>")
    assert caught.value.place is not None and caught.value.place.column == 6


def test_errors_point_into_what_was_written() -> None:
    written = "<p>&theta;&#776; = 0</p>\n<p>m L<sup>2</sup> &theta;'' + nonsense(x = 0</p>"
    with pytest.raises(ParseError) as caught:
        parse_answer(written, derivation("pendulum").model)
    place = caught.value.place
    assert place is not None and (place.line, place.text) == (2, written.split("\n")[1])
    assert place.column == written.split("\n")[1].index("(x") + 1


CART = r"""(a dot is written as _t, and w = theta_t)
M_t = M + m
M_t x_tt + m l cos(theta) w_t - m l sin(theta) w^2 + b x_t = F
(J + m l^2) w_t + m l cos(theta) x_tt - m g l sin(theta) = 0"""
LATEX = r"""\[(M+m)x_{tt} + m l\cos\theta\,\theta_{tt} - m l\sin\theta\,\theta_t^2 + b x_t = F\]
\[(J+m l^2)\theta_{tt} + m l\cos\theta\, x_{tt} - m g l\sin\theta = 0\]"""
REFERENCES = """[1] T_1 = 1/2*M*x'^2
[2] T_2 = 1/2*m*(x'^2 + 2*l*cos(theta)*x'*theta' + l^2*theta'^2) + 1/2*J*theta'^2
[3] V = m*g*l*cos(theta)
[4] L = [1] + [2] - [3]
[5] (M + m)*x'' + m*l*cos(theta)*theta'' - m*l*sin(theta)*theta'^2 = F - b*x'
[6] (J + m*l^2)*theta'' + m*l*cos(theta)*x'' - m*g*l*sin(theta) = 0"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("written", "old", "new"),
    [
        (CART, "b x_t", "b x_tt"),
        (LATEX, r"\theta_t^2", r"\theta_{tt}^2"),
        (REFERENCES, "1/2*M", "M"),
        (REFERENCES, "+ [2] - [3]", "+ [2] + [3]"),
    ],
    ids=["index", "index in LaTeX", "reference", "signs"],
)
def test_rates_with_an_index_and_references_to_lines(written: str, old: str, new: str) -> None:
    assert old in written
    verdict = derivation("cart-pole").check(written)
    assert verdict.right, verdict.to_text()
    assert not derivation("cart-pole").check(written.replace(old, new), hint=0).right


@pytest.mark.slow
def test_a_turntable_that_turns_the_other_way_is_a_mistake_and_no_other_coordinate() -> None:
    turntable = loads(TURNTABLE).derive()
    rows = "m*(x'' - 2*W*y' - W^2*x) + k*x = 0\nm*(y'' + 2*W*x' - W^2*y) = 0"
    assert turntable.check(rows, hint=0).right
    verdict = turntable.check("m*(x'' + 2*W*y' - W^2*x) + k*x = 0\nm*(y'' - 2*W*x' - W^2*y) = 0")
    assert not verdict.right
    assert verdict.mistake is not None and verdict.mistake.name == "prescribed_sign"
