"""Leaves out the energies to which a loop of a program adds, where the program is not carried out: T = T + …; end."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from lagrangian.check.reading.answer import Answer

_LOOP = re.compile(
    r"(?P<indent>[ \t]*+)(?:for[ \t]*+\(?[ \t]*+(?:int[ \t]++)?[^\W\d]\w{0,30}+"
    r"(?:[ \t]*+,[ \t]*+[^\W\d]\w{0,30}+){0,4}+"
    r"[ \t]*+(?:=|∈|in\b)|while\b(?=[^\n]{0,200}?(?:[<>(]|[!=~]=|\btrue\b|\bTrue\b)))(?P<said>[^\n]*+)"
)
"""The head of a loop in a program: for k = 1:2, for k in range(2):, while k < 3."""
_ADDED = re.compile(r"[ \t]*+(?P<name>[TVUL])[ \t]*+(?:[-+]=|=[ \t]*+(?P=name)[ \t]*+[-+])(?=[^\n]{0,300}?[^\W\d])")
_STATED = re.compile(r"[ \t]*+(?P<name>[TVUL])[ \t]*+=(?!=)(?P<value>[^\n]*+)")


def without_sums_of_loops(text: str, read: Callable[[str], Answer]) -> Answer:
    """Read a program without the lines that state such an energy in part, each left empty, with notes about them.

    These are the lines up to the end of the loop, and those behind it that go on with what it gives: T = T + …
    """
    bare, notes = _bare(text)
    found = read(bare)
    return replace(found, notes=(*notes, *found.notes))


def _bare(text: str) -> tuple[str, tuple[str, ...]]:
    """A program without these lines, and notes about them."""
    lines = text.split("\n")
    added, ends = dict[str, int](), dict[str, int]()
    for k, end in _in_loops(lines):
        if (match := _ADDED.match(lines[k])) is not None:
            added.setdefault(match["name"], k)
            ends[match["name"]] = end
    notes = list[str]()
    for k, line in enumerate(lines):
        stated = _STATED.match(line)
        name = "" if stated is None else stated["name"]
        if stated is None or name not in ends:
            continue
        if k >= ends[name] and re.search(rf"(?<!\w){name}(?!\w)", stated["value"]) is None:
            del ends[name]  # it is stated anew
            continue
        where = f"the loop in line {added[name] + 1} adds to it, and was not carried out."
        notes.append(f"'{' '.join(line.split())}' was not judged: {where}")
        lines[k] = ""
    return "\n".join(lines), tuple(dict.fromkeys(notes))


def _in_loops(lines: list[str]) -> list[tuple[int, int]]:
    """The places of the lines in the bodies of loops, up to the word end or as far as they are indented, each with the
    place where its loop ends."""
    found, body, inside = list[tuple[int, int]](), list[int](), -1
    ended = False
    for k, line in enumerate(lines):
        bare, indent = line.strip(), len(line) - len(line.lstrip())
        loop = _LOOP.match(line)
        closes = bare.startswith(("end", "}")) if ended else indent <= inside
        if inside >= 0 and bare and closes and indent <= inside:
            found += [(j, k) for j in body]
            inside = -1
        if loop is not None and inside < 0:
            body, inside = [], len(loop["indent"])
            ended = not loop["said"].split("#")[0].rstrip().endswith(":")
        elif inside >= 0:
            body.append(k)
    return found + ([(j, len(lines)) for j in body] if inside >= 0 and not ended else [])
