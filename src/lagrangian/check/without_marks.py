"""Lines that are not right as they are read, and are without a mark or words that may be no part of them.

(psi) [J + m r²] ψ″ = τ: the name in brackets is a factor or says which equation follows. The likelier reading is
judged first. Where a line is not right in it, its other readings are judged, and that in which it is right is taken.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from lagrangian.check.names.needless import Needed
from lagrangian.check.reading import Answer
from lagrangian.check.verdict import Status, Verdict
from lagrangian.errors import ParseError
from lagrangian.records import dataclass

MOST_JUDGED = 16
"""The largest number of readings of an answer that are judged."""


Judge: TypeAlias = Callable[[Answer], tuple[Needed, Verdict]]


@dataclass(frozen=True, eq=False)
class ReadAgain:
    """An answer in another reading, the lines of it that decide, and the verdict on them."""

    answer: Answer
    decides: Needed
    verdict: Verdict


def without_marks(answer: Answer, verdict: Verdict, judge: Judge) -> ReadAgain | None:
    """The reading of a wrong answer in which more of its lines are right, and its verdict; None if there is none.

    All lines that are not right are read in their first other reading, and so on; then each for itself.
    """
    if answer.read_marked is None or verdict.status is not Status.WRONG:
        return None
    wrong = _wrong(verdict)
    rows = {row.start: row for row in answer.marked_rows() if row.line in wrong}
    most = max((row.count for row in rows.values()), default=0)
    together = [tuple((at, k) for at, row in rows.items() if k < row.count) for k in range(most)]
    alone = [((at, k),) for at, row in rows.items() for k in range(row.count)] if len(rows) > 1 else []
    kept: tuple[tuple[int, int], ...] = ()
    for marks in (*together, *alone)[:MOST_JUDGED]:
        more = tuple(x for x in marks if x[0] not in {at for at, _ in kept})
        found = _judged(answer, (*kept, *more), judge) if more else None
        if found is None:
            continue
        if found.verdict.right:
            return found
        now = _wrong(found.verdict)
        if now < wrong and found.verdict.status is Status.WRONG:
            kept, wrong = (*kept, *((at, k) for at, k in more if rows[at].line not in now)), now
    return _judged(answer, kept, judge) if kept else None


def _judged(answer: Answer, marks: tuple[tuple[int, int], ...], judge: Judge) -> ReadAgain | None:
    """The answer with some rows in other readings, and its verdict; None if it, or a part of it, cannot be read so."""
    if answer.read_marked is None:
        return None
    try:
        read = answer.read_marked(marks)
    except ParseError:
        return None
    if read.doubt is not None and answer.doubt is None:
        return None
    return ReadAgain(read, *judge(read))


def _wrong(verdict: Verdict) -> set[int]:
    """The numbers of the lines that are not right."""
    return {f.line.number for f in verdict.findings if f.status is Status.WRONG}
