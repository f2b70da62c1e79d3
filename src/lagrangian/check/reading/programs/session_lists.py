"""Reads lists of programs whose entries are equations: expressions that are zero, and solutions.

eqs = [m*x'' - F,⏎ J*phi'' - M]                m*x'' - F = 0⏎ J*phi'' - M = 0          also { }
Matrix([⏎[m*x'' - F],⏎[J*phi'' - M]])          the same
{x'': a, y'': b}   {{x'' -> a, y'' -> b}}      x'' = a⏎ y'' = b
{x': v, y': w}                                 x' = v⏎ y' = w                         rates and their names
{'x': m*x'' - F, 'phi': J*phi'' - M}           m*x'' - F = 0⏎ J*phi'' - M = 0          also {"x": "m*x'' = F"}
x'' : a   Derivative(x(t), (t, 2)) : a          x'' = a                                solutions, one a line
{a, b} == {c, d}                               a = c⏎ b = d
\\left\\{a = b, c = d\\right\\}                    a = b⏎ c = d                          LaTeX, also with [ ]
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import islice, pairwise

from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.programs.sessions import MOST, carries, closes, is_acceleration, pieces
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

_LIST = re.compile(
    rf"(?:(?P<name>{IDENT})[ \t]*+=(?!=)[ \t]*+)?"
    r"(?P<call>(?:(?:\w{1,8}\.)?(?:Matrix|MutableDenseMatrix|ImmutableDenseMatrix|ImmutableMatrix|array)\(\s*+)?)"
    r"(?P<open>[\[{(])"
)
_SETS = (re.compile(r"(?P<opens>\\left\s?\\\{)|\\right\s?\\\}"), re.compile(r"(?P<opens>\\left\s?\[)|\\right\s?\]"))
_SOLVED = re.compile(r"(?:\\[ ,;:!]\s*+)?\\(?:ddot(?![a-z])|frac\s?\{d\^)[^:=]{1,80}:")
"""A second derivative in LaTeX and a colon, as SymPy prints a solution."""
_SIDE = re.compile(r"\s*+={1,2}\s*+\{")
_KEY = re.compile(
    rf"(?:(?P<quote>['\"])(?P<name>[^\"\n:]{{1,60}}?)(?P=quote)|(?P<bare>{IDENT}))[ \t]*+:(?!=)\s*+(?=\S)"
)
"""The name of an entry in a dictionary of Python or JSON."""
_SHOWN = re.compile(
    r"(?P<of>[^\s:=]{2,60}+(?:(?<=,)[ \t][^\s:=]{1,20}+){0,3}+)[ \t]*+(?P<maps>(?:->|→|:)(?!=))[ \t]++(?=\S)"
)
"""What a solution is of, and a colon or an arrow."""
_NAMED_RATE = re.compile(
    rf"(?:{IDENT}(?:\(t\))?['’′]|Derivative\({IDENT}\(t\),[ ]?t\))"
    rf"[ \t]*+(?:->|:)\s*+{IDENT}(?:\(t\))?"
)
"""A rate and the name that an answer has for it: x': v."""
_OF_POINT = re.compile(r"(?:a|γ|gamma|acc)(?:_\w{1,8}|\d|[A-Z]|\Z)")
"""What the acceleration of a point is called: γ3 = (−l φ'' sin φ ; z'') has its components."""
_MAPS = re.compile(r"(?:->|:)(?!=)")


def without_lists(written: TracedText) -> TracedText:
    """Return an answer in plain text in which such lists are equations, one a line."""
    text, edits = written.text, list[Edit]()
    for piece in pieces(text):
        edits += _edits(text, piece.start, piece.end)
    return written.edited(apart(edits))


def without_sets(written: TracedText) -> TracedText:
    """Return an answer in LaTeX in which sets of equations are equations, one a line."""
    text, edits = written.text, list[Edit]()
    for start, opened, closed, end in (x for form in _SETS for x in _pairs(text, form)):
        spans = entries_in(text, opened, closed)
        if "\\begin" in text[opened:closed]:
            continue
        if spans and all("=" in text[a:b] for a, b in spans):
            edits += _listed(text, start, end, spans, "", between=" \\\\")
        elif spans and all(_SOLVED.match(text, a, b) for a, b in spans):
            edits += _listed(text, start, end, spans, "", between=" \\\\")
            edits += ((at := text.index(":", a), at + 1, "=") for a, _ in spans)
    return written.edited(apart(sorted(edits)))


def _pairs(text: str, form: re.Pattern[str]) -> Iterator[tuple[int, int, int, int]]:
    """The places of the outermost brackets of a kind: where each begins, its inside, and where it ends."""
    stack: list[re.Match[str]] = []
    for match in islice(form.finditer(text), MOST):
        if match["opens"]:
            stack.append(match)
        elif stack:
            first = stack.pop()
            if not stack:
                yield first.start(), first.end(), match.start(), match.end()


def _edits(text: str, start: int, end: int) -> Iterator[Edit]:
    """The edits of one statement, if it is such a list."""
    match = _LIST.match(text, start, end)
    if match is None:
        yield from _solved(text, start, end)
        return
    close = closes(text, match.end() - 1)
    if match["open"] == "{" and (other := _SIDE.match(text, close + 1, end)) is not None:
        yield from _side_by_side(text, start, match.end(), close, other.end(), end)
    if close < 0 or text[close + 1 : end].partition("#")[0].strip(" \t\n;,.") != (")" if match["call"] else ""):
        return
    name = match["name"]
    if name is not None and (_OF_POINT.match(name) or len(re.findall(rf"(?<!\w){name}(?!\w)", text)) > 1):
        return
    spans = list(_inner(text, entries_in(text, match.end(), close)))
    written = [text[a:b] for a, b in spans]
    keys = [_KEY.match(x) for x in written] if match["open"] == "{" else []
    maps = [_MAPS.search(x) for x in written]
    if keys and all(key is not None and not is_acceleration(key["name"] or key["bare"]) for key in keys):
        yield from _called(
            text, start, close + 1, [(a + key.end(), b) for (a, b), key in zip(spans, keys, strict=True) if key]
        )
    elif written and all(map(_maps, written, maps)):
        yield from _listed(text, start, end, spans, "")
        yield from ((a + m.start(), a + m.end(), " = ") for (a, _), m in zip(spans, maps, strict=True) if m)
    elif len(spans) > (0 if match["call"] else 1):
        carried = [carries(x) for x in written]
        sure = all(carried) if match["open"] == "{" else any(carried)
        if any("=" in x or "Eq(" in x for x in written) or not sure:
            return
        yield from _listed(text, start, end, spans, " = 0")


def _solved(text: str, start: int, end: int) -> Iterator[Edit]:
    """The edit that equates an acceleration with what stands behind it and a colon, as loops over solutions print."""
    match = _SHOWN.match(text, start, end)
    if match is None or not is_acceleration(match["of"]) or "=" in text[match.end() : end]:
        return
    if not carries(text[match.end() : end]):
        yield match.start("maps"), match.end("maps"), " = "


def _maps(entry: str, sign: re.Match[str] | None) -> bool:
    """Whether an entry of a dictionary says what an acceleration is, or how a rate is called."""
    of_rate = _NAMED_RATE.fullmatch(entry) is not None
    return sign is not None and (of_rate or is_acceleration(entry[: sign.start()]))


def _called(text: str, start: int, end: int, values: Sequence[tuple[int, int]]) -> Iterator[Edit]:
    """The edits that leave the entries of a dictionary with names of equations; what is no equation is zero."""
    values = [(a + 1, b - 1) if text[a] == text[b - 1] == '"' else (a, b) for a, b in values]
    stated = ["=" in text[a:b] or "Eq(" in text[a:b] for a, b in values]
    if any(carries(text[a:b]) for a, b in values) and (all(stated) or not any(stated)):
        yield from _listed(text, start, end, values, "" if all(stated) else " = 0")


def _side_by_side(text: str, start: int, first: int, last: int, other: int, end: int) -> Iterator[Edit]:
    """The edits that write {a, b} == {c, d} as a = c and b = d, one a line."""
    close = closes(text, other - 1)
    left, right = entries_in(text, first, last), entries_in(text, other, close) if close > 0 else []
    if len(left) == len(right) and not text[close + 1 : end].strip(" \t\n;,."):
        yield start, end, "\n".join(f"{text[a:b]} = {text[c:d]}" for (a, b), (c, d) in zip(left, right, strict=True))


def _listed(
    text: str, start: int, end: int, spans: Sequence[tuple[int, int]], behind: str, *, between: str = ""
) -> Iterator[Edit]:
    """The edits that leave the entries of a list, each on a line, with what is put behind them, and between two."""
    cuts = [start, *(x for span in spans for x in span), end]
    for k, (a, b) in enumerate(zip(cuts[::2], cuts[1::2], strict=True)):
        ends = f"{behind}{between}\n" if k else "\n"
        yield a, b, ends if k < len(spans) else behind
    for a, b in spans:
        yield from ((k, k + 1, " ") for k in range(a, b) if text[k] == "\n")


def entries_in(text: str, start: int, end: int) -> list[tuple[int, int]]:
    """The places of the entries of a list, without blanks around them; an empty one at its end is none."""
    depth, cuts = 0, [start - 1]
    for at in range(start, end):
        depth += (text[at] in "([{") - (text[at] in ")]}")
        if depth == 0 and text[at] in ",;" and text[at - 1] != "\\":  # a space in LaTeX
            cuts.append(at)
    cuts.append(end)
    bare = [(a + 1, text[a + 1 : b]) for a, b in pairwise(cuts)]
    found = [(a + len(x) - len(x.lstrip()), a + len(x.rstrip())) for a, x in bare if x.strip()]
    return found


def _inner(text: str, spans: Sequence[tuple[int, int]]) -> Iterator[tuple[int, int]]:
    """The places of entries without brackets of their own around them: rows with one entry, lists in a list."""
    for a, b in spans:
        if text[a] in "[{" and closes(text, a) == b - 1:
            yield from entries_in(text, a + 1, b - 1)
        else:
            yield a, b
