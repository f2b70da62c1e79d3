"""Reads what a program states that was carried out on symbols, with its comments where these can be read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import sympy as sp

from lagrangian.check.reading.answer import Answer, AnswerLine
from lagrangian.check.reading.carried_out.stated import CarriedOut, carried_out
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.reading.marked_values import Marks, with_marks
from lagrangian.check.reading.programs.marks import in_comment
from lagrangian.errors import ParseError
from lagrangian.model import Model

CARRIED_OUT = "The program was carried out on symbols, and what it computes was judged."
"""The note on a program whose lines are not read as they stand."""
COMMENTS_LEFT_OUT = "Its comments could not be read and were not judged."


def read_program(program: CarriedOut, text: str, model: Model, read: Callable[[str], Answer]) -> Answer:
    """Return what ``read`` makes of the text of a program, or of what it states when it is carried out, where it states
    an equation of motion in comments at most."""
    by_steps = partial(_stated_by_steps, program, text, model, read)
    computed = partial(read, program.bare)
    typed: Answer | ParseError
    try:
        typed = read(text)
    except ParseError as error:
        typed = error
    moving = [] if isinstance(typed, ParseError) or typed.doubt is not None else equations_of_motion(typed)
    if all(in_comment(text, x.place) for x in moving):
        try:
            steps = by_steps()
        except ParseError:
            if isinstance(typed, ParseError):
                raise typed from None
        else:
            comments = typed
            if isinstance(comments, ParseError) or not moving:
                return steps
            return replace(steps, others=(lambda: comments,), computed=computed)
    assert isinstance(typed, Answer)
    return replace(typed, others=(*typed.others, by_steps), computed=computed)


def equations_of_motion(answer: Answer) -> list[AnswerLine]:
    """The equations with accelerations in an answer: where only a program has some, that is judged."""
    return [x for x in answer.lines if x.kind == "equation" and accelerates(sp.sympify(x.residual))]


def _stated_by_steps(program: CarriedOut, text: str, model: Model, read: Callable[[str], Answer]) -> Answer:
    """Return what ``read`` makes of a program and, with marks, of its ``text``; `ParseError` if it cannot be read."""

    def marked(marks: Marks) -> Answer:
        again = carried_out(text, model, marks)
        if again is None:
            raise ParseError("the program cannot be carried out with marks", code="E701")
        return _read_steps(again, read)

    return replace(_read_steps(program, read), marked=lambda: with_marks(text, marked))


def _read_steps(program: CarriedOut, read: Callable[[str], Answer]) -> Answer:
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
    used = ("nothing else uses ", "no equation uses this matrix ")  # nor does anything in a program that is carried out
    told = tuple(x for x in found.notes if not any(y in x for y in used))
    return replace(found, notes=(*notes, *program.notes, *told), program=True)
