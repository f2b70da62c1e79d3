r"""Writes sums over an index out, where an answer says over which numbers and uses the names with these numbers.

\sum_{i=1}^{3} m_i g \sin\beta         (m_1 g \sin\beta + m_2 g \sin\beta + m_3 g \sin\beta)
Σ_{i∈{2,3}} m_i (u'' − x'')             (m_2 (u'' − x'') + m_3 (u'' − x''))          also sum_{i=2}^3, Σ_i
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.traced_text import TracedText

MOST, MOST_TERMS, LONGEST = 40, 9, 600
"""The most sums of an answer, terms of one, and characters of a term."""

_LETTER = r"(?P<index>[ijkln])"
_SET = r"\\?\{(?P<set>[ ]?\d(?:[ ]?,(?:\\[,; ])?[ ]?\d){0,8}[ ]?)\\?\}"
_BELOW = rf"{_LETTER}[ ]?(?:=[ ]?(?P<first>\d)|(?:\\in|∈|=)[ ]?{_SET}|=[ ]?(?P<listed>\d(?:[ ]?,[ ]?\d){{1,8}}))[ ]?"
_SUM = re.compile(
    r"(?:\\sum(?![A-Za-z])|[∑Σ]|(?<![\w\\])sum)(?:\\(?:no)?limits)?[ ]?"
    rf"(?:_[ ]?(?:\{{[ ]?{_BELOW}\}}|\([ ]?{_BELOW.replace('?P<', '?P<b')}\))"
    r"(?:[ ]?\^[ ]?[{(]?[ ]?(?P<last>\d)[ ]?[)}]?)?"
    r"|\^[ ]?\{?(?P<above>\d)\}?[ ]?_[ ]?\{[ ]?(?P<letter>[ijkln])[ ]?=[ ]?(?P<from>\d)[ ]?\}"
    r"|_?(?P<bare>[ijklnᵢⱼ])(?![A-Za-z0-9_=]))"
)
_SIGN = re.compile(
    r"(?P<open>[(\[{])|(?P<close>[)\]}])|(?P<end>[=&\n$]|(?<!\\)[;,]|\\\\|\\[\])]|\\(?:end|text|quad|qquad)(?![A-Za-z]))"
    r"|(?P<sign>[-+−±])"
)
_SIZE = re.compile(r"\\(?:right|[bB]igg?[lrm]?)[ ]?\Z")
_OPERATOR = re.compile(r"(?:\A|[*/^·=(_])\s*\Z")
_INDEXED = r"(?P<stem>\\?[^\W\d_]+)(?:_\{{?[ ]?{0}[ ]?\}}?(?![A-Za-z0-9])|{1})"
_ALONE = r"(?<![\w\\]){0}(?![\w])|_(?:\{{[^{{}}]{{0,20}}?{0}[^A-Za-z]|\w{{0,8}}{0}(?![A-Za-z]))"
"""The letter of an index as a number, or in an index with other letters."""
_SMALL = {"i": "ᵢ", "j": "ⱼ"}


def with_sums_written_out(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer with such sums written out. Every name with a number is one of the system, as ``taken`` says,
    or gets a value in the answer: what else a sum adds up is not known."""
    if not any(x in written.text for x in ("\\sum", "∑", "Σ", "sum_")):
        return written
    for match in reversed(list(islice(_SUM.finditer(written.text), MOST))):
        if (made := _written_out(written.text, match, taken)) is not None:
            written = written.edited([made])
    return written


def _written_out(text: str, match: re.Match[str], taken: Callable[[str], bool]) -> tuple[int, int, str] | None:
    """The edit that writes one sum out."""
    index = match["index"] or match["bindex"] or match["letter"] or match["bare"]
    letter = {small: x for x, small in _SMALL.items()}.get(index, index)
    end = _end(text, match.end())
    term = text[match.end() : end].strip()
    form = re.compile(_INDEXED.format(letter, _SMALL.get(letter, "(?!)")))
    stems = {m["stem"] for m in form.finditer(term)}
    rest = form.sub("", term)
    if not stems or len(term) > LONGEST or re.search(_ALONE.format(letter), rest) is not None:
        return None
    given = [{k for k in range(1, MOST_TERMS + 1) if _is_given(f"{x}_{k}", text, taken)} for x in stems]
    numbers = _numbers(match)
    if numbers is None:
        numbers = sorted(given[0]) if all(x == given[0] for x in given) else []
    if not 0 < len(numbers) <= MOST_TERMS or any(not set(numbers) <= x for x in given):
        return None
    terms = [form.sub(lambda m, k=k: f"{m['stem']}_{k}", term) for k in numbers]
    return match.start(), end, f" ({' + '.join(terms)}) "


def _numbers(match: re.Match[str]) -> list[int] | None:
    """The numbers that the index takes; None if the sum does not say it."""
    if match["bare"]:
        return None
    listed = match["set"] or match["listed"] or match["bset"] or match["blisted"]
    if listed:
        return [int(x) for x in re.findall(r"\d", listed)]
    first, last = match["first"] or match["bfirst"] or match["from"], match["last"] or match["above"]
    return list(range(int(first), int(last) + 1)) if first and last else []


def _end(text: str, start: int) -> int:
    """Where the term behind a sum ends: at a sign, an equals sign or the end of the bracket that it stands in."""
    depth = 0
    for match in _SIGN.finditer(text, start, start + 2 * LONGEST):
        if match["open"] and not text.startswith("\\", match.start() - 1):
            depth += 1
        elif match["close"]:
            depth -= 1
            if depth < 0:
                size = _SIZE.search(text[start : match.start()])
                return match.start() if size is None else start + size.start()
        elif depth == 0 and (match["end"] or (match["sign"] and not _OPERATOR.search(text[start : match.start()]))):
            return match.start()
    return min(len(text), start + 2 * LONGEST)


def _is_given(name: str, text: str, taken: Callable[[str], bool]) -> bool:
    """Whether a name belongs to the system, or gets a value in the answer."""
    stem, _, number = name.lstrip("\\").rpartition("_")
    if taken(f"{stem}_{number}") or taken(f"{stem}{number}"):
        return True
    lowered = chr(ord("₀") + int(number))
    named = rf"{re.escape(stem)}(?:_?\{{?{number}\}}?|{lowered})"
    value = rf"(?<![A-Za-z]){named}[ \t]*&?[ \t]*:?(?:=(?![=>])|\\coloneqq)|=:[ ]?{named}"
    return re.search(value, text) is not None
