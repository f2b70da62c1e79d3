r"""Reads fractions in LaTeX, and derivatives that are written as fractions: d/dt, d²x/dt², ∂L/∂ẋ."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import replace

from lark import Tree

from lagrangian.check.reading.latex.symbols import LatexSymbols
from lagrangian.check.reading.nodes import inside, leaf, node
from lagrangian.check.reading.parser import AnswerToken
from lagrangian.read.letters import dotted, key

_ENERGIES = frozenset("TVLDℒ")
CLOSING = {"(": ")", "[": "]", "{": "}"}
"""Opening brackets, with their closing brackets."""


class LatexFractions(LatexSymbols):
    """The part of the parser that reads fractions."""

    @abstractmethod
    def _symbol(self) -> Tree:
        """Read a name with its subscript, dots, primes and powers."""

    @abstractmethod
    def _argument(self) -> Tree:
        """Read a group in braces, or one token."""

    @abstractmethod
    def _closed(self, closing: str) -> Tree:
        """Read a bracket up to its closing bracket."""

    def _frac(self, token: AnswerToken) -> Tree:
        """Read a fraction, which may be a derivative: d/dt, d²x/dt² and ∂L/∂ẋ."""
        if (twice := self._twice(*self._parts())) is not None:
            self._put_slope_of_slope(*twice)
            return self._slope_of_bracket(token)
        top, bottom = self._parts()
        order = _differential_of_time(bottom)
        if order and _begins_with_d(top):
            return self._rate_fraction(token, top, order)
        if top and bottom and self._differentiates(top, bottom):
            return self._slope_of_bracket(token)
        if top and bottom and self._is_partial(top, bottom):
            return self._partial_fraction(token)
        over, under = self._part(), self._part()
        return node("product", token.start, over, leaf("OPERATOR", "/", token.start), under)

    def _put_in_fraction(self) -> None:
        """Make a fraction of a derivative that is written on one line, if it is next: dx/dt, d²x/dt², d(…)/dt, d/dt."""
        twice = self.next.kind == "partial" and self.ahead().text in ("^", "²")
        if not (twice or _begins_with_d(self.tokens[self.i : self.i + 1])) or self.known("dt"):
            return
        over = self._end_of_differential()
        written = "".join(x.text for x in self.tokens[self.i : over])
        factor = written == "dd" and self.known("d") and not self.names.changes("d")  # d d/dt(x) is d ẋ
        if self.tokens[over].kind != "over" or factor:
            return
        for end in range(min(over + 7, len(self.tokens) - 1), over + 1, -1):
            top, bottom = self.tokens[self.i : over], self.tokens[over + 1 : end]
            if _differential_of_time(bottom) or self._is_slope(top, bottom) or self._twice(top, bottom):
                opened, closed = (AnswerToken(x, x, self.next.start, self.next.start) for x in "{}")
                frac = replace(opened, kind="frac", text="frac")
                self.tokens[self.i : end] = [frac, opened, *top, closed, opened, *bottom, closed]
                return

    def _end_of_differential(self) -> int:
        """Where d, d² or what follows it, one symbol or a bracket, ends."""
        at = self.i + 1
        at += 1 if self.tokens[at].kind == "raised" else 0
        at = self._behind(at + 1) if self.tokens[at].kind == "^" else at
        if (len(self.next.text) == 1 or self.next.kind == "partial") and self.tokens[at].kind != "over":
            while self.tokens[at].kind in ("accent", "decoration"):
                at += 1
            at = self._behind(at)
        while self.tokens[at].kind in ("_", "lowered", "primes"):
            at = self._behind(at + 1) if self.tokens[at].kind == "_" else at + 1
        return at

    def _behind(self, at: int) -> int:
        """Where a group in brackets, or one token, ends."""
        closing, depth, end = CLOSING.get(self.tokens[at].kind), 0, at
        while closing is not None and end < len(self.tokens) - 1:
            depth += (self.tokens[end].kind == self.tokens[at].kind) - (self.tokens[end].kind == closing)
            if not depth:
                break
            end += 1
        return min(end + 1, len(self.tokens) - 1)

    def _part(self) -> Tree:
        """Read one argument of a fraction: a group, or one token, or one digit of a number."""
        if self.next.kind == "number" and len(self.next.text) > 1:
            whole = self.next
            first = replace(whole, text=whole.text[0], end=whole.start + 1)
            self.tokens[self.i : self.i + 1] = [first, replace(whole, text=whole.text[1:], start=whole.start + 1)]
        return self._argument()

    def _parts(self) -> tuple[list[AnswerToken], list[AnswerToken]]:
        """The tokens of numerator and denominator, without consuming them."""
        found: list[list[AnswerToken]] = []
        at = self.i
        for _ in range(2):
            if self.tokens[at].kind != "{":
                found.append(self.tokens[at : at + 1])
                at = min(at + 1, len(self.tokens) - 1)
                continue
            depth, end = 0, at
            while self.tokens[end].kind != "end":
                depth += (self.tokens[end].kind == "{") - (self.tokens[end].kind == "}")
                if not depth:
                    break
                end += 1
            found.append(self.tokens[at + 1 : end])
            at = min(end + 1, len(self.tokens) - 1)
        return found[0], found[1]

    def _skip_part(self) -> None:
        depth = 0
        while True:
            kind = self.take().kind
            depth += (kind == "{") - (kind == "}")
            if depth <= 0 or kind == "end":
                return

    def _rate_fraction(self, token: AnswerToken, top: list[AnswerToken], order: int) -> Tree:
        inner = [x for x in top[1:] if x.kind not in ("{", "}")]
        rest = inner[2:] if inner and inner[0].kind == "^" else inner
        if len(top[0].text) == 1 and (len(top) == 1 or (top[1].kind == "^" and not rest)):
            self._skip_part()
            self._skip_part()
            return node("rate", token.start, self._differentiated(), order)
        if not self.accept("{"):
            raise self.stopped(True)
        if len(top[0].text) > 1:
            self._cut(1)
        self.take()
        if not self.accept("raised") and self.accept("^"):
            self._argument()
        self.deeper(token.start)
        inner = self.sum()
        self.opened.pop()
        if not self.accept("}"):
            raise self.stopped(False)
        self._skip_part()
        return node("rate", token.start, inner, order)

    def _differentiated(self) -> Tree:
        """Read what d/dt applies to: a bracket, a function written with its time, or all factors that follow."""
        if self.next.kind in ("(", "[", "{"):
            return self._closed(CLOSING[self.next.kind])
        self.deeper(self.next.start)
        at = self.i
        made = self.operand()
        if [x.text for x in self.tokens[self.i - 3 : self.i]] != ["(", "t", ")"]:
            self.i = at
            made = self.product()
        self.opened.pop()
        return made

    def _differentiates(self, top: list[AnswerToken], bottom: list[AnswerToken]) -> bool:
        """Whether a fraction is d/dθ or ∂/∂θ in front of a bracket."""
        over, under = ("".join(x.text for x in part if x.kind not in "{}") for part in (top, bottom))
        behind = self.i
        for _ in range(2):
            behind = self._behind(behind)
        by = under[1:] if bottom[0].kind != "partial" else "".join(x.text for x in bottom[1:])
        alone = top[0].kind == "partial" or over == "d"
        opens = self.tokens[behind].kind in ("(", "[")
        return len(top) == 1 and alone and opens and under[:1] in ("d", bottom[0].text[:1]) and self.names.changes(by)

    def _twice(
        self, top: list[AnswerToken], bottom: list[AnswerToken]
    ) -> tuple[list[AnswerToken], list[AnswerToken]] | None:
        """What a second derivative by a coordinate, d²l/dθ², differentiates, and by what; None of another fraction."""
        over, under = _without_d(top), _without_d(bottom)
        if over is None or under is None:
            return None
        of, by = _without_two(over, behind=False), _without_two(under, behind=True)
        if not of or not by or not self.names.changes("".join(x.text for x in by)):
            return None
        applied = [x.text for x in of[-len(by) - 2 :]] == ["(", *(x.text for x in by), ")"]
        return of[: -len(by) - 2] if applied else of, by

    def _put_slope_of_slope(self, of: list[AnswerToken], by: list[AnswerToken]) -> None:
        """Write ∂/∂θ (∂l/∂θ) in the place of the two parts of a fraction."""
        end = self._behind(self._behind(self.i))
        at = self.next.start

        def sign(kind: str, text: str) -> AnswerToken:
            return AnswerToken(kind, text, at, at)

        opened, closed, d = sign("{", "{"), sign("}", "}"), sign("partial", "∂")
        below = [opened, d, *by, closed]
        once = [sign("frac", "frac"), opened, d, *of, closed, *below]
        self.tokens[self.i : end] = [opened, d, closed, *below, sign("(", "("), *once, sign(")", ")")]

    def _slope_of_bracket(self, token: AnswerToken) -> Tree:
        """Read d/dθ(…), the derivative of what stands in the bracket by a coordinate."""
        self._skip_part()
        by = self._after_d()
        return node("derivative", token.start, self._closed(CLOSING[self.next.kind]), by)

    def _is_partial(self, top: list[AnswerToken], bottom: list[AnswerToken]) -> bool:
        """Whether a fraction is ∂L/∂ẋ, dL/dẋ of an energy, or dI/dθ of a quantity of the answer's own by what moves."""
        if top[0].kind == bottom[0].kind == "partial":
            return True
        over, under = ("".join(x.text for x in part if x.kind not in "{}") for part in (top, bottom))
        energy = over[:1] == under[:1] == "d" and over[1:] in _ENERGIES and len(under) > 1 and not self.known(over)
        return energy or self._is_slope(top, bottom)

    def _is_slope(self, top: list[AnswerToken], bottom: list[AnswerToken]) -> bool:
        """Whether a fraction is the slope dI/dφ of an energy or of another quantity of the answer's own."""
        over, under = (
            "".join(x.text for x in part if x.kind not in ("{", "}", "accent")).replace("'", "")
            for part in (top, bottom)
        )
        of, by = over[1:].partition("(")[0], under[1:]
        if not over[:1] == under[:1] == "d" or not self.names.changes(by) or self.known(over) or self.known(under):
            return False
        factors = self.names.known("d") and key(of) not in self.names.scope.taken and not self.names.is_own(of)
        meant = self.names.scope.meanings(of)[0] if of else ()
        own = bool(of) and not meant and not (factors and len(key(of)) > 1)
        return own or of in _ENERGIES or any(d.moving and d.name in meant for d in self.names.model.definitions)

    def _partial_fraction(self, token: AnswerToken) -> Tree:
        energy = self._after_d()
        by = self._after_d()
        return node("partial", token.start, leaf("NAME", _energy(energy), token.start), by)

    def _after_d(self) -> Tree:
        """The symbol after ∂ or d in one part of a fraction."""
        if not self.accept("{"):
            raise self.stopped(True)
        if self.next.kind == "letters" and len(self.next.text) > 1:
            self._cut(1)
        self.take()
        made = self._symbol_in_brackets()
        if not self.accept("}"):
            raise self.stopped(False)
        return made

    def _symbol_in_brackets(self) -> Tree:
        if self.next.kind in ("(", "{"):
            return inside(self._closed(CLOSING[self.next.kind]))
        return self._symbol()

    def _partial_inline(self, token: AnswerToken) -> Tree:
        """Read ∂L/∂ẋ written on one line."""
        energy = self._symbol()
        if not (self.accept("over") and self.accept("partial")):
            raise self.source.error(
                "a partial derivative is a fraction", token.start, fix="write \\frac{\\partial L}{\\partial \\dot x}"
            )
        by = self._symbol_in_brackets()
        return node("partial", token.start, leaf("NAME", _energy(energy), token.start), by)


def _energy(tree: Tree) -> str:
    of, *primes = inside(tree).children
    return dotted(f"{of}{primes[0] or '' if primes else ''}")


def _without_d(part: list[AnswerToken]) -> list[AnswerToken] | None:
    """What is behind the d or ∂ with which one part of a fraction begins; None if it does not begin so."""
    inner = list(part)
    while (
        two := next((k for k in range(len(inner) - 2) if [x.text for x in inner[k : k + 3]] == ["{", "2", "}"]), -1)
    ) > 0:
        inner[two : two + 3] = inner[two + 1 : two + 2]
    if not inner or not (inner[0].kind == "partial" or _begins_with_d(inner)):
        return None
    first, rest = inner[0], inner[1:]
    behind = first.text[1:] if first.kind != "partial" else ""
    return [replace(first, text=behind, start=first.start + 1), *rest] if behind else rest


def _without_two(part: list[AnswerToken], *, behind: bool) -> list[AnswerToken] | None:
    """The tokens without the square in front of them or ``behind`` them; None if there is none."""
    for two in (["²"], ["^", "2"]):
        n = len(two)
        if [x.text for x in (part[-n:] if behind else part[:n])] == two:
            return part[:-n] if behind else part[n:]
    return None


def _begins_with_d(part: list[AnswerToken]) -> bool:
    return bool(part) and part[0].kind in ("letters", "upright") and part[0].text.startswith("d")


def _differential_of_time(part: list[AnswerToken]) -> int:
    """1 for dt, 2 for dt², 0 for anything else."""
    text = "".join(x.text for x in part if x.kind not in ("{", "}"))
    return {"dt": 1, "dt^2": 2, "dt²": 2}.get(text, 0)
