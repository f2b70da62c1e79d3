"""What an answer states and uses again, written out there: functions of a letter of their own, and "…".

e_r(β) = (cos β, sin β);  r = R e_r(φ) + l e_r(φ + ψ)      r = R (cos (φ), sin (φ)) + l (cos (φ + ψ), sin (φ + ψ))
f(u) = k u + c u^3;  F = f(x2 - x1)                        F = (k (x2 - x1) + c (x2 - x1)^3)
V = 1/2 k x^2;  V = … + m g x                              V = V + m g x
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import islice

from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.stated import ENERGY_NAMES
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

_LETTER = r"[^\W\d_]\w{0,15}"
_STATED = re.compile(rf"(?<![\w\\·*/^+.)])(?P<name>{_LETTER})\((?P<of>{_LETTER})\)[ \t]*=(?![=>])[ \t]*")
MOST, LONGEST, MOST_CALLS = 12, 200, 60
"""The most functions, the longest value of one, and the most places where they are used."""


def with_functions_applied(text: TracedText, taken: Callable[[str], bool], told: dict[str, None]) -> TracedText:
    """Return a plain text in which every such function has its value at its argument; notes tell these.

    ``taken`` says whether a name belongs to the system: the letter of a function is none of its names.
    """
    found: dict[str, tuple[str, str]] = {}
    for match in islice(_STATED.finditer(text.text), 4 * MOST):
        name, of = match["name"], match["of"]
        end = _end(text.text, match.end(), ",;=\n")
        value = text.text[match.end() : end].strip().rstrip(".")
        letter = re.compile(rf"(?<!\w){re.escape(of)}(?!\w)")
        free = name not in ENERGY_NAMES and function_of(name) is None and not taken(name)
        own = of != "t" and not taken(of) and not re.search(rf"(?<!\w){re.escape(of)}[ \t]*=", text.text)
        if free and own and len(found) < MOST and len(value) <= LONGEST and letter.search(value):
            found.setdefault(name, (of, value))
    edits = apart(edit for name, (of, value) in found.items() for edit in _calls(text.text, name, of, value))
    if len(edits) > MOST_CALLS:
        return text
    for name, (of, _) in found.items():
        if any(text.text.startswith(name, start) for start, _, _ in edits):
            told.setdefault(f"'{name}({of})' was read as a function of {of}.")
    return text.edited(edits)


def _calls(text: str, name: str, of: str, value: str) -> Iterator[Edit]:
    """The value in place of every use of a function for something else than its own letter."""
    letter = re.compile(rf"(?<!\w){re.escape(of)}(?!\w)")
    whole = value if _end(value, 1, "") == len(value) - 1 and value[0] in "([" else f"({value})"
    for match in islice(re.finditer(rf"(?<![\w\\]){re.escape(name)}\(", text), 2 * MOST_CALLS):
        end = _end(text, match.end(), "=;\n")
        argument = text[match.end() : end]
        if text[end : end + 1] == ")" and 0 < len(argument) <= LONGEST and argument.strip() != of:
            at = f"({argument})"
            yield match.start(), end + 1, letter.sub(lambda _, at=at: at, whole)


def _end(text: str, start: int, stops: str) -> int:
    """Where brackets that were open at a place close, or one of the signs that stop stands outside all others."""
    depth = 0
    for at in range(start, min(len(text), start + 2 * LONGEST)):
        if depth == 0 and (text[at] in stops or text[at] in ")]"):
            return at
        depth += (text[at] in "([") - (text[at] in ")]")
    return min(len(text), start + 2 * LONGEST)


_SQUARE = r"[ \t]*[*·]?[ \t]*(?:{of})(?:['’′]|\u0307|dot|_dot)[ \t]*(?:²|\^\{{?2|\*\*2)"
"""The square of the rate of a letter behind something."""
_OF_ENERGY = re.compile(r"d[ \t]?[TVELKU]\w{0,9}[ \t]?/[ \t]?dt|power", re.IGNORECASE)
"""A line with the rate of an energy, in which a rate may stand before such a square: ½ İ θ'²."""


def with_slopes_by_arguments(
    text: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool], told: dict[str, None]
) -> TracedText:
    """Return a plain text in which I' is I'(θ) before θ'², where the answer states I(θ): a rate of I stands before θ'.

    ½ I' θ'² is ∂T/∂θ, and d/dt (I θ') = I θ'' + I' θ'.
    """
    edits: list[Edit] = []
    for match in islice(_STATED.finditer(text.text), 4 * MOST):
        name, of = match["name"], match["of"]
        if not moves(of) or taken(name) or name in ENERGY_NAMES or function_of(name) is not None:
            continue
        primed = re.compile(rf"(?<![\w\\]){re.escape(name)}['’′](?={_SQUARE.format(of=re.escape(of))})")
        for line in re.finditer(r"[^\n]+", text.text):
            if _OF_ENERGY.search(line.group()) is None:
                edits += [(m.end(), m.end(), f"({of})") for m in primed.finditer(text.text, *line.span())]
    for at, _, argument in edits[:1]:
        told.setdefault(f"{text.text[:at].split()[-1]} was read as a derivative by {argument[1:-1]}.")
    return text.edited(edits[:MOST_CALLS])


_GOES_ON = re.compile(
    r"(?<![\w\\])(?P<name>[TVLUKEPD]\*?|(?:\\?Xi|Ξ|Q)[ ]?_?[ ]?(?:\{[^{}\n]{1,20}\}|\\?\w{1,20}))"
    r"(?P<is>[ \t]{0,9}&?[ \t]{0,9}=[ \t]{0,9})(?:\.{3,6}|…|\\[lc]?dots)(?=[ \t]{0,9}[-+−–])"
)
"""A quantity that is what stands above, and more."""


def with_values_above(text: TracedText) -> TracedText:
    """Return a text in which … in front of a term has the value that the quantity has above: V = … + m g y."""

    def named(match: re.Match[str]) -> str:
        above = re.compile(rf"(?<![\w\\]){re.escape(match['name'])}[ \t]{{0,9}}&?[ \t]{{0,9}}=(?!=)")
        whole = f"{match['name']}{match['is']}{match['name']}"
        return whole if above.search(text.text, 0, match.start()) else match.group()

    return text.sub(_GOES_ON, named) if any(x in text.text for x in ("...", "…", "dots")) else text
