"""The letters of a notation, and the quantities of a derivation laid out in them.

    meaning                lecture   physics   robotics
    coordinate             ξ_i       q_i       q_i
    kinetic co-energy      T*        T         K
    potential energy       V         V         P
    Lagrangian             ℒ         ℒ         ℒ
    generalized force      Ξ_i       Q_i       τ_i
    matrix form            M q̈ + C q̇ + G = Ξ   (with Q)   M(q) q̈ + C(q, q̇) q̇ + g(q) = τ

If the system uses a letter itself, the next one in the same row of `_CHOICES` replaces it: in a system with a
parameter V, the potential energy is U.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Literal, TypeAlias, cast, get_args

import sympy as sp

from lagrangian.errors import ModelError, did_you_mean
from lagrangian.model import Model
from lagrangian.page.formula import (
    Elided,
    Formula,
    Left,
    Matrix,
    Minus,
    Name,
    Partial,
    Product,
    Square,
    Terms,
    Text,
    Total,
    Variation,
    Verbatim,
)
from lagrangian.write.expression import Expressions, NamedSymbol
from lagrangian.write.expression_tree import (
    Addition,
    Fence,
    Grid,
    Letter,
    Mark,
    Math,
    Number,
    Numeral,
    Power,
    Quotient,
    Times,
    Word,
    equality,
    fenced,
    numbered,
    product,
)

Notation: TypeAlias = Literal["lecture", "physics", "robotics"]

NOTATIONS: tuple[Notation, ...] = get_args(Notation)
"""The notations that every writer knows."""
"""Which letters: the lecture's ξ, T*, V, Ξ; the physicist's q, T, V, Q; the roboticist's q, K, P, τ."""

_CHOICES: dict[str, dict[str, tuple[Letter, ...]]] = {
    "lecture": {
        "T*": (Letter("T", star=True),),
        "V": (Letter("V"), Letter("U"), Letter("𝒱")),
        "Xi": (Letter("Xi"), Letter("Q"), Letter("𝒬")),
        "xi": (Letter("xi"), Letter("q"), Letter("eta")),
        "stored": (Letter("T"), Letter("E"), Letter("ℰ")),
    },
    "physics": {
        "T*": (Letter("T"), Letter("K"), Letter("T", star=True)),
        "V": (Letter("V"), Letter("U"), Letter("𝒱")),
        "Xi": (Letter("Q"), Letter("Xi"), Letter("𝒬")),
        "xi": (Letter("q"), Letter("xi"), Letter("eta")),
    },
    "robotics": {
        "T*": (Letter("K"), Letter("T"), Letter("T", star=True)),
        "V": (Letter("P"), Letter("V"), Letter("U")),
        "Xi": (Letter("tau"), Letter("Q"), Letter("Xi")),
        "xi": (Letter("q"), Letter("xi"), Letter("eta")),
    },
}
_COMMON: dict[str, tuple[Letter, ...]] = {
    "L": (Letter("ℒ"),),
    "D": (Letter("D"), Letter("ℱ")),
    "delta": (Letter("delta"), Letter("Delta")),
    "psi": (Letter("psi"), Letter("Psi")),
    "current": (Letter("i"), Letter("I"), Letter("ℐ")),
    "stored": (Letter("E"), Letter("ℰ")),
    "h": (Letter("h"), Letter("z"), Letter("H")),
    "v": (Letter("v"), Letter("u")),
    "omega": (Letter("omega"), Letter("Omega")),
    "phi": (Letter("phi"), Letter("psi")),
    "W": (Letter("W"), Letter("𝒲")),
    "F": (Letter("F"),),
    "E": (Letter("E"), Letter("ℰ")),
    "H": (Letter("H"), Letter("ℋ")),
    "R": (Letter("R"), Letter("ℛ")),
    "lambda": (Letter("lambda"), Letter("mu"), Letter("Lambda")),
    "f": (Letter("f"), Letter("Phi")),
    "c": (Letter("c"), Letter("Psi")),
    "r": (Letter("r"), Letter("rho")),
    "moment": (Letter("Gamma"), Letter("Theta")),
    "pull": (Letter("S"), Letter("𝒮")),
    "push": (Letter("N"), Letter("𝒩")),
    "sum": (Letter("Sigma"),),
    "pi": (Letter("pi"), Letter("Pi")),
}
_VECTORS = (
    {letter: letter for letter in "MCGqABJKS"}
    | {"D matrix": "D", "damping matrix": "Gamma"}
    | {f"{x} vector": x for x in ("x", "u", "y", "q", "f", "p", "gamma", "lambda")}
)
"""The letters of matrices and vectors, which are bold if a symbol of the system has the same letter."""


class Quantities:
    """Lays out everything that formulas contain, in one notation; ``full`` writes out what would be summarized."""

    def __init__(
        self, model: Model, notation: Notation, *, full: bool = False, named: Sequence[NamedSymbol] = ()
    ) -> None:
        if notation not in NOTATIONS:
            known = ", ".join(NOTATIONS)
            hint = did_you_mean(str(notation), NOTATIONS)
            raise ModelError(f"unknown notation '{notation}'", fix=hint or f"use one of {known}", code="E405")
        self.notation, self.full = notation, full
        self.expressions = Expressions(model, named)
        self._taken = {(x.base, x.sub) for x in self.expressions.letters.values() if not x.literal}
        self._subs = {""} | {self._index(e.name) for e in model.elements}
        names = sorted((re.escape(f"'{e.name}'") for e in model.elements), key=len, reverse=True)
        self._quoted = re.compile("(" + "|".join([*names, "'[^']*'"]) + ")")
        self._order = [c.name for c in model.coordinates]
        self._chosen = {base: self._choose(base, row) for base, row in (_COMMON | _CHOICES[notation]).items()}

    # -- letters ----------------------------------------------------------------------------------------------------

    def _choose(self, base: str, row: tuple[Letter, ...]) -> Letter:
        return next((x for x in row if not self._clashes(base, x)), row[-1])

    def _clashes(self, meaning: str, candidate: Letter) -> bool:
        """Whether a symbol of the system looks like this letter with an index that the derivation may use."""
        if candidate.star:
            return False
        for base, sub in self._taken:
            if base != candidate.base:
                continue
            index = " ".join(sub)
            if meaning in ("Xi", "xi") and index == "":
                continue  # without an index these are vectors, so they are set bold
            if meaning == "xi" and index.isdigit() and self._own_place(base, index):
                continue
            if index in self._subs or index.isdigit():
                return True
        return False

    def _own_place(self, base: str, index: str) -> bool:
        """Whether the coordinate with this index has this very name: q₁ is the first coordinate."""
        at = int(index) - 1
        return 0 <= at < len(self._order) and self.expressions.letter(self._order[at]) == Letter(base, (index,))

    def _index(self, index: str) -> str:
        """The parts of an index, joined; the name of an element is laid out like a symbol."""
        return " ".join(self._parts(index))

    def _parts(self, index: str) -> tuple[str, ...]:
        if not index:
            return ()
        if index.isidentifier():
            made = self.expressions.letter(index)
            whole = made.base + "".join(made.sub)
            if made.literal:
                return (index,)
            return (whole,) if numbered(whole) else (made.base, *made.sub)
        return (index,)

    def name(self, name: Name) -> Math:
        """Lay out a named quantity."""
        sub = self._parts(name.index)
        if name.base in self._chosen and not (name.base == "Xi" and not sub):
            chosen = self._chosen[name.base]
            return Letter(chosen.base, sub, name.dots, chosen.star)
        if name.base == "Xi":
            return self._vector(self._chosen["Xi"].base, name.dots)
        if name.base in _VECTORS:
            if name.base == "G" and self.notation == "robotics":
                return Numeral(self._vector("g", 0), (self._vector("q", 0),))
            return self._vector(_VECTORS[name.base], name.dots)
        if name.base == "A transposed":
            return Power(self._vector("A", 0), Word("T"))
        if name.base in ("x", "y", "z"):
            return Letter(name.base, sub, name.dots)
        if name.base.isdigit():
            return Number(name.base)
        return Word(name.base + (f" {name.index}" if name.index else ""))

    def _vector(self, base: str, dots: int) -> Letter:
        return Letter(base, (), dots, bold=True, apart=any(taken == base for taken, _ in self._taken))

    def words(self, words: str) -> Iterator[str | Math]:
        """Find the letters of the lecture in words, and lay them out in this notation.

        A text in quotation marks is a name that a user chose: the name of a symbol is laid out as in the formulas; any
        other stays as it is.
        """
        for i, part in enumerate(self._quoted.split(words)):
            if i % 2:
                yield self.expressions.letters.get(part[1:-1], part)
                continue
            at = 0
            for found in _LETTERS.finditer(part):
                if found.start() > at:
                    yield part[at : found.start()]
                at = found.end()
                yield self._lecture_letter(found.group())
            if at < len(part):
                yield part[at:]

    def _lecture_letter(self, found: str) -> Math:
        letters = {"T*": "T*", "V": "V", "L": "L", "Ξ": "Xi", "ξ": "xi", "Ξᵢ": "Xi", "ξᵢ": "xi"}
        base = letters[found]
        sub = ("i",) if found.endswith("ᵢ") else ()
        return Letter(self._chosen[base].base, sub, star=self._chosen[base].star)

    # -- anything in a formula --------------------------------------------------------------------------------------

    def __call__(self, item: Left) -> Math:
        """Lay out any side of an equality."""
        match item:
            case Name():
                return self.name(item)
            case Partial(of, by):
                return Quotient(Mark("∂", self(of)), Mark("∂", self(by)))
            case Total(of):
                return Times((Quotient(Word("d"), Word("dt")), Fence(self(of))))
            case Variation(of):
                return Mark("δ", fenced(self(of), (Addition, Times, Quotient)))
            case Terms(terms):
                return self._terms(terms)
            case Minus(of):
                return Addition(((True, fenced(self(of), Addition)),))
            case Product(factors):
                return self._product(factors)
            case Square(coefficient, of):
                return self._square(coefficient, of)
            case Matrix(rows, symmetric):
                laid = tuple(tuple(self(x) for x in row) for row in rows)
                diagonal = all(x == Number("0") for i, row in enumerate(laid) for x in row[i + 1 :])
                return _upper(laid) if symmetric and not diagonal else Grid(laid)
            case Elided(expr, operations, terms):
                if not self.full:
                    return Word(f"⟨{operations} operations⟩")
                return self.expressions.sum(terms) if terms else self(expr)
        return self.expressions(item)

    def _terms(self, terms: tuple[Left, ...]) -> Math:
        laid: list[tuple[bool, Math]] = []
        for term in terms:
            if isinstance(term, Minus):
                laid.append((True, self(term.of)))
            elif isinstance(term, sp.Basic):
                laid.append(self.expressions.term(cast(sp.Expr, term)))
            else:
                laid.append((False, self(term)))
        if len(laid) == 1 and not laid[0][0]:
            return laid[0][1]
        return Addition(tuple(laid)) if laid else Number("0")

    def _product(self, factors: tuple[Left, ...]) -> Math:
        laid: list[Math] = []
        for factor in factors:
            made = self(factor)
            if self.notation == "robotics" and isinstance(factor, Name) and isinstance(made, Letter):
                q, rate = self._vector("q", 0), self._vector("q", 1)
                made = Numeral(made, {"M": (q,), "C": (q, rate)}[factor.base]) if factor.base in ("M", "C") else made
            laid += made.factors if isinstance(made, Times) else (made,)
        return product(laid[0], *laid[1:]) if laid else Number("1")

    def _square(self, coefficient: sp.Expr, of: tuple[Left, ...]) -> Math:
        """Lay out a sum of squares: ½ m (ẋ² + ẏ²)."""
        content, rest = coefficient.as_content_primitive()
        if isinstance(rest, sp.Add):
            negative, front = False, product(self.expressions(content), self.expressions(rest))
        else:
            negative, front = self.expressions.term(coefficient)
        squares = [Power(fenced(self(a), _NOT_SQUARED), Number("2")) for a in of]
        inner: Math = squares[0] if len(squares) == 1 else Addition(tuple((False, s) for s in squares))
        made = product(front, inner)
        return Addition(((True, made),)) if negative else made

    def formula(self, item: Formula) -> tuple[Math, ...]:
        """Lay out the sides of a chain of equalities; a side that looks like the previous one is omitted."""
        sides: list[Math] = []
        for side in item.sides:
            laid = self(side)
            if not sides or laid != sides[-1]:
                sides.append(laid)
        return tuple(sides)

    def inline(self, item: Text | Formula, *, given: frozenset[str] = frozenset()) -> tuple[str | Math, ...]:
        """Lay out words that contain symbols; texts in ``given`` are words of users and stay as they are."""
        if isinstance(item, Formula):
            return (equality(self.formula(item)),)
        made: list[str | Math] = []
        for part in item.parts:
            if isinstance(part, str):
                made += [part] if part in given else self.words(part)
            elif isinstance(part, Verbatim):
                made.append(part.words)
            else:
                made.append(self(part))
        return tuple(made)


def _upper(rows: tuple[tuple[Math, ...], ...]) -> Grid:
    """A symmetric matrix by its upper half, with "sym." in the lower corner."""
    last = len(rows) - 1
    corner = [[Word("sym." if (i, j) == (last, 0) else "") for j in range(i)] for i in range(len(rows))]
    return Grid(tuple((*corner[i], *row[i:]) for i, row in enumerate(rows)), symmetric=True)


_LETTERS = re.compile(r"T\*|Ξᵢ|ξᵢ|Ξ|ξ(?!̇)|(?<![\w*'’])[VL](?![\w*'’(])")
_NOT_SQUARED = (Addition, Times, Quotient, Power, Mark)
