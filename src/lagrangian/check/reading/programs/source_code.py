"""Takes off an answer what is code of a program: loops, tuples, tables, procedures of one's own, inputs of Maxima.

for q in (x, y):⏎    print(E(q))         a block, which states nothing and is left out
a, b = x - y, x + y                      a = x - y; b = x + y
Q = {x: F, y: 0}                         a table, which is left out
eq := EL(T - V, x) = Q:                  EL is no function of mathematics and no name: a command, which is left out
(%i2) a:x-y$  b:x+y$                     a = x-y; b = x+y;                       Maxima

Nothing is left out in which an equation of motion may stand.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from itertools import islice, pairwise

from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.programs.sessions import MATHEMATICAL, MOST, Piece, carries, closes, is_program, pieces
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.read.letters import SPELLED

_LABEL = re.compile(r"^[ \t]*+[(\[]%(?P<kind>[io])(?P<number>\d{1,4})[)\]]", re.MULTILINE)
_MATRIX = re.compile(r"(?<!\w)matrix\((?=\s*\[)")
_SHOWS = re.compile(r"[^\n=:]{1,80};[ \t]*+$", re.MULTILINE)
"""What only shows something: eq1;"""
_ASSIGNS = re.compile(rf"\s*+(?P<name>{IDENT})(?P<sign>[ \t]*+:)(?!=)")
_CONSTANT = re.compile(
    rf"(?:(?<=[(\[,*/^+=:-])|(?<=[(\[,*/^+=:-][ ]))%(?P<name>pi|e|i|{'|'.join(SPELLED.values())})(?!\w)"
)
"""A constant or a Greek letter of Maxima behind an operator, which is no comment: beta-%pi/2."""
_SESSION = re.compile(r"^[ \t]*+(?:>{1,3}[ \t]|[(\[]%i\d|In[ \t]?\[\d)", re.MULTILINE)
_MAPLE = re.compile(r"^[ \t]*+>[ \t][^\n]*+$", re.MULTILINE)
_TYPED = re.compile(r"^[ \t]*+>[ \t]++(?P<said>[^\n#]*?;[ \t]*+(?:#[^\n]*+)?$)", re.MULTILINE)
"""A statement of Maple behind its prompt."""
_OPENED = re.compile(rf"^(?P<prompt>[ \t]*+>[ \t]++)(?:{IDENT}[ \t]*+=[ \t]*+)?[\[{{(]", re.MULTILINE)
_PROMPT = re.compile(r"^[ \t]*+>[ \t]++", re.MULTILINE)
"""A prompt of Maple, and a list behind one that goes on over lines with and without prompts."""
_ENDS = re.compile(
    rf"(?<=[^\s:]):(?=[ \t]*+(?:$|#|{IDENT}(?:\([^()\n]{{0,80}}\))?[ \t]*+=|(?:read|with|lprint|print)\b))"
)
_READS = re.compile(r"[ \t>]*+(?:restart|read[ \t]++[\"'`]?[\w./\\-]{1,60}[\"'`]?|with[ \t]*+\([\w, \[\]]{1,60}\))\Z")
_LOOP = re.compile(
    r"(?P<indent>[ \t]*+)for[ \t]++[\w, ()]{1,120}[ \t]in[ \t]++(?:[(\[{]|[\w.]{1,60}+[(\[:])[^\n]{0,200}:"
    r"[ \t]*+(?:#[^\n]*+)?\Z"
)
_TUPLE = re.compile(rf"(?P<names>{IDENT}(?:[ \t]*+,[ \t]*+{IDENT}){{1,15}}+)[ \t]*+=(?!=)[ \t]*+")
_TABLE = re.compile(rf"{IDENT}[ \t]*+=[ \t]*+(?:dict\([^\n]*+|\{{[^{{}}=:]{{1,200}}:[^{{}}=]*+\}})\Z")
_DEFINED = re.compile(
    rf"[ \t>]*+(?P<name>{IDENT})\([ \t]*+(?P<by>{IDENT})[^()\n]{{0,80}}\)[ \t]*+=(?!=)(?P<body>[^\n]*+)"
)
_TEMPLATE = re.compile(rf"[ \t>]*+{IDENT}\[(?P<given>[\w ,]{{1,80}}+)\][ \t]*+:?=(?!=)")
_CALL = re.compile(r"(?<![\w.\\])(?P<name>[^\W\d]\w{1,39}+)[(\[]")
MOST_CALLS = 60
"""The most calls that are looked at in one statement."""


def without_maxima(written: TracedText) -> TracedText:
    """Return an answer in which statements that are typed into Maxima end with semicolons and assign with =; the name
    of an equation, and what only shows one, is left out. A matrix is one of SymPy, and %pi is pi."""
    written = written.sub(_CONSTANT, lambda m: m["name"])
    written = written.edited(_matrices(written.text))
    text, edits = written.text, list[Edit]()
    labels = list(islice(_LABEL.finditer(text), MOST))
    ends = [*(m.start() for m in labels[1:]), len(text)]
    for label, end in zip(labels, ends, strict=False):
        shows = _SHOWS.match(text, label.end(), end) if label["kind"] == "i" else None
        if shows is not None and text[end : end + 20].lstrip(" \t([").startswith(f"%o{label['number']}"):
            edits.append((label.start(), shows.end(), ""))
        elif label["kind"] == "i":
            edits += _typed(text, label.end(), end)
    return written.edited(edits)


def _matrices(text: str) -> Iterator[Edit]:
    """The edits that write matrix([a, b], [c, d]) as Matrix([[a, b], [c, d]])."""
    for match in islice(_MATRIX.finditer(text), MOST):
        if (end := closes(text, match.end() - 1)) > 0:
            yield *match.span(), "Matrix(["
            yield end, end, "]"


def _typed(text: str, at: int, end: int) -> Iterator[Edit]:
    """The edits of what is typed behind one label, up to its last end of a statement."""
    cuts = [at, *(m.end() for m in islice(re.compile(r"[;$]").finditer(text, at, end), MOST))]
    for start, stop in pairwise(cuts):
        assigns = _ASSIGNS.match(text, start, stop)
        if assigns is not None and "=" in text[assigns.end() : stop]:
            yield assigns.start("name"), assigns.end(), ""
        elif assigns is not None:
            yield *assigns.span("sign"), " ="
        if text[stop - 1] == "$":
            yield stop - 1, stop, ";"


def is_session(text: str) -> bool:
    """Whether lines of an answer begin with the prompt of a program."""
    return _SESSION.search(text) is not None


def without_code(
    written: TracedText, taken: Callable[[str], bool], left_out: Callable[[int], None], *, session: bool
) -> TracedText:
    """Return an answer without code that states nothing about the system; ``left_out`` is told where it was.

    ``session``: lines begin with prompts, so that a call of an unknown function is one of a procedure.
    """
    written = written.sub(_MAPLE, lambda m: _ENDS.sub(";", m.group())).sub(_TYPED, lambda m: m["said"])
    written = written.edited(apart(_prompts(written.text)))
    text, edits = written.text, list[Edit]()
    edits += _loops(text)
    own = set(_procedures(text)) if session else set[str]()
    for piece in pieces(text):
        said = text[piece.start : piece.end]
        if (session and (_calls_own(said, own, taken) or _READS.match(said))) or (
            (_TABLE.match(said) and not carries(said)) or _is_template(said)
        ):
            edits.append((piece.start, piece.end, ""))
        else:
            edits += _tuples(text, piece)
    kept = list(apart(sorted(edits)))
    for start, _, made in kept:
        if not made:
            left_out(written.origins[start] if written.origins else start)
    return written.edited(kept)


def _is_template(said: str) -> bool:
    """Whether a statement of Mathematica defines a function of anything: eq[q_, Q_] := D[D[L, q'[t]], t] == Q."""
    match = _TEMPLATE.match(said)
    given = [x.strip() for x in match["given"].split(",")] if match is not None else []
    return any(x.endswith("_") and x != "t_" for x in given)


def _prompts(text: str) -> Iterator[Edit]:
    """Nothing in the place of Maple's prompts before and in a list."""
    for match in islice(_OPENED.finditer(text), MOST):
        end = closes(text, match.end() - 1)
        if end > 0:
            yield *match.span("prompt"), ""
            yield from ((*m.span(), "") for m in _PROMPT.finditer(text, match.end(), end))


def told_commands(text: str, commands: Sequence[int]) -> str:
    """What to say about commands of a program at these places."""
    at = [str(x) for x in sorted({text.count("\n", 0, x) + 1 for x in commands})]
    named = f"Lines {', '.join(at[:-1])} and {at[-1]} hold" if len(at) > 1 else f"Line {at[0]} holds"
    return f"{named} commands of a program, which state no equation and were not judged."


def _loops(text: str) -> Iterator[Edit]:
    """Nothing in the place of loops with the lines in them, unless an equation of motion stands there."""
    lines = text.split("\n")
    places = [0]
    for line in lines:
        places.append(places[-1] + len(line) + 1)
    at = 0
    while at < len(lines):
        match, first = _LOOP.match(lines[at]), at
        at += 1
        if match is None:
            continue
        while at < len(lines) and lines[at].strip() and _deeper(lines[at], match["indent"]):
            at += 1
        if at > first + 1 and not any(map(carries, lines[first:at])):
            yield places[first], places[at] - 1, ""


def _deeper(line: str, indent: str) -> bool:
    return len(line) - len(line.lstrip()) > len(indent)


def _procedures(text: str) -> Iterator[str]:
    """The names of procedures that a session defines: they derive by what they are given."""
    for piece in pieces(text):
        match = _DEFINED.match(text, piece.start, piece.end)
        if (
            match is not None
            and re.search(rf"diff\([^=\n]{{0,200}}(?<!\w){match['by']}(?!\w)", match["body"]) is not None
        ):
            yield match["name"]


def _calls_own(said: str, own: set[str], taken: Callable[[str], bool]) -> bool:
    """Whether a procedure of the author's own is called in a statement, which holds no equation of motion."""
    if (defines := _DEFINED.match(said)) is not None and defines["name"] in own:
        return True
    return any(_is_own(said, m, own, taken) for m in islice(_CALL.finditer(said), MOST_CALLS)) and not carries(said)


def _is_own(said: str, call: re.Match[str], own: set[str], taken: Callable[[str], bool]) -> bool:
    name = call["name"]
    if name in own:
        return True
    if taken(name) or function_of(name) is not None or name in MATHEMATICAL or is_program(name):
        return False
    end = closes(said, call.end() - 1)
    inside = said[call.end() : end]
    return end > 0 and "," in inside and "=" not in inside and re.search(r"['\"]", inside) is None


def _tuples(text: str, piece: Piece) -> Iterator[Edit]:
    """One statement for each name of a tuple."""
    match = _TUPLE.match(text, piece.start, piece.end)
    if match is None:
        return
    names = [x.strip() for x in match["names"].split(",")]
    depth, cuts = 0, [match.end() - 1]
    for at in range(match.end(), piece.end):
        depth += (text[at] in "([{") - (text[at] in ")]}")
        if depth == 0 and text[at] == "," and not (text[at - 1].isdigit() and text[at + 1 : at + 2].isdigit()):
            cuts.append(at)
    entries = [text[a + 1 : b].strip() for a, b in pairwise((*cuts, piece.end))]
    if len(cuts) == len(names) and all(entries) and "=" not in text[match.end() : piece.end]:
        yield match.start(), match.end(), f"{names[0]} = "
        yield from ((at, at + 1, f"; {name} = ") for at, name in zip(cuts[1:], names[1:], strict=True))
