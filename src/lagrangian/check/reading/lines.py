"""Converts statements to lines: determines what each one states, and the order in which names are defined."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import cast

import sympy as sp
from lark import Token, Tree
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.answer import AnswerLine, Kind
from lagrangian.check.reading.meaning import Meaning, ReadingBudget
from lagrangian.check.reading.names import Names, Value, spelled_rates
from lagrangian.check.reading.nodes import Node, inside, only_name, squared_name, start_of
from lagrangian.check.reading.placeholders import ENERGIES, generalized_force, is_force, is_placeholder, is_vector
from lagrangian.check.reading.stated import energy_of, force_of, momentum_of
from lagrangian.model import Model
from lagrangian.quantities.source import Source
from lagrangian.read.letters import key, undotted

MAX_CHAIN = 20
"""The largest number of definitions that may each need the one below it."""


@dataclass(frozen=True)
class Statement:
    """The syntax trees between the equals signs of a statement, and its text."""

    sides: tuple[Tree, ...]
    source: Source


@dataclass(frozen=True)
class Subject:
    """The subject of a statement: its kind, its name, the token, the order of a rate, and whether it is squared."""

    kind: Kind
    name: str | None = None
    token: Token | None = None
    order: int = 0
    square: bool = False


class Lines:
    """Reads the statements of one answer."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.names = Names(model)
        self.names.later = self._look_ahead
        self.budget = ReadingBudget()
        self._waiting: dict[str, int] = {}
        self._statements: Sequence[Statement] = ()
        self._made: dict[int, list[AnswerLine]] = {}
        self._chain = 0

    def read(self, statements: Sequence[Statement]) -> tuple[AnswerLine, ...]:
        """Return the lines of the statements, in their order."""
        self._statements = statements
        self.names.gather(tree for s in statements for tree in s.sides)
        for i, statement in enumerate(statements):
            subject = self._subject(statement.sides[0]) if len(statement.sides) > 1 else None
            if subject is not None and subject.kind == "definition" and subject.token is not None:
                self._waiting.setdefault(key(undotted(subject.token)[0]), i)
        for i in range(len(statements)):
            self._line(i)
        return tuple(line for i in range(len(statements)) for line in self._made[i])

    def _look_ahead(self, base: str) -> None:
        """Read the definition of a name that comes later in the answer."""
        at = self._waiting.pop(base, None)
        if at is None or at in self._made or self._chain >= MAX_CHAIN:
            return
        self._chain += 1
        self._line(at)
        self._chain -= 1

    def _line(self, i: int) -> None:
        if i in self._made:
            return
        self._made[i] = []  # a definition that refers to itself finds its own name unknown
        statement = self._statements[i]
        sides = list(statement.sides)
        subject, sides = self._turned(sides)
        reader = Meaning(statement.source, self.names, self.budget)
        if subject is not None and subject.token is not None:
            self._waiting.pop(key(undotted(subject.token)[0]), None)
        before = set(self.names.unknown)
        lines = self._about(subject, sides, reader) if subject else self._equations(sides, reader)
        if all(line.kind == "statement" for line in lines):  # a general statement may use its own letters: ξ_i
            for new in set(self.names.unknown) - before:
                del self.names.unknown[new]
        self._made[i] = lines

    def _turned(self, sides: list[Tree]) -> tuple[Subject | None, list[Tree]]:
        """The subject of a statement and its sides, the subject first; it may be on the left or right, a Ξ anywhere."""
        if len(sides) == 1:
            return None, sides
        subjects = [self._subject(side) for side in sides]
        order = [0, len(sides) - 1, *(i for i, s in enumerate(subjects) if s is not None and s.kind == "Xi")]
        for i in order:
            if subjects[i] is not None:
                return subjects[i], [sides[i], *sides[:i], *sides[i + 1 :]]
        return None, sides

    # -- what a statement is about -----------------------------------------------------------------------------------

    def _subject(self, side: Tree) -> Subject | None:
        """The subject of a statement with this left-hand side; None if it is an equation."""
        if (found := only_name(side)) is not None:
            return self._named(*found)
        if (token := squared_name(side)) is not None and not self._taken(token):
            return Subject("definition", str(token), token, square=True)
        return self._derivative_of_energy(inside(side))

    def _left_side(self, side: Tree) -> Subject | None:
        """Recognize d/dt ∂L/∂ξ̇ − ∂L/∂ξ, written with L alone."""
        side = inside(side)
        terms = [inside(x) for x in side.children if isinstance(x, Tree)] if side.data == "sum" else []
        if len(terms) != 2 or [str(x) for x in side.children if isinstance(x, Token)] != ["-"]:
            return None
        first, second = (self._derivative_of_energy(x) for x in terms)
        if first is None or second is None or (first.kind, second.kind) != ("p-rate", "slope"):
            return None
        return Subject("left", first.name) if first.name == second.name else None

    def _taken(self, token: Token) -> bool:
        """Whether a name belongs to the model, or spells out the rate of one of its names: theta1_ddot."""
        scope = self.names.scope
        return bool(scope.meanings(token)[0]) or any(scope.meanings(stem)[0] for _, stem in spelled_rates(token))

    def _named(self, token: Token, primes: int) -> Subject | None:
        base, dots = undotted(token)
        order = primes + dots
        if order:
            if self._taken(token):
                return None
            own = key(base) in self.names.own or key(base) in self._waiting
            return Subject("identity" if own else "definition", base, token, order)
        if (kind := energy_of(token, self.model, lhs=True)) is not None:
            return Subject(cast("Kind", kind), None, token)
        if (coordinate := force_of(token, self.model)) is not None:
            return Subject("Xi", coordinate)
        if (coordinate := momentum_of(token, self.model)) is not None and self.names.occurs(token) == 1:
            return Subject("p", coordinate)
        return None if self._taken(token) or token in ("t", "pi") else Subject("definition", str(token), token)

    def _derivative_of_energy(self, side: Node) -> Subject | None:
        """Recognize ∂L/∂ξ, ∂L/∂ξ̇ and d/dt ∂L/∂ξ̇ alone on one side."""
        if not isinstance(side, Tree):
            return None
        if side.data == "rate" and side.children[1] == 1:
            inner = self._derivative_of_energy(inside(side.children[0]))
            return Subject("p-rate", inner.name) if inner is not None and inner.kind == "p" else None
        if side.data != "partial" or side.children[0] not in ("L", "ℒ"):
            return None
        found = only_name(side.children[1])
        if found is None:
            return None
        token, primes = found
        names, dots = self.names.scope.meanings(token)
        coordinates = {c.name for c in self.model.coordinates}
        if len(names) != 1 or names[0] not in coordinates or primes + dots > 1:
            return None
        return Subject("p" if primes + dots else "slope", names[0])

    # -- lines ---------------------------------------------------------------------------------------------------------

    def _about(self, subject: Subject, sides: list[Tree], reader: Meaning) -> list[AnswerLine]:
        lines: list[AnswerLine] = []
        for side in sides[1:]:
            value = reader.value(side)
            if isinstance(value, MatrixBase):
                lines += self._matrix_of(subject, value, sides[0], reader)
            else:
                lines.append(self._stated(subject, value, sides, side, reader))
        return lines

    def _stated(self, subject: Subject, value: sp.Expr, sides: list[Tree], side: Tree, reader: Meaning) -> AnswerLine:
        value = reader.finite(value, side)
        kind: Kind = subject.kind
        name = subject.name
        lhs: sp.Expr | None = None
        if _general(value):
            return self._make("statement", None, value, None, sides[0], side, reader)
        if kind in ENERGIES:
            self.names.stated[kind] = value
            if subject.token is not None and energy_of(subject.token, self.model) is None:
                self.names.define(subject.token, value)  # K, P are energies only if a line says so
        elif kind == "definition":
            assert subject.token is not None
            if self._is_equation(subject, value):
                return self._make("equation", reader.value(sides[0]), value, None, sides[0], side, reader)
            self._define(subject, value)
        elif kind == "identity":
            lhs = reader.value(sides[0])
        elif kind == "Xi" and _accelerates(value):
            assert name is not None
            return self._make("equation", value, generalized_force(name), None, sides[0], side, reader)
        return self._make(kind, lhs, value, name, sides[0], side, reader)

    def _is_equation(self, subject: Subject, value: sp.Expr) -> bool:
        """Whether a new name alone on a side is not a definition: nothing else uses it, and it equals accelerations."""
        assert subject.token is not None
        if subject.order or subject.square or self.names.occurs(subject.token) > 1:
            return False
        return _accelerates(value)

    def _define(self, subject: Subject, value: sp.Expr) -> None:
        assert subject.token is not None
        if subject.order:
            self.names.rates[key(undotted(subject.token)[0]), subject.order] = value
        else:
            self.names.define(subject.token, sp.sqrt(value) if subject.square else value)

    def _matrix_of(self, subject: Subject, value: Value, side: Tree, reader: Meaning) -> list[AnswerLine]:
        """Read a named matrix: a column of all Ξ states each of them; any other is stored for the lines that use it."""
        token = subject.token
        if token is None or subject.order or subject.kind in ENERGIES:
            reader.fail("a single quantity cannot equal a matrix", side, fix="write one equation per line")
        names = [c.name for c in self.model.coordinates]
        if key(token) in ("Xi", "Q", "bold Xi", "bold Q") and value.shape == (len(names), 1):
            own = Subject("Xi")
            return [
                self._stated(replace(own, name=n), x, [side, side], side, reader)
                for n, x in zip(names, value, strict=True)
            ]
        self.names.define(token, value)
        return []

    def _equations(self, sides: list[Tree], reader: Meaning) -> list[AnswerLine]:
        values = [reader.value(side) for side in sides]
        if len(values) == 1:
            values.append(sp.S.Zero)
            sides = [*sides, sides[0]]
        lines: list[AnswerLine] = []
        for i in range(len(values) - 1):
            lines += self._equation(values[i], values[i + 1], sides[i], sides[i + 1], reader)
        return lines

    def _equation(self, left: Value, right: Value, a: Tree, b: Tree, reader: Meaning) -> list[AnswerLine]:
        pairs = [(left, right)]
        if is_vector(left) or is_vector(right):
            return []
        if isinstance(left, MatrixBase) or isinstance(right, MatrixBase):
            pairs = _rows(left, right, b, reader)
        return [self._judged(reader.finite(x, a), reader.finite(y, b), a, b, reader) for x, y in pairs]

    def _judged(self, left: sp.Expr, right: sp.Expr, a: Tree, b: Tree, reader: Meaning) -> AnswerLine:
        kind: Kind = "equation"
        for side, value in ((a, right), (b, left)):
            if (subject := self._left_side(side)) is not None and _accelerates(value):
                return self._make("left", None, value, subject.name, a, b, reader)
        if _general(left) or _general(right):
            kind = "statement"
        elif (found := only_name(a)) is not None and not found[1] and self._change(found[0], right):
            return self._make("definition", None, right, str(found[0]), a, b, reader)
        return self._make(kind, left, right, None, a, b, reader)

    def _change(self, token: Token, value: sp.Expr) -> bool:
        """Whether a line expresses a coordinate of the model in new ones: x2 = x1 + s, where the model has no s."""
        names, dots = self.names.scope.meanings(token)
        if dots or len(names) != 1 or names[0] not in {c.name for c in self.model.coordinates}:
            return False
        new = {u.symbol for u in self.names.unknown.values() if isinstance(u.symbol, AppliedUndef)}
        return bool(value.atoms(AppliedUndef) & new) and not value.has(sp.Derivative)

    @staticmethod
    def _make(
        kind: Kind, lhs: sp.Expr | None, rhs: sp.Expr, name: str | None, a: Tree, b: Tree, reader: Meaning
    ) -> AnswerLine:
        """Make the line; its place is that of its first side."""
        source = reader.source
        start = min(start_of(a), start_of(b))
        return AnswerLine(kind, lhs, rhs, name, source.at(start), " ".join(source.text.split()))


def _general(value: sp.Expr) -> bool:
    """Whether an expression contains energies or variations that have no value."""
    return any(is_placeholder(x) and not is_force(x) for x in value.atoms(AppliedUndef))


def _accelerates(value: sp.Expr) -> bool:
    return any(d.derivative_count > 1 for d in value.atoms(sp.Derivative))


def _rows(left: Value, right: Value, node: Tree, reader: Meaning) -> list[tuple[sp.Expr, sp.Expr]]:
    """The equations of a matrix equation, row by row; a plain 0 is a column of zeros."""
    shape = left.shape if isinstance(left, MatrixBase) else right.shape
    both = []
    for value in (left, right):
        if not isinstance(value, MatrixBase):
            if value != 0:
                reader.fail("a matrix equals a number", node, fix="write a column [a; b] on both sides")
            value = sp.zeros(*shape)
        both.append(value)
    if both[0].shape != both[1].shape:
        a, b = (f"{s[0]} × {s[1]}" for s in (both[0].shape, both[1].shape))
        reader.fail(f"the left side is {a}, the right side {b}", node, fix="give both sides the same number of rows")
    return list(zip(both[0], both[1], strict=True))
