"""The class `Linearization`: the data of a linearization, its report and its methods."""

from __future__ import annotations

from functools import cached_property
from typing import Any

from lagrangian.linear.linear_model import LinearModel
from lagrangian.linear.modes import Mode, modes
from lagrangian.linear.regulate import lqr, to_control
from lagrangian.linear.regulator import Regulator
from lagrangian.linear.report import POLES_AND_MODES, linear_report
from lagrangian.linear.symbolic import SymbolicLinearization
from lagrangian.linear.symbolic import symbolic as in_symbols
from lagrangian.model import Model
from lagrangian.page.report import Report
from lagrangian.records import dataclass
from lagrangian.viewed import Viewed
from lagrangian.write.report import report_fragment
from lagrangian.write.written import Written


@dataclass(frozen=True, eq=False)
class Linearization(Written, LinearModel):
    """A linearization δẋ = A δx + B δu, δy = C δx + D δu, with names, poles, modes and stability; see `LinearModel`."""

    def report(self, *, symbols: bool = False) -> Report[Model]:
        """Return the report; with ``symbols``, also the matrices with the parameters as symbols."""
        return linear_report(self, self.symbolic if symbols else None)

    @cached_property
    def modes(self) -> tuple[Mode, ...]:
        """The modes, slowest first; a notebook shows them as a table."""
        return Viewed(modes(self.motions, self.coordinates), self._modes_view)

    def _modes_view(self) -> str:
        found = self.report()
        parts = tuple(part for part in found.parts if str(part.title) == POLES_AND_MODES)
        return report_fragment(Report(found.title, found.model, parts))

    @cached_property
    def symbolic(self) -> SymbolicLinearization:
        """M, D, K, S, A, B in SymPy, with the parameters as symbols; raises `RunError` if they are too long to
        write."""
        return in_symbols(self)

    def to_control(self) -> Any:
        """Return python-control's StateSpace with the names of states, inputs and outputs."""
        return to_control(self)

    def lqr(self, Q: Any, R: Any) -> Regulator:
        """Return the linear-quadratic regulator u = u₀ − K (x − x₀), which minimizes ∫ (δxᵀQ δx + δuᵀR δu) dt.

        ``Q`` is the weight of states, ``R`` that of inputs: a matrix, one number, or weights by name. Raises `RunError`
        if no feedback stabilizes the system, or weights do not fit.
        """
        return lqr(self, Q, R)
