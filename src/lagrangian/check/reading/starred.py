r"""Names with a star, m^*, m^{\ast}, m_r^*, m*: names of the answer's own: m* = M + m. T* is the co-energy; where an
answer says that T is what is left of it, T = ψ i − T*, T is a name of its own, too."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import islice, pairwise

from lagrangian.check.reading.name_patterns import MEANS
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

MOST = 200
"""The most stars that are looked at."""

_STAR = r"(?:\*(?!\*)|\\ast(?![A-Za-z])|\\star(?![A-Za-z])|[⋆★])"
_NAME = r"[^\W\d_⁰¹²³⁴-⁹][^\W_]{0,11}+(?:_[^\W_]{1,11}+)?"
_INDEX = r"(?:_[ ]?(?:\{(?P<low>\w{1,12})\}|\{\\(?:text|mathrm)\{(?P<word>\w{1,12})\}\}|(?P<short>\w)))?"
_RAISED = re.compile(
    rf"(?<![\w^])(?P<name>\\(?!dot|ddot|text|math)[A-Za-z]{{2,8}}+|{_NAME})[ ]?{_INDEX}[ ]?"
    rf"\^[ ]?(?:[{{(][ ]?{_STAR}[ ]?[)}}]|{_STAR})(?:_[ ]?(?:\{{(?P<index>\w{{1,12}})\}}|(?P<one>\w)))?"
)
_BESIDE = re.compile(rf"(?<![\w^*\\])(?P<name>{_NAME})(?:\\?\*|[⋆★])(?![\w(*])")
_JOINED = re.compile(rf"(?<![\w^*\\])(?P<name>{_NAME})(?:\\?\*(?!\*)|[⋆★])")
_BEFORE = r"(?:^(?:[ \t]*+[-–•*+][ ])?|[,;:(]|(?<=\w)|(?<=\.)[ ])[ \t]*+"
_STATED = re.compile(
    rf"{_BEFORE}(?P<name>{_NAME})(?:\\?\*|[⋆★])[ \t]*+(?:=(?![=>])|{MEANS}\b|:(?=[ \t][^\n=:]{{0,60}}[-+−]))"
    rf"|[^\s+−*/^·×=\\-][ \t]*+(?<!\w)(?P<own>{_NAME})(?:\\?\*|[⋆★])[ \t]*+:?=(?![=>])",
    re.MULTILINE,
)
"""A name with a star in front of what it stands for; in front of an equals sign, behind anything but an operator."""
_STATED_BEHIND = re.compile(
    rf"=(?P<defined>[ ]?:)?[ \t]*+(?P<name>{_NAME})(?:\\?\*|[⋆★])(?=[ \t]*+(?:[,;.)\]|]|$))", re.MULTILINE
)
"""One behind it: J + M a² =: J*; behind a plain equals sign, a star may also be a mark."""
_SUBTRACTED = re.compile(
    rf"(?<![\w*^/])(?P<of>{_NAME})[ \t]*(?:[-−][ \t]*(?P=of)(?:\\?\*|[⋆★])"
    r"(?=[ \t]*(?:[.,;:)]|$|[^\W\d_]{2}))"
    r"|=[ \t]*(?P=of)(?:\\?\*|[⋆★])[ \t]*\+)",
    re.MULTILINE,
)
"""A value from which deviations count: z = s - s*, s = s* + z."""
_ENERGY_STAR = rf"[ ]?\^?[ ]?(?:\{{[ ]?{_STAR}[ ]?\}}|{_STAR})"
_ENERGY = re.compile(
    rf"(?P<sign>[-−–+][ ]?)?(?<![\w\\])T(?P<star>{_ENERGY_STAR})?"
    r"(?P<index>_[ ]?(?:\{\\(?:text|mathrm)\{\w{1,20}\}\}|\{\w{1,20}\}|\w{1,20}))?"
    rf"(?P<behind>{_ENERGY_STAR})?(?![\w^*])"
)
"""T, T* or one of a part: T^{*}_{\\mathrm{coil}}, T*_coil, T_coil."""
_GOES_ON = re.compile(r"[ \t]*(?:\\\\)?\n?[ \t]*&?[ \t]*=")
_FACTOR = re.compile(r"(?!\w{1,12}['’′\u0307\u0308])[\w(]")
"""What stands directly behind the sign of a product, and is no rate, which may also stand behind a name with a star."""
_HEADED = re.compile(r"^(?P<words>[^=*\n]{1,60}\w)\*(?=:[ \t]*$)", re.MULTILINE)
"""A star at the end of a heading: factor of s*:"""


def with_starred_names(written: TracedText, known: Callable[[str], bool]) -> TracedText:
    """Return an answer in which m^* is m_star; so is m*, where the answer says what m* is and a gap stands behind the
    star, or m alone is no name. ``known`` says whether a name belongs to the system."""
    text = written.text
    if not any(c in text for c in ("*", "\\ast", "\\star", "⋆", "★")):
        return written
    latex = "\\" in text or "$" in text
    written = written.sub(_HEADED, lambda m: m["words"]).edited(_energies_beside(text, latex))
    text = written.text
    return written.edited(apart((*_raised(text, latex), *_beside(text, known, latex))))


def _energies_beside(text: str, latex: bool) -> Iterator[Edit]:
    """Names for the energies that are stored where they are no co-energies, T_coil = ψ i − T*_coil, T* = p v − T; in
    T_coil = ψ i − T*_coil = …, the two values are set equal."""
    found = [(m, re.sub(r"\W|_|mathrm|text", "", m["index"] or "")) for m in islice(_ENERGY.finditer(text), MOST)]
    starred = {m.start() for m, _ in found if m["star"] or m["behind"]}
    stored, ends = set[str](), dict[int, int]()
    for (a, of), (b, other) in pairwise(found):
        between = text[a.end() : b.start()]
        joined = b["sign"] is not None and (of or b["sign"][0] != "+") and between.count("=") == 1
        if of == other and joined and "\n" not in between and (a.start() in starred) != (b.start() in starred):
            stored.add(of)
            if between.strip(" &")[0] == "=" and _GOES_ON.match(text, b.end()) is not None and a.start() not in starred:
                ends[a.start()] = text.index("=", a.end()) + 1
    for m, of in found:
        if of in stored and m.start() not in starred:
            start = m.start() + len(m["sign"] or "")
            made = "" if m.start() in ends else _named(f"stored_{of or 'T'}", latex)
            yield start, ends.get(m.start(), m.end()), made


def _raised(text: str, latex: bool) -> Iterator[Edit]:
    for match in islice(_RAISED.finditer(text), MOST):
        base, index = (
            match["name"].lstrip("\\"),
            next((x for x in match.group("low", "word", "short", "index", "one") if x), None),
        )
        if base != "T":
            yield *match.span(), _named(f"{base if index is None else f'{base}_{index}'}_star", latex)


def _beside(text: str, known: Callable[[str], bool], latex: bool) -> Iterator[Edit]:
    said = {m["name"] or m["own"] for m in islice(_STATED.finditer(text), MOST)}
    said |= {m["name"] for m in islice(_STATED_BEHIND.finditer(text), MOST) if m["defined"] or _again(m["name"], text)}
    said |= {m["of"] for m in islice(_SUBTRACTED.finditer(text), MOST)}
    own = [m for m in _JOINED.finditer(text) if m["name"] in said and _FACTOR.match(text, m.end()) is None]
    products = sum(map(text.count, "*⋆★")) > len(own)
    for name in sorted(said):
        if name[0] == "T":
            continue
        alone = products and (known(name) or re.search(rf"(?<!\w){name}(?![\w*⋆★\\])", text) is not None)
        found = (m for m in (_BESIDE if alone else _JOINED).finditer(text) if m["name"] == name)
        yield from ((*m.span(), _named(f"{name}_star", latex)) for m in islice(found, MOST))


def _again(name: str, text: str) -> bool:
    """Whether a name stands with its star more than once."""
    return len([*islice((m for m in _JOINED.finditer(text) if m["name"] == name), 2)]) > 1


def _named(name: str, latex: bool) -> str:
    return rf"\mathrm{{{name}}}" if latex else name
