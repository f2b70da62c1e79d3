"""Takes what is only drawn around statements off an answer: boxes, rules, and headings between rules.

+----------+
| x'' = F  |           the equation remains
+----------+
--- output (lhs = rhs) ---        a heading
*** x'' = F ***                   the equation remains

Everything is replaced by spaces, so that all places stay the same.
"""

from __future__ import annotations

import re

_ONLY = re.compile(r"^[ \t]*+[-=_~–—*#+|.: \t]{3,}+$")
_RUN = re.compile(r"([-=_~–—*#])\1")
_RULED = re.compile(r"[ \t]*+(?P<mark>[-=_~*#–—])(?P=mark){1,80}+(?=[ \t])")
_LEFT = re.compile(r"^[ \t]*+([-=~*])\1{2,80}+[ \t]++(?=\S)", re.MULTILINE)
_RIGHT = re.compile(r"(?<=[\w)\]'’′″²³])[ \t]++([-=~*])\1{2,80}+[ \t]*+$", re.MULTILINE)
_BRACKETS = re.compile(r"\([^()\n]{0,80}\)")
_FRAMED = re.compile(r"^([ \t]*)([|*#!])(?=[ \t])([^\n]*[ \t])\2([ \t]*)$")


def without_rules(text: str) -> str:
    """Return an answer without boxes and rules; a heading between rules is blank, too, an equation is not."""
    if _RUN.search(text) is None:
        return text
    text = "\n".join(map(_without_heading, _without_boxes(text.split("\n"))))
    for form in (_LEFT, _RIGHT):
        text = form.sub(lambda m: " " * len(m.group()), text)
    return text


def _without_heading(line: str) -> str:
    """A line without the rules at both ends, and without what stands between unless it is an equation."""
    match = _RULED.match(line)
    said = line.rstrip(" \t")
    if match is None or not said.endswith(2 * match["mark"]):
        return line
    said = said.rstrip(match["mark"])
    if len(said) <= match.end() or said[-1] not in " \t":
        return line
    kept = "=" in _BRACKETS.sub("", said[match.end() :])
    return (" " * match.end() + said[match.end() :] if kept else "").ljust(len(line))


def _without_boxes(lines: list[str]) -> list[str]:
    """The lines, those of boxes without their frames."""
    found: list[str] = []
    corner = ""
    for line in lines:
        if _ONLY.match(line) and _RUN.search(line):
            corner = line.strip()[0]
            found.append(" " * len(line))
            continue
        framed = _FRAMED.match(line) if corner else None
        if framed is not None and (framed[2] == corner or (corner in "+.:" and framed[2] in "|!")):
            line = f"{framed[1]} {framed[3]} {framed[4]}"
        elif not line.strip():
            corner = ""
        found.append(line)
    return found
