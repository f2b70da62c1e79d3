"""Takes checks of units off an answer: units: m g l = kg m/s² m = N m, b θ̇ = N m."""

from __future__ import annotations

import re
from collections.abc import Iterator

from lagrangian.check.reading.prose.remarks import accelerates_in
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.quantities.units import joined, lookup

_SAID = re.compile(r"^[^=\n]{0,60}?\b(?:units?|dimensions?|einheit(?:en)?|dimensionen|unités?)\b", re.IGNORECASE)
"""The words with which a line begins that checks units."""
_PART = re.compile(r"[^,;\n]++")
_NAME = re.compile(r"[^\W\d_]+")
_OTHER = re.compile(r"[\w\s*·./^()\[\]{}²³⁻¹−$-]*")
"""What a product of units consists of."""


def without_unit_checks(written: TracedText) -> TracedText:
    """Return an answer without what is equated to units on lines that say that they check these."""
    return written.edited(_checks(written.text))


def _checks(text: str) -> Iterator[Edit]:
    at = 0
    for line in text.splitlines(keepends=True):
        if "=" in line and _SAID.match(line) is not None:
            for part in _PART.finditer(line):
                if "=" in part.group() and not accelerates_in(part.group()) and _ends_in_units(part.group()):
                    yield at + part.start(), at + part.end(), " " * len(part.group())
        at += len(line)


def _ends_in_units(part: str) -> bool:
    """Whether what stands behind the last equals sign is a product of units."""
    last = part.rsplit("=", 1)[1].rstrip(" \t.✓✔")
    names = _NAME.findall(last)
    return bool(names) and _OTHER.fullmatch(last) is not None and all(lookup(x) or joined(x) for x in names)
