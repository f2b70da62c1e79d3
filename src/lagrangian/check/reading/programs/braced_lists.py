r"""Reads products of matrices as Mathematica writes them, in lists between braces.

{{a, b}, {c, d}} . {x'', y''} == {f, g}           [a, b; c, d] * [x''; y''] == [f; g]
mm = {{a, b}, {c, d}}; mm . {x'', y''} == ff       mm = [a, b; c, d]; mm * [x''; y''] == ff
Thread[Dot[mm, qdd] == MatrixForm[ff]]             mm * qdd == ff
{x'', y''} == LinearSolve[mm, ff]                 mm * [x''; y''] == ff             also Inverse[mm] . ff
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.programs.session_lists import entries_in
from lagrangian.check.reading.programs.sessions import closes
from lagrangian.check.reading.traced_text import Edit, TracedText, apart, line_end

MOST, DEEPEST = 100, 6
"""The most lists and calls of an answer that are looked at, and how deep calls stand in each other."""

_MATRIX = re.compile(r"\{\s*\{[^{}=]{1,400}\}\s*,\s*\{")
_PRODUCT = re.compile(r"[}\]]\s*\.\s*[\w{(]|[\w)\]]\s*\.\s*\{|\b(?:Dot|Det)\[|\bLinearSolve\[|\bInverse\[")
_LIST = re.compile(r"(?<![\w^\]\\])(?<!_)\{(?![{}\s]*\})")
_RULE = re.compile(r"→|[=<>]")
_CALL = re.compile(rf"(?<![\w\\])(?P<name>{IDENT})\[")
_SHOWN = frozenset(["Thread", "MatrixForm", "Simplify", "FullSimplify", "Expand", "Normal"])
_DOT = re.compile(rf"(?:(?<=[)\]}}])|(?<![\w.'\d])(?P<before>{IDENT}))(?P<dot>\s*\.\s*)(?=[\[({{]|(?P<behind>{IDENT}))")
_NAMED = re.compile(rf"(?:^|(?<=[;\n]))[ \t]*(?P<name>{IDENT})[ \t]*=[ \t]*(?=\[)")
_SOLVED = re.compile(
    rf"^[ \t]*(?:{IDENT}[ \t]*=(?!=)[ \t]*)?"
    rf"(?P<left>\[[^=\n]{{1,400}}\]|{IDENT}['’′]{{0,2}}|\([^=\n]{{1,80}}\))[ \t]*={{1,2}}"
    r"[ \t]*(?P<by>LinearSolve|Inverse)\[",
    re.MULTILINE,
)
_TIMES = re.compile(r"\s*\.\s*(?=[\[\w])")


def with_braced_lists(written: TracedText) -> TracedText:
    """Return an answer in plain text in which such lists are matrices and columns, if one of them is a matrix, or a
    product of lists stands in it; a list of rules or of equations is none."""
    text = written.text
    if "{" not in text or "\\" in text or "$" in text or not (_MATRIX.search(text) or _PRODUCT.search(text)):
        return written
    if _PRODUCT.search(text) is None and re.search(r"[\w)]\s\.\s\w", text) is None:
        return written
    for _ in range(DEEPEST):
        shown = written.edited(_without_calls(written.text))
        if shown.text == written.text:
            break
        written = shown
    written = written.edited(apart(_lists(written.text)))
    written = written.edited(apart(_solved(written.text)))
    names = {m["name"] for m in islice(_NAMED.finditer(written.text), MOST)}

    def times(match: re.Match[str]) -> str:
        sides = (match["before"], match["behind"])
        listed = all(x is None or x in names for x in sides) and (" " in match["dot"] or None in sides)
        return f"{match['before'] or ''} * " if listed else match.group()

    return written.sub(_DOT, times)


def _without_calls(text: str) -> Iterator[Edit]:
    """The edits that take the innermost calls off what they show or thread, and that write Dot[a, b] as (a) . (b)."""
    for match in islice(_CALL.finditer(text), MOST):
        end = closes(text, match.end() - 1)
        if end < 0 or any(f"{x}[" in text[match.end() : end] for x in (*_SHOWN, "Dot")):
            continue
        spans = entries_in(text, match.end(), end)
        if match["name"] in _SHOWN and len(spans) == 1:
            yield match.start(), match.end(), ""
            yield end, end + 1, ""
        elif match["name"] == "Dot" and len(spans) == 2:
            (_, a), (b, _) = spans
            yield match.start(), match.end(), ""
            yield a, b, " . "
            yield end, end + 1, ""


def _lists(text: str) -> Iterator[Edit]:
    """The edits that write lists in braces with square brackets: rows of a matrix, and columns."""
    at = 0
    for match in islice(_LIST.finditer(text), MOST):
        if match.start() < at or _is_within_call(text, match.start()):
            continue
        end = closes(text, match.start())
        inside = text[match.end() : end]
        if end < 0 or _RULE.search(inside) is not None:
            continue
        rows = [text[a:b] for a, b in entries_in(text, match.end(), end)]
        nested = [row.startswith("{") and closes(row, 0) == len(row) - 1 for row in rows]
        if any(nested) and not all(nested):
            continue
        at = end + 1
        rows = (
            [", ".join(row[a:b] for a, b in entries_in(row, 1, len(row) - 1)) for row in rows] if all(nested) else rows
        )
        yield match.start(), end + 1, " ".join(f"[{'; '.join(rows)}]".split())


def _is_within_call(text: str, at: int) -> bool:
    """Whether a place is in square brackets of a function other than those that solve: D[x[t], {t, 2}]."""
    start = max(text.rfind("\n\n", 0, at), text.rfind(";", 0, at)) + 1
    stack = list[str]()
    for match in re.finditer(rf"(?P<name>{IDENT})?\[|\]", text[start:at]):
        if match.group() != "]":
            stack.append(match["name"] or "")
        elif stack:
            stack.pop()
    return any(x not in ("LinearSolve", "Inverse", "Det") for x in stack)


def _solved(text: str) -> Iterator[Edit]:
    """The edits that write q == LinearSolve[m, f] and q == Inverse[m] . f as m * q == f."""
    for match in islice(_SOLVED.finditer(text), MOST):
        end = closes(text, match.end() - 1)
        inside = [text[a:b] for a, b in entries_in(text, match.end(), end)] if end > 0 else []
        if match["by"] == "LinearSolve" and len(inside) == 2:
            yield match.start("left"), end + 1, f"{inside[0]} * {match['left']} == {inside[1]}"
        elif match["by"] == "Inverse" and end > 0 and (dot := _TIMES.match(text, end + 1)) is not None:
            of = text[match.end() : end].strip()
            factor = re.compile(IDENT).match(text, dot.end())
            last = closes(text, dot.end()) + 1 if factor is None else factor.end()
            behind = text[last : line_end(text, last)].strip(" \t;")
            if last > 0 and not behind:
                yield match.start("left"), last, f"{of} * {match['left']} == {text[dot.end() : last]}"
