r"""Names that an answer in LaTeX gives otherwise than by a formula of its own: below a brace, and in a sentence.

\underbrace{(J + m l^2)}_{\Theta} \ddot\theta = …        $\Theta = (J + m l^2)$ in front, where \Theta is used again
$S$ = tension in the hitch $= k u + c\dot u$              tension in the hitch $S = k u + c\dot u$
$\frac{d}{dt} p = m \ddot x$, which we call $Z$            $\frac{d}{dt} p = m \ddot x = Z$
$\Theta$ & $= J + m l^2$ \\                               $\Theta = J + m l^2$, in a row of a table
\begin{tabular}{l@{$=$}l} $x_1$ & $x - d$ \\              $x_1 = x - d$
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.latex.layout import closing
from lagrangian.check.reading.name_patterns import CALLED_AFTER, CALLED_SO
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

MOST = 40
"""The most braces, and sentences, that are looked at."""
LONGEST = 400
"""The most characters of what stands above a brace."""

_NAME = r"\\?[^\W\d_][A-Za-z]{0,11}(?:_(?:\w|\{\w{1,8}\}|\\[A-Za-z]{2,8}))?(?![\w_{])"
_THIN = r"(?:\s|\\[,;:! ])*+"
_BRACE = re.compile(r"\\under(?:brace|bracket)\s{0,3}(?=\{)")
_LABEL = re.compile(
    rf"\s{{0,3}}_\s{{0,3}}(?:\{{{_THIN}(?:=:|=?:?=|\\equiv|:=)?{_THIN}(?P<braced>{_NAME}){_THIN}(?::?=|=:)?\s*\}}"
    r"|(?P<bare>\w))"
)
_SINGLE = re.compile(r"\\[A-Za-z]+|[A-Za-z](?:_(?:\w|\{\w{1,8}\}|\\[A-Za-z]{2,8}))?")
_DISPLAY = re.compile(
    r"\\begin\{(?P<kind>equation|align|gather|multline|eqnarray|flalign|alignat|displaymath)\*?\}|\\\[|\$\$|\n[ \t]*\n"
)
_IN_WORDS = re.compile(
    rf"\$(?P<new>{_NAME})\$[ \t]*+(?:=|:|is\b|denotes\b|means\b)?[ \t]*+"
    r"(?P<words>(?:[^\W\d_][^\W\d_’'-]{1,20}[ \t]++){1,8})\$(?P<sign>[ \t]*+=)(?![=>])"
)
"""A name, words that say what it is, and its value in a formula of its own."""
_IN_CELL = re.compile(
    rf"\$(?P<new>{_NAME})\$[ \t]*+[&|][ \t]*+(?:[^\W\d_][^$&|\\\n=]{{0,80}})?\$(?P<sign>[ \t]*+=)(?![=>])"
)
"""A name and its value in cells of a table that stand beside each other."""
_NAMED_BEHIND = re.compile(
    rf"=[^=$]{{1,400}}(?P<said>\$\$?,?[ \n]{CALLED_SO}\$(?P<new>{_NAME})\$)(?={CALLED_AFTER}\s*(?:[.,;]|\Z))",
    re.IGNORECASE,
)
"""A name that words give to the end of a formula in front of them."""

_COLUMNS = re.compile(
    r"\\begin\s?\{(?P<kind>tabular|tabularx|longtable)\*?\}(?P<spec>\{(?:[^{}\n]|\{[^{}\n]{0,40}\}){1,80}\})"
    r"(?P<rows>[^\0]{0,4000}?)\\end\{(?P=kind)\*?\}"
)
"""A table with what stands between its columns."""
_EQUATED = re.compile(r"\{\s?\|?\s?[lcr]\s?[@!]\{[^{}=]{0,20}=[^{}=]{0,20}\}")
"""Columns of which an equals sign parts the first two."""
_CELLS = re.compile(rf"(?P<new>\$\s?{_NAME}\s?)\$\s{{0,9}}&\s{{0,9}}\$(?=[^$&\n]{{1,200}}\$)")


def with_named_formulas(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in LaTeX in which such names stand in front of their formulas; ``taken`` says whether a name
    belongs to the system."""
    return _with_named_braces(_with_names_in_words(_with_equated_columns(written), taken), taken)


def _with_equated_columns(written: TracedText) -> TracedText:
    """An answer in which an equals sign that stands between the columns of a table stands in its rows."""
    edits: list[Edit] = []
    for match in islice(_COLUMNS.finditer(written.text), MOST):
        if "$" in match["spec"]:
            edits.append((*match.span("spec"), "{l}"))
        if _EQUATED.match(match["spec"]) is not None:
            found = islice(_CELLS.finditer(written.text, *match.span("rows")), MOST)
            edits += [(x.end("new"), x.end(), " = ") for x in found]
    return written.edited(apart(edits))


def _with_names_in_words(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    edits: list[Edit] = []
    for match in islice(_IN_WORDS.finditer(written.text), MOST):
        if taken(_bare(match["new"])) or _is_given(written.text, match["new"]):
            continue
        edits.append((match.start(), match.start("words"), " "))
        edits.append((*match.span("sign"), f"{match['new']} ="))
    for match in islice(_NAMED_BEHIND.finditer(written.text), MOST):
        if not taken(_bare(match["new"])) and not _is_given(written.text, match["new"]):
            edits.append((*match.span("said"), f" = {match['new']}" + "$" * (1 + match["said"].startswith("$$"))))
    for match in islice(_IN_CELL.finditer(written.text), MOST):
        if not taken(_bare(match["new"])) and not _is_given(written.text, match["new"]):
            edits.append((*match.span("sign"), f"{match['new']} ="))
    return written.edited(apart(sorted(edits)))


def _with_named_braces(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """An answer in which a name below a brace that is used elsewhere is stated in front of the display."""
    text, edits, named = written.text, dict[int, str](), set[str]()
    for match in islice(_BRACE.finditer(text), MOST):
        end = closing(text, match.end() + 1)
        label = _LABEL.match(text, end)
        if label is None or end - match.end() > LONGEST:
            continue
        name, inside = label["braced"] or label["bare"], text[match.end() + 1 : end - 1]
        if name in named or taken(_bare(name)) or "=" in inside or _is_given(text, name):
            continue
        others = text[: label.start()] + text[label.end() :]
        if not _is_used(others, name):
            continue
        named.add(name)
        at = _front(text, match.start())
        edits[at] = f"{edits.get(at, '')}${name} = {inside}$\n"
    return written.edited((at, at, said) for at, said in edits.items())


def _front(text: str, place: int) -> int:
    """Where the display, or the paragraph, begins in which a place stands."""
    at = 0
    for match in _DISPLAY.finditer(text, 0, place):
        opens = match["kind"] is not None or match.group() == "\\["
        at = match.start() if opens else match.end() if match.group().isspace() else at
        if match.group() == "$$" and text.count("$$", 0, match.end()) % 2 == 1:
            at = match.start()
    return at


def _is_used(text: str, name: str) -> bool:
    """Whether a name stands in a text; one that begins with a single letter may follow another name, as in r_2F_1."""
    if re.search(rf"(?<![\w\\]){re.escape(name)}(?![A-Za-z_])", text) is not None:
        return True
    return name[1:2] == "_" and any(m.group() == name for m in _SINGLE.finditer(text))


def _is_given(text: str, name: str) -> bool:
    """Whether a formula gives a name its value."""
    return re.search(rf"(?<![\w\\]){re.escape(name)}\s*&?\s*:?=(?!=)", text) is not None


def _bare(name: str) -> str:
    """A name as the system may spell it: \\Theta_O is Theta_O."""
    return name.replace("\\", "").replace("{", "").replace("}", "")
