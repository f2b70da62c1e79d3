"""Takes off an answer in plain text how a rate is written otherwise, where this stands in brackets behind it.

x2 = θ̇ (dθ/dt)        x2 = theta' (= dtheta/dt)        v = dx/dt (= x')        (xd, yd their derivatives)

A rate is said twice only where it is the whole value of a name and its line ends behind the brackets or goes on with
something else: anywhere else brackets are a factor, and so is the same rate in the same spelling.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from unicodedata import normalize

from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.traced_text import TracedText
from lagrangian.read.letters import key, undotted

_NAME = r"[^\W\d_][\w\u0307\u0308]{0,23}+"
_TWO = r"(?:\^2|²)"
_RATE = rf"(?:d{_TWO}?[ ]?{_NAME}(?:\(t\))?[ ]?/[ ]?dt{_TWO}?|{_NAME}['’′″]{{0,2}})"
_GLOSS = re.compile(
    rf"(?<![^\W_])(?P<of>[^\W\d]\w{{0,23}}+)[ \t]*+(?::=|=)[ \t]*+(?P<rate>{_RATE})"
    rf"[ \t]*+(?P<gloss>\((?P<equal>[ \t]*+[=≡])?[ \t]*+(?P<other>{_RATE})[ \t]*+\))(?=[ \t]*+(?:[,;.]\s|[,;.]?$))",
    re.MULTILINE,
)
_SLOPE = re.compile(
    rf"^(?P<value>[ \t]*+(?P<name>[^\W\d]\w{{0,23}}+)[ \t]*+(?::=|=)[^=\n]{{1,200}}?)"
    rf"(?:[ \t]{{3,}}|[ ]?\t[ \t]*)\([ \t]*+=?[ \t]*+[d∂][ ]?(?P<of>{_NAME})[ ]?/[ ]?[d∂][ ]?(?P<by>{_NAME})"
    r"[ \t]*+\)[ \t]*$",
    re.MULTILINE,
)
"""A value of a name and, apart from it, the derivative that it is: r = …      (ds/dtheta)."""
_DERIVATIVES = re.compile(
    rf"\([ ,]{{0,24}}(?P<listed>{_NAME}(?:[ ]?(?:,|and|und)[ ]{_NAME}){{0,11}})[ ,:]{{1,3}}(?:(?:are|sind|for)[ ])?"
    r"(?:their|the|its|ihre|die)[ ](?:time[ ])?(?:derivatives?|rates?|velocities|[Aa]bleitungen)[ .]?\)"
)
"""A list of rates in brackets, and that they are: (xd, yd their derivatives)."""
_FRACTION = re.compile(rf"d(?P<two>{_TWO})?[ ]?(?P<of>{_NAME})(?:\(t\))?[ ]?/[ ]?dt(?P<twice>{_TWO})?")
_LETTERS = re.compile(r"(?P<of>[^\W\d_]\w{0,20}?)_?(?P<dots>ddot|dot)")


def without_glosses_of_rates(text: TracedText, changes: Callable[[str], bool]) -> TracedText:
    """Return an answer without the brackets behind a rate that hold the same rate in another spelling, and without
    those that say, apart from a value, which derivative it is.

    ``changes`` says whether a name changes with time.
    """

    def plain(match: re.Match[str]) -> str:
        before = match.string[: match.start()].rstrip(" \t")[-1:]
        rate, other = _rate(match["rate"]), _rate(match["other"])
        if rate is None or other is None or rate[:2] != other[:2] or rate[2] == other[2]:
            return match.group()
        if not changes(rate[0]) or (before and before in "*/+-−·×^=()²³0123456789"):
            return match.group()
        return match.group()[: match.start("gloss") - match.start()].rstrip(" \t")

    def without_list(match: re.Match[str]) -> str:
        listed = re.findall(_NAME, match["listed"])
        rates = [any(changes(stem) for _, stem in spelled_rates(x)) or changes(x) for x in listed]
        return "" if all(rates) else match.group()

    def slope(match: re.Match[str]) -> str:
        force = key(match["name"]).startswith(("Q", "Xi"))
        said = changes(match["by"]) and match["by"] != match["of"] and not changes(match["name"]) and not force
        return match["value"] if said and match["value"].rstrip()[-1:] not in "*/+-−·×^(" else match.group()

    apart = text.sub(_SLOPE, slope)
    return apart.sub(_GLOSS, plain).sub(_DERIVATIVES, without_list)


def _rate(written: str) -> tuple[str, int, str] | None:
    """The key of a coordinate, how often it is differentiated, at least once, and how this is written."""
    if (match := _FRACTION.fullmatch(written)) is not None:
        if (match["two"] is None) != (match["twice"] is None):
            return None
        return key(match["of"]), 2 if match["two"] else 1, "fraction"
    bare = written.rstrip("'’′″")
    primes = sum(2 if mark == "″" else 1 for mark in written[len(bare) :])
    name, dots = undotted(normalize("NFC", bare))
    if primes and not dots:
        return key(bare), primes, "primes"
    if dots and not primes:
        return key(name), dots, "dots"
    match = _LETTERS.fullmatch(bare)
    return None if match is None or primes else (key(match["of"]), len(match["dots"]) - 2, "letters")
