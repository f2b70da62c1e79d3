"""Reads functions of programs that return the rates of a state: def f(t, z): … return np.array([v, a]).

x, v = z                        the states
return [v, (F - k*x)/m]         x' = v,  v' = (F - k*x)/m

function f!(dz, z, p, t)        the same in Julia
function dz = f(t, z)           z(2) is v, or by default the coordinates and then their rates
dz = [z(2); (F - k*z(1))/m]     also dzdt = [z[1], …] with return dzdt

% z = [x; v]                    the states in a comment, as z(1) = x, z(2) = v or in a list
dz(2) = (F - k*z(1))/m          without the function's first line
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

from lagrangian.check.reading.names import spelled_rates
from lagrangian.check.reading.shortened import meant
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.records import dataclass, field

_NAME = r"[^\W\d]\w*"
_HEADER = re.compile(
    rf"^[ \t]*+(?:def[ \t]++{_NAME}[ \t]*+\((?P<python>[^()\n]*+)\)[^:\n]*+:"
    rf"|function[ \t]++(?:(?P<out>{_NAME}['’′]?)[ \t]*+=[ \t]*+{_NAME}[ \t]*+\((?P<matlab>[^()\n]*+)\)[ \t]*+;?"
    rf"|{_NAME}!?[ \t]*+\([ \t]*+(?P<given>d\w*+)[ \t]*+,(?P<julia>[^()\n]*+)\)))[ \t]*+$",
    re.MULTILINE,
)
_END = r"[ \t]*+;?[ \t]*+$"
_UNPACKED = re.compile(
    rf"^[ \t]*+(?P<names>{_NAME}(?:[ \t]*+,[ \t]*+{_NAME})++)[ \t]*+=[ \t]*+(?P<of>{_NAME})(?:\[[:\d]*\])?{_END}",
    re.MULTILINE,
)
_INDEX = r"(?:\[(?P<zero>\d)\]|\((?P<one>\d)\))"
_INDEXED = re.compile(
    rf"(?:^|(?<=;))[ \t]*+(?P<name>{_NAME})[ \t]*+=[ \t]*+(?P<of>{_NAME}){_INDEX}[ \t]*+(?:;|$)", re.MULTILINE
)
_VALUE = re.compile(r"[ \t]*+=[ \t]*+(?P<entry>[\w()\[\]'’′]{1,60}+)[ \t]*+(?:;|$)", re.MULTILINE)
"""A state or a rate alone, as it is assigned."""
_LIST = r"(?:(?:np|numpy|jnp)\.(?:array|asarray|hstack)[ \t]*\([ \t]*)?[\[(]"
_RETURNED = re.compile(rf"^[ \t]*+return[ \t]++(?P<list>{_LIST})", re.MULTILINE)
_NAMED = re.compile(
    rf"^[ \t]*+return[ \t]++(?:(?:np|numpy|jnp)\.(?:array|asarray)\()?(?P<name>{_NAME}['’′]?)\)?{_END}", re.MULTILINE
)
"""What returns the rates that have a name: return dydt."""
_BY_TIME = re.compile(r"[dD](?P<of>[^\W\d_]\w*?)_?dt\Z|(?P<primed>\w++)['’′]\Z")
_NOTHING = re.compile(
    rf"^[ \t]*+(?:end|return|return[ \t]++{_NAME}['’′]?"
    rf"|{_NAME}['’′]?[ \t]*=[ \t]*(?:np\.)?(?:zeros|empty)(?:_like)?\([\w(), ]*\)){_END}",
    re.MULTILINE,
)
_ACCELERATIONS = re.compile(
    rf"^[ \t]*+{_NAME}\*(?P<name>\(?(?:(?P<column>qdd|ddq|qddot)|q?acc|q?accel|q?accelerations?)\)?)[ \t]*+=(?!=)",
    re.MULTILINE,
)
"""The equations of motion that a program solves, M*acc = f."""
_CLOSED = {"(": ")", "[": "]"}
_RATES = re.compile(
    rf"^[ \t]*+(?P<out>[dD](?P<of>[^\W\d_]\w*?)(?:_?dt)?|(?P<dotted>[^\W\d_]\w*?)_?(?:dot|prime))[ \t]*+"
    rf"(?:{_INDEX})?[ \t]*+=(?!=)",
    re.MULTILINE,
)
"""What the rates of a state are called: dz, dzdt, dz_dt, zdot, and one of them, dz(1)."""
MOST = 60
"""The most rates among which that of a state is sought."""
_COMMENT = re.compile(r"(?:(?<!\\)[#%]|//)(?P<said>[^\n]*)")
_STATE = rf"(?P<name>{_NAME}['’′]{{0,2}})"
_ONE_STATE = rf"(?<!\w)STATE{_INDEX}[ \t]*+(?:=|:|is)[ \t]*+{_STATE}(?P<rate>[ \t]*+(?:dot|prime|rate)(?!\w))?"
_LISTED_STATES = r"(?<!\w)STATE[ \t]*+(?:=|:|is)[ \t]*+[\[(](?P<names>[^\[\]()]*+)[\])]"


@dataclass
class _Function:
    """A function: the name of its state, an expression for that of what it returns, and the states by index."""

    state: str | None
    out: str | None
    names: dict[int, str] = field(default_factory=dict)
    others: Sequence[str] = ()
    """Its other arguments, such as a list of parameters."""

    def listed(self) -> re.Pattern[str]:
        """What begins the list of all rates."""
        given = rf"^[ \t]*+{self.out}[ \t]*=[ \t]*(?P<list>{_LIST})"
        return _RETURNED if self.out is None else re.compile(given, re.MULTILINE)


def without_functions(written: TracedText, coordinates: Sequence[str]) -> TracedText:
    """Return an answer in which a function that returns the rates of a state is a list of equations."""
    written = _with_round_indices(written)
    text = written.text
    headers = list(_HEADER.finditer(text))
    returns = _RETURNED.search(text) is not None or _named(text) is not None
    loose = _without_header(text) if not headers and not returns else None
    if len(headers) != 1 and loose is None and not (not headers and returns):
        return written
    function = loose or _function(text, headers)
    said = _commented(text, function.state, coordinates)
    of = _coordinates_said(function.names, said, coordinates)
    function.names = said | function.names
    rates = {name: rate for name in function.names.values() if (rate := _spelled_out(name, coordinates)) != name}
    if rates:  # dy = z(4) is y', not d y
        function.names = {i: rates.get(name, name) for i, name in function.names.items()}
        written = written.edited(apart(list(_used(text, rates))))
        text, headers = written.text, list(_HEADER.finditer(written.text))
    names = [function.names.get(i) for i in range(2 * len(coordinates))]
    default = [*coordinates, *(f"{name}'" for name in coordinates)]
    if function.state is not None and _alternates(text, function, len(coordinates)):
        default = [name + prime for name in coordinates for prime in ("", "'")]
    states = [name or default[i] for i, name in enumerate(names)]
    if len(function.names) > 1 and set(function.names) == set(range(len(function.names))):
        states = states[: len(function.names)]  # the current and not the charge
    read = [of.get(name) or next(iter(meant(name, coordinates)), name) for name in states]
    order = [name for name in read if name in coordinates]
    whole = sorted(order) == sorted(coordinates)
    solved = [f"{name}''" for name in order] if whole else list(_rates_of_speeds(text, function, states))
    if solved:
        written = written.edited(apart(list(_solved(text, solved, in_order=order == [*coordinates]))))
        text, headers = written.text, list(_HEADER.finditer(written.text))
    edits: list[Edit] = [(m.start(), m.end(), "") for m in headers]
    edits += [(m.start(), m.end(), "") for m in _NOTHING.finditer(text)]
    unpacked = {function.state, *function.others}
    edits += [(*m.span(), _said(m, of)) for m in _UNPACKED.finditer(text) if m["of"] in unpacked]
    edits += [(*m.span(), _said(m, of)) for m in _INDEXED.finditer(text) if m["of"] == function.state]
    if function.state is not None:
        edits += _indices(text, function.state, states)
    if function.out is not None:
        edits += _rates(text, function, states)
    edits += _returned(text, function, states)
    return written.edited(apart(edits))


def _coordinates_said(names: Mapping[int, str], said: Mapping[int, str], coordinates: Sequence[str]) -> dict[str, str]:
    """The coordinates that comments say unpacked names to be, each one name alone: p = z(1), where z(1) is phi."""
    own = {i: name for i, name in names.items() if said.get(i) in coordinates}
    rates = {name for name in own.values() for _, stem in spelled_rates(name) if meant(stem, coordinates)}
    known = {x for name in names.values() for x in meant(name, coordinates)}
    taken = [said[i] for i in own]
    return {
        name: said[i]
        for i, name in own.items()
        if taken.count(said[i]) == 1 and said[i] not in known and name not in rates
    }


def _said(unpacked: re.Match[str], of: dict[str, str]) -> str:
    """What unpacked names are of which a comment says that they are coordinates: p = phi; nothing for others."""
    groups = unpacked.groupdict()
    names = [x.strip() for x in (groups.get("names") or groups["name"]).split(",")]
    return "".join(f"{name} = {of[name]};" for name in names if name in of)


def _rates_of_speeds(text: str, function: _Function, states: Sequence[str]) -> Iterator[str]:
    """The rates that accelerations are, one by one, in the list of all rates: [v, w, acc[0], acc[1]] says v' and w'."""
    match, listed = _ACCELERATIONS.search(text), function.listed().search(text)
    spans = _entries(text, listed.end("list") - 1) if match is not None and listed is not None else None
    if match is None or spans is None or len(spans) != len(states):
        return
    entry = re.compile(rf"{re.escape(match['name'].strip('()'))}{_INDEX}")
    found = {
        _place(m): x
        for x, span in zip(states, spans, strict=True)
        if (m := entry.fullmatch(text[slice(*span)].strip()))
    }
    if set(found) == set(range(len(found))):
        yield from (f"{found[k]}'" for k in range(len(found)))


def _solved(text: str, rates: Sequence[str], *, in_order: bool) -> Iterator[Edit]:
    """The rates of speeds, in the order of the states, in the place of accelerations that a program solves for; qdd
    remains where the order is that of the system."""
    match = _ACCELERATIONS.search(text)
    if match is None:
        return
    if match["column"] is None or not in_order:
        yield *match.span("name"), f"[{'; '.join(rates)}]"
    name = match["name"].strip("()")
    for entry in re.finditer(rf"(?<!\w){name}{_INDEX}", text):
        if 0 <= _place(entry) < len(rates):
            yield *entry.span(), rates[_place(entry)]
    for last in re.finditer(rf"(?P<comma>[,;])[ \t]*+\*?{name}[ \t]*+(?=[\])])", text):
        yield *last.span(), "".join(f"{last['comma']} {rate}" for rate in rates)


def _with_round_indices(written: TracedText) -> TracedText:
    """The indices of Julia, which begin at 1, in round brackets: du[1] as du(1)."""
    header = next((m for m in _HEADER.finditer(written.text) if m["given"]), None)
    if header is None:
        return written
    listed = (re.escape(x.strip()) for x in (header["given"], header["julia"].split(",")[0]))
    return written.sub(re.compile(rf"(?<!\w)({'|'.join(listed)})\[(\d)\]"), lambda m: f"{m[1]}({m[2]})")


def _function(text: str, headers: Sequence[re.Match[str]]) -> _Function:
    """What is known about the function: its state is its second argument, or what is unpacked."""
    listed = [
        x.strip().lstrip("*") for m in headers for x in (m["python"] or m["matlab"] or m["julia"] or "").split(",")
    ]
    others = [x.partition("=")[0].partition(":")[0].strip() for x in listed]
    unpacked = [m for m in _UNPACKED.finditer(text) if not others or m["of"] in others]
    if any(m["julia"] for m in headers):  # f!(du, u, p, t): the parameters are unpacked, too
        unpacked.sort(key=lambda m: others.index(m["of"]))
    indexed = [m for m in _INDEXED.finditer(text) if m["of"] in others]
    used = [x for x in others if re.search(rf"(?<!\w){re.escape(x)}{_INDEX}", text)]
    state = next((m["of"] for m in (*unpacked, *indexed)), None) or next(
        (x for x in (*used, *others) if x not in ("t", "")), None
    )
    out = next((m["out"] or m["given"] for m in headers), None)
    found = _Function(state, _named(text) if out is None else _spellings(out))
    found.others = [x for x in others if x]
    for match in [m for m in unpacked if m["of"] == state][:1]:
        found.names = dict(enumerate(x.strip() for x in match["names"].split(",")))
    for match in indexed:
        found.names[_place(match)] = match["name"]
    return found


def _spellings(out: str) -> str:
    """An expression for the name of rates, where dydt may have become y' already."""
    by_time = _BY_TIME.match(out)
    of = by_time["of"] or by_time["primed"] if by_time is not None else None
    return rf"(?:[dD]{of}_?dt|{of}['’′])" if of is not None else out


def _named(text: str) -> str | None:
    """The spellings of a name that is returned, which a list or entries give above; None if there is none."""
    match = _NAMED.search(text)
    out = _spellings(match["name"]) if match is not None else None
    given = rf"^[ \t]*+{out}(?:{_INDEX}[ \t]*=(?!=)|[ \t]*=[ \t]*{_LIST})"
    return out if out is not None and re.search(given, text, re.MULTILINE) else None


def _place(match: re.Match[str]) -> int:
    """The place in a list that an index means, from 0: z[0] and z(1) are the first."""
    return int(match["zero"]) if match["zero"] else int(match["one"]) - 1


def _without_header(text: str) -> _Function | None:
    """The state and the name of its rates where both are used with an index and no function begins; None if not."""
    for match in islice(_RATES.finditer(text), MOST):
        state = match["of"] or match["dotted"]
        listed = re.compile(_LISTED_STATES.replace("STATE", state))
        if re.search(rf"(?<!\w){state}{_INDEX}", text) or any(
            listed.search(m["said"]) for m in _COMMENT.finditer(text)
        ):
            found = _Function(state, match["out"])
            for named in _INDEXED.finditer(text):
                if named["of"] == state:
                    found.names[_place(named)] = named["name"]
            return found
    return None


def _commented(text: str, state: str | None, coordinates: Sequence[str]) -> dict[int, str]:
    """The states that comments name: z(1) = x, z(2) = v, or z = [x; v]."""
    if state is None:
        return {}
    found: dict[int, str] = {}
    said = [m["said"] for m in _COMMENT.finditer(text)]
    listing = rf"(?:^|;)[ \t]*+({_LISTED_STATES.replace('STATE', state)})[ \t]*+(?=[.,;]|$)"
    said += [m[1] for m in re.finditer(listing, text, re.MULTILINE)]  # a comment that became a statement
    for comment in said:
        for match in re.finditer(_ONE_STATE.replace("STATE", state), comment):
            found[_place(match)] = match["name"] + ("'" if match["rate"] else "")
        for match in re.finditer(_LISTED_STATES.replace("STATE", state), comment):
            listed = [
                x.strip() for x in re.split("[,;]" if re.search("[,;]", match["names"]) else r"\s", match["names"])
            ]
            if all(re.fullmatch(_STATE, x) for x in listed):
                found |= dict(enumerate(listed))
    return {at: _spelled_out(name, coordinates) for at, name in found.items()}


def _spelled_out(name: str, coordinates: Sequence[str]) -> str:
    """theta' for theta_dot, which may get a prime behind it."""
    return next((stem + "'" * order for order, stem in spelled_rates(name) if stem in coordinates), name)


def _used(text: str, rates: dict[str, str]) -> Iterator[Edit]:
    """The rates themselves in the place of names for them, but where these are unpacked from a state."""
    given = [m.span() for form in (_UNPACKED, _INDEXED) for m in form.finditer(text)]
    for match in re.finditer(rf"(?<![\w.])(?:{'|'.join(map(re.escape, rates))})(?!\w)", text):
        if not any(start <= match.start() < end for start, end in given):
            yield *match.span(), rates[match.group()]


def _alternates(text: str, function: _Function, n: int) -> bool:
    """Whether every coordinate is followed by its rate: the first rate is the second state."""
    out, state = function.out, function.state
    second = rf"{state}(?:\[1\]|\(2\))[ \t]*+[,;\n]"
    first = rf"(?:return[ \t]++{_LIST}|(?<!\w){out}[ \t]*=[ \t]*{_LIST}|(?<!\w){out}(?:\[0\]|\(1\))[ \t]*=)[ \t]*+"
    return n > 1 and re.search(first + second, text) is not None


def _indices(text: str, state: str, states: Sequence[str]) -> Iterator[Edit]:
    """The names of the states in the place of z[0] or z(1)."""
    for match in re.finditer(rf"(?<!\w){state}{_INDEX}", text):
        at = _place(match)
        if 0 <= at < len(states):
            yield match.start(), match.end(), states[at]


def _rates(text: str, function: _Function, states: Sequence[str]) -> Iterator[Edit]:
    """The rates of states in the place of dz(1); nothing where it is only said that they are the rates."""
    for match in re.finditer(rf"(?<!\w){function.out}{_INDEX}(?=[ \t]*=)", text):
        if 0 <= _place(match) < len(states):
            name, given = states[_place(match)], _VALUE.match(text, match.end())
            own = given is not None and _is_rate(_state_of(given["entry"], function, states), name)
            yield (match.start(), given.end(), "") if given and own else (*match.span(), f"{name}'")


def _returned(text: str, function: _Function, states: Sequence[str]) -> Iterator[Edit]:
    """The equations in the place of a list that is returned: each entry is the rate of its state."""
    for match in function.listed().finditer(text):
        spans = _entries(text, match.end("list") - 1)
        if spans is None or len(spans) != len(states):
            continue
        last = spans[-1][1]
        end = text.find("\n", last)
        at = match.start()
        for name, (start, stop) in zip(states, spans, strict=True):
            entry = text[start:stop]
            lead = len(entry) - len(entry.lstrip())
            said = "" if _is_rate(_state_of(entry.strip(), function, states), name) else f"{name}' = "
            yield at, start + lead, f"\n{said}"
            if not said:
                yield start + lead, stop, ""
            elif "\n" in entry.strip():
                yield from ((start + k, start + k + 1, " ") for k, c in enumerate(entry) if c == "\n" and k >= lead)
            at = stop
        yield at, end if end >= 0 else len(text), "\n"


def _state_of(entry: str, function: _Function, states: Sequence[str]) -> str:
    """The name of the state that an entry of a list is; the entry as it is if it is none."""
    match = re.fullmatch(rf"{function.state}{_INDEX}", entry)
    return states[_place(match)] if match is not None and 0 <= _place(match) < len(states) else entry


def _is_rate(entry: str, name: str) -> bool:
    """Whether an entry is only the rate of its state, perhaps spelled out: x' or dx for x, ddx for dx."""
    if entry == f"{name}'":
        return True
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
