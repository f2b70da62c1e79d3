"""L as a length of the answer's own, or of the system, and dL/dθ as its slope, where L is no Lagrangian.

L = b √(2 + 2 sin θ),  dL/dθ = b² cos θ/L      L_len = b √(2 + 2 sin θ),  ∂L_len/∂θ = b² cos θ/L_len
dL/dθ = b cos(π/4 + θ/2)                       L_slope = b cos(π/4 + θ/2)

A Lagrangian and its slopes hold a mass, a stiffness or a weight in every term; a length and its slopes hold none.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import islice
from unicodedata import normalize

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded
from lagrangian.check.reading.arguments import apart_from, differentiated
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.model import Body, Damper, Gravity, Spring
from lagrangian.model.names import time

_D = r"(?:\\mathrm[ ]?\{?[ ]?d\}?|\\partial|d|∂)[ ]?"
_TWO = r"(?:²|\^[ ]?\{?[ ]?2[ ]?\}?)[ ]?"
_STATED = re.compile(
    r"(?<![\w\\^{/∂*·+−-])(?<![*·+−-][ ])L[ \t]*+(?P<square>²|\^[ ]?\{?2\}?)?[ \t]*+&?[ \t]*+=(?![=>])[ \t]*+&?"
    r"(?P<value>[^,;\n&$=]{1,200})"
)
"""L or L² that is given a value."""
_OTHER = re.compile(
    r"ℒ|\\(?:mathcal|mathscr|cal)(?![A-Za-z])|[Ll]agrangian|[Ll]agrange[- ]?[Ff]un[ck]tion"
    r"|\b(?:diff|[Dd]erivative|jacobian|symbols)[ ]?\(|\b(?:syms|import)\b"
)
"""The Lagrangian by its usual names, and what programs have, which are carried out."""
_OF_L = re.compile(rf"(?<![^\W\d])(?<!\\){_D}(?:{_TWO})?L(?!\w)")
"""A differential of L."""
_BY_TIME = re.compile(rf"[ ]?\}}?[ ]?[/{{][ ]?{_D}t(?!\w)")
_VALUE = re.compile(r"[ \t]*[)}]?[ \t]*&?[ \t]*=(?![=>])(?P<value>[^,;\n&$=]{1,200})")
"""What is behind the equals sign of a slope."""
_END = re.compile(
    r"[ \t]+[^\W\d_]{4,}\b|[ \t]and\b|\\q?quad|\\\\|\\text|\\Rightarrow|\\\]|\.(?:\s|\Z)|[ \t]{3}|[⇒→]|[-=]>"
)
"""Where a value ends."""
_WORD = re.compile(r"\\[A-Za-z]+(?:_\{\w{1,20}\}|_\w)?|[^\W\d_](?:_\{\w{1,20}\}|_\w|[^\W_²³])*")
_FUNCTION = re.compile(r"\\?(?:sin|cos|tan|sqrt)(?=[^\W\d_\\])")
_COMMANDS = frozenset(["frac", "dfrac", "tfrac", "left", "right", "cdot", "bigl", "bigr", "Bigl", "Bigr", "pi", "π"])
_RATE = re.compile("[\u0307\u0308'’′]|\\\\d?dot(?![A-Za-z])")
_CALLED = re.compile(r"[\w}][ \t]*+&?[ \t]*+=[ \t]*+&?[ \t]*\Z")
"""What stands before a slope that has a name."""
LONGEST = 60
"""How far from a slope or a letter is looked."""
_ALONE = re.compile(r"L(?![\d_'’′(])")
MOST = 40
"""The most places where L is given a value or differentiated."""


def with_own_length(text: TracedText, names: Names, taken: Callable[[str], bool], *, latex: bool) -> TracedText:
    """Return an answer in which such an L, or its slope alone, has a name of its own; a note tells it.

    ``taken`` says whether the system has a name. Where it defines an L by what moves, L is that.
    """
    written = text.text
    defined = next((d for d in names.model.definitions if d.name == "L" and d.moving), None)
    if (defined is None and taken("L")) or _OTHER.search(written) or any(map(taken, ("Llen", "Lslope", "Lslopes"))):
        return text
    coordinates = {c.symbol for c in names.model.coordinates}
    by = [x for x in dict.fromkeys(_WORD.findall(written)) if _meant(x, names) in coordinates]
    slopes = {(m.span(), x): m for x in by for form in differentiated("L", x) for m in _found(form, written)}
    twice = [m for x in by for m in _found(_second(x), written)]
    stated = list(islice(_STATED.finditer(written), MOST))
    if not _is_length(written, names, stated, [*slopes.values(), *twice]):
        return text
    named = any(_CALLED.search(written, max(0, m.start() - LONGEST), m.start()) for m in slopes.values())
    if not (stated or defined or named or len(slopes) > 1):
        return text  # of an energy, perhaps, that lost its mass
    length, slope, second = (f"L_{{{x}}}" if latex else f"L_{x}" for x in ("len", "slope", "slopes"))
    edits: list[Edit] = [(*m.span(), apart_from(written, m, second)) for m in twice]
    for ((start, end), of), match in slopes.items():
        partial = rf"\frac{{\partial {length}}}{{\partial {of}}}" if latex else f"∂{length}/∂{of}"
        edits.append((start, end, apart_from(written, match, partial if stated or defined else slope)))
    edits = apart(edits)
    if defined is None:
        alone = [m.start() for m in re.finditer(_ALONE, written) if _is_factor(m, written, taken)]
        edits += [(at, at + 1, length) for at in alone if not any(a <= at < b for a, b, _ in edits)]
    else:
        names.own["Llen"] = ("L_len", defined.symbol)
    if edits:
        names.notes.setdefault("L was read as a length, not as the Lagrangian.")
    return text.edited(edits)


def _is_length(written: str, names: Names, stated: list[re.Match[str]], slopes: list[re.Match[str]]) -> bool:
    """Whether every value of L is one of lengths, and every one of its slopes, of which there is at least one value."""
    spans = [m.span() for m in slopes]
    for match in _OF_L.finditer(written):
        if not any(start <= match.start() < end for start, end in spans) and not _BY_TIME.match(written, match.end()):
            return False  # ∂L/∂θ'
    given = [m for m in slopes if _VALUE.match(written, m.end())]
    values = [x["value"] for m in given if (x := _VALUE.match(written, m.end())) is not None]
    values += [m["value"] for m in stated]
    lengths = _lengths(names)
    return bool(values) and all(_is_of_lengths(x, names, lengths) for x in values)


def _is_of_lengths(value: str, names: Names, lengths: frozenset[object]) -> bool:
    """Whether a value has lengths and angles alone, and at least one of the lengths; L is one."""
    end = _END.search(value)
    value = value[: len(value) if end is None else end.start()]
    words = [x for x in _WORD.findall(_FUNCTION.sub(" ", value)) if x.removeprefix("\\") not in _COMMANDS]
    words = [x for x in words if function_of(x.removeprefix("\\")) is None]
    coordinates = {c.symbol for c in names.model.coordinates}
    found: set[object] = set()
    for word in words:
        whole = _meant(word, names)
        listed = [whole] if whole is not None else [_meant(x, names) for x in word]
        if _RATE.search(normalize("NFD", value)) or not all(x in lengths or x in coordinates for x in listed):
            return False
        found |= set(listed) - coordinates
    return bool(found)


def _lengths(names: Names) -> frozenset[object]:
    """The letters of the system that are no mass, stiffness, damping, force or weight, and what is defined by these."""
    sizes = set[object]()
    for element in names.model.elements:
        if isinstance(element, (Body, Gravity, Spring, Damper)):
            listed = [getattr(element, x, None) for x in ("mass", "inertia", "g", "k", "b", "law", "energy")]
        else:
            listed = list(vars(element).values())
        for x in listed:
            for y in x if isinstance(x, (tuple, list)) else (x,):
                sizes |= set(y.free_symbols) if isinstance(y, (sp.Basic, MatrixBase)) else set()
    lengths = {p.symbol for p in names.model.parameters} - sizes
    moving = {c.symbol for c in names.model.coordinates}
    defined = {
        d.symbol
        for d in names.model.definitions
        if bounded.symbols(x := names.model.expand(d.symbol)) - {time} <= lengths and x.atoms(AppliedUndef) <= moving
    }
    return frozenset((*lengths, *defined, _LENGTH))


_LENGTH = sp.Dummy("L")
"""The L of an answer, where the system has none."""


def _meant(word: str, names: Names) -> object:
    """The symbol of the system that a word is."""
    bare = re.sub(r"[\\{}]", "", word).replace("varphi", "phi").replace("vartheta", "theta")
    found, dots = names.scope.meanings(bare)
    if len(found) == 1 and not dots:
        return names.scope[found[0]]
    return _LENGTH if bare == "L" else None


def _is_factor(match: re.Match[str], written: str, taken: Callable[[str], bool]) -> bool:
    """Whether an L stands alone, or as a factor beside letters of the system: r L in LaTeX, and no word or command."""
    start, end = match.start(), match.end()
    while start and written[start - 1].isalpha() and match.start() - start < LONGEST:
        start -= 1
    while end < len(written) and written[end].isalpha() and end - match.end() < LONGEST:
        end += 1
    run = written[start:end]
    return written[start - 1 : start] != "\\" and all(x == "L" or (taken(x) and not taken(run)) for x in run)


def _second(by: str) -> str:
    """The pattern of the second derivative of L."""
    of = rf"{re.escape(by)}[ ]?{_TWO}"
    return (
        rf"(?:(?<![^\W\d])(?<!\\){_D}{_TWO}L[ ]?/[ ]?{_D}{of}"
        rf"|\\[dt]?frac[ ]?\{{[ ]?{_D}{_TWO}L[ ]?\}}[ ]?\{{[ ]?{_D}{of}\}})"
    )


def _found(form: str, written: str) -> Iterator[re.Match[str]]:
    return islice(re.finditer(form, written), MOST)
