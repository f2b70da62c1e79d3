r"""Reads rates that are written with t as an index, where an answer writes accelerations so or says it.

w = phi_t, J w_t + b w = tau, m x_tt = F      w = phi', J w' + b w = tau, m x'' = F
\theta_{tt}, x_t                              \ddot{\theta}, \dot{x}
m x_{,tt} + c x_{,t} = F, x_1,tt              m x'' + c x' = F, x_1''           behind a comma, whatever else is said
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.traced_text import TracedText

_STEM = r"(?P<of>\\?[^\W\d_]\w{0,23}?)"
_PLAIN = re.compile(rf"(?<![\w\\]){_STEM}_(?P<by>t{{1,2}})(?![^\W²³]|['’′(])")
_BRACED = re.compile(r"(?<=\w)_\{[ ]?(?P<by>t{1,2})[ ]?\}")
_LATEX = re.compile(
    r"(?<![A-Za-z\\])(?P<of>\\?[A-Za-z]+?(?:_\d|_\{\d\})?)_(?:\{\s?(?P<by>t{1,2})\s?\}|(?P<short>t)(?![A-Za-z]))(?!['’′(])"
)
_SAID = re.compile(
    r"(?:\bdots?\b|\bderivatives?\b|\brates?\b|Ableitung|Punkt)[^.\n]{0,60}(?<!\w)_\{?t\b|(?<!\w)_\{?t\b[^.\n]{0,60}"
    r"\b(?:dots?|derivatives?|rates?)\b",
    re.IGNORECASE,
)
_EXPLAINED = re.compile(
    r"\b(?:index|subscript|suffix)[ ]t[ ]{0,3}(?:=|:|means|is|denotes|stands[ ]for|for|bedeutet|heißt|ist)[ ]{0,3}"
    r"(?:the[ ]|a[ ]|die[ ])?(?:d[ ]?/[ ]?dt\b|(?:time[ -]?|partial[ ])?(?:derivative|rate)s?\b|(?:Zeit)?Ableitung)",
    re.IGNORECASE,
)
"""Words that say it of every letter that is none of a constant."""


_COMMA = re.compile(
    r"(?<![A-Za-z\\])(?P<of>\\?[^\W\d_]{1,23}+(?:_(?!,)[^\W_]{1,8})?)_(?:"
    r"\{[ ]?(?P<index>[^\W_]{0,8}+)[ ]?,[ ]?(?P<by>t{1,2})[ ]?\}|,(?P<bare>t{1,2})(?![^\W²³]|['’′(]))"
)
"""t behind a comma in an index, perhaps behind another index: x_{,tt}, \\theta_{1,t}, x_,t."""
_ON_LINE = re.compile(r"(?<![\w\\.])(?P<of>[^\W\d_]\w{0,23}),(?P<by>t{1,2})(?![^\W²³]|['’′(])")
"""The same without a mark of an index: x,tt."""
_CALLS_WITH_T = re.compile(r"(?<!\w)(?:[dD]iff|Derivative|D|[dD]solve|subs)[ ]?[(\[]")
_LEGEND = re.compile(
    r"^[^=\n]{0,60}(?:(?<!\w)[(\[][ .·•…*]{0,5}[)\]]|[·•…](?!\w)|\bcomma\b|\bKomma\b)[ ]?_?\{?[ ]?,?[ ]?t{0,2}\}?(?!\w)"
    r"[^\n]{0,80}(?:derivative|rate|Ableitung|differentiat|d[ ]?(?:\([^()\n]{0,5}\)[ ]?)?/[ ]?dt)[^=\n]{0,60}$",
    re.MULTILINE | re.IGNORECASE,
)
"""A line that says what the comma means: ( ),t is the time derivative."""


def with_index_behind_comma(written: TracedText, moves: Callable[[str], bool]) -> TracedText:
    """Return an answer in which such indices of what changes with time are primes or dots, without the line that says
    what they mean."""
    text = written.text
    latex = "\\" in text or "$" in text
    found = [m for m in _COMMA.finditer(text) if moves(_name(_of(m)))]
    if not found and not latex and _CALLS_WITH_T.search(text) is None:
        found = [m for m in _ON_LINE.finditer(text) if moves(m["of"])]
        found = found if any(m["by"] == "tt" for m in found) else []
    if not found:
        return written
    said = [m for m in _LEGEND.finditer(text) if not any(m.start() <= x.start() < m.end() for x in found)]
    edits = [(*m.span(), _dotted(_of(m), len(m.groupdict().get("bare") or m["by"]), latex=latex)) for m in found]
    return written.edited([*edits, *((*m.span(), "") for m in said)])


def _of(match: re.Match[str]) -> str:
    """What is differentiated, with its other index."""
    index = match.groupdict().get("index")
    return f"{match['of']}_{index}" if index else match["of"]


def with_index_of_time(written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which such rates have primes or dots.

    ``moves`` says whether a name is a coordinate, ``taken`` whether it belongs to the system. Names of the answer's
    own have rates so where two t stand behind them, u_tt, or their value has a rate, and no line gives the rate a
    value: M_t = m_1 + m_2 is a mass; and where words explain the index, if the names stand without it, too.
    """
    latex = "\\" in written.text or "$" in written.text
    written = written if latex else written.sub(_BRACED, lambda m: f"_{m['by']} ")
    text, form = written.text, _LATEX if latex else _PLAIN
    found = [m for m in form.finditer(text) if not taken(_name(m.group()))]
    twice = any((m["by"] == "tt") and moves(_name(m["of"])) for m in found)
    explained = _EXPLAINED.search(text) is not None
    if not found or not (twice or explained or _SAID.search(text) is not None):
        return written
    names = {m["of"]: m for m in sorted(found, key=lambda m: m["by"] == "tt") if not taken(_name(m["of"]))}
    own = {of for of, m in names.items() if not _is_stated(text, of)}
    own = {of for of in own if names[of]["by"] == "tt" or _is_valued(text, of, form, moves)}
    own |= {x for x in names if explained and re.search(rf"(?<![\w\\]){re.escape(x)}(?![\w{{]|_)", text)}
    kept = [m for m in found if moves(_name(m["of"])) or m["of"] in own]
    return written.edited((*m.span(), _written(m, latex=latex)) for m in kept)


def _is_valued(text: str, name: str, form: re.Pattern[str], moves: Callable[[str], bool]) -> bool:
    """Whether a line gives a name a value in which a rate stands."""
    given = re.compile(rf"(?<![\w\\]){re.escape(name)}[ \t&]*=(?!=)(?P<value>[^=\n,;]{{1,400}})")
    rates = (m for x in given.finditer(text) for m in form.finditer(x["value"]))
    return any(moves(_name(m["of"])) for m in rates)


def _is_stated(text: str, name: str) -> bool:
    """Whether a line gives a name with such an index a value."""
    alone = rf"(?:^|[,;:$(\[]|\b(?:with|where|and))[ \t]*{re.escape(name)}_\{{?t{{1,2}}\}}?[ \t&]*=(?!=)"
    return re.search(alone, text, re.MULTILINE) is not None


def _name(written: str) -> str:
    return re.sub(r"\\var(?=[a-z])|[\\{}]", "", written)


def _written(match: re.Match[str], *, latex: bool) -> str:
    return _dotted(match["of"], len(match["by"] or "t"), latex=latex)


def _dotted(name: str, order: int, *, latex: bool) -> str:
    """A name with primes, or with dots in LaTeX."""
    if not latex:
        return name + "'" * order
    letter, _, index = name.partition("_")
    return f"\\{'d' * order}ot{{{letter}}}" + (f"_{index}" if index else "")
