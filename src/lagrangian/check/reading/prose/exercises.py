"""Takes the numbers of exercises off statements: Exercise 3 c)   m x'' = …, Sheet 2, problem 4 (ii): T = …, 3 c) V = …

What stands behind the words is a number or a letter with a bracket, a colon, a stop, a stroke or a gap, so that "2 (b)"
is no factor. A bracket that nothing opens in front of a statement belongs to such a number.
"""

from __future__ import annotations

import re

from lagrangian.check.reading.prose.words import Words

_KINDS = (
    "exercise exercice ejercicio esercizio exc ex problem problema prob question task aufgabe aufg teilaufgabe übung "
    "übungsaufgabe frage part teil sheet blatt übungsblatt serie homework hw assignment hausaufgabe no nr number "
    "nummer solution solutions lösung answer antwort item punkt"
)
_WORDS_OF_EXERCISES = frozenset(_KINDS.split())
_BETWEEN = frozenset(["to", "of", "for", "zu", "von", "der", "the", "and", "und", "für"])
"""Words between two of them: solution to exercise 3."""
MOST = 8
"""The most parts of one number, and the most characters between them and the statement."""

_WORD = re.compile(r"[ \t]*+(?P<word>[^\W\d_]{2,16}+)\.?(?=[ \t\d(])")
_PART = re.compile(
    r"[ \t]*+(?:(?P<open>[(\[])[ ]?)?(?:\d{1,3}(?:\.\d{1,3}){0,2}[a-h]?|[a-h]|[ivx]{1,4}|[IVX]{1,4}|[A-Z]\d{1,2})"
    r"(?![\w'’′^*])(?P<close>[ ]?[)\]])?"
)
_STROKE = re.compile(r"[ \t]*[,/]|[ \t]*:|\.(?=[ \t])|[ \t]+[-–—](?=[ \t])")
_END = re.compile(r"[ \t]{2,}|\t")
_NEXT = re.compile(r"[ \t]*+(?![=*/^+)\]'’′<>]|[-–—−]\s)\S")
_NUMBER_AND_LETTER = re.compile(r"[ \t]*+\d{1,2}\.?[ \t][a-h][ ]?\)[.:]?(?=[ \t]+[^\s=*/^+)\]<>-])")


def without_exercises(text: str, words: Words) -> str:
    """Return an answer in plain text in which the numbers of exercises in front of statements are blank."""
    lines = text.split("\n")
    for k, line in enumerate(lines):
        end = _end_of_number(line, words)
        if not end and not _is_open(lines[k - 1] if k else ""):
            bare = _NUMBER_AND_LETTER.match(line)
            end = bare.end() if bare is not None else 0
        if end:
            lines[k] = " " * end + line[end:]
    return "\n".join(lines)


def _is_open(above: str) -> bool:
    """Whether a line goes on below: it has an open bracket, or ends with a sign."""
    return above.count("(") > above.count(")") or above.rstrip()[-1:] in tuple("-+−*/·=(")


def _end_of_number(line: str, words: Words) -> int:
    """Where the statement behind the number of an exercise begins; 0 if none stands in front."""
    at, kinds, numbers, ended, end = 0, 0, 0, False, 0
    for _ in range(MOST):
        if (word := _WORD.match(line, at)) is not None and _is_of_exercises(word["word"], words, first=not kinds):
            kinds, at, ended = kinds + 1, word.end(), False
        elif kinds and (part := _PART.match(line, at)) is not None and bool(part["open"]) <= bool(part["close"]):
            if numbers and not part["close"] and (ended or not part.group().strip()[:1].isalpha()):
                break  # Exercise 3: 2 m x'' = F, Exercise 3: I phi'' = M
            numbers, at, ended = numbers + 1, part.end(), bool(part["close"])
        elif numbers and (stroke := _STROKE.match(line, at)) is not None:
            at, ended = stroke.end(), True
        else:
            break
        if numbers and (ended or _END.match(line, at) is not None) and _NEXT.match(line, at) is not None:
            end = at
    return end


def _is_of_exercises(word: str, words: Words, *, first: bool) -> bool:
    """Whether a word calls an exercise or a part of one, or joins such words, and is no name of the system."""
    called = word.lower() in _WORDS_OF_EXERCISES or (not first and word.lower() in _BETWEEN)
    return called and not words.is_name(word)
