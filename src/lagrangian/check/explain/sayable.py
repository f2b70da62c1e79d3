"""A quantity that an answer may say, and what another value in its place adds to energies, forces and equations."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import sympy as sp

from lagrangian.page.formula import Left
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class Effect:
    """What another value of a quantity adds to T*, to V, to every Ξ_i, to the left-hand sides and to D."""

    T: sp.Expr = sp.S.Zero
    V: sp.Expr = sp.S.Zero
    Xi: tuple[sp.Expr, ...] = ()
    left: tuple[sp.Expr, ...] = ()
    D: sp.Expr = sp.S.Zero


Adds: TypeAlias = Callable[[sp.Expr], Effect]


@dataclass(frozen=True, eq=False)
class Sayable:
    """A quantity of a body, of another element or of a coordinate, and what another value in its place adds.

    ``words`` are those of a sentence, without an article. ``adds`` takes what is written, counted as ``right`` is.
    """

    kind: str
    owner: Any
    words: tuple[str | Left, ...]
    right: sp.Expr
    adds: Adds
    coordinate: str | None = None
    parts: tuple[tuple[Any, sp.Expr], ...] = ()
    """The elements and the values of forces of which it is the sum."""
    also: tuple[str, ...] = ()
    """The other elements of which it is, too."""
    axis: int | None = None
    """Along which axis of a body it is a component, from 0."""
    entry: str = ""
    """The row and the column of the mass matrix in which it stands, "12", off its diagonal."""


def pushing(force: sp.Expr, slopes: Sequence[sp.Expr]) -> Effect:
    """What a force adds to the left-hand sides, that has these lever arms."""
    return Effect(left=tuple(force * x for x in slopes))
