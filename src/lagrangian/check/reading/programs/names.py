"""Reads what programs say about the names that they use, in declarations and in comments.

a, W = symbols('a Omega')                  W = Omega         a name of Python for one of the system
th = Function('theta')(t)                  th = theta
# i is dq/dt, w1, w2 = their rates         i = q'            a comment
# kinematics: x' = v                       v = x'
di_dt = …   dw = …                         i' = …  w' = …    a rate
Eq(a,⏎   b)                                Eq(a, b)          a call in several lines
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import chain, islice

from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

MOST, LONGEST = 60, 4_000
"""The most comments, rates and calls that are looked at, and the longest call in several lines."""

_LIST = rf"{IDENT}(?:[ \t]*+,[ \t]*+{IDENT}){{0,15}}+"
_DECLARED = re.compile(
    rf"^[ \t]*+(?P<names>{_LIST})[ \t]*+=[ \t]*+(?:\w{{1,6}}\.)?(?:symbols|dynamicsymbols|var|Symbol|Function)"
    r"\([ \t]*+(?P<quote>['\"])(?P<called>[\w ,]{1,400}+)(?P=quote)(?![ \t]*+,[ \t]*+\d)[^\n]*+$",
    re.MULTILINE,
)
_FUNCTION = re.compile(
    rf"(?:^|;)[ \t]*+(?P<names>{IDENT})[ \t]*+=[ \t]*+(?:\w{{1,6}}\.)?Function"
    r"\([ \t]*+['\"](?P<called>\w{1,24})['\"][ \t]*+\)(?:\(t\))?",
    re.MULTILINE,
)
_OF_TIME = re.compile(rf"(?<!\w)(?P<name>{IDENT})\[t_\][ \t]*+:?=(?!=)")
"""A function of Mathematica: y[t_] := Y Sin[w t]."""
_CALL = re.compile(r"(?<!\w)Eq\w{0,6}\(")
_RATE_OF = re.compile(r"(?<!\w)d(?P<two>2|\^2|²)?_?(?P<of>[^\W\d_]\w{0,20}?)_?dt(?(two)_?\^?2)(?=[ \t]*+=(?!=))")
_RATE = re.compile(r"^[ \t]*+(?P<rate>d_?(?P<of>[^\W\d_]\w{0,20}))(?=[ \t]*+=(?!=)[ \t]*+[^ \t\[])", re.MULTILINE)
_COMMENT = re.compile(r"(?<![\\\w])(?P<mark>[#%]+|//)(?P<said>[^\n]*+)")
_IS = r"(?:=|:=|:|is|are|denotes|means|stands[ ]for|<-|->)"
_VALUE = rf"d[ ]?{IDENT}[ ]?/[ ]?dt|der\({IDENT}\)|{IDENT}['’′]{{0,2}}"
_OF_LIST = rf"their[ ](?:rates|velocities|speeds|derivatives)|{_VALUE}(?:[ ]?,[ ]?(?:{_VALUE}))*"
_SAID = re.compile(
    rf"(?<![\w.])(?P<new>{_LIST})[ \t]*+{_IS}[ \t]*+(?:the[ ]|rate[ ]of[ ])*(?P<own>{_OF_LIST})(?![\w(^*/+-]|[ ]*{_IS})"
)
_NAMES_RATE = re.compile(
    rf"(?<![\w.*/^+-])(?P<own>d[ ]?{IDENT}[ ]?/[ ]?dt|der\({IDENT}\)|{IDENT}['’′]{{1,2}})[ \t]*+(?:=|:=|->)[ \t]*+"
    rf"(?P<new>{IDENT})(?=[ \t]*+(?:[.,;]|$|(?:and|und)\b))"
)
"""A rate and the name for it: x' = v."""
_FORMULA = re.compile(
    rf"^[ \t]*+(?P<mark>[#%]+|//)[ \t]*+(?P<name>{IDENT})[ \t]*+=[ \t]*+"
    r"(?P<value>[^=\n]{1,200}?)(?P<words>[ \t]{2,9}[^\W\d_][^=\n]{0,200})?$",
    re.MULTILINE,
)
"""A definition that stands in a comment alone."""
_DERIVED = re.compile(rf"d[ ]?(?P<of>{IDENT})[ ]?/[ ]?dt|der\((?P<in>{IDENT})\)")


def with_program_names(written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text in which declarations and comments that name quantities of the system state them.

    ``moves`` says whether a name changes with time, ``taken`` whether it belongs to the system.
    """
    text = written.text
    edits = list(_commented(text, taken))
    edits += [(*m.span(), f"{m['name']} = ") for m in _OF_TIME.finditer(text)]
    edits += _joined(text)
    rates = [m for m in _RATE_OF.finditer(text) if not taken(m.group())]
    edits += [(*m.span(), m["of"] + ("''" if m["two"] else "'")) for m in rates]
    edits += _rates(text, moves, taken)
    return written.edited(apart(edits))


def with_declared(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which declarations that name letters of the system otherwise state them: al = alpha."""
    return written.edited(apart(list(_declared(written.text, taken))))


def _declared(text: str, taken: Callable[[str], bool]) -> Iterator[Edit]:
    """The statements in the place of declarations whose names differ from what is declared."""
    for match in (*_DECLARED.finditer(text), *_FUNCTION.finditer(text)):
        names = re.findall(IDENT, match["names"])
        called = re.findall(IDENT, match["called"])
        pairs = [(a, b) for a, b in zip(names, called, strict=False) if a != b and taken(b) and not taken(a)]
        if len(names) == len(called) and pairs:
            yield *match.span(), "\n" + "; ".join(f"{a} = {b}" for a, b in pairs)


def _joined(text: str) -> Iterator[Edit]:
    """Blanks for the ends of lines inside Eq( … )."""
    for match in islice(_CALL.finditer(text), MOST):
        depth = 0
        for at in range(match.end() - 1, min(len(text), match.end() + LONGEST)):
            depth += (text[at] in "([") - (text[at] in ")]")
            if depth == 0:
                inside = range(match.end(), at)
                yield from ((k, k + 1, " ") for k in inside if text[k] == "\n")
                break


def _rates(text: str, moves: Callable[[str], bool], taken: Callable[[str], bool]) -> Iterator[Edit]:
    """w' for dw at the beginning of a line of a program, where w is a name of its own that is used elsewhere."""
    for match in islice(_RATE.finditer(text), MOST):
        name, of = match["rate"], match["of"]
        used = re.findall(rf"(?<!\w){of}(?!\w)", text)
        alone = len(re.findall(rf"(?<!\w){name}(?!\w)", text)) == 1
        listed = re.search(rf"(?<!\w){of}[(\[]\d[)\]]", text) is not None
        if used and alone and not listed and not taken(name) and not taken(of) and not moves(name):
            yield *match.span("rate"), f"{of}'"


def _commented(text: str, taken: Callable[[str], bool]) -> Iterator[Edit]:
    """The statements in the place of comments that say what a name of the answer is in the system's."""
    for comment in islice(_COMMENT.finditer(text), MOST):
        stated: list[str] = []
        above: list[str] = []
        said = comment["said"]
        for match in islice(chain(_SAID.finditer(said), _NAMES_RATE.finditer(said)), MOST):
            new = re.findall(IDENT, match["new"])
            own = [_DERIVED.sub(lambda m: f"{m['of'] or m['in']}'", x.strip()) for x in match["own"].split(",")]
            if own[0].startswith("their "):
                own = [f"{x}'" for x in above]
            new = new[-len(own) :]  # two pendula, th1, th2 = …
            fits = len(new) == len(own) and all(taken(x.rstrip("'’′")) for x in own)
            before = said[: match.start()].strip()
            ends = len(before) > 1 and before[-1] in "+-−*/^·"  # m s'' + b psid = tau
            if ends or not fits or any(taken(x) or not _used(text, x, comment.span()) for x in new):
                continue
            above = own
            stated += [f"{a} = {b}" for a, b in zip(new, own, strict=True)]
        if stated:
            behind = text[text.rfind("\n", 0, comment.start()) + 1 : comment.start()].strip()
            yield *comment.span(), ("; " if behind else " ") + "; ".join(stated)
    for match in islice(_FORMULA.finditer(text), MOST):
        names = re.findall(IDENT, re.sub(r"['’′]+", "", match["value"]))
        known = [taken(x) or function_of(x) is not None for x in names]
        if (
            any(map(taken, names))
            and all(known)
            and not taken(match["name"])
            and _used(text, match["name"], match.span())
        ):
            yield *match.span("mark"), " "
            if match["words"]:
                yield *match.span("words"), " "


def _used(text: str, name: str, comment: tuple[int, int]) -> bool:
    """Whether a name stands outside a comment, and is given no value there."""
    rest = text[: comment[0]] + text[comment[1] :]
    found = re.compile(rf"(?<!\w){name}(?!\w)")
    given = re.search(rf"^[ \t]*+{name}[ \t]*+=(?!=)(?![ \t]*+\w+[(\[]\d[)\]])", rest, re.MULTILINE)  # not i = z(1)
    return found.search(rest) is not None and given is None
