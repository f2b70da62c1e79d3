"""At which position of a coordinate, or value of a constant, the statements of a line hold, as words in front say.

At θ = 90°: ℓ = √(a² + b²) = 0.6        ℓ has this value at θ = π/2 alone
For n = 1 it turns alone, J = J1 + J2   J has this value for n = 1
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping

from lagrangian.check.reading.names import Names
from lagrangian.check.reading.prose.remarks import accelerates_in

MOST = 2_000
"""The most lines that are looked at."""
AT = "at "
"""How the words begin that say such a position: at theta = 1/2 π."""

_COORDINATE = r"\\?(?P<name>[^\W\d_]\w{0,15}+)"
_VALUE = (
    r"(?:(?P<degrees>\d{1,3}(?:\.\d{1,4})?)[ ]?(?:\\?°|\^\s?\{?\\circ\}?|\\degree|deg(?:rees)?\b|Grad\b|degrés\b)"
    r"|(?P<times>\d{0,2})[ ]?(?:π|\\?pi(?![A-Za-z]))(?:[ ]?/[ ]?(?P<by>\d{1,2}))?"
    r"|\\[dt]?frac[ ]?\{(?P<top>\d{0,2})\\pi\}[ ]?\{(?P<below>\d{1,2})\}|(?P<whole>[01])(?![\d.,/]\d|[\w*^]))"
)
_SAID = re.compile(
    rf"(?<!\w)(?:at|for|with|bei|für|mit|pour|à|en)[ ]\$?{_COORDINATE}[ ]?=[ ]?"
    rf"(?P<minus>[-−]?)[ ]?{_VALUE}\$?[ *_]{{0,3}}"
    r"(?:\([^()=\n]{0,40}\)[ ]?)?(?:[:,]|[ ](?=[^\W\d_]{2,24}[ ]))",
    re.IGNORECASE,
)

_SENTENCE = re.compile(r"[.;!?]\s")


def with_places(said: Mapping[int, frozenset[str]], text: str, names: Names) -> Mapping[int, frozenset[str]]:
    """Return what words say of lines, by number, with the positions at which their statements hold."""
    own = {x.name for x in (*names.model.coordinates, *names.model.parameters)}

    def meaning(name: str) -> str | None:
        meant = names.scope.meanings(name)[0]
        return meant[0] if len(meant) == 1 and meant[0] in own else None

    places = dict(_places(text, meaning))
    return {k: said.get(k, frozenset[str]()) | places.get(k, frozenset()) for k in said.keys() | places.keys()}


def _places(text: str, meaning: Callable[[str], str | None]) -> Iterator[tuple[int, frozenset[str]]]:
    """The lines without accelerations that say such a value; ``meaning`` gives the name of the system that one is."""
    for k, line in enumerate(text.split("\n")[:MOST], 1):
        match = _SAID.search(line) if "=" in line and not accelerates_in(line) else None
        before = "" if match is None else _SENTENCE.split(line[: match.start()])[-1]
        if match is not None and "=" not in before and (name := meaning(match["name"])) is not None:
            yield k, frozenset([f"{AT}{name} = {match['minus'] and '-'}{_value(match)}"])


def _value(match: re.Match[str]) -> str:
    """The value of a position, as numbers and pi."""
    if match["degrees"] is not None:
        return f"{match['degrees']}*pi/180"
    if match["whole"] is not None:
        return match["whole"]
    times, by = match["times"] or match["top"] or "1", match["by"] or match["below"] or "1"
    return f"{times}*pi/{by}"
