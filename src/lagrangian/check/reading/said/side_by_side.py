"""Parts definitions with only a blank between them: C=cos(phi) S=sin(phi) is C = cos(phi); S = sin(phi).

As a chain, the second name would be a factor that nothing explains.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText

MOST = 40
"""The most lines that are looked at."""
MOST_LETTERS = 3
"""The most letters of a product without signs in a value."""

_NAME = r"(?:[^\W\d⁰¹²³⁴-⁹₀-₉¼½¾⅐-⅞][^\W⁰¹²³⁴-⁹¼½¾⅐-⅞]{0,15}+)(?![⁰¹²³⁴-⁹])"
_ROW = re.compile(
    rf"(?:^|(?<=[,;:.])[ \t]|(?<!\w)(?:with|where|let|mit|avec|wobei)[ \t])[ \t]*+(?P<row>{_NAME}[ \t]*+=(?![=>])"
    r"(?=[^\n,;=]{1,200}=)[^\n,;]{2,400})",
    re.MULTILINE,
)
"""A definition and at least one more equals sign, without a mark between them."""
_SECOND = re.compile(rf"(?<=[\w)\]²³'’′])(?P<gap>[ \t]{{1,2}})(?P<new>{_NAME})[ \t]*=(?![=>])")
_BESIDE = re.compile(
    rf"^(?P<before>[^=\n]{{3,200}}?[\w)\]²³'’′\u0307\u0308])(?P<gap>[ \t]{{3,150}}+)"
    rf"(?=(?P<name>{_NAME})['’′]{{0,2}}(?:²|\^2)?[ \t]*=(?![=>]))",
    re.MULTILINE,
)
"""A term without an equals sign, and a definition far behind it: - m g cos psi      psi = psi0 - x/r."""
_MATHEMATICS = re.compile(r"[+*/^²³·(]|(?:^|[ \t])[-−][ \t]?\w|\w['’′]|[\u0307\u0308]")
_SAID = r"[ \t]*(?::(?!=)|…|\.{2}|\b(?:is|are|being|denotes|means|stands|for|ist|bezeichnet|bedeutet|steht|est)\b)"
"""What stands behind a name of which words say what it is."""
_WORD = re.compile(r"[^\W\d_]\w*")
_POWERS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹¼½¾⅓", " " * 14)


def with_definitions_apart(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text in which a semicolon stands between such definitions, and between a term and one.

    Each name but the first of a row is none of the system, which ``taken`` tells, has no other value or meaning, and
    is used elsewhere; what stands in front of it is a value in names that are known.
    """
    text = written.text
    edits: list[Edit] = []
    for match in islice(_ROW.finditer(text), MOST):
        row, start = match["row"], match.start("row")
        found = list(_SECOND.finditer(row))
        if len(found) + 1 != row.count("="):
            continue
        ends = [x.start() for x in found]
        values = [row[row.find("=", a) + 1 : b] for a, b in zip([0, *ends[:-1]], ends, strict=True)]
        own = {row.partition("=")[0].strip(), *(x["new"] for x in found)}
        if (
            len(own) > len(found)
            and all(_is_own(x["new"], text, taken) for x in found)
            and all(_is_value(x, own, taken) for x in values)
        ):
            edits += [(start + x.start("gap"), start + x.end("gap"), "; ") for x in found]
    terms = (m for m in islice(_BESIDE.finditer(text), MOST) if not taken(m["name"]) and _is_term(m["before"], taken))
    edits += [(*m.span("gap"), "; ") for m in terms]
    return written.edited(edits)


def _is_term(before: str, taken: Callable[[str], bool]) -> bool:
    """Whether a part of a line is a formula, perhaps behind a label, and no words."""
    last = before.rpartition(":")[2] if ":" in before else before
    names = [x for x in _WORD.findall(last.translate(_POWERS)) if function_of(x) is None]
    known = sum(taken(x) or (len(x) <= MOST_LETTERS and all(map(taken, x))) for x in names)
    return known > 1 and (_MATHEMATICS.search(last) is not None or known == len(names))


def _is_own(name: str, text: str, taken: Callable[[str], bool]) -> bool:
    """Whether a name is one of the answer's own, with one value, that is used."""
    whole = rf"(?<!\w){re.escape(name)}(?!\w)"
    stated = re.search(rf"(?:^|[,;:.])[ \t]*{whole}[ \t]*:?=(?!=)", text, re.MULTILINE)
    said = re.search(rf"{whole}{_SAID}", text)
    own = not taken(name) and function_of(name) is None
    return own and stated is None and said is None and len(re.findall(whole, text)) > 1


def _is_value(value: str, own: set[str], taken: Callable[[str], bool]) -> bool:
    """Whether a value has names of the system, or those defined beside it, and no words."""
    names = [x for x in _WORD.findall(value.translate(_POWERS)) if function_of(x) is None]
    known = (taken(x) or x in own or (len(x) <= MOST_LETTERS and all(map(taken, x))) for x in names)
    return bool(names) and all(known)
