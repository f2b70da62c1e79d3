"""Words in front of a definition that look like mathematics: Newton/Euler, w = φ̇ + ψ̇; distance from O (of AB)   p = …

A stroke between two words is no division, a point that is named in words is no name of the answer, and a verb that
introduces a name is no factor of it: Abbreviate σ = sin(φ − θ).
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.traced_text import TracedText

_STROKE = re.compile(r"^(?P<gap>[ \t]*+)(?P<one>[^\W\d_]{4,24})/(?P<other>[^\W\d_]{4,24})(?=[,:][ \t])", re.MULTILINE)
_LED = re.compile(
    r"^(?P<words>[ \t]*+[^\W\d_]{3,24}(?:[ \t][^\W\d_]{1,24}(?:['’]s)?){1,9})(?P<aside>[ \t]\([^()=\n]{3,80}\))?"
    r"(?=[ \t]{3,}\\?[^\W\d_]\w{0,12}[ \t]*=(?!=))",
    re.MULTILINE,
)
_POINT = re.compile(r"(?P<of>\b(?:from|about|point|to|at|around)[ \t])[A-Z](?![\w'’])")
_VERB = re.compile(
    r"(?P<before>^(?:[ \t]*+(?:[-•*+][ \t]++|\d{1,2}[.)][ \t]++)?)|(?<=[.:;,])[ \t]++)"
    r"(?P<verb>(?:abbreviat|denot|defin|introduc|writ|substitut|nam|us)(?:e|ing)|(?:put|sett)ing|call(?:ing)?|put|set"
    r"|say|setze|setzt|bezeichne|definiere|schreibe|nenne|sei|seien|posons|notons|soit|soient)(?=[ \t]++"
    r"\\?(?P<new>[^\W\d]\w{0,15}+)(?:\([^()=\n]{1,20}\))?[ \t]*+:?=(?![=>]))",
    re.MULTILINE | re.IGNORECASE,
)
"""A verb alone in front of the definition of a new name, at the beginning of a sentence."""
_WORD = re.compile(r"[^\W\d_]{3,}")


def without_leading_words(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text without such strokes, points and verbs; ``taken`` are names of the system."""

    def apart(match: re.Match[str]) -> str:
        one, other = match["one"], match["other"]
        return match.group() if taken(one) or taken(other) else f"{match['gap']}{one} {other}"

    def bare(match: re.Match[str]) -> str:
        aside = match["aside"] or ""
        said = _POINT.sub(lambda m: m.group() if taken(m.group()[-1]) else f"{m['of']} ", match["words"])
        return said + (" " * len(aside) if len(_WORD.findall(aside)) > 1 else aside)

    def silent(match: re.Match[str]) -> str:
        verb = match["verb"]
        return match.group() if taken(verb) or taken(match["new"]) else match["before"] + " " * len(verb)

    return written.sub(_VERB, silent).sub(_STROKE, apart).sub(_LED, bare)
