"""Explicit Runge–Kutta methods from their tables.

    k_i = f(t + c_i h, x + h Σ_j a_ij k_j)     x_new = x + h Σ b_i k_i     error = h Σ e_i k_i

Zero entries cost nothing. Stages are kept in registers if the vectors are short.
"""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.codegen.ir import Value
from lagrangian.records import dataclass

from .method import Method, MethodStep
from .printer import Printer, Vec

Row = tuple[float, ...]


@dataclass(frozen=True)
class Tableau:
    """The coefficients of a method: nodes c, matrix a (row i has the i entries before the diagonal), weights b.

    ``errors``: weights of the error estimates. ``more_c``, ``more_a``: stages that only the dense output needs;
    ``dense``: its coefficients F3, F4, … beyond Hermite's, as weights of all stages and, after the regular ones, the
    derivative at the end of the step (see :meth:`Method.interpolant`).
    """

    c: Row
    a: tuple[Row, ...]
    b: Row
    errors: tuple[Row, ...] = ()
    more_c: Row = ()
    more_a: tuple[Row, ...] = ()
    dense: tuple[Row, ...] = ()


class Explicit(Method):
    """A method that is defined by its tableau."""

    def __init__(
        self,
        name: str,
        title: str,
        source: str,
        order: int,
        table: Tableau,
        *,
        error_order: int | None = None,
        dense_order: int = 3,
        memory: float = 0.0,
        limits: tuple[float, float] = (0.2, 10.0),
    ) -> None:
        self.name, self.title, self.source, self.order, self.table = name, title, source, order, table
        self.error_order, self._dense_order, self.memory, self.limits = error_order, dense_order, memory, limits
        self.follows = error_order is not None
        self.evaluations = len(table.c)
        self.lands_late = self.follows and all(len(row) <= len(table.c) for row in table.errors)
        self.dense_evaluations = len(table.more_c) if self.follows else 1

    @property
    def dense_order(self) -> int:
        """The order of the dense output."""
        return self._dense_order

    def trial(self, s: MethodStep) -> Value | None:
        """Print the stages and the new state; see :meth:`Method.trial`."""
        p, table = s.p, self.table
        stages = [s.k if self.follows else s.rate(s.t, s.x, s.k)]
        s.k = stages[0]
        for c, row in zip(table.c[1:], table.a[1:], strict=True):
            stages.append(self._stage(s, c, row, stages))
        used = [(b, k) for b, k in zip(table.b, stages, strict=True) if b]
        s.advance(lambda *ks: s.h * _sum(p, used, ks), *(k for _, k in used))
        s.stages = stages
        if not self.follows:
            return None
        if not s.lands_late:
            self.landed(s, s.rate(s.t + s.h, s.new_x, s.new_k))
        return self.error(s)

    def landed(self, s: MethodStep, k: Vec) -> None:
        """The last stage is the derivative at the step's end."""
        s.new_k = k
        s.stages = [*s.stages[: len(self.table.c)], k]

    def _stage(self, s: MethodStep, c: float, row: Row, stages: Sequence[Vec]) -> Vec:
        p = s.p
        used = [(a, k) for a, k in zip(row, stages, strict=True) if a]
        if len(used) == 1:
            ha = s.h * used[0][0]
            (at,) = p.map(lambda x, k: p.f.fma(ha, k, x), s.x, used[0][1], into=s.inlet)
        else:
            (at,) = p.map(lambda x, *ks: p.f.fma(s.h, _sum(p, used, ks), x), s.x, *(k for _, k in used), into=s.inlet)
        return s.rate(s.t + s.h * c if c != 1.0 else s.t + s.h, at)

    def error(self, s: MethodStep) -> Value:
        """The root mean square of the entries of the error, each divided by its tolerance."""
        f = s.p.f
        weights = self.table.errors[0]
        used = [(e, k) for e, k in zip(weights, s.stages, strict=False) if e]

        def add(total: Value, x: Value, new: Value, atol: Value, *ks: Value) -> tuple[Value]:
            ratio = _sum(s.p, used, ks) / s.scale(x, new, atol)
            return (f.fma(ratio, ratio, f.fma(new, 0.0, total)),)  # 0·new: a state that is not finite shows

        (total,) = s.p.fold(add, [0.0], s.x, s.new_x, s.atol, *(k for _, k in used))
        return f.intrinsic("fabs", s.h) * f.intrinsic("sqrt", total * (1.0 / s.p.size))

    def interpolant(self, s: MethodStep) -> list[Vec]:
        """Hermite's coefficients, then those of the table; see :meth:`Method.interpolant`."""
        table, stages = self.table, list(s.stages)
        coefficients = super().interpolant(s)
        if not table.dense:
            return coefficients
        for c, row in zip(table.more_c, table.more_a, strict=True):
            stages.append(self._stage(s, c, row, stages))
        for row in table.dense:
            used = [(d, k) for d, k in zip(row, stages, strict=True) if d]
            (found,) = s.p.map(lambda *ks, used=used: s.h * _sum(s.p, used, ks), *(k for _, k in used))
            coefficients.append(found)
        return coefficients


def _sum(p: Printer, used: Sequence[tuple[float, Vec]], ks: Sequence[Value]) -> Value:
    return p.weighted([(c, k) for (c, _), k in zip(used, ks, strict=True)])
