r"""Two forms of one Greek letter that an answer in LaTeX tells apart: ``\vartheta = -\theta``.

Everywhere else both are the same letter.
"""

from __future__ import annotations

import re

from lagrangian.check.reading.traced_text import TracedText

_LETTERS = "theta|phi|epsilon|rho|sigma"
_ALONE = r"(?:^|[$(,;:&]|\\\[|\\\()[ \t]{0,9}"
_RELATED = re.compile(
    rf"{_ALONE}\\(?:var(?P<new>{_LETTERS})[ \t]{{0,9}}&?=[^=$\n;]{{0,80}}?\\(?P=new)(?![A-Za-z])"
    rf"|(?P<old>{_LETTERS})[ \t]{{0,9}}&?=[^=$\n;]{{0,80}}?\\var(?P=old)(?![A-Za-z]))",
    re.MULTILINE,
)
"""One of the two alone on the left, and the other one in what it is."""


def with_variants_apart(text: TracedText) -> TracedText:
    r"""Return a text in which ``\vartheta`` has a name of its own, if it says what this is in terms of ``\theta``."""
    apart = {m["new"] or m["old"] for m in _RELATED.finditer(text.text)}
    if not apart:
        return text
    form = re.compile(rf"\\(var(?:{'|'.join(sorted(apart))}))(?![A-Za-z])")
    return text.sub(form, lambda m: rf"\mathrm{{{m[1]}}}")
