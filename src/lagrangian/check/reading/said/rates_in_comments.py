"""What comments of a program say names to be that nothing else explains: % p = phidot, # v = x'.

% q = [x; th], qd = [xd; w]     w is th': the rate at the place that th has among the coordinates
# state: x, th, xd, w           the same
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import islice

from lagrangian.check.reading.names import Names, spelled_rates
from lagrangian.read.letters import key

MOST = 200
"""The most comments, and the most lists in one, that are looked at."""
_COMMENT = re.compile(r"(?:[#%]|//)[^\n]{0,400}")
_RATED = re.compile(
    r"(?<![\w'’′*/+^.-])(?P<name>[^\W\d]\w{0,23})[ \t]{0,9}(?::=|=|:|\bis\b)[ \t]{0,9}"
    r"(?P<of>[^\W\d]\w{0,23})(?P<primes>['’′]{0,2})(?![\w'’′*/+^.(-]|[ \t]*[*/+^=(-])"
)
_ENTRY = r"[^\W\d]\w{0,23}+['’′]{0,2}+"
_LIST = re.compile(
    rf"[\[({{<][ \t]*+(?P<inside>{_ENTRY}(?:(?:[ \t]*+[,;|][ \t]*+|[ \t]++){_ENTRY}){{1,11}})[ \t]*+[\])}}>]"
    rf"|(?P<bare>(?<![\w'’′*/+^.-]){_ENTRY}(?:[ \t]*+[,;|][ \t]*+{_ENTRY}){{1,11}})(?![\w'’′*/+^.(=-]|[ \t]*[*/+^=(-])"
)
"""Names in brackets, or bare with marks between them."""
_NAMES = re.compile(_ENTRY)


def rates_in_comments(text: str, unknown: Sequence[str], names: Names) -> dict[str, str]:
    """The ``unknown`` names that comments say to be a rate or an acceleration of a coordinate, with it as an answer
    spells it; none of which two comments say different things."""
    wanted = {key(x): x for x in unknown}
    rates = {c.name + "'" * k for c in names.model.coordinates for k in (1, 2)}
    said: dict[str, set[str]] = {}
    for comment in islice(_COMMENT.finditer(text), MOST):
        for match in _RATED.finditer(comment.group()):
            meant = _meant(match["of"], match["primes"], names) & rates
            if key(match["name"]) in wanted and len(meant) == 1:
                said.setdefault(wanted[key(match["name"])], set()).update(meant)
        for name, of in _in_lists(comment.group(), names):
            if key(name) in wanted:
                said.setdefault(wanted[key(name)], set()).add(of)
    return {name: next(iter(of)) for name, of in said.items() if len(of) == 1}


def _meant(stem: str, primes: str, names: Names) -> set[str]:
    """The coordinates and rates that a name may be, as an answer spells them."""
    spelled = [(len(primes), stem), *(() if primes else spelled_rates(stem))]
    return {c + "'" * k for k, base in spelled for c in names.scope.meanings(base)[0]}


def _in_lists(comment: str, names: Names) -> Iterator[tuple[str, str]]:
    """The entries of lists of all rates that nothing explains, with the rates whose places they have.

    A list of rates stands behind the coordinates, in the same list or in one of its own, and spells another rate in
    its place.
    """
    order = [c.name for c in names.model.coordinates]
    for match in islice(_LIST.finditer(comment), MOST):
        entries = _NAMES.findall(match["inside"] or match["bare"])
        bases = [(x.rstrip("'’′"), "'" * (len(x) - len(x.rstrip("'’′")))) for x in entries]
        meant = [_meant(stem, primes, names) for stem, primes in bases]
        found = [next((c for c in order if c in x), None) for x in meant[: len(order)]]
        if len(order) in (len(entries), len(entries) // 2) and None not in found and len({*found}) == len(order):
            order = [c for c in found if c is not None]
            bases, meant = bases[len(order) :], meant[len(order) :]
        elif len(entries) != len(order):
            continue
        rates = [c + "'" for c in order]
        known = [r in x for r, x in zip(rates, meant, strict=False)]
        if len(bases) == len(order) and any(known) and all(k or not x for k, x in zip(known, meant, strict=True)):
            yield from ((stem, r) for (stem, _), r, k in zip(bases, rates, known, strict=True) if not k)
