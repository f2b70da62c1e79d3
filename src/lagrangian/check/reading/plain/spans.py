"""Finds the statements in a line of plain text that cannot be parsed as a whole, whatever stands around them.

The line is cut where no expression can go on: at words, at points and commas outside brackets, and at brackets that
hold words or an equals sign. What remains are runs of names, numbers and operators. Those with an equals sign are the
statements; all others are mentioned in passing: Eliminating x'' gives s'' (M + m) = F, which …

Nothing is left out that may belong to a statement: no run with an operator at its end, where a word stands for a term,
and no word that changes a value, such as twice.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from lagrangian.check.reading.plain.tokens import TOKEN
from lagrangian.check.reading.prose.conditions import gives_constant
from lagrangian.check.reading.prose.words import Words, function_of
from lagrangian.check.reading.prose.words_or_mathematics import ADDING, ARTICLES, LINKING, moves
from lagrangian.records import dataclass

MOST = 400
"""The largest number of tokens in a line that is looked at."""

CONDITIONS = frozenset(
    [
        "if",
        "when",
        "whenever",
        "for",
        "at",
        "unless",
        "assuming",
        "provided",
        "wenn",
        "falls",
        "für",
        "bei",
        "sofern",
        "si",
        "pour",
        "quand",
        "lorsque",
        "cuando",
    ]
)
"""Words that make what follows them a condition."""

_SIDE_BY_SIDE = re.compile(r"[\w(\[]")
_WHOLE = frozenset(["name", "primes", "number", "raised", "fraction", ")", "]"])
_OPERATOR = re.compile(r"[-+*/^·×−–]")
_SHORTEST = 3
_COUNTED = re.compile(r"\s*+\w{1,2}\s*+=\s*+\d\s*+\Z")
_CALLS = frozenset(["Eq", "Equality", "Equal", "diff", "Derivative", "D", "piecewise", "Piecewise"])


@dataclass(frozen=True, slots=True)
class MathSpan:
    """A run of mathematics from ``start`` to ``end``, whether it has an equals sign, and the word in front of it."""

    start: int
    end: int
    stated: bool
    word: str

    @property
    def conditional(self) -> bool:
        """Whether it says only when something holds."""
        return self.word.lower() in CONDITIONS


@dataclass(frozen=True, slots=True)
class _Token:
    kind: str
    text: str
    start: int
    end: int


def spans(text: str, words: Words) -> list[MathSpan]:
    """Return the runs of mathematics in a text, in their order."""
    tokens = _tokens(text, words)
    return list(_runs(tokens, _partners(tokens), 0, len(tokens), words)) if len(tokens) <= MOST else []


def statements(text: str, words: Words) -> list[MathSpan]:
    """Return the statements in a text that cannot be parsed as a whole; empty if something else may belong to them."""
    found = spans(text, words)
    rest = _rest(text, found)
    if not found or any(x.lower() in ADDING for x in re.findall(r"[^\W\d_]+", rest)):
        return []
    for span in found:
        first, last = text[span.start : span.end].lstrip()[:1], text[span.start : span.end].rstrip()[-1:]
        if first in "*/^·×" or last in "+-−–*/^·×=":
            return []
        inside = text[span.start : span.end]
        if not span.stated and len(inside) > 1 and (first in "+-−–" or (moves(inside) and _OPERATOR.search(inside))):
            return []
    stated = [x for x in found if x.stated and (not x.conditional or gives_constant(text[x.start : x.end], words))]
    if any(_belongs(text, left, right) for left, right in pairwise(found)):
        return []
    if not all(_is_apart(text, x, words) for x in stated):
        return []
    return [x for x in stated if not (_COUNTED.match(text[x.start : x.end]) and text[x.end :].lstrip()[:1] == ",")]


def _belongs(text: str, left: MathSpan, right: MathSpan) -> bool:
    """Whether one of two runs next to each other is no statement, and no word says that it is only mentioned, as in
    m x'' = 1, 5 b; the number of an equation is."""
    passing = left if not left.stated else right
    if left.stated == right.stated or _MARK.fullmatch(text[passing.start : passing.end]):
        return False
    beyond = text[passing.end :] if passing is right else text[: passing.start]
    said = _WORD_NEXT.match(beyond) if passing is right else _WORD_LAST.search(beyond[-30:])
    between = text[left.end : right.start]
    ended = passing is left and _SENTENCE_END.match(between) and not _OPERATOR.search(text[left.start : left.end])
    explained = passing is left and between.strip() == "," and _explains(text[right.start : right.end], left, text)
    return said is None and not ended and not explained and not re.search(r"[^\W\d_]", between)


def _explains(stated: str, left: MathSpan, text: str) -> bool:
    """Whether a statement says what a name is that stands in what is mentioned before it: m u², u = a d sin θ / l."""
    named = _NAME_ALONE.match(stated)
    names = re.findall(r"[^\W\d_][^\W²³]*", text[left.start : left.end])
    return named is not None and named[0][:-1].strip() in names


_SENTENCE_END = re.compile(r"[.!?]\s")
_MARK = re.compile(r"\s*[(\[]?\d{1,2}[a-z]?[)\]]?\s*")
_WORD_NEXT, _WORD_LAST = re.compile(r"[ \t]*[^\W\d_]{2}"), re.compile(r"[^\W\d_]{2}[ \t]*\Z")
_BEFORE = re.compile(r"(?:(?P<above>[^\W\d_]+)[ \t]+)?(?P<word>[^\W\d_]+)[ \t]*\Z")
_BEHIND = re.compile(r"[ \t]*(?P<word>[^\W\d_]+)(?:[ \t]+(?P<below>[^\W\d_]{2,}))?")
_NAME_ALONE = re.compile(r"\s*+[^\W\d]\w*+['’′″]*+\s*+=")


def _is_apart(text: str, span: MathSpan, words: Words) -> bool:
    """Whether no word beside a statement may be a factor of it: none touches it, or it is common or one of several."""
    before, behind = _BEFORE.search(text[max(0, span.start - 60) : span.start]), _BEHIND.match(text, span.end)
    inside = text[span.start : span.end]
    if before is not None and before["above"] is None and not _NAME_ALONE.match(inside) and not _common(before, words):
        return False
    return behind is None or behind["below"] is not None or _common(behind, words)


def _common(found: re.Match[str], words: Words) -> bool:
    return found["word"].lower() in LINKING and not words.is_name(found["word"])


def _rest(text: str, found: Sequence[MathSpan]) -> str:
    """What stands outside all runs."""
    for span in reversed(found):
        text = f"{text[: span.start]} {text[span.end :]}"
    return text


def _tokens(text: str, words: Words) -> list[_Token]:
    """The tokens of a text; a word has the kind "word", a letter that is an article, too."""
    found: list[_Token] = []
    for match in TOKEN.finditer(text):
        kind = str(match.lastgroup)
        if kind == "space":
            if "\n" in match.group() and _SIDE_BY_SIDE.match(text, match.end()):
                found.append(_Token("newline", "\n", match.start(), match.end()))
            continue
        if kind == "name" and _is_word(match.group(), words):
            kind = "word"
        elif kind == "name" and match.group() in ("a", "I") and not words.known(match.group()):
            after = text[match.end() :]
            kind = "word" if re.match(r"[ \t]+[^\W\d_]", after) else kind
        elif kind == "minus" and found and found[-1].kind == "word" and found[-1].end == match.start():
            kind = "word"  # right-hand
        elif kind == "bracket":
            kind = match.group()
        start = match.start()
        if match.group() == "°" and found and found[-1].kind == "number":
            kind, start = "number", found.pop().start
        found.append(_Token(kind, text[start : match.end()], start, match.end()))
    return found


def _is_word(written: str, words: Words) -> bool:
    """Whether this is a word of a sentence: no name, no function and no product of names."""
    if words.is_name(written) or function_of(written) is not None or written in _CALLS:
        return False
    if written in ARTICLES and words.is_used(written):
        return False
    if written.lower() in LINKING and len(written) > 1 and not words.is_product(written):
        return True
    bare = re.sub(r"[\W\d_]", "", written)
    return len(bare) >= _SHORTEST and bare == written and not words.readable(written) and not words.is_product(written)


def _partners(tokens: Sequence[_Token]) -> dict[int, int]:
    """The place of the bracket that closes each bracket."""
    stack: list[int] = []
    found: dict[int, int] = {}
    pairs = {"(": ")", "[": "]", "{": "}"}
    for i, token in enumerate(tokens):
        if token.kind in pairs:
            stack.append(i)
        elif token.kind in pairs.values():
            if stack and pairs[tokens[stack[-1]].kind] == token.kind:
                found[stack.pop()] = i
            else:
                stack.clear()
    return found


def _runs(tokens: Sequence[_Token], partners: dict[int, int], i: int, end: int, words: Words) -> Iterator[MathSpan]:
    """The runs between two places, those in brackets that end a run included."""
    run: list[_Token] = []
    word = ""

    def made() -> Iterator[MathSpan]:
        if run:
            yield MathSpan(run[0].start, run[-1].end, any(x.kind == "eq" for x in run), word)
            run.clear()

    while i < end:
        token = tokens[i]
        last = partners.get(i)
        if last is not None and _is_closed(tokens, i, last, words):
            run += tokens[i : last + 1]
            i = last + 1
            continue
        if last is not None:
            yield from made()
            yield from _runs(tokens, partners, i + 1, last, words)
            i = last + 1
            continue
        if token.kind == "newline" and run and run[-1].kind in _WHOLE:
            yield from made()
        ends = token.kind in ("word", "other", "relation", ",", ";", "(", "[", "{", ")", "]", "}", "sym")
        if ends:
            yield from made()
            word = token.text if token.kind == "word" else "" if token.kind == ";" else word
        elif token.kind != "newline":
            run.append(token)
        i += 1
    yield from made()


def _is_closed(tokens: Sequence[_Token], i: int, last: int, words: Words) -> bool:
    """Whether a bracket is part of an expression: it holds no words and no equals sign, or is that of a call."""
    before = tokens[i - 1].text if i else ""
    if before in _CALLS or (tokens[i].kind == "[" and any(x.kind == "[" for x in tokens[i + 1 : last])):
        return True
    inside = tokens[i + 1 : last]
    return bool(inside) and not any(x.kind in ("word", "eq", "other") for x in inside)
