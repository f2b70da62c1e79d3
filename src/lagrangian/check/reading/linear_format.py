"""Takes the linear format of Word's equation editor, and dots typed beside a letter, off an answer.

    θ ̈   (θ_1 ) ̇   x˙   x..        x''  θ_1'          a dot over what stands before it
    cos⁡〖θ_2 〗   k〖(r-l)〗^2        brackets that are not shown
    ■(a&b@c&d)   █(a=b@c=d)         a matrix, equations below each other
    (d^2 x)/(dt^2 )   ∂L/(∂x' )     derivatives as fractions

Every replacement is as long as what it replaces, so that all places stay the same.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from lagrangian.check.reading.braces import with_round_brackets
from lagrangian.check.reading.latex.tokens import SYMMETRIC
from lagrangian.check.reading.markup import blank
from lagrangian.check.reading.prose.words import function_of
from lagrangian.read.letters import key

_NAME = r"[^\W\d_⁰¹²³⁴-⁹₀-₉][^\W⁰¹²³⁴-⁹]*"
_INDEX = r"_[^\W_⁰¹²³⁴-⁹]+"
_GROUPED_INDEX = re.compile(r"(?<=[\w*\u0307\u0308])_\(\s*(\w+(?:[ -]\w+){0,4})\s*\)")
_DOTTED = re.compile(rf"(?P<base>[^\W\d_]|\))[ \xa0]+(?P<mark>[\u0307\u0308\u20db])(?P<index>{_INDEX})?")
_LETTER = r"[^\W⁰¹²³⁴-⁹]"
_SPACING = re.compile(
    rf"(?<=[\w)])(?P<mark>[˙¨])(?!{_LETTER})|(?<!{_LETTER})(?<!\))(?P<before>[˙¨])(?P<after>{_NAME})"
    rf"|(?<={_LETTER})(?P<amid>[˙¨])(?P<next>[^\W\d_])"
)
_MARKS = {"\u0307": "'", "\u0308": "''", "\u20db": "‴", "˙": "'", "¨": "″"}
_TWO = r"\s*(?:\^\s*2|\*\*\s*2|²)"
_PRIMES = r"['’′″]*"
_ABOVE = rf"(?:d(?:{_TWO})?|d(?:{_TWO})?\s*{_NAME}{_PRIMES}|∂\s*{_NAME})"
_BELOW = rf"(?:d\s*{_NAME}{_PRIMES}|∂\s*{_NAME}{_PRIMES})(?:{_TWO})?"
_FRACTION = re.compile(
    rf"(?<!\w)(?P<open>\(\s*)?{_ABOVE}(?(open)(?P<close>\s*\)))\s*/\s*(?P<under>\(\s*)?{_BELOW}(?(under)(?P<end>\s*\)))"
)
_ARRAY = re.compile(r"[■█]\s*\(")
_ROW = re.compile(r"(?P<open>[⎡⎢⎣])(?P<row>[^⎡-⎦]*)(?P<close>[⎤⎥⎦])")
_TALL = re.compile(r"[⎡-⎦]")
_COLUMNS = re.compile(r"(?<=\S)\s{2,}(?=\S)")
_LETTERED = re.compile(r"(?<!\w)(?P<stem>[^\W\d]\w{0,30}?)_?(?P<dots>p{1,2}|(?:punkt){1,2})(?!\w)")
_LISTED = re.compile(r"\[([^\[\]=\n]{3,2000})\]")
_GAPS = re.compile(r"(?<=[\w)'²])\s+(?=(?P<told>\d|-\S)|[\w(])")
_CALL = re.compile(r"(?<![^\W\d_])(?P<word>[^\W\d_]{2,8})(?:[²³]|\^\d)?\Z")
"""What may be a function at the end of a text, perhaps with its power: sin²"""
_ADDED = re.compile(r"\S\s++[-+−–]\s")
"""A sign between the terms of a sum."""
_DELIMITERS = str.maketrans("├┤", "  ")
_SUM = re.compile(r"(?<=[\w)\]'′″\s])\s*[-+−–/±]")
_MAX = 400
"""The largest number of arrays and of hidden brackets that are looked at."""


def plain_format(text: str) -> str:
    """Return an answer with the linear format written in plain text."""
    text = with_round_brackets(text)
    if "■" in text or "█" in text:
        text = _arrays(text).translate(_DELIMITERS)
    if "⎡" in text:
        text = "\n".join(_drawn(line) for line in text.split("\n"))
    if "〖" in text:
        text = _shown(text)
    if "[" in text:
        text = _rows_with_commas(text)
    text = _GROUPED_INDEX.sub(lambda m: f"_{re.sub('[ -]', '_', m[1])}".ljust(len(m.group())), text)
    text = _DOTTED.sub(_primed, text)
    found = [m.lastgroup for m in _SPACING.finditer(text)]
    before, behind = "after" in found, "mark" in found
    text = _SPACING.sub(lambda m: _spaced(m, before=before and not behind, behind=behind and not before), text)
    if ".." in text:
        text = _dots_behind(text)
    return _FRACTION.sub(_bare, text)


def _drawn(line: str) -> str:
    """A line of a matrix between tall brackets, ⎡ a   b ⎤, as a row: [a, b, then those that go on until ; c, d]."""
    match = _ROW.search(line)
    if match is None or len(_TALL.findall(line)) != 2:
        return line
    inside = _COLUMNS.sub(lambda m: ",".ljust(len(m.group())), match["row"])
    inside = inside.replace("sym.", f"{SYMMETRIC}   ")
    opened, closed = ("[" if match["open"] == "⎡" else ";"), ("]" if match["close"] == "⎦" else " ")
    return f"{line[: match.start()]}{opened}{inside}{closed}{line[match.end() :]}"


def dots_in_letters(text: str, coordinates: Sequence[str], given: Iterable[str]) -> str:
    """Return an answer that writes accelerations as x_pp, xpp or x_punktpunkt with primes, x_p and xp included.

    The names ``given`` are those of the system, which stay.
    """
    names, own = ({key(name) for name in listed} for listed in (coordinates, given))
    words = {m.group(): m for m in _LETTERED.finditer(text) if key(m.group()) not in own}
    twice = {key(m["stem"]) for m in words.values() if len(m["dots"]) in (2, 10)}
    meant = twice & names
    if meant:  # th1pp of a th1 of the answer's own beside xpp
        meant |= twice & {key(x) for x in re.findall(r"[^\W\d]\w*", text)}

    def primed(match: re.Match[str]) -> str:
        if match.group() not in words or key(match["stem"]) not in meant:
            return match.group()
        made = match["stem"].rstrip("_") + ("''" if len(match["dots"]) in (2, 10) else "'")
        return made.ljust(len(match.group()))

    return _LETTERED.sub(primed, text) if meant else text


def _rows_with_commas(text: str) -> str:
    """Matrices as in MATLAB, [a 0; -b c], with commas: where a number or a sign stands behind a gap."""

    def separated(match: re.Match[str]) -> str:
        rows = match[1].split(";")
        if "," in match[1] or (len(rows) == 1 and _ADDED.search(match[1])):
            return match.group()  # [m + M cos 2θ] L θ'' is a factor
        found = [_gaps(row) for row in rows]
        told = any(gap["told"] for gaps in found for gap in gaps)
        if not told or len({len(gaps) for gaps in found}) > 1:
            return match.group()
        return f"[{';'.join(map(_with_commas, rows, found))}]"

    return _LISTED.sub(separated, text)


def _gaps(row: str) -> list[re.Match[str]]:
    """The gaps between the entries of a row: outside brackets, and not behind a function, whose argument follows."""
    found: list[re.Match[str]] = []
    depth, at = 0, 0
    for gap in _GAPS.finditer(row.rstrip()):
        depth += row.count("(", at, gap.start()) - row.count(")", at, gap.start())
        at = gap.start()
        word = _CALL.search(row, max(0, at - 12), at)
        if depth == 0 and row[:at].strip() and (word is None or function_of(word["word"]) is None):
            found.append(gap)
    return found


def _with_commas(row: str, gaps: Sequence[re.Match[str]]) -> str:
    """A row with a comma at the beginning of each of its gaps."""
    for gap in gaps:
        row = f"{row[: gap.start()]},{row[gap.start() + 1 :]}"
    return row


def _primed(match: re.Match[str]) -> str:
    """θ ̇_1 as θ_1', with a space behind it."""
    made = f"{match['base']}{match['index'] or ''}{_MARKS[match['mark']]}"
    return made.ljust(len(match.group()))


def _spaced(match: re.Match[str], *, before: bool, behind: bool) -> str:
    """¨x and x¨ as x″; between two letters, a mark belongs to that side on which all others of the answer stand."""
    if match["amid"]:
        mark = _MARKS[match["amid"]]
        return f"{match['next']}{mark}" if before else f"{mark}{match['next']}" if behind else match.group()
    if match["before"]:
        return f"{match['after']}{_MARKS[match['before']]}"
    return _MARKS[match["mark"]]


def _dots_behind(text: str) -> str:
    """Dots behind names as primes, theta.. and theta., in an answer that writes accelerations so.

    A single dot at the end of a line is a full stop if all lines end with one.
    """
    second = rf"(?<![\w.]){_NAME}\.\.(?![.\w])"
    if re.search(second, text) is None:
        return text
    text = re.sub(rf"(?<![\w.])(\d*{_NAME})\.\.(?![.\w])", r"\1''", text)
    stops = all(line.rstrip().endswith(".") for line in text.split("\n") if "=" in line)
    last = r"(?!\s*$)" if stops else ""
    return re.sub(rf"(?<![\w.])(\d*{_NAME})\.{last}(?=\s*(?:[-+*/^²³)=,;]|$)|\s+\w)", r"\1'", text, flags=re.MULTILINE)


def _bare(match: re.Match[str]) -> str:
    """A derivative without brackets around what is above and below its line."""
    letters = list(match.group())
    for group in ("open", "close", "under", "end"):
        if match[group] is not None:
            at = match.start(group) - match.start()
            letters[at : at + len(match[group])] = " " * len(match[group])
    return "".join(letters)


def _shown(text: str) -> str:
    """The brackets 〖〗, which only group, as brackets around a sum or quotient, otherwise as spaces."""
    for _ in range(_MAX):
        end = text.find("〗")
        start = text.rfind("〖", 0, end) if end >= 0 else -1
        if start < 0:
            break
        outside = re.sub(r"\([^()]*\)", lambda m: "x" * len(m.group()), text[start + 1 : end])
        sums = _SUM.search(outside) is not None
        inner = text[start + 1 : end]
        text = f"{text[:start]}{'(' if sums else ' '}{inner}{')' if sums else ' '}{text[end + 1 :]}"
    return text.replace("〖", "(").replace("〗", ")")


def _arrays(text: str) -> str:
    """Matrices ■(a&b@c&d) as [a,b;c,d], equation arrays █(a=b@c=d) as lines."""
    for _ in range(_MAX):
        match = next(reversed(list(_ARRAY.finditer(text))), None)  # the innermost of the last
        if match is None:
            break
        end = _closing(text, match.end())
        if end < 0:
            return text
        matrix = match.group().startswith("■")
        inside = text[match.end() : end].translate(str.maketrans("&@", ",;" if matrix else " \n"))
        opened, closed = ("[", "]") if matrix else (" ", " ")
        text = f"{text[: match.start()]}{opened.rjust(match.end() - match.start())}{inside}{closed}{text[end + 1 :]}"
        if not matrix and (brace := re.search(r"\{\s*\Z", text[: match.start()])) is not None:
            text = blank(text, brace.start(), brace.end())
    return text


def _closing(text: str, start: int) -> int:
    """Where the bracket that was opened before ``start`` is closed; −1 if nowhere."""
    depth = 1
    for at in range(start, len(text)):
        depth += (text[at] == "(") - (text[at] == ")")
        if not depth:
            return at
    return -1
