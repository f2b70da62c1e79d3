"""Leaves out the energies to which a loop of a program adds, where the program is not carried out: T = T + …; end."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from lagrangian.check.reading.answer import Answer

_LOOP = re.compile(r"(?P<indent>[ \t]*+)(?:for|while)\b(?P<said>[^\n]*+)")
_ADDED = re.compile(r"[ \t]*+(?P<name>[TVUL])[ \t]*+(?:[-+]=|=[ \t]*+(?P=name)[ \t]*+[-+])")
_FIRST = re.compile(r"[ \t]*+(?P<name>[TVUL])[ \t]*+=(?!=)")


def without_sums_of_loops(text: str, read: Callable[[str], Answer]) -> Answer:
    """Read a program without the lines that state such an energy in part, each left empty, with notes about them."""
    bare, notes = _bare(text)
    found = read(bare)
    return replace(found, notes=(*notes, *found.notes))


def _bare(text: str) -> tuple[str, tuple[str, ...]]:
    """A program without these lines, and notes about them."""
    lines = text.split("\n")
    added = dict[str, int]()
    for k in _in_loops(lines):
        if (match := _ADDED.match(lines[k])) is not None:
            added.setdefault(match["name"], k)
    notes = list[str]()
    for k, line in enumerate(lines):
        first = _FIRST.match(line)
        if first is None or first["name"] not in added:
            continue
        if k < added[first["name"]]:
            where = f"the loop in line {added[first['name']] + 1} adds to it, and was not carried out."
            notes.append(f"'{' '.join(line.split())}' was not judged: {where}")
        lines[k] = ""
    return "\n".join(lines), tuple(notes)


def _in_loops(lines: list[str]) -> list[int]:
    """The places of the lines in the bodies of loops: up to the word end, or as far as they are indented."""
    found, inside = list[int](), -1
    ended = False
    for k, line in enumerate(lines):
        bare, indent = line.strip(), len(line) - len(line.lstrip())
        loop = _LOOP.match(line)
        if inside >= 0 and bare and (bare.startswith("end") if ended else indent <= inside):
            inside = -1 if not ended or indent <= inside else inside
        if loop is not None and inside < 0:
            inside, ended = len(loop["indent"]), not loop["said"].split("#")[0].rstrip().endswith(":")
        elif inside >= 0:
            found.append(k)
    return found
