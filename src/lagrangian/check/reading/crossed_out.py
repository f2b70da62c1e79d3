r"""Takes off an answer what is crossed out, which is no part of it: ~~V = k r²~~, <s>…</s>, \sout{…}."""

from __future__ import annotations

import re
from collections.abc import Iterator

from lagrangian.check.reading.latex_layout import closing
from lagrangian.check.reading.traced_text import Edit, TracedText

_BETWEEN = re.compile(r"~~(?=[^\s~])[^~\n]{1,1000}~~|<(?P<tag>s|del|strike)>[^<>\n]{1,1000}</(?P=tag)>", re.IGNORECASE)
_COMMAND = re.compile(r"\\(?:sout|xout)\s?\{")
_MOST = 50


def without_crossed_out(written: TracedText, notes: dict[str, None]) -> TracedText:
    """Return an answer without what is crossed out; notes tell it."""
    edits = list(_edits(written.text))
    for start, end, _ in edits:
        notes.setdefault(f"'{' '.join(written.text[start:end].split())}' was not judged: it is crossed out.")
    return written.edited(edits)


def _edits(text: str) -> Iterator[Edit]:
    if "~~" in text or "<" in text:
        yield from ((*m.span(), " ") for m in _BETWEEN.finditer(text))
    elif "out" in text:
        end = 0
        for match in list(_COMMAND.finditer(text))[:_MOST]:
            if match.start() >= end:
                end = closing(text, match.end())
                yield match.start(), end, " "
