"""Writes functions of Julia as functions of MATLAB, line by line, to be carried out on symbols.

function f!(du, u, p, t)     function du = f(u, p, t)        u[1]       u(1)          2m       2*m
(; m, k) = p                 the parameters by their names   [a, b]     [a; b]        φ̇        phidot
du .= (v, a)                 du = [v; a]                     return a   out = a
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator

from lagrangian.check.reading.carried_out.values import AbandonedError

_NAME = r"[^\W\d]\w*+"
_FUNCTION = re.compile(rf"^[ \t]*+function[ \t]++(?P<name>{_NAME})(?P<mark>!?)\((?P<given>[^\n]*+)", re.MULTILINE)
_SHORT = re.compile(rf"^[ \t]*+(?P<name>{_NAME})\((?P<given>[\w ,]{{0,60}}+)\)[ \t]*+=(?!=)[ \t]*+", re.MULTILINE)
"""A function in one line: f(q, v) = …"""
_ARROW = re.compile(rf"(?:\((?P<given>[\w ,]{{1,60}}+)\)|(?P<one>\b{_NAME}))[ \t]*+->")
_PARAMETERS = re.compile(
    rf"^[ \t]*+(?:\([ \t]*+;[^()=\n]++\)|@unpack\b[^=\n]++)[ \t]*+=(?!=)[ \t]*+{_NAME}[ \t]*+$", re.MULTILINE
)
_INNER = r"\((?:[^\n%()\[\]]|\([^\n%()\[\]]{0,80}+\)){0,200}+\)"
_VALUE = rf"(?:[^\n%()\[\],]|{_INNER})*+"
_BETWEEN = re.compile(rf"{_INNER}|,")
"""The commas between values, and what stands in brackets, with commas of its own: atan(a, b)."""
_UNPACKED = re.compile(
    rf"^(?P<indent>[ \t]*+)(?P<names>{_NAME}(?:[ \t]*+,[ \t]*+{_NAME})++)[ \t]*+=(?!=)"
    rf"(?P<listed>{_VALUE}(?:,{_VALUE})++)?",
    re.MULTILINE,
)
_CONDITION = re.compile(
    r"(?P<to>=[ \t]*+(?:@\([\w ,]{0,60}+\)[ \t]*+)?)(?P<given>[^=?\n%]{1,200}+)\?[^\n%:]{1,200}+:[^\n%]++$",
    re.MULTILINE,
)
"""A value by a condition: F(t) = t < 1 ? 20.0 : 0.0."""
_WHOLE = re.compile(rf"^(?P<to>[ \t]*+{_NAME})(?:\[[ \t]*+:[ \t]*+\])?[ \t]*+\.=[ \t]*+(?P<bare>\()?", re.MULTILINE)
_LEFT_OUT = re.compile(
    r"^[ \t]*+(?:(?:using|import|export|const|plot|println|print|display)\b|@(?!unpack))[^\n]*+$", re.MULTILINE
)
_VALUES = re.compile(
    rf"^[ \t]*+{_NAME}[ \t]*+=[ \t]*+\([ \t]*+;?[ \t]*+{_NAME}[ \t]*+=(?!=)[^\n()]*+\)[ \t]*+$", re.MULTILINE
)
"""Values of parameters by their names, in one line: p = (m = 1.0, k = 2.0)."""
_BOTH = re.compile(
    rf"^(?P<indent>[ \t]*+)(?P<sine>{_NAME})[ \t]*+,[ \t]*+(?P<cosine>{_NAME})[ \t]*+=[ \t]*+sincos"
    r"(?P<of>\([^\n%#=]*+)$",
    re.MULTILINE,
)
"""Sine and cosine at once: s, c = sincos(φ)."""
_PART = re.compile(
    rf"^(?P<indent>[ \t]*+)(?P<of>{_NAME})\[(?P<first>\d{{1,2}}):(?P<last>\d{{1,2}})\][ \t]*+\.=[ \t]*+"
    r"[(\[](?P<listed>[^\n%#()\[\]]*+)[)\]][ \t]*+$",
    re.MULTILINE,
)
"""Some entries of a list at once: du[1:2] .= (v, w)."""
_CHANGES = re.compile(r"(?<=\w)!(?!=)")
_STRUCTURE = re.compile(r"[ \t]*+(?:@kwdef[ \t]++|Base\.@kwdef[ \t]++)?(?:mutable[ \t]++)?struct\b")
_TYPE = re.compile(r"::[\w.{}]{1,60}+")
_FACTOR = re.compile(r"(?<![\w.])(?P<number>\d++(?:\.\d++)?)(?=[^\W\d]|\()(?![eEf][-+]?\d)")
_RETURNED = re.compile(r"^(?P<indent>[ \t]*+)return[ \t]++(?!nothing\b)(?=\S)", re.MULTILINE)
_NOTHING = re.compile(r"^[ \t]*+(?:return[ \t]++)?nothing[ \t]*+;?[ \t]*+$", re.MULTILINE)
_ENDS = re.compile(r"[ \t]*+(?:end|return)\b")
_DOTTED = re.compile("(?<=\\w)[\u0307\u0308]")
_PRIMES = re.compile(r"(?<=\w)[′″]")
_IS_JULIA = re.compile(
    rf"^[ \t]*+function[ \t]++{_NAME}!?\([^\n=]*+$|^[ \t]*+using[ \t]++[A-Z]|^[ \t]*+\([ \t]*+;[^()=\n]++\)[ \t]*+=",
    re.MULTILINE,
)
CONDITIONAL = "conditional"
"""What gives a value that depends on a condition, of which nothing is known."""
RESULT = "result_of_it"
"""The name of what a function returns that has none for it."""


def is_julia(text: str) -> bool:
    """Whether a program is in Julia: a function with its arguments alone, without what it returns in front."""
    return _IS_JULIA.search(text) is not None


def in_matlab(text: str) -> str:
    """Return the program in MATLAB's syntax, with the same lines; `AbandonedError` if its brackets do not close."""
    text = _PRIMES.sub(lambda m: "dot" if m.group() == "′" else "ddot", _letters(text))
    text = "\n".join(_without_structures([_commented(x) for x in text.split("\n")]))
    text = _TYPE.sub("", _NOTHING.sub("", _VALUES.sub("", _PARAMETERS.sub("", _LEFT_OUT.sub("", text)))))
    text = _BOTH.sub(lambda m: f"{m['indent']}{m['sine']} = sin{m['of']}; {m['cosine']} = cos{m['of']}", text)
    text = _CHANGES.sub("", _FUNCTION.sub(_header, _PART.sub(_part, text)))
    text = _SHORT.sub(lambda m: f"{m['name']} = @({m['given']}) ", text)
    text = _ARROW.sub(lambda m: f"@({m['given'] or m['one']}) ", text)
    text = _CONDITION.sub(lambda m: f"{m['to']}{CONDITIONAL}()", text)
    text = _RETURNED.sub(lambda m: f"{m['indent']}{RESULT} = ", text)
    text = _with_results(_FACTOR.sub(lambda m: f"{m['number']}*", text).split("\n"))
    return _UNPACKED.sub(_unpacked, _brackets(text))


def _letters(text: str) -> str:
    """φ̇ as φdot, also where the letter and its dot are one character; ü stays."""
    text = "".join(unicodedata.normalize("NFD", c) if c not in "äöüÄÖÜ" else c for c in text)
    return unicodedata.normalize("NFC", _DOTTED.sub(lambda m: "dot" if m.group() == "\u0307" else "ddot", text))


def _commented(line: str) -> str:
    """A line whose comment, if it has one, begins as in MATLAB."""
    code, mark, said = line.partition("#")
    code = code.replace("//", "/")  # a rational number
    return f"{code}%{said}" if mark else code


def _without_structures(lines: list[str]) -> list[str]:
    """The lines without definitions of structures, which hold values of parameters."""
    made: list[str] = []
    inside = False
    for line in lines:
        if not inside and _STRUCTURE.match(line):
            inside = re.search(r"\bend\b", line) is None
            made.append("")
        else:
            made.append("" if inside else line)
            inside = inside and re.match(r"[ \t]*+end\b", line) is None
    return made


def _header(match: re.Match[str]) -> str:
    """The first line of a function; one with ! changes its first argument."""
    listed = match["given"].partition("%")[0].rstrip()
    if not listed.endswith(")"):
        raise AbandonedError
    given = [x.partition("=")[0].strip() for x in re.split(r"[,;]", re.sub(r"[()]", "", listed))]
    given = [x for x in given if x]
    out = given.pop(0) if match["mark"] and given else RESULT
    return f"function {out} = {match['name']}({', '.join(given)})"


def _part(match: re.Match[str]) -> str:
    """Entries one by one: du[1] = v; du[2] = w."""
    listed = [x.strip() for x in match["listed"].split(",")]
    places = range(int(match["first"]), int(match["last"]) + 1)
    if len(listed) != len(places):
        return match.group()
    return match["indent"] + "; ".join(f"{match['of']}[{k}] = {x}" for k, x in zip(places, listed, strict=True))


def _unpacked(match: re.Match[str]) -> str:
    """Several names on the left of one list: [a, b] = [1; 2]."""
    values = _BETWEEN.sub(lambda m: ";" if m.group() == "," else m.group(), match["listed"] or "")
    listed = f" [{values}]" if match["listed"] else ""
    return f"{match['indent']}[{match['names']}] ={listed}"


def _with_results(lines: list[str]) -> str:
    """The program in which a function returns what its last line says, if that is a value alone."""
    function, last, depth = False, -1, 0
    for k, line in enumerate(lines):
        bare = line.partition("%")[0].strip()
        if bare.startswith("function "):
            function, last, depth = f"function {RESULT} " in bare, -1, 0
        elif function and _ENDS.fullmatch(bare):
            if last >= 0 and re.search(r"(?<![=<>~.])=(?!=)", lines[last].partition("%")[0]) is None:
                lines[last] = f"{RESULT} = {lines[last].strip()}"
            function = False
        elif bare:
            last = last if depth > 0 else k
            depth += sum((c in "([") - (c in ")]") for c in bare)
    return "\n".join(lines)


def _brackets(text: str) -> str:
    """Indices in round brackets, columns with semicolons: x[1] as x(1), [a, b] as [a; b], du .= (a, b) as a list."""
    out: list[str] = []
    open_: list[str] = []
    assigned = list(_WHOLE.finditer(text))
    whole = {m.end() - 1 for m in assigned if m["bare"]}
    starts = {m.end("to") for m in assigned}
    skipped = {k for m in assigned for k in range(m.end("to"), m.end() - bool(m["bare"]))}
    rows = set(_with_rows(text))
    comment = False
    for k, c in enumerate(text):
        comment = (comment or c == "%") and c != "\n"
        if k in starts and not comment:
            out.append(" = ")
        if k in skipped and not comment:
            continue
        if comment or c not in "()[],":
            out.append(c)
        elif c in "([":
            index = c == "[" and k > 0 and (text[k - 1].isalnum() or text[k - 1] in "_)]")
            open_.append("[" if k in whole or (c == "[" and not index) else "(")
            out.append(open_[-1])
            open_[-1] += ";" * (k in rows)
        elif c == ",":
            out.append(";" if open_ and open_[-1] == "[" else c)
        else:
            if not open_:
                raise AbandonedError
            out.append("]" if open_.pop().startswith("[") else ")")
    return "".join(out).replace(".+", "+").replace(".-", "-").replace(".=", "=")


def _with_rows(text: str) -> Iterator[int]:
    """Where brackets are opened that hold semicolons: rows whose entries may have commas, too."""
    open_: list[int] = []
    for k, c in enumerate(text):
        if c in "([":
            open_.append(k)
        elif c in ")]" and open_:
            open_.pop()
        elif c == ";" and open_:
            yield open_[-1]
