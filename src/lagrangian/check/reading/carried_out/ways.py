"""Places and velocities of bodies that a program assigns to names of its own, from which it makes its energies.

X2 = l*sin(al) + l/2*sin(al)        X2 = 3*l*sin(al)/2          p = [x + l*sin(phi); h]         p = [x + l*sin(phi), h]
crate = Matrix([x + s*cos(th), …])  as p, where a body of the system is called so

What is carried out has these names no more; they only say where a mistake in an energy was made.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.carried_out.evaluator import Evaluator
from lagrangian.check.reading.carried_out.moving_names import MovingNames
from lagrangian.check.reading.carried_out.values import NAME, TIME, Shown
from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.shortened import AnswerScope
from lagrangian.model import Model

MOST = 12
"""The most names that are told."""
LONGEST = 60
"""The largest number of operations of such a value."""
_NAME = re.compile(r"(?:[xyzrph]|v(?!\d?$)|vel|pos)[a-z]{0,8}_?[a-z\d]{0,12}", re.IGNORECASE)
"""Names of places, and of velocities with an index."""
_WORD = re.compile(r"[^\W\d_]{3,30}")


def ways(
    run: Evaluator, moving: MovingNames, model: Model, taken: Callable[[str], bool]
) -> Iterator[tuple[int, str, list[sp.Expr]]]:
    """The line, the name and the value, or the entries, of each; ``taken`` says whether a name is one of the system."""
    last = {one.name: one for one in run.stated}
    once = [one for one in run.stated if one.name is not None and last[one.name] is one]
    bodies = frozenset(word.lower() for b in model.bodies for word in _WORD.findall(b.name))
    found = [x for one in once if (x := _way(run, moving, one, bodies)) is not None and not taken(one.name or "")]
    yield from found[:MOST]


def _way(
    run: Evaluator, moving: MovingNames, one: Shown, bodies: frozenset[str]
) -> tuple[int, str, list[sp.Expr]] | None:
    """What a name says that is one of a place or a velocity or, of a column, of one of the ``bodies``."""
    name, value = one.name or "", one.value
    listed = value.flat() if isinstance(value, MatrixBase) else [value]
    called = _NAME.fullmatch(name) is not None or (len(listed) > 1 and not bodies.isdisjoint(name.lower().split("_")))
    if name not in run.used or not called or any(spelled_rates(name)) or len(listed) > 3:
        return None
    if isinstance(value, MatrixBase) and (1 not in value.shape or len(listed) == 1):
        return None
    if not all(isinstance(x, sp.Expr) and sp.count_ops(x) <= LONGEST for x in listed):
        return None
    moved = [moving.order(x) for x in listed]
    trivial = len(listed) == 1 and isinstance(listed[0], (sp.Symbol, AppliedUndef, sp.Derivative))
    return None if max(moved) != 1 or trivial else (one.line, name, listed)


def in_own_coordinates(
    run: Evaluator, found: Sequence[tuple[int, str]], model: Model, scope: AnswerScope
) -> Iterator[tuple[int, str, list[sp.Expr]]]:
    """The coordinates of the system that a program makes of its own, s = r*phi, and has no more when it is carried out:
    the line, the name and the value of each."""
    used = {name for _, said in found for name in NAME.findall(said)}
    last = {one.name: one for one in run.stated if one.name is not None and isinstance(one.value, sp.Expr)}
    for name, one in last.items():
        meant = [c.name for c in model.coordinates if c.name in scope.meanings(name)[0]]
        letters = {str(x.func) for x in one.value.atoms(AppliedUndef)} | {str(x) for x in one.value.free_symbols}
        own = {x for x in letters - {TIME.name} if NAME.fullmatch(x) and not scope.meanings(x)[0]}
        if meant and own & used and not any(set(scope.meanings(x)[0]) & set(meant) for x in used):
            yield one.line, name, [one.value]
