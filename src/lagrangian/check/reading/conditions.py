"""Sets aside what holds only under a condition: x is cyclic if F = 0 and b = 0; for J = 0 we get l θ'' + g sin θ = 0.

The condition says nothing of the system. An equation of motion in the same sentence is one of a special case: it is not
judged where every coordinate has its equation elsewhere.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from lagrangian.check.reading.markup import blank
from lagrangian.check.reading.prose import moves
from lagrangian.check.reading.words import Words

_NAME = r"[^\W\d]\w{0,15}+['’′]{0,2}"
_RELATION = (
    rf"{_NAME}[ \t]*(?:=|≈|≪|≫|<<|>>|<|>|≤|≥|→|≡|≠|!=|->)[ \t]*"
    rf"[-−]?(?:\d[\w./]{{0,8}}|{_NAME}|π(?:/2)?|∞)(?![\w(*/^+²])"
)
_LINK = r"[ \t]*(?:,|and|or|und|oder|et)[ \t]+"
CONDITION = re.compile(
    r"(?<!\w)(?:if|when|whenever|for|unless|(?:provided|assuming)(?:[ \t]that)?|wenn|falls|für|bei|sofern|si|pour)"
    rf"[ \t]+(?:[^\W\d_]{{2,12}}[ \t]+){{0,2}}?(?P<said>{_RELATION}(?:{_LINK}{_RELATION}){{0,4}})"
    r"(?=[ \t]*(?:$|[,.;:)]|[^\W\d_]{2}))",
    re.IGNORECASE | re.MULTILINE,
)
"""A condition, whose values are numbers or names."""
_CASE = re.compile(
    rf"^(?:[ \t]*[^\W\d_][\w \t-]{{2,30}}:)?[ \t]*(?P<said>{_RELATION}(?:{_LINK}{_RELATION}){{0,4}})"
    r"[ \t]*(?:⇒|⟹|=+>|→|-+>)",
    re.MULTILINE,
)
"""A special case, from which an arrow leads to what it would mean: check: m2 = m3 ⇒ y'' = 0."""
_SAID = re.compile(rf"(?P<left>{_NAME})[ \t]*[^\s\w]+[ \t]*[-−]?(?P<right>[\w./π∞]+)")
_COUNTED = re.compile(r"[ijkn][ \t]*=[ \t]*\d")
_SENTENCE_END = re.compile(r"[.;](?=\s|\Z)|\n")


def without_conditions(text: str, words: Words) -> str:
    """Return an answer in plain text with conditions, and special cases in the sentences of these, blanked out."""
    found = [m for m in CONDITION.finditer(text) if not _COUNTED.match(m["said"])]
    found += [m for m in _CASE.finditer(text) if _is_case(m["said"], words)]
    if not found:
        return text
    bare = text
    for match in found:
        bare = blank(bare, *match.span())
    cases = list(dict.fromkeys(_sentence(text, match.start()) for match in found))
    special = [(start, end) for start, end in cases if "=" in bare[start:end] and moves(bare[start:end])]
    rest = bare
    for start, end in special:
        rest = blank(rest, start, end)
    if special and sum(1 for _ in _moving(rest)) >= len(words.names.model.coordinates):
        for start, end in special:
            told = " ".join(text[start:end].split())
            words.names.notes.setdefault(f"'{told}' was not judged: it holds only under a condition.")
        return rest
    return bare


def _is_case(said: str, words: Words) -> bool:
    """Whether constants of the system are set equal to each other, or to 0."""
    constants = {p.name for p in words.names.model.parameters}
    pairs = [(m["left"], m["right"]) for m in _SAID.finditer(said)]
    named = [words.names.scope.meanings(x)[0] for pair in pairs for x in pair if x != "0"]
    return bool(named) and all(found and found[0] in constants for found in named)


def _moving(text: str) -> Iterator[str]:
    """The lines with an equation that has a rate."""
    return (line for line in text.split("\n") if "=" in line and moves(line))


def _sentence(text: str, at: int) -> tuple[int, int]:
    """Where the sentence at a place begins and ends."""
    start = max((m.end() for m in _SENTENCE_END.finditer(text, 0, at)), default=0)
    match = _SENTENCE_END.search(text, at)
    return start, len(text) if match is None else match.start()
