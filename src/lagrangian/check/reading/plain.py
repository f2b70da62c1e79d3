"""Answers in plain text: the grammar of model files, with the ways people write derivatives and matrices.

x1'  x1''  ẋ₁  dx1/dt  d2x1/dt2  d^2 x1/dt^2  d/dt(…)  d(…)/dt  diff(…, t, 2)  Derivative(x1(t), t)  ddot(x1)
∂L/∂x1'  dL/dx1'  diff(L, x1')          [a, b; c, d]  [[a, b], [c, d]]          sin^2(x)  sin²(x)
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lark import Tree

from lagrangian.check.reading.nodes import Node, leaf, matrix, name, node, number, only_name
from lagrangian.check.reading.parser import AnswerToken, Parser
from lagrangian.errors import ParseError
from lagrangian.model.names import FUNCTIONS
from lagrangian.quantities.source import Source
from lagrangian.read.explain import explain

_LETTER = r"[^\W\d⁰¹²³⁴-⁹₀-₉¼½¾⅐-⅞]"
_MARK = r"[\u0307\u0308\u20db\u20dc]"
_NAME = rf"{_LETTER}{_MARK}*(?:[^\W⁰¹²³⁴-⁹¼½¾⅐-⅞]{_MARK}*)*"
_TWO = r"\s*(?:(?:\^|\*\*)\s*2|²|2)"
_PRIME = r"['’′″‴]"
_KINDS = [
    ("space", r"\s+"),
    ("ddt2", rf"d{_TWO}\s*/\s*dt{_TWO}(?!\w)"),
    ("ddt", r"d\s*/\s*dt(?!\w)"),
    ("rate2", rf"d{_TWO}\s*(?P<of2>{_NAME})\s*/\s*dt{_TWO}(?!\w)"),
    ("rate", rf"d\s*(?P<of1>{_NAME}{_PRIME}*)\s*/\s*dt(?!\w)"),
    (
        "partial",
        rf"(?:∂|d)\s*(?P<what>T|V|L|D|ℒ)\s*/\s*(?:∂|d)\s*(?P<open>\()?\s*(?P<by>{_NAME})(?P<dots>{_PRIME}*)(?(open)\s*\))",
    ),
    ("number", r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"),
    ("fraction", r"[¼½¾⅐-⅞]"),
    ("star", r"T\*(?=\s*(?:[-+−–=),;]|\Z))"),
    ("name", _NAME),
    ("primes", rf"{_PRIME}+"),
    ("raised", r"[⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+"),
    ("power", r"\^|\*\*"),
    ("times", r"[*×·⋅∙]"),
    ("over", r"[/÷∕]"),
    ("plus", r"\+"),
    ("minus", r"[-−–]"),
    ("relation", r"<=|>=|!=|<|>|≤|≥|≠"),
    ("=", r"==?"),
    ("bracket", r"[()\[\],;]"),
    ("other", r"."),
]
_TOKEN = re.compile("|".join(f"(?P<{'eq' if kind == '=' else kind}>{form})" for kind, form in _KINDS), re.DOTALL)
_ORDERS = {"'": 1, "’": 1, "′": 1, "″": 2, "‴": 3}
_DIFFERENTIATE = frozenset(["diff", "Derivative", "D"])
OR, AND, NOT = ("or", "|", "||", "∨"), ("and", "&", "&&", "∧"), ("not", "~", "¬")
_DOTS = {"dot": 1, "ddot": 2}


def tokenize(text: str) -> list[AnswerToken]:
    """Return the tokens of a statement."""
    tokens: list[AnswerToken] = []
    for match in _TOKEN.finditer(text):
        kind = "=" if match.lastgroup == "eq" else str(match.lastgroup)
        if kind == "star":  # the kinetic co-energy T*, not a product
            tokens.append(AnswerToken("name", "T", match.start(), match.end()))
        elif kind != "space":
            tokens.append(
                AnswerToken(match.group() if kind == "bracket" else kind, match.group(), match.start(), match.end())
            )
    tokens.append(AnswerToken("end", "", len(text), len(text)))
    return tokens


class PlainParser(Parser):
    """Parses one statement of plain text; an implicit product is an error that says so, except between matrices."""

    def __init__(self, source: Source) -> None:
        super().__init__(source, tokenize(source.text))

    def side_by_side(self) -> bool:
        """Only matrices may be next to each other without an operator."""
        before = self.tokens[self.i - 1].kind if self.i else "end"
        return self.next.kind == "[" and before == "]"

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

    # -- operands --------------------------------------------------------------------------------------------------

    def operand(self) -> Tree:
        """Read a postfix expression and its powers."""
        start = self.next.start
        children: list[Node] = [self._postfix()]
        while (power := self.accept("power")) is not None:
            if self.next.kind == "name" and self.next.text == "T" and self.tokens[self.i - 2].kind == "]":
                self.take()
                continue  # a list in brackets is already a column
            children += [leaf("POWER", "^", power.start), self._sign(), self._postfix()]
        return node("power", start, *children)

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
        """Whether (t) is next: x1''(t) is x1''."""
        return [x.text for x in self.tokens[self.i : self.i + 3]] == ["(", "t", ")"]

    def _primed(self, made: Tree, primes: AnswerToken) -> Tree:
        order = sum(_ORDERS[c] for c in primes.text)
        if made.data == "name" and made.children[1] is None:
            token: Node = made.children[0]
            return name(token, token.start_pos, order)
        return node("rate", primes.start, made, order)

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
            case "ddt" | "ddt2":
                self.take()
                return node("rate", token.start, self._postfix(), 1 if token.kind == "ddt" else 2)
            case "partial":
                self.take()
                found = _TOKEN.match(self.source.text, token.start)
                assert found is not None
                by = name(found["by"], found.start("by"), sum(_ORDERS[c] for c in found["dots"]))
                return node("partial", token.start, leaf("NAME", found["what"], token.start), by)
        raise self.stopped(True)

    def _fraction_rate(self) -> Tree:
        token = self.take()
        found = _TOKEN.match(self.source.text, token.start)
        assert found is not None
        group, order = ("of1", 1) if token.kind == "rate" else ("of2", 2)
        written = found[group].rstrip("'’′″‴")
        order += sum(_ORDERS[c] for c in found[group][len(written) :])
        return name(written, found.start(group), order)

    def _bracket(self) -> Tree:
        start = self.take().start
        self.deeper(start)
        inner = self.sum()
        if not self.accept(")"):
            raise self.stopped(False)
        self.opened.pop()
        return inner

    def _matrix(self) -> Tree:
        """Read [a, b; c, d] or [[a, b], [c, d]]; a plain list is a column; a single entry is itself."""
        start = self.take().start
        self.deeper(start)
        rows: list[list[Tree]] = [[]]
        while True:
            rows[-1].append(self._matrix() if self.next.kind == "[" else self.sum())
            if self.accept(","):
                continue
            if self.accept(";"):
                rows.append([])
                continue
            if not self.accept("]"):
                raise self.stopped(False)
            break
        self.opened.pop()
        if len(rows) == 1:
            inner = rows[0]
            if len(inner) == 1:
                return inner[0]
            nested = [_entries(x) for x in inner]
            rows = [n if n is not None else [x] for n, x in zip(nested, inner, strict=True)]
        return matrix(start, rows)

    # -- names and calls -------------------------------------------------------------------------------------------

    def _named(self) -> Tree:
        token = self.take()
        if token.text in _DIFFERENTIATE and self.next.kind == "(":
            return self._differentiated(token)
        if token.text in _DOTS and self.next.kind == "(":
            return node("rate", token.start, self._bracket(), _DOTS[token.text])
        if token.text == "d" and self.next.kind == "(" and (rate := self._d_of_bracket(token)) is not None:
            return rate
        if token.text in FUNCTIONS and self.next.kind in ("power", "raised"):
            return self._powered_call(token)
        if self.next.kind == "(":
            return self._call(token)
        return name(token.text, token.start)

    def _call(self, token: AnswerToken) -> Tree:
        arguments = self._arguments()
        if len(arguments) == 1 and only_name(arguments[0]) == ("t", 0):  # x1(t)
            return name(token.text, token.start)
        depends = arguments and all(only_name(x) is not None for x in arguments) and self.next.kind == "="
        if depends and token.text not in FUNCTIONS:  # V(theta) = …
            return name(token.text, token.start)
        return node("call", token.start, leaf("NAME", token.text, token.start), *arguments)

    def _arguments(self) -> list[Tree]:
        start = self.take().start
        self.deeper(start)
        arguments = [] if self.next.kind == ")" else [self._argument()]
        while self.accept(","):
            arguments.append(self._argument())
        if not self.accept(")"):
            raise self.stopped(False)
        self.opened.pop()
        return arguments

    # -- conditions, for piecewise ---------------------------------------------------------------------------------

    def _argument(self) -> Tree:
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

    def _powered_call(self, token: AnswerToken) -> Tree:
        """Read sin^2(x) or sin²(x)."""
        at = self.i
        raised = self.take()
        sign = self.accept("minus") if raised.kind == "power" else None
        if raised.kind == "power":
            digits = self.accept("number")
            exponent = None if digits is None else digits.text
        else:
            exponent = raised.text.translate(str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")).lstrip("+")
        if exponent is not None and (sign or exponent.startswith("-")):
            raise self.source.error(
                f"{token.text} to a negative power can mean its inverse or its reciprocal",
                token.start,
                fix=f"write a{token.text}(x) for the inverse, 1/{token.text}(x) for the reciprocal",
            )
        if exponent is None or self.next.kind != "(":
            self.i = at
            raise self.stopped(False)
        call = self._call(token)
        power = leaf("POWER", "^", raised.start)
        return node("power", token.start, call, power, None, number(exponent, raised.start))

    def _d_of_bracket(self, token: AnswerToken) -> Tree | None:
        """Read d(…)/dt; None if no /dt follows."""
        at = self.i
        inner = self._bracket()
        if self.next.kind == "over" and self.ahead().kind == "name" and self.ahead().text == "dt":
            self.take()
            self.take()
            return node("rate", token.start, inner, 1)
        self.i = at
        return None

    def _differentiated(self, token: AnswerToken) -> Tree:
        """Read diff(x, t), diff(x, t, 2), diff(x, t, t), Derivative(x(t), (t, 2)) or diff(L, x')."""
        start = self.take().start
        self.deeper(start)
        made = self.sum()
        order = 0
        while self.accept(","):
            tuple_open = self.accept("(")
            by = self.sum()
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
            if tuple_open and not self.accept(")"):
                raise self.stopped(False)
        if not self.accept(")"):
            raise self.stopped(False)
        self.opened.pop()
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
        which = only_name(made)
        if which is None or which[1] or which[0] not in ("T", "V", "L", "D", "ℒ"):
            raise self.source.error(
                "only T, V, L and D can be differentiated by a coordinate or its rate",
                token.start,
                fix="write ∂L/∂x1' or diff(L, x1')",
            )
        return which[0]


def _entries(tree: Tree) -> list[Tree] | None:
    """The entries of a list inside a list."""
    if tree.data != "matrix":
        return None
    rows: list[Node] = list(tree.children[1:])
    return [row.children[0] for row in rows] if all(len(r.children) == 1 for r in rows) else None
