"""The tokens of a statement in plain text: numbers with their units and commas, words split into names."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import islice

from lagrangian.check.reading.name_patterns import NAME, RAISED
from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.parser import AnswerToken
from lagrangian.check.reading.prose.words import Words, function_of
from lagrangian.quantities.source import Source
from lagrangian.quantities.units import joined, lookup
from lagrangian.read.letters import key, undotted

_TWO = r"\s*(?:(?:\^|\*\*)\s*2|²|2)"
_PRIME = r"['’′″‴\"]"
_DOT_PRODUCT = r"(?<=\s)\.(?=[ \t]{1,3}(?:∂|d)[ ]?(?![TVUWLDHℒ]\*?[ ]?/)[^\W\d]\w{0,24}[ ]?/[ ]?[∂d](?!t(?!\w)))"
"""A point between spaces in front of a derivative, F . dr/dq; a statement may begin with that of an energy."""
_KINDS = [
    ("space", r"\s+"),
    ("ddt2", rf"d{_TWO}\s*/\s*\(?\s*dt{_TWO}\s*\)?(?!\w)"),
    ("ddt", r"d\s*/\s*dt(?!\w)"),
    ("rate2", rf"d{_TWO}\s*(?P<of2>{NAME})\s*/\s*dt{_TWO}(?!\w)"),
    ("rate", rf"d\s*(?P<of1>{NAME}{_PRIME}*)\s*/\s*dt(?!\w)"),
    (
        "partial",
        rf"(?:(?P<round>∂)|d)\s*(?P<what>(?(round){NAME}{_PRIME}{{0,2}}|[^\W\d]\w{{0,24}}))\*?\s*/\s*(?:∂|d)\s*(?P<open>\()?\s*(?P<by>{NAME})(?P<dots>{_PRIME}*)(?(open)\s*\))",
    ),
    (
        "partial2",
        rf"∂²(?P<what2>[^\W\d²³][^\W²³]{{0,23}}{_PRIME}{{0,2}})\s?/\s?∂(?P<by2>[^\W\d²³][^\W²³]{{0,23}})²",
    ),
    ("number", r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"),
    ("fraction", r"[¼½¾⅐-⅞]"),
    ("star", r"T[₀-₉]*\*(?:[₀-₉]+|_\w+)?(?=\s*(?:[-+−–=),;]|\Z))"),
    ("name", NAME),
    ("primes", rf"{_PRIME}+"),
    ("raised", r"[⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+"),
    ("power", r"\.?\^|\.?\*\*"),
    ("times", rf"\.?[*×·⋅∙•]|{_DOT_PRODUCT}"),
    ("over", r"\.?[/÷∕]"),
    ("plus", r"\+"),
    ("minus", r"[-−–]"),
    ("relation", r"<=|>=|!=|<|>|≤|≥|≠"),
    ("=", r"==?"),
    ("sym", "\x01"),
    ("root", r"√"),
    ("bracket", r"[()\[\]{},;]"),
    ("other", r"."),
]
TOKEN = re.compile("|".join(f"(?P<{'eq' if kind == '=' else kind}>{form})" for kind, form in _KINDS), re.DOTALL)
"""The regular expression of one token, with the groups of_1, of_2, what, by and dots."""

_ONE = re.compile(
    r"(?P<by>\s*[/·*⋅]?\s*)(?P<unit>[^\W\d_⁰¹²³⁴-⁹]+)(?:\s*(?:\^|\*\*)\s*(?P<power>-?\d)|(?P<raised>[⁻⁺]?[¹²³⁴]))?"
)
_RATE = re.compile(r"d[ \t]?(?:\^[ \t]?2|²)?[ \t]?\w{0,24}+(?:\(t\))?[ \t]?/[ \t]?dt")
_BY_TIME = re.compile(r"[ \t]?/[ \t]?dt(?!\w)")
_LONGEST = 24
"""The most letters of a word among which a rate is sought."""
_MARKED = re.compile(rf"{_PRIME}(?!s\b)")
DETERMINANTS = frozenset(["det", "Det"])
"""What is written in front of a matrix for its determinant."""
_MATRIX_BEHIND = re.compile(r"[ ]?[(\[]|[ ][A-ZΑ-Ω](?![a-z])")
_QUOTIENT = re.compile(r"[ \t]*/[ \t]*[(]?d")
_DEGREES = re.compile(r"\s*(?:°|deg(?:rees?)?(?!\w))")
_WORD = re.compile(NAME)
_ENERGIES = frozenset("TVLDℒ")
_JOINED = frozenset(["N", "mN", "kN", "kg", "Nm", "J"])
_GOES_ON = tuple("'’′″_([0123456789\u0307\u0308")
_NUMBER = re.compile(r"(?<![\w.])(?>\d+)(?:\.\d*)?(?:[eE][+-]?\d+)?")
_BEHIND = re.compile(rf"\s*[*·⋅]?\s*(?P<name>{NAME})")
VARIATION = "δ"
"""The sign of virtual displacements and virtual work: δx, δW."""
_VARIED = re.compile(rf"{VARIATION}?[^{VARIATION}]+|{VARIATION}")
"""What stands in front of virtual displacements, and each of them."""
_OWN_DELTA = re.compile(rf"{VARIATION}_?[\d₀-₉]{{1,3}}")
"""A name with the letter δ: δ1 is no virtual displacement, of which a number has none."""
_ARGUMENT = re.compile(r"(?:sin|cos|exp)[ ]?\(?[^()=\n]{0,40}\Z")
"""The text up to a place in the argument of a function: no t that stands there is a tonne."""
MOST = 60
"""The most numbers of a statement among which units are sought."""
_VALUE = re.compile(
    rf"\s*(?P<name>{NAME})\s*==?\s*(?:[-−]\s*)?[0-9.]+(?:[eE][+-]?[0-9]+)?(?P<behind>\s*[^\W\d_]+[^=+()]*)", re.DOTALL
)
_LISTS = frozenset(["atan2", "min", "max", "diff", "Derivative", "D", "Eq", "piecewise", "Matrix", "Piecewise"])
_COMMA = re.compile(r"(?<=\d),(?=\d)")
_TIME = lookup("s").dimension  # type: ignore[union-attr]


def tokenize(source: Source, words: Words) -> list[AnswerToken]:
    """Return the tokens of a statement; words that are products become several."""
    text = source.text
    tokens: list[AnswerToken] = []
    at = 0
    value = (given := _VALUE.fullmatch(text)) is not None and _is_unit(given["behind"], given["name"], words)
    units = value or _in_units(text, words, sure=words.units)
    while at < len(text):
        match = TOKEN.match(text, at)
        assert match is not None
        at = match.end()
        kind = "=" if match.lastgroup == "eq" else str(match.lastgroup)
        if kind == "space":
            continue
        if kind == "star":  # the kinetic co-energy T*, not a product
            tokens.append(AnswerToken("name", match.group().replace("*", ""), match.start(), at))
        elif kind == "partial" and not _is_partial(match, words):
            match = _WORD.match(text, match.start())
            assert match is not None
            at = match.end()
            tokens += _names(match.group(), source, match.start(), words)
        elif kind == "rate" and _is_times_rate(match["of1"], words):
            at = match.start() + 1
            tokens.append(AnswerToken("name", "d", match.start(), at))
        elif kind == "root":
            tokens.append(AnswerToken("name", "sqrt", match.start(), at))
        elif kind == "number":
            tokens.append(AnswerToken(kind, match.group(), match.start(), at))
            at = _with_unit(tokens, text, at, words, value=value, units=units)
        elif kind == "name":
            at = match.start() + (before_rate(match, words) or len(match.group()))
            tokens += _names(text[match.start() : at], source, match.start(), words)
        else:
            tokens.append(AnswerToken(match.group() if kind == "bracket" else kind, match.group(), match.start(), at))
    tokens.append(AnswerToken("end", "", len(text), len(text)))
    return tokens


def _is_partial(match: re.Match[str], words: Words) -> bool:
    """Whether an energy, or another quantity of the answer's own, is differentiated by what moves: dR/dx', dR/dxd."""
    if match["round"] or match["what"] in _ENERGIES:
        return True
    quotient = any(words.is_name(f"d{match[x]}") for x in ("what", "by"))
    moves = words.names.changes(match["by"]) or _is_rate(match["by"], words)
    return not quotient and moves and words.is_own(match["what"])


def _is_rate(name: str, words: Words) -> bool:
    """Whether a name is the spelled rate of what moves, perhaps in shortened letters: xd, thd for theta'."""
    stems = [stem for _, stem in spelled_rates(name)]
    coordinates = [key(c.name) for c in words.names.model.coordinates]
    shortened = any(c.startswith(key(stem)) for c in coordinates for stem in stems if len(stem) > 1)
    return shortened or any(map(words.names.changes, stems))


def before_rate(match: re.Match[str], words: Words) -> int:
    """How many letters of a word are factors of a rate that begins in it, as in bdθ/dt and md²x/dt²; 0 if none is."""
    word, text = match.group(), match.string
    if words.is_name(word):
        return 0
    if word[-1] == "d" and (rate := TOKEN.match(text, match.end() - 1)) is not None and rate["rate2"] is not None:
        cuts = [len(word) - 1]
    elif _BY_TIME.match(text, match.end()) is not None:
        moving = (k for k, c in enumerate(word[:_LONGEST]) if k and c == "d" and len(word) > k + 1)
        cuts = [k for k in moving if words.names.changes(word[k + 1 :]) or words.is_own(word[k + 1 :])]
    else:
        return 0
    return next((k for k in cuts if words.is_name(word[:k]) or words.is_product(word[:k])), 0)


def _is_times_rate(of: str, words: Words) -> bool:
    """Whether what stands between d and /dt has a d of its own, so that the first d is a factor of the system or of the
    answer: d dx/dt is d ẋ, unless dx is a name."""
    if of == "d":
        return words.is_name("d") and not words.names.changes("d")
    if not of.startswith("d") or not words.is_name("d") or words.is_name(of):
        return False
    return words.names.changes(undotted(of[1:])[0]) or words.is_own(of[1:])


def is_varied(word: str, words: Words) -> bool:
    """Whether a word may hold a virtual displacement: not in δ1, nor if the system or the answer has a name δ, unless
    the word is that of a coordinate and the answer speaks of virtual work."""
    if VARIATION not in word or word == VARIATION or _OWN_DELTA.fullmatch(word) is not None:
        return False
    of = word.removeprefix(VARIATION)
    return not words.is_name(VARIATION) or (words.virtual and of != word and words.names.changes(of))


def _names(word: str, source: Source, start: int, words: Words) -> Iterator[AnswerToken]:
    """The tokens of a word: one, or one for each of its parts; a virtual displacement, δx in Fδx, is one."""
    if is_varied(word, words):
        for piece in _VARIED.finditer(word):
            at = start + piece.start()
            if piece.group().startswith(VARIATION):
                yield AnswerToken("name", piece.group(), at, start + piece.end())
            else:
                yield from _parts(piece.group(), source, at, words)
    else:
        yield from _parts(word, source, start, words)


def _parts(word: str, source: Source, start: int, words: Words) -> Iterator[AnswerToken]:
    """The tokens of a word without virtual displacements."""
    end = start + len(word)
    if word in DETERMINANTS and _MATRIX_BEHIND.match(source.text, end) is not None and not words.is_name(word):
        yield AnswerToken("name", word, start, end)
        return
    quotient = _QUOTIENT.match(source.text, end) or source.text[:start].rstrip()[-1:] == "/"  # dx/dθ
    if not quotient and (stem := words.behind_factor(word, rated=_MARKED.match(source.text, end) is not None)):
        words.note_split(word, f"d {stem}")
        yield AnswerToken("name", "d", start, start + 1)
        yield AnswerToken("name", stem, start + 1, end)
        return
    called = bool(re.match(r"\s*[\w(\[^²³√]|\s*\*\*", source.text[end : end + 8]))
    at = start
    for part in words.parts(word, source, start, called=called):
        kind = "number" if part.isdecimal() else "name"  # ① is a digit and no number
        yield AnswerToken(kind, part, at, at + len(part))
        at += len(part)


# -- numbers ----------------------------------------------------------------------------------------------------------


def with_points(text: str) -> str:
    """Return a statement with decimal commas as points: 0,5 is 0.5 outside matrices and lists of arguments."""
    if not _COMMA.search(text):
        return text
    open_brackets: list[bool] = []
    letters = list(text)
    for match in re.finditer(r"(\w*)\s*([(\[])|[)\]]|(?<=\d),(?=\d)", text):
        mark = match.group()
        if match[2]:
            open_brackets.append(match[2] == "[" or match[1] in _LISTS)
        elif mark in ")]":
            if open_brackets:
                open_brackets.pop()
        elif not any(open_brackets):
            letters[match.start()] = "."
    return "".join(letters)


def _in_units(text: str, words: Words, *, sure: bool) -> bool:
    """Whether what follows the numbers of a statement are units: one is no product of names, 300 N/m, or the answer is
    surely read so, and nothing else in the statement is a parameter: (8 kg + 2 kg) x'' + 300 N/m x = F."""
    rest, at = "", 0
    for match in islice(_NUMBER.finditer(text), MOST):
        if match.start() >= at and (end := _unit(text, match.end(), words, True)[1]) > match.end():
            unit, behind = text[match.end() : end].strip(), _BEHIND.match(text, end)
            if words.known(unit) and (words.names.changes(unit) or (behind and words.names.changes(behind["name"]))):
                return False  # 2500 s of a coordinate s; 2 m x''
            sure = sure or _unit(text, match.end(), words, False)[0] is not None
            rest, at = rest + text[at : match.start()] + " ", end
    listed = _WORD.findall(rest + text[at:]) if sure else []
    return sure and not any(words.known(x) and not words.names.changes(x) and function_of(x) is None for x in listed)


def _with_unit(tokens: list[AnswerToken], text: str, at: int, words: Words, *, value: bool, units: bool) -> int:
    """Convert the number that was just read if a unit follows that is no product of names; return where to go on.

    In a ``value``, m = 2 kg, and where a statement has ``units``, what follows the number is always a unit.
    """
    number = tokens[-1]
    if (degrees := _DEGREES.match(text, at)) is not None and not words.is_name("deg"):
        tokens[-1:] = [AnswerToken("(", "(", number.start, number.start), number]  # cos 25° is cos(25 π/180)
        more = [("times", "*"), ("name", "pi"), ("over", "/"), ("number", "180"), (")", ")")]
        tokens += [AnswerToken(kind, written, number.end, degrees.end()) for kind, written in more]
        return degrees.end()
    factor, end = _unit(text, at, words, units)
    if factor is None and not units:
        sure, behind = _unit(text, at, words, True)
        if sure is not None and _is_amount(text, number, behind, words):
            factor, end = sure, behind
    if factor is None and not units and not words.doubtful:
        words.doubtful = _unit(text, at, words, True)[0] is not None and _in_units(text, words, sure=True)
    made = _decimal(Fraction(number.text) * factor) if factor is not None else None
    if made is None:
        return at
    tokens[-1] = replace(number, text=made)
    if not value or factor != 1:
        words.names.notes.setdefault(f"{text[number.start : end]} was read as {made}.")
    return end


def _is_amount(text: str, number: AnswerToken, end: int, words: Words) -> bool:
    """Whether a number with a unit is what a calculation amounts to at the end of its statement, m g/k = 29 mm, though
    the unit may also be names of the system: constants alone are on its left, more than one, and m follows a decimal
    number, as masses are not added up to half of one."""
    before, unit = text[: number.start].rstrip(), text[number.end : end].strip()
    if before[-1:] not in ("=", "≈") or text[end:].strip(" \t.;"):
        return False
    listed = _WORD.findall(before)
    factors = [part for x in listed for part in (words.factors(x) or [x])]
    constant = all(words.known(x) and not words.names.changes(x) for x in factors if function_of(x) is None)
    return constant and len(factors) > 1 and ("." in number.text or len(unit) > 1)


def _is_unit(behind: str, name: str, words: Words) -> bool:
    """Whether what follows the number in a value is a unit alone: no function and no name that moves stands in it, as
    in 2 F l cos θ, and a ``name`` of the answer's own is not given names of the system, as in m_t = 2 m, or, without a
    blank, their product, J0 = 2mL²/3."""
    listed = re.findall(r"[^\W\d_⁰¹²³⁴-⁹₀-₉][^\W⁰¹²³⁴-⁹]*", behind)
    parts = [part for x in listed for part in words.factors(x)]  # 2L cosθ
    if any(function_of(x) is not None or words.names.changes(x) for x in (*listed, *parts)):
        return False
    glued = behind[:1].isalpha()
    return not words.is_own(name) or not all(words.known(x) or (glued and words.is_product(x)) for x in listed)


def _unit(text: str, at: int, words: Words, sure: bool) -> tuple[Fraction | None, int]:
    """How many SI units the unit at a place is, and where it ends; None if it consists of names of the system.

    A name of the system is part of a unit after /, N and kg only, 9.81 m/s^2, 3 N m, unless it is ``sure`` that units
    follow numbers; and nothing but a divisor follows such a name, 2 m g. No term of an equation is a time: 2h are
    no hours.
    """
    factor, end, below, foreign, before = Fraction(1), at, False, False, ""
    times, product = True, False
    argument = _ARGUMENT.search(text, max(0, at - 48), at) is not None
    while (match := _ONE.match(text, end)) is not None and text[match.end() : match.end() + 1] not in _GOES_ON:
        name = match["unit"]
        unit = lookup(name) or lookup(next(iter(joined(name)), ""))  # Nms is N m s, all of them SI units
        own = words.known(name) or (not before and (words.alone(name) or words.is_product(name)))
        below = below or "/" in match["by"]
        power = int(match["power"] or (match["raised"] or "1").translate(RAISED))
        if not sure and ((product and not below and power > 0) or _RATE.match(text, match.start("unit"))):
            break  # 2 m g with a mass m, 10 kg d²x/dt²
        if unit is None or unit.factor == 0 or (argument and name == "t") or (before == "" and match["by"].strip()):
            break
        if before and own and "/" not in match["by"] and before not in _JOINED and not sure:
            break
        if sure and before and match["by"].strip() == "*" and match["by"] != "*":
            break
        factor *= unit.factor ** (-power if below else power)
        times = times and not below and unit.dimension == _TIME
        foreign, before, end, product = foreign or sure or not own, name, match.end(), product or own
    return (factor, end) if foreign and (sure or not times) else (None, at)


def _decimal(value: Fraction) -> str | None:
    """A fraction as a decimal number, if it is one."""
    digits = 0
    scaled = value
    while scaled.denominator != 1 and digits < 30:
        scaled, digits = scaled * 10, digits + 1
    if scaled.denominator != 1 or abs(scaled.numerator) > 10**40:
        return None
    whole = str(scaled.numerator).rjust(digits + 1, "0")
    return whole if not digits else f"{whole[:-digits]}.{whole[-digits:]}"
