"""Reads derivatives in plain text: primes, dx/dt, d(…)/dt, diff(x, t, 2), Derivative(x(t), (t, 2)), D[x[t], {t, 2}]."""

from __future__ import annotations

from lark import Token, Tree

from lagrangian.check.reading.nodes import Node, column, inside, leaf, name, node, only_name
from lagrangian.check.reading.parser import AnswerToken
from lagrangian.check.reading.plain.conditions import PlainConditions
from lagrangian.check.reading.plain.tokens import TOKEN
from lagrangian.check.reading.prose.words import Words
from lagrangian.check.reading.stated import energy_of
from lagrangian.read.letters import dotted

ORDERS = {"'": 1, "’": 1, "′": 1, "″": 2, "‴": 3, '"': 2}
"""How often each mark differentiates."""

DIFFERENTIATE = frozenset(["diff", "Derivative", "D", "Diff"])
"""The functions of programs that differentiate."""

DOTS = {"dot": 1, "ddot": 2, "der": 1}
"""Functions that stand for dots."""

PARTIAL = "∂"
"""The sign of partial derivatives; in front of a name it is part of a token of its own, ∂L/∂θ."""

CLOSING = {"(": ")", "[": "]"}
"""Opening brackets, with their closing brackets."""


class PlainDerivatives(PlainConditions):
    """The part of the parser that reads derivatives; ``words`` are those of the answer."""

    words: Words

    def _moves(self, called: str) -> bool:
        """Whether a name changes with time."""
        raise NotImplementedError

    def _primed(self, made: Tree, primes: AnswerToken) -> Tree:
        order = sum(ORDERS[c] for c in primes.text)
        inner = inside(made)
        if inner.data == "name" and inner.children[1] is None:
            token: Node = inner.children[0]
            return name(token, token.start_pos, order)
        return node("rate", primes.start, made, order)

    def _bracket(self) -> Tree:
        closing = CLOSING[self.next.kind]
        start = self.take().start
        self.deeper(start)
        listed = [self.sum()]
        while self.accept(",", ";"):  # (x, y) is a column, and (x ; y), too
            listed.append(self.sum())
        if not self.accept(closing):
            raise self.stopped(False)
        self.opened.pop()
        return listed[0] if len(listed) == 1 else column(start, listed)

    def _fraction_rate(self) -> Tree:
        token = self.take()
        found = TOKEN.match(self.source.text, token.start)
        assert found is not None
        group, order = ("of1", 1) if token.kind == "rate" else ("of2", 2)
        written = found[group].rstrip("'’′″‴\"")
        order += sum(ORDERS[c] for c in found[group][len(written) :])
        return name(written, found.start(group), order)

    def _second_slope(self, token: AnswerToken) -> Tree:
        """Read ∂²l/∂θ², the derivative of ∂l/∂θ."""
        found = TOKEN.match(self.source.text, token.start)
        assert found is not None
        by = name(found["by2"], found.start("by2"))
        once = node("partial", token.start, leaf("NAME", dotted(found["what2"]), token.start), by)
        return node("derivative", token.start, once, by)

    def _d_of_bracket(self, token: AnswerToken) -> Tree | None:
        """Read d(…)/dt, d²(…)/dt² or d(…)/dθ; None if no bracket or nothing of this follows."""
        at = self.i
        twice = self._two()
        inner = self._bracket() if self.next.kind == "(" else None
        if inner is not None and self.next.kind == "over" and self.ahead().text == "dt":
            self.take()
            self.take()
            if not twice or self._two():
                return node("rate", token.start, inner, 2 if twice else 1)
        if inner is not None and not twice and self.accept("over") and (by := self._coordinate_behind_d()) is not None:
            return node("derivative", token.start, inner, by)
        self.i = at
        return None

    def _operator_by_coordinate(self, token: AnswerToken) -> Tree | None:
        """Read d/dθ(…) or d/dθ […]; None if that does not follow."""
        at = self.i
        if self.accept("over") and (by := self._coordinate_behind_d()) is not None and self.next.kind in ("(", "["):
            return node("derivative", token.start, self._bracket(), by)
        self.i = at
        return None

    def _partial_of_bracket(self, token: AnswerToken) -> Tree:
        """Read ∂(…)/∂θ or ∂/∂θ(…), behind the sign."""
        made = self._d_of_bracket(token) if self.next.kind == "(" else self._operator_by_coordinate(token)
        if made is None:
            self.i -= 1
            raise self.stopped(True)
        return made

    def _coordinate_behind_d(self) -> Tree | None:
        """Read dθ or d(θ) below a bar, where θ is a coordinate."""
        token = self.next
        if token.text in ("d", PARTIAL) and self.ahead().kind == "(":
            self.take()
            by = self._bracket()
            which = only_name(by)
            return by if which is not None and not which[1] and self._moves(str(which[0])) else None
        if token.text == PARTIAL and self.ahead().kind == "name" and self._moves(self.ahead().text):
            self.take()
            return name(self.next.text, self.take().start)
        if token.kind != "name" or token.text[:1] != "d" or not self._moves(token.text[1:]) or self._moves(token.text):
            return None
        self.take()
        return name(token.text[1:], token.start + 1)

    def _two(self) -> bool:
        """Whether ² or ^2 is next; if so, consume it."""
        if self.next.text == "²" or (self.next.kind == "power" and self.ahead().text == "2"):
            self.i += 1 if self.next.text == "²" else 2
            return True
        return False

    def _differentiated(self, token: AnswerToken) -> Tree:
        """Read diff(x, t), diff(x, t, 2), diff(x, t, t), Derivative(x(t), (t, 2)), D[x[t], {t, 2}] or diff(L, x')."""
        closing = CLOSING[self.next.kind]
        start = self.take().start
        self.deeper(start)
        made = self.sum()
        order = 0
        while self.accept(","):
            if self.next.kind == "number" and not order and made.data != "partial":  # diff(x, 2)
                order = self._order()
                continue
            tuple_open = self.accept("(", "{")
            by = _named_rate(self.sum())
            which = only_name(by)
            if which == ("t", 0):
                order += 1
                if self.next.kind == "," and self.ahead().kind == "number":
                    self.take()
                    order += self._order() - 1
            elif which is not None:
                made = node("partial", token.start, self._energy(made, token), by)
            else:
                raise self.source.error(
                    "a derivative must be with respect to t or to one name",
                    by.meta.start_pos,
                    fix="write diff(x1, t, 2) or x1''",
                )
            if tuple_open and not self.accept(")", "}"):
                raise self.stopped(False)
        if not self.accept(closing):
            raise self.stopped(False)
        self.opened.pop()
        named = only_name(made)
        called = token.text in ("diff", "Derivative") and named is not None and not named[1]
        if not order and called and named is not None and self._moves(str(named[0])):
            order = 1  # diff(x) can only mean the rate
        if not order and made.data != "partial":
            raise self.source.error(
                f"{token.text} needs a variable to differentiate by", token.start, fix=f"write {token.text}(x1, t)"
            )
        return node("rate", token.start, made, order) if order else made

    def _order(self) -> int:
        token = self.take()
        if token.text not in ("1", "2"):
            raise self.source.error(
                "derivatives go up to the second", token.start, fix="write x1'' for an acceleration"
            )
        return int(token.text)

    def _energy(self, made: Tree, token: AnswerToken) -> Node:
        """The energy that is differentiated, T - V as L, or an expression by the name that the answer gives it."""
        which = only_name(made)
        terms = [only_name(x) for x in inside(made).children if isinstance(x, Tree)] if made.data != "name" else []
        kinds = [energy_of(str(x[0]), self.words.names.model) for x in terms if x is not None and not x[1]]
        if kinds == ["T", "V"] and [str(x) for x in inside(made).children if isinstance(x, Token)] == ["-"]:
            return leaf("NAME", "ℒ", token.start)
        if which is not None and not which[1] and self.words.is_own(str(which[0])):
            return which[0]
        if which is None or which[1] or which[0] not in ("T", "V", "L", "D", "ℒ"):
            raise self.source.error(
                "only T, V, L and D can be differentiated by a coordinate or its rate",
                token.start,
                fix="write ∂L/∂x1' or diff(L, x1')",
            )
        return which[0]


def _named_rate(by: Tree) -> Tree:
    """By what is differentiated: x' of diff(L, diff(x, t))."""
    rate = inside(by)
    of = only_name(rate.children[0]) if rate.data == "rate" else None
    return by if of is None else name(of[0], rate.meta.start_pos, of[1] + rate.children[1])
