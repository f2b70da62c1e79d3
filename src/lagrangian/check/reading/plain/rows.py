"""Splits an answer in plain text into statements: continued lines, comments, and numbers or labels around them."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import pairwise

from lagrangian.check.reading.labels import (
    Numbering,
    before,
    behind,
    is_label,
    is_mark,
    numbering,
    without_dashes,
    without_units,
)
from lagrangian.check.reading.markup import blank, opened_list
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.plain.ends import (
    EMPTY_SIDE,
    NAME_NEXT,
    OPEN_END,
    defines_behind,
    incomplete,
    missing_brackets,
    open_brackets,
    whole_lists,
    within_sums,
)
from lagrangian.check.reading.prose.combined import without_combinations
from lagrangian.check.reading.prose.conditions import without_conditions
from lagrangian.check.reading.prose.descriptions import amid_names, is_description, is_left_out, says_nothing
from lagrangian.check.reading.prose.directions import without_directions
from lagrangian.check.reading.prose.exercises import without_exercises
from lagrangian.check.reading.prose.headings import without_headings
from lagrangian.check.reading.prose.joined_words import with_words_joined
from lagrangian.check.reading.prose.remarks import is_remark
from lagrangian.check.reading.prose.sides_in_words import ends_in_a_word, without_sides_in_words
from lagrangian.check.reading.prose.sketches import without_sketches
from lagrangian.check.reading.prose.words import Words
from lagrangian.check.reading.prose.words_or_mathematics import (
    LINKING,
    is_sentence,
    moves,
    stated_remarks,
    without_lead,
    without_remarks,
    without_tail,
)
from lagrangian.check.reading.traced_text import line_end
from lagrangian.model.names import FUNCTIONS
from lagrangian.records import dataclass

MAX_STATEMENTS = 500
"""The largest number of statements in one answer."""


@dataclass(frozen=True, slots=True)
class AnswerRow:
    """A statement: ``text`` begins at ``start`` of the answer; comments and labels in it are blanked out."""

    start: int
    text: str


LONGEST_LABEL = 140
"""The most characters of a label in front of an equation, with its number."""

LONGEST_FORMULA = 400
"""The most characters of a formula with a word behind it that says what a name in it means."""

_COMMENT = re.compile(r"(?:#|%|//(?=\s)).*")
_STARRED = re.compile(r"(?<!\w)T\^\*{1,2}(?=\s*[=:])")
_OPEN_START = re.compile(r"\s*(?:[+*/×·)\]^]|=(?!=*>))")
_LISTED_START = re.compile(r"\s*[+*][ \t]+[^=]*=")
_MINUS_START = re.compile(r"\s*[-−–](?![-−–]{0,9}>)")
_WORK_START = re.compile(r"\s*(?:[dδ]|delta)[ \t]?[WA]\w{0,8}[ \t]*=[^=]*")
"""A virtual work, a sum whose = 0 may stand below."""
_WORK_END = re.compile(r"[ \t]+[-−–][^=]*=\s*0\s*+[.;,]?\s*")
_STATEMENT_SIGN = re.compile(r"[=+*/^()\[\]'′″\u0307\u0308]")
_DOTTED = re.compile(r"(?:\.\.\.|…|\\)(?=\s*\Z)")
_LEFT_OUT = re.compile(r"=\s*(?:\.\.\.|…)\s*\Z")
"""A side that is left out: p = ∂L/∂x' = …"""
_PLUS_END = re.compile(r"\+\s*\Z")
_PLUS_START = re.compile(r"\s*\+")
_GOES_ON = re.compile(r"\s*(?:\.\.\.|…)")
_SUM_ALONE = re.compile(
    r"\s*[↑→↓←↻↺⟲⟳⤵]?\s*(?:∑|Σ|\\sum(?![A-Za-z]))[\s_{}\\]*[^\W\d]?[\w{}\\]{0,16}(?:\^[\w{}]{1,4}|\(\w{1,4}\))?\s*"
)
_SUM = re.compile(r"∑|\\sum(?![A-Za-z])")
_SIGMA = re.compile(r"(?<!\w)Σ(?=[^\W_]|\s[A-Z])")
_ARROWS = r"<?=+>|⇒|⟹|⇔|⟺|<?(?<![^\s>=]-)-++>|→|⟶|↔|⟷|∴"
_LINKED = (
    "and|or|where|with|so|thus|hence|therefore|implies|then|i\\.e\\."
    "|(?:I|we)[ ](?:have|get|find|obtain|write|see)"
    "|und|oder|wobei|mit|sowie|also|daraus|somit|d\\.h\\."
)
_WITH = "con|com|met|med|dove|donde|onde|waarbij|y|og|och|en"
"""How other languages link statements, in words that may be names of the system or products of these."""
_LINKS = rf"(?<=[\s,;])(?:{_LINKED}|et|avec|où|donc|soit|(?P<foreign>{_WITH}))(?=[\s,:])"
_MEANING = re.compile(r"(?:with|where|wobei|mit|avec|où|soit|con|com|met|med|dove|donde|onde|waarbij)\b")
_RATES = re.compile(
    r"(?<==)[ \t]*+[^\W\d]\w*+['’′″]{1,2}[ \t]++(?=[^\W\d_]\w{0,11}+(?<=[dtp])[ \t]*+=[ \t]*+[^\W\d]\w*+['’′″])"
)
"""A rate behind its name, where the name of another follows: xd = x' xdd = x''."""
_NEXT = (
    r"(?<=[\w)\]'’′²³\u0307\u0308])[ \t]{2,}"
    r"(?=(?:[∂d][^\W\d_]/[∂d])?[^\W\d_](?:\w|[\u0307\u0308]){0,8}['′*]?[ \t]*=(?!=))"
)
_COLUMN = r"(?P<column>(?<=[\w)\]'’′²³\u0307\u0308])(?:[ ]{3,}|[ ]?\t[ \t]*)(?=[\w(∂\[]))"
"""A gap between two columns of a line."""
_COLON = r"(?P<colon>(?<=[\w)\]'’′″²³]):(?=\s))"
_SHORT_WORDS = r"(?<!(?<!\w)[ieIE]\.[eg])(?<!(?<!\w)[dDzZ]\.[hBb])(?<!(?<!\w)cf)(?<!(?<!\w)ca)(?<!(?<!\w)vs)"
"""What ends in a point and no sentence: i.e. Steiner's theorem."""
_STOP = (
    rf"(?<=[\w)\]'’′″²³])[ \t]*+{_SHORT_WORDS}(?P<stop>\.)"
    r"(?=[ \t]+(?:"
    r"[A-ZÄÖÜÉ][a-zäöüéè](?:[a-zäöüéè]|[ \t][a-z]{3})|(?:OK|ok|Ok|QED)\b|[^\W\d]\w{0,8}+[ \t]*+(?:=(?!=)"
    r"|(?<=[ \t])(?:as|is|are|denotes|means|measured|counted|wie|ist|wird|zählt|comme|est)[ \t])))"
)
_ENDS = re.compile(r"[;,]")
_OTHER_NAME = re.compile(r"\s*+[^\W\d]\w{1,23}+\s*+=\s*+[^\W\d]\w{0,23}+\s*+")
_EQUALS = re.compile(r"(?<![=<>:!])=(?![=>])")
_PARTED = re.compile(r"[;\t]| {3}")
_BETWEEN = re.compile(
    rf"[(\[{{}}\])\n]|{_NEXT}|{_COLUMN}|{_COLON}|{_STOP}|(?<=[^\s>=])[ \t]*(?P<arrow>{_ARROWS}|\bimplies\b)|{_LINKS}"
)


def plain_rows(text: str, words: Words) -> list[AnswerRow]:
    """Return the statements of an answer in plain text; headings and remarks are ignored."""
    text = without_headings(
        without_exercises(_STARRED.sub(lambda m: "T*".ljust(len(m.group())), without_sketches(text, words)), words)
    )
    text = with_words_joined(without_combinations(without_conditions(text, words), words), words)
    text = without_directions(without_units(without_dashes(text, words), words), words)
    text = without_remarks(stated_remarks(text), words)
    text = _RATES.sub(lambda m: f"{m.group()[:-1]};", text)
    numbers = numbering(text, words)
    labelled = partial(is_label, words=words, numbers=numbers)
    text = _separated(opened_list(text) if "\n\n" not in text.strip() else text, labelled, words)
    text = "\n".join(
        opened_list(line) if "Eq" in line or line.lstrip()[:1] in ("[", "{") else line for line in whole_lists(text)
    )
    rows, offset, within = list[AnswerRow](), 0, within_sums(text)
    open_row: AnswerRow | None = None
    led = False  # by words and a place, with a colon: the counterweight, at a distance -d cos(phi):
    for line in re.split(r"(?<=\n)", text):
        bare = _COMMENT.sub(lambda m: " " * len(m.group()), line.rstrip("\r\n"))
        if not bare.strip():
            open_row = open_row if line.strip() else None  # a line with only a comment ends nothing
        elif open_row is not None and (_continues(open_row.text, bare, offset in within, led) or _GOES_ON.match(bare)):
            goes_on = _GOES_ON.match(bare)
            bare = blank(bare, *goes_on.span()) if goes_on is not None else bare
            head = _DOTTED.sub(lambda m: " " * len(m.group()), open_row.text)
            if (repeated := _PLUS_END.search(head)) is not None and _PLUS_START.match(bare):
                head = blank(head, repeated.start(), len(head))  # "a + …" continues with "… + b"
            if (at := _explained_from(head, bare)) is not None:  # T = A with J = B, and "= C" below it
                rows.insert(-1, AnswerRow(open_row.start + at, head[at:]))
                head = head[:at].rstrip(";, \t")
            gap = offset - open_row.start - len(head)
            rows[-1] = open_row = AnswerRow(open_row.start, head + " " * gap + _ended(head, bare, numbers, words))
        elif (stripped := before(bare, words, numbers)).strip() and not plain_words(stripped):
            rows.append(AnswerRow(offset, _ended("", stripped, numbers, words)))
            open_row = None if is_sentence(stripped, words) else rows[-1]
            led = stripped.rstrip().endswith(":") and "=" not in stripped
        offset += len(line)
    rows = [AnswerRow(row.start, opened_list(row.text)) for row in rows]
    split = [
        piece for row in rows for part in pieces(row, ";", always=True) for piece in pieces(part, ",", words=words)
    ]
    begin = {row.start for row in rows}  # labels behind commas: of A: x' = a, of B: y' = b
    split = [x if x.start in begin else replace(x, text=before(x.text, words, numbers)) for x in split]
    split = [row for row in (without_sums(row, words.names) for row in split) if row.text.strip()] or split[:1]
    found = [AnswerRow(row.start, _bare(row.text, words)) for row in split]
    if len(found) > 1:
        told = [(row, own) for row, own in zip(found, split, strict=True) if not _explained(row, own, words)]
        found, split = [row for row, _ in told], [own for _, own in told]
    return [row for row, own in zip(found, split, strict=True) if not is_left_out(row.text, own.text, words)] or found[
        :1
    ]


def _ended(head: str, line: str, numbers: Numbering, words: Words) -> str:
    """A line, which goes on from ``head``, without what stands behind it; the comma in a list that goes on is kept."""
    bare, text = behind(line, numbers, words), line.rstrip()
    return f"{bare[: len(text) - 1]}," if text[-1:] == "," and open_brackets(head + bare) > 0 else bare


def _bare(text: str, words: Words) -> str:
    """A statement without the words in front of it and behind it, and without sides in words."""
    said = without_sides_in_words(text, words)  # I = J + m l² = all inertia at the axle: "all" is no a l l
    bare = without_lead(said, words)
    if "=" not in said and bare != said and not moves(bare):
        return said  # I divided the second by m*l^2
    return without_sides_in_words(without_tail(bare, words, led=bare != said and "=" in said), words)


def _explained(row: AnswerRow, own: AnswerRow, words: Words) -> bool:
    """Whether one side of a row consisted of words, which a note tells: N is the contact force = lambda."""
    empty = row.text.lstrip().startswith("=") and not own.text.lstrip().startswith("=")
    if (empty := empty or ends_in_a_word(row.text, words)) and not is_description(own.text, words):
        words.names.notes.setdefault(f"'{' '.join(own.text.split())}' was not judged: one side consists of words.")
    return empty


def _separated(text: str, labelled: Callable[[str], bool], words: Words) -> str:
    """Replace arrows and linking words between statements by semicolons: a = b ⇒ c = d, a = b and c = d, s'' with s = …

    ``labelled`` says whether what stands before a colon is a label.
    """
    depth = 0
    letters = list(text)
    for match in _BETWEEN.finditer(text):
        mark = match.group()
        if mark in "([{":
            depth += 1
        elif mark in ")]}":
            depth -= 1
        elif mark == "\n":
            depth = depth if depth > 0 else 0
        elif depth <= 0 and match["arrow"] and is_mark(text[text.rfind("\n", 0, match.start()) + 1 : match.start()]):
            continue
        elif depth <= 0 and match["colon"]:
            if _states(text, match.start()) and not _labelled(text, match.start(), labelled):
                letters[match.start()] = ";"
        elif depth <= 0 and match["stop"]:
            first = text.rfind("\n", 0, match.start()) + 1
            if text.find("=", first, match.start()) >= 0 or defines_behind(text, first, match.span("stop")):
                letters[match.start("stop")] = ";"
        elif match["column"]:
            if depth <= 0 and _beside(text, match.start(), match.end()):
                letters[match.end() - 1] = ";"
        elif (match["foreign"] and (words.known(mark) or words.is_product(mark))) or amid_names(text, match, words):
            continue
        elif depth <= 0 and (match["arrow"] or _both(text, match.start(), match.end()) or _is_meant(text, match)):
            at = match.start()
            letters[at : match.end()] = ";" + " " * (match.end() - at - 1)
    return "".join(letters)


def _labelled(text: str, at: int, labelled: Callable[[str], bool]) -> bool:
    """Whether what stands before a colon on its line is a label."""
    first = text.rfind("\n", max(0, at - LONGEST_LABEL), at) + 1
    return (first > 0 or at < LONGEST_LABEL) and labelled(text[first : at + 1])


def _states(text: str, at: int) -> bool:
    """Whether a colon stands between two statements, ∑F = m x'': F - k x = m x'', or behind more than a label."""
    first, last = text.rfind("\n", 0, at) + 1, line_end(text, at)
    before = re.split("[,;]", text[max(first, at - 400) : at])[-1]
    return text.find("=", at, last) >= 0 and bool(re.search(r"[=\[\]*^/'′]", before))


def _both(text: str, start: int, end: int) -> bool:
    """Whether there is an equals sign on the same line before and after a place."""
    first, last = text.rfind("\n", 0, start) + 1, line_end(text, end)
    return "=" in text[first:start] and "=" in text[end:last]


def _beside(text: str, start: int, end: int) -> bool:
    """Whether statements stand on both sides of a gap: p = m x'      dp/dt = m x'' is no product."""
    first, last = text.rfind("\n", 0, start) + 1, line_end(text, end)
    parted = _PARTED.search(text, end, last)
    right = text[end : parted.start() if parted else last]
    if _EQUALS.search(right) is None:
        return False
    left = text[first:start].rstrip()
    for mark in (";", "\t", "   "):
        left = left[left.rfind(mark) + 1 :]
    return _EQUALS.search(left) is not None


def _is_meant(text: str, match: re.Match[str]) -> bool:
    """Whether a word says what a name means in the formula in front of it, which has no equals sign: a'' with a = …"""
    if _MEANING.fullmatch(match.group()) is None or NAME_NEXT.match(text, match.end()) is None:
        return False
    above = re.split("[:;\n]", text[max(0, match.start() - LONGEST_FORMULA) : match.start()])[-1]
    return "=" not in above and moves(above)


def plain_words(line: str) -> bool:
    """Whether a line consists of words, without anything found in an expression or equation."""
    words = re.findall(r"[^\W\d_₀-₉]{2,}", line)
    return len(words) >= 2 and not _STATEMENT_SIGN.search(line) and not FUNCTIONS & set(words)


def _remark(part: str) -> bool:
    """Whether a part of a line consists of words: "with the stretch s,"."""
    words = re.findall(r"[^\W\d_]+", part)
    return "=" not in part and any(w.lower() in LINKING for w in words) and not FUNCTIONS & set(words)


def _continues(above: str, line: str, within: bool, led: bool) -> bool:
    if _ends_open(above, line) or (_LEFT_OUT.search(above) and "=" in line and not _OPEN_START.match(line)):
        return False
    if (
        (within and "=" not in above)
        or incomplete(above, line)
        or _goes_on(above, line)
        or (_WORK_START.fullmatch(above) and _WORK_END.fullmatch(line))
    ):
        return True
    if led or not _MINUS_START.match(line) or (not line[:1].isspace() and "=" in above and _begins(above, line)):
        return False
    return ("=" in above) != ("=" in line) or (line[:1].isspace() and "=" not in line)


def _goes_on(above: str, line: str) -> bool:
    """Whether a line begins with a sign that goes on above; a plus that is not set in may be that of a list."""
    deeper = len(line) - len(line.lstrip()) > len(above) - len(above.lstrip()) and not _LISTED_START.match(above)
    listed = _LISTED_START.match(line) and "=" in above and not deeper
    return _OPEN_START.match(line) is not None and not listed


def _explained_from(above: str, line: str) -> int | None:
    """Where an equation that goes on below it says what a letter in it is: T = m v²/2 + J w²/2 with J = m a²/3."""
    if not line.lstrip().startswith("="):
        return None
    for match in _ENDS.finditer(above):
        named = NAME_NEXT.match(above, match.end())
        if named is None or "=" not in above[: match.start()]:
            continue
        name = re.escape(named.group().split("=")[0].strip())
        if re.search(rf"(?<![^\W_]){name}(?![^\W_'’′])", above[above.index("=") : match.start()]):
            return match.end()
    return None


def _begins(above: str, line: str) -> bool:
    """Whether a program printed an equation of motion without its = 0, which is no part of what is above it."""
    return "=" not in line and is_remark(above) and not is_remark(line)


def _ends_open(above: str, line: str) -> bool:
    """Whether an equation only lacks a bracket at its end, because the next line is another equation."""
    if "=" not in above or "=" not in line or OPEN_END.search(above) or _OPEN_START.match(line):
        return False
    return len(missing_brackets(above)) == 1 and not missing_brackets(line)


def without_sums(row: AnswerRow, names: Names) -> AnswerRow:
    """A row without the side that only says what is added up, ∑M = J φ'' = …; empty, which a note tells, if there is no
    other equation. A capital sigma before a name is this sign, too, unless the system has one. The same for T = with
    nothing behind it."""
    form = _SUM
    if (empty := EMPTY_SIDE.fullmatch(row.text)) is not None:
        names.notes.setdefault(f"'{empty[1]} =' was not judged: it has no right-hand side.")
        return replace(row, text="")
    if "Σ" in row.text and not names.scope.meanings("Σ")[0]:
        form = re.compile(rf"{_SUM.pattern}|{_SIGMA.pattern}")
    if not form.search(row.text):
        return row
    sides = row.text.split("=")
    kept = [side for side in sides if not form.search(side)]
    text = row.text
    for k, side in enumerate(sides):
        adds = form.search(side) is not None
        if adds:
            start = sum(len(x) + 1 for x in sides[:k])
            text = blank(text, max(0, start - (k == len(sides) - 1)), min(len(text), start + len(side) + 1))
        if adds and (len(kept) < 2 or not _SUM_ALONE.fullmatch(side)):
            told = row.text if len(kept) < 2 else side
            names.notes.setdefault(f"'{' '.join(told.split())}' was not judged: nothing says what ∑ adds up.")
    return AnswerRow(row.start, text if len(kept) > 1 else "")


def _stated(part: str) -> bool:
    """Whether a part of a row is a statement of its own."""
    return "=" in part or bool(re.match(r"\s*Eq\w*\s*[(\[]", part))


def pieces(row: AnswerRow, separators: str, *, always: bool = False, words: Words | None = None) -> list[AnswerRow]:
    """Split a row at separators outside brackets; unless ``always``, only if every piece contains an = or, with the
    ``words`` of the answer, consists of words."""
    cuts, depth = [-1], 0
    for i, c in enumerate(row.text):
        depth += (c in "([{") - (c in ")]}")
        if depth == 0 and c in separators and not (row.text[i + 1 : i + 2].isdigit() and row.text[i - 1].isdigit()):
            cuts.append(i)
    cuts.append(len(row.text))
    parts = [(a + 1, row.text[a + 1 : b]) for a, b in pairwise(cuts)]
    stated = sum(_stated(part) for _, part in parts)
    if stated:
        said = partial(says_nothing, words=words) if words is not None else _remark
        parts = [(at, part) for at, part in parts if not _remark(part) and not said(part)]
    listed = stated > 1 or (len(parts) > 1 and _OTHER_NAME.fullmatch(parts[1][1]) is not None)
    if listed and parts and words is not None and words.is_name(parts[0][1].strip()):
        del parts[0]  # J0, Ja = A, Jb = B
    explained = len(parts) > 1 and moves(parts[0][1]) and all(NAME_NEXT.match(part) for _, part in parts[1:])
    if len(parts) > 1 and not always and stated < sum(bool(part.strip()) for _, part in parts) and not explained:
        return [row]  # but T: ½ I φ'², I = J + m l²
    return [AnswerRow(row.start + at, part) for at, part in parts if part.strip()]
