"""What students say of their own letters, deviations and columns, in words, tables and comments.

Oracle: the equations of a puck on a rod that a motor turns and of a cart with a pendulum, written by hand in the new
letters; beside each, the same words with a mistake in them or in the equations.
"""

from __future__ import annotations

import pytest
from small_systems import cart, rod

from lagrangian.errors import Error

IN_UNIFORM = """
m r'' - m r (W + w)^2 + k (r - a) = 0
(J + m r^2) w' + 2 m r r' (W + w) = M
"""
IN_UNIFORM_LATEX = r"""
\[ m\ddot r-mr(\Omega+\nu)^2+k(r-a)=0 \]
\[ (J+mr^2)\dot\nu+2mr\dot r(\Omega+\nu)=M \]
"""
TURNS = {
    "sum": "phi' = W + w with a constant W",
    "the other way round": "phi' = w + W, where W is constant",
    "difference": "Let w = phi' - W be the deviation from the constant speed W.",
    "latex": r"We write $\dot\varphi=\Omega+\nu$ with $\Omega$ constant.",
    "with dots": "φ̇ = W + w (W constant)",
}


def accepted(said: str, equations: str, *, of_cart: bool = False) -> bool:
    """Whether an answer is read and right."""
    try:
        return (cart() if of_cart else rod()).check(f"{said}\n{equations}").right
    except Error:
        return False


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", TURNS)
def test_a_deviation_from_a_uniform_motion_may_have_any_speed(said: str) -> None:
    equations = IN_UNIFORM_LATEX if "latex" in said else IN_UNIFORM
    assert accepted(TURNS[said], equations)
    for whole in ("(W + w)^2", r"(\Omega+\nu)^2"):
        assert whole not in equations or not accepted(TURNS[said], equations.replace(whole, whole[:-2]))


def test_an_angle_may_be_a_uniform_rotation_and_a_deviation() -> None:
    said = r"The arm turns steadily, $\varphi(t)=\Omega t+\delta(t)$, and $u=M-M_0$ with a constant $M_0$."
    equations = r"""\[ m\ddot r-mr(\Omega+\dot\delta)^2+k(r-a)=0,\qquad
    (J+mr^2)\ddot\delta+2mr\dot r(\Omega+\dot\delta)=u+M_0 \]"""
    assert accepted(said, equations)
    assert not accepted(said, equations.replace(r"2mr\dot r(\Omega+\dot\delta)", r"2mr\dot r\dot\delta"))


@pytest.mark.slow
def test_a_steady_position_is_said_by_its_condition() -> None:
    said = "Let r* be where the puck stays at the speed W, so k (r* - a) = m r* W^2. I set z = r - r* and w = phi' - W."
    equations = """m z'' - m r* (2 W w + w^2) - m z (W + w)^2 + k z = 0
    (J + m (r* + z)^2) w' + 2 m (r* + z) z' (W + w) = M"""
    assert accepted(said, equations)
    assert not accepted(said, equations.replace("2 W w", "W w"))
    assert not accepted(said.replace("m r* W^2", "2 m r* W^2"), equations)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("dots", [r"\Delta\ddot r", r"\ddot{\Delta r}"])
@pytest.mark.parametrize("said", [r"$r=a+\Delta r$ hence $\Delta r=r-a$", r"$\Delta r=r-a$, $\Delta M=M-M_0$"])
def test_a_difference_is_one_name(said: str, dots: str) -> None:
    first = dots.replace("ddot", "dot")
    equations = rf"""\[ m{dots}-m(a+\Delta r)\dot\varphi^2+k\,\Delta r=0 \]
    \[ (J+m(a+\Delta r)^2)\ddot\varphi+2m(a+\Delta r)\,{first}\,\dot\varphi=M \]"""
    assert accepted(said, equations)
    assert not accepted(said, equations.replace(r"k\,\Delta r", r"2k\,\Delta r"))


def test_the_deviation_of_an_input_is_the_rest_of_a_sum() -> None:
    said = "M = k a + v"
    equations = "m r'' - m r phi'^2 + k (r - a) = 0\n(J + m r^2) phi'' + 2 m r r' phi' - k a = v"
    assert accepted(said, equations)
    assert not accepted(said, equations.replace("- k a = v", "= v"))


SHEET = {
    "was": "* angle of the rod: **b** (was phi)\n* puck: **s** (was r), relaxed at **s0** (was a)\n",
    "on the sheet": "I use b, the angle (phi on the sheet), s (r on the sheet) and the relaxed s0 (a in the task).\n",
    "yours": "b: angle of the rod, your phi\ns: puck, your r\ns0: where the spring is relaxed, the sheet's a\n",
    "called": "b: angle, called phi in the problem\ns: puck (the sheet calls it r)\ns0: relaxed (formerly a)\n",
}
OF_SHEET = "m s'' - m s b'^2 + k (s - s0) = 0\n(J + m s^2) b'' + 2 m s s' b' = M"


@pytest.mark.parametrize("said", SHEET)
def test_letters_are_set_against_those_of_the_sheet(said: str) -> None:
    assert accepted(SHEET[said], OF_SHEET)
    assert not accepted(SHEET[said], OF_SHEET.replace("s - s0", "s + s0"))


@pytest.mark.parametrize(
    "said",
    ["I wrote b for the angle (it is phi on the sheet).", "I call the angle of the rod b (on the sheet: phi)."],
)
def test_a_pronoun_is_no_letter_that_is_set_against_one_of_the_sheet(said: str) -> None:
    verdict = rod().check(f"{said}\nm r'' - m r b'^2 + k (r - a) = 0\n(J + m r^2) b'' + 2 m r r' b' = M")
    assert verdict.right
    assert "As you write, b stands for phi." in map(str, verdict.notes)


def test_letters_of_a_table_in_latex_are_set_against_those_of_the_sheet() -> None:
    said = r"""\begin{tabular}{ll}
    $\gamma$ & angle of the rod, the sheet's $\varphi$\\
    $k_F$ & stiffness (the sheet's $k$)
    \end{tabular}"""
    equations = r"\[ m\ddot r-mr\dot\gamma^2+k_F(r-a)=0 \] \[ (J+mr^2)\ddot\gamma+2mr\dot r\dot\gamma=M \]"
    assert accepted(said, equations)
    assert not accepted(said, equations.replace("2mr", "mr"))


@pytest.mark.slow
@pytest.mark.parametrize("between", [r"@{\;$=$\;}", "@{ = }"])
def test_an_equals_sign_may_stand_between_columns(between: str) -> None:
    said = rf"""\begin{{tabular}}{{l{between}l}}
    $s$ & $r-a$\\
    $\gamma$ & $\varphi$
    \end{{tabular}}"""
    equations = r"\[ m\ddot s-m(s+a)\dot\gamma^2+ks=0 \] \[ (J+m(s+a)^2)\ddot\gamma+2m(s+a)\dot s\dot\gamma=M \]"
    assert accepted(said, equations)
    assert not accepted(said.replace("r-a", "r+a"), equations)


def test_definitions_may_stand_in_large_brackets() -> None:
    equations = r"""\[ (M+m)\ddot x+ml(\ddot\varphi C-\dot\varphi^2 S)+kx=0 \]
    \[ ml\ddot x\,C+ml^2\ddot\varphi+mgl\,S=0 \]"""
    said = r"$\bigl(C=\cos\varphi,\ S=\sin\varphi\bigr)$"
    assert accepted(equations, said, of_cart=True)
    assert not accepted(equations, said.replace(r"C=\cos", r"C=\sin"), of_cart=True)


VALUES = {
    "sum": "P is the sum of the two forces, - k (r - a) and m r phi'^2.",
    "sum in latex": r"$P$ is the sum of the spring's $-k(r-a)$ and the centrifugal force $mr\dot\varphi^2$.",
    "times": "The force P is m r phi'^2 minus k (r - a).",
    "brackets": "The pull, which I call P (= m r phi'^2 - k (r - a)), acts on the puck.",
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", VALUES)
def test_a_name_is_a_sum_in_words(said: str) -> None:
    equations = "m r'' = P\n(J + m r^2) phi'' + 2 m r r' phi' = M"
    if "latex" in said:
        equations = "\\[ m\\ddot r=P \\]\n\\[ (J+mr^2)\\ddot\\varphi+2mr\\dot r\\dot\\varphi=M \\]"
    assert accepted(VALUES[said], equations)
    assert not accepted(VALUES[said].replace("(r - a)", "(r + a)").replace("(r-a)", "(r+a)"), equations)


@pytest.mark.parametrize(
    "said",
    [
        "I call the spring force f_s (= k times the stretch r - a).",
        "The spring force f_s is k times the stretch r - a.",
    ],
)
def test_a_name_is_a_product_in_words(said: str) -> None:
    equations = "m r'' - m r phi'^2 + f_s = 0\n(J + m r^2) phi'' + 2 m r r' phi' = M"
    assert accepted(said, equations)
    assert not accepted(said.replace("r - a", "r + a"), equations)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("verb", ["are", "are short for", "stand for", "for"])
def test_several_names_have_as_many_values(verb: str) -> None:
    said = f"We agreed that cg, sg {verb} cos(phi), sin(phi)."
    equations = """(M + m)*x'' + m*l*cg*phi'' - m*l*sg*phi'^2 + k*x = 0
    m*l*cg*x'' + m*l^2*phi'' + m*g*l*sg = 0"""
    assert accepted(said, equations, of_cart=True)
    assert not accepted(said.replace("cg, sg", "sg, cg"), equations, of_cart=True)


def test_a_length_between_two_points_is_said_in_words() -> None:
    said = "AB denotes how far A is to the right of B (AB = l sin(phi)); CB is the height below, CB = l cos(phi)."
    equations = "(M + m) x'' + m CB phi'' - m AB phi'^2 + k x = 0\nm CB x'' + m l^2 phi'' + m g AB = 0"
    assert accepted(said, equations, of_cart=True)
    assert not accepted(said.replace("CB = l cos(phi)", "CB = l sin(phi)"), equations, of_cart=True)


@pytest.mark.parametrize("where", ["relaxed at", "without force for"])
def test_a_constant_is_said_where_a_spring_is_relaxed(where: str) -> None:
    said = f"I count the other way, s = -r, and the spring is {where} s0 = -a."
    equations = "m s'' - m s phi'^2 + k (s - s0) = 0\n(J + m s^2) phi'' + 2 m s s' phi' = M"
    assert accepted(said, equations)
    assert not accepted(said.replace("s0 = -a", "s0 = a"), equations)


def test_parameters_may_be_given_in_new_ones_together() -> None:
    said = "The bob's mass is a fraction ε of the total mass m0, so m = ε m0 and M = (1 - ε) m0."
    equations = "m0 (x'' + ε l (phi'' cos(phi) - phi'^2 sin(phi))) + k x = 0\nx'' cos(phi) + l phi'' + g sin(phi) = 0"
    assert accepted(said, equations, of_cart=True)
    assert not accepted(said.replace("(1 - ε) m0", "(1 + ε) m0"), equations, of_cart=True)


def test_forms_of_kappa_are_letters() -> None:
    equations = r"\[ \ddot r-r\dot\varphi^2+\varkappa(r-a)=0 \] \[ (J+mr^2)\ddot\varphi+2mr\dot r\dot\varphi=M \]"
    assert accepted(r"Let $\varkappa=k/m$.", equations)
    assert not accepted(r"Let $\varkappa=2k/m$.", equations)


COLUMNS = {
    "single entries": "# q[0] = r, q[1] = phi;  v = dq/dt;  a_ = dv/dt\n",
    "lists": "# q = [r, phi], v = q', a_ = v'\n",
}


@pytest.mark.parametrize("said", COLUMNS)
def test_comments_list_the_entries_of_columns(said: str) -> None:
    code = """res = [
    m*a_[0] - m*q[0]*v[1]**2 + k*(q[0] - a),
    (J + m*q[0]**2)*a_[1] + 2*m*q[0]*v[0]*v[1] - M,
]   # both are zero
"""
    assert accepted(COLUMNS[said], code)
    assert not accepted(COLUMNS[said], code.replace("v[0]*v[1]", "v[1]*v[1]"))


def test_a_state_without_a_function_is_unpacked() -> None:
    code = """x = s(1); phi = s(2); xd = s(3); phid = s(4);
Mq = [M+m, m*l*cos(phi); m*l*cos(phi), m*l^2];
f = [m*l*phid^2*sin(phi) - k*x; -m*g*l*sin(phi)];
qdd = Mq\\f;
sd = [xd; phid; qdd];
"""
    assert accepted("% s = [x; phi; xd; phid]", code, of_cart=True)
    assert not accepted("% s = [x; phi; xd; phid]", code.replace("- k*x", "+ k*x"), of_cart=True)


def test_what_a_formula_says_again_is_no_change() -> None:
    said = "d is twice the angle of the pendulum, d = 2 phi."
    equations = """(M + m) x'' + m l d'' cos(d/2)/2 - m l d'^2 sin(d/2)/4 + k x = 0
    x'' cos(d/2) + l d''/2 + g sin(d/2) = 0"""
    verdict = cart().check(f"{said}\n{equations}")
    assert verdict.right
    assert not any("may change" in str(note) for note in verdict.notes)
