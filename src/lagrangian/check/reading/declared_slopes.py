r"""What an answer says its primes mean: after ℓ' = dℓ/dθ, ℓ' is a slope and ℓ'' is the slope of ℓ', no rates.

ℓ' = dℓ/dθ = a sin θ / ℓ,  ℓ'' = …       ℓ_slope = ∂ℓ/∂θ;  ∂ℓ/∂θ = a sin θ / ℓ,  ∂ℓ_slope/∂θ = …
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.read.letters import key

_NAME = r"\\?[^\W\d_]\w{0,15}+"
_D = r"(?:\\mathrm[ ]?\{d\}|\\partial|d|∂)[ ]?"
_DECLARED = re.compile(
    rf"(?<![\w\\'’′^*/+)}}\]−-])(?P<name>{_NAME})[ ]?['’′](?:[ ]?(?:\\left)?\([ ]?(?P<at>{_NAME})[ ]?(?:\\right)?\))?"
    r"[ \t]*+&?[ \t]*+(?:=|:=|\\equiv|≡)[ \t]*+&?[ \t]*+"
    rf"(?:\\[dt]?frac[ ]?\{{[ ]?{_D}(?P<above>{_NAME})[^{{}}]{{0,12}}\}}[ ]?\{{[ ]?{_D}(?P<below>{_NAME})[ ]?\}}"
    rf"|(?P<open>\()?{_D}(?P<over>{_NAME})[ ]?/[ ]?{_D}(?P<under>{_NAME})(?![\w'’′\u0307\u0308(])(?(open)\)))"
    r"(?P<behind>[ \t]*+&?[ \t]*+(?:=|(?=[,;.:\n$)]|\\\]|\\\)|\\\\|\\q?quad|\\end|(?=(?:and|und|where|with)\b)|\Z)))"
)
_IN_WORDS = re.compile(
    rf"(?<![\w\\'’′^*/+)}}\]−-])(?P<name>{_NAME})[ ]?['’′][ ]{{1,2}}(?:(?:is|be|for|as)[ ])?(?:its|the)[ ]"
    rf"(?:derivative|slope)(?:[ ]of[ ](?P<over>{_NAME}))?[ ](?:with[ ]respect[ ]to|by|w\.?r\.?t\.?)[ ]"
    rf"(?P<under>{_NAME})(?![\w'’′\u0307\u0308(])"
)
"""The same in words: q' its derivative with respect to θ."""
_QUOTIENT = (
    r"(?:[d∂][ ]?(?P<over>{of})[ ]?/[ ]?[d∂][ ]?(?P<under>{by})|∂²(?P<top>{of})/∂(?P<below>{by})²)"
    r"(?![\w'’′\u0307\u0308(])"
)
_SPELLED = re.compile(
    rf"(?<![\w\\'’′^*/+)}}\]−∂-])(?P<name>{_NAME})[ ]?:?=[ ]?" + _QUOTIENT.format(of=_NAME, by=r"[^\W\d_][^\W²]{0,15}+")
)
"""A name in plain text that is given such a derivative: dp = dp/dtheta, ldd = ∂²l/∂θ²."""
_IN_COMMAND = re.compile(r"\\[A-Za-z]*\Z")
"""What makes a letter the end of a command."""
_MOST = 12
_LONGEST = 20_000


def with_declared_slopes(
    text: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool], told: dict[str, None], *, latex: bool
) -> TracedText:
    """Return an answer in which names with primes that it declares to be slopes are written as such; notes tell these.

    ``moves`` says whether a name is a coordinate, ``taken`` whether the system has a name.
    """
    found: dict[str, re.Match[str]] = {}
    declared = (*_DECLARED.finditer(text.text[:_LONGEST]), *_IN_WORDS.finditer(text.text[:_LONGEST]))
    for match in islice(declared, _MOST):
        over, by, at = _parts(match)
        fits = _key(over) == _key(match["name"]) and _key(at) == _key(by) and moves(_bare(by))
        rated = re.search(rf"(?<!\w){re.escape(match['name'])}[ ]?=[ ]?(?:\\dot|\w{{1,15}}['’′])", text.text)
        fits = fits and rated is None  # v = x' is a rate, and v' its rate
        if fits and not moves(_bare(match["name"])) and not taken(f"{_bare(match['name'])}_slope"):
            found.setdefault(match["name"], match)
    edits: list[Edit] = []
    for name, match in found.items():
        by = _parts(match)[1]
        slope = f"{name}_{{slope}}" if latex else f"{name}_slope"
        first, second = (rf"\frac{{\partial {x}}}{{\partial {by}}}" if latex else f"∂{x}/∂{by}" for x in (name, slope))
        goes_on = "=" in match.groupdict().get("behind", "")
        apart_by = ", \\quad" if latex else ","
        space = " " if match.group()[-1].isspace() else ""
        edits.append((*match.span(), f"{slope} = {first}{f'{apart_by} {first} =' if goes_on else ''}{space}"))
        applied = rf"(?:[ ]?(?:\\left)?\([ ]?{re.escape(by)}[ ]?(?:\\right)?\))?"
        before = "" if latex else r"(?<![\w\\])"
        form = rf"{before}{re.escape(name)}[ ]?(?P<primes>['’′]{{1,2}}|″)(?!['’′″]){applied}"
        for use in re.finditer(form, text.text):
            part = (
                name[0] != "\\"
                and latex
                and _IN_COMMAND.search(text.text, max(0, use.start() - 20), use.start()) is not None
            )
            if not match.start() <= use.start() < match.end() and not part:
                twice = use["primes"] not in ("'", "’", "′")
                edits.append((*use.span(), f" {second} " if twice else f"{slope} "))
        shown = "ℓ" if _bare(name) == "ell" else _bare(name)
        told.setdefault(f"{shown}' was read as the slope of {shown} by {_bare(by)}, as the answer says.")
    return text.edited(apart(sorted(edits)))


def with_spelled_slopes(text: TracedText, moves: Callable[[str], bool], told: dict[str, None]) -> TracedText:
    """Return an answer in plain text in which names that spell rates, and that it says to be slopes, have other names:
    dp, pd after dp = dp/dθ; notes tell these. ``moves`` says whether a name is a coordinate."""
    edits: list[Edit] = []
    for match in islice(_SPELLED.finditer(text.text[:_LONGEST]), _MOST):
        name, of, by = match["name"], match["over"] or match["top"], match["under"] or match["below"]
        if not moves(by) or moves(of) or all(key(stem) != key(of) for _, stem in spelled_rates(name)):
            continue
        slope = f"{of}_slope{'s' if match['top'] else ''}"
        quotient = _QUOTIENT.format(of=re.escape(of), by=re.escape(by))
        for use in re.finditer(rf"(?<![\w\\∂])(?:{quotient}|{re.escape(name)}(?![^\W²³]))", text.text):
            whole = use.group() == name
            edits.append((*use.span(), slope if whole else f"∂{of}/∂{by}" if use["over"] else use.group()))
        told.setdefault(
            f"{name} was read as the {'second ' if match['top'] else ''}slope of {of} by {by}, as the answer says."
        )
    return text.edited(apart(sorted(edits)))


def _parts(match: re.Match[str]) -> tuple[str, str, str]:
    """Of what a declared slope is, by what, and at what it is taken."""
    said = match.groupdict()
    by = said.get("below") or match["under"]
    return said.get("above") or match["over"] or match["name"], by, said.get("at") or by


def _bare(name: str) -> str:
    return name.removeprefix("\\")


def _key(name: str) -> str:
    return key("ℓ" if _bare(name) == "ell" else _bare(name))
