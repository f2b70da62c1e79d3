"""What is wrong is told by what it means: a prescribed motion, a side of an equation, a relative velocity, an arm."""

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation
from lagrangian.model import time


def words(system: lg.Derivation, answer: str) -> str:
    """What the first explanation of a wrong answer says."""
    verdict = system.check(answer)
    assert not verdict.right and verdict.mistakes, verdict
    return str(verdict.mistakes[0].what)


def everything(system: lg.Derivation, answer: str) -> str:
    """All explanations and second choices of a wrong answer."""
    verdict = system.check(answer)
    assert not verdict.right
    return " ".join(str(m.what) for m in (*verdict.mistakes, *verdict.alternatives))


@pytest.fixture(scope="module")
def drum() -> lg.Derivation:
    """A drum on a rope whose other end moves as prescribed, and a spring."""
    s = lg.System("drum on a rope")
    x = s.coordinates("x")
    m, J, r, k, A, nu = s.parameters("m J r k A nu")
    w = s.define("w", A * sp.sin(nu * time))
    s.rigid_body(mass=m, inertia=J, at=s.point("C", (x, 0)), frame=s.frame((x - w) / r, name="drum"), name="drum")
    s.spring(k, deflection=x + w, name="spring")
    return s.derive()


T = "T = 1/2 m x'^2 + 1/2 J {}/r^2\nV = 1/2 k (x + w)^2\n"
ROW = "(m + J/r^2) x'' {} + k (x + w) = 0"


@pytest.mark.parametrize(
    ("rate", "said"),
    [
        ("x'^2", "the rate w' of the prescribed motion is left out"),
        ("(x' + w')^2", "the rate w' of the prescribed motion has the wrong sign"),
        ("(x' + A nu cos(nu t))^2", "the rate w' of the prescribed motion has the wrong sign"),
    ],
)
def test_the_rate_of_a_prescribed_motion_is_told_and_not_its_letters(drum: lg.Derivation, rate: str, said: str) -> None:
    assert drum.check(T.format("(x' - w')^2") + ROW.format("- J/r^2 w''"), hint=0).right
    told = everything(drum, T.format(rate))
    assert said in told and "nu is left out" not in told and "A has the wrong sign" not in told, told


def test_a_prescribed_motion_that_an_answer_does_not_name_is_told_by_its_formula(drum: lg.Derivation) -> None:
    told = words(drum, "T = 1/2 m x'^2 + 1/2 J x'^2/r^2\nV = 1/2 k (x + A sin(nu t))^2")
    assert "the rate A*nu*cos(nu*t) of the prescribed motion is left out" in told, told


def test_without_energies_nothing_is_said_of_them(drum: lg.Derivation) -> None:
    told = everything(drum, ROW.format(""))
    assert "The term -J*w''/r^2 of the equation of x is missing." in told and "In T*" not in told, told


def test_what_follows_from_a_wrong_rate_of_a_prescribed_motion_is_no_second_mistake(drum: lg.Derivation) -> None:
    wrong = "w'' = A nu^2 sin(nu t)\n" + ROW.format("- J A nu^2 sin(nu t)/r^2")
    verdict = drum.check(wrong)
    assert not verdict.right and len(verdict.mistakes) == 1 and [f.follows for f in verdict.findings] == [False, True]
    verdict = drum.check("w' = A cos(nu t)\nw'' = -A nu sin(nu t)\n" + ROW.format("+ J A nu sin(nu t)/r^2"))
    assert not verdict.right and [f.follows for f in verdict.findings] == [False, True, True]
    verdict = drum.check("w'' = A nu^2 sin(nu t)\n" + ROW.format("- 2 J A nu^2 sin(nu t)/r^2"))
    assert not verdict.right and not any(f.follows for f in verdict.findings)


@pytest.fixture(scope="module")
def sledge() -> lg.Derivation:
    """A cart that pitches, a sledge with an absolute coordinate, a block with a relative one, and a force."""
    s = lg.System("cart with a sledge")
    x, phi, y, w = s.coordinates("x phi y w")
    M, J, m, n, e, k = s.parameters("M J m n e k")
    F = s.input("F")
    rate = [sp.diff(q, time) for q in (x, phi, y, w)]
    s.kinetic(M * rate[0] ** 2 / 2 + J * rate[1] ** 2 / 2, name="cart")
    s.kinetic(m * rate[2] ** 2 / 2, name="sledge")
    s.kinetic(n * (rate[0] + e * rate[1] + rate[3]) ** 2 / 2, name="block")
    s.spring(k, deflection=y - x - e * phi, name="spring")
    s.force(F, deflection=x + e * phi, name="push")
    return s.derive()


ENERGY = "T = {} + 1/2 J phi'^2 + 1/2 m {} + 1/2 n {}"
BLOCK = "(x' + e phi' + w')^2"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("energy", "said"),
    [
        (("1/2 M x'^2", "(y' + x' + e phi')^2", BLOCK), "is added, as if y' were relative to it"),
        (("1/2 M x'^2", "y'^2", "w'^2"), "is not added, as if w' were the whole velocity"),
        (("1/2 (M + m) x'^2", "y'^2", BLOCK), "m of kinetic 'sledge' is counted twice, here with x'"),
    ],
)
def test_a_velocity_is_told_as_relative_or_absolute(sledge: lg.Derivation, energy: tuple[str, ...], said: str) -> None:
    told = words(sledge, ENERGY.format(*energy))
    assert said in told, told


def test_a_force_with_another_arm_and_a_missing_factor_are_told_where_they_stand(sledge: lg.Derivation) -> None:
    rows = """M x'' + n (x'' + e phi'' + w'') - k (y - x - e phi) = {}
J phi'' + n e (x'' + e phi'' + w'') - {} (y - x - e phi) = F e
m y'' + k (y - x - e phi) = 0
x'' + e phi'' + w'' = 0"""
    assert sledge.check(rows.format("F", "k e"), hint=0).right
    told = words(sledge, rows.format("F (1 + e)", "k e"))
    assert "on the right-hand side, the term e*F does not belong there" in told, told
    assert "counts with the factor e + 1 there, not with 1" in told, told
    told = words(sledge, rows.format("F", "k"))
    assert told.startswith("In what spring 'spring' adds to the equation of phi, the factor e is missing."), told
    assert "A possible reason: In ∂/∂phi" in told, told


def test_a_term_that_is_missing_in_a_solved_line_has_the_sign_that_it_has_there() -> None:
    told = words(
        derivation("elastic-pendulum"), "theta'' = -g sin(theta)/r\nr'' = r theta'^2 + g cos(theta) - k (r - L_0)/m"
    )
    assert "on the right-hand side, the term -2*r'*theta'/r of the equation of theta is missing" in told, told


@pytest.mark.parametrize("sign", ["", "-"])
def test_a_derivative_of_the_potential_may_have_a_minus(sledge: lg.Derivation, sign: str) -> None:
    wrong = f"V = 1/2 k (y - x - e phi)^2\n{sign}dV/dphi = {sign}(-k (y - x - e phi))"
    verdict = sledge.check(wrong)
    assert not verdict.right and verdict.findings[1].line.kind == "V-slope" and not verdict.findings[1].status.right
    right = sledge.check(wrong.replace("(-k ", "(-k e "))
    assert all(f.status.right for f in right.findings), right


def test_an_entry_of_a_mass_matrix_stands_on_no_side_of_the_line_that_is_solved() -> None:
    s = lg.System("coupled")
    a, b = s.coordinates("a b")
    J, m, e, k, c = s.parameters("J m e k c")
    s.kinetic(J * sp.diff(a, time) ** 2 / 2 + m * (sp.diff(b, time) + e * sp.diff(a, time)) ** 2 / 2, name="both")
    s.spring(k, deflection=a, name="spring")
    s.spring(c, deflection=b, name="other spring")
    coupled = s.derive()
    program = "% q = [a; b]\nMq = [J + m*e^2, {}*m*e; m*e, m];\nKq = [k, 0; 0, c];\nqdd = Mq\\(-Kq*q);"
    assert coupled.check(program.format("1"), hint=0).right
    told = words(coupled, program.format("-1"))
    assert told == "In line 2, the term -e*m has the wrong sign: it should be e*m."


def test_what_is_known_of_one_equation_is_told_beside_a_term_of_another() -> None:
    s = lg.System("two rollers")
    x, y = s.coordinates("x y")
    m, J, r, M, k, g = s.parameters("m J r M k g")
    s.rigid_body(mass=m, inertia=J, at=s.point("C", (x, 0)), frame=s.frame(x / r, name="roller"), name="roller")
    s.particle(mass=M, at=s.point("L", (0, -y)), name="load")
    s.spring(k, deflection=y - x, name="spring")
    s.gravity((0, -1), g)
    verdict = s.derive().check("m x'' + k (x - y) = 0\nM y'' + k (y - x) = (m + M) g")
    told = [str(x.what) for x in verdict.mistakes]
    assert not verdict.right and len(told) == 2, told
    assert told[0] == "½Jω² of rigid body 'roller' is missing.", told
    assert told[1] == "In line 2, on the right-hand side, the term g*m does not belong there.", told


@pytest.mark.slow
def test_an_energy_follows_from_a_wrong_rate_also_where_the_motion_is_an_angle() -> None:
    s = lg.System("child on a swing")
    theta = s.coordinates("theta")
    M, J, h, A, nu = s.parameters("M J h A nu")
    alpha = s.define("alpha", A * sp.sin(nu * time))
    at = (sp.sin(theta) - h * sp.sin(theta + alpha), -sp.cos(theta) + h * sp.cos(theta + alpha))
    s.rigid_body(mass=M, inertia=J, at=s.point("C", at), frame=s.frame(theta + alpha, name="body"), name="child")
    swing = s.derive()
    answer = """alpha' = {0}
T = 1/2 M theta'^2 + 1/2 (M h^2 + J) (theta' + {0})^2 - M h theta' (theta' + {0}) cos(alpha)"""
    right, wrong = (answer.format(x) for x in ("A nu cos(nu t)", "A cos(nu t)"))
    assert all(f.status.right for f in swing.check(right).findings)
    verdict = swing.check(wrong)
    assert not verdict.right and [f.follows for f in verdict.findings] == [False, True] and len(verdict.mistakes) == 1
    verdict = swing.check(wrong.replace("+ 1/2 (M h^2 + J)", "+ (M h^2 + J)"))
    assert not verdict.right and not any(f.follows for f in verdict.findings)
