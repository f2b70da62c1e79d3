"""Names of an answer's own for an input, with a value that depends on time alone: motor(t) = 8 + 2 sin 3t."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.model import Model
from lagrangian.model.names import time
from lagrangian.model.symbols import Parameter

_DRIVES = re.compile(
    r"force|torque|thrust|motor|driv|input|push|pull|actuat|control|excit|kraft|antrieb|eingang|moteur|couple|entrada"
    r"|\A(?:f|u|m|q|tau)(?:_?\w{1,2})?\Z",
    re.IGNORECASE,
)
"""Names of forces, torques, motors and inputs."""
_ELSE = re.compile(
    r"damp|fric|drag|viscous|spring|stiff|grav|weight|mass|inerti|brak|loss|angle|length|height|radius|distance"
    r"|reib|dämpf|daempf|feder|länge|winkel|gewicht|frein|amort|ressort",
    re.IGNORECASE,
)
"""Names that mean something else."""


def may_drive(name: str, *, constant: bool) -> bool:
    """Whether a name may be that of an input; one with a constant value must say so."""
    return _ELSE.search(name) is None and (not constant or _DRIVES.search(name) is not None)


def told(written: str, name: str) -> str:
    """The note on a name that was read as an input."""
    return f"'{written}' was read as {name}, with the value that you give it."


NEAR = 1e-9
"""The relative difference of a value that is rounding."""
_WORDS = re.compile(r"[^\W\d_]{4,}+")


def of_value(value: sp.Expr, parameters: Iterable[Parameter]) -> Parameter | None:
    """The one of the parameters that has a value: slope = pi/12 for α = 15°.

    A whole number may count something, and ½ is one.
    """
    if not value.is_real or (2 * value).is_Integer:
        return None
    size = float(value.evalf())
    same = [p for p in parameters if p.value is not None and abs(size - float(p.value)) <= NEAR * abs(float(p.value))]
    return same[0] if len(same) == 1 else None


def says_else(said: str, parameter: Parameter) -> bool:
    """Whether what a comment says is something else than a parameter."""
    words, known = ({x.lower() for x in _WORDS.findall(y)} for y in (said, f"{parameter.name} {parameter.description}"))
    return bool(words) and bool(parameter.description) and not words & known


class OwnInputs:
    """Reads such a name as the input of the system that the answer does not name, if it is the only one."""

    def __init__(self, model: Model) -> None:
        self.put = False
        """Whether such names are read so."""
        self.asked = False
        """Whether there is one."""
        self._inputs = model.inputs

    def meant(self, written: str, value: Any, occurs: Callable[[str], int], notes: dict[str, None]) -> Any:
        """The value of a name, or the input that it is."""
        if not isinstance(value, sp.Expr) or bounded.letters(value) != {time}:
            return value
        free = [u for u in self._inputs if not occurs(u.name)]
        if len(free) != 1:
            return value
        self.asked = True
        if not self.put:
            return value
        notes.setdefault(told(written, free[0].name))
        return free[0].symbol
