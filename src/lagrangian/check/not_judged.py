"""Formulas of an answer that were not judged, above the first line that is wrong: then this may not be the first."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.explain.row_words import is_of_numbers
from lagrangian.check.lines import lines_of
from lagrangian.check.reading import Answer, AnswerLine
from lagrangian.check.verdict import IS_MISSING, AnsweredLine, Finding, Status, Verdict
from lagrangian.errors import ParseError
from lagrangian.model import Model
from lagrangian.page.formula import Text, text
from lagrangian.read.letters import key, undotted
from lagrangian.records import dataclass

_FORMULA = re.compile(
    r"[²³½¼⅓⅙⅛^·\u0307\u0308ṙẋẏżṡ]|\\(?:d?dot|[dt]?frac|cdot)|(?<=\w)['’′](?![\w’'′])|\b(?:sin|cos|tan|sqrt)"
    r"|\*(?!\{)|(?<=[\w)])[ ][-+−][ ](?=\w)|\(\w{1,5}[-+−]\w{1,5}\)"
)
"""What no line of words has: a power, a product, a rate, a function, a sum."""
_TOKEN = re.compile(r"\\?(?P<word>[A-Za-z]{1,30}[0-9]{0,3})|[^\x00-\x7f]")
_GREEK = "alpha|beta|gamma|delta|epsilon|zeta|eta|theta|kappa|lambda|mu|nu|xi|rho|sigma|tau|phi|chi|psi|omega"
_LETTER = rf"(?:[^\W\d_a-zA-Z]|\\?(?:var)?(?:{_GREEK})|[A-Za-z])"
_PRODUCT = re.compile(rf"(?<![\w\\])(?P<one>{_LETTER})[ ]?(?P<other>{_LETTER})(?!\w)")
"""Two letters beside each other, κ θ."""
_SAID = re.compile(r":[ \t]{0,3}[$`]{0,2}(?P<value>[^:|`$\n]{1,60}?)[$`]{0,2}[ \t]{0,3}\.?[ \t]*$")
"""What stands behind words and a colon: Engine: τ."""
_GOES_ON = re.compile(r"[ \t]*+(?!\*{1,2}\w)(?:[-+−*·/=&)\]}]|\\(?:q?quad|end|left|right|cdot)\b|\\\\)")
_LISTED = re.compile(r"[ \t]{0,8}[-+*][ \t]+[^\W\d_]{2}")
"""A point of a list that begins with words."""
_ENDS_OPEN = re.compile(r"[-+−*·/=&(\[{,][ \t]*$|\\\\?[ \t]*$")
_HEADING = re.compile(r"[ \t]*\*\*[^*\n=]{1,80}\*\*[ \t]*")
_UNJUDGED = re.compile(r"'(?P<text>.{1,400})' was not judged")
_RATE = re.compile(r"_?d{1,2}ot$")
_SPELLED = re.compile(r"'(?P<own>[^']{1,20})' was read as (?P<name>\w{1,20})\.")
_NUMBER = re.compile(r"[ \t]*[-+−]?\d{1,9}(?:[.,]\d{1,9})?[ \t]*")
_PLAIN = frozenset(["body", "rigid", "particle", "spring", "damper", "force", "torque", "of", "the"])
"""Words that are in the titles of many elements."""
_FUNCTIONS = frozenset(["sin", "cos", "tan", "sqrt", "frac", "dfrac", "tfrac", "dot", "ddot", "left", "right", "cdot"])
_ARTICLES = ("a", "I", "A")
"""Letters that are words as well."""
LONGEST_PRODUCT = 5
"""The most letters of what may be several names, mgl."""
_ROUND = str.maketrans({"[": "(", "]": ")", "δ": "d"})
"""Lists in round brackets are told in square ones, and dx of virtual work as δx."""
MOST_LINES = 400
"""Of longer answers nothing is said."""


@dataclass(frozen=True)
class Unjudged:
    """The numbers of lines with formulas of which nothing was judged, and of those of which only a part was."""

    lines: tuple[int, ...] = ()
    partly: tuple[int, ...] = ()


def rows_left(model: Model, answer: Answer, verdict: Verdict, *, whole: bool) -> list[Text]:
    """What to say of what has no verdict: the values of a name that has several, and, where all was judged (``whole``)
    and something is wrong, the coordinates for which there is no equation among those for others."""
    lines = [x for x in verdict.findings if x.line.kind in ("equation", "left")]
    named = [f.coordinate for f in lines]
    told = _without_a_row(lines_of(answer), verdict)
    if not whole or verdict.status is not Status.WRONG or model.constraints or verdict.change or verdict.motion:
        return told
    lacking = [c for c in model.coordinates if c.name not in named]
    if not lines or None in named or len(named) + len(lacking) != len(model.coordinates):
        return told
    return told + [text("The equation of ", c.symbol, f"{IS_MISSING}.") for c in lacking]


def _without_a_row(lines: Sequence[AnsweredLine], verdict: Verdict) -> list[Text]:
    """What to say of the values of a name that has several, v² = … of one body and of another, of which some alone were
    judged."""
    rows = {(f.line.number, f.line.text) for f in verdict.findings}
    named: dict[str, list[AnsweredLine]] = {}
    for x in lines:
        if x.kind == "definition" and x.name:
            named.setdefault(key(x.name), []).append(x)
    told: list[Text] = []
    for own in named.values():
        judged = [x for x in own if (x.number, x.text) in rows]
        others = [x for x in own if judged and x.number not in {y.number for y in judged}]
        told += [
            text(f"'{x.text}' was not judged: {x.name} has another value, too.")
            for x in others
            if all(bounded.trigsimp(bounded.expand(x.expr - y.expr)) != 0 for y in judged)
        ]
    return told


def unjudged_above(text: str, verdict: Verdict, model: Model, answer: Answer) -> Unjudged:
    """The lines with formulas of what moves above the first wrong one that have no verdict, or one on a part of them
    alone, and that belong to none which has one."""
    first = verdict.first_wrong
    rows = text.split("\n")
    if first is None or len(rows) > MOST_LINES:
        return Unjudged()
    if answer.program:
        return Unjudged(_values_above(verdict, first, answer))
    if not _is_at(first.line.number, first.line.text, rows):
        return Unjudged()
    above = _Above(verdict, model, answer)
    lines, partly = list[int](), list[int]()
    for number, row in enumerate(rows[: first.line.number - 1], 1):
        goes_on = _GOES_ON.match(row) and not _LISTED.match(row)
        if goes_on or _HEADING.fullmatch(row) or (number > 1 and _ENDS_OPEN.search(rows[number - 2])):
            continue
        if number in above.judged:
            partly += [number] if above.lacks_a_part(number, row) else []
        elif number in above.numbers:
            lines += [number] if above.names_something(row) else []
        elif _squeezed(row) not in above.whole:
            formula = above.is_formula(row) and not above.is_used_rightly(number, row)
            lines += [number] if formula or above.says_what_is_used(number) else []
    return Unjudged(tuple(lines), tuple(partly))


def _values_above(verdict: Verdict, first: Finding, answer: Answer) -> tuple[int, ...]:
    """The lines of a program above the first wrong one that give a name a sum of what moves and have no verdict."""
    judged = {f.line.number for f in verdict.findings} | {first.line.number}
    said = [
        x
        for x in answer.lines
        if x.kind == "definition" and x.place.line is not None and not x.rhs.atoms(sp.Derivative)
    ]
    lines = {x.place.line for x in said if isinstance(x.rhs, sp.Add) and x.rhs.has(AppliedUndef)}
    return tuple(sorted(x for x in lines if x is not None and x < first.line.number and x not in judged))


class _Above:
    """What is known of the lines above the first wrong one."""

    def __init__(self, verdict: Verdict, model: Model, answer: Answer) -> None:
        self.judged = {f.line.number for f in verdict.findings if not is_of_numbers(f.line)}
        kinds = {f.line.kind for f in verdict.findings} & {"T", "V"}  # parts of an energy are added up and judged
        self.judged |= {x.place.line for x in answer.lines if x.kind in kinds and x.place.line is not None}
        self.numbers = {f.line.number for f in verdict.findings} - self.judged
        self.findings = verdict.findings
        self.whole = "".join(_squeezed(f.line.text) for f in verdict.findings)
        self.left = [m["text"] for note in verdict.notes for m in _UNJUDGED.finditer(str(note))]
        self.said = [x for x in answer.lines if x.kind == "definition" and x.name]
        self.moving = {key(c.name) for c in model.coordinates}
        self.moving |= {key(str(x.name)) for x in self.said if x.rhs.has(AppliedUndef)}
        spelled = [m for note in verdict.notes for m in _SPELLED.finditer(str(note))]
        self.moving |= {key(m["own"]) for m in spelled if key(m["name"]) in self.moving}
        self.inputs = {key(u.name) for u in model.inputs}
        self.letters = self.moving | {key(name) for name in model.symbols} | {key(str(x.name)) for x in self.said}
        self.named = {x for e in model.elements for x in _words(e.title)} - _PLAIN
        self.right = _used(self.said, [f for f in verdict.findings if f.status.right])
        first = verdict.first_wrong
        beside = [x.names for x in answer.lines if first is not None and x.place.line == first.line.number]
        self.asked = _with_names_of(self.said, set[str]().union(*beside)) - self.right

    def is_formula(self, row: str) -> bool:
        """Whether a row has a formula of what moves, or says in words and a letter what a force is."""
        tokens = set(tokens_of(row))
        if _FORMULA.search(row) is not None and tokens & self.moving:
            return True
        if any(self._is_product(m) for m in _PRODUCT.finditer(row)):
            return True
        said = _SAID.search(row)
        if said is None:
            return False
        own = set(tokens_of(said["value"]))
        if not own:
            return _NUMBER.fullmatch(said["value"]) is not None and self.names_something(row[: said.start()])
        force = bool(own & (self.moving | self.inputs)) or _FORMULA.search(said["value"]) is not None
        return force and own <= self.letters

    def _is_product(self, match: re.Match[str]) -> bool:
        one, other = (key(match[x].lstrip("\\")) for x in ("one", "other"))
        apart = match["one"] not in _ARTICLES and " " in match[0]
        return apart and {one, other} <= self.letters and bool({one, other} & self.moving) and one != other

    def names_something(self, row: str) -> bool:
        """Whether a row has a word from the title of an element."""
        return bool(set(_words(row)) & self.named)

    def says_what_is_used(self, number: int) -> bool:
        """Whether a row says what a name is that the first wrong line uses, and no right one."""
        return any(x.place.line == number and key(str(x.name)) in self.asked for x in self.said)

    def is_used_rightly(self, number: int, row: str) -> bool:
        """Whether a row is nothing but definitions that right lines use."""
        said = [x for x in self.said if x.place.line == number]
        return bool(said) and all(key(str(x.name)) in self.right for x in said) and self._rest(row, said) is None

    def lacks_a_part(self, number: int, row: str) -> bool:
        """Whether a formula of a row that was judged has no verdict."""
        written = _squeezed(row)
        found = [f.line for f in self.findings if f.line.number == number]
        open_ones = {key(str(x.name)) for x in self.said if x.place.line == number} & self.asked
        told = any(_squeezed(x) in written and self.is_formula(x) for x in self.left)
        if told or open_ones - {key(str(x.name)) for x in found}:
            return True
        said = [x for x in self.said if x.place.line == number and key(str(x.name)) in self.right]
        rest = self._rest(row, [*found, *said])
        return rest is not None and "=" not in rest

    def _rest(self, row: str, said: Sequence[object]) -> str | None:
        """What a row has besides some statements, if it has a formula; None if it has none, or not all of them."""
        rest = " ".join(row.split())
        for x in said:
            text = " ".join(str(getattr(x, "text", "")).split())
            if text not in rest:
                return None
            rest = rest.replace(text, " ; ")
        return rest if _FORMULA.search(rest) is not None and self.is_formula(rest) else None


def _used(said: Sequence[AnswerLine], findings: Sequence[Finding]) -> set[str]:
    """The keys of the names that some lines use, themselves or by others."""
    return _with_names_of(said, set[str]().union(*(f.line.names for f in findings if f.line.kind != "definition")))


def _with_names_of(said: Sequence[AnswerLine], used: set[str]) -> set[str]:
    """The names that are used, with those that stand in their values."""
    for _ in said:
        more = set[str]().union(*(x.names for x in said if key(str(x.name)) in used))
        if more <= used:
            break
        used |= more
    return used


def tokens_of(row: str) -> Iterator[str]:
    """The keys of what may be names in a row, without dots."""
    for match in _TOKEN.finditer(row):
        whole = match["word"] or match[0]
        if whole in _FUNCTIONS:
            continue
        alone = match[0].startswith("\\") or len(whole) > LONGEST_PRODUCT
        for x in (whole, "" if alone else whole[:1], _RATE.sub("", whole)):
            yield from [key(undotted(x)[0])] if x else ()


def _words(text: str) -> list[str]:
    """The words of a text, in small letters."""
    return [x.lower() for x in re.findall(r"[^\W\d_]{2,30}", text)]


def _squeezed(row: str) -> str:
    return "".join(row.split()).translate(_ROUND)


def _is_at(number: int, written: str, rows: list[str]) -> bool:
    """Whether a statement begins in the line of which it has the number."""
    begins = _squeezed(written.split("\n")[0])[:8]
    return 0 < number <= len(rows) and begins in _squeezed(rows[number - 1])


def hidden_result(answer: Answer, verdict: Verdict) -> ParseError | None:
    """The error of a sentence behind all right energies and forces that was not read, where no equation of motion was
    judged: it may be the result."""
    if any(f.line.kind in ("equation", "left") for f in verdict.findings):
        return None
    last = max((f.line.number for f in verdict.findings), default=0)
    return next((e for e in answer.sentences if e.place is not None and (e.place.line or 0) > last), None)
