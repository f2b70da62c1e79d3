"""The pieces that are looked for before a form stand in everything that the form reads."""

from __future__ import annotations

import pytest

from lagrangian.check.reading.said.own_names import _CUES as OF_LETTERS
from lagrangian.check.reading.said.senses import _CUES as OF_WAYS
from lagrangian.check.reading.said.senses import stated_senses

WAYS = [
    "to the right",
    "rightwards",
    "nach rechts",
    "to the left",
    "leftward",
    "nach links",
    "uphill",
    "upward",
    "up the slope",
    "hangaufwärts",
    "bergauf",
    "nach oben",
    "downhill",
    "downwards",
    "down an incline",
    "hangabwärts",
    "bergab",
    "nach unten",
    "forwards",
    "vorwärts",
    "nach vorne",
    "backwards",
    "rückwärts",
    "nach hinten",
    "to starboard",
    "to port",
    "counterclockwise",
    "anti-clockwise",
    "gegen den Uhrzeigersinn",
    "CLOCKWISE",
    "im Uhrzeigersinn",
]
LETTERS = [
    "x instead of s",
    "x in place of s",
    "x in lieu of s",
    "x rather than s",
    "x statt s",
    "x anstatt s",
    "x anstelle von s",
    "x an Stelle von s",
    "x stands for s",
    "x replaces s",
    "x corresponds to s",
    "x takes the place of s",
    "x steht für s",
    "x ersetzt s",
    "x entspricht s",
    "x (= s)",
    "x (≙ s)",
    "for s I write x",
    "für s schreibe ich x",
    "renamed s to x",
    "replacing s by x",
    "s is called x",
    "s is written as x",
    "s HEISST x",
    "s heißt x",
]


@pytest.mark.parametrize("way", WAYS)
def test_every_way_is_found(way: str) -> None:
    assert any(piece in way.casefold() for piece in OF_WAYS)
    assert stated_senses(f"N ({way})", ["N"])


@pytest.mark.parametrize("said", LETTERS)
def test_every_form_of_a_letter_has_a_piece(said: str) -> None:
    assert any(piece in said.casefold() for piece in OF_LETTERS)
