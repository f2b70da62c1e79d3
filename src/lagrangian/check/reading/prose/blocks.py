"""How far what a line of an answer begins goes on below it: under a title, behind a colon, or in brackets."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lagrangian.check.reading.prose.remarks import accelerates_in

_HEADING = re.compile(r"[ \t]{0,3}#{1,6}[ \t]|[ \t]*\\(?:sub){0,2}(?:section|paragraph)\b")
_RULE = re.compile(r"[ \t]*(?:-{3,}|={3,}|~{3,})[ \t]*")
_OPEN = re.compile(r"[:,][ \t*`_)}\\]*\Z|=[ \t]*\Z")
_ENVIRONMENT = re.compile(r"[ \t]*\\(?:begin|end|item)\b")
_LAST = re.compile(r"[ \t]*\\end\{document\}")
_MOST_CLOSED = 12
"""The most lines of a remark in brackets."""
_LONGEST_TITLE = 8
"""The most words of a title on a line of its own."""
_WORD = re.compile(r"[^\W\d_]{2,}")


def _is_title(lines: Sequence[str], k: int) -> bool:
    """Whether a line is a heading."""
    line = lines[k]
    if _HEADING.match(line) or (k + 1 < len(lines) and line.strip() and _RULE.fullmatch(lines[k + 1])):
        return True
    words = line.split()
    if _ENVIRONMENT.match(line):
        return False
    return "=" not in line and bool(_WORD.search(line)) and len(words) <= _LONGEST_TITLE and not accelerates_in(line)


def is_open(lines: Sequence[str], k: int) -> bool:
    """Whether the lines below a line belong to it."""
    return _is_title(lines, k) or bool(_OPEN.search(lines[k].rstrip())) or "=" not in lines[k]


def closed(lines: Sequence[str], k: int) -> int:
    """The line behind a remark in brackets that begins on line k and is closed below it; 0 if it is none."""
    if not lines[k].lstrip().startswith("("):
        return 0
    depth = 0
    for j in range(k, min(k + _MOST_CLOSED, len(lines))):
        depth += lines[j].count("(") - lines[j].count(")")
        if depth <= 0:
            return j + 1 if depth == 0 and j > k and lines[j].rstrip(" \t.").endswith(")") else 0
    return 0


def end_below(lines: Sequence[str], k: int) -> int:
    """The line behind what stands under line k."""
    marked = bool(_HEADING.match(lines[k]))
    stated, j = False, k + 1
    if j < len(lines) and _RULE.fullmatch(lines[j]):
        marked, j = True, j + 1
    while j < len(lines):
        if lines[j].strip() and _is_end(lines, j, stated):
            break
        if stated and not marked and not lines[j - 1].strip() and accelerates_in(_block(lines, j)):
            break
        stated = stated or "=" in lines[j]
        j += 1
    return j


def _is_end(lines: Sequence[str], j: int, stated: bool) -> bool:
    """Whether a heading ends what stands above it: any behind an equation, a marked one anywhere."""
    if _LAST.match(lines[j]):
        return True
    marked = bool(_HEADING.match(lines[j])) or (j + 1 < len(lines) and bool(_RULE.fullmatch(lines[j + 1])))
    return marked or (_is_title(lines, j) and (stated or lines[j].rstrip().endswith(":")))


def _block(lines: Sequence[str], j: int) -> str:
    """The lines up to the next blank one."""
    end = next((i for i in range(j, len(lines)) if not lines[i].strip()), len(lines))
    return "\n".join(lines[j:end])
