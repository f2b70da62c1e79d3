"""Answers in plain text: the grammar of model files, with the ways people and programs write derivatives and products.

x1'  x1''  ẋ₁  dx1/dt  d2x1/dt2  d^2 x1/dt^2  d/dt(…)  d(…)/dt  diff(…, t, 2)  Derivative(x1(t), t)  ddot(x1)  x1''[t]
∂L/∂x1'  dL/dx1'  diff(L, x1')     [a, b; c, d]  [[a, b], [c, d]]  Matrix([a, b])     sin^2(x)  sin² x  Sin[x]
m L^2 phi''  k(x1 - x2)  2mgL      Eq(a, b)
"""

from __future__ import annotations

from functools import partial

from lark import Tree

from lagrangian.check.reading.multiple_angles import is_multiple
from lagrangian.check.reading.name_patterns import RAISED
from lagrangian.check.reading.nodes import (
    Node,
    column,
    diagonal,
    is_column,
    is_matrix,
    leaf,
    matrix,
    matrix_entries,
    name,
    node,
    number,
    only_name,
    wrapped,
)
from lagrangian.check.reading.parser import AnswerToken
from lagrangian.check.reading.plain.calls import PlainCalls
from lagrangian.check.reading.plain.conditions import AND, NOT, OR
from lagrangian.check.reading.plain.derivatives import CLOSING, DIFFERENTIATE, DOTS, ORDERS, PARTIAL
from lagrangian.check.reading.plain.tokens import DETERMINANTS, TOKEN, VARIATION, is_varied, tokenize
from lagrangian.check.reading.programs.residuals import CALLED
from lagrangian.check.reading.prose.words import Words, function_of
from lagrangian.errors import ParseError
from lagrangian.quantities.source import Source
from lagrangian.read.explain import explain
from lagrangian.read.letters import dotted, undotted

_EQUALITIES = frozenset(["Eq", "Equality", "Equal"])
_BEGINS = frozenset(["number", "fraction", "name", "(", "rate", "rate2", "ddt", "ddt2", "partial", "partial2"])
_NUMBERS = frozenset(["number", "fraction"])
MAX_RATES = 8
"""The most signs d/dt in front of each other."""


class PlainParser(PlainCalls):
    """Parses one statement of plain text. A product without a sign needs factors that can be told apart."""

    def __init__(self, source: Source, words: Words) -> None:
        super().__init__(source, tokenize(source, words))
        self.words = words
        self._bars = 0

    def side_by_side(self) -> bool:
        """Whether the next token begins a factor: known names, numbers and brackets may be next to each other."""
        token = self.next
        before = self.tokens[self.i - 1] if self.i else token
        if token.kind == "[":
            return before.kind in ("]", ")", "name", "primes", "number", "fraction", "raised")
        if token.text == "|":
            return not self._bars
        if token.text == PARTIAL:
            return self.ahead().kind in ("(", "over")
        if token.kind not in _BEGINS or (token.kind in _NUMBERS and before.kind in _NUMBERS):
            return False
        names = [x for x in (before, token) if x.kind == "name"]
        if any(x.text in (*OR, *AND, *NOT) for x in names):
            return False
        return all(self.words.readable(x.text) for x in names)

    def stays_below(self, begins: int) -> bool:
        """Whether the next factor belongs to the denominator: in g/2L, which is written in one piece, but not in 1/2 m.

        The other reading is tried if an answer is not right with this one.
        """
        last = self.tokens[self.i - 1]
        moves = self.next.kind == "name" and self.words.names.changes(undotted(self.next.text)[0])
        if last.kind == ")" or moves or (self.next.kind == "name" and self.words.is_function(self.next.text)):
            return False
        self.words.asked = True
        numbers = self.tokens[begins].kind == "number" and self.tokens[begins - 2].kind == "number"
        likely = self.next.start == last.end and not numbers
        return likely != self.words.flipped

    def _moves(self, called: str) -> bool:
        return self.words.names.changes(undotted(called)[0])

    def stopped(self, wants_operand: bool) -> ParseError:
        """Raise the error that explains what is wrong at the next token."""
        token = self.next
        if (error := self.unclosed()) is not None:
            return error
        if token.kind == "=":
            return self.source.error("one side of '=' is empty", token.start, fix="write 0 for a side that is zero")
        if token.kind in ("[", "]"):
            return self.source.error(
                f"found '{token.text}' here", token.start, fix="a matrix is [a, b; c, d], a column [a; b]"
            )
        return explain(self.source, token.start, wants_operand)

    def sides(self) -> list[Tree]:
        """Read sums with = between them, or Eq(a, b); what a program calls an equation is ignored: eq1 = a == b."""
        texts = [x.text for x in self.tokens]
        if texts[0] in self.words.names.residuals and "=" in (texts[1:2] + texts[4:5]) and texts.count("=") == 1:
            self.i = texts.index("=") + 1
            return [number("0", self.tokens[0].start), *super().sides()]
        called = self.tokens[0].kind == "name" and texts[1:2] == ["="]
        named = called and CALLED.fullmatch(texts[0]) and not self.words.names.known(texts[0])
        named = named and (texts.count("=") == 2 or self.words.count(texts[0]) == 1)
        if called and ("==" in texts or texts[2] in _EQUALITIES or named):
            self.i = 2
        token = self.next
        if token.text not in _EQUALITIES or self.ahead().kind not in CLOSING or self.words.is_name(token.text):
            return super().sides()
        self.take()
        found = self._arguments()
        if self.next.kind != "end" or len(found) != 2:
            raise self.source.error("Eq takes two sides", token.start, fix="write Eq(left, right), or left = right")
        return found

    # -- operands --------------------------------------------------------------------------------------------------

    def operand(self) -> Tree:
        """Read a postfix expression and its powers."""
        start = self.next.start
        children: list[Node] = [self._postfix()]
        while (power := self.accept("power")) is not None:
            if self.next.kind == "name" and self.next.text == "T" and self._listed(children[0]):
                self.take()
                if is_matrix(children[0]) and not is_column(children[0]):
                    children = [wrapped("transpose", start, children[0])]
                continue  # a list in brackets is already a column
            squared = self.next.kind == "number" and self.next.text.isdigit()  # e² is the square of a letter
            alone = only_name(children[0]) == ("e", 0) and len(children) == 1 and not squared
            if alone and not self.words.is_name("e"):
                sign = self._sign()
                exponent = node("signed", power.start, sign, self._postfix())
                children = [node("call", start, leaf("NAME", "exp", start), exponent)]
                continue
            children += [leaf("POWER", "^", power.start), self._sign(), self._postfix()]
        return node("power", start, *children)

    def _listed(self, made: Tree) -> bool:
        """Whether what was just read is a list in brackets, before ^T."""
        return self.tokens[self.i - 2].kind == "]" or is_matrix(made)

    def _postfix(self) -> Tree:
        start = self.next.start
        made = self._atom()
        while True:
            if (primes := self.accept("primes")) is not None:
                made = self._primed(made, primes)
            elif (raised := self.accept("raised")) is not None:
                made = node("postfix", start, made, leaf("SUPERSCRIPT", raised.text, raised.start))
            elif self._of_time():
                del self.tokens[self.i : self.i + 3]
            else:
                return made

    def _of_time(self) -> bool:
        """Whether (t) or [t] is next: x1''(t) is x1''."""
        return [x.text for x in self.tokens[self.i : self.i + 3]] in (["(", "t", ")"], ["[", "t", "]"])

    def _atom(self) -> Tree:
        token = self.next
        match token.kind:
            case "number":
                self.take()
                return number(token.text, token.start)
            case "fraction":
                self.take()
                return node("number", token.start, leaf("FRACTION", token.text, token.start))
            case "(":
                return self._bracket()
            case "[":
                return self._matrix()
            case "name":
                return self._named()
            case "rate" | "rate2":
                return self._fraction_rate()
            case "other" if token.text == "|":
                return self._absolute()
            case "other" if token.text == PARTIAL and self.ahead().kind in ("(", "over"):
                return self._partial_of_bracket(self.take())
            case "ddt" | "ddt2":
                run = self.tokens[self.i : self.i + MAX_RATES + 1]
                if len(run) > MAX_RATES and all(x.kind in ("ddt", "ddt2") for x in run):
                    raise self.source.error(f"more than {MAX_RATES} times d/dt", token.start, code="E703")
                self.take()
                return node("rate", token.start, self._postfix(), 1 if token.kind == "ddt" else 2)
            case "partial":
                self.take()
                found = TOKEN.match(self.source.text, token.start)
                assert found is not None
                by = name(found["by"], found.start("by"), sum(ORDERS[c] for c in found["dots"]))
                return node("partial", token.start, leaf("NAME", dotted(found["what"]), token.start), by)
            case "partial2":
                return self._second_slope(self.take())
        raise self.stopped(True)

    def _absolute(self) -> Tree:
        """Read |x|, an absolute value or the length of a vector."""
        start = self.take().start
        self.deeper(start)
        self._bars += 1
        inner = self.sum()
        if self.next.text != "|":
            raise self.source.error("this '|' is never closed", start, fix="add the missing '|', or write abs(x)")
        self.take()
        self._bars -= 1
        self.opened.pop()
        return node("call", start, leaf("NAME", "abs", start), inner)

    def _matrix(self) -> Tree:
        """Read [a, b; c, d] or [[a, b], [c, d]]; a plain list is a column; a single entry is itself."""
        start = self.take().start
        self.deeper(start)
        entries: list[list[Tree | None]] = [[]]
        lists = self.next.kind == "["
        while True:
            entries[-1].append(self._entry())
            if self.accept(","):
                continue
            if self.accept(";"):
                entries.append([])
                continue
            if not self.accept("]"):
                raise self.stopped(False)
            break
        self.opened.pop()
        token = self.tokens[self.i - 1]
        rows = [[self.mirrored(entries, i, j, token) for j in range(len(row))] for i, row in enumerate(entries)]
        if len(rows) == 1:
            inner = rows[0]
            if len(inner) == 1:
                return inner[0]
            nested = [matrix_entries(x) for x in inner]
            if not lists:
                return column(start, inner)
            rows = [n if n is not None else [x] for n, x in zip(nested, inner, strict=True)]
        return matrix(start, rows)

    def _entry(self) -> Tree | None:
        """Read an entry of a matrix; None for one that is the same as on the other side of the diagonal."""
        if self.accept("sym"):
            return None
        return self._matrix() if self.next.kind == "[" else self.sum()

    # -- names and calls -------------------------------------------------------------------------------------------

    def _named(self) -> Tree:
        token = self.take()
        opens = self.next.kind in ("(", "[")
        if token.text in DIFFERENTIATE and opens and (not self.words.is_name(token.text) or self._by_time()):
            return self._differentiated(token)
        if token.text in DOTS and not self.words.is_name(token.text):
            if self.next.kind == "(":
                return node("rate", token.start, self._bracket(), DOTS[token.text])
            if self.next.kind == "name" and self.ahead().kind != "primes":  # ddot x
                below = self.take()
                return name(below.text, below.start, DOTS[token.text])
        whole = token.text in ("Matrix", "Hold", "HoldForm") and opens and not self.words.is_name(token.text)
        if whole or self._rewrites(token):
            return self._bracket_of_one()
        if token.text in DETERMINANTS and not self.words.is_name(token.text):
            called = leaf("NAME", "det", token.start)
            return node("call", token.start, called, self._bracket() if self.next.kind == "(" else self._atom())
        if token.text == "diag" and self.next.kind == "(" and not self.words.is_name("diag"):
            listed = self._arguments()
            return diagonal(token.start, matrix_entries(listed[0]) or listed)
        if (
            token.text == "d"
            and self.next.kind in ("(", "raised", "power")
            and (rate := self._d_of_bracket(token)) is not None
        ):
            return rate
        if token.text == "d" and self.next.kind == "over" and (made := self._operator_by_coordinate(token)) is not None:
            return made
        if token.text[0] == VARIATION and is_varied(token.text, self.words):
            return wrapped("variation", token.start, name(token.text[1:], token.start))
        if self.words.is_function(token.text):
            return self._function(token)
        if self.next.kind == "(" and self._called(token):
            return self._call(token)
        return name(token.text, token.start)

    def _bracket_of_one(self) -> Tree:
        """Read Matrix([[a, b], [c, d]]), or the first argument of a function that writes it in another way."""
        found = self._arguments()
        if not found:
            raise self.stopped(True)
        return found[0]

    def _function(self, token: AnswerToken) -> Tree:
        """Read sin(x), sin^2(x), sin² x, Sin[x] or sin 2 x: without brackets, numbers and one factor."""
        called = function_of(token.text) or token.text
        raised = self.accept("power", "raised")
        exponent = self._exponent(token, raised) if raised is not None else None
        if self.next.kind in ("(", "["):
            arguments = self._arguments()
            if len(arguments) == 1:
                arguments = [self.with_multiple(arguments[0], partial(is_multiple, names=self.words.names))]
        elif self.next.kind == "minus" or self.next.kind not in _BEGINS - {"("}:
            raise self.stopped(False) if raised is not None else self._without_argument(token)
        else:
            arguments = [self._bare_argument(token)]
        call = node("call", token.start, leaf("NAME", called, token.start), *arguments)
        if exponent is None or raised is None:
            return call
        power = leaf("POWER", "^", raised.start)
        return node("power", token.start, call, power, None, number(exponent, raised.start))

    def _without_argument(self, token: AnswerToken) -> ParseError:
        shown = "-x" if self.next.kind == "minus" else "x"
        return self.source.error(
            f"the argument of {token.text} is missing", token.start, fix=f"write {token.text}({shown})"
        )

    def _exponent(self, token: AnswerToken, raised: AnswerToken) -> str:
        """The exponent between a function and its argument: sin^2(x), sin²(x)."""
        sign, exponent = None, ""
        if raised.kind == "power":
            opened = self.accept("(")
            sign = self.accept("minus")
            digits = self.accept("number")
            exponent = "" if digits is None or (opened and not self.accept(")")) else digits.text
        else:
            exponent = raised.text.translate(RAISED).lstrip("+")
        if sign or exponent.startswith("-"):
            raise self.source.error(
                f"{token.text} to a negative power can mean its inverse or its reciprocal",
                token.start,
                fix=f"write a{token.text}(x) for the inverse, 1/{token.text}(x) for the reciprocal",
            )
        if not exponent:
            raise self.stopped(False)
        return exponent

    def _bare_argument(self, token: AnswerToken) -> Tree:
        """Read numbers, then one factor; a constant and t count as one factor."""
        start = self.next.start
        children: list[Node] = []
        while True:
            if children:
                children.append(leaf("OPERATOR", "*", self.next.start))
            kind, text = self.next.kind, self.next.text
            if kind == "name" and self.words.is_function(text):
                raise self._without_argument(token)
            children.append(self.operand())
            if kind in ("number", "fraction"):
                if self.next.kind in ("name", "(", "rate"):
                    continue
                self.accept("times") if self.next.kind == "times" and self.ahead().kind == "name" else None
                if self.next.kind in ("name", "("):
                    continue
                break
            if self.next.kind == "name" and self.next.text == "t":
                children += [leaf("OPERATOR", "*", self.next.start), self.operand()]
            elif kind == "name":
                children += self.multiplied(children[-1], partial(is_multiple, names=self.words.names))
            break
        tree = node("product", start, *children)
        while self._goes_on():
            sign = self.take()
            operator = leaf("SIGN", "+" if sign.kind == "plus" else "-", sign.start)
            tree = node("sum", start, None, tree, operator, self.operand())
        if self.next.kind in ("times", "over"):
            end = self.tokens[self.i - 1].end
            inner = self.source.text[start:end].strip()
            read = f"{token.text} {inner}{self.next.text}… was read as {token.text}({inner})."
            self.words.names.notes.setdefault(read)
        return tree

    def _goes_on(self) -> bool:
        """Whether an angle that is added without a gap is read as part of an argument without brackets: cosθ1-θ2."""
        last, sign, more = self.tokens[self.i - 1], self.next, self.ahead()
        joined = last.end == sign.start and sign.end == more.start and sign.kind in ("plus", "minus")
        moving = [x.kind == "name" and self.words.names.changes(x.text) for x in (last, more)]
        if not joined or not all(moving):
            return False
        self.words.summed_asked = True
        return self.words.summed
