"""Two systems compared: the data of `analyze.compare`, with the ways of writing it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Protocol

from lagrangian.analysis import Written
from lagrangian.analyze import compare as found
from lagrangian.analyze.report import Report
from lagrangian.derivation import Derivation
from lagrangian.errors import ModelError
from lagrangian.viewed import cut


class Derivable(Protocol):
    """What can be derived: a `System`."""

    def derive(self) -> Derivation:
        """Return the derivation."""
        ...


@dataclass(frozen=True, eq=False)
class Comparison(Written, found.Comparison):
    """Whether two systems are one motion, row by row, and where they differ; see `analyze.compare.Comparison`."""

    def report(self) -> Report:
        """Return the report."""
        return found.comparison_report(self)

    def __repr__(self) -> str:
        """Say of what it is, and what was found; ``print`` shows it all."""
        a, b = self.a.derivation.model.name, self.b.derivation.model.name
        return cut(f"<Comparison of {a!r} and {b!r}: {'the same' if self.same else 'they differ'}>")

    def __bool__(self) -> bool:
        """Whether they are the same: ``assert lg.compare(a, b)``."""
        return self.same


def compare(
    a: Derivable | Derivation, b: Derivable | Derivation, change: Mapping[Any, Any] | None = None
) -> Comparison:
    """Return two systems (or their derivations) side by side: are they one motion, and where do they differ?

    ``change`` says coordinates of one in those of the other, ``{"x2": "x1 + x2r"}``; left out, it is found from what
    both put in the same places.
    """
    data = found.compare(_derived(a, "first"), _derived(b, "second"), change)
    return Comparison(**{f.name: getattr(data, f.name) for f in fields(data)})


def _derived(thing: object, which: str) -> Derivation:
    if isinstance(thing, Derivation):
        return thing
    if not hasattr(thing, "derive"):
        raise ModelError(
            f"the {which} of the two is not a system (got {type(thing).__name__})",
            fix="compare(System, System), or their derivations",
            code="E406",
        )
    return thing.derive()  # type: ignore[attr-defined]
