"""A velocity behind the name of a body is that of this body: "hook: v2 = ẏ" is wrong, though the trolley has ẏ.

Oracle: by hand, a trolley at y with a hook that a winch lets out by u along the same line, and a spring to the trolley:

    T = ½ m1 ẏ² + ½ m2 (ẏ + u̇)²
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg


@cache
def hoist() -> lg.Derivation:
    """A trolley, and a hook on a spring and a damper that runs along the same rail."""
    s = lg.System("trolley with a hook")
    y, u = s.coordinates("y u")
    m1, m2, k, b = s.parameters("m1 M k b")
    s.particle(m1, at=s.point("A", (y, 0)), name="trolley")
    s.particle(m2, at=s.point("B", (y + u, 0)), name="hook")
    s.spring(k, deflection=u, name="cable")
    s.damper(b, deflection=u, name="buffer")
    return s.derive()


def sheet(first: str, second: str, hook: str) -> str:
    """An answer with the velocities of both, and the kinetic energy with that of the hook."""
    return f"{first}\n{second}\nT = 1/2 m1 y'^2 + 1/2 M ({hook})^2\nV = 1/2 k u^2"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("said", "value", "ending"),
    [
        ("hook: v2 = y'", "y'", "speed of particle 'hook' is u' + y', not y': the term u' is missing."),
        ("hook:  v = u'", "u'", "speed of particle 'hook' is u' + y', not u': the term y' is missing."),
        ("speed of the hook: v = u' - y'", "u' - y'", "speed of particle 'hook' is "),
        ("Hook: v_2 = 2 y' + u'", "2 y' + u'", "speed of particle 'hook' is u' + y', not u' + 2*y'"),
    ],
)
def test_the_velocity_of_another_body_is_the_mistake(said: str, value: str, ending: str) -> None:
    verdict = hoist().check(sheet("trolley: v1 = y'", said, value))
    wrong = [(f.line.number, f.follows) for f in verdict.findings if not f.status.right]
    assert wrong == [(2, False), (3, True)]
    (mistake,) = verdict.mistakes
    assert str(mistake.what).startswith("Line 2 is not right: the ")
    assert ending in str(mistake.what)


@pytest.mark.parametrize(
    ("said", "note"),
    [
        ("hook: v2 = y' + u'", ""),
        ("buffer of the hook: v = u'", "velocity of damper 'buffer'"),
        ("hook, relative to the trolley: v = u'", "velocity of damper 'buffer'"),
    ],
)
def test_what_is_right_of_what_is_said_is_right(said: str, note: str) -> None:
    verdict = hoist().check(sheet("trolley: v1 = y'", said, "y' + u'"))
    assert verdict.right
    notes = [str(f.note) for f in verdict.findings if f.line.number == 2]
    assert not notes or note in notes[0]


def test_the_velocity_of_a_damper_is_not_right_of_a_body() -> None:
    verdict = hoist().check(sheet("trolley: v1 = y'", "hook: v = u'", "y' + u'"))
    assert not [f for f in verdict.findings if f.line.number == 2 and f.status.right]
