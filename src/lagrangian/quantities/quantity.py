"""Numbers with units: ``"40 N/m"``, ``"30 deg"``, ``"-pi/4 rad"``, ``"1/2 kg"``, ``"9.81 m/s²"``.

    quantity: [sign] number ((* | /) number)* [unit]        a number, pi, ½
    unit: power ((* | / | space) power)*                    no space-product after a /
    power: name | ( unit ) [^ whole number | ^ ( fraction ) | ²]

Values come out in SI units; angles in radians.
"""

from __future__ import annotations

import math
import re
from fractions import Fraction
from functools import lru_cache
from typing import NoReturn

from lagrangian.advice import Advice, Verb
from lagrangian.codes import CodeText
from lagrangian.errors import ParseError, Place
from lagrangian.quantities.source import Source, character, shown
from lagrangian.quantities.unit_hints import refusal, similar
from lagrangian.quantities.units import BEFORE_WORDS, ONE, Dimension, Unit, lookup
from lagrangian.records import dataclass

MAX_CHARACTERS = 200
MAX_EXPONENT = 20
MAX_DEPTH = 8
_FRACTIONS = {"¼": Fraction(1, 4), "½": Fraction(1, 2), "¾": Fraction(3, 4)}
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
_TOKEN = re.compile(
    r"""\s*(?:
      (?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|[¼½¾])
    | (?P<power>\^|\*\*)
    | (?P<raised>[⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+)
    | (?P<operator>[*/×·⋅÷])
    | (?P<sign>[+\-−])
    | (?P<bracket>[()])
    | (?P<name>[^\W\d_⁰¹²³⁴-⁹¼½¾][^\W⁰¹²³⁴-⁹¼½¾]*|°)
    )""",
    re.VERBOSE,
)


@dataclass(frozen=True)
class Quantity:
    """A quantity: ``value`` in SI units, the ``unit`` in which it was given (empty for a bare number) and its
    dimension."""

    value: float
    unit: str
    dimension: Dimension

    @property
    def is_bare(self) -> bool:
        """Whether no unit was given."""
        return not self.unit


@dataclass(frozen=True)
class _Token:
    kind: str
    text: str
    start: int
    end: int


@lru_cache(maxsize=1024)
def parse_quantity(text: str, *, what: str = "value", example: str = "40 N/m") -> Quantity:
    """Return the quantity that ``text`` describes. Raises `ParseError` with line, column and a correct form, such as
    the ``example``.

    >>> parse_quantity("40 N/m").value, parse_quantity("250 mm").value
    (40.0, 0.25)
    """
    return read_quantity(Source(text, what, example=example))


def read_quantity(source: Source) -> Quantity:
    """Return the quantity that a `Source` describes."""
    source.check_text(MAX_CHARACTERS, f"a number and a unit, such as {source.example}")
    reader = _Reader(source)
    number, is_pi = reader.number()
    start = reader.offset
    unit = reader.unit()
    text = source.text[start:].strip()
    try:
        value = float(number * unit.factor) * (math.pi if is_pi else 1.0)
    except OverflowError:
        value = math.inf
    if math.isinf(value):
        raise source.error("the number is too large", 0, fix="numbers go up to 1.7e308", code="E703")
    return Quantity(value, text.removeprefix("*").strip() if not text.startswith("/") else "1" + text, unit.dimension)


@lru_cache(maxsize=1024)
def parse_unit(text: str, what: str = "unit", place: Place | None = None) -> Unit:
    """Return the unit that ``text`` describes, such as ``"N/m"``; raises `ParseError`."""
    source = Source(text, what, place)
    source.check_text(MAX_CHARACTERS, "a unit, such as N/m")
    return _Reader(source).unit()


def unit_dimension(text: str) -> tuple[Fraction, ...]:
    """Return the exponents of the SI base units, in the order of `BASE`, of a unit."""
    return parse_unit(text).dimension.exponents


def unit_and_words(text: str) -> tuple[str | None, str]:
    """Split ``"N, pushes the carts apart"``. The part before the comma is a unit if it consists of SI symbols."""
    first, comma, rest = text.partition(",")
    words = re.findall(r"[^\W\d]+|°", first)
    if words and all(w in BEFORE_WORDS for w in words) and not re.search(r"[^\W\d]\s+[^\W\d]", first):
        try:
            parse_unit(first.strip())
        except ParseError:
            return None, text
        return first.strip(), rest.strip() if comma else ""
    return None, text


def si_unit(text: str) -> str | None:
    """Return the SI unit to which values in a unit are converted: ``kg`` for g; None if the unit itself is an SI
    unit."""
    unit = parse_unit(text)
    return None if unit.plain else unit.si


def unit_factor(text: str) -> float:
    """Return the factor from a unit to SI units: 0.001 for mm."""
    return float(parse_unit(text).factor)


class _Reader:
    def __init__(self, source: Source) -> None:
        self.source = source
        self.tokens = self._split()
        self.at = 0

    def _split(self) -> list[_Token]:
        text, tokens, position = self.source.text, [], 0
        while position < len(text) and not text[position:].isspace():
            match = _TOKEN.match(text, position)
            if match is None:
                self._strange(position)
            kind = match.lastgroup or ""
            tokens.append(_Token(kind, match.group(kind), match.start(kind), match.end()))
            position = match.end()
        return tokens

    def _strange(self, position: int) -> NoReturn:
        text = self.source.text
        while text[position].isspace():
            position += 1
        if comma := re.search(r"([0-9]+),([0-9]+)", text[max(0, position - 30) : position + 30]):
            number = comma.group()
            raise self.source.error(
                f"cannot read {shown(number)} as a number",
                position,
                fix=f"use a decimal point: {number.replace(',', '.')}",
                code="E406",
            )
        if text[position] == ":" and all(map(lookup, re.findall(r"[^\W\d_]+", text))):
            fix = Advice("give one value; a range such as 10:100:50 is an argument of ", Verb("sweep"))
            self.fail("this is a range of values, but one value is needed", position, fix)
        fix = (
            "write * for a product"
            if text[position] == "."
            else f"write a number and a unit, such as {self.source.example}"
        )
        raise self.source.error(
            f"found {character(text[position])} in a number with a unit", position, fix=fix, code="E406"
        )

    @property
    def offset(self) -> int:
        return self.tokens[self.at].start if self.at < len(self.tokens) else len(self.source.text)

    def peek(self, ahead: int = 0) -> _Token:
        index = self.at + ahead
        return self.tokens[index] if index < len(self.tokens) else _Token("end", "", self.offset, self.offset)

    def take(self) -> _Token:
        token = self.peek()
        self.at += 1
        return token

    def fail(self, message: str, offset: int, fix: str | None = None, code: CodeText = "E406") -> NoReturn:
        raise self.source.error(message, offset, fix=fix, code=code)

    # -- the number ---------------------------------------------------------------------------------------------

    def number(self) -> tuple[Fraction, bool]:
        """Read ``-2*pi/3``: the rational part, and whether it contains pi."""
        sign = -1 if self.peek().kind == "sign" and self.take().text != "+" else 1
        if not self._is_number():
            token = self.peek()
            if token.text.lower() in ("nan", "inf", "infinity"):
                self.fail(
                    f"it must be a finite number (got {token.text})", token.start, "write a finite number", "E101"
                )
            found = shown(token.text) if token.text else "the end"
            self.fail(
                f"found {found} where a number is expected first",
                token.start,
                f"write a number and a unit, such as {self.source.example}",
            )
        value, pis = sign * Fraction(1), 0
        operator = "*"
        while True:
            part, pi = self._factor()
            if operator in "/÷" and part == 0:
                self.fail("division by zero", self.tokens[self.at - 1].start)
            value = value / part if operator in "/÷" else value * part
            pis += (-1 if operator in "/÷" else 1) * pi
            if self.peek().kind != "operator" or not self._is_number(1):
                break
            operator = self.take().text
        if pis not in (0, 1):
            self.fail("pi may occur only once, as a factor", 0, "write a decimal number")
        if self._is_number() and not (self.peek().text == "1" and self.peek(1).text in ("/", "÷")):
            fix = f"write one number and a unit, such as {self.source.example}"
            self.fail("two numbers are next to each other", self.offset, fix)
        return value, bool(pis)

    def _is_number(self, ahead: int = 0) -> bool:
        token = self.peek(ahead)
        return token.kind == "number" or (token.kind == "name" and token.text in ("pi", "π"))

    def _factor(self) -> tuple[Fraction, int]:
        token = self.take()
        if token.kind == "name":
            return Fraction(1), 1
        if token.text in _FRACTIONS:
            return _FRACTIONS[token.text], 0
        digits, _, power = token.text.lower().partition("e")
        if len(digits) > 60 or len(power) > 5 or abs(int(power or 0)) > 308:
            self.fail(
                f"the number {shown(token.text, 20)} is too long",
                token.start,
                "at most 60 digits, and powers of ten from -308 to 308",
                "E703",
            )
        return Fraction(token.text), 0

    # -- the unit -----------------------------------------------------------------------------------------------

    def unit(self) -> Unit:
        """Read the rest as a unit; an empty rest is no unit."""
        if self.peek().kind == "end":
            return ONE
        first = self.peek()
        divide = first.kind == "operator" and first.text in "/÷"
        if first.kind == "operator":
            self.take()
        start = self.offset
        try:
            unit = self._product(0, divide)
            float(unit.factor)
        except (OverflowError, ZeroDivisionError):
            self.fail("the unit is too large or too small", start, code="E703")
        if self.peek().kind != "end":
            self._behind()
        return unit

    def _behind(self) -> NoReturn:
        """Raise an error for anything after a unit."""
        token = self.peek()
        fix = "write a unit such as N/m or kg*m^2"
        if token.kind == "sign" and self.peek(1).kind == "name" and self.tokens[self.at - 1].kind == "name":
            fix = f"write * for a product: {self.tokens[self.at - 1].text}*{self.peek(1).text}"
        self.fail(f"found {shown(token.text)}", token.start, fix, "E408")

    def _product(self, depth: int, divide: bool) -> Unit:
        unit, divided = ONE, divide
        while True:
            unit = unit.times(self._power(depth), Fraction(-1 if divide else 1))
            token = self.peek()
            if token.kind == "operator":
                self.take()
                divide = token.text in "/÷"
                divided = divided or divide
            elif token.kind in ("name", "number") or token.text == "(":
                if divided:
                    self.fail("a product after / needs parentheses", token.start, "write N/(m*s), or N*s/m", "E408")
                divide = False
            else:
                return unit

    def _power(self, depth: int) -> Unit:
        token = self.take()
        if token.text == "(":
            if depth >= MAX_DEPTH:
                self.fail(f"parentheses are nested more than {MAX_DEPTH} deep", token.start, code="E703")
            base = self._product(depth + 1, False)
            if self.take().text != ")":
                self.fail("this '(' is never closed", token.start, "add the missing ')'", "E408")
        elif token.kind == "name":
            base = self._named(token)
        elif token.kind == "number" and token.text == "1":
            base = ONE
        else:
            found = shown(token.text) if token.text else "the end"
            self.fail(f"found {found} where a unit is expected", token.start, "write a unit such as N/m", "E408")
        return ONE.times(base, self._exponent())

    def _named(self, token: _Token) -> Unit:
        degrees = token.text in ("°", "deg") and self.peek().text in ("C", "F", "K")
        if reason := refusal(f"deg{self.peek().text}" if degrees else token.text):
            self.fail(reason[0], token.start, reason[1], "E408")
        unit = lookup(token.text)
        if unit is None:
            self.fail(
                f"unknown unit {shown(token.text)}",
                token.start,
                similar(token.text) or "units are written as kg, m, s, N, N*m, N/m, rad, deg, ...",
                "E408",
            )
        return unit

    def _exponent(self) -> Fraction:
        token = self.peek()
        if token.kind == "raised":
            self.take()
            return self._small(Fraction(token.text.translate(_RAISED)), token)
        if token.kind != "power":
            return Fraction(1)
        self.take()
        bracket = self.peek().text == "("
        if bracket:
            self.take()
        sign = -1 if self.peek().kind == "sign" and self.take().text != "+" else 1
        number = self.take()
        if number.kind != "number" or not re.fullmatch(r"[0-9]{1,6}(\.[0-9]{1,6})?", number.text):
            self.fail("an exponent must be a number", number.start, "write m^2, s^-1 or m^(1/2)", "E408")
        value = sign * Fraction(number.text)
        if bracket:
            if self.peek().text == "/":
                self.take()
                under = self.take()
                if not re.fullmatch(r"[1-9][0-9]?", under.text):
                    self.fail("an exponent must be a number", under.start, "write m^2, s^-1 or m^(1/2)", "E408")
                value /= int(under.text)
            if self.take().text != ")":
                self.fail("this '(' is never closed", token.end, "add the missing ')'", "E408")
        return self._small(value, number)

    def _small(self, value: Fraction, token: _Token) -> Fraction:
        if abs(value) > MAX_EXPONENT:
            self.fail("the exponent is too large", token.start, f"units go up to the power {MAX_EXPONENT}", "E703")
        return value
