"""Reads what an answer says beside its mathematics about the letters that it uses for coordinates.

% q1 = phi, q2 = s             q1 = phi, q2 = s           a comment of a program
$\\theta$ stands for phi here   $\\theta=\\phi$ here         a sentence
I use u for x and w for x'.     I ; u = x; w = x'.        another
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.read.letters import SPELLED, key

_NAME = r"[^\W\d]\w{0,15}+"
_PAIR = rf"{_NAME}[ \t]*+=[ \t]*+{_NAME}"
_PAIRS = rf"{_PAIR}(?:[ \t]*+(?:,|;|and|und|et)[ \t]*+{_PAIR})*+"
_COMMENT = re.compile(
    rf"(?P<mark>(?<!\\)[#%]|//)[ \t]*+(?P<said>{_PAIRS})[ \t]*+[.;]?[ \t]*+$",
    re.MULTILINE,
)
_EACH = re.compile(rf"({_NAME})[ \t]*+=[ \t]*+({_NAME})")
_SENTENCE = re.compile(
    rf"(?P<math>\$?)(?<![\w\\])(?P<new>\\?{_NAME})(?P=math)[ \t]++(?:stands[ \t]for|denotes|steht[ \t]für|bezeichnet)"
    rf"[ \t]++(?:the[ \t]|your[ \t]|den[ \t]|das[ \t])?(?P<open>\$?)(?P<own>\\?{_NAME})(?P=open)(?![\w(^'′$\\])"
)


_USED = re.compile(
    rf"(?<![\w\\])(?:use|used|using|write|wrote|writing|call|schreibe|nehme|verwende|benutze)[ \t]++"
    rf"(?P<said>{_NAME}[ \t]++(?:for|für)[ \t]++{_NAME}['’′]{{0,2}}"
    rf"(?:[ \t]*+(?:,|and|und)[ \t]++{_NAME}[ \t]++(?:for|für)[ \t]++{_NAME}['’′]{{0,2}})*+)(?![\w(^'′])"
)
_FOR = re.compile(rf"({_NAME})[ \t]++(?:for|für)[ \t]++({_NAME})(['’′]{{0,2}})")


def with_stated_letters(
    written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool], *, latex: bool
) -> TracedText:
    """Return an answer in which names of coordinates that comments and sentences say stand as statements.

    ``moves`` says whether a name is one that changes with time, ``taken`` whether it belongs to the system. Only a new
    name for such a one is read; every other comment stays a comment.
    """

    def says(new: str, own: str) -> bool:
        return moves(own.lstrip("\\")) and not taken(new.lstrip("\\"))

    edits: list[Edit] = []
    if not latex:
        text = written.text
        for match in _COMMENT.finditer(text):
            if all(says(*pair) or says(*reversed(pair)) for pair in _EACH.findall(match["said"])):
                behind = text[text.rfind("\n", 0, match.start()) + 1 : match.start()].strip()
                edits.append((*match.span("mark"), "; " if behind else " "))
    for match in _SENTENCE.finditer(written.text):
        if says(match["new"], match["own"]):
            edits.append((*match.span(), _statement(match, latex=latex)))
    for match in _USED.finditer(written.text) if not latex else ():
        pairs = _FOR.findall(match["said"])
        if all(says(new, own) for new, own, _ in pairs):
            edits.append((*match.span(), "; " + "; ".join(f"{new} = {own}{primes}" for new, own, primes in pairs)))
    return written.edited(sorted(edits))


_VARIATION = re.compile(r"(?<![\w\\])delta[ \t_]?+(?=[^\W\d])")
_VIRTUAL_WORK = re.compile(r"(?<![\w\\])delta[ \t_]?W(?!\w)")


def with_variations(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text in which the sign of virtual displacements is δ: delta W = F delta x."""
    if taken("delta") or _VIRTUAL_WORK.search(written.text) is None:
        return written
    return written.edited([(*match.span(), "δ") for match in _VARIATION.finditer(written.text)])


def _statement(match: re.Match[str], *, latex: bool) -> str:
    """The statement that a sentence makes."""
    new, own = match["new"], match["own"]
    if not latex:
        return f"{new} = {own}"
    new, own = (f"\\{x}" if key(x) in SPELLED.values() and not x.startswith("\\") else x for x in (new, own))
    return f"${new}={own}$"
