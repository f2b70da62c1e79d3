r"""Reads in words how a body moves by a coordinate of the answer's own: the drum turns by psi/n.

psi = angle of the motor (so the drum turns by psi/n)          phi = psi/n, where phi is described as the drum's
$\psi$ is the angle of the wheels; the car has moved $r\psi$ up the hill      $x = r\psi$, where x is "car, up the hill"
"""

from __future__ import annotations

import re
from collections.abc import Callable, Set
from itertools import islice

from lagrangian.check.reading.shortened import moving_names
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.model import Coordinate, Model
from lagrangian.read.letters import key

MOST = 20
"""The most such sentences that are read."""

_NAME = r"\\?[^\W\d_][\w]{0,15}"
_SO = r"(?:so|and|where|thus|hence|then|also|i\.e\.|meanwhile|whereby|dann|also|wobei)[ ](?:that[ ])?(?:then[ ])?"
_TURNS = re.compile(
    rf"(?P<front>\((?:[^()=\n]{{1,60}}[,;:][ ])?(?:{_SO})?|[.,;:][ ](?:{_SO})?|(?<!\w){_SO})"
    r"(?:the[ ]|die[ ]|der[ ]|das[ ]|le[ ]|la[ ])?"
    r"(?P<noun>[^\W\d_]{3,20})[ ](?:then[ ]|itself[ ]|itself[ ]then[ ])?"
    r"(?:turns|rotates|moves|rises|sinks|travels|advances|rolls|dreht[ ]sich|dreht|bewegt[ ]sich|tourne"
    r"|(?:has|have)[ ](?:then[ ])?(?:turned|rotated|moved|risen|sunk|travelled|traveled|advanced|rolled))"
    r"(?:[ ](?:by|with|through|um|mit|de))?[ ]"
    r"(?P<said>[^()=.,;:\n]{1,80}(?=[ ]?(?:\.?\)|[.,;:](?=\s|\Z)|\n|\Z)))",
    re.IGNORECASE,
)
_PART = re.compile(rf"[ ]?(?:(?P<name>{_NAME})|\d{{1,3}}|[/*·$]|\\[,; ])")
_WORD = re.compile(r"[^\W\d_]+")


def with_turned_bodies(text: TracedText, model: Model, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which such a sentence gives the coordinate of the body it names, if one coordinate alone is
    described with this noun and with the words behind the value, and the value has a coordinate of the answer's own."""
    edits: list[Edit] = []
    found = list(islice(_TURNS.finditer(text.text), MOST))
    moving = moving_names(text.text) if found else frozenset[str]()
    for match in found:
        by, new = _value(match["said"], moving, taken)
        meant = [c for c in model.coordinates if _is_described(c, match["noun"])]
        behind = _WORD.findall(match["said"][len(by) :])
        if len(meant) != 1 or len(new) != 1 or not all(_is_described(meant[0], x) for x in behind):
            continue
        math = "$" if "$" in by else ""
        stated = f"{math}{meant[0].name} = {by.replace('$', ' ').strip()}{math}"
        bracketed = match["front"][0] == "("
        edits.append((*match.span(), f"({stated}" if bracketed else f"; {stated};"))
    return text.edited(apart(edits))


def _value(said: str, moving: Set[str], taken: Callable[[str], bool]) -> tuple[str, list[str]]:
    """The value with which words begin, and the names in it that the system does not have; these have rates."""
    end, new = 0, list[str]()
    while (part := _PART.match(said, end)) is not None:
        name = part["name"]
        bare = "" if name is None else name.lstrip("\\").removeprefix("var")
        if bare and not taken(bare):
            if key(bare) not in moving:
                break
            new.append(bare)
        end = part.end()
    return said[:end], new


def _is_described(coordinate: Coordinate, noun: str) -> bool:
    """Whether a coordinate is described with a word."""
    return re.search(rf"(?<!\w){re.escape(noun)}(?!\w)", coordinate.description, re.IGNORECASE) is not None
