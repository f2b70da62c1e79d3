"""Explains why a text is not an expression, and what to write instead."""

from __future__ import annotations

import re

from lagrangian.errors import ParseError
from lagrangian.model.names import FUNCTIONS
from lagrangian.quantities.source import Source, character, shown
from lagrangian.quantities.units import BEFORE_WORDS

ALLOWED = "only numbers, names, + - * / ^ ( ) and the listed functions are allowed"
_WORD = re.compile(r"[^\W\d]\w*")
_NUMBER = re.compile(r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_PYTHON_WORDS = frozenset(
    ["if", "else", "for", "in", "is", "import", "lambda", "while", "def", "return", "await", "yield"]
)
_COMPARISON = re.compile(r"<=|>=|==|!=|<|>|≤|≥|≠")

_CHARACTERS = {
    "[": ("found '[': lists and indexing are not part of an expression", "write x_1 for a subscript"),
    "]": ("found ']': lists and indexing are not part of an expression", "use parentheses ( )"),
    "{": ("found '{': braces are not part of an expression", "use parentheses ( ), and x_1 for a subscript"),
    "}": ("found '}': braces are not part of an expression", "use parentheses ( )"),
    "\\": ("found '\\': LaTeX is not read here", "write theta, sin(x), sqrt(x), a/b"),
    "%": ("found '%': remainders and per cent are not part of an expression", "write 5/100 for 5 %"),
    "!": ("found '!': factorials are not part of an expression", "write the product out"),
    "@": ("found '@': matrix products are not part of an expression", "write the components out"),
    "$": ("found '$': LaTeX is not read here", "write theta, sin(x), sqrt(x), a/b"),
    ";": ("found ';': this is one expression, not several statements", "write one expression"),
    "#": ("found '#': a comment cannot stand inside an expression", "put the comment outside the quotes"),
    ":": ("found ':': slices, lambda and assignments are not part of an expression", "write one expression"),
    "|": ("found '|'", "write abs(x) for |x|"),
    "√": ("found '√'", "write sqrt(x)"),
    "∞": ("found '∞': every number must be finite", "write a finite number"),
    "°": ("found '°'", 'write pi/180*angle; units belong in [parameters], such as "30 deg"'),
    "…": ("found '…'", "write every term"),
}
_QUOTES = frozenset("'\"`‘’“”′″")


_LONGEST_SIDE = 60
"""The longest side of an equation that is repeated in an error."""


def _of_equation(source: Source, offset: int) -> str:
    """What to write for an equation in a constraint: the difference of its sides, which is zero."""
    left, right = source.text[:offset].strip(), source.text[offset:].lstrip("=").strip()
    sides = (left, right)
    if not re.match(r"expression of (velocity )?constraint\b", source.what) or not all(
        0 < len(x) <= _LONGEST_SIDE and "=" not in x for x in sides
    ):
        return ""
    if left.count("(") != left.count(")"):
        return ""
    is_sum = any(x in right[1:] for x in "+-")
    whole = left if right in ("0", "0.0") else f"{left} - ({right})" if is_sum else f"{left} - {right}"
    return f"write what is zero, without '=': {whole}"


def explain(source: Source, offset: int, wants_operand: bool) -> ParseError:
    """Return the error for a text whose parse stopped at ``offset``, where an operand or an operator was expected."""
    text = source.text
    rest = text[offset:]
    before = text[:offset].rstrip()
    if not rest.strip():
        return _at_end(source, before)
    c = rest[0]
    if c in _QUOTES:
        return _quote(source, offset, before)
    if c == "." and (not before or not before[-1].isdigit()):
        return _dot(source, offset, rest)
    if c == ",":
        return _comma(source, offset, before, rest)
    if c == "=" and not rest.startswith("=="):
        return source.error(
            f"found '=' (assignment); {ALLOWED}",
            offset,
            fix=_of_equation(source, offset)
            or "write one expression without '='; inside piecewise(...) equality is ==",
        )
    if match := _COMPARISON.match(rest):
        equation = _of_equation(source, offset) if match.group() == "==" else ""
        return source.error(
            f"found the comparison '{match.group()}' outside a condition",
            offset,
            fix=equation or "comparisons are allowed only in piecewise(condition, value, otherwise)",
        )
    if c == ")":
        return _closing(source, offset, before, wants_operand)
    if c in _CHARACTERS:
        message, fix = _CHARACTERS[c]
        return source.error(message, offset, fix=fix)
    if match := re.match(r"[&|~∧∨¬]+", rest):
        return source.error(
            f"found '{match.group()}' outside a condition",
            offset,
            fix="conditions are allowed only in piecewise(condition, value, otherwise)",
        )
    if wants_operand:
        return _no_operand(source, offset, before, rest)
    return _no_operator(source, offset, before, rest)


def _at_end(source: Source, before: str) -> ParseError:
    open_at = _unclosed(source.text)
    if open_at is not None:
        return source.error("this '(' is never closed", open_at, fix="add the missing ')'")
    return source.error(
        f"the text ends after {shown(before[-1:])}; a number, a name, a function or '(' must follow",
        len(before),
        fix="complete the expression",
    )


def _unclosed(text: str) -> int | None:
    stack: list[int] = []
    for i, c in enumerate(text):
        if c == "(":
            stack.append(i)
        elif c == ")" and stack:
            stack.pop()
    return stack[-1] if stack else None


def _quote(source: Source, offset: int, before: str) -> ParseError:
    c = source.text[offset]
    if c in "'′″\"" and before and before[-1] == ")" and len(before) == offset:
        return source.error(
            "a prime must follow a name",
            offset,
            fix="write the derivative out in rates: x1' + x2' for (x1 + x2)'",
        )
    if c == '"' and before and (before[-1].isalnum() or before[-1] == "_") and len(before) == offset:
        return source.error("found '\"'", offset, fix="write two primes for an acceleration: x''")
    return source.error(f"found text in quotes; {ALLOWED}", offset, fix="write names without quotes")


def _dot(source: Source, offset: int, rest: str) -> ParseError:
    match = _WORD.match(rest[1:])
    if match:
        word = match.group()
        hint = "write x' for a rate and x'' for an acceleration" if word in ("diff", "dt", "dot", "d") else None
        return source.error(
            f"found attribute access ('.{word[:30]}'); {ALLOWED}", offset, fix=hint or "write names without dots"
        )
    return source.error(f"found '.'; {ALLOWED}", offset, fix="write * for a product, 1.5 for a number")


def _comma(source: Source, offset: int, before: str, rest: str) -> ParseError:
    left = re.search(r"[0-9.]+\Z", before)
    right = _NUMBER.match(rest[1:])
    if left and right and len(before) == offset:
        number = f"{left.group()},{right.group()}"
        return source.error(
            f"cannot read {shown(number)} as a number",
            offset,
            fix=f"use a decimal point: {left.group()}.{right.group()}",
            code="E406",
        )
    return source.error(
        "found ',' outside a function's parentheses", offset, fix="a comma separates a function's arguments only"
    )


def _closing(source: Source, offset: int, before: str, wants_operand: bool) -> ParseError:
    if before.count("(") <= before.count(")"):
        return source.error("this ')' has no matching '('", offset, fix="remove it, or add the missing '('")
    if before.endswith("("):
        return source.error("the parentheses are empty", offset, fix="write an expression between them")
    if wants_operand:
        return source.error(
            f"found ')' after {shown(before[-1:])}; a number, a name, a function or '(' must come first", offset
        )
    return source.error("found ')' too early", offset, fix="a condition needs a comparison, such as x > 0")


def _no_operand(source: Source, offset: int, before: str, rest: str) -> ParseError:
    if before and rest[0] in "+-−–*/×·":
        doubled = before[-1] + rest[0]
        fix = {"//": "write / for a quotient", "--": "write -(-x)", "++": "write one +"}.get(doubled)
        return source.error(
            f"found '{rest[0]}' after '{before[-1]}'; a number, a name, a function or '(' must come first",
            offset,
            fix=fix or "put something between the two operators",
        )
    if not before and rest[0] in "*/×·^÷":
        return source.error(f"the text starts with '{rest[0]}'", offset, fix="put something before it")
    return source.error(
        f"found {character(rest[0])}; {ALLOWED}", offset, fix="write a number, a name, a function or '('"
    )


def _is_quantity(before: str, left: str, rest: str) -> bool:
    """Whether the text is a number followed by a unit: ``10 kg``, ``-5 N/m``."""
    if before.lstrip("+-− ") != left or not re.fullmatch(_NUMBER, left):
        return False
    return all(unit in BEFORE_WORDS for unit in _WORD.findall(rest))


def _no_operator(source: Source, offset: int, before: str, rest: str) -> ParseError:
    """The error for two operands side by side, or for a character that is not in the grammar."""
    left_match = re.search(r"(?:[\w.]|[\u0307\u0308])+['’′″]*\Z", before)
    left = left_match.group() if left_match else before[-1:]
    word = _WORD.match(rest)
    number = _NUMBER.match(rest)
    match = re.search(r"(\w+?)(?:\s*(?:\^|\*\*)\s*([0-9]+)|[²³])\s*\Z", before)
    if match and match.group(1) in FUNCTIONS and rest[0] == "(":
        return source.error(
            f"the argument of {match.group(1)} must come before the power",
            offset,
            fix=f"write {match.group(1)}(x)^{match.group(2) or 2}",
        )
    start = len(before) - len(left)
    if left == "lambda" and word:
        return source.error(f"found a lambda; {ALLOWED}", start, fix="write the expression itself")
    if word and (word.group() in _PYTHON_WORDS or left in ("import", "from", "def")):
        found, where = (word.group(), offset) if word.group() in _PYTHON_WORDS else (left, start)
        return source.error(f"found the Python word '{found}'; {ALLOWED}", where, fix="write one plain expression")
    if word and (word.group() in ("and", "or", "not") or left == "not"):
        found, where = ("not", start) if left == "not" else (word.group(), offset)
        return source.error(
            f"found '{found}' outside a condition",
            where,
            fix="conditions are allowed only in piecewise(condition, value, otherwise)",
        )
    if word and _is_quantity(before, left, rest):
        return source.error(
            f"found a value with a unit, {shown(source.text.strip())}",
            offset,
            fix="give it a name under [parameters] and write the name here",
        )
    right = word or number
    if right or rest[0] == "(" or rest[0] in "¼½¾":
        shown_right = right.group()[:30] if right else "(…)" if rest[0] == "(" else rest[0]
        if left in FUNCTIONS:
            return source.error(
                f"the argument of {left} must be in parentheses", offset, fix=f"write {left}({shown_right})"
            )
        touching = len(before) == offset
        if number and not word and re.fullmatch(_NUMBER, left):
            fix = f"write one number, or a product: {left}*{shown_right}"
            return source.error(
                f"two numbers are next to each other, {shown(left)} and {shown(shown_right)}", offset, fix=fix
            )
        left = "(…)" if left == ")" else left
        pair = f"{left}{'' if touching else ' '}{shown_right}"
        return source.error(
            f"a product must be written with *: found {shown(pair)}", offset, fix=f"write {left}*{shown_right}"
        )
    return source.error(
        f"found {character(rest[0])}; {ALLOWED}", offset, fix="an operator (+ - * / ^) or the end must come next"
    )
