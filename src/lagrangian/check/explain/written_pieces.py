"""What the terms of an answer, as they are written, say against an explanation of them.

Who writes ½ m v² has neither left out ½mv², nor its ½, nor counted it half: what is missing is something else that
happens to be as large. And who writes ½ (m r²) ω² has not left out the ½ of ½ J ω² with J = ½ m r².
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
import sympy as sp

from lagrangian.check.explain.candidates import ingredients_of
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.meant import kinds_of
from lagrangian.check.explain.search import Explanation, Told, without_constant
from lagrangian.check.explain.undone import Undone
from lagrangian.check.rows import same_values
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import RigidBody, time
from lagrangian.records import dataclass

Factors: TypeAlias = tuple[sp.Expr, ...]
NEAR = 1e-9
"""The relative difference of values that is rounding."""
FORGOTTEN = (Fraction(-1), Fraction(0))
TWICE = (Fraction(1), Fraction(2))
MULTIPLES = {
    "half_forgotten": TWICE,
    "spring_half_forgotten": TWICE,
    "element_twice": TWICE,
    "translation_forgotten": FORGOTTEN,
    "rotation_forgotten": FORGOTTEN,
    "element_forgotten": FORGOTTEN,
}
"""Misconceptions by which a piece counts another number of times: the multiple of the piece that is added, and how
often it counts then."""
HALVES = frozenset(["half_forgotten", "spring_half_forgotten"])
"""Those that lose a ½; a piece that stands with its ½ has it, however often it counts."""
HALF = sp.Rational(1, 2)
LEDGERS = {"T": "kinetic", "V": "potential"}


@dataclass(frozen=True, eq=False)
class _Piece:
    """A right piece of T* or V, its values, the letters with which it is written, and the body of which it is ½Jω²."""

    ledger: str
    values: Array
    letters: frozenset[Any]
    turning: RigidBody | None = None


@dataclass(frozen=True, eq=False)
class _Line:
    """The kind of a line, and the ways to read each of its terms: what it adds, with its factors."""

    kind: str
    terms: tuple[tuple[tuple[Array, Factors], ...], ...]

    def like(self, values: Array) -> list[Factors]:
        """The terms that have some values, each once."""
        size = NEAR * np.abs(values).max()
        return [f for term in self.terms for x, f in term if np.abs(x - values).max() <= size]


class WrittenPieces:
    """The terms of an answer's energies and equations as they are written, to hold explanations against."""

    def __init__(self, pool: Pool, lines: Sequence[AnsweredLine]) -> None:
        self.pool, self.truth = pool, pool.truth
        self._written = lines
        self._known: dict[tuple[int, Fraction], bool] = {}

    @cached_property
    def lines(self) -> list[_Line]:
        """The lines that can be compared."""
        return [x for line in self._written if (x := self._line(line)) is not None]

    def allow(self, found: Sequence[Explanation]) -> list[Explanation]:
        """The explanations that nothing contradicts which is written."""
        return [e for e in found if not any(self.contradict(t) for t in e.told)]

    def contradict(self, told: Told) -> bool:
        """Whether what a mistake says of a piece of an energy is not so in a term that is written."""
        key = id(told.mistake), told.times
        if key not in self._known:
            self._known[key] = self._contradict(told)
        return self._known[key]

    def _contradict(self, told: Told) -> bool:
        if (said := self._said(told)) is None or not self.lines:
            return False
        number, times = said
        place = self.pool.places[id(told.mistake)]
        for ledger in LEDGERS:
            whole = (self.pool.T if ledger == "T" else self.pool.V)[place] / float(number)
            whole = without_constant(whole) if ledger == "V" else whole
            if np.abs(whole).max() <= NEAR:
                continue
            pieces = self._of(ledger, whole, _turns(told))
            lines = [x for x in self.lines if x.kind in (ledger, "L")]
            wrong = told.mistake.wrong
            half = wrong is not None and wrong.name in HALVES
            if any(self._stands(line, p, pieces, times, half=half) for line in lines for p in pieces):
                return True
        rows = self.pool.W[place] / float(number)
        return bool(np.abs(self.pool.T[place]).max() > NEAR) and any(self._moves(x, times) for x in rows)

    @staticmethod
    def _said(told: Told) -> tuple[Fraction, Fraction] | None:
        """By which multiple of a piece an explanation changes it, and how often that counts then; None for another."""
        change, wrong = told.mistake.change, told.mistake.wrong
        if wrong is not None:
            return MULTIPLES.get(wrong.name)
        if change is None or change.kind != "part" or change.site.single or told.times in (-2, 0):
            return None
        return Fraction(1), 1 + told.times

    # -- what is right -----------------------------------------------------------------------------------------------

    def _pieces(self) -> list[_Piece]:
        """The energies of translations and rotations, of other elements, of springs and of weights."""
        s = ingredients_of(self.truth.derivation)
        kinetic: list[tuple[Any, Any, RigidBody | None]] = []
        for b in s.bodies:
            kinetic.append((s.translation(b), (s.expand(b.mass), *s.velocity(b)), None))
            if isinstance(b, RigidBody):
                kinetic.append((s.rotation(b), (*map(s.expand, b.inertia), *s.omega(b)), b))
        others = [s.kinetic(e) for e in s.model.elements if e.kind == "kinetic"]
        kinetic += [(x, (x,), None) for x in others]
        stored = [V for *_, V in (*s.springs(), *s.weights())]
        exprs = [self.truth.put(x) for x in (*(x for x, *_ in kinetic), *stored)]
        values = CompiledExpressions(exprs).at(self.truth.states)
        each = zip(values, kinetic, strict=False)
        found = [_Piece("T", x, _letters(sp.Tuple(*made)), body) for x, (_, made, body) in each]
        found += [
            _Piece("V", without_constant(x), _letters(V)) for x, V in zip(values[len(kinetic) :], stored, strict=True)
        ]
        return [p for p in found if np.isfinite(p.values).all() and np.abs(p.values).max() > NEAR]

    def _of(self, ledger: str, whole: Array, turns: bool) -> list[_Piece]:
        """The pieces of which a part of T* or V consists: one of them, a rotation if it is one, two or all."""
        own = [p for p in self.pool.kept("right pieces", self._pieces) if p.ledger == ledger]
        own.sort(key=lambda p: (p.turning is not None) != turns)
        size = NEAR * np.abs(whole).max()
        for chosen in (*([p] for p in own), *([p, q] for k, p in enumerate(own) for q in own[:k]), own):
            if chosen and np.abs(sum(p.values for p in chosen) - whole).max() <= size:
                return chosen
        return []

    # -- what is written ---------------------------------------------------------------------------------------------

    def _line(self, line: AnsweredLine) -> _Line | None:
        """A line of energies or an equation, ready to be compared; None if its terms are not those of what it says."""
        kinds = kinds_of(line.name or "") if line.kind == "definition" else ()
        kind = next((k for k, name in LEDGERS.items() if kinds == (name,)), line.kind)
        if kind not in ("T", "V", "L", "equation") or not line.summands:
            return None
        put = self.truth.expand
        every = [(k, f) for k, ways in enumerate(line.summands) for f in ways]
        exprs = [self.truth.put(put(sp.Mul(*f))) for _, f in every]
        whole = self.truth.put(put(line.expr))
        if any(x.free_symbols - self.truth.names for x in (*exprs, whole)):
            return None
        with np.errstate(all="ignore"):
            values = CompiledExpressions([whole, *exprs]).at(self.truth.states)
        firsts = [values[1 + j] for j, (k, _) in enumerate(every) if j == 0 or every[j - 1][0] != k]
        if not np.isfinite(values).all() or not np.allclose(np.sum(firsts, axis=0), values[0], rtol=1e-7, atol=1e-9):
            return None
        if kind == "V":
            values = without_constant(values)
        terms: dict[int, list[tuple[Array, Factors]]] = {}
        for (k, factors), x in zip(every, values[1:], strict=True):
            terms.setdefault(k, []).append((x, factors))
        return _Line(kind, tuple(map(tuple, terms.values())))

    def _stands(self, line: _Line, piece: _Piece, changed: Sequence[_Piece], times: Fraction, *, half: bool) -> bool:
        """Whether a line has one of the pieces that are ``changed`` in full, or with its ½ beside another mass, where
        each should count so often, or should have lost its ``half``."""
        sign = -1.0 if line.kind == "L" and piece.ledger == "V" else 1.0
        every = self.pool.kept("right pieces", self._pieces)
        alike = [p for p in every if p.ledger == piece.ledger and same_values(p.values, piece.values)]
        others = [p for p in alike if not any(p is x for x in changed)]
        there = line.like(sign * piece.values)
        of_others = [x for x in there if any(_letters(sp.Tuple(*x)) <= p.letters for p in others)]
        if others and len(of_others) < len(there):
            return True
        if len(there) == len(others) + times:
            return half and len(others) == 0
        if len(there) > len(others):
            return times == 0 or not line.like(sign * float(times) * piece.values)
        if times == 0 or piece.ledger == "V":
            return False
        taken = [p for p in every if p.ledger == "T" and same_values(p.values, float(times) * piece.values)]
        left = sorted(line.like(sign * float(times) * piece.values), key=_simplicity)[len(taken) :]
        return bool(left) and all(self._has_half(x, piece, times) for x in left)

    def _has_half(self, factors: Factors, piece: _Piece, times: Fraction) -> bool:
        """Whether the ½ of an energy stands in a term, so that what counts otherwise is its mass or its J."""
        numbers = [x for x in factors if x.is_number and x not in (1, -1)]
        if HALF not in numbers:
            return False
        numbers.remove(HALF)
        rest = sp.Mul(*numbers)
        if piece.turning is None:
            return rest == 1
        s = ingredients_of(self.truth.derivation)
        J = sp.sympify(s.expand(piece.turning.inertia[0])) * sp.Rational(times.numerator, times.denominator)
        if any(isinstance(x, sp.Mul | sp.Add) and self._is(x, J) for x in factors):
            return True
        return rest != 1

    def _is(self, one: sp.Expr, other: sp.Expr) -> bool:
        """Whether two expressions have the same values."""
        exprs = [self.truth.put(self.truth.expand(x)) for x in (one, other)]
        a, b = CompiledExpressions(exprs).at(self.truth.states)
        return same_values(a, b)

    def _moves(self, row: Array, times: Fraction) -> bool:
        """Whether what a piece of T* adds to an equation stands in one in full, and in no other way."""
        if np.abs(row).max() <= NEAR:
            return False
        alike = self.pool.kept(("rows", row.tobytes()), lambda: len([*self._adding(row)]))
        found = (max(len(x.like(row)), len(x.like(-row))) for x in self.lines if x.kind == "equation")
        return 0 < alike <= (most := max(found, default=0)) and most != alike - 1 + times

    def _adding(self, row: Array) -> Iterator[Any]:
        """The pieces of T* that add the same to an equation, each once."""
        seen = set[Any]()
        for k, p in enumerate(self.pool.all):
            if p.change is None or p.change.site.only is not None:  # the same piece, in one equation alone
                continue
            if p.change.kind == "part" and not p.change.site.single and p.element is not None:
                key = id(p.element), tuple(np.round(self.pool.T[k][:3], 9))
                if key not in seen and any(same_values(x, row) for x in self.pool.W[k]):
                    seen.add(key)
                    yield p


@dataclass(frozen=True, eq=False)
class Against:
    """What an answer says against explanations: the ``mistakes``, by their identity, that would show in a right line,
    its terms as they are written, and the terms in which its wrong lines differ."""

    mistakes: frozenset[int]
    pieces: WrittenPieces
    undone: Undone

    def speaks(self, told: Told) -> bool:
        """Whether anything speaks against a mistake."""
        return id(told.mistake) in self.mistakes or self.pieces.contradict(told)

    def unopposed(self, found: Sequence[Explanation]) -> list[Explanation]:
        """The explanations that nothing speaks against."""
        return [e for e in found if not any(self.speaks(t) for t in e.told) and not self.undone.holds(e)]

    def also(self, mistakes: Set[int]) -> Against:
        """The same with more mistakes that would show in a right line."""
        return replace(self, mistakes=self.mistakes | mistakes)

    def only(self, mistakes: Set[int]) -> Against:
        """The same with these alone as the mistakes that would show in a right line."""
        return replace(self, mistakes=frozenset(mistakes))


def _turns(told: Told) -> bool:
    """Whether a mistake is said of the rotation of a body."""
    change, wrong = told.mistake.change, told.mistake.wrong
    said = str(wrong.variant.what) if wrong is not None else "".join(map(str, change.site.words)) if change else ""
    return "½Jω²" in said or "rotation" in said


def _letters(expr: sp.Basic) -> frozenset[Any]:
    """The constants in an expression."""
    return frozenset(expr.free_symbols - {time})


def _simplicity(factors: Factors) -> int:
    """How many letters the factors of a term have: m ẋ² comes before m r² (ẋ/r)²."""
    return len(sp.Tuple(*factors).free_symbols) + sum(isinstance(x, sp.Mul | sp.Add) for x in factors)
