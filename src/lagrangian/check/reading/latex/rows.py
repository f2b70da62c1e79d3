"""Splits LaTeX into statements: finds mathematics among words, opens environments, joins rows that continue."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from lagrangian.check.reading.labels import DIRECTIONS
from lagrangian.check.reading.latex.layout import (
    closing,
    remark_end,
    with_displays_joined,
    without_braces,
    without_brackets_around,
    without_end_marks,
    without_gap,
    without_units,
)
from lagrangian.check.reading.latex.tokens import SYMMETRIC
from lagrangian.check.reading.markup import blank
from lagrangian.check.reading.name_patterns import OF_CHAPTER
from lagrangian.check.reading.plain.ends import incomplete
from lagrangian.check.reading.plain.rows import MAX_STATEMENTS, AnswerRow, plain_words
from lagrangian.check.reading.prose.conditions import IF
from lagrangian.check.reading.prose.directions import is_direction
from lagrangian.check.reading.traced_text import line_end

_COMMENT = re.compile(r"(?<!\\)%.*")
_BEHIND = re.compile(r"(?:\s|\\[,;:!]|&)*+(?:[,.;]|\\\\|\\q?quad|\\end|\\\]|\$|\Z)")
"""What stands behind a word of a direction that is no factor."""
_DISPLAYS = "equation|align|gather|multline|eqnarray|flalign|alignat|displaymath|math|dmath"
_OPENING = re.compile(rf"(?<!\\)\$\$?|\\\[|\\\(|\\begin\{{(?P<kind>(?:{_DISPLAYS})\*?)\}}")
_CLOSING = {"$": "$", "$$": "$$", "\\[": "\\]", "\\(": "\\)"}
_WRAPPERS = rf"{_DISPLAYS}|aligned|alignedat|gathered|split|subequations|document|center"
_THIN = r"(?:\s|~|\\[,;:!> ]|\\q?quad(?![A-Za-z])|\{\s?\})*+"
"""Space between a large bracket and what stands in it."""
_WRAPPER = re.compile(
    rf"(?:\\left\s*(?:\\\{{|\\lbrace|\.|\[){_THIN})?\\begin\{{(?:{_WRAPPERS})\*?\}}(?:\[[tcb]\])?"
    rf"|\\end\{{(?:{_WRAPPERS})\*?\}}(?:{_THIN}\\right\s*(?:\.|\\\}}|\\rbrace|\]))?"
)
_SYSTEM = re.compile(
    rf"(?:\\left\s*(?:\\\{{|\\lbrace|\.){_THIN})?"
    r"\\begin\{(?P<kind>array|cases|dcases)\}(?:\s*\{[lcr|@{}\s]{0,40}\})?"
    r"(?P<rows>(?:(?!\\begin|\\end)[^=])*=(?:(?!\\begin\{(?P=kind)\}).)*?)\\end\{(?P=kind)\}"
    rf"(?:{_THIN}\\right\s*(?:\.|\\\}}|\\rbrace))?",
    re.DOTALL,
)
_NOTE = re.compile(r"\\(?:label|tag\*?|ref|eqref|intertext|hspace\*?|vspace\*?|color)\s*\{[^{}]{0,200}\}")
_STYLE = re.compile(r"\\(?:display|text|script)style(?![A-Za-z])")
_UPRIGHT_NUMBER = re.compile(r"\\(?:mathrm|mathbf|text|textbf|textrm|rm)\s*\{\s*\(\s*\w{1,4}\s*\)\s*\}")
_BOXED = re.compile(
    r"\\(?:A?boxed|fbox|tcbhighmath|tcboxmath|ensuremath|(?:underline|uu?line)(?!\s*\{\s*\\?\w{1,20}\s*\}))\s*\{"
)
"""What stands around a result; a line below one name is a part of the name."""
_WORDS = re.compile(r"(?<![_^{])(?<![_^]\s)\\(?:text|textbf|textit|textrm|mbox|emph)\s*\{")
_SHORT = re.compile(r"\w{1,20}\Z")
_LINKS = frozenset(
    ["and", "where", "with", "so", "then", "for", "or", "hence", "thus", "therefore", "gives", "if", "when", "let"]
)
_BRACKETED = re.compile(
    r"(?<=[\w})\]'’′])(?:\s|~|&|\\[,;:! ]|\\q?quad(?![A-Za-z])|\{\s?\})++[(\[][\s.,;:!~]*+\x00[\s\x00.,;:!~]*+[)\]]"
    r"(?=(?:\s|~|&|\\[,;:! ])*+(?:[.,;]|\\\\|\\q?quad(?![A-Za-z])|\\end|\Z))"
)
r"""Words in brackets behind a statement: \Theta = J + m s^2 \quad (\text{about the hinge})"""
_LISTS = re.compile(r"\\(?:operatorname|mathrm)\{(?:atan2|min|max)\}|\\(?:min|max)(?![A-Za-z])|atan2")
_SYMMETRIC = frozenset(["sym", "symm", "symmetric"])
_MARK = re.compile(r"\\begin\{(\w+\*?)\}|\\end\{(\w+\*?)\}|\\\\(?:\s*\[[^\]\n]{0,20}\])?|\\[{}]|[{}]|\n")
_SPACE = r"(?:\s|&|~|\\[,;:! ]|\\q?quad(?![A-Za-z])|\{\s*\})*"
_NUMBER_BEFORE = re.compile(
    rf"{_SPACE}\(\s*(?:\d{{1,3}}[a-z]?|{OF_CHAPTER})\s*\)(?={_SPACE}[^\s=+\-*/^])(?=.*=)", re.DOTALL
)
_LETTER_BEFORE = re.compile(
    rf"{_SPACE}(?:(?:[^\W\d_]{{2,12}}\.?\s+){{0,2}}(?:\d{{1,3}}[a-z]?|[a-h]|[ivx]{{1,4}})\s?\)[.:]?|\((?:i{{2,3}}|i?v|vi{{1,3}})\))"
    rf"(?={_SPACE}[^\s=+*/^])(?=.*=)",
    re.DOTALL,
)
"""A letter or a number with a bracket that nothing opens, perhaps after a word, and Roman numbers: ad a), (ii)."""
_NAME_BEFORE = re.compile(
    rf"{_SPACE}(?:(?:eqn?\.?|equation|gl\.?|gleichung)[ ](?:(?:for|of|in|für|von)[ ])?)?(?:\\delta\s*+)?"
    r"(?:\\[A-Za-z]{2,12}|[^\W\d_])(?:\s?_\s?(?:\w|\{\w{1,8}\}))?"
    rf"(?:['’′]{{1,2}}|\^\s?\{{?\s?\\prime\s?\}}?)?(?:[- ]?(?:{DIRECTIONS})\b\.?)?\s*:(?={_SPACE}[^\s=])(?=.*=)",
    re.DOTALL | re.IGNORECASE,
)
"""The name of the coordinate or axis whose equation follows: x: &\\quad m\\ddot x = F, \\phi-equation: …, y': …"""
_TAGGED = r"\(\s*(?:\\[A-Za-z]{2,12}|[^\W\d_])(?:\s?_\s?(?:\w|\\[A-Za-z]{2,12}|\{\s?\\?\w{1,8}\s?\}))?['’′]*\s*\)"
_WORDS_BEFORE = re.compile(rf"{_SPACE}\x00(?:\s|~|\(\s*\w{{1,4}}\s*\))*:(?={_SPACE}[^\s=])(?=.*=)", re.DOTALL)
r"""Words and a colon: \text{Moments about A}: J \ddot\theta = …"""
_TAG_BEFORE = re.compile(
    rf"{_SPACE}{_TAGGED}(?:\s*[-+]\s*{_TAGGED}){{0,4}}\s*(?:&|\\q?quad(?![A-Za-z]))(?={_SPACE}[^\s=+*/^])(?=.*=)",
    re.DOTALL,
)
"""The name of an equation in brackets, or of those that were added, apart from it: (E_x)+(E_u)\\quad& …"""
_PIECE = re.compile(r"(?:\s|&|~|\x00|\\[,;:! ]|\\q?quad(?![A-Za-z])|\{\s*\})|(?P<content>.)", re.DOTALL)
_NUMBER = re.compile(rf"\(\s*(?:\d{{1,3}}[a-z]?|[ivx]{{1,4}}|\*{{1,3}}|[†‡]|{OF_CHAPTER})\s*\)\Z")
_GAP = re.compile(r"(?:\\q?quad|&|~|\s\s|\\[,;: ])\s*\Z")
_FAR = re.compile(r"(?:&|\\q?quad)(?:\s|~|&|\\[,;:! ]|\\q?quad(?![A-Za-z]))*+\Z")
_ROW_END = re.compile(r"(?:\s|~|\\[,;:! ]|[.,;])*+(?:\\\\|\\end\{|\\\]|\$|\Z)")
_BOUND = re.compile(
    r"(?:[<>≤≥≠]|\\(?:[gl]eq?|[gl]t|neq?)(?![A-Za-z])|\\not\s?=)(?:\s|\\[,;:! ])*+0(?=(?:\s|~|\\[,;:! ]|[.,;])*+\Z)"
)
"""What a definition is not: D = J + m r^2 > 0."""
_ARROWS = (
    r"\\(?:Rightarrow|implies|therefore|iff|Leftrightarrow|Longrightarrow|Longleftrightarrow|longrightarrow|to|rightarrow"
    r"|leadsto|Leftarrow|because|land)(?![A-Za-z])|[⇒⟹⇔⟺→⟶∴]|<?=>"
)
_ARROW = re.compile(rf"{_SPACE}(?:{_ARROWS})")
_EQUALS = re.compile(r"\\(?:coloneqq|triangleq|equiv|stackrel\{!\}\{=\}|eqdef)(?![A-Za-z])|:=")
_INDENTED = re.compile(r"\s*&?\s*(?:\\q?quad(?![A-Za-z])|\{\s*\})")
_STARTS = re.compile(rf"{_SPACE}(?:[+*/=·×)\]^]|\\(?:cdot|times|right)(?![A-Za-z]))")
_BLANK = re.compile(r"\n[ \t]*+\n")
_MINUS = re.compile(rf"{_SPACE}[-−–]")
_AT_MARK = re.compile(
    r"(?P<mark>\s*+&)\s*+[-−–](?=[^&=]*\\delta(?![A-Za-z]))[^&=]*+=(?:\s|\\[,;:! ])*+0\s*+[.,;]?\s*+\Z"
)
_WORK_BEFORE = re.compile(r"\s*+\\delta\s*+[WA](?![A-Za-z])[^&=]*+=\s*+(?:\{\s?\}\s*+)?&(?!\s*+=)")
"""A row with a minus at the mark behind = in a virtual work above: \\delta W ={}& a\\\\ &- b\\delta x = 0."""
_CUT = re.compile(rf"(?<!\\)[,;](?!\w)|\\q?quad(?![A-Za-z])|\x00|{_ARROWS}")
_INDENT = re.compile(_SPACE)
r"""Before a row that only continues a side, c &= a \\\\ &\\quad - b \\\\ &= 0, no gap between two statements."""
_PROSE = re.compile(r"[^\W_]*+[^\\=_^*/+{}<>|\n]*+")
_SENTENCE = re.compile(r"\s*+(?P<said>[^\W\d_][^\\=_^*/+{}<>|\n]{4,300}[.!?])\s++(?=[^\n]*=)")
"""Words that end before an equation on the same line: The two steps were T and V. 0 = …"""
_LONG_WORD = re.compile(r"[^\W\d_]{4,}")

_FORMULA = re.compile(
    r"\s*+\\(?:begin\{[bpvB]?matrix\}|left(?![A-Za-z])|d?dot(?![A-Za-z])|[dt]?frac(?![A-Za-z]))|\s*+[\d(+-]*+\w*+\\d?dot(?![A-Za-z])"
)
"""How an equation in LaTeX begins that has no delimiters."""


def latex_rows(text: str) -> list[AnswerRow]:
    """Return the statements of an answer in LaTeX; words around the mathematics are ignored."""
    text = _COMMENT.sub(lambda m: " " * len(m.group()), text)
    text = _EQUALS.sub(lambda m: "=".ljust(len(m.group())), with_displays_joined(text))
    found = list(_mathematics(text))
    if not found:
        return _statements(text, 0, lines=True)
    rows: list[AnswerRow] = []
    found = sorted([*found, *_bare(text, found)])
    for start, inside in [x for x in found if "=" in x[1] and not _is_aside(text, *x)] or found:
        if len(rows) > MAX_STATEMENTS:
            break
        rows += _statements(inside, start, lines=False)
    return rows


_IF = re.compile(rf"(?<!\w)(?:{'|'.join(sorted(IF))})\s{{1,3}}(?:\$|\\\()\Z", re.IGNORECASE)
_SINGLE = re.compile(r"\s*\\?[^\W\d]\w*(?:\{\w+\})?\s*=")
_MOVES = re.compile(r"\\d?dot|['’′]")

_LEVEL = re.compile(r"\s*(?P<energy>[TVU]|E_(?:p|\{?(?:\\\w{4,6}\{)?pot\}{0,2}))\s*=\s*0\s*")
_AT_PLACE = re.compile(
    r"(?:\$|\\\))\s{1,3}(?:in|at|for|if|when|on|where|bei|im|am|an|auf|für|wenn|falls|pour|en|au|à|dans|si)[ \n]"
    r"(?!general)",
    re.IGNORECASE,
)


def _is_aside(text: str, start: int, inside: str) -> bool:
    """Whether a formula is a condition, or says where an energy that another one gives is 0: $V = 0$ at the hinge."""
    level = _LEVEL.fullmatch(inside)
    if level is None or _AT_PLACE.match(text, start + len(inside)) is None:
        return _is_condition(text, start, inside)
    return re.search(rf"(?<![\w\\]){re.escape(level['energy'])}\s*&?\s*=(?!\s*0\s*(?:\$|\\\)))", text) is not None


def _is_condition(text: str, start: int, inside: str) -> bool:
    """Whether a formula is a condition between products or sums without rates: if $m_1 r = m_2(l - r)$, …"""
    said = _IF.search(text, max(0, start - 20), start)
    return said is not None and _MOVES.search(inside) is None and _SINGLE.match(inside) is None


def _bare(text: str, found: Sequence[tuple[int, str]]) -> Iterator[tuple[int, str]]:
    """The lines that are equations in LaTeX without delimiters, beside mathematics that has some."""
    inside = [(start, start + len(piece)) for start, piece in found]
    at = 0
    for line in text.split("\n"):
        end = at + len(line)
        alone = "$" not in line and all(end <= a or b <= at for a, b in inside)
        if alone and _FORMULA.match(line) and "=" in line:
            yield at, line
        at = end + 1


def beside_mathematics(text: str) -> str:
    """Return a text with mathematics between delimiters in which only those lines are left that contain neither
    mathematics nor commands; everything else is blank."""
    text = _COMMENT.sub(lambda m: " " * len(m.group()), text)
    kept: list[str] = []
    at = 0  # up to which the text is kept or blank
    for start, inside in _mathematics(text):
        if start + len(inside) < at:
            continue
        first, last = text.rfind("\n", at, start) + 1, line_end(text, start + len(inside))
        kept += [text[at : max(at, first)], re.sub(r"[^\n]", " ", text[max(at, first) : last])]
        at = last
    if not at:
        return ""
    lines = "".join([*kept, text[at:]]).split("\n")
    return "\n".join(" " * len(line) if "\\" in line or "$" in line else line for line in lines)


def _mathematics(text: str) -> Iterator[tuple[int, str]]:
    """The pieces of mathematics between delimiters, with the place where each begins."""
    at, missing = 0, set[str]()
    while (match := _OPENING.search(text, at)) is not None:
        closing = _CLOSING.get(match.group(), f"\\end{{{match['kind']}}}")
        end = -1 if closing in missing else text.find(closing, match.end())
        if end < 0:
            missing.add(closing)
            at = match.end()
        else:
            yield match.end(), text[match.end() : end]
            at = end + len(closing)


def _statements(text: str, start: int, *, lines: bool) -> list[AnswerRow]:
    """The statements of one piece of mathematics; ``lines``: the end of a line may end a statement."""
    text = _SYSTEM.sub(lambda m: m["rows"].rjust(m.end("rows") - m.start()).ljust(len(m.group())), text)
    for form in (_WRAPPER, _NOTE, _STYLE, _UPRIGHT_NUMBER):
        text = form.sub(lambda m: " " * len(m.group()), text)
    text = without_units(without_braces(_with_points(_without_words(without_end_marks(_unboxed(text))))))
    rows: list[AnswerRow] = []
    end = 0
    for at, piece, hard in _cut(text, lines):
        said = _SENTENCE.match(piece) if lines else None
        kept = _labels(blank(piece, 0, said.end()) if said is not None and _is_prose(said["said"]) else piece)
        if not _content(kept):
            continue
        if rows and (previous := rows[-1]) and _continues(previous.text, piece, hard, _BLANK.search(text, end, at)):
            gap = at + start - previous.start - len(previous.text)
            kept = kept if "=" in kept else _INDENT.sub(lambda m: " " * len(m.group()), kept, count=1)
            at_mark = _AT_MARK.match(kept)
            rows[-1] = AnswerRow(
                previous.start,
                previous.text + " " * gap + (blank(kept, 0, at_mark.end("mark")) if at_mark is not None else kept),
            )
        elif "\\" in kept or not plain_words(kept):
            rows.append(AnswerRow(at + start, kept))
        end = at + len(piece)
    return [part for row in rows if not (lines and _is_prose(row.text)) for part in _parts(_tidy(row))]


def _is_prose(text: str) -> bool:
    """Whether a line of LaTeX without delimiters consists of words: My answer is below - hope it's right!"""
    if _PROSE.fullmatch(text.strip()) is None:
        return False
    return plain_words(text.replace("-", " ").replace("'", "")) or _LONG_WORD.search(text) is not None


def _with_points(text: str) -> str:
    """Replace decimal commas by points, except between the arguments of a function."""
    return re.sub(r"(?<=\d),(?=\d)", ".", text) if not _LISTS.search(text) else text


def _without_words(text: str) -> str:
    """Replace words by a mark and spaces, except a short word that may be a name."""
    at = 0
    while (match := _WORDS.search(text, at)) is not None:
        end = closing(text, match.end())
        words = text[match.end() : end - 1].strip()
        end = max(end, remark_end(text, match.end(), end))
        symmetric = words.lower().rstrip(".") in _SYMMETRIC
        behind = is_direction(words) and _BEHIND.match(text, end) is not None
        behind = behind and text[: match.start()].rstrip(" ~\\,;:")[-1:] not in {*"=+-*/({", ""}
        behind = behind or (len(words) > 3 and words.isalpha() and _is_column_of_words(text, match.start(), end))
        if symmetric or behind or not _SHORT.match(words) or words.lower() in _LINKS:
            text = blank(text, match.start(), end)
            text = text[: match.start()] + (SYMMETRIC if symmetric else "\x00") + text[match.start() + 1 :]
        at = end
    return _BRACKETED.sub(lambda m: re.sub(r"[()\[\]]", " ", m.group()), text)


def _is_column_of_words(text: str, start: int, end: int) -> bool:
    r"""Whether a word stands alone behind a wide gap at the end of a row, and in no matrix: T = … && \text{kinetic}."""
    if text.count("\\begin{", 0, start) > text.count("\\end{", 0, start):
        return False
    return _FAR.search(text, max(0, start - 40), start) is not None and _ROW_END.match(text, end) is not None


def _unboxed(text: str) -> str:
    r"""Blank out every ``\boxed{`` and its closing brace."""
    if _BOXED.search(text) is None:
        return text
    letters, boxes = list(text), list[bool]()
    for match in re.finditer(rf"{_BOXED.pattern}|\\[{{}}]|[{{}}]", text):
        mark = match.group()
        if mark.endswith("{") and mark != "\\{":
            boxes.append(len(mark) > 1)
        if len(mark) > 2 or (mark == "}" and boxes and boxes.pop()):
            letters[match.start() : match.end()] = " " * len(mark)
    return "".join(letters)


def _cut(text: str, lines: bool) -> list[tuple[int, str, bool]]:
    """The pieces between row separators outside braces and matrices, and whether each follows an explicit separator."""
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
    """Blank out arrows, and numbers of equations before and after a statement."""
    for form in (_ARROW, _NUMBER_BEFORE, _LETTER_BEFORE, _NAME_BEFORE, _WORDS_BEFORE, _TAG_BEFORE, _ARROW):
        if match := form.match(piece):
            piece = blank(piece, 0, match.end())
    if (bound := _BOUND.search(piece)) is not None and "=" in piece[: bound.start()]:
        piece = blank(piece, *bound.span())
    end = _content_end(piece)
    if (number := _NUMBER.search(piece[max(0, end - 12) : end])) is not None:
        start = end - len(number.group())
        if _GAP.search(piece[max(0, start - 12) : start]):
            piece = blank(piece, start, len(piece))
    return piece


def _content_end(piece: str) -> int:
    """The position where only spacing, alignment marks and words follow."""
    return max((m.end() for m in _PIECE.finditer(piece) if m["content"] is not None), default=0)


def _content(piece: str) -> bool:
    """Whether there is anything but spacing and punctuation."""
    return any(m["content"] not in (None, ".", ",", ";") for m in _PIECE.finditer(piece))


def _continues(before: str, piece: str, hard: bool, apart: re.Match[str] | None) -> bool:
    """Whether a row continues the previous one; a minus does not if a blank line sets them ``apart``."""
    below = incomplete(without_gap(before.replace("&", " ")), piece)
    if _STARTS.match(piece) or (hard and _INDENTED.match(piece)) or below:
        return True
    if apart is not None or _MINUS.match(piece) is None or _is_prose(before):
        return False
    if hard and _AT_MARK.match(piece) and _WORK_BEFORE.match(before):
        return True
    return ("=" in before) != ("=" in piece)


def _tidy(row: AnswerRow) -> AnswerRow:
    text = _outer(row.text)
    end = _content_end(text)
    while end and text[end - 1] in (".,;:" if "=" in text else ".,;"):
        end -= 2 if text[end - 2 : end - 1] == "\\" else 1
        end = _content_end(text[:end])
    return AnswerRow(row.start, without_brackets_around(text[:end]))


def _outer(text: str) -> str:
    r"""Blank out the & that align rows, but not those inside matrices; one between equations side by side,
    a &= b & c &= d, becomes a mark."""
    matrices, places = 0, list[int]()
    for match in re.finditer(r"\\begin|\\end|&", text):
        if match.group() != "&":
            matrices += 1 if match.group() == "\\begin" else -1
        elif matrices <= 0 and text[match.start() - 1 : match.start()] != "\\":
            places.append(match.start())
    letters = list(text)
    for at in places:
        letters[at] = " "
    places = [b for a, b in pairwise([-1, *places]) if a < 0 or text[a + 1 : b].strip() != "="]  # a &=& b
    between = places[1::2]
    pairs = [text[a:b] for a, b in pairwise([0, *between, len(text)])]
    if between and all("=" in pair and not _STARTS.match(pair) for pair in pairs):
        for at in between:
            letters[at] = "\x00"
    return "".join(letters)


def _parts(row: AnswerRow) -> list[AnswerRow]:
    """Split a row at commas, wide spaces and words outside brackets, if every piece is a statement."""
    if any("\x00" in side and not _content(side) for side in row.text.split("=")):
        return []  # one side consists of words: a remark
    depth, cuts = 0, [(0, 0)]
    for match in re.finditer(rf"[(\[{{}}\])]|\\begin|\\end|{_CUT.pattern}", row.text):
        mark = match.group()
        if mark in "([{" or mark == "\\begin":
            depth += 1
        elif mark in ")]}" or mark == "\\end":
            depth -= 1
        elif depth <= 0 and _STARTS.match(row.text, match.end()) is None:
            cuts.append((match.start(), match.end()))
    cuts.append((len(row.text), len(row.text)))
    pieces = [(a[1], row.text[a[1] : b[0]]) for a, b in pairwise(cuts)]
    pieces = [(at, piece) for at, piece in pieces if _content(piece)]
    if all("=" in piece for _, piece in pieces):
        return [AnswerRow(row.start + at, piece) for at, piece in pieces]
    return [AnswerRow(row.start, row.text.replace("\x00", " "))]
