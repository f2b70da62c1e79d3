"""Finds letters that words call deviations of coordinates from rest: φ̃ and ỹ, Δφ, or p and u "of φ and y".

Each is then stated by a formula, with a value at rest of which nothing is said: φ̃ = φ − φ_rest.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import islice

from lagrangian.check.reading.answer import Answer
from lagrangian.check.reading.said.conventions import stated_coordinates
from lagrangian.model import Model
from lagrangian.read.letters import key

MOST = 20
"""The most lists of letters that are looked at."""

MARKS = ("_tilde", "_hat", "_bar", "_star")
"""The ends of names that are those of coordinates with a mark."""

_NAMES = r"(?:\\?[^\W\d_][\w]{0,11}(?:[ ]?,[ ]?(?:and[ ])?|[ ]and[ ]|[ ]und[ ])?){1,8}"
_WORD = r"(?:deviations?|displacements?|departures?|changes|excursions?|abweichung\w{0,2}|auslenkung\w{0,2})"
_ARE = r"(?:be|are|denote|sind|seien)[ ](?:the[ ]|small[ ]|die[ ]){0,2}"
_LISTED = re.compile(
    rf"(?:\b{_WORD}[ ](?P<new>{_NAMES})[ ]?|(?P<named>{_NAMES})[ ]{_ARE}{_WORD}[ ])"
    rf"(?:of|von)[ ](?:the[ ])?(?P<of>{_NAMES})",
    re.IGNORECASE,
)
_NAME = re.compile(r"\\?(?P<name>[^\W\d_]\w{0,11})")
_WORDS = frozenset(["and", "und", "the", "let", "be", "with", "small", "die"])
_DELTA = re.compile(r"\\Delta[ ]?(?P<dots>\\d?dot[ ]?)?\{?(?P<name>\\?[A-Za-z]+)\}?(?![A-Za-z])")


def in_deviations(answer: Answer, text: str, model: Model, read: Callable[[str], Answer]) -> Answer:
    """Return an answer with what its words say of its coordinates, and with formulas for letters that they call
    deviations from rest."""
    counted = stated_coordinates(text, [c.name for c in model.coordinates])
    names = [x.name for x in (*model.coordinates, *model.inputs)]
    marked = _with_tildes(text, names) if counted.rest else text
    unknown = (read(marked) if marked != text else answer).unknown if counted.rest else ()
    if not unknown or not (own := _own_deviations(marked, [u.name for u in unknown], names)):
        return replace(answer, counted=counted)
    told = tuple(f"{name} was read as {of} less its value at rest, as the words say." for name, of in own.items())
    found = read(_with_statements(marked, own))
    return replace(found, notes=(*told, *found.notes), counted=replace(counted, rest=frozenset()))


def _own_deviations(text: str, unknown: Sequence[str], names: Sequence[str]) -> dict[str, str]:
    """Return the coordinates and inputs of which the unknown names of an answer are deviations, by these names."""
    own = {key(name): name for name in names}
    found: dict[str, str] = {}
    for name in unknown:
        bases = [name.removesuffix(mark) for mark in MARKS if name.endswith(mark)]
        bases += [name[len(x) :].lstrip("_") for x in ("Δ", "Delta") if name.startswith(x) and len(name) > len(x)]
        if of := [own[key(base)] for base in bases if key(base) in own]:
            found[name] = of[0]
    asked = {key(name): name for name in unknown}
    bare = " ".join(re.sub(r"[$`*{}]", " ", text).split())
    for match in islice(_LISTED.finditer(bare), MOST):
        new, of = ([*_letters(x)] for x in (match["new"] or match["named"], match["of"]))
        if len(new) == len(of) and all(key(x) in own for x in of):
            found |= {asked[key(a)]: own[key(b)] for a, b in zip(new, of, strict=True) if key(a) in asked}
    return found


def _with_statements(text: str, deviations: dict[str, str]) -> str:
    """Return an answer with the formulas of its deviations below it."""
    stated = (f"{name} = {of} - {of}_rest" for name, of in deviations.items())
    return "\n".join([text, "", *stated])


def _with_tildes(text: str, names: Sequence[str]) -> str:
    r"""Return an answer in LaTeX with deviations of coordinates as single letters: \Delta\ddot y as \ddot{\tilde y}."""
    own = {key(name) for name in names}

    def marked(match: re.Match[str]) -> str:
        name = match["name"].lstrip("\\")
        if not {key(name), key(name.removeprefix("var"))} & own:
            return match[0]
        marked = rf"{{\tilde{{{match['name']}}}}}"
        return f"{match['dots'].strip()}{marked}" if match["dots"] else marked

    return _DELTA.sub(marked, text)


def _letters(listed: str) -> Iterator[str]:
    return (m["name"] for m in _NAME.finditer(listed) if m["name"].lower() not in _WORDS)
