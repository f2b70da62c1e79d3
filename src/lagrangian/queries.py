"""Functions of a compiled system that return points, frames and expressions at any state."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike, NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics, read
from lagrangian.calls import COMPILED, Guided
from lagrangian.errors import ModelError
from lagrangian.model import Frame, Point, as_expr
from lagrangian.page.plain import plain

if TYPE_CHECKING:
    from lagrangian.graph import Program
    from lagrangian.model import Model

REMEMBERED = 64
"""The number of points, frames and expressions whose code is kept; the most recently used stay."""


class Looking(Guided):
    """The part of a compiled system that evaluates points, frames and expressions; `lagrangian.compiled.Compiled` adds
    the equations."""

    _guide = COMPILED
    _model: Model
    _lanes: int | None
    _threads: int | None
    _seen: dict[Any, machine.Kernel]

    def _called(self, kernel: machine.Kernel, given: tuple[Any, ...]) -> Any:
        """Call a kernel with coordinates, …, inputs, parameters and t; if the result is not finite, explain why."""
        raise TypeError(f"{type(self).__name__} calls no kernel")

    def _made(
        self, key: Any, make: Callable[[], Program], *, still: bool = True, admitted: bool = False
    ) -> machine.Kernel:
        """Return what was compiled under a key; compile it at the first request.

        With ``still``, v may be left out and is 0; with ``admitted``, masses are checked in all parameters given.
        """
        found = self._seen.pop(key, None)
        if found is None:
            optional = {"u": 0.0, "t": 0.0, **({"v": 0.0} if still else {})}
            found = machine.compile(make(), optional=optional, lanes=self._lanes, threads=self._threads)
            if admitted:
                self._admit(found)
        self._seen[key] = found  # the most recently used is last
        for oldest in list(self._seen)[:-REMEMBERED]:
            self._seen.pop(oldest, None)
        return found

    def _admit(self, kernel: machine.Kernel) -> None:
        """Have a kernel refuse parameters with which a mass or an inertia is impossible."""
        if not self._model.parameters:
            return
        # imported here because exporting source code needs no machine code
        from lagrangian.simulate.admission import Admission, fitness

        fit = fitness(self._model, tuple(p.name for p in self._model.parameters))
        if fit is not None:
            kernel.admit = Admission(self._model, fit)

    def point(
        self, point: str | Point, q: ArrayLike, v: ArrayLike | None = None, p: Any = None, t: ArrayLike = 0.0
    ) -> dict[str, NDArray[np.float64]]:
        """Return the position ``r`` and velocity ``v`` of a point, ``(..., d)``, and ``J`` = ∂v/∂q̇, ``(..., d, n)``.

        ``bias``, ``(..., d)``, is its acceleration while v does not change: r̈ = J v̇ + bias.
        ``point`` is a name, or any point of the system, with or without a name. Components are along the fixed axes, d
        = 2 in the plane and 3 in space. The rates are 0 unless given. Raises `ModelError` if there is no such point.
        """
        found = dynamics.named_place(self._model, point, Point)
        kernel = self._made(("point", found), lambda: dynamics.point_program(self._model, found))
        return self._called(kernel, (q, v, None, p, t))

    def frame(
        self, frame: str | Frame, q: ArrayLike, v: ArrayLike | None = None, p: Any = None, t: ArrayLike = 0.0
    ) -> dict[str, NDArray[np.float64]]:
        """Return the rotation matrix ``R`` and angular velocity ``omega`` [rad/s] of a frame, and ``J`` = ∂omega/∂q̇.

        ``bias`` is its angular acceleration while v does not change, shaped as omega: ω̇ = J v̇ + bias.
        ``frame`` is a name, or any frame of the system. A vector with components x in the frame has components R x in
        the fixed axes; omega and J are in the fixed axes, too. R is ``(..., d, d)``. In space omega is ``(..., 3)`` and
        J ``(..., 3, n)``; in the plane they are ``(...)`` and ``(..., n)``, positive counter-clockwise. Raises
        `ModelError` if there is no such frame.
        """
        found = dynamics.named_place(self._model, frame, Frame)
        kernel = self._made(("frame", found), lambda: dynamics.frame_program(self._model, found))
        return self._called(kernel, (q, v, None, p, t))

    def evaluate(
        self,
        expression: Any,
        q: ArrayLike,
        v: ArrayLike | None = None,
        u: Any = None,
        p: Any = None,
        t: ArrayLike = 0.0,
    ) -> NDArray[np.float64]:
        """Return the value of an expression, shape ``(...)``, in SI units.

        ``expression`` is SymPy or text. It may contain coordinates, rates, accelerations (computed from the equations
        of motion), inputs, parameters, definitions and t. A SymPy matrix, or a list, gives ``(..., *shape)``. Each
        expression is compiled at its first call. Raises `ModelError` for a symbol that the system does not have.
        """
        flat, shape = self._flat(expression)
        kernel = self._made(("expressions", tuple(flat)), lambda: _observing(self._model, flat))
        answer = self._called(kernel, (q, v, u, p, t))
        if shape == ():
            return answer if not isinstance(answer, Mapping) else answer["expression"]
        columns = list(answer.values()) if isinstance(answer, Mapping) else [answer]
        stacked = np.stack(columns, axis=-1)
        return stacked.reshape(*stacked.shape[:-1], *shape)

    def _flat(self, expression: Any) -> tuple[list[sp.Expr], tuple[int, ...]]:
        """The entries of the requested expression, matrix or list, row after row, and its shape."""
        if isinstance(expression, sp.MatrixBase):
            if not expression.shape[0] * expression.shape[1]:
                raise ModelError("a matrix to evaluate has no entries", fix="give it at least one", code="E501")
            return [as_expr(x, "what is evaluated") for x in expression.flat()], tuple(expression.shape)
        if isinstance(expression, (list, tuple)):
            parts = [self._flat(x) for x in expression]
            if not parts or len({shape for _, shape in parts}) != 1:
                raise ModelError(
                    "a list to evaluate must have at least one entry, and all entries must have the same shape",
                    code="E501",
                )
            return [x for flat, _ in parts for x in flat], (len(parts), *parts[0][1])
        if isinstance(expression, str):
            expression = read.parse_expression(expression, read.Scope(self._model.symbols), what="what is evaluated")
        return [as_expr(expression, "what is evaluated")], ()


_TEXT = frozenset((str,))


def by_name(given: Any) -> Any:
    """Return a mapping with names as keys, whether its keys were names or symbols; return anything else unchanged."""
    if given is None or type(given) is np.ndarray:
        return given
    if type(given) is dict and _TEXT.issuperset(map(type, given)):
        return given
    if isinstance(given, Mapping):
        return {plain(k) if isinstance(k, sp.Basic) else k: value for k, value in given.items()}
    return given


def _observing(model: Model, exprs: list[sp.Expr]) -> Program:
    names = ["expression"] if len(exprs) == 1 else [f"expression {k}" for k in range(1, len(exprs) + 1)]
    return dynamics.observe(model, dict(zip(names, exprs, strict=True)), state=False)
