r"""Takes off an answer what is crossed out, which is no part of it: ~~V = k r²~~, <s>…</s>, \sout{…}.

A remark says it of the line in front of it: V = m g z   <- crossed out, V = m g z   ← wrong, see below.
A sentence says it of itself, I first had V = m g z, because I counted z upwards, where another line states V again.
A correction says it of what it states anew: Correction to line 2, I forgot g: V = m g z. *V = m g z. Wait, V should be
m g z.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from itertools import islice

from lagrangian.check.reading.latex.layout import closing
from lagrangian.check.reading.traced_text import Edit, TracedText, line_end
from lagrangian.read.letters import key

_BETWEEN = re.compile(r"~~(?=[^\s~])[^~\n]{1,1000}~~|<(?P<tag>s|del|strike)>[^<>\n]{1,1000}</(?P=tag)>", re.IGNORECASE)
_COMMAND = re.compile(r"\\(?:sout|xout)\s?\{")
_SAID = re.compile(
    r"(?:<-+|←|\(|\[|//|#|%|--|—|…|\.\.\.)[ \t]{0,4}(?:this )?(?:line |is )?"
    r"(?:(?:crossed|struck|scratched)[ -](?:out|through)|(?:durch)?gestrichen|verworfen"
    r"|(?:scrap|forget|ignore|discard)[ ](?:that|this)"
    r"|(?:wrong|incorrect|falsch)(?=[^\n]{0,40}?\b(?:below|corrected|unten|korrigiert)\b)[^\n)\]]{0,60}"
    r"|wrong|incorrect|falsch)[ \t]{0,4}(?=[!,;:.)\]\n]|\Z)",
    re.IGNORECASE,
)
"""A remark that begins with these words: the line is crossed out or taken back."""
_FIRST = r"(?:at first|first|initially|originally|previously|zuerst|zunächst|erst|ursprünglich|d'abord)"
_VERB = r"(?P<had>had|forgot)(?![ \t]to\b)|wrote|got|put|took|used"
_HAD = (
    rf"(?:(?:I|we)[ \t]++(?:had[ ])?{_FIRST}[ \t]++(?:{_VERB})"
    rf"|{_FIRST},?[ \t]++(?:I|we)[ \t]++(?:{_VERB.replace('had>', 'had_2>')})"
    rf"|(?P<had_3>(?:I|we)[ \t]++had[ \t]++{_FIRST}|{_FIRST}[ \t]++hatte[ \t]++ich|ich[ \t]++hatte[ \t]++{_FIRST}))\b"
)
_TAKEN_BACK = re.compile(
    rf"(?:(?<=[.!?;(][ \t])|(?<=\()|^[ \t]*+(?:[-*>][ \t]++)?)(?P<said>(?P<verb>{_HAD})"
    r"(?:[^\n;.!?:]|[.!?:](?!\s|\Z)){1,300}+)(?=[.!?;:](?:\s|\Z)|\n|\Z)",
    re.IGNORECASE | re.MULTILINE,
)
"""A sentence about what stood there before."""
_WRONG = re.compile(
    r"\b(?:wrong(?:ly)?|mistake|mistakenly|corrected|forgotten|forgetting"
    r"|falsch|vergessen|korrigiert|faux|oublié)\b",
    re.IGNORECASE,
)
"""Words that say that it was wrong."""
_NOT = re.compile(
    r"(?:\b(?:not|no|nothing|never|without|nicht|nichts|kein\w{0,2}|pas|rien|sans)|n['’]t)(?: \w{1,12}){0,2} \Z", re.I
)
"""Words in front of these that deny it: which is not wrong."""
_BUT = re.compile(r"\b(?:but|aber|mais)\b", re.IGNORECASE)
_NO_LONGER = re.compile(r"\b(?:originally|at first|ursprünglich)\b", re.IGNORECASE)
"""Words for what is so no longer; "first" may be the first step."""
_NAMED = re.compile(r"(?<![\w\\*])(\\?[^\W\d](?:\w|[{}*]){0,24}+)[ \t$&]{0,4}\Z")
_TWICE = re.compile(r"\\ddot[ ]?\{?(?P<in_latex>\\?\w{1,24})|(?P<name>\w{1,24}+)(?:''|’’|′′|″|\u0308(?![a-z]))")
"""An acceleration; the dots within a word are no rates: zählte."""
_WHY = re.compile(r"\b(?:because|since|weil|da|car)\b", re.IGNORECASE)
"""Words that say why it was there."""
_WORDS = ("crossed", "struck", "scratched", "gestrichen", "wrong", "incorrect", "falsch", "verworfen", " that", " this")
_BEFORE = ("first", "initially", "originally", "previously", "erst", "ursprünglich", "zunächst", "abord")
_MOST = 50
_OF_LINE = r"(?:[ ](?:to|of|in|for|on|zu|von|in|für|à|de)[ ](?:(?:the|my|der|die)[ ])?(?P<of>[\w()., -]{1,24}?))?"
_CORRECTS = re.compile(
    r"^[ \t]*+(?:[>#%-][ \t]++)?(?:\*(?=[^\s*])(?![^\n]*\S\*(?:[\s.,;:]|$))"
    r"|(?:(?:a|small|one)[ ])?"
    r"(?:correction|corrected|corrigend[au]m?|erratum|edit|update|typo|korrektur|korrigiert|berichtigung)\b"
    rf"{_OF_LINE}(?=[ ]?[:,.!–-]|[ \t]*\n|[ ])"
    r"|(?:(?:oh|ah|hmm+|oops|ups|whoops|sorry|pardon|wait|halt|nein|non|actually|i[ ]mean|i[ ]meant"
    r"|i[ ]mixed|scratch[ ]that|my[ ]mistake|that[ ](?:is|was)[ ]wrong|that's[ ]wrong|mistake|falsch|fehler"
    r"|no(?=[ ]?[,!–-]))\b[ ]?[,.:;!–-]+[ ]?){1,4})",
    re.IGNORECASE | re.MULTILINE,
)
"""The beginning of a line that states something anew."""
_STARRED = re.compile(r"^[ \t]*+\*(?=[^\s*])", re.MULTILINE)
_SIGN = re.compile(
    r"(?<![ \t&])[ \t&]*+(?:(?::=|=|:)(?![=>])"
    r"|(?<=[ ])(?P<said>(?:should|must|has[ ]to|ought[ ]to)[ ](?:be|read)|muss|müsste)(?=[ ]))"
)
_APART = re.compile(r"[,;:.!?(][ \t]|[;:]|\A|\b(?:it[ ]is|so|then|therefore|because|with|und|also|dann)[ ]")
_ENDS = re.compile(r";|\.(?=\s)|,(?=[ \t]+[^\s=,;:]{1,16}[ \t]*=)|\n|\Z")
_NO_HEAD = re.compile(
    r"\W*(?:(?:line|row|step|part|eq\w*|equation|zeile|schritt|gl\w*)\.?[ ]?[(\[]?(?:\d{1,3}|[ivx]{1,4}|[a-h])"
    r"|[(\[](?:\d{1,3}|[ivx]{1,4}|[a-h])|\d{1,3})\W*",
    re.IGNORECASE,
)
"""What is no name of a quantity: the number of a line."""
_IN_FORMULA = re.compile(r"[+−·]|\*(?!\Z)|[ ]-[ ]|\d[ ]?[^\W\d_(]|\A[^\w∂ℒ\\(|]|''|\A\W*\d|.{50}")
"""What stands in sides of equations, and in no name of a quantity."""


def without_crossed_out(written: TracedText, notes: dict[str, None]) -> TracedText:
    """Return an answer without what is crossed out; notes tell it."""
    again, fronts = _stated_anew(written.text)
    edits = [x for x in _edits(written.text) if not any(x[0] < b and a < x[1] for a, b, _ in (*again, *fronts))]
    edits = sorted([*edits, *again])
    for start, end, _ in edits:
        notes.setdefault(
            f"'{' '.join(written.text[start:end].split())}' was not judged: it is crossed out or taken back."
        )
    return written.edited([*edits, *fronts])


def _stated_anew(text: str) -> tuple[list[Edit], list[Edit]]:
    """What corrections take back, and the words of these in front of what they state anew."""
    gone: list[Edit] = []
    fronts: list[Edit] = []
    starred = len(_STARRED.findall(text)) > 1  # a list
    for match in islice(_CORRECTS.finditer(text), _MOST):
        if starred and match.group().endswith("*"):
            continue
        start, end = match.end(), line_end(text, match.end())
        found = _anew(text, match, start, end) if text[start:end].strip(" \t:.,-") else None
        if found is None and text[start:end].rstrip()[-1:] in ("", ":", ".") and end + 1 < len(text):
            found = _anew(text, match, end + 1, line_end(text, end + 1))
        if found is not None and not any(a <= found[0][0] < b for a, b, _ in (*gone, *fronts)):
            gone.append((*found[0], " "))
            fronts += found[1]
    return gone, fronts


def _anew(text: str, match: re.Match[str], start: int, end: int) -> tuple[tuple[int, int], list[Edit]] | None:
    """The statement above that a correction states anew, and what is left out of the correction and written in it."""
    above = list(_heads(text, 0, match.start()))
    for head, at, sign in _heads(text, start, end):
        same = [x for x in above if x[0] == head]
        if same:
            stop = _ENDS.search(text, same[-1][2].end())
            edits = [(match.start(), at, "")] if at > match.start() else []
            edits += [(*sign.span(), " = ")] if sign["said"] else []
            return (same[-1][1], stop.start() if stop is not None else len(text)), edits
    moving = _accelerating(text[start:end])
    lines = [(a, line_end(text, a)) for a in _starts(text, match.start())]
    alike = [x for x in lines if moving and "=" in text[slice(*x)] and _accelerating(text[slice(*x)]) == moving]
    of = re.search(r"\d{1,2}|\b[ivx]{1,4}\b|\b[a-h]\b", match["of"] or "")
    if of is not None:
        numbered = rf"[ \t]*(?:(?:line|eq\w*|equation|zeile|gl\w*)\.?[ ]?)?[(\[]?{of.group()}[)\].:]"
        alike = [x for x in alike if re.match(numbered, text[slice(*x)], re.IGNORECASE)]
    if len(alike) != 1 and not (of is None and alike and not text[alike[-1][1] : match.start()].strip()):
        return None
    front = re.match(r"[^=:\n]*:[ \t]", text[start:end])
    return alike[-1], [(match.start(), start + (front.end() if front is not None else 0), "")]


def _starts(text: str, end: int) -> Iterator[int]:
    """Where the lines above a place begin."""
    yield from (at for at in (0, *(m.end() for m in re.finditer(r"\n", text[:end]))) if at < end)


def _heads(text: str, start: int, end: int) -> Iterator[tuple[str, int, re.Match[str]]]:
    """The names in front of equals signs and colons, with the places where they begin, and these signs."""
    for sign in islice(_SIGN.finditer(text, start, end), 4 * _MOST):
        line = max(start, text.rfind("\n", 0, sign.start()) + 1, sign.start() - 80)
        piece = text[line : sign.start()]
        at = line + max((m.end() for m in _APART.finditer(piece)), default=0)
        head = " ".join(text[at : sign.start()].replace("$", "").replace("&", "").split())
        if head and _NO_HEAD.fullmatch(head) is None and _IN_FORMULA.search(head) is None:
            yield head, at, sign


def _edits(text: str) -> Iterator[Edit]:
    lines: list[tuple[int, int]] = []
    if any(word in text.lower() for word in _WORDS):
        said = [m.start() for m in _SAID.finditer(text)][:_MOST]
        lines = sorted({(text.rfind("\n", 0, k) + 1, line_end(text, k)) for k in said})
    if any(word in text.lower() for word in _BEFORE):
        taken = {_span(m) for m in islice(_TAKEN_BACK.finditer(text), _MOST) if "=" in m["said"] and _is_taken_back(m)}
        taken = {x for x in taken if not any(a <= x[0] < b for a, b in lines)}
        others = _others(text, [*lines, *taken])
        lines = sorted({*lines, *(x for x in taken if _is_stated(text[slice(*x)], others))})
    yield from ((*line, " ") for line in lines)
    for start, end in _marked(text):
        if not any(a <= start < b for a, b in lines):
            yield start, end, " "


def _span(match: re.Match[str]) -> tuple[int, int]:
    """Where a sentence begins and ends, without the bracket that closes what stands around it."""
    said = match["said"].rstrip(" \t")
    if said.endswith(")") and said.count(")") > said.count("("):
        said = said[:-1]
    return match.start("said"), match.start("said") + len(said)


def _is_taken_back(match: re.Match[str]) -> bool:
    """Whether a sentence about what stood there before says that it was wrong, or why it was there."""
    had = match["had"] or match["had_2"] or match["had_3"]
    said = match["said"]
    if any(
        _NOT.search(" ".join(said[max(0, m.start() - 60) : m.start()].split()) + " ") for m in _WRONG.finditer(said)
    ):
        return False
    if _NO_LONGER.search(match["verb"]) is not None and _BUT.search(said) is not None:
        return True
    return _WRONG.search(said) is not None or (had is not None and _WHY.search(said) is not None)


def _others(text: str, lines: list[tuple[int, int]]) -> list[str]:
    """The lines of an answer with an equals sign, without what is taken back."""
    ends = [0, *(x for span in sorted(lines) for x in span), len(text)]
    rest = "\n".join(text[a:b] for a, b in zip(ends[::2], ends[1::2], strict=True))
    return [line for line in rest.split("\n") if "=" in line]


def _is_stated(said: str, others: list[str]) -> bool:
    """Whether other lines state what a sentence states: the same name, or an equation with the same accelerations."""
    moving = _accelerating(said)
    if moving:
        return any(_accelerating(line) == moving for line in others)
    named = _NAMED.search(said.partition("=")[0])
    if named is None:
        return False
    again = re.compile(rf"(?<![\w\\]){re.escape(named[1])}[ \t$&]{{0,4}}=")
    return any(again.search(line) for line in others)


def _accelerating(text: str) -> frozenset[str]:
    """The names with two dots or primes in a text."""
    found = _TWICE.finditer(unicodedata.normalize("NFD", text))
    return frozenset(key((m["in_latex"] or m["name"]).lstrip("\\")) for m in found)


def _marked(text: str) -> Iterator[tuple[int, int]]:
    if "~~" in text or "<" in text:
        yield from (m.span() for m in _BETWEEN.finditer(text))
    elif "out" in text:
        end = 0
        for match in list(_COMMAND.finditer(text))[:_MOST]:
            if match.start() >= end:
                end = closing(text, match.end())
                yield match.start(), end
