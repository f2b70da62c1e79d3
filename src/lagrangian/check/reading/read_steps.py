"""Reads what a program states that was carried out on symbols, with its comments where these can be read."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import sympy as sp

from lagrangian.check.reading.answer import Answer, AnswerLine
from lagrangian.check.reading.carried_out.stated import CarriedOut, carried_out
from lagrangian.check.reading.carried_out.values import NAME
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.reading.marked_values import ValueMarks, with_marks
from lagrangian.check.reading.programs.marks import in_comment
from lagrangian.errors import ParseError
from lagrangian.model import Damper, Model, Spring

CARRIED_OUT = "The program was carried out on symbols, and what it computes was judged."
"""The note on a program whose lines are not read as they stand."""
_COMMENT = re.compile(r"[#%].*|//.*")
COMMENTS_LEFT_OUT = "Its comments could not be read and were not judged."

SCALED = "What the program computes was not judged: it is in quantities without dimensions."
_SCALED = re.compile(
    r"\b(?:(?:dimension|unit)less|non-?[ ]?dimensional\w{0,8}|without dimensions?|dimensionslos\w{0,2}|normiert\w{0,2}"
    r"|adimensional\w{0,2}|adimensionn\w{0,4})\b"
    r"(?:[ \t]*[:,(]|[ \t]{1,4}(?:[\w-]{1,20}[ \t]{1,4}){0,2}(?:time|zeit|temps|variable|form|equation|gleichung"
    r"|quantit|größe|unit|coordinate|model|system|state))",
    re.IGNORECASE,
)
"""Words that say that the quantities or the equations of a program have no dimensions, and not a ratio alone."""


def read_program(program: CarriedOut, text: str, model: Model, read: Callable[[str], Answer]) -> Answer:
    """Return what ``read`` makes of the text of a program, or of what it states when it is carried out, where it states
    an equation of motion in comments at most."""
    by_steps = partial(_stated_by_steps, program, text, model, read)
    computed = partial(read, program.motion)
    opened = partial(_opened, text, model, read)
    typed: Answer | ParseError
    try:
        typed = read(text)
    except ParseError as error:
        typed = error
    moving = [] if isinstance(typed, ParseError) or typed.doubt is not None else equations_of_motion(typed)
    if all(in_comment(text, x.place) for x in moving):
        if moving and isinstance(typed, Answer) and _is_scaled(program, text, model):
            return replace(typed, notes=(*typed.notes, SCALED))
        try:
            steps = by_steps()
        except ParseError:
            if isinstance(typed, ParseError):
                raise typed from None
        else:
            comments = typed
            if isinstance(comments, ParseError) or not moving:
                return replace(steps, others=(opened,))
            return replace(steps, others=(opened, lambda: comments), computed=computed, opened=opened)
    assert isinstance(typed, Answer)
    if _is_scaled(program, text, model):
        return replace(typed, notes=(*typed.notes, SCALED))
    return replace(typed, others=(*typed.others, by_steps), computed=computed, opened=opened)


def _is_scaled(program: CarriedOut, text: str, model: Model) -> bool:
    """Whether a program says that it computes in quantities without dimensions, and has no parameter and no input of
    the system."""
    code = {name for line in text.splitlines() for name in NAME.findall(_COMMENT.sub("", line))}
    said = set(NAME.findall(program.motion))
    plain = said.isdisjoint(p.name for p in model.parameters) and code.isdisjoint(u.name for u in model.inputs)
    return plain and _SCALED.search(text) is not None


def equations_of_motion(answer: Answer) -> list[AnswerLine]:
    """The equations with accelerations in an answer: where only a program has some, that is judged."""
    return [x for x in answer.lines if x.kind == "equation" and accelerates(sp.sympify(x.residual))]


def _stated_by_steps(program: CarriedOut, text: str, model: Model, read: Callable[[str], Answer]) -> Answer:
    """Return what ``read`` makes of a program and, with marks, of its ``text``; `ParseError` if it cannot be read."""

    def marked(marks: ValueMarks) -> Answer:
        again = carried_out(text, model, marks)
        if again is None:
            raise ParseError("the program cannot be carried out with marks", code="E701")
        return _read_steps(again, read)

    return replace(_read_steps(program, read), marked=lambda: with_marks(text, marked))


def _opened(text: str, model: Model, read: Callable[[str], Answer]) -> Answer:
    """Return what ``read`` makes of a program that closes a loop, with its inputs as they are.

    `ParseError` if it closes none, or has letters of the system in what it gives an input and no comment with an
    equation, or those of a spring or a damper: F = u - k*x may be all forces.
    """
    found = carried_out(text, model, opened=True)
    known = {sp.Symbol(p.name) for p in model.parameters}
    sizes = [e.k if isinstance(e, Spring) else e.b for e in model.elements if isinstance(e, (Spring, Damper))]
    acting = {sp.Symbol(str(x)) for size in sizes if size is not None for x in sp.sympify(size).free_symbols}
    if found is None or not found.closed:
        raise ParseError("the program closes no loop", code="E701")
    if any(letters & (known if found.text == found.bare else acting) for letters in found.closed.values()):
        raise ParseError("what the program gives its inputs is not read", code="E701")
    answer = _read_steps(found, read)
    names = ", ".join(found.closed)
    return replace(answer, notes=(*answer.notes, f"What the program gives {names} was not judged."))


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
