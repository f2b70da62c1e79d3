"""Places and velocities of bodies that a program assigns to names of its own, from which it makes its energies.

X2 = l*sin(al) + l/2*sin(al)        X2 = 3*l*sin(al)/2          p = [x + l*sin(phi); h]         p = [x + l*sin(phi), h]

What is carried out has these names no more; they only say where a mistake in an energy was made.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.carried_out.evaluator import Evaluator
from lagrangian.check.reading.carried_out.moving_names import MovingNames
from lagrangian.check.reading.carried_out.values import Shown
from lagrangian.check.reading.names import spelled_rates

MOST = 12
"""The most names that are told."""
LONGEST = 60
"""The largest number of operations of such a value."""
_NAME = re.compile(r"(?:[xyzrph]|v(?!\d?$)|vel|pos)[a-z]{0,8}_?[a-z\d]{0,12}", re.IGNORECASE)
"""Names of places, and of velocities with an index."""


def ways(run: Evaluator, moving: MovingNames, taken: Callable[[str], bool]) -> Iterator[tuple[int, str, list[sp.Expr]]]:
    """The line, the name and the value, or the entries, of each; ``taken`` says whether a name is one of the system."""
    last = {one.name: one for one in run.stated}
    once = [one for one in run.stated if one.name is not None and last[one.name] is one]
    found = [x for one in once if (x := _way(run, moving, one)) is not None and not taken(one.name or "")]
    yield from found[:MOST]


def _way(run: Evaluator, moving: MovingNames, one: Shown) -> tuple[int, str, list[sp.Expr]] | None:
    name, value = one.name or "", one.value
    listed = value.flat() if isinstance(value, MatrixBase) else [value]
    if name not in run.used or _NAME.fullmatch(name) is None or any(spelled_rates(name)) or len(listed) > 3:
        return None
    if isinstance(value, MatrixBase) and (1 not in value.shape or len(listed) == 1):
        return None
    if not all(isinstance(x, sp.Expr) and sp.count_ops(x) <= LONGEST for x in listed):
        return None
    moved = [moving.order(x) for x in listed]
    trivial = len(listed) == 1 and isinstance(listed[0], (sp.Symbol, AppliedUndef, sp.Derivative))
    return None if max(moved) != 1 or trivial else (one.line, name, listed)
