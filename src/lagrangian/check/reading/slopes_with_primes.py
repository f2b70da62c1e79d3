r"""Primes of names that are no rates, where rates have dots: Θ′ = 2 m r² sin φ cos φ is ∂Θ/∂φ, and so is U′ = ….

Such a value holds one coordinate and no rate, so that it is no derivative by time. Where an answer says that primes are
d/dφ, all of them are; l′(φ) always is, where the system defines l by φ. Θ″ is ∂²Θ/∂φ².
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import islice
from unicodedata import normalize

from lagrangian.check.reading.arguments import QUOTIENT, apart_from, is_in_chain
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.read.letters import key

MOST = 12
"""The most such names."""

_NAME = r"\\?[^\W\d_]\w{0,15}?"
_STATED = re.compile(
    rf"(?:^|[,;:&$⇒⟹→]|=>|->|(?<=\])|\\\[|\\q?quad|(?<=[^\W\d_]{{3}})[ ]|[-*•–][ ])[ \t$]*+(?P<name>{_NAME})[ ]?"
    r"['’′″]{1,2}(?!['’′″])(?:(?:\\left)?\([^()\n]{1,16}\))?[ \t]*+&?[ \t]*+=(?![=>])(?P<value>[^\n=;]{1,300})",
    re.MULTILINE,
)
"""A name with a prime, or two, that is given a value."""
_D = r"(?:\\mathrm[ ]?\{d\}|\\partial|d|∂)[ ]?(?:\([ ]?(?:\\cdot|·|\.)?[ ]?\))?[ ]?"
_OVER = rf"(?:{_D}/[ ]?{_D}(?P<under>{_NAME})|\\[dt]?frac[ ]?\{{[ ]?{_D}\}}[ ]?\{{[ ]?{_D}(?P<below>{_NAME})[ ]?\}})"
_LEGEND = re.compile(
    r"(?:\b(?:(?:[Aa]|[Tt]he)[ ])?[Pp]rimes?\b|(?<![\w)}\]'’′])(?P<open>\$)?[ ]?"
    r"(?:\([ ]?(?:\\cdot|·|\.)?[ ]?\))?['’′])(?:[ ]\([ ]?['’′][ ]?\))?"
    r"[ \t]*+(?:=|≡|:|\\equiv|means?|denotes?|stands?[ ]for|marks?|indicates?|is|are|for)[ \t]*+"
    rf"(?:(?:the|a)[ ])?(?(open)|\$?)[ ]?(?:{_OVER}|(?:derivatives?|differentiation|slopes?)[ ]"
    rf"(?:with[ ]respect[ ]to|by|w\.?r\.?t\.?)[ ]\$?(?P<said>{_NAME}))\$?(?![\w'’′\u0307\u0308(])"
)
"""What says of which derivative primes are: prime = d/dθ, primes denote derivatives with respect to θ."""
_BEGINS = re.compile(r"(?:(?<![\w\\])|(?<=[½¼¾⅓⅔])|(?<=frac\d\d)|(?<=[-+−–=(\[{ ]\d))")
"""Where a name begins, also behind a fraction or a number: ½I'."""
_RUN = re.compile(r"(?<![^\W\d])(?<!\\)[^\W\d_]{1,4}\Z")
_APPLIED = re.compile(
    rf"(?<![^\W\d_])(?P<name>{_NAME})[ ]?['’′″]{{1,2}}(?:\\left)?\([ ]?(?P<by>{_NAME})[ ]?(?:\\right)?\)"
)
"""A name with primes, and what it depends on: l'(θ)."""
_PRIMES = r"[ ]?(?P<primes>['’′]{1,2}|″)(?!['’′″])"
_DOTS = re.compile("[\u0307\u0308]|\\\\d?dot(?![A-Za-z])")
_PRIMED = re.compile(
    r"(?:(?<=frac\d\d)|(?<![^\W\d_½¼¾⅓⅔])(?!\\?[dt]?frac\d))(?P<name>\\?[^\W\d_½¼¾⅓⅔]\w{0,15}?)[ ]?['’′″]"
)
_LETTERS = re.compile(r"\\?[^\W\d_]+")
_FUNCTION = re.compile(r"\\?(?:sin|cos|tan)(?=[^\W\d_\\])")
_POWERS = re.compile("[⁰¹²³⁴-⁹]")


def with_primes_of_slopes(
    text: TracedText,
    moves: Callable[[str], bool],
    taken: Callable[[str], bool],
    defined: Callable[[str], bool],
    told: dict[str, None],
    *,
    latex: bool,
) -> TracedText:
    """Return an answer in which such names are slopes; notes tell these.

    ``moves`` says whether a name is a coordinate, ``taken`` whether the system has a name, and ``defined`` whether it
    is a quantity that the system defines by one coordinate.
    """
    whole = normalize("NFD", text.text)
    legend = next((m for m in islice(_LEGEND.finditer(text.text), MOST) if moves(_bare(_by(m)))), None)
    said = range(*legend.span()) if legend is not None else range(0)
    marks = (m for m in islice(_PRIMED.finditer(text.text), 20 * MOST) if m.end() - 1 not in said)
    primed = dict.fromkeys(m["name"] for m in marks)
    applied = islice(_APPLIED.finditer(text.text), 20 * MOST)
    found = {m["name"]: m["by"] for m in applied if defined(_bare(m["name"])) and moves(_bare(m["by"]))}
    if "=" not in whole or any(moves(_bare(x)) for x in primed):
        legend = None
    elif legend is not None:
        alone = dict.fromkeys(x[-1] if _is_joined(x[:-1], taken) and defined(x[-1]) else x for x in primed)
        free = [x for x in alone if not taken(_bare(x)) or defined(_bare(x))]
        found |= dict.fromkeys(free[:MOST], _by(legend))
    elif _DOTS.search(whole) is not None:
        found |= _stated(text.text, moves, lambda x: defined(x) or not taken(x))
    edits: list[Edit] = [] if legend is None or not found else [(*legend.span(), "primes are slopes")]
    for name, by in found.items():
        for match, new in _slopes(text.text, name, by, latex=latex, valued=defined(_bare(name))):
            before = _RUN.search(text.text, max(0, match.start() - 8), match.start())
            joined = name[0] == "\\" or (len(name) == 1 and before is not None and _is_joined(before.group(), taken))
            if joined or _BEGINS.match(text.text, match.start()) is not None:
                edits.append((*match.span(), apart_from(text.text, match, new)))
        if f"{_bare(name)}' was read as a derivative by {_bare(by)}." in told:
            continue
        told.setdefault(f"{_bare(name)}' was read as the slope of {_bare(name)} by {_bare(by)}.")
    return text.edited(apart(sorted(edits)))


def _by(legend: re.Match[str]) -> str:
    return legend["under"] or legend["below"] or legend["said"]


def _stated(text: str, moves: Callable[[str], bool], free: Callable[[str], bool]) -> dict[str, str]:
    """The names whose primes have values without rates, and by which coordinate these are slopes."""
    found: dict[str, str] = {}
    stated = list(islice(_STATED.finditer(text), 2 * MOST))
    for match in (*stated, *stated):  # I' = 2 m l' l'' may stand above l' = …
        name, value = match["name"], match["value"]
        if name in found or not free(_bare(name)) or moves(_bare(name)) or len(found) == MOST:
            continue
        held = {m["name"] for m in _PRIMED.finditer(value)} - {name}
        if _DOTS.search(normalize("NFD", value)) or QUOTIENT.search(value) or not held <= found.keys():
            continue
        by = [x for x in _letters(value) if moves(_bare(x))] + [found[x] for x in held]
        if len({key(_bare(x)) for x in by}) == 1:
            found[name] = by[0]
    return found


def _slopes(text: str, name: str, by: str, *, latex: bool, valued: bool) -> Iterator[tuple[re.Match[str], str]]:
    """The primes of one name, and the slopes that they are; without a value of the name they are names as any."""
    given = rf"(?<![\w\\]){re.escape(name)}(?:\([^()\n]{{1,24}}\))?[ \t]*&?[ \t]*=(?![=>])"
    of = rf"\partial {name}" if latex else f"∂{name}"
    below = rf"\partial {by}" if latex else f"∂{by}"
    first = rf"\frac{{{of}}}{{{below}}}" if latex else f"{of}/{below}"
    second = rf"\frac{{\partial^2 {name}}}{{{below}^2}}" if latex else f"∂²{name}/{below}²"
    if not valued and re.search(given, text) is None and not is_in_chain(name, text):
        first = f"{name}_{{slope}}" if latex else f"{name}_slope"
        second = rf"\frac{{\partial {first}}}{{{below}}}" if latex else f"∂{first}/{below}"
    form = rf"{re.escape(name)}{_PRIMES}(?:(?:\\left)?\([ ]?{re.escape(by)}[ ]?(?:\\right)?\))?"
    for match in islice(re.finditer(form, text), 20 * MOST):
        yield match, first if match["primes"] in ("'", "’", "′") else second


def _is_joined(before: str, taken: Callable[[str], bool]) -> bool:
    """Whether what stands right before a letter is a product of letters of the system: m g in mgl'."""
    return 0 < len(before) < 5 and before.isalpha() and all(map(taken, before))


def _letters(value: str) -> list[str]:
    """The names in a value."""
    return [_FUNCTION.sub("", x) for x in _LETTERS.findall(_POWERS.sub(" ", value))]


def _bare(name: str) -> str:
    return name.removeprefix("\\").removeprefix("var")
