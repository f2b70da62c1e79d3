"""What quantities are said to depend on: after I(r) = …, I(r) is I and no product of I and r."""

from __future__ import annotations

import re
from collections.abc import Callable

_NAME = r"(?<![\w\\])\\?[^\W\d_]\w*(?:\{\w{1,20}\})?"
_STATED = re.compile(
    rf"(?P<name>{_NAME})\s{{0,3}}(?P<of>(?:\\left)?\([^()=+*/^\n-]{{1,60}}\))\s{{0,3}}&?\s{{0,3}}=(?!=)"
)
_QUANTITY = re.compile(r"\s*(?:\\d{0,2}dot)?[\s{]*\\?[^\W\d_]\w*(?:\{\w{1,20}\})?[\s}'’]*\Z")
_BEFORE = re.compile(r"(?:([^\W\d_]+)|[\w*/+^·×=)\]}'−-])[ \t]*\Z")
"""What makes something a factor or a term, and no beginning of a statement; a word of several letters does not."""

_MATRIX = re.compile(r"\s*(?:\[|\\begin|\\left)")

_MAX = 100
"""The largest number of such quantities."""


def dependents(text: str, taken: Callable[[str], bool]) -> frozenset[str]:
    """Return the quantities that an answer states with what they depend on, as I(r); ``taken`` are names of the
    system, which are no such quantities unless they are given a matrix."""
    found: set[str] = set()
    for match in _STATED.finditer(text):
        name, of = written(match["name"]), match["of"].removeprefix("\\left")[1:-1].removesuffix("\\right")
        before = _BEFORE.search(text, max(0, match.start() - 40), match.start())
        first = before is None or (before[1] is not None and len(before[1]) > 1 and not taken(before[1]))
        free = not taken(name) or _MATRIX.match(text, match.end()) is not None
        if len(found) < _MAX and first and free and all(_QUANTITY.match(x) for x in re.split("[,;]", of)):
            found.add(f"{name}({written(of)})")
    return frozenset(found)


def written(text: str) -> str:
    r"""Return a quantity without spaces, braces and commands: J_{b}(\theta) as Jb(theta)."""
    return re.sub(r"\\(?:left|right|,)|[\s\\{}_]", "", text)
