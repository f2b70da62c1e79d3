"""Tells a name apart that gets a value for each of several bodies, on lines that begin with what they are about.

platform: height l sin α, v = l α̇ cos α          v_platform = l α̇ cos α
foot:     v = −l α̇ sin α                         v_foot = −l α̇ sin α
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.name_patterns import INNER, WORD_LETTER
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText

MOST = 60
"""The most lines with a label that are looked at."""
_LABELLED = re.compile(
    r"^[ \t]*+(?:[-•*][ \t]+|\d{1,2}[.)][ \t]+)?(?P<label>[^\W\d_]{3,24}(?:[ \t-][^\W\d_]{1,24}){0,2})"
    r"(?:[ \t]*\([^()=\n]{1,40}\))?[ \t]*:(?!=)(?P<rest>[^\n]*=[^\n]*)$",
    re.MULTILINE,
)
"""A line that begins with a word or some and a colon."""
_GIVEN = re.compile(
    rf"(?:^|[,;]|(?<![ \t])[ \t]{{2}}|\b(?:and|und|with|mit))[ \t]*+(?P<name>{WORD_LETTER}{INNER}{{0,7}}+)"
    r"(?P<mark>['’′]{1,2}|²|\^2)?[ \t]*=(?![=>])"
)


def with_names_of_each(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text in which such a name has the label of its line; ``taken`` says whether a name
    belongs to the system. It stands on such lines alone, once on each."""
    text = written.text
    found: dict[str, list[tuple[re.Match[str], int, str]]] = {}
    for line in islice(_LABELLED.finditer(text), MOST):
        for match in _GIVEN.finditer(line["rest"]):
            if not taken(match["name"]) and function_of(match["name"]) is None:
                found.setdefault(match["name"], []).append((match, line.start("rest"), line["label"]))
    edits: list[Edit] = []
    for name, places in found.items():
        labels = {label.lower() for *_, label in places}
        if all(match["mark"] for match, *_ in places):
            continue  # rates and squares alone
        alone = len(re.findall(rf"(?<!\w){re.escape(name)}(?![^\W²³])", text)) == len(places)
        if len(places) > 1 and len(labels) == len(places) and alone:
            for match, start, label in places:
                named = re.sub(r"\W", "", label.title() if " " in label else label)
                edits.append((start + match.start("name"), start + match.end("name"), f"{name}_{named}"))
    return written.edited(edits)
