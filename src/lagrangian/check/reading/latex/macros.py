r"""Writes out macros in LaTeX: those that an answer defines, \newcommand{\st}{\sin\theta}, and those of packages.

\dv{t}  \dv{x}{t}  \pdv{L}{x}  \qty(…)  \vb{q}  \abs{x}  \dd t       of the package physics, \od and \pd of commath
\flatfrac{a}{b}  \pqty{…}  \mqty(a & b \\ c & d)                    also of physics
\let\th\vartheta                                                  another name of a command
"""

from __future__ import annotations

import re
from collections import Counter
from itertools import islice

from lagrangian.check.reading.latex.layout import closing
from lagrangian.check.reading.markup import blanked
from lagrangian.check.reading.programs.sessions import closes
from lagrangian.errors import ParseError
from lagrangian.quantities.source import Source
from lagrangian.records import dataclass

MAX_MACROS = 100
"""The largest number of macros in an answer."""

MAX_WRITTEN = 120_000
"""The largest number of characters of an answer after its macros are written out."""

MAX_INSIDE = 8
"""How deep macros may be inside others."""

LONGEST_SHORT = 24
"""The most characters of what stands for a macro that is only another name."""

_DEFINES = re.compile(
    r"\\(?:(?:re)?newcommand|providecommand|DeclareRobustCommand|DeclareMathOperator|def|gdef)\*?\s*+"
    r"\{?\s*+\\(?P<name>[A-Za-z]++|[^A-Za-z\s])\s*+\}?\s*+"
    r"(?:\[(?P<count>\d)\]\s*+(?:\[(?P<first>[^\]]{0,80})\])?|(?P<hashes>(?:#\d)*+))\s*+\{"
)
_LET = re.compile(r"\\let\s*+\\(?P<new>[A-Za-z]++|[^A-Za-z\s])\s*+=?\s*+\\(?P<old>[A-Za-z]++|[^A-Za-z\s])")
_USED = re.compile(r"\\(?P<name>[A-Za-z]+|[^A-Za-z\s])(?P<star>\*?)")
_PARAMETER = re.compile(r"#(\d)")
_FUNCTION = re.compile(r"\s*+\\(?:sin|cos|tan|cot)\s*+\\?\w++(?:\{\w{1,12}\})?\s*+")
"""A function of one name: the power behind its macro, \\ct^2, is not that of the name."""
_POWER = re.compile(r"\s{0,9}\^\s{0,9}(?:\d|\{\s{0,9}\d)")
_SPACE = re.compile(r"\s*")
_SPACED = re.compile(r"[ \t]*")


@dataclass(frozen=True)
class Macro:
    """The text of a macro with #1, #2 for its arguments. ``first`` is the value of the first if it is left out."""

    body: str
    count: int = 0
    first: str | None = None
    least: int | None = None
    """The fewest arguments in braces, if the last may be left out; ``short`` is the text then."""
    short: str = ""
    bracketed: bool = False
    """Whether its argument may also stand in round or square brackets."""


def _derivative(d: str) -> Macro:
    whole = rf"\frac{{{d}^{{#1}} #2}}{{{d} #3^{{#1}}}}"
    return Macro(whole, 3, "", least=2, short=rf"\frac{{{d}^{{#1}}}}{{{d} #2^{{#1}}}}")


_PACKAGES = {name: _derivative("d") for name in ("dv", "derivative", "od", "odv")}
_PACKAGES |= {name: _derivative(r"\partial ") for name in ("pdv", "pd", "diffp", "partialderivative")}
_PACKAGES |= {"dd": Macro("d"), "qty": Macro(""), "vb": Macro(r"\mathbf{#1}", 1), "va": Macro(r"\mathbf{#1}", 1)}
_PACKAGES |= {"abs": Macro(r"\lvert #1 \rvert", 1), "dotproduct": Macro(r"\cdot"), "vdot": Macro(r"\cdot")}
_PACKAGES |= {"quantity": Macro(""), "flatfrac": Macro(r"\frac{#1}{#2}", 2)}
_PACKAGES |= {"pqty": Macro("(#1)", 1), "bqty": Macro("[#1]", 1), "Bqty": Macro("(#1)", 1)}
_MATRIX = Macro(r"\begin{pmatrix}#1\end{pmatrix}", 1, bracketed=True)
_MATRICES = "mqty matrixquantity pmqty bmqty Pmqty smqty spmqty sbmqty"
_PACKAGES |= dict.fromkeys(_MATRICES.split(), _MATRIX)
_PACKAGES |= {"Dot": Macro(r"\dot{#1}", 1), "Ddot": Macro(r"\ddot{#1}", 1), "differential": Macro("d")}


@dataclass(frozen=True)
class ExpandedLatex:
    """A text with its macros written out, and for each of its characters the place in the original."""

    text: str
    origins: list[int]

    def origin(self, at: int) -> int:
        """The place in the original of a character."""
        return self.origins[min(at, len(self.origins) - 1)] if self.origins else 0


def written_out(source: Source) -> ExpandedLatex:
    """Return LaTeX without macros; raise an error if it becomes too long."""
    text = source.text
    origins = list(range(len(text)))
    text, macros = _definitions(text, source)
    for _ in range(MAX_INSIDE):
        found = _once(text, origins, macros, source)
        if found is None:
            return ExpandedLatex(text, origins)
        text, origins = found
    raise _too_long(source, origins[0] if origins else 0)


def _too_long(source: Source, at: int) -> ParseError:
    return source.error(
        "the macros become too long when they are written out", at, fix="write the formulas out", code="E703"
    )


def _definitions(text: str, source: Source) -> tuple[str, dict[str, Macro]]:
    """The text with all definitions replaced by spaces, and the macros by name."""
    text, macros = _other_names(text, dict(_PACKAGES))
    at = 0
    for _ in range(MAX_MACROS + 1):
        match = _DEFINES.search(text, at)
        if match is None:
            return text, macros
        end = closing(text, match.end())
        body = text[match.end() : end - 1]
        if "operator" in match.group().lower():
            body = rf"\operatorname{{{body}}}"
        count = int(match["count"] or len(match["hashes"] or "") // 2)
        macros[match["name"]] = Macro(body, count, match["first"])
        text = blanked(text, match.start(), end)
        at = end
    raise source.error(f"more than {MAX_MACROS} macros", at, fix="write the formulas out", code="E703")


def _other_names(text: str, macros: dict[str, Macro]) -> tuple[str, dict[str, Macro]]:
    """The text with all \\let replaced by spaces, and the macros with those that they define; names that are exchanged,
    \\let\\old\\phi \\let\\phi\\varphi \\let\\varphi\\old, stay as they are."""
    lets = {m["new"]: m["old"] for m in islice(_LET.finditer(text), MAX_MACROS)}
    for new, old in lets.items():
        if old not in lets or all(x not in (new, old) for x in _followed(old, lets)):
            macros[new] = Macro(f"\\{old}")
    return _LET.sub(lambda m: " " * len(m.group()), text), macros


def _followed(name: str, lets: dict[str, str]) -> list[str]:
    """What a name stands for, and what that does, until none is left or one comes again."""
    found: list[str] = []
    while (name := lets.get(name, "")) and name not in found:
        found.append(name)
    return found


def short_names(text: str) -> dict[str, str]:
    """Return the macros of an answer that are another name, \\newcommand{\\q}{\\varphi}, with what they stand for."""
    found = {m["new"]: f"\\{m['old']}" for m in islice(_LET.finditer(text), MAX_MACROS)}
    for match in islice(_DEFINES.finditer(text), MAX_MACROS):
        body = text[match.end() : closing(text, match.end()) - 1].strip()
        if len(body) <= LONGEST_SHORT and not match["count"] and not match["hashes"]:
            found[match["name"]] = body
    return found


def _once(text: str, origins: list[int], macros: dict[str, Macro], source: Source) -> tuple[str, list[int]] | None:
    """The text with each macro in it written out once; None if there is none."""
    pieces: list[str] = []
    places: list[int] = []
    at = 0
    size = 0
    for match in _USED.finditer(text):
        if match.start() < at or (macro := macros.get(match["name"])) is None:
            continue
        body, values, end = _arguments(macro, text, match.end("name") if not match["star"] else match.end())
        size += _length(body, values)  # looked at before anything of that length is made
        if size + len(text) > MAX_WRITTEN:
            raise _too_long(source, origins[match.start()])
        made = _with_arguments(body, values)
        if _FUNCTION.fullmatch(made) and _POWER.match(text, end):
            made = f"{{{made}}}"
        gap = " " if made[-1:].isalpha() or made[:1].isalpha() else ""
        made = f"{gap}{made}{gap}"
        pieces += [text[at : match.start()], made]
        places += [*origins[at : match.start()], *([origins[match.start()]] * len(made))]
        at = end
    if not pieces:
        return None
    return "".join([*pieces, text[at:]]), [*places, *origins[at:]]


def _arguments(macro: Macro, text: str, at: int) -> tuple[str, list[str], int]:
    """The body of a macro that ends at a place, its arguments, and where these end."""
    values: list[str] = []
    if macro.first is not None:
        start = _end(_SPACED, text, at)
        stop = text.find("]", start) if text[start : start + 1] == "[" else -1
        values.append(text[start + 1 : stop] if stop >= 0 else macro.first)
        at = stop + 1 if stop >= 0 else at
    body = macro.body
    while len(values) < macro.count:
        start = _end(_SPACE, text, at)
        if macro.least is not None and len(values) == macro.least and text[start : start + 1] != "{":
            body = macro.short
            break
        value, at = _argument(text, start, macro.bracketed)
        values.append(value)
    return body, values, at


def _length(body: str, values: list[str]) -> int:
    """An upper bound of the characters of a body with its arguments: at least its own, for so many are gone through."""
    uses = Counter(map(int, _PARAMETER.findall(body))) if len(body) <= MAX_WRITTEN else {}
    inserted = sum(uses.get(number, 0) * len(value) for number, value in enumerate(values, 1))
    return len(body) + inserted + 2


def _with_arguments(body: str, values: list[str]) -> str:
    made = _PARAMETER.sub(lambda m: values[int(m[1]) - 1] if 0 < int(m[1]) <= len(values) else "", body)
    return made.replace("^{}", "")


def _argument(text: str, at: int, bracketed: bool) -> tuple[str, int]:
    """The argument that begins at a place, without its braces, or brackets if it is ``bracketed``, and its end."""
    if bracketed and text[at : at + 1] in ("(", "[") and (last := closes(text, at)) > 0:
        return text[at + 1 : last], last + 1
    if text[at : at + 1] == "{":
        end = closing(text, at + 1)
        return text[at + 1 : end - 1], end
    match = _USED.match(text, at)
    end = match.end("name") if match is not None else min(at + 1, len(text))
    return text[at:end], end


def _end(form: re.Pattern[str], text: str, at: int) -> int:
    match = form.match(text, at)
    return match.end() if match is not None else at
