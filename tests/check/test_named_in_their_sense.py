"""Explanations that say what was written in its own sense: rates without a turned sign, J about another axis."""

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.model import time


def told(system: lg.Derivation, answer: str) -> str:
    """What an explanation of a wrong answer says went wrong."""
    verdict = system.check(answer)
    assert not verdict.right
    return " And: ".join(str(m.what) for m in verdict.mistakes)


@pytest.fixture(scope="module")
def collar() -> lg.Derivation:
    """A collar on a rod, with a dashpot to a point beside the rod."""
    s = lg.System("collar")
    y = s.coordinate("y")
    m, h, c, g = s.parameters("m h c g")
    s.particle(m, at=s.point("A", (h, -y)), name="collar")
    s.gravity((0, -1), g)
    s.damper(c, deflection=sp.sqrt(h**2 + y**2), name="dashpot")
    return s.derive()


def test_the_rate_of_a_damper_is_told_in_the_sense_of_the_right_one(collar: lg.Derivation) -> None:
    assert collar.check("m y'' + c y^2 y'/(h^2 + y^2) = m g", hint=0).right
    verdict = collar.check("m y'' + c y' = m g")
    (mistake,) = verdict.mistakes
    assert "is taken as y'; it is y*y'/sqrt(h^2 + y^2)" in str(mistake.what), verdict.to_text()
    assert "inner derivative" in str(mistake.why)


@pytest.mark.slow
def test_a_rate_that_is_that_of_a_coordinate_has_no_inner_derivative(vane: lg.Derivation) -> None:
    verdict = vane.check("Q_phi = -d (phi' + Omega)")
    (mistake,) = verdict.mistakes
    assert "is taken as" in str(mistake.what) and "inner derivative" not in str(mistake.why), verdict.to_text()


@pytest.fixture(scope="module")
def vane() -> lg.Derivation:
    """A vane on the rim of a disc that turns steadily."""
    s = lg.System("vane")
    phi = s.coordinate("phi")
    W, R, M, L, k, d = s.parameters("Omega R M L k d")
    out = s.frame(W * time + phi, name="vane")
    x, y = R * sp.cos(W * time), R * sp.sin(W * time)
    centre = s.point("G", (x + L / 2 * sp.cos(W * time + phi), y + L / 2 * sp.sin(W * time + phi)))
    s.rigid_body(mass=M, inertia=M * L**2 / 12, at=centre, frame=out, name="vane")
    s.spring(k, deflection=phi, name="spring")
    s.damper(d, deflection=phi, name="hinge")
    return s.derive()


CARRIED = "T = 1/2 {} (Omega + phi')^2 + 1/2 M R L Omega (Omega + phi') cos(phi) + 1/2 M R^2 Omega^2"


def test_the_moment_of_inertia_about_the_centre_is_no_negative_multiple(vane: lg.Derivation) -> None:
    row = "\n{} phi'' + M L/2 R Omega^2 sin(phi) + k phi + d phi' = 0"
    assert vane.check(CARRIED.format("M L^2/3") + row.format("M L^2/3"), hint=0).right
    words = told(vane, CARRIED.format("M L^2/12") + row.format("M L^2/12"))
    assert (
        words
        == "J of rigid body 'vane' is about its centre of mass: what the swing of that centre adds to J is missing."
    )


@pytest.fixture(scope="module")
def drum() -> lg.Derivation:
    """A drum that rolls with a slug in a slot through its centre."""
    s = lg.System("drum")
    phi, q = s.coordinates("phi s")
    J, R, m, k = s.parameters("J R m k")
    s.rigid_body(mass=m, inertia=J, at=s.point("C", (R * phi, 0)), frame=s.frame(-phi, name="drum"), name="drum")
    s.particle(m, at=s.point("P", (R * phi + q * sp.sin(phi), q * sp.cos(phi))), name="slug")
    s.spring(k, deflection=q, name="spring")
    return s.derive()


ROLLING = (
    "T = 1/2 (J + m R^2) phi'^2 + 1/2 m (R^2 phi'^2 + s'^2 + s^2 phi'^2 + 2 R phi' s' sin(phi)"
    " + 2 R s phi'^2 cos(phi))\n"
    "d/dt dT/dphi' = (J + 2 m R^2 + m s^2 + 2 m R s cos(phi)) phi'' + 2 m s s' phi' {}"
    "+ m R s'' sin(phi) + m R s' phi' cos(phi)"
)


def test_the_factor_that_was_not_differentiated_is_told(drum: lg.Derivation) -> None:
    right = ROLLING.format("+ 2 m R s' phi' cos(phi) - 2 m R s phi'^2 sin(phi) ")
    assert not drum.check(right).mistakes
    words = told(drum, ROLLING.format(""))
    assert "the derivative of the factor 2*m*R*s*cos(phi) is missing: 2*m*R*" in words.replace("R*m", "m*R"), words
    assert "the derivative of the factor" not in told(drum, ROLLING.format("+ 2 m R s' phi' sin(phi) "))


@pytest.fixture(scope="module")
def spreader() -> lg.Derivation:
    """A vane on the rim of a disc that turns steadily, and a block along it."""
    s = lg.System("spreader")
    phi, q = s.coordinates("phi s")
    W, R, M, L, m, k = s.parameters("Omega R M L m k")
    out = s.frame(W * time + phi, name="vane")

    def along(a: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
        x, y = R * sp.cos(W * time), R * sp.sin(W * time)
        return x + a * sp.cos(W * time + phi), y + a * sp.sin(W * time + phi)

    s.rigid_body(mass=M, inertia=M * L**2 / 12, at=s.point("G", along(L / 2)), frame=out, name="vane")
    s.particle(m, at=s.point("P", along(q)), name="block")
    s.spring(k, deflection=q, name="spring")
    return s.derive()


@pytest.mark.slow
def test_what_has_the_wrong_sign_in_one_equation_is_not_left_out_twice(spreader: lg.Derivation) -> None:
    rows = (
        "(M L^2/3 + m s^2) phi'' + 2 m s s' (phi' + Omega) {} (M L/2 + m s) R Omega^2 sin(phi) = 0\n"
        "m s'' - m s (phi' + Omega)^2 {} + k s = 0"
    )
    assert spreader.check(rows.format("+", "- m R Omega^2 cos(phi)"), hint=0).right
    words = told(spreader, rows.format("-", ""))
    assert "has the wrong sign" in words and "of the equation of s is missing" in words, words
    assert "left out" not in words and words.count("missing") == 1, words


@pytest.fixture(scope="module")
def hung() -> lg.Derivation:
    """A weight on a spring, whose support slides up a slope as prescribed."""
    s = lg.System("hung")
    r, th = s.coordinates("r th")
    m, k, A, W, b, g = s.parameters("m k A Omega beta g")
    u = A * sp.sin(W * time)
    s.particle(m, at=s.point("P", (u * sp.cos(b) + r * sp.sin(th), u * sp.sin(b) - r * sp.cos(th))), name="weight")
    s.spring(k, deflection=r, name="spring")
    s.gravity((0, -1), g)
    return s.derive()


@pytest.mark.slow
def test_another_angle_is_told_as_that_and_not_as_a_piece_that_nobody_wrote(hung: lg.Derivation) -> None:
    energy = "u = A sin(Omega t)\nT = m/2 (u'^2 + r'^2 + r^2 th'^2 + 2 u' r' sin({0}) + 2 u' r th' cos({0}))"
    assert not hung.check(energy.format("th - beta")).mistakes
    assert told(hung, energy.format("th + beta")).endswith("the angle beta + th stands in place of -beta + th.")
    turned = energy.replace("+ 2 u' r' sin", "- 2 u' r' sin").format("th - beta")
    assert "the angle" not in told(hung, turned)


@pytest.fixture(scope="module")
def tumbler() -> lg.Derivation:
    """A cylinder that rolls in a drum, which turns on its own axle."""
    s = lg.System("tumbler")
    psi, phi = s.coordinates("psi phi")
    J, m, R, r, c, g = s.parameters("J m R r c g")
    centre = s.point("roller", ((R - r) * sp.sin(phi), -(R - r) * sp.cos(phi)))
    turned = s.frame((R * psi - (R - r) * phi) / r, name="roller")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=s.frame(psi, name="drum"), name="drum")
    s.rigid_body(mass=m, inertia=m * r**2 / 2, at=centre, frame=turned, name="roller")
    s.gravity((0, -1), g)
    s.damper(c, deflection=psi, name="axle")
    return s.derive()


def test_what_stands_whole_in_an_equation_does_not_count_half(tumbler: lg.Derivation) -> None:
    rows = (
        "(J + m R^2/2) psi'' - m R (R - r)/2 phi'' = {0} c psi'\n"
        "{1} m (R - r)^2 phi'' - m R (R - r)/2 psi'' + m g (R - r) sin(phi) = 0"
    )
    assert tumbler.check(rows.format("-", "3/2"), hint=0).right
    words = told(tumbler, rows.format("+", ""))
    assert "counts half" not in words and "should be 3*m*(R - r)^2*phi''/2" in words, words


def test_sine_and_cosine_exchanged_in_both_components_of_a_weight_are_one_mistake(hung: lg.Derivation) -> None:
    rows = (
        "m r'' - m A Omega^2 sin(Omega t) sin(th - beta) - m r th'^2 + {0} - m g {1} = 0\n"
        "m r^2 th'' + 2 m r r' th' - m A Omega^2 r sin(Omega t) cos(th - beta) + m g r {2} = 0"
    )
    assert hung.check(rows.format("k r", "cos(th)", "sin(th)"), hint=0).right
    words = told(hung, rows.format("k r", "sin(th)", "cos(th)"))
    assert words == "Sine and cosine are exchanged in the components of the weight of particle 'weight'."
    words = told(hung, rows.format("2 k r", "sin(th)", "cos(th)"))
    assert "the components of the weight" in words and "wrong sign" not in words, words


def test_what_follows_from_a_wrong_derivative_of_an_own_motion_is_told_there(hung: lg.Derivation) -> None:
    rows = (
        "m r'' + m {0} sin(th - beta) - m r th'^2 + k r - m g cos(th) = 0\n"
        "m r^2 th'' + 2 m r r' th' + m r {0} cos(th - beta) + m g r sin(th) = 0\n"
    )
    answer = "u = A sin(Omega t)\nu' = A Omega cos(Omega t)\nu'' = {0}\n" + rows.format("u''") + rows.format("({0})")
    assert hung.check(answer.format("-A Omega^2 sin(Omega t)"), hint=0).right
    verdict = hung.check(answer.format("-A Omega sin(Omega t)"))
    assert not verdict.right
    assert [(f.line.number, f.follows) for f in verdict.findings if not f.status.right] == [
        (3, False),
        (6, True),
        (7, True),
    ]
    (mistake,) = verdict.mistakes
    assert str(mistake.what).startswith("In line 3, the derivative of u is "), verdict.to_text()
    assert not hung.check(rows.format("(-A Omega sin(Omega t))")).right
    both = told(hung, answer.format("-A Omega sin(Omega t)").replace("k r", "2 k r"))
    assert both.count(" And: ") == 1 and "factor Omega" not in both, both


@pytest.fixture(scope="module")
def sash() -> lg.Derivation:
    """A collar on a rod, with a rope over a pulley beside it to a weight."""
    s = lg.System("sash")
    y = s.coordinate("y")
    m, M, h, g, L = s.parameters("m M h g L")
    s.particle(m, at=s.point("A", (h, -y)), name="collar")
    s.particle(M, at=s.point("B", (0, sp.sqrt(h**2 + y**2) - L)), name="weight")
    s.gravity((0, -1), g)
    return s.derive()


def test_a_wrong_height_is_one_term_in_place_of_another_whatever_heights_are_counted_from(sash: lg.Derivation) -> None:
    energy = "V = -m g y + M g {}"
    for level in ("", " - M g L"):
        assert not sash.check(energy.format("sqrt(h^2 + y^2)") + level).mistakes
        verdict = sash.check(energy.format("y") + level)
        (mistake,) = verdict.mistakes
        assert str(mistake.what) == "The term M*g*y stands where M*g*sqrt(h^2 + y^2) belongs.", verdict.to_text()
        assert "height" in str(mistake.why)


def test_the_term_of_a_denominator_is_told_as_one_of_it(sash: lg.Derivation) -> None:
    solved = "l = sqrt(h^2 + y^2)\ny'' = (m g - M g y/l - M h^2 y y'^2/l^4)/({})"
    assert sash.check(solved.format("m + M y^2/l^2"), hint=0).right
    words = told(sash, solved.format("m + M y/l"))
    assert words == "In the denominator of the equation of y: the term M*y/l stands where M*y^2/l^2 belongs."
    assert "denominator" not in told(sash, solved.replace("M g y/l", "M g").format("m + M y^2/l^2"))


def test_where_no_rate_of_a_prescribed_motion_is_written_none_is_called_wrong(hung: lg.Derivation) -> None:
    rows = (
        "m r'' {0} m A Omega^2 sin(Omega t) sin(th - beta) - m r th'^2 + k r - m g cos(th) = 0\n"
        "m r^2 th'' + 2 m r r' th' {0} m A Omega^2 r sin(Omega t) cos(th - beta) + m g r sin(th) = 0"
    )
    verdict = hung.check(rows.format("+"))
    (mistake,) = verdict.mistakes
    assert str(mistake.what) == "What the prescribed motion adds to the equations has the wrong sign."
    assert "second derivative" in str(mistake.why)


def test_a_whole_factor_is_missing_and_no_letter_of_it_left_out() -> None:
    """A roller in a round gutter turns by (R − r)/r for each unit of φ, by hand; ratios that keep a letter are sums."""
    s = lg.System("roller")
    phi = s.coordinate("phi")
    m, J, R, r, b, g = s.parameters("m J R r b g")
    turn = (R - r) / r * phi.diff(time)
    s.kinetic(m * (R - r) ** 2 * phi.diff(time) ** 2 / 2, name="centre")
    s.kinetic(J * turn**2 / 2, name="turning")
    s.potential(-m * g * (R - r) * sp.cos(phi), name="weight")
    s.damper(b, deflection=(R - r) / r * phi, name="drag")
    roller = s.derive()
    right = "m (R - r)^2 phi'' + J (R - r)^2/r^2 phi'' + m g (R - r) sin(phi) = -b (R - r)^2/r^2 phi'"
    assert roller.check(right).right
    for lost in ("J (R - r)^2/r^2", "b (R - r)^2/r^2"):
        said = told(roller, right.replace(lost, lost[0]))
        assert "the factor (R - r)^2/r^2 is missing" in said.replace("(-R + r)", "(R - r)"), said
    said = told(roller, right.replace("m g (R - r)", "m g R"))
    assert "the factor" not in said, said


def test_a_rate_in_a_sum_is_left_out_and_no_factor() -> None:
    s = lg.System("two discs")
    theta, psi = s.coordinates("theta psi")
    I, J, k = s.parameters("I J k")
    s.kinetic(I * theta.diff(time) ** 2 / 2, name="first")
    s.kinetic(J * (theta.diff(time) + psi.diff(time)) ** 2 / 2, name="second")
    s.spring(k, deflection=psi, name="shaft")
    discs = s.derive()
    assert discs.check("I theta'' + J (theta'' + psi'') = 0\nJ (theta'' + psi'') + k psi = 0").right
    said = told(discs, "I theta'' = 0\nJ psi'' + k psi = 0")
    assert "factor" not in said and ("theta' is left out" in said or "in place of psi' + theta'" in said), said
