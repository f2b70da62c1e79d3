"""The compiled routes of a model at a state; with friction that a multiplier presses on, those of the state's regime.

The friction at a state that slips is known from the sense of the slip and the sign of the multiplier. Which sign that
is, only the equations tell: every combination is tried, and at most one agrees with its own multipliers.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import Any

from lagrangian import dynamics
from lagrangian.derive import Derived
from lagrangian.graph import Program
from lagrangian.model import Friction, Model
from lagrangian.model.rows import pressed_rows, pressing_rows, rows_of
from lagrangian.records import dataclass
from lagrangian.verify.states import evaluated

Groups = Mapping[str, list[float]]
Values = dict[Any, float]


@dataclass(frozen=True)
class Routes:
    """The programs of a model that are compared with its derivation; the last ones only with constraints."""

    inverse: Program
    from_lagrangian: Program
    forward: Program
    multipliers: Program | None
    dual: Program | None

    @classmethod
    def of(cls, model: Model) -> Routes:
        """The programs of a model in which nothing sticks or slips, or in a regime."""

        def made() -> Routes:
            rows = bool(model.constraints)
            return cls(
                dynamics.inverse(model),
                dynamics.inverse_from_lagrangian(model),
                dynamics.forward(model),
                dynamics.multipliers(model) if rows else None,
                dynamics.forward_dual(model) if rows else None,
            )

        return model.remembered("compared routes", made)


class InRegimes:
    """The routes of a derivation's model, state by state."""

    def __init__(self, derivation: Derived) -> None:
        self.model = derivation.model
        self._pressed = pressed_rows(self.model)
        self._known = any(isinstance(e, Friction) and e.sense is not None and e.pressing for e in self.model.elements)
        self._open = bool(pressing_rows(self.model))
        self._symbols = {name: known.symbol for name, known in derivation.multipliers.items()}

    def at(self, state: Values, groups: Groups) -> tuple[Values, Routes] | None:
        """The state, with the multipliers that belong to it, and the routes there; None where no regime fits."""
        if not self._open and not self._known:
            return state, Routes.of(self.model)
        modes = self._modes(groups) if self._open else ()
        if modes is None:
            return None
        routes = Routes.of(dynamics.regime(self.model, modes) if modes else self.model)
        assert routes.multipliers is not None
        lam = evaluated(routes.multipliers, groups)["lam"]
        known = {row.name: x for row, x in zip(rows_of(self.model), lam, strict=True)}
        return {**state, **{symbol: known[name] for name, symbol in self._symbols.items()}}, routes

    def _modes(self, groups: Groups) -> dynamics.Modes | None:
        """The senses of the slips and the signs of the multipliers that press."""
        count = len(self.model.frictions)
        given = {**groups, "x": [*groups["q"], *groups["v"]]}
        senses = (1,) * count
        for sides in product((1, -1), repeat=len(self._pressed)):
            found = evaluated(self._verdict((*senses, *sides)), given)
            if (senses := tuple(1 if rate >= 0 else -1 for rate in found["rate"])) != (1,) * count:
                found = evaluated(self._verdict((*senses, *sides)), given)
            if found["regularity"] > dynamics.LEAST_REGULARITY and min(found["normal"], default=0.0) >= 0:
                return (*senses, *sides)
            senses = (1,) * count
        return None

    def _verdict(self, modes: dynamics.Modes) -> Program:
        known = self.model.remembered("compared verdicts", dict[dynamics.Modes, Program])
        if modes not in known:
            known[modes] = dynamics.verdict(self.model, modes, {})
        return known[modes]
