"""What comments of a program say names to be that nothing else explains: % p = phidot, # v = x'."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import islice

from lagrangian.check.reading.names import Names, spelled_rates
from lagrangian.read.letters import key

MOST = 200
"""The most comments that are looked at."""
_COMMENT = re.compile(r"(?:[#%]|//)[^\n]{0,400}")
_RATED = re.compile(
    r"(?<![\w'’′*/+^.-])(?P<name>[^\W\d]\w{0,23})[ \t]{0,9}(?::=|=|:|\bis\b)[ \t]{0,9}"
    r"(?P<of>[^\W\d]\w{0,23})(?P<primes>['’′]{0,2})(?![\w'’′*/+^.(-]|[ \t]*[*/+^=(-])"
)


def rates_in_comments(text: str, unknown: Sequence[str], names: Names) -> dict[str, str]:
    """The ``unknown`` names that comments say to be a rate or an acceleration of a coordinate, with it as an answer
    spells it; none of which two comments say different things."""
    wanted = {key(x): x for x in unknown}
    coordinates = {c.name for c in names.model.coordinates}
    said: dict[str, set[str]] = {}
    for comment in islice(_COMMENT.finditer(text), MOST):
        for match in _RATED.finditer(comment.group()):
            primes = len(match["primes"])
            listed = [(primes, match["of"])] if primes else spelled_rates(match["of"])
            meant = {c + "'" * k for k, stem in listed for c in names.scope.meanings(stem)[0] if k and c in coordinates}
            if key(match["name"]) in wanted and len(meant) == 1:
                said.setdefault(wanted[key(match["name"])], set()).update(meant)
    return {name: next(iter(of)) for name, of in said.items() if len(of) == 1}
