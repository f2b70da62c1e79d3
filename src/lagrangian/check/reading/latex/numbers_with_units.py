r"""Writes out what the package siunitx sets, numbers with units and angles, as LaTeX does without it.

\SI{9.81}{m/s^2}  \qty{0.5}{\newton\metre}  \num{1,5e-3}  9.81\,\unit{\metre\per\second\squared}    9.81, 0.5, …
\ang{30}  \SI{30}{\degree}                                                                       30^\circ

A unit is left out only if one of it is one in SI units; all others stay as they are.
"""

from __future__ import annotations

import re

from lagrangian.check.reading.traced_text import TracedText
from lagrangian.quantities.units import joined, lookup

_OPTIONS = r"(?:\s{0,3}\[[^\[\]{}]{0,80}\])?\s{0,3}"
_VALUE = r"\{\s{0,3}(?P<number>[^{}]{1,40})\}"
_UNIT = r"\s{0,3}\{(?P<unit>[^{}]{0,80})\}"
_QUANTITY = re.compile(rf"\\(?:SI|qty){_OPTIONS}{_VALUE}{_UNIT}")
_ALONE = re.compile(rf"\\(?:num{_OPTIONS}|(?P<angle>ang){_OPTIONS}){_VALUE}")
_BEHIND = re.compile(rf"(?<=[\d)])(?:\s|~|\\[,;:! ]){{0,5}}\\(?:si|unit){_OPTIONS}\{{(?P<unit>[^{{}}]{{0,80}})\}}")
_NUMBER = re.compile(
    r"(?P<sign>[+-]?)\s?(?P<digits>\d{1,15}(?:[.,]\d{0,15})?|[.,]\d{1,15})\s?(?:[eEdD]\s?(?P<power>[+-]?\d{1,3}))?\s*"
)
_NAME = re.compile(r"[^\W\d_]+")
_OTHER = re.compile(r"[\w\s*·./^(){}²³⁻¹°Ω\\~,;:!+-]*")
"""What a unit consists of."""
_WORDS = {"metre": "m", "meter": "m", "kilogram": "kg", "second": "s", "newton": "N", "joule": "J", "watt": "W"}
_WORDS |= {"radian": "rad", "hertz": "Hz", "pascal": "Pa", "ampere": "A", "volt": "V", "ohm": "Ω", "henry": "H"}
_WORDS |= {"farad": "F", "tesla": "T", "weber": "Wb", "coulomb": "C", "kelvin": "K"}
_JOINING = frozenset(["per", "squared", "cubed", "square", "cubic", "tothe", "cdot", "of"])
_DEGREES = frozenset(["\\degree", "°", "\\circ", "^\\circ", "deg"])


def with_siunitx(written: TracedText) -> TracedText:
    """Return an answer in LaTeX with such numbers, units and angles written out."""

    def quantity(match: re.Match[str]) -> str:
        if match["unit"].strip() in _DEGREES:
            return _number(match, degrees=True)
        return _number(match) if _is_one(match["unit"]) else match.group()

    def alone(match: re.Match[str]) -> str:
        return _number(match, degrees=match["angle"] is not None)

    plain = written.sub(_QUANTITY, lambda m: quantity(m).rjust(len(m.group())))
    plain = plain.sub(_ALONE, lambda m: alone(m).rjust(len(m.group())))  # its last place is that of the command
    return plain.sub(_BEHIND, lambda m: "" if _is_one(m["unit"]) else m.group())


def _number(match: re.Match[str], *, degrees: bool = False) -> str:
    """The number of a command as it is written without it; what is no plain number stays as it is."""
    number = _NUMBER.fullmatch(match["number"])
    if number is None:
        return match.group()
    made = number["digits"].replace(",", ".")
    made = f"0{made}" if made.startswith(".") else made.rstrip(".")
    made = made if number["power"] is None else rf"{made}\cdot 10^{{{int(number['power'])}}}"
    if degrees:
        made = rf"{made}^\circ"
    if number["sign"] == "-" or number["power"] is not None:
        return f"({'-' if number['sign'] == '-' else ''}{made})"
    before = match.string[: match.start()].rstrip()[-1:]
    return f"({made})" if before.isalnum() or before in {"}", "."} else made


def _is_one(unit: str) -> bool:
    """Whether one of a unit is one in SI units."""
    written: list[str] = _NAME.findall(unit)
    names = [x for name in written if (x := _WORDS.get(name, name)) not in _JOINING]
    found = [lookup(part) for name in names for part in (joined(name) or (name,))]
    prefixed = re.search(r"\\(?:kilo|milli|centi|micro|mega|deci|nano|giga|hecto)(?![A-Za-z])", unit) is not None
    return _OTHER.fullmatch(unit) is not None and not prefixed and all(x is not None and x.factor == 1 for x in found)
