"""Writes functions of programs without a name as functions with one, and equations in quotes without these.

f = @(t,y) [y(3); y(4); …];                 function dy = f(t, y)⏎ dy = [y(3); y(4); …];         MATLAB
[t,y] = ode45(@(t,y) [y(3); …], [0 5], y0)  function dy = rates(t, y)⏎ dy = [y(3); …]
f = lambda t, y: [y[2], y[3], …]            def f(t, y):⏎    return [y[2], y[3], …]              Python
M = @(y) [J, …];  … M(y)\\h                  M = [J, …];  … M\\h               a function of the state
eq1 = "m*xdd + k*x = 0"                     m*xdd + k*x = 0                  an equation in quotes
T = sympify('m*v**2/2')  "T": "m*v**2/2"    T = m*v**2/2
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lagrangian.check.reading.programs.sessions import MOST, closes
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

_NAME = r"[^\W\d]\w{0,23}+"
_MADE = re.compile(
    rf"^(?P<indent>[ \t]*+)(?:(?P<name>{_NAME})[ \t]*+=[ \t]*+(?P<solver>\w{{1,12}}+(?:\.\w{{1,12}}+){{0,2}}\()?"
    rf"|(?:\[[\w, ]{{1,40}}\][ \t]*+=[ \t]*+)?(?P<call>(?:ode|solve)\w{{1,10}}\())"
    rf"(?:@\((?P<matlab>[\w, ~]{{1,80}})\)|lambda[ \t]++(?P<python>[\w, ]{{1,80}}):)[ \t]*+",
    re.MULTILINE,
)
"""A function without a name, which has one from here on or is given to a solver."""
_TIME_AND_STATE = re.compile(r"(?:t|T|time|tt|~)[ ]*,[ ]*(?P<state>[^\W\d]\w{0,23})(?![\w])")
_TEXT = r"[bfru]?(?P<mark>\"|')(?P<said>(?:(?!(?P=mark))[^\n]){1,400}+)(?P=mark)"
_QUOTED = re.compile(
    rf"^(?P<indent>[ \t]*+)(?:(?P<quote>['\"]?)(?P<to>{_NAME})(?P=quote)[ \t]*+[=:][ \t]*+)?(?:\[[ \t]*+)?"
    rf"(?P<call>(?:\w{{1,8}}\.)?(?:sympify|parse_expr|str2sym|S|sym|print|disp)\([ \t]*+)?{_TEXT}"
    r"(?(call)[^()\n]{0,60}\))[ \t]*+[;,\]]{0,2}+(?P<end>[ \t]*+(?:[#%][^\n]*+)?$)",
    re.MULTILINE,
)
"""A line that is a text in quotes, perhaps behind a name."""
_LISTED = re.compile(
    rf"^(?P<indent>[ \t]*+)(?:{_NAME}[ \t]*+=[ \t]*+)?[\[({{][ \t]*+(?P<texts>['\"][^\n]{{1,2000}}['\"])"
    r"[ \t]*+[\])}];?[ \t]*+$",
    re.MULTILINE,
)
_ONE = re.compile(_TEXT)
"""Texts in quotes in a list on one line, and one of them."""
_FORMULA = re.compile(r"[\w)\]]\s?(?:\*\*?|/|\^|\+|-|=)\s?[\w(\[-]")
_STATED = re.compile(r"(?<![=<>!:])==?(?![=>])")
_WORD = re.compile(r"[^\W\d_]{2,}[ ][^\W\d_]{2,}[ ][^\W\d_]{2,}")
"""Three words, which are no formula."""


MOST_MADE = 20
"""The most functions without a name that are looked at."""


def with_named_functions(written: TracedText) -> TracedText:
    """Return an answer in which the function of time and a state that gives its rates has a name, and functions of the
    state are what they give."""
    text = written.text
    if "@(" not in text and "lambda" not in text:
        return written
    found = list(islice(_MADE.finditer(text), MOST_MADE))
    rates = [m for m in found if _TIME_AND_STATE.match(_arguments(m)) and not _calls(text, m)]
    edits: list[Edit] = []
    for match in found:
        end = _end(text, match)
        if match in rates and len(rates) == 1:
            edits += _as_function(text, match, end)
        elif match["name"] and not match["solver"]:
            edits += _without_arguments(text, match)
    return written.edited(apart(edits))


def _arguments(match: re.Match[str]) -> str:
    return str(match["matlab"] or match["python"]).strip()


def _end(text: str, match: re.Match[str]) -> int:
    """Where the expression of a function ends: at a comma of its call, at a semicolon, or with its line."""
    called = match["solver"] or match["call"]
    at = match.end()
    while at < len(text) and text[at] not in "\n;)" and not (called and text[at] == ","):
        if text[at] in "([{":
            close = closes(text, at)
            if close < 0:
                return at
            at = close
        elif text.startswith("...", at):
            at = max(at, text.find("\n", at))
        elif text[at] in "%#":
            return at
        at += 1
    return at


def _as_function(text: str, match: re.Match[str], end: int) -> Iterator[Edit]:
    """The edits that give the function of the rates a name; what else its call holds is left out."""
    given = _arguments(match)
    state = re.split(r"[ ,]+", given)[1]
    name, indent = match["name"] if match["name"] and not match["solver"] else "rates", match["indent"]
    if match["matlab"]:
        head = f"{indent}function d{state} = {name}({given.replace('~', 't')})\n{indent}d{state} = "
    else:
        head = f"{indent}def {name}({given}):\n{indent}    return "
    yield *match.span(), head
    line = text.find("\n", end)
    line = len(text) if line < 0 else line
    if match["solver"] or match["call"]:
        yield end, line, ""


def _calls(text: str, match: re.Match[str]) -> list[re.Match[str]]:
    """Where a function that has a name is called."""
    if not match["name"] or match["solver"]:
        return []
    return list(islice(re.finditer(rf"(?<![\w.]){match['name']}\(", text), MOST))


def _without_arguments(text: str, match: re.Match[str]) -> Iterator[Edit]:
    """The edits that take the arguments off a function that is called with the same ones only."""
    calls = _calls(text, match)
    given = re.sub(r"\s", "", _arguments(match))
    ends = [closes(text, m.end() - 1) for m in calls]
    if all(end > 0 and re.sub(r"\s", "", text[m.end() : end]) == given for m, end in zip(calls, ends, strict=True)):
        yield match.start() + len(match.group()[: match.group().index("=")]) + 1, match.end(), " "
        yield from ((m.end() - 1, end + 1, "") for m, end in zip(calls, ends, strict=True))


def without_quotes(written: TracedText) -> TracedText:
    """Return an answer in which formulas that fill a line in quotes stand without these; the name of an equation is
    left out."""
    if "'" not in written.text and '"' not in written.text:
        return written
    return written.sub(_LISTED, _on_lines).sub(_QUOTED, _unquoted)


def _on_lines(match: re.Match[str]) -> str:
    """The equations of a list in quotes, one on each line; the list as it is if it holds something else."""
    said = [m["said"].strip() for m in _ONE.finditer(match["texts"])]
    equations = all(_is_formula(x) and _STATED.search(x) for x in said)
    between = re.sub(r"[\s,;]", "", _ONE.sub("", match["texts"]))
    return "\n".join(match["indent"] + x for x in said) if equations and not between else match.group()


def _unquoted(match: re.Match[str]) -> str:
    """The formula of a line in quotes; a text that is no formula as it is."""
    said, states = match["said"].strip(), _STATED.search(match["said"]) is not None
    shows = (match["call"] or "").lstrip().startswith(("print", "disp"))
    if not _is_formula(said) or not (states or (match["to"] and not shows)):
        return match.group()
    return f"{match['indent']}{said if states else match['to'] + ' = ' + said}{match['end']}"


def _is_formula(said: str) -> bool:
    """Whether a text in quotes is a formula and no sentence, nor one in which a program puts in values."""
    return _FORMULA.search(said) is not None and _WORD.search(said) is None and "{" not in said and "%" not in said
