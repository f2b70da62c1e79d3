"""Checks that units agree, and determines unknown dimensions by solving linear equations.

Every symbol has a dimension kg^a m^b s^c A^d …, which is known from its unit or unknown. The model states facts such as
"this is a mass", "this is added to that" or "this is the argument of a sine", which are linear equations for the
exponents.
They are solved one after another; the first one that contradicts the others is reported as an error, with its element.
Angles have no dimension. A bare number may stand for a quantity ("0.5" for half a metre): if that would explain a
difference, there is no error, and the terms of the equations are not compared.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.functions.elementary.miscellaneous import MinMaxBase

from lagrangian.errors import ModelError, Place
from lagrangian.model import Model, Parameter, Point, time
from lagrangian.model.elements import Friction, Measure, answers
from lagrangian.model.elements.conditions import Stated
from lagrangian.model.rows import NamedCondition, named_conditions
from lagrangian.page.plain import plain
from lagrangian.quantities.quantity import parse_quantity, unit_dimension
from lagrangian.quantities.units import BASE
from lagrangian.records import dataclass, field

Power = int | Fraction
"""An exponent; whole ones are `int`, with which most dimensions are computed at once."""

Exponents = tuple[Power, ...]


@dataclass(frozen=True)
class Dim:
    """A dimension, the exponents of the SI base units, times powers of dimensions that are not known yet (``unknown``:
    symbol → power)."""

    known: Exponents = (0,) * len(BASE)
    unknown: tuple[tuple[Any, Power], ...] = ()

    @classmethod
    def of_unit(cls, unit: answers.Unit) -> Dim:
        """That of a unit, by its exponents."""
        return _dim(*unit)

    def times(self, other: Dim, power: Power = 1) -> Dim:
        """self · other^power."""
        known = tuple(_whole(a + power * b) if b else a for a, b in zip(self.known, other.known, strict=True))
        if not other.unknown:
            return Dim(known, self.unknown)
        table = dict(self.unknown)
        for symbol, p in other.unknown:
            table[symbol] = _whole(table.get(symbol, 0) + power * p)
        left = [(s, p) for s, p in table.items() if p]
        if len(left) > 1:
            left.sort(key=lambda x: str(x[0]))
        return Dim(known, tuple(left))

    def power(self, exponent: Power) -> Dim:
        """self^exponent."""
        return NONE.times(self, exponent)

    def __str__(self) -> str:
        """Return the dimension as a unit: ``kg m^2``, or ``1`` for none; one that has a name by its name, ``N m``."""
        if self.known in NAMED:
            return NAMED[self.known]
        powers = [(unit, e) for unit, e in zip(BASE, self.known, strict=True) if e]
        over, under = (
            [unit if e == sign else f"{unit}^{sign * e}" for unit, e in powers if sign * e > 0] for sign in (1, -1)
        )
        below = f"({' '.join(under)})" if len(under) > 1 else "".join(under)
        return (" ".join(over) or "1") + (f"/{below}" if below else "")


NAMED: dict[Exponents, str] = {
    (*unit, *(0,) * (len(BASE) - len(unit))): name
    for unit, name in (
        (answers.FORCE, "N"),
        (answers.ENERGY, "N m"),
        (answers.POWER, "W"),
        ((1, 0, -2), "N/m"),
        ((1, 0, -1), "N s/m"),
        ((1, 2, -1), "N m s"),
        ((1, -1, -2), "Pa"),
        (answers.CHARGE, "C"),
        (answers.VOLTAGE, "V"),
        (answers.FLUX, "Wb"),
        (answers.INDUCTANCE, "H"),
        (answers.CAPACITANCE, "F"),
        (answers.RESISTANCE, "Ω"),
        ((-1, -2, 3, 2), "S"),
        ((1, 0, -2, -1), "T"),
        ((1, 1, -2, -1), "N/A"),
    )
}
"""The units that people call by a name, or as a product of named ones, rather than by base units."""


def _whole(x: Power) -> Power:
    return x.numerator if x.denominator == 1 else x


def _dim(*exponents: int) -> Dim:
    return Dim((*exponents, *(0,) * (len(BASE) - len(exponents))))


NONE, LENGTH, SECOND, ENERGY = _dim(0, 0, 0), _dim(0, 1, 0), _dim(0, 0, 1), _dim(*answers.ENERGY)
RATE = NONE.times(SECOND, -1)


class Mismatch(Exception):
    """Two dimensions that should be equal differ."""

    def __init__(self, found: Dim, wanted: Dim) -> None:
        super().__init__(f"{found} instead of {wanted}")
        self.found, self.wanted = found, wanted


@dataclass
class Dimensions:
    """The dimensions found so far; ``loose`` once a bare number was taken for a quantity with a unit.

    ``given``: whether a unit was given other than that of the standard g.
    """

    solved: dict[Any, Dim] = field(default_factory=dict)
    loose: bool = False
    given: bool = True
    seen: dict[int, Point] = field(default_factory=dict)

    def reduce(self, dim: Dim) -> Dim:
        """The dimension after all solved dimensions have been substituted."""
        if not dim.unknown:
            return dim
        result = Dim(dim.known)
        for symbol, power in dim.unknown:
            part = self.solved.get(symbol)
            result = result.times(Dim(unknown=((symbol, 1),)) if part is None else self.reduce(part), power)
        return result

    def equal(self, found: Dim, wanted: Dim) -> Dim:
        """Use the equation ``found`` = ``wanted``; raise `Mismatch` if it contradicts what is known."""
        found, wanted = self.reduce(found), self.reduce(wanted)
        rest = found.times(wanted, -1)
        if rest.unknown:
            symbol, power = rest.unknown[0]
            other = Dim(rest.known, rest.unknown[1:])
            self.solved[symbol] = other.power(Fraction(-1) / power)
        elif any(rest.known):
            raise Mismatch(found, wanted)
        return self.reduce(wanted)

    def of(self, expr: sp.Expr) -> Dim | None:
        """The dimension of an expression, or None for a bare number."""
        if expr.is_number:
            return None
        if expr == time:
            return SECOND
        if isinstance(expr, (sp.Symbol, AppliedUndef)):
            return self.reduce(Dim(unknown=((expr, 1),)))
        if isinstance(expr, sp.Derivative):
            base = self.of(cast("sp.Expr", expr.expr))
            return None if base is None else base.times(SECOND, -int(expr.derivative_count))
        if isinstance(expr, sp.Mul):
            factors = [d for d in map(self.of, expr.args) if d is not None]
            product = NONE
            for d in factors:
                product = product.times(d)
            return self.reduce(product)
        if isinstance(expr, sp.Pow):
            return self._power(expr)
        if isinstance(expr, (sp.Add, MinMaxBase)):
            return self._same(expr.args)
        if isinstance(expr, sp.Piecewise):
            return self._same([value for value, _ in cast("Any", expr.args)])
        if isinstance(expr, sp.Abs):
            return self.of(cast("sp.Expr", expr.args[0]))
        if isinstance(expr, sp.atan2):
            self._same(expr.args)
            return NONE
        if not isinstance(expr, sp.sign):
            for argument in cast("tuple[sp.Expr, ...]", expr.args):
                found = self.of(argument)
                if found is not None:
                    self.settle(found, NONE, argument)
        return NONE

    def _power(self, expr: sp.Pow) -> Dim | None:
        base = self.of(expr.base)
        if isinstance(expr.exp, sp.Rational):
            return None if base is None else self.reduce(base.power(_whole(Fraction(int(expr.exp.p), int(expr.exp.q)))))
        for part in (base, self.of(expr.exp)):
            if part is not None:
                self.equal(part, NONE)
        return NONE

    def _same(self, parts: Any) -> Dim | None:
        first: Dim | None = None
        for part in sorted(parts, key=_number_explains):  # the parts without bare numbers determine the dimension
            found = self.of(part)
            if found is not None and first is not None:
                self.settle(found, first, part)
            first = found if first is None else first
        return None if first is None else self.reduce(first)

    def settle(self, found: Dim, wanted: Dim, expr: sp.Expr) -> None:
        """Use the equation ``found`` = ``wanted``, unless a bare number in ``expr`` may have the missing unit."""
        try:
            self.equal(found, wanted)
        except Mismatch:
            if not _number_explains(expr):
                raise
            self.loose = True


PURE = 12
"""Fractions with numerator and denominator up to this are pure numbers, as in L/2 or m L²/12; 9.81 may be a
quantity."""


def _number_explains(expr: sp.Expr) -> bool:
    """Whether a number in the expression may have a unit of its own.

    A factor other than ±1 may, as in ``0.5*sin(theta)`` or ``3*t``, but not a simple factor of a parameter, as in
    ``L/2``.
    """
    for term in sp.Add.make_args(expr):
        number, rest = term.as_coeff_Mul()
        small = isinstance(number, sp.Rational) and abs(int(number.p)) <= PURE and int(number.q) <= PURE
        named = any(isinstance(f.as_base_exp()[0], sp.Symbol) and f != time for f in sp.Mul.make_args(rest))
        if number not in (1, -1) and not (small and named):
            return True
    return False


def check_dimensions(model: Model) -> Dimensions | None:
    """Raise `ModelError` if units do not agree; return the dimensions found, or None if no unit was given."""
    found = model.remembered("dimensions", lambda: _checked(model))
    return None if found is None else replace(found, solved=dict(found.solved), seen=dict(found.seen))


def _checked(model: Model) -> Dimensions | None:
    own = {
        x for f in model.floating if f.floating is not None for x in (*f.floating.coordinates, *f.floating.velocities)
    }
    named = (*model.coordinates, *model.velocities, *model.parameters, *model.inputs)
    if not any(x.unit for x in named if x not in own):
        return None
    dims = Dimensions(given=any(x.unit for x in named if x not in own and not _is_standard_gravity(x)))
    for x in named:
        if x.unit:
            if not isinstance(x, Parameter) and (scale := parse_quantity(f"1 {x.unit}").value) != 1:
                raise ModelError(
                    f"'{x.name}' has the unit {x.unit}, which is {scale:.6g} in SI units",
                    place=x.place,
                    fix="coordinates and inputs are in SI units (rad, m, N); only values of parameters are converted",
                    code="E408",
                )
            dims.solved[x.symbol] = Dim(unit_dimension(x.unit))
    for definition in model.definitions:
        _settle(dims, definition.symbol, definition.expression, f"definition '{definition.name}'", definition.place)
    for element in model.elements:
        for bearer, what, expr, wanted in _claims(model, element, dims):
            _claim(dims, bearer, what, expr, wanted)
    return dims


def _settle(dims: Dimensions, symbol: Any, expr: sp.Expr, where: str, place: Place | None) -> None:
    try:
        found = dims.of(expr)
        if found is not None and not _number_explains(expr):
            dims.equal(dims.of(symbol) or NONE, found)
    except Mismatch as wrong:
        what = f"{where} adds a quantity in {wrong.found} to one in {wrong.wanted}"
        raise ModelError(what, place=place, fix="check the units in it", code="E408") from None


def _inside(dims: Dimensions, element: Any, what: str, expr: sp.Expr) -> Dim | None:
    """The dimension of an expression in an element; its own terms and functions must agree, too."""
    try:
        return dims.of(expr)
    except Mismatch as wrong:
        raise ModelError(
            f"the units inside its {what}, {plain(expr)}, do not fit: {wrong.found} where {wrong.wanted} is needed",
            element=element.title,
            place=element.place,
            fix="give the terms of a sum the same unit, and functions an angle or a plain number",
            code="E408",
        ) from None


def _claim(dims: Dimensions, element: Any, what: str, expr: sp.Expr, wanted: Dim) -> None:
    found = _inside(dims, element, what, expr)
    if found is None:
        dims.loose = dims.loose or expr != 0
        return
    try:
        dims.settle(found, wanted, expr)
    except Mismatch as wrong:
        if not dims.given:  # no units were given: a bare sin(theta) is a position in a unit of its own
            dims.loose = True
            return
        names = ", ".join(sorted(plain(s) for s in _atoms(expr)))
        bare = f"a number has no unit: multiply by a parameter that has one, or check the units of {names}"
        raise ModelError(
            f"its {what} {plain(expr)} has the unit {wrong.found}, but {wrong.wanted} is needed",
            element=element.title,
            place=element.place,
            fix=bare if found == NONE else f"check the units of {names}",
            code="E408",
        ) from None


def _is_standard_gravity(x: Any) -> bool:
    """Whether `gravity` added this parameter."""
    return isinstance(x, Parameter) and (x.name, x.unit, x.value) == ("g", "m/s^2", 9.81)


def _atoms(expr: sp.Expr) -> set[sp.Basic]:
    return (expr.free_symbols - {time}) | expr.atoms(AppliedUndef)


Claim = tuple[Any, str, sp.Expr, Dim]


def _claims(model: Model, element: Any, dims: Dimensions) -> Iterator[Claim]:
    """The statements of an element about its expressions: (what has it, description, expression, dimension)."""
    for key, point in element.points():
        at = point
        while not at.is_origin and id(at) not in dims.seen:  # what the dimension depends on was already determined
            dims.seen[id(at)] = at
            own = SimpleNamespace(title=f"point '{at.name}'", place=at.place) if at.name and at.place else None
            for x in at.offset:
                yield own or element, "position" if own else f"position ({key})", x, LENGTH
            at = at.parent
    for key, frame in element.frames():
        yield element, f"angle ({key})", frame.angle, NONE
    for measure in element.measures(model):
        if measure.local:  # the meaning of the symbol in the law of this element only
            dims.solved[measure.expr] = _unit(dims, element, measure)
        else:
            yield element, measure.what, measure.expr, _unit(dims, element, measure)
    if isinstance(element, Friction) and element.pressing:
        yield from _pressed(model, element, dims)


def _pressed(model: Model, friction: Friction, dims: Dimensions) -> Iterator[Claim]:
    """Coefficients of friction that rows press on: mu λ is energy / δ."""
    along = LENGTH if friction.between else _inside(dims, friction, "deflection", friction.deflection)
    if along is None:
        return
    for named in named_conditions(model):
        if named.name in friction.pressing and (force := multiplier_dimension(dims, named)) is not None:
            unit = ENERGY.times(along, -1).times(force, -1)
            yield friction, "coefficient", friction.mu, unit
            if friction.static is not None:
                yield friction, "coefficient at rest", friction.static, unit


def multiplier_dimension(dims: Dimensions, row: NamedCondition) -> Dim | None:
    """The unit of λ: energy / f, or power / c; None if that of an expression is not known."""
    if row.condition.unit is not None:
        return Dim.of_unit(row.condition.unit)
    if not isinstance(row.condition, Stated):
        return None
    found = _inside(dims, row.element, "expression", row.condition.value)
    if found is None:
        return None
    whole = ENERGY.times(SECOND, -1) if row.condition.velocity else ENERGY
    return whole.times(found, -1)


def _unit(dims: Dimensions, element: Any, measure: Measure) -> Dim:
    unit = _dim(*measure.unit)
    if not measure.power:
        return unit
    what = measure.what if measure.along is measure.expr else "deflection"
    along = None if measure.along is None else _inside(dims, element, what, measure.along)
    return unit.times(LENGTH if along is None else along, measure.power)


def check_terms(dims: Dimensions, terms: tuple[sp.Expr, ...], coordinate: sp.Expr) -> int:
    """Return how many terms of an equation have the dimension energy / ξ; raise `Mismatch` for one that has another.

    Numbers are pure here, because they come from the derivation, so every term counts.
    """
    wanted = ENERGY.times(dims.of(coordinate) or NONE, -1)
    for term in terms:
        found = dims.of(term)
        if found is not None:
            dims.equal(found, wanted)
    return len(terms)
