"""No answer is called wrong because of a name that nothing explains, and names are explained in many ways.

Oracle: the equation of a drum with a load, (J + m R²) φ̈ + d φ̇ + k R² φ − m g R = τ, and those of two carts, by hand.
Every form has a wrong twin, which is not accepted.
"""

from functools import cache

import pytest

from lagrangian import Derivation, ParseError, System

RIGHT = "(J + m R^2) phi'' + d phi' + k R^2 phi - m g R = tau"


@cache
def drum() -> Derivation:
    """A load on a rope around a drum that a spring and a damper hold."""
    sys = System("drum with a load")
    phi = sys.coordinate("phi")
    m, R, J, k, d, g = sys.parameters("m R J k d g")
    sys.rigid_body(0, J, at=sys.origin, frame=sys.frame(phi))
    sys.particle(m, at=sys.point("load", (0, -R * phi)))
    sys.gravity((0, -1), g=g)
    sys.spring(k, deflection=R * phi)
    sys.damper(d, deflection=phi)
    sys.generalized_force(phi, sys.input("tau"))
    return sys.derive()


@cache
def carts() -> Derivation:
    """Two carts with a spring between them, the first pulled by F."""
    sys = System("two carts")
    x1, x2 = sys.coordinates("x1 x2")
    m1, m2, k = sys.parameters("m1 m2 k")
    sys.particle(m1, at=sys.point("A", (x1, 0)))
    sys.particle(m2, at=sys.point("B", (x2, 0)))
    sys.spring(k, deflection=x2 - x1)
    sys.generalized_force(x1, sys.input("F"))
    return sys.derive()


def accepted(derivation: Derivation, written: str) -> bool:
    """Whether an answer is right; one that cannot be read is not."""
    try:
        return derivation.check(written, hint=0).right
    except ParseError:
        return False


def test_a_name_that_nothing_explains_is_asked_about_and_not_guessed() -> None:
    written = RIGHT.replace("d phi'", "B d rho phi'")
    with pytest.raises(ParseError, match="what is 'B'") as caught:
        drum().check(written)
    assert caught.value.place is not None and caught.value.place.column == written.index("B") + 1


@pytest.mark.parametrize("named", ["J_A: moment of inertia about A", "J_A = moment of inertia", ""])
def test_what_may_be_a_sum_is_not_taken_for_one_summand(named: str) -> None:
    with pytest.raises(ParseError, match="what is 'J_A'"):
        drum().check(f"J_A phi'' + d phi' + k R^2 phi - m g R = tau\n{named}")


def test_what_is_wrong_without_the_unknown_name_is_wrong() -> None:
    rows = "m1 x1'' + k (x1 - x2) = F\nm2 x2'' + k (x1 - x2) = rho m1"
    assert not carts().check(rows.replace("rho m1", "0").replace("F", "2 F"), hint=0).right
    with pytest.raises(ParseError, match="what is 'rho'"):
        carts().check(rows)


def test_a_meaning_that_makes_an_equation_right_is_the_meaning() -> None:
    rows = "m1 x1'' + k (x1 - x2) = P\nm2 x2'' + k (x1 - x2) = P"
    assert not carts().check(rows, hint=0).right


@pytest.mark.parametrize(
    "written",
    [
        "With D = d*phi' the moment of the damper, I find\n(J + m R^2) phi'' + D + k R^2 phi - m g R = tau",
        "D = (J + m R^2) phi'\ndD/dt = tau - d phi' - k R^2 phi + m g R",
        "with s = R phi (s: how far the load has moved down) I get\n(m + J/R^2) s'' + d/R^2 s' + k s - m g = tau/R",
        "rod: m L^2/3\ninertia: J + m R^2\n" + RIGHT,
    ],
)
def test_letters_of_energies_and_remarks_are_what_the_answer_makes_of_them(written: str) -> None:
    assert accepted(drum(), written)
    assert not accepted(drum(), written.replace("m g", "2 m g"))


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "written",
    [
        "% y(1) = phi, y(2) = phi_dot\ndydt = zeros(2,1);\ndydt(1) = y(2);\n"
        "dydt(2) = (tau + m*g*R - k*R^2*y(1) - d*y(2))/(J + m*R^2);",
        "% s = [phi; w]\na = (tau + m*g*R - k*R^2*s(1) - d*s(2))/(J + m*R^2);\nds = [s(2); a];",
        "dz = [w; (tau + m*g*R - k*R^2*phi - d*w)/(J + m*R^2)];  % z = [phi; w]",
        "dz = [z(2); (tau + m*g*R - k*R^2*z(1) - d*z(2))/(J + m*R^2)];",
        "# y = (phi, w)\ndydt[0] = y[1]\ndydt[1] = (tau + m*g*R - k*R**2*y[0] - d*y[1])/(J + m*R**2)",
    ],
)
def test_rates_of_a_state_are_read_without_the_first_line_of_a_function(written: str) -> None:
    assert accepted(drum(), written)
    assert not accepted(drum(), written.replace("m*g", "2*m*g"))


def test_states_may_alternate_with_their_rates() -> None:
    written = "dx = [x(2); (F + k*(x(3) - x(1)))/m1; x(4); k*(x(1) - x(3))/m2];"
    assert accepted(carts(), written)
    assert not accepted(carts(), written.replace("k*(x(1)", "2*k*(x(1)"))


@pytest.mark.parametrize(
    "written",
    [
        "# i is the rate of phi, w = dphi/dt\nw_dot = (tau + m*g*R - k*R**2*phi - d*w)/(J + m*R**2)",
        "% p, w = phi, dphi/dt\nddt = 0;\ndw = (tau + m*g*R - k*R^2*p - d*w)/(J + m*R^2);",
        "dw_dt = (tau + m*g*R - k*R**2*phi - d*w)/(J + m*R**2)  # w = phi'",
        "u[t_] := tau + m*g*R;\n(J + m*R^2)*phi''[t] + d*phi'[t] + k*R^2*phi[t] == u[t]",
        "t, m, r, J = symbols('t m R J')\np = Function('phi')(t)\n"
        "e = Eq((J + m*r**2)*p.diff(t, 2) + d*p.diff(t),\n       tau + m*g*r - k*r**2*p)",
    ],
)
def test_comments_and_declarations_of_programs_say_what_names_are(written: str) -> None:
    assert accepted(drum(), written)
    assert not accepted(drum(), written.replace("m*g", "2*m*g"))


@pytest.mark.parametrize("counted", [" for i = 1, 2", ""])
def test_definitions_with_an_index_are_written_out(counted: str) -> None:
    first = rf"$\kappa_i = \frac{{k}}{{m_i}}${counted.replace('i = 1, 2', '$i = 1, 2$')}"
    rows = r"$\ddot x_1 + \kappa_1 (x_1 - x_2) = F/m_1$" + "\n" + r"$\ddot x_2 + \kappa_2 (x_2 - x_1) = 0$"
    assert accepted(carts(), f"{first}\n{rows}")
    assert not accepted(carts(), f"{first.replace('{k}', '{2 k}')}\n{rows}")
    plain = f"kappa_i = k/m_i{counted}\nx1'' + kappa_1 (x1 - x2) = F/m1\nx2'' + kappa_2 (x2 - x1) = 0"
    assert accepted(carts(), plain)


def test_values_of_products_are_no_equations() -> None:
    valued = System("oscillator")
    x = valued.coordinate("x")
    m, k, c = valued.parameters("m k c", m=0.5, k=8, c=0.3)
    valued.particle(m, at=valued.point("A", (x, 0)))
    valued.spring(k, deflection=x)
    valued.damper(c, deflection=x)
    derived = valued.derive()
    assert accepted(derived, "k m = 4, c m = 0.15\n0.5 x'' + 0.3 x' + 8 x = 0")
    assert not accepted(derived, "k m = 5, c m = 0.15\n0.5 x'' + 0.3 x' + 8 x = 0")


def test_an_energy_may_have_the_constraint_put_in() -> None:
    sys = System("yo-yo")
    y, phi = sys.coordinates("y phi")
    m, J, r, g = sys.parameters("m J r g")
    sys.particle(m, at=sys.point("centre", (0, -y)))
    sys.rigid_body(0, J, at=sys.origin, frame=sys.frame(phi))
    sys.gravity((0, -1), g=g)
    sys.constraint(y - r * phi, name="string")
    derived = sys.derive()
    written = "y = r phi\nT = 1/2 (m r^2 + J) phi'^2\nV = -m g r phi\n(J + m r^2) phi'' = m g r"
    assert accepted(derived, written)
    assert not accepted(derived, written.replace("r^2 + J) phi'^2", "r + J) phi'^2"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "written",
    [
        "[M]{q''} + [K]{q} = {f}\n[M] = [m1, 0; 0, m2]\n[K] = [k, -k; -k, k]\n{f} = {F; 0}, {q} = {x1; x2}",
        "M = [m1 0\n     0  m2]\nK = [k  -k\n     -k  k]\nf = [F\n     0]\nM*q'' + K*q = f,  q = (x1 x2)^T",
        "q = [x1; x2], u = F\n[m1 0; 0 m2] q'' + [k -k; -k k] q = [1; 0] u",
        r"\[ \begin{pmatrix} m_1 & 0\\ 0 & m_2\end{pmatrix}\ddot{\mathbf q}"
        r" + \begin{pmatrix} k & -k\\ -k & k\end{pmatrix}\mathbf q = \begin{pmatrix}F\\ 0\end{pmatrix},"
        r"\qquad \mathbf q = (x_1\; x_2)^T \]",
        "[m1 0; 0 2 m2] q'' + [k, -k; -2*k, 2*k] q = [F; 0], q = [x1; x2]",
        "I) m1 x1'' + k (x1 - x2) = F\nII) m2 x2'' + k (x2 - x1) = 0\nI+II) m1 x1'' + m2 x2'' = F",
        "Equation of motion for x1 =\nm1 x1'' + k (x1 - x2) = F\nand for mass two =\nm2 x2'' + k (x2 - x1) = 0",
        "m1 x1'' = F - S\nm2 x2'' = S\nwhere S = k (x1 - x2) is the spring force and k its stiffness.",
    ],
)
def test_matrices_labels_and_words_of_other_hands(written: str) -> None:
    assert accepted(carts(), written)
    twin = (
        written.replace("f = [F", "f = [2*F")
        .replace("= {F;", "= {2 F;")
        .replace("= [1; 0]", "= [2; 0]")
        .replace("= [F; 0]", "= [2*F; 0]")
    )
    twin = twin.replace(r"{pmatrix}F", r"{pmatrix}2F").replace("= F", "= 2 F").replace("u = 2 F", "u = F")
    assert twin != written
    assert not accepted(carts(), twin)


@pytest.mark.parametrize("energy", ["L", "T"])
def test_a_momentum_that_is_also_a_derivative_is_judged(energy: str) -> None:
    written = f"p = ∂{energy}/∂phi' = (J + m R^2) phi'\np' = tau - d phi' - k R^2 phi + m g R"
    verdict = drum().check(written)
    assert verdict.right and [x.line.kind for x in verdict.findings] == ["p", "equation"]
    wrong = drum().check(f"p = ∂{energy}/∂phi' = J phi'\n{RIGHT}")
    assert [x.status.right for x in wrong.findings] == [False, True]


@pytest.mark.parametrize("called", ["ξ₁ = φ", "xi1 = phi", "q = [phi]", "x = [phi, phi']"])
def test_what_coordinates_are_called_needs_no_note(called: str) -> None:
    assert not drum().check(f"{called}\n{RIGHT}").notes
    assert "nothing else uses" in drum().check(f"{called} + 2 phi\n{RIGHT}".replace("] + 2 phi", " + 2 phi]")).to_text()


def _holds(answer: str) -> bool:
    """Whether an answer is right; one that cannot be read is not."""
    try:
        return drum().check(answer, hint=0).right
    except ParseError:
        return False


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", ["Inertia of the load, reduced to φ: ", "The load: ", "Load gives ", ""])
def test_a_name_is_explained_behind_what_it_stands_in(said: str) -> None:
    """m u², u = R: what is mentioned is no part of what is stated, which is judged where it is used."""
    used = f"{said}m u², u = R\n(J + m u²) phi'' + d phi' + k u² phi - m g u = tau"
    assert drum().check(used, hint=0).right
    assert not _holds(used.replace("u = R", "u = 2 R"))
    assert not _holds(used.replace("k u²", "k u"))
    assert not _holds(used.replace("m u², u", "m v², u").replace("m g u", "m g v"))


def test_what_stands_before_a_statement_of_something_else_belongs_to_it() -> None:
    """No name is explained: the comma is left out by mistake, or a term stands behind it."""
    assert not _holds("m R^2 phi'', J phi'' + d phi' + k R^2 phi - m g R = tau")
    assert not _holds("(J + m R^2) phi'' + d phi' + k R^2 phi - m g R, q = tau")


def test_a_force_with_an_arm_is_not_this_arm() -> None:
    """N with the arm s says what N has; A with m g R and the value m g R say what A is."""
    answer = "Moments: only N with the arm R.\nm R phi'' = m g - N - k R phi\nJ phi'' = tau - d phi' + N R"
    assert "was read as R" not in str(drum().check(answer + f"\n{RIGHT}"))
    for words in ("with", "with the value"):
        assert accepted(drum(), f"We use A {words} m g R.\n{RIGHT.replace('m g R', 'A')}")
        assert not accepted(drum(), f"We use A {words} 2 m g R.\n{RIGHT.replace('m g R', 'A')}")
