"""Sets aside what holds only under a condition: x is cyclic if F = 0 and b = 0; for J = 0 we get l θ'' + g sin θ = 0.

The condition says nothing of the system. An equation in the same sentence is one of a special case, a remark. So is for
which virtual motions an equation holds, for all φ*: they are no factors of it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from lagrangian.check.reading.markup import blank
from lagrangian.check.reading.prose.words import Words
from lagrangian.read.letters import key

_NAME = r"[^\W\d][\w\u0307\u0308]{0,15}+['’′]{0,2}"
_RELATION = (
    rf"{_NAME}[ \t]*(?:=|≈|≪|≫|<<|>>|<|>|≤|≥|→|≡|≠|!=|->)[ \t]*"
    rf"[-−]?(?:\d[\w./]{{0,8}}|(?:π|pi)(?:/\d)?|{_NAME}|∞)(?![\w(*/^+²])"
)
_LINK = r"[ \t]*(?:,|and|or|und|oder|et)[ \t]+"
CONDITION = re.compile(
    r"(?<!\w)(?:(?:V|U|PE|E_?pot)[ \t]*=[ \t]*0[ \t]+)?"
    r"(?P<word>at(?![ \t]+[^\s=]{1,20}['’′]{2})|if|when|whenever|for|unless|"
    r"(?:provided|assuming)(?:[ \t]that)?|wenn|falls|für|bei|sofern|si|pour)"
    rf"[ \t]+(?:[^\W\d_]{{2,12}}[ \t]+){{0,2}}?(?P<said>{_RELATION}(?:{_LINK}{_RELATION}){{0,4}})"
    r"(?=[ \t]*(?:$|[,.;:)]|[^\W\d_]{2}))",
    re.IGNORECASE | re.MULTILINE,
)
"""A condition, whose values are numbers or names, and the zero of V that it is."""
IF = frozenset(["if", "when", "whenever", "unless", "wenn", "falls", "si"])
_SIDES = re.compile(
    rf"(?<!\w)(?P<word>{'|'.join(sorted(IF))})[ \t]+(?P<left>[^=<>\n.;:'’′]{{3,60}})=(?P<right>[^=<>\n.;:'’′]{{1,60}}?)"
    r"(?=[ \t]*[,;][ \t]|[ \t]*\.?[ \t]*$|[ \t]+(?:[^\W\d_]{2,20}[ \t]+){2})",
    re.IGNORECASE | re.MULTILINE,
)
"""A condition between products or sums of constants and positions: if m1 r = m2 (l - r) there is no pull."""
_ZERO = r"(?:sin|cos|tan)(?![^\W_])[^=<>\n.;:'’′]{1,40}=[ \t]*0"
_VANISHES = re.compile(
    rf"(?<!\w)(?:where(?:ver)?|wo|où)(?:[ \t]+|[ \t]*\n[ \t]*){_ZERO}(?:{_LINK}{_ZERO}){{0,4}}"
    r"(?=[ \t]*(?:$|[,;)]|\.(?!\d)|[ \t][^\W\d_]{2}))",
    re.IGNORECASE | re.MULTILINE,
)
"""Where a function is zero, by which something was divided: this fails where sin θ = 0 or cos φ = 0."""
_REFERENCE = re.compile(
    rf"(?<![\w)\]])[(\[](?P<words>[^()\[\]=\n]{{0,60}}?)(?P<name>{_NAME})[ \t]*=[ \t]*[-−]?(?:\d[\d.,/π]{{0,8}}|π|pi)"
    r"(?:[ \t]?/[ \t]?\d)?(?P<more>[^()\[\]=\n+*^]{0,60})[)\]]"
)
"""Where a coordinate is zero, or V, in brackets and in words: (spring relaxed, x = 0)."""
_VIRTUAL = rf"(?:δ[ ]?|delta[ _]?)?{_NAME}[*⋆]?"
_FOR_ALL = re.compile(
    r"(?<!\w)(?:(?:for|pour|für|per|para)[ \t]+(?:all|any|every|each|arbitrary|tout(?:es?|s)?|tous|alle|jedes?|jeden"
    r"|beliebiges?|todos?|todas?|ogni)|∀|quel(?:le)?s?[ ]que[ ]soi(?:en)?t)[ \t]*(?:[^\W\d_]{3,16}[ \t]+){0,3}?"
    rf"(?P<names>{_VIRTUAL}(?:[ \t]*(?:,|and|et|und)[ \t]*{_VIRTUAL}){{0,5}})"
    r"(?=[ \t]*(?:[:;,]|\.?[ \t]*$))[ \t]*:?",
    re.IGNORECASE | re.MULTILINE,
)
"""The virtual motions for which an equation holds, in front of it or behind it."""
_AND = re.compile(r",|[ \t](?:and|et|und)[ \t]")
_WORD = re.compile(r"[^\W\d_]{3,}")
_CASE = re.compile(
    rf"^(?:[ \t]*[^\W\d_][\w \t-]{{2,30}}:)?[ \t]*(?P<said>{_RELATION}(?:{_LINK}{_RELATION}){{0,4}})"
    r"[ \t]*(?:⇒|⟹|=+>|→|-+>)",
    re.MULTILINE,
)
"""A special case, from which an arrow leads to what it would mean: check: m2 = m3 ⇒ y'' = 0."""
_UNDRIVEN = re.compile(
    rf"(?:^(?:[ \t]*[^\W\d_][\w \t-]{{2,30}}:)?|(?<=\())[ \t]*(?P<said>(?:{_NAME}[ \t]*=[ \t]*){{1,4}}0"
    rf"(?:{_LINK}(?:{_NAME}[ \t]*=[ \t]*){{1,4}}0){{0,3}})[ \t]*(?:⇒|⟹|=+>|→|-+>|:(?=[ \t][^\n]*=))",
    re.MULTILINE,
)
"""The case without inputs, with what it would mean behind it: u = P = 0 → p_phi = const."""
_GONE = re.compile(
    rf"(?:^|[:;.,(]|(?<!\w)(?:with|and|or|also|mit|und|avec))[ \t]*(?P<said>{_NAME}[ \t]*(?:=|→|->)[ \t]*0"
    rf"(?:{_LINK}{_NAME}[ \t]*(?:=|→|->)[ \t]*0){{0,4}})(?=[ \t]*(?:$|[,;:)⇒⟹→]|\.(?!\d))|[ \t]+[^\W\d_]{{3}})",
    re.MULTILINE,
)
"""A special case, of constants that are 0: limits: a = 0 decouples both; m → 0, J → 0: the mass alone."""
_SAID = re.compile(rf"(?P<left>{_NAME})[ \t]*[^\s\w]+[ \t]*[-−]?(?P<right>[\w./π∞]+)")
_COUNTED = re.compile(r"[ijkn][ \t]*=[ \t]*\d")
_NAMED = re.compile(r"[^\W\d][\w\u0307\u0308]*")
_INDEXED = re.compile(r"[^\W\d_]\w{0,15}?[\d_₀-₉]\w{0,15}")
"""A name with an index."""
_FACTOR = re.compile(r"(?<![\d.])[ \t]+([^\W\d_]{2,12})(?![^\W_])(?!['’′]{0,2}[ \t]*=)")
_SENTENCE_END = re.compile(r"[.;](?=\s|\Z)|\n")


def without_conditions(text: str, words: Words) -> str:
    """Return an answer in plain text with conditions blanked out."""
    found = [
        m
        for m in CONDITION.finditer(text)
        if not (_COUNTED.match(m["said"]) or _goes_on(text, m.end("said"), words))
        and (m["word"].lower() in IF or not (gives_constant(m["said"], words) and _is_given_once(m["said"], text)))
    ]
    found += [m for m in _vanishing(text) if _is_case(m["said"], words)]
    found += _VANISHES.finditer(text)
    found += [m for m in _CASE.finditer(text) if _is_case(m["said"], words)]
    found += [m for m in _UNDRIVEN.finditer(text) if _is_undriven(m["said"], words)]
    found += [m for m in _SIDES.finditer(text) if _is_readable(m["left"], words) and _is_readable(m["right"], words, 0)]
    for match in found:
        if match.re not in (CONDITION, _SIDES) or not words.is_name(match["word"]):  # si = sin ψ is a factor
            text = blank(text, *match.span("said" if match.re is _GONE else 0))
    for match in _FOR_ALL.finditer(text):
        named = (x.strip().removeprefix("delta").strip("δ_*⋆'’′ ") for x in _AND.split(match["names"]))
        if all(x == "t" or words.names.changes(x) for x in named):
            text = blank(text, *match.span())
    for match in _REFERENCE.finditer(text):
        spoken = [x for x in _WORD.findall(f"{match['words']} {match['more']}") if not words.readable(x)]
        if spoken and words.names.changes(match["name"]):
            text = blank(text, *match.span())
    return text


def gives_constant(stated: str, words: Words) -> bool:
    """Whether a statement behind "at" or "for" says what a new constant is that is used elsewhere: relaxed at y0 = -s0.
    A name with a rate, or without an index, may be a coordinate, which is there."""
    name, equals, value = (x.strip() for x in stated.partition("="))
    named = _NAMED.findall(value)
    if not (equals and named and _INDEXED.fullmatch(name)) or words.names.known(name):
        return False
    fixed = all(words.names.known(x) and not words.names.changes(x) for x in named)
    return fixed and key(name) not in words.names.scope.moving and words.count(name) > 1


def _is_given_once(stated: str, text: str) -> bool:
    """Whether nothing else gives a name its value."""
    name = re.escape(stated.partition("=")[0].strip())
    return len(re.findall(rf"(?<!\w){name}[ \t]*=(?!=)", text)) == 1


def _goes_on(text: str, end: int, words: Words) -> bool:
    """Whether a value is a factor of what stands behind it: axle at x = h sin β."""
    behind = _FACTOR.match(text, end)
    return behind is not None and (words.is_function(behind[1]) or words.is_name(behind[1]))


def _vanishing(text: str) -> Iterator[re.Match[str]]:
    """Where constants are 0, with words alone behind it and no equation."""
    at = 0
    for row in text.splitlines(keepends=True):
        last = _GONE.sub(lambda m: " " * len(m.group()), row).rfind("=")
        yield from (m for m in _GONE.finditer(text, at, at + len(row)) if m.end() > at + last)
        at += len(row)


def _is_readable(side: str, words: Words, least: int = 2) -> bool:
    """Whether a side consists of names of the system alone, at ``least`` so many, and of no rates."""
    named = [x for word in _NAMED.findall(side) for x in words.factors(word)]
    return len(named) >= least and all(words.is_name(x) or words.is_function(x) for x in named)


def _is_case(said: str, words: Words) -> bool:
    """Whether constants of the system are set equal to each other, or to 0."""
    constants = {p.name for p in words.names.model.parameters}
    pairs = [(m["left"], m["right"]) for m in _SAID.finditer(said)]
    named = [words.names.scope.meanings(x)[0] for pair in pairs for x in pair if x != "0"]
    return bool(named) and all(found and found[0] in constants for found in named)


def _is_undriven(said: str, words: Words) -> bool:
    """Whether inputs of the system are set equal to 0."""
    inputs = {u.name for u in words.names.model.inputs}
    named = [words.names.scope.meanings(x)[0] for x in re.findall(rf"({_NAME})[ \t]*=", said)]
    return all(found and found[0] in inputs for found in named)
