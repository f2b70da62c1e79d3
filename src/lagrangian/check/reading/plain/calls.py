"""Reads brackets behind names in plain text: arguments, what a quantity depends on, or a factor."""

from __future__ import annotations

from lark import Tree

from lagrangian.check.reading.arguments import written
from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.nodes import leaf, name, node, only_name
from lagrangian.check.reading.parser import AnswerToken
from lagrangian.check.reading.plain.derivatives import CLOSING, PlainDerivatives
from lagrangian.check.reading.prose.words import REWRITES, Words
from lagrangian.read.letters import undotted


class PlainCalls(PlainDerivatives):
    """The part of the parser that reads brackets behind names; ``words`` are those of the answer."""

    words: Words

    def _by_time(self) -> bool:
        """Whether the bracket that is next ends as that of a derivative does, even if D is a name: D[x[t], {t, 2}]."""
        if self.next.kind != "[":
            return False
        depth, at = 0, self.i
        while self.tokens[at].kind != "end":
            depth += (self.tokens[at].kind == "[") - (self.tokens[at].kind == "]")
            if depth == 1 and self.tokens[at].kind == ",":
                return [x.text for x in self.tokens[at + 1 : at + 3]] in (["{", "t"], ["t", "]"])
            if not depth:
                return False
            at += 1
        return False

    def _called(self, token: AnswerToken) -> bool:
        """Whether the bracket after a name holds what it depends on, or its arguments, and is no factor."""
        inside = [x.text for x in self.tokens[self.i + 1 : self.i + 4]]
        if inside[:2] == ["t", ")"] or self.words.calls(token.text) or self._says(token):
            return True
        if self._of_column():
            return True
        moving = self.words.names.changes(token.text)
        if moving and self.ahead().kind == "number" and inside[1:2] == [")"]:
            return True  # x(0) is no product
        if self.i > 1 or self.words.names.scope.meanings(token.text)[0]:
            return False
        end = self.i
        while self.tokens[end].kind not in (")", "end"):
            end += 1
        listed = all(x.kind in ("name", "primes", ",", "(") for x in self.tokens[self.i : end])
        return listed and self.tokens[end + 1 : end + 2] != [] and self.tokens[end + 1].kind == "="

    def _rewrites(self, token: AnswerToken) -> bool:
        """Whether the next bracket holds what a program writes in another way: simplify(…), Expand[…]."""
        return self.next.kind in CLOSING and token.text in REWRITES and not self.words.known(token.text)

    def _of_column(self) -> bool:
        """Whether the next bracket only holds the column of coordinates, as in M(q) q'', C(q, q') and C(q, qdot)."""
        at = self.i + 1
        while self.tokens[at].kind in ("name", "primes", ","):
            token = self.tokens[at]
            stems = {undotted(token.text)[0], *(stem for _, stem in spelled_rates(token.text))}
            if token.kind == "name" and (
                not stems & {"q", "xi", "ξ"} or self.words.names.scope.meanings(token.text)[0]
            ):
                return False
            at += 1
        return at > self.i + 1 and self.tokens[at].kind == ")"

    def _says(self, token: AnswerToken) -> bool:
        """Whether the answer says that a quantity depends on what is in this bracket: I(r) = …"""
        end = self.source.text.find(")", self.next.start) + 1
        return written(token.text + self.source.text[self.next.start : end]) in self.words.names.dependents

    def _call(self, token: AnswerToken) -> Tree:
        stated = self._says(token) or self._of_column()
        arguments = self._arguments()
        if len(arguments) == 1 and only_name(arguments[0]) == ("t", 0):  # x1(t)
            return name(token.text, token.start)
        depends = arguments and all(only_name(x) is not None for x in arguments) and self.next.kind == "="
        if (stated or (depends and token is self.tokens[0])) and not self.words.is_function(token.text):  # V(theta) = …
            return name(token.text, token.start)
        return node("call", token.start, leaf("NAME", token.text, token.start), *arguments)

    def _arguments(self) -> list[Tree]:
        closing = CLOSING[self.next.kind]
        start = self.take().start
        self.deeper(start)
        arguments = [] if self.next.kind == closing else [self.argument()]
        while self.accept(","):
            arguments.append(self.argument())
        if not self.accept(closing):
            raise self.stopped(False)
        self.opened.pop()
        return arguments
