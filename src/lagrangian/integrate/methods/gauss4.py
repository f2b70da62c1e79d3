"""Gauss' method with two stages: order 4, symplectic, equal steps.

    k_i = f(t + c_i h, x + h Σ_j a_ij k_j)     x_new = x + h (k_1 + k_2)/2

Applied to Hamilton's equations it is a variational integrator (J. E. Marsden, M. West, Acta Numerica 10 (2001)
357–514): it conserves quadratic invariants, and the energy stays close to its initial value for exponentially long
times. The stages are iterated until only rounding changes them, because a remaining error of the iteration would cause
a drift (Hairer, Lubich, Wanner, Geometric Numerical Integration, section VIII.6). The iteration starts from the
polynomial of the last step.
"""

from __future__ import annotations

import math

from lagrangian.codegen.ir import Value

from .method import Method, MethodStep
from .printer import Vec

ROOT = math.sqrt(3.0)
C = (0.5 - ROOT / 6, 0.5 + ROOT / 6)
A = ((0.25, 0.25 - ROOT / 6), (0.25 + ROOT / 6, 0.25))

ROUNDS = 100
"""The largest number of iterations of the stages."""

STAGE_TOLERANCE = 1e-9
"""The largest accepted last change of a stage, relative to the state, when iterations no longer come closer."""


class Gauss(Method):
    """The method; it stores the stages of the last step in two vectors of its own."""

    name = "gauss4"
    title = "Gauss, two stages, order 4, symplectic, fixed step"
    source = "E. Hairer, Ch. Lubich, G. Wanner, Geometric Numerical Integration, sections II.1.3 and VIII.6"
    order = 4
    evaluations = 0  # counted as they come
    dense_evaluations = 2
    blocks = 2
    slots = 2

    @property
    def cost(self) -> int:
        """The cost of about ten iterations."""
        return 20

    def trial(self, s: MethodStep) -> Value:
        """Iterate the stages; return 1 in lanes where they do not converge, else 0."""
        p, f = s.p, s.p.f
        first, second = s.memory
        last, rounds = s.slots

        def ahead(a: Value, b: Value) -> tuple[Value, Value]:
            slope = (b - a) * ROOT
            return a + slope, b + slope

        # starting values of the stages: the last step's polynomial, continued
        p.map(ahead, first, second, into=(first, second))
        p.store(math.inf, last)
        p.store(0.0, rounds)
        with p.forever() as leave:
            # lanes that have not converged; ``last`` is the size of the last change, negative once done
            before, count = p.load(last), p.load(rounds)
            active = f.logic("and", s.running, f.compare("oge", before, 0.0))
            leave(f.put(f"xor i1 {p.any(active)}, true"))
            found = [self._stage(s, i) for i in (0, 1)]

            def change(total: Value, *pairs: Value) -> tuple[Value]:
                for old, new in (pairs[:2], pairs[2:]):
                    d = new - old
                    total = f.fma(d, d, total)
                return (total,)

            def keep(new: Value, old: Value) -> Value:
                return f.select(active, new, old)

            # the new stages, and by how much they changed
            (size,) = p.fold(change, [0.0], first, found[0], second, found[1])
            for home, new in zip((first, second), found, strict=True):
                p.map(keep, new, home, into=(home,))
            s.spend(active, 2)
            # a change that no longer shrinks, or is no number, is the last; the sign says that it is
            on = f.logic("and", f.compare("olt", size, before), f.compare("ogt", size, 0.0))
            on = f.logic("and", on, f.compare("olt", count, float(ROUNDS)))
            done = f.select(f.compare("olt", size, before), size, before)
            done = f.select(f.compare("uno", size, size), size, done)
            p.store(f.select(active, f.select(on, size, -done - 1e-300), before), last)
            p.store(count + 1.0, rounds)
        s.advance(lambda a, b: s.h * 0.5 * (a + b), first, second)

        def measure(total: Value, x: Value, a: Value, b: Value) -> tuple[Value]:
            total = f.fma(x, x, total)
            for k in (a, b):
                k = k * s.h
                total = f.fma(k, k, total)
            return (total,)

        # converged if the last change is at the level of rounding of x and h k
        (scale,) = p.fold(measure, [0.0], s.x, first, second)
        left = -p.load(last) * s.h * s.h
        fine = f.compare("ole", left, scale * STAGE_TOLERANCE**2 + 1e-290)
        return f.select(fine, 0.0, 1.0)

    def interpolant(self, s: MethodStep) -> list[Vec]:
        """The coefficients of Hermite's cubic."""
        s.k = s.rate(s.t, s.x, s.k)
        return super().interpolant(s)

    def _stage(self, s: MethodStep, i: int) -> Vec:
        p, f = s.p, s.p.f
        first, second = s.memory
        near, far = A[i]
        (at,) = p.map(
            lambda x, a, b: f.fma(s.h, f.fma(b, far, a * near), x), s.x, first, second, into=s.inlet
        )  # fmt: skip
        return s.rate(s.t + s.h * C[i], at)


GAUSS4 = Gauss()
