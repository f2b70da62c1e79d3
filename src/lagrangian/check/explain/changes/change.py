"""A place in a derivation, and one local change there: what it adds to the energies, the forces or the equations."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import Any, TypeAlias

import sympy as sp

from lagrangian.check.explain.changes.ring import Sum, minus
from lagrangian.model import Element
from lagrangian.page.formula import Left
from lagrangian.records import dataclass, field

Words: TypeAlias = "tuple[str | Left, ...]"


@dataclass(frozen=True, eq=False, kw_only=True)
class Site:
    """A part of the derivation: its words, and its sums in T*, V, every Ξ_i and the left-hand side of every row.

    ``words`` name it as they stand in a sentence, ``brief`` name it without its terms. ``only`` are the rows in which
    it counts (all unless given). A narrow site has a ``surcharge``: a change of a whole is likelier than one of a part.
    """

    words: Words
    brief: Words
    step: int
    element: Element | None = None
    coordinate: int | None = None
    T: Sum = field(default_factory=dict[Any, Any])
    V: Sum = field(default_factory=dict[Any, Any])
    Xi: Mapping[int, Sum] = field(default_factory=dict[int, Sum])
    rows: Mapping[int, Sum] = field(default_factory=dict[int, Sum])
    only: frozenset[int] | None = None
    surcharge: float = 0.0
    single: bool = False
    whole: bool = False
    body: str | None = None
    """The body whose weight it is, where the element is gravity."""
    against: Words = ()
    """What cancels it in the right equations."""
    members: tuple[Sum, ...] = ()
    """What each element adds, if its words name several."""
    sign_cost: float = 0.15
    """What the other sign costs besides; less where a sign is slipped most easily."""

    def sums(self) -> Iterator[Sum]:
        """All its sums."""
        yield self.T
        yield self.V
        yield from self.Xi.values()
        yield from self.rows.values()

    def atoms(self) -> list[int]:
        """The atoms in its sums."""
        return sorted({a for s in self.sums() for m in s for a, _ in m})

    def shared_atoms(self) -> list[int]:
        """The atoms that all members of a group have: a change of any other one leaves a member as it is."""
        return [a for a in self.atoms() if all(any(a == b for m in x for b, _ in m) for x in self.members)]

    def changed(self, change: Callable[[Sum], Sum]) -> Site:
        """What the site gains when every sum is replaced by ``change`` of it: the differences."""

        return self.gaining(lambda old: minus(change(old), old))

    def gaining(self, gained: Callable[[Sum], Sum]) -> Site:
        """What the site gains if every sum gains ``gained`` of it."""

        def own(old: Sum) -> Sum:
            return gained(old) if old else old

        made = object.__new__(type(self))  # as `replace` makes it, in a fifth of the time: thousands are made
        made.__dict__.update(self.__dict__)
        made.__dict__.update(T=own(self.T), V=own(self.V))
        made.__dict__["Xi"] = {i: own(x) for i, x in self.Xi.items()}
        made.__dict__["rows"] = {i: own(x) for i, x in self.rows.items()}
        return made

    def within(self, row: int) -> Site:
        """The same in one row alone."""
        return replace(self, only=frozenset({row}), coordinate=row, surcharge=self.surcharge + 1.2)

    @property
    def empty(self) -> bool:
        """Whether all its sums are 0."""
        return not any(self.sums())


@dataclass(frozen=True, eq=False, kw_only=True)
class LocalChange:
    """One local change: its kind (see `say`), its cost, the site, and ``effect``, what is added at the site.

    ``free``: any multiple of it is a mistake of the same kind: −1 times leaves it out, −2 times gives it the other
    sign. If there is nothing at the site that could be left out, only ``positive`` multiples are. ``right`` and
    ``written`` are what belongs there and what stands there instead, for the words.
    """

    kind: str
    cost: float
    site: Site
    effect: Site
    free: bool = False
    positive: bool = False
    right: sp.Expr | Words | None = None
    written: sp.Expr | Words | None = None


def made(kind: str, cost: float, site: Site, sums: dict[str, Any], right: Any, written: Any) -> LocalChange:
    """The change at a site that has no sums of its own, by what it adds: ``sums`` are T, V, Xi or rows."""
    effect = replace(site, **sums)
    return LocalChange(kind=kind, cost=cost, site=site, effect=effect, right=right, written=written)
