"""Takes lists of values off an answer: Numbers: M = 5 kg, m = 2 kg, slope 25 deg, g = 9.81.

A line that only gives several parameters values is no equation; each value becomes a statement of its own, and the
words between them are blank. Every replacement is as long as what it
replaces, so that all places stay the same.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from math import isclose, isnan, pi, prod

from lagrangian.check.reading.name_patterns import BARE_NAME, RAISED
from lagrangian.check.reading.prose.words import function_of
from lagrangian.quantities.units import joined, lookup

_VALUE = re.compile(
    rf"(?<![\w.])(?P<name>{BARE_NAME})(?:\^\d|[²³])?+[ \t]*+=[ \t]*+(?P<number>\d++(?:[.,]\d++)?+(?:[eE][-+]?\d++)?+)"
    r"(?P<below>[ \t]*+/[ \t]*+\d++(?:\.\d++)?+)?+"
    r"(?![ \t]*[*·×⋅^+'′″\[=−-]|[ \t]*/[ \t]*[\d(]|[ \t]*\((?!\w{1,6}\)))"
    r"(?P<unit>[ \t]*+°|[ \t]*+[^\W\d_]++(?:(?:[ \t]|[ ]?[/·*][ ]?)?[^\W_]++){0,4}(?![\w²³]*[ \t]*=))?"
)
_AMOUNT = r"\d++(?:[.,]\d++)?+(?:[eE][-+]?\d++)?+"
_UNIT = r"[ \t]*+(?:°|[^\W\d_]++(?:(?:[ \t]|[ ]?[/·*][ ]?)?[^\W_]++){0,4}(?![\w²³(]))"
_AGAIN = re.compile(
    rf"=[ \t]*+(?P<number>{_AMOUNT})(?P<unit>{_UNIT})[ \t]*+(?==[ \t]*+(?P<same>{_AMOUNT})(?P<other>{_UNIT}))"
)
"""A value that is given once more in another unit: e = 120 mm = 0.12 m."""
_FACTOR = re.compile(
    rf"(?:(?<![\w.])(?P<name>{BARE_NAME})|(?<![\w.,^])\d{{1,6}}|\((?P<sum>[\w \t+*/·−-]{{1,40}})\))(?:\^\d|[²³])?"
    r"(?:[ ]?[*·/+−-])?[ ]?\Z"
)
"""A factor or a term in front of a name: a name, a number or a sum in brackets."""
_PART = re.compile(r"(?P<by>[/·* ]*)(?P<unit>[^\W\d_]+)(?P<power>\d?)")

_RATE = re.compile(r"\w['’′″]++(?!s\b)|\bd\d?\w*+/d|[\u0307\u0308]|[ẋẍẏÿżṙṁ]|\w_?d?dot\b|\bdd?ot\b|\bdiff\b|\bDeriv")
"""A rate or an acceleration, by which a part of an equation is known from words."""

FEWEST = 2
"""The fewest values in a line that make it a list of values."""


_TEN = re.compile(
    rf"(?P<head>(?<![\w.]){BARE_NAME}[ \t]*+=[ \t]*+[-−]?)(?P<number>\d++(?:[.,]\d++)?+)[ \t]?[·×⋅*][ \t]?10"
    r"(?:(?:\^|\*\*)[({]?(?P<power>[-+−]?\d{1,2})[)}]?|(?P<raised>[⁻⁺]?[⁰¹²³⁴-⁹]{1,2}))(?![\d(^⁰¹²³⁴-⁹])"
)
"""A value with a power of ten, perhaps with a unit behind it: k = 8·10⁶ N/m."""


def _with_exponents(text: str) -> str:
    """The text, as long as it was, with 8·10⁶ as 8e6 in values of names."""
    return _TEN.sub(lambda m: f"{m['head']}{m['number'].replace(',', '.')}e{_power(m)}".ljust(len(m.group())), text)


def _power(match: re.Match[str]) -> str:
    return (match["power"] or match["raised"].translate(RAISED)).replace("−", "-")


def without_values(text: str, values: Callable[[str], float | None], notes: dict[str, None]) -> str:
    """Return an answer in plain text without its lists of values.

    ``values`` returns the value of a parameter of the system, NaN for one without a value, and None for other names.
    """
    lines = _with_exponents(text).split("\n")
    for k, typed in enumerate(lines):
        line = _AGAIN.sub(_in_last_unit, typed) if typed.count("=") > FEWEST else typed
        if line.count("=") < FEWEST:
            continue
        found = list(_VALUE.finditer(line))
        if len(found) != line.count("=") or any(values(m["name"]) is None for m in found):
            continue
        if _moves(_VALUE.sub(lambda m: f" {m['unit'] or ''}", line)):
            continue  # an equation without "=" stands beside the values, and is not to be passed over
        kept, starts = list(" " * len(line)), _starts(line, found, values)
        for match, start, below in zip(found, starts, [*starts[1:], len(line)], strict=True):
            unit = match["unit"] or "" if match.end() <= below else ""
            read = not _same(match, values(match["name"])) and _factor(unit) not in (None, 1.0)
            end = match.end() if read and unit else match.end("below") if match["below"] else match.end("number")
            kept[start:end] = line[start:end].replace(",", ".")
            if end < len(line):
                kept[end] = ";"
        lines[k] = "".join(kept)
        notes.setdefault(f"Line {k + 1} was read as a list of values.")
    return "\n".join(lines)


_NUMBER = re.compile(r"[ \t]*+([-−]?\d{1,9}(?:[.,]\d{1,12})?)(?![\w.,]*\d)")
_LETTER = re.compile(r"[^\W\d_₀-₉](?:_?[\d₀-₉]{1,2})?")
LONGEST_PRODUCT = 4
"""The most letters of a product whose value is given."""
ROUNDED = 0.005
"""How far the value of a product may be off, as a part of it."""


def is_value_of_product(name: str, text: str, end: int, values: Callable[[str], float | None]) -> bool:
    """Whether what stands behind a name up to ``end``, its equals sign, is the value of the product of its letters,
    which are parameters of the system: Me = 0.18, m₂L = 48."""
    letters = _LETTER.findall(name)
    if not 1 < len(letters) <= LONGEST_PRODUCT or "".join(letters) != name or values(name) is not None:
        return False
    factors = [values(x) for x in letters]
    number = _NUMBER.match(text, end)
    if number is None or any(x is None or isnan(x) for x in factors):
        return False
    return isclose(float(number[1].replace(",", ".").replace("−", "-")), prod(map(float, factors)), rel_tol=ROUNDED)  # type: ignore[arg-type]


def _in_last_unit(match: re.Match[str]) -> str:
    """Blanks for a value that is given again in another unit; the value as it stands if the two differ."""
    factors = [_factor(match["unit"]), _factor(match["other"])]
    if factors[0] is None or factors[1] is None:
        return match.group()
    first, second = (float(x.replace(",", ".")) for x in (match["number"], match["same"]))
    same = isclose(first * factors[0], second * factors[1], rel_tol=1e-3)
    return " " * len(match.group()) if same else match.group()


def _starts(line: str, found: Sequence[re.Match[str]], values: Callable[[str], float | None]) -> list[int]:
    """Where the expressions begin whose values are given: n K = 2, (M + m) g = 20; a unit in front is no part of it."""
    starts, least = list[int](), 0
    for match in found:
        start = match.start()
        while (factor := _FACTOR.search(line, max(least, start - 60), start)) is not None:
            named = re.findall(BARE_NAME, factor["name"] or factor["sum"] or "")
            if any(values(x) is None and function_of(x) is None for x in named):
                break
            start = factor.start()
        starts.append(start)
        apart = (match["unit"] or "")[:2].isspace() or _factor(match["unit"] or "") is None
        least = match.end("number") if apart else match.end()
    return starts


def _moves(words: str) -> bool:
    """Whether a rate stands among the words between values."""
    return _RATE.search(words) is not None


def _same(match: re.Match[str], value: float | None) -> bool:
    """Whether a number is the value in the system, in SI units."""
    number = float(match["number"].replace(",", "."))
    return value is not None and isclose(number, value, rel_tol=1e-9)


def _factor(unit: str) -> float | None:
    """How many SI units a unit is; None if it is none."""
    if unit.strip() == "°":
        return pi / 180
    total, below = 1.0, False
    for by, written, power in _parts(unit):
        found = lookup(written)
        below = below or "/" in by
        if found is None or found.factor == 0:
            return None
        factor = float(Fraction(found.factor)) ** int(power or 1)
        total = total / factor if below else total * factor
    return total


def _parts(unit: str) -> Iterator[tuple[str, str, str]]:
    """The parts of a unit: what stands before each, its letters and its power; N and m of Nm."""
    for match in _PART.finditer(unit):
        word = match["unit"]
        parts = joined(word) or (word,)
        for k, part in enumerate(parts):
            yield "" if k else match["by"], part, match["power"] if part is parts[-1] else ""
