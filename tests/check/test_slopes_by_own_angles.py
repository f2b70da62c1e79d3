"""Slopes dX/dβ by an angle β = π − φ of an answer's own, in a system that has a d.

Oracle: the equation of an arm with a spring and a load on the distance of its end to a point. Every form has a wrong
twin.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg


@cache
def arm() -> lg.Derivation:
    """An arm that turns against a spring to a fixed point, and lifts a load by a cord that goes there."""
    s = lg.System("arm")
    phi = s.coordinate("phi")
    J, a, d, k, m, n = s.parameters("J a d k m n")
    u = sp.sqrt(a**2 + d**2 - 2 * a * d * sp.cos(phi))
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=s.frame(phi, name="arm"), name="arm")
    s.spring(k=k, deflection=u, rest=n)
    s.particle(m, at=s.point("load", (0, u)))
    s.torque(s.inputs("M"), on=phi)
    return s.derive()


WRITTEN = """I use β = π - φ
u = sqrt(a² + d² + 2 a d cos β)
h = a d sin(β)/u       (the lever arm of the spring; du/dβ = -h)
z = dh/dβ = a d cos(β)/u + a² d² sin²(β)/u³
(J + m h²) β'' + m h z β'² - k (u - n) h = -M
"""


def test_a_slope_by_an_own_angle_is_one_where_the_system_has_a_d() -> None:
    verdict = arm().check(WRITTEN)
    assert verdict.right, verdict.to_text()


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("cos(β)/u +", "cos(β)/u -"),
        ("β'² - k", "β'² + k"),
        ("z β'²", "2 z β'²"),
        ("= -M", "= M"),
        ("u - n", "u + n"),
        ("h = a d sin", "h = 2 a d sin"),
    ],
)
def test_a_wrong_slope_by_an_own_angle_is_wrong(old: str, new: str) -> None:
    assert old in WRITTEN
    assert not arm().check(WRITTEN.replace(old, new), hint=0).right


def test_a_slope_that_stands_alone_is_judged() -> None:
    written = WRITTEN.replace("       (the lever arm of the spring; du/dβ = -h)", "\ndu/dβ = -h")
    assert arm().check(written).right, arm().check(written).to_text()
    assert not arm().check(written.replace("du/dβ = -h", "du/dβ = h"), hint=0).right
