"""Reads lists of names that sentences in plain text give values, one behind the other, with words in front of these.

where m is the total mass m1 + m2, S stands for m2*a and I for J + m2*a^2      ; m = m1 + m2; S = m2*a; I = J + m2*a^2;

where s, c are sin(phi), cos(phi)                                              ; s = sin(phi); c = cos(phi);

The verb may be said once, and one name may be I; or it stands between as many names and values.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import islice, pairwise

from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.prose.words_or_mathematics import CHANGING
from lagrangian.check.reading.said.explained_names import is_formula
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

MOST = 60
"""The most names with a verb that are looked at."""
_HEAD = re.compile(
    r"(?:^[ \t]*+|(?<=[.,;:])[ \t]++|(?<![\w])(?=(?:here|where|with|and|hier|mit|wobei|und)[ \t]))"
    r"(?:(?:here|where|with|and|hier|mit|wobei|und)[ \t]++){0,2}"
    rf"(?P<new>{IDENT})[ \t]++"
    r"(?:(?P<verb>is[ \t]short[ \t]for|stands[ \t]for|steht[ \t]für)|(?P<for>for|für)"
    r"|(?:is|being|means|denotes|abbreviates|ist|bezeichnet))[ \t]++",
    re.MULTILINE | re.IGNORECASE,
)
"""A name and its verb."""
_END = re.compile(r"[;=\n]|\.(?=\s|\Z)|\Z")
_GROUP = re.compile(
    rf"(?<![\w*/^+−'’′-])(?P<new>{IDENT}(?:[ \t]*(?:,[ \t]*(?:and|und)|,|[ \t]and|[ \t]und|/)[ \t]*{IDENT}){{1,7}})"
    r"[ \t]++(?:are[ \t](?:short|abbreviations|symbols)[ \t]for|are|be|denote|mean|abbreviate"
    r"|stand[ \t]for|short[ \t]for|for|sind|seien|stehen[ \t]für|für)[ \t]++"
    r"(?P<values>[^\n;=]{3,300}?)[ \t]*(?:respectively[ \t]*)?(?:[;:\n]|\.(?=\s|\Z)|\Z)",
    re.IGNORECASE,
)
"""Several names, a verb, and the rest of the sentence."""
_JOINS = re.compile(r"[ \t]*(?:,[ \t]*(?:and|und)(?!\w)|[ \t](?:and|und)(?!\w)|,|/(?=[ \t]))[ \t]*|(?P<mark>[()])")
_WORDS = re.compile(r"(?:the|an?|its|our|das|die|der|dem)[ \t]++(?:[^\W\d_]{3,20}[ \t]++){1,4}", re.IGNORECASE)
"""What a value is, in front of it: the total mass."""


def with_listed_names(written: TracedText, taken: Callable[[str], bool], exact: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text in which the names of such lists are statements.

    ``taken`` says whether a name may be one of the system, ``exact`` whether the system spells one so.
    """
    text = written.text
    edits: list[Edit] = []
    for heads in _sentences(text):
        last = _END.search(text, heads[-1].end())
        end = len(text) if last is None else last.start()
        if len(heads) < 2 or text[end : end + 1] == "=":
            continue
        values = [_value(text, a.end(), b) for a, b in zip(heads, [*(x.start() for x in heads[1:]), end], strict=True)]
        pairs = list(zip(heads, values, strict=True))
        if all(_is_said(head["new"], text[slice(*value)], text, taken, exact) for head, value in pairs):
            ends = [*(x.start() for x in heads[1:]), values[-1][1]]
            for (head, (start, stop)), behind in zip(pairs, ends, strict=True):
                edits += [(head.start(), start, f"; {head['new']} = "), (stop, behind, ";")]
    for match in islice(_GROUP.finditer(text), MOST):
        names, parts = ([x for x, _ in _parted(match[part])] for part in ("new", "values"))
        if len(names) == len(parts) and all(
            _is_said(a, b, text, taken, exact) for a, b in zip(names, parts, strict=True)
        ):
            said = "; ".join(f"{a} = {b}" for a, b in zip(names, parts, strict=True))
            edits.append((match.start(), match.end("values"), f"; {said};"))
    return written.edited(apart(sorted(edits)))


def _parted(listed: str) -> Iterator[tuple[str, int]]:
    """The items of a list, which commas and "and" outside brackets part, and where each begins."""
    start = depth = 0
    for match in _JOINS.finditer(listed):
        if match["mark"]:
            depth += 1 if match["mark"] == "(" else -1
        elif depth == 0:
            yield listed[start : match.start()].strip(), start
            start = match.end()
    yield listed[start:].strip(), start


def _sentences(text: str) -> Iterator[list[re.Match[str]]]:
    """The names with their verbs in each sentence; one with "for" alone stands behind one that says "stands for"."""
    found = list(islice(_HEAD.finditer(text), MOST))
    heads = found[:1] if found and not found[0]["for"] else []
    for above, head in pairwise(found):
        ends = _END.search(text, above.end())
        goes_on = bool(heads) and heads[-1] is above and ends is not None and ends.start() >= head.start()
        spoken = not head["for"] or (goes_on and bool(above["verb"] or above["for"]))
        if heads and not (goes_on and spoken):
            yield heads
        heads = [*(heads if goes_on else []), head] if spoken else []
    if heads:
        yield heads


def _value(text: str, start: int, end: int) -> tuple[int, int]:
    """Where a value between two places begins and ends, without the words in front of it."""
    while end > start and text[end - 1] in " \t,":
        end -= 1
    words = _WORDS.match(text, start, end)
    spoken = words is not None and not any(x.lower() in CHANGING for x in words.group().split())
    return (words.end(), end) if words is not None and spoken else (start, end)


def _is_said(new: str, value: str, text: str, taken: Callable[[str], bool], exact: Callable[[str], bool]) -> bool:
    """Whether a name is none of the system, is used elsewhere, and its value is a formula without it."""
    whole = rf"(?<!\w){re.escape(new)}(?!\w)"
    own = not exact(new) and function_of(new) is None and re.search(whole, value) is None
    product = len(names := value.split()) > 1 and all(map(taken, names))
    return own and len(re.findall(whole, text)) > 1 and "," not in value and (product or is_formula(value, taken))
