"""For which values of coordinates, rates, inputs and constants a line may hold: those that it, or lines above it, say.

At θ = 90°: ℓ = √(a² + b²) = 0.6             ℓ has this value at θ = π/2 alone
α → 90°: what remains is m ẍ + k x = F       an equation of motion for α = π/2
θ̇ = θ̈ = 0:                                   of what stands below it, too
    τ = m g l sin θ
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence

from lagrangian.check.reading.name_patterns import INNER, LETTER
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.prose.remark_words import REST
from lagrangian.check.reading.prose.remarks import accelerates_in
from lagrangian.check.reading.prose.words import function_of
from lagrangian.read.letters import undotted

MOST = 2_000
"""The most lines that are looked at."""
ABOVE = 5
"""The most lines above one that may say for which values it holds."""
AT = "at "
"""How the words begin that say such a value: at theta'' = 0, at theta = 1*pi/2."""
LONGEST = 24
"""The most characters in front of a name that tell whether it is a factor."""
ORDERS = 2
"""The highest derivative of a coordinate that gets a value."""
STILL, STEADY, START = "still", "steady", "start"
"""That a line may be about rest, about constant rates, or about a start from rest."""

_PRIMES = r"(?:['’′]{1,2}|[\"″])?"
_NAME = rf"{LETTER}(?:{INNER}|[\u0307\u0308]){{0,23}}{_PRIMES}(?:\(0\))?"
_VALUE = (
    r"(?P<minus>[-−]?)[ ]?(?:"
    r"(?P<degrees>\d{1,3}(?:\.\d{1,4})?)[ ]?(?:°|\^\s?circ\b|degree\b|deg(?:rees)?\b|Grad\b|degrés\b)"
    r"|(?P<times>\d{0,2})[ ]?(?:π|pi(?![A-Za-z]))(?:[ ]?/[ ]?(?P<by>\d{1,2}))?"
    r"|frac[ ]?(?P<top>\d{0,2})[ ]?pi[ ]{0,3}(?P<below>\d{1,2})"
    rf"|(?P<number>\d{{1,4}}(?:\.\d{{1,6}})?)|(?P<infinite>∞|infinity\b|infty\b)|(?P<name>{_NAME}))"
)
_SAID = re.compile(
    rf"(?<![\w^*/+(.'’′-])(?P<left>{_NAME}(?:[ ]?=[ ]?{_NAME}){{0,5}})"
    r"[ ]?(?:=(?![=>])|≡|≈|→|->|⟶|\bto\b|\bapprox\b|\bequiv\b|\brightarrow\b)[ ]?"
    rf"{_VALUE}(?![\w^²³(]|[ ]?[*/·×+−]|[ ]-[ ])(?!['’′])"
)
"""Names, rates or accelerations that have a value."""
_NEXT = re.compile(rf"[ ]?(?P<name>{_NAME})")
_LAST = re.compile(rf"(?<![^\W_])(?P<word>{LETTER}(?:{INNER}|[\u0307\u0308]){{0,11}}{_PRIMES})\Z")
_GOES_ON = frozenset(")]²³⁴'’′*/·×^+−-√")
"""What ends a factor or a term."""
_ITEM = re.compile(r"[-–•*+]|\(?[a-z\d]{1,3}[.)]")
"""A bullet or a number."""
_DOT = re.compile(
    r"\\(?P<two>d?)dot[ ]?(?:\{[ ]?\\?(?P<in>[A-Za-z]{1,12})[ ]?\}|\\(?P<greek>[A-Za-z]{2,12})|(?P<one>[A-Za-z]))"
    r"(?P<index>_(?:\w|\{\w{1,8}\}))?"
)
_TEX = re.compile(r"\\(?:[,;:! ]|left|right|big)|[\\${}&`*]")
_STEADY = re.compile(
    r"\b(?:const(?:ant)?|steady|uniform(?:ly)?|konstant\w{0,2}|stationär\w{0,2}|gleichförmig\w{0,2}|constante?s?|"
    r"unaccelerated)\b",
    re.IGNORECASE,
)
_START = re.compile(
    r"\b(?:initial(?:ly)?|start(?:s|ing)?|immediately|just after|first moment|at first|released?|anfang\w{0,3}|beginn|"
    r"losgelassen|initialement|début)\b|\bt[ ]?=[ ]?0|['’′″\u0308}ẍÿ][ ]?\(0",
    re.IGNORECASE,
)
_STILL = re.compile(
    r"\b(?:holds?|holding|held|keeps?|stays?|stops?|standstill|equilibri\w{2}|balanced?|h[aä]lt(?:en)?|halte\w{0,3}|steht|"
    r"steh(?:en|t)|immobile|maintenir)\b",
    re.IGNORECASE,
)
_SPEAKS = re.compile(r"[^\W\d_]{4}|0")
"""What stands in all that these speak of: a word, or the time 0."""


def values_said(text: str, names: Names) -> Mapping[int, frozenset[str]]:
    """Return the values and the kinds of motion for which the statements of a line may hold, by its number."""
    model = names.model
    moving = {c.name for c in model.coordinates}
    own = moving | {x.name for x in (*model.parameters, *model.inputs)}

    def meaning(written: str) -> tuple[str, int] | None:
        bare = written.removesuffix("(0)")
        stem = bare.rstrip("'’′\"″")
        primes = sum(2 if x in '"″' else 1 for x in bare[len(stem) :])
        base, dots = undotted(stem)
        meant, order = names.scope.meanings(base)[0], primes + dots
        known = len(meant) == 1 and meant[0] in (moving if order else own) and order <= ORDERS
        return (meant[0], order) if known else None

    lines = text.split("\n")[:MOST]
    return {k: said for k, said in enumerate(_said(lines, meaning), 1) if said}


def _said(lines: Sequence[str], meaning: Callable[[str], tuple[str, int] | None]) -> Iterator[frozenset[str]]:
    """What each line with an equals sign, and the lines above it, say."""
    plain = [_plain(x) if any(c in x for c in "=→>≈") or "to" in x else x for x in lines]
    values = [frozenset(_values(x, meaning)) for x in plain]
    cues = [_cues(x) for x in lines]
    for k, line in enumerate(lines):
        if "=" not in line:
            yield frozenset()
            continue
        above = _above(lines, k)
        if any(values[above : k + 1]) or cues[k] or not accelerates_in(_SAID.sub(" ", plain[k])):
            yield frozenset[str]().union(*values[above : k + 1], *cues[above : k + 1])
        else:
            yield frozenset()


def _above(lines: Sequence[str], k: int) -> int:
    """The first line of those above one, up to an empty line, or to the next one if it follows an empty line."""
    first = k - 1 if k and not lines[k - 1].strip() else k
    while first > max(0, k - ABOVE) and lines[first - 1].strip():
        first -= 1
    return first


def _cues(line: str) -> frozenset[str]:
    """What kinds of motion the words of a line speak of."""
    if _SPEAKS.search(line) is None:
        return frozenset()
    kinds = ((STILL, REST), (STILL, _STILL), (STEADY, _STEADY), (START, _START))
    return frozenset(kind for kind, words in kinds if words.search(line))


def _values(line: str, meaning: Callable[[str], tuple[str, int] | None]) -> Iterator[str]:
    """The values that a line gives what the system has."""
    for match in _SAID.finditer(line):
        behind = _NEXT.match(line, match.end())
        if (behind is not None and meaning(behind["name"])) or _is_factor(line, match.start(), meaning):
            continue  # s'' = e phi'', cos α = 0, c θ' = τ
        value = _value(match, meaning)
        listed = [meaning(x.strip()) for x in match["left"].split("=")]
        if value is None or None in listed:
            continue
        for name, order in filter(None, listed):
            if value != name or order:
                yield f"{AT}{name}{order * chr(39)} = {value}"


def _is_factor(line: str, at: int, meaning: Callable[[str], tuple[str, int] | None]) -> bool:
    """Whether a name belongs to a product, a sum or a function that begins in front of it."""
    before = line[max(0, at - LONGEST) : at].rstrip(" \t(")
    if _ITEM.fullmatch(line[:at].strip()) or not before:
        return False
    word = _LAST.search(before)
    leads = word is not None and (function_of(word["word"]) is not None or meaning(word["word"]) is not None)
    return leads or before[-1] in _GOES_ON


def _plain(line: str) -> str:
    """A line without the marks of LaTeX, with primes for its dots."""

    def primed(match: re.Match[str]) -> str:
        index = (match["index"] or "").replace("{", "").replace("}", "")
        return f" {match['in'] or match['greek'] or match['one']}{index}{2 * chr(39) if match['two'] else chr(39)} "

    bare = _TEX.sub("", _DOT.sub(primed, line)) if "\\" in line or "$" in line else line
    return re.sub(r"[ \t]{2,}", " ", bare)


def _value(match: re.Match[str], meaning: Callable[[str], tuple[str, int] | None]) -> str | None:
    """A value, as numbers and pi, or as a name of the system."""
    minus = "-" if match["minus"] else ""
    if match["degrees"] is not None:
        return f"{minus}{match['degrees']}*pi/180"
    if match["number"] is not None:
        return f"{minus}{match['number']}"
    if match["infinite"] is not None:
        return f"{minus}oo"
    if match["name"] is not None:
        meant = meaning(match["name"])
        return None if meant is None or meant[1] else f"{minus}{meant[0]}"
    times, by = match["times"] or match["top"] or "1", match["by"] or match["below"] or "1"
    return f"{minus}{times}*pi/{by}"
