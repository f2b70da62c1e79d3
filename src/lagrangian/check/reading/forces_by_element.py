"""Generalized forces that an answer lists element by element, some of them in words alone.

- Drehdämpfer: −d·φ̇ in φ              - Q_φ = −d·φ̇
- Motor: +τ in φ                       - Q_φ = +τ
- soil R at P: Q_z = R, Q_φ = −R l     - soil R at P: Q_z = R, Q_φ = −R l

The items without an equals sign are read so where another item of the list states a force by the same coordinate.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import islice

from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.read.letters import undotted

MOST = 40
"""The most items of lists that are looked at."""
_NAME = r"[^\W\d](?:\w|[\u0307\u0308]){0,24}+"
_ITEM = re.compile(
    r"^[ \t]*+[-*•–][ \t]++(?P<label>[^\W\d_][^:=\n]{2,80}?):(?=[ \t])(?P<value>[^\n]{1,300})$", re.MULTILINE
)
_STATED = re.compile(r"(?<!\w)(?P<letter>Q|Xi|Ξ)_(?P<of>[^\W\d_]\w{0,24})[ \t]*=(?!=)")
_IN_WORDS = re.compile(
    r"[ \t]*+(?P<force>[^=:;,\n]{1,120}?)(?P<tail>[ \t]++(?:in|on|auf|für|for|along|entlang)[ \t]++"
    rf"(?P<of>{_NAME})[ \t]*+[.,;]?[ \t]*+)\Z"
)
_WORD = re.compile(_NAME)


def with_forces_by_element(written: TracedText, known: Callable[[str], bool]) -> TracedText:
    """Return a plain text in which such items are generalized forces; ``known`` tells whether the system has a name."""
    edits: list[Edit] = []
    for items in _lists(written.text):
        stated = {m["of"]: m["letter"] for item in items for m in _STATED.finditer(item["value"])}
        for item in items:
            said = _IN_WORDS.match(item["value"])
            if said is None or said["of"] not in stated or not _is_read(said["force"], known, said["of"]):
                continue
            start = item.start("value")
            edits.append((item.start("label"), start + said.start("force"), f"{stated[said['of']]}_{said['of']} = "))
            edits.append((start + said.start("tail"), start + said.end("tail"), ""))
    return written.edited(edits)


def _lists(text: str) -> Iterator[list[re.Match[str]]]:
    """The items of each list, which stand on lines one below the other."""
    items: list[re.Match[str]] = []
    for item in islice(_ITEM.finditer(text), MOST):
        if items and item.start() != items[-1].end() + 1:
            yield items
            items = []
        items.append(item)
    yield items


def _is_read(force: str, known: Callable[[str], bool], own: str) -> bool:
    """Whether a force is made of names of the system, and of the coordinate that it acts on."""
    bare = [undotted(x)[0] for x in _WORD.findall(force)]
    return bool(bare) and all(x == own or known(x) or function_of(x) is not None for x in bare)
