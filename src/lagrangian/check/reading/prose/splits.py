"""Splits a word into parts: all ways of which none only splits the parts of another."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

MAX_SPLITS = 64
"""The largest number of ways to split a word that are looked at."""

LONGEST = 40
"""The longest word that is split."""


def splits(
    word: str, fits: Callable[[str, bool, bool], bool], opens: Callable[[str], bool] = lambda part: False
) -> list[list[str]]:
    """Return the coarsest ways to split a word into at least two parts.

    ``fits`` says whether something may be a part, the last one, and one behind a part that ``opens`` an argument.
    """
    if len(word) > LONGEST:
        return []

    @cache
    def ways(at: int, after: bool) -> list[list[str]]:
        found: list[list[str]] = [[]] if at == len(word) else []
        for end in range(len(word), at, -1):
            part = word[at:end]
            if (at > 0 or end < len(word)) and fits(part, end == len(word), after):
                found += [[part, *rest] for rest in ways(end, opens(part))]
        return found[:MAX_SPLITS]

    return _coarsest(ways(0, False))


def _coarsest(found: list[list[str]]) -> list[list[str]]:
    """The splits that do not only split the parts of another."""
    cuts = [{sum(map(len, s[: k + 1])) for k in range(len(s))} for s in found]
    return [s for s, mine in zip(found, cuts, strict=True) if not any(other < mine for other in cuts)]
