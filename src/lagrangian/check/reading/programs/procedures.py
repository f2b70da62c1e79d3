"""Writes out in an answer what its own short functions say where they are called.

EL = lambda q: diff(diff(L, q.diff(t)), t) - diff(L, q)
eq1 = EL(x) - F                    eq1 = (diff(diff(L, x.diff(t)), t) - diff(L, x)) - F
def EL(q, Q):⏎    return …         the same in several lines
A = @(t, z) [1, z(1); …]           A = [1, z(1); …]          MATLAB: with its own letters, A(t, z) is A
f = @(t, z) [z(2); …]              function dz = f(t, z)⏎dz = [z(2); …];⏎end         rates of a state, or A*z

A function is written out only if its value is one expression and it is called with as many arguments as it has.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import islice

from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.records import dataclass

MOST, MOST_CALLS, LONGEST, LONGEST_ADDED = 12, 40, 2_000, 20_000
"""The most functions, and the most calls of one; the most characters of one value, and of all that is written out."""

_NAME = r"[^\W\d]\w{0,39}+"
_OF = r"(?P<of>[\w,= \t~]{0,120}+)"
_ONE_LINE = re.compile(
    rf"^[ \t]*+(?P<name>{_NAME})[ \t]*+:?=[ \t]*+(?:lambda[ \t]++{_OF}:|(?P<handle>@)\({_OF.replace('<of>', '<at>')}\)"
    rf"|\(?{_OF.replace('<of>', '<to>')}\)?[ \t]*+->)[ \t]*+",
    re.MULTILINE,
)
_BLOCK = re.compile(
    rf"^(?P<indent>[ \t]*+)def[ \t]++(?P<name>{_NAME})\({_OF}\)[^:\n]{{0,40}}:[^\S\n]*+(?:#[^\n]*+)?\n"
    r"(?P<body>(?:(?P=indent)[ \t]++[^\n]*+(?:\n|\Z)|[ \t]*+\n)++)",
    re.MULTILINE,
)
_RETURNS = re.compile(r"^[ \t]++return[ \t]++", re.MULTILINE)
_LOCAL = re.compile(rf"^[ \t]++(?P<name>{_NAME})[ \t]*+=(?!=)[ \t]*+(?P<value>[^\n#]++)(?:#[^\n]*+)?$", re.MULTILINE)
_PASSED = re.compile(r"[ \t]++(?:#[^\n]*+|(?P<mark>'''|\"\"\"|['\"])[^\n]*+(?P=mark)|pass)?$", re.MULTILINE)
"""A line of a function that says nothing: a comment, and a description in quotes."""
_DECLARES = re.compile(r"(?:\w{1,8}\.)?(?:symbols|Symbol|Function|dynamicsymbols)\(")
_LIST = re.compile(r"\[|(?:\w{1,8}\.)?(?:array|asarray|hstack|concatenate)\(")
_RATES = re.compile(r"(?:[\w.]{1,20}\()?\[[ \t]*+(?P<of>[^\W\d]\w*+)(?:[\[(]\d[\])])?[ \t]*+[,;]")
"""A list of rates, whose first one is a state."""
_SOLVES = re.compile(
    rf"^[^\n=]{{0,60}}=[ \t]*+(?:\w{{1,12}}\.){{0,2}}(?P<name>ode\w{{1,6}}|solve_ivp)\([ \t]*+"
    rf"(?:@\({_OF}\)|lambda[ \t]++{_OF.replace('<of>', '<to>')}:)[ \t]*+(?=\[|(?:\w{{1,8}}\.)?array\()",
    re.MULTILINE,
)
"""A function that is stated where a program solves it: ode45(@(t, z) [z(2); …], …)."""
_PLAIN = re.compile(r"[\w.]++(?:\([\w, ]{0,20}\))?")
_OPENED, _CLOSED = "([{", ")]}"


@dataclass(frozen=True)
class _Procedure:
    """A function of an answer: its letters, with what stands for those that are left out; its value; where it is."""

    name: str
    letters: tuple[tuple[str, str], ...]
    value: str
    start: int
    end: int
    handle: bool


def with_procedures(written: TracedText) -> TracedText:
    """Return an answer in which the value of such a function stands where it is called."""
    kept, added = set[str](), 0
    for _ in range(MOST):
        found = next((x for x in _procedures(written.text) if x.name not in kept), None)
        if found is None:
            break
        kept.add(found.name)
        edits = list(_written_out(written.text, found))
        added += sum(len(made) for _, _, made in edits)
        if added > LONGEST_ADDED:
            break
        written = written.edited(edits)
    return written


def _procedures(text: str) -> Iterator[_Procedure]:
    """The functions whose value is one expression."""
    for match in islice(_ONE_LINE.finditer(text), MOST):
        end = end_of(text, match.end(), "\n;#%")
        of = match["of"] if match["of"] is not None else match["at"] if match["at"] is not None else match["to"]
        yield _Procedure(
            match["name"], _letters(of), text[match.end() : end].strip(), match.start(), end, bool(match["handle"])
        )
    for match in islice(_SOLVES.finditer(text), 1):
        end, stop = end_of(text, match.end(), ",\n"), text.find("\n", match.end())
        stop = max(end, len(text) if stop < 0 else stop)
        handle, of = match["of"] is not None, match["of"] or match["to"]
        yield _Procedure(match["name"], _letters(of), text[match.end() : end], match.start(), stop, handle)
    for match in islice(_BLOCK.finditer(text), MOST):
        if (value := _returned(match["body"])) is not None:
            yield _Procedure(match["name"], _letters(match["of"]), value, match.start(), match.end("body"), False)


def _letters(listed: str) -> tuple[tuple[str, str], ...]:
    """The letters of a function, each with its value where it is left out."""
    pairs = (x.partition("=") for x in listed.split(","))
    return tuple((name.strip(), value.strip()) for name, _, value in pairs if name.strip())


def _returned(body: str) -> str | None:
    """The expression that the lines of a function return, its own names written out; None if they do more."""
    returns = _RETURNS.search(body)
    if returns is None:
        return None
    end = end_of(body, returns.end(), "\n#")
    value = body[returns.end() : end].strip()
    if body[end:].strip() or not value:
        return None
    own: dict[str, str] = {}
    for line in body[: returns.start()].split("\n"):
        local = _LOCAL.fullmatch(line)
        if local is not None and _DECLARES.match(local["value"]) is None:
            own[local["name"]] = bracketed(put_in(local["value"].strip(), own))
        elif local is None and line.strip() and _PASSED.fullmatch(line) is None:
            return None
        if sum(map(len, own.values())) > LONGEST:
            return None
    return put_in(value, own)


def _written_out(text: str, found: _Procedure) -> Iterator[Edit]:
    """The edits that write a function out; none if it is not called as it is stated."""
    calls = list(_calls(text, found))
    names = [name for name, _ in found.letters]
    if not all(re.fullmatch(_NAME, x) for x in names if x != "~") or not found.value:
        return
    if not calls:
        yield from _passed_on(text, found, names)
        return
    given = [dict(zip(names, listed, strict=False)) for _, _, listed in calls]
    given = [{name: one.get(name, value) for name, value in found.letters} for one in given]
    if any(len(x[2]) > len(names) for x in calls) or not all(all(one.values()) for one in given):
        return
    values = [put_in(found.value, {x: bracketed(y) for x, y in one.items()}) for one in given]
    same = len(set(values)) == 1
    rates = _RATES.match(found.value)
    if same and (found.handle or _LIST.match(found.value)) and (rates is None or rates["of"] not in names):
        yield found.start, found.end, f"{found.name} = {values[0]}\n"
        yield from ((start, end, found.name) for start, end, _ in calls)
    elif len(found.value) <= LONGEST and values[0] != found.value and not _LIST.match(found.value):
        lines = "\n" * text.count("\n", found.start, found.end)
        made = ((start, end, f"({value})") for (start, end, _), value in zip(calls, values, strict=True))
        yield from apart([(found.start, found.end, lines), *made])


def _passed_on(text: str, found: _Procedure, names: Sequence[str]) -> Iterator[Edit]:
    """The edits that write a function of a state in one line, which returns its rates, in several lines."""
    several = re.search(r"^[ \t]*(?:function|def)\b", text, re.MULTILINE)
    if len(names) < 2 or several is not None:
        return
    times = re.match(rf"[^\W\d]\w{{0,23}}+[ ]?[*@][ ]?{re.escape(names[1])}(?!\w)", found.value)
    if times is None and _LIST.match(found.value) is None:
        return
    if found.handle:
        rates = f"d{names[1]}"
        header = f"function {rates} = {found.name}({', '.join(names).replace('~', 't')})"
        yield found.start, found.end, f"{header}\n{rates} = {found.value};\nend\n"
    else:
        yield found.start, found.end, f"def {found.name}({', '.join(names)}):\n    return {found.value}\n"


def _calls(text: str, found: _Procedure) -> Iterator[tuple[int, int, list[str]]]:
    """Where a function is called outside its own lines, and with what."""
    for match in islice(re.finditer(rf"(?<![\w.@]){re.escape(found.name)}\(", text), MOST_CALLS):
        if found.start <= match.start() < found.end:
            continue
        end = end_of(text, match.end(), "")
        if text[end : end + 1] == ")":
            yield match.start(), end + 1, split_at_commas(text[match.end() : end])


def end_of(text: str, at: int, stops: str) -> int:
    """Where what begins at a place ends: at a bracket that was open before, or at one of the signs outside of all."""
    depth = 0
    for k in range(at, min(len(text), at + LONGEST)):
        c = text[k]
        if depth == 0 and (c in stops or c in _CLOSED):
            return k
        depth += (c in _OPENED) - (c in _CLOSED)
    return min(len(text), at + LONGEST)


def split_at_commas(listed: str) -> list[str]:
    """The parts of a list between commas outside of brackets."""
    found, start = list[str](), 0
    while start <= len(listed):
        end = end_of(listed, start, ",")
        found.append(" ".join(listed[start:end].split()))
        start = end + 1
    return found if listed.strip() else []


def put_in(text: str, values: dict[str, str]) -> str:
    """A text in which names have their values."""
    if not values:
        return text
    form = re.compile(rf"(?<![\w.])(?:{'|'.join(map(re.escape, values))})(?!\w)")
    return form.sub(lambda m: values[m.group()], text)


def bracketed(value: str) -> str:
    """A value in brackets, unless it is a name, a number or a call."""
    return value if _PLAIN.fullmatch(value) else f"({value})"
