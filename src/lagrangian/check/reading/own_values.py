"""Records the values that an answer gives its own names, in their order, and which of them it uses."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy as sp

from lagrangian.model import Model

ROUNDED = 1e-3
"""The relative difference of a value that was rounded."""


def amounts_to(value: Any, number: Any, model: Model) -> bool:
    """Whether a number, perhaps with a unit that was read as parameters, is what a value in letters is with the values
    of the system: R - r = 0.4 m."""
    if not isinstance(value, sp.Expr) or not isinstance(number, sp.Expr) or not value.free_symbols:
        return False
    amount = value.xreplace({p: sp.Float(v) for p, v in model.values.items()})
    factor, unit = number.as_coeff_Mul()
    factors: Any = unit.args or [unit]
    letters = unit == 1 or all(x.as_base_exp()[0].is_Symbol for x in factors)
    return bool(amount.is_Float and factor != 1 and letters and abs(amount - factor) <= ROUNDED * abs(factor))


class OwnValues:
    """The values that an answer gives its own names, in their order, and which of them it uses."""

    def __init__(self) -> None:
        self._values: dict[str, list[tuple[int, Any]]] = {}
        self._used: set[tuple[str, int]] = set()

    def define(self, base: str, value: Any, statement: int) -> None:
        """Record that a statement gives a name its value."""
        self._values.setdefault(base, []).append((statement, value))

    def use(self, base: str) -> None:
        """Record that the value that a name has now is used."""
        self._used.add((base, len(self._values.get(base, ()))))

    def unused(self) -> Iterator[tuple[str, int, Any, Any]]:
        """Each name that is used, with two values of which one is used nowhere: (name, statement, above, value)."""
        for base, given in self._values.items():
            for k in range(1, len(given)):
                if (base, k) in self._used and (base, k + 1) in self._used:
                    continue
                if not any((base, n) in self._used for n in range(1, len(given) + 1)):
                    continue
                (_, above), (at, value) = given[k - 1 : k + 1]
                yield base, at, above, value
