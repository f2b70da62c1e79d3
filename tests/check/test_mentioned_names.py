"""Names of the answer's own of which words say something that is not read: they are asked about, not called wrong.

Oracle: by hand; each of these answers is right if its words are believed, and nobody can tell without them.
"""

from __future__ import annotations

import pytest
from small_systems import mass, pendulum, rod

import lagrangian as lg
from lagrangian.check import Status
from lagrangian.check.reading.said.mentioned import mentioned_names
from lagrangian.errors import ParseError


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("answer", "of", "name"),
    [
        (
            "m x'' = F - K - b x'\nIn all this K should be taken as nothing other than the rubber's pull, k times x.",
            mass(),
            "K",
        ),
        ("m x'' = F - A\nA is what spring and damper take together, namely k x and b x' summed.", mass(), "A"),
        ("m x'' + K + b x' = F\nK: the force of the spring (stiffness times stretch)", mass(), "K"),
        ("m x'' + B + k x = F\nB: the force of the damper (b times speed)", mass(), "B"),
        ("m l^2 phi'' + b phi' + G = M\nHere G, obviously, the weight's moment m g l sin(phi).", pendulum(), "G"),
    ],
)
def test_a_name_whose_explanation_was_not_read_is_asked_about(answer: str, of: lg.Derivation, name: str) -> None:
    with pytest.raises(ParseError, match=f"what is '{name}'.*what the answer says of it was not understood"):
        of.check(answer)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("answer", "of"),
    [
        ("m x'' - K x + b x' = F\nK is the stiffness of the spring, N/m", mass()),
        ("m x'' + K x - b x' = F\nK: spring constant", mass()),
        ("(J + m r^2) phi'' + A = M\nm r'' - m r phi'^2 - k (r - a) = 0\nA is a sum that I wrote above", rod()),
        ("A pushes the puck.\nJ phi'' = M - A r\nm (r phi'' + r' phi') = A\nm r'' - m r phi'^2 + k (r - a) = 0", rod()),
        ("m l^2 phi'' + b phi' - m g l sin(phi) = M\nM: torque of the motor times nothing else", pendulum()),
    ],
)
def test_a_wrong_answer_is_told_so_where_no_such_words_matter(answer: str, of: lg.Derivation) -> None:
    """A constant that words describe, a wrong line with known names alone, and a force that is eliminated."""
    assert of.check(answer).status is Status.WRONG


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("K ... static moment, (m*l/2)*g", {"K"}),
        ("K ... stiffness, N/m", set[str]()),
        ("Let A be the bracket of the first line.", {"A"}),
        ("A is the point of contact", set[str]()),
        ("the pull of the spring (K) and its k times x", {"K"}),
        (r"Mit $A$ bezeichne ich die Summe aller Kräfte.", {"A"}),
        ("m x'' = F - A", set[str]()),
    ],
)
def test_what_words_say_of_a_name(text: str, found: set[str]) -> None:
    assert mentioned_names(text, ["A", "K"]) == found
