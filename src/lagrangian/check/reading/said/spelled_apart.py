"""Reads letters that an answer in plain text says stand for others where only a mark tells them from a third letter.

b_ for the angle beta, beside a damper b: where no words say so, b_ is another spelling of b.

cos b_ + b betad   (b_ stands for beta)     cos beta + b betad
q_ = phi;  … sin q_                         … sin phi       beside a charge q
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.read.letters import key

MOST = 20
"""The most sentences that are looked at."""
_SAID = re.compile(
    rf"(?:(?P<open>\()[ \t]{{0,4}}|(?<![\w'’′(]))(?:(?:where|with|here|and|mit|wobei|hier|und)[ \t]++)?(?P<new>{IDENT})"
    r"[ \t]{0,8}(?:=|:=|(?<=[ \t])(?:is|means|stands[ \t]for|denotes|for|ist|bedeutet|bezeichnet|steht[ \t]für|für)"
    rf"(?=[ \t]))[ \t]{{0,8}}(?P<own>{IDENT})(?P<close>[ \t]{{0,4}}\))?+(?=[ \t]*+(?:[.,;)\n]|\Z))",
)
"""A name and what it stands for, with nothing behind that would be more of a formula."""
_BEFORE = re.compile(r"(?:^|[.,;:(]|\b(?:where|with|here|and|mit|wobei|hier|und|write|I))[ \t]*+\Z")
"""What stands in front of such a sentence: the beginning of a line, or a mark; no half of a formula."""
_RATES = r"(?P<rate>d{1,2}|d?dot)?(?!\w)"


def with_letters_apart(
    written: TracedText,
    moves: Callable[[str], bool],
    exact: Callable[[str], bool],
    taken: Callable[[str], bool],
    notes: dict[str, None],
) -> TracedText:
    """Return an answer in which such letters are those for which they stand.

    ``moves`` says whether a name is that of a coordinate, ``exact`` whether the system spells one so, and ``taken``
    whether it would be read as one of the system.
    """
    stands: dict[str, str] = {}
    said: list[Edit] = []
    text = written.text
    for match in islice((m for m in _SAID.finditer(text) if "_" in m["new"]), MOST):
        new, own = match["new"], match["own"]
        line = text[text.rfind("\n", 0, match.start()) + 1 : match.start()]
        whole = match["open"] is not None or _BEFORE.search(line) is not None
        if not whole or exact(new) or not taken(new) or not moves(own) or key(new) == key(own):
            continue
        if stands.setdefault(new, own) == own:
            both = match["open"] is not None and match["close"] is not None
            begin = match.start() if both else match.start("new")
            said.append((begin, match.end() if both else match.end("own"), ""))
            notes.setdefault(f"'{new}' was read as {own}, as you say.")
    for new, own in stands.items():
        uses = re.finditer(rf"(?<!\w){re.escape(new)}{_RATES}", text)
        said += [(*use.span(), f"{own}{use['rate'] or ''}") for use in uses if not _within(use, said)]
    return written.edited(apart(said))


def _within(use: re.Match[str], said: list[Edit]) -> bool:
    """Whether a letter stands in one of the sentences that say what it is."""
    return any(begin <= use.start() < end for begin, end, _ in said[:MOST])
