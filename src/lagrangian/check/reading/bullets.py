"""Tells the bullets of a list from the minus in front of an equation: both are a sign and a blank at the beginning of a
line.

- T = 1/2 m x'^2          a bullet: nobody gives an energy with a minus in front of its name
- m x'' + k x = 0         a bullet beside such lines, or where all lines with an equals sign begin so; else a minus
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

from lagrangian.check.reading.prose.remarks import accelerates_in

_BULLET = re.compile(r"[ \t]*(?P<mark>[-*+•–])[ \t]+(?=\S)")
_STATED = re.compile(r"(?P<name>[^\W\d]\w{0,23}+)(?:\*|\^\*)?[ \t]*:?=(?![=>])")
_SAID = re.compile(
    r"[$\\]{0,3}[^\W\d_]\w{0,23}+['’′]{0,2}\$?[ \t](?:[^\W\d_]{1,24}[ \t]){0,2}?"
    r"(?:is|are|denotes|means|stands|points|ist|sind|bezeichnet|zeigt|est|sont|désigne)[ \t][^=]{3,}$"
)
"""A sentence of a list that says what a letter is, which no minus begins: θ is the angle of the buckets."""
_TERM = re.compile(
    r"[ \t]*[-–][ \t]+(?![$]|\\[(\[]|[^\W\d]\w*(?:\{\w{1,12}\})?['’′]{0,2}[ \t]*[:=]"
    r"|[^\W\d_]{2,}:?[ \t]+[^\W\d_]{2,}(?!\w)[ \t:])"
)
"""A line that begins with a minus or a bullet and goes on with a formula, not with words or a name and its value."""
_PRINTED = re.compile(r"\{\\left\(|\\frac\{d(?:\^\{2\})?\}\{d t")
"""How SymPy prints LaTeX, in which a blank stands behind a minus."""
_BY_TIME = re.compile(r"d\s?/\s?dt\b(?=[^=\n]*(?:=|[>→⇒⟶⟹]))(?![^=\n]*[\])][ \t]*[-+])")
"""A derivative by time alone on the left."""
_SIGNED = re.compile(r"[ \t]*[-+–]")
_UNFINISHED = re.compile(
    r"^(?![ \t]*[*_]{1,3}[^*_=\n]{1,80}[*_]{1,3}[ \t]*$)(?=[^=]*['′″²³*^()\u0307\u0308])[^=:]*[^\s=:.,;][ \t]*$"
)
"""A line that ends in mathematics, has no equals sign and is no heading in Markdown: *for x*."""
_DISPLAYED = re.compile(
    r"(?<!\\)\\(?:(?P<opens>begin\{(?!itemize|enumerate|document)|\[)|end\{(?!itemize|enumerate|document)|\])"
)
_DOLLARS = re.compile(r"(?<!\\)\$\$")


class Bullets:
    """What may be bullets in an answer. ``names`` says whether a name of which a line gives the value is one that has
    no minus in front of it: that of an energy, of a generalized force, or a new one."""

    def __init__(self, text: str, names: Callable[[str], bool]) -> None:
        self._lines = text.split("\n")
        displayed = _in_mathematics(self._lines)
        found = [None if own else _BULLET.match(x) for x, own in zip(self._lines, displayed, strict=True)]
        self._ends = [m.end() if m is not None else 0 for m in found]
        self._marks = [m["mark"] if m is not None else "" for m in found]
        self._sure = [bool(mark) and self._is_sure(k, names) for k, mark in enumerate(self._marks)]

    @property
    def doubtful(self) -> bool:
        """Whether a line begins with what may be a bullet or a sign."""
        unsure = any(mark and not sure for mark, sure in zip(self._marks, self._sure, strict=True))
        return unsure and not self._are_signs()

    def without(self, chosen: bool | None, notes: dict[str, None], *, marked: bool) -> str:
        """The answer in which bullets are blank: in the whole answer, or in a paragraph of several such lines, which a
        note tells if they may be a minus; ``chosen`` decides for all if it is not None. ``marked``: Markdown is used
        elsewhere."""
        every = range(len(self._lines))
        if chosen is not None:
            return self._blanked([k for k in every if chosen or self._sure[k]])
        if self._are_list(every, marked=marked):
            lists = [every]
        else:
            lists = [x for x in self._paragraphs() if not self._are_signs() and self._are_list(x)]
            lists += self._introduced(lists, marked=marked)
        if any(map(self._may_be_signs, lists)):
            notes.setdefault("The sign at the beginning of lines was read as that of a list.")
        return self._blanked([*self._beside_sure_ones(), *(k for x in lists for k in x)])

    def _is_sure(self, k: int, names: Callable[[str], bool]) -> bool:
        """Whether a line gives the value of a name that has no minus, or begins with a mark that is no sign, or with
        d/dt behind one, as a step does."""
        line = self._lines[k]
        if self._marks[k] == "•" or (self._marks[k] in "-–*" and _BY_TIME.match(line, self._ends[k])):
            return True
        if _SAID.match(line, self._ends[k]) or self._is_starred(k):
            return True
        stated = _STATED.match(line, self._ends[k])
        return stated is not None and names(stated["name"]) and self._marks[k] in "-–*" and not accelerates_in(line)

    def _is_starred(self, k: int) -> bool:
        """Whether a line, and all above it in its paragraph, begin with *: the first one goes on with no product."""
        while k >= 0 and self._lines[k].strip():
            if self._marks[k] != "*":
                return False
            k -= 1
        return True

    def _beside_sure_ones(self) -> Iterator[int]:
        """The lines with the mark of one in their paragraph that is a bullet, unless they go on with the line above."""
        for places in self._paragraphs():
            sure = {self._marks[k] for k in places if self._sure[k]}
            yield from (k for k in places if self._marks[k] in sure and not self._goes_on(k))

    def _goes_on(self, k: int) -> bool:
        above, line = self._lines[k - 1] if k else "", self._lines[k]
        return "=" in line and _SIGNED.match(line) is not None and _UNFINISHED.search(above) is not None

    def _may_be_signs(self, places: Sequence[int]) -> bool:
        """Whether what begins lines may be a minus as well as a bullet: all with an equals sign begin with it, and
        nothing shows that they are a list, such as words in front of an equation or a name that one defines."""
        stated = [self._lines[k] for k in places if "=" in self._lines[k] and self._marks[k]]
        return bool(stated) and all(map(_TERM.match, stated))

    def _are_signs(self) -> bool:
        """Whether lines that may begin with a minus are those of a program that puts a blank behind it."""
        return any(map(_PRINTED.search, self._lines)) and self._may_be_signs(range(len(self._lines)))

    def _introduced(self, lists: Sequence[range], *, marked: bool) -> list[range]:
        """Paragraphs of one line with an equals sign that are lists like the others, by what stands above them, words
        with a colon at their end: **Roller:** and a line with a bullet. Without ``lists`` they must be several, in an
        answer that uses Markdown elsewhere (``marked``)."""
        marks = {self._marks[k] for x in lists for k in x if self._marks[k]}
        found = [x for x in self._paragraphs() if x not in lists and self._is_introduced(x)]
        alike = marks if marks or not marked or len(found) < 2 else {self._marks[x[0]] for x in found}
        return [x for x in found if self._marks[x[0]] in alike] if not self._are_signs() and len(alike) == 1 else []

    def _is_introduced(self, places: range) -> bool:
        above = next((line for line in reversed(self._lines[: places[0]]) if line.strip()), "")
        return above.rstrip(" \t*_").endswith(":") and self._are_list(places, marked=True)

    def _are_list(self, places: Sequence[int], *, marked: bool = False) -> bool:
        """Whether several lines with an equals sign begin with the same bullet, and none without; one if Markdown is
        used elsewhere (``marked``)."""
        if any(map(self._goes_on, places)) or (not marked and self._are_signs()):
            return False
        marks = [self._marks[k] for k in places if "=" in self._lines[k]]
        return len(marks) > (0 if marked else 1) and len(set(marks)) == 1 and marks[0] != ""

    def _paragraphs(self) -> list[range]:
        blank = [-1, *(k for k, line in enumerate(self._lines) if not line.strip()), len(self._lines)]
        return [range(a + 1, b) for a, b in pairwise(blank) if b > a + 1]

    def _blanked(self, places: Sequence[int]) -> str:
        ends = {k: self._ends[k] for k in places}
        return "\n".join(" " * ends.get(k, 0) + line[ends.get(k, 0) :] for k, line in enumerate(self._lines))


def _in_mathematics(lines: Sequence[str]) -> list[bool]:
    """Whether each line begins inside mathematics of LaTeX on lines of its own, where a sign is a sign."""
    found: list[bool] = []
    depth = dollars = 0
    for line in lines:
        found.append(depth > 0 or dollars % 2 > 0)
        for match in _DISPLAYED.finditer(line):
            depth = max(0, depth + (1 if match["opens"] else -1))
        dollars += len(_DOLLARS.findall(line))
    return found
