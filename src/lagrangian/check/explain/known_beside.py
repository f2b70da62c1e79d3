"""Of several wrong equations of which one has a term of its own, what is known of the others: "½Jω² is missing".

A mistake that shows in one equation alone says more than that one sum of terms stands where another belongs.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from lagrangian.check.align import Alignment
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.own_terms import OwnTerm
from lagrangian.check.explain.quoted import claimed
from lagrangian.check.explain.search import EXOTIC, Explanation, in_rows
from lagrangian.check.explain.spoken import in_words
from lagrangian.check.explain.written_pieces import Against
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import Mistake
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class KnownBeside:
    """A mistake of the pool that explains one wrong equation."""

    explanation: Explanation

    @property
    def cost(self) -> float:
        """How unlikely it is."""
        return self.explanation.cost

    def mistake(self, truth: Reference) -> Mistake:
        """The mistake in words."""
        return in_words(truth, self.explanation.told[0], self.explanation.under)


Slip: TypeAlias = "OwnTerm | KnownBeside"


def with_known(
    pool: Pool, own: Sequence[OwnTerm] | None, found: Sequence[Alignment], against: Against
) -> Sequence[Slip] | None:
    """The terms of several equations that are wrong; in place of one the likelier mistake that explains its equation,
    and changes no other one."""
    if own is None or len(own) < 2:
        return own
    told: list[Slip] = [_known(pool, t, found, against) or t for t in own]
    return told if any(isinstance(t, OwnTerm) for t in told) else own


def _known(pool: Pool, own: OwnTerm, found: Sequence[Alignment], against: Against) -> KnownBeside | None:
    """The likeliest mistake that explains the equation of a term, of which nothing is said that was written."""
    for a in (x for x in found if own.row in x.rows and not x.solved):
        row = own.row or 0
        [each] = in_rows(pool, [a.rest[[a.rows.index(row)]]], [a], [row])
        for e in each:
            [t] = e.told
            alone = pool.felt[pool.places[id(t.mistake)]].sum() == 1 and not against.speaks(t)
            known = KnownBeside(e)
            if alone and e.cost < min(own.cost, EXOTIC) and not any(claimed(known.mistake(pool.truth))):
                return known
    return None
