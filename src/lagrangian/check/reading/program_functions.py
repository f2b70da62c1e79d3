"""Reads functions of programs that return the rates of a state: def f(t, z): … return np.array([v, a]).

x, v = z                        the states
return [v, (F - k*x)/m]         x' = v,  v' = (F - k*x)/m

function dz = f(t, z)           z(2) is v, or by default the coordinates and then their rates
dz = [z(2); (F - k*z(1))/m]
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.records import dataclass, field

_NAME = r"[^\W\d]\w*"
_HEADER = re.compile(
    rf"^[ \t]*+(?:def[ \t]++{_NAME}[ \t]*+\((?P<python>[^()\n]*+)\)[^:\n]*+:"
    rf"|function[ \t]++(?P<out>{_NAME})[ \t]*+=[ \t]*+{_NAME}[ \t]*+\((?P<matlab>[^()\n]*+)\)[ \t]*+;?)[ \t]*+$",
    re.MULTILINE,
)
_END = r"[ \t]*+;?[ \t]*+$"
_UNPACKED = re.compile(
    rf"^[ \t]*+(?P<names>{_NAME}(?:[ \t]*+,[ \t]*+{_NAME})++)[ \t]*+=[ \t]*+(?P<of>{_NAME})(?:\[[:\d]*\])?{_END}",
    re.MULTILINE,
)
_INDEX = r"(?:\[(?P<zero>\d)\]|\((?P<one>\d)\))"
_INDEXED = re.compile(rf"^[ \t]*+(?P<name>{_NAME})[ \t]*+=[ \t]*+(?P<of>{_NAME}){_INDEX}{_END}", re.MULTILINE)
_LIST = r"(?:(?:np|numpy|jnp)\.(?:array|asarray|hstack)[ \t]*\([ \t]*)?[\[(]"
_RETURNED = re.compile(rf"^[ \t]*+return[ \t]++(?P<list>{_LIST})", re.MULTILINE)
_NOTHING = re.compile(
    rf"^[ \t]*+(?:end|return|return[ \t]++{_NAME}|{_NAME}[ \t]*=[ \t]*(?:np\.)?zeros\([\w(), ]*\)){_END}", re.MULTILINE
)
_CLOSED = {"(": ")", "[": "]"}


@dataclass
class _Function:
    """A function: the name of its state, of what it returns, the names of the states by index, and where it ends."""

    state: str | None
    out: str | None
    names: dict[int, str] = field(default_factory=dict)


def without_functions(written: TracedText, coordinates: Sequence[str]) -> TracedText:
    """Return an answer in which a function that returns the rates of a state is a list of equations."""
    text = written.text
    headers = list(_HEADER.finditer(text))
    if len(headers) != 1 and not (not headers and _RETURNED.search(text)):
        return written
    function = _function(text, headers)
    edits: list[Edit] = [(m.start(), m.end(), "") for m in headers]
    edits += [(m.start(), m.end(), "") for m in _NOTHING.finditer(text)]
    edits += [(m.start(), m.end(), "") for m in _UNPACKED.finditer(text) if m["of"] == function.state]
    edits += [(m.start(), m.end(), "") for m in _INDEXED.finditer(text) if m["of"] == function.state]
    names = [function.names.get(i) for i in range(2 * len(coordinates))]
    default = [*coordinates, *(f"{name}'" for name in coordinates)]
    states = [name or default[i] for i, name in enumerate(names)]
    if function.state is not None:
        edits += _indices(text, function.state, states)
    if function.out is not None:
        rates = re.finditer(rf"(?<!\w){function.out}\((\d)\)(?=[ \t]*=)", text)
        edits += [(*m.span(), f"{states[int(m[1]) - 1]}'") for m in rates if 0 < int(m[1]) <= len(states)]
    edits += _returned(text, function, states)
    kept: list[Edit] = []
    for edit in sorted(edits):
        if not kept or edit[0] >= kept[-1][1]:
            kept.append(edit)
    return written.edited(kept)


def _function(text: str, headers: Sequence[re.Match[str]]) -> _Function:
    """What is known about the function: its state is its second argument, or what is unpacked."""
    listed = [x.strip().lstrip("*") for m in headers for x in (m["python"] or m["matlab"] or "").split(",")]
    others = [x.partition("=")[0].partition(":")[0].strip() for x in listed]
    unpacked = [m for m in _UNPACKED.finditer(text) if not others or m["of"] in others]
    indexed = [m for m in _INDEXED.finditer(text) if m["of"] in others]
    state = next((m["of"] for m in (*unpacked, *indexed)), None) or next(
        (x for x in others if x not in ("t", "")), None
    )
    found = _Function(state, next((m["out"] for m in headers), None))
    for match in unpacked[:1]:
        found.names = dict(enumerate(x.strip() for x in match["names"].split(",")))
    for match in indexed:
        found.names[int(match["zero"]) if match["zero"] else int(match["one"]) - 1] = match["name"]
    return found


def _indices(text: str, state: str, states: Sequence[str]) -> Iterator[Edit]:
    """The names of the states in the place of z[0] or z(1)."""
    for match in re.finditer(rf"(?<!\w){state}{_INDEX}", text):
        at = int(match["zero"]) if match["zero"] else int(match["one"]) - 1
        if 0 <= at < len(states):
            yield match.start(), match.end(), states[at]


def _returned(text: str, function: _Function, states: Sequence[str]) -> Iterator[Edit]:
    """The equations in the place of a list that is returned: each entry is the rate of its state."""
    given = re.compile(rf"^[ \t]*+{function.out}[ \t]*=[ \t]*(?P<list>\[)", re.MULTILINE)
    for match in (_RETURNED if function.out is None else given).finditer(text):
        spans = _entries(text, match.end("list") - 1)
        if spans is None or len(spans) != len(states):
            continue
        last = spans[-1][1]
        end = text.find("\n", last)
        at = match.start()
        for name, (start, stop) in zip(states, spans, strict=True):
            entry = text[start:stop]
            lead = len(entry) - len(entry.lstrip())
            said = "" if _is_rate(entry.strip(), name) else f"{name}' = "
            yield at, start + lead, f"\n{said}"
            if not said:
                yield start + lead, stop, ""
            elif "\n" in entry.strip():
                yield from ((start + k, start + k + 1, " ") for k, c in enumerate(entry) if c == "\n" and k >= lead)
            at = stop
        yield at, end if end >= 0 else len(text), "\n"


def _is_rate(entry: str, name: str) -> bool:
    """Whether an entry is only the spelled-out rate of its state: dx for x, ddx for dx."""
    own = {(name.rstrip("'"), name.count("'")), *((stem, order) for order, stem in spelled_rates(name))}
    return any((stem, order - 1) in own for order, stem in spelled_rates(entry) if re.fullmatch(_NAME, entry))


def _entries(text: str, at: int) -> list[tuple[int, int]] | None:
    """The places of the entries of a list that opens at a place; None if it is not closed."""
    stack: list[str] = []
    found: list[tuple[int, int]] = []
    start = at + 1
    for k in range(at, len(text)):
        c = text[k]
        if c in _CLOSED:
            stack.append(_CLOSED[c])
        elif stack and c == stack[-1]:
            stack.pop()
            if not stack:
                return [*found, (start, k)] if text[start:k].strip() else found
        elif c in ",;" and len(stack) == 1:
            found.append((start, k))
            start = k + 1
    return None
