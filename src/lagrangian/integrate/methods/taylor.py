"""The Taylor series of the motion, with an order that depends on the tolerance; the last terms determine the step.

The coefficients x_n of x(t + τ s) = Σ x_n τⁿ, where s is the length of the last step, are computed from the right-hand
side by rules for every operation (``jets.py``). A step is as long as the last two terms meet the tolerance:

    h = s · min over n ∈ {N − 1, N} of |x_n / (atol + rtol |x|)|^(−1/n), where the largest entry counts

Values inside a step are computed from the same series.
"""

from __future__ import annotations

from collections.abc import Callable

from lagrangian.codegen.ir import Value

from .jets import Jets, order_for
from .method import Method, MethodStep, rough_power
from .printer import Vec

CAUTION = 0.88
"""The factor by which a step is shorter than the last terms allow, because they do not show the next order."""


class Taylor(Method):
    """The method; ``order`` is that of the compiled code and depends on the tolerance."""

    name = "taylor"
    title = "Taylor series, order by the tolerance, adaptive"
    source = "Á. Jorba, M. Zou, Experimental Mathematics 14 (2005) 99–117"
    evaluations = 1
    expands = True
    limits = (0.0, 2.0)
    origin = 0.0

    def __init__(self, order: int = 15) -> None:
        self.order = order
        self.error_order = order

    def suited(self, tolerance: float) -> Taylor:
        """The method of the order for a tolerance."""
        return Taylor(order_for(tolerance))

    @property
    def cost(self) -> int:
        """A product of series costs half the square of the order."""
        return self.order**2 // 2

    @property
    def dense_order(self) -> int:
        """The order of the dense output."""
        return self.order

    def expand(self, s: MethodStep, jets: Callable[[list[list[Value]]], Jets]) -> Value:
        """Print the coefficients for time in units of ``s.h``; return the length of the step to take."""
        p, f = s.p, s.p.f
        assert s.x.slot is not None
        states: list[list[Value]] = [[p.read(s.x, i)] for i in range(p.size)]
        series = jets(states)
        zero = Value(f, f.constant(0.0))
        # coefficient n of the right-hand side gives coefficient n + 1 of the states
        for n in range(self.order):
            series.order(n)
            scale = s.h * (1.0 / (n + 1))
            for k, state in enumerate(states):
                found = series.output(k, n)
                state.append(zero if found is None else found * scale)
        s.stages = [Vec(values=tuple(state[n] for state in states)) for n in range(1, self.order + 1)]
        # the step for which each of the last two terms meets the tolerance; the shorter one counts
        shortest: Value | None = None
        for n in (self.order - 1, self.order):
            largest = self._size(s, s.stages[n - 1])
            tau = rough_power(f, largest, -1.0 / n)
            shortest = tau if shortest is None else f.select(f.compare("olt", tau, shortest), tau, shortest)
        assert shortest is not None
        return s.h * (shortest * CAUTION)

    def _size(self, s: MethodStep, term: Vec) -> Value:
        """The largest coefficient of an order, relative to the tolerances."""
        f = s.p.f

        def add(most: Value, x: Value, atol: Value, c: Value) -> tuple[Value]:
            size = f.intrinsic("fabs", c) / f.fma(f.intrinsic("fabs", x), s.rtol, atol)
            return (f.select(f.compare("ogt", size, most), size, most),)

        return s.p.fold(add, [1e-300], s.x, s.atol, term)[0]

    def trial(self, s: MethodStep) -> None:
        """Sum the series at ``s.h``, in units of ``s.unit``."""
        assert s.unit is not None
        tau = s.h / s.unit
        s.advance(lambda *c: self._horner(s, c, tau), *s.stages)

    @staticmethod
    def _horner(s: MethodStep, coefficients: tuple[Value, ...], tau: Value) -> Value:
        total = coefficients[-1]
        for c in reversed(coefficients[:-1]):
            total = s.p.f.fma(total, tau, c)
        return total * tau

    def interpolant(self, s: MethodStep) -> list[Vec]:
        """The coefficients of the series."""
        return s.stages

    def between(self, s: MethodStep, coefficients: list[Vec], theta: Value) -> Callable[..., Value]:
        """The value at θ of an entry, from x and its coefficients."""
        assert s.unit is not None
        tau = theta * (s.h / s.unit)
        return lambda x, *c: x + self._horner(s, c, tau)

    def powers(self, s: MethodStep, coefficients: list[Vec], entry: int) -> list[Value]:
        """The series of an entry in θ: the coefficients times powers of h over the unit of time."""
        assert s.unit is not None
        ratio = s.h / s.unit
        found, power = [s.p.read(s.x, entry)], ratio
        for c in coefficients:
            found.append(s.p.read(c, entry) * power)
            power = power * ratio
        return found


TAYLOR = Taylor()
