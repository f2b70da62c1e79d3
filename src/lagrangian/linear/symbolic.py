"""A linearization in symbols: M, D, K, S and A, B about an equilibrium, with the parameters as symbols.

h = C q̇ + G − Ξ of the derivation is differentiated and evaluated at the equilibrium: K = ∂h/∂q, D = ∂h/∂q̇, S =
−∂h/∂u; A = [[0, 1], [−M⁻¹K, −M⁻¹D]], B = [[0], [M⁻¹S]].
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian import bounded, derive
from lagrangian.derive.algebra import Algebra, Form, OutOfReach
from lagrangian.derive.algebra.ratios import FormRatio, inverse, written
from lagrangian.errors import RunError
from lagrangian.linear.linear_model import LinearModel
from lagrangian.model import Model, is_hard, time
from lagrangian.page.plain import plain
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

MAX_SYMBOLIC_COORDINATES = 6
"""The largest number of coordinates for which a linearization is written in symbols."""

EXACT_TOLERANCE = 1e-12


@dataclass(frozen=True, eq=False)
class SymbolicLinearization(Brief):
    """The matrices of a linearization in SymPy, with the parameters as symbols.

    ``point`` contains the substitution for every coordinate and input: an exact number if its value is 0 or a simple
    fraction of a turn, otherwise a symbol, named after it, that stands for its value at the equilibrium. ``conditions``
    are the equations h = 0 that these symbols satisfy.
    """

    M: sp.ImmutableMatrix
    D: sp.ImmutableMatrix
    K: sp.ImmutableMatrix
    S: sp.ImmutableMatrix
    A: sp.ImmutableMatrix
    B: sp.ImmutableMatrix
    point: dict[sp.Expr, sp.Expr]
    conditions: tuple[sp.Eq, ...]


def _hard(linear: LinearModel) -> bool:
    return is_hard(linear.model)


@bounded.answered("writing the matrices out", _hard)
def symbolic(linear: LinearModel) -> SymbolicLinearization:
    """Return a linearization in symbols. Raises `RunError` if it is not about an equilibrium, or too long to write
    out."""
    model, n = linear.model, len(linear.model.coordinates)
    if model.constraints:
        raise RunError(
            "symbolic matrices are not available for systems with constraints, whose independent states are found in "
            "numbers",
            fix="use A and B, which contain the numbers, or describe the system without constraints",
            code="E523",
        )
    if linear.kind != "rest" or linear.mass is None:
        raise RunError(
            "symbolic matrices are available only at an equilibrium, and only for systems without floating frames",
            fix="use A and B, which contain the numbers",
            code="E523",
        )
    if n > MAX_SYMBOLIC_COORDINATES:
        raise _too_long(f"{n} coordinates")
    made = derive.derive(model)
    point = _point(linear)
    v, u = [c.rate for c in model.coordinates], [i.symbol for i in model.inputs]
    h = made.coriolis_matrix * sp.Matrix(v) + made.gravity_vector - made.generalized_forces
    h = sp.Matrix([model.expand(cast("sp.Expr", x), constants=True) for x in h])
    mass = made.mass_matrix.applyfunc(lambda x: model.expand(x, constants=True))
    q = [c.symbol for c in model.coordinates]
    raw = {
        "M": _at(mass, point, v),
        "D": _at(_slopes(h, v), point, v),
        "K": _at(_slopes(h, q), point, v),
        "S": _at(-_slopes(h, u), point, v),
        "h": _at(h, point, v),
    }
    try:
        return _made(model, raw, point, n)
    except OutOfReach as trouble:
        raise _too_long(trouble.what) from trouble


def _too_long(why: str) -> RunError:
    return RunError(
        f"the symbolic matrices are too long to write: {why}", fix="use A and B, which contain the numbers", code="E523"
    )


def _made(model: Model, raw: dict[str, sp.Matrix], point: dict[Any, Any], n: int) -> SymbolicLinearization:
    algebra = Algebra(model, cast("list[sp.Expr]", [x for matrix in raw.values() for x in matrix]))
    form = {name: [[algebra.form(x) for x in matrix.row(i)] for i in range(n)] for name, matrix in raw.items()}

    def shown(name: str) -> sp.ImmutableMatrix:
        rows = form[name]
        return sp.ImmutableMatrix(n, len(rows[0]) if rows else 0, [x.expr() for row in rows for x in row])

    inverted = inverse(form["M"], algebra)

    def solved(name: str, sign: int) -> list[list[sp.Expr]]:
        columns = len(form[name][0]) if n else 0
        return [[_entry(row, [form[name][k][j] for k in range(n)], sign) for j in range(columns)] for row in inverted]

    upper = sp.zeros(n, n).row_join(sp.eye(n))
    lower = sp.Matrix(solved("K", -1)).row_join(sp.Matrix(solved("D", -1)))
    inputs = len(model.inputs)
    B = sp.zeros(n, inputs).col_join(sp.Matrix(n, inputs, [x for row in solved("S", 1) for x in row]))
    left = [x.expr() for row in form["h"] for x in row]
    return SymbolicLinearization(
        M=shown("M"),
        D=shown("D"),
        K=shown("K"),
        S=shown("S"),
        A=sp.ImmutableMatrix(upper.col_join(lower)),
        B=sp.ImmutableMatrix(B),
        point=point,
        conditions=tuple(cast("sp.Eq", sp.Eq(x, 0, evaluate=False)) for x in left if x != 0),
    )


def _entry(row: list[FormRatio], column: list[Form], sign: int) -> sp.Expr:
    """Σ_k (M⁻¹)_ik column_k as a single fraction."""
    terms = [
        sign * (ratio.over * x).expr() / ratio.under.expr()
        for ratio, x in zip(row, column, strict=True)
        if ratio.over.parts and x.parts
    ]
    return written(cast("sp.Expr", sp.Add(*terms)), row[0].over.algebra)


def _slopes(h: sp.Matrix, by: list[Any]) -> sp.Matrix:
    """∂h/∂by, with a symbol for every coordinate, rate and input."""
    return sp.Matrix(h.rows, len(by), lambda i, k: sp.diff(h[i], by[k]))


def _at(matrix: sp.Matrix, point: dict[Any, Any], v: list[Any]) -> sp.Matrix:
    still = dict.fromkeys(v, sp.S.Zero)
    return sp.Matrix(matrix.applyfunc(lambda x: x.xreplace(still).xreplace(point)))


def _point(linear: LinearModel) -> dict[sp.Expr, sp.Expr]:
    """Coordinate or input → exact value, or the symbol for its value at the equilibrium; t has its value at that
    moment."""
    model = linear.model
    taken = set(model.symbols)
    found: dict[sp.Expr, sp.Expr] = {}
    values = [(c.symbol, linear.at[c.name]) for c in model.coordinates]
    values += [(i.symbol, linear.inputs_at[i.name]) for i in model.inputs]
    for symbol, value in values:
        exact = _exact(value)
        if exact is None:
            name = f"{plain(symbol)}_0"
            while name in taken:
                name += "_0"
            taken.add(name)
            exact = sp.Symbol(name)
        found[symbol] = exact
    if linear.time:
        found[time] = sp.Float(linear.time)
    return found


def _exact(value: float) -> sp.Expr | None:
    """0 or a fraction of a turn with a small denominator; None for any other number."""
    if value == 0:
        return sp.S.Zero
    part = Fraction(value / np.pi).limit_denominator(12)
    if part and abs(value - float(part) * np.pi) <= EXACT_TOLERANCE * max(1.0, abs(value)):
        return sp.Rational(part.numerator, part.denominator) * sp.pi
    return None
