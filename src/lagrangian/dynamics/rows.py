"""The rows of constraints: what must hold between velocities, and where it comes from.

A row is a node linear in the velocities, c = A(q, t) v + a₀(q, t), that must be zero. A row on positions, f(q, t) = 0,
gives c = ḟ and keeps f. Its multiplier acts so as to increase f, or c:

    M v̇ + h = Ξ + Aᵀ λ        A v̇ + γ = 0,   γ = ċ at v̇ = 0
"""

from __future__ import annotations

from collections.abc import Callable

from lagrangian.dynamics.axes import Accelerations
from lagrangian.errors import Place
from lagrangian.model import Friction
from lagrangian.records import dataclass


@dataclass(frozen=True)
class ConstraintRow:
    """One row: ``rate`` is c, ``residual`` is f of a row on positions, in the same axes as c.

    ``name`` is what the row is called (``loop.x``). Rows of one ``closure`` are measured together when the program asks
    whether one of them depends on the others. ``acceleration`` gives c's derivative out of accelerations that are there
    already; without it c is differentiated. ``scale`` is the size, in the unit of f, that a gap is compared with, and
    ``place`` where the constraint stands in its file.
    """

    name: str
    closure: str
    rate: int
    residual: int | None = None
    acceleration: Callable[[Accelerations], int] | None = None
    scale: float = 1.0
    place: Place | None = None


@dataclass(frozen=True)
class Drag:
    """A friction whose normal force N is a multiplier: its effort is ``factor`` · N on ``rate``.

    N is λ of the row in ``rows``, with its sign, or √(λ₁² + λ₂² + …) of several. ``factor`` is None where it is not
    known whether the friction slips, and in which sense: then its effort is −μ |N| sign(rate), and ``coefficient`` is
    μ. ``friction`` is its element.
    """

    rate: int
    coefficient: int
    factor: int | None
    rows: tuple[str, ...]
    friction: Friction


@dataclass(frozen=True)
class Added:
    """What one element added to a system: potentials, and (rate, effort) pairs of what it stores and of what acts."""

    potentials: list[int]
    stores: list[tuple[int, int]]
    efforts: list[tuple[int, int]]
