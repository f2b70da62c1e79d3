"""Recognizes a dissipation function that an answer calls F or P, as its words say: Rayleigh: F = b x'^2/2.

F is a force and P a potential energy otherwise; what the words call so is read as if it were called D.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.traced_text import TracedText

_STATED = re.compile(
    r"(?<![\w\\^'’*/+-])(?:\\mathcal[ ]?\{?)?(?P<name>[FP])\}?[ \t]{0,9}=(?!=)(?P<value>[^\n=]{1,200})"
)
_SURE = re.compile(r"rayleigh|dissipati(?:on|ve)[ -]?(?:function|potential)|dissipationsfunktion", re.IGNORECASE)
_LIKELY = re.compile(r"dissipati(?:on|ve)|damping|dämpfung|amortissement", re.IGNORECASE)
_HALF = re.compile(r"½|\b1/2|/[ ]?2(?![\d.])|\b0\.5|frac[ ]?\{?1\}?[ ]?\{?2")
_SQUARE = re.compile(r"²|(?:\^|\*\*)[ ]?\{?2")
_POWER = re.compile(r"power|leistung|puissance", re.IGNORECASE)
_SENTENCE = re.compile(r"=|[.;][ \n]|\n[ \t]*\n")
_REACH = 80
"""How many characters in front of the name are read."""


def with_called_dissipation(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which the dissipation function is D; ``taken`` says whether a name belongs to the system.

    The letter must stand nowhere else but in slopes of it, ∂F/∂ẋ; D must be free. Words that may mean a power, damping,
    count beside a factor ½ only.
    """
    text = written.text
    found = next((m for m in _STATED.finditer(text) if not taken(m["name"]) and _calls_it_so(m)), None)
    if found is None or taken("D") or re.search(r"(?<![\w\\])D(?!\w)", text):
        return written
    name = found["name"]
    places = list(re.finditer(rf"(?<![\w\\]){name}(?!\w)", text))
    others = text[: found.start()] + text[found.end("name") :]
    slopes = re.findall(
        rf"(?:∂|(?<!\w)d|\\partial|[Ff]unction)[ ]?(?:\\mathcal)?[ ${{]{{0,2}}{name}(?![\w'’′])", others
    )
    return written.edited((m.start(), m.end(), "D") for m in places) if len(places) == len(slopes) + 1 else written


def _calls_it_so(match: re.Match[str]) -> bool:
    """Whether words in front of a statement say that it is the dissipation function."""
    before = _SENTENCE.split(match.string[max(0, match.start() - _REACH) : match.start()])[-1]
    likely = _LIKELY.search(before) and _HALF.search(match["value"]) and not _POWER.search(before)
    return _SQUARE.search(match["value"]) is not None and bool(_SURE.search(before) or likely)
