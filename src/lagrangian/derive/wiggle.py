"""What moves when one coordinate wiggles: the rank of the coordinates, and the boxes of the lecture.

The columns ∂r/∂ξ_i (and ∂ω/∂ξ̇_i if it can turn) of every body are computed at random states. Their common rank decides
whether the coordinates are independent; if a column is not zero, the body is in the box of ξ_i.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TypeAlias

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.derive.sample import Sampler
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, NotAlgebraic, PrimePoint, from_sympy, gradient
from lagrangian.model import Element, Frame, Model
from lagrangian.model.elements import MovingMass
from lagrangian.model.rows import rows_of
from lagrangian.records import dataclass

SMALL = 1e-9
"""A singular value or a column below this relative size counts as zero."""
STATES = 3

Rows: TypeAlias = "tuple[Element, MovingMass]"
"""A block of rows ∂(rate)/∂ξ̇ of one element."""


@dataclass(frozen=True, eq=False)
class Wiggle:
    """The result of `study`: ``moved[i]`` are the bodies in the box of coordinate i.

    ``rank`` is the rank of the velocities of everything with mass. It equals the number of coordinates; otherwise
    `study` has raised an error.
    With ``rows``, the rows of the constraints had to be counted too: something without mass is carried along by them.
    """

    moved: tuple[tuple[Element, ...], ...]
    rank: int
    rows: bool = False


def study(model: Model) -> Wiggle:
    """Return what each coordinate moves; raise `ModelError`, with names, for dependent, missing and idle
    coordinates."""
    for frame in model.floating:
        _refuse_quaternion(frame)
    found = _study(model, _blocks(model), refuse=not model.constraints)
    if found.rank == len(model.coordinates):
        return found
    rows: list[Rows] = [(r.element, MovingMass((r.rate,), ((sp.S.One,),))) for r in rows_of(model)]
    return replace(_study(model, _blocks(model), rows), moved=found.moved, rows=True)


def _study(model: Model, blocks: list[Rows], rows: Sequence[Rows] = (), *, refuse: bool = True) -> Wiggle:
    """What moves with what; ``rows`` of constraints are counted with what has mass."""
    blocks = [*blocks, *rows]
    rates = [c.rate for c in model.coordinates]
    weights = [x for _, mass in blocks for row in mass.weight for x in row]
    sampler = Sampler(model, weights, slopes_of=[r for _, mass in blocks for r in mass.rates], by=rates)
    n, best = len(rates), -1
    seen = np.zeros((len(blocks), n), dtype=bool)
    worst: np.ndarray = np.zeros((0, n))
    for _, values in sampler.states(STATES):
        columns, weighted = _split(blocks, np.array(values), n)
        for k, block in enumerate(columns):
            seen[k] |= np.abs(block).max(axis=0, initial=0.0) > SMALL
        stacked = np.vstack(weighted)
        rank = _rank(stacked)
        if rank > best:
            best, worst = rank, stacked
    moved = tuple(_bodies(blocks, seen[:, i]) for i in range(n))
    if best < n and refuse:
        _refuse(model, blocks, seen, worst)
    return Wiggle(moved, best)


def _blocks(model: Model) -> list[Rows]:
    """Those of bodies first, then those of energies that were given."""
    others = [e for e in model.elements if e not in model.bodies]
    return [(element, mass) for element in (*model.bodies, *others) for mass in element.masses(model)]


def _split(blocks: Sequence[Rows], values: np.ndarray, n: int) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Split the flat list of sampled values into the columns of each block, and these multiplied by the weight."""
    columns: list[np.ndarray] = []
    weighted: list[np.ndarray] = []
    slope, at = 0, n * sum(len(mass.rates) for _, mass in blocks)
    for _, mass in blocks:
        rows = len(mass.rates)
        jacobian = values[slope : slope + rows * n].reshape(rows, n)
        slope += rows * n
        size = len(mass.weight)
        weight = values[at : at + size * size].reshape(size, size)
        at += size * size
        columns.append(jacobian)
        weighted.append(weight @ jacobian)
    return columns, weighted


def _rank(matrix: np.ndarray) -> int:
    scale = np.linalg.norm(matrix, axis=0)
    live = matrix[:, scale > 0] / scale[scale > 0]
    if live.shape[1] == 0:
        return 0
    singular = np.linalg.svd(live, compute_uv=False)
    return int((singular > SMALL * singular[0]).sum())


def _bodies(blocks: Sequence[Rows], seen: np.ndarray) -> tuple[Element, ...]:
    chosen: list[Element] = []
    for (element, _), moves in zip(blocks, seen, strict=True):
        if moves and element not in chosen:
            chosen.append(element)
    return tuple(chosen)


def _refuse_quaternion(frame: Frame) -> None:
    """Raise the error for the four dependent entries of a quaternion."""
    assert frame.floating is not None
    listed = ", ".join(c.name for c in frame.floating.orientation)
    raise ModelError(
        f"frame '{frame.name}' floats with a quaternion: its four entries {listed} tell three angles, so they are "
        "dependent, and its velocities are not the rates of its coordinates",
        place=frame.place,
        fix="derive writes its equations in velocities that are not the rates of coordinates; for equations in "
        "coordinates alone describe the turn by three angles: frame(yaw, axis=(0, 0, 1)), then "
        "frame(pitch, axis=(0, 1, 0), parent=…), then a third",
        code="E202",
    )


def _refuse(model: Model, blocks: Sequence[Rows], seen: np.ndarray, stacked: np.ndarray) -> None:
    """Raise the error that names the coordinates at fault."""
    names = [c.name for c in model.coordinates]
    for i, c in enumerate(model.coordinates):
        if np.abs(stacked[:, i]).max(initial=0.0) > SMALL:
            continue
        turned = [element for (element, mass), moves in zip(blocks, seen[:, i], strict=True) if moves and mass.turning]
        if turned:
            raise ModelError(
                f"coordinate '{c.name}' only turns {turned[0].title}, which has no inertia about that axis",
                place=c.place,
                fix="give the body that inertia, or leave the coordinate out",
                code="E104",
            )
        raise ModelError(
            f"coordinate '{c.name}' moves nothing that has mass: if it alone changes, every body stays",
            place=c.place,
            fix=f"leave '{c.name}' out, or put it into the position of a body",
            code="E201",
        )
    vector = _null(stacked)
    involved = [(names[i], x) for i, x in enumerate(vector) if abs(x) > 1e-6]
    wiggled = ", ".join(f"{name} by {_figure(x)}" for name, x in involved)
    listed = " and ".join(f"'{name}'" for name, _ in involved)
    place = model.coordinates[names.index(involved[-1][0])].place
    raise ModelError(
        f"coordinates {listed} are dependent: nothing with mass moves if they change together, {wiggled}",
        place=place,
        fix=f"{len(names)} coordinates are too many (independent: {_rank(stacked)}); remove one of them",
        code="E202",
    )


def _null(matrix: np.ndarray) -> np.ndarray:
    """A null vector with few nonzero entries, the largest of which is 1."""
    n = matrix.shape[1]
    for size in range(2, n + 1):  # the first columns that depend on each other name the fault most shortly
        for last in range(size - 1, n):
            block = matrix[:, last - size + 1 : last + 1]
            _, singular, right = np.linalg.svd(block)
            if len(singular) < size or singular[-1] <= SMALL * singular[0]:
                vector = np.zeros(n)
                vector[last - size + 1 : last + 1] = right[-1]
                return vector / vector[np.abs(vector).argmax()]
    raise AssertionError("a matrix of deficient rank has a null vector")


def _figure(x: float) -> str:
    near = Fraction(x).limit_denominator(12)
    return str(near) if abs(float(near) - x) < 1e-6 else f"{x:.3g}"


def depends(model: Model, expr: sp.Expr, symbol: sp.Expr) -> bool:
    """Whether ``expr`` changes with a coordinate, decided by its derivative."""
    found = model.remembered(("changes with", expr), lambda: _changes_with(model, expr))
    return expr.has(symbol) and bounded.diff(expr, symbol) != 0 if found is None else symbol in found


class _Point:
    """A random point of a prime field, with what several expressions share evaluated once."""

    def __init__(self) -> None:
        self.graph = Graph()
        self.table: dict[sp.Basic, int] = {}
        self.made: dict[sp.Basic, int] = {}
        self.point = PrimePoint(self.graph)

    def slopes(self, expr: sp.Expr, names: Iterable[sp.Basic], symbols: Sequence[sp.Expr]) -> list[int] | NotAlgebraic:
        """The derivatives of an expression by some of its names."""
        for x in names:
            self.table.setdefault(x, self.graph.input("x", len(self.table)))
        node = from_sympy(self.graph, expr, self.table, self.made)
        return self.point.values(gradient(self.graph, node, [self.table[x] for x in symbols]))


def _changes_with(model: Model, expr: sp.Expr) -> frozenset[sp.Expr] | None:
    """The coordinates whose derivatives are not identically 0: not 0 at a random point of a prime field.

    None if the field has no value for a part of the expression.
    """
    names = bounded.names(expr)
    there = [c.symbol for c in model.coordinates if c.symbol in names]
    values = model.remembered("point of the field", _Point).slopes(expr, sorted(names, key=str), there)
    if isinstance(values, NotAlgebraic):  # perhaps only beside what others contain
        values = _Point().slopes(expr, sorted(names, key=str), there)
    if isinstance(values, NotAlgebraic):
        return None
    return frozenset(x for x, value in zip(there, values, strict=True) if value)
