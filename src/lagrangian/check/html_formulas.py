"""Reads an HTML page of this package back as Markdown: its words, and its formulas as LaTeX made of their MathML.

The formulas of one display, which browsers show term by term, become one formula; so does every equation of the result.
Nothing here is shared with the writer of MathML: what a browser shows is what is read.
"""

from __future__ import annotations

from collections.abc import Mapping
from html.parser import HTMLParser

from lagrangian.records import dataclass, field

DISPLAYS = frozenset(["formula", "equation"])
"""Classes of the elements whose formulas are one."""

ASIDE = frozenset(["note", "tag", "unseen", "lead"])
"""Classes of what stands beside a formula and is not part of it."""

BLOCKS = frozenset(["p", "h1", "h2", "h3", "li", "tr", "div", "section", "table", "ul", "summary", "details", "main"])
"""Elements that begin a line of words."""

CELLS = frozenset(["td", "th"])
"""Cells of tables, between which a line has bars."""

SKIPPED = frozenset(["style", "script", "svg", "head", "nav", "title"])
"""Elements without words of the page."""

VOID = frozenset(["meta", "link", "br", "hr", "img", "input", "wbr"])
"""Elements without an end."""

_SMALL = "αβγδεζηθικλμνξπρστυφχψω", (
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi",
    "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega",
)  # fmt: skip
_CAPITAL = "ΓΔΘΛΞΠΣΥΦΨΩ", (
    "Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi", "Omega",
)  # fmt: skip
LETTERS: Mapping[str, str] = {
    **dict(zip(*_SMALL, strict=True)),
    **dict(zip(*_CAPITAL, strict=True)),
    "∞": "infty",
    "ℒ": "mathcal{L}",
}
"""Letters → their names in LaTeX."""

FUNCTIONS = frozenset(["sin", "cos", "tan", "sinh", "cosh", "tanh", "arcsin", "arccos", "arctan", "ln", "exp"])
"""Functions that have commands of their own."""

SIGNS: Mapping[str, str] = {
    "−": "-",
    "·": r"\cdot ",
    "∂": r"\partial ",
    "\u2061": "",
    "≤": r"\le ",
    "≥": r"\ge ",
    "≠": r"\ne ",
    "|": "|",
    "*": "*",
}
"""Operators that LaTeX writes in other characters."""

DOTS: Mapping[str, str] = {"˙": "dot", "¨": "ddot", "⃛": "dddot"}
"""Accents → their commands."""


@dataclass
class _Node:
    """An element of MathML, or a text (then without a ``tag``)."""

    tag: str
    text: str = ""
    children: list[_Node] = field(default_factory=list)


def as_markdown(page: str) -> str:
    """Return the words and formulas of a page, a line or a display each."""
    reader = _Reader()
    reader.feed(page)
    reader.close()
    return reader.text()


class _Reader(HTMLParser):
    """Walks through a page, and collects lines."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self._lines: list[str] = []
        self._line: list[str] = []
        self._open: list[tuple[str, frozenset[str]]] = []
        self._math: list[_Node] = []
        self._display: list[str] = []

    def text(self) -> str:
        """What was read."""
        self._end_line()
        return "\n\n".join(self._lines) + "\n"

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Open an element."""
        if tag in VOID:
            return
        if tag == "math" or self._math:
            self._math.append(_Node(tag))
            return
        classes = frozenset((dict(attrs).get("class") or "").split())
        if tag in BLOCKS and not self._within(DISPLAYS):
            self._end_line()
        self._open.append((tag, classes))
        if tag in CELLS and not self._within(SKIPPED, tags=True):
            self._line.append(" | " if self._line else "| ")

    def handle_endtag(self, tag: str) -> None:
        """Close an element."""
        if tag in VOID:
            return
        if self._math:
            done = self._math.pop()
            if self._math:
                self._math[-1].children.append(done)
            elif not self._within(ASIDE | SKIPPED, tags=True):
                self._put(_row(done.children))
            return
        closed = frozenset[str]()
        while self._open:
            name, classes = self._open.pop()
            closed |= classes
            if name == tag:
                break
        if closed & DISPLAYS and self._display:
            self._lines.append(f"$$\n{' '.join(self._display)}\n$$")
            self._display = []
        elif tag in BLOCKS and not self._within(DISPLAYS):
            self._end_line()

    def handle_data(self, data: str) -> None:
        """Keep words."""
        if self._math:
            self._math[-1].children.append(_Node("", data))
        elif not self._within(DISPLAYS) and not self._within(ASIDE | SKIPPED, tags=True):
            self._line.append(data)

    def _put(self, formula: str) -> None:
        if self._within(DISPLAYS):
            self._display.append(formula)
        else:
            self._line.append(f"${formula}$")

    def _within(self, wanted: frozenset[str], *, tags: bool = False) -> bool:
        return any(classes & wanted or (tags and tag in wanted) for tag, classes in self._open)

    def _end_line(self) -> None:
        words = " ".join("".join(self._line).split())
        if words:
            self._lines.append(words)
        self._line = []


def _row(nodes: list[_Node]) -> str:
    return "".join(_latex(node) for node in nodes)


def _latex(node: _Node) -> str:
    """An element of MathML as LaTeX."""
    of = node.children
    match node.tag:
        case "mi":
            return _letter(_words(node))
        case "mn":
            return _words(node)
        case "mo":
            return SIGNS.get(_words(node), _words(node))
        case "mtext":
            return _text(_words(node))
        case "mspace":
            return " "
        case "mfrac":
            return rf"\frac{{{_latex(of[0])}}}{{{_latex(of[1])}}}"
        case "msqrt":
            return rf"\sqrt{{{_row(of)}}}"
        case "msub":
            return f"{_latex(of[0])}_{{{_latex(of[1])}}}"
        case "msup":
            return f"{_latex(of[0])}^{{{_latex(of[1])}}}"
        case "msubsup":
            above, below = f"^{{{_latex(of[2])}}}", f"_{{{_latex(of[1])}}}"
            starred = of[2].tag == "mo"  # a mark, which belongs to the letter
            return _latex(of[0]) + (above + below if starred else below + above)
        case "mover":
            return rf"\{DOTS[_words(of[1])]}{{{_latex(of[0])}}} "
        case "mtable":
            return " ".join(_row([cell for cell in line.children if cell.tag]) for line in of if line.tag)
        case _:
            return _row(of)


def _words(node: _Node) -> str:
    return (node.text + "".join(_words(child) for child in node.children)).strip("\n")


def _letter(name: str) -> str:
    if name in FUNCTIONS:
        return rf"\{name} "
    if name in LETTERS:
        return rf"\{LETTERS[name]} "
    return name if len(name) == 1 else rf"\mathrm{{{name}}}"


def _text(words: str) -> str:
    """A name in upright letters; a phrase is no part of a formula that is read."""
    return rf"\mathrm{{{words}}}" if words.isalnum() else rf"\text{{{words}}}"
