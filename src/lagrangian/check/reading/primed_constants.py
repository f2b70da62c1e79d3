"""Reads primes of constants as parts of names: g' = g sin γ, J' = J + m a². A constant has no rate."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.prose.words_or_mathematics import moves
from lagrangian.check.reading.traced_text import TracedText

MOST = 20
"""The most such names."""

_STATED = re.compile(
    r"(?<![\w'’′\\^*/+−-])(?P<name>[^\W\d_](?:_?\w{1,6}|_\{\w{1,6}\})?)(?:['’′]|\^\{?\\prime\}?)[ \t]*&?:?=(?![=>])"
    r"(?P<value>[^\n=,;:]{1,200})"
)


def with_primed_constants(written: TracedText, is_constant: Callable[[str], bool]) -> TracedText:
    """Return an answer in which constants with a prime, to which it gives a value without rates, have names of letters.

    One that has two primes or a dot elsewhere moves: the answer uses its letter for something of its own.
    """
    for match in islice(_STATED.finditer(written.text), MOST):
        name = match["name"]
        bare = name.replace("{", "").replace("}", "")
        again = rf"(?<![\w\\]){re.escape(name)}"
        rates = re.search(rf"{again}['’′]{{2}}|dot\s?\{{?\s?{re.escape(name)}(?!\w)", written.text)
        spoken = re.search(r"[^\W\d_]", match["value"]) is not None  # g' = 0 says that it has a rate
        if not spoken or not is_constant(bare) or moves(match["value"]) or "dot" in match["value"] or rates is not None:
            continue
        form = re.compile(rf"{again}(?:['’′](?!['’′])|\^\{{?\\prime\}}?)")
        written = written.sub(form, lambda m, bare=bare: f"{bare}prime" if "_" in bare else f"{bare}_prime")
    return written
