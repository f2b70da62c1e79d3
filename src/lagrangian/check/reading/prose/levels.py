"""Tells statements that only say where something is 0: V = 0 at the pivot, θ = 0 is downwards, φ = 0 uphill."""

from __future__ import annotations

import re

from lagrangian.check.reading.name_patterns import RATE_OR_NAME
from lagrangian.check.reading.prose.words import Words
from lagrangian.check.reading.prose.words_or_mathematics import is_word

_LEVEL = re.compile(rf"\s*+(?P<name>{RATE_OR_NAME})\s*+=\s*+0\s*+[.,;]?\s*+")
_LEVEL_IN_WORDS = re.compile(rf"\s*+(?P<name>{RATE_OR_NAME})\s*+=\s*+0[ \t]++[^\W\d_][^\W\d_][^\n;=+*/^()\d]{{0,80}}")
_PLACES = "up|at|for|when|where|with|while|if|is|means|in|on|along|bei|im|für|wenn|wo|mit|ist|heißt|à|au"
_PLACED = re.compile(rf"=\s*0\s+(?:(?:{_PLACES})\b|(?P<word>[^\W\d_]{{4,24}})(?=[\s.,;]|$))")
_ENERGIES = frozenset(["V", "U", "Epot", "E_pot", "Ep", "E_p"])


def is_level(text: str, own: str, words: Words) -> bool:
    """Whether a statement with words behind it only says where something is 0, as a note tells: V = 0 at the pivot."""
    match, placed = _LEVEL.fullmatch(text) or _LEVEL_IN_WORDS.fullmatch(own), _PLACED.search(own)
    if match is None or placed is None or (placed["word"] is not None and not is_word(placed["word"], words)):
        return False
    if not words.names.changes(match["name"]) and match["name"].rstrip("*") not in _ENERGIES:
        return False
    words.names.notes.setdefault(f"'{' '.join(own.split())}' was not judged: it says where {match['name']} is 0.")
    return True
