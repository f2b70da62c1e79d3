"""Finds words that may change an equation and that no statement holds: F must be replaced by 2 F; … plus the weight.

Nothing is read out of such words: a note says on which lines they stand, so that nobody takes them for judged.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

_CHANGES = re.compile(
    r"\b(?:replaced? (?:by|with)|"
    r"(?:half|twice|double|triple)(?: of)? (?:the|that|this|its)|times (?:two|three|four|ten|\d+)|else add|"
    r"(?:to|must|should) (?:add|subtract))\b|"
    r"(?:^|\.\.\.|…)[ \t]{0,9}(?:plus|minus|negative|negated)\b",
    re.IGNORECASE | re.MULTILINE,
)
_BEHIND = re.compile(
    r"(?<![\w-])(?:twice|doubled|halved|tripled|negative|negated|less[ ](?:the|that)|except|opposite|reversed|"
    r"without(?![ ](?:slip|slid|skid|gliding))|\(minus\)|with[ ](?:a[ ])?minus)"
    r"(?![\w-])"
)
"""Such words behind the last equals sign of a line; what rolls without slipping changes nothing."""
_SAID_AGAIN = re.compile(
    r"(?<![\w-])(?:half|twice|doubled?|halved|tripled?|less|negative|opposite)(?![\w-])[^.;:=()\n]{1,80}"
    r"(?:,[ ](?:so|i\.e\.|that[ ]is|thus|hence)?[ ]?\w{1,16}[ ]?=(?!=)"
    r"|\((?=[^()\n]{0,80}[-+−*/^·²=])(?:[^()\n]|\([^()\n]{0,40}\)){1,80}\))",
    re.IGNORECASE,
)
"""What words say and a formula behind them says, too: it is twice the angle of the bar, delta = 2 alpha."""
_DERIVED = re.compile(r"\b(?:differentiat|deriv)\w{0,5}\b", re.IGNORECASE)
"""What is done twice or must be done without changing a value."""
_MOST = 5
"""The largest number of lines that a note names."""


def changing_words(text: str) -> Iterator[str]:
    """A note about the lines of an answer whose words may change an equation, if there are any."""
    lines = [
        number
        for number, line in enumerate(_SAID_AGAIN.sub("", text).split("\n"), 1)
        if (_CHANGES.search(line) is not None or _changes_behind(line)) and _DERIVED.search(line) is None
    ]
    if not lines:
        return
    more = ", …" if len(lines) > _MOST else ""
    told = ", ".join(map(str, lines[:_MOST])) + more
    which = f"line {told}" if len(lines) == 1 else f"lines {told}"
    yield f"Words on {which} may change an equation; they were not judged, only what stands as an equation was."


def _changes_behind(line: str) -> bool:
    """Whether words behind the last equals sign of a line, which an equation of motion may be, change it."""
    head, _, tail = line.rpartition("=")
    return bool(head) and _BEHIND.search(tail) is not None
