"""Takes off an answer what a session of a program holds besides equations.

In [3]: LM = LagrangesMethod(L, [x])          a command, which states nothing and is left out
Out[3]:⏎ Matrix([⏎[a],⏎[b]])                   Matrix([[a], [b]])           what it shows, on one line
Out[9]//InputForm=⏎ {a == b}                   {a == b}
print(Eq(a, b))   simplify(a == b)             Eq(a, b)   a == b            an equation in a call that shows it

A command is a call that alone fills a statement, perhaps behind a name that it is assigned to. It is left out only if
no equation of motion stands in it: one that does, and cannot be read, is an error at its place.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.prose.words import REWRITES, function_of
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.records import dataclass

MOST, LONGEST = 400, 6_000
"""The most statements of a session, and the most characters of one that goes on over several lines."""

_PROMPT = re.compile(
    r"(?P<before>(?:^|(?<=[^\S \t])|(?<=\S[ \t]))[ \t]*+|(?<=[ \t]))"  # each blank is looked at once
    r"(?:In|Out)[ \t]?\[\d{1,4}\](?://\w{1,20}+)?[ \t]*+(?::?=|:)?[ \t]*+"
    r"|^(?P<cell>[ \t]*+\[\d{1,4}\]:[ \t])"
    r"|^(?P<more>[ \t]*+\.\.\.:?(?:[ \t]|$))"
    r"|^[ \t]*+(?:>>>|julia>|sage:)[ \t]++"
    r"|^[ \t]*+(?:Out|Output)(?:[ \t]\d{1,4})?:[ \t]*+$",
    re.MULTILINE,
)
_NAME_ALONE = re.compile(
    rf"^[ \t]*+(?:In[ \t]?\[\d{{1,4}}\][ \t]*+:?=?|>>>|julia>|sage:)[ \t]*+{IDENT};?[ \t]*+$", re.MULTILINE
)
"""A name behind a prompt, which only shows what it is."""
_TYPED_LAST = re.compile(r"^[ \t]*+\.\.\.:?(?:[ \t][^\n]*+)?\n(?=[ \t]*+[^\s.])", re.MULTILINE)
"""The last line of a block that is typed, behind its prompt: what a program shows stands below it."""
_BREAK = re.compile(r"(?P<mark>['\"])(?:\\[nrt]){1,4}(?P=mark)")
"""A string that only breaks a line."""
_MAGIC = re.compile(
    r"^[ \t]*+%(?:matplotlib|pylab|load_ext|reset|display|time|timeit|config)\b[^\n]*+$"
    r"|^[ \t]*+@(?:variables|parameters|independent_variables|constants|syms|named|mtkbuild)\b[^\n~]*+$",
    re.MULTILINE,
)
"""Commands to a notebook, and declarations in Julia: @variables x(t) s(t)."""
_CALLED = re.compile(
    rf"(?:\[?(?P<to>{IDENT}(?:[ \t]*+,[ \t]*+{IDENT}){{0,15}}+)\]?[ \t]*+=(?!=)[ \t]*+)?"
    rf"(?P<of>(?:{IDENT}\.){{0,4}}+)(?P<name>{IDENT})(?P<open>[(\[])"
)
_APPLIED = re.compile(
    rf"(?:{IDENT}[ \t]*+=(?!=)[ \t]*+)?(?P<first>{IDENT})[ \t]*+(?:/@|@@?|//)[ \t]*+(?P<second>{IDENT})\Z"
)
"""How Mathematica applies a function without brackets: TeXForm /@ eqs, eqs // Simplify."""
_EXPRESSION = re.compile(r"(?:[\w\s()+\-*/^,'’′]|\.(?=\d|[a-z]{1,12}\())++")
_CALLS = re.compile(rf"(?<!\w)(?P<name>{IDENT})\(")
"""An expression without lists, words and parts of objects, and what is called in it."""
_LOOP = re.compile(r"(?:for|while|if|with)[ \t][^:\n]{1,200}:(?P<body>[^\n]*+)")
_STRING = re.compile(r"(?<=[(\[,=])[ \t]*+[bfru]?(?P<mark>['\"])[^'\"\n]{0,200}+(?P=mark)(?=[ \t]*+[,)\]:])")
_DECLARES = re.compile(
    rf"(?P<name>{IDENT})[ \t]*+=[ \t]*+(?:\w{{1,8}}\.)?Function"
    r"\([ \t]*+['\"](?P<called>\w{1,24}+)['\"][^()\n]{0,60}+\)"
    r"[ \t]*+\([ \t]*+t[ \t]*+\)"
)
"""A function of time that has the name with which it is declared: y = Function('y')(t)."""
_KEYWORD = re.compile(rf"[(,]\s*+{IDENT}[ \t]*+(?:=(?!=)|->)")
_HUMPED = re.compile(r"(?:[A-Z][a-z]{1,20}){2,6}[A-Z]?|[a-z]{2,20}(?:_[a-z]{2,20}){1,5}")
_ACCELERATES = re.compile(
    r"['’′]\s?['’′]|[″\"]|\u0308|[ẍÿẅ¨]|ddot|(?<=\w)dd(?!\w)|\bD2\(|\bD\(\s*D\b|\bDerivative\[2\]|\bd2(?=[^\W\d])"
    r"|(?:[dD]iff\w{0,9}|Derivative|\bD)[(\[](?:[^()\[\],\n]{0,40}(?:[(\[]t[)\]])?\s*,)?\s*[({]?\s*t\s*(?:,\s*(?:2|t)|\$\s*2)"
    r"|diff\(t?\)\.diff|\bd\^?[2²]\s*/\s*dt"
    r"|diff\((?:[^()\n]|\([^()\n]{0,20}\)){1,60}\)\s?(?:\.diff\(|,)\s*t\b"
)
"""Signs of an acceleration, also the rate of a slope: L.diff(xd).diff(t), diff(diff(L, xd), t)."""
_BY_TIME = re.compile(r"\bd\^?[2²]\s*/\s*dt")
_STATED = re.compile(r"==|(?<![=!<>:])=(?!=)|\bEq(?:uality)?[(\[]")
_OPERATOR = re.compile(r"(?<!\*)[-+*/·⋅](?!\*)")
_SHOWN = rf"(?:\w{{1,20}}\()?(?P<name>{IDENT})(?:\[\d\])?(?:\.\w{{1,20}}\(\))?\)?"
_NAME_IS_ZERO = re.compile(
    rf"Eq(?:uality)?\([ \t]*{_SHOWN}[ \t]*,[ \t]*0(?:[ \t]*,[ \t]*evaluate[ \t]*=[ \t]*False)?[ \t]*\)|"
    rf"{_SHOWN.replace('<name>', '<other>')}[ \t]*==[ \t]*0"
)
"""What only shows an equation by its name: Eq(e1, 0)."""
_CLOSING = {"(": ")", "[": "]", "{": "}"}

_SHOW = (
    "print pprint display disp simplify expand factor collect trigsimp nsimplify together cancel latex pretty Simplify "
    "FullSimplify Expand Factor Collect TeXForm InputForm MatrixForm TraditionalForm Print ratsimp trigreduce tex tex1 "
    "mprint mpprint mlatex vprint vpprint init_printing lprint eval combine grind trigrat ratexpand trigexpand"
)
_SHOWING = frozenset(_SHOW.split())
"""Functions that show what is in their brackets, which they leave as it is or simplify."""
_WORK = (
    "solve solveset linsolve nsolve dsolve Solve NSolve DSolve NDSolve plot Plot show figure input clear syms symbols "
    "var Symbol Function dynamicsymbols Point Particle Body depends assume assuming declare kill load restart exit "
    "quit init_vprinting init_session lambdify ode45 odeint solve_ivp coeff subs help ODESystem ODEProblem "
    "fsolve vpasolve lsqnonlin nonlinsolve fminsearch"
)
_WORKING = frozenset(_WORK.split())
"""Functions that set something up or work on what is known already."""
_FORM = (
    "Eq Equality Equal Matrix MutableDenseMatrix ImmutableDenseMatrix ImmutableMatrix Rational Integer diff Diff D "
    "Derivative der dot ddot pow power square abs array matrix vector diag Array Piecewise piecewise"
)
MATHEMATICAL = frozenset(_FORM.split())
"""Functions of which expressions consist."""
_MEANT = "diff dt doit simplify expand subs T evalf applyfunc col row"
_METHODS = frozenset(_MEANT.split())
"""Methods of expressions."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A statement of a session, from ``start`` to ``end``."""

    start: int
    end: int


def without_prompts(written: TracedText) -> TracedText:
    """Return an answer without prompts and without commands to a notebook."""
    written = written.sub(_BREAK, lambda m: " ").sub(_NAME_ALONE, lambda m: "")
    written = written.sub(_TYPED_LAST, lambda m: f"{m.group()}\n").sub(_PROMPT, _unprompted)
    return written.sub(_MAGIC, lambda m: "")


def without_session(written: TracedText, taken: Callable[[str], bool], left_out: Callable[[int], None]) -> TracedText:
    """Return an answer, whose prompts are taken off, without commands; ``left_out`` is told where each of these was.

    ``taken`` says whether a name belongs to the system.
    """
    text, edits = written.text, list[Edit]()
    for piece in pieces(text):
        for start, end, made in _edits(text, piece, taken):
            edits.append((start, end, made))
            if (start, end) == (piece.start, piece.end):
                left_out(written.origins[start] if written.origins else start)
    return written.edited(apart(edits))


def _unprompted(match: re.Match[str]) -> str:
    """What stands in the place of a prompt; how far the lines of a block are indented stays as it is."""
    if match["more"]:
        return ""
    text, width = match.string, len(match.group())
    above = text[text.rfind("\n", 0, max(0, match.start() - 1)) + 1 : max(0, match.start() - 1)]
    if match["before"] is not None and not match["before"].strip() and above[:width].isspace() and above.strip():
        return " " * width  # what stands above it is drawn
    return "\n" if match["before"] == "" or match["cell"] else " "


_ENDS = re.compile(r"[(){}\[\]\n;]")


def pieces(text: str) -> Iterator[Piece]:
    """The statements of a text: parts of lines between semicolons, and lines that a bracket holds together."""
    depth = start = count = 0
    for mark in _ENDS.finditer(f"{text}\n"):
        at, c = mark.start(), mark.group()
        if c in "([{":
            depth += 1
        elif c in ")]}":
            depth = max(0, depth - 1)
        ends = c == "\n" and (text[at + 1 : at + 2] == "\n" or at - start > LONGEST)
        if (c in "\n;" and depth == 0) or ends:
            piece = text[start:at]
            first, last = start + len(piece) - len(piece.lstrip()), start + len(piece.rstrip())
            if first < last:
                yield Piece(first, last)
            count, depth, start = count + 1, 0, at + 1
        if count > MOST:
            return


def _edits(text: str, piece: Piece, taken: Callable[[str], bool]) -> Iterator[Edit]:
    """What is changed about one statement."""
    written = text[piece.start : piece.end]
    if (loop := _LOOP.fullmatch(written)) is not None:
        if not carries(written) and _command(loop["body"].strip(), taken):
            yield piece.start, piece.end, ""
        return
    if (applied := _APPLIED.fullmatch(written)) is not None:
        if is_program(applied["first"]) or is_program(applied["second"]):
            yield piece.start, piece.end, ""
        return
    whole, shown = piece, list[Edit]()
    while (match := _whole_call(written)) is not None and match["name"] in _SHOWING:
        inside = written[match.end() : -1]
        states = _STATED.search(_plain(f"({inside})")) is not None or carries(inside) or _is_value(match, inside)
        if not states or _KEYWORD.search(inside):
            break
        named = _NAME_IS_ZERO.fullmatch(inside.strip())
        if named is not None and not taken(named["name"] or named["other"]):
            yield whole.start, whole.end, ""
            return
        at = piece.start + match.end()
        if match["to"]:
            yield from (*shown, (piece.start + match.start("of"), at - 1, ""))
            return
        shown += [(piece.start, at, ""), (piece.end - 1, piece.end, "")]
        piece = Piece(at, piece.end - 1)
        written = text[piece.start : piece.end]
    yield from shown
    if _command(written, taken):
        yield piece.start, piece.end, ""


def _is_value(match: re.Match[str], inside: str) -> bool:
    """Whether a statement gives a new name the value of an expression in another form: T = simplify(T1 + T2)."""
    to, called = match["to"], [m["name"] for m in _CALLS.finditer(inside)]
    known = all(function_of(x) is not None or x in MATHEMATICAL or x in REWRITES for x in called)
    plain = known and match["name"] in REWRITES - {"collect"} and _EXPRESSION.fullmatch(inside) is not None
    return bool(to) and plain and re.search(rf"(?<!\w){re.escape(to)}(?!\w)", inside) is None


def _whole_call(written: str) -> re.Match[str] | None:
    """The beginning of a call that fills a statement, perhaps behind a name and an equals sign."""
    match = _CALLED.match(written)
    return match if match is not None and closes(written, match.end() - 1) == len(written) - 1 else None


def closes(text: str, at: int) -> int:
    """Where the bracket at a place is closed; -1 if it is not."""
    stack: list[str] = []
    for k in range(at, min(len(text), at + LONGEST)):
        if text[k] in _CLOSING:
            stack.append(_CLOSING[text[k]])
        elif text[k] in ")]}":
            if stack.pop() != text[k]:
                return -1
            if not stack:
                return k
    return -1


def _command(written: str, taken: Callable[[str], bool]) -> bool:
    """Whether a statement is a command that states nothing about the system."""
    match = _whole_call(written)
    if (declares := _DECLARES.fullmatch(written)) is not None:
        return declares["name"] == declares["called"]
    if match is None or carries(written[match.end() :]):
        return False
    name, of = match["name"], match["of"]
    if name in MATHEMATICAL or function_of(name) is not None or (taken(name) and not of):
        return False
    if match["to"] and any(taken(x.strip()) for x in match["to"].split(",")):
        return name in _WORKING or name == "ReferenceFrame"
    if of:
        return name not in _METHODS
    return is_program(name) or _STRING.search(written) is not None or _KEYWORD.search(written) is not None


def is_program(name: str) -> bool:
    """Whether a name is that of a function of a program."""
    return name in _SHOWING or name in _WORKING or _HUMPED.fullmatch(name) is not None


def _plain(written: str) -> str:
    """A text without strings and without the names of arguments."""
    return _KEYWORD.sub(lambda m: m.group()[0], _STRING.sub("", written))


def carries(written: str) -> bool:
    """Whether an equation of motion may stand in a text: an acceleration beside an operator, in one entry of a list."""
    return any(
        _ACCELERATES.search(x) is not None and _OPERATOR.search(x) is not None for x in _entries(_plain(written))
    )


def is_acceleration(written: str) -> bool:
    """Whether a text is an acceleration alone."""
    return _ACCELERATES.search(written) is not None and _OPERATOR.search(_BY_TIME.sub("", written)) is None


def _entries(written: str) -> Iterator[str]:
    """The parts of a text between the commas of lists; those between the commas of calls belong together."""
    stack: list[bool] = []
    start = 0
    for at, c in enumerate(written):
        if c in "([{":
            called = c != "{" and re.search(r"\w\Z", written[max(0, at - 1) : at]) is not None
            stack.append(called or (bool(stack) and stack[-1]))
        elif c in ")]}" and stack:
            stack.pop()
        elif c == "," and not (stack and stack[-1]):
            yield written[start:at]
            start = at + 1
    yield written[start:]
