"""Changes of a number: a part left out, with the wrong sign, counted twice, halved."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lagrangian.check.explain.changes.change import LocalChange, Site

LEFT_OUT = 1.2


def scales(n: int, places: Iterable[Site]) -> Iterator[LocalChange]:
    """For every site, any multiple of it; for those of energies also in one of the ``n`` equations alone."""
    for site in places:
        if site.whole:
            continue
        yield LocalChange(kind="part", cost=LEFT_OUT + site.surcharge, site=site, effect=site, free=True)
        if (site.T or site.V) and not site.Xi and site.only is None and n > 1 and not site.single:
            for i in range(n):
                own = site.within(i)
                yield LocalChange(kind="part", cost=LEFT_OUT + own.surcharge, site=own, effect=own, free=True)
