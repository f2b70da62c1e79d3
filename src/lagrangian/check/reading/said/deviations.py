"""Reads deviations from a position at rest: φ = φ0 + φ1 or p = φ − φ0 with a constant φ0, which is not φ, and
τ = τ0 + τ1; and from a uniform motion: φ′ = Ω + w, φ = Ω t + δ.

The deviation of an input is the input less its constant: τ = τ0 + τ1 is τ1 = τ − τ0.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Set
from itertools import islice

from lagrangian.check.reading.shortened import moving_names
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.read.letters import key, undotted

MOST = 20
"""The most such sums."""

_INDEX = r"_?\{?\w{1,6}\}?"
_LETTER = r"\\?[^\W\d_]\w{0,11}"
_BEGINS = r"(?<![\w\\'’′^*/+−-])"
_WORDS = r"(?:and|und|with|mit|be|are|is|from|as|for|where|denotes?)\b|\([^\W\d_]{1,16}[ ][a-z]{2}"
_ENDS = rf"(?![\w'’′(*/^·{{])(?=[ \t]*(?:[.,;:)$&]|\\|\n|\Z|{_WORDS}))"
_MORE = (
    rf"(?:(?:\\?[Δδ]|\\?[dD]elta[ ]?_?)?(?!\\(?:wide)?(?:tilde|hat|bar|mathrm)(?![A-Za-z])){_LETTER}"
    r"|\\mathrm\{\w{1,24}\}|\\(?:wide)?(?:tilde|hat|bar)(?![A-Za-z])[ ]?(?:\{[ ]?\\?\w{1,12}[ ]?\}|\\?\w{1,12}))"
)
_SUM = re.compile(
    rf"{_BEGINS}(?P<of>{_LETTER}?)[ \t]*&?=[ \t]*(?P<rest>(?P=of){_INDEX})[ \t]*\+[ \t]*"
    rf"(?P<more>{_MORE}){_ENDS}"
)
"""A quantity as the sum of its value at rest, of the same letter, and its deviation."""
_OF_INPUT = re.compile(
    rf"{_BEGINS}(?P<of>{_LETTER})[ \t]*+&?=[ \t]*+(?P<rest>[\w\\{{}}() *·/^,]{{1,80}}?)[ \t]*+\+[ \t]*+"
    rf"(?P<more>{_MORE}){_ENDS}"
)
"""An input as the sum of what it is at rest and its deviation."""
_NAMES = re.compile(r"\\?[^\W\d_]\w{0,15}")
_OF = r"(?:\\(?!d?dot|frac|left|right)[A-Za-z]{2,12}|[A-Za-z])(?![A-Za-z_])"
_DELTA_STATED = re.compile(
    rf"\\Delta[ ]?(?P<name>{_OF})[ \t]*&?:?="
    rf"|(?<![\w\\])(?P<of>{_OF})[ \t]*&?=[^=$\n&]{{1,80}}?\+[ \t]*\\Delta[ ]?(?P=of)(?![A-Za-z_])"
)
_DELTA = re.compile(
    rf"\\Delta[ ]?(?:(?P<dots>\\d?dot)(?![A-Za-z])[ ]?(?:\{{[ ]?(?P<braced>{_OF})[ ]?\}}|(?P<dotted>{_OF}))"
    rf"|(?P<name>{_OF}))"
)
_DIFFERENCE = re.compile(
    rf"{_BEGINS}(?P<more>{_LETTER})[ \t]*&?:?=[ \t]*(?P<of>{_LETTER}?)[ \t]*[-−][ \t]*(?P<rest>(?P=of){_INDEX}){_ENDS}"
)
"""A deviation as the quantity less its value at rest."""

_OF_TIME = r"(?:[ ]?\([ ]?t[ ]?\))?"
_RATE = r"\\dot(?![A-Za-z])[ ]?(?:\{[ ]?\\?\w{1,12}[ ]?\}|\\?\w{1,12})|[^\W\d_][\w\u0307]{0,11}['’′]?"
_PART = r"\\?[^\W\d_]\w{0,11}(?:_\{\w{1,6}\})?"
_UNIFORM = re.compile(
    rf"{_BEGINS}(?P<of>{_RATE}|{_LETTER}){_OF_TIME}[ \t]*&?:?=[ \t]*(?P<first>{_PART})"
    rf"(?P<time>(?:\\[,; ]|[ *·])?[ ]?t(?!\w))?{_OF_TIME}[ \t]*\+[ \t]*(?P<second>{_PART}){_OF_TIME}{_ENDS}"
)
"""A rate as the sum of a constant and a name that has rates itself, or a coordinate as that of Ω t and a name."""


def with_deviations(
    written: TracedText, moves: Callable[[str], bool], drives: Callable[[str], bool], taken: Callable[[str], bool]
) -> TracedText:
    """Return an answer in which the deviations of inputs, and those with letters of their own, are stated by
    themselves; ``moves`` says what a coordinate is, ``drives`` what an input is, and ``taken`` what the system has."""
    written = _with_delta_names(written, lambda x: moves(x) or drives(x), taken)
    edits: list[Edit] = []
    for match in islice(_SUM.finditer(written.text), MOST):
        of, own = _bare(match["of"]), not _bare(match["more"]).startswith(_bare(match["of"]))
        if match["more"] != match["of"] and (drives(of) or (moves(of) and own)):
            edits.append((*match.span(), f"{match['more']} = {match['of']} - {match['rest']}"))
    for match in islice(_OF_INPUT.finditer(written.text), MOST):
        fixed = not any(moves(x) or drives(x) for x in map(_bare, _NAMES.findall(match["rest"])))
        if fixed and drives(_bare(match["of"])) and not taken(_bare(match["more"])):
            rest = match["rest"] if _NAMES.fullmatch(match["rest"]) else f"({match['rest']})"
            edits.append((*match.span(), f"{match['more']} = {match['of']} - {rest}"))
    uniform = list(islice(_UNIFORM.finditer(written.text), MOST))
    moving = moving_names(written.text) if uniform else frozenset[str]()
    for match in uniform:
        if (said := _of_uniform_motion(match, moves, moving)) is not None:
            edits.append((*match.span(), said))
    return written.edited(apart(sorted(edits)))


def _of_uniform_motion(match: re.Match[str], moves: Callable[[str], bool], moving: Set[str]) -> str | None:
    """The deviation from a uniform motion by itself: w = φ′ − Ω, where Ω has no rate and w has; δ = φ − Ω t."""
    bare = _bare(match["of"].removeprefix("\\dot").strip(" {}"))
    of, order = undotted(bare.rstrip("'’′"))
    order += match["of"].startswith("\\dot") + len(bare) - len(bare.rstrip("'’′"))
    first, second = (match[x] for x in ("first", "second"))
    rated = [key(_bare(x)) in moving for x in (first, second)]
    if match["time"] is None and rated == [True, False]:
        first, second = second, first
    sure = match["time"] is not None or any(rated) != all(rated)
    if not sure or order != (match["time"] is None) or not moves(of) or any(map(moves, map(_bare, (first, second)))):
        return None
    return f"{second} = {match['of']} - {first}{' t' if match['time'] else ''}"


def _with_delta_names(written: TracedText, counts: Callable[[str], bool], taken: Callable[[str], bool]) -> TracedText:
    r"""Return an answer in LaTeX in which \Delta u is one name, also \Delta\dot u, where it is stated as one."""
    stated = (m["name"] or m["of"] for m in islice(_DELTA_STATED.finditer(written.text), MOST))
    named = {x for x in stated if counts(_bare(x))}
    if not named or taken("Delta"):
        return written

    def one(match: re.Match[str]) -> str:
        of = match["name"] or match["braced"] or match["dotted"]
        name = rf"\mathrm{{Delta_{_bare(of)}}}"
        return match.group() if of not in named else rf"{match['dots']}{{{name}}}" if match["dots"] else name

    return written.sub(_DELTA, one)


def constants_of_deviations(text: str) -> Iterator[str]:
    """The names of the constants in such sums and differences: φ0 of φ = φ0 + φ1."""
    for match in (*islice(_SUM.finditer(text), MOST), *islice(_DIFFERENCE.finditer(text), MOST)):
        if key(_bare(match["rest"])) != key(_bare(match["of"])):
            yield _bare(match["rest"])


def _bare(name: str) -> str:
    bare = re.sub(r"[\\{}]", "", name)
    return bare.removeprefix("var") if name.startswith("\\") else bare
