"""Answers for systems with constraints: multipliers of any sign and scale, and equations without multipliers."""

from dataclasses import replace

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check import Status, check, lines_of
from lagrangian.check.reading import parse_answer
from lagrangian.page.formula import text


@pytest.fixture(scope="module")
def pendulum() -> lg.Derivation:
    s = lg.System("pendulum in x, y")
    x, y = s.coordinates("x y")
    m, length = s.parameters("m l", m=1.0, l=2.0)
    bob = s.point("P", (x, y))
    s.particle(m, at=bob)
    s.gravity()
    s.constraint(between=(bob, s.origin), distance=length, name="rod")
    return s.derive()


IN_AN_ANGLE = {
    "l*theta'' + g*sin(theta) = 0": "x = l sin θ, y = −l cos θ",
    "x = l*sin(theta)\ny = -l*cos(theta)\nm*l^2*theta'' = -m*g*l*sin(theta)": "x = l sin θ, y = −l cos θ",
    "l*phi'' = -g*cos(phi)": "x = l cos φ, y = l sin φ",
    "l*theta'' = g*sin(theta)": "x = −l sin θ, y = l cos θ",
}
"""Equations in an angle of the rod, by how it is measured: from below, from the side, from above (x may be −x)."""


@pytest.mark.sampled(2)
@pytest.mark.parametrize("answer", IN_AN_ANGLE)
def test_an_answer_may_use_an_angle_of_the_circle(pendulum: lg.Derivation, answer: str) -> None:
    found = pendulum.check(answer)
    assert found.right and f"Read with {IN_AN_ANGLE[answer]}." in str(found)


@pytest.mark.slow
def test_a_force_may_be_stated_in_an_angle_of_the_circle() -> None:
    s = lg.System("pendulum in x, y with a damper")
    x, y = s.coordinates("x y")
    m, length, b = s.parameters("m l b", m=1.0, l=2.0, b=0.3)
    bob = s.point("P", (x, y))
    s.particle(m, at=bob)
    s.gravity()
    s.damper(b, deflection=x)
    s.constraint(between=(bob, s.origin), distance=length, name="rod")
    damped = s.derive()
    answer = "x = l sin(theta)\ny = -l cos(theta)\nQ_x = -b l cos(theta) theta'\n"
    answer += "m l theta'' = -m g sin(theta) - b l cos(theta)^2 theta'"
    assert damped.check(answer, hint=0).right
    assert not damped.check(answer.replace("Q_x = -b", "Q_x = b"), hint=0).right
    assert not damped.check(answer.replace("Q_x = -b l cos", "Q_x = -b l sin"), hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "answer",
    [
        "l*theta'' = -g*theta",
        "2*l*theta'' + g*sin(theta) = 0",
        "x = l*sin(theta)\ny = -l*cos(theta)\nl*theta'' = g*sin(theta)",  # right in another angle than it says
    ],
)
def test_a_wrong_equation_in_an_angle_is_wrong(pendulum: lg.Derivation, answer: str) -> None:
    found = pendulum.check(answer)
    assert found.status is Status.WRONG and "Read with x = l sin θ, y = −l cos θ." in str(found)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["lam", "lmbda", "lambda"])
def test_a_multiplier_needs_no_sign_of_a_product(pendulum: lg.Derivation, name: str) -> None:
    assert pendulum.check(f"m x'' = 2 {name} x\nm y'' + m g = 2 {name} y", hint=0).right
    assert not pendulum.check(f"m x'' = 2 {name} x\nm y'' + m g = {name} y", hint=0).right


@pytest.fixture(scope="module")
def sleigh() -> lg.Derivation:
    s = lg.System("Chaplygin sleigh")
    x, y, theta = s.coordinates("x y theta")
    m, J, a = s.parameters("m J a", m=1.0, J=0.5, a=0.3)
    body = s.frame(theta, origin=s.point("P", (x, y)), name="B")
    s.rigid_body(m, J, at=body.point(a, 0), frame=body, name="sleigh")
    s.velocity_constraint(y.diff() * sp.cos(theta) - x.diff() * sp.sin(theta), name="knife edge")
    return s.derive()


RIGHT = (
    "m*x'' = lambda_rod*x/sqrt(x^2 + y^2)\nm*y'' + m*g = lambda_rod*y/sqrt(x^2 + y^2)",
    "m*x'' = -S*x/l\nm*y'' = -S*y/l - m*g\nx^2 + y^2 = l^2",
    "m*x'' = 2*mu*x\nm*y'' + m*g = 2*mu*y\nx*x'' + y*y'' + x'^2 + y'^2 = 0",
)


@pytest.mark.parametrize("answer", RIGHT)
def test_sign_and_scale_of_a_multiplier_are_free(pendulum: lg.Derivation, answer: str) -> None:
    assert pendulum.check(answer, hint=0).status is Status.RIGHT


def test_the_reading_of_a_multiplier_is_told(pendulum: lg.Derivation) -> None:
    notes = [str(n) for n in pendulum.check(RIGHT[1]).notes]
    assert any("'S' was read as -lambda_rod" in n for n in notes)


def test_below_the_terms_no_note_holds_the_missing_factor(pendulum: lg.Derivation) -> None:
    found = pendulum.check("m*x'' = lambda*x\nm*y'' + m*g = -lambda*y")
    note = text("'lambda' was read as ", sp.Symbol("h") * sp.Symbol("lambda"), ".")
    sign = text("'S' was read as ", -sp.Symbol("lambda"), ".")
    for hint, told in ((1, [str(sign)]), (2, [str(sign)]), (3, [str(note), str(sign)])):
        verdict = replace(found, notes=(note, sign), hint=hint)
        assert not verdict.right and verdict.to_dict()["notes"] == told
        assert ("'lambda' was read as" in verdict.to_text()) == (hint == 3)


def test_below_the_terms_nothing_of_a_wrong_answer_holds_a_formula(pendulum: lg.Derivation) -> None:
    found = pendulum.check("m*x'' = lambda*x\nm*y'' + m*g = -lambda*y")
    first, *others = found.findings
    note, m = text("the equation of x, times ", 1 / sp.Symbol("m")), sp.Symbol("m")
    for hint in (1, 2, 3):
        findings = (replace(first, status=Status.WRONG, note=note), *others)
        verdict = replace(found, findings=findings, change={m: m**2}, combination=((m**2,),), hint=hint)
        data = verdict.to_dict()
        assert [data["change"], data["combination"]] == ([{"m": "m^2"}, [["m^2"]]] if hint == 3 else [{}, None])
        assert (data["lines"][0]["note"] is not None) == ("times 1/m" in verdict.to_text()) == (hint == 3)


@pytest.mark.sampled(12)
@pytest.mark.parametrize("name", ["lambda", "S", "lambda_rod"])
@pytest.mark.parametrize("scale", ["", "-", "2*"])
def test_a_force_that_is_only_a_result_is_judged(pendulum: lg.Derivation, name: str, scale: str) -> None:
    equations = "m*x'' = S*x/l\nm*y'' + m*g = S*y/l\n".replace("S", "S" if name != "S" else "T")
    force = f"{name} = {scale}(m*g*y - m*(x'^2 + y'^2))/l"  # of the equations times x and y, added
    judged = name.startswith("lambda")  # what another letter may be is not known
    assert pendulum.check(equations + force, hint=0).status is Status.RIGHT
    wrong = pendulum.check(equations + force.replace("g*y -", "g*y +"))
    assert wrong.status is (Status.WRONG if judged else Status.RIGHT)
    assert ("is not the force of a constraint" if judged else "was not judged") in wrong.to_text()


WRONG = (
    "m*x'' = S*x/l\nm*y'' + m*g = -S*y/l",
    "m*x'' = S*x/l\nm*y'' - m*g = S*y/l",
    "m*x'' = S*x/l\nm*y'' + m*g = S*y/l\nx^2 + y^2 = l",
    "m*x'' = S*x/l\nm*y'' + m*g = R*y/l",
    "m*x'' = 0\nm*y'' + m*g = 0",
)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("answer", WRONG)
def test_a_wrong_answer_stays_wrong(pendulum: lg.Derivation, answer: str) -> None:
    assert pendulum.check(answer, hint=0).status is Status.WRONG


def test_one_equation_of_two_is_incomplete(pendulum: lg.Derivation) -> None:
    assert pendulum.check("m*x'' = S*x/l", hint=0).status is Status.INCOMPLETE


def test_a_true_combination_is_the_same_motion(pendulum: lg.Derivation) -> None:
    """The multiplier eliminated by hand: x'' y − x y'' = g x."""
    assert pendulum.check("x''*y - x*y'' = g*x", hint=0).status is Status.SAME_MOTION


@pytest.mark.slow
def test_the_equations_without_multipliers_are_right(sleigh: lg.Derivation) -> None:
    right = "(J + m*a^2)*theta'' + a*m*v*theta' = 0\nm*v' - a*m*theta'^2 = 0"
    assert sleigh.check(right, hint=0).status is Status.RIGHT
    scaled = "(J + m*a^2)*theta'' + a*m*v*theta' = 0\nv' = a*theta'^2"
    assert sleigh.check(scaled, hint=0).status is Status.EQUIVALENT
    wrong = sleigh.check("(J + m*a^2)*theta'' + a*m*v*theta' = 0\nm*v' + a*m*theta'^2 = 0")
    assert wrong.status is Status.WRONG
    assert wrong.first_wrong is not None
    assert wrong.first_wrong.line.number == 2
    assert sleigh.check("m*v' - a*m*theta'^2 = 0", hint=0).status is Status.INCOMPLETE


@pytest.mark.slow
def test_a_nonholonomic_row_put_into_the_lagrangian_is_wrong(sleigh: lg.Derivation) -> None:
    """T* = ½ m v² + ½ (J + m a²) θ'² with the row put in gives m v' = 0 and θ'' = 0, which is not the motion."""
    assert sleigh.check("m*v' = 0\n(J + m*a^2)*theta'' = 0", hint=0).status is Status.WRONG


def test_energies_are_judged_as_always(pendulum: lg.Derivation) -> None:
    found = pendulum.check("T = m*(x'^2 + y'^2)/2\nV = m*g*y\n" + RIGHT[1], hint=0)
    assert found.status is Status.RIGHT
    assert pendulum.check("T = m*(x'^2 + y'^2)\nV = m*g*y", hint=0).status is Status.WRONG


@pytest.fixture(scope="module")
def wheel() -> lg.Derivation:
    s = lg.System("wheel on a slope")
    x, phi = s.coordinates("x phi")
    m, J, r, g, alpha = s.parameters("m J r g alpha", m=1.0, J=0.5, r=0.3, g=9.81, alpha=0.2)
    s.kinetic((m * x.diff() ** 2 + J * phi.diff() ** 2) / 2)
    s.potential(-m * g * x * sp.sin(alpha))
    s.velocity_constraint(x.diff() - r * phi.diff(), name="rolling")
    return s.derive()


def judged(derivation: lg.Derivation, written: str) -> Status:
    """The status of an answer, whose mistakes are not sought."""
    return check(derivation, lines_of(parse_answer(written, derivation.model)), explain=False).status


ROLLING = "m x'' - m g sin(alpha) = lambda\nJ phi'' = -r lambda\n"


@pytest.mark.sampled(4)
@pytest.mark.parametrize("integrated", ["x = r phi", "phi - x/r = 0", "x = r (phi - pi/2)"])
def test_a_condition_of_rolling_may_be_integrated(wheel: lg.Derivation, integrated: str) -> None:
    assert wheel.check(ROLLING + integrated, hint=0).right
    assert judged(wheel, ROLLING + integrated.replace("r", "2 r")) is Status.WRONG
    assert judged(wheel, ROLLING.replace("-r", "r") + integrated) is Status.WRONG


@pytest.mark.slow
@pytest.mark.parametrize("sign", ["+", "-"])
def test_a_constraint_in_l_is_judged_as_a_constraint(pendulum: lg.Derivation, sign: str) -> None:
    energy = f"L = m*(x'^2 + y'^2)/2 - m*g*y {sign} lambda*(x^2 + y^2 - l^2)\n"
    equations = f"m*x'' = {sign}2*lambda*x\nm*y'' + m*g = {sign}2*lambda*y\n"
    assert pendulum.check(energy + equations, hint=0).right and pendulum.check(energy, hint=0).right
    for wrong in (energy.replace("- l^2", "- 2*l^2"), energy.replace("m*g*y", "m*g*x")):
        assert judged(pendulum, wrong + equations) is Status.WRONG
    opposite = {"+": "-", "-": "+"}[sign]
    other = equations.replace(f"{sign}2", f"{opposite}2")
    assert judged(pendulum, energy + other) is Status.WRONG
    assert judged(pendulum, energy + equations.splitlines()[0]) is Status.INCOMPLETE


def test_a_position_is_no_integrated_constraint(pendulum: lg.Derivation) -> None:
    assert judged(pendulum, f"{RIGHT[0]}\nx^2 + y^2 = 2*l^2") is Status.WRONG


def test_derivatives_of_an_energy_with_the_constraint_put_in_beside_right_equations() -> None:
    """Nothing is left to explain where all that differs follows from lines above: no special case is looked for."""
    s = lg.System("cylinder on a plank")
    x, y, phi = s.coordinates("x y phi")
    M, m, J, R, k = s.parameters("M m J R k", M=4.0, m=2.0, J=0.01, R=0.1, k=60.0)
    s.particle(M, at=s.point("A", (x, 0)))
    s.rigid_body(m, J, at=s.point("C", (y, R)), frame=s.frame(-phi, name="B"), name="cylinder")
    s.spring(k, deflection=y)
    s.constraint(y - x - R * phi, name="rolling")
    found = s.derive().check(
        "T = 1/2 M x'^2 + 1/2 m (x' + R phi')^2 + 1/2 J phi'^2\nV = 1/2 k (x + R phi)^2\n"
        "d/dt(dL/dx') = M x'' + m (x'' + R phi'')\ndL/dx = -k (x + R phi)\n"
        "d/dt(dL/dphi') = m R (x'' + R phi'') + J phi''\ndL/dphi = -k R (x + R phi)\n"
        "(M + m) x'' + m R phi'' + k (x + R phi) = 0\nm R x'' + (J + m R^2) phi'' + k R (x + R phi) = 0"
    )
    assert (found.right or found.motion) and not found.mistakes


@pytest.mark.sampled(4)
@pytest.mark.parametrize("force", ["J^T lambda", "Jᵀ λ", "J^T*lambda, J q' = 0"])
def test_the_transpose_of_a_matrix_that_is_given_below(pendulum: lg.Derivation, force: str) -> None:
    """J is a list, which is a column; in front of a column it is a row."""
    answer = f"M q'' = F + {force}, q = [x; y]\nM = [m, 0; 0, m]\nF = [0; -m g]\nJ = [2 x, 2 y]"
    assert pendulum.check(answer, hint=0).right
    assert not pendulum.check(answer.replace("-m g", "m g"), hint=0).right
    assert not pendulum.check(answer.replace("2 y", "-2 y"), hint=0).right
    assert "J q'" not in force or not pendulum.check(answer.replace("J q'", "F q'"), hint=0).right
