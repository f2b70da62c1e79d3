"""A recursive-descent parser of sums, products and powers in any notation, with bounded depth.

The parser of a notation defines its tokens, its operands, and whether two adjacent operands are a product.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from copy import deepcopy

from lark import Tree

from lagrangian.check.reading.nodes import MAX_DEPTH, Node, leaf, node, start_of
from lagrangian.errors import ParseError
from lagrangian.quantities.source import Source
from lagrangian.records import dataclass

MAX_SIDES = 200
"""The most sides of a statement, a = b = c = …"""


@dataclass(frozen=True, slots=True)
class AnswerToken:
    """A piece of the text: its kind, its text, and where it begins and ends."""

    kind: str
    text: str
    start: int
    end: int


class Parser(ABC):
    """Parses one statement. ``tokens`` ends with a token of kind ``end``."""

    def __init__(self, source: Source, tokens: list[AnswerToken]) -> None:
        self.source, self.tokens = source, tokens
        self.i = 0
        self.opened: list[int] = []

    # -- defined by each notation --------------------------------------------------------------------------------

    @abstractmethod
    def operand(self) -> Tree:
        """Read a number, a name, a call or a bracket, with its powers and primes."""

    @abstractmethod
    def side_by_side(self) -> bool:
        """Whether the next token begins another factor of a product that has no operator."""

    def stays_below(self, begins: int) -> bool:
        """Whether the next factor, which has no operator, belongs to the denominator that begins at a token."""
        return False

    @abstractmethod
    def stopped(self, wants_operand: bool) -> ParseError:
        """Return the error for a text that cannot continue with the next token."""

    # -- tokens ----------------------------------------------------------------------------------------------------

    @property
    def next(self) -> AnswerToken:
        """The next token, without consuming it."""
        return self.tokens[self.i]

    def ahead(self, count: int = 1) -> AnswerToken:
        """The token after the next one."""
        return self.tokens[min(self.i + count, len(self.tokens) - 1)]

    def take(self) -> AnswerToken:
        """Return the next token and consume it."""
        token = self.next
        self.i = min(self.i + 1, len(self.tokens) - 1)
        return token

    def accept(self, *kinds: str) -> AnswerToken | None:
        """Consume the next token if it is of one of these kinds."""
        return self.take() if self.next.kind in kinds else None

    def deeper(self, start: int) -> None:
        """Count an opening bracket; raise an error if brackets are nested too deep."""
        self.opened.append(start)
        if len(self.opened) > MAX_DEPTH:
            raise self.source.error(
                f"brackets are nested more than {MAX_DEPTH} deep",
                start,
                fix="give the inner parts names on lines of their own: h = …",
                code="E703",
            )

    def multiplied(self, first: Node, joins: Callable[[Node, Node], bool]) -> list[Node]:
        """Read the next factor, with its operator, if it ``joins`` the ``first`` one in an argument without brackets;
        read nothing if it does not."""
        at, tokens, depth = self.i, list(self.tokens), len(self.opened)
        signed = self.accept("times")
        found: Tree | None = None
        if signed is not None or self.side_by_side():
            start = self.next.start
            try:
                found = self.operand()
            except ParseError:
                found = None
            if found is not None and joins(first, found):
                return [leaf("OPERATOR", "*", start), found]
        self.i, self.tokens = at, tokens
        del self.opened[depth:]
        return []

    def with_multiple(self, argument: Tree, joins: Callable[[Node, Node], bool]) -> Tree:
        """An argument in brackets with the factor behind it, cos(n + 1)φ, if it ``joins`` it."""
        more = self.multiplied(argument, joins)
        return node("product", start_of(argument), argument, *more) if more else argument

    def unclosed(self) -> ParseError | None:
        """Return the error for a bracket that is still open at the end of a side."""
        if not self.opened or self.next.kind not in ("=", "end"):
            return None
        at = self.opened[-1]
        return self.source.error(
            f"this '{self.source.text[at]}' is never closed", at, fix="close it on the same side of '='"
        )

    # -- grammar ---------------------------------------------------------------------------------------------------

    def sides(self) -> list[Tree]:
        """Read sums with = between them, up to the end."""
        found = [self.sum()]
        while self.accept("="):
            found.append(self.sum())
            if len(found) > MAX_SIDES:
                raise self.source.error(
                    f"a statement of more than {MAX_SIDES} sides",
                    self.next.start,
                    fix="write one equation per line",
                    code="E703",
                )
        if self.next.kind != "end":
            raise self.stopped(False)
        return found

    def sum(self) -> Tree:
        """Read [sign] product (sign product)*."""
        start = self.next.start
        children: list[Node] = [self._sign(), self.product()]
        while (sign := self._sign()) is not None:
            children += [sign, self.product()]
        return node("sum", start, *children)

    def product(self) -> Tree:
        """Read signed (operator signed)*; the operator may be omitted if the notation allows it."""
        start = self.next.start
        children: list[Node] = [self.operand()]
        while True:
            if (operator := self.accept("times", "over")) is not None:
                children.append(leaf("OPERATOR", "/" if operator.kind == "over" else "*", operator.start))
                at, begins = self.next.start, self.i
                sign = self._sign()
                below = [self.operand()]
                while operator.kind == "over" and self.side_by_side() and self.stays_below(begins):
                    below += [leaf("OPERATOR", "*", self.next.start), self.operand()]
                below = below if len(below) == 1 else [node("product", at, *below)]
                children.append(node("signed", at, sign, *below))
            elif self.side_by_side():
                children += [leaf("OPERATOR", "*", self.next.start), self.operand()]
            else:
                return node("product", start, *children)

    def mirrored(self, rows: list[list[Tree | None]], i: int, j: int, token: AnswerToken) -> Tree:
        """The entry in row i and column j; for an empty one, the entry on the other side of the diagonal."""
        entry = rows[i][j]
        if entry is None and j < i and i < len(rows[j]):
            entry = rows[j][i]
        if entry is None:
            what = "an entry of this matrix is empty and has no counterpart above the diagonal"
            raise self.source.error(what, token.start, fix="write the diagonal and all that is above it")
        return deepcopy(entry)

    def _sign(self) -> Node:
        token = self.accept("plus", "minus")
        return None if token is None else leaf("SIGN", "+" if token.kind == "plus" else "-", token.start)
