r"""Rates and rows as students type them: (θ')² behind a letter, dots and _dot behind names, an index t, rows of LaTeX.

Oracle: the equations of a cart with a pendulum, of a mass on a spring and of a puck on a rod, by hand. Every
form has a wrong twin.
"""

from __future__ import annotations

import pytest
from small_systems import cart, mass, rod

import lagrangian as lg
from lagrangian.check.reading import parse_answer


def assert_read(system: lg.Derivation, written: str, *wrong: tuple[str, str]) -> None:
    """An answer is right, and each of its wrong twins is not."""
    verdict = system.check(written)
    assert verdict.right, verdict.to_text()
    for old, new in wrong:
        assert old in written, old
        assert not system.check(written.replace(old, new), hint=0).right, (old, new)


SWUNG = """u = -x.   p = phi
(M + m) u'' - m l cos(p) p'' + m l sin(p) (p')^2 + k u = 0
m l^2 p'' - m l cos(p) u'' + m g l sin(p) = 0"""


def test_a_letter_in_front_of_the_square_of_a_rate_is_a_factor() -> None:
    # the value of a letter ends with its sentence, and a power behind a rate in brackets is one of the rate
    right = "s = r.   p = phi\nJ p'' + m s² p'' + 2 m s s' p' = M\nm s'' - m s (p')^2 + k (s - a) = 0"
    assert_read(rod(), right, ("m s (p')^2", "m s p'"), ("m s (p')^2", "m s²"), ("- m s (p')", "+ m s (p')"))
    assert_read(cart(), SWUNG, ("(p')^2", "p'"), ("+ m l sin(p) (p')", "- m l sin(p) (p')"))


def test_a_function_of_a_glued_letter_in_front_of_a_rate_in_brackets_is_no_name() -> None:
    written = """T = ½ M ẋ² + ½ m (ẋ² + 2 l cosφ φ̇ ẋ + l² (φ̇)²)
V = ½ k x² − m g l cosφ
(M + m) ẍ + m l cosφ φ̈ − m l sinφ (φ̇)² + k x = 0
m l² φ̈ + m l cosφ ẍ + m l sinφ cosφ (φ̇)² + m g l sinφ = m l sinφ cosφ (φ̇)²"""
    assert_read(
        cart(), written, ("= m l sinφ cosφ (φ̇)²", "= m l sinφ cosφ φ̇"), ("cosφ φ̈", "sinφ φ̈"), ("sinφ (φ̇)²", "sinφ φ̇")
    )


@pytest.mark.sampled(4)
@pytest.mark.parametrize("begins", [r"\displaystyle\qquad{}", r"\displaystyle{}", r"\displaystyle\quad", r"\qquad"])
@pytest.mark.parametrize("kind", ["cases", "aligned", "array"])
def test_a_row_that_begins_with_an_operator_goes_on_in_any_style(begins: str, kind: str) -> None:
    opened = f"{kind}}}{{l}}" if kind == "array" else f"{kind}}}"
    written = rf"""\[
\begin{{{opened}
\displaystyle (M+m)\,\ddot x + m l\cos\phi\;\ddot\phi\\[6pt]
{begins}- m l\sin\phi\;\dot\phi^2 + k x = 0\\[10pt]
\displaystyle m l^2\ddot\phi + m l\cos\phi\;\ddot x + m g l\sin\phi = 0
\end{{{kind}}}
\]"""
    assert_read(cart(), written, ("- m l", "+ m l"), ("k x = 0", "2 k x = 0"), ("+ m g l", "- m g l"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "remark",
    [
        r"\text{(everything about the pin, arm at }90^\circ)",
        r"\text{(bob, arm at }\phi\text{ from the vertical)}",
        r"\mbox{(largest for }(\phi)\mbox{ small)}",
    ],
)
def test_a_bracket_of_words_may_end_in_mathematics(remark: str) -> None:
    written = rf"""\[
\begin{{array}}{{ll}}
 A = m\,l^2 & {remark}\\
 B = m\,l & \text{{(static moment)}}
\end{{array}}
\]
\[ (M+m)\ddot x + B\cos\phi\,\ddot\phi - B\sin\phi\,\dot\phi^2 + k x = 0 \]
\[ A\,\ddot\phi + B\cos\phi\,\ddot x + B\,g\sin\phi = 0 \]"""
    assert_read(cart(), written, (r"A = m\,l^2", r"A = 2 m\,l^2"), (r"B = m\,l ", r"B = m\,l^2 "), ("- B", "+ B"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "w. = its derivative, r. and r.. the first and second one of r\n",
        "letters: w. the derivative of w\n",
        "(a dot behind a letter means d/dt)\n",
        "w. = dw/dt, r. = dr/dt, v. = dv/dt\n",
        "v. and w. their derivatives\n",
    ],
)
def test_dots_behind_names_are_rates_where_the_answer_says_so(said: str) -> None:
    written = f"""{said}w = phi', v = r'
J w. + m r^2 w. + 2 m r v w = M          [1]
m (v. - r w^2) = - k (r - a)             [2]"""
    if said.startswith(("w. = its", "letters")):
        written = written.replace("v.", "r''")
    assert_read(rod(), written, ("2 m r v w", "2 m r v"), ("J w.", "J w"), ("- r w^2", "+ r w^2"))


TWO = """(x. = first, x.. = second derivative of x)
m x.. = F - k x - b x.                          <-- equation of motion"""


def test_two_dots_behind_a_name_say_what_one_is_in_front_of_anything() -> None:
    assert_read(mass(), TWO, ("b x.", "b x"), ("- b", "+ b"))
    assert_read(mass(), "m x.. = F - k x - b x. This is the equation of motion.".replace("x. This", "x."))
    squared = """p means phi.
J p.. + m r^2 p.. + 2 m r r. p. = M
r.. - r p.^2 = - k (r - a)/m"""
    assert_read(rod(), squared, ("p.^2", "p^2"), ("r. p.", "r p."), ("p.^2", "p."))


def test_a_dot_before_a_new_sentence_is_a_full_stop() -> None:
    written = "m x.. + b x. = F - k x. The mass is not weightless.\nHere F is the force."
    assert_read(mass(), written, ("- k x.", "- k x. - k x."), ("b x. =", "b x ="))
    whole = "With x. = dx/dt we have\nm x.. = F - b x. - k x."
    assert_read(mass(), whole, ("- b x.", "+ b x."))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("value", ["(= dphi/dt)", "(= d phi/dt)", "(= phi')", "(= phi' + 0)"])
def test_a_value_in_brackets_behind_what_a_letter_is(value: str) -> None:
    written = f"""letters:  w1 rate of the rod {value},  v speed along it (= dr/dt),
Js inertia about the pin (= J + m r²)
Js w1' + 2 m r v w1 = M
m (v' - r w1^2) = - k (r - a)"""
    assert_read(rod(), written, ("(= J + m r²)", "(= J + 2 m r²)"), ("2 m r v w1", "2 m r v"), ("(= dr", "(= 2 dr"))


def test_words_in_front_of_such_a_value_are_no_names() -> None:
    # the energy of one body is not T, and "the" and "arm" are no letters
    written = """T kinetic energy of the motor (= 0), the rod (= a), I take phi (= phi).
J phi'' + m r² phi'' + 2 m r r' phi' = M
m r'' - m r phi'^2 = - k (r - a)"""
    assert_read(rod(), written, ("2 m r r'", "m r r'"))


POWER = """Names: w = phi_dot, v = r_dot. The ending _dot means d/dt.
virtual power:  0 = (M - (J w + m r^2 w)_dot) w* + (m r w^2 - k (r - a) - m v_dot) v*
(m r^2 w)_dot = m r^2 w_dot + 2 m r v w
Terms with w*:   J w_dot + (m r^2 w)_dot = M
Terms with v*:   (m v)_dot - m r w^2 + k (r - a) = 0"""


def test_the_rate_of_what_stands_in_brackets_and_virtual_velocities() -> None:
    assert_read(
        rod(),
        POWER,
        ("= M\n", "= 2 M\n"),
        ("J w_dot + (m r^2 w)_dot", "J w_dot + (m r w)_dot"),
        ("2 m r v w", "m r v w"),
        ("(m v)_dot", "(m v)"),
        ("(m v)_dot", "2 (m v)_dot"),
    )


def test_stars_without_virtual_velocities_are_products() -> None:
    written = "w = phi', v = r'\nJ*w' + m*r^2*w' + 2*m*r*v* w = M\nm*v' - m*r*w^2 + k*(r - a) = 0"
    assert_read(rod(), written, ("2*m*r*v* w", "2*m*r*v"))


INDEXED = """w = phi_t   (index t = time derivative),   u = r_t

D = J w + m r^2 w          (counter-clockwise)

D_t = sum of moments:
   (J + m r^2) w_t + 2 m r u w = M      (A)

the mass along the rod
   m (u_t - r w^2) = - k (r - a)        (B)"""


@pytest.mark.parametrize("said", ["index t = time derivative", "subscript t means d/dt", "index t: derivative"])
def test_an_index_is_a_rate_of_every_letter_where_an_answer_explains_it(said: str) -> None:
    written = INDEXED.replace("index t = time derivative", said)
    assert_read(rod(), written, ("2 m r u w", "m r u w"), ("u_t - r w^2", "u_t + r w^2"))


def test_a_momentum_called_d_may_be_written_with_letters_for_rates() -> None:
    written = "w = phi', u = r'\nD = (J + m r²) w\nD' = M\nm u' - m r w² = - k (r - a)"
    assert_read(rod(), written, ("D' = M", "D' = 2 M"), ("(J + m r²) w", "(J + m r) w"))
    damped = "v = x'\nT = 1/2 m v^2, V = 1/2 k x^2, D = 1/2 b v^2\nm v' + b v + k x = F"
    assert_read(mass(), damped, ("D = 1/2 b", "D = b"), ("b v +", "b x +"))


def test_a_sum_of_something_is_no_product_of_letters() -> None:
    written = "s = r, u = s', m u' - m s phi'^2 = sum of forces = - k (s - a)\nJ phi'' + m s² phi'' + 2 m s u phi' = M"
    assert_read(rod(), written, ("- k (s", "+ k (s"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("bound", [">0", r"\neq 0", r"\,>\,0", r"\ge 0", r"\not= 0"])
def test_a_definition_in_latex_may_say_that_it_is_not_zero(bound: str) -> None:
    written = rf"""Cramer with $\Delta = (M + m\sin^2\phi)\,l {bound}$ yields
\begin{{align*}}
 \ddot x &= \frac{{m l^2\dot\phi^2\sin\phi + m g l\sin\phi\cos\phi - k l x}}{{\Delta}},\\
 \ddot\phi &= \frac{{k x\cos\phi - m l\dot\phi^2\sin\phi\cos\phi - (M + m) g\sin\phi}}{{\Delta}}.
\end{{align*}}"""
    assert_read(cart(), written, (r"(M + m\sin", r"(M - m\sin"), ("- k l x", "+ k l x"), ("- (M + m)", "+ (M + m)"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("gap", ["&&", r"&\quad", r"\qquad"])
def test_a_word_behind_a_gap_at_the_end_of_a_row_is_no_factor(gap: str) -> None:
    written = rf"""\begin{{align*}}
 T &= \tfrac12 M\dot x^2 + \tfrac12 m(\dot x^2 + 2 l\dot x\dot\phi\cos\phi + l^2\dot\phi^2) {gap} \text{{kinetic}}\\
 V &= \tfrac12 k x^2 - m g l\cos\phi {gap} \text{{potential}},\\
 (M+m)\ddot x &+ m l\cos\phi\,\ddot\phi - m l\sin\phi\,\dot\phi^2 + k x = 0 {gap} \text{{horizontal}}\\
 m l^2\ddot\phi &+ m l\cos\phi\,\ddot x + m g l\sin\phi = 0 {gap} \mbox{{moments}}
\end{{align*}}"""
    assert_read(cart(), written, ("2 l", "3 l"), ("- m g l", "+ m g l"), ("+ k x", "- k x"), ("+ m g l", "- m g l"))


def test_a_word_in_a_matrix_stays_an_entry() -> None:
    row = r"\[ \begin{bmatrix} m\ddot x & 0\end{bmatrix} = \begin{bmatrix} F - k x & \text{pull}\end{bmatrix} \]"
    assert [u.name for u in parse_answer(row, mass().model).unknown] == ["pull"]


def test_an_index_that_is_explained_in_latex_is_a_rate_of_letters_that_stand_alone_too() -> None:
    written = r"""The index $t$ is the time derivative (index t = d/dt): $w = \phi_t$, $u = r_t$, $J_t = J + m r^2$.
\[ J_t\,w_t + 2 m r u w = M \]
\[ m\,(u_t - r w^2) = -k\,(r - a) \]"""
    assert_read(rod(), written, ("2 m r u w", "m r u w"), ("u_t - r w^2", "u_t + r w^2"), ("J + m r^2", "J + m r"))
