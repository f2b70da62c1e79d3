"""Finds the names that programs give to expressions that are zero: e1 = m*x'' + k*x - F, res(2) = J*phi'' - M.

return e1, e2        solve([e1, e2], …)        Eq(e1, 0)        # residuals, all zero

Nothing else may use such a name: r1 = e + a cos θ is a distance where another line has r1^2.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from itertools import islice

from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.programs.session_lists import entries_in
from lagrangian.check.reading.programs.sessions import MOST, carries, closes, pieces
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.records import dataclass

_COMMENT = re.compile(r"(?:[#%]|//(?=\s))[^\n]*+")
_CONTINUED = re.compile(r"(?:\.{3}|\\)[ \t]*+\n|(?<=\S)\n(?=[ \t]*+[-+*/=])")
"""The end of a line on which a statement is not complete."""
_LABEL = re.compile(rf"(?P<name>{IDENT})(?:[(\[]\d{{1,2}}[)\]])?[ \t]*+(?::?=)(?!=)[ \t]*+")
_WORD = re.compile(r"[^\W\d]\w*+")
_STEM = re.compile(r"(?:_?\d{1,2}|_\w{1,12})\Z")
_OPERATES = re.compile(r"[*/^+'’.·⋅×−-]")
_OPERATOR = re.compile(r"[*/^+·⋅×−-]")
_NUMBER = re.compile(r"(?<![\w.])\d++\Z")
_ENDS = re.compile(r"\.(?:\s|\Z)")
_CALLS = re.compile(rf"({IDENT})\(")
_FILLED = re.compile(r"[^=\n]{1,40}=[ \t]*+(?:(?:\w{1,8}\.)?zeros\([^=\n]*+|\[(?:0(?:\.0*)?)?\](?:[ \t]*+\*[^=\n]*+)?)")
"""A list that is made before its entries: res = zeros(2, 1)."""
_HEADER = re.compile(rf"(?:function|def)[ \t](?:[ \t]*+(?P<out>{IDENT})[ \t]*+=)?")
_ZERO = re.compile(r"(?<!\w)(?:[a-z]{0,4}solve\w{0,12}\(|root\(|Eq\()|={1,2}[ \t]*+0(?![\d.])", re.IGNORECASE)
"""What sets something to zero where it is used."""
_LISTED = re.compile(r"[ \t]*+(?:\w{1,8}\.)?(?:(?:array|Matrix)[ \t]*+\(\s*+)?\[")
_RETURNS = re.compile(r"return\b")
_RESIDUALS = re.compile(r"(?<![^\W_])residu(?:al|um|en)", re.IGNORECASE)
_SAID = re.compile(
    r"\b(?:all|both|each|set|equals?|are|is|be|to)[ \t]{1,3}(?:=[ \t]{0,3})?(?:zero\b|0(?![\d.]))|\bvanish",
    re.IGNORECASE,
)
"""That something is zero, in words."""
CALLED = re.compile(
    r"(?:(?:lag(?:range)?|lhs|my)_?)?(?:(?:eqn?s?|eom|ode|dgl|gl|bwg|equation|residual|res|expr)_?\w{0,12}|e_?\d)",
    re.IGNORECASE,
)
"""What people call an equation in programs: eq1 := m*x'' = F, eom_x = m*x'' - F."""
_PURE = re.compile(r"[\s()\[\]{},;.:=0]*+")
_WORDS = frozenset(
    ["return", "Matrix", "array", "np", "sp", "sympy", "numpy", "Eq", "simplify", "print", "disp", "list"]
    + ["with", "where", "and", "both", "so", "that"]
)
MOST_NAMES, DEEPEST = 40, 3
"""The most names that are looked at, and how many lists may hold each other: eqs = [e1, e2], all = [eqs, more]."""


@dataclass(frozen=True)
class Residuals:
    """The names of expressions that are zero, and the answer without the statements that only list these names."""

    written: TracedText
    names: frozenset[str]


def residuals(written: TracedText, taken: Callable[[str], bool], moves: Callable[[str], bool]) -> Residuals:
    """Return the names of an answer's expressions that are zero; ``taken`` says whether a name belongs to the system,
    ``moves`` whether it changes with time."""
    found = _Found(written.text, taken, moves)
    names = frozenset(found.names())
    return Residuals(written.edited(found.uses(names)), names)


class _Found:
    """The statements of an answer, without their comments."""

    def __init__(self, text: str, taken: Callable[[str], bool], moves: Callable[[str], bool]) -> None:
        self.bare = _CONTINUED.sub(_blank, _COMMENT.sub(_blank, text))
        self.sure, self.said = (x.search(text) is not None for x in (_RESIDUALS, _SAID))
        self.taken, self.moves = taken, moves
        self.pieces = [(x.start, x.end) for x in pieces(self.bare)]
        self.labels: dict[str, list[tuple[int, int]]] = {}
        self.computed: set[str] = set()
        """The names of accelerations that statements compute."""
        self.families: dict[str, list[str]] = {}
        for start, end in self.pieces:
            label = _LABEL.match(self.bare, start, end)
            if label is None or "=" in (value := self.bare[label.end() : end]):
                continue
            if self._order(name := label["name"]):
                self.computed |= {name} if _OPERATOR.search(value) else set()
            elif not taken(name) and _is_sum(value):
                self.labels.setdefault(name, []).append((label.end(), end))
        self._free: dict[str, bool] = {}
        self._moving: dict[tuple[int, int], bool] = {}
        for name in islice(self.labels, MOST_NAMES):
            counted = _STEM.sub("", name)
            self.families.setdefault(counted if counted != name or CALLED.fullmatch(name) else "", []).append(name)

    def names(self) -> Iterator[str]:
        """The names of expressions that are zero: those of one family, in which an acceleration stands, where they say
        so, something sets them to zero, or they are all that is said of accelerations."""
        for called, family in self.families.items():
            free = [x for x in family if self._is_free(x)]
            free = free if called else [x for x in free if self._moves(x)]
            if not any(map(self._moves, free)):
                continue
            several = len(free) > 1 and (self.said or any(self._meets(x, _RETURNS) for x in free))
            sure = self.sure or any(CALLED.fullmatch(x) or self._meets(x, _ZERO) for x in free)
            if sure or (several and not self._others(free)):
                yield from free

    def uses(self, names: frozenset[str]) -> Iterator[Edit]:
        """The edits that leave out what only lists names of expressions that are zero, and the word in front of such
        expressions that a function returns."""
        for start, end in self.pieces:
            piece = self.bare[start:end]
            listed = _WORD.findall(piece)
            target = _LABEL.match(piece)
            known = {*names, *_WORDS} | ({target["name"]} if target is not None else set())
            pure = all(x in known for x in listed) and _PURE.fullmatch(_WORD.sub("", piece))
            if any(x in names for x in listed) and (pure or _FILLED.fullmatch(piece)):
                yield start, end, ""
            elif (returned := _RETURNS.match(piece)) is not None and self._returns_sums(start + returned.end(), end):
                yield start, start + returned.end(), ""

    def _returns_sums(self, start: int, end: int) -> bool:
        """Whether a list of sums is returned in which accelerations stand that nothing computes."""
        opened = _LISTED.match(self.bare, start, end)
        if opened is None or (closed := closes(self.bare, opened.end() - 1)) < 0:
            return False
        entries = [self.bare[a:b] for a, b in entries_in(self.bare, opened.end(), closed)]
        several = len(entries) > 1 or self.sure
        return several and all(map(_is_sum, entries)) and self._accelerates(start, end)

    def _order(self, name: str) -> bool:
        """Whether a name is an acceleration in letters."""
        return any(order == 2 and self.moves(stem) for order, stem in spelled_rates(name))

    def _accelerates(self, start: int, end: int) -> bool:
        """Whether accelerations that nothing computes stand in a part of the text."""
        if (start, end) not in self._moving:
            value = self.bare[start:end]
            named = [x for x in _WORD.findall(value) if self._order(x)]
            found = any(x not in self.computed for x in named) or (not named and carries(value))
            self._moving[start, end] = found
        return self._moving[start, end]

    def _moves(self, name: str) -> bool:
        return any(self._accelerates(*at) for at in self.labels[name])

    def _others(self, family: Sequence[str]) -> bool:
        """Whether another statement holds accelerations beside an equals sign, and no other uses its name."""
        own = {end for x in family for _, end in self.labels[x]}
        for start, end in self.pieces:
            label = _LABEL.match(self.bare, start, end)
            if end in own or "=" not in self.bare[start:end] or not _OPERATOR.search(self.bare[start:end]):
                continue
            computes = label is not None and label["name"] in self.computed
            if not computes and not self._accelerates(start, end):
                continue
            if label is None or label["name"] not in self.labels or self._is_free(label["name"]):
                return True
        return False

    def _uses_of(self, name: str) -> Iterator[tuple[str, int, int]]:
        """The statements that use a name, without those that it only labels, and its place in them."""
        own = re.compile(rf"(?<![\w.]){re.escape(name)}(?!\w)(?:[(\[]\d{{1,2}}[)\]])?")
        labelled = {end for _, end in self.labels.get(name, ())}
        for start, end in self.pieces:
            piece = self.bare[start:end]
            for k, match in enumerate(islice(own.finditer(piece), MOST)):
                if k or match.start() or end not in labelled:
                    yield piece, *match.span()

    def _is_free(self, name: str) -> bool:
        """Whether all statements that use a name have it as an entry alone, and lists of it are used so, too."""
        if name not in self._free:
            self._free[name] = False  # a list that holds itself
            self._free[name] = not any(self._needs(name, *use) for use in self._uses_of(name))
        return self._free[name]

    def _needs(self, name: str, piece: str, start: int, end: int) -> bool:
        """Whether a statement needs the value of a name at a place."""
        if _FILLED.fullmatch(piece) or _HEADER.match(piece):
            return False
        if self._is_factor(piece, start, end):
            return True
        target = _LABEL.match(piece)
        if target is None or target["name"] == name or _CALLS.search(piece[:start]):
            return False
        return not self._is_free(target["name"])

    def _is_factor(self, piece: str, start: int, end: int) -> bool:
        """Whether what stands at a place is a term, a factor or an argument of a function of mathematics."""
        before, behind = piece[:start].rstrip(), piece[end:].lstrip(" \t")
        if _OPERATOR.match(before[-1:]) or (_OPERATES.match(behind) and not _ENDS.match(behind)):
            return True
        words = [*_WORD.findall(before)[-1:], *_WORD.findall(behind[:40])[:1]]
        beside = [x for x in words if before.endswith(x) or behind.startswith(x)]
        called = _CALLS.findall(before)
        return (
            _NUMBER.search(before) is not None
            or any(map(self.taken, beside))
            or any(function_of(x) for x in [*beside, *called])
        )

    def _meets(self, name: str, form: re.Pattern[str], depth: int = DEEPEST) -> bool:
        """Whether a statement that uses a name, or a list of it, has this form; for what is returned, also a header."""
        for piece, start, _ in self._uses_of(name):
            header = _HEADER.match(piece)
            if header is not None:
                if form is _RETURNS and header["out"] == name:
                    return True
                continue
            if form.search(piece):
                return True
            target = _LABEL.match(piece)
            if target is not None and start and depth and self._meets(target["name"], form, depth - 1):
                return True
        return False


def _blank(match: re.Match[str]) -> str:
    return " " * len(match.group())


def _is_sum(value: str) -> bool:
    """Whether terms stand beside each other in an expression, outside of brackets but such around the whole."""
    value = value.strip().rstrip(",;")
    while value.startswith("(") and closes(value, 0) == len(value) - 1:
        value = value[1:-1].strip()
    depth = 0
    for at, c in enumerate(value):
        depth += (c in "([{") - (c in ")]}")
        if at and depth == 0 and c in "+-" and value[at - 1] not in "*/^(eE":
            return True
    return False
