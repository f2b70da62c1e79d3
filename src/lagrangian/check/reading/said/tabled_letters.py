r"""Finds tables in which an answer sets its own letters against those of the system, and such pairs in brackets.

| mine | yours | meaning |    $m_1$ & $M$ & hull \\    below "mine & yours & meaning"      m_1 is M
$\qa$, $\qb$ & hangers (sheet: $\alpha$, $\beta$) \\    qa: left hanger (in your notation α)    qa is α, qb is β
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from itertools import islice

from lagrangian.check.reading.latex.macros import short_names

DEEPEST = 3
"""How often a macro may stand for another one."""
MOST, LONGEST = 40, 400
"""The most tables and rows, and the most characters of a row."""

_MINE = (
    "mine|my|own|ours?|i|here|meine?|eigene?|ich|mir|hier|moi|mes|ma|mon|miens?|mienne|notre|"
    "symbol|symbols|letter|name|notation|symbole|buchstabe|zeichen|bezeichnung|lettre"
)
_YOURS = (
    "yours?|sheet|problem|exercise|statement|task|original|handout|assignment|system|blatt|aufgabe|angabe|"
    "aufgabenblatt|aufgabenstellung|vorlage|ihre?|euer|eure|énoncé|sujet|vôtre|votre"
)
_SURE_OF_MINE = re.compile(
    r"(?:mine|my|own|ours?|i|here|meine?|eigene?|ich|mir|hier|moi|mes|ma|mon|miens?|mienne|notre)"
)
_HEAD_OF_MINE, _HEAD_OF_YOURS = re.compile(_MINE), re.compile(_YOURS)
_WORD = re.compile(r"[^\W\d_]+")
_NAME = r"[$`*]{0,2}\\?[^\W\d_][^\W_]{0,11}(?:_\w{1,8}|_\{\w{1,8}\}|_\\[A-Za-z]{2,8})?[$`*]{0,2}"
_LIST = rf"{_NAME}(?:[ ]?(?:,|/|and|und|et)[ ]?{_NAME}){{0,7}}"
_ONE = re.compile(_NAME)
_NAMES = re.compile(_LIST)
_MARKDOWN = re.compile(r"^[ \t]*+\|?+(?P<row>[^\n|]{1,200}+(?:\|[^\n|]{1,200}+){1,8}+)\|?+[ \t]*$", re.MULTILINE)
_TABLE = r"\{(?:tabular|tabularx|array|longtable)\*?\}"
_TABULAR = re.compile(rf"\\begin{_TABLE}(?P<rows>[^\0]{{1,4000}}?)\\end{_TABLE}")
_ROW_END = re.compile(r"\\\\(?:\[[^\]\n]{0,12}\])?|\\tabularnewline(?![A-Za-z])")
_LINES = re.compile(r"\\(?:hline|toprule|midrule|bottomrule|cline\{[^{}]{0,12}\})|\A\s*(?:\{[^{}\n]{0,40}\}){1,2}")
_SHEET = (
    rf"(?:(?:the|your|our|this|dem|der|die|das|eurem?|ihrem?|l['’]|la|le)[ ])?(?:{_YOURS})"
    r"(?:[ ](?:sheet|statement|description|text|notation|letters?|symbols?))?"
)
_IN = r"(?:in|on|of|from|by|im|auf|in[ ]der|dans|sur)[ ]"
_BESIDE = r"(?!(?:plus|also|besides|beside|with|dazu|sowie|avec)[ ])"
_THEIRS = rf"(?:(?:the|its|der|die|das)[ ])?{_BESIDE}(?:[^\W\d_]{{3,20}}[ ]){{0,2}}(?P<own>{_LIST})"
_REFERENCES = tuple(
    re.compile(rf"(?P<opens>\([ ]?|,[ ]){form}(?(opens)[ ]?(?:\)|(?=[ \t]*(?:\\\\|[\n|;.&]|\Z))))", re.IGNORECASE)
    for form in (
        rf"(?:{_IN})?{_SHEET}(?:['’]s[ ]|[ ]?[:=][ ]?){_THEIRS}",
        rf"(?:your|euer|eure?|ihre?|votre|there|dort)[ ]{_THEIRS}",
        rf"(?:(?:which|it|this)[ ])?(?:(?:was|were|formerly|previously|originally|war|früher|vorher|ehemals)[ ]){{1,2}}"
        rf"(?:(?:the[ ])?{_SHEET}['’]s[ ])?{_THEIRS}(?:[ ]{_IN}{_SHEET}|[ ]before)?",
        rf"(?:(?:which|it|this)[ ](?:is[ ])?)?(?:(?:called|named|denoted|written|genannt)[ ])?{_THEIRS}"
        rf"(?:[ ]{_IN}{_SHEET}|[ ]there|[ ]dort)",
        rf"(?:which[ ])?{_SHEET}[ ](?:calls?|names?|denotes?|writes|nennt|uses)(?:[ ]it)?[ ]{_THEIRS}",
    )
)
"""What says, in brackets or behind a comma, how the system calls what a row is about: (sheet: α), (was theta), (M in
the task), and, at the end of a row, ", the sheet's α"."""
_BEFORE = re.compile(
    rf"(?:\A|\\\\|[\n|;]|^[ \t]*[-*•][ ])[ \t\n]*(?P<new>{_LIST})[ \t]*"
    r"(?:&|\||=|:|[-–—]|\bis\b|\bare\b|\bist\b|\bsind\b)?"
    r"(?P<words>[^\n&|=+*/^()\\${}\[\];]{1,80})\Z",
    re.MULTILINE,
)
"""The names and the words in front of such a reference, on a row of their own."""
_BEGINS = (
    r"(?:\A|\\\\|[\n|;,:]|(?<!\w)(?:and|und|that|dass|with|mit|us(?:e|ed|ing)|wr(?:ite|ote)|call(?:ed)?|take|took"
    r"|nenne|schreibe|nehme)(?!\w))"
)
_STARTS = re.compile(_BEGINS)
_PART = re.compile(
    rf"{_BEGINS}[ \t\n]*(?:[-*•–][ ])?(?P<new>{_NAME})(?![\w'’′])"
    r"[ \t]*(?:&|\||=|[-–—]|,[ ](?=the[ ]|its?[ ]|an?[ ]))?[ \t]*[^\n&|=+*/^()\\${}\[\];:,]{0,80}\Z",
)
"""One name and the words behind it, as a part of a sentence; that part which begins last is found last."""
_WORD_ALONE = re.compile(
    r"I[ \t]+(?!(?:is|are|be|denotes|means|stands|for)\b)[a-z]{2}|[aA][ \t]+(?!(?:is|are|for|its)\b)[a-z]{2}"
)
"""A pronoun or an article, which is no name: I call the angle …"""
_JUST = re.compile(rf"(?<![\w$`*\\])(?P<new>{_NAME})[ \t]*\Z")
"""The name in front of such a reference."""
Pair = tuple[str, str]


def tabled_letters(
    text: str, bare: Callable[[str], str], may_be: Callable[[str, str], bool]
) -> Iterator[tuple[list[Pair], tuple[int, int]]]:
    """Yield the letters of an answer with those of the system, as tables and brackets set them against each other, and
    where; ``bare`` takes the marks off a name, and ``may_be`` says whether one may be a letter for the other."""
    meanings = short_names(text) if "\\" in text else {}

    def plain(name: str) -> str:
        for _ in range(DEEPEST):
            short = name.strip("$`*")
            name = meanings.get(short[1:], name) if short.startswith("\\") else name
        return bare(name)

    for rows in (*_markdown(text), *_latex(text)):
        yield from (x for x in _of_table(rows, plain) if all(may_be(a, b) for a, b in x[0]))
    for form in _REFERENCES:
        for match in islice(form.finditer(text), MOST):
            for start, new in _named_before(text, match.start()):
                pairs = _pairs(new, match["own"], plain)
                if pairs and all(may_be(a, b) for a, b in pairs):
                    yield pairs, (start, match.end())
                    break


def _named_before(text: str, end: int) -> Iterator[tuple[int, str]]:
    """The names for which a reference that begins at ``end`` may be, the likeliest first, and where they begin."""
    first = max(0, end - LONGEST // 2)
    starts = islice(_STARTS.finditer(text, first, end), MOST)
    parts = [x for m in starts if (x := _PART.match(text, m.start(), end)) is not None]
    others = (form.search(text, first, end) for form in (_BEFORE, _JUST))
    for found in (*reversed(parts), *others):
        if found is not None and _WORD_ALONE.match(text, found.start("new")) is None:
            yield found.start("new"), found["new"]


Row = tuple[list[str], tuple[int, int]]


def _markdown(text: str) -> Iterator[list[Row]]:
    """The rows of each table of Markdown."""
    found: list[Row] = []
    for match in islice(_MARKDOWN.finditer(text), MOST * MOST):
        if found and match.start() > found[-1][1][1] + 1:
            yield found
            found = []
        found.append(([x.strip() for x in match["row"].split("|")], match.span()))
    if found:
        yield found


def _latex(text: str) -> Iterator[list[Row]]:
    """The rows of each table of LaTeX."""
    for match in islice(_TABULAR.finditer(text), MOST):
        found: list[Row] = []
        ends = [*(m.span() for m in _ROW_END.finditer(text, *match.span("rows"))), (match.end("rows"),) * 2]
        at = match.start("rows")
        for end, after in ends:
            cells = _LINES.sub(" ", text[at:end])
            found.append(([x.strip() for x in cells.split("&")], (at, end)))
            at = after
        yield found


def _of_table(rows: Sequence[Row], bare: Callable[[str], str]) -> Iterator[tuple[list[Pair], tuple[int, int]]]:
    """The pairs of a table whose head says which column holds whose letters."""
    head = rows[0][0]
    said = [[x.lower() for x in _WORD.findall(cell)] for cell in head]
    yours = [k for k, words in enumerate(said) if any(map(_HEAD_OF_YOURS.fullmatch, words)) and len(words) < 4]
    mine = [k for k, words in enumerate(said) if any(map(_HEAD_OF_MINE.fullmatch, words)) and k not in yours]
    sure = [k for k in mine if any(map(_SURE_OF_MINE.fullmatch, said[k]))]
    mine = sure or mine
    if len(yours) != 1 or len(mine) != 1:
        return
    start = rows[0][1][0]
    for cells, (first, end) in rows[1 : MOST + 1]:
        if len(cells) <= max(mine[0], yours[0]):
            continue
        if pairs := _pairs(cells[mine[0]], cells[yours[0]], bare):
            yield pairs, (min(start, first), end)
            start = end


def _pairs(new: str, own: str, bare: Callable[[str], str]) -> list[Pair]:
    """The names of two lists against each other; none if they are no lists of as many names."""
    if _NAMES.fullmatch(new.strip()) is None or _NAMES.fullmatch(own.strip()) is None:
        return []
    lists = [[bare(x) for x in _ONE.findall(y) if x not in ("and", "und", "et")] for y in (new, own)]
    return list(zip(*lists, strict=True)) if len(lists[0]) == len(lists[1]) else []
