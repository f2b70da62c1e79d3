"""The line in which an answer says what its own ω, v², d, … are has its verdict: the mistake may stand there."""

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check import lines_of
from lagrangian.check.explain.reasoned import with_bodies
from lagrangian.check.reading import parse_answer
from lagrangian.check.reference import truth_of
from lagrangian.check.verdict import Finding, Mistake, Status
from lagrangian.page.formula import text
from student_answers import CART, POLE, right


@pytest.fixture(scope="module")
def drum() -> lg.Derivation:
    """A cylinder that rolls in a turning drum."""
    s = lg.System("drum")
    psi, phi = s.coordinates("psi phi")
    J, R, r, m, b = s.parameters("J R r m b")
    M = s.inputs("M")
    centre = s.point("C", ((R - r) * sp.sin(phi), -(R - r) * sp.cos(phi)))
    s.rigid_body(m, J, at=s.origin, frame=s.frame(psi, name="drum"), name="drum")
    s.rigid_body(m, m * r**2 / 2, at=centre, frame=s.frame((R * psi - (R - r) * phi) / r, name="roll"), name="roll")
    s.gravity()
    s.damper(b, deflection=psi, name="axle")
    s.torque(M, on=psi, name="motor")
    return s.derive()


@pytest.fixture(scope="module")
def hoist() -> lg.Derivation:
    """A drum that lifts a load by a spring and a damper."""
    s = lg.System("hoist")
    phi, x = s.coordinates("phi x")
    J, R, m, k, b = s.parameters("J R m k b")
    M = s.inputs("M")
    s.rigid_body(m, J, at=s.origin, frame=s.frame(phi, name="drum"), name="drum")
    s.particle(m, at=s.point("Q", (0, x)), name="load")
    s.gravity()
    s.spring(k, deflection=R * phi - x, name="rope")
    s.damper(b, deflection=R * phi - x, name="absorber")
    s.torque(M, on=phi, name="motor")
    return s.derive()


def found(verdict: lg.CheckedAnswer) -> list[tuple[int, bool, bool]]:
    """The number of every line with a verdict, whether it is right, and whether it is wrong because of another."""
    return [(f.line.number, f.status.right, f.follows) for f in verdict.findings]


STANDING = """omega = (R - r) phi'/r
T = J psi'^2/2 + m (R - r)^2 phi'^2/2 + m r^2/2 omega^2/2
V = -m g (R - r) cos(phi)
J psi'' + b psi' = M
3/2 m (R - r)^2 phi'' + m g (R - r) sin(phi) = 0"""


@pytest.mark.slow
def test_a_wrong_angular_velocity_is_the_mistake_and_the_rest_follows(drum: lg.Derivation) -> None:
    verdict = drum.check(STANDING)
    (mistake,) = verdict.mistakes
    assert mistake.name == "turning_of_body" and mistake.element == "rigid body 'roll'"
    assert str(mistake.what) == (
        "Line 1 is not right: the angular velocity of rigid body 'roll' is (-R*psi' + (R - r)*phi')/r, "
        "not (R - r)*phi'/r: the term -R*psi'/r is missing."
    )
    assert found(verdict) == [(1, False, False), (2, False, True), (3, True, False), (4, False, True), (5, False, True)]


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("said", "rows"),
    [
        ("d = phi - x", "J phi'' + b R (R phi' - x') + k R d = M\nm x'' - b (R phi' - x') - k d = -m g"),
        ("d = phi + x", "J phi'' + b R (R phi' - x') + k R d = M\nm x'' - b (R phi' - x') - k d = -m g"),
        ("u = phi' - x'", "J phi'' + b R u + k R (R phi - x) = M\nm x'' - b u - k (R phi - x) = -m g"),
    ],
)
def test_a_wrong_deflection_or_rate_is_named_in_its_line(hoist: lg.Derivation, said: str, rows: str) -> None:
    verdict = hoist.check(f"{said}\n{rows}")
    (mistake,) = verdict.mistakes
    assert str(mistake.what).startswith("Line 1 is not right: the ")
    assert found(verdict) == [(1, False, False), (2, False, True), (3, False, True)]


def test_a_right_definition_is_no_mistake(hoist: lg.Derivation) -> None:
    """The deflection is right, its sign in one equation is not."""
    rows = "J phi'' + b R (R phi' - x') - k R d = M\nm x'' - b (R phi' - x') - k d = -m g"
    verdict = hoist.check(f"d = R phi - x\n{rows}")
    assert not verdict.right and "Line 1" not in str(verdict.mistakes[0].what)


def test_right_definitions_are_said_to_be_right(drum: lg.Derivation) -> None:
    """What a name stands for is found by its value, and told."""
    answer = """v_C = (R - r) phi'
omega = (R psi' - (R - r) phi')/r
J_C = m r^2/2
T = J psi'^2/2 + m v_C^2/2 + J_C omega^2/2"""
    verdict = drum.check(answer)
    assert not [f for f in verdict.findings if not f.status.right]
    assert [str(f.note) for f in verdict.findings[:3]] == [
        "the speed of rigid body 'roll'",
        "the angular velocity of rigid body 'roll'",
        "the moment of inertia of rigid body 'roll'",
    ]
    assert not any("not judged" in str(note) for note in verdict.notes)


def test_names_of_coordinates_and_rates_have_no_verdict(drum: lg.Derivation) -> None:
    """q1 = ψ and c = R − r are neither right nor wrong."""
    verdict = drum.check("q1 = psi\nc = R - r\nx3 = psi'\nV = -m g c cos(phi)")
    assert [f.line.kind for f in verdict.findings] == ["V"]


def test_an_index_says_of_which_body_a_value_is(drum: lg.Derivation) -> None:
    """ψ′ is the angular velocity of the drum: right where the index says so, and without one; not of the roll."""
    for name, judged in (("omega_drum", True), ("omega", True), ("omega_roll", False)):
        verdict = drum.check(f"{name} = psi'\nV = -m g (R - r) cos(phi)")
        assert (verdict.findings[0].line.kind == "definition") is judged, name


PARTS = """T_drum = J psi'^2/2
T_roll = m (R - r)^2 phi'^2/2
V = -m g (R - r) cos(phi)
J psi'' + b psi' = M
m (R - r)^2 phi'' + m g (R - r) sin(phi) = 0"""


@pytest.mark.slow
def test_parts_of_t_are_judged_where_no_t_is_stated(drum: lg.Derivation) -> None:
    verdict = drum.check(PARTS)
    (mistake,) = verdict.mistakes
    assert mistake.name == "kinetic_of_body" and mistake.element == "rigid body 'roll'"
    assert str(mistake.what).startswith("Line 2 is not right: the kinetic energy of rigid body 'roll' is ")
    right = [(1, True, False), (2, False, False), (3, True, False)]
    assert found(verdict) == [*right, (4, False, True), (5, False, True)]
    assert not any("not judged" in str(note) for note in verdict.notes)


def test_a_definition_that_uses_a_wrong_one_follows_from_it(drum: lg.Derivation) -> None:
    """Even where it stands above: T_roll with ω, whose value comes below it."""
    answer = PARTS.replace("\nV", "\nomega = (R - r) phi'/r\nV").replace("T_roll = m", "T_roll = m r^2/4 omega^2 + m")
    verdict = drum.check(answer.replace("m (R - r)^2 phi''", "3/2 m (R - r)^2 phi''"))
    assert [x for x in found(verdict) if not x[1]] == [(2, False, True), *((k, False, k > 3) for k in (3, 5, 6))]
    assert verdict.first_wrong is not None and verdict.first_wrong.line.number == 3
    assert "line 2 not right, but only because of line 3" in " ".join(verdict.to_text().split())
    assert "Line 3 is not right: the angular velocity" in str(verdict.mistakes[0].what)


def test_the_same_slip_in_two_definitions_is_named_in_both(hoist: lg.Derivation) -> None:
    answer = """F_s = k (phi - x)
F_d = b (phi' - x')
J phi'' + R F_s + R F_d = M
m x'' - F_s - F_d = -m g"""
    verdict = hoist.check(answer)
    assert found(verdict) == [(1, False, False), (2, False, False), (3, False, True), (4, False, True)]
    assert [str(m.what).partition(" is ")[2][:19] for m in verdict.mistakes] == ["not right: the force"[:19]] * 2


@pytest.fixture(scope="module")
def crane() -> lg.Derivation:
    """A trolley with a hanging rod."""
    s = lg.System("crane")
    x, phi = s.coordinates("x phi")
    M, m, J, l = s.parameters("M m J l")
    s.particle(M, at=s.point("A", (x, 0)), name="trolley")
    at = s.point("S", (x + l / 2 * sp.sin(phi), -l / 2 * sp.cos(phi)))
    s.rigid_body(m, J, at=at, frame=s.frame(phi, name="rod"), name="rod")
    s.gravity()
    return s.derive()


HANGING = """r_S = (x + l sin(phi), -l cos(phi))
v_S^2 = x'^2 + 2 l x' phi' cos(phi) + l^2 phi'^2
T = M x'^2/2 + m/2 v_S^2 + J phi'^2/2
V = -m g l cos(phi)
(M + m) x'' + m l phi'' cos(phi) - m l phi'^2 sin(phi) = 0
(J + m l^2) phi'' + m l x'' cos(phi) + m g l sin(phi) = 0"""


@pytest.mark.slow
def test_a_wrong_position_as_a_column_is_the_mistake(crane: lg.Derivation) -> None:
    verdict = crane.check(HANGING)
    assert found(verdict) == [(1, False, False), *((k, False, True) for k in range(2, 7))]
    (mistake,) = verdict.mistakes
    assert str(mistake.what) == (
        "Line 1 is not right: the position of rigid body 'rod' is (l*sin(phi)/2 + x, -l*cos(phi)/2), "
        "not (l*sin(phi) + x, -l*cos(phi))."
    )


@pytest.mark.parametrize(
    ("said", "right"),
    [
        ("r_S = (x + l/2 sin(phi), -l/2 cos(phi))", True),
        ("r_S = (x + l/2 sin(phi), l/2 cos(phi) + 3)", True),  # y down, from another height
        ("v_S = (x' + l/2 phi' cos(phi), l/2 phi' sin(phi))", True),
        ("v_S = (x' cos(phi) + l/2 phi', -x' sin(phi))", True),  # along axes that turn with the rod
        ("v_S = (x' cos(phi) + l/2 phi', x' cos(phi))", False),
        ("r_A = (x + l sin(phi), -l cos(phi))", False),
    ],
)
def test_columns_are_right_along_fixed_axes_or_by_their_square(crane: lg.Derivation, said: str, right: bool) -> None:
    """A column that is not right is no mistake by itself."""
    verdict = crane.check(f"{said}\n{HANGING.splitlines()[3].replace('g l', 'g l/2')}")
    assert [f.line.kind == "definition" for f in verdict.findings] == [True, False] if right else [False]
    assert not [f for f in verdict.findings if not f.status.right]


def test_a_name_in_a_right_line_is_defined_rightly(hoist: lg.Derivation) -> None:
    """d = φ − x may be of use elsewhere: then the spring that is stretched by d is the mistake."""
    rows = "J phi'' + b R (R phi' - x') + k R d = M\nm x'' - b (R phi' - x') - k d = -m g"
    verdict = hoist.check(f"d = phi - x\nT = J phi'^2/2 + m (phi' - d')^2/2\n{rows}")
    assert found(verdict) == [(2, True, False), (3, False, False), (4, False, False)]
    assert not any(str(m.what).startswith("Line 1") for m in verdict.mistakes)


def test_a_relation_that_says_the_same_is_not_right_either(drum: lg.Derivation) -> None:
    """r ω = (R − r) φ′ and then ω = …, with every equation twice."""
    rows = "\n".join(STANDING.splitlines()[3:])
    answer = f"r omega = (R - r) phi'\nomega = (R - r) phi'/r\n{rows}\n{rows}"
    verdict = drum.check(answer)
    assert not [k for k, right, _ in found(verdict) if right] and verdict.first_wrong is not None
    assert [k for k, right, follows in found(verdict) if not right and not follows] == [verdict.first_wrong.line.number]
    assert "the angular velocity of rigid body 'roll'" in str(verdict.mistakes[0].what)


def test_a_wrong_rate_of_a_place_is_the_mistake(crane: lg.Derivation) -> None:
    """ẋ_S lacks ẋ: what follows from it is right in itself."""
    answer = """x_S = x + l/2 sin(phi)
x_S' = l/2 phi' cos(phi)
v^2 = l^2/4 phi'^2
T = M x'^2/2 + m/2 v^2 + J phi'^2/2"""
    verdict = crane.check(answer)
    assert found(verdict) == [(1, True, False), (2, False, False), (3, False, True), (4, False, True)]
    assert "the x component of the velocity of rigid body 'rod'" in str(verdict.mistakes[0].what)


def test_the_sense_is_that_of_the_answer(drum: lg.Derivation) -> None:
    """ω of the roll is counted against φ: what is right is told with the sign of what is written."""
    said = STANDING.replace("omega = (R - r) phi'/r", "omega = -(R - r) phi'/r")
    assert "is (R*psi' - (R - r)*phi')/r, not -(R - r)*phi'/r" in str(drum.check(said).mistakes[0].what)


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("m_t = M + m", "the factor of x'' in the equation of x"),
        ("H = (J + m l^2/4) phi' + m l/2 x' cos(phi)", "the generalized momentum of phi"),
        ("m_t = M + 2 m", None),
    ],
)
def test_what_multiplies_an_acceleration_has_its_verdict(crane: lg.Derivation, said: str, told: str | None) -> None:
    row = "m_t x'' + m l/2 phi'' cos(phi) - m l/2 phi'^2 sin(phi) = 0" if "m_t" in said else "V = -m g l/2 cos(phi)"
    verdict = crane.check(f"{said}\n{row}")
    if told is not None:
        assert str(verdict.findings[0].note) == told and verdict.findings[1].status.right
        return
    assert found(verdict) == [(1, False, False), (2, False, True)]
    assert "the factor of x'' in the equation of x is M + m, not M + 2*m" in str(verdict.mistakes[0].what)


@pytest.mark.parametrize("velocity", ["", "Ṗ = (ẋ + l θ̇ cos(θ), -l θ̇ sin(θ))\n"])
@pytest.mark.parametrize(("sign", "is_right"), [("+", True), ("-", False)])
def test_the_square_of_a_dotted_column_is_that_of_its_length(velocity: str, sign: str, is_right: bool) -> None:
    answer = f"P = (x + l sin(θ), l cos(θ))\n{velocity}Ṗ² = ẋ² {sign} 2 l ẋ θ̇ cos(θ) + l² θ̇²"
    assert right(f"{answer}\n{CART}\n{POLE}") == is_right


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("said", "reason"),
    [
        ("J phi'^2/2", "½mv² of rigid body 'rod' is missing."),
        ("m/2 (x'^2 + l^2/4 phi'^2) + J phi'^2/2", "The velocities of rigid body 'rod' were squared one by one"),
        ("m/2 (x'^2 + l x' phi' cos(phi) + l^2/4 phi'^2)", "½Jω² of rigid body 'rod' is missing."),
        ("m/2 (x'^2 + l x' phi' cos(phi) + l^2/4 phi'^2) + J phi'^2", "The ½ of ½Jω² of rigid body 'rod' is missing."),
        ("m/2 (x'^2 + l x' phi' cos(phi) + l^2/4 phi'^2) + J x' phi'", None),
    ],
)
def test_why_the_energy_of_a_body_came_out_wrong(crane: lg.Derivation, said: str, reason: str | None) -> None:
    """The formulas are told as well; a term that nothing explains has no reason."""
    energies = f"T_trolley = M x'^2/2\nT_rod = {said}"
    (mistake,) = crane.check(f"{energies}\nT = T_trolley + T_rod\nV = -m g l/2 cos(phi)").mistakes
    words = str(mistake.what)
    assert words.startswith("Line 2 is not right: the kinetic energy of rigid body 'rod' is ")
    assert (f"A possible reason: {reason}" in words) if reason is not None else ("reason" not in words)


@pytest.fixture(scope="module")
def bar() -> lg.Derivation:
    """A uniform bar that hangs from one end."""
    s = lg.System("bar")
    phi = s.coordinates("phi")
    m, l = s.parameters("m l")
    at = s.point("S", (l / 2 * sp.sin(phi), -l / 2 * sp.cos(phi)))
    s.rigid_body(m, m * l**2 / 12, at=at, frame=s.frame(phi, name="bar"), name="bar")
    s.gravity()
    return s.derive()


@pytest.mark.parametrize(("name", "about_pivot"), [("J_S", False), ("J_G", False), ("J_O", True), ("J", True)])
def test_the_index_of_the_centre_says_about_which_axis_it_is(bar: lg.Derivation, name: str, about_pivot: bool) -> None:
    """J_S = m l²/3 is wrong where ½mv² stands beside it; J_O is right, and what uses it is wrong."""
    verdict = bar.check(f"{name} = m l^2/3\nT = m l^2/8 phi'^2 + {name} phi'^2/2\nV = -m g l/2 cos(phi)")
    assert found(verdict) == [(1, about_pivot, False), (2, False, not about_pivot), (3, True, False)]
    inertia = "Line 1 is not right: the moment of inertia of rigid body 'bar' is l^2*m/12, not l^2*m/3."
    twice = "Rigid body 'bar' has J about its pivot and ½mv² as well."
    assert str(verdict.mistakes[0].what) == (twice if about_pivot else inertia)


@pytest.mark.parametrize("name", ["J_S", "J_O"])
def test_a_moment_of_inertia_that_is_used_rightly_is_not_wrong(bar: lg.Derivation, name: str) -> None:
    assert bar.check(f"{name} = m l^2/3\n{name} phi'' + m g l/2 sin(phi) = 0", hint=0).right


def test_a_wrong_energy_that_nothing_uses_is_told_in_place_of_what_else_would_explain_it(crane: lg.Derivation) -> None:
    truth = truth_of(crane)
    (line,) = (x for x in lines_of(parse_answer("T_rod = m x'^2 + J phi'^2/2", crane.model)) if x.kind == "definition")
    other = [Mistake("lost", text(name), text(""), step, name) for name, step in (("rigid body 'rod'", 2), ("F", 6))]
    first, second = with_bodies(truth, [Finding(line, Status.WRONG)], other)
    assert str(first.what).startswith("Line 1 is not right: the kinetic energy of rigid body 'rod' is ")
    assert second is other[1]
    assert with_bodies(truth, [Finding(line, Status.WRONG)], [first]) == (first,)
    assert with_bodies(truth, [Finding(line, Status.RIGHT)], other) == tuple(other)


def test_of_two_likely_reasons_both_are_told(bar: lg.Derivation) -> None:
    """m l²/4 φ̇² too much is ½mv² without its ½, and J about the pivot beside ½mv²."""
    answer = "T_bar = 7/24 m l^2 phi'^2\nT = T_bar\nV = -m g l/2 cos(phi)"
    words = str(bar.check(answer).mistakes[0].what)
    first, _, second = words.partition(" A possible reason: ")[2].partition(" Or: ")
    assert sorted(["½" in first and "missing" in first, "about its pivot" in second]) == [True, True], words


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "said",
    ["with w0^2 = k/m, 2 D w0 = b/m", "Let 2 D w0 = b/m and m w0^2 = k.", "2 m D w0 = b\nw0 = sqrt(k/m)"],
)
def test_a_product_says_what_the_new_name_in_it_is(said: str) -> None:
    system = lg.System("oscillator")
    x = system.coordinate("x")
    m, k, b = system.parameters("m k b")
    system.kinetic(m * x.diff() ** 2 / 2)
    system.spring(k, deflection=x)
    system.damper(b, deflection=x)
    derivation = system.derive()
    assert derivation.check(f"{said}\nx'' + 2 D w0 x' + w0^2 x = 0", hint=0).right
    assert not derivation.check(f"{said}\nx'' + D w0 x' + w0^2 x = 0", hint=0).right
    assert not derivation.check(f"{said.replace('D w0', 'D')}\nx'' + 2 D w0 x' + w0^2 x = 0", hint=0).right
