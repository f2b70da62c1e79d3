"""Slips on the way from a right equation to its acceleration are told by what stands in the answer.

Oracle: by hand. A bead m slides on a spoke that turns with φ and carries a rotor J; a spring k pulls it in, the spoke
has the damper c and the torque τ:

    (J + m s²) φ̈ + 2 m s ṡ φ̇ + c φ̇ + m g s cos φ = τ,     m s̈ − m s φ̇² + k s + m g sin φ = 0

and a crank with the mass m at the length l, whose slotted bar M moves along x = l cos φ:

    (m l² + M l² sin²φ) φ̈ + M l² sin φ cos φ φ̇² + c φ̇ = τ
"""

from __future__ import annotations

from functools import cache

import pytest
from sympy import cos, sin

from lagrangian import Derivation, System


@cache
def spoke() -> Derivation:
    """A bead on a spoke that turns."""
    sys = System("spoke")
    phi, s = sys.coordinates("phi s")
    J, m, k, c, g = sys.parameters("J m k c g")
    tau = sys.inputs("tau")
    turned = sys.frame(phi, name="spoke")
    sys.rigid_body(0, J, at=sys.origin, frame=turned, name="rotor")
    sys.particle(m, at=turned.point(s, 0), name="bead")
    sys.spring(k, deflection=s)
    sys.damper(c, deflection=phi, name="bearing")
    sys.gravity((0, -1), g)
    sys.torque(tau, on=phi, name="motor")
    return sys.derive()


@cache
def yoke() -> Derivation:
    """A crank that moves a slotted bar."""
    sys = System("yoke")
    phi = sys.coordinates("phi")
    m, M, l, c = sys.parameters("m M l c")
    tau = sys.inputs("tau")
    sys.rigid_body(0, m * l**2, at=sys.origin, frame=sys.frame(phi, name="crank"), name="crank")
    sys.particle(M, at=sys.point("B", (l * cos(phi), 0)), name="bar")
    sys.damper(c, deflection=phi, name="bearing")
    sys.torque(tau, on=phi, name="motor")
    return sys.derive()


SPOKE = """(J + m s^2) phi'' + 2 m s s' phi' + c phi' + m g s cos(phi) = tau
m s'' - m s phi'^2 + k s + m g sin(phi) = 0
phi'' = """


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("solved", "told"),
    [
        (
            "(tau - c phi')/(J + m s^2) - 2 s' phi'/s - g cos(phi)/s",
            "divided by J + m*s^2, but the terms g*m*s*cos(phi) + 2*m*s*phi'*s' only by m*s^2.",
        ),
        (
            "(tau - c phi' - 2 m s s' phi' - m g s cos(phi))/J",
            None,
        ),
        (
            "(tau - m g s cos(phi) - 2 m s s' phi')/(J + m s^2) - c phi'/J",
            "divided by J + m*s^2, but the term c*phi' only by J.",
        ),
    ],
)
def test_terms_that_were_divided_by_a_part_of_the_inertia(solved: str, told: str | None) -> None:
    verdict = spoke().check(SPOKE + solved)
    assert not verdict.right
    words = [str(m.what) for m in verdict.mistakes]
    assert [w.endswith(told) for w in words] == [True] if told else not any("divided" in w for w in words), words


YOKE = """I phi'' + M l^2 sin(phi) cos(phi) phi'^2 + c phi' = tau  with  I = l^2 (m + M sin(phi)^2)
phi'' = (tau - c phi' {} M l^2 sin(phi) cos(phi) phi'^2)/I"""


def test_a_wrong_sign_in_a_numerator_is_quoted_as_it_was_written() -> None:
    assert yoke().check(YOKE.format("-")).right
    verdict = yoke().check(YOKE.format("+"))
    assert [str(m.what) for m in verdict.mistakes] == [
        "In the numerator of phi'': the term M*l^2*sin(phi)*cos(phi)*phi'^2 has the wrong sign."
    ]


@pytest.mark.slow
def test_a_slip_in_a_bracket_that_was_put_in_is_told_by_its_term() -> None:
    """Oracle: by hand, φ̈ from the second equation in the first one; its inertia has two masses."""
    s = System("cart with two bobs")
    x, phi = s.coordinates("x phi")
    M, m, J, l, k, c = s.parameters("M m J l k c")
    s.particle(M, at=s.point("C", (x, 0)), name="cart")
    s.particle(m, at=s.point("B", (x + l * sin(phi), -l * cos(phi))), name="bob")
    s.kinetic(J * phi.diff() ** 2 / 2, name="rod")
    s.spring(k, deflection=x, name="spring")
    s.spring(c, deflection=phi, name="torsion spring")
    s.torque(s.input("Q"), on=phi, name="motor")
    above = (
        "I = J + m l^2\n(M + m) x'' + m l phi'' cos(phi) - m l phi'^2 sin(phi) + k x = 0\n"
        "I phi'' + m l x'' cos(phi) + c phi = Q\n"
    )
    solved = "(M + m - m^2 l^2 cos(phi)^2/I) x'' = m l phi'^2 sin(phi) - k x - (m l cos(phi)/I) [Q - c phi]"
    assert s.derive().check(above + solved).right
    verdict = s.derive().check(above + solved.replace("- c phi]", "+ c phi]"))
    (mistake,) = verdict.mistakes
    assert str(mistake.what).startswith("In what is solved for x'' alone: the term ") and "wrong sign" in str(
        mistake.what
    )


BELOW = """(m l^2 + M l^2 sin(phi)^2) phi'' + M l^2 sin(phi) cos(phi) phi'^2 + c phi' = tau
phi'' = 1/({below}) (tau - c phi' - M l^2 sin(phi) cos(phi) phi'^2)"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("below", "told"),
    [
        ("m l^2", "the term M*l^2*sin(phi)^2 is missing"),
        ("m l^2 + M l^2 sin(phi)", "M*l^2*sin(phi) should be M*l^2*sin(phi)^2"),
        ("m l^2 - M l^2 sin(phi)^2", "wrong sign"),
    ],
)
def test_a_wrong_term_of_the_denominator_of_one_coordinate_is_told_there(below: str, told: str) -> None:
    assert yoke().check(BELOW.format(below="m l^2 + M l^2 sin(phi)^2")).right
    [mistake] = yoke().check(BELOW.format(below=below)).mistakes
    assert "enominator" in str(mistake.what) and told in str(mistake.what), str(mistake.what)


def test_a_wrong_numerator_is_not_told_as_a_denominator() -> None:
    answer = BELOW.format(below="m l^2").replace("(tau - c", "(tau + c")
    assert not any("denominator is not" in str(m.what) for m in yoke().check(answer).mistakes)


@cache
def planet() -> Derivation:
    """A bead on a planet in a ring: l and n are short for R − r and l/r."""
    sys = System("planet")
    phi = sys.coordinates("phi")
    R, r, M, m, d, k, c, g = sys.parameters("R r M m d k c g")
    length = sys.define("l", R - r)
    n = sys.define("n", length / r)
    x = (length * sin(phi) - d * sin(n * phi), -length * cos(phi) - d * cos(n * phi))
    sys.particle(M, at=sys.point("P", (length * sin(phi), -length * cos(phi))), name="planet")
    sys.particle(m, at=sys.point("B", x), name="bead")
    sys.spring(k, deflection=phi)
    sys.gravity((0, -1), g)
    sys.damper(c, deflection=phi, name="bearing")
    sys.torque(sys.inputs("tau"), on=phi, name="crank")
    return sys.derive()


PLANET = """I = M l^2 + m (l^2 + n^2 d^2 - 2 n l d cos((n+1) phi))
I phi'' + m n (n+1) l d sin((n+1) phi) phi'^2 + (M + m) g l sin(phi) + m g n d sin(n phi) + k phi + c phi' = tau
phi'' = (tau - c phi' - k phi {sign} m n (n+1) l d sin((n+1) phi) phi'^2 - (M+m) g l sin(phi) - m g n d sin(n phi))/I"""


@pytest.mark.slow
def test_a_sign_in_a_numerator_is_told_where_shorthands_are_sums() -> None:
    assert planet().check(PLANET.format(sign="-")).right
    [mistake] = planet().check(PLANET.format(sign="+")).mistakes
    assert str(mistake.what).startswith("In the numerator of phi''") and "wrong sign" in str(mistake.what)


SLOPE = """T = 1/2 M l^2 phi'^2 + 1/2 m (l^2 + n^2 d^2 - 2 n l d cos((n+1) phi)) phi'^2
V = -(M + m) g l cos(phi) - m g d cos(n phi) + 1/2 k phi^2
∂T/∂phi = m n {factor} l d sin((n+1) phi) phi'^2
Xi = tau - c phi'"""


@pytest.mark.slow
def test_a_factor_of_an_own_derivative_is_told_where_shorthands_are_sums() -> None:
    right = planet().check(SLOPE.format(factor="(n+1)"))
    assert not any(f.status.value == "wrong" for f in right.findings)
    [mistake] = planet().check(SLOPE.format(factor="")).mistakes
    assert str(mistake.what).startswith("In ∂T*/∂phi") and "n + 1" in str(mistake.what)
    assert "inner derivative" in str(mistake.why)
    assert not any("belongs" in str(m.what) for m in planet().check(SLOPE.format(factor="sin(phi)")).mistakes)
