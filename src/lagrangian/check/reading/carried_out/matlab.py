"""Writes a program in MATLAB or Octave as one in Python's syntax, line by line, to be carried out on symbols.

function dx = f(t, x)     def f(t, x) -> "dx":         [a, b; c d]   Matrix([[a, b], [c, d]])
@(t, z) z(2)              (lambda t, z: z(2))          A \\ b         A @ b
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Set

from lagrangian.check.reading.carried_out.values import AbandonedError

_TOKEN = re.compile(
    r"(?P<number>(?:\d++\.?\d*+|\.\d++)(?:[eE][+-]?\d++)?)|(?P<name>[^\W\d]\w*+)|(?P<string>\"[^\"\n]*+\")"
    r"|(?P<op>==|~=|<=|>=|&&|\|\||\.\^|\.\*|\./|\.\\|\.['’]|[-+*/\\^=<>&|~:!])"
    r"|(?P<mark>[()\[\]{},;.'’@])|(?P<space>[ \t]++)"
)
_HEADER = re.compile(
    r"function[ \t]++(?:(?:(?P<out>[^\W\d]\w*+)|\[(?P<several>[^\]\n]*+)\])[ \t]*+=[ \t]*+)?"
    r"(?P<name>[^\W\d][\w.]*+)[ \t]*+(?:\((?P<given>[^()\n]*+)\))?[ \t]*+;?[ \t]*+\Z"
)
_KEYWORDS = frozenset(["if", "for", "while", "switch", "try", "parfor", "else", "elseif", "case", "otherwise", "catch"])
_OPENING = frozenset(["if", "for", "while", "switch", "try", "parfor"])
_END = re.compile(r"[\s,;]end(?:if|for|while|switch)?[ \t]*+[,;]?[ \t]*+\Z")
_LOOP, _CONDITION = "while unread(): ", "if unread(): "
UNREAD = "unread"
"""What gives a value of which nothing is known."""
_GIVEN = re.compile(
    r"[ \t]*+(?:\[(?P<several>[\w,~ \t]{1,120}+)\]|(?P<name>[^\W\d]\w*+)"
    r"(?:\.\w++|\([^()=\n]{0,60}\)|\{[^{}=\n]{0,60}\}){0,4}+)"
    r"[ \t]*+=(?!=)"
)
_WORD = re.compile(r"(?<![\w.'])[^\W\d]\w*+")
"""A statement that gives a name, or a part of what it is, a value: Z(:, i) = z."""
_DROPPED = re.compile(r"[ \t]*+(?:clear|close|clc|format|hold|figure|warning|pkg|addpath|digits|more)\b[^=]*+\Z")
_SYMS = re.compile(r"[ \t]*+syms[ \t]++(?P<names>[\w() \t,]++);?[ \t]*+\Z")
_ENTRY = re.compile(r"(?P<name>[^\W\d]\w*+)\((?P<at>[\w, \t]++)\)[ \t]*+=(?!=)")
_FOR = re.compile(
    r"for[ \t]++(?P<name>[^\W\d]\w{0,12}+)[ \t]*+=[ \t]*+(?P<first>\d{1,2})[ \t]*+:[ \t]*+"
    r"(?P<last>\d{1,2}|\w{1,12}(?:\([ \t]*+\w{1,12}+[ \t]*+\))?)[ \t]*+[;,]?\Z"
)
"""A loop over numbers: for i = 1:numel(q)."""
_PLACE = r"[ \t]*+(?:\d*+[ \t]*+:[ \t]*+(?:\d++|end\b)?+|\d++|[^\W\d]\w{0,12}+)[ \t]*+"
_PLACES = re.compile(rf"(?=[^()]*:){_PLACE}(?:,{_PLACE})?\)")
_KEPT = re.compile(
    r"(?<![\w.])(?:(?P<multiplier>lambda)|as|is|del|def|pass|with|from|yield|assert|raise|async|await)(?!\w)"
)
"""Names that Python keeps for itself."""
_OPERATORS = {"^": "**", ".^": "**", ".*": "*", "./": "/", "\\": "@", ".\\": "@", "~": "not "}


def in_python(text: str) -> str:
    """Return the program in Python's syntax, with the same lines.

    What stands in branches, and in loops over anything but numbers, is kept for what it changes.
    """
    bare = (_without_comment(x) for x in text.split("\n"))
    lines = _joined([_KEPT.sub(lambda m: "λ" if m["multiplier"] else f"{m.group()}_", x) for x in bare])
    made: list[str] = []
    indent, counted = 0, set[str]()
    for line in lines:
        bare = line.strip()
        if not bare or _DROPPED.fullmatch(line):
            made.append("")
            continue
        if (loop := _FOR.fullmatch(bare)) is not None:
            last = _Expression(loop["last"]).written()
            made.append(" " * indent + f"for {loop['name']} in range({loop['first']}, {last} + 1):")
            indent += 1
            counted.add(loop["name"])
            continue
        if (word := bare.split("(")[0].split()[0].rstrip(",;")) in _KEYWORDS:
            whole = _END.search(bare) is not None and word in _OPENING
            made.append(" " * indent + _branch(word, bare))
            indent += int(word in _OPENING and not whole)
            continue
        if (header := _HEADER.fullmatch(bare)) is not None:
            given = [("_" if x.strip() in ("~", "") else x.strip()) for x in (header["given"] or "").split(",")]
            given = [x if x != "_" else f"unused{k}" for k, x in enumerate(given)]
            out = header["out"] or ",".join(re.findall(r"\w+", header["several"] or ""))
            named = header["name"].replace(".", "_")
            made.append(f"def {named}({', '.join(given)}) -> {out!r}:" if out else f"def {named}({', '.join(given)}):")
            indent = 1
        elif bare.rstrip(";,") in ("end", "endfunction", "return", "endif", "endfor", "endwhile", "endswitch"):
            made.append("")
            indent = indent if bare.startswith("return") else max(indent - 1, 0)
        elif (syms := _SYMS.fullmatch(line)) is not None:
            made.append(" " * indent + _declared(syms["names"]))
        else:
            made.append(" " * indent + "; ".join(_read_statement(x, counted) for x in _statements(line)))
    return "\n".join(_with_bodies(made)) + "\n"


def _with_bodies(lines: list[str]) -> Iterator[str]:
    for k, line in enumerate(lines):
        following = next((x for x in lines[k + 1 :] if x.strip()), "")
        inner = len(following) - len(following.lstrip()) > len(line) - len(line.lstrip())
        yield line + " pass" if line.endswith(":") and not inner else line


def _branch(word: str, line: str) -> str:
    """What begins a branch or a loop, with the statements on its line; all that follows up to its end is one block."""
    parts = [x.strip() for x in _statements(line)]
    inside = [_read_statement(x) for x in parts[1:] if x not in ("end", "else", "otherwise", "try")]
    if word in _OPENING:
        if inside and _END.search(line) is None:
            raise AbandonedError  # a block that begins on the line of its condition
        return f"{_LOOP if word in ('for', 'parfor', 'while') else _CONDITION}{'; '.join(inside)}".rstrip()
    return "; ".join(inside) or "pass"


def _read_statement(text: str, counted: Set[str] = frozenset()) -> str:
    """One statement, in Python's syntax; of what cannot be read so, that it gives its name a value."""
    try:
        return _statement(text, counted)
    except AbandonedError:
        given = _GIVEN.match(text)
        if given is None:
            return "pass"
        names = re.findall(r"[^\W\d]\w*+", given["several"] or given["name"])
        return f"{', '.join(names)} = {UNREAD}({', '.join(_WORD.findall(text, given.end()))})"


def _without_comment(line: str) -> str:
    """A line up to its comment; a string keeps its signs."""
    inside = False
    for k, c in enumerate(line):
        if c == '"' or (c == "'" and (inside or not line[:k].rstrip() or line[:k].rstrip()[-1] in "=,([{;")):
            inside = not inside
        elif not inside and (c == "%" or (c == "#" and not line[k + 1 : k + 2].isalnum()) or line.startswith("//", k)):
            return line[:k]
    return line


def _joined(lines: list[str]) -> list[str]:
    """The statements that go on over several lines, in brackets or behind …, on the last of their lines."""
    made: list[str] = []
    held, depth = "", 0
    for line in lines:
        going = line.rstrip().endswith("...")
        bare = line.rstrip()[:-3] if going else line
        depth += len(re.findall(r"[\[{(]", bare)) - len(re.findall(r"[\]})]", bare))
        inside = depth > 0 and not going
        held += bare + ("; " if inside and bare.strip() and not bare.rstrip().endswith((",", ";", "[", "(")) else " ")
        if going or depth > 0:
            made.append("")
            continue
        made.append(held.rstrip() if held.strip() else "")
        held, depth = "", 0
    return made


def _declared(names: str) -> str:
    """syms x(t) m: x is a function of time, m a symbol."""
    found = re.findall(r"([^\W\d]\w*)(\(t\))?", names)
    words = [(name, moving) for name, moving in found if name not in ("real", "positive", "t")]
    parts = [f"{n} = {'dynamicsymbols' if moving else 'symbols'}({n!r})" for n, moving in words]
    return "; ".join(parts) or "pass"


def _statements(line: str) -> list[str]:
    """The statements of a line, cut at ; and , outside of brackets."""
    found, depth, start = [], 0, 0
    for k, c in enumerate(line):
        depth += (c in "([{") - (c in ")]}")
        if c in ";," and depth <= 0:
            found.append(line[start:k])
            start = k + 1
    found.append(line[start:])
    return [x for x in found if x.strip()]


def _statement(text: str, counted: Set[str] = frozenset()) -> str:
    """One statement, in Python's syntax; ``counted`` are the names that loops count with."""
    text = text.strip()
    if (several := re.match(r"\[([\w,~ \t]+)\][ \t]*=(?!=)", text)) is not None:  # [t, z] = ode45(…)
        targets = [x if x != "~" else "unused" for x in re.split(r"[\s,]+", several[1].strip())]
        return f"{', '.join(targets)} = {_statement(text[several.end() :])}"
    entry = _ENTRY.match(text)
    if entry is not None and all(x.isdigit() or x in counted for x in re.findall(r"\w+", entry["at"])):  # M(1,2) = …
        return f"{entry['name']}[{entry['at']}] = {_statement(text[entry.end() :])}"
    return _Expression(text).written()


class _Expression:
    """An expression of MATLAB, token by token."""

    def __init__(self, text: str) -> None:
        self.text, self.at = text, 0
        self.out: list[str] = []
        self.stack: list[str] = []
        """The brackets that are open."""
        self.functions: list[int] = []
        """How many brackets were open where each function without a name begins."""
        self.before = ""

    def written(self) -> str:
        """The expression in Python's syntax."""
        while self.at < len(self.text):
            match = _TOKEN.match(self.text, self.at)
            if match is None:
                raise AbandonedError
            self.at = match.end()
            self._add(match.group(), str(match.lastgroup))
        return "".join(self.out) + ")" * len(self.functions)

    def _put(self, written: str, before: str | None = None) -> None:
        self.out.append(written)
        self.before = written or self.before if before is None else before

    def _add(self, token: str, kind: str) -> None:
        inside = bool(self.stack) and self.stack[-1] == "["
        if kind == "space":
            if inside and _separates(self.before, self.text, self.at):
                self._put(",")
        elif kind == "mark" and token in "'’":
            self._quote(token)
        elif kind == "op":
            if token == ":" and self.stack and self.stack[-1] != "slice":
                raise AbandonedError
            self._put(".T" if token in (".'", ".’") else _OPERATORS.get(token, token))
        elif token == "@":
            self._function()
        elif token == "(" and self._slices():
            self.stack.append("slice")
            self._put("[")
        elif token in "([{" and kind == "mark":
            if token == "{" and self.before[-1:].isalnum():
                raise AbandonedError  # an entry of a cell array
            self.stack.append(token)
            self._put({"[": "Matrix([[", "{": "["}.get(token, token))  # {x, y} is a list
        elif token in ")]}" and kind == "mark":
            self._close(token)
        elif token == ";" and self.stack and self.stack[-1] == "{":
            self._put(",")
        elif token == ";" and inside:
            self._strip()
            self._put("],[")
        elif token == "end" and self.stack and self.stack[-1] == "slice":
            pass
        else:
            if token == "," and self.functions and self.functions[-1] == len(self.stack) and self.stack:
                self.functions.pop()
                self.out.append(")")
            self._put(token)

    def _quote(self, mark: str) -> None:
        """A transpose behind a value, else a string."""
        if self.before and (self.before[-1].isalnum() or self.before[-1] in "_)]}'"):
            self._put(".T", ")")
            return
        end = self.text.find(mark, self.at)
        if end < 0:
            raise AbandonedError
        self._put(repr(self.text[self.at : end]))
        self.at = end + 1

    def _function(self) -> None:
        """A function without a name, @(t, z) …; the mark alone in front of the name of one."""
        given = re.match(r"[ \t]*\(([\w, \t~]*)\)", self.text[self.at :])
        if given is None:
            return
        self.at += given.end()
        listed = [x.strip() if x.strip() != "~" else "unused" for x in given[1].split(",") if x.strip()]
        self.functions.append(len(self.stack))
        self._put(f"(lambda {', '.join(listed)}: ", "(")

    def _close(self, token: str) -> None:
        while self.functions and self.functions[-1] == len(self.stack):
            self.functions.pop()
            self.out.append(")")
        if not self.stack:
            raise AbandonedError
        opened = self.stack.pop()
        if opened == "[":
            self._strip()
            token = "]])"
        elif opened == "{":
            token = "]"
        self._put("]" if opened == "slice" else token, ")" if opened == "slice" else None)

    def _slices(self) -> bool:
        """Whether what stands in a bracket that was opened are places from one to another: z(3:4), A(:, 1)."""
        places = _PLACES.match(self.text, self.at)
        return bool(self.before) and (self.before[-1].isalnum() or self.before[-1] == "_") and places is not None

    def _strip(self) -> None:
        """Take off what separates nothing at the end of a row."""
        while self.out and self.out[-1] in (",", "],["):
            self.out.pop()


def _separates(before: str, text: str, at: int) -> bool:
    """Whether a gap in a matrix is between two entries: [a b], [1 -x], but not [a - b]."""
    rest = text[at:]
    if not before or not rest or not (before[-1].isalnum() or before[-1] in "_)].T'\""):
        return False
    if rest[0] in "+-":
        return len(rest) > 1 and not rest[1].isspace()
    return rest[0].isalnum() or rest[0] in "_(.@" or rest[0] == "["
