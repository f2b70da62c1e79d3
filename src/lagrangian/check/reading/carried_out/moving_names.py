"""What moves in the values of a program: functions of time and their derivatives, coordinates and rates in letters."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.check.reading.carried_out.values import TIME
from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.shortened import AnswerScope
from lagrangian.model import Model
from lagrangian.records import dataclass, field


@dataclass(frozen=True, eq=False)
class MovingNames:
    """Tells what moves: functions of time and their derivatives, coordinates and their rates in letters, thdd."""

    model: Model
    scope: AnswerScope
    said: Mapping[str, str] = field(default_factory=dict)
    """What symbols of the program's own are, with primes: acc is x''."""

    def order(self, value: sp.Expr) -> int:
        """2 if accelerations stand in a value, 1 if something else in it moves, else 0."""
        found = [d.derivative_count for d in value.atoms(sp.Derivative)]
        found += [1 for _ in value.atoms(AppliedUndef)]
        found += [self._in_letters(x.name) for x in value.atoms(sp.Symbol) if x != TIME]
        return max([0, *(2 if k == 2 else 1 for k in found if k)])

    def _in_letters(self, name: str) -> int:
        coordinates = {c.name for c in self.model.coordinates}
        stem = self.said.get(name, "").rstrip("'’′")
        if stem and set(self.scope.meanings(stem)[0]) & coordinates:
            return max(len(self.said[name]) - len(stem), 1)
        if set(found := self.scope.meanings(name)[0]):
            return int(bool(set(found) & coordinates))
        orders = [k for k, stem in spelled_rates(name) if set(self.scope.meanings(stem)[0]) & coordinates]
        return max([0, *orders])
