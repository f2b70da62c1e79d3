"""Formulas in the words of a description: where they stand, what they claim, and whether that holds.

"pole, m*(2*l)^2/12 about its own centre of mass" claims a value of its letter; "above sqrt(g/R) the bead leaves" states
a condition and "m*R^2/2 where it is solid" one that may not be met, so neither claims anything.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

import sympy as sp
from sympy.core.alphabets import greeks

from lagrangian import bounded
from lagrangian.errors import Error, ModelError
from lagrangian.model import Model, Parameter
from lagrangian.model.names import FUNCTIONS
from lagrangian.page.formula import Left
from lagrangian.quantities.quantity import parse_quantity
from lagrangian.read.expression import parse_expression
from lagrangian.records import dataclass
from lagrangian.values.dimensions import Mismatch, check_dimensions

GREEK = frozenset([*greeks, *(name.capitalize() for name in greeks)])

TOLERANCE = 0.01
"""A description may round: a value and its formula differ by no more than this, relative to them."""

MAX_WORDS = 400
"""Formulas are looked for in a description with at most so many characters."""

_TOKEN = re.compile(
    r"(?P<name>[^\W\d]\w*)|(?P<number>\d+(?:\.\d+)?)|(?P<sign>[*/^+()-])|(?P<blank> +)|(?P<other>.)", re.S
)
_BEFORE = re.compile(r"\b(?:above|below|beyond|than|least|most|where|if|when|while|unless|until|for)\b", re.IGNORECASE)
_AFTER = re.compile(r" *(?:where|if|when|while|unless|until|for|of an?)\b", re.IGNORECASE)
_LIKEWISE = re.compile(r"\b(?:likewise|ditto|the same|as well|equally)\b", re.IGNORECASE)
_QUANTITY = re.compile(r"(?<![\w.*/^])\d[\d.]* ?[^\W\d_][\w*/^²³·]*")


@dataclass(frozen=True)
class Spelled:
    """A formula or a letter in words, from ``start`` to ``end``; ``formula`` unless it is one bare letter."""

    start: int
    end: int
    expression: sp.Expr
    formula: bool


@dataclass(frozen=True)
class Claim:
    """What a description says of values: ``left`` = ``right``, which ``loose`` words only say of some systems."""

    left: sp.Expr
    right: sp.Expr
    loose: bool = False

    def holds(self, values: Mapping[Any, float]) -> bool | None:
        """Whether it holds, about, for these values; None if one of its letters has none."""
        numbers = [number(side, values) for side in (self.left, self.right)]
        if None in numbers:
            return None
        one, other = (float(n or 0) for n in numbers)
        return abs(one - other) <= TOLERANCE * max(abs(one), abs(other))


def number(expr: sp.Expr, values: Mapping[Any, float]) -> float | None:
    """The value of an expression, or None if one of its letters has none."""
    if not bounded.letters(expr) <= set(values):
        return None
    found: sp.Expr = sp.N(expr.xreplace({s: sp.Float(values[s]) for s in bounded.symbols(expr)}))
    return float(found) if found.is_real and found.is_finite else None


def is_letter(word: str) -> bool:
    """Whether a word is a letter: one character, a Greek name, or one with an index; a, A and I are words."""
    return word not in ("a", "A", "I") and (len(word) == 1 or not word.isalpha() or word in GREEK)


def parts_of(description: str) -> list[str]:
    """The parts of a description, each with the mark before it."""
    return re.split(r"(?=[,;:])", description)


def formulas(model: Model, words: str) -> list[Spelled]:
    """The formulas and letters of a model in words, in order; what the reader of expressions refuses is no formula."""
    if len(words) > MAX_WORDS:
        return []
    scope = {x.name: x.symbol for x in (*model.coordinates, *model.parameters, *model.inputs, *model.definitions)}
    tokens = list(_TOKEN.finditer(words))
    found: list[Spelled] = []
    k = 0
    while k < len(tokens):
        last = k if tokens[k]["blank"] else _expression(tokens, k, scope)
        made = None if last == k else _read(words, tokens[k:last], scope)
        if made is not None:
            found.append(made)
        k = max(last, k + 1)
    return found


def _read(words: str, tokens: Sequence[re.Match[str]], scope: Mapping[str, sp.Basic]) -> Spelled | None:
    start, end = tokens[0].start(), tokens[-1].end()
    names = [t[0] for t in tokens if t["name"]]
    bare = len(tokens) == 1
    if not any(n in scope for n in names):
        return None
    if bare and (not is_letter(names[0]) or _in_a_unit(words, start, end)):
        return None
    if all(t["name"] or t[0] in "- " for t in tokens) and not bare and " " not in words[start:end]:
        return None  # the x-y plane
    try:
        return Spelled(start, end, parse_expression(words[start:end], scope), not bare)
    except Error:
        return None


def _in_a_unit(words: str, start: int, end: int) -> bool:
    """Whether a letter is one of a unit, as in 2 m or N/m."""
    return bool(re.search(r"(?:[\d½¼¾] ?|[*/^·])$", words[:start]) or re.match(r"[*/^·]", words[end:]))


def _expression(tokens: Sequence[re.Match[str]], k: int, scope: Mapping[str, sp.Basic]) -> int:
    """The end of the longest formula that begins at a token: known names and numbers, with signs between them."""
    depth, best, wanted = 0, k, True
    j = k
    while j < len(tokens):
        token = tokens[j]
        if token["blank"]:
            j += 1
            continue
        if wanted and token["name"] in FUNCTIONS and j + 1 < len(tokens) and tokens[j + 1][0] == "(":
            j += 1
            continue
        if wanted and token[0] == "(":
            depth += 1
        elif wanted and (token["number"] or token["name"] in scope):
            wanted = False
        elif not wanted and token[0] == ")" and depth:
            depth -= 1
        elif not wanted and token["sign"] and token[0] not in "()":
            wanted = True
        else:
            break
        j += 1
        if not wanted and depth == 0:
            best = j
    return best


def typeset(model: Model, words: str) -> list[str | Left]:
    """The words with their formulas and letters as expressions, which are set as everywhere on a sheet."""
    parts: list[str | Left] = []
    done = 0
    for one in formulas(model, words):
        parts += [words[done : one.start], one.expression]
        done = one.end
    return [p for p in (*parts, words[done:]) if p != ""]


def claims(model: Model, parameter: Parameter | None, part: str) -> Iterator[Claim]:
    """What one part of a description, that of a parameter or of something else, says of values."""
    found = formulas(model, part)
    related: set[int] = set()
    for k, (one, other) in enumerate(pairwise(found)):
        if re.fullmatch(r" *[=<>≤≥≈] *", between := part[one.end : other.start]):
            related |= {k, k + 1}
            if "=" in between:
                yield Claim(one.expression, other.expression, _conditional(part, one, other))
    for k, one in enumerate(found):
        before = part[: one.start].rstrip()
        if parameter is None or k in related or not one.formula or before.endswith(("<", ">", "≤", "≥")):
            continue
        if (before.endswith("=") and before[:-1].strip(" ,;:")) or part[one.end :].lstrip()[:1] in tuple("=<>≤≥"):
            continue  # of something that is no letter, as y in y = c*x^2
        if _comparable(model, parameter, one.expression):
            yield Claim(parameter.symbol, one.expression, _conditional(part, one, one))


def _conditional(part: str, first: Spelled, last: Spelled) -> bool:
    return bool(_BEFORE.search(part[: first.start]) or _AFTER.match(part[last.end :]))


def _comparable(model: Model, parameter: Parameter, expr: sp.Expr) -> bool:
    """Whether an expression may be the value of a parameter: it has the same unit, as far as units are given."""
    try:
        dims = check_dimensions(model)
        if dims is None or not parameter.unit:
            return True
        own, found = dims.of(parameter.symbol), dims.of(expr)
        if own is not None and found is not None:
            dims.equal(found, own)
    except (Mismatch, ModelError):
        return False
    return True


def relations(model: Model) -> dict[Any, sp.Expr]:
    """The values that follow from others, as the descriptions of a model say and its values bear out, in order."""
    values = values_of(model)
    found: dict[Any, sp.Expr] = {}
    for p in model.parameters:
        for part in parts_of(p.description):
            for claim in claims(model, p, part):
                sides = ((claim.left, claim.right), (claim.right, claim.left))
                target = next(
                    ((a, b) for a, b in sides if a in values and a not in found and a not in b.free_symbols), None
                )
                if target is None or not claim.holds(values) or _comes_back(found, *target):
                    continue
                found[target[0]] = target[1]
    ordered: dict[Any, sp.Expr] = {}
    while len(ordered) < len(found):
        ready = [s for s, e in found.items() if s not in ordered and not e.free_symbols & (set(found) - set(ordered))]
        ordered.update({s: found[s] for s in ready})
    return ordered


def _comes_back(found: Mapping[Any, sp.Expr], symbol: Any, expr: sp.Expr) -> bool:
    """Whether an expression has a letter that itself follows from the symbol."""
    open_, seen = list(expr.free_symbols), set[Any]()
    while open_:
        one = open_.pop()
        if one == symbol:
            return True
        if one not in seen:
            seen.add(one)
            open_ += list(found[one].free_symbols) if one in found else []
    return False


def values_of(model: Model) -> dict[Any, float]:
    """The values of the parameters by their symbols."""
    return {p.symbol: p.value for p in model.parameters if p.value is not None}


def still_true(model: Model, parameter: Parameter | None, description: str, values: Mapping[Any, float]) -> str:
    """A description without the parts that other values of the parameters make untrue."""
    old = values_of(model)
    changed = [v for s, v in old.items() if values.get(s) != v]

    def untrue(part: str) -> bool:
        for claim in claims(model, parameter, part):
            before, now = claim.holds(old), claim.holds(values)
            if now is False and (before or not claim.loose):
                return True
        if parameter is not None and _LIKEWISE.search(part) and _follows_a_claim(model, parameter):
            return True
        if "=" in part and _a_number(model, part):
            return True
        return any(_is_quantity(q, changed) for q in _QUANTITY.findall(part))

    return "".join(p for p in parts_of(description) if not changed or not untrue(p)).lstrip(",;: ")


def _a_number(model: Model, part: str) -> bool:
    """Whether an equality says a number, other than 0, of something: R = 2, or the length of "length = 2 m"."""
    for side in re.split(r"[=<>≤≥≈]", part)[1:]:
        if re.match(r" *[-−]?[\d.]*[1-9]", side) and not any(f.formula for f in formulas(model, side)):
            return True
    return False


def _is_quantity(words: str, changed: Sequence[float]) -> bool:
    """Whether a quantity such as 2 m is the old value of a letter that has another value now."""
    try:
        value = parse_quantity(words).value
    except Error:
        return False
    return any(abs(value - old) <= 1e-9 * abs(old) for old in changed)


def _follows_a_claim(model: Model, parameter: Parameter) -> bool:
    """Whether the description before one with "likewise" claims a value."""
    listed = list(model.parameters)
    for before in reversed(listed[: listed.index(parameter)]):
        if any([*claims(model, before, part)] for part in parts_of(before.description)):
            return True
        if not _LIKEWISE.search(before.description):
            return False
    return False
