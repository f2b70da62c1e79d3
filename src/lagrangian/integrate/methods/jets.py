"""Taylor coefficients of a tape: the time series of every operation is computed coefficient by coefficient.

With normalized coefficients, a(t + τ) = Σ a_n τⁿ:

    (ab)_n = Σ a_j b_{n−j}          (a/b)_n = (a_n − Σ_{j≥1} b_j q_{n−j}) / b_0
    y' = a' w:  y_n = (1/n) Σ_{j≥1} j a_j w_{n−j}       sin, cos, exp, log, … with w another series

The terms that contain a coefficient of order n itself come last in a sum. The inner terms, Σ over 0 < j < n, need only
earlier coefficients: for a single run, several such sums are packed into a vector (``sums.py``).

Source: Á. Jorba, M. Zou, Experimental Mathematics 14 (2005) 99–117; R. D. Neidinger, SIAM Review 52 (2010) 545–563.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from lagrangian.codegen.elementary import function, sincos
from lagrangian.codegen.ir import Function, Value
from lagrangian.codegen.tape import Tape

from .sums import Maybe, Side, Sums

KINKS = frozenset({"abs", "sign", "min", "max", "select", "lt", "le", "eq", "and", "or", "not"})
"""Operations that have no series at their kinks."""


class Jets:
    """The series of the entries of a tape. ``leaf(i)`` returns the coefficients of entry i, a constant or an input, and
    whether all further coefficients are 0.

    ``order(n)`` adds the n-th coefficient of every other entry. The caller appends coefficients to the lists of states
    as their derivatives become known.
    """

    def __init__(self, f: Function, tape: Tape, leaf: Callable[[int], tuple[list[Maybe], bool]]) -> None:
        self.f, self.tape = f, tape
        self.known: list[list[Maybe]] = []
        self.sums = Sums(f)
        self.still: list[bool] = []  # series that do not change in time
        self.rules: list[Callable[[int], None]] = []
        self.conditions: dict[int, Callable[[], str]] = {}  # by the series that stands for one: its flag
        self._weighted: dict[int, list[Maybe]] = {}
        self._reciprocals: dict[int, Value] = {}
        self.place: list[int] = []  # of each tape entry among the series
        self._pairs: dict[int, tuple[int, int]] = {}
        for i, op in enumerate(tape.ops):
            self.place.append(self._leaf(*leaf(i)) if op[0] in ("const", "in", "shared") else self._entry(op))

    # Series ------------------------------------------------------------------------------------------------------

    def _leaf(self, coefficients: list[Maybe], still: bool) -> int:
        self.known.append(coefficients)
        self.still.append(still)
        self.rules.append(lambda n: None)
        return len(self.known) - 1

    def _new(self, rule: Callable[[int], Maybe], *sources: int) -> int:
        """A series defined by a rule for its n-th coefficient from other series."""
        series: list[Maybe] = []
        self.known.append(series)
        self.still.append(all(self.still[k] for k in sources))
        self.rules.append(lambda n: series.append(rule(n)))
        return len(self.known) - 1

    def _inner(self, left: Side, right: Side, *sources: int) -> Callable[[int], Maybe]:
        """n → ``Σ_{0<j<n} left_j right_{n−j}``; nothing if one of the series ``sources`` is constant."""
        if any(self.still[k] for k in sources):
            return lambda n: None
        pair = self.sums.add(left, right)
        return lambda n: self.sums.inner(pair, n)

    def _side(self, i: int) -> Side:
        return lambda j: self.get(i, j)

    def get(self, i: int, n: int) -> Maybe:
        """Coefficient n of series i; 0 beyond the coefficients of a leaf."""
        series = self.known[i]
        return series[n] if n < len(series) else None

    def first(self, i: int) -> Value:
        """The current value."""
        found = self.get(i, 0)
        return Value(self.f, self.f.constant(0.0)) if found is None else found

    def order(self, n: int) -> None:
        """Add coefficient n of all series."""
        self.sums.begin(n)
        for rule in self.rules:
            rule(n)

    def output(self, k: int, n: int) -> Maybe:
        """Coefficient n of the tape's output k."""
        return self.get(self.place[self.tape.outputs[k]], n)

    # Arithmetic with zeros left out ------------------------------------------------------------------------------

    def fma(self, a: Maybe, b: Maybe, c: Maybe) -> Maybe:
        """``a b + c``."""
        if a is None or b is None:
            return c
        return a * b if c is None else self.f.fma(a, b, c)

    def minus(self, a: Maybe, b: Maybe) -> Maybe:
        """``a − b``."""
        return a if b is None else -b if a is None else a - b

    def plus(self, a: Maybe, b: Maybe) -> Maybe:
        """``a + b``."""
        return a if b is None else b if a is None else a + b

    def scaled(self, a: Maybe, c: Value | float) -> Maybe:
        """``c a``."""
        return None if a is None else a * c

    def times_index(self, a: int, j: int) -> Maybe:
        """``j a_j``."""
        kept = self._weighted.setdefault(a, [])
        while len(kept) <= j:
            k = len(kept)
            kept.append(self.get(a, k) if k == 1 else self.scaled(self.get(a, k), float(k)))
        return kept[j]

    # Operations --------------------------------------------------------------------------------------------------

    def product(self, a: int, b: int, c: int | None = None, sign: int = 1) -> int:
        """The series ``c ± ab``."""
        inner = self._inner(self._side(a), self._side(b), a, b)

        def rule(n: int) -> Maybe:
            extra = None if c is None else self.get(c, n)
            left, first = self.get(a, 0), self.get(a, n)
            if sign < 0:
                extra = None if extra is None else -extra
            total = self.plus(inner(n), extra)
            if a == b and n:
                twice = self.scaled(left, 2.0) if n == 1 else self._twice(a)
                total = self.fma(first, twice, total)
            else:
                total = self.fma(left, self.get(b, n), total)
                total = self.fma(first, self.get(b, 0), total) if n else total
            return total if sign > 0 or total is None else -total

        return self._new(rule, a, b, *([] if c is None else [c]))

    def _twice(self, a: int) -> Maybe:
        """2 a_0."""
        return self.scaled(self.get(a, 0), 2.0)

    def sum(self, a: int, b: int, sign: int = 1) -> int:
        """The series a ± b."""
        join = self.plus if sign > 0 else self.minus
        return self._new(lambda n: join(self.get(a, n), self.get(b, n)), a, b)

    def number(self, c: float) -> int:
        """The series of a constant."""
        return self._leaf([Value(self.f, self.f.constant(c))], True)

    def quotient(self, a: int, b: int) -> int:
        """The series a/b."""
        here = len(self.known)
        inner = self._inner(self._side(b), lambda j: self.get(here, j), b)

        def rule(n: int) -> Maybe:
            if b not in self._reciprocals:
                self._reciprocals[b] = 1.0 / self.first(b)
            inverse = self._reciprocals[b]
            if n == 0:
                return self.scaled(self.get(a, 0), inverse)
            early = self.scaled(self.minus(self.get(a, n), inner(n)), inverse)
            late, lead = self.get(b, n), self.scaled(self.get(here, 0), inverse)
            return early if late is None or lead is None else self.fma(-late, lead, early)

        return self._new(rule, a, b)

    def flow(self, start: Callable[[], Value], a: int, w: Callable[[], int], sign: float = 1.0) -> int:
        """The series of y with ``y' = ± a' w`` and the current value from ``start``; w may depend on y."""
        inner = self._inner(lambda j: self.times_index(a, j), lambda j: self.get(w(), j), a)

        def rule(n: int) -> Maybe:
            if n == 0:
                return start()
            late = self.get(a, n)
            if late is not None and sign < 0:
                late = -late
            return self.fma(late, self.get(w(), 0), self.scaled(inner(n), sign / n))

        return self._new(rule, a)

    def root(self, a: int) -> int:
        """The series √a: ``s_n = (a_n − Σ_{0<j<n} s_j s_{n−j}) / (2 s_0)``."""
        here = len(self.known)
        inner = self._inner(lambda j: self.get(here, j), lambda j: self.get(here, j), a)
        half: list[Value] = []

        def rule(n: int) -> Maybe:
            if n == 0:
                value = self.f.intrinsic("sqrt", self.first(a))
                half.append(0.5 / value)
                return value
            return self.scaled(self.minus(self.get(a, n), inner(n)), half[0])

        return self._new(rule, a)

    def call(self, name: str, *arguments: int) -> Value:
        """An elementary function of the current values."""
        f = self.f
        symbol = function(f.module, name, f.lanes)
        passed = ", ".join(f"{f.real} {self.first(a).name}" for a in arguments)
        return Value(f, f.put(f"call {f.real} {symbol}({passed})"))

    def turned(self, a: int) -> tuple[int, int]:
        """The series of sin a and cos a."""
        if a not in self._pairs:
            values: list[Value] = []

            def both() -> list[Value]:
                if not values:
                    f = self.f
                    pair = f"{{ {f.real}, {f.real} }}"
                    found = f.put(f"call {pair} {sincos(f.module, f.lanes)}({f.real} {self.first(a).name})")
                    values.extend(Value(f, f.put(f"extractvalue {pair} {found}, {k}")) for k in (0, 1))
                return values

            s = self.flow(lambda: both()[0], a, lambda: s + 1)
            c = self.flow(lambda: both()[1], a, lambda: s, -1.0)
            self._pairs[a] = s, c
        return self._pairs[a]

    def hyperbolic(self, a: int) -> tuple[int, int]:
        """The series of sinh a and cosh a."""
        s = self.flow(lambda: self.call("sinh", a), a, lambda: s + 1)
        c = self.flow(lambda: self.call("cosh", a), a, lambda: s)
        return s, c

    def power(self, a: int, b: int, constant: bool) -> int:
        """The series a^b: ``y' = a' b y/a`` if b is constant, which is also valid for negative a; otherwise ``y' = (b
        log a)' y``.
        """
        if constant:
            w = [0]
            y = self.flow(lambda: self.call("pow", a, b), a, lambda: w[0])
            w[0] = self.product(b, self.quotient(y, a))
            return y
        log = self._function("log", a)
        grown = self.product(b, log)
        y = self.flow(lambda: self.call("pow", a, b), grown, lambda: y)
        return y

    def angle(self, y: int, x: int) -> int:
        """The series of the angle of (x, y): ``θ' = x'·(−y/r²) + y'·(x/r²)``, each part a flow."""
        square = self.sum(self.product(x, x), self.product(y, y))
        by, bx = self.quotient(y, square), self.quotient(x, square)
        one = self.flow(lambda: self.call("atan2", y, x), y, lambda: bx)
        other = self.flow(lambda: Value(self.f, self.f.constant(0.0)), x, lambda: by, -1.0)
        return self.sum(one, other)

    def _function(self, name: str, a: int) -> int:
        """A function y(a) with y' = a' w."""
        if name == "exp":
            y = self.flow(lambda: self.call("exp", a), a, lambda: y)
            return y
        if name == "tanh":
            one = self.number(1.0)
            w = [0]
            y = self.flow(lambda: self.call("tanh", a), a, lambda: w[0])
            w[0] = self.sum(one, self.product(y, y), -1)
            return y
        one = self.number(1.0)
        if name == "log":
            w = self.quotient(one, a)
        elif name in ("atan", "atanh"):
            w = self.quotient(one, self.sum(one, self.product(a, a), 1 if name == "atan" else -1))
        else:
            square = self.product(a, a)
            under = self.sum(square, one, 1 if name == "asinh" else -1)
            if name in ("asin", "acos"):
                under = self.sum(one, square, -1)
            w = self.quotient(one, self.root(under))
        return self.flow(lambda: self.call(name, a), a, lambda: w, -1.0 if name == "acos" else 1.0)

    def _entry(self, op: tuple) -> int:
        """The series of an operation of the tape."""
        kind, at = op[0], [self.place[k] for k in op[1:]]
        match kind:
            case "add" | "sub":
                return self.sum(*at, sign=1 if kind == "add" else -1)
            case "mul":
                return self.product(*at)
            case "fma":
                return self.product(*at)
            case "fms":
                return self.product(at[0], at[1], self._opposite(at[2]))
            case "fnma":
                return self.product(*at, sign=-1)
            case "neg":
                return self._opposite(at[0])
            case "div":
                return self.quotient(*at)
            case "sqrt":
                return self.root(*at)
            case "sin" | "cos":
                return self.turned(*at)[kind == "cos"]
            case "sinh" | "cosh":
                return self.hyperbolic(*at)[kind == "cosh"]
            case "pow":
                return self.power(*at, constant=self.tape.ops[op[2]][0] == "const")
            case "atan2":
                return self.angle(*at)
        if kind == "lt":  # of a guard, which does not change within a step: see `integrate.guards`
            found = self._new(lambda n: None)
            self.conditions[found] = lambda: self.f.compare("olt", self.first(at[0]), self.first(at[1]))
            return found
        if kind == "select":
            return self._decided(*at) if {at[1], at[2]} & self.conditions.keys() else self._chosen(*at)
        if kind in KINKS:
            raise KeyError(f"operation {kind!r} has no series")
        return self._function(kind, at[0])

    def _chosen(self, condition: int, a: int, b: int) -> int:
        """One of two series, as the condition between the values now decides."""
        flags: list[str] = []
        zero = Value(self.f, self.f.constant(0.0))

        def rule(n: int) -> Maybe:
            if not flags:
                flags.append(self._flag(condition))
            x, y = self.get(a, n), self.get(b, n)
            if x is None and y is None:
                return None
            return self.f.select(flags[0], zero if x is None else x, zero if y is None else y)

        return self._new(rule, a, b)

    def _decided(self, condition: int, a: int, b: int) -> int:
        """A condition that is one of two others."""
        found = self._new(lambda n: None)

        def flag() -> str:
            f, c = self.f, self._flag(condition)
            both, other = f.logic("and", c, self._flag(a)), f.logic("and", f.opposite(c), self._flag(b))
            return f.logic("or", both, other)

        self.conditions[found] = flag
        return found

    def _flag(self, i: int) -> str:
        """The truth value of a condition now; of a number, whether it is not 0."""
        return self.conditions[i]() if i in self.conditions else self.f.compare("one", self.first(i), 0.0)

    def _opposite(self, a: int) -> int:
        """The series −a."""

        def rule(n: int) -> Maybe:
            found = self.get(a, n)
            return None if found is None else -found

        return self._new(rule, a)


def order_for(tolerance: float) -> int:
    """The order that reaches a tolerance with the least work: ``1 − ln(tolerance)/2`` (Jorba and Zou)."""
    return max(4, math.ceil(1 - math.log(max(tolerance, 2.0**-53)) / 2))
