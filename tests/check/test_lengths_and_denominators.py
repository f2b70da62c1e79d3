"""Two lengths that are added before they are squared, and a wrong term of a denominator, are told as they stand.

Oracle: a rod with a weight that is off its axis, by hand.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

import lagrangian as lg


@cache
def arm() -> lg.Derivation:
    """An arm on a torsion spring with a weight at (d, e) in its own frame, in a horizontal plane."""
    s = lg.System("arm with a weight")
    phi, psi = s.coordinates("phi psi")
    J, M, d, e, k, B = s.parameters("J M d e k B")
    s.kinetic(J * phi.diff() ** 2 / 2, name="arm")
    s.kinetic(B * psi.diff() ** 2 / 2, name="wheel")
    cos, sin = sp.cos(phi), sp.sin(phi)
    s.particle(M, at=s.point("P", (d * cos - e * sin, d * sin + e * cos)), name="weight")
    s.spring(k, deflection=phi - psi, name="torsion spring")
    s.force(s.input("tau"), deflection=phi, name="motor")
    return s.derive()


def test_lengths_that_are_added_are_told_as_a_sum() -> None:
    told = arm().check("T = 1/2 (J + M (d + e)^2) phi'^2 + 1/2 B psi'^2\nV = 1/2 k (phi - psi)^2").to_text()
    assert "(d + e)² stands in place of d² + e²" in told and "right angle, as by a sine" not in told


def test_a_wrong_term_of_a_denominator_is_told_there() -> None:
    right = "phi'' = (tau - k (phi - psi))/(J + M d^2 + M e^2)\npsi'' = k (phi - psi)/B"
    assert arm().check(right).right
    above = "(J + M d^2 + M e^2) phi'' + k (phi - psi) = tau\nB psi'' - k (phi - psi) = 0\n"
    told = arm().check(f"{above}phi'' = (tau - k (phi - psi))/(J + M d + M e^2)").to_text()
    assert "enominator" in told and "φ̈/(" not in told and "M d" in told
