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
_GAPS = re.compile(r"(?<=[\w)'²])\s+(?=[\w(]|-\S)")
_TOLD = re.compile(r"[\w)'²]\s+(?:\d|-\S)")
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
        found = [_GAPS.sub(lambda m: ",".ljust(len(m.group())), row.strip().rjust(len(row))) for row in rows]
        counts = {row.count(",") for row in found}
        told = any(_TOLD.search(row) for row in rows) and "," not in match[1]
        return f"[{';'.join(found)}]" if told and len(counts) == 1 and counts != {0} else match.group()

    return _LISTED.sub(separated, text)


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
