"""What is told of an energy that is summed in parts: by its written terms, and in no units of another energy."""

from __future__ import annotations

from functools import cache

from lagrangian import loads
from lagrangian.derivation import Derivation

BOOM = """
name = "boom on a lift"
[coordinates]
y = { description = "lift, upwards", unit = "m" }
beta = { description = "boom above the horizontal", unit = "rad" }
[parameters]
M = "6 kg"
m = "2 kg"
a = "0.9 m"
[points]
C = ["0", "y"]
G = { from = "C", frame = "boom", offset = ["a/2", "0"] }
[[frame]]
name = "boom"
angle = "beta"
origin = "C"
[[particle]]
name = "lift"
mass = "M"
at = "C"
[[rigid_body]]
name = "boom"
mass = "m"
inertia = "m*a^2/12"
at = "G"
frame = "boom"
[[gravity]]
direction = [0, -1]
"""


@cache
def boom() -> Derivation:
    return loads(BOOM).derive()


def test_a_wrong_term_is_told_as_it_was_written() -> None:
    """Its rotation has the inertia about the pivot; the piece of the motion of G is right."""
    verdict = boom().check(
        "vG^2 = y'^2 + y' a beta' cos(beta) + 1/4 a^2 beta'^2\nT = 1/2 M y'^2 + 1/2 m vG^2 + 1/2 (1/3 m a^2) beta'^2\n"
    )
    (finding,) = [f for f in verdict.findings if f.line.kind == "T"]
    (difference,) = finding.differences
    assert str(difference.written) == "a**2*m*Derivative(beta(t), t)**2/6"
    assert str(difference.term) == "a**2*m*Derivative(beta(t), t)**2/24"


def test_no_energy_is_measured_in_units_of_another() -> None:
    """T1 is a multiple of what is missing in T2, and no part of it."""
    verdict = boom().check(
        "T1 = 1/24 m a^2 beta'^2\nT2 = 1/2 M y'^2\nT3 = 1/2 m (y'^2 + y' a beta' cos(beta))\n"
        "V = (M + m) g y + 1/2 m g a sin(beta)\nL = T1 + T2 + T3 - V"
    )
    assert not verdict.right and verdict.mistakes
    told = [str(m.what) for m in (*verdict.mistakes, *verdict.alternatives)]
    told += [str(f.note) for f in verdict.findings] + [str(d) for f in verdict.findings for d in f.differences]
    assert not any("T1" in x or "T_1" in x for x in told)
