"""What decides between the readings of an answer: which lines are wrong by themselves, whether a program is meant."""

from __future__ import annotations

import re
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.lines import lines_of
from lagrangian.check.reading import Answer, reads_flipped
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Status, Verdict
from lagrangian.errors import ParseError
from lagrangian.read.letters import key

ENTRY = re.compile(r"[^\W\d]\w{0,30}+[ \t]*+=[ \t]*+[^\W\d]\w{0,30}+[(\[]\d{1,2}[)\]][ \t]*+[;,]?")
"""A line that takes an entry of a state: v = y(3)."""
LONGEST = 200
"""The size up to which an energy is compared before the answer is judged."""
_FRACTION = re.compile(
    r"(?<![\w.^)\]}/])\d{1,3}[ ]?/[ ]?\d{1,3}[ ]{1,3}(?:\([ ]?)?(?P<name>[^\W\d_]\w{0,24}+)"
    r"(?!['’′″\u0307\u0308\u20db\u20dc(\[])"
)
"""A fraction of numbers in front of a name: 1/2 m, 1/2 (J + m r²)."""


def program_of(answer: Answer) -> Answer | None:
    """The reading in which an answer is a program that is carried out, if it is one and was not read so."""
    if answer.computed is None and not answer.program:
        return None
    try:
        return next((x for other in answer.others[-1:] if (x := other()).program), None)
    except ParseError:
        return None


def is_misread(verdict: Verdict) -> bool:
    """Whether a line that only takes an entry of a state, v = y(3), or gives a constant a value, m = 2, is called
    wrong: it says nothing of the motion."""
    wrong = [f.line for f in verdict.findings if f.status is Status.WRONG]
    return any(ENTRY.fullmatch(x.text) or _gives_number(x) for x in wrong)


def _gives_number(line: AnsweredLine) -> bool:
    """Whether a line equates one letter and a number."""
    letters = line.expr.free_symbols
    return line.kind == "equation" and len(letters) == 1 and bool(line.expr.diff(*letters).is_number)


def computes_right(typed: Verdict, computed: Verdict) -> bool:
    """Whether a wrong program computes what is right where a line is called wrong as it is typed: a loop adds to T. One
    that is right as a whole was accepted among the readings, unless a remark in it is wrong."""

    def lines(verdict: Verdict, wrong: bool) -> set[tuple[int, str]]:
        found = {(f.line.number, f.line.kind) for f in verdict.findings if (f.status is Status.WRONG) == wrong}
        return {x for x in found if x[1] in ("T", "V", "L", "equation")}

    right = lines(computed, False) - lines(computed, True)
    kinds = {kind for _, kind in lines(computed, True)}
    energies = {kind for _, kind in right if kind != "equation" and kind not in kinds}
    return not computed.right and any(x in right or x[1] in energies for x in lines(typed, True))


def of_comments(lines: set[tuple[int, str]]) -> set[tuple[int, str]]:
    """Those lines that are comments of a program; its statements say what they say when they are carried out."""
    return {(number, text) for number, text in lines if text.lstrip().startswith(("%", "#", "//"))}


def wrong_together(verdict: Verdict) -> set[tuple[int, str]]:
    """The equations of motion that are wrong by what lines with names of the answer's own say together."""
    return {
        (f.line.number, f.line.text) for f in verdict.findings if f.status is Status.WRONG and accelerates(f.line.expr)
    }


def without_flipped(truth: Reference, answer: Answer) -> Answer:
    """An answer without the reading in which denominators are read the other way, where an energy is right in which
    fractions of numbers stand in front of parameters, as in 1/2 m x'²: it would be wrong with 1/(2 m).

    In every term of it something moves: a constant more would not make V wrong. With values that are given, the
    parameter may be 1, which makes both the same.
    """
    if not any(map(reads_flipped, answer.others)) or any(line.kind == "given" for line in answer.lines):
        return answer
    if truth.derivation.multipliers or not any(_has_right_fraction(truth, x) for x in lines_of(answer)):
        return answer
    return replace(answer, others=tuple(x for x in answer.others if not reads_flipped(x)))


def _has_right_fraction(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line is such an energy."""
    if line.kind not in truth.energies or line.beside or line.text.count("=") != 1 or bounded.size(line.expr) > LONGEST:
        return False
    names = {key(p.name) for p in truth.model.parameters if p.value is None or abs(float(p.value)) != 1}
    if not any(key(m["name"]) in names for m in _FRACTION.finditer(line.text)):
        return False
    moving, expr = [c.symbol for c in truth.model.coordinates], truth.expand(line.expr)
    moves = all(term.has(*moving) for term in sp.Add.make_args(line.expr)) and bounded.letters(expr) <= truth.names
    return moves and zero_everywhere(truth, expr - truth.energies[line.kind])


def is_of_others(verdict: Verdict) -> bool:
    """Whether a note of a verdict tells of coordinates in which the answer would be right."""
    return any(str(note).startswith("It would be right with ") for note in verdict.notes)
