"""Answers in numbers, and which of several explanations is told, against mistakes made by hand.

Oracle: the values of the model file put in by hand; a motor's torque N kₜ (U − kₜ N ṡ/r)/(r R) with its back-EMF.
"""

from functools import cache

import pytest

from built_in import derivation
from lagrangian import examples, loads
from lagrangian.check import Status
from lagrangian.derivation import Derivation
from lagrangian.errors import ParseError

MOTOR = """
name = "cart with a motor"
[coordinates]
s = "position"
[parameters]
M = "1.5 kg"
r_w = "30 mm"
k_t = "0.05 N m/A"
R = "1.2 ohm"
[inputs]
U = "V, motor voltage"
[define]
i_m = "(U - k_t*s'/r_w)/R"
[points]
C = ["s", "0"]
[[particle]]
mass = "M"
at = "C"
[[force]]
name = "motor"
value = "k_t*i_m/r_w"
deflection = "s"
"""
PENDULUM = (
    "0.5*r'' - 0.5*r*theta'^2 + 30*(r - {l}) - {w}*cos(theta) = 0\nr*theta'' + {c}*r'*theta' + {g}*sin(theta) = 0"
)


@cache
def derived(name: str) -> Derivation:
    return loads(MOTOR).derive() if name == "motor" else derivation(name)


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("l", "w", "c", "g", "right"),
    [
        ("0.6", "4.905", "2", "9.81", True),
        ("0.6", "0.5*9.81", "2", "9.81", True),
        ("0.6", "4.905", "2", "9.8", False),
        ("0.5", "4.905", "2", "9.81", False),
        ("0.6", "4.905", "1", "9.81", False),
    ],
)
def test_a_number_may_be_g_or_a_value(l: str, w: str, c: str, g: str, right: bool) -> None:
    assert derived("elastic-pendulum").check(PENDULUM.format(l=l, w=w, c=c, g=g), hint=0).right is right


@pytest.mark.slow
def test_energies_in_letters_go_with_equations_in_numbers_alone() -> None:
    energies = "T = m/2*(r'^2 + r^2*theta'^2)\nV = k/2*(r - L_0)^2 - m*g*r*cos(theta)\nwith m*g = 4.905 N\n"
    numbers = PENDULUM.format(l="0.6", w="4.905", c="2", g="9.81")
    judge = derivation("elastic-pendulum")
    assert judge.check(energies + numbers, hint=0).right
    assert not judge.check(energies + numbers.replace("2*r'", "1*r'"), hint=0).right
    assert not judge.check(energies.replace("m*g*r", "g*r") + numbers, hint=0).right


def test_what_is_wrong_in_numbers_is_told_in_the_answers_numbers() -> None:
    verdict = derived("elastic-pendulum").check(PENDULUM.format(l="0.5", w="4.905", c="2", g="9.81"))
    assert verdict.first_wrong is not None
    (difference,) = verdict.first_wrong.differences  # 30 · 0.5 in place of 30 · 0.6
    assert (difference.written, difference.term) == (-15, -18)
    verdict = derived("elastic-pendulum").check(PENDULUM.format(l="0.6", w="4.905", c="1", g="9.81"))
    assert verdict.first_wrong is not None
    (difference,) = verdict.first_wrong.differences
    assert difference.term == 2 * difference.written and "½" not in verdict.to_text()
    assert verdict.mistake is not None and verdict.mistake.name == "coriolis_half"


@pytest.mark.slow
def test_numbers_in_other_coordinates() -> None:
    answer = "0.5*x'' + 30*x*(1 - 0.6/sqrt(x^2 + y^2)) = 0\n0.5*y'' + 30*y*(1 - 0.6/sqrt(x^2 + y^2)) + {w} = 0"
    assert derived("elastic-pendulum").check(answer.format(w="4.905"), hint=0).status is Status.OTHER_COORDINATES
    assert not derived("elastic-pendulum").check(answer.format(w="4.9"), hint=0).right


@pytest.mark.parametrize(
    ("name", "answer", "mistake"),
    [
        ("motor", "M*s'' = k_t*U/(R*r_w)", "effort_term_forgotten"),
        (
            "two-disk-shaft",
            "J1*phi1'' + b*phi1' + k*(phi1 - phi2) = tau\n"
            "J2*phi2'' + b*(phi2' - phi1') + b_load*phi2' + k*(phi2 - phi1) = 0",
            "damper_rate_not_relative",
        ),
    ],
)
def test_what_was_left_out_of_a_force_is_no_question_of_its_direction(name: str, answer: str, mistake: str) -> None:
    verdict = derived(name).check(answer)
    assert verdict.mistake is not None and verdict.mistake.name == mistake, verdict.to_text()
    assert "cos of the angle" not in verdict.to_text()


LONG_NAMES = loads(
    examples.text("cart-pole").replace("\nl = {", "\nlength = {").replace('"l"', '"length"').replace("l*", "length*")
).derive()


@pytest.mark.sampled(9)
@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ("(M + m)*x'' + m*length*cos(thta)*theta'' = F", "no 'thta'. Did you mean 'theta'?"),
        ("(M + m)*x'' + m*length*cos(theta)*thta'' = F", "no 'thta'. Did you mean 'theta'?"),
        ("(M + m)*x'' + m*length*lenght*cos(theta)*theta'' = F", "no 'lenght'. Did you mean 'length'?"),
        (r"(M + m) \ddot x + m length lenght \cos\theta \ddot\theta = F", "no 'lenght'. Did you mean 'length'?"),
        (r"(M + m) \ddot x + m \mathrm{lenght} \cos\theta \ddot\theta = F", "'lenght' was read as length."),
        (r"(M + m) \ddot x + m lenght \cos\theta \ddot\theta = F", "'lenght' was read as length."),
        ("(M + m)*x'' + m*length*phi'' = F", "The system has no 'phi'."),
    ],
)
def test_a_misspelled_name_is_answered_with_the_one_that_is_meant(answer: str, said: str) -> None:
    notes = " ".join(map(str, LONG_NAMES.check(answer).notes))
    assert said in notes, notes


def test_letters_side_by_side_are_still_a_product() -> None:
    """Runs of letters are names that were misspelled only where they are no product of names."""
    verdict = LONG_NAMES.check(r"\text{T} = \frac12 mlength^2")
    assert not any("mlength" in str(note) for note in verdict.notes)


def test_a_misspelled_command_is_answered_with_the_one_that_is_meant() -> None:
    with pytest.raises(ParseError) as caught:
        LONG_NAMES.check(r"M \ddot{x} + \thta = F")
    assert caught.value.fix == r"Did you mean '\theta'?"
