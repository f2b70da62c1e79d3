"""Names of an answer's own for an input, with a value that depends on time alone: motor(t) = 8 + 2 sin 3t."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.model import Model
from lagrangian.model.names import time


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
        notes.setdefault(f"'{written}' was read as {free[0].name}, with the value that you give it.")
        return free[0].symbol
