"""Components of a velocity along axes that turn are told along these, and not along fixed ones.

Oracle: by hand, a bead on a rod that swings at the rim of a wheel driven at ν, s from its pivot, β from the radius:
v_s = ṡ + e ν sin β along the rod, v_t = s (ν + β̇) + e ν cos β across it.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.model import time

ALONG, ACROSS = "s' + e nu sin(beta)", "s (nu + beta') + e nu cos(beta)"


@cache
def wheel() -> lg.Derivation:
    """A bead on a rod that swings at the rim of a driven wheel."""
    sys = lg.System("bead on a rod at a driven wheel")
    s, beta = sys.coordinates("s beta")
    m, e, nu, k, c = sys.parameters("m e nu k c")
    turned = nu * time + beta
    pivot = (e * sp.cos(nu * time), e * sp.sin(nu * time))
    place = (pivot[0] + s * sp.cos(turned), pivot[1] + s * sp.sin(turned))
    sys.particle(m, at=sys.point("P", place), name="bead")
    sys.spring(k, deflection=s, name="spring")
    sys.damper(c, deflection=beta, name="hinge damper")
    return sys.derive()


def sheet(along: str, across: str) -> str:
    """An answer with these components of the velocity of the bead."""
    return (
        f"Components of the velocity of the bead:\nv1 = {along}, v2 = {across}\nT = 1/2 m (v1^2 + v2^2)\nV = 1/2 k s^2"
    )


TURNED = "the component of the velocity of particle 'bead' along the {} axis turned by {} "
ROD, WHEEL = "nu*t + beta", "nu*t"
ON_WHEEL = "s' cos(beta) - s (nu + beta') sin(beta)", "s' sin(beta) + s (nu + beta') cos(beta) + e nu"


@pytest.mark.slow
@pytest.mark.parametrize("order", [1, -1])
def test_sine_and_cosine_exchanged_in_the_velocity_of_the_pivot(order: int) -> None:
    said = ("s' + e nu cos(beta)", "s (nu + beta') + e nu sin(beta)")[::order]
    verdict = wheel().check(sheet(*said))
    assert not verdict.right
    assert all(f.line.number == 2 or f.follows or f.status.right for f in verdict.findings)
    one, other = (str(m.what) for m in verdict.mistakes[::order])
    assert TURNED.format("x", ROD) + "is e*nu*sin(beta) + s'" in one
    assert one.endswith(": the term e*nu*cos(beta) should be e*nu*sin(beta).")
    assert TURNED.format("y", ROD) in other
    assert other.endswith(": the term e*nu*sin(beta) should be e*nu*cos(beta).")
    assert all("has the cosine" in str(m.why) for m in verdict.mistakes)


def test_what_is_missing_in_both_components_is_told_of_both() -> None:
    one, other = (str(m.what) for m in wheel().check(sheet("s'", "s (nu + beta')")).mistakes)
    assert one.endswith("not s': the term e*nu*sin(beta) is missing.")
    assert other.endswith(": the term e*nu*cos(beta) is missing.")


@pytest.mark.parametrize(("said", "angle"), [((ALONG, ACROSS), ROD), (ON_WHEEL, WHEEL)])
def test_right_components_along_either_axes_are_called_so(said: tuple[str, str], angle: str) -> None:
    verdict = wheel().check(sheet(*said))
    assert verdict.right
    notes = [str(f.note) for f in verdict.findings if f.line.number == 2]
    assert notes == [TURNED.format(axis, angle).strip() for axis in "xy"]


def test_a_component_along_the_axes_of_the_wheel_is_told_along_these() -> None:
    along, across = ON_WHEEL
    (mistake,) = wheel().check(sheet(along, across.replace(" + e nu", ""))).mistakes
    assert TURNED.format("y", WHEEL) in str(mistake.what)
    assert str(mistake.what).endswith(": the term e*nu is missing.")


@cache
def arm() -> lg.Derivation:
    """A bob along an arm on a driven table; the arm is nothing but its kinetic energy."""
    s = lg.System("bob along an arm")
    r, psi = s.coordinates("r psi")
    m, J, nu, k = s.parameters("m J nu k")
    turned = nu * time + psi
    s.particle(m, at=s.point("P", (r * sp.cos(turned), r * sp.sin(turned))), name="bob")
    s.kinetic(J * (nu + psi.diff(time)) ** 2 / 2, name="arm")
    s.spring(k, deflection=r)
    return s.derive()


def test_the_rate_of_an_angle_in_a_kinetic_energy_is_an_angular_velocity() -> None:
    energies = "T = 1/2 J w^2 + 1/2 m (r'^2 + r^2 (nu + psi')^2)\nV = 1/2 k r^2"
    verdict = arm().check(f"w = nu + psi'\n{energies}")
    assert verdict.right and str(verdict.findings[0].note) == "the angular velocity of 'arm'"
    (mistake,) = arm().check(f"w = psi'\n{energies}").mistakes
    assert str(mistake.what) == (
        "Line 1 is not right: the angular velocity of 'arm' is nu + psi', not psi': the term nu is missing."
    )
