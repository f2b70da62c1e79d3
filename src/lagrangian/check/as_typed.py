"""Notes quote lines of an answer as they were typed: dB/dφ = …, and not as they were read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lagrangian.check.reading.answer import AnswerLine
from lagrangian.page.formula import Text, Verbatim


def as_typed(note: Text, lines: Sequence[AnswerLine]) -> Text:
    """The note with what it quotes of lines that were read in other letters as these were typed."""
    table = {f"'{x.text}'": f"'{x.typed}'" for x in lines if x.typed}
    if not any(quoted in str(note) for quoted in table):
        return note

    def put(words: str) -> str:
        for quoted, typed in table.items():
            words = words.replace(quoted, typed)
        return words

    parts = [
        put(x) if isinstance(x, str) else Verbatim(put(x.words)) if isinstance(x, Verbatim) else x for x in note.parts
    ]
    return replace(note, parts=tuple(parts))
