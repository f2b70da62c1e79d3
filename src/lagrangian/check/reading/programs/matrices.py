"""Reads the matrices of programs: how they are typed and printed, and comments that say how they belong together.

M = [a, 0; ...⏎ 0, b]              M = [a, 0;  0, b]            a statement of MATLAB that goes on
np.array([[a, 0],⏎ [0, b]])        np.array([[a, 0],  [0, b]])
qdd = np.linalg.solve(M, f)        M*qdd = f                    also inv(M) @ f and M.LUsolve(f)
xdd, ydd = np.linalg.solve(M, f)   M*[xdd; ydd] = f
qdd = M \\ (f - D*qd)              M*qdd = (f - D*qd)
M =⏎⏎ [a, 0]⏎ [0, b]               M = [a, 0; 0, b]             what MATLAB prints
h =⏎⏎  b*dx⏎   k*x                 h = [b*dx; k*x]
% q = [x; y], M(q)*qdd + h = f     q = [x; y]; M*qdd + h = f    an equation that only a comment states
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator
from itertools import islice

from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.names import COLUMNS, spelled_rates
from lagrangian.check.reading.programs.sessions import MOST, closes
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText

_WORD = r"[^\W\d]\w*"
_RATE = rf"{_WORD}['’′]{{0,2}}"
_CALL = r"(?:\w{1,8}\.)?(?:array|asarray|Matrix|MutableDenseMatrix|ImmutableDenseMatrix|ImmutableMatrix)\("
_ARRAY = re.compile(rf"(?<![\w.\\{{]){_CALL}(?=\s*+\[)")
_MATRIX = re.compile(rf"^[ \t]*+({IDENT})[ \t]*+=[ \t]*+(?:\[|diag\(|{_CALL})", re.MULTILINE)
_MARK = re.compile(
    r"[\[\]]|\n[ \t]*+\n|(?P<more>\.\.\.[ \t]*+(?:%[^\n]*+)?\n)"
    r"|(?<=[\w)\]'])(?P<row>[ \t]*+(?:%[^\n]*+)?\n[ \t]*+(?=[\w(\[-]))"
)
_MATLAB = re.compile(r"^[ \t]*+function[ \t]|=[ \t]*+@\(", re.MULTILINE)
"""A function of MATLAB, in which the end of a line ends a row of a matrix."""
_FACTOR = r"[^\W\d]\w{0,23}+|\([^()\n=]{1,200}\)"
_SOLVED = re.compile(
    rf"(?<![\w.])(?P<left>{IDENT}['’′]{{0,2}}(?:[ \t]*+,[ \t]*+{IDENT}){{0,8}})[ \t]*+=[ \t]*+(?:"
    rf"(?:(?:\w{{1,6}}\.){{0,3}}solve\([ \t]*+|(?=\w{{1,24}}\.LUsolve))(?P<of>{IDENT})(?:[ \t]*+,|\.LUsolve\()"
    r"[ \t]*+(?P<by>(?:[^()\n=;,]|\([^()\n=;]{0,80}\)){1,200})\)"
    rf"|(?:(?:\w{{1,6}}\.){{0,3}}inv\([ \t]*+(?P<inverse>{IDENT})[ \t]*+\)|(?P<own>{IDENT})\.inv\(\))"
    rf"[ \t]*+[@*][ \t]*+(?P<factor>{_FACTOR})"
    r"(?=[ \t]*+(?:$|[;#%]|[ \t]{2})))",
    re.MULTILINE,
)
_DIVIDED = re.compile(
    rf"^(?P<indent>[ \t]*+)(?P<left>{IDENT})[ \t]*+=[ \t]*+(?P<of>{IDENT})[ \t]*+\\[ \t]*+"
    rf"(?P<by>{IDENT}|\((?:[^()\n=]|\([^()\n=]{{0,80}}\)){{1,300}}\))(?=[ \t]*+(?:$|[;%]))",
    re.MULTILINE,
)
"""A column divided by a matrix from the left, as in MATLAB."""
_RETURNED = re.compile(
    rf"^(?P<before>[ \t]*+)return[ \t]++(?=(?:(?:\w{{1,6}}\.){{0,3}}(?:solve|inv)\(|{IDENT}\.(?:inv|LUsolve)\())",
    re.MULTILINE,
)
"""What returns the accelerations for which it solves: return np.linalg.solve(M, f)."""
_JULIA = re.compile(r"\bModelingToolkit\b|\bDifferential\(|@(?:variables|parameters|mtkmodel)\b|(?<!\w)D\(D\(")
_EQUATES = re.compile(r"(?<=\S)[ \t]+~[ \t]+(?=\S)")
"""The sign of an equation of Julia, also in a list."""
_SHOWN = re.compile(rf"[ \t]*+(?P<name>{IDENT})[ \t]*+=[ \t]*+\Z")
_BRACKETED = re.compile(r"[ \t]*+(?P<open>\[)[^\[\]=]*+(?P<close>\])[ \t]*+\Z")
_ENTRY = re.compile(r"[ \t]++(?![+*/^)]|-[ \t])[^\[\]{}=%#>;]*[^\s\[\]{}=%#>;+*/^(-][ \t]*+\Z")
_ENDS = re.compile(r"[ \t]*+(?:$|[#%]|>>)")
"""What stands below a matrix: a blank line, a comment or the next command."""
_COMMENT = re.compile(r"(?P<prompt>^[ \t]*+>>[ \t]*+)?(?<![\\\w])(?P<mark>[#%]+|//)(?P<said>[^\n]*+)", re.MULTILINE)
_CUT = re.compile(
    r"[()\[\]]|(?P<cut>[,;.](?=\s|$)|:(?!=)|\b(?:with|where|and|so|mit|wobei|und)\b"
    r"|(?<=[^\s=+*/-])[ \t]{2,}(?![=+*/-]))"
)
_ARGUMENTS = re.compile(r"(?<!\w)(?P<of>[^\W\d]\w{0,23})\((?P<by>[\w ,'’′]{1,40})\)")
_COLUMN = re.compile(
    rf"(?:(?:the|states?|vector|column)[ \t]++){{0,3}}(?P<name>{IDENT})[ \t]*+=[ \t]*+"
    r"[\[(](?P<entries>[\w ,;'’′]{3,200})[\])](?:\.?['’]|\^T|ᵀ)?"
)
_BY_TIME = re.compile(r"(?<!\w)d(?P<of>[^\W\d_]\w{0,11}?)(?:/|_)?dt(?!\w)")
"""The rate of a column: dz/dt, dzdt."""
_ORDER = re.compile(r"\bcoordinates[^\S\n][^\n\[\](=]{0,20}[\[(](?P<entries>[\w ,;]{3,200})[\])]")
"""The order of the coordinates in words: generalized coordinates [x; theta]."""
_LISTED = re.compile(
    r"(?<![\w\\])(?:\\(?:mathbf|boldsymbol|bm|vec)[ ]?)?[{*]{0,2}(?P<of>q|z|ξ|\\xi)[}*]{0,2}"
    r"[ \t$]{0,3}&?[=:][ \t$]{0,3}"
    r"(?:(?:\\left)?[\[(](?P<plain>[^\[\]()=\n]{3,120}?)(?:\\right)?[\])]"
    r"|\\begin\{[bp]?matrix\}(?P<latex>[^=\n]{3,160}?)\\end\{[bp]?matrix\})"
)
"""The column of the coordinates: q = (θ, s)ᵀ."""
_NO_LIST = re.compile(r"[-−+/^]|\*|\d[ ]?[^\W\d]|\A[^,;&\s\\]{1,60}\Z")
"""What is in a formula, and in no list of names: z = (x2 - x1)."""
LONGEST = 400
"""The most characters of a comment that states an equation."""


def with_whole_matrices(written: TracedText) -> TracedText:
    """Return an answer in which every matrix that is typed stands on one line, and none is inverted by a function."""
    written = written.sub(_EQUATES, lambda m: " = ") if _JULIA.search(written.text) else written
    written = written.edited(_continued(written.text))
    written = written.edited(_arrays(written.text))
    given = set(_MATRIX.findall(written.text))
    written = written.sub(_RETURNED, lambda m: f"{m['before']}qdd = ") if given else written
    return written.sub(_DIVIDED, _multiplied(given)).sub(_SOLVED, lambda m: _product(m, given)) if given else written


def with_shown_matrices(written: TracedText) -> TracedText:
    """Return an answer in which a matrix that MATLAB prints, or a column, stands on one line with brackets."""
    found = list(_shown(written.text))
    names = {name for name, _ in found}
    written = written.edited(edit for _, edits in found for edit in edits)
    if not names:
        return written
    command = re.compile(
        rf"^[ \t]*+>>[ \t]*+(?:{'|'.join(names)})[ \t]*+(?:=(?!=)[^\n%]*+|;?[ \t]*+(?=%|$))", re.MULTILINE
    )
    return written.sub(command, lambda m: "")


def told_order(text: str) -> list[str]:
    """The names of the coordinates in the order in which an answer lists them; none if it does not."""
    if (match := _ORDER.search(text)) is not None:
        return re.findall(_WORD, match["entries"])
    listed = [m for m in _LISTED.finditer(text) if _NO_LIST.search(m["plain"] or m["latex"]) is None]
    match = next((m for m in listed if m["of"] == "q"), listed[0] if listed else None)
    return [] if match is None else [x.removeprefix("var") for x in re.findall(_WORD, match["plain"] or match["latex"])]


def with_equations_in_comments(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which equations of matrices that only comments state are statements, and the column of
    coordinates in them; ``taken`` says whether a name belongs to the system."""
    text = written.text
    code = _COMMENT.sub(" ", text)
    counts = Counter(re.findall(_WORD, code))
    given = set(_MATRIX.findall(code))
    unused = {name for name in given if counts[name] == 1}
    return written.edited(_stated(text, code, given, unused, taken)) if given else written


def _continued(text: str) -> Iterator[Edit]:
    """Blanks for the marks with which a line of a matrix goes on below, and semicolons for the ends of rows."""
    depth, rows = 0, _MATLAB.search(text) is not None
    for match in _MARK.finditer(text):
        mark = match.group()
        if match["more"] or match["row"]:
            if depth and (match["more"] or rows):
                yield *match.span(), " " if match["more"] else "; "
        else:
            depth = depth + 1 if mark == "[" else max(0, depth - 1) if mark == "]" else 0


def _arrays(text: str) -> Iterator[Edit]:
    """Blanks for the ends of lines inside the call that makes a matrix."""
    last = 0
    for match in islice(_ARRAY.finditer(text), MOST):
        if match.start() >= last and (end := closes(text, match.end() - 1)) > 0:
            last = end
            yield from ((k, k + 1, " ") for k in range(match.end(), end) if text[k] == "\n")


def _multiplied(given: set[str]) -> Callable[[re.Match[str]], str]:
    """What makes of such a quotient the product that equals the column, where the matrix is given."""

    def made(match: re.Match[str]) -> str:
        of, left = match["of"], match["left"]
        if of not in given or not any(stem in COLUMNS or stem in given for _, stem in spelled_rates(left)):
            return match.group()  # accelerations of any name
        return f"{match['indent']}{of}*{left} = {match['by']}"

    return made


def _product(match: re.Match[str], given: set[str]) -> str:
    """The product that equals what is solved for; the text as it is if the matrix is not given."""
    of = match["of"] or match["inverse"] or match["own"]
    left = match["left"] if "," not in match["left"] else f"[{match['left'].replace(',', ';')}]"
    return f"{of}*{left} = {match['by'] or match['factor']}" if of in given else match.group()


def _shown(text: str) -> Iterator[tuple[str, list[Edit]]]:
    """The names and the edits of matrices in lines of their own below a name and an equals sign."""
    lines = text.split("\n")
    places = [0]
    for line in lines:
        places.append(places[-1] + len(line) + 1)
    for i, line in enumerate(lines):
        named = _SHOWN.match(line) if len(line) <= LONGEST else None
        first = next((k for k in range(i + 1, min(i + 4, len(lines))) if lines[k].strip()), i + 1)
        if named is None or (first == i + 1 and ">>" not in text):  # without a session, a sum may go on below
            continue
        for form in (_BRACKETED, _ENTRY):
            rows = list(_rows(lines, first, form))
            if form is _ENTRY and (len(rows) < 2 or any(not _balanced(m.group()) for m in rows)):
                continue
            last = first + len(rows)
            if rows and (last == len(lines) or _ENDS.match(lines[last])):
                yield named["name"], list(_joined(places, i, first, rows))
                break


def _rows(lines: list[str], first: int, form: re.Pattern[str]) -> Iterator[re.Match[str]]:
    for line in lines[first : first + MOST]:
        match = form.match(line) if line.strip() and len(line) <= 4 * LONGEST else None
        if match is None:
            return
        yield match


def _joined(places: list[int], named: int, first: int, rows: list[re.Match[str]]) -> Iterator[Edit]:
    """The edits that put rows below each other into one pair of brackets."""
    at = places[named + 1] - 1
    for k, row in enumerate(rows):
        bracketed = "open" in row.re.groupindex
        begin, end = row.span("open")[1] if bracketed else 0, row.start("close") if bracketed else len(row.group())
        yield at, places[first + k] + begin, "; " if k else " ["
        at = places[first + k] + end
    yield at, places[first + len(rows)] - 1, "]"


def _balanced(text: str) -> bool:
    """Whether round brackets are closed in a text where they are opened."""
    depth = 0
    for c in text:
        depth += (c == "(") - (c == ")")
        if depth < 0:
            return False
    return depth == 0


def _stated(text: str, code: str, given: set[str], unused: set[str], taken: Callable[[str], bool]) -> Iterator[Edit]:
    """The edits that state what comments say about matrices; the rest of a comment stays one."""
    comments = [m for m in islice(_COMMENT.finditer(text), MOST) if len(m["said"]) <= LONGEST]
    columns: dict[str, str] = {}
    renamed: dict[str, str] = {}
    for comment in comments:
        for piece in _pieces(comment["said"]):
            if (column := _COLUMN.fullmatch(piece)) is None:
                continue
            if own := _own_name(column, text, code, taken):
                renamed[column["name"]] = own
                columns[own] = piece
            elif _is_column(column, code, taken):
                columns.setdefault(column["name"], piece)
    for comment in comments:
        stated, rest = list[str](), list[str]()
        for piece in _pieces(comment["said"]):
            column = next((name for name, listed in columns.items() if piece and listed == piece), None)
            said = "" if column else _equation(_put(piece, renamed), given, unused, {*columns, *COLUMNS}, taken)
            if column is not None:
                entries = re.findall(_RATE, columns[column].partition("=")[2].removesuffix("^T"))
                columns[column] = ""
                stated.insert(0, f"{column} = [{'; '.join(entries)}]")
            elif said:
                stated.append(said)
            else:
                rest.append(piece)
        if stated:
            behind = text[text.rfind("\n", 0, comment.start()) + 1 : comment.start()].strip()
            kept = f"\n{comment['mark']} {'; '.join(rest)}" if rest else ""
            yield *comment.span(), f"{'; ' if behind else ''}{'; '.join(stated)}{kept}"


def _own_name(column: re.Match[str], text: str, code: str, taken: Callable[[str], bool]) -> str:
    """A name for the state x = [phi; x; …] of a program in whose code the coordinate x does not occur; none for another
    column."""
    name, entries = column["name"], re.findall(_WORD, column["entries"])
    if name not in entries or not taken(name) or re.search(rf"(?<!\w){name}(?!\w)", code):
        return ""
    free = (
        x for x in ("z", "y", "q", "X") if not taken(x) and re.search(rf"(?<!\w)d?{x}(?:_?dot)?(?!\w)", text) is None
    )
    states = all(taken(x) or any(taken(stem) for _, stem in spelled_rates(x)) for x in entries)
    return next(free, "") if states and len(entries) > 1 else ""


def _put(piece: str, renamed: dict[str, str]) -> str:
    """A part of a comment with other names for columns and their rates."""
    for name, own in renamed.items():
        piece = re.sub(rf"(?<!\w)(d?){name}(?=(?:_?dot|_?dt|/dt)?(?!\w))", rf"\g<1>{own}", piece)
    return piece


def _pieces(said: str) -> Iterator[str]:
    """The parts of a comment between commas, colons, wide gaps and linking words outside brackets."""
    depth = start = 0
    for match in _CUT.finditer(said):
        if match["cut"] is None:
            depth += 1 if match.group() in "([" else -1
        elif depth <= 0:
            yield said[start : match.start()].strip()
            start = match.end()
    yield said[start:].strip()


def _is_column(column: re.Match[str], code: str, taken: Callable[[str], bool]) -> bool:
    """Whether a comment says which coordinates a column holds, and which of their rates if it is the state of a
    program that takes none of its entries."""
    entries, name = re.findall(_WORD, column["entries"]), column["name"]  # without primes
    assigned = re.search(rf"(?<!\w){name}[ \t]*=(?!=)", code) is not None
    rates = [x for x in entries if not taken(x)]
    known = all(any(taken(stem) for _, stem in spelled_rates(x)) for x in rates)
    indexed = bool(rates) and re.search(rf"(?<![\w.]){name}[(\[]\d", code) is not None
    return len(entries) > 1 and known and not indexed and not taken(name) and not assigned


def _equation(piece: str, given: set[str], unused: set[str], columns: set[str], taken: Callable[[str], bool]) -> str:
    """The equation of matrices that a part of a comment states, without arguments; nothing if it states none."""
    said = _SOLVED.sub(lambda m: _product(m, given), piece.replace("==", "="))
    said = _ARGUMENTS.sub(lambda m: m["of"] if m["of"] in given else m.group(), said)
    said = _BY_TIME.sub(lambda m: f"{m['of']}'" if m["of"] in columns else m.group(), said)
    words = re.findall(_WORD, said)
    if said.count("=") != 1 or not unused & set(words) or len(words) < 2:
        return ""
    called = re.findall(rf"({_WORD})\(", said)
    rates = [w for w in words if any(stem in columns for _, stem in spelled_rates(w))]
    known = {w for w in words if w in given or w in columns or taken(w) or function_of(w) is not None}
    known |= {w for w in words if any(stem in columns or taken(stem) for _, stem in spelled_rates(w))}
    if not known.issuperset(words) or any(function_of(x) is None for x in called):
        return ""
    left, _, right = said.partition("=")
    if left.strip() in given:
        return f"{right.strip()} = {left.strip()}" if rates or "'" in right or "[" in right else ""
    return said
