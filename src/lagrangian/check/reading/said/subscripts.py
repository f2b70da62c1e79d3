r"""Reads rates that are written with t as an index, where an answer writes accelerations so or says it, and derivatives
of energies that have what they are taken by as an index.

w = phi_t, J w_t + b w = tau, m x_tt = F      w = phi', J w' + b w = tau, m x'' = F
\theta_{tt}, x_t                              \ddot{\theta}, \dot{x}
m x_{,tt} + c x_{,t} = F, x_1,tt              m x'' + c x' = F, x_1''           behind a comma, whatever else is said
L_xd = m xd, d/dt L_ẋ - L_x = 0               ∂L/∂xd = m xd, d/dt (∂L/∂ẋ) - (∂L/∂x) = 0
T_{\dot x}, V_\varphi                         \frac{\partial T}{\partial \dot x}, \frac{\partial V}{\partial \varphi}
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.name_patterns import DOTS, NAME
from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.traced_text import TracedText
from lagrangian.read.letters import undotted

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

_OF_ENERGY = re.compile(rf"(?<![\w\\])(?P<of>[LTVUDℒ])_(?P<by>(?:(?!_){NAME})(?>['’′]?))(?![\w'’′(])")
_OF_ENERGY_IN_LATEX = re.compile(
    r"(?<![A-Za-z\\])(?P<of>[LTVUD]|\\mathcal[ ]?\{?L\}?)[ ]?_[ ]?"
    r"(?:\{[ ]?(?P<by>(?:\\dot(?![A-Za-z])[ ]?)?\{?[ ]?\\?[A-Za-z]{1,12}(?:_\w)?[ ]?\}?)[ ]?\}"
    r"|(?P<short>\\[A-Za-z]{1,12}|[a-z])(?![\w{]))(?!['’′])"
)
_BY_TIME_BEFORE = re.compile(r"(?:d[ ]?/[ ]?d[ ]?t|\\[dt]?frac\{[ ]?d[ ]?\}\{[ ]?dt[ ]?\})[ ]?[({\[]?[ ]?\Z")


def with_energies_below(written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which L_x and L_ẋ are derivatives of L, where it has one by a rate.

    L_xd and L_x' may be the rate of an angular momentum L_x: they are derivatives where they are differentiated by time
    or a line says what L is as a whole, L = T - V; T = T_x + T_y are parts. ``moves`` says whether a name is a
    coordinate, ``taken`` whether it belongs to the system.
    """
    text = written.text
    latex = "\\" in text or "$" in text
    form = _OF_ENERGY_IN_LATEX if latex else _OF_ENERGY
    found = [(m, by) for m in form.finditer(text) if (by := _by(m, moves)) is not None]
    found = [(m, by) for m, by in found if not taken(_name(m["of"])) and not taken(_name(m.group()))]
    letters = {m["of"] for m, _ in found if not _is_part(text, m["of"])}
    rated = {m["of"] for m, order in found if order == 1 and m["of"] in letters and _is_slope(text, m, latex=latex)}
    if not rated:
        return written
    letters = {x for x in letters if x in rated or (x in "VU" and "T" in rated)}
    return written.edited((*m.span(), _slope(m, latex=latex)) for m, _ in found if m["of"] in letters)


def _by(match: re.Match[str], moves: Callable[[str], bool]) -> int | None:
    """By which order of a coordinate an index differentiates, 0 or 1; None for another index."""
    by = match["by"] or match["short"]
    if "\\dot" in by:
        return 1 if moves(_name(by.replace("\\dot", "")).strip()) else None
    bare, dots = undotted(_name(by.rstrip("'’′")).strip())
    dots += len(by) - len(by.rstrip("'’′"))
    if moves(bare):
        return dots if dots < 2 else None
    return 1 if not dots and any(order == 1 and moves(stem) for order, stem in spelled_rates(bare)) else None


def _is_part(text: str, of: str) -> bool:
    """Whether a line gives an energy as the sum of parts with such indices: T = T_x + T_y."""
    return re.search(rf"(?<![\w\\]){re.escape(of)}[ \t&]*=(?!=)[^\n]{{0,80}}?{re.escape(of)}[ ]?_", text) is not None


def _is_slope(text: str, match: re.Match[str], *, latex: bool) -> bool:
    """Whether an energy with a rate as its index can be no rate of the energy with that index."""
    if latex or re.search(DOTS, match["by"]) or undotted(match["by"])[1]:
        return True
    if _BY_TIME_BEFORE.search(text[max(0, match.start() - 24) : match.start()]):
        return True
    whole = rf"(?<![\w\\_]){match['of']}\*?(?:[ ]?\([^()\n]{{1,60}}\))?[ \t]*=(?!=)"
    return re.search(whole, text) is not None


def _slope(match: re.Match[str], *, latex: bool) -> str:
    """The derivative of an energy by what stands as its index."""
    of, by = match["of"], match["by"] or match["short"]
    if latex:
        return rf"\frac{{\partial {of}}}{{\partial {by}}}"
    alone = re.match(r"[ \t]*=(?!=)", match.string[match.end() :][:20])
    return f"∂{of}/∂{by}" if alone else f"(∂{of}/∂{by})"


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
