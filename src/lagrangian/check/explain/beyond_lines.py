"""What is wrong in equations beside the mistakes that lines above them already show.

A wrong V goes on into the equations. What differs there is explained with it: the mistake of V and one more, rather
than a single other one that happens to do the same as both.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lagrangian.check.align import alignments
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.line_mistakes import stated
from lagrangian.check.explain.search import EXOTIC, MOST_FOR_PAIRS, SMALL, Explanation, in_rows
from lagrangian.check.explain.written_pieces import Against
from lagrangian.check.verdict import AnsweredLine


def beyond(
    pool: Pool, equations: Sequence[AnsweredLine], groups: Sequence[Sequence[Explanation]], against: Against
) -> list[Explanation] | None:
    """The single mistakes that lead to equations beside known ones of lines, the first of each group, together or one
    of them; none if the known ones suffice, and None if they lead nowhere."""
    firsts = [group[0].told for group in groups if group]
    every = tuple({id(t.mistake): t for told in firsts for t in told}.values())
    if not every or not equations:
        return None
    exprs, P = stated(pool.truth, equations)
    found = alignments(pool.truth, exprs, P)[:MOST_FOR_PAIRS]
    explained: list[Explanation] = []
    for known in dict.fromkeys((every, *firsts)):
        made = np.sum([float(t.times) * pool.W[pool.places[id(t.mistake)]] for t in known], axis=0)
        elements = {t.mistake.element for t in known} - {None}
        for a in found:
            rest = a.rest - made[list(a.rows)]
            if np.abs(rest).max() <= SMALL * (np.abs(a.rest).max() + np.abs(pool.truth.W).max()):
                return []
            [singles] = in_rows(pool, [rest], [a], a.rows)
            more = [e for e in singles if e.cost <= EXOTIC and not against.speaks(e.told[0])]
            explained += [e for e in more if e.told[0].mistake.element not in elements]
    return sorted(explained, key=lambda e: e.cost) or None
