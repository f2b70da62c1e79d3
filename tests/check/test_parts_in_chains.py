"""An energy of a part that is worked out in a list, A = B below a heading, is that of the part.

Oracle: a crank and a uniform bar on the same axle, whose energies about the axle are known by hand.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verdict import Verdict


@cache
def axle() -> lg.Derivation:
    """A crank with a knob, and a uniform bar that turns with it through a gear, q = n φ."""
    s = lg.System("crank and bar")
    phi = s.coordinate("phi")
    J, m, r, M, L, n, g, b = s.parameters("J m r M L n g b")
    s.kinetic(J * phi.diff() ** 2 / 2, name="crank")
    s.particle(m, at=s.point("K", (r * sp.sin(phi), r * sp.cos(phi))), name="knob")
    middle = s.point("G", (L / 2 * sp.cos(n * phi), L / 2 * sp.sin(n * phi)))
    s.rigid_body(M, inertia=M * L**2 / 12, at=middle, frame=s.frame(n * phi), name="bar")
    s.gravity(direction=(0, -1), g=g)
    s.damper(b, deflection=phi, name="axle")
    return s.derive()


LISTED = """\
Kinetic energy
  crank:   1/2 J phi_dot^2
  knob:    1/2 m (r phi_dot)^2
  bar:     1/2 ({part} M L^2) (n phi_dot)^2 = {whole} M L^2 n^2 phi_dot^2      because it turns n times as fast

Lagrange:
  (J + m r^2 + {inertia} M L^2 n^2) phi_ddot - m g r sin(phi) + 1/2 M g L n cos(n phi) = -b phi_dot
"""


def first_wrong(verdict: Verdict) -> int | None:
    return next((f.line.number for f in verdict.findings if not f.status.right and not f.follows), None)


def test_a_right_chain_is_right() -> None:
    verdict = axle().check(LISTED.format(part="1/3", whole="1/6", inertia="1/3"))
    assert verdict.right, str(verdict)
    assert "the kinetic energy of rigid body 'bar'" in " ".join(str(verdict).split())


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("part", "whole", "inertia"), [("1/12", "1/24", "1/12"), ("1/4", "1/8", "1/4"), ("1/3", "1/3", "2/3")]
)
def test_the_part_is_blamed_where_it_stands(part: str, whole: str, inertia: str) -> None:
    """The parallel axis is forgotten, the centre of mass alone counts, or the half is lost on the way."""
    verdict = axle().check(LISTED.format(part=part, whole=whole, inertia=inertia))
    assert not verdict.right and first_wrong(verdict) == 4
