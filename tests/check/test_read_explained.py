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
        return derivation.check(written).right
    except ParseError:
        return False


def test_a_name_that_nothing_explains_is_asked_about_and_not_guessed() -> None:
    written = RIGHT.replace("d phi'", "B d rho phi'")
    with pytest.raises(ParseError, match="what is 'B'") as caught:
        drum().check(written)
    assert caught.value.place is not None and caught.value.place.column == written.index("B") + 1


def test_what_is_wrong_without_the_unknown_name_is_wrong() -> None:
    rows = "m1 x1'' + k (x1 - x2) = F\nm2 x2'' + k (x1 - x2) = rho m1"
    assert not carts().check(rows.replace("rho m1", "0").replace("F", "2 F")).right
    with pytest.raises(ParseError, match="what is 'rho'"):
        carts().check(rows)


def test_a_meaning_that_makes_an_equation_right_is_the_meaning() -> None:
    rows = "m1 x1'' + k (x1 - x2) = P\nm2 x2'' + k (x1 - x2) = P"
    assert not carts().check(rows).right


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


@pytest.mark.parametrize(
    "written",
    [
        "% y(1) = phi, y(2) = phi_dot\ndydt = zeros(2,1);\ndydt(1) = y(2);\n"
        "dydt(2) = (tau + m*g*R - k*R^2*y(1) - d*y(2))/(J + m*R^2);",
        "% s = [phi; w]\na = (tau + m*g*R - k*R^2*s(1) - d*s(2))/(J + m*R^2);\nds = [s(2); a];",
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
