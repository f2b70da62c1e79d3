"""Reads what lines of a legend and sentences in plain text say that a name is, with words in front of the formula.

I(phi) ... moment of inertia about the pin, J + m*l^2      I(phi) = J + m*l^2
K ... static moment, (m*l/2 + M*l)*g                       K = (m*l/2 + M*l)*g
Q: everything that turns, seen from O, = J + m l²          Q = J + m l²
J_t about the pin: J + m*l^2                           J_t = J + m*l^2
z = height of the plate (= l sin φ). Then …                z = l sin φ; Then …
Here K is k*(r*phi - s), and A stands for b*s'             K = k*(r*phi - s); A = b*s'
The spring pulls with k*(r*phi - s), which I call K.       K = k*(r*phi - s)
d/dt(a θ') = a θ'', which we call Z                        d/dt(a θ') = a θ'' = Z

A letter that would be read as a name of the system in the other case, K as k, is a name of its own there.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import islice

from lagrangian.check.reading.name_patterns import CALLED_AFTER, CALLED_SO, MEANS
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.prose.words_or_mathematics import CHANGING
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.check.reading.unit_checks import UNITS

MOST = 40
"""The most such lines and sentences."""
LONGEST = 400
"""The most characters of a formula with a name behind it."""
MOST_LETTERS = 3
"""The most letters of a product without signs in a formula."""

_NAME = r"[^\W\d]\w{0,15}+"
_LEGEND = re.compile(
    rf"^[ \t]*+(?:[-*•–][ \t]++)?(?P<new>{_NAME})(?P<of>\([ ]?{_NAME}[ ]?\))?[ \t]*+"
    r"(?:\.{2,9}|…|[:=–—]|-{1,3}(?=[ \t])|\b(?:is|ist|means|denotes)\b)[ \t]*+"
    r"(?P<words>[^\W\d_]{2,24}(?:[ ,()'’/-]{1,3}[^\W\d_]{1,24}){0,14})\)?"
    r"[ \t]*+(?:[,:–][ \t]*+(?P<equals>=)|[,:=–])[ \t]*+(?P<value>[^\n=;:…]{2,200}?)[ \t]*+[.;,]?[ \t]*+$",
    re.MULTILINE,
)
"""A line with a name, what it is in words, and its formula."""
_ABOUT = re.compile(
    r"(?:^[ \t]*+(?:[-*•–][ \t]++)?|(?<=[.;][ ]))"
    r"(?P<new>(?![TVUEL])(?:[^\W\d_]{1,8}[_\d₀-₉]\w{0,12}+|[B-HJ-ZΑ-Ωα-ω]))(?:,?[ \t]++)"
    r"(?P<words>\(?[^\W\d_]{2,24}(?:[ ,()'’/-]{1,3}\w{1,24}){0,9})\)?[ \t]*+(?::=?|=|\bist?\b)[ \t]++"
    r"(?P<value>[^\n=;:…]{2,200}?)(?:[ \t]*+[.;,]?[ \t]*+$|(?=[ \t]{2,9}+\())",
    re.MULTILINE,
)
"""The same without a mark behind the name, which is no word: one with an index, or a single letter."""
_BRACKETED = re.compile(
    rf"(?:^[ \t]*+(?:[-*•–][ \t]++)?|(?<=[.,;:][ ])|(?<!\w)(?:let|with|where|here|mit|wobei|sei)[ \t]++)"
    rf"(?P<new>{_NAME})[ \t]*+"
    r"(?:\.{2,9}|…|[:=–—]|-{1,3}(?=[ \t])|\b(?:is|be|ist|means|denotes)\b)[ \t]*+"
    r"(?P<words>[^\W\d_]{2,24}(?:[ ,'’/-]{1,3}[^\W\d_]{1,24}){0,14})[ \t]*+"
    r"\([ \t]*+=(?P<value>(?:[^()\n=;:…]|\([^()\n=]{0,80}\)){2,200})\)[ \t]*+(?:[.;,](?=\s|$)|$)",
    re.MULTILINE | re.IGNORECASE,
)
"""A name, what it is in words, and its formula in brackets with an equals sign."""
_SAID = re.compile(
    r"(?:(?<!\w)(?P<open>\()[ \t]?(?:(?:where|with|here|mit|wobei)[ \t])?|^[ \t]*+|(?<=[.,;:][ ])"
    rf"|(?<!\w)(?:here|hier|where|with|and|mit|wobei|und)[ \t]++)(?P<new>{_NAME})(?:[ \t]++|(?=,[ \t])){MEANS}[ \t]++"
    r"(?P<value>[^\n;:=]{0,30}?[-−+*/^·²³(][^\n;:=]{0,200}?)"
    r"(?P<end>[ \t]*(?(open)\)(?=[ \t]*(?:[.,;]|$))"
    rf"|(?:;|\.(?=\s|$)|$|(?=,?[ \t]+(?:and|und|where|with|wobei|mit)[ \t]+{_NAME}[ \t]))))",
    re.MULTILINE | re.IGNORECASE,
)
"""A name and its formula in a sentence, perhaps in brackets."""
_NAMED_BEHIND = re.compile(
    rf"(?P<said>(?<![ \t])[ \t]{{0,40}}+,?+[ \t]{{0,40}}+(?<=[ \t]){CALLED_SO}(?P<new>{_NAME}){CALLED_AFTER})"
    r"(?=[ \t]*(?:[.,;](?=\s|$)|$))",
    re.MULTILINE | re.IGNORECASE,
)
"""A name behind its formula, with words that say that this is called so."""
_LAST_WORD = re.compile(r"(?<!\w)[^\W\d_]{2,24}[ \t]+(?=[^\w]|\w{1,3}(?!\w)|\w{1,12}[ \t]*[*(^'’′])")
_CLAUSE = re.compile(r"[;:=]|[.](?=\s)|\n")
_WORD = re.compile(r"[^\W\d_²³⁴]\w*")
_OPERATOR = re.compile(r"[-−+*/^·×²³(]")
_SUM = re.compile(r"[-−+(]")
_NO_LETTERS = dict.fromkeys(map(ord, "⁰¹²³⁴⁵⁶⁷⁸⁹¼½¾⅐⅑⅒⅓⅔⅕⅖⅗⅘⅙⅚⅛⅜⅝⅞"), " ")
"""Powers and fractions, which are no letters of names."""
_FUNCTION = re.compile(r"(?:arc|a)?(?:sin|cos|tan)(?=[^\W\d_])")


def with_explained_names(written: TracedText, taken: Callable[[str], bool], exact: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text in which such lines and sentences are statements.

    ``taken`` says whether a name may be one of the system, ``exact`` whether the system spells one so.
    """
    text = written.text
    edits: list[Edit] = []
    for match in (m for form in (_LEGEND, _BRACKETED, _ABOUT) for m in islice(form.finditer(text), MOST)):
        words = re.findall(r"[^\W\d_]+", match["words"])
        spoken = not taken(words[0]) and any(len(x) > MOST_LETTERS and not taken(x) for x in words)
        changed = any(x.lower() in CHANGING for x in words) or _is_rate(match["words"], match["new"])
        equals = match.re is _BRACKETED or bool(match.groupdict().get("equals"))
        said = is_formula(match["value"], taken) or (equals and _is_product(match["value"], taken))
        if spoken and not changed and said and _is_new(match, text, exact):
            of = match.groupdict().get("of") or ""
            edits.append((match.start("new"), match.start("value"), f"{match['new']}{of} = "))
            edits += [(match.end("value"), match.end(), ";")] if match.re is _BRACKETED else []
    for match in islice(_SAID.finditer(text), MOST):
        own = match["new"] not in _names(match["value"]) and _is_new(match, text, exact)
        if own and is_formula(match["value"], taken):
            edits.append((match.start(), match.start("value"), f"; {match['new']} = "))
            edits.append((*match.span("end"), ";"))
    edits += _named_behind(text, taken)
    return written.edited(apart(edits))


def _named_behind(text: str, taken: Callable[[str], bool]) -> Iterator[Edit]:
    """The statements of names behind their formulas: the end of a chain, or a statement behind words."""
    for match in islice(_NAMED_BEHIND.finditer(text), MOST):
        new = match["new"]
        used = len(re.findall(rf"(?<!\w){re.escape(new)}(?!\w)", text)) > 1
        if taken(new) or not used or function_of(new) is not None or re.search(rf"(?<!\w){new}[ \t]*:?=(?!=)", text):
            continue
        start = text.rfind("\n", 0, match.start()) + 1
        clause = text[max(start, match.start() - LONGEST) : match.start()]
        cut = max((m.end() for m in _CLAUSE.finditer(clause)), default=0)
        if clause[max(0, cut - 1) : cut] == "=":
            yield (*match.span("said"), f" = {new}")
            continue
        words = [m for m in _LAST_WORD.finditer(clause, cut) if not taken(m.group().strip())]
        value = clause[words[-1].end() if words else cut :].strip(" \t,")
        if is_formula(value, taken):
            at = match.start() - len(clause) + clause.rindex(value)
            yield at, match.end("said"), f"; {new} = {value}"


def _is_rate(words: str, name: str) -> bool:
    """Whether words end in the rate of a name, of which the formula is the value: w … speed, so dw/dt = phi''."""
    return (
        re.search(rf"(?<!\w)(?:d[ ]?{re.escape(name)}[ ]?/[ ]?d[ ]?t|{re.escape(name)}_?d{{1,2}}(?:ot)?)\Z", words)
        is not None
    )


def _is_new(match: re.Match[str], text: str, exact: Callable[[str], bool]) -> bool:
    """Whether a name is none of the system and is used elsewhere."""
    used = re.findall(rf"(?<!\w){re.escape(match['new'])}(?!\w)", text)
    return not exact(match["new"]) and function_of(match["new"]) is None and len(used) > 1


def _names(value: str) -> list[str]:
    """The names in a formula, without functions."""
    bare = value.translate(_NO_LETTERS)
    listed = (_FUNCTION.sub("", x) for x in _WORD.findall(bare))
    return [x for x in listed if function_of(x) is None]


def _is_product(value: str, taken: Callable[[str], bool]) -> bool:
    """Whether a value consists of several names of the system, without a sign between them: ½ m g l."""
    names = _names(value)
    return len(names) > 1 and all(map(taken, names)) and not UNITS.issuperset(names)


def is_formula(value: str, taken: Callable[[str], bool]) -> bool:
    """Whether this is a formula in names of the system, and no unit: m/s."""
    names = _names(value)
    if not names or _OPERATOR.search(value) is None or (UNITS.issuperset(names) and _SUM.search(value) is None):
        return False
    return all(taken(x) or (len(x) <= MOST_LETTERS and all(map(taken, x))) for x in names)
