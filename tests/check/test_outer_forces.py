"""What a force from outside does in two equations is no action and reaction: only what acts between two bodies has one.

Oracle: a truck that draws a trailer at x − s. A brake on the trailer has Ξ_x = −B and Ξ_s = +B, and nothing but the
trailer feels it; a winch between both has Ξ_s alone, or, with the trailer's own place y, +W and −W.
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg
from lagrangian.check.verdict import Verdict


@cache
def road_train() -> lg.Derivation:
    """A truck, and a trailer behind it, whose distance is counted from that at rest."""
    s = lg.System("truck and trailer")
    x, u = s.coordinates("x u")
    m, n, k = s.parameters("m n k")
    F, B = s.inputs("F B")
    truck, trailer = s.point("truck", (x, 0)), s.point("trailer", (x - u, 0))
    s.particle(m, at=truck, name="truck")
    s.particle(n, at=trailer, name="trailer")
    s.spring(k, deflection=u, name="drawbar")
    s.force((F, 0), at=truck, name="traction")
    s.force((-B, 0), at=trailer, name="brake")
    return s.derive()


@cache
def winched() -> lg.Derivation:
    """Two carts that a winch pushes apart."""
    s = lg.System("two carts")
    x, y = s.coordinates("x y")
    m, n, k = s.parameters("m n k")
    s.particle(m, at=s.point("A", (x, 0)), name="first")
    s.particle(n, at=s.point("B", (y, 0)), name="second")
    s.spring(k, deflection=x, name="stay")
    s.force(s.input("W"), deflection=y - x, name="winch")
    return s.derive()


TRAIN = "T = m x'^2/2 + n (x' - u')^2/2\nV = k u^2/2\n(m + n) x'' - n u'' = F - B\nn (u'' - x'') + k u = {}"
CARTS = "T = m x'^2/2 + n y'^2/2\nV = k x^2/2\nm x'' + k x = {}\nn y'' = W"


def told(verdict: Verdict) -> str:
    return " ".join(str(verdict).split())


@pytest.mark.parametrize(("share", "said"), [("0", "is missing in"), ("-B", "has the wrong sign in")])
def test_an_outer_force_has_no_reaction(share: str, said: str) -> None:
    """A force on one body that moves with two coordinates is left out or turned round in one of their equations."""
    assert road_train().check(TRAIN.format("B")).right
    verdict = road_train().check(TRAIN.format(share))
    assert not verdict.right and "eaction" not in told(verdict) and "two bodies" not in told(verdict)
    assert f"Force 'brake' {said} the equation of u." in told(verdict)


@pytest.mark.parametrize(("share", "said"), [("0", "missing"), ("W", "wrong sign")])
def test_what_acts_between_two_has_one(share: str, said: str) -> None:
    assert winched().check(CARTS.format("-W")).right
    verdict = winched().check(CARTS.format(share))
    assert "eaction" in told(verdict) and said in told(verdict)
