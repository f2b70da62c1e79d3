r"""Redraws matrices that are typed between bars, or between slashes, with tall brackets.

    | M+m         m l cos θ | | x'' |   | F |         ⎡ M+m         m l cos θ ⎤ ⎡ x'' ⎤   ⎡ F ⎤
    | m l cos θ   J + m l²  | | θ'' | = | 0 |         ⎣ m l cos θ   J + m l²  ⎦ ⎣ θ'' ⎦ = ⎣ 0 ⎦

Each sign is replaced by one sign. What stands between bars in a single line is the size of a number, and a table of
Markdown has other things than signs between its columns.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lagrangian.check.reading.traced_text import Edit, TracedText

MOST, LONGEST = 2_000, 1_000
"""The most lines of an answer, and the most characters of a line, that are looked at."""

_LEAD = re.compile(r"\s*+(?:[^\W\d][\w ()^']{0,30}=)?\s*+\Z")
_GAP = re.compile(
    r"(?:[\s=+*·×@−-]*+|\s*+[.•∙⋅∘◦]\s*+|\s++x\s++"
    r"|\s{2,}+[^\W\d]\w{0,15}[ \t]*+=\s*+|\s*+[,;]\s*+[^\W\d]\w{0,15}[ \t]*+=\s*+)\Z"
)
"""What stands between matrices: signs, or the name of another one behind a gap."""
_DOT = re.compile(r"\s*+(?P<dot>[.•∙⋅∘◦x])\s*+")
"""A sign of products that is no other sign where it stands alone."""
_TAIL = re.compile(r"\s*+[.,;]?\s*+\Z")
_SLASH = re.compile(r"(?<!\S)[/\\](?=\s)|(?<=\s)[/\\](?!\S)")
_OPENS, _CLOSES = "⎡⎢⎣", "⎤⎥⎦"


def with_tall_brackets(written: TracedText) -> TracedText:
    """Return an answer in which matrices between bars over several lines have tall brackets."""
    if "|" not in written.text and "\\" not in written.text:
        return written
    return written.edited(_redrawn(written.text))


def _redrawn(text: str) -> Iterator[Edit]:
    block: list[tuple[int, list[int], str]] = []
    at = 0
    for line in [*text.split("\n")[:MOST], ""]:
        bars = _bars(line) if len(line) < LONGEST else []
        named = bars and "=" in line[: bars[0]] and any("=" in above[: x[0]] for _, x, above in block)
        if not bars or named or (block and len(bars) != len(block[0][1])):
            yield from _brackets(block)
            block = []
        if bars:
            block.append((at, bars, line))
        at += len(line) + 1


def _bars(line: str) -> list[int]:
    """Where matrices are opened and closed in a line that consists of rows of them; nothing if it does not."""
    bars = [k for k, c in enumerate(line) if c == "|"] or _slashes(line)
    if not bars or len(bars) % 2:
        return []
    between = [line[a + 1 : b] for a, b in zip(bars[1::2], bars[2::2], strict=False)]
    fits = _LEAD.match(line[: bars[0]]) and all(map(_GAP.match, between)) and _TAIL.match(line[bars[-1] + 1 :])
    return bars if fits else []


def _slashes(line: str) -> list[int]:
    r"""The places of the slashes of a first line, / a b \ / x \, or of a last one, \ c d / \ y /."""
    found = list(_SLASH.finditer(line))
    signs = "".join(m.group() for m in found)
    pairs = len(signs) // 2
    return [m.start() for m in found] if pairs and signs in ("/\\" * pairs, "\\/" * pairs) else []


def _brackets(block: Sequence[tuple[int, list[int], str]]) -> Iterator[Edit]:
    """The edits for lines below each other; none unless they are an equation of matrices."""
    if len(block) < 2:
        return
    outside = [[line[a:b] for a, b in _outside(bars, len(line))] for _, bars, line in block]
    told = [[x.strip() for x in column if x.strip()] for column in zip(*outside, strict=True)]
    if any(len(x) > 1 for x in told[:-1]) or not any("=" in x[0] for x in told if x):
        return
    first = [line[bars[0]] for _, bars, line in block]
    if first != ["|"] * len(first) and first != ["/", *["|"] * (len(first) - 2), "\\"]:
        return
    for k, (at, bars, line) in enumerate(block):
        piece = 0 if k == 0 else 2 if k == len(block) - 1 else 1
        for i, bar in enumerate(bars):
            yield at + bar, at + bar + 1, (_CLOSES if i % 2 else _OPENS)[piece]
        for a, b in _outside(bars, len(line))[1:-1]:
            if (dot := _DOT.fullmatch(line, a, b)) is not None:
                yield at + dot.start("dot"), at + dot.end("dot"), "*"


def _outside(bars: Sequence[int], end: int) -> list[tuple[int, int]]:
    """The places in front of, between and behind the brackets of a line."""
    return list(zip([0, *(x + 1 for x in bars[1::2])], [*bars[::2], end], strict=True))
