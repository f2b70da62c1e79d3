"""Answers in other coordinates: stated, named, or without a word; and what is not let through as such."""

import pytest
import sympy as sp

from built_in import derivation as derived
from lagrangian import System
from lagrangian.check import Status
from lagrangian.errors import ParseError

RELATIVE = "(m1 + m2)*x1'' + m2*{s}'' = 0\nm2*x1'' + m2*{s}'' + k*{s} = F"
ABSOLUTE = "m1*x1'' - k*({x} - x1) = -F\nm2*{x}'' + k*({x} - x1) = F"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("name", "answer"),
    [
        ("lecture-3a", RELATIVE.format(s="x2")),
        ("lecture-3a", RELATIVE.format(s="x2r")),
        ("lecture-3a", RELATIVE.format(s="s")),
        ("lecture-3a", "x2 = x1 + s\n" + RELATIVE.format(s="s")),
        ("lecture-3b", ABSOLUTE.format(x="x2")),
        ("lecture-3b", ABSOLUTE.format(x="x2r")),
        ("lecture-3b", "T = m1*x1'^2/2 + m2*x2'^2/2\nV = k*(x2 - x1)^2/2"),
        ("pendulum", "m*L^2*phi'' + b*phi' - m*g*L*sin(phi) = 0"),
        ("pendulum", "m*L^2*phi'' + b*phi' + m*g*L*cos(phi) = 0"),
    ],
)
def test_right_in_other_coordinates(name: str, answer: str) -> None:
    verdict = derived(name).check(answer)
    assert verdict.status is Status.OTHER_COORDINATES, verdict.to_text()
    assert verdict.right and verdict.change


def test_a_name_defined_by_the_answer_is_no_other_coordinate() -> None:
    verdict = derived("lecture-3b").check("x2 = x1 + x2r\n" + ABSOLUTE.format(x="x2"))
    assert verdict.right and not verdict.change


def test_measured_from_the_place_of_rest() -> None:
    s = System("hanging mass")
    x = s.coordinates("x")
    m, k = s.parameters("m k")
    s.particle(m, at=s.origin + (0, -x))
    s.gravity()
    s.spring(k, deflection=x)
    hanging = s.derive()
    assert hanging.check("m*y'' + k*y = 0", hint=0).status is Status.OTHER_COORDINATES
    verdict = hanging.check("m*x'' + k*x = 0")
    assert not verdict.right
    assert verdict.mistake is not None and verdict.mistake.name == "gravity_forgotten"
    assert any("It would be right with" in str(note) for note in verdict.notes)


def test_a_direction_that_the_answer_does_not_state_makes_nothing_right() -> None:
    """The equations of whoever counts the first cart to the left: who must say so."""
    rows = "m1*x1'' + k*(x1 + x2) = F\nm2*x2'' + k*(x1 + x2) = F"
    verdict = derived("lecture-3a").check(rows)
    assert verdict.status is Status.WRONG
    told = "It would be right with x1 counted the other way round. Say so in your answer if that is what you mean."
    assert told in [str(note) for note in verdict.notes], verdict.notes
    stated = derived("lecture-3a").check(f"u = -x1\n{rows.replace('x1', 'u')}")
    assert stated.right
    assert not any("would be right" in str(note) for note in stated.notes)


@pytest.mark.slow
def test_one_energy_alone_does_not_tell_a_relative_angle_from_a_wrong_one() -> None:
    answer = (
        "V = m1*g*L_a*sin(theta1) + m2*g*(L_a + L_b)*sin(theta1) + m3*g*((L_a + L_b)*sin(theta1) + L_c*sin(theta2))"
    )
    assert not derived("lecture-2").check(answer, hint=0).right


def test_wrong_in_other_coordinates_is_explained_there() -> None:
    verdict = derived("lecture-3b").check(ABSOLUTE.format(x="x2").replace("= -F", "= F"))
    assert verdict.status is Status.WRONG
    assert verdict.first_wrong is not None and verdict.first_wrong.line.number == 1
    assert [d.kind for d in verdict.first_wrong.differences] == ["sign"]
    assert verdict.mistake is not None and verdict.mistake.name == "reaction_sign"


@pytest.mark.slow
def test_letters_and_numbers_that_mean_a_parameter_are_read_and_told() -> None:
    verdict = derived("lecture-3a").check("m1*x1'' + c*(x1 - x2) = -F\nm2*x2'' + c*(x2 - x1) = F")
    assert verdict.right and "'c' was read as k." in map(str, verdict.notes)
    verdict = derived("pendulum").check("m*L^2*theta'' + b*theta' + 9.81*m*L*sin(theta) = 0")
    assert verdict.right and "9.81 was read as g." in map(str, verdict.notes)
    verdict = derived("pendulum").check("0.25*theta'' + 0.02*theta' + 4.905*sin(theta) = 0")
    assert verdict.right and "are substituted" in str(verdict.notes[-1])
    verdict = derived("pendulum").check("0.25*theta'' + 0.02*theta' + 4.906*sin(theta) = 0")
    assert not verdict.right
    with pytest.raises(ParseError, match=r"what is 'c'.*\n(.*\n)*.*what is 'w'"):
        derived("lecture-3a").check("m1*x1'' + c*(x1 - x2) = -F + w\nm2*x2'' + c*(x2 - x1) = F")


def test_a_mistake_is_named_where_a_coordinate_is_abbreviated() -> None:
    verdict = derived("pendulum").check("m*L^2*th'' - b*th' + m*g*L*sin(th) = 0")
    assert not verdict.right and any("th" in str(note) for note in verdict.notes)
    assert verdict.mistake is not None and verdict.mistake.name == "damper_sign"


@pytest.mark.slow
def test_an_angle_may_be_given_by_its_tangent() -> None:
    s = System("collar on a rod, pulled by a rope over a pulley")
    y = s.coordinates("y")
    m, M, h, g = s.parameters("m M h g")
    s.particle(m, at=s.origin + (h, -y))
    s.particle(M, at=s.origin + (0, sp.sqrt(h**2 + y**2)))
    s.gravity((0, -1), g)
    d = s.derive()
    rows = (
        "I use the angle alpha of the rope; y = h*tan(alpha), the rope is h/cos(alpha).\n"
        "y' = h*alpha'/cos(alpha)^2\n"
        "T = h^2*(m + M*sin(alpha)^2)*alpha'^2/(2*cos(alpha)^4)\nV = -m*g*h*tan(alpha) + M*g*h/cos(alpha)\n"
        "h^2*(m + M*sin(alpha)^2)/cos(alpha)^4*alpha'' + h^2*(M*sin(alpha)/cos(alpha)^3 "
        "+ 2*(m + M*sin(alpha)^2)*sin(alpha)/cos(alpha)^5)*alpha'^2 - m*g*h/cos(alpha)^2 "
        "+ M*g*h*sin(alpha)/cos(alpha)^2 = 0"
    )
    assert d.check(rows).right
    assert not d.check(rows.replace("V = -m", "V = m")).right
    assert not d.check(rows.replace("h*tan", "h*sin")).right
