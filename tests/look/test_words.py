"""The sentences that say what a picture shows: true for mechanisms that everybody knows, sensible for all examples."""

import re

import pytest
from sympy import cos, sin

import built_in
import lagrangian as lg
from built_in import SOME, picture
from lagrangian.examples import names

KNOWN = {
    "cart-pole": "A cart on a horizontal track; a pole hinged on the cart. Damper b between the cart and the ground. "
    "Gravity acts; force F acts on the cart. Coordinates: x: cart, along the track; theta: pole, from upright, "
    "positive where it leans forward.",
    "double-pendulum": "Mass m1 on a rod from a fixed point; mass m2 on a rod from mass m1. Gravity acts. Coordinates: "
    "theta1: rod 1, from hanging straight down; theta2: rod 2, from hanging straight down.",
    "lecture-3b": "Cart m1 on a horizontal track; cart m2 on a horizontal track. Spring k between cart m1 and cart m2; "
    "force F between cart m1 and cart m2. Coordinates: x1: cart 1, from where it stands when the spring is relaxed; "
    "x2r: cart 2, relative to cart 1: the stretch of the spring.",
    "four-bar": "A crank hinged on the ground; a coupler hinged on the crank; a rocker hinged on the ground. Pin loop "
    "joins the coupler and the rocker. Gravity acts; torque tau turns the crank. Coordinates: theta1: crank, from the "
    "base; theta2: coupler, from the base; theta3: rocker, from the base.",
    "furuta-pendulum": "An arm hinged on the ground; a pendulum hinged on the arm. Damper b1 between the arm and the "
    "ground; damper b2 between the arm and the pendulum. Gravity acts; torque tau turns the arm. Coordinates: theta1: "
    "arm, about the vertical; theta2: pendulum, about the arm, from hanging straight down.",
    "bead-on-hoop": "Mass m on a hoop that is turned as a function of time. Gravity acts. Coordinates: theta: bead, "
    "from the lowest point of the hoop.",
    "atwood": "Block m1 on a vertical line; block m2 on a vertical line; a pulley on a fixed axle. A string "
    "from block m1 over a fixed pulley to block m2. Gravity acts. Coordinates: x: mass 1, downward.",
    "ball-and-beam": "A ball rolling along the beam; a beam turning about a fixed point. Gravity acts; torque tau "
    "turns the beam. Coordinates: r: ball, along the beam, from the pivot; theta: tilt of the beam, counter-clockwise.",
}


@pytest.mark.parametrize("name", KNOWN)
def test_what_everybody_knows_is_said(name: str) -> None:
    assert picture(name).description == KNOWN[name]


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", names())
def test_every_body_and_coordinate_is_mentioned_in_whole_sentences(name: str) -> None:
    system = built_in.system(name)
    text = picture(name).description
    assert text.endswith(".") and "  " not in text and "None" not in text and len(text) < 3000
    for sentence in re.split(r"(?<=\.) (?=[A-Z])", text):
        assert re.match(r"[A-Z]|[\w']+ ", sentence)
    few = len(system.model.bodies) <= 14 and len(system.model.coordinates) <= 14
    for thing in (*system.model.bodies, *system.model.coordinates):
        assert thing.name in text or not few


@pytest.mark.parametrize(("one", "other"), [("lecture-3a", "lecture-3b"), ("lecture-2", "lecture-2-absolute")])
def test_a_mechanism_is_described_alike_in_all_coordinates(one: str, other: str) -> None:
    first, second = (picture(n).description.partition("Coordinates")[0] for n in (one, other))
    assert first == second


def test_names_cannot_make_it_long() -> None:
    system = lg.System("chain")
    at = system.origin
    for i in range(30):
        q = system.coordinate(f"q{i}", "angle " * 60)
        at = at + (0.1 * sin(q), -0.1 * cos(q))
        system.particle(system.parameter(f"m{i}", 1.0), at=at, name=f"m{i} " + "x" * 150)
    text = system.look(pose={}).description
    assert "more" in text and len(text) < 6000
