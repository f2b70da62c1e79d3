"""Converts SymPy expressions to mathematics on a page: dots for rates, textbook order, signs in front, neat
fractions."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from decimal import Decimal, Inexact, localcontext
from fractions import Fraction
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational
from sympy.logic.boolalg import BooleanFunction

from lagrangian.model import Model, time
from lagrangian.page.plain import as_cases
from lagrangian.records import dataclass
from lagrangian.write.expression_tree import (
    FUNCTIONS,
    Addition,
    Apply,
    Cases,
    Fence,
    Letter,
    Mark,
    Math,
    Number,
    Power,
    Quotient,
    Radical,
    Relation,
    Times,
    Word,
    fenced,
)
from lagrangian.write.names import letter, letters
from lagrangian.write.order import Order

_FUNCTION_NAMES = {
    "asin": "arcsin",
    "acos": "arccos",
    "atan": "arctan",
    "log": "ln",
    "sign": "sgn",
    "Min": "min",
    "Max": "max",
    "asinh": "arsinh",
    "acosh": "arcosh",
    "atanh": "artanh",
}
_CONSTANTS = {sp.pi: "π", sp.E: "e", sp.oo: "∞", sp.zoo: "∞", sp.nan: "undefined", sp.I: "i"}
_RELATIONS = {"<": "<", "<=": "≤", ">": ">", ">=": "≥", "==": "=", "!=": "≠"}


@dataclass(frozen=True)
class NamedSymbol:
    """A symbol that a page defines: products list it by its ``rank`` behind what belongs to the system; ``inward`` is
    marked with ⁺."""

    symbol: sp.Symbol
    rank: int
    inward: bool = False

    @property
    def letter(self) -> Letter:
        """How it is written; the mark takes the place of the last part of its name."""
        name = self.symbol.name.removesuffix(INWARD) if self.inward else self.symbol.name
        return replace(letter(name), plus=self.inward)


INWARD = "_out"
"""How the name of a sum over all that hangs on something ends."""


_POSITION = tuple(Letter(x) for x in "xyz")
_QUATERNION = tuple(Letter("epsilon", (x,)) for x in "xyzw")
_MOVING, _TURNING = (tuple(Letter(base, (x,)) for x in "xyz") for base in ("v", "omega"))


def _floating(model: Model, others: Mapping[str, Letter]) -> dict[str, Letter]:
    """The letters of floating frames: x, ε_x, v_x, ω_x; with the frame's name if there are several, or others look so.

    A frame whose letters look like others even then keeps its names as they are spelled.
    """
    floats = [(f.name, f.floating) for f in model.floating if f.floating is not None]
    own = {x.name for _, f in floats for x in (*f.coordinates, *f.velocities)}
    taken = {(x.base, x.sub) for name, x in others.items() if name not in own}
    found: dict[str, Letter] = {}
    for frame, f in floats:
        names = [x.name for x in (*f.coordinates, *f.velocities)]
        for index in ((), (frame,)) if len(floats) == 1 else ((frame,),):
            own_letters = (*_QUATERNION, *_TURNING) if f.held else (*_POSITION, *_QUATERNION, *_MOVING, *_TURNING)
            made = [replace(x, sub=(*x.sub, *index)) for x in own_letters]
            if not any((x.base, x.sub) in taken for x in made):
                found |= dict(zip(names, made, strict=True))
                break
    return found


class Expressions:
    """Lays out the expressions of one system, whose symbols all look different."""

    def __init__(self, model: Model, named: Sequence[NamedSymbol] = ()) -> None:
        moving = [c.symbol for c in model.coordinates] + [d.symbol for d in model.definitions if d.moving]
        found = {**letters(model.symbols), **{x.symbol.name: x.letter for x in named}}
        found |= _floating(model, found)
        self.letters: Mapping[str, Letter] = found
        ranks = {x.symbol: x.rank for x in named}
        self._decimals = {Fraction(int(x.p), int(x.q)) for x in model.decimals}
        self._order = Order(moving, [i.symbol for i in model.inputs], _coefficients(model), ranks)

    def letter(self, name: str) -> Letter:
        """The letter for a symbol of the system, or for any other name."""
        return self.letters.get(name) or letter(name)

    def __call__(self, expr: Any) -> Math:
        """Lay out an expression; `TypeError` for anything else."""
        match expr:
            case sp.Add():
                return self.sum(self._sorted(expr))
            case sp.Mul():
                return self._product(expr)
            case sp.Pow():
                return self._power(expr)
            case sp.Symbol():
                return self.letter(expr.name)
            case AppliedUndef():
                return self._undefined(expr)
            case sp.Derivative():
                return self._derivative(expr)
            case sp.Number():
                return self._number(expr)
            case sp.Piecewise():
                return self._piecewise(expr)
            case sp.Heaviside():
                return self._piecewise(as_cases(expr))
            case sp.Abs():
                return Fence(self(expr.args[0]), "|", "|")
            case sp.Function() | sp.Min() | sp.Max():
                return self._function(expr, None)
            case Relational():
                return self._relation(expr)
            case BooleanFunction():
                name = {"And": "and", "Or": "or", "Not": "not"}[type(expr).__name__]
                return Apply(name, tuple(self(a) for a in expr.args))
        if expr in _CONSTANTS:
            return Number(_CONSTANTS[expr])
        if expr in (sp.true, sp.false):
            return Word("always" if expr == sp.true else "never")
        raise TypeError(f"cannot write {type(expr).__name__}: {expr}")

    # -- sums -------------------------------------------------------------------------------------------------------

    def sum(self, terms: Iterable[sp.Expr]) -> Math:
        """Lay out a sum whose terms keep the given order."""
        laid = [self.term(t) for t in terms]
        if len(laid) == 1 and not laid[0][0]:
            return laid[0][1]
        return Addition(tuple(laid)) if laid else Number("0")

    def term(self, term: sp.Expr) -> tuple[bool, Math]:
        """Lay out a term as (whether it is negative, its absolute value)."""
        if term.is_number and term.is_extended_real and term.is_negative:
            return True, self(-term)
        if isinstance(term, sp.Mul):
            laid = self._product(term)
            if isinstance(laid, Addition) and len(laid.terms) == 1:
                return laid.terms[0]
            return False, laid
        return False, self(term)

    def _sorted(self, expr: sp.Add) -> list[sp.Expr]:
        """The terms in textbook order, with a positive one first if there is one."""
        terms = self._sorted_terms(expr)
        if _negative(terms[0]):
            first = next((t for t in terms if not _negative(t)), None)
            if first is not None:
                terms.remove(first)
                terms.insert(0, first)
        return terms

    def _sorted_terms(self, expr: sp.Add) -> list[sp.Expr]:
        functions = any(isinstance(f, sp.Function) and not isinstance(f, AppliedUndef) for f in expr.atoms(sp.Function))
        return sorted(expr.args, key=lambda t: self._order.term(t, functions))

    # -- products ---------------------------------------------------------------------------------------------------

    def _product(self, expr: sp.Expr) -> Math:
        number, over, under = self._split(expr)
        negative = number < 0
        number = abs(number)
        if under:
            top, bottom = Fraction(number).limit_denominator(10**18).as_integer_ratio()
            if isinstance(number, Fraction) and _decimal(number, self._decimals):
                over, top, bottom = [sp.Rational(top, bottom), *over], 1, 1
            elif Fraction(top, bottom) != number:  # a decimal number stays in front of the fraction
                over, top, bottom = [sp.Float(sp.Rational(*Fraction(number).as_integer_ratio())), *over], 1, 1
            shown: Math = Quotient(self._times(top, over), self._times(bottom, under))
        else:
            shown = self._times(number, over)
        return Addition(((True, shown),)) if negative else shown

    def _split(self, expr: sp.Expr) -> tuple[Any, list[sp.Expr], list[sp.Expr]]:
        """The number, the factors of the numerator and the factors of the denominator."""
        number: Any = 1
        over: list[sp.Expr] = []
        under: list[sp.Expr] = []
        waiting: list[Any] = list(expr.args)
        while waiting:
            factor = waiting.pop(0)
            if isinstance(factor, sp.Mul):
                waiting = [*factor.args, *waiting]
            elif isinstance(factor, sp.Rational):
                number = number * Fraction(int(factor.p), int(factor.q))
            elif isinstance(factor, sp.Float):
                number = number * float(factor)
            elif isinstance(factor, sp.Pow) and _negative(factor.exp):
                under.append(sp.Pow(factor.base, -factor.exp))
            else:
                over.append(factor)
        return number, sorted(over, key=self._order.factor), sorted(under, key=self._order.factor)

    def _times(self, number: Any, factors: list[sp.Expr]) -> Math:
        laid = [self(f) for f in factors]
        if number != 1 or not laid or isinstance(number, float):
            laid.insert(0, self._numeral(number))
        return laid[0] if len(laid) == 1 else Times(tuple(laid))

    def _power(self, expr: sp.Pow) -> Math:
        base, exponent = expr.base, expr.exp
        if _negative(exponent):
            return Quotient(Number("1"), self(sp.Pow(base, -exponent)))
        if exponent == sp.Rational(1, 2):
            return Radical(self(base))
        if isinstance(base, sp.Function) and not isinstance(base, AppliedUndef) and exponent.is_Integer:
            name = _FUNCTION_NAMES.get(base.func.__name__, base.func.__name__)
            if name in FUNCTIONS and not isinstance(base, sp.exp):
                return self._function(base, self(exponent))
        if isinstance(base, sp.Add) and exponent.is_Integer and exponent.is_even:
            base = self._facing(base)
        return Power(self._base(base), self(exponent))

    def _facing(self, base: sp.Add) -> sp.Expr:
        """The base of an even power with the sign for which the moving part is positive: (x − L₀)², not (L₀ − x)²."""
        terms = self._sorted_terms(base)
        first = next((t for t in terms if t.has(AppliedUndef)), terms[0])
        return sp.Add(*[-t for t in terms]) if _negative(first) else base

    def _base(self, base: sp.Expr) -> Math:
        laid = self(base)
        if isinstance(laid, Apply) and laid.name != "atan2":
            return Fence(laid)
        return fenced(laid, (Addition, Times, Quotient, Power, Mark, Relation, Cases, Radical))

    # -- the rest ---------------------------------------------------------------------------------------------------

    def _undefined(self, expr: Any) -> Math:
        name = expr.func.__name__
        if expr.args == (time,):
            return self.letter(name)
        return Apply(name, tuple(self(a) for a in expr.args))

    def _derivative(self, expr: sp.Derivative) -> Math:
        laid = self(expr.expr)
        count = expr.derivative_count
        if isinstance(laid, Letter) and set(expr.variables) == {time} and count <= 3:
            return Letter(laid.base, laid.sub, count, laid.star, laid.bold, laid.literal)
        if set(expr.variables) == {time}:
            order: Math = Number(str(count))
            sign: Math = Word("d") if count == 1 else Power(Word("d"), order)
            return Times((Quotient(sign, Mark("d", Word("t") if count == 1 else Power(Word("t"), order))), Fence(laid)))
        below = tuple(Mark("∂", self(v)) for v in expr.variables)
        above: Math = Word("∂") if count == 1 else Power(Word("∂"), Number(str(count)))
        return Times((Quotient(above, below[0] if count == 1 else Times(below)), Fence(laid)))

    def _number(self, expr: sp.Number) -> Math:
        if expr in _CONSTANTS:
            return Number(_CONSTANTS[expr])
        value: Any = Fraction(int(expr.p), int(expr.q)) if isinstance(expr, sp.Rational) else float(expr)
        return Addition(((True, self._numeral(-value)),)) if value < 0 else self._numeral(value)

    def _numeral(self, value: Any) -> Math:
        return _numeral(value, self._decimals)

    def _function(self, expr: Any, power: Math | None) -> Math:
        name = expr.func.__name__
        args = expr.args
        if name in ("Min", "Max"):
            args = sorted(args, key=self._order.names)
        return Apply(_FUNCTION_NAMES.get(name, name), tuple(self(a) for a in args), power)

    def _relation(self, expr: Any) -> Math:
        return Relation((self(expr.lhs), self(expr.rhs)), _RELATIONS[expr.rel_op])

    def _piecewise(self, expr: Any) -> Math:
        return Cases(tuple((self(value), None if cond == sp.true else self(cond)) for value, cond in expr.args))


def _coefficients(model: Model) -> Iterator[sp.Basic]:
    """The symbols in stiffnesses of springs, in coefficients of dampers and in given dissipation functions."""
    for element in model.elements:
        for expr in (getattr(element, "k", None), getattr(element, "b", None), element.dissipation(model)):
            if isinstance(expr, sp.Basic):
                yield from expr.free_symbols


def _negative(expr: sp.Expr) -> bool:
    """Whether an expression is written with a minus sign in front, because its number is negative."""
    number = expr.as_coeff_Mul()[0]
    return bool(number.is_extended_real and number.is_negative)


LONGEST_DENOMINATOR = 10_000
"""The denominator above which a fraction that is a decimal number is written as such, whoever wrote it."""

SHORTEST_DENOMINATOR = 8
"""Halves, quarters and eighths less than 1 stay fractions: they come from ½ m v² and the like."""

MOST_DIGITS = 17
"""Digits that tell a floating-point number from all others; a longer decimal number stays a fraction."""


def _decimal(value: Fraction, written: Collection[Fraction] = ()) -> str:
    """A fraction as a decimal number that equals it, 0.7071067811865476; empty where it is shown as a fraction.

    Tenths are decimals where any number of the description was ``written`` so, 0.3 · 9.81 = 2.943, and halves likewise.
    """
    under = value.denominator
    if under == 1 or pow(10, under.bit_length(), under):
        return ""
    tenths = under % 5 == 0
    if not tenths and value < 1 and under <= SHORTEST_DENOMINATOR:
        return ""
    alike = any((x.denominator % 5 == 0) == tenths for x in written)
    if not alike and not (tenths and under > LONGEST_DENOMINATOR):
        return ""
    with localcontext() as exact:
        exact.prec = MOST_DIGITS
        made = Decimal(value.numerator) / Decimal(under)
        return "" if exact.flags[Inexact] else f"{made.normalize()}".lower()


def _numeral(value: Any, written: Collection[Fraction]) -> Math:
    """A nonnegative number: 2, ½, 9.81, 1.5·10⁻⁶."""
    if isinstance(value, Fraction) and (digits := _decimal(value, written)):
        return _scientific(digits)
    if isinstance(value, Fraction) and value.denominator != 1:
        return Quotient(Number(str(value.numerator)), Number(str(value.denominator)))
    if isinstance(value, (int, Fraction)):
        return Number(str(int(value)))
    return _scientific(f"{value:.15g}")


def _scientific(written: str) -> Math:
    """A number as Python writes it: with a power of ten where there is one."""
    digits, _, exponent = written.partition("e")
    if exponent:
        power = int(exponent)
        raised: Math = Number(str(power)) if power >= 0 else Addition(((True, Number(str(-power))),))
        return Times((Number(digits), Word("·"), Power(Number("10"), raised)))
    return Number(digits)
