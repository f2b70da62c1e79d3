"""A mistake in what a force or a damper adds belongs to step 6, and only the elements that it concerns are named."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import pytest

import lagrangian as lg
from built_in import derivation
from lagrangian.check.explain import say
from lagrangian.check.explain.changes.pool import pool_of
from lagrangian.check.reference import truth_of
from lagrangian.check.words import STEPS, step_title


@cache
def turntable() -> lg.Derivation:
    """A mass in springs and dampers on a turntable, in axes that turn with it."""
    return lg.loads("""
name = "turntable"
[coordinates]
x = ""
y = ""
[parameters]
m = "1 kg"
Omega = "3 rad/s"
k = "40 N/m"
c = "0.4 N*s/m"
[inputs]
f = "N"
[points]
P = ["x*cos(Omega*t) - y*sin(Omega*t)", "x*sin(Omega*t) + y*cos(Omega*t)"]
[[particle]]
mass = "m"
at = "P"
[[spring]]
k = "k"
deflection = "x"
[[damper]]
name = "along x"
b = "c"
deflection = "x"
[[damper]]
name = "along y"
b = "c"
deflection = "y"
[[force]]
name = "actuator"
value = "f"
deflection = "x"
""").derive()


X = "m*(x'' - 2*Omega*y' - Omega^2*x) + k*x"
Y = "m*(y'' + 2*Omega*x' - Omega^2*y)"


@pytest.mark.slow
def test_dampers_with_the_velocity_against_the_fixed_axes() -> None:
    verdict = turntable().check(f"{X} + c*(x' - Omega*y) = f\n{Y} + c*(y' + Omega*x) = 0")
    (mistake,) = verdict.mistakes
    assert (mistake.name, mistake.step) == ("damper_other_velocity", 6)
    assert "along x" in str(mistake.what) and "along y" in str(mistake.what)


@pytest.mark.slow
def test_a_force_along_fixed_axes() -> None:
    verdict = turntable().check(f"{X} + c*x' = f*cos(Omega*t)\n{Y} + c*y' = -f*sin(Omega*t)")
    assert {m.step for m in verdict.mistakes} == {6}
    assert {m.element for m in verdict.mistakes} == {"force 'actuator'"}


def test_a_damper_with_the_velocity_of_the_body_that_swings() -> None:
    verdict = derivation("cart-pole").check(
        "(M+m)*x'' + b*(x' + l*theta'*cos(theta)) + m*l*cos(theta)*theta'' - m*l*sin(theta)*theta'^2 = F\n"
        "(J+m*l^2)*theta'' + m*l*cos(theta)*x'' - m*g*l*sin(theta) + b*l*cos(theta)*(x' + l*theta'*cos(theta)) = 0"
    )
    (mistake,) = verdict.mistakes
    assert (mistake.name, mistake.step) == ("damper_other_velocity", 6)


@pytest.mark.parametrize(
    ("name", "answer", "element"),
    [
        ("pendulum", "m*L^2*theta'' + m*g*L*sin(theta) + b*theta' + b*sin(theta)*theta'^2 = 0", "damper 'b'"),
        ("pendulum", "m*L^2*theta'' + m*g*L*sin(theta) + b*theta' + 7*b*theta^2 = 0", "damper 'b'"),
    ],
)
def test_a_term_with_a_letter_of_a_damper_belongs_to_step_6(name: str, answer: str, element: str) -> None:
    (mistake,) = derivation(name).check(answer).mistakes
    assert (mistake.step, mistake.element) == (6, element)
    assert "A damper feels" in str(mistake.why)


def test_a_mistake_concerns_its_own_elements() -> None:
    verdict = derivation("cart-pole").check(
        "(M+m)*x'' - b*x' + m*l*cos(theta)*theta'' = F\n(J+m*l^2)*theta'' + m*l*cos(theta)*x'' - m*g*l*sin(theta) = 0"
    )
    assert len(verdict.mistakes) == 2
    (about,) = [line for line in " ".join(str(verdict).split()).split("This belongs to ") if line.startswith("step 5")]
    assert "damper" not in about.split(".")[0]


@pytest.mark.parametrize(("arm", "said"), [("", "The arm R is missing"), ("/R", "R is not squared")])
def test_an_arm_is_not_squared_only_where_it_stands(arm: str, said: str) -> None:
    (mistake,) = derivation("rolling-cylinder").check(f"(J{arm} + m)*x'' = m*g*sin(alpha)").mistakes
    assert mistake.name == "arm_not_squared"
    assert str(mistake.what).startswith(said)


def test_a_force_that_does_no_work_is_counted_where_it_does_none() -> None:
    answer = "(M+m)*x'' + b*x' + m*l*cos(theta)*theta'' - m*l*sin(theta)*theta'^2 = F\n"
    answer += "(J+m*l^2)*theta'' + m*l*cos(theta)*x'' - m*g*l*sin(theta) = F/l"
    (mistake,) = derivation("cart-pole").check(answer).mistakes
    assert mistake.element == "force 'F'" and mistake.step == 6
    assert "is counted in the equation of theta, where it does no work" in str(mistake.what)


def test_speeds_on_one_line_are_not_called_vectors() -> None:
    s = lg.System("two on a line")
    x, y = s.coordinates("x y")
    m, k = s.parameters("m k")
    s.particle(m, at=s.origin + (x, 0), name="one")
    s.particle(m, at=s.origin + (x + y, 0), name="two")
    s.spring(k, deflection=x + y)
    (mistake,) = s.derive().check("V = k*(x + y)^2/2\nT = m*x'^2/2 + m*(x' - y')^2/2").mistakes
    assert (mistake.name, mistake.element) == ("velocity_part_sign", "particle 'two'")
    assert "y' has the wrong sign" in str(mistake.what)


def test_units_are_no_reason_for_a_sine_that_is_missing() -> None:
    (mistake,) = derivation("bead-on-hoop").check("T = m*R^2*theta'^2/2 + m*R^2*Omega^2/2").mistakes
    assert "sin" in str(mistake.what) and "units" not in str(mistake.why)


def test_a_wrong_number_is_shown_in_the_form_of_the_right_term() -> None:
    verdict = derivation("bead-on-hoop").check(
        "m*R^2*theta'' - m*R^2*Omega^2*sin(theta)*cos(theta)/2 + m*g*R*sin(theta) = 0"
    )
    (difference,) = verdict.findings[0].differences
    assert 2 * difference.written == difference.term


@pytest.mark.slow
def test_the_root_of_a_deflection_is_drawn() -> None:
    d = lg.loads("""
name = "a mass on a spring that swings"
coordinates.r = { unit = "m", positive = true }
coordinates.theta = ""
parameters = { m = "1 kg", k = "30 N/m", l = "0.4 m" }
points.B = ["r*sin(theta)", "-r*cos(theta)"]
[[particle]]
mass = "m"
at = "B"
[[spring]]
k = "k"
between = ["origin", "B"]
rest = "l"
""").derive()
    changes = [p.change for p in pool_of(truth_of(d)).all if p.change is not None]
    said = [str(say.mistake(c, Fraction(1), d.model).what) for c in changes if c.kind == "deflection_left_out"]
    assert any("is taken as r; it is" in words for words in said)
    assert not any("sqrt" in words for words in said)


def test_titles_of_steps_in_sentences_keep_the_capitals_of_names() -> None:
    assert [step_title(step) for step in (3, 4, 5)] == ["potential energy", "Lagrangian", "left-hand sides"]
    assert all(step_title(step).lower() == title.lower() for step, title in STEPS.items())


@pytest.mark.parametrize(
    ("name", "answer", "said"),
    [
        ("pendulum", "V = m*g*L*(1 - cos(theta))", "right: V may differ by a constant"),
        (
            "pendulum",
            "T = m*L^2*theta'^2\nV = -m*g*L*cos(theta)\nL = m*L^2*theta'^2 + m*g*L*cos(theta)",
            "line 3 (ℒ) not right, but only because of line 1 (T*)",
        ),
        (
            "rolling-cylinder",
            "T = 1/2*m*x'^2 + 3*J*x'^2/R^2",
            "has a wrong factor. Compare the units and the numbers of this term with those of its neighbours. This "
            "belongs to step 2, kinetic co-energy; it concerns the cylinder.",
        ),
    ],
)
def test_a_verdict_speaks_to_a_student_in_plain_words(name: str, answer: str, said: str) -> None:
    assert said in " ".join(str(derivation(name).check(answer, hint=2)).split())
