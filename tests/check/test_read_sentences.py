"""Statements are found in any sentence, and names have the value that any sentence gives them.

Oracle: the equations of the cart with a pole and of other examples, in the grammar of model files. Every answer has a
wrong twin, in which what the sentence says is another thing, and which is not accepted.
"""

from __future__ import annotations

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation
from lagrangian import ParseError, System
from student_answers import CART, POLE, right


def twins(written: str, old: str, new: str, name: str = "cart-pole") -> None:
    """An answer is right, and is not with something else in its place."""
    assert old in written and right(written, name), written
    assert not right(written.replace(old, new), name), written.replace(old, new)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("said", "old", "new"),
    [
        ("A stands for M+m, B for m*l and D for J + m*l^2.", "J + m*l^2", "J + m*l"),
        ("A is short for M+m; B is short for m*l; D denotes J + m*l^2.", "M+m", "M-m"),
        ("Denote M+m by A, m l by B and J + m l^2 by D.", "m l by", "m g by"),
        ("We write A, B and D for M+m, m l and J + m l^2.", "M+m, m l", "m l, M+m"),
        ("let A be the total mass, i.e. A = M + m. Also I define B := m l, and D := J + m l^2", "M + m", "M"),
        ("Let A be M + m, and let B be m l\nIn what follows D is J + m l^2.", "J +", "J -"),
    ],
)
def test_a_sentence_gives_names_their_values(said: str, old: str, new: str) -> None:
    rows = (
        "A x'' + B theta'' cos theta - B theta'^2 sin theta + b x' = F\nD theta'' + B x'' cos theta - B g sin theta = 0"
    )
    twins(f"{said}\n\n{rows}", old, new)
    twins(f"{rows}\n\n{said}", old, new)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("said", "old", "new"),
    [
        (
            "where $m_t$ is the total mass $M+m$ and $J_p$ the moment of inertia about the pivot, $J+ml^2$.",
            "$M+m",
            "$M-m",
        ),
        (r"We write $m_t$ and $J_p$ for $M+m$ and $J+ml^2$.", "J+ml", "J-ml"),
        (r"Here $J_p$ denotes $J+ml^2$, and $m_t = M+m$.", "J+ml^2", "J+ml"),
    ],
)
def test_a_sentence_of_latex_gives_names_their_values(said: str, old: str, new: str) -> None:
    rows = r"m_t\ddot x+ml\ddot\theta\cos\theta-ml\dot\theta^2\sin\theta+b\dot x&=F\\"
    rows += r"J_p\ddot\theta+ml\ddot x\cos\theta-mgl\sin\theta&=0"
    twins(f"\\begin{{align}}{rows}\\end{{align}}\n{said}", old, new)


def test_a_greek_letter_has_the_value_that_a_sentence_of_latex_gives_it() -> None:
    rows = r"$$mL^2\ddot\theta + b\dot\theta + m g L\kappa = 0$$"
    twins(f"{rows}\nI write $\\kappa$ for $\\sin\\theta$.", r"\sin", r"\cos", "pendulum")


def test_a_wrong_answer_is_judged_with_the_values_that_words_give() -> None:
    verdict = derivation("cart-pole").check(
        f"{CART}\nD theta'' + m l x'' cos theta + m g l sin theta = 0\nD is J + m l^2."
    )
    assert not verdict.right and "weight" in str(verdict.mistakes[0].what).lower(), verdict.to_text()


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "{} | Newton for the right-hand cart",
        "The sum of all gives [{}].",
        "coil and cone aside, we find that {} ... (1)",
        "double check: {}, which agrees with the book.",
        "Eliminating x would give {}, but I stop here.",
        "M x'' is clear, and the rest gives {} (as in the lecture)",
    ],
)
def test_an_equation_is_found_in_a_sentence(said: str) -> None:
    twins(f"{POLE}\n{said.format(CART)}", "+ b x'", "- b x'")


@pytest.mark.parametrize("row", [f"{CART} damping", f"{CART}, 5*b", f"{CART} - drag b x'"])
def test_what_may_belong_to_an_equation_is_not_left_out(row: str) -> None:
    assert not right(f"{row}\n{POLE}")


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "said",
    [
        "From d/dt(...) we see that x is cyclic if F = 0 and b = 0.",
        "Check: for theta = 0 the first gives (M + m) x'' + b x' = F.",
        "If J = 0, the second becomes l theta'' + x'' cos theta = g sin theta, as for a point mass.",
        "For θ̇ = 0 this is a cart that carries a load.",
        "Limits: l = 0 decouples both; m → 0, J → 0: the cart M alone. Fine.",
        "With m = 0, J = 0 only the cart is left.",
    ],
)
def test_what_holds_under_a_condition_is_not_judged(said: str) -> None:
    twins(f"{CART}\n{POLE}\n{said}", "+ b x' = F\n", "- b x' = F\n")
    assert not right(f"{CART}\n{said}")


@pytest.mark.slow
def test_a_line_with_a_name_that_nothing_needs_is_not_judged() -> None:
    rows = "(J/R^2 + m1 + m2) x'' = (m1 - m2) g"
    twins(f"The pulley turns with phi' = x'/R.\n{rows}", "m1 - m2", "m1 + m2", "atwood")
    assert not right(f"x = R phi\nx = R phi + 1\n{rows}", "atwood")
    assert right(f"x = R phi\nx' = R phi'\n{rows}", "atwood")
    assert not right("phi' = x'/R\n(J/R^2 + m1 + mu) x'' = (m1 - m2) g", "atwood")


@pytest.mark.slow
def test_functions_of_julia_and_declarations_of_c_are_read() -> None:
    julia = (
        "function f!(du, u, p, t)\n    x, xdot, th, thdot = u\n    M, m, l, J, b, g, F = p\n"
        "    D = (M+m)*(J+m*l^2) - (m*l*cos(th))^2\n    f1 = F - b*xdot + m*l*sin(th)*thdot^2\n"
        "    f2 = m*g*l*sin(th)\n    du[1] = xdot\n    du[2] = ((J+m*l^2)*f1 - m*l*cos(th)*f2)/D\n"
        "    du[3] = thdot\n    du[4] = ((M+m)*f2 - m*l*cos(th)*f1)/D\nend\n"
    )
    twins(julia, "F - b", "F + b")
    own = "/* right-hand\n sides */\ndouble H = J + m*l*l;  /* about the pivot */\n"
    rows = f"{CART}\nH theta'' + m l x'' cos theta - m g l sin theta = 0"
    twins(own + rows, "J + m*l*l", "J - m*l*l")


def test_matrices_that_are_drawn_with_a_name_on_their_middle_line() -> None:
    drawn = (
        "A q'' + D q' + K q = f,  q = (phi1, phi2)\n\n    ⎡ J1   0  ⎤       ⎡  b    -b        ⎤\n"
        "A = ⎢         ⎥ , D = ⎢                 ⎥\n    ⎣ 0    J2 ⎦       ⎣ -b   b + b_load ⎦\n\n"
        "K = [k, -k; -k, k], f = [tau; 0]"
    )
    twins(drawn, "b + b_load", "b - b_load", "two-disk-shaft")


def test_sessions_of_maxima_and_sets_of_maple_are_read() -> None:
    maxima = (
        "/* Maxima */\ndepends([phi1,phi2],t)$\n"
        "(%o1) J1*'diff(phi1,t,2)+b*('diff(phi1,t)-'diff(phi2,t))+k*(phi1-phi2)=tau\n"
        "(%o2) J2*'diff(phi2,t,2)-b*('diff(phi1,t)-'diff(phi2,t))-k*(phi1-phi2)+b_load*'diff(phi2,t)=0\n"
    )
    twins(maxima, "=tau", "=-tau", "two-disk-shaft")
    maple = (
        "sys := {m1*diff(x1(t),t,t) + m2*(diff(x1(t),t,t) + diff(x2(t),t,t)) = 0,\n"
        "        m2*(diff(x1(t),t,t) + diff(x2(t),t,t)) + k*x2(t) = F};\n"
    )
    twins(maple, "+ k*", "- k*", "two-carts")


@pytest.mark.parametrize(
    "unread",
    [
        "N = ReferenceFrame('N'); P = Point('P')",
        "T = kinetic § energy",
        "(see the figure) = 3 § 4",
    ],
)
def test_what_cannot_be_read_is_told_where_the_equations_do_without_it(unread: str) -> None:
    twins(f"{unread}\n{CART}\n{POLE}", "+ b x'", "- b x'")
    assert not right(f"{unread}\n{CART}")


def test_an_equation_that_cannot_be_read_is_never_passed_over() -> None:
    assert not right(f"{CART}\n{POLE}\nm x'' § = 3")
    with pytest.raises(ParseError, match="§"):
        derivation("cart-pole").check(f"J = § m l^2\n{CART}\n{POLE.replace('- m g', '+ m g')}")


@pytest.mark.parametrize(
    "words",
    [
        "But F must be replaced by 2 F everywhere.",
        "where k is half of the spring constant",
        "plus the weight m1 g",
        "(with k replaced by k/2)",
        "The right-hand side counts times two.",
    ],
)
def test_words_that_may_change_an_equation_are_told(words: str) -> None:
    right = "m1*x1'' + k*(x1 - x2) = -F\nm2*x2'' - k*(x1 - x2) = F\n"
    notes = derivation("lecture-3a").check(right + words).notes
    assert any("Words on line 3 may change an equation" in str(note) for note in notes)
    notes = derivation("lecture-3a").check(right + "These are the equations, differentiated twice.").notes
    assert not any("may change" in str(note) for note in notes)


def test_a_term_behind_dots_and_a_word_is_not_left_out() -> None:
    with pytest.raises(ParseError, match="line 2"):
        derivation("lecture-3a").check("m1*x1'' + k*(x1 - x2) = -F\nm2*x2'' - k*(x1 - x2) = F ... plus m2 g")


SLIDERS = """
name = "two sliders"
[coordinates]
y1 = "first"
y2 = "second"
[parameters]
M1 = "2 kg"
M2 = "1 kg"
k = "80 N/m"
d = "2 N*s/m"
[points]
A = ["y1", "0"]
B = ["y2", "0"]
[[particle]]
mass = "M1"
at = "A"
[[particle]]
mass = "M2"
at = "B"
[[spring]]
k = "k"
deflection = "y2 - y1"
[[damper]]
b = "d"
deflection = "y2"
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("said", "old", "new"),
    [
        ("w2 is the velocity of mass 2, and c1, ..., c2 the accelerations of the masses.", "- d", "+ d"),
        ("c1 and c2 are the accelerations of masses 1 and 2, and w2 the speed of mass 2.", "1 and 2", "1 and 3"),
        ("Here c1, c2 are the accelerations of the carts and w2 the velocity of cart 2.", "y2 - y1", "y2 + y1"),
    ],
)
def test_names_told_by_enumeration_are_rates_of_masses_with_the_same_numbers(said: str, old: str, new: str) -> None:
    written = f"M1*c1 = k*(y2 - y1)\nM2*c2 = -k*(y2 - y1) - d*w2\n\n{said}"
    derived = lg.loads(SLIDERS).derive()
    assert derived.check(written, hint=0).right
    try:
        assert not derived.check(written.replace(old, new), hint=0).right
    except ParseError as error:
        assert "what is '" in str(error)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("tag", ["(I)", "[II]", "(q)"])
def test_a_letter_in_brackets_far_behind_an_equation_is_its_label(tag: str) -> None:
    twins(f"{POLE}        {tag}\n{CART}\nI add {tag} to the other one.", "- m g", "+ m g")
    assert not right(f"{POLE}\n{CART} * {tag}")
    assert not right(f"{POLE}\n{CART}        (l)")
    assert not right(f"{POLE}\n{CART.replace('F', 'q x - F')}        (q)")


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("said", "old", "new"),
    [
        ("The cart's wheel turns by φ, and r·φ = l·θ.", "l·θ.", "M·θ."),
        ("Let me use φ instead, so θ = r·φ/l.", "r·φ/l.", "r·φ/M."),
    ],
)
def test_a_relation_in_a_sentence_says_what_a_coordinate_is(said: str, old: str, new: str) -> None:
    said, old, new = (x.replace("r·", "2·") for x in (said, old, new))
    turned = "(2·φ/l)"
    rows = f"(M + m) x'' + 2·m·φ̈·cos{turned} - 4·m/l·φ̇²·sin{turned} + b x' = F\n"
    rows += f"(J + m l^2)·2/l·φ̈ + m l x'' cos{turned} - m g l sin{turned} = 0"
    twins(f"{said}\n{rows}", old, new)
    assert not right(f"{said}\n{rows.replace('- m g l', '+ m g l')}")


def test_a_coordinate_that_only_words_explain_is_asked_about() -> None:
    rows = "(M + m) x'' + 2*m*φ''*cos(2*φ/l) - 4*m/l*φ'^2*sin(2*φ/l) + b x' = F\n"
    rows += "(J + m l^2)*2/l*φ'' + m l x'' cos(2*φ/l) - m g l sin(2*φ/l) = 0"
    with pytest.raises(ParseError, match="what is 'φ'"):
        derivation("cart-pole").check(f"As second coordinate I use the angle φ through which a wheel turns.\n\n{rows}")


@pytest.mark.parametrize(("one", "two"), [("*", "*"), ("1.", "2."), ("1)", "2)")])
def test_a_bullet_or_number_behind_a_sentence_begins_a_statement(one: str, two: str) -> None:
    wrong = POLE.replace("- m g", "+ m g")
    assert right(f"The two steps were T and V. {one} {CART}\n  {two} {POLE}\nThe units agree.")
    assert not right(f"The two steps were T and V. {one} {CART}\n  {two} {wrong}\nThe units agree.")


def test_a_matrix_drawn_with_its_name_on_a_middle_line_is_read() -> None:
    def drawn(last: str) -> str:
        return (
            "    ⎡ M+m        m*l*cos(theta) ⎤\n"
            "M = ⎢                           ⎥\n"
            f"    ⎣ m*l*cos(theta)  {last} ⎦\n"
            "M*[x''; theta''] + [b*x' - m*l*theta'^2*sin(theta); -m*g*l*sin(theta)] = [F; 0]"
        )

    assert right(drawn("J + m*l^2"))
    assert not right(drawn("J - m*l^2"))


def test_words_behind_a_gap_are_no_product_though_letters_of_the_system_spell_them() -> None:
    sys = System("rod on a pin")
    theta = sys.coordinates("theta")
    m, k, b, e, l = sys.parameters("m k b e l")
    sys.kinetic(m * (e + l) ** 2 * theta.diff() ** 2 / 2)
    sys.potential(k * b * theta**2 / 2)
    derived = sys.derive()
    said = "rho = e + l*sin(theta)      distance of a ball from the axis\n"
    right_energy = "T = m*(rho - l*sin(theta) + l)^2*theta'^2/2"
    assert derived.check(said + right_energy, hint=0).right
    wrong = derived.check(said + right_energy.replace("/2", "/3"))
    assert not wrong.right and "th e" not in wrong.to_text()


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "place", ["theta = 0 is alpha = pi/2", "theta = 0 (upright) means alpha = pi/2", "alpha = pi/2"]
)
def test_one_position_of_an_angle_of_the_answer_is_no_value_of_it(place: str) -> None:
    said = f"alpha = pi/2 - theta is the angle from the ground, and {place}.\n"
    cart = "(M + m) x'' - m l alpha'' sin alpha - m l alpha'^2 cos alpha + b x' = F"
    twins(
        f"{said}{cart}\n(J + m l^2) alpha'' - m l x'' sin alpha + m g l cos alpha = 0", "pi/2 - theta", "pi/2 + theta"
    )


def test_what_was_done_to_an_equation_is_no_factor_of_it() -> None:
    twins(
        f"2 (M + m) x'' + 2 m l theta'' cos theta - 2 m l theta'^2 sin theta + 2 b x' = 2 F   (times 2)\n{POLE}",
        "2 F",
        "F",
    )
    twins(f"{CART}\n{POLE} (divided by nothing)", "m g l", "m g")


def test_a_name_of_the_system_is_never_split_in_latex() -> None:
    sys = System("shaft")
    phi = sys.coordinates("phi")
    J, kt, k, t = sys.parameters("J kt k tau")
    sys.kinetic(J * phi.diff() ** 2 / 2)
    sys.potential((kt + k * t) * phi**2 / 2)
    derived = sys.derive()
    row = r"J \ddot\phi + \left(kt + k \tau\right) \phi{\left(t \right)} = 0"
    assert derived.check(row, hint=0).right
    assert not derived.check(row.replace("kt", "k t"), hint=0).right


@pytest.mark.parametrize(
    "written",
    ["S = {left}\nwhere S = {right}", "{left} = S, where S is {right}.", "{left} = S with S being {right} and b > 0"],
)
def test_a_side_has_the_value_that_is_given_below_it(written: str) -> None:
    left, right_side = "m L^2 theta''", "-b theta' - m g L sin theta"
    answer = written.format(left=left, right=right_side)
    pendulum = derivation("pendulum")
    assert pendulum.check(answer, hint=0).right
    assert not pendulum.check(answer.replace("-b", "b"), hint=0).right


def test_a_title_may_hold_definitions_and_a_sentence_an_angle_in_degrees() -> None:
    rows = """(M + m) x'' + m l c theta'' - m l theta'^2 sin theta + b x' = F
(J + m l^2) theta'' + m l c x'' = m g l sin theta"""
    twins(f"Exercise 6 (cart and pole) – solution with c = cos theta\n{rows}", "cos theta\n", "sin theta\n")
    slope = System("slope")
    s = slope.coordinate("s")
    m, alpha = slope.parameter("m"), slope.parameter("alpha")
    slope.particle(m, at=slope.point("P", (s * sp.cos(alpha), s * sp.sin(alpha))))
    slope.gravity()
    said = slope.derive().check("The angle alpha = 30° stands only in this: m s'' = -m g sin alpha")
    assert said.right and "α = ⅙ π" in said.to_text()


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "I take cart + pole as two bodies with one rail. Notation: A = M + m, B = m l.",
        '"let me call the mass A = M + m; the first moment is B = m l"',
        'The sheet says "A = M + m, B = m l" for these. ',
    ],
)
def test_signs_between_words_and_quotation_marks_are_no_mathematics(said: str) -> None:
    rows = """A x'' + B cos theta theta'' - B theta'^2 sin theta + b x' = F
d/dt ∂T/∂θ' :   (J + m l^2) theta'' + B cos theta x'' = m g l sin theta"""
    twins(f"{said}\n{rows}", "M + m", "M - m")
    twins(f"{said}\n{rows}", "B cos theta x''", "B sin theta x''")


def test_a_definition_stands_in_a_sentence_with_mathematics_and_the_is_no_product() -> None:
    """With a coordinate θ and a parameter e, the is no th·e."""
    arm = System("arm")
    theta = arm.coordinate("theta")
    m, e, length = arm.parameters("m e l")
    arm.particle(m, at=arm.point("P", (length * sp.sin(theta), e - length * sp.cos(theta))))
    arm.gravity()
    told = "The bob has, with R = l θ', the momentum terms m l² θ'' + m R l θ'² sin θ about the hinge.\n"
    for row, holds in (("m l R' = -m g l sin(θ)", True), ("m l R' = -m g e sin(θ)", False)):
        assert arm.derive().check(told + row, hint=0).right is holds
