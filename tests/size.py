"""How large a test is: small by default, full where the tests that take long are run (``pytest -m slow``)."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from typing import Any

import pytest
from hypothesis import settings

FULL = False
"""Whether the tests that take long are run; ``conftest.py`` sets it before any test is read."""

EVERY = False
"""Whether their exhaustive cases are run, too: all that there are, before a release. Set in the same place."""


def sized(full: int, small: int, **others: Any) -> Callable[[Any], Any]:
    """Decorate a test by Hypothesis: ``small`` examples by default, a third of ``full`` among the tests that take
    long, and ``full`` before a release."""
    long = full if EVERY else max(small, full // 3)

    def decorate(test: Any) -> Any:
        chosen = settings(max_examples=long if FULL else small, deadline=None, derandomize=True, **others)
        return also_in_full(chosen(test))

    return decorate


def also_in_full(test: Any) -> Any:
    """Mark a test whose cases are a sample by default: all of them are run among the tests that take long."""
    return pytest.mark.slow(test) if FULL else test


def cases(every: Sequence[Any], small: Sequence[Any]) -> list[Any]:
    """The values of a parameter: ``small`` by default, ``every`` one among the tests that take long."""
    assert set(map(str, small)) <= set(map(str, every))
    return list(every) if FULL else list(small)


def rest_slow(every: Iterable[Any], quick: Collection[Any]) -> list[Any]:
    """The values of a parameter, those that are not ``quick`` marked as taking long."""
    return [value if value in quick else pytest.param(value, marks=pytest.mark.slow) for value in every]


def in_sample(sample: int | Collection[Any], place: int, values: Iterable[Any]) -> bool:
    """Whether a case of a test marked ``sampled`` is run by default.

    ``sampled(n)`` runs every n-th, beginning with the first; ``sampled(SOME)`` those with one of these values.
    """
    return place % sample == 0 if isinstance(sample, int) else any(value in sample for value in values)
