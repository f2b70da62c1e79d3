"""The matrix of a solver's options that multiplies the rates of a state: odeset('Mass', @(t,y) A(y)) and A y' = f."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from lagrangian.check.reading.carried_out.evaluator import Evaluator
from lagrangian.check.reading.carried_out.values import AbandonedError, OwnFunction, Value, listed, matrix


def with_mass(run: Evaluator, given: Sequence[Value], rates: Sequence[sp.Expr]) -> list[sp.Expr]:
    """The rates of a state of which a function with arguments that are ``given`` returns the products with that matrix:
    those in whose rows it is the unit matrix, and unknowns of linear equations. All as they are without one."""
    made = run.functions.get(run.mass.name, run.mass) if isinstance(run.mass, sp.Symbol) else run.mass
    if made is None:
        return list(rates)
    n = len(rates)
    A = matrix(run.function(made, given[: len(made.arguments)]) if isinstance(made, OwnFunction) else made)
    if A.shape != (n, n):
        raise AbandonedError
    left = [i for i in range(n) if A[i, :] != sp.eye(n)[i, :]]
    if any(A[i, j] != 0 for i in left for j in range(n) if j not in left) or any(A[i, :].is_zero_matrix for i in left):
        raise AbandonedError
    if not left:
        return list(rates)
    solved = listed(run.solution(A.extract(left, left), sp.Matrix([rates[i] for i in left])))
    return [solved[left.index(i)] if i in left else x for i, x in enumerate(rates)]
