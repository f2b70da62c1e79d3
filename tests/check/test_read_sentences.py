"""Statements are found in any sentence, and names have the value that any sentence gives them.

Oracle: the equations of the cart with a pole and of other examples, in the grammar of model files. Every answer has a
wrong twin, in which what the sentence says is another thing, and which is not accepted.
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import ParseError

CART = "(M + m) x'' + m l theta'' cos theta - m l theta'^2 sin theta + b x' = F"
POLE = "(J + m l^2) theta'' + m l x'' cos theta - m g l sin theta = 0"


def right(written: str, name: str = "cart-pole") -> bool:
    """Whether an answer is judged right; one that cannot be read is not."""
    try:
        return derivation(name).check(written).right
    except ParseError as error:
        assert error.place is not None
        return False


def twins(written: str, old: str, new: str, name: str = "cart-pole") -> None:
    """An answer is right, and is not with something else in its place."""
    assert old in written and right(written, name), written
    assert not right(written.replace(old, new), name), written.replace(old, new)


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


@pytest.mark.parametrize(
    "said",
    [
        "From d/dt(...) we see that x is cyclic if F = 0 and b = 0.",
        "Check: for theta = 0 the first gives (M + m) x'' + b x' = F.",
        "If J = 0, the second becomes l theta'' + x'' cos theta = g sin theta, as for a point mass.",
    ],
)
def test_what_holds_under_a_condition_is_not_judged(said: str) -> None:
    twins(f"{CART}\n{POLE}\n{said}", "+ b x' = F\n", "- b x' = F\n")
    assert not right(f"{CART}\n{said}")


def test_a_line_with_a_name_that_nothing_needs_is_not_judged() -> None:
    rows = "(J/R^2 + m1 + m2) x'' = (m1 - m2) g"
    twins(f"The pulley turns with phi' = x'/R.\n{rows}", "m1 - m2", "m1 + m2", "atwood")
    assert not right(f"x = R phi\nx = R phi + 1\n{rows}", "atwood")
    assert right(f"x = R phi\nx' = R phi'\n{rows}", "atwood")
    assert not right("phi' = x'/R\n(J/R^2 + m1 + mu) x'' = (m1 - m2) g", "atwood")


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
        "plus m1 g",
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
