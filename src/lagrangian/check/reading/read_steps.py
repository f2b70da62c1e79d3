"""Reads what a program states that was carried out on symbols, with its comments where these can be read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lagrangian.check.reading.answer import Answer
from lagrangian.check.reading.carried_out.stated import CarriedOut
from lagrangian.errors import ParseError

CARRIED_OUT = "The program was carried out on symbols, and what it computes was judged."
"""The note on a program whose lines are not read as they stand."""
COMMENTS_LEFT_OUT = "Its comments could not be read and were not judged."


def read_steps(program: CarriedOut, read: Callable[[str], Answer]) -> Answer:
    """Return what ``read`` makes of a program; `ParseError` if that cannot be read."""
    notes: tuple[str, ...] = (CARRIED_OUT,)
    try:
        found = read(program.text)
        unread = found.doubt is not None
    except ParseError:
        if program.bare == program.text:
            raise
        found, unread = None, True
    if found is None or (unread and program.bare != program.text):
        found, notes = read(program.bare), (CARRIED_OUT, COMMENTS_LEFT_OUT)
    told = tuple(x for x in found.notes if "nothing else uses " not in x)  # nor does a program that is carried out
    return replace(found, notes=(*notes, *program.notes, *told), program=True)
