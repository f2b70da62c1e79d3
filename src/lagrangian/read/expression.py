"""Converts the syntax tree of an expression to SymPy; the text is never executed.

Decimal numbers become exact rationals (0.5 → 1/2). ``x'`` and ``x''`` are the rate and the acceleration of a name that
changes with time. Sizes are limited before anything is computed: numbers by their bits or, of exp(exp(20)) and
its like, by their value, powers by their exponent.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Any, NoReturn, TypeAlias

import sympy as sp
from lark import Token, Tree
from sympy.core.function import AppliedUndef
from sympy.logic.boolalg import Boolean

from lagrangian import bounded
from lagrangian.codes import CodeText
from lagrangian.errors import Place, did_you_mean
from lagrangian.model.decimals import noted
from lagrangian.model.names import FUNCTIONS as FUNCTION_NAMES
from lagrangian.model.names import time
from lagrangian.quantities.source import Source, shown
from lagrangian.read.functions import ALIASES, FUNCTIONS
from lagrangian.read.grammar import parse
from lagrangian.read.scope import Scope

MAX_EXPONENT = 100
"""The largest exponent of a power: x^100."""

MAX_BITS = 4096
"""The largest number of bits of a numerator or denominator (about 1200 decimal digits)."""

MAX_TOWER = 10
"""The largest number of stacked powers: a^b^c has two."""

MAX_ROOTS = 50
"""The largest number of roots of numbers in one text: SymPy compares each with every other."""

MAX_DIGITS = 60
MAX_DECIMAL_EXPONENT = 308
MAX_ORDER = 2
"""The highest derivative that primes can mean: the acceleration."""

_POWER_DIGITS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
_FRACTIONS = {c: sp.Rational(p, q) for c, p, q in (("¼", 1, 4), ("½", 1, 2), ("¾", 3, 4), ("⅐", 1, 7), ("⅑", 1, 9))}
_FRACTIONS |= {c: sp.Rational(p, q) for c, p, q in (("⅒", 1, 10), ("⅓", 1, 3), ("⅔", 2, 3), ("⅕", 1, 5), ("⅖", 2, 5))}
_FRACTIONS |= {c: sp.Rational(p, q) for c, p, q in (("⅗", 3, 5), ("⅘", 4, 5), ("⅙", 1, 6), ("⅚", 5, 6), ("⅛", 1, 8))}
_FRACTIONS |= {c: sp.Rational(p, q) for c, p, q in (("⅜", 3, 8), ("⅝", 5, 8), ("⅞", 7, 8))}
_PRIMES = {"'": 1, "’": 1, "′": 1, "″": 2, "‴": 3}
_RELATIONS = {
    "<": sp.StrictLessThan,
    "<=": sp.LessThan,
    "≤": sp.LessThan,
    ">": sp.StrictGreaterThan,
    ">=": sp.GreaterThan,
    "≥": sp.GreaterThan,
    "==": sp.Equality,
    "!=": sp.Unequality,
    "≠": sp.Unequality,
}


Node: TypeAlias = Any
"""A node of lark's tree or one of its tokens; lark's own types are no more specific about children."""


def parse_expression(
    text: str, scope: Mapping[str, sp.Basic], *, place: Place | None = None, what: str = "expression"
) -> sp.Expr:
    """Return the SymPy expression that ``text`` describes.

    ``scope`` maps names to SymPy objects; a coordinate is a function of time, so that ``x'`` is its rate. ``what``
    describes the text (``"k of spring 's1'"``), and ``place`` is the place of its first character. ``t`` is time and
    ``pi`` the number π. Raises `ParseError` with line, column, what is wrong and how to fix it.

    >>> from sympy.physics.vector import dynamicsymbols
    >>> scope = {"theta": dynamicsymbols("theta"), "m": sp.Symbol("m"), "L": sp.Symbol("L")}
    >>> parse_expression("m*L^2*theta'' + m*sin(θ)", scope)
    L**2*m*Derivative(theta(t), (t, 2)) + m*sin(theta(t))
    """
    return read_source(Source(text, what, place), scope)


def read_source(source: Source, scope: Mapping[str, sp.Basic]) -> sp.Expr:
    """Return the SymPy expression of a `Source`."""
    names = scope if isinstance(scope, Scope) else Scope(scope)
    value = ExpressionReader(source, names).value(parse(source))
    if value.has(sp.nan, sp.zoo, sp.oo, -sp.oo):
        raise source.error("its value is not finite", 0, fix="look for a division by zero", code="E705")
    return value


class ExpressionReader:
    """Evaluates a syntax tree; every method takes a node and returns its meaning."""

    def __init__(self, source: Source, scope: Scope) -> None:
        self.source, self.scope = source, scope
        self.roots = 0

    def fail(self, message: str, node: Node, *, fix: str | None = None, code: CodeText = "E701") -> NoReturn:
        """Raise an error at the place of a node."""
        raise self.source.error(message, _start(node), fix=fix, code=code)

    def value(self, node: Node) -> sp.Expr:
        """The number or expression of any node that is not a condition."""
        while len(inner := [c for c in node.children if c is not None]) == 1 and isinstance(inner[0], Tree):
            node = inner[0]  # a node that only wraps another: a sum of one product of one power ...
        if node.data in ("condition", "conjunction", "negation", "comparison"):
            self.fail(
                "found a condition where a value is expected",
                node,
                fix="conditions are allowed only in piecewise(condition, value, otherwise)",
            )
        return getattr(self, f"_{node.data}")(node)

    # -- arithmetic ---------------------------------------------------------------------------------------------

    def _sum(self, node: Node) -> sp.Expr:
        sign, first, *rest = node.children
        terms = [self._signed_value(sign, self.value(first))]
        for sign, term in zip(rest[::2], rest[1::2], strict=True):
            terms.append(self._signed_value(sign, self.value(term)))
        return self._bounded(sp.Add(*terms), node)

    @staticmethod
    def _signed_value(sign: Any, value: sp.Expr) -> sp.Expr:
        return value if sign is None or sign == "+" else -value

    def _signed(self, node: Node) -> sp.Expr:
        return self._signed_value(node.children[0], self.value(node.children[1]))

    def _product(self, node: Node) -> sp.Expr:
        first, *rest = node.children
        number: sp.Expr = sp.S.One  # numbers are multiplied one by one, so that the size of a long product is checked
        factors: list[sp.Expr] = []
        for operator, child in ((None, first), *zip(rest[::2], rest[1::2], strict=True)):
            factor = self.value(child)
            if operator is not None and operator in "/÷∕":
                if bounded.is_zero(factor):
                    self.fail("division by zero", child, fix="divide by something that is not 0", code="E705")
                factor = factor**-1
            if factor.is_Rational:
                number = self._bounded(number * factor, child)
            else:
                factors.append(factor)
        return self._bounded(sp.Mul(number, *factors), node)

    def _power(self, node: Node) -> sp.Expr:
        """a^b^c = a^(b^c), evaluated from the right."""
        *rest, last = node.children
        if len(rest) > 3 * MAX_TOWER:
            self.fail(
                f"more than {MAX_TOWER} powers are stacked on top of each other",
                node,
                fix="use parentheses",
                code="E703",
            )
        value = self.value(last)
        while rest:
            base, _, sign = rest[-3:]
            del rest[-3:]
            value = self._raise(base, self.value(base), self._signed_value(sign, value))
        return value

    def _postfix(self, node: Node) -> sp.Expr:
        atom, raised = node.children
        base = self.value(atom)
        if raised is None:
            return base
        digits = raised.translate(_POWER_DIGITS)
        if len(digits) > 6:
            self.fail(f"the exponent has {len(digits)} digits", raised, fix=f"use at most {MAX_EXPONENT}", code="E703")
        return self._raise(atom, base, sp.Integer(int(digits)))

    def _raise(self, node: Node, base: Any, exponent: Any) -> sp.Expr:
        if exponent.is_Rational:
            if abs(exponent) > MAX_EXPONENT or exponent.q > MAX_EXPONENT:
                shown_exponent = str(exponent) if abs(exponent.p) < 10**12 and exponent.q < 10**12 else "it"
                self.fail(
                    f"the exponent is too large ({shown_exponent})",
                    node,
                    fix=f"powers go up to {MAX_EXPONENT}, roots up to the {MAX_EXPONENT}th",
                    code="E703",
                )
            if exponent < 0 and bounded.is_zero(base):
                self.fail(
                    "zero to a negative power is a division by zero", node, fix="use a positive power", code="E705"
                )
            if base.is_Rational and abs(exponent) * max(_bits(base), 1) > MAX_BITS:
                self.fail("the number is too large", node, fix=f"numbers go up to {MAX_BITS} bits", code="E703")
            self._count_root(base, exponent, node)
        elif base.is_Rational and exponent.is_number and _bits(base) > 64:
            self.fail("the number is too large to raise to this power", node, code="E703")
        return self._real(self._bounded(base**exponent, node), node)

    def _count_root(self, base: Any, exponent: Any, node: Node) -> None:
        if not base.is_Rational or exponent.q == 1:
            return
        self.roots += 1
        if self.roots > MAX_ROOTS:
            self.fail(f"more than {MAX_ROOTS} roots of numbers", node, fix="write the numbers as decimals", code="E703")

    def _bounded(self, value: sp.Expr, node: Node) -> sp.Expr:
        if value.is_Atom and value in (sp.nan, sp.zoo, sp.oo, -sp.oo):
            self.fail("the value is not finite", node, fix="check it for a pole or a division by zero", code="E705")
        factors: Any = sp.Mul.make_args(value)
        for factor in factors:
            if factor.is_Rational and _bits(factor) > MAX_BITS:
                self.fail("the number is too large", node, fix=f"numbers go up to {MAX_BITS} bits", code="E703")
            if factor.is_Pow and factor.exp.is_Rational and abs(factor.exp) > MAX_EXPONENT:
                self.fail("the power is too large", node, fix=f"powers go up to {MAX_EXPONENT}", code="E703")
        if value.is_number and not value.is_Rational and abs(value.evalf(15)) > sys.float_info.max:
            self.fail("the number is too large", node, fix="numbers go up to 1.8e308", code="E703")
        return value

    def _real(self, value: sp.Expr, node: Node) -> sp.Expr:
        if value.has(sp.I) or (value.is_number and value.is_extended_real is False):
            self.fail(
                "the value is not a real number",
                node,
                fix="use real values only: no root or logarithm of a negative number, no asin(2)",
                code="E705",
            )
        return value

    # -- numbers and names --------------------------------------------------------------------------------------

    def _number(self, node: Node) -> sp.Expr:
        token = node.children[0]
        if token in _FRACTIONS:
            return _FRACTIONS[token]
        digits, _, power = token.lower().partition("e")
        if len(digits) > MAX_DIGITS or (power and (len(power) > 5 or abs(int(power)) > MAX_DECIMAL_EXPONENT)):
            self.fail(
                f"the number {shown(token, 20)} is too long",
                token,
                fix=f"at most {MAX_DIGITS} digits, and powers of ten up to {MAX_DECIMAL_EXPONENT} either way",
                code="E703",
            )
        value = sp.Rational(token.value)
        return noted(value) if "." in digits or power else value

    def _name(self, node: Node) -> sp.Expr:
        token, primes = node.children
        base, value, order = self._meaning(token)
        order += sum(_PRIMES[c] for c in primes or "")
        if order == 0:
            return value
        if order > MAX_ORDER:
            self.fail(
                f"'{base}' with {order} dots or primes",
                token,
                fix=f"{base}' is its rate, {base}'' its acceleration; nothing higher is needed",
            )
        if not value.has(AppliedUndef, time):
            self.fail(
                f"'{base}' does not change with time: it has no rate",
                token,
                fix="primes belong to coordinates, inputs and definitions that move",
            )
        for _ in range(order):
            value = bounded.diff(value, time)
        return value

    def _meaning(self, token: Any) -> tuple[str, sp.Expr, int]:
        """The name that is meant, its object, and the number of dots on it."""
        names, dots = self.scope.meanings(token)
        if len(names) == 1:
            value = self.scope[names[0]]
            if isinstance(value, sp.Expr):
                return names[0], value, dots
            self.fail(f"'{names[0]}' is not a quantity", token, code="E402")
        if len(names) > 1:
            listed = " or ".join(f"'{n}'" for n in names)
            self.fail(f"'{token[:40]}' can mean {listed}", token, fix="write the one you mean", code="E402")
        if token in ("pi", "π"):
            return "pi", sp.pi, 0
        if token == "t":
            return "t", time, 0
        if token in FUNCTION_NAMES:
            fix = f"write {token}(x)"
            self.fail(f"the function {token} has no argument in parentheses", token, fix=fix)
        if len(token) > 200:
            self.fail(f"a name with {len(token)} characters", token, fix="names have at most 64", code="E703")
        fix = self.scope.hint(token) or _known(self.scope)
        self.fail(f"unknown symbol {shown(token)}", token, fix=fix, code="E402")

    # -- functions ----------------------------------------------------------------------------------------------

    def _call(self, node: Node) -> sp.Expr:
        token, *arguments = node.children
        arguments = [a for a in arguments if a is not None]
        if token == "piecewise":
            return self._piecewise(token, arguments)
        known = FUNCTIONS.get(token)
        if known is None:
            self._unknown_function(token, arguments)
        if len(arguments) < known.least or (known.most is not None and len(arguments) > known.most):
            count = str(known.least) if known.least == known.most else f"{known.least} to {known.most}"
            self.fail(
                f"{token} takes {count} argument{'s' if count != '1' else ''} (got {len(arguments)})",
                token,
                fix=_arity_fix(token, len(arguments)),
                code="E704",
            )
        values = [self.value(a) for a in arguments]
        if token in ("log", "ln") and bounded.is_zero(values[0]):
            self.fail("the logarithm of zero is not finite", arguments[0], fix="use a positive number", code="E705")
        return self._real(self._bounded(known.make(*values), token), token)

    def _unknown_function(self, token: Any, arguments: list[Node]) -> NoReturn:
        names, _ = self.scope.meanings(token)
        if names:
            inside = self.source.text[_start(arguments[0]) :].lstrip()[:1] if arguments else ""
            if inside == "t" and self.scope[names[0]].has(AppliedUndef):
                fix = f"write {names[0]}: it is a function of time already"
            else:
                fix = f"write {names[0]}*(…) for a product"
            self.fail(f"'{names[0]}' is not a function", token, fix=fix)
        if token in ALIASES:
            fix = f"write {ALIASES[token]}"
        else:
            fix = did_you_mean(token.lower(), FUNCTION_NAMES) or "known: " + " ".join(sorted(FUNCTION_NAMES))
        self.fail(f"unknown function {shown(token)}", token, fix=fix, code="E402")

    def _piecewise(self, token: Any, arguments: list[Node]) -> sp.Expr:
        """Read piecewise(condition, value, condition, value, ..., otherwise)."""
        form = "write piecewise(condition, value, ..., otherwise)"
        if len(arguments) < 3 or len(arguments) % 2 == 0:
            what = f"piecewise takes an odd number of arguments, at least 3 (got {len(arguments)})"
            self.fail(what, token, fix=f"{form}: the last value covers all other cases", code="E704")
        pairs: list[tuple[sp.Expr, Boolean]] = []
        for condition, value in zip(arguments[:-1:2], arguments[1::2], strict=True):
            holds, taken = self.condition(condition), self.value(value)
            if holds != sp.false:
                pairs.append((taken, holds))
        pairs.append((self.value(arguments[-1]), sp.true))
        if pairs[0][1] == sp.true:
            return pairs[0][0]
        # not evaluated: SymPy's proofs about conditions may take unlimited time
        return sp.Piecewise(*pairs[: 1 + next(i for i, p in enumerate(pairs) if p[1] == sp.true)], evaluate=False)

    def condition(self, node: Node) -> Boolean:
        """The truth value of the node of a condition."""
        while len(inner := [c for c in node.children if c is not None]) == 1 and isinstance(inner[0], Tree):
            node = inner[0]
        if node.data == "comparison":
            left, relation, right = node.children
            a, b = self.value(left), self.value(right)
            numbers = a.is_Rational and b.is_Rational
            return _RELATIONS[relation](a, b) if numbers else _RELATIONS[relation](a, b, evaluate=False)
        if node.data == "negation":
            return sp.Not(self.condition(node.children[1]))
        if node.data in ("conjunction", "condition"):
            parts = [self.condition(c) for c in node.children[::2]]
            return sp.And(*parts) if node.data == "conjunction" else sp.Or(*parts)
        self.fail(
            "found a value where a condition is expected", node, fix="compare it with something: piecewise(x > 0, a, b)"
        )


def _start(node: Node) -> int:
    if isinstance(node, Token):
        return node.start_pos or 0
    return node.meta.start_pos


def _bits(number: Any) -> int:
    return max(int(number.p).bit_length(), int(number.q).bit_length())


def _known(scope: Scope) -> str:
    names = sorted(scope)
    if not names:
        return "declare it first; nothing is declared yet"
    return "known: " + ", ".join(names[:12]) + (", …" if len(names) > 12 else "")


def _arity_fix(name: str, count: int) -> str:
    if name in ("log", "ln") and count == 2:
        return "log is natural: write log(x)/log(10) for another base"
    if name == "atan" and count == 2:
        return "write atan2(y, x)"
    if name == "atan2":
        return "write atan2(y, x)"
    if count == 2:
        return f"write {name}(x); a decimal comma is a point here: 1.5"
    return f"write {name}(x)" if FUNCTIONS[name].most == 1 else f"write {name}(a, b)"
