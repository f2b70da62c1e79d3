"""Base parameters: the combinations of masses, first moments and inertias on which the motion depends.

r = Y(q, v, v̇) π is linear in the inertial parameters (`regressor`). Columns of Y that are combinations of others at all
states add nothing: with Y_d = Y_b X only π_b + X π_d can be found from any motion, and nothing else of π matters to it.
Which columns are independent is found in floating-point numbers and again in a prime field, where nothing is rounded,
both at one value of the lengths; X follows from numbers. Source: M. Gautier, W. Khalil, Direct calculation of minimum
set of inertial parameters of serial robots, IEEE Trans. Robotics and Automation 6 (1990) 368-373.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike, NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.advice import Advice, Argument
from lagrangian.dynamics.notices import configurations
from lagrangian.errors import ModelError, RunError
from lagrangian.fit.regressor import Columns, Rigid, columns
from lagrangian.graph import NotAlgebraic, Output, PrimePoint, Program, evaluate, reached
from lagrangian.graph.prime_field import Echelon
from lagrangian.graph.to_sympy import number
from lagrangian.model import Model
from lagrangian.page.figures import figure
from lagrangian.page.formula import Item, Left, Table, formula, text
from lagrangian.page.report import Part, Report
from lagrangian.records import dataclass, field
from lagrangian.values.values import Given, Named
from lagrangian.write.written import Written

Array = NDArray[np.float64]

SPARE = 8
"""States beyond those that the number of parameters asks for."""

MOST = 1200
"""Inertial parameters above which the question is refused."""

ROUNDING = 1e-9
"""A coefficient below this part of the largest of its column is rounding."""

NOTHING = 1e-13
"""A column below this part of the largest is 0: columns have different units, so it is little more than rounding."""

FIRST = {"J": 0, "mx": 0, "my": 0, "Jzz": 0, "Jxy": 0, "Jxz": 0, "Jyz": 0, "Jxx": 1, "mz": 2, "Jyy": 2, "m": 3}
"""Which parameters are kept first: of a joint about z the others join those of the link before."""


@dataclass(frozen=True, eq=False)
class BaseParameters(Written):
    """The combinations of inertial parameters on which a motion depends, and the regressor that belongs to them.

    ``names`` are those of all inertial parameters, ``meaning`` what each is in the symbols of the system, ``bases`` the
    combinations: for each the coefficients by name. ``unseen`` have no effect on any motion. ``values`` (n_b,) are the
    values of the combinations, NaN where a parameter has no value. The coefficients hold for the lengths in
    ``parameters``.
    """

    model: Model = field(repr=False)
    names: tuple[str, ...]
    meaning: Mapping[str, sp.Expr] = field(repr=False)
    about: Mapping[str, str] = field(repr=False)
    bases: tuple[Mapping[str, float], ...]
    unseen: tuple[str, ...]
    values: Array
    parameters: Mapping[str, float] = field(repr=False)
    exact: bool
    _program: Program = field(repr=False)

    def __len__(self) -> int:
        """The number of base parameters."""
        return len(self.bases)

    def regressor(self, q: ArrayLike, v: ArrayLike, a: ArrayLike, t: ArrayLike = 0.0) -> Array:
        """Return Y_b of shape ``(..., n, n_b)`` at coordinates q, velocities v and accelerations a.

        ``t`` [s] is the time, one or as many as there are states; it matters only where a motion is prescribed.

        Y_b π_b is what inertia and weight take of the generalized forces: Ξ of the other forces, with those of
        constraints, less what springs store, equals it. With measured forces it is the matrix of a linear
        least-squares problem for π_b.
        """
        p = np.array([self.parameters[x] for x in self._program.inputs["p"]])
        found = np.asarray(self._kernel(q, v, a, p, t), float)
        n = len(self.model.velocities)
        return found.reshape(*np.shape(found)[:-1], n, len(self.bases))

    @cached_property
    def _kernel(self) -> machine.Kernel:
        return machine.compile(self._program)

    def report(self) -> Report[Model]:
        """Return the report: the combinations with their values, and what the letters stand for."""
        return _report(self)


def base_parameters(model: Model, params: Named | None = None) -> BaseParameters:
    """Return the base parameters of a model; see `lagrangian.System.base_parameters`."""
    if not model.bodies:
        raise ModelError(
            f"system '{model.name}' has no bodies, so it has no inertial parameters",
            fix="describe it by particles and rigid bodies",
            code="E412",
        )
    made = columns(model)
    if len(made.nodes) > MOST:
        raise ModelError(
            f"system '{model.name}' has {len(made.nodes)} inertial parameters, more than {MOST}", code="E601"
        )
    labels = _labels(made)
    given = _given(model, made, params)
    order = sorted(range(len(labels)), key=lambda k: FIRST[made.parameters[k][1]])
    kept, unseen, exact = _independent(model, made, order, given)
    shares = _combinations(model, made, kept, unseen, given)
    bases = tuple(
        {labels[k]: 1.0} | {labels[j]: x for j, x in share.items()} for k, share in zip(kept, shares, strict=True)
    )
    meaning = {labels[k]: rigid.values.get(name, sp.S.Zero) for k, (rigid, name) in enumerate(made.parameters)}
    known = {p.symbol: given[p.name] for p in model.parameters if p.name in given}
    numbers = {name: _number(x, known) for name, x in meaning.items()}
    return BaseParameters(
        model=model,
        names=tuple(labels),
        meaning=meaning,
        about={label: _place(rigid) for label, (rigid, _) in zip(labels, made.parameters, strict=True)},
        bases=bases,
        unseen=tuple(labels[k] for k in unseen),
        values=np.array([sum(c * numbers[name] for name, c in base.items()) for base in bases]),
        parameters=given,
        exact=exact,
        _program=_program(made, kept),
    )


def _labels(made: Columns) -> list[str]:
    """Names for all parameters: m_1, mx_1, Jxx_1, … of the first rigid part, and so on."""
    parts: dict[int, int] = {}
    for rigid, _ in made.parameters:
        parts.setdefault(id(rigid), len(parts) + 1)
    return [f"{name}_{parts[id(rigid)]}" for rigid, name in made.parameters]


def _place(rigid: Rigid) -> str:
    """What a rigid part consists of."""
    return ", ".join(body.title for body in rigid.bodies)


def _given(model: Model, made: Columns, params: Named | None) -> dict[str, float]:
    """The values of all parameters that have one; an error for those that Y contains and that have none."""
    values = {p.name: p.value for p in model.parameters} | Given.of(model, dynamics.rhs(model)).parameters.values(
        params
    )
    nodes = set(reached(made.graph, [i for column in made.nodes for i in column]))
    missing = [
        p.name
        for p, node in zip(model.parameters, made.inputs.p, strict=True)
        if node in nodes and values[p.name] is None
    ]
    if missing:
        raise RunError(
            f"the length or acceleration '{missing[0]}' has no value, and the combinations depend on it. Missing: "
            f"{', '.join(missing)}",
            fix=Advice("give ", Argument("params", "…", missing[0]), ", or a value where it is declared"),
            code="E401",
        )
    return {name: float(value) for name, value in values.items() if value is not None}


def _independent(
    model: Model, made: Columns, order: Sequence[int], given: Mapping[str, float]
) -> tuple[list[int], list[int], bool]:
    """The columns that are independent, taken in an order, those that are 0, and whether the rank is exact.

    Axes of length 1 may have components that are rounded; then no combination is exact, and numbers decide.
    """
    kept, unseen = _by_numbers(_stacked(model, made, given), order)
    rows = _in_the_field(model, made, given)
    if rows is None:
        return kept, unseen, False
    p, matrix = rows
    echelon, exact = Echelon(p), list[int]()
    for k in order:
        column = [row[k] for row in matrix]
        if any(column) and echelon.take(k, column):
            exact.append(k)
    return kept, unseen, sorted(exact) == kept


def _count(model: Model, made: Columns) -> int:
    """The number of states at which Y is evaluated."""
    return len(made.nodes) // max(1, len(model.velocities)) + SPARE


def _in_the_field(model: Model, made: Columns, given: Mapping[str, float]) -> tuple[int, list[list[int]]] | None:
    """The prime, and the rows of Y at random states in its field; None if the field has no values for it."""
    fixed = {
        node: Fraction(str(number(given.get(p.name, 1.0))))
        for p, node in zip(model.parameters, made.inputs.p, strict=True)
    }
    ids = [i for column in made.nodes for i in column]
    n, prime, rows, seed = len(model.velocities), 0, list[list[int]](), 0
    while len(rows) < n * _count(model, made):
        seed += 1
        point = PrimePoint(made.graph, fixed, seed=seed)
        values = point.values(ids)
        if isinstance(values, NotAlgebraic) or seed > 20 * _count(model, made):
            return None
        prime = prime or point.prime
        if point.prime == prime:
            rows += [[values[k * n + i] for k in range(len(made.nodes))] for i in range(n)]
    return prime, rows


def _stacked(model: Model, made: Columns, given: Mapping[str, float]) -> Array:
    """Y at random states, one below the other, in floating-point numbers."""
    program = _program(made, range(len(made.nodes)))
    source, rows = random.Random(1), list[Array]()
    n = len(model.velocities)
    for q, _ in zip(configurations(model), range(_count(model, made)), strict=False):
        state = {
            "q": q,
            "v": [source.uniform(-1, 1) for _ in range(n)],
            "a": [source.uniform(-1, 1) for _ in range(n)],
            "p": [given.get(name, 1.0) for name in program.inputs["p"]],
            "t": [source.uniform(0, 1)],
        }
        rows.append(np.array(evaluate(program, state)["Y"], float).reshape(n, -1))
    return np.vstack(rows)


def _by_numbers(Y: Array, order: Sequence[int]) -> tuple[list[int], list[int]]:
    """The independent columns and those that are 0, by what projection leaves of each."""
    kept, unseen, basis = list[int](), list[int](), np.zeros((len(Y), 0))
    largest = float(np.abs(Y).max(initial=0.0))
    for k in order:
        column = Y[:, k]
        size = float(np.linalg.norm(column))
        if size <= NOTHING * largest:
            unseen.append(k)
            continue
        left = column - basis @ (basis.T @ column)
        left -= basis @ (basis.T @ left)
        if np.linalg.norm(left) > ROUNDING * size:
            kept.append(k)
            basis = np.column_stack([basis, left / np.linalg.norm(left)])
    return sorted(kept), sorted(unseen)


def _combinations(
    model: Model, made: Columns, kept: Sequence[int], unseen: Sequence[int], given: Mapping[str, float]
) -> list[dict[int, float]]:
    """For every column that is kept, the others that add to it, with their coefficients: Y_d = Y_b X."""
    others = [k for k in range(len(made.nodes)) if k not in kept and k not in unseen]
    if not others or not kept:
        return [{} for _ in kept]
    Y = _stacked(model, made, given)
    size = np.linalg.norm(Y[:, kept], axis=0)
    X = np.linalg.lstsq(Y[:, kept] / size, Y[:, others], rcond=None)[0] / size[:, None]
    X[np.abs(X) <= ROUNDING * np.abs(X).max(axis=0, initial=0.0)] = 0.0
    return [{j: float(x) for j, x in zip(others, row, strict=True) if x} for row in X]


def _program(made: Columns, kept: Sequence[int]) -> Program:
    """q, v, v̇, p, t → Y of some columns, row after row."""
    n = len(made.inputs.v)
    ids = tuple(made.nodes[k][i] for i in range(n) for k in kept)
    names = {group: tuple(x) for group, x in made.groups.items()}
    return Program("regressor", made.graph, names, {"Y": Output(ids, (len(ids),))})


def _number(expr: sp.Expr, known: Mapping[sp.Symbol, float]) -> float:
    value: Any = expr.xreplace({x: sp.Float(v, 17) for x, v in known.items()})
    return float(value) if value.is_number else float("nan")


# -- on paper ----------------------------------------------------------------------------------------------------------


def _symbol(name: str) -> sp.Symbol:
    return sp.Symbol(name, real=True)


def _sum(base: Mapping[str, float]) -> sp.Expr:
    return sp.Add(*[_rounded(c) * _symbol(name) for name, c in base.items()])


def _rounded(c: float) -> sp.Expr:
    """A coefficient with as many digits as a reader wants."""
    near = Fraction(c).limit_denominator(12)
    if abs(float(near) - c) <= 1e-9 * abs(c):
        return sp.Rational(near.numerator, near.denominator)
    return sp.Float(f"{c:.6g}")


def _report(found: BaseParameters) -> Report[Model]:
    rows = [
        (text(str(k)), text(_sum(base)), text("" if np.isnan(value) else figure(float(value))))
        for k, (base, value) in enumerate(zip(found.bases, found.values, strict=True), 1)
    ]
    how = "exactly, in a prime field" if found.exact else "by projection, in floating-point numbers"
    items: list[Item] = [
        text(
            f"The motion depends on {len(found.bases)} combinations of {len(found.names)} inertial parameters and on "
            f"nothing else of them (rank found {how})."
        ),
        Table((text(""), text("combination"), text("value")), tuple(rows)),
    ]
    if found.unseen:
        items.append(text("No motion shows ", *_listed(found.unseen), "."))
    parts = [Part(text("Base parameters"), tuple(items)), Part(text("What the letters are"), tuple(_letters(found)))]
    return Report(f"{found.model.name}: base parameters", found.model, tuple(parts), _data(found))


def _listed(names: Sequence[str]) -> list[str | Left]:
    parts: list[str | Left] = []
    for name in names:
        parts += [", " if parts else "", _symbol(name)]
    return parts


def _letters(found: BaseParameters) -> list[Item]:
    items: list[Item] = [
        text(
            "m is a mass, mx, my, mz are first moments (mass times the way to the centre of mass), J are inertias; all "
            "about the point next to the joint and along the axes of the part's own frame. An index is the number of "
            "the part."
        )
    ]
    parts: dict[str, str] = {}
    for name in found.names:
        parts.setdefault(name.rpartition("_")[2], found.about[name])
    rows = tuple((text(number), text(words)) for number, words in parts.items())
    items.append(Table((text("part"), text("its bodies")), rows))
    items += [formula(_symbol(name), x) for name, x in found.meaning.items() if x != 0]
    return items


def _data(found: BaseParameters) -> dict[str, Any]:
    return {
        "system": found.model.name,
        "count": len(found.bases),
        "bases": [dict(base) for base in found.bases],
        "values": [None if np.isnan(x) else float(x) for x in found.values],
        "unseen": list(found.unseen),
        "meaning": {name: str(x) for name, x in found.meaning.items()},
        "exact": found.exact,
    }
