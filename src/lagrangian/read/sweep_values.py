"""The values that one quantity takes over a sweep, as people write them in a word.

    k=10:100:50            50 values from 10 to 100, both among them
    k=10:100:50:log        the same, each a fixed factor above the last
    m2=1 kg, 2 kg, 5 kg    these
    m2=0.5kg               this one
    b~normal(1, 0.1)       drawn: normal(mean, deviation), uniform(lowest, highest), lognormal(mu, sigma)

Numbers carry units or are in SI units; a range or a list mixes neither; mu and sigma are those of
the logarithm. The text is split here and never run.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import NoReturn, TypeAlias

from lagrangian.errors import Place, did_you_mean
from lagrangian.quantities.quantity import Quantity, read_quantity
from lagrangian.quantities.source import Source, printable, shown
from lagrangian.records import dataclass

MAX_CHARACTERS = 10_000
MAX_COUNT = 10_000_000
"""The largest number of values in one range."""

LAWS = {"normal": 2, "uniform": 2, "lognormal": 2}
"""The distributions, and their numbers of parameters."""

SPACINGS = ("lin", "log")
Part: TypeAlias = Callable[[int, int], Source]
"""A piece of the whole text, from one character to another, with its place."""

EXAMPLE = "k=10:100:50, k=10,20,40 or k~normal(40,2)"


@dataclass(frozen=True)
class Spread:
    """The values given for ``name``: ``kind`` is "range", "list" or a distribution; ``numbers`` are as written.

    A range has two numbers and ``count`` values, which are evenly spaced or, with ``log``, evenly spaced in the
    logarithm. ``text`` is the part after the name; ``source`` gives its place in messages.
    """

    name: str
    kind: str
    numbers: tuple[Quantity, ...]
    count: int
    log: bool
    text: str
    source: Source

    @property
    def drawn(self) -> bool:
        """Whether the values are drawn from a distribution."""
        return self.kind in LAWS


def parse_spread(text: str) -> Spread:
    """Return the values that ``text`` describes, with their name: ``"k=10:100:50"``, ``"b~normal(1, 0.1)"``.

    Raises `ParseError` with a caret and a remedy.

    >>> parse_spread("k=10 N/m : 100 N/m : 4").count
    4
    """
    line = printable(text) if isinstance(text, str) else None
    source = Source(text, "", locate=lambda k: Place(None, None, k + 1, line))
    source.check_text(MAX_CHARACTERS, EXAMPLE)
    found = re.match(r"\s*([^=~\s][^=~]*?)\s*([=~])", text)
    if found is None:
        raise source.error("this is not a name with values", 0, fix=f"write {EXAMPLE}", code="E406")
    return _spread(found.group(1), found.group(2) == "~", text, found.end())


def parse_values(name: str, text: str) -> Spread:
    """Return the values of ``name`` that ``text`` describes: ``"10:100:50"``, ``"normal(1, 0.1)"``."""
    Source(text, f"values of '{name}'").check_text(MAX_CHARACTERS, "10:100:50")
    start = len(text) - len(text.lstrip(" \t\n=~"))
    return _spread(name, text.lstrip().startswith("~"), text, start)


def _spread(name: str, tilde: bool, whole: str, start: int) -> Spread:
    line = printable(whole)

    def part(begin: int, end: int) -> Source:
        return Source(
            whole[begin:end], f"values of '{name[:64]}'", locate=lambda k: Place(None, None, begin + k + 1, line)
        )

    source = part(start, len(whole))
    if not source.text.strip():
        raise source.error("no value is given", 0, fix=f"write {EXAMPLE}", code="E406")
    law = re.match(r"\s*([^\W\d]\w*)\s*\(", source.text)
    if tilde or law is not None:
        return _law(name, source, part, start, law)
    if ":" in source.text:
        return _range(name, source, part, start)
    pieces = _pieces(source.text, ",")
    numbers = tuple(read_quantity(part(start + a, start + b)) for a, b in pieces)
    _same_units(source, numbers)
    return Spread(name, "list", numbers, len(numbers), False, source.text.strip(), source)


def _pieces(text: str, mark: str) -> list[tuple[int, int]]:
    """Where the parts between ``mark`` begin and end."""
    found, begin = [], 0
    for k, c in enumerate(text):
        if c == mark:
            found.append((begin, k))
            begin = k + 1
    return [*found, (begin, len(text))]


def _range(name: str, source: Source, part: Part, start: int) -> Spread:
    pieces = _pieces(source.text, ":")
    if not 3 <= len(pieces) <= 4:
        ends = source.text.strip()
        fix = f"write {ends}:11 for 11 values from the first to the second" if len(pieces) == 2 else "write 10:100:50"
        raise source.error(f"a range has three parts, from:to:count (got {len(pieces)})", 0, fix=fix, code="E406")
    low, high = (read_quantity(part(start + a, start + b)) for a, b in pieces[:2])
    _same_units(source, (low, high))
    begin, end = pieces[2]
    count = source.text[begin:end].strip()
    if not re.fullmatch(r"[0-9]{1,12}", count) or not 2 <= int(count) <= MAX_COUNT:
        _refuse_count(source, count, begin)
    log = False
    if len(pieces) == 4:
        begin, end = pieces[3]
        spacing = source.text[begin:end].strip()
        if spacing not in SPACINGS:
            raise source.error(f"unknown spacing {shown(spacing)}", begin, fix="lin or log", code="E402")
        log = spacing == "log"
    if log and not (low.value * high.value > 0):
        raise source.error(
            "a logarithmic range needs two numbers of the same sign, neither of them 0",
            0,
            fix="1:100:20:log",
            code="E406",
        )
    return Spread(name, "range", (low, high), int(count), log, source.text.strip(), source)


def _refuse_count(source: Source, count: str, offset: int) -> NoReturn:
    if re.fullmatch(r"[0-9]+", count) and (len(count) > 12 or int(count) > MAX_COUNT):
        raise source.error(
            f"{shown(count)} values are too many for one range", offset, fix=f"at most {MAX_COUNT}", code="E703"
        )
    if count in ("0", "1"):
        raise source.error(
            f"a range needs at least 2 values (got {count})",
            offset,
            fix="give 2 or more; for a single value write k=10",
            code="E406",
        )
    raise source.error(
        f"the third part of a range is the number of values (got {shown(count)})",
        offset,
        fix="give a whole number: 10:100:50 is 50 values from 10 to 100",
        code="E406",
    )


def _law(name: str, source: Source, part: Part, start: int, law: re.Match[str] | None) -> Spread:
    known = "normal(mean, deviation), uniform(lowest, highest), lognormal(mu, sigma)"
    if law is None:
        raise source.error("this is not a distribution", 0, fix=known, code="E406")
    kind = law.group(1)
    if kind not in LAWS:
        hint = did_you_mean(kind, LAWS) or f"known: {known}"
        raise source.error(f"unknown distribution {shown(kind)}", law.start(1), fix=hint, code="E402")
    inner = source.text[law.end() :].rstrip()
    if not inner.endswith(")"):
        raise source.error("this '(' is never closed", law.end() - 1, fix="add the missing ')'", code="E406")
    begin = law.end()
    pieces = [(begin + a, begin + b) for a, b in _pieces(inner[:-1], ",")]
    if len(pieces) != LAWS[kind]:
        raise source.error(f"{kind} takes {LAWS[kind]} numbers (got {len(pieces)})", begin, fix=known, code="E406")
    numbers = tuple(read_quantity(part(start + a, start + b)) for a, b in pieces)
    _fits(source, kind, numbers, pieces)
    return Spread(name, kind, numbers, 1, False, source.text.strip(), source)


def _fits(source: Source, kind: str, numbers: tuple[Quantity, ...], pieces: list[tuple[int, int]]) -> None:
    """Raise an error for numbers that are not valid for a distribution."""
    a, b = (n.value for n in numbers)
    if kind == "lognormal":
        if not all(n.is_bare for n in numbers):
            raise source.error(
                "lognormal takes the mean and deviation of the logarithm, which have no unit",
                pieces[0][0],
                fix="lognormal(0, 0.1) has its median at 1 SI unit",
                code="E408",
            )
    else:
        _same_units(source, numbers)
    if kind == "uniform" and not a < b:
        raise source.error(
            "the lowest value is not below the highest", pieces[0][0], fix="write uniform(1, 2)", code="E406"
        )
    if kind != "uniform" and not b >= 0:
        raise source.error("the standard deviation is negative", pieces[1][0], fix=f"{kind}(1, 0.1)", code="E406")


def _same_units(source: Source, numbers: tuple[Quantity, ...]) -> None:
    """Check that all numbers have a unit of one dimension, or none has: 10:50 mm would be 10 m to 50 mm."""
    for n in numbers[1:]:
        if n.is_bare != numbers[0].is_bare and 0 not in (n.value, numbers[0].value):
            raise source.error(
                "some of the numbers have a unit and others do not",
                0,
                fix="give all of them a unit: 10 mm:50 mm:5",
                code="E408",
            )
        if not n.is_bare and not numbers[0].is_bare and n.dimension != numbers[0].dimension:
            raise source.error(
                f"'{numbers[0].unit}' and '{n.unit}' are units of different quantities", 0, fix="one unit", code="E408"
            )
