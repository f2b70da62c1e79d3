r"""Parses one statement of an answer in LaTeX. Products may be implicit; ``mgL`` is split into names of the model.

A function without parentheses applies to the next factor, with the numbers before it: ``\sin 2\theta \dot\theta`` is
sin(2θ) θ̇. A constant followed by t counts as one factor there: ``\cos\omega t``.
"""

from __future__ import annotations

from functools import partial

from lark import Tree

from lagrangian.check.reading.latex.quotients import CLOSING, LatexFractions
from lagrangian.check.reading.latex.tokens import DETERMINANT, is_determinant
from lagrangian.check.reading.multiple_angles import is_multiple
from lagrangian.check.reading.name_patterns import RAISED
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.nodes import (
    Node,
    column,
    diagonal,
    inside,
    is_column,
    leaf,
    matrix,
    matrix_entries,
    name,
    node,
    number,
    wrapped,
)
from lagrangian.check.reading.parser import AnswerToken
from lagrangian.errors import ParseError
from lagrangian.model.names import FUNCTIONS
from lagrangian.quantities.source import Source, shown
from lagrangian.read.letters import normal

_ORDERS = {"'": 1, "’": 1, "′": 1, "″": 2, "‴": 3}
_BEGINS_LISTED = "number fraction letters symbol upright accent decoration function frac sqrt { ( [ abs( begin partial"
_BEGINS = frozenset(_BEGINS_LISTED.split())
_INVERSE = {"sin": "asin", "cos": "acos", "tan": "atan", "sinh": "asinh", "cosh": "acosh", "tanh": "atanh"}


class LatexParser(LatexFractions):
    """Parses one statement."""

    def __init__(self, source: Source, names: Names) -> None:
        super().__init__(source, names)
        self._bars = 0
        self._blanks = False
        """Whether an entry of the matrix that is read was left empty."""

    def side_by_side(self) -> bool:
        """Any operand may follow another; a number may not follow a number."""
        if self.next.kind == "number" and self.i and self.tokens[self.i - 1].kind == "number":
            two = f"{self.tokens[self.i - 1].text} {self.next.text}"
            raise self.source.error(
                f"two numbers stand next to each other, {shown(two)}", self.next.start, fix="write \\cdot"
            )
        return self.next.kind in _BEGINS or (self.next.kind == "|" and not self._bars)

    def stopped(self, wants_operand: bool) -> ParseError:
        """Raise the error that explains what is wrong at the next token."""
        if (error := self.unclosed()) is not None:
            return error
        token = self.next
        after = f" after {shown(self.tokens[self.i - 1].text)}" if self.i else ""
        if token.kind == "end":
            what, fix = f"the formula ends{after}", "a number, a symbol or a bracket must follow, or a brace be closed"
        elif token.kind == "=":
            what, fix = "one side of '=' is empty", "write 0 for a side that is zero"
        elif token.kind in (")", "]", "}", ")abs", "end_"):
            what = f"found {shown(token.text)}{after}"
            fix = "something must stand before it" if wants_operand else "it closes nothing here: check the brackets"
        elif token.kind in ("&", "rowsep"):
            what, fix = f"found {shown(token.text)} here", "it separates the entries of a matrix"
        elif token.kind in ("^", "_"):
            what = f"found {shown(token.text)}{after}"
            fix = "two exponents or subscripts in a row need braces: {x^a}^b"
        elif token.kind == ",":
            what, fix = "found ',' inside a formula", "write a decimal point; write equations on rows of their own"
        else:
            what, fix = (
                f"found {shown(token.text)}{after}",
                "a number, a symbol, a function or a bracket must stand here",
            )
        return self.source.error(what, token.start, fix=fix)

    # -- operands --------------------------------------------------------------------------------------------------

    def operand(self) -> Tree:
        """Read an operand with its primes and powers."""
        start = self.next.start
        self._put_in_fraction()
        if self.next.kind in ("letters", "symbol", "upright", "accent", "decoration"):
            return self._symbol()
        return self._powered(self._atom(), start)

    def _powered(self, made: Tree, start: int) -> Tree:
        """Read what follows an operand: primes, powers, a transposition."""
        raised = False
        while True:
            if (primes := self.accept("primes")) is not None:
                made = node("rate", primes.start, made, sum(_ORDERS[c] for c in primes.text))
            elif (digits := self.accept("raised")) is not None:
                made = node("postfix", start, made, leaf("SUPERSCRIPT", digits.text, digits.start))
            elif self.next.kind == "^" and inside(made).data == "matrix" and self._transposed():
                made = made if is_column(made) else wrapped("transpose", start, made)  # (x, y) is a column with ^T too
            elif self.next.kind == "^" and not raised:
                power = self.take()
                made = node("power", start, made, leaf("POWER", "^", power.start), None, self._argument())
                raised = True
            else:
                return made

    def _transposed(self) -> bool:
        r"""Whether ^T or ^\top is next; if so, consume it."""
        texts = [x.text for x in self.tokens[self.i + 1 : self.i + 4]]
        for form in (["T"], ["top"], ["intercal"], ["{", "T", "}"], ["{", "top", "}"]):
            if texts[: len(form)] == form:
                self.i += 1 + len(form)
                return True
        return False

    def _argument(self) -> Tree:
        r"""Read a group in braces, or one token: the argument of ^, \frac, \sqrt."""
        if self.next.kind == "{":
            return self._closed("}")
        if self.next.kind in ("number", "fraction"):
            token = self.take()
            return number(token.text, token.start) if token.kind == "number" else self._fraction(token)
        if self.next.kind == "minus":  # x^-1
            sign = self.take()
            return node("signed", sign.start, leaf("SIGN", "-", sign.start), self._argument())
        if self.next.kind in _BEGINS - {"(", "["}:
            if self.next.kind == "letters":  # \frac m2 is m/2 beside a mass m2
                self._cut(1)
                return name((letter := self.take()).text, letter.start)
            return self._atom()
        raise self.stopped(True)

    def _closed(self, closing: str) -> Tree:
        """Read a bracket up to its closing bracket."""
        start = self.take().start
        self.deeper(start)
        bars, self._bars = self._bars, 0
        listed = [self.sum()]
        while closing in (")", "]") and self.accept(","):
            listed.append(self.sum())
        if not self.accept(closing):
            raise self.stopped(False)
        self._bars = bars
        self.opened.pop()
        return listed[0] if len(listed) == 1 else column(start, listed)

    def _atom(self) -> Tree:
        token = self.next
        match token.kind:
            case "number":
                self.take()
                return number(token.text, token.start)
            case "fraction":
                return self._fraction(self.take())
            case "{":
                return self._closed("}")
            case "(":
                return self._closed(")")
            case "[":
                return self._closed("]")
            case "abs(" | "|":
                return self._absolute(token)
            case "function":
                return self._function(self.take())
            case "frac":
                return self._frac(self.take())
            case "sqrt":
                return self._root(self.take())
            case "begin":
                return self._matrix(self.take())
            case "partial":
                return self._partial_inline(self.take())
            case "letters" | "symbol" | "upright" | "accent" | "decoration":
                base, primes, at = self._base()
                return name(base, at, primes)
        raise self.stopped(True)

    @staticmethod
    def _fraction(token: AnswerToken) -> Tree:
        return node("number", token.start, leaf("FRACTION", token.text, token.start))

    def _absolute(self, token: AnswerToken) -> Tree:
        if token.kind == "abs(":
            inner = self._closed(")abs")
        else:
            self.take()
            self.deeper(token.start)
            self._bars += 1
            inner = self.sum()
            if not self.accept("|"):
                raise self.source.error("this '|' is never closed", token.start, fix="add the missing '|'")
            self._bars -= 1
            self.opened.pop()
        return node("call", token.start, leaf("NAME", "abs", token.start), inner)

    # -- symbols -----------------------------------------------------------------------------------------------------

    def _symbol(self) -> Tree:
        """Read a name with its subscript, dots, primes and powers, or a product under dots."""
        start = self.next.start
        if self.next.kind == "accent" and (over := self._dots_over_more()) is not None:
            return self._powered(over, start)
        base, order, start = self._base()
        if base == "diag" and self.next.kind == "(" and not self.known("diag"):
            made = inside(self._closed(")"))
            return diagonal(start, matrix_entries(made) or [made])
        if base == "delta" and self.next.kind in ("letters", "symbol", "upright", "("):
            varied, at = not self._is_letter(base), self.i
            if varied or self._of_work():
                of = self._symbol_in_brackets()
                if varied or self._moves(of):
                    return wrapped("variation", start, of)
            self.i = at
        if base == "e" and self.next.kind == "^" and not self._is_letter(base) and not self._is_squared():
            self.take()
            return node("call", start, leaf("NAME", "exp", start), self._argument())
        exponent: Node = None
        while True:
            if self.next.kind == "_":
                base = f"{base}_{self._subscript()}"
            elif (lowered := self.accept("lowered")) is not None:
                base += normal(lowered.text)
            elif (primes := self.accept("primes")) is not None:
                order += sum(_ORDERS[c] for c in primes.text)
            elif self.next.kind == "^" and (more := self._raised_primes()):
                order += more
            elif self.next.kind == "^" and (base == "bold T" or base.partition("_")[0] == "T") and self._starred():
                continue
            elif self.next.kind == "^" and exponent is None and self.ahead().kind != "accent":
                exponent = (self.take(), self._argument())
            elif base not in FUNCTIONS and self._of_time():
                self.i += 3
            elif base not in FUNCTIONS and (count := self._depends(base)):
                self.i += count
            else:
                break
        made = name(base, start, order)
        if exponent is not None:
            made = node("power", start, made, leaf("POWER", "^", exponent[0].start), None, exponent[1])
        return self._powered(made, start) if self.next.kind == "raised" else made

    def _dots_over_more(self) -> Tree | None:
        """Read dots over a bracket or over a product in braces; return None if they are over a single symbol."""
        at = self.i
        if self.ahead().kind != "{":
            return None
        depth, end = 0, at + 1
        while True:
            kind = self.tokens[end].kind
            depth += (kind == "{") - (kind == "}")
            if kind == "end" or not depth:
                break
            end += 1
        within = [x.kind for x in self.tokens[at + 2 : end]]
        letters = next((x.text for x in self.tokens[at + 2 : end] if x.kind == "letters"), "")
        whole = "".join(x.text for x in self.tokens[at + 2 : end])
        single = not within or (len(within) == 1 and len(letters) <= 1) or self.known(whole)
        name_first = bool(within) and within[0] in ("accent", "decoration", "symbol", "upright", "letters")
        if single or (name_first and len(within) > 1 and within[1] in ("_", "lowered", "{", "letters", "symbol")):
            return None
        token = self.take()
        return node("rate", token.start, self._closed("}"), int(token.text))

    # -- functions and fractions -------------------------------------------------------------------------------------

    def _function(self, token: AnswerToken) -> Tree:
        """Read a function with its power and its argument, with or without brackets."""
        exponent: Node = None
        called = token.text
        if self.accept("^"):
            exponent = self._argument()
            if self._is_minus_one(exponent):
                called, exponent = _INVERSE.get(called, called), None
        elif (raised := self.accept("raised")) is not None:
            exponent = number(raised.text.translate(RAISED), raised.start)
        elif self._has_power_in_brackets():
            exponent = self._closed("]")
        arguments = self._arguments(token)
        call = node("call", token.start, leaf("NAME", called, token.start), *arguments)
        if exponent is None:
            return call
        return node("power", token.start, call, leaf("POWER", "^", token.end), None, exponent)

    def _has_power_in_brackets(self) -> bool:
        """Whether a number in square brackets comes next, and brackets behind it, as in \\sin[2](x) of physics."""
        kinds = [x.kind for x in self.tokens[self.i : self.i + 4]]
        return kinds[:3] == ["[", "number", "]"] and kinds[3] in ("(", "{")

    @staticmethod
    def _is_minus_one(exponent: Tree) -> bool:
        texts = [str(x) for x in exponent.scan_values(lambda x: True)]
        return [x for x in texts if x != "None"] == ["-", "1"]

    def _arguments(self, token: AnswerToken) -> list[Tree]:
        if self.next.kind == "(" and token.text in ("atan2", "min", "max"):
            start = self.take().start
            self.deeper(start)
            found = [self.sum()]
            while self.accept(","):
                found.append(self.sum())
            if not self.accept(")"):
                raise self.stopped(False)
            self.opened.pop()
            return found
        if self.next.kind in ("(", "[", "{"):
            return [self.with_multiple(self._closed(CLOSING[self.next.kind]), partial(is_multiple, names=self.names))]
        if self.next.kind == "minus":
            raise self.source.error(
                f"the argument of {token.text} begins with a sign", self.next.start, fix=f"write \\{token.text}(-x)"
            )
        return [self._bare_argument(token)]

    def _bare_argument(self, token: AnswerToken) -> Tree:
        """Read numbers, then one factor; a constant and t count as one factor."""
        start = self.next.start
        children: list[Node] = []
        while True:
            if children:
                children.append(leaf("OPERATOR", "*", self.next.start))
            kind = self.next.kind
            if kind not in _BEGINS or kind == "function":
                raise self.source.error(
                    f"the argument of {token.text} is missing", self.next.start, fix=f"write \\{token.text}(x)"
                )
            children.append(self.operand())
            if kind in ("number", "fraction"):
                if self.next.kind in ("letters", "symbol", "upright", "accent", "(", "frac", "{"):
                    continue
                break
            if self.next.kind == "letters" and self.next.text == "t":
                children += [leaf("OPERATOR", "*", self.next.start), self.operand()]
            else:
                children += self.multiplied(children[-1], partial(is_multiple, names=self.names))
            break
        return node("product", start, *children)

    def _root(self, token: AnswerToken) -> Tree:
        degree = None
        if self.next.kind == "[":
            degree = self._closed("]")
        argument = self._argument()
        if degree is None:
            return node("call", token.start, leaf("NAME", "sqrt", token.start), argument)
        inverse = node("product", token.start, number("1", token.start), leaf("OPERATOR", "/", token.start), degree)
        return node("power", token.start, argument, leaf("POWER", "^", token.start), None, inverse)

    def _matrix(self, token: AnswerToken) -> Tree:
        self.deeper(token.start)
        symmetric, self._blanks = self._says_symmetric(), False
        rows: list[list[Tree | None]] = [[self._entry(symmetric)]]
        while not self.accept("end_"):
            if self.accept("&"):
                rows[-1].append(self._entry(symmetric))
            elif self.accept("rowsep"):
                if self.next.kind != "end_":
                    rows.append([self._entry(symmetric)])
            else:
                raise self.stopped(False)
        self.opened.pop()
        if self._blanks and not symmetric:
            width = max(map(len, rows))
            rows = [[*row, *(number("0", token.start) for _ in range(width - len(row)))] for row in rows]
            self.names.notes.setdefault("Empty entries of a matrix were read as 0.")
        entries = [[self.mirrored(rows, i, j, token) for j in range(len(row))] for i, row in enumerate(rows)]
        made = matrix(token.start, entries)
        if is_determinant(token.text, self.source.text) and all(len(row) == len(entries) for row in entries):
            return node("call", token.start, leaf("NAME", DETERMINANT, token.start), made)
        return made

    def _says_symmetric(self) -> bool:
        """Whether the current matrix contains "sym." instead of its lower half."""
        depth = 0
        for token in self.tokens[self.i :]:
            depth += (token.kind == "begin") - (token.kind == "end_")
            if token.kind == "sym" and depth == 0:
                return True
            if depth < 0:
                return False
        return False

    def _entry(self, symmetric: bool) -> Tree | None:
        """Read an entry of a matrix; None for one that is left empty because the matrix is symmetric."""
        if symmetric and (self.accept("sym") or self.next.kind in ("&", "rowsep", "end_")):
            return None
        if self.next.kind in ("&", "rowsep"):
            self._blanks = True
            return number("0", self.next.start)
        return self.sum()
