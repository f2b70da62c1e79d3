"""Writes the states that a program of rates slices, and accelerations that it solves for in a list, one by one.

v = z(3:4);  … v(2)  C*v                … z(4)  C*[z(3); z(4)]        a name of a part of the state
dz = [z(3:4); M\\f]                      qdd = M\\f⏎ dz = [z(3); z(4); qdd(1); qdd(2)]
np.concatenate([z[2:], solve(M, f)])    qdd = solve(M, f)⏎ [z[2], z[3], qdd[0], qdd[1]]
dz(1:2) = z(3:4)                        dz(1) = z(3)⏎ dz(2) = z(4)
du[3:4] .= M \\ f                        qdd = M \\ f⏎ du[3] = qdd(1)⏎ du[4] = qdd(2)       Julia
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import islice

from lagrangian.check.reading.programs.sessions import closes
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

_NAME = r"[^\W\d]\w{0,23}+"
_PLACES = (
    r"(?:\([ ]?(?P<one>\d{1,2})[ ]?:[ ]?(?P<last>\d{1,2}|end)[ ]?\)"
    r"|\[[ ]?(?P<zero>\d{0,2})[ ]?:[ ]?(?P<stop>\d{0,2}|end)[ ]?\])"
)
_SLICE = re.compile(rf"(?P<of>{_NAME}){_PLACES}")
_WRITTEN = rf"{_NAME}[(\[][ ]?(?:\d{{0,2}}|end)[ ]?:[ ]?(?:\d{{0,2}}|end)[ ]?[)\]]"
_ENDS = r"(?=[ \t]*+(?:$|[;#%]))"
_PART = re.compile(
    rf"(?:^|(?<=;))[ \t]*+(?P<names>{_NAME}(?:[ \t]*+,[ \t]*+{_NAME})?)[ \t]*+=[ \t]*+"
    rf"(?P<parts>{_WRITTEN}(?:[ \t]*+,[ \t]*+{_WRITTEN})?){_ENDS};?",
    re.MULTILINE,
)
"""Names of one or two parts of a state."""
_MODULE = r"(?:\w{1,8}\.){0,3}"
_FACTOR = rf"(?:{_NAME}|\([^()\n=;]{{1,200}}\))"
_SOLVES = (
    rf"(?:{_NAME}[ ]?\\[ ]?{_FACTOR}|{_MODULE}inv\([ ]?{_NAME}[ ]?\)[ ]?[*@][ ]?{_FACTOR}"
    rf"|{_MODULE}solve\([ ]?{_NAME}[ ]?,[^\n=;]{{1,200}}\)|{_NAME}\.LUsolve\([^\n=;]{{1,200}}\))"
)
_SOLVED = re.compile(rf"\*?(?P<said>{_SOLVES})|\((?P<spread>{_SOLVES})\)\.\.\.|list\((?P<listed>{_SOLVES})\)")
_GIVEN = re.compile(rf"(?:^|(?<=;))[ \t]*+(?P<name>{_NAME})[ \t]*+=[ \t]*+{_SOLVES}{_ENDS}", re.MULTILINE)
"""A name of accelerations that are solved for."""
_LIST = re.compile(
    rf"^(?P<indent>[ \t]*+)(?P<to>return[ \t]*+|{_NAME}['’′]?(?:\(:\))?[ \t]*+\.?=[ \t]*+)"
    rf"(?:{_MODULE}(?:array|asarray|hstack|concatenate|append|block|vcat)|{_MODULE}r_)?(?P<open>[\[(])",
    re.MULTILINE,
)
_PUT = re.compile(
    rf"^(?P<indent>[ \t]*+)(?P<to>{_WRITTEN})[ \t]*+\.?=[ \t]*+(?P<said>[^\n=;#%]{{1,300}}+);?[ \t]*+$", re.MULTILINE
)
_INDEX = re.compile(r"\((\d{1,2})\)|\[(\d{1,2})\]")
_HEADER = re.compile(r"^[ \t]*+(?:function|def)[ \t]", re.MULTILINE)
_ASSIGNED = re.compile(r"[ \t]*+(?:=(?!=)|[(\[])")
_END = re.compile(r"[ \t)]*+(?:$|[;#%])", re.MULTILINE)
COLUMN = "qdd"
"""The name of accelerations that are solved for."""
_DEEPEST, _LONGEST, MOST = 3, 40, 60
"""The largest depth of lists in each other, the most entries of one, and the most statements of a kind."""


def with_states_one_by_one(written: TracedText) -> TracedText:
    """Return an answer in which a program slices no state, and solves for accelerations in statements of their own."""
    from_one = re.search(r"^[ \t]*+function[ \t]", written.text, re.MULTILINE) is not None
    written = written.edited(apart(_without_parts(written.text, from_one=from_one)))
    text = written.text
    solved = {m["name"] for m in islice(_GIVEN.finditer(text), MOST)}
    edits = apart([*_lists(text, solved, from_one=from_one), *_put(text, solved, from_one=from_one)])
    if not edits and not _HEADER.search(text):
        return written
    used = [x for x in solved if re.search(rf"(?<!\w){x}[(\[]\d", text) or any(x in text[a:b] for a, b, _ in edits)]
    for name in _names(text, used):
        index = _INDEX.match(text, name.end())
        place = "" if index is None else f"({_entry(index, from_one=from_one) + 1})"
        edits.append((name.start(), (index or name).end(), f"{COLUMN}{place}"))
    return written.edited(apart(edits))


def _places(part: str, *, from_one: bool) -> list[str]:
    """The entries that a slice has, counted from 1; none if it is no slice, or does not say how many."""
    match = _SLICE.fullmatch(part.strip())
    if match is None:
        return []
    first, last = match["one"] or match["zero"], match["last"] or match["stop"]
    begins = int(first) - bool(match["one"] or from_one) if first else 0
    ends = int(last) if last.isdigit() else 2 * begins
    return [f"{match['of']}({k + 1})" for k in range(begins, min(ends, begins + _LONGEST))]


def _entry(index: re.Match[str], *, from_one: bool) -> int:
    """The place of an entry with an index, from 0."""
    return int(index[1] or index[2]) - bool(index[1] or from_one)


def _names(text: str, names: Iterable[str]) -> list[re.Match[str]]:
    """Where names stand outside comments."""
    if not names:
        return []
    form = re.compile(rf"(?P<aside>(?:#|%|//)[^\n]*+)|(?<![\w.'\"])(?:{'|'.join(names)})(?!\w)")
    return [m for m in form.finditer(text) if m["aside"] is None]


def _without_parts(text: str, *, from_one: bool) -> Iterator[Edit]:
    """The entries of a state in the place of the names of its parts."""
    given: dict[str, list[str]] = {}
    for match in islice(_PART.finditer(text), MOST):
        names, parts = (re.split(r"[ \t]*,[ \t]*", match[x]) for x in ("names", "parts"))
        entries = [_places(part, from_one=from_one) for part in parts]
        if len(names) == len(entries) and all(entries) and not set(names) & set(given):
            given |= dict(zip(names, entries, strict=True))
            yield *match.span(), ""
    for match in _names(text, given):
        entries, index = given[match.group()], _INDEX.match(text, match.end())
        at = -1 if index is None else _entry(index, from_one=from_one)
        if index is not None and 0 <= at < len(entries):
            yield match.start(), index.end(), entries[at]
        elif index is None and not _ASSIGNED.match(text, match.end()):
            yield *match.span(), f"[{'; '.join(entries)}]"


def _lists(text: str, solved: Iterable[str], *, from_one: bool) -> Iterator[Edit]:
    """Lists of rates, whose entries are written one by one."""
    for match in islice(_LIST.finditer(text), MOST):
        at = match.end("open")
        end = closes(text, at - 1)
        if end < 0 or not _END.match(text, end + 1):
            continue
        entries = list(_flat(text[at:end], _DEEPEST))
        known = [x for entry in entries[:-1] for x in _places(entry, from_one=from_one) or [entry]]
        last = _solution(entries[-1]) if entries else ""
        if not last and entries and entries[-1].lstrip("*") not in solved:
            continue
        above = f"{match['indent']}{COLUMN} = {last}\n" if last else ""
        said = ", ".join([*known, *_accelerations(len(known))])
        to = match["to"].replace("(:)", "").replace(".=", "=")
        yield match.start(), end + 1, f"{above}{match['indent']}{to}[{said}]"


def _put(text: str, solved: Iterable[str], *, from_one: bool) -> Iterator[Edit]:
    """Statements that assign several rates at once."""
    for match in islice(_PUT.finditer(text), MOST):
        to, said = _places(match["to"], from_one=from_one), match["said"].strip()
        last = _solution(said)
        given = _accelerations(len(to)) if last or said in solved else _places(said, from_one=from_one)
        if to and len(to) == len(given):
            above = [f"{COLUMN} = {last}"] if last else []
            lines = [*above, *(f"{a} = {b}" for a, b in zip(to, given, strict=True))]
            yield *match.span(), "\n".join(f"{match['indent']}{line}" for line in lines)


def _solution(entry: str) -> str:
    """What an entry solves for, without what spreads it over a list; nothing if it solves nothing."""
    match = _SOLVED.fullmatch(entry)
    return "" if match is None else match["said"] or match["spread"] or match["listed"]


def _accelerations(count: int) -> list[str]:
    """The entries of the column of accelerations."""
    return [f"{COLUMN}({k + 1})" for k in range(count)]


def _flat(inside: str, deepest: int) -> Iterator[str]:
    """The entries of a list, and of lists in it."""
    depth = start = 0
    for at, c in enumerate(f"{inside};"):
        depth += (c in "([{") - (c in ")]}")
        if c not in ",;" or depth:
            continue
        entry = " ".join(inside[start:at].split())
        start = at + 1
        if entry[:1] in ("[", "(") and closes(entry, 0) == len(entry) - 1 and deepest:
            yield from _flat(entry[1:-1], deepest - 1)
        elif entry:
            yield entry
