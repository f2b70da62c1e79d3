"""A column of new names behind a column of formulas, in an answer in plain text: the names are these formulas.

M q'' = [F − k x; −m g l] = [p; q]        M q'' = [F − k x; −m g l]; p = F − k x; q = −m g l
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import TracedText

_NAME = r"[^\W\d]\w{0,15}"
_COLUMNS = re.compile(
    r"=[ \t]*+\[(?P<formulas>[^\[\]=,\n]{1,1000})\]"
    rf"(?P<names>[ \t]*+=[ \t]*+\[[ \t]*+(?P<listed>{_NAME}(?:[ \t]*+;[ \t]*+{_NAME}){{1,9}})[ \t]*+\])"
    r"[ \t]*+[.,;]?[ \t]*+$",
    re.MULTILINE,
)
MOST = 10
"""The most rows of such a column."""


def with_named_columns(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which such names are given their values; ``taken`` says whether the system has a name."""
    if "[" not in written.text or "\\" in written.text:
        return written
    return written.edited(_named(written.text, taken))


def _named(text: str, taken: Callable[[str], bool]) -> Iterator[tuple[int, int, str]]:
    for match in _COLUMNS.finditer(text):
        names = re.findall(_NAME, match["listed"])
        formulas = [x.strip() for x in match["formulas"].split(";")]
        if len(names) != len(formulas) or len(set(names)) < len(names) or not all(formulas):
            continue
        if any(taken(x) or function_of(x) is not None or _is_stated(x, text) for x in names):
            continue
        given = "; ".join(f"{name} = {formula}" for name, formula in zip(names, formulas, strict=True))
        yield *match.span("names"), f"; {given}"


def _is_stated(name: str, text: str) -> bool:
    """Whether a line gives a name its value."""
    return re.search(rf"(?<![\w.]){re.escape(name)}[ \t]*=(?!=)", text) is not None
