"""Reads from where and in which direction an answer counts coordinates of the system: x from rest, φ clockwise.

Such words keep the letter, so no formula shows them: "x is measured from the static equilibrium", "s positive upwards",
"θ from the horizontal".
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import islice

from lagrangian.check.reading.answer import StatedCoordinates
from lagrangian.check.reading.said.senses import stated_senses
from lagrangian.read.letters import key

MOST = 60
"""The most sentences that are looked at."""
LONGEST = 400
"""The most characters of one that are."""

_SENTENCE = re.compile(r"(?:[.;!?](?=\s|$)|\n[ \t]*\n)")
_REST = (
    r"(?:static|equilibri\w{1,3}|(?:positions?|places?|state)[ ](?:of|at)[ ]rest|rest[ -]position|ruhelagen?|"
    r"gleichgewichts?\w{0,8}|statische[rn]?|équilibre)\b"
)
_FROM_REST = re.compile(
    r"\b(?:from|about|around|relative[ ]to|with[ ]respect[ ]to|against|aus|von|um|gegenüber|ab|depuis)[ ]"
    r"(?:(?:the|its|their|this|that|an?|own|common|respective|stable|of|der|die|den|ihrer|seiner|l')[ ]?){0,3}+"
    + _REST,
    re.IGNORECASE,
)
_AT_REST = re.compile(
    r"(?:(?:=|\bis|\bare|\bist)[ ]?(?:0|zero|null)|\b(?:origins?|zeros?|nullpunkt))[ \t]{0,3}(?:\w{1,12}[ ]){0,4}"
    r"(?:at|in|is|of|corresponds[ ]to|means)[ ](?:the[ ]|its[ ]|der[ ]|their[ ]|a[ ])?" + _REST,
    re.IGNORECASE,
)
_STRETCH = re.compile(
    r"\b(?:is|be|are|sei|ist)[ ](?:\w{1,12}[ ]){0,3}?"
    r"(?:stretch|stretched|elongation|extension|compression|dehnung|verlängerung)\b",
    re.IGNORECASE,
)
"""What a coordinate is that counts from where a spring is relaxed."""
_DEVIATION = re.compile(
    r"\b(?:deviations?|displacements?|departures?|measured|counted)\b.{0,80}?\bfrom[ ](?:the[ ])?rest\b(?![ ]length)",
    re.IGNORECASE,
)
_COUNTED = re.compile(
    r"\b(?:measur\w{1,4}|count\w{0,3}|taken|reckon\w{1,3}|deviations?|displacements?|departures?|excursions?|deflections?|"
    r"offsets?|origin|zero|coordinates?|gemessen|gezählt|auslenkung\w{0,2}|abweichung\w{0,2})\b",
    re.IGNORECASE,
)
_OTHERWISE = re.compile(
    r"\b(?:not|never|unstretched|unstrained|undeformed|relaxed|slack|natural|rest[ ]length|free[ ]length|unloaded|"
    r"nicht|kein\w{0,2}|entspannt\w{0,2}|ungespannt\w{0,2})\b",
    re.IGNORECASE,
)
_AXIS = re.compile(
    r"\b(?:measured|counted|taken|reckoned|angle|gemessen)[ ](?:\w{1,12}[ ]){0,4}?"
    r"(?:from|against|to|with|von|gegen|zu)[ ](?:the[ ]|der[ ]|die[ ])?"
    r"(?P<upper>upward[ ]|upper[ ]|upright[ ])?(?P<lower>downward[ ]|lower[ ]|hanging[ ])?"
    r"(?P<axis>horizontal|vertical|upright|waag\w{1,6}|horizontale\w?|senkrecht\w{0,3}|vertikale\w?)(?!\w)",
    re.IGNORECASE,
)
_TOKEN = re.compile(r"(?<![\w\\])\\?(?P<name>[^\W\d]\w{0,23}+)")


def stated_coordinates(text: str, names: Sequence[str]) -> StatedCoordinates:
    """Return what the sentences of an answer say of the system's coordinates, by their ``names``."""
    own = {key(name): name for name in names}
    bare = re.sub(r"[$`*{}]|\\(?:text|mathrm|,|;|!)", " ", text)
    ways = sorted({(name, way) for name, way, _ in stated_senses(bare, names)})
    rest, axes = set[str](), set[tuple[str, str]]()
    stretched = _STRETCH.search(bare) is not None
    for said in islice(_sentences(bare), MOST):
        found = [own[key(m["name"])] for m in _TOKEN.finditer(said) if key(m["name"]) in own]
        if not stretched and _counts_from_rest(said):
            rest |= set(found or names)
        for match in _AXIS.finditer(said):
            if "=" in said[: match.start()]:
                continue  # a formula says it
            before = [own[key(m["name"])] for m in _TOKEN.finditer(said[: match.start()]) if key(m["name"]) in own]
            axes |= {(name, _axis(match)) for name in (before or found)[-1:]}
    return StatedCoordinates(frozenset(rest), tuple(ways), tuple(sorted(axes)))


def _sentences(text: str) -> Iterator[str]:
    """The sentences with their first characters."""
    return (" ".join(x.split())[:LONGEST] for x in _SENTENCE.split(text) if x.strip())


def _counts_from_rest(said: str) -> bool:
    """Whether a sentence says that coordinates are counted from the position at rest."""
    if _OTHERWISE.search(said) is not None:
        return False
    counted = _FROM_REST.search(said)
    if counted is None:
        return _AT_REST.search(said) is not None or _DEVIATION.search(said) is not None
    return _COUNTED.search(said) is not None


def _axis(match: re.Match[str]) -> str:
    """Horizontal, vertical, upright (above) or hanging (below)."""
    axis = match["axis"].lower()
    if match["upper"] or axis == "upright":
        return "upright"
    if match["lower"]:
        return "hanging"
    return "horizontal" if axis[0] in "hw" else "vertical"
