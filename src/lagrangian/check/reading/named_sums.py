"""Reads the sign of a sum in front of a letter as part of a name, where the answer says what is added up.

Σm := m0 + m1 + m2, Σm z'' = F        Σ_m = m0 + m1 + m2, Σ_m z'' = F

It is a name if it has one such value, of constants with this letter; ∑F = m x'' and ∑M = J φ'' say what is added.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.traced_text import TracedText

_SIGN = r"(?:(?<!\w)[∑Σ]|\\(?:sum|Sigma)(?![A-Za-z]))"
_STATED = re.compile(
    rf"{_SIGN}[ ]?(?P<letter>[^\W\d_])(?!\w)[ \t]*+:?=[ \t]*+(?P<value>[\w{{}} \t]{{1,30}}\+[\w{{}}+ \t]{{1,120}}+)"
    r"(?=[,;.)$\n\\]|\Z)"
)
_NAME = re.compile(r"[^\W\d_]\w{0,15}")
_MOST = 12
"""The most such values that are looked at."""


def with_named_sums(written: TracedText, fixed: Callable[[str], bool], *, latex: bool) -> TracedText:
    """Return an answer in which such sums have a name; ``fixed`` says whether a name is a constant of the system."""
    found: dict[str, list[str]] = {}
    for match in islice(_STATED.finditer(written.text), _MOST):
        terms = [_NAME.fullmatch(re.sub(r"[{}\s]", "", x)) for x in match["value"].split("+")]
        names = [None if x is None else x.group() for x in terms]
        if all(x is not None and x[0].lower() == match["letter"].lower() and fixed(x) for x in names):
            found.setdefault(match["letter"], []).append(match["value"])
    for letter in (x for x, values in found.items() if len(values) == 1):
        form = re.compile(rf"{_SIGN}[ ]?{letter}(?![\w'’′])")
        if len(form.findall(written.text)) > 1:
            sign = "\\Sigma" if latex else "Σ"
            written = written.sub(form, lambda _, name=f"{sign}_{letter}": name)
    return written
