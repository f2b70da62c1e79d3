r"""Reads symbols in LaTeX: letters with subscripts, dots and stars; a run of letters is split into known names.

A run that cannot be split into known names, but is similar to one, is a misspelled name.
"""

from __future__ import annotations

from dataclasses import replace

from lark import Tree

from lagrangian.check.reading.arguments import written
from lagrangian.check.reading.latex.tokens import tokenize
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.nodes import only_name
from lagrangian.check.reading.parser import AnswerToken, Parser
from lagrangian.check.reading.prose.splits import splits
from lagrangian.model.names import MAX_LENGTH
from lagrangian.quantities.source import Source
from lagrangian.read.letters import key, normal


class LatexSymbols(Parser):
    """The part of the parser that reads names."""

    def __init__(self, source: Source, names: Names) -> None:
        super().__init__(source, tokenize(source))
        self.known, self.names = names.known, names

    def _base(self) -> tuple[str, int, int]:
        """Read a Latin or Greek letter or a word, dotted or decorated: its name, its dots, and where it begins."""
        token = self.take()
        if token.kind in ("accent", "decoration"):
            self.deeper(token.start)
            braced = self.accept("{")
            if self.next.kind not in ("letters", "symbol", "upright", "accent", "decoration"):
                raise self.stopped(True)
            if not braced and self.next.kind == "letters" and len(self.next.text) > 1:
                self._cut(1)
            base, order, _ = self._base()
            while braced and self.next.kind in ("_", "lowered"):
                base = f"{base}_{self._subscript()}" if self.next.kind == "_" else base + normal(self.take().text)
            if braced and not self.accept("}"):
                raise self.stopped(False)
            self.opened.pop()
            if token.kind == "accent":
                return base, order + int(token.text), token.start
            return (base if base.startswith("bold ") else f"{base}_{token.text}"), order, token.start
        if token.kind != "letters":
            return token.text, 0, token.start
        self.i -= 1
        if (end := self._whole_name()) > self.i + 1:
            base = "".join(x.text for x in self.tokens[self.i : end])
            self.i = end
            return base, 0, token.start
        self._cut(self._first_name(token))
        token = self.take()
        if self._digits_belong(token):
            return token.text + self.take().text, 0, token.start
        return token.text, 0, token.start

    def _is_letter(self, base: str) -> bool:
        """Whether a sign that may be an operator is a name of the system, or one that the answer defines."""
        return self.known(base) or key(base) in self.names.scope.taken

    def _is_squared(self) -> bool:
        """Whether the exponent that follows is a number alone: then e is a letter."""
        kinds = [x.kind for x in self.tokens[self.i + 1 : self.i + 4]]
        return kinds[:1] == ["number"] or kinds == ["{", "number", "}"]

    def _of_work(self) -> bool:
        r"""Whether a virtual work is stated: there δ before what moves is no letter, \delta W = \tau\,\delta\delta."""
        sign, work = self.tokens[0].text, self.tokens[min(1, len(self.tokens) - 1)].text
        return sign == "delta" and work in ("W", "A") and not self._is_letter(work)

    def _moves(self, of: Tree) -> bool:
        """Whether a tree is the name of what moves, or of a virtual work."""
        named = str((only_name(of) or ("",))[0])
        return self.names.changes(named) or (named[:1] in ("W", "A") and not self._is_letter(named))

    def _whole_name(self) -> int:
        """The token behind a name of the system with digits between its letters, x2r; the next one if there is none."""
        end = self.i + 1
        while self.tokens[end].kind in ("letters", "number") and self.tokens[end].start == self.tokens[end - 1].end:
            end += 1
        while end > self.i + 2:
            if "".join(x.text for x in self.tokens[self.i : end]) in self.names.model.symbols:
                return end
            end -= 1
        return self.i + 1

    def _digits_belong(self, token: AnswerToken) -> bool:
        """Whether the number directly after a letter is part of its name: x1."""
        behind = self.next
        if behind.kind != "number" or behind.start != token.end or not behind.text.isdigit():
            return False
        return self.known(token.text + behind.text) or not self.known(token.text)

    def _first_name(self, token: AnswerToken) -> int:
        """The length of the first name in a run of letters: the longest known name together with what follows,
        otherwise 1."""
        run = token.text
        ending = ""
        if self.ahead().kind == "_":
            at = self.i
            self.i += 1
            ending = "_" + self._subscript()
            self.i = at
        elif self.ahead().kind == "number" and self.ahead().start == token.end:
            ending = self.ahead().text
        elif self.ahead().kind == "lowered":
            ending = normal(self.ahead().text)
        if run + ending in self.names.model.symbols or self.names.misspelled(run):
            return len(run)
        found = splits(run, lambda part, last, _: self.known(part + ending if last else part))
        if len(found) > 1:
            one, other = (r" \cdot ".join(x) for x in found[:2])
            what = f"'{run}' can mean {one} or {other}"
            raise self.source.error(what, token.start, fix="write the product that you mean with spaces", code="E402")
        if found:
            return len(found[0][0])
        for length in range(len(run), 0, -1):
            candidate = run[:length] + (ending if length == len(run) else "")
            if self.known(candidate) or (length == len(run) and length > 1 and self.known(run)):
                return length
        return 1

    def _cut(self, length: int) -> None:
        """Split the next run of letters after ``length`` of them."""
        token = self.next
        if length < len(token.text):
            middle = token.start + length
            first = replace(token, text=token.text[:length], end=middle)
            self.tokens[self.i : self.i + 1] = [first, replace(token, text=token.text[length:], start=middle)]

    def _subscript(self) -> str:
        """Read the letters and digits after _, joined; long ones are in braces."""
        underscore = self.take()
        if self.next.kind != "{":
            if self.next.kind not in ("letters", "number", "symbol", "upright"):
                raise self.stopped(True)
            if self.next.kind == "letters":
                self._cut(self._subscript_length())
            return self.take().text.removeprefix("bold ")
        text, depth = "", 0
        while True:
            token = self.take()
            if token.kind in ("letters", "number", "symbol", "upright", "lowered", "function"):
                text += normal(token.text)
            elif token.kind == "{":
                depth += 1
            elif token.kind == "}":
                depth -= 1
            elif token.kind not in (",", "_"):
                raise self.source.error(
                    "a subscript holds letters and digits only",
                    underscore.start,
                    fix="write x_1, x_{2r}, L_{\\mathrm{a}}",
                )
            if not depth:
                return text

    def _subscript_length(self) -> int:
        """How many of the letters after _ belong to it: one if that makes a known name, as TeX does, otherwise all."""
        letters = self.next.text
        at = self.i - 2  # before _, which was taken last
        while at >= 0 and self.tokens[at].kind == "}":
            at -= 1
        before = self.tokens[at].text[-MAX_LENGTH:] if at >= 0 else ""
        for length in (len(letters), 1):
            if length <= MAX_LENGTH and any(
                self._has(f"{before[at:]}_{letters[:length]}") for at in range(len(before))
            ):
                return length
        return len(letters)

    def _has(self, indexed: str) -> bool:
        """Whether the system or the answer has a name with this index."""
        return self.known(indexed) or key(indexed) in self.names.scope.taken

    def _raised_primes(self) -> int:
        r"""Count and consume the primes in ^\prime or ^{\prime\prime}."""
        at = self.i + 1
        braced = self.tokens[at].kind == "{"
        at += braced
        count = 0
        while self.tokens[at].kind == "prime":
            count, at = count + 1, at + 1
        if not count or (braced and self.tokens[at].kind != "}"):
            return 0
        self.i = at + braced
        return count

    def _depends(self, base: str) -> int:
        """The number of tokens that are the arguments of a quantity, not a factor: V(θ) = …, C(q, q̇); 0 if there are
        none."""
        if self.next.kind != "(":
            return 0
        plain, commas, end = True, 0, self.i + 1
        while self.tokens[end].kind not in (")", "end"):
            kind = self.tokens[end].kind
            commas += kind == ","
            plain = plain and kind in (
                "letters",
                "symbol",
                "upright",
                "accent",
                "_",
                "{",
                "}",
                "number",
                ",",
                "lowered",
            )
            end += 1
        if not plain or end == self.i + 1 or self.tokens[end].kind == "end":
            return 0
        stated = self.tokens[end + 1].kind == "="
        stated = stated or self._says(base, self.next.start, self.tokens[end].end)
        inside = self.tokens[self.i + 1].text.lstrip("\\")
        column = end == self.i + 2 and inside in ("q", "xi", "ξ") and not self.names.scope.meanings(inside)[0]
        return end + 1 - self.i if commas or stated or column or base.startswith("bold ") else 0

    def _says(self, base: str, start: int, end: int) -> bool:
        """Whether the answer states this quantity with these arguments elsewhere."""
        return written(base) + written(self.source.text[start:end]) in self.names.dependents

    def _starred(self) -> bool:
        """Whether ^* is next, as in T^*; if so, consume it."""
        texts = [x.text for x in self.tokens[self.i + 1 : self.i + 4]]
        for form in (["*"], ["ast"], ["star"], ["{", "*", "}"], ["{", "ast", "}"], ["{", "star", "}"]):
            if texts[: len(form)] == form:
                self.i += 1 + len(form)
                return True
        return False

    def _of_time(self) -> bool:
        r"""Whether (t) is next: \theta(t), or \theta{\left(t \right)} as SymPy writes it."""
        texts = [x.text for x in self.tokens[self.i : self.i + 5]]
        if texts == ["{", "(", "t", ")", "}"]:
            del self.tokens[self.i], self.tokens[self.i + 3]
            return True
        return texts[:3] == ["(", "t", ")"]
