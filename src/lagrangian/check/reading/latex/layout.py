r"""Takes layout off LaTeX: braces under terms, marks over signs, crossed-out terms, colours, upright units."""

from __future__ import annotations

import re

from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.quantities.units import joined, lookup

_COVERS = "underbrace overbrace underbracket overbracket underset overset stackrel cancel bcancel xcancel"
_UNDER = re.compile(rf"\\(?:{'|'.join(_COVERS.split())})\s*\{{")
_DROPPED_FIRST = frozenset(["underset", "overset", "stackrel"])
_SIGN = re.compile(r"\s*\{\s*([=+<>-]|\\equiv)\s*\}")
_SIGNED = re.compile(r"\{\s*(?:\{\}\s*)?[+-]")
_COLOURED = re.compile(
    r"\\(?:textcolor|colorbox|mathcolor)\s*(?:\[[^\]]*\])?\s*\{[^{}]*\}\s*(?=\{)|\\color\s*\{[^{}]*\}"
)
_CLASS = re.compile(r"\\(?:(?P<hidden>[hv]?phantom)|math(?:rel|bin|op|ord|open|close|punct|inner))\s*\{")
_UNITS = re.compile(r"(?<=\d)(?:\s|~|\\[,;:! ])*\\(?:mathrm|text|textrm|si|unit)\s*\{(?P<unit>[^{}]{0,60})\}")
_ENVIRONMENT = re.compile(r"\\begin\{(?P<kind>(?:align|gather|flalign|alignat)\*?)\}(?:\{\d\})?")
_BETWEEN = re.compile(r"\\(?:short)?intertext\s*\{")
_ROW_ENDS = re.compile(r"(?:\\\\(?:\[[^\]]{0,12}\])?|\\begin\{[a-z]{1,12}\*?\}(?:\{\d\})?)\s*\Z")
"""What stands before the beginning of a row."""
_GAP = r"(?:\s|~|&|\\[,;:! ]|\\(?:q?quad|hfill|hspace\*?\{[^{}]{0,12}\})(?![A-Za-z])|\{\s?\})"
_DONE = re.compile(
    r"(?:\\(?:blacksquare|square|Box|[qQ][eE][dD]|qedsymbol|qedhere|checkmark|bigstar|blacktriangle|triangleleft)"
    rf"(?![A-Za-z])|[✓✔☑∎■□▢])(?={_GAP}*+(?:\\\\|\\end\{{|[.,;}}]|\Z))"
)
"""What says that the work is done, behind an equation: \\qquad\\blacksquare."""
_BEFORE = re.compile(rf"{_GAP}++\Z")
_AROUND = re.compile(
    rf"{_GAP}*+(?:\\(?:left|[bB]igg?l?)(?![A-Za-z])\s?)?[(\[](?P<inside>[^\0]{{1,2000}}?)"
    rf"(?:\\(?:right|[bB]igg?r?)(?![A-Za-z])\s?)?[)\]](?:{_GAP}|[.;,])*+"
)
"""A row in brackets."""
_DEEP = re.compile(r"[(\[{}\])=]")
_FAR = 40
"""The most characters of space in front of such a mark."""
_MAX = 200


def with_open_text(written: TracedText) -> TracedText:
    r"""Return an answer in which words with mathematics between rows, \\intertext{with $a = b$}, stand outside the
    environment, which ends before them and begins again behind them; a row ends before all such words."""
    text = written.text
    edits: list[Edit] = []
    for match in list(_BETWEEN.finditer(text))[:_MAX]:
        opened = list(_ENVIRONMENT.finditer(text, 0, match.start()))
        end = closing(text, match.end())
        if opened and "$" in text[match.end() : end]:
            last = opened[-1]
            edits.append((*match.span(), f"\\end{{{last['kind']}}}\n"))
            edits.append((end - 1, end, f"\n{last.group()}"))
        elif opened and _ROW_ENDS.search(text, max(0, match.start() - 60), match.start()) is None:
            edits.append((match.start(), match.start(), "\\\\ "))
    return written.edited(edits)


_DISPLAY = r"(?:equation|displaymath|align|gather|multline|eqnarray|flalign|dmath)\*?"
_BETWEEN_DISPLAYS = re.compile(
    rf"\s{{0,40}}(?:\\\]\s*+\\\[|(?P<dollars>\$\$\s*+\$\$|(?<!\$)\$[ \t]*+\n\s*+\$(?!\$))"
    rf"|\\end\{{(?P<kind>{_DISPLAY})\}}\s*+\\begin\{{(?P=kind)\}})\s*+"
)
_SPACES = (
    r"(?:\s|~|&|\\[,;:! ]|\\q?quad(?![A-Za-z])|\\(?:left\.|hspace\*?\{[^{}]{0,12}\}|phantom\{[^{}]{0,40}\})|\{\s?\})"
)
_GOES_ON = re.compile(
    rf"(?P<gap>{_SPACES}*+)(?:(?P<sign>[-+−])|(?P<equals>=)|[*/·×)\]^]|\\(?:cdot|times|right)(?![A-Za-z]))"
)
_OPEN_END = re.compile(rf"(?:[-+=*/·×(\[^]|\\(?:cdot|times|left[(\[]))(?:{_SPACES}|\\[^\W\d_]?\s)*+\Z")
_ACCELERATES = re.compile(r"\\ddot|''|\^\{?\\prime\\prime|\\d?frac\{\s?(?:d|\\mathrm\{d\})\^")
_ROW_ENDS_AT = re.compile(r"\\\\(?:\[[^\]]{0,12}\])?")
_LARGEST = 3_000
"""The most characters of a row at the end or the beginning of a display."""


def with_displays_joined(text: str) -> str:
    r"""Return a text in which a display that goes on in the next one, with nothing but space between them, is one with
    it: \[ m\ddot x \] \[ {}+ kx = F \]. The next one begins with a sign, or the first one ends with one, and
    not both state something."""
    letters = list(text)
    for match in list(_BETWEEN_DISPLAYS.finditer(text))[:_MAX]:
        if (dollars := match["dollars"]) and text.count(dollars[:2].strip(), 0, match.start()) % 2 == 0:
            continue  # the second ones are the end of a display
        before = _ROW_ENDS_AT.split(text[max(0, match.start() - _LARGEST) : match.start()])[-1]
        before = re.split(r"\\\[|\$|\\begin\{[a-z]{1,12}\*?\}", before)[-1]
        next_one = re.split(r"\\\]|\$|\\end\{", text[match.end() : match.end() + _LARGEST], maxsplit=1)[0]
        behind, *below = _ROW_ENDS_AT.split(next_one)
        behind = behind if "=" in behind else "".join((behind, *below))  # its first equation, over several rows
        if _is_one(before, behind):
            letters[match.start() : match.end()] = " " * len(match.group())
    return "".join(letters)


def _is_one(before: str, behind: str) -> bool:
    """Whether the end of a display and the beginning of the next one are one equation."""
    stated = [x.count("=") for x in (before, behind)]
    goes_on = _GOES_ON.match(behind)
    if (
        not before.strip()
        or not behind.strip()
        or min(stated) > (goes_on is not None and goes_on["equals"] is not None)
    ):
        return False
    if goes_on is None:
        return max(stated) == 1 and _OPEN_END.search(before) is not None
    if goes_on["sign"] is None or goes_on["gap"].strip():
        return True
    return sum(stated) > 0 and (stated[0] > 0 or _ACCELERATES.search(before) is not None)


def without_brackets_around(text: str) -> str:
    r"""Return a row of LaTeX without brackets around it in which equations stand: \bigl(C = \cos\theta\bigr)."""
    match = _AROUND.fullmatch(text) if ")" in text or "]" in text else None
    if match is None or "=" not in match["inside"]:
        return text
    depth, stated = 0, False
    for mark in _DEEP.findall(match["inside"]):
        depth += (mark in "([{") - (mark in ")]}")
        stated |= mark == "=" and depth == 0
        if depth < 0:
            return text
    if depth or not stated:
        return text
    return " " * match.start("inside") + match["inside"] + " " * (len(text) - match.end("inside"))


def without_end_marks(text: str) -> str:
    r"""Return the text without the marks that say behind an equation that the work is done; one that is a side or a
    factor, x = \\square, stays."""

    def blank(match: re.Match[str]) -> str:
        before = _BEFORE.sub("", text[max(0, match.start() - _FAR) : match.start()])
        stays = before[-1:] in {*"=+-−*/·^_({[<>", ""}
        return match.group() if stays else " " * len(match.group())

    return _DONE.sub(blank, text)


def without_braces(text: str) -> str:
    r"""Return the text with \\underbrace{X}_{words} as X, \\overset{!}{=} as =, and colours left out; places stay."""
    text = _without_classes(_COLOURED.sub(lambda m: " " * len(m.group()), text))
    for _ in range(_MAX):
        match = _UNDER.search(text)
        if match is None:
            return text
        text = _uncovered(text, match)
    return text


def _without_classes(text: str) -> str:
    r"""The text without what is not printed, \\phantom{=}, and without what only says how far signs stand apart,
    \\mathrel{=}."""
    at = 0
    for _ in range(_MAX):
        match = _CLASS.search(text, at)
        if match is None:
            return text
        end, at = closing(text, match.end()), match.end()
        if match["hidden"]:
            text = f"{text[: match.start()]}{' ' * (end - match.start())}{text[end:]}"
        else:
            text = f"{text[: match.start()]}{' ' * len(match.group())}{text[match.end() : end - 1]} {text[end:]}"
    return text


def _uncovered(text: str, match: re.Match[str]) -> str:
    """The text without one such command."""
    inside = match.end() - 1
    end = closing(text, match.end())
    name = match.group()[1:].rstrip("{ ")
    letters = list(text)

    def drop(start: int, stop: int) -> None:
        letters[start:stop] = " " * (stop - start)

    drop(match.start(), inside)
    if (signed := _SIGNED.match(text, inside)) is not None:  # what is printed is a − b
        drop(inside, signed.end() - 1)
        drop(end - 1, end)
    if name in _DROPPED_FIRST:
        drop(inside, end)
        if (sign := _SIGN.match(text, end)) is not None:
            drop(end, sign.start(1))
            drop(sign.end(1), sign.end())
        return "".join(letters)
    if (below := re.compile(r"\s*[_^]\s*").match(text, end)) is not None:
        stop = closing(text, below.end() + 1) if text[below.end() : below.end() + 1] == "{" else below.end() + 1
        drop(end, stop)
    return "".join(letters)


_SPOKEN = re.compile(r"\s*\([^()]*?(?<![^\W\d_])[^\W\d_]{3,}")
_ROW_OR_SIDE = re.compile(r"(?<!\\)&|\\\\|=|\$|\n[ \t]*\n|[()]")


def remark_end(text: str, start: int, end: int) -> int:
    r"""Where a bracket of words ends that begins in text, between ``start`` and ``end``, and goes on in mathematics:
    \text{(arm at }90^\circ); 0 if none does before the row ends, or if an equals sign stands in it."""
    if _SPOKEN.match(text, start, end - 1) is None or ")" in text[start:end]:
        return 0
    depth = 0
    for match in _ROW_OR_SIDE.finditer(text, start, end + _LONGEST_REMARK):
        if match.group() not in "()":
            return 0
        depth += 1 if match.group() == "(" else -1
        if depth == 0:
            inside = text[end : match.start()]
            return closing(text, match.end()) if inside.count("{") > inside.count("}") else match.end()
    return 0


_LONGEST_REMARK = 120
"""The most characters of mathematics and words in which such a bracket goes on."""


def without_units(text: str) -> str:
    r"""Return the text without SI units in upright letters after a number: 3\\,\\mathrm{kg\\,m^2} is 3."""

    def plain(match: re.Match[str]) -> str:
        names = re.findall(r"[^\W\d_]+", re.sub(r"\\(?:cdot|,|;|:|!)", " ", match["unit"]))
        found = [lookup(part) for name in names for part in (joined(name) or (name,))]
        whole = bool(found) and all(unit is not None and unit.factor == 1 for unit in found)
        return " " * len(match.group()) if whole else match.group()

    return _UNITS.sub(plain, text)


_GAP_AT_END = re.compile(r"(?:\\[,;:!>\s]|\\q?quad|[\s~,]|\\)\Z")
_FAR_GAP = 8
"""The most characters of one piece of spacing."""


def without_gap(text: str) -> str:
    r"""The text without commas and spacing at its end: = b\\, \\\\ ends a row, = \\; \\\\ does not."""
    end = len(text)
    while (gap := _GAP_AT_END.search(text, max(0, end - _FAR_GAP), end)) is not None:
        end = gap.start()
    return text[:end]


def closing(text: str, start: int) -> int:
    """The position after the brace that closes the one that was opened before ``start``."""
    depth, at = 1, start
    while at < len(text) and depth:
        if text[at] == "\\":
            at += 1
        else:
            depth += {"{": 1, "}": -1}.get(text[at], 0)
        at += 1
    return min(at, len(text))
