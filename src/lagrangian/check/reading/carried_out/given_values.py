"""Numbers that a program gives to parameters of the system: these stand for any values, and a note tells which are
others than those of the system.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from math import degrees, isclose

import sympy as sp

from lagrangian.check.reading.own_inputs import NEAR
from lagrangian.check.reading.shortened import AnswerScope
from lagrangian.errors import listed
from lagrangian.model import Model
from lagrangian.model.symbols import Parameter
from lagrangian.records import dataclass, field

ROUNDED = 0.01
"""The relative difference of a value that is rounded."""
ANGLES = ("deg", "rad")


@dataclass(eq=False)
class GivenValues:
    """The parameters of the system that have values, by the names that a program has for them."""

    parameters: Mapping[str, Parameter] = field(default_factory=dict)
    others: dict[str, None] = field(default_factory=dict)
    """Those of these names that the program gives other values."""

    def stands_for(self, name: str, value: sp.Expr) -> bool:
        """Whether a number that a parameter is given stands for any value, and is not its own in degrees, where a
        program counts in radians."""
        of = self.parameters.get(name)
        if of is None or not of.value or not value.is_number or not value.is_real:
            return True
        size = float(value)
        if of.unit in ANGLES and isclose(size, degrees(of.value), rel_tol=NEAR):
            return False
        self.others |= {} if isclose(size, of.value, rel_tol=ROUNDED) else {name: None}
        return True

    def notes(self) -> Iterator[str]:
        """What to say of other values."""
        if self.others:
            yield f"The program gives {listed([*self.others])} other values than the system has: these were not judged."


def given_values(named: Iterable[str], model: Model, scope: AnswerScope) -> GivenValues:
    """The parameters among the names of a program."""
    valued = {p.name: p for p in model.parameters if p.value is not None}
    called = ((x, scope.meanings(x)[0]) for x in named)
    return GivenValues({x: valued[of[0]] for x, of in called if len(of) == 1 and of[0] in valued})
