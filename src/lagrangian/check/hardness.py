"""Whether checking an answer may take so long that it is counted."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from lagrangian import bounded
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive import Derived
from lagrangian.model import is_hard

LONG = 1_500
"""The total size of its lines above which an answer counts as hard, see `bounded.hard`."""


WRITTEN = 2_000
"""The total size of the equations above which checking counts as hard: mistakes are sought in all of their terms."""


def hard_to_check(derivation: Derived, lines: Sequence[AnsweredLine], **_: object) -> bool:
    """Whether the system, its equations or the lines of the answer are hard, see `bounded.hard`."""
    return _is_hard(derivation) or bounded.hard((line.expr for line in lines), LONG)


@lru_cache(maxsize=32)
def _is_hard(derivation: Derived) -> bool:
    """Whether the system or its equations are hard, for the derivations that were checked most recently."""
    written = sum(bounded.size(side) for e in derivation.equations for side in (e.lhs, e.rhs))
    return written > WRITTEN or is_hard(derivation.model)
