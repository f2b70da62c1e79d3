"""Mistakes in equations with multipliers: named, and never hidden in a multiplier that takes them up."""

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check import Status

RADIAL = "m*r'' - m*r*theta'^2 + m*g*cos(theta) = F*sin(theta) + lambda"
TANGENT = "m*r^2*theta'' + 2*m*r*r'*theta' - m*g*r*sin(theta) = F*r*cos(theta) - c*theta'"


@pytest.fixture(scope="module")
def puck() -> lg.Derivation:
    """A puck on a smooth cylinder, in polar coordinates; the contact force is the multiplier of r = a."""
    s = lg.System("puck on a cylinder")
    r, theta = s.coordinates("r theta")
    m, a, c, F = *s.parameters("m a c"), s.inputs("F")
    at = s.point("P", (r * sp.sin(theta), r * sp.cos(theta)))
    s.particle(m, at=at, name="puck")
    s.gravity()
    s.force((F, 0), at=at, name="wind")
    s.damper(c, deflection=theta, name="friction")
    s.constraint(r - a, name="contact")
    return s.derive()


def test_the_right_equations_are_right_with_any_sign_and_scale(puck: lg.Derivation) -> None:
    assert puck.check(f"{RADIAL}\n{TANGENT}", hint=0).right
    assert puck.check(f"{RADIAL.replace('+ lambda', '- 2*N')}\n{TANGENT}", hint=0).right
    assert puck.check(
        f"{RADIAL}\n{TANGENT}".replace("r*r'*theta'", "r*0*theta'"), hint=0
    ).right  # r' = 0 on the cylinder


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "row", [("*theta'^2", "*theta'"), (" - m*r*theta'^2", ""), ("F*sin", "F*cos"), ("+ m*g*", "- m*g*")]
)
def test_a_multiplier_takes_up_no_mistake(puck: lg.Derivation, row: tuple[str, str]) -> None:
    verdict = puck.check(f"{RADIAL.replace(*row)}\n{TANGENT}")
    assert verdict.status is Status.WRONG
    assert [f.status.right for f in verdict.findings] == [False, True]
    assert verdict.mistakes and verdict.mistakes[0].coordinate in ("r", None)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong", "kinds", "element"),
    [
        ("- c*theta'", "", {"element_forgotten"}, "damper 'friction'"),
        ("- m*g*r", "+ m*g*r", {"wrong_sign", "gravity_sign"}, "gravity 'g'"),
        ("F*r*cos", "F*cos", {"lost_in_a_sum", "no_arm", "force_arm"}, "force 'wind'"),
    ],
)
def test_mistakes_beside_a_multiplier_are_named(
    puck: lg.Derivation, right: str, wrong: str, kinds: set[str], element: str | None
) -> None:
    for name in ("lambda", "N"):
        verdict = puck.check(f"{RADIAL.replace('lambda', name)}\n{TANGENT.replace(right, wrong)}")
        (mistake,) = verdict.mistakes
        assert mistake.name in kinds and mistake.element == element, str(mistake.what)
        assert verdict.first_wrong is not None and verdict.first_wrong.line.number == 2


def test_a_multiplier_in_an_equation_where_the_constraint_does_no_work(puck: lg.Derivation) -> None:
    (mistake,) = puck.check(f"{RADIAL}\n{TANGENT} + lambda").mistakes
    assert mistake.name == "term_too_much" and mistake.coordinate == "theta"


# -- a multiplier of the answer's own scale, and where it stands wrong -----------------------------------------------

ALONG = "(m1 + m3/4)*x'' + c*x' = F + 2*N*x"
UP = "(m2 + m3/4)*y'' + (m2 + m3/2)*g + k*y = 2*N*y"


@pytest.fixture(scope="module")
def trammel() -> lg.Derivation:
    """Two sliders on crossing rails, joined by a rod with a mass in its middle; λ is the force in the rod."""
    s = lg.System("trammel")
    x, y = s.coordinates("x y")
    m1, m2, m3, d, k, c = s.parameters("m1 m2 m3 d k c")
    F = s.inputs("F")
    a, b = s.point("A", (x, 0)), s.point("B", (0, y))
    s.particle(m1, at=a, name="slider A")
    s.particle(m2, at=b, name="slider B")
    s.particle(m3, at=s.point("C", (x / 2, y / 2)), name="pen")
    s.gravity()
    s.spring(k, deflection=y, name="spring")
    s.damper(c, deflection=x, name="rail")
    s.force((F, 0), at=a, name="push")
    s.constraint(between=(a, b), distance=d, name="rod")
    return s.derive()


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("right", "wrong", "kind", "element"),
    [
        (" + c*x'", "", "element_forgotten", "damper 'rail'"),
        ("m3/2)*g", "m3)*g", "element_twice", "gravity 'g'"),
        ("= 2*N*y", "= -2*N*y", "multiplier_sign", "constraint 'rod'"),
        ("= 2*N*y", "= 0", "multiplier_missing", "constraint 'rod'"),
        ("= 2*N*y", "= 2*N*x", "multiplier_factor", "constraint 'rod'"),
        ("x^2 + y^2 = d^2", "x + y = d", "constraint_wrong", "constraint 'rod'"),
    ],
)
def test_mistakes_beside_a_multiplier_of_another_scale(
    trammel: lg.Derivation, right: str, wrong: str, kind: str, element: str
) -> None:
    """The factors of λ are ∂f/∂x : ∂f/∂y = x : y, whatever the scale of f."""
    answer = f"{ALONG}\n{UP}\nx^2 + y^2 = d^2"
    assert trammel.check(answer, hint=0).right
    (mistake,) = trammel.check(answer.replace(right, wrong)).mistakes
    assert (mistake.name, mistake.element) == (kind, element), str(mistake.what)


def test_the_constraint_that_an_answer_states_tells_which_factor_is_wrong(trammel: lg.Derivation) -> None:
    verdict = trammel.check(f"{ALONG.replace('N*x', 'N*y')}\n{UP}\nx^2 + y^2 = d^2")
    assert [f.status.right for f in verdict.findings] == [False, True, True]
    (mistake,) = verdict.mistakes
    assert mistake.coordinate == "x" and "factor 2*y in the equation of x; to fit the others, 2*x" in str(mistake.what)


def test_equations_with_a_multiplier_follow_from_a_wrong_energy(trammel: lg.Derivation) -> None:
    T = "T = 1/2*m1*x'^2 + 1/2*m2*y'^2 + 1/2*m3*(x'^2 + y'^2)"
    verdict = trammel.check(f"{T}\n{ALONG}\n{UP}".replace("m3/4", "m3"))
    (mistake,) = verdict.mistakes
    assert mistake.element == "particle 'pen'" and mistake.step == 2
    assert [f.follows for f in verdict.findings] == [False, True, True]


def test_mistakes_in_an_equation_without_its_multiplier(trammel: lg.Derivation) -> None:
    """x·(second) − y·(first) holds no λ; the sum of both does."""
    first, second = (f"({a}) - ({b})" for a, b in (row.split(" = ") for row in (ALONG, UP)))
    without = f"x*({second}) - y*({first}) = 0\nx^2 + y^2 = d^2".replace(" + 2*N*x", "").replace("2*N*y", "0")
    assert trammel.check(without, hint=0).right
    (mistake,) = trammel.check(without.replace(" - y*(", " + y*(")).mistakes
    assert mistake.name == "elimination"
    (mistake,) = trammel.check(without.replace("k*y", "2*k*y")).mistakes
    assert mistake.element == "spring 'spring'"


@pytest.fixture(scope="module")
def trolley() -> lg.Derivation:
    """A load on a rod of length l below a trolley, in the coordinates s of the trolley and x, y of the load."""
    system = lg.System("load below a trolley")
    s, x, y = system.coordinates("s x y")
    M, m, l, k = system.parameters("M m l k")
    system.particle(M, at=system.origin + (s, 0), name="trolley")
    system.particle(m, at=system.origin + (x, y), name="load")
    system.gravity()
    system.spring(k, deflection=s)
    system.constraint((x - s) ** 2 + y**2 - l**2, name="rod")
    return system.derive()


@pytest.mark.slow
def test_a_wrong_constraint_is_one_mistake_with_the_factors_that_follow(trolley: lg.Derivation) -> None:
    rows = "M*s'' + k*s = 0\nm*x'' = 2*lambda*x\nm*y'' = 2*lambda*y - m*g"
    verdict = trolley.check(f"x^2 + y^2 = l^2\n{rows}")
    (mistake,) = verdict.mistakes
    assert mistake.name == "constraint_wrong" and "s is left out. The factors" in str(mistake.what)
    assert [f.follows for f in verdict.findings if not f.status.right] in ([False, True], [False, True, True])


@pytest.mark.slow
def test_a_multiplier_with_another_factor_in_one_equation_is_one_mistake(trolley: lg.Derivation) -> None:
    rows = "M*s'' + k*s = -2*lambda*(x-s)\nm*x'' = lambda*(x-s)\nm*y'' = 2*lambda*y - m*g"
    (mistake,) = trolley.check(rows).mistakes
    assert mistake.name == "multiplier_factor" and mistake.coordinate == "x"


# -- lines that state a constraint or a derivative of it -------------------------------------------------------------


@pytest.fixture(scope="module")
def bob() -> lg.Derivation:
    """A bob on a string of length l, in the coordinates of the plane."""
    s = lg.System("bob on a string")
    x, y = s.coordinates("x y")
    m, l = s.parameters("m l")
    s.particle(m, at=s.origin + (x, y), name="bob")
    s.gravity()
    s.constraint(x**2 + y**2 - l**2, name="string")
    return s.derive()


ROWS = "m x'' = 2 lambda x\nm y'' = 2 lambda y - m g\n"


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("line", "kind", "said"),
    [
        ("x x'' + y y'' = 0", "constraint_acceleration_wrong", "with products of rates, x'^2 + y'^2, are missing"),
        ("2 x x'' + 2 y y'' + 2 x'^2 = 0", "constraint_acceleration_wrong", "the term 2*y'^2 is missing"),
        ("x x'' + y y'' - x'^2 - y'^2 = 0", "constraint_acceleration_wrong", "have the wrong sign"),
        ("x x' - y y' = 0", "constraint_rate_wrong", "the term -y*y' has the wrong sign"),
        ("x^2 + y^2 = l", "constraint_wrong", "in the term l, the factor l is missing"),
    ],
)
def test_a_slip_in_a_constraint_or_its_derivative(bob: lg.Derivation, line: str, kind: str, said: str) -> None:
    verdict = bob.check(ROWS + line)
    (mistake,) = verdict.mistakes
    assert mistake.name == kind and said in str(mistake.what), str(mistake.what)
    assert [f.status.right for f in verdict.findings] == [True, True, False]


def test_what_follows_from_a_wrong_constraint_is_no_mistake(bob: lg.Derivation) -> None:
    rows = ROWS.replace("2 lambda y", "-2 lambda y")
    verdict = bob.check(rows + "x^2 - y^2 = l^2\nx x'' - y y'' + x'^2 - y'^2 = 0")
    (mistake,) = verdict.mistakes
    assert mistake.name == "constraint_wrong" and "follow from it" in str(mistake.what)
    assert [f.follows for f in verdict.findings] == [False, False, False, True]


def test_a_multiplier_is_read_with_the_signs_that_most_equations_agree_on(trolley: lg.Derivation) -> None:
    verdict = trolley.check("M*s'' + k*s = -S*(x - s)/l\nm*x'' = -S*(x - s)/l\nm*y'' = -m*g - S*y")
    assert [f.status.right for f in verdict.findings] == [False, True, False]
    assert [(m.name, m.coordinate) for m in verdict.mistakes] == [("multiplier_sign", "s"), ("multiplier_factor", "y")]
    assert str(verdict.mistakes[1].what).endswith("y/l belongs there.")


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["la", "La", "lam"])
def test_a_short_name_between_a_number_and_a_sum_is_a_factor(trolley: lg.Derivation, name: str) -> None:
    """That la is an article in French does not cut the equation."""
    rows = f"M s'' + k s = -2 {name} (x - s)\nm x'' = 2 {name} (x - s)\nm y'' = 2 {name} y - m g"
    assert trolley.check(rows, hint=0).right
    assert not trolley.check(rows.replace(f"= 2 {name} (x - s)", f"= 2 {name} (x + s)"), hint=0).right


def test_equations_that_stand_there_twice_are_no_other_ones(bob: lg.Derivation) -> None:
    rows = ROWS.replace("2 lambda y", "-2 lambda y")
    verdict = bob.check(f"x^2 - y^2 = l^2\nd/dt(m x') = 2 lambda x\nd/dt(m y') + m g = -2 lambda y\n\ni.e.\n{rows}")
    (mistake,) = verdict.mistakes
    assert mistake.name == "constraint_wrong" and "follow from it" in str(mistake.what)
    assert [f.status.right for f in verdict.findings] == [False, True, False, True, False]
    assert all(f.follows for f in verdict.findings[1:] if not f.status.right)


# -- the special case in which what nothing explains would be right --------------------------------------------------

ON_CIRCLE = "x = l sin theta\ny = -l cos theta\n"
FORCE = "lambda = -m/(2 l^2)*(g l cos theta + l^2 theta'^2)"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ("theta'' = -g/l sin theta\n" + FORCE.replace(" + l^2 theta'^2", ""), "at rest, but not in motion"),
        ("theta'' = -g/l sin theta\n" + FORCE.replace("cos theta +", "cos theta -"), "Line 4 holds at rest"),
        (
            "m l theta'' cos theta = 2 lambda l sin theta\nm l theta'' sin theta = -m g - 2 lambda l cos theta",
            "The equations hold at rest",  # without the squares of the rates
        ),
    ],
)
def test_what_nothing_explains_is_told_by_the_case_in_which_it_holds(
    bob: lg.Derivation, answer: str, said: str
) -> None:
    assert bob.check(ON_CIRCLE + "theta'' = -g/l sin theta\n" + FORCE, hint=0).right
    (mistake,) = bob.check(ON_CIRCLE + answer).mistakes
    assert mistake.name == "special_case" and said in str(mistake.what), str(mistake.what)


@pytest.mark.slow
def test_slopes_by_an_angle_of_the_answer_are_not_judged(bob: lg.Derivation) -> None:
    slopes = "T = m l^2 theta'^2/2\ndL/dtheta' = m l^2 theta'\n"
    assert bob.check(ON_CIRCLE + slopes + "theta'' = -g/l sin theta\n" + FORCE, hint=0).right
    assert not bob.check(ON_CIRCLE + slopes + "theta'' = g/l sin theta\n" + FORCE, hint=0).right


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ("theta'' = -g/l cos theta\n" + FORCE, "Sine and cosine are exchanged in the weight of particle 'bob'."),
        (
            "T = m l^2 theta'^2\nV = -m g l cos theta\n2 m l^2 theta'' + m g l sin theta = 0",
            "The ½ is missing in every kinetic energy.",
        ),
    ],
)
def test_mistakes_in_an_angle_of_the_answer_are_those_of_a_system_without_constraints(
    bob: lg.Derivation, answer: str, said: str
) -> None:
    verdict = bob.check(ON_CIRCLE + answer)
    (mistake,) = verdict.mistakes
    assert said in str(mistake.what), str(mistake.what)
    assert "Read with x = l sin θ, y = −l cos θ." in str(verdict)


@pytest.mark.slow
def test_a_factor_of_a_multiplier_may_have_another_form() -> None:
    s = lg.System("slotted lever")
    theta, x = s.coordinates("theta x")
    J, m, h, k = s.parameters("J m h k")
    s.kinetic((J * theta.diff() ** 2 + m * x.diff() ** 2) / 2)
    s.potential(k * x**2 / 2)
    s.constraint(x - h * sp.tan(theta), name="slot")
    lever, carriage = "J*theta'' = -N*h/cos(theta)^2", "m*x'' + k*x = N"
    assert s.derive().check(f"{lever}\n{carriage}", hint=0).right
    verdict = s.derive().check(f"{lever}\n{carriage.replace('+ k', '- k')}")
    assert [f.status.right for f in verdict.findings] == [True, False]
    assert not any(mistake.name.startswith("multiplier") for mistake in verdict.mistakes)
    verdict = s.derive().check(f"{lever.replace('h/cos', '2*h/cos')}\n{carriage}")
    assert [mistake.name for mistake in verdict.mistakes] == ["multiplier_factor"]
