"""What answers say beside their equations: units, labels, remarks in brackets, comments, names for coordinates.

Oracle: the equation of the pendulum, m L² θ̈ + b θ̇ + m g L sin θ = 0, and those of the cart with a pole, in the grammar
of model files. Every form has a wrong twin, which stays wrong.
"""

import pytest

from built_in import derivation
from lagrangian import ParseError
from student_answers import CART, POLE

BARE = r"m L^2\ddot\theta + b\dot\theta + m g L\sin\theta"


def right(written: str, name: str = "cart-pole") -> bool:
    """Whether an answer is judged right; one with a name that nothing explains is asked about, and is not."""
    try:
        return derivation(name).check(written, hint=0).right
    except ParseError as error:
        if "what is '" not in str(error):
            raise
        return False


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("unit", "factor"), [("   [N m]", " [m]"), (" [N m].", " (N m)"), ("\t[kg m²/s²]", " [m l]"), ("   [m]", " [g]")]
)
def test_a_unit_behind_a_statement_is_none_of_its_factors(unit: str, factor: str) -> None:
    first = f"H = m l cos theta{unit}\n(M + m) x'' + H theta'' - m l theta'^2 sin theta + b x' = F"
    assert right(f"{first}\n{POLE}")
    assert not right(f"{first.replace(unit, factor)}\n{POLE}")
    assert not right(f"{first.replace('cos', 'sin')}\n{POLE}")


def test_a_unit_in_a_sentence_is_no_factor() -> None:
    where = "where H = m l cos theta [kg m] is the coupling and R = m g l sin theta [N m]."
    for sign, is_right in (("-", True), ("+", False)):
        rows = f"(M + m) x'' + H theta'' - m l theta'^2 sin theta + b x' = F\n(J + m l^2) theta'' + H x'' {sign} R = 0"
        assert right(f"{rows}\n{where}") == is_right


def test_letters_in_brackets_that_the_answer_has_nowhere_else_are_labels() -> None:
    assert right(f"(A) {CART}\n(B) {POLE}")
    assert not right(f"(A) {CART}\n(B) {POLE.replace('- m g', '+ m g')}")
    assert not right(f"(A) {CART}\n(A) {POLE}")  # a factor of both is none of the letters
    assert not right(f"(l) {CART.replace('b x', 'l b x')}\n(B) {POLE}")


@pytest.mark.parametrize(
    "remark",
    [
        "(about the pivot, the same as m*l^2/3 + m*(l/2)^2)",
        "(uniform rod about its end: m l^2/3)",
        "(SymPy, .expand())",
        "(inertia of the pole about the joint, J + m l^2)",
    ],
)
def test_a_sentence_in_brackets_is_a_remark_even_with_mathematics(remark: str) -> None:
    for inertia, is_right in (("J + m*l^2", True), ("J + m*l^2/3", False)):
        written = f"with A = {inertia}  {remark}:\n{CART}\nA theta'' + m l x'' cos theta - m g l sin theta = 0"
        verdict = derivation("cart-pole").check(written)
        assert verdict.right == is_right
        assert any("is a remark" in str(note) for note in verdict.notes)


def test_a_factor_in_words_is_no_remark() -> None:
    assert right(f"{CART}\n(J + m l^2) theta'' = m l (g sin theta - x'' cos theta)")
    with pytest.raises(ParseError):
        right(f"{CART}\n(J + m l^2) theta'' = m l (twice g sin theta - x'' cos theta)")


@pytest.mark.sampled(3)
@pytest.mark.parametrize("mark", ["%", "#", "//"])
def test_comments_that_name_coordinates_are_read(mark: str) -> None:
    for first, second, is_right in (("x", "theta", True), ("theta", "x", False)):
        rows = "(M + m)*q1dd + m*l*q2dd*cos(q2) - m*l*q2d^2*sin(q2) + b*q1d == F\n"
        rows += "(J + m*l^2)*q2dd + m*l*q1dd*cos(q2) - m*g*l*sin(q2) == 0"
        assert right(f"{mark} q1 = {first}, q2 = {second}\n{rows}") == is_right
    assert right(f"{mark} m = l, M = b\n{CART}\n{POLE}")  # a comment about constants stays one


def test_brackets_say_which_letter_of_the_system_another_one_is() -> None:
    cart = "(M + m) x'' + m h theta'' cos(theta) - m h theta'^2 sin(theta) + b x' = F     (h is l)"
    pole = "(J + m h^2) theta'' + m h x'' cos(theta) - m g h sin(theta) = 0"
    assert right(f"{cart}\n{pole}")
    assert not right(f"{cart}\n{pole.replace('- m g', '+ m g')}")
    assert not right(f"{cart.replace('is l', 'is b')}\n{pole}")


@pytest.mark.slow
def test_a_sentence_says_what_a_letter_stands_for() -> None:
    cart = r"$$(M+m)\ddot x+ml\ddot\psi\cos\psi-ml\dot\psi^2\sin\psi+b\dot x=F$$"
    pole = r"$$(J+ml^2)\ddot\psi+ml\ddot x\cos\psi-mgl\sin\psi=0$$"
    assert right(rf"$\psi$ stands for theta here. {cart} {pole}")
    assert not right(rf"$\psi$ stands for theta here. {cart} {pole.replace('-mgl', '+mgl')}")
    assert not right(rf"$\psi$ stands for x here. {cart} {pole}")


def test_names_are_given_values_in_one_sentence_after_the_other() -> None:
    said = "I measure the pole's angle as psi = theta and abbreviate A = J + m l^2. H = m l (a moment of the pole)."
    rows = "(M + m) x'' + H psi'' cos psi - H psi'^2 sin psi + b x' = F\nA psi'' + H x'' cos psi - H g sin psi = 0"
    assert right(f"{said}\n{rows}")
    assert not right(f"{said.replace('H = m l', 'H = m')}\n{rows}")
    assert not right(f"{said}\n{rows.replace('- H g', '+ H g')}")


def test_a_list_in_braces_may_go_on_in_the_next_line() -> None:
    program = (
        "Mathematica:\n{(M + m) x''[t] + m l Cos[theta[t]] theta''[t] - m l Sin[theta[t]] theta'[t]^2 + b x'[t] == F,\n"
    )
    program += " (J + m l^2) theta''[t] + m l Cos[theta[t]] x''[t] - m g l Sin[theta[t]] == 0}"
    assert right(program)
    assert not right(program.replace("- m g l", "+ m g l"))


def test_twice_differentiated_multiplies_nothing() -> None:
    said = "with s = l sin theta, twice differentiated s'' = l cos theta theta'' - l sin theta theta'^2"
    rows = f"(M + m) x'' + m s'' + b x' = F\n{POLE}"
    assert right(f"{rows}\n{said}")
    assert not right(f"{rows}\n{said.replace('- l', '+ l')}")


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["y", "z", "q"])
def test_rates_in_letters_of_a_column_that_the_answer_names(name: str) -> None:
    matrices = "A = [M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2],  {0} = [x; theta]\n"
    matrices += "h = [b*x' - m*l*theta'^2*sin(theta) - F; -m*g*l*sin(theta)]"
    assert right(f"A*{name}dd + h = [0; 0]\n{matrices.format(name)}")
    assert not right(f"A*{name}dd - h = [0; 0]\n{matrices.format(name)}")


def test_a_delta_that_the_answer_defines_is_no_variation() -> None:
    said = r"$\delta=g/L$: \[ m L^2\left(\ddot\theta + \delta(\sin\theta)\right) + b\dot\theta = 0 \]"
    assert right(said, "pendulum")
    assert not right(said.replace("g/L", "gL"), "pendulum")
    assert not right(rf"\[ ({BARE})\delta(\theta) = 0,\quad T = m L^2\dot\theta^2 \]", "pendulum")


SMALL = "(M + m) x'' + m l theta'' + b x' = F\n(J + m l^2) theta'' + m l x'' - m g l theta = 0"


@pytest.mark.sampled(4)
@pytest.mark.parametrize("beside", [f"For small angles:\n{SMALL}", "theta = 0", "Equilibria: sin theta = 0 or x = 0"])
def test_single_positions_and_small_motions_beside_the_equations_are_not_judged(beside: str) -> None:
    verdict = derivation("cart-pole").check(f"{CART}\n{POLE}\n{beside}")
    assert verdict.right and any("was not judged: it is about" in str(note) for note in verdict.notes)
    assert not right(f"{CART}\n{POLE.replace('- m g', '+ m g')}\n{beside}")


@pytest.mark.sampled(2)
@pytest.mark.parametrize("untrue", ["cos theta = 7", "sin theta = theta/2"])
def test_a_line_that_no_position_makes_true_is_untrue(untrue: str) -> None:
    verdict = derivation("cart-pole").check(f"{CART}\n{POLE}\n{untrue}")
    assert not verdict.right and any("is not true" in str(note) for note in verdict.notes)
    assert right(f"{CART}\n{POLE}\nsin theta = theta, cos theta = 1 - theta^2/2")


@pytest.mark.slow
def test_a_position_at_rest_must_be_one() -> None:
    row = "m R^2 theta'' - m R^2 Omega^2 sin theta cos theta + m g R sin theta = 0"
    assert right(f"{row}\ntheta = 0 or cos theta = g/(R Omega^2)", "bead-on-hoop")
    assert not right(f"{row}\ncos theta = g/(R Omega)", "bead-on-hoop")


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "line",
    [
        "theta'' = (m g l sin(theta) - ...)/(J + m l^2), in full:",
        "used sin(2 theta) = 2 sin cos",
        "(d = d/dt, dd = second derivative)",
        "(J about the centre of mass, so J + m l^2 about the pivot)",
        "Momentum p_x = dL/dx' = ...",
        "Half length h = L_p/2, H = M + m. I moved x to the left:",
        "(I wrote theta for the angle of the sheet)",
        "× 2, h := l because I had this letter in my sketch",
        "virtual work: delta W = F delta x - b x' delta x",
    ],
)
def test_a_line_of_words_is_not_needed_beside_complete_equations(line: str) -> None:
    assert right(f"{line}\n{CART}\n{POLE}")
    assert not right(f"{line}\n{CART}\n{POLE.replace('- m g', '+ m g')}")


def test_a_name_that_only_words_explain_is_unknown() -> None:
    with pytest.raises(ParseError):  # what may say what m is must be read
        right(f"m = pole ((half\n{CART}\n{POLE}")
    with pytest.raises(ParseError, match="what is 'S'"):
        derivation("cart-pole").check(f"S x'' + {CART.split(' + ', 2)[2]}\n{POLE}\nS = the ((sum of masses")


@pytest.mark.slow
def test_letters_of_energies_and_rates_of_columns_are_the_answers_own() -> None:
    cart = "q1'' = (F - b q1' - m l D q2'' + m l sin(q2) q2'^2)/(M + m)"
    assert right(f"D = cos(q2)\n{cart}\nq2'' = m l (g sin(q2) - D q1'')/(J + m l^2)")
    assert not right(f"D = sin(q2)\n{cart}\nq2'' = m l (g sin(q2) - D q1'')/(J + m l^2)")
    matrices = "A = [M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2]\nB = [b, -m*l*sin(theta)*theta'; 0, 0]\n"
    matrices += "f = [F; m*g*l*sin(theta)]\n"
    assert right(f"{matrices}A*qdd + B*qd = f")
    assert not right(f"{matrices}A*qdd + B*q = f")
    assert right("(ad = d alpha/dt, add = d²alpha/dt²)\nm L^2 add + b ad + m g L sin alpha = 0", "pendulum")


def test_small_motions_are_wrong_alone_and_where_they_do_not_follow() -> None:
    assert not right(SMALL)
    assert not right(f"{CART}\n{POLE}\n{SMALL.replace('- m g', '+ m g')}")
    assert not right(f"{CART}\n{POLE}\ntheta = x")


HALVES = (
    "S x'' + {coupling} theta'' - m l theta'^2 sin theta + b x' = F\n{coupling} x'' + J_p theta'' - m g l sin theta = 0"
)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "written",
    [
        "S = M + m, a_12 = a_21 = {H}, J_p = J + m l^2\n" + HALVES.format(coupling="a_21"),
        "M + m =: S\n{H} =: H\nJ + m l^2 =: J_p\n" + HALVES.format(coupling="H"),
        "F_h = S x'' + {H} theta'' - m l theta'^2 sin theta = F - b x'\nS = M + m\n" + POLE,
        CART.replace("m l cos", "H").replace("m l theta'' cos theta", "{H} theta''") + "    (I)\n" + POLE + "   (II)",
        "Eq. 1 (cart): " + CART.replace("m l theta'' cos theta", "{H} theta''") + "\nEq. 2 (pole): " + POLE,
        "(using 2 cos² = 1 + cos 2θ)\n" + CART.replace("m l theta'' cos theta", "{H} theta''") + "\n" + POLE,
        "I use u for x' and q for theta.\n(M + m) u' + m l q'' cos q - m l q'^2 sin q + b u = F\n"
        "(J + m l^2) q'' + {H} u' - m g l sin q = 0",
        "eq1 = (M + m)*x'' + {H}*theta'' ...\n    - m*l*theta'^2*sin(theta) ...\n    + b*x' - F;\neq2 = "
        + POLE.removesuffix(" = 0"),
        "Q1 = F - b x' + m l theta'^2 sin theta\n(M + m) x'' + {H} theta'' = Q1\n" + POLE,
        "r = (x + l sin θ, l cos θ)\nv = (x' + l θ' cos θ, -l θ' sin θ)\nv^2 = x'^2 + 2 {H}/m x' θ' + l^2 θ'^2\n"
        "T = M/2 x'^2 + J/2 θ'^2 + m/2 v^2\n" + CART + "\n" + POLE,
    ],
)
def test_names_numbers_and_remarks_as_students_place_them(written: str) -> None:
    assert right(written.replace("{H}", "m l cos theta"))
    assert not right(written.replace("{H}", "m l sin theta"))


def test_a_bracket_that_begins_with_a_product_is_no_remark_though_it_spells_a_word() -> None:
    rows = "m x'' + b x' + F sin(theta) = 0\nm y'' + (by' + m g) = F cos(theta)\nJ theta'' = L (F1 - F2)\nF = F1 + F2"
    assert right(rows, "planar-quadrotor")
    assert not right(rows.replace("(by'", "(2 by'"), "planar-quadrotor")


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "letters",
    [
        "Solution (my own letters: A = J + m l² for pole + tip, s = M + m)",
        "With A = J + m l² for pole & tip and s = M + m:",
        "A = J + m l² (pole + tip), s = M + m",
    ],
)
def test_words_may_be_joined_by_signs(letters: str) -> None:
    rows = f"\n{CART.replace('(M + m)', 's')}\n{POLE.replace('(J + m l^2)', 'A')}"
    assert right(letters + rows) and not right(letters.replace("m l²", "m l") + rows)


def test_letters_with_small_digits_in_brackets_are_no_words() -> None:
    energy = "T = m l ẋ θ' cos θ + ½ (J + m l²) θ'² + ½ (Mẋ² + mẋ²)"
    assert right(f"{energy}\n{CART}\n{POLE}") and not right(f"{energy.replace('mẋ²', 'lẋ²')}\n{CART}\n{POLE}")


def test_bold_lines_may_hold_stars_and_lines_that_are_set_in_go_on_with_a_plus() -> None:
    bold = f"**{CART.replace('m l theta', 'm*l*theta')}**\n**{POLE.replace('m g l', 'm*g*l')}**"
    assert right(bold) and not right(bold.replace("m*g*l", "2*m*g*l"))
    broken = "0 = " + CART.replace(" + m l theta''", "\n    + m l theta''", 1).replace("= F", "- F = 0") + "\n" + POLE
    assert right(broken) and not right(broken.replace("+ m l theta''", "+ 2 m l theta''"))


@pytest.mark.slow
def test_a_tangent_with_two_values_says_that_these_are_equal() -> None:
    rows = "α: slope of the path\ntan α = {} = -x/y\nm x'' = -N x/l\nm y'' = -N y/l - m g\nx^2 + y^2 = l^2"
    assert right(rows.format("dy/dx"), "rod-pendulum") and not right(rows.format("-dx/dy"), "rod-pendulum")


def test_equations_in_latex_beside_delimited_mathematics_are_read() -> None:
    rows = (
        r"\begin{bmatrix} M+m & m l c\\ m l c & J+m l^2\end{bmatrix}\begin{bmatrix}\ddot x\\ \ddot\theta\end{bmatrix}"
        r"=\begin{bmatrix}F-b\dot x+m l s\dot\theta^2\\ m g l s\end{bmatrix}"
    )
    assert right(rf"{rows}\n with $s=\sin\theta$, $c=\cos\theta$".replace(r"\n", "\n"))
    assert not right(rf"{rows}\n with $s=\cos\theta$, $c=\cos\theta$".replace(r"\n", "\n"))


def test_a_word_between_with_and_an_article_is_no_name() -> None:
    """… with F and therefore the pole with -F: nothing is stated there."""
    said = "The motor pushes the cart with F and therefore the pole with -F."
    verdict = derivation("cart-pole").check(f"{said}\n{CART}\n{POLE}")
    assert verdict.right and not any("therefore" in str(note) for note in verdict.notes)


def test_labels_behind_commas_are_left_out() -> None:
    said = "Velocity of A: v = x', velocity of B: u = x' + l theta' cos(theta), in y: w = {}l theta' sin(theta)"
    energy = "T = 1/2 M v^2 + 1/2 m (u^2 + w^2) + 1/2 J theta'^2"
    assert right(f"{said.format('')}\n{energy}\n{CART}\n{POLE}")
    assert not right(f"{said.format('2 ')}\n{energy}\n{CART}\n{POLE}")


def test_a_common_word_between_a_formula_and_words_is_no_product() -> None:
    said = "I use the distance s = 2*x as second coordinate instead of x, so x = s/2, x' = s'/2, x'' = s''/2."
    rows = f"{CART}\n{POLE}".replace("x''", "s''/2").replace("x'", "s'/2").replace("m l x", "m l x")
    assert right(f"{said}\n{rows}")
    assert not right(f"{said}\n{rows.replace('b s', 'b 2 s')}")
    assert not right(f"{said.replace('s = 2*x', 's = 3*x')}\n{rows}")


def test_a_name_gets_a_value_behind_a_sentence() -> None:
    said = "Newton for the cart, the pole about the joint. s = sin(theta), c = cos(theta)."
    rows = f"{CART}\n{POLE}".replace("cos theta", "c").replace("sin theta", "s")
    assert right(f"{said}\n{rows}")
    assert not right(f"{said.replace('sin', 'tan')}\n{rows}")


def test_a_product_that_an_answer_spells_out_stays_one() -> None:
    rows = f"{CART}\n(J + ml²) theta'' + ml x'' cos theta - mgl sin theta = 0"
    assert right(f"{rows}\nml means m times l, mgl = m·g·l, and so on.")
    assert not right(f"{rows.replace('- mgl', '+ mgl')}\nml means m times l, mgl = m·g·l, and so on.")
    assert not right(f"{rows}\nmgl = m·g")


def test_a_name_of_the_system_in_a_list_of_other_names_says_nothing() -> None:
    rows = f"{CART}\n{POLE}".replace("J", "Jp").replace("m g l", "m*g*l").replace("M + m", "Mc + m")
    assert right(f"m, Jp = J, Mc = M\n{rows}")
    assert right(f"m, Jp = J, Mc = M  (I wrote Jp and Mc on my paper)\n{rows}")
    assert not right(f"m, Jp = 2*J, Mc = M\n{rows}")
    assert not right(f"m, Jp = M, Mc = J\n{rows}")
