"""Takes off what programs set around equations: comments in brackets, prompts, names of lists, fields of parameters.

(* ks is k_s *)  /* ks is k_s */  # ks is k_s                 a comment of Mathematica, Maple or C
(%o7) m*x'' = F                 m*x'' = F                     a line of Maxima
eq1(t) =⏎ a == b                a == b                        a function of time that MATLAB shows
>> EL = simplify(…)             EL = m*x'' + …                a command of MATLAB and the result that it shows
EL =⏎⏎ m*x'' + …
sys = {a == b,⏎ c == d}         {a == b,⏎ c == d}             a list of equations
p.m*p.g                         m*g                           the fields of a structure
S.dds =⏎⏎ (F - …)/m              dds = (F - …)/m               a solution
v.'*v                           v^T*v                         a column that is transposed
A = diag([m J]);                A = diag(m, J)                a diagonal
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from itertools import islice

from lagrangian.check.reading.characters import LATEX
from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.programs.matrices import with_equations_in_comments, with_shown_matrices
from lagrangian.check.reading.programs.sessions import carries
from lagrangian.check.reading.traced_text import Edit, TracedText, line_end
from lagrangian.errors import Place

MOST, LONGEST = 200, 2_000
"""The most marks of one kind that are looked at, and the most characters of a comment in brackets."""

_COMMENT = re.compile(
    rf"\(\*(?!\))(?P<said>(?:(?!\*\)|\(\*).){{1,{LONGEST}}}?)\*\)|/\*(?P<slashed>(?:(?!\*/|/\*).){{1,{LONGEST}}}?)\*/",
    re.DOTALL,
)
_TERMINATED = re.compile(r"\$(?=[ \t]*$)", re.MULTILINE)
_PAIRED = re.compile(r"\$[^\n]*\$|\$(?![ \t]*$)|\\[A-Za-z]|^[ \t]*\$", re.MULTILINE)
"""How statements end in Maxima, and what dollar signs of LaTeX have about them."""
_LABELLED = re.compile(r"^[ \t]*+(?:\(%[iot]\d{1,4}\)|\[%[iot]\d{1,4}\])", re.MULTILINE)
"""How Maxima numbers what is typed and what it answers."""
_LIST = re.compile(rf"^[ \t]*+{IDENT}[ \t]*+=[ \t]*+(?=[{{\[])", re.MULTILINE)
_COMMAND = re.compile(rf"^[ \t]*+>>>?[ \t]*+(?:(?P<name>{IDENT})[ \t]*+=(?!=)[^\n]*+|(?=[^\W\d%#]))", re.MULTILINE)
_SHOWN = re.compile(
    rf"^[ \t]*+(?P<name>{IDENT})[ \t]*+=(?P<gap>[ \t]*+\n(?:[ \t]*+\n){{1,3}})(?=[^\n=]+$)", re.MULTILINE
)
_SHOWN_OF_TIME = re.compile(
    rf"^[ \t]*+(?P<name>{IDENT})\(t\)[ \t]*+=[ \t]*+\n(?:[ \t]*+\n){{0,3}}(?=(?P<states>[^\n=]*+=)?[^\n]*\S)",
    re.MULTILINE,
)
"""What MATLAB shows of a function of time: eq1(t) = ⏎ a == b."""
_SOLUTION = re.compile(rf"^[ \t]*+[A-Za-z]\w{{0,11}}\.(?={IDENT}[ \t]*+=(?!=))", re.MULTILINE)
"""The structure of a solution: S.dds = …"""
_NUMBERED = re.compile(
    r"^[ \t>]*+(?:eq|Eq|EQ|equation|ode|de|gl|EL|EOM|eom)[a-z]{0,9}[\[(]\d{1,2}[\])][ \t]*+:?=[ \t]*+(?=[^\n=]*=|Eq\()",
    re.MULTILINE,
)
"""An entry of a list of equations: eq[1] := a = b."""
_ANSWERED = re.compile(
    rf"^[ \t]*+>>[ \t]*+(?:[a-z]{{4,16}}\()?(?:{IDENT}\.)?(?P<name>{IDENT})\)?[ \t]*+\n\s{{0,9}}ans[ \t]*+=(?=\s)",
    re.MULTILINE,
)
"""What MATLAB answers to the name of a quantity: simplify(S.xdd) ⏎ ans = …"""
_TRANSPOSED = re.compile(r"(?<=[\w)\]])\.['’]")
_DIAGONAL = re.compile(r"(?<!\w)diag\([ \t]*\[(?P<entries>[^\[\]()=\n]{1,300})\][ \t]*\)")
_BLOCK = re.compile(r"(?:^[ \t]*+(?:[#%]+|//(?=\s))[^\n]*+(?:\n|\Z))++", re.MULTILINE)
"""Lines below each other that are comments."""
_BEHIND = re.compile(r"(?<=\S)[ \t]++(?P<mark>[#%]++|//(?=\s))(?P<said>[^\n]*+)$", re.MULTILINE)
"""A comment behind a statement."""
_LED = re.compile(r"(?<![\w/])dd(?=[^\W\d])")
"""The letters in front of an acceleration, ddx."""
_SOLVES = re.compile(
    r"\b(?:solve|inv|solve_ivp|odeint|ode\d{2}s?|ODEProblem|lambdify|rk4|RK4)[ \t]*+\(|^[ \t]*+(?:def|function)\b",
    re.MULTILINE,
)
"""What a program has that computes motions."""
_SIGN = re.compile(r"[#%]|//(?=\s)")
_WHOLE_LINE_COMMENT = re.compile(r"^[ \t]*+(?:[#%]+|//(?=\s))(?P<said>[^\n]*+)$", re.MULTILINE)
_FIELD = re.compile(
    rf"(?<![\w.)\]])(?!(?:i\.e|e\.g|d\.h|z\.B|u\.a|s\.o|s\.u)\.)(?P<of>[A-Za-z]\w{{0,11}})\.(?P<name>{IDENT})(?![\w(])"
)


def without_program_marks(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text without these marks; ``taken`` says whether a name belongs to the system."""
    written = written.edited(_comments(written.text)).sub(_LABELLED, lambda m: "")
    written = written.sub(_NUMBERED, lambda m: "").sub(_ANSWERED, lambda m: f"{m['name']} =")
    written = written.sub(_SOLUTION, lambda m: "").sub(_TRANSPOSED, lambda m: "^T")
    written = with_shown_matrices(written)
    shown = {m["name"] for m in _SHOWN.finditer(written.text)}
    shown |= {m["name"] for m in _SHOWN_OF_TIME.finditer(written.text) if not taken(m["name"])}
    if shown and ">>" in written.text:
        written = written.sub(_COMMAND, lambda m: "" if m["name"] in (None, *shown) else m.group())
    written = written.edited([(*m.span("gap"), " ") for m in _SHOWN.finditer(written.text)])
    written = written.sub(_SHOWN_OF_TIME, lambda m: _shown_of_time(m, taken))
    written = written.edited(_list_names(written.text))
    written = written.edited(_diagonals(written.text))
    written = with_equations_in_comments(written, taken)
    return written.edited(_fields(written.text, taken))


def _shown_of_time(match: re.Match[str], taken: Callable[[str], bool]) -> str:
    """Nothing in the place of the name of an equation, and an equals sign behind that of an expression."""
    if taken(match["name"]):
        return match.group()
    return "" if match["states"] else f"{match['name']} = "


def told_comments(text: str, *, read: bool = False) -> Iterator[str]:
    """What to say about comments and headings that hold an equation of motion, and that are ``read`` or not."""
    why = "was read, though it is a comment: no other line states an equation of motion"
    whole = [m for block in _blocks(text) for m in block if _moves(m["said"])]
    for match in sorted((*whole, *_behind(text)), key=lambda m: m.start()):
        yield f"'{' '.join(match.group().split())}' {why if read else 'was not judged: it is a comment'}."


def is_program(text: str) -> bool:
    """Whether LaTeX stands in no line of a text but in comments."""
    return LATEX.search(_WHOLE_LINE_COMMENT.sub("", text)) is None


def in_comment(text: str, place: Place) -> bool:
    """Whether a place is in a comment, behind its sign."""
    lines = text.split("\n")
    row = lines[place.line - 1] if place.line is not None and 0 < place.line <= len(lines) else ""
    return _SIGN.search(row[: place.column or 0]) is not None


def told_beside_comments(text: str, places: Sequence[Place]) -> tuple[str, ...]:
    """What to say about a program that solves for accelerations and was not carried out, where the ``places`` of all
    equations of motion are in comments."""
    if not places or _SOLVES.search(text) is None or not all(in_comment(text, x) for x in places):
        return ()
    return ("What the program computes was not carried out and was not judged: its comments were.",)


def with_comments_read(written: TracedText) -> TracedText:
    """Return an answer in which what comments say is no comment, where an equation of motion stands there. Beside LaTeX
    in comments, the lines of a program are left out."""
    marks = [m for block in _blocks(written.text) for m in block]
    if LATEX.search(written.text):
        said = [m.span("said") for m in marks]
        ends = [0, *(x for span in said for x in span), len(written.text)]
        return written.edited(
            [(a, b, "\n" * written.text.count("\n", a, b)) for a, b in zip(ends[::2], ends[1::2], strict=True)]
        )
    edits = [(m.start(), m.start("said"), " " * (m.start("said") - m.start())) for m in marks]
    return written.edited((*edits, *((*m.span("mark"), ";") for m in _behind(written.text))))


def _behind(text: str) -> Iterator[re.Match[str]]:
    """The comments behind statements in which an equation of motion stands."""
    for match in islice(_BEHIND.finditer(text), MOST):
        above = text[text.rfind("\n", 0, match.start()) + 1 : match.start()]
        if "=" in match["said"] and _moves(match["said"]) and not _WHOLE_LINE_COMMENT.match(above):
            yield match


def _blocks(text: str) -> Iterator[list[re.Match[str]]]:
    """The comments below each other in which an equation of motion stands."""
    for block in islice(_BLOCK.finditer(text), MOST):
        lines = list(islice(_WHOLE_LINE_COMMENT.finditer(text, *block.span()), MOST))
        if any("=" in m["said"] for m in lines) and any(_moves(m["said"]) for m in lines):
            yield lines


def _moves(said: str) -> bool:
    """Whether an equation of motion may stand in a comment."""
    return len(said) < LONGEST and carries(_LED.sub("''", said))


def without_terminators(written: TracedText) -> TracedText:
    """Return an answer in which the statements of Maxima do not end with dollar signs."""
    if "$" not in written.text or _PAIRED.search(written.text):
        return written
    return written.sub(_TERMINATED, lambda m: ";")


def _comments(text: str) -> Iterator[Edit]:
    """The marks of comments that end with their line, in the place of those in brackets; nothing where one is inside a
    line."""
    for match in islice(_COMMENT.finditer(text), MOST):
        first, end = text.rfind("\n", 0, match.start()) + 1, line_end(text, match.end())
        above, below = text[first : match.start()].strip(), text[match.end() : end].strip()
        if above and below:
            yield *match.span(), " "
            continue
        yield match.start(), match.start() + 2, "\n# " if above else "# "
        inside = match.span("said" if match["said"] is not None else "slashed")
        yield from ((k, k + 1, "\n# ") for k in range(*inside) if text[k] == "\n")
        yield match.end() - 2, match.end(), "\n" if below else " "


def _diagonals(text: str) -> Iterator[Edit]:
    """The entries alone, with commas, of a diagonal that is given as a list: diag([a b]) as diag(a, b)."""
    for match in _DIAGONAL.finditer(text):
        listed = match["entries"]
        by = "," if "," in listed else ";" if ";" in listed else None
        entries = [x.strip() for x in listed.split(by)]
        if all(x and x[-1] not in "+-*/" and x.strip("+-*/") for x in entries):
            yield *match.span(), f"diag({', '.join(entries)})"


def _list_names(text: str) -> Iterator[Edit]:
    """Nothing in the place of the name of a list whose entries are equations."""
    for match in islice(_LIST.finditer(text), MOST):
        depth = 0
        for at in range(match.end(), min(len(text), match.end() + 2 * LONGEST)):
            depth += (text[at] in "([{") - (text[at] in ")]}")
            if depth == 0:
                inside = text[match.end() : at]
                if "==" in inside or re.search(r"\bEq\(", inside) or _are_equations(inside):
                    yield *match.span(), ""
                break


def _are_equations(listed: str) -> bool:
    """Whether all entries of a list have an equals sign."""
    depth, entries = 0, [""]
    for c in listed:
        depth += (c in "([{") - (c in ")]}")
        entries = [*entries, ""] if c == "," and not depth else [*entries[:-1], entries[-1] + c]
    return all("=" in x for x in entries)


def _fields(text: str, taken: Callable[[str], bool]) -> Iterator[Edit]:
    """The names of fields alone, p.m as m, where every field of the structure is a name of the system."""
    found: dict[str, list[re.Match[str]]] = {}
    for match in _FIELD.finditer(text):
        found.setdefault(match["of"], []).append(match)
    for of, fields in found.items():
        if not taken(of) and all(taken(m["name"]) for m in fields):
            yield from ((m.start(), m.start("name"), "") for m in fields)
