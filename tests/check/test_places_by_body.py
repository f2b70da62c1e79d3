"""Coordinates that are listed by body under the same letters, "sled u = x", "bob u = x + e sin φ", are a table.

Oracle: by hand, a sled with a bob that swings below it:

    T = ½ M ẋ² + ½ m [(ẋ + e φ̇ cos φ)² + (e φ̇ sin φ)²]    V = −m g e cos φ
"""

from __future__ import annotations

from functools import cache

import pytest
from sympy import cos, sin

import lagrangian as lg


@cache
def sledge() -> lg.Derivation:
    """A sled on a level guide, and a bob."""
    s = lg.System("sledge")
    x, phi = s.coordinates("x phi")
    M, m, e = s.parameters("M m e")
    s.particle(M, at=s.point("S", (x, 0)), name="heavy sled")
    s.particle(m, at=s.point("B", (x + e * sin(phi), -e * cos(phi))), name="bob")
    s.gravity((0, -1))
    return s.derive()


SHEET = """Axes u along the guide, w upwards.
sled  u = x              w = 0
bob   u = x + e sin(phi)  w = {w}
Velocities
bob   u' = x' + {rate},  w' = e phi' sin(phi)
T = 1/2 M x'^2 + 1/2 m ((x' + {rate})^2 + (e phi' sin(phi))^2)
V = -m g e cos(phi)
"""
ROWS = """
(M + m) x'' + m e cos(phi) phi'' - m e sin(phi) phi'^2 = 0
m e^2 phi'' + m e cos(phi) x'' + m g e sin(phi) = 0
"""
GOOD, RATE = "-e cos(phi)", "e phi' cos(phi)"


def statuses(found: lg.CheckedAnswer) -> dict[tuple[int, str | None], str]:
    """What is told of each line."""
    told = ((f, "right" if f.status.right else "follows" if f.follows else "wrong") for f in found.findings)
    return {(f.line.number, f.line.name if f.line.kind == "identity" else None): x for f, x in told}


@pytest.mark.parametrize("mark", ["  ", ": "])
def test_the_same_letters_for_two_bodies_are_no_contradiction(mark: str) -> None:
    answer = SHEET.format(w=GOOD, rate=RATE).replace("sled  ", f"sled{mark}").replace("bob   ", f"bob{mark}")
    found = sledge().check(answer + ROWS)
    assert found.right and set(statuses(found).values()) == {"right"}, found.to_text()


def test_the_rate_that_is_wrong_is_told_and_the_energy_follows() -> None:
    found = sledge().check(SHEET.format(w=GOOD, rate="e phi' sin(phi)"))
    told = statuses(found)
    assert not found.right and told.get((3, None)) != "wrong", found.to_text()
    assert told[5, "u_bob"] == "wrong" and told[5, "w_bob"] == "right", found.to_text()
    assert told[6, None] == "follows" and len(found.mistakes) == 1, found.to_text()


def test_a_place_whose_rate_does_not_fit_is_not_right() -> None:
    found = sledge().check(SHEET.format(w="-e sin(phi)", rate=RATE))
    told = statuses(found)
    assert not found.right and told[5, "u_bob"] == "right" and told[5, "w_bob"] == "wrong", found.to_text()


@pytest.mark.parametrize(
    "answer",
    [
        "bob  u = x + e\nbob  u = x\nT = 1/2 (M + m) u'^2\n",
        "sled  u = x\nbob   u = x + e sin(phi)\nT = 1/2 M u'^2\n",
    ],
)
def test_a_letter_of_one_body_or_of_other_lines_keeps_its_meaning(answer: str) -> None:
    found = sledge().check(answer + ROWS)
    assert "u_sled" not in found.to_text() and "u_bob" not in found.to_text(), found.to_text()
