"""The box of coordinates in which equilibria are sought."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.advice import Advice, Argument
from lagrangian.equilibria.orientations import SIDE as ORIENTED
from lagrangian.errors import RunError
from lagrangian.model import Model
from lagrangian.model.elements import answers
from lagrangian.records import dataclass
from lagrangian.values.dimensions import LENGTH, NONE, Dim
from lagrangian.values.values import Given, Group, number

Array = NDArray[np.float64]

TURN = 2 * np.pi
LENGTHS = 4.0
"""A side that is a length extends to this multiple of the largest length among the parameters."""

CHARGE, CURRENT = Dim.of_unit(answers.CHARGE), Dim.of_unit(answers.CURRENT)

SIDE = 10.0
"""Half the length of a side if no length is known."""

MAX_EQUILIBRIA = 500
"""A search ends when it has found more and there are others still: which of them it finds is chance."""

LeftOut: TypeAlias = Literal["outside", "negative", "moving"]
"""Why a root is not listed: it is outside the box that was given, has a positive coordinate that is not, or does not
rest at other times."""


@dataclass(frozen=True, eq=False)
class Box:
    """Low and high ends by coordinate; ``turns``: periodic with a whole turn; ``given``: the user gave the side;
    ``positive``: a distance, always above 0.
    """

    names: tuple[str, ...]
    low: Array
    high: Array
    turns: NDArray[np.bool_]
    given: NDArray[np.bool_]
    positive: NDArray[np.bool_]

    @property
    def sides(self) -> dict[str, tuple[float, float]]:
        """(low, high) by coordinate."""
        return {n: (float(a), float(b)) for n, a, b in zip(self.names, self.low, self.high, strict=True)}

    def centre(self) -> Array:
        """0 if the box contains it, otherwise the middle of the box."""
        inside = (self.low <= 0) & (self.high >= 0) & ~self.positive
        return np.where(inside, 0.0, (self.low + self.high) / 2)

    def placed(self, q: Array) -> tuple[Array, LeftOut | None]:
        """A root with whole turns subtracted so that it lies in the box, and why it is left out, if it is: it lies
        outside a given side, or a positive coordinate is not."""
        slack = 1e-9 * (self.high - self.low)
        turned = self.low - slack + (q - self.low + slack) % TURN
        q = np.where(self.turns & self.given, turned, q)
        inside = (q >= self.low - slack) & (q <= self.high + slack)
        if not (q > 0)[self.positive].all():
            return q, "negative"
        return q, None if (inside | ~self.given).all() else "outside"

    def listed(self, roots: Array) -> int:
        """How many of the roots (N, n) are not left out."""
        return sum(self.placed(q)[1] is None for q in roots)

    def words(self, why: str, count: int) -> str:
        """How many roots are left out for a reason."""
        one = count == 1
        if why == "outside":
            return f"{count} more {'lies' if one else 'lie'} outside the box that was given"
        if why == "moving":
            return f"{count} more {'holds' if one else 'hold'} at one time only, because forces change"
        names = ", ".join(name for name, positive in zip(self.names, self.positive, strict=True) if positive)
        is_left = "is" if one else "are"
        return f"{count} more {is_left} left out, where a coordinate that is always positive is not ({names})"


def check_few(model: Model, box: Box, isolated: Array) -> None:
    """Raise `RunError` if the isolated roots of a search that did not find all are too many for a list."""
    if box.listed(isolated) > MAX_EQUILIBRIA:
        raise RunError(
            f"system '{model.name}' has more than {MAX_EQUILIBRIA} equilibria in the box, and a search finds some of "
            "them by chance",
            fix=Advice("narrow ", Argument("box"), " to those you look for, or say from how many ", Argument("starts")),
            code="E601",
        )


def make_box(
    given: Given,
    names: tuple[str, ...],
    asked: Mapping[Any, Any] | None,
    turns: NDArray[np.bool_],
    charge: float | None = None,
    quaternions: Sequence[int] = (),
) -> Box:
    """The box that the user gave; by default (−π, π] for angles, and a multiple of the lengths of the parameters for
    the rest; ``charge`` is the largest charge of a capacitor, if that is known. A name with a prime is a current;
    ``quaternions`` are the places of their entries."""
    low, high, told = np.empty(len(names)), np.empty(len(names)), np.zeros(len(names), bool)
    dims = tuple(given.states.dims[given.states.names.index(name)] for name in names)
    sides = _sides(names, dims, asked)
    reach = {dim: _reach(given, dim) for dim in (LENGTH, CURRENT)}
    if charge is not None:
        reach[CHARGE] = LENGTHS * charge
    positive = {c.name for c in given.model.coordinates if c.positive}
    distances = np.array([name in positive for name in names], bool)
    for k, name in enumerate(names):
        if name in sides:
            low[k], high[k] = sides[name]
            told[k] = True
            continue
        half = np.pi if turns[k] or dims[k] == NONE else reach.get(dims[k] or LENGTH, reach[LENGTH])
        half = ORIENTED if k in quaternions else half
        low[k], high[k] = 0.0 if distances[k] else -half, half
    return Box(names, low, high, turns, told, distances)


def _sides(
    names: tuple[str, ...], dims: tuple[Dim | None, ...], asked: Mapping[Any, Any] | None
) -> dict[str, tuple[float, float]]:
    if asked is None:
        return {}
    if not isinstance(asked, Mapping):
        raise RunError(
            "box must be a mapping from coordinates to (low, high)", fix="{coordinate: (low, high)}", code="E501"
        )
    group = Group("coordinate", names, dims)
    found: dict[str, tuple[float, float]] = {}
    for key, side in asked.items():
        (name,) = group.values({key: 0.0})
        dim = dims[names.index(name)]
        if isinstance(side, str) or not isinstance(side, Sequence | np.ndarray) or len(side) != 2:
            raise RunError(f"the box of '{name}' must be (low, high) (got {side!r:.40})", code="E501")
        ends = (number(side[0], f"low end of '{name}'", dim), number(side[1], f"high end of '{name}'", dim))
        if not ends[0] < ends[1]:
            raise RunError(
                f"the box of '{name}' is empty: {ends[0]:.6g} to {ends[1]:.6g}",
                fix="give the lower end first",
                code="E501",
            )
        found[name] = ends
    return found


def _reach(given: Given, unit: Dim) -> float:
    """Half a side of the box for a coordinate that is not an angle: a multiple of the largest length, or current."""
    parameters = given.parameters
    if given.dimensions is None:
        return SIDE
    values = {p.name: p.value for p in given.model.parameters}
    lengths = [
        abs(values[name] or 0.0) for name, dim in zip(parameters.names, parameters.dims, strict=True) if dim == unit
    ]
    return LENGTHS * max(lengths) if lengths and max(lengths) > 0 else SIDE
