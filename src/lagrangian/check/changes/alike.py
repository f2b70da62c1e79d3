"""Sites of several elements of one kind that go together: bodies of the same mass, the two strands of a belt."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Protocol

from lagrangian.check.changes.change import Site, Words
from lagrangian.check.changes.ring import Sum, plus
from lagrangian.check.misconceptions.base import Ingredients
from lagrangian.model import Element


class Shares(Protocol):
    """What every element adds to T*, to V and to the equations."""

    of: Ingredients
    n: int

    @property
    def kinetic(self) -> Mapping[Any, Sum]: ...  # noqa: D102
    @property
    def weights(self) -> Mapping[Any, tuple[Element, Sum]]: ...  # noqa: D102
    @property
    def energies(self) -> Mapping[Element, Sum]: ...  # noqa: D102
    @property
    def element_rows(self) -> Mapping[Element, Mapping[int, Sum]]: ...  # noqa: D102


def bodies(sites: Shares) -> Iterator[Site]:
    """Several bodies of the same mass together, if there are others."""
    groups: dict[Any, list[Any]] = {}
    for b in sites.of.bodies:
        groups.setdefault(b.mass, []).append(b)
    for group in groups.values():
        if 1 < len(group) < len(sites.of.bodies):
            names = _names(group)
            words: Words = (f"the kinetic energy of {names}",)
            T = plus(*[sites.kinetic[b] for b in group])
            yield Site(words=words, brief=words, step=2, element=group[0], T=T, surcharge=0.1, sign_cost=0.9)
            V = plus(*[sites.weights[b][1] for b in group if b in sites.weights])
            words = (f"the weights of {names}",)
            yield Site(words=words, brief=words, step=3, element=group[0], V=V, surcharge=0.1)


def energies(sites: Shares) -> Iterator[Site]:
    """Springs of the same energy together, if there are others."""
    for group in _of_one_energy(sites):
        words = (f"the energies of {_names(group)}",)
        V = plus(*[sites.energies[e] for e in group])
        yield Site(words=words, brief=words, step=3, element=group[0], V=V, surcharge=0.1)


def in_rows(sites: Shares) -> Iterator[Site]:
    """What springs of the same energy add to one equation."""
    for group in _of_one_energy(sites):
        for i in range(sites.n):
            if x := plus(*[sites.element_rows[e].get(i, {}) for e in group]):
                words: Words = (f"what {_names(group)} add to the equation of ", sites.of.q[i])
                yield Site(words=words, brief=words, step=5, element=group[0], coordinate=i, rows={i: x}, surcharge=0.4)


def _of_one_energy(sites: Shares) -> list[list[Element]]:
    groups: dict[frozenset[Any], list[Element]] = {}
    for element, V in sites.energies.items():
        groups.setdefault(frozenset(V.items()), []).append(element)
    return [group for group in groups.values() if 1 < len(group) < len(sites.energies)]


def _names(group: list[Any]) -> str:
    return " and ".join(x.title for x in group)
