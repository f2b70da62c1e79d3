"""Says which derivative a line goes on with, where it writes d/dt alone, or an arrow and the acceleration alone.

∂T/∂ẋ = m ẋ  ⇒  d/dt = m ẍ          d/dt(∂T/∂ẋ) = m ẍ
∂L/∂q̇ = L q̇     d/dt → L q̈          d/dt(∂L/∂q̇) = L q̈
∂T/∂ẏ = m ẏ → m ÿ;  ∂V/∂y = m g     d/dt(∂T/∂ẏ) = m ÿ
∂L/∂ẏ = m ẏ ⏎ d/dt = m ÿ            d/dt(∂L/∂ẏ) = m ÿ          also d/dt(..) = m ÿ and d/dt → m ÿ
∂T/∂ẋ = m ẋ ⏎ ∂T/∂ẏ = M ẏ ⏎ d/dt: m ẍ ⏎ M ÿ     d/dt(∂T/∂ẋ) = m ẍ ⏎ d/dt(∂T/∂ẏ) = M ÿ

Both mean the derivative by time of what stands in front, on the same line or above, which is judged as such. As many
lines as there are derivatives above are those of each of them, in this order.
"""

from __future__ import annotations

import re
from collections.abc import Sequence, Set
from itertools import takewhile

from lagrangian.check.reading.prose.words_or_mathematics import moves
from lagrangian.check.reading.traced_text import TracedText
from lagrangian.read.letters import undotted

_BY = r"[^\W\d](?:\w|[\u0307\u0308]){0,24}['’′]?"
_PARTIAL = re.compile(rf"(?P<slope>(?:∂|d)(?P<of>[TLVDℒ])\*?\s?/\s?(?:∂|d)(?P<by>{_BY}))\s*=(?![=>])")
_ARROW = r"(?:=+>|⇒|⟹|→|⟶|-+>|➔|➜)"
_NOTHING = r"(?:[(\[{][ \t]*(?:[.·…]{0,9}|-?[\"″]-?|ditto|dito|this|that|it)[ \t]*[)\]}]|\.{2,4}|…)?+"
"""What stands for what is differentiated: d/dt(..), d/dt[ ], d/dt …"""
_BY_TIME = rf"d\s?/\s?dt[ \t]*+{_NOTHING}[ \t]*+"
_ALONE = re.compile(rf"(?<![\w/)])(?:{_ARROW}[ \t]*)?{_BY_TIME}(?:{_ARROW}|=(?!=)|:(?=[ \t]))")
"""d/dt of nothing, with what stands between it and its value."""
_BEGINS = re.compile(rf"[ \t]*+(?:[-•*][ \t]+)?(?:{_ARROW}[ \t]*)?(?P<said>{_BY_TIME}(?:{_ARROW}|=(?!=)|:(?=[ \t])))")
"""d/dt of nothing at the beginning of a line."""
_BARE = re.compile(r"[ \t]*+[^\s+−=*/·^-][^=<>:]*+$")
"""A line with an expression that goes on with no line above."""
_MARKS_RATE = re.compile(r"_?(?:d|dt|dot|p|t)")
_GIVES = re.compile(rf"{_ARROW}(?P<value>[^=;\n]{{1,200}}?)(?=[;,]|[ \t]{{2,}}\S|$)")
"""A value behind an arrow."""
_TWICE = re.compile(r"['’′]{2}|[\u0308ẍÿẅ¨]|ddot|dd\b")


def with_derivatives(text: TracedText, *, latex: bool = False) -> TracedText:
    """Return a text in which every derivative by time in plain text says of what it is one; in ``latex`` on lines
    without commands and mathematics between delimiters."""
    edits: list[tuple[int, int, str]] = []
    above: str | None = None
    stems = {m["by"] for m in _PARTIAL.finditer(text.text)}
    lines = [x for x in re.finditer(r"[^\n]+", text.text) if x.group().strip()]
    listed, group = dict[int, str](), list[str]()
    for k, line in enumerate(lines):
        if latex and ("\\" in line.group() or "$" in line.group()):
            above = None
            continue
        slopes = [m for m in _PARTIAL.finditer(text.text, *line.span()) if _is_rate(m["by"], stems)]
        begins = _BEGINS.match(text.text, *line.span())
        group = [*group, *(m["slope"] for m in slopes)]
        if begins is not None and above is not None and k not in listed:
            listed |= _each(lines[k : k + len(group) + 1], k, group)
            group = []
        if begins is not None and above is not None:
            edits.append((*begins.span("said"), f"d/dt({listed.get(k, above)}) = "))
        elif k in listed:
            start = line.end() - len(line.group().lstrip())
            edits.append((start, start, f"d/dt({listed[k]}) = "))
        ends = [*(m.start() for m in slopes[1:]), line.end()]
        for slope, end in zip(slopes, ends[: len(slopes)], strict=True):
            found = _ALONE.search(text.text, slope.end(), end) or _value(text.text, slope.end(), end)
            if found is not None:
                start, stop = (
                    found.span() if "value" not in found.groupdict() else (found.start(), found.start("value"))
                )
                edits.append((start, stop, f"; d/dt({slope['slope']}) = "))
        above = slopes[-1]["slope"] if slopes else above
    return text.edited(edits)


def _each(lines: Sequence[re.Match[str]], first: int, slopes: Sequence[str]) -> dict[int, str]:
    """The derivatives that several lines go on with, by the numbers of these, the first of which begins with d/dt, and
    the others as well or with no equals sign; none if they are not as many as the ``slopes``."""
    written = (x.group() for x in lines[1:])
    count = 1 + sum(1 for _ in takewhile(lambda x: _BEGINS.match(x) or (_TWICE.search(x) and _BARE.match(x)), written))
    same = 1 < count == len(slopes) == len({*slopes})
    return {first + k: slope for k, slope in enumerate(slopes)} if same else {}


def _is_rate(name: str, stems: Set[str]) -> bool:
    """Whether a name by which an energy is differentiated is a rate: with a mark, or th_d where there is th, too."""
    if moves(name) or undotted(name)[1]:
        return True
    return any(name != x and name.startswith(x) and _MARKS_RATE.fullmatch(name[len(x) :]) for x in stems)


_WORD = r"[^\W\d_]{1,15}"
_ENERGY_BESIDE = re.compile(
    rf"(?<!\w)(?P<name>[TV]\*?)[ \t]*=(?!=)[^=;,:\n]{{1,300}}"
    rf"(?P<said>[,;][ \t]+(?:{_WORD}[ \t]+){{0,4}}(?i:energy|energie)(?:[ \t]+{_WORD}){{0,4}}[ \t]?:)(?=[ \t])"
)


def with_energies_beside(text: TracedText) -> TracedText:
    """Return a plain text in which an energy in words behind T or V is a part of it: T = A, energy in the coil: B."""
    return text.edited((*m.span("said"), f"; {m['name']} = ") for m in _ENERGY_BESIDE.finditer(text.text))


_ENERGY = r"(?:[TLVD]|\\math(?:cal|scr)\s?\{[^{}]\}|\\mathcal\s[A-Z])(?:\^\s?(?:\*|\{\*\}))?"
_FRACTION = r"\\[dt]?frac\s?"
_LATEX_DOT = r"\\partial\s?\\dot\s?[^{}=]{0,20}(?:\{[^{}]{1,20}\}[^{}=]{0,20}){0,2}"
_LATEX_SLOPE = (
    rf"(?P<slope>{_FRACTION}\{{\\partial\s?{_ENERGY}\s?\}}\s?\{{{_LATEX_DOT}\}}"
    rf"|\\partial\s?{_ENERGY}\s?/\s?{_LATEX_DOT})\s{{0,4}}&?\s{{0,4}}="
)
_LATEX_ALONE = (
    rf"(?P<alone>{_FRACTION}\{{\s?(?:d|\\mathrm\s?\{{d\}})\s?\}}\s?\{{\s?(?:d|\\mathrm\s?\{{d\}})\s?t\s?\}})"
    r"\s{0,4}(?:(?:\\left)?[(\[]\s{0,4}(?:\\[lc]?dots?|\\cdot|\.{2,3})\s{0,4}(?:\\right)?[)\]]\s{0,4})?(?P<is>&?\s{0,4}(?:=|\\(?:to|rightarrow|Rightarrow)(?![A-Za-z])))"
)
_LATEX = re.compile(rf"{_LATEX_SLOPE}|{_LATEX_ALONE}")


def with_derivatives_in_latex(text: TracedText) -> TracedText:
    """Return an answer in LaTeX in which d/dt alone says of what it is the derivative: of the last slope above."""
    edits: list[tuple[int, int, str]] = []
    above: str | None = None
    for match in _LATEX.finditer(text.text):
        if match["slope"]:
            above = match["slope"]
        elif above is not None:
            aligned = "&" if "&" in match["is"] else ""
            edits.append((*match.span(), rf"\Rightarrow \frac{{d}}{{dt}}\left({above}\right) {aligned}= "))
    return text.edited(edits)


def _value(text: str, start: int, end: int) -> re.Match[str] | None:
    """An arrow with an expression that accelerates behind it, and no equals sign."""
    found = _GIVES.search(text, start, end)
    return found if found is not None and _TWICE.search(found["value"]) is not None else None
