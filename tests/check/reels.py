"""A reel that rolls, for several tests."""

from __future__ import annotations

from functools import cache

from sympy import cos, sin

from lagrangian import Derivation, System

VALUES = {"M": "0.05 kg", "J": "0.00002 kg*m^2", "R": "0.02 m", "m": "0.03 kg", "l": "0.015 m", "k": "0.0004 N*m/rad"}
VALUES |= {"c": "0.00001 N*m*s", "g": "9.81 m/s^2"}


@cache
def reel() -> Derivation:
    """A reel that rolls, with a mass on an arm that a band ties to its turning: the band feels φ + ψ."""
    return reel_with()


def reel_with(**values: str) -> Derivation:
    """The reel with values of its parameters."""
    sys = System("reel with an arm")
    x, phi, psi = sys.coordinates("x phi psi")
    M, J, R, m, l, k, c, g = sys.parameters("M J R m l k c g", **values)
    F = sys.input("F")
    axle = sys.point("axle", (x, R))
    body = sys.rigid_body(M, J, at=axle, frame=sys.frame(-phi), name="reel")
    sys.particle(m, at=axle + (l * sin(psi), -l * cos(psi)))
    sys.gravity((0, -1), g)
    sys.spring(k, deflection=phi + psi)
    sys.damper(c, deflection=phi + psi)
    sys.force((F, 0), at=axle)
    sys.rolling(body, at=sys.point("contact", (x, 0)), along=(1, 0))
    return sys.derive()
