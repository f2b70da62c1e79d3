"""Equilibria: the points, their stability, their residual, the free directions; and the report of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, overload

import numpy as np

from lagrangian.equilibria.roots import ENOUGH, EXACT
from lagrangian.linear.manifold import point_words
from lagrangian.linear.report import symbol
from lagrangian.linear.stability import Stability
from lagrangian.model import Model
from lagrangian.page.figures import figure, scientific
from lagrangian.page.formula import Item, Table, text
from lagrangian.page.report import Part, Report
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief
from lagrangian.write.written import Written


@dataclass(frozen=True)
class Equilibrium(Brief):
    """An equilibrium: values of all states by name (rates 0), with the inputs and parameters to which it belongs.

    ``residual`` is the largest |h|, relative to the size of h in the box; ``stability`` is the verdict. In a family of
    equilibria this is the one nearest to 0: ``moves`` names the coordinates that change along the family, and
    ``dimension`` is its dimension, 0 for an isolated equilibrium. ``starts`` counts the starting points that led here.
    ``multipliers`` are λ of the rows of constraints; if rows depend on each other, they are one choice among several.
    """

    at: Mapping[str, float]
    inputs: Mapping[str, float]
    parameters: Mapping[str, float]
    residual: float
    stability: Stability
    starts: int = 0
    moves: tuple[str, ...] = ()
    dimension: int = 0
    multipliers: Mapping[str, float] = field(default_factory=dict[str, float])

    def __getitem__(self, name: str) -> float:
        """The value of a coordinate or rate."""
        return self.at[name]

    def __str__(self) -> str:
        """Return the equilibrium and its stability as one line."""
        shown = {name: value for name, value in self.at.items() if value or not name.endswith("'")}
        return f"{point_words(tuple(shown), np.array(list(shown.values())))}: {self.stability.verdict}"


@dataclass(frozen=True, eq=False)
class Equilibria(Written, Sequence[Equilibrium]):
    """The equilibria that were found, sorted by the values of the coordinates.

    ``box`` contains the range of the search for each coordinate; ``free`` the directions on which nothing depends, each
    as coordinate → component, held at ``held``; ``starts`` is the number of starting points. ``sure`` is true if every
    equilibrium was found several times and the last round found nothing new.
    """

    model: Model
    found: tuple[Equilibrium, ...]
    box: Mapping[str, tuple[float, float]]
    free: tuple[Mapping[str, float], ...]
    held: Mapping[str, float]
    starts: int
    sure: bool
    notes: tuple[str, ...] = field(default=())

    @overload
    def __getitem__(self, index: int) -> Equilibrium: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Equilibrium, ...]: ...
    def __getitem__(self, index: int | slice) -> Equilibrium | tuple[Equilibrium, ...]:
        """The equilibrium with an index."""
        return self.found[index]

    def __len__(self) -> int:
        """The number of equilibria."""
        return len(self.found)

    def __iter__(self) -> Iterator[Equilibrium]:
        """Iterate over the equilibria."""
        return iter(self.found)

    def report(self) -> Report[Model]:
        """Return the report."""
        return equilibria_report(self)


def equilibria_report(found: Equilibria) -> Report[Model]:
    """Return the report of equilibria."""
    names = list(found.box)
    letters = [symbol(found.model, name) for name in names]
    items: list[Item] = []
    if found:
        header = (text(""), *(text(x) for x in letters), text("verdict"))
        rows = tuple(
            (
                text(str(k)),
                *(text(_shown(found, e, name)) for name in names),
                text(e.stability.verdict),
            )
            for k, e in enumerate(found)
        )
        items.append(Table(header, rows))
        items += [
            text(f"{k}: {e.stability.reason[0].upper()}{e.stability.reason[1:]}.{_family(e)}")
            for k, e in enumerate(found)
        ]
        items += [text(f"The constraints push at {k}: {_pushes(e)}.") for k, e in enumerate(found) if e.multipliers]
        items.append(
            text(f"At each of them the forces balance to {scientific(EXACT, 1)} of their size in the box searched.")
        )
    items += [text(note[0].upper() + note[1:] + ".") for note in found.notes]
    sides: list[Any] = []
    for name, letter in zip(names, letters, strict=True):
        low, high = found.box[name]
        sides += [", " if sides else "", letter, f" from {figure(low)} to {figure(high)}"]
    items.append(text("Sought from many starts in the box ", *sides, f".{_certain(found)}"))
    return Report(
        f"{found.model.name}: equilibria", found.model, (Part(text("Equilibria"), tuple(items)),), data(found)
    )


def _certain(found: Equilibria) -> str:
    """How often the search found them; the counts themselves depend on last digits, so a text does not contain them."""
    if not found.sure or not found:
        return ""
    return f" Each was found from {ENOUGH} starts or more, and the last round of starts found nothing new."


def _shown(found: Equilibria, e: Equilibrium, name: str) -> str:
    free = any(name in direction for direction in found.free) and name in found.held
    return "free" if free else figure(e.at[name]) + (" *" if name in e.moves else "")


def _pushes(e: Equilibrium) -> str:
    return ", ".join(f"λ of '{name}' = {figure(value)}" for name, value in e.multipliers.items())


def _family(e: Equilibrium) -> str:
    if not e.dimension:
        return ""
    what = "a curve" if e.dimension == 1 else f"a family of {e.dimension} dimensions"
    return f" One of {what} of equilibria along which {', '.join(e.moves)} (*) change."


def data(found: Equilibria) -> dict[str, Any]:
    """Equilibria as plain data."""
    return {
        "system": found.model.name,
        "equilibria": [
            {
                "at": dict(e.at),
                "inputs": dict(e.inputs),
                "parameters": dict(e.parameters),
                "residual": e.residual,
                "verdict": e.stability.verdict,
                "stable": e.stability.stable,
                "reason": e.stability.reason,
                "starts": e.starts,
                "family": {"dimension": e.dimension, "moves": list(e.moves)} if e.dimension else None,
                **({"multipliers": dict(e.multipliers)} if e.multipliers else {}),
            }
            for e in found
        ],
        "box": {name: list(side) for name, side in found.box.items()},
        "free": [dict(direction) for direction in found.free],
        "held": dict(found.held),
        "starts": found.starts,
        "sure": found.sure,
        "notes": list(found.notes),
    }
