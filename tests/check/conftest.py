"""What is wrong is wrong at every hint level: some answers that tests judge at level 0 are judged in full, too."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from typing import Any

import pytest

import size
from lagrangian.check import verb
from lagrangian.derive import Derived

SAMPLE = 8
"""One of so many answers is judged at both levels; before a release all are."""


@pytest.fixture(autouse=True, scope="session")
def alike_at_every_level() -> Iterator[None]:
    """Tests that ask only whether an answer is right ask at hint level 0, where mistakes are not sought."""
    judge = verb.check_answer

    def both(derivation: Derived, answer: Any, *, hint: int = 3, name: str | None = None) -> verb.CheckedAnswer:
        found = judge(derivation, answer, hint=hint, name=name)
        chosen = size.EVERY or zlib.crc32(str(answer).encode()) % SAMPLE == 0
        if hint == 0 and not found.right and chosen:
            assert judge(derivation, answer, hint=3, name=name).status is found.status
        return found

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(verb, "check_answer", both)
        yield
