"""Components of velocities along axes that turn are right, and a wrong one is told by its own line."""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

from built_in import derivation
from lagrangian import Derivation, System
from lagrangian.check.explain.sense_counted import turned_to
from lagrangian.check.reference import truth_of
from lagrangian.model import time

T = "T = 1/2 m (r'^2 + r^2 theta'^2)"


@pytest.mark.parametrize("said", ["v_r = r', v_t = r theta'", "v_xi = -r'\nv_eta = r theta'", "v_n = r theta'"])
def test_components_along_turning_axes_are_right(said: str) -> None:
    verdict = derivation("elastic-pendulum").check(f"{said}\n{T}")
    assert verdict.right
    assert "axis turned by θ" in " ".join(verdict.to_text().split())


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("said", "wrong", "told"),
    [
        ("v_r = r', v_t = theta'", "r'^2 + theta'^2", "r θ̇, not θ̇"),
        ("v_r = r', v_t = 2 r theta'", "r'^2 + 4 r^2 theta'^2", "r θ̇, not 2 r θ̇"),
        ("v_r = r' - r theta', v_t = r theta'", "(r' - r theta')^2 + r^2 theta'^2", "ṙ, not ṙ − r θ̇"),
    ],
)
def test_a_wrong_one_is_told_at_its_line_and_the_other_stays_right(said: str, wrong: str, told: str) -> None:
    verdict = derivation("elastic-pendulum").check(f"{said}\nT = 1/2 m ({wrong})")
    assert not verdict.right
    assert told in " ".join(verdict.to_text().split())
    assert str(verdict.mistakes[0].what).startswith("Line 1 is not right: the component of the velocity")
    assert sorted(f.status.right for f in verdict.findings) == [False, False, True]


def test_along_x_it_is_the_fixed_axis_that_is_meant() -> None:
    """r θ̇ is right across the spring; along x the cosine is missing."""
    wrong = "v_x = r theta', v_y = r' cos(theta)\nT = 1/2 m (r^2 theta'^2 + r'^2 cos(theta)^2)"
    verdict = derivation("elastic-pendulum").check(wrong)
    assert not verdict.right and "axis turned" not in str(verdict.findings)


@cache
def tray() -> Derivation:
    """A cellar that slides along a groove in a tray: along the axes of the tray its velocity is (−s φ̇, ṡ + h φ̇)."""
    sys = System("tray")
    phi, s = sys.coordinates("phi s")
    J, m, h, k = sys.parameters("J m h k")
    frame = sys.frame(phi)
    sys.rigid_body(1, J, at=sys.point("spindle", (0, 0)), frame=frame)
    sys.particle(m, at=frame.point(h, s), name="cellar")
    sys.spring(k, deflection=s)
    return sys.derive()


@pytest.mark.slow
def test_the_sign_of_a_part_is_told_of_the_component_that_has_it() -> None:
    verdict = tray().check(
        "v_xi = -s phi', v_eta = s' - h phi'\nT = 1/2 J phi'^2 + 1/2 m (s^2 phi'^2 + (s' - h phi')^2)\nV = 1/2 k s^2"
    )
    assert not verdict.right
    (mistake,) = verdict.mistakes
    assert "axis turned by φ is h φ̇ + ṡ, not ṡ − h φ̇" in " ".join(verdict.to_text().split())
    assert mistake.element is not None and "cellar" in mistake.element


def test_a_rate_of_r_is_no_raw_string() -> None:
    """r' + r*theta' is a sum of two rates, and no text in quotes behind the r of Python."""
    right = "v_s = r' + r*theta'\nT = 1/2 m (v_s^2 - 2 r r' theta')"
    assert derivation("elastic-pendulum").check(right, hint=0).right
    assert not derivation("elastic-pendulum").check(right.replace("+ r*theta'", "+ 2*r*theta'"), hint=0).right


@cache
def table() -> Derivation:
    """A block in a slot that misses the centre of a turning table by h."""
    sys = System("table")
    psi, s = sys.coordinates("psi s")
    J, m, h, k = sys.parameters("J m h k")
    frame = sys.frame(psi, name="table")
    sys.rigid_body(0, J, at=sys.origin, frame=frame, name="disc")
    sys.particle(m, at=sys.point("B", (s, h), frame=frame), name="block")
    sys.spring(k, deflection=s)
    return sys.derive()


COMPONENTS = "v_x = {x}\nv_y = {y}\nT = 1/2 J psi'^2 + 1/2 m (({x})^2 + ({y})^2)\nV = 1/2 k s^2"


@pytest.mark.slow
def test_components_x_and_y_without_an_angle_are_along_the_axes_that_turn() -> None:
    right = table().check(COMPONENTS.format(x="s' - h psi'", y="s psi'"))
    assert right.right and "axis turned by ψ" in " ".join(right.to_text().split())
    verdict = table().check(COMPONENTS.format(x="s' + h psi'", y="s psi'"))
    told = " ".join(verdict.to_text().split())
    assert not verdict.right and "axis turned by ψ is ṡ − h ψ̇, not h ψ̇ + ṡ" in told
    assert [f.status.right for f in verdict.findings] == [False, True, False, True]


def test_where_one_of_them_has_the_angle_the_axes_are_fixed() -> None:
    wrong = COMPONENTS.format(x="s' - h psi'", y="s psi' cos(psi)")
    verdict = table().check(wrong)
    assert not verdict.right and "axis turned" not in verdict.to_text()


def test_a_part_along_axes_that_turn_in_space_is_told_as_one() -> None:
    """Ω x left out of v_y along axes that turn about z is one part, not one along each of two fixed axes."""
    s = System("whirled")
    x, y, z = s.coordinates("x y z")
    m, k, w = s.parameters("m k Omega")
    c, n = sp.cos(w * time), sp.sin(w * time)
    s.particle(m, at=s.point("P", (x * c - y * n, x * n + y * c, z)), name="bead")
    s.spring(k=k, deflection=z, name="bed")
    d = s.derive()
    right = "T = m/2 ((x' - Omega y)^2 + (y' + Omega x)^2 + z'^2)"
    assert not [f for f in d.check(right).findings if not f.status.right]
    (mistake,) = d.check(right.replace("y' + Omega x", "y'")).mistakes
    assert str(mistake.what) == "In the velocity of particle 'bead' along axes that turn, Omega*x is left out."


def test_a_component_is_told_in_the_sense_of_its_own_rate() -> None:
    """Of ṡ − r θ̇ for ṡ + r θ̇, along an axis that we count the other way, the sign of r θ̇ is wrong."""
    s = System("ramp")
    theta, u = s.coordinates("theta s")
    J, m, r, k = s.parameters("J m r k")
    s.kinetic(J * theta.diff() ** 2 / 2, name="ramp")
    s.kinetic(m * (u.diff() + r * theta.diff()) ** 2 / 2, name="wagon")
    s.spring(k=k, deflection=u, name="spring")
    truth, forth = truth_of(s.derive()), u.diff() + r * theta.diff()
    said = u.diff() - r * theta.diff()
    assert turned_to(truth, -forth, said) == -1
    assert turned_to(truth, forth, said) == 1


@pytest.mark.slow
def test_the_rate_of_a_stated_coordinate_is_right() -> None:
    """s′ = R φ′ below "(s = R φ)" is no wrong line in an answer in φ."""
    s = System("barrel")
    x, u = s.coordinates("x s")
    M, m, J, R, k = s.parameters("M m J R k")
    s.kinetic(M * x.diff() ** 2 / 2, name="car")
    s.kinetic((m + J / R**2) * u.diff() ** 2 / 2, name="barrel")
    s.spring(k=k, deflection=x - u, name="spring")
    answer = """with x and the angle phi of the barrel (s = R phi)
s' = R phi'
M x'' + k (x - R phi) = 0
(m R^2 + 4 J) phi'' - k R (x - R phi) = 0"""
    verdict = s.derive().check(answer)
    assert [f.line.number for f in verdict.findings if not f.status.right] == [4]
    assert s.derive().check(answer.replace("4 J", "J")).right
