"""Reads what an answer says beside its mathematics about the letters that it uses for coordinates.

% q1 = phi, q2 = s             q1 = phi, q2 = s           a comment of a program
$\\theta$ stands for phi here   $\\theta=\\phi$ here         a sentence
I use u for x and w for x'.     I ; u = x; w = x'.        another
… sin(a)   (a is alpha)         … sin(a)   ; a = alpha    in brackets
with μ the reduced mass m M/(m + M), …    ; μ = m M/(m + M); …      a name, what it is, and its value
w: speed of the drum (phi')               ; w = phi';       a rate
The cart's speed v is x'.                 … ; v = x';.      another
Denote J + m l^2 by A.                    ; A = J + m l^2;.
(a1, a2: accelerations of the carts)      (; a1 = x1''; a2 = x2'')
States: x (cart), v = x'.                 v = x';
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from itertools import islice

from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.read.letters import SPELLED, key, undotted

MOST_VALUES = 20
"""The most values in comments that are looked at."""
MOST_LETTERS = 3
"""The most letters of a product without signs in the value of a name."""
_PAIR = rf"{IDENT}[ \t]*+=[ \t]*+{IDENT}"
_PAIRS = rf"{_PAIR}(?:[ \t]*+(?:,|;|and|und|et)[ \t]*+{_PAIR})*+"
_COMMENT = re.compile(
    rf"(?P<mark>(?<!\\)[#%]|//)[ \t]*+(?P<said>{_PAIRS})[ \t]*+[.;]?[ \t]*+$",
    re.MULTILINE,
)
_COMMENTED = re.compile(
    rf"^[ \t]*+(?P<mark>(?:[#%]+|//)[ \t]*+(?:(?:where|with|here|mit|wobei)[ \t]++)?)(?P<new>{IDENT})[ \t]*+="
    r"[ \t]*+(?P<value>[^\n=]{3,200})$",
    re.MULTILINE,
)
"""The value of a name on a line that is a comment: % where Delta = …"""
_EACH = re.compile(rf"({IDENT})[ \t]*+=[ \t]*+({IDENT})")
_SENTENCE = re.compile(
    rf"(?P<math>\$?)(?<![\w\\])(?P<new>\\?{IDENT})(?P=math)[ \t]++(?:stands[ \t]for|denotes|steht[ \t]für|bezeichnet)"
    rf"[ \t]++(?:the[ \t]|your[ \t]|den[ \t]|das[ \t])?(?P<open>\$?)(?P<own>\\?{IDENT})(?P=open)(?![\w(^'′$\\])"
)
_SHORT = re.compile(
    rf"\([ \t]*+(?P<new>{IDENT})[ \t]++(?:is|means|stands[ \t]for|denotes|ist|bedeutet)[ \t]++(?P<own>{IDENT})[ \t]*+\)"
)
"""A letter of the system that is written otherwise: (a is alpha)."""

_TERM = rf"{IDENT}(?:\([^()\n]{{1,40}}\))?['’′]{{0,2}}(?:\^\d)?"
_VALUE = rf"{_TERM}(?:[ \t]?[-+*/·][ \t]?{_TERM}){{0,8}}"
_WHAT = r"(?:(?:the|a|an|den|die|das)[ \t](?:[^\W\d_]{3,20}[ \t]){1,3})?"
_ONE = rf"{IDENT}[ \t]++(?:for|für)[ \t]++{_WHAT}{_VALUE}"
_USED = re.compile(
    rf"(?<![\w\\])(?:use|used|using|write|wrote|writing|call|schreibe|nehme|verwende|benutze)[ \t]++"
    rf"(?P<said>{_ONE}(?:[ \t]*+(?:,[ \t]++(?:and|und)|,|and|und)\s++{_ONE})*+)(?![\w(^'′])"
)
_GOES_ON = re.compile(rf"[ \t]*+(?:[-+*/·^(\d√]|(?P<name>{IDENT}))")
"""What stands behind a value: another part of it, if this is no word."""
_FOR = re.compile(rf"({IDENT})[ \t]++(?:for|für)[ \t]++{_WHAT}({_VALUE})")


def with_stated_letters(
    written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool], *, latex: bool
) -> TracedText:
    """Return an answer in which names of coordinates that comments and sentences say stand as statements.

    ``moves`` says whether a name is one that changes with time, ``taken`` whether it belongs to the system. Only a new
    name for such a one is read; every other comment stays a comment.
    """

    def says(new: str, own: str) -> bool:
        return moves(own.lstrip("\\")) and not taken(new.lstrip("\\"))

    edits: list[Edit] = []
    if not latex:
        text = written.text
        for match in _COMMENT.finditer(text):
            if all(says(*pair) or says(*reversed(pair)) for pair in _EACH.findall(match["said"])):
                behind = text[text.rfind("\n", 0, match.start()) + 1 : match.start()].strip()
                edits.append((*match.span("mark"), "; " if behind else " "))
        edits += _values_in_comments(text, taken)
    for match in _SENTENCE.finditer(written.text):
        if says(match["new"], match["own"]):
            edits.append((*match.span(), _statement(match, latex=latex)))
    for match in _SHORT.finditer(written.text) if not latex else ():
        if taken(match["own"]) and not taken(match["new"]):
            edits.append((*match.span(), f"; {match['new']} = {match['own']}"))
    for match in _USED.finditer(written.text) if not latex else ():
        after = _GOES_ON.match(written.text, match.end())
        if after is not None and (after["name"] is None or taken(after["name"])):
            continue  # I write A for J + 2 m; for J + l^2 m
        pairs = _FOR.findall(match["said"])
        named = [[x for x in re.findall(IDENT, value) if function_of(x) is None] for _, value in pairs]
        if all(a and all(map(taken, a)) and not taken(new) for a, (new, _) in zip(named, pairs, strict=True)):
            edits.append((*match.span(), "; " + "; ".join(f"{new} = {value}" for new, value in pairs) + ";"))
    return written.edited(sorted(edits))


def _values_in_comments(text: str, taken: Callable[[str], bool]) -> list[Edit]:
    """The marks in front of values of names that other lines use and none defines."""
    edits: list[Edit] = []
    for match in islice(_COMMENTED.finditer(text), MOST_VALUES):
        new, whole = match["new"], re.escape(match["new"])
        names = [x for x in re.findall(r"[^\W\d_²³]\w*", match["value"]) if function_of(x) is None]
        if taken(new) or not names or not all(_is_product(x, taken) for x in names):
            continue
        defined = re.search(rf"^[ \t]*+{whole}[ \t]*+:?=(?!=)", text, re.MULTILINE)
        used = re.search(rf"^(?![ \t]*+(?:[#%]|//))[^\n#%]*(?<!\w){whole}(?!\w)", text, re.MULTILINE)
        if defined is None and used is not None:
            edits.append((*match.span("mark"), " "))
    return edits


_WORD = r"[^\W\d_]{2,20}+"
_VALUED = re.compile(
    rf"(?<!\w)(?:with|where|let|and|mit|wobei|und|sei)[ \t]++(?P<new>{IDENT})[ \t]++"
    r"(?:(?:is|be|being|denotes|ist)[ \t]++)?(?:the|an?|its|das|die|der|dem)[ \t]++"
    rf"(?P<words>(?:{_WORD}[ \t]++){{1,4}}?)"
    r"(?P<value>[^\s,;=]{0,60}[-+*/^·²³(][^,;=\n]{0,200}?)(?P<end>[ \t]*(?:[,;:]|\.(?=\s|$)|$))",
    re.MULTILINE | re.IGNORECASE,
)
_IS_VALUE = re.compile(
    rf"(?<!\w)(?:with|where|and|mit|wobei|und)[ \t]++(?P<new>{IDENT})[ \t]++(?:is|being|denotes|means|ist|bezeichnet)"
    r"[ \t]++(?P<value>[^\n;:=]{0,60}?[-−+*/^·²³(][^\n;:=]{0,200}?)"
    rf"(?P<end>[ \t]*(?:;|\.(?=\s|$)|$|(?=,?[ \t]+(?:and|und|where|with|wobei|mit)[ \t]+{IDENT}[ \t])))",
    re.MULTILINE | re.IGNORECASE,
)
"""A name and its value: where N is -b theta' - m g L sin theta."""
_IN_BRACKETS = re.compile(
    rf"(?<![\w.*/^+])(?P<new>{IDENT})(?:[ \t]*+(?::|=|,|\bis\b|\bdenotes\b)[ \t]++|[ \t]++)"
    rf"(?P<words>(?:{_WORD}[ \t]++){{1,6}})"
    rf"\([ \t]*=?[ \t]*(?P<value>{IDENT}['’′]{{1,2}})[ \t]*\)"
)
"""A name, what it is, and the rate that it is: w: speed of the drum (phi')."""
_EQUAL_IN_BRACKETS = re.compile(
    rf"(?<![\w.*/^+])(?P<new>{IDENT})(?:[ \t]*+(?::|,|\bis\b|\bdenotes\b)[ \t]++|[ \t]++)"
    rf"(?P<words>(?:{_WORD}[ \t]++){{1,6}})\([ \t]*=[ \t]*(?P<value>[^()=,;\n]{{1,80}}?)[ \t]*\)"
)
"""A name, what it is, and its value: w absolute rate of the panel (= dphi/dt + dpsi/dt)."""
_NAMED_IN_BRACKETS = re.compile(
    rf"(?<!\w)(?:with|by|as|call(?:ed)?|named?|denoted?|forces?|mit|durch|als|Kraft)[ \t]++(?P<new>{IDENT})[ \t]++"
    r"\([ \t]*=[ \t]*(?P<value>(?:[^()=,;\n]|\([^()=\n]{0,60}\)){1,80})[ \t]*\)"
)
"""A name behind a word that leads to one, and its value: which I call f (= k times the stretch s)."""
_TIMES_WHAT = re.compile(
    r"[ \t]++(?:times|mal|fois)[ \t]++(?P<what>(?:the|its|die|der|das|le|la)[ \t]++(?:[^\W\d_]{3,20}[ \t]++){1,3})?"
)
"""The word for a product, and what the other factor is."""
_BY_TIME = re.compile(r"(?<!\w)d[ ]?(?P<of>[^\W\d_]\w{0,15}?)[ ]?/[ ]?dt(?!\w)")
_IS_RATE = re.compile(
    rf"(?<![\w.*/^+=])(?P<new>{IDENT})[ \t]++(?:is|denotes|means|being|ist|bezeichnet)[ \t]++"
    rf"(?P<value>{IDENT}['’′]{{1,2}})(?=[ \t]*(?:[.,;:)]|$|and\b|und\b))",
    re.MULTILINE,
)
_BY = re.compile(
    r"(?<!\w)(?:denot(?:e|ing)|abbreviat(?:e|ing)|call(?:ing)?|writ(?:e|ing))[ \t]++(?P<value>[^,;:=\n]{3,80}?)"
    rf"[ \t]++(?:by|as)[ \t]++(?P<new>{IDENT})(?![\w'’′(])",
    re.IGNORECASE,
)
_FOR_SUM = re.compile(
    rf"(?<!\w)(?:with|mit|write|writing|using|abbreviating)[ \t]++(?:the[ \t]{_WORD}[ \t])?(?P<new>{IDENT})[ \t]++"
    r"(?:for|für)[ \t]++(?P<value>(?=[^,;:=\n]{0,60}?[-−+*/·²³^])[^\s,;:=][^,;:=\n]{1,100}?)"
    r"(?=[ \t]++(?:the|we|I|our|this|it|die|der|das|wird|ist|is|becomes?|gives?)[ \t]|[ \t]*(?:[,;:]|\.(?=\s|$)|$))",
    re.MULTILINE | re.IGNORECASE,
)
"""A name in the place of its value: With I for A + m l² the Lagrangian is …"""
_LISTED = rf"{IDENT}(?:[ \t]*(?:,|and|und)[ \t]*{IDENT}){{0,7}}"
_RATES = re.compile(
    rf"(?<![\w.*/^+])(?P<names>{_LISTED})[ \t]*"
    r"(?::|=|\bis\b|\bare\b|\bdenotes?\b)[ \t]*(?:the[ \t]+)?(?:(?:angular|linear|their|its)[ \t]+)?"
    r"(?P<rate>accelerations?|velocit(?:y|ies)|speeds?"
    r"|(?:first|second)(?![ \t]+(?:and|und|or)\b)(?=\b[^.;\n]{0,60}\bderivatives?\b))\b"
    rf"(?:(?![ \t]*(?:,|and\b|und\b)[ \t]*{_LISTED}[ \t]*(?::|=|is\b|are\b|denotes?\b))[^=+*/^()\n;.]){{0,60}}",
    re.IGNORECASE,
)

_STATES = re.compile(
    r"^[ \t]*+(?:states?|state[ \t](?:variables?|vector)|Zustände|Zustandsgrößen)[ \t]*+:[ \t]*+"
    r"(?P<listed>[^\n;]{3,300}?)(?P<end>[ \t]{0,9}(?:[.;](?=\s|$)|$))",
    re.MULTILINE | re.IGNORECASE,
)
_STATE = re.compile(
    rf"{IDENT}['’′]{{0,2}}(?:[ \t]*=[ \t]*(?P<value>{IDENT}['’′]{{1,2}}))?(?:[ \t]*\([^()=]{{1,60}}\))?"
)


def _with_listed_states(written: TracedText) -> TracedText:
    """Return an answer in plain text in which a list of states only states which rates they are."""
    edits: list[Edit] = []
    for match in _STATES.finditer(written.text):
        states = [
            _STATE.fullmatch(x.strip()) for x in re.split(r",(?![^(]*\))|[ \t]and[ \t]|[ \t]und[ \t]", match["listed"])
        ]
        stated = [x.group().partition("(")[0] for x in states if x is not None and x["value"]]
        if stated and all(states):
            edits.append((*match.span(), f"{'; '.join(stated)};"))
    return written.edited(edits)


def _is_word(name: str, text: str) -> bool:
    """Whether a name is a word that stands only once: and therefore the gimbal with -tau."""
    return (
        len(name) > 3 and name.isalpha() and name not in SPELLED.values() and len(re.findall(rf"\b{name}\b", text)) == 1
    )


def with_stated_values(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text in which a value behind the words for a new name is a statement, or a
    rate in brackets behind them."""
    written = _with_listed_states(written)
    edits: list[Edit] = []
    forms = (_VALUED, _IS_VALUE, _IN_BRACKETS, _EQUAL_IN_BRACKETS, _NAMED_IN_BRACKETS, _IS_RATE, _BY, _FOR_SUM)
    for form in forms:
        for match in form.finditer(written.text):
            spoken = match.groupdict().get("words") or ""
            value = _multiplied(_BY_TIME.sub(r"\g<of>'", match["value"]))
            names = [x for x in re.findall(r"[^\W\d_²³]\w*", value) if function_of(x) is None]
            if (
                not names
                or not all(_is_product(x, taken) for x in names)
                or any(map(taken, [match["new"], *spoken.split()]))
            ):
                continue
            if _is_word(match["new"], written.text) or (
                form in (_EQUAL_IN_BRACKETS, _NAMED_IN_BRACKETS) and not _is_letter(match["new"])
            ):
                continue
            if "end" in form.groupindex:  # a long value keeps its places
                edits.append((match.start(), match.start("value"), f"; {match['new']} = "))
                edits.append((*match.span("end"), ";"))
            else:
                edits.append((*match.span(), f"; {match['new']} = {value};"))
    return written.edited(apart(edits))


def _multiplied(value: str) -> str:
    """A value with the word for a product as its sign, and the other factor in brackets if words say what it is:
    k times the stretch s - s0 is k*(s - s0)."""
    match = _TIMES_WHAT.search(value)
    if match is None:
        return value
    factor = value[match.end() :]
    return f"{value[: match.start()]}*({factor})" if match["what"] else f"{value[: match.start()]}*{factor}"


def _is_letter(name: str) -> bool:
    """Whether a name is a letter, perhaps with an index, a few capitals or a spelled Greek letter, and neither a common
    word nor the letter of an energy: w1, f_s, Th2, omega; no "the arm (= l)"."""
    if name[1:2] == "_":
        return name[0] not in {*"TVUKLEDW"}
    stem = name.rstrip("0123456789_")
    spelled = stem in SPELLED.values() or name != stem or (len(name) <= MOST_LETTERS and not name.islower())
    return (len(name) == 1 or spelled) and stem not in {*"TVUKLEDWIaA"}


def _is_product(name: str, taken: Callable[[str], bool]) -> bool:
    """Whether letters are a name of the system, perhaps with a power, or a few such names: l², ml²."""
    bare = name.rstrip("²³")
    return taken(bare) or (len(bare) <= MOST_LETTERS and all(map(taken, bare)))


def with_stated_rates(
    written: TracedText, coordinates: Sequence[str], taken: Callable[[str], bool], *, sure: bool = False
) -> TracedText:
    """Return an answer in plain text in which names that words call velocities or accelerations are rates.

    They are those of the coordinates with the same number, a2 of x2, or of all of them in their order. It is ``sure``
    where comments of programs say so of names that begin as the coordinates do: xp, tp = velocities.
    """
    edits: list[Edit] = []
    for match in _RATES.finditer(written.text):
        names = [x for x in re.findall(IDENT, match["names"]) if x not in ("and", "und")]
        primes = "''" if match["rate"].lower().startswith(("acc", "second")) else "'"
        numbered = any(map(_number, coordinates)) and all(map(_number, names))
        of = [[c for c in coordinates if _number(c) == _number(x)] for x in names]
        own = [x[0] for x in of if len(x) == 1] if numbered else coordinates
        told = re.findall(r"(?<![\w.])\d{1,2}(?!\w)", match.group()[match.end("rate") - match.start() :])[: len(names)]
        if numbered and told and told != [_number(x) for x in names]:
            continue  # c1 and c2 are the accelerations of masses 1 and 3
        line = written.text[written.text.rfind("\n", 0, match.start()) + 1 : match.start()]
        mark = re.search(r"(?<![\\\w])(?:[#%]|//)", line)
        alike = mark is not None and all(x[0] == c[0] for x, c in zip(names, own, strict=False))
        if len(own) == len(names) and not any(map(taken, names)) and (alike or not sure):
            pairs = [(x, c) for x, c in zip(names, own, strict=True) if (len(primes), c) not in spelled_rates(x)]
            said = "; ".join(f"{x} = {c}{primes}" for x, c in pairs)
            edits.append((*match.span(), f"; {said}" if mark is None else f"\n{said}\n{mark.group()} "))
    return written.edited(edits)


def _number(name: str) -> str:
    """The number at the end of a name."""
    return re.search(r"\d*\Z", name)[0]  # type: ignore[index]  # it always matches


_VARIATION = re.compile(r"(?<![\w\\])delta[ \t_]?+(?=[^\W\d])")
_VIRTUAL_WORK = re.compile(r"(?<![\w\\])delta[ \t_]?W(?!\w)")


_VIRTUAL = re.compile(r"\bvirtual|virtuelle?[rn]?\b|\bvirtuel|d['’]?[ ]?alembert", re.IGNORECASE)
_DISPLACED = re.compile(
    r"(?<![\w\\/∂])d(?:\([ ]?(?P<inside>[^\W\d]\w{0,11})[ ]?\)|(?P<bare>[^\W\d]\w{0,11}))(?![\w(]|[ ]?/[ ]?d|['’′]|\.)"
)
"""A virtual displacement written as a differential, dx or d(xm)."""


def speaks_of_virtual_work(text: str) -> bool:
    """Whether an answer speaks of virtual work or displacements."""
    return _VIRTUAL.search(text) is not None


_WORK_OF_DIFFERENTIALS = re.compile(r"(?<![\w\\/∂])d(?=W[ \t]{0,8}=[ \t]{0,8}(?P<sum>[^\n=]{1,400}))")
"""The d of a virtual work dW = F dx."""


def with_variations(
    written: TracedText, taken: Callable[[str], bool], moves: Callable[[str], bool] | None = None
) -> TracedText:
    """Return an answer in plain text in which the sign of virtual displacements is δ: delta W = F delta x, and dx, dφ
    where the answer speaks of these or has a dW = F dx; dẋ is the product of a damper. ``moves``: whether a name
    changes with time."""
    if moves is not None:

        def is_own(match: re.Match[str]) -> bool:
            name = match["inside"] or match["bare"]
            own = undotted(name)[1] == 0 and (moves(name) or (match["inside"] is not None and not taken(name)))
            return own and not taken(f"d{name}")

        def displaced(match: re.Match[str]) -> str:
            return f"δ{match['inside'] or match['bare']}" if is_own(match) else match.group()

        works = [
            x for x in _WORK_OF_DIFFERENTIALS.finditer(written.text) if any(map(is_own, _DISPLACED.finditer(x["sum"])))
        ]
        if works and not taken("dW"):
            written = written.edited([(*x.span(), "δ") for x in works])
        if works or speaks_of_virtual_work(written.text):
            written = written.sub(_DISPLACED, displaced)
    said = any(form.search(written.text) is not None for form in (_VIRTUAL_WORK, _VIRTUAL))
    if taken("delta") or not said:
        return written
    return written.edited([(*match.span(), "δ") for match in _VARIATION.finditer(written.text)])


def _statement(match: re.Match[str], *, latex: bool) -> str:
    """The statement that a sentence makes."""
    new, own = match["new"], match["own"]
    if not latex:
        return f"{new} = {own}"
    new, own = (f"\\{x}" if key(x) in SPELLED.values() and not x.startswith("\\") else x for x in (new, own))
    return f"${new}={own}$"
