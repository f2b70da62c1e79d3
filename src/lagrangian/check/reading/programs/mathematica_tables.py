"""Writes out what an answer in Mathematica makes of lists: q = {x, y}, Table[D[L, q[[i]][t]] == Q[[i]], {i, 2}].

Each entry of a table becomes a statement of its own, with the items of the lists in it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import islice

from lagrangian.check.reading.programs.session_lists import entries_in
from lagrangian.check.reading.programs.sessions import closes
from lagrangian.check.reading.traced_text import Edit, TracedText

MOST_LISTS, MOST_TABLES, MOST_ENTRIES = 20, 10, 12
LONGEST = 2_000
"""The most characters of a list, and of a table."""

_NAME = r"[A-Za-zα-ωΑ-Ω]\w{0,23}"
_LIST = re.compile(rf"(?:(?<=^)|(?<=;)|(?<=\n))[ \t]*(?P<name>{_NAME})[ \t]*=[ \t]*\{{")
_TABLE = re.compile(rf"(?:(?<=^)|(?<=;)|(?<=\n))[ \t]*(?:{_NAME}[ \t]*=[ \t]*)?Table\[")
_RANGE = re.compile(rf",\s*\{{\s*(?P<index>{_NAME})\s*,\s*(?:1\s*,\s*)?(?P<last>\d{{1,2}})\s*\}}\s*\Z")
_BEHIND = re.compile(r"[ \t]*(?://[ \t]*\w{1,30})*[ \t]*;?")


def with_tables_written_out(written: TracedText) -> TracedText:
    """Return an answer without the lists from which it makes entries, and with the entries of its tables."""
    text = written.text
    if "[[" not in text:
        return written
    lists: dict[str, list[str]] = {}
    edits: list[Edit] = []
    for match in islice(_LIST.finditer(text), MOST_LISTS):
        end = closes(text, match.end() - 1)
        if end < 0 or end - match.end() > LONGEST or f"{match['name']}[[" not in text:
            continue
        lists[match["name"]] = [text[a:b].strip() for a, b in entries_in(text, match.end(), end)]
        edits.append((match.start(), end + 1, ""))
    for match in islice(_TABLE.finditer(text), MOST_TABLES) if lists else ():
        end = closes(text, match.end() - 1)
        made = _entries(text[match.end() : end], lists) if 0 <= end <= match.end() + LONGEST else None
        if made is not None and (behind := _BEHIND.match(text, end + 1)) is not None:
            edits.append((match.start(), behind.end(), "\n".join(made)))
    return written.edited(edits)


def _entries(table: str, lists: Mapping[str, list[str]]) -> list[str] | None:
    """The entries of a table; None if it is not made of lists that are known."""
    found = _RANGE.search(table)
    if found is None or not 0 < int(found["last"]) <= MOST_ENTRIES:
        return None
    body, made = table[: found.start()], list[str]()
    for k in range(1, int(found["last"]) + 1):
        entry = body
        for name, items in lists.items():
            part = rf"(?<!\w){re.escape(name)}\[\[\s*{re.escape(found['index'])}\s*\]\]"
            if k > len(items) and re.search(part, entry) is not None:
                return None
            pieces = re.split(part, entry)
            entry = pieces[0] if len(pieces) == 1 else _whole(items[k - 1]).join(pieces)
        made.append(entry)
    return made if all(found["index"] not in re.findall(r"\w+", x) for x in made) else None


def _whole(item: str) -> str:
    """An item in brackets, if it is no single name or number."""
    return item if re.fullmatch(r"\w+", item) else f"({item})"
