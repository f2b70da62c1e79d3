"""Reads conditions in plain text, for piecewise: comparisons joined by and, or and not, in any spelling."""

from __future__ import annotations

from collections.abc import Callable

from lark import Tree

from lagrangian.check.reading.nodes import Node, leaf, node
from lagrangian.check.reading.parser import Parser

OR, AND, NOT = ("or", "|", "||", "∨"), ("and", "&", "&&", "∧"), ("not", "~", "¬")


class PlainConditions(Parser):
    """The part of the parser that reads conditions."""

    def argument(self) -> Tree:
        """Read an argument of a function: a value or a condition."""
        return self._condition() if self._compares(self.i) else self.sum()

    def _compares(self, at: int) -> bool:
        """Whether there is a comparison before the end of the argument or bracket that begins here.

        A comparison inside a factor or a function does not count: max(piecewise(x > 0, 1, 2), 3) is no condition.
        """
        depth = 0
        factor: int | None = None  # the depth outside the bracket, no condition, that is being passed over
        for k in range(at, len(self.tokens)):
            token, before = self.tokens[k], self.tokens[k - 1].text
            if factor is None and token.kind in "([" and before not in ("(", ",", *OR, *AND, *NOT):
                factor = depth
            depth += (token.kind in "([") - (token.kind in ")]")
            if depth < 0 or (depth == 0 and token.kind in (",", "end")):
                return False
            if factor is not None:
                factor = factor if depth > factor else None
            elif token.kind == "relation" or token.text == "==":
                return True
        return False

    def _condition(self) -> Tree:
        """Read conditions joined by or, each of which consists of conditions joined by and."""
        return self._joined("condition", OR, self._conjunction)

    def _conjunction(self) -> Tree:
        return self._joined("conjunction", AND, self._truth)

    def _joined(self, kind: str, words: tuple[str, ...], part: Callable[[], Tree]) -> Tree:
        start = self.next.start
        children: list[Node] = [part()]
        while self.next.text in words:
            word = self.take()
            children += [leaf("WORD", word.text, word.start), part()]
        return node(kind, start, *children)

    def _truth(self) -> Tree:
        """Read a comparison, a condition in brackets, or the negation of one."""
        token = self.next
        if token.text in NOT:
            self.take()
            self.deeper(token.start)
            made = node("negation", token.start, leaf("NOT", token.text, token.start), self._truth())
            self.opened.pop()
            return made
        if token.kind == "(" and self._compares(self.i + 1):
            self.take()
            self.deeper(token.start)
            made = self._condition()
            if not self.accept(")"):
                raise self.stopped(False)
            self.opened.pop()
            return made
        left = self.sum()
        relation = self.next
        if relation.kind != "relation" and relation.text != "==":
            raise self.stopped(False)
        self.take()
        return node("comparison", token.start, left, leaf("RELATION", relation.text, relation.start), self.sum())
