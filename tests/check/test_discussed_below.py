"""What a discussion says below right equations: special motions, rest in several coordinates, values at a position.

Oracle: a cart on a spring that carries a pendulum, by hand, and its positions at rest.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg

EQUATIONS = """(M + m) x'' + m l phi'' cos(phi) - m l phi'^2 sin(phi) + k x = F
m l^2 phi'' + m l x'' cos(phi) + m g l sin(phi) = tau
"""


@cache
def cart() -> lg.Derivation:
    """A cart on a spring with a pendulum, a force on the cart and a torque on the pendulum."""
    s = lg.System("cart with a pendulum")
    x, phi = s.coordinates("x phi")
    M, m, l_, k, g = s.parameters("M m l k g")
    s.particle(M, at=s.point("C", (x, 0)), name="cart")
    s.particle(m, at=s.point("P", (x + l_ * sp.sin(phi), -l_ * sp.cos(phi))), name="bob")
    s.gravity((0, -1), g)
    s.spring(k, deflection=x)
    s.force(s.input("F"), deflection=x)
    s.force(s.input("tau"), deflection=phi, name="motor")
    return s.derive()


SPECIAL = [
    "Cart held in the middle (x = 0): m l^2 phi'' + m g l sin(phi) = tau, a pendulum.",
    "(g) Controls\nPendulum locked (phi = 0): (M + m) x'' + k x = F",
    "Is that plausible? For a steady push the cart rests where k x = F_0.",
    "Discussion. Static: with F = F0 and tau = 0 the rows read\nk x = F0 and m g l sin(phi) = 0.",
    "Small motions, the drive left out: (M + m) x'' + m l phi'' + k x = 0",
    "If M = m and k l = m g, the two swing alike.",
    "Remark. For l = 1 it is a pendulum of unit length, m g l = m g, as it must be.",
    "Where can it stand still? With the drives off: sin(phi) (m g l) = 0.",
]


@pytest.mark.parametrize("said", SPECIAL)
def test_what_is_said_of_a_special_motion_is_no_mistake(said: str) -> None:
    verdict = cart().check(f"{EQUATIONS}\n{said}\n")
    assert verdict.right, verdict.to_text()


LIMITS = r"""\[ (M+m)\ddot x + m l\ddot\phi\cos\phi - m l\dot\phi^2\sin\phi + k x = F \]
\[ m l^2\ddot\phi + m l\ddot x\cos\phi + m g l\sin\phi = \tau \]
\textbf{Limiting cases.}
\begin{itemize}
\item $m\to 0$: the cart alone, $M\ddot x + k x = F$.
\item $k=g=0$, $F=0$: $\partial L/\partial\dot x$ stays constant.
\end{itemize}
"""


def test_limits_in_a_list_of_latex_are_remarks() -> None:
    verdict = cart().check(LIMITS)
    assert verdict.right, verdict.to_text()
    assert not cart().check(LIMITS.replace("+ m g l", "- m g l")).right
    assert (
        not cart()
        .check(LIMITS.replace("\\textbf{Limiting cases.}", "").replace("$m\\to 0$: the cart alone, ", ""))
        .right
    )


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", SPECIAL)
@pytest.mark.parametrize(("right", "wrong"), [("+ k x = F\n", "- k x = F\n"), ("+ m g l sin", "+ m g sin")])
def test_equations_above_a_discussion_are_judged(said: str, right: str, wrong: str) -> None:
    assert not cart().check(f"{EQUATIONS.replace(right, wrong)}\n{said}\n").right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "m l^2 phi'' + m g l sin(phi) = tau",
        "The pendulum obeys m l^2 phi'' + m g l sin(phi) = tau in every motion.",
        "k x = F",
        "k x = 0",
        "k x = 2 F",
        "For l = 1 we get the same, m g l = 2 m g.",
    ],
)
def test_a_wrong_line_below_is_judged(said: str) -> None:
    assert not cart().check(f"{EQUATIONS}\n{said}\n").right


@cache
def seesaw() -> lg.Derivation:
    """A beam with a weight that slides along it on a spring."""
    s = lg.System("beam with a sliding weight")
    phi, u = s.coordinates("phi u")
    J, M, m, a, k, g = s.parameters("J M m a k g")
    s.kinetic(J * phi.diff() ** 2 / 2, name="beam")
    s.particle(m, at=s.point("W", (u * sp.cos(phi), u * sp.sin(phi))), name="weight")
    s.potential(-M * g * a * sp.cos(phi), name="ballast")
    s.gravity((0, -1), g)
    s.spring(k, deflection=u)
    s.force(s.input("tau"), deflection=phi, name="motor")
    return s.derive()


BEAM = """(J + m u^2) phi'' + 2 m u u' phi' + M g a sin(phi) + m g u cos(phi) = tau
m u'' - m u phi'^2 + m g sin(phi) + k u = 0
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("said", "is_right"),
    [
        ("M g a sin(phi) + m g u cos(phi) = 0", True),
        ("tan(phi) = -m u/(M a)", True),
        ("k u + m g sin(phi) = 0", True),
        ("M g a sin(phi) - m g u cos(phi) = 0", False),
        ("tan(phi) = m u/(M a)", False),
        ("tan(phi) = -m u/(2 M a)", False),
    ],
)
def test_a_relation_of_two_positions_at_rest_must_hold(said: str, is_right: bool) -> None:
    text = f"{BEAM}\nStatic position: with tau = 0 the rows read\n{said}"
    assert seesaw().check(text).right is is_right


def gate() -> str:
    """A pendulum's equation with the length of a strut as a name of its own."""
    return (
        "q = sqrt(a^2 + l^2 - 2 a l cos(phi)), q_phi = dq/dphi = a l sin(phi)/q\n"
        "m l^2 phi'' + m g l sin(phi) + c (q - q0) q_phi = 0\n"
    )


@cache
def strut() -> lg.Derivation:
    """A pendulum with a strut between its bob and a point on the wall, with values."""
    s = lg.System("pendulum with a strut")
    phi = s.coordinate("phi")
    values = {"m": "2 kg", "l": "0.55 m", "a": "0.25 m", "c": "300 N/m", "q0": "0.3 m", "g": "9.81 m/s^2"}
    m, l_, a, c, q0, g = (s.parameter(name, value=value) for name, value in values.items())
    s.particle(m, at=s.point("P", (l_ * sp.sin(phi), -l_ * sp.cos(phi))), name="bob")
    s.gravity((0, -1), g)
    s.spring(c, deflection=sp.sqrt(a**2 + l_**2 - 2 * a * l_ * sp.cos(phi)) - q0)
    return s.derive()


@pytest.mark.slow
def test_a_value_at_a_position_is_no_other_value_of_a_name() -> None:
    verdict = strut().check(f"{gate()}For phi = 90°: q = sqrt(a^2 + l^2).")
    assert verdict.right, verdict.to_text()
    assert not strut().check(f"{gate()}For every position: q = sqrt(a^2 + l^2).").right
    assert not strut().check(f"{gate().replace('+ c', '- c')}For phi = 90°: q = sqrt(a^2 + l^2).").right


@pytest.mark.parametrize("value", ["0.356 m", "0.356"])
def test_a_number_at_a_position_is_about_that_position(value: str) -> None:
    written = f"{gate()}What holds it? (at phi = 30°, say, q = {value})"
    assert strut().check(written).right
    assert strut().check(f"{gate()}For phi = 30°: q = {value}.").right
    assert not strut().check(f"{gate().replace('+ c', '- c')}For phi = 30°: q = {value}.").right
