"""Takes the name of an element behind a formula off its statement: S = k1 (r φ - x) rope, C = k2 s + b s' coupling."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.said.glossed_names import words_of_system
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.model import Model

MOST = 40
"""The most such words."""

_BEHIND = re.compile(
    r"(?<=[\w)\]'’′²³\u0307\u0308])[ \t](?P<word>[a-zäöüéè]{4,20})(?=[ \t]?(?:,[ ][^\W\d]\w{0,12}[ ]?=|[,.;]?[ \t]*$))",
    re.MULTILINE,
)


def without_elements_behind(text: TracedText, model: Model, taken: Callable[[str], bool]) -> TracedText:
    """Return a plain text without words of the system's descriptions at the end of statements, where each stands in the
    answer behind equals signs alone and is no name."""
    edits: list[Edit] = []
    found = list(islice(_BEHIND.finditer(text.text), MOST))
    spoken = words_of_system(model) if found else ()
    for match in found:
        line = text.text[text.text.rfind("\n", 0, match.start()) + 1 : match.start()]
        if "=" in line and match["word"] in spoken and not taken(match["word"]):
            edits.append((match.start("word"), match.end("word"), " " * len(match["word"])))
    return text.edited(edits)
