"""Takes checks of units off an answer: units: m g l = kg m/s² m = N m, b θ̇ = N m; and units behind sums of numbers.

J θ''        kg m²/s² = N m   ok          a term, and its unit far behind it or in square brackets
m g s sin θ  [kg m/s² · m = N m]          the term alone is left
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from lagrangian.check.reading.traced_text import Edit, TracedText, apart, line_end

_SAID = re.compile(
    r"^[^\w\n]{0,6}(?:\d{1,2}[.)][ \t]*)?(?:(?:check|checking|kontrolle|probe)[ \t]+(?:(?:of|the|der)[ \t]+){0,2})?"
    r"(?:units?|dimensions?|einheit(?:en)?|dimensionen|unités?)(?:[ \t]+check)?[ \t]*:",
    re.IGNORECASE,
)
"""The words with which a line begins that checks units."""
UNITS = frozenset(["kg", "m", "s", "N", "J", "W", "rad", "Nm", "Ns", "Nms", "kgm"])
"""The units in which mechanics is checked; h, A and V may be names of the answer's own."""
_PART = re.compile(r"[^,;\n]++")
_NAME = re.compile(r"[^\W\d_]+")
_OTHER = re.compile(r"[\w\s*·./^()\[\]{}²³⁻¹−$-]*")
"""What a product of units consists of."""
_NUMBER = r"\d{1,12}(?:[.,]\d{1,12})?"
_UNIT = (
    r"[ ]?(?:kg|Nms|Nm|Ns|N|J|W|rad|m|s)(?:(?:²|³|\^\d)?[ ]?[·*/]?[ ]?(?:kg|N|m|s|rad)(?![A-Za-z_])){0,4}(?:²|³|\^\d)?"
    r"(?![\w'’′(^*/·])"
)
_FACTOR = r"(?:(?:kg|Nms|Nm|Ns|N|J|W|rad|m|s|1)(?![A-Za-z_\d])(?:²|³|\^-?\d|⁻[¹²³])?|[()])"
_PRODUCT = rf"{_FACTOR}(?:[ ]{{0,2}}+(?:[·*/⋅][ ]{{0,2}}+)?+{_FACTOR}){{0,16}}+"
_EQUATED = re.compile(
    rf"(?:[ \t]{{2,150}}+|(?P<open>[ \t]{{0,150}}+\[)[ ]?)"
    rf"(?P<units>{_PRODUCT}(?:[ ]?=[ ]?{_PRODUCT}){{1,3}})(?(open)[ ]?\])"
    r"(?=[ \t]{0,20}(?:ok|OK|okay|passt|[✓✔☑])?[ \t.,]{0,20}$)",
    re.MULTILINE,
)
"""A unit that is another, behind a gap or in square brackets."""
_SIGNED = re.compile(r"[ \t]*+[-+−–*·/=]")
"""How a line begins that goes on with an equation."""
_SUM = re.compile(
    rf"(?<![\w.,)/*^+·−-])(?<![/*^+·−-][ ])(?:{_NUMBER}[ ]?[-+−·*×/][ ]?){{1,8}}{_NUMBER}[ ]?=[ ]?{_NUMBER}"
    rf"(?P<unit>{_UNIT})"
)
"""A sum of numbers with the unit of its value: 15 + 4.8 = 19.8 kg m²."""
_INERTIA = re.compile(
    rf"(?<![\w.,=])(?<!=[ ]){_NUMBER}(?P<unit>[ ]?kg[ ]?[·*]?[ ]?m(?:²|\^2))(?![\w'’′(^])(?=[^\n=]*=|[^\n=]*\n)"
)
"""A moment of inertia in an equation, which is no product: (19.8 kg m² + …) θ''."""

_RAISED = re.compile(
    rf"[=≈][ ]?[-−]?{_NUMBER}(?P<unit>[ ]?(?:[·*]|\\,)?[ ]?\((?=[^()]{{0,12}}(?:kg|N))"
    r"(?:(?:kg|N|m|s|rad)(?:²|³|\^\d)?(?:[ ·*/]|\\,)?){2,6}\)(?:²|³|\^\{?\d\}?))"
    r"(?=[ \t]*(?:[.,;]?\s|[.,;$]?\Z|[$]|\\[\])]))"
)
"""A product of units in brackets, with a power, at the end of what is said of a number: Δ = 0.19 (kg m²)²."""


def without_units_of_numbers(written: TracedText) -> TracedText:
    """Return an answer without the units behind sums of numbers, behind moments of inertia in equations and, with a
    power, behind numbers, whose letters may be names of the system: kg is no k·g."""
    found = (m.span("unit") for form in (_SUM, _INERTIA, _RAISED) for m in form.finditer(written.text))
    return written.edited(apart((start, end, "") for start, end in found))


def without_unit_checks(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer without what is equated to units on lines that say that they check these; ``taken``: whether
    the system has a name, which is no unit alone."""
    checked = written.edited(_checks(written.text, taken))
    return checked.edited(list(_equated(checked.text, taken)))


def _checks(text: str, taken: Callable[[str], bool]) -> Iterator[Edit]:
    at = 0
    for line in text.splitlines(keepends=True):
        if "=" in line and _SAID.match(line) is not None:
            for part in _PART.finditer(line):
                if "=" in part.group() and _ends_in_units(part.group(), taken):
                    yield at + part.start(), at + part.end(), " " * len(part.group())
        at += len(line)


def _equated(text: str, taken: Callable[[str], bool]) -> Iterator[Edit]:
    """Units that are equated to others, with the term whose unit it is if a gap parts them."""
    for match in _EQUATED.finditer(text):
        start = text.rfind("\n", 0, match.start()) + 1
        before, names = text[start : match.start()], _NAME.findall(match["units"])
        if not {"kg", "N"}.intersection(names) or all(map(taken, names)) or not before.strip():
            continue
        above = text[:start].rstrip().rpartition("\n")[2][-1:]
        goes_on = _SIGNED.match(before) is not None or above in "+-−*·/="
        at = match.start() if match["open"] or "=" in before or goes_on else start
        yield at, line_end(text, match.end()) if at == start else match.end(), ""


def _ends_in_units(part: str, taken: Callable[[str], bool]) -> bool:
    """Whether what stands behind the last equals sign is a product of units."""
    last = part.rsplit("=", 1)[1].rstrip(" \t.✓✔")
    names = _NAME.findall(last)
    units = _OTHER.fullmatch(last) is not None and UNITS.issuperset(names)
    return units and any(not taken(x) for x in names)
