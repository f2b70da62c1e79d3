r"""Takes off an answer what is crossed out, which is no part of it: ~~V = k r²~~, <s>…</s>, \sout{…}.

A remark says it of the line in front of it: V = m g z   <- crossed out, V = m g z   ← wrong, see below.
A sentence says it of itself: I first had V = m g z, because I counted z upwards.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lagrangian.check.reading.latex.layout import closing
from lagrangian.check.reading.traced_text import Edit, TracedText

_BETWEEN = re.compile(r"~~(?=[^\s~])[^~\n]{1,1000}~~|<(?P<tag>s|del|strike)>[^<>\n]{1,1000}</(?P=tag)>", re.IGNORECASE)
_COMMAND = re.compile(r"\\(?:sout|xout)\s?\{")
_SAID = re.compile(
    r"(?:<-+|←|\(|\[|//|#|%|--|—|…|\.\.\.)[ \t]{0,4}(?:this )?(?:line |is )?"
    r"(?:(?:crossed|struck|scratched)[ -](?:out|through)|(?:durch)?gestrichen|verworfen"
    r"|(?:scrap|forget|ignore|discard)[ ](?:that|this)"
    r"|(?:wrong|incorrect|falsch)(?=[^\n]{0,40}?\b(?:below|corrected|unten|korrigiert)\b)[^\n)\]]{0,60}"
    r"|wrong|incorrect|falsch)[ \t]{0,4}(?=[!,;:.)\]\n]|\Z)",
    re.IGNORECASE,
)
"""A remark that begins with these words: the line is crossed out or taken back."""
_FIRST = r"(?:at first|first|initially|originally|previously|zuerst|zunächst|erst|ursprünglich|d'abord)"
_VERB = r"(?P<had>had|forgot)(?![ \t]to\b)|wrote|got|put|took|used"
_HAD = (
    rf"(?:(?:I|we)[ \t]+(?:had[ ])?{_FIRST}[ \t]+(?:{_VERB})"
    rf"|{_FIRST},?[ \t]+(?:I|we)[ \t]+(?:{_VERB.replace('had>', 'had_2>')})"
    rf"|(?P<had_3>(?:I|we)[ \t]+had[ \t]+{_FIRST}|{_FIRST}[ \t]+hatte[ \t]+ich|ich[ \t]+hatte[ \t]+{_FIRST}))\b"
)
_TAKEN_BACK = re.compile(
    rf"(?:(?<=[.!?;(][ \t])|(?<=\()|^[ \t]*+(?:[-*>][ \t]++)?)(?P<said>{_HAD}[^\n;]{{1,300}}?)"
    r"(?=[.!?;:](?:\s|\Z)|\)?[ \t]*(?:\n|\Z))",
    re.IGNORECASE | re.MULTILINE,
)
"""A sentence about what stood there before."""
_WRONG = re.compile(
    r"\b(?:but|wrong(?:ly)?|mistake|mistakenly|instead|corrected|forgotten|forgetting|changed"
    r"|aber|falsch|statt|vergessen|korrigiert|mais|faux|oublié)\b",
    re.IGNORECASE,
)
"""Words that say that it was wrong."""
_WHY = re.compile(r"\b(?:because|since|weil|da|car)\b", re.IGNORECASE)
"""Words that say why it was there."""
_WORDS = ("crossed", "struck", "scratched", "gestrichen", "wrong", "incorrect", "falsch", "verworfen", " that", " this")
_BEFORE = ("first", "initially", "originally", "previously", "erst", "ursprünglich", "zunächst", "abord")
_MOST = 50


def without_crossed_out(written: TracedText, notes: dict[str, None]) -> TracedText:
    """Return an answer without what is crossed out; notes tell it."""
    edits = list(_edits(written.text))
    for start, end, _ in edits:
        notes.setdefault(
            f"'{' '.join(written.text[start:end].split())}' was not judged: it is crossed out or taken back."
        )
    return written.edited(edits)


def _edits(text: str) -> Iterator[Edit]:
    lines: list[tuple[int, int]] = []
    if any(word in text.lower() for word in _WORDS):
        said = [m.start() for m in _SAID.finditer(text)][:_MOST]
        lines = sorted({(text.rfind("\n", 0, k) + 1, _end(text, k)) for k in said})
    if any(word in text.lower() for word in _BEFORE):
        taken = [m for m in islice(_TAKEN_BACK.finditer(text), _MOST) if "=" in m["said"] and _is_taken_back(m)]
        lines = sorted(
            {*lines, *(m.span("said") for m in taken if not any(a <= m.start("said") < b for a, b in lines))}
        )
    yield from ((*line, " ") for line in lines)
    for start, end in _marked(text):
        if not any(a <= start < b for a, b in lines):
            yield start, end, " "


def _is_taken_back(match: re.Match[str]) -> bool:
    """Whether a sentence about what stood there before says that it was wrong, or why it was there."""
    had = match["had"] or match["had_2"] or match["had_3"]
    return _WRONG.search(match["said"]) is not None or (had is not None and _WHY.search(match["said"]) is not None)


def _marked(text: str) -> Iterator[tuple[int, int]]:
    if "~~" in text or "<" in text:
        yield from (m.span() for m in _BETWEEN.finditer(text))
    elif "out" in text:
        end = 0
        for match in list(_COMMAND.finditer(text))[:_MOST]:
            if match.start() >= end:
                end = closing(text, match.end())
                yield match.start(), end


def _end(text: str, start: int) -> int:
    """The end of a line."""
    end = text.find("\n", start)
    return len(text) if end < 0 else end
