"""LaTeX cut into statements: mathematics found among the words, environments opened, rows and their continuations."""

from __future__ import annotations

import re
from itertools import pairwise

from lagrangian.read.answers.latex_tokens import MATRICES
from lagrangian.read.answers.rows import MAX_STATEMENTS, Row, blank, incomplete, plain_words

_COMMENT = re.compile(r"(?<!\\)%.*")
_DISPLAYS = [
    "equation",
    "align",
    "gather",
    "multline",
    "eqnarray",
    "flalign",
    "alignat",
    "displaymath",
    "math",
    "dmath",
]
_MATH = re.compile(
    r"\$\$(?P<a>.*?)\$\$|(?<!\\)\$(?P<b>.*?)(?<!\\)\$|\\\[(?P<c>.*?)\\\]|\\\((?P<d>.*?)\\\)"
    rf"|\\begin\{{(?P<kind>(?:{'|'.join(_DISPLAYS)})\*?)\}}(?P<e>.*?)\\end\{{(?P=kind)\}}",
    re.DOTALL,
)
_WRAPPERS = [*_DISPLAYS, *["aligned", "alignedat", "gathered", "split", "subequations", "document", "center"]]
_WRAPPER = re.compile(rf"\\(?:begin|end)\{{(?:{'|'.join(_WRAPPERS)})\*?\}}(?:\[[tcb]\])?")
_NOTE = re.compile(r"\\(?:label|tag\*?|ref|eqref|intertext|hspace\*?|vspace\*?|color)\s*\{[^{}]{0,200}\}")
_BOXED = re.compile(r"\\(?:boxed|fbox|ensuremath)\s*\{")
_WORDS = re.compile(r"(?<![_^{])(?<![_^]\s)\\(?:text|textbf|textit|textrm|mbox|emph)\s*\{")
_SHORT = re.compile(r"\w{1,20}\Z")
_LINKS = frozenset(
    ["and", "where", "with", "so", "then", "for", "or", "hence", "thus", "therefore", "gives", "if", "when", "let"]
)
_MARK = re.compile(r"\\begin\{(\w+\*?)\}|\\end\{(\w+\*?)\}|\\\\(?:\s*\[[^\]\n]{0,20}\])?|\\[{}]|[{}]|\n")
_SPACE = r"(?:\s|&|~|\\[,;:! ]|\\q?quad(?![A-Za-z])|\{\s*\})*"
_NUMBER_BEFORE = re.compile(rf"{_SPACE}\(\s*\d{{1,3}}[a-z]?\s*\)(?={_SPACE}[^\s=+\-*/^])(?=.*=)", re.DOTALL)
_NUMBER_AFTER = re.compile(
    rf"(?:\\q?quad(?![A-Za-z])|&|~|\s\s|\\[,;: ])+{_SPACE}\(\s*(?:\d{{1,3}}[a-z]?|[ivx]{{1,4}})\s*\){_SPACE}\Z"
)
_ARROW = re.compile(rf"{_SPACE}\\(?:Rightarrow|implies|therefore|iff|Leftrightarrow|Longrightarrow|to|rightarrow)\b")
_TAIL = re.compile(rf"(?:[.,;]|\\[,;]){_SPACE}\Z")
_INDENTED = re.compile(r"\s*&?\s*(?:\\q?quad(?![A-Za-z])|\{\s*\})")
_STARTS = re.compile(rf"{_SPACE}(?:[+*/=·×)\]^]|\\(?:cdot|times|right)(?![A-Za-z]))")
_MINUS = re.compile(rf"{_SPACE}[-−–]")
_CUT = re.compile(r"[,;](?!\w)|\\q?quad(?![A-Za-z])|\x00")


def latex_rows(text: str) -> list[Row]:
    """Return the statements of an answer in LaTeX; words around the mathematics are left out."""
    text = _COMMENT.sub(lambda m: " " * len(m.group()), text)
    found = [m for m in _MATH.finditer(text) if "=" in m.group()] or list(_MATH.finditer(text))
    if not found:
        return _statements(text, 0, lines=True)
    rows: list[Row] = []
    for match in found:
        group = next(g for g in "abcde" if match[g] is not None)
        if len(rows) > MAX_STATEMENTS:
            break
        rows += _statements(match[group], match.start(group), lines=False)
    return rows


def _statements(text: str, start: int, *, lines: bool) -> list[Row]:
    """The statements of one piece of mathematics; ``lines``: a line's end may end a statement."""
    for form in (_WRAPPER, _NOTE):
        text = form.sub(lambda m: " " * len(m.group()), text)
    text = _without_words(_unboxed(text))
    rows: list[Row] = []
    for at, piece, hard in _cut(text, lines):
        kept = _labels(piece)
        if not _content(kept):
            continue
        if rows and (previous := rows[-1]) and _continues(previous.text, piece, hard):
            gap = at + start - previous.start - len(previous.text)
            rows[-1] = Row(previous.start, previous.text + " " * gap + kept)
        elif not plain_words(kept):
            rows.append(Row(at + start, kept))
    return [part for row in rows for part in _parts(_tidy(row))]


def _without_words(text: str) -> str:
    """Replace words by a mark and spaces; a short word that may be a name stays."""
    at = 0
    while (match := _WORDS.search(text, at)) is not None:
        end = _closing(text, match.end())
        words = text[match.end() : end - 1].strip()
        if not _SHORT.match(words) or words.lower() in _LINKS:
            text = blank(text, match.start(), end)
            text = text[: match.start()] + "\x00" + text[match.start() + 1 :]
        at = end
    return text


def _unboxed(text: str) -> str:
    r"""Blank out ``\boxed{`` and the brace that closes it."""
    while (match := _BOXED.search(text)) is not None:
        end = _closing(text, match.end())
        text = blank(blank(text, end - 1, end), match.start(), match.end())
    return text


def _closing(text: str, start: int) -> int:
    """Where the brace that was opened before ``start`` has closed."""
    depth, at = 1, start
    while at < len(text) and depth:
        if text[at] == "\\":
            at += 1
        else:
            depth += {"{": 1, "}": -1}.get(text[at], 0)
        at += 1
    return at


def _cut(text: str, lines: bool) -> list[tuple[int, str, bool]]:
    """Pieces between row separators outside braces and matrices, whether each begins after an explicit one."""
    cuts: list[tuple[int, int, bool]] = [(0, 0, True)]
    depth = matrices = 0
    for match in _MARK.finditer(text):
        mark = match.group()
        if mark in ("{", "}"):
            depth += 1 if mark == "{" else -1
        elif match[1] or match[2]:
            matrices += 1 if match[1] else -1
        elif depth <= 0 and matrices <= 0 and (mark.startswith("\\\\") or (lines and mark == "\n")):
            cuts.append((match.start(), match.end(), mark != "\n"))
    cuts.append((len(text), len(text), True))
    return [(a[1], text[a[1] : b[0]], a[2]) for a, b in pairwise(cuts)]


def _labels(piece: str) -> str:
    """Blank out arrows, and numbers of equations before and behind."""
    for form in (_ARROW, _NUMBER_BEFORE):
        if match := form.match(piece):
            piece = blank(piece, 0, match.end())
    if match := _NUMBER_AFTER.search(piece):
        piece = blank(piece, match.start(), len(piece))
    return piece


def _content(piece: str) -> str:
    return re.sub(_SPACE, "", piece).replace("\x00", "").strip(".,;")


def _continues(before: str, piece: str, hard: bool) -> bool:
    """Whether a row goes on with the one before it."""
    if _STARTS.match(piece) or (hard and _INDENTED.match(piece)) or incomplete(before.replace("&", " ").rstrip("\\ ,")):
        return True
    return bool(_MINUS.match(piece)) and (("=" in before) != ("=" in piece))


def _tidy(row: Row) -> Row:
    text = row.text.replace("&", " ") if not any(f"{{{m}}}" in row.text for m in MATRICES) else _outer(row.text)
    while match := _TAIL.search(text):
        text = blank(text, match.start(), len(text))
    return Row(row.start, text)


def _outer(text: str) -> str:
    """Blank out the & that align rows, not those of matrices."""
    matrices, letters = 0, list(text)
    for match in re.finditer(r"\\begin|\\end|&", text):
        if match.group() == "&":
            if matrices <= 0:
                letters[match.start()] = " "
        else:
            matrices += 1 if match.group() == "\\begin" else -1
    return "".join(letters)


def _parts(row: Row) -> list[Row]:
    """Split a row at commas, wide spaces and words outside brackets, where every piece states something."""
    if any("\x00" in side and not _content(side) for side in row.text.split("=")):
        return []  # one side is words: a remark
    depth, cuts = 0, [(0, 0)]
    for match in re.finditer(rf"[(\[{{}}\])]|\\begin|\\end|{_CUT.pattern}", row.text):
        mark = match.group()
        if mark in "([{" or mark == "\\begin":
            depth += 1
        elif mark in ")]}" or mark == "\\end":
            depth -= 1
        elif depth <= 0:
            cuts.append((match.start(), match.end()))
    cuts.append((len(row.text), len(row.text)))
    pieces = [(a[1], row.text[a[1] : b[0]]) for a, b in pairwise(cuts)]
    pieces = [(at, piece) for at, piece in pieces if _content(piece)]
    if all("=" in piece for _, piece in pieces):
        return [Row(row.start + at, piece) for at, piece in pieces]
    return [Row(row.start, row.text.replace("\x00", " "))]
