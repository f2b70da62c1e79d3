"""Right-hand sides that stand apart, below the left-hand sides, behind the same coordinates: steps 5 and 6.

x: m x'' + k x          x: m x'' + k x          Generalized forces      Generalized forces
y: m y''                y: m y''                  x: F - b x'             Q_x = F - b x'
x: F - b x'             Ξ_x = F - b x'            y: 0                    Q_y = 0
y: 0                    Ξ_y = 0

The number of a step may stand in front of the first row, Step 6  x: F, and a sentence may say that the sides are equal,
The equations are Step 5 = Step 6.

A bare Q in such a row is that of its coordinate:   y: dV/dy = k y, Q = F
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from itertools import pairwise

from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import TracedText
from lagrangian.read.letters import undotted

_NAME = r"[^\W\d](?:\w|[\u0307\u0308]){0,24}+"
_STEP = r"(?:steps?|parts?|lines?|schritt|teil|zeile)"
_LABELLED = re.compile(
    rf"^[ \t]*+(?:[-*•][ \t]++)?(?P<label>(?:(?:{_STEP}[ \t]?\d{{1,2}}[.:)]?|\d{{1,2}}[.)])[ \t]++)?+(?P<name>{_NAME})"
    r"[ \t]*+:)(?P<value>[ \t]++[^=:;\n]{1,400}+)$",
    re.MULTILINE | re.IGNORECASE,
)
_HEADING = re.compile(
    r"^[^=:\n]{0,30}?\b(?:generali[sz]ed[ ]forces?|(?:verallgemeinerten?|generalisierten?)[ ]Kräfte?n?)\b"
    r"[^=:\n]{0,30}:?[ \t]*$",
    re.MULTILINE | re.IGNORECASE,
)
"""A line above generalized forces."""
_SIDES_EQUAL = re.compile(
    rf"^[^=\n]{{0,60}}?(?<!\w){_STEP}[ \t]?\(?\d{{1,2}}\)?[ \t]*+(?:=|equals?|is[ ]equal[ ]to|ist[ ]gleich)[ \t]*+"
    rf"{_STEP}[ \t]?\(?\d{{1,2}}\)?[^=+*/^\n]{{0,40}}$",
    re.MULTILINE | re.IGNORECASE,
)
"""A sentence that sets the rows of two steps equal."""
_TWICE = re.compile(r"['’′]{2}|″|[\u0308ẍÿẅ¨]|ddot|dd\b")
_WORD = re.compile(_NAME)
_OF_ROW = re.compile(rf"^[ \t]*+(?P<name>{_NAME})[ \t]*+:[^\n]{{0,400}}?(?<![\w∂/])(?P<force>Q)[ \t]*+=", re.MULTILINE)
_BARE = re.compile(r"(?P<equal>=[ \t]*+)?(?<![\w\\])Q(?!\w)")


def with_labelled_forces(
    written: TracedText, coordinates: Callable[[str], Sequence[str]], known: Callable[[str], bool], count: int
) -> TracedText:
    """Return a plain text in which such right-hand sides are generalized forces.

    ``coordinates`` are those that a name can mean, ``count`` is how many the system has, and ``known`` tells whether
    the system has a name.
    """

    def is_read(word: str) -> bool:
        stems = [undotted(word)[0], *(stem for _, stem in spelled_rates(word))]
        return function_of(word) is not None or any(map(known, stems))

    written = written if known("Q") else _with_forces_of_rows(written, coordinates)
    left, right = list[str](), list[re.Match[str]]()
    headed = _HEADING.search(written.text) is not None
    for match in _LABELLED.finditer(written.text):
        if len(meant := coordinates(match["name"])) != 1:
            continue
        if _TWICE.search(match["value"]):
            left.append(meant[0])
        elif (left or headed) and all(map(is_read, _WORD.findall(match["value"]))):
            right.append(match)
    named = [coordinates(match["name"])[0] for match in right]
    if len(named) != count or len(set(named)) != count:
        return written
    apart = len(left) == len(set(left)) == count
    if not apart and (known("Q") or not _is_headed(written.text, right)):
        return written
    letter = "Ξ" if apart else "Q"  # what a heading calls so may be all forces, with those of V
    edits = [(*m.span("label"), f"{letter}_{name} = ") for m, name in zip(right, named, strict=True)]
    said = _SIDES_EQUAL.search(written.text, right[-1].end()) if apart else None
    return written.edited(edits if said is None else [*edits, (*said.span(), "")])


def _is_headed(text: str, rows: Sequence[re.Match[str]]) -> bool:
    """Whether rows follow each other, right below a heading that calls them generalized forces."""
    begin = text[: rows[0].start()].rstrip()
    heading = _HEADING.match(begin, begin.rfind("\n") + 1)
    between = (text[a.end() : b.start()] for a, b in pairwise(rows))
    return heading is not None and not any(x.strip() for x in between)


def _with_forces_of_rows(written: TracedText, coordinates: Callable[[str], Sequence[str]]) -> TracedText:
    """Return a text in which the Q of every row is that of its coordinate, if Q is nothing else: … = Q in general."""
    rows = {m.start("force"): m for m in _OF_ROW.finditer(written.text)}
    of = [coordinates(m["name"]) for m in rows.values()]
    bare = (m for m in _BARE.finditer(written.text) if m["equal"] is None and m.start() not in rows)
    if len(of) < 2 or any(len(x) != 1 for x in of) or len({x[0] for x in of}) < len(of) or next(bare, None):
        return written
    return written.edited([(at, at + 1, f"Xi_{x[0]}") for at, x in zip(rows, of, strict=True)])
