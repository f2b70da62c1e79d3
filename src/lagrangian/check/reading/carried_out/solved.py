"""The equations of functions that return accelerations: of unknowns that a program solves for, those that it solves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any, cast

import sympy as sp
from sympy.matrices.matrixbase import MatrixBase
from sympy.polys.solvers import PolyNonlinearError

from lagrangian.check.reading.carried_out.interpreter import Interpreter
from lagrangian.check.reading.carried_out.states import StateFunction, StateReader
from lagrangian.check.reading.carried_out.values import AbandonedError, checked, cramer, scalar
from lagrangian.check.reading.carried_out.written import written

DEEPEST = 40
"""How often unknowns may stand in the equations of others."""


def equations(run: Interpreter, found: StateFunction, reader: StateReader) -> Iterator[tuple[int, str]]:
    """The equations of one function, with their lines: of unknowns that a program solves for, those that it solves.

    Unknowns that are no accelerations are multipliers, by the names that the program or its comments give them.
    """
    put = partial(_put, table=found.moving)
    unknowns: dict[Any, sp.Expr] = {x: rate for rate, x in found.accelerations if x in run.solved}
    unknowns |= (combined := _combined(run, found))
    done: set[Any] = set()
    for rate, value in found.accelerations:
        if combined and value not in run.solved and value.free_symbols <= combined.keys():
            continue  # what it says is put into the equations that are solved
        if value not in run.solved:
            yield run.lines.get(value, found.line), f"{written(rate)} = {written(put(explicit(run, value)))}"
            continue
        A, b, x = run.solved[cast("sp.Symbol", value)]
        if x in done:
            continue
        done.add(x)
        if len(x) > len(found.accelerations) and len(unknowns) == len(found.accelerations):
            unknowns |= {one: name for one, name in _multipliers(run, x, reader) if one not in unknowns}
        if not unknowns.keys() >= set(x):
            raise AbandonedError
        for k in range(A.shape[0]):
            left = sp.Add(*[put(explicit(run, A[k, j])) * unknowns[x[j]] for j in range(A.shape[1])])
            yield found.line, f"{written(left)} = {written(put(explicit(run, b[k])))}"


def _combined(run: Interpreter, found: StateFunction) -> dict[Any, sp.Expr]:
    """The unknowns of a system of linear equations, as many as accelerations are sums of these: what is solved for is
    the absolute acceleration, and β̈ = α̈ - ψ̈ is returned. None if every acceleration is an unknown itself."""
    sums = [(rate, x) for rate, x in found.accelerations if x.free_symbols and x.free_symbols <= run.solved.keys()]
    names = sorted(set[sp.Symbol]().union(*(cast("set[sp.Symbol]", x.free_symbols) for _, x in sums)), key=str)
    if all(x in run.solved for _, x in sums) or len(names) != len(sums):
        return {}
    try:
        A, b = cast("tuple[sp.Matrix, sp.Matrix]", sp.linear_eq_to_matrix([x for _, x in sums], names))
    except PolyNonlinearError:
        return {}
    if not all(x.is_Rational for x in (*A.flat(), *b.flat())) or A.det() == 0:
        return {}
    return dict(zip(names, A.LUsolve(sp.Matrix([rate for rate, _ in sums]) + b).flat(), strict=True))


def explicit(run: Interpreter, value: sp.Expr) -> sp.Expr:
    """A value with unknowns of linear equations, in formulas, written out by Cramer's rule."""
    for _ in range(DEEPEST):
        if not (found := value.free_symbols & run.solved.keys()):
            return value
        value = checked(value.xreplace({x: cramer(x, *run.solved[x]) for x in run.solved if x in found}))
    raise AbandonedError


def _multipliers(
    run: Interpreter, x: Sequence[sp.Symbol], reader: StateReader
) -> Iterator[tuple[sp.Symbol, sp.Symbol]]:
    """Names for the unknowns of a system of linear equations that are no accelerations."""
    columns = [s.name for s in run.stated if s.name and isinstance(s.value, MatrixBase) and s.value.flat() == list(x)]
    called = {k: name for column in columns for k, name in reader.in_comments(column).items()}
    parts = {s.value: s.name for s in run.stated if s.name and isinstance(s.value, sp.Symbol)}
    for k, one in enumerate(x):
        yield one, sp.Symbol(run.aliases.get(one) or called.get(k + 1) or parts.get(one) or f"lambda_{k + 1}")


def _put(value: sp.Expr, table: dict[sp.Symbol, sp.Expr]) -> sp.Expr:
    return cast("sp.Expr", scalar(value).xreplace(table))
