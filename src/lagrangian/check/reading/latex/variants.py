r"""Two forms of one letter that an answer in LaTeX tells apart: ``\vartheta = -\theta``, and ``\ell``, which moves,
beside a constant ``l``.

Everywhere else both are the same letter.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.traced_text import TracedText

_LETTERS = "theta|phi|epsilon|rho|sigma|kappa"
_ALONE = r"(?:^|[$(,;:&]|\\\[|\\\()[ \t]{0,9}"
_RELATED = re.compile(
    rf"{_ALONE}\\(?:var(?P<new>{_LETTERS})[ \t]{{0,9}}&?=[^=$\n;]{{0,80}}?\\(?P=new)(?![A-Za-z])"
    rf"|(?P<old>{_LETTERS})[ \t]{{0,9}}&?=[^=$\n;]{{0,80}}?\\var(?P=old)(?![A-Za-z]))",
    re.MULTILINE,
)
"""One of the two alone on the left, and the other one in what it is."""


_LENGTH = re.compile(rf"{_ALONE}\\ell(?![A-Za-z])(?:\(t\))?[ \t]{{0,9}}&?=(?P<value>[^$\n;]{{1,300}})", re.MULTILINE)
_ELL = re.compile(r"\\ell(?![A-Za-z])")
_WORD = re.compile(r"[A-Za-z]+")


def with_variants_apart(text: TracedText, changes: Callable[[str], bool], taken: Callable[[str], bool]) -> TracedText:
    r"""Return a text in which ``\vartheta`` has a name of its own, if it says what this is in terms of ``\theta``, and
    ``\ell``, if it is a length that ``changes`` where the name l, which is ``taken``, does not."""
    apart = {m["new"] or m["old"] for m in _RELATED.finditer(text.text)}
    if apart:
        form = re.compile(rf"\\(var(?:{'|'.join(sorted(apart))}))(?![A-Za-z])")
        text = text.sub(form, lambda m: rf"\mathrm{{{m[1]}}}")
    if not taken("l") or changes("l"):
        return text
    moves = any(any(map(changes, _WORD.findall(m["value"]))) for m in _LENGTH.finditer(text.text))
    return text.sub(_ELL, lambda _: r"\varell ") if moves else text
