r"""Primes of names that are no rates, where rates have dots: Θ′ = 2 m r² sin φ cos φ is ∂Θ/∂φ, and so is U′ = ….

Such a value holds one coordinate and no rate, so that it is no derivative by time.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice
from unicodedata import normalize

from lagrangian.check.reading.arguments import QUOTIENT, apart_from, is_in_chain
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.read.letters import key

MOST = 12
"""The most such names."""

_NAME = r"\\?[^\W\d_]\w{0,15}?"
_STATED = re.compile(
    rf"(?:^|[,;:&$]|(?<=\])|\\\[|\\quad|(?<=[^\W\d_]{{3}})[ ]|[-*•–][ ])[ \t$]*+(?P<name>{_NAME})[ ]?['’′](?!['’′″])"
    r"[ \t]*+&?[ \t]*+=(?![=>])(?P<value>[^\n=;]{1,300})",
    re.MULTILINE,
)
"""A name with a prime that is given a value."""
_BEGINS = r"(?:(?<![\w\\])|(?<=[½¼¾⅓⅔])|(?<=frac\d\d)|(?<=[-+−–=(\[{ ]\d))"
"""Where a name begins, also behind a fraction or a number: ½I'."""
_DOTS = re.compile("[\u0307\u0308]|\\\\d?dot(?![A-Za-z])")
_PRIMED = re.compile(r"(?<![^\W\d_])(?P<name>\\?[^\W\d_]\w{0,15}?)[ ]?['’′″]")
_LETTERS = re.compile(r"\\?[^\W\d_]+")
_FUNCTION = re.compile(r"\\?(?:sin|cos|tan)(?=[^\W\d_\\])")
_POWERS = re.compile("[⁰¹²³⁴-⁹]")


def with_primes_of_slopes(
    text: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool], told: dict[str, None], *, latex: bool
) -> TracedText:
    """Return an answer in which such names are slopes; notes tell these.

    ``moves`` says whether a name is a coordinate, ``taken`` whether the system has a name.
    """
    whole = normalize("NFD", text.text)
    if "=" not in whole or _DOTS.search(whole) is None or any(moves(_bare(m["name"])) for m in _PRIMED.finditer(whole)):
        return text
    found: dict[str, str] = {}
    for match in islice(_STATED.finditer(text.text), MOST):
        name, value = match["name"], match["value"]
        by = {_bare(x) for x in _letters(value) if moves(_bare(x))}
        rated = (
            _DOTS.search(normalize("NFD", value)) is not None or re.search(r"['’′]", value) or QUOTIENT.search(value)
        )
        if len({key(x) for x in by}) == 1 and not rated and not taken(_bare(name)) and not moves(_bare(name)):
            found.setdefault(name, next(x for x in _letters(value) if moves(_bare(x))))
    edits: list[Edit] = []
    for name, by in found.items():
        new = rf"\frac{{\partial {name}}}{{\partial {by}}}" if latex else f"∂{name}/∂{by}"
        given = rf"(?<![\w\\]){re.escape(name)}(?:\([^()\n]{{1,24}}\))?[ \t]*&?[ \t]*=(?![=>])"
        if re.search(given, text.text) is None and not is_in_chain(name, text.text):
            new = f"{name}_{{slope}}" if latex else f"{name}_slope"  # it has no value, so that this is a name as any
        form = rf"{_BEGINS}{re.escape(name)}[ ]?['’′](?!['’′″])"
        edits += [(*m.span(), apart_from(text.text, m, new)) for m in re.finditer(form, text.text)]
        told.setdefault(f"{_bare(name)}' was read as the slope of {_bare(name)} by {_bare(by)}.")
    return text.edited(apart(sorted(edits)))


def _letters(value: str) -> list[str]:
    """The names in a value."""
    return [_FUNCTION.sub("", x) for x in _LETTERS.findall(_POWERS.sub(" ", value))]


def _bare(name: str) -> str:
    return name.removeprefix("\\").removeprefix("var")
