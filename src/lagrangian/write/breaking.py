"""Breaks a formula that is longer than its line.

It is broken first at relations, then before + and − outside all parentheses, then inside parentheses, where lines are
indented further. A product stays on one line if possible: a factor is separated from its parenthesis or its
acceleration only if no other break helps. If a product has to be broken, the next line begins with a dot for "times". A
short parenthesis, such as (x₁ − x₂), is broken last of all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise

from lagrangian.records import dataclass, field
from lagrangian.write.expression_tree import (
    GLUED,
    LOOSE,
    Addition,
    Apply,
    Cases,
    Fence,
    Glyph,
    Letter,
    Mark,
    Number,
    Power,
    Quotient,
    Radical,
    Relation,
    Times,
    Word,
    fenced,
    in_parentheses,
    tokens,
)

SMALL = 20
"""A parenthesis of at most this many columns is short; on a narrow line, one of at most a third of the line."""
WHOLE = 300
"""The level of a line break inside a short parenthesis."""
STEP = 2
"""The indentation in columns for each surrounding pair of parentheses."""

Measure = Callable[[Glyph], int]


@dataclass
class BrokenRow:
    """A line of a formula; ``depth`` is the number of parentheses open at its beginning."""

    tokens: list[Glyph] = field(default_factory=list)
    depth: int = 0


def break_lines(
    pieces: Sequence[Glyph], width: int, measure: Measure, *, first: int | None = None, flat: bool = True
) -> list[BrokenRow]:
    """Break tokens into lines of at most ``width`` columns (at most ``first`` for the first line).

    ``flat`` says that a fraction is written on one line, a/b, instead of a over b. A line is longer than ``width`` only
    if it is a single symbol or number.
    """
    made = _Breaker(width, width if first is None else first, measure, flat)
    made.put(made.guarded(pieces))
    return made.rows


class _Breaker:
    def __init__(self, width: int, first: int, measure: Measure, flat: bool) -> None:
        self.width, self.measure, self.flat = width, measure, flat
        self.rows = [BrokenRow()]
        self.left = first
        self.whole = True
        self._sizes: dict[int, tuple[Glyph, int]] = {}

    def put(self, pieces: list[Glyph]) -> None:
        """Add tokens to the current line and, if they do not fit, to further lines."""
        if self._size(pieces) <= self.left:
            self._add(pieces)
            return
        segments = self._segments(pieces)
        if len(segments) == 1 or (segments[1][0].level or 0) >= LOOSE:
            tight = len(segments) == 1 or any(self._size(s) > self.width - STEP * (s[0].depth + 1) for s in segments)
            opened = self._opened(pieces) if tight else None
            if opened is not None:
                self.put(opened)
                return
        if len(segments) == 1:
            self._add(pieces)
            return
        start = len(self.rows)
        self.put(segments[0])
        self.whole = len(self.rows) == start
        for segment in segments[1:]:
            product = segment[0].role == "gap"
            if (not product and not self.whole) or self._size(segment) > self.left:
                self._next_line(segment[0])
                if product:  # after the dot no other break is allowed
                    segment = [Glyph("leaf", Word("·")), replace(segment[0], level=None), *segment[1:]]
            start = len(self.rows)
            self.put(segment)
            self.whole = len(self.rows) == start

    def _next_line(self, piece: Glyph) -> None:
        depth = piece.depth + (piece.role == "gap")
        self.rows.append(BrokenRow(depth=depth))
        self.left = self.width - STEP * depth
        self.whole = True

    def _add(self, pieces: list[Glyph]) -> None:
        self.rows[-1].tokens += pieces
        self.left -= self._size(pieces)

    def _size(self, pieces: Sequence[Glyph]) -> int:
        return sum(self._columns(p) for p in pieces)

    def _columns(self, piece: Glyph) -> int:
        if id(piece) not in self._sizes:
            self._sizes[id(piece)] = (piece, self.measure(piece))
        return self._sizes[id(piece)][1]

    def _segments(self, pieces: list[Glyph]) -> list[list[Glyph]]:
        """The pieces after the best possible breaks: in a product before its functions if that is enough, otherwise in
        its sums."""
        levels = [(p.level, p.depth, p.role) for p in pieces[1:] if p.level is not None]
        if not levels:
            return [pieces]
        best, depth, _ = min(levels)
        gaps = [d for _, d, role in levels if role == "gap"]
        if gaps and min(gaps) < depth and best < LOOSE:
            cut = _cut(pieces, LOOSE + min(gaps))
            room = self.width - STEP * (min(gaps) + 1) - 2
            if len(cut) > 1 and self._size(cut[0]) <= self.left and all(self._size(s) <= room for s in cut[1:]):
                return cut
        return _cut(pieces, best)

    def _opened(self, pieces: list[Glyph]) -> list[Glyph] | None:
        """The pieces with the longest one that has an inside taken apart; None if there is no long one."""
        for i in sorted(range(len(pieces)), key=lambda i: -self._columns(pieces[i])):
            if 2 * self._columns(pieces[i]) <= self.width:
                return None
            parts = _parts(pieces[i], self.flat)
            if parts is not None:
                return [*pieces[:i], *self.guarded(parts), *pieces[i + 1 :]]
        return None

    def guarded(self, pieces: Sequence[Glyph]) -> list[Glyph]:
        """The pieces, in which breaks inside short parentheses have the worst level."""
        made, open_at = list(pieces), []
        short = max(SMALL // 2, min(SMALL, self.width // 3))
        for i, piece in enumerate(made):
            if piece.role == "open":
                open_at.append(i)
            elif piece.role == "close" and open_at:
                inside = range(open_at.pop() + 1, i)
                if sum(self._columns(made[k]) for k in inside) + 2 <= short:
                    for k in inside:
                        if made[k].level is not None:
                            made[k] = replace(made[k], level=WHOLE + made[k].depth)
        return made


def _cut(pieces: list[Glyph], level: int) -> list[list[Glyph]]:
    starts = [0, *(i for i, p in enumerate(pieces) if i and p.level == level), len(pieces)]
    return [pieces[a:b] for a, b in pairwise(starts)]


def _parts(piece: Glyph, flat: bool) -> list[Glyph] | None:
    """The tokens of a long fraction, root or function, so that it can be broken inside; None for anything else."""
    math, depth = piece.math, piece.depth
    if piece.role != "leaf":
        return None
    match math:
        case Quotient(Number(), Number()):
            return None
        case Quotient(over, under) if flat or over == Number("1"):
            plain = isinstance(under, (Letter, Number, Word, Mark, Power, Radical, Fence))
            slash = Glyph("sign", text="/", level=LOOSE + depth, depth=depth + 1)
            bottom = under if plain else Fence(under)
            return [*tokens(fenced(over, (Addition, Quotient, Relation)), depth), slash, *tokens(bottom, depth)]
        case Quotient(over, under):
            factors = over.factors if isinstance(over, Times) else (over,)
            inverse = Glyph("leaf", Quotient(Number("1"), under), depth=depth)
            return [inverse, Glyph("gap", level=GLUED + depth, depth=depth), *tokens(Times(factors), depth)]
        case Radical(of):
            return [Glyph("leaf", Word("√"), depth=depth), *tokens(Fence(of), depth)]
        case Apply(name, args, power):
            raised = [Glyph("exponent", power)] if power is not None else []
            inner = [t for i, a in enumerate(args) for t in ((Glyph("sign", text=","),) if i else ()) + _in(a, depth)]
            if len(args) == 1 and in_parentheses(args[0]):
                inner = list(_in(args[0].of, depth))  # type: ignore[union-attr]
            fence = (Glyph("open", text="("), Glyph("close", text=")"))
            return [Glyph("leaf", Word(name), depth=depth), *raised, fence[0], *inner, fence[1]]
        case Mark(sign, of):
            return [Glyph("leaf", Word(sign), depth=depth), *tokens(of if in_parentheses(of) else Fence(of), depth)]
        case Power(base, exponent) if isinstance(base, (Radical, Apply)):
            return [*tokens(Fence(base), depth), Glyph("exponent", exponent)]
        case Cases(branches) if flat:
            made = [Glyph("open", text="{")]
            for i, (value, condition) in enumerate(branches):
                made += [Glyph("sign", text=";", level=1 + depth, depth=depth + 1)] if i else []
                made += tokens(value, depth + 1)
                made += [Glyph("leaf", Word(" otherwise" if condition is None else " if "))]
                made += [] if condition is None else tokens(condition, depth + 1)
            return [*made, Glyph("close", text="}")]
        case _:
            return None


def _in(math: object, depth: int) -> tuple[Glyph, ...]:
    return tuple(tokens(math, depth + 1))  # type: ignore[arg-type]
