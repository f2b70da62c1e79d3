"""The first line from which everything else follows is told: places in programs, items below headings, equal bodies.

Oracle: by hand. Links with the angle α from the vertical, the second folded back, so that both centres are ½ l sin α
aside and ½ l cos α and 3/2 l cos α below the pivot:

    T = ½ m l² α̇² (¼ + (¼ cos²α + 9/4 sin²α)) + m l² α̇²/12,     V = −2 m g l cos α

Two equal balls on an arm that rises by β on both sides, at the distance s from the axis, with the drum J:

    T = m (ṡ² + s² cos²β φ̇²) + ½ J φ̇²,     V = 2 m g s sin β + k s²
"""

from __future__ import annotations

from functools import cache

import pytest
from sympy import cos, sin

from lagrangian import CheckedAnswer, Derivation, System


@cache
def links() -> Derivation:
    """Two equal links that fold, driven by nothing but their weight."""
    sys = System("links")
    alpha = sys.coordinates("alpha")
    m, J, l, g = sys.parameters("m J l g")
    at = {"upper": (l / 2 * sin(alpha), -l / 2 * cos(alpha)), "lower": (l / 2 * sin(alpha), -3 * l / 2 * cos(alpha))}
    for name, (x, y) in at.items():
        frame = sys.frame(alpha if name == "upper" else -alpha, name=f"{name}_frame")
        sys.rigid_body(m, J, at=sys.point(f"{name}_centre", (x, y)), frame=frame, name=f"{name} link")
    sys.gravity(direction=(0, -1), g=g)
    return sys.derive()


@cache
def flyer() -> Derivation:
    """Two balls on an arm that turns and rises on both sides."""
    sys = System("flyer")
    phi, s = sys.coordinates("phi s")
    m, J, beta, g, k = sys.parameters("m J beta g k")
    sys.kinetic(J * phi.diff() ** 2 / 2, name="drum")
    for number, sign in ((1, 1), (2, -1)):
        place = (sign * s * cos(beta) * cos(phi), sign * s * cos(beta) * sin(phi), s * sin(beta))
        sys.particle(m, at=sys.point(f"P{number}", place), name=f"ball {number}")
    sys.gravity(direction=(0, 0, -1), g=g)
    sys.spring(k, deflection=s)
    sys.spring(k, deflection=s)
    return sys.derive()


def first(verdict: CheckedAnswer, line: int) -> str:
    """The first mistake, which is that of a line from which all that is wrong follows."""
    assert not verdict.right
    wrong = [f for f in verdict.findings if not f.status.right]
    assert wrong[0].line.number == line and all(f.follows for f in wrong[1:])
    return str(verdict.mistakes[0].what)


PROGRAM = """syms m J l g real
syms alpha(t)
w = diff(alpha,t);
X1 = l/2*sin(alpha); Y1 = l/2*cos(alpha);
X2 = l*sin(alpha) - l/2*sin(alpha); Y2 = 3/2*l*cos(alpha);
T = m/2*(diff(X1,t)^2 + diff(Y1,t)^2) + m/2*(diff(X2,t)^2 + diff(Y2,t)^2) + J*w^2;
V = -m*g*(Y1 + Y2);
L = T - V;
E = diff(diff(L,w),t) - diff(L,alpha)
"""


def test_a_place_in_a_program_is_told_for_its_body() -> None:
    assert links().check(PROGRAM).right
    told = first(links().check(PROGRAM.replace("l*sin(alpha) - l/2", "l*sin(alpha) + l/2")), 5)
    assert told.startswith("Line 5 is not right: the x coordinate of rigid body 'lower link' is l*sin(alpha)/2, not ")


LISTED = """Velocities by components (right, down)
 upper centre: l/2 cos(alpha) alpha', -l/2 sin(alpha) alpha'
 lower centre: l/2 cos(alpha) alpha', -3/2 l sin(alpha) alpha'
Energies
T = 1/2 m l^2 alpha'^2/4 + 1/2 m (l^2/4 cos(alpha)^2 + 9/4 l^2 sin(alpha)^2) alpha'^2 + J alpha'^2
V = -2 m g l cos(alpha)
"""


def test_columns_below_a_heading_are_velocities() -> None:
    right = links().check(LISTED + "(m l^2/2 + 2 m l^2 sin(alpha)^2 + 2 J) alpha'' + 2 m l^2 sin(alpha) cos(alpha) "
                          "alpha'^2 + 2 m g l sin(alpha) = 0")  # fmt: skip
    assert right.right
    wrong = LISTED.replace("-3/2 l sin(alpha) alpha'", "-1/2 l sin(alpha) alpha'").replace("9/4", "1/4")
    told = first(links().check(wrong + "(m l^2/2 + 2 J) alpha'' + 2 m g l sin(alpha) = 0"), 3)
    assert told.startswith("Line 3 is not right: the velocity of rigid body 'lower link' is ")


BALLS = """Velocity of a ball in the turning frame:
- outwards: s' cos(beta)
- across: s cos(beta) phi'
- vertical: s' sin(beta)
(J + 2 m s^2 cos(beta)^2) phi'' + 4 m s cos(beta)^2 s' phi' = 0
2 m s'' - 2 m s cos(beta)^2 phi'^2 + 2 k s + 2 m g sin(beta) = 0
"""


def test_what_is_said_of_a_ball_is_said_of_both() -> None:
    assert flyer().check(BALLS).right
    wrong = BALLS.replace("2 m s'' -", "2 m cos(beta)^2 s'' -")
    told = first(flyer().check(wrong.replace("vertical: s' sin(beta)", "vertical: 0")), 4)
    assert "component of the velocity of particle 'ball 1' and particle 'ball 2' is " in told and told.endswith(
        "not 0."
    )
    other = flyer().check(wrong)  # the velocities are right, so that the mistake is not theirs
    assert not other.right and "Line" not in str(other.mistakes[0].what)


@pytest.mark.parametrize("up", ["", "-"])
def test_places_count_along_the_same_axes(up: str) -> None:
    places = (
        f"r_1 = (s cos(beta) cos(phi), s cos(beta) sin(phi), {up} s sin(beta))\n"
        f"r_2 = (-s cos(beta) cos(phi), -s cos(beta) sin(phi), {up} s sin(beta))\n"
    )
    equations = "\n".join(BALLS.splitlines()[4:])
    verdict = flyer().check(places + equations)
    assert verdict.right and len([f for f in verdict.findings if f.status.right]) == 4
    down = places.replace(f"{up} s sin(beta))\nr_2", "#").replace(f"{up} s sin", f"{'' if up else '-'} s sin")
    wrong = down.replace("#", f"{up} s sin(beta))\nr_2") + equations.replace("+ 2 m g sin(beta)", "")
    told = first(flyer().check(wrong), 2)
    assert told.startswith("Line 2 is not right: the position of particle 'ball 2' is ")
