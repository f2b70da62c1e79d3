"""Puts factors and terms in textbook order: m g L sin θ, m₁ l₁ l₂ θ̈₂ cos(θ₁ − θ₂), (m₁ + m₂) ẍ₁, k (x₁ − x₂).

Factors: number, masses, stiffness, forces, damping, g, other parameters, sums, coordinates, rates, accelerations,
functions. A letter b or c counts as damping if a damper or a spring of the system contains it, and otherwise as any
other parameter. Terms: accelerations, rates, then the rest; equal ones by coordinate in declared order, then by name in
natural order.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.write.names import natural

_MASS, _STIFF, _GRAVITY, _OTHER, _SUM, _PLACE, _RATE, _ACCELERATION, _FUNCTION = range(1, 10)
_LETTERS = {"k": 0, "f": 1, "b": 2, "c": 2}
"""The order among stiffnesses, forces and damping coefficients."""
_TRIGONOMETRIC = {"sin": 0, "cos": 1, "tan": 2}


class Order:
    """Sort keys for the factors and terms in the expressions of one system."""

    def __init__(
        self,
        moving: Iterable[sp.Expr],
        inputs: Iterable[sp.Expr] = (),
        coefficients: Iterable[sp.Basic] = (),
        named: Mapping[sp.Symbol, int] | None = None,
    ) -> None:
        """``moving``: the coordinates in declared order, then the definitions that move; ``inputs``: signals from
        outside; ``coefficients``: the symbols in stiffnesses and damping coefficients; ``named``: symbols that a page
        defines, each with its rank among these, which all come last.
        """
        self._index: dict[sp.Basic, int] = {symbol: i for i, symbol in enumerate(moving)}
        self._inputs = frozenset(inputs)
        self._coefficients = frozenset(coefficients)
        self._named = named or {}
        self._names: dict[sp.Expr, tuple[Any, ...]] = {}
        self._factors: dict[sp.Expr, tuple[Any, ...]] = {}

    def factor(self, factor: sp.Expr) -> tuple[Any, ...]:
        """Return the sort key of a factor."""
        if factor not in self._factors:
            self._factors[factor] = self._factor(factor)
        return self._factors[factor]

    def _factor(self, factor: sp.Expr) -> tuple[Any, ...]:
        base, exponent = factor.as_base_exp() if isinstance(factor, sp.Pow) else (factor, sp.S.One)
        if isinstance(base, sp.Symbol):
            if base in self._named:
                return (_FUNCTION + 1, self._named[base], natural(base.name))
            return (self._class(base), _LETTERS.get(base.name[:1].lower(), 3), natural(base.name))
        if isinstance(base, (AppliedUndef, sp.Derivative)):
            return self._moving(base)
        if isinstance(base, sp.Add):
            return self._sum(base)
        if isinstance(base, sp.Function):
            name = base.func.__name__
            return (_FUNCTION, _TRIGONOMETRIC.get(name, -1), self.names(base))
        return (_OTHER if not base.atoms(AppliedUndef) else _PLACE, 2, self.names(base), str(exponent))

    def _moving(self, base: Any) -> tuple[Any, ...]:
        symbol = base.expr if isinstance(base, sp.Derivative) else base
        if symbol in self._inputs:
            return (_STIFF, _LETTERS["f"], natural(str(symbol.func)))
        rank = _PLACE + (min(base.derivative_count, 2) if isinstance(base, sp.Derivative) else 0)
        return (rank, 0, self._index.get(symbol, len(self._index)), natural(str(getattr(symbol, "func", symbol))))

    def _sum(self, base: sp.Add) -> tuple[Any, ...]:
        """(m₁ + m₂) belongs to the masses; (M + m sin²θ) comes before the coordinates, and (x₁ − x₂) among them."""
        names = self.names(base)
        count = max((d.derivative_count for d in base.atoms(sp.Derivative)), default=0)
        if count:
            return (_PLACE + min(count, 2), 1, names)
        if base.has(sp.sin, sp.cos, sp.tan):
            return (_SUM, 1, names)
        if any(not p.exp.is_Integer or p.exp.is_negative for p in base.atoms(sp.Pow) if p.atoms(AppliedUndef)):
            return (_PLACE, 3, names)
        if base.atoms(AppliedUndef) - self._inputs:
            return (_PLACE, 1, names)
        ranks = {_initial(s.name) for s in base.free_symbols if isinstance(s, sp.Symbol)}
        return (_MASS if ranks == {_MASS} else _SUM, 2, names)

    def _class(self, symbol: sp.Symbol) -> int:
        """The class of a parameter; that of a letter for damping depends on its use in the system."""
        if symbol.name[:1] in ("b", "c") and symbol not in self._coefficients:
            return _OTHER
        return _initial(symbol.name)

    def names(self, expr: sp.Expr) -> tuple[Any, ...]:
        """A key from the names in an expression, with coordinates by their index."""
        if expr not in self._names:
            atoms = expr.atoms(sp.Symbol, AppliedUndef)
            moving = sorted(self._index[a] for a in atoms if a in self._index)
            others = sorted(natural(_name(a)) for a in atoms if a not in self._index and _name(a) != "t")
            self._names[expr] = (tuple(moving), tuple(others), str(expr))
        return self._names[expr]

    def term(self, term: sp.Expr, functions: bool) -> tuple[Any, ...]:
        """Return the sort key of a term.

        ``functions`` says whether the sum contains functions: then a number comes first, as in 1 − cos θ.
        """
        if term.is_number:
            return (-1,) if functions else (9,)
        derivatives: list[tuple[int, int]] = []
        places: list[int] = []
        rest: list[Any] = []
        called = False
        for part in sp.Mul.make_args(term):
            base, exponent = part.as_base_exp()
            times = int(exponent) if exponent.is_Integer and exponent > 0 else 1
            if isinstance(base, sp.Derivative):
                derivatives += [(-base.derivative_count, self._index.get(base.expr, 99))] * min(times, 4)
            elif base.atoms(sp.Derivative):
                inner = base.atoms(sp.Derivative)
                derivatives += sorted((-d.derivative_count, self._index.get(d.expr, 99)) for d in inner)
            elif base in self._index:
                places.append(self._index[base])
            elif isinstance(base, sp.Function) and base not in self._inputs:
                called = True
                rest.append((8, self.names(base)))
            elif not base.is_number:
                rest.append((self.factor(base)[0], self.names(base)))
        highest = min((d for d, _ in derivatives), default=0)
        kind = {0: 2, -1: 1}.get(highest, 0)
        moved = tuple(i for _, i in sorted(derivatives))
        return (kind, moved, called, tuple(sorted(places)), tuple(sorted(rest)))


def _initial(name: str) -> int:
    """The class of a parameter from its first letter, as textbooks use it."""
    if name == "g":
        return _GRAVITY
    if name[:1] in ("m", "M", "J", "I") and not name.startswith("mu"):
        return _MASS
    return _STIFF if name[:1] in ("k", "K", "b", "c", "F") else _OTHER


def _name(atom: Any) -> str:
    return atom.name if isinstance(atom, sp.Symbol) else str(atom.func)
