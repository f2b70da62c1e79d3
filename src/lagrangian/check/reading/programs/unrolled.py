"""Writes out the loops of a program over the coordinates in which equations stand, and its functions.

for q, Q in zip([x, th], [F, 0]):⏎    print(diff(diff(L, q.diff(t)), t) - diff(L, q) - Q)
eqs = [diff(diff(L, q.diff(t)), t) - diff(L, q) for q in (x, th)]
qs = [x, th]⏎for i in range(2):⏎    e = diff(diff(L, qs[i].diff(t)), t) - diff(L, qs[i])

Q = {x: F, th: 0}⏎for q in Q:⏎    print(diff(diff(L, q.diff(t)), t) - diff(L, q) - Q[q])

Each turn stands on lines of its own, with what the names of the loop are in it. A loop with parts of lists that are not
known stays. What the lines of a loop assign gets
the number of the turn: e_1, e_2.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import islice

from lagrangian.check.reading.programs.procedures import bracketed, end_of, put_in, split_at_commas, with_procedures
from lagrangian.check.reading.programs.sessions import carries
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

MOST, MOST_TURNS, LONGEST = 8, 8, 2_000
"""The most loops, and the most turns of one; the most characters of its lines."""

_NAME = r"[^\W\d]\w{0,39}+"
_FOR = re.compile(
    r"^(?P<indent>[ \t]*+)for[ \t]++(?P<names>[\w, ()]{1,80}?)[ \t]++in[ \t]++(?P<over>[^\n#]{1,300}?):"
    r"[ \t]*+(?:#[^\n]*+)?(?P<body>(?:\n(?P=indent)[ \t]++[^\n]*+)++|[^\n]++)",
    re.MULTILINE,
)
_COMPREHENSION = re.compile(
    rf"^[ \t]*+(?:{_NAME}[ \t]*+=[ \t]*+)?(?:\w{{1,8}}\.)?(?:Matrix\(|list\(|print\()?[\[(](?=[^\n]{{0,400}}\bfor\b)",
    re.MULTILINE,
)
_IN = re.compile(r"\s+for\s+(?P<names>[\w, ()]{1,80}?)\s+in\s+(?P<over>.+)\Z", re.DOTALL)
_GIVEN = re.compile(rf"^[ \t]*+(?P<name>{_NAME})[ \t]*+=[ \t]*+(?=(?:\w{{1,8}}\.)?(?:Matrix\()?[\[(])", re.MULTILINE)
_TABLE = re.compile(rf"^[ \t]*+(?P<name>{_NAME})[ \t]*+=[ \t]*+\{{(?=[^{{}}=]{{1,2000}}\}})", re.MULTILINE)
_CALL = re.compile(r"(?:\w{1,8}\.)?(?P<name>zip|enumerate|range|Matrix|list|tuple)\((?P<inside>.*)\)\Z", re.DOTALL)
_DIFFERENTIATES = re.compile(r"\bdiff\(|\bDerivative\(")
_ASSIGNED = re.compile(rf"^[ \t]*+(?P<name>{_NAME})[ \t]*+=(?!=)", re.MULTILINE)
_ADDED = re.compile(rf"^[ \t]*+{_NAME}(?:\.append\(|[ \t]*+\+=[ \t]*+\[)(?P<value>[^\n]*+)", re.MULTILINE)
_PLACED = re.compile(rf"^[ \t]*+{_NAME}\[[^\]=\n]{{1,40}}+\][ \t]*+=(?!=)", re.MULTILINE)
"""What adds an equation to a list, and what puts one at a place of it."""
_SHOWN = re.compile(r"(?P<call>(?:\w{1,8}\.)?(?:print|pprint|display)\()(?P<value>.*)\)\Z")
_PART = re.compile(r"(?<![\w.])[^\W\d]\w{0,39}\[[^\[\]\n]{1,40}\]")


def unrolled(written: TracedText) -> TracedText:
    """Return an answer in which every turn of such a loop is written out, and every function where it is called."""
    return with_procedures(_without_loops(written) if " in " in written.text else written)


def _without_loops(written: TracedText) -> TracedText:
    """Return an answer in which every turn of such a loop is written out."""
    text = written.text
    lists = dict(_lists(text))
    edits = list[Edit]()
    for match in islice(_FOR.finditer(text), MOST):
        turns = _turns(match["names"], match["over"].strip(), lists)
        if turns is None or len(match["body"]) > LONGEST or _DIFFERENTIATES.search(match["body"]) is None:
            continue
        lines = "\n".join(line.strip() for line in match["body"].split("\n"))
        made = "\n".join(_turn(lines, values, lists, k) for k, values in enumerate(turns, 1))
        if _PART.search(made) is None:
            edits.append((*match.span(), made))
    for match in islice(_COMPREHENSION.finditer(text), MOST):
        end = end_of(text, match.end(), "")
        inside = text[match.end() : end]
        said = _IN.search(inside)
        turns = _turns(said["names"], said["over"].strip(), lists) if said is not None else None
        if said is None or turns is None or _DIFFERENTIATES.search(inside) is None:
            continue
        stop = text.find("\n", end)
        made = "\n".join(_turn(inside[: said.start()], values, lists, k) for k, values in enumerate(turns, 1))
        if _PART.search(made) is None:
            edits.append((match.start(), len(text) if stop < 0 else stop, made))
    return written.edited(apart(edits))


def _turn(lines: str, values: Mapping[str, str], lists: Mapping[str, Mapping[str, str]], number: int) -> str:
    """The lines of a loop in one of its turns."""
    own = {name: f"{name}_{number}" for name in _ASSIGNED.findall(lines)}
    made = put_in(lines, {**own, **{name: bracketed(value) for name, value in values.items()}})
    for name, listed in lists.items():
        entry = re.compile(rf"(?<![\w.]){name}\[[ ]?([\w.()]{{1,40}})[ ]?\]")
        made = entry.sub(lambda m, of=listed: bracketed(of[m[1]]) if m[1] in of else m.group(), made)
    made = _ADDED.sub(lambda m: m["value"][: end_of(m["value"], 0, "")], _PLACED.sub("", made))
    return "\n".join(map(_as_equation, made.split("\n")))


def _as_equation(line: str) -> str:
    """The left side of an equation of motion that a line shows or puts in a list with = 0; any other line as it is."""
    shown = _SHOWN.match(line)
    value = shown["value"] if shown is not None and end_of(line, shown.end("call"), "") == len(line) - 1 else line
    return f"{value} = 0" if carries(value) and not re.search(r"=|\bEq\(|['\"]", value) else line


def _turns(names: str, over: str, lists: Mapping[str, Mapping[str, str]]) -> list[dict[str, str]] | None:
    """What the names of a loop are in each turn; None if that is not known."""
    own = re.findall(_NAME, names)
    items = _items(over, lists)
    if items is None or not 0 < len(items) <= MOST_TURNS or any(len(x) != len(own) for x in items):
        return None
    return [dict(zip(own, item, strict=True)) for item in items]


def _items(over: str, lists: Mapping[str, Mapping[str, str]]) -> list[list[str]] | None:
    """What a loop runs over, each item as the list of its parts."""
    called = _CALL.match(over)
    if called is not None and called["name"] == "zip":
        columns = [_items(x, lists) for x in split_at_commas(called["inside"])]
        known = [x for x in columns if x is not None]
        if not known or len(known) < len(columns):
            return None
        return [[part for item in row for part in item] for row in zip(*known, strict=False)]
    if called is not None and called["name"] == "enumerate":
        inner = _items(called["inside"], lists)
        return None if inner is None else [[str(k), *item] for k, item in enumerate(inner)]
    if called is not None and called["name"] == "range":
        of = re.fullmatch(rf"(?P<count>\d)|len\((?P<name>{_NAME})\)", called["inside"].strip())
        count = 0 if of is None else int(of["count"]) if of["count"] else len(lists.get(of["name"], ()))
        return [[str(k)] for k in range(count)] or None
    if over.endswith(".items()"):
        return [list(pair) for pair in lists.get(over.removesuffix(".items()"), {}).items()] or None
    given = lists.get(over)
    first = None if given is None else list(given) if not next(iter(given)).isdigit() else list(given.values())
    listed = first or _listed(over)
    return None if listed is None else [_listed(x) or [x] for x in listed]


def _listed(written: str) -> list[str] | None:
    """The parts of a list; None if it is none."""
    called = _CALL.match(written)
    if called is not None and called["name"] in ("Matrix", "list", "tuple"):
        return _listed(called["inside"].strip())
    if written[:1] in ("[", "(") and end_of(written, 1, "") == len(written) - 1:
        parts = [x for x in split_at_commas(written[1:-1]) if x]
        return parts if len(parts) > 1 or written[0] == "[" else None
    parts = split_at_commas(written)
    return parts if len(parts) > 1 else None


def _lists(text: str) -> Iterator[tuple[str, dict[str, str]]]:
    """The lists and tables that an answer gives names: what stands at each place, or beside each name."""
    for match in islice(_GIVEN.finditer(text), 4 * MOST):
        end = text.find("\n", match.end())
        listed = _listed(text[match.end() : end if end >= 0 else len(text)].partition("#")[0].strip())
        if listed and len(listed) <= MOST_TURNS and sum(map(len, listed)) <= LONGEST:
            yield match["name"], {str(k): part for k, part in enumerate(listed)}
    for match in islice(_TABLE.finditer(text), MOST):
        pairs = [x.partition(":") for x in split_at_commas(text[match.end() : end_of(text, match.end(), "")]) if x]
        if 0 < len(pairs) <= MOST_TURNS and all(value for _, _, value in pairs):
            yield match["name"], {name.strip(): value.strip() for name, _, value in pairs}
