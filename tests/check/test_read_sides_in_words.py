"""Sides in words in the middle of an equation, and values of names in passing in a list of notation."""

from __future__ import annotations

import pytest

import lagrangian as lg
from built_in import derivation
from student_answers import CART, POLE, right

ROD = "(J + m l^2) theta'' = moment of the weight − moment of inertia forces = m g l sin(theta) - m l x'' cos(theta)"
WORDS = [
    "M x'' + m (x'' + l theta'' cos(theta) - l theta'^2 sin(theta)) = drive + friction = F - b x'",
    "M x'' + m (x'' + l theta'' cos(theta) - l theta'^2 sin(theta)) = Antrieb − Reibung des Wagens\n   = F - b x'",
    "M x'' + m (x'' + l theta'' cos(theta) - l theta'^2 sin(theta)) = sum of all forces = F - b x'",
]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("cart", WORDS)
def test_a_side_in_words_says_what_the_terms_are(cart: str) -> None:
    assert right(f"{cart}\n{POLE}")
    assert not right(f"{cart.replace('F - b', 'F + b')}\n{POLE}")
    assert not right(f"{cart.replace('- l theta', '+ l theta')}\n{POLE}")
    assert right(f"{CART}\n{ROD}") and not right(f"{CART}\n{ROD.replace('= m g', '= -m g')}")


def test_a_sentence_is_no_name_though_its_words_stand_elsewhere_too() -> None:
    title = "The pole: moment of momentum about the hinge; sum of forces for the cart"
    rod = ROD.replace("moment of the weight − moment of inertia forces", "sum of moments about hinge")
    assert right(f"{title}\n{CART}\n{rod}") and not right(f"{title}\n{CART}\n{rod.replace('= m g', '= -m g')}")


def test_a_word_that_is_a_name_is_no_word() -> None:
    drive = "M x'' + m (x'' + l theta'' cos(theta) - l theta'^2 sin(theta)) = drive = F - b x'"
    assert right(f"drive = F - b x'\n{drive}\n{POLE}")
    assert not right(f"drive = F + b x'\n{drive}\n{POLE}")


def test_a_list_of_notation_with_words_says_what_names_are() -> None:
    cart = CART.replace("M", "Mc").replace("theta'", "thd").replace("x'", "xd").replace("thd'", "thdd")
    pole = POLE.replace("theta'", "thd").replace("x'", "xd").replace("thd'", "thdd")
    said = "thd = first derivative, thdd = second derivative of theta, xd, xdd the same for x, Mc = M."
    cart, pole = cart.replace("xd'", "xdd"), pole.replace("xd'", "xdd")
    assert right(f"{cart}\n{pole}\n\n{said}")
    assert not right(f"{cart}\n{pole}\n\n{said.replace('Mc = M', 'Mc = m')}")


VIRTUAL = """Principle of virtual work (d'Alembert): xs = x + l sin(theta), ys = l cos(theta)
d(xs) = dx + l cos(theta) dtheta, d(ys) = -l sin(theta) dtheta
0 = (F - b x' - M x'') dx - J theta'' dtheta - m xs'' d(xs) - m (ys'' + g) d(ys)"""


def test_virtual_displacements_may_be_written_as_differentials() -> None:
    assert right(f"{VIRTUAL}\n{CART}\n{POLE}")
    assert not right(f"{VIRTUAL}\n{CART}\n{POLE.replace('- m g', '+ m g')}")
    assert right(VIRTUAL) and not right(VIRTUAL.replace("- J", "+ J"))


def test_a_damper_d_makes_no_virtual_displacement_of_a_rate() -> None:
    sys = lg.System("damped mass")
    y = sys.coordinate("y")
    m, d, g = sys.parameters("m d g")
    sys.kinetic(m * y.diff() ** 2 / 2)
    sys.potential(m * g * y)
    sys.damper(d, deflection=y)
    assert sys.derive().check("Virtual work:\n\nmÿ = −dẏ − mg", hint=0).right
    assert not sys.derive().check("Virtual work:\n\nmÿ = dẏ − mg", hint=0).right


@pytest.mark.parametrize("words", ["for a 1-dof system we have: ", "As a 2-DOF system: "])
def test_degrees_of_freedom_with_a_number_are_words(words: str) -> None:
    assert right(f"{CART}\n{words}{POLE}")
    assert not right(f"{CART}\n{words}{POLE.replace('m g l', '2 m g l')}")


@pytest.mark.slow
def test_an_equation_that_ends_in_a_word_states_no_force() -> None:
    general = "For one degree of freedom, the moments about P give J_P theta'' = moment, with"
    answer = f"{general} J_P = m l^2/3:\nJ_P theta'' + m g l/2 cos theta = 0\nx = l/2 cos theta, y = l/2 sin theta"
    ladder = derivation("ladder")
    assert ladder.check(answer, hint=0).right
    assert not ladder.check(answer.replace("+ m g", "- m g"), hint=0).right
    assert not ladder.check(answer.replace("l^2/3", "l^2/12"), hint=0).right
    explained = answer.replace("with J_P", "moment = m g l sin theta, with J_P")
    assert not ladder.check(explained, hint=0).right
