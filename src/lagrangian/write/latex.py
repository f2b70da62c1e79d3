"""Writes a derivation as a complete LaTeX article, for any engine."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lagrangian.write.document import (
    Block,
    Boxed,
    CheckLines,
    Details,
    Display,
    Document,
    HeadingBlock,
    HeadPicture,
    Inline,
    Paragraph,
    TableBlock,
)
from lagrangian.write.expression_tree import tokens
from lagrangian.write.lines import set_columns
from lagrangian.write.tex import PAGE
from lagrangian.write.tex_lines import WIDTH, boxed, displayed, rows
from lagrangian.write.tex_words import escape
from lagrangian.write.text import clean
from lagrangian.write.unicode_math import columns

MOST_BOXED = 30
"""The largest number of rows of results in a box; more results run over pages between two rules."""
MOST_ROWS = 30
"""A table with at most this many rows is kept on one page."""
MOST_ALIGNED = 20
"""A formula with at most this many rows is kept on one page."""

PIXEL, WIDEST = 0.75, 460.0
"""A pixel of a picture, and the largest width of a picture, in big points."""

_PREAMBLE = r"""\documentclass[11pt,a4paper,fleqn]{article}
\usepackage[utf8]{inputenc}
\IfFileExists{lmodern.sty}{\usepackage{lmodern}\usepackage[T1]{fontenc}}{}
\usepackage{textcomp}
\usepackage{amsmath,amssymb}
\usepackage[margin=22mm]{geometry}
\usepackage{longtable,array}
\setlength{\parindent}{0pt}
\setlength{\parskip}{0.5\baselineskip}
\setlength{\emergencystretch}{3em}
\setcounter{secnumdepth}{0}
\setlength{\mathindent}{2em}
\AtBeginDocument{\setlength{\abovedisplayskip}{4pt plus 2pt}\setlength{\belowdisplayskip}{4pt plus 2pt}%
  \setlength{\abovedisplayshortskip}{4pt plus 2pt}\setlength{\belowdisplayshortskip}{4pt plus 2pt}}
\allowdisplaybreaks
% A letter that pdfLaTeX has no sign for is shown by its number; XeLaTeX and LuaLaTeX show the letter.
\ifdefined\Umathchar
  \newcommand{\glyph}[1]{\symbol{"#1}}
\else
  \newcommand{\glyph}[1]{\texttt{[U+#1]}}
\fi
"""

_SMALL = r"""\small\setlength{\parskip}{0pt}\setlength{\LTpre}{2pt}\setlength{\LTpost}{2pt}
\setlength{\abovedisplayskip}{2pt}\setlength{\belowdisplayskip}{2pt}
\setlength{\abovedisplayshortskip}{2pt}\setlength{\belowdisplayshortskip}{2pt}"""


def page(document: Document) -> str:
    """Return a document as a complete LaTeX article."""
    preamble = _PREAMBLE.replace("margin=22mm", "margin=15mm") if document.brief else _PREAMBLE
    blocks = [preamble + r"\begin{document}", rf"\section*{{\Large {words(document.title)}}}"]
    if document.picture is not None and document.picture.tikz:
        blocks[0] = blocks[0].replace("\\begin{document}", "\\usepackage{tikz}\n\\begin{document}")
        blocks.append(_centred(document.picture))
    if document.brief:
        blocks.append(_SMALL)
    for section in document.sections:
        number = f"{section.number}\\quad " if section.number is not None else ""
        title = f"{number}{inline(section.title)}"
        blocks.append(rf"\medskip\textbf{{{title}}}" if document.brief else rf"\section*{{{title}}}")
        blocks += _blocks(section.blocks)
    blocks.append(r"\end{document}")
    text = blocks[0]
    for block in blocks[1:]:  # an empty line before a displayed formula would be an empty paragraph
        text += ("\n" if block.startswith((r"\begin{gather*}", r"\begin{align*}")) else "\n\n") + block
    return text + "\n"


def _centred(picture: HeadPicture) -> str:
    """The picture between the margins; one that is too wide is made smaller."""
    tikz = picture.tikz.rstrip("\n")
    if (points := PIXEL * picture.size[0]) > WIDEST:
        tikz = f"\\scalebox{{{WIDEST / points:.3f}}}{{%\n{tikz}}}"
    return f"\\begin{{center}}\n{tikz}\n\\end{{center}}"


def _blocks(blocks: Iterable[Block]) -> Iterator[str]:
    """The blocks, with consecutive formulas combined in one display."""
    run: list[Display] = []
    for block in blocks:
        if isinstance(block, Display):
            run.append(block)
            continue
        yield from _displays(run)
        run = []
        yield from _block(block)
    yield from _displays(run)


def _displays(run: list[Display]) -> Iterator[str]:
    """Formulas as rows of one display; a long one is aligned by itself, so that it can run over pages."""
    waiting: list[str] = []
    for formula in run:
        note = rf" \qquad\text{{({inline(formula.note)})}}" if formula.note else ""
        lines = rows(PAGE, formula.sides)
        if len(lines) <= MOST_ALIGNED:
            waiting.append(displayed(PAGE, formula.sides) + note)
            continue
        if waiting:
            yield _gathered(waiting)
            waiting = []
        yield "\\begin{align*}\n" + " \\\\\n".join(lines) + note + "\n\\end{align*}"
    if waiting:
        yield _gathered(waiting)


def _gathered(rows_of: list[str]) -> str:
    return "\\begin{gather*}\n" + " \\\\\n".join(rows_of) + "\n\\end{gather*}"


def words(text: str) -> str:
    """Any text as LaTeX words."""
    return escape(clean(text))


def inline(text: Inline) -> str:
    """Words and mathematics in a line."""
    return "".join(words(x) if isinstance(x, str) else f"${PAGE.latex(x)}$" for x in text)


def _block(block: Block) -> Iterator[str]:
    match block:
        case HeadingBlock(text):
            yield rf"\subsubsection*{{{inline(text)}}}"
        case Paragraph(text, role):
            yield rf"\textit{{Why:}} {inline(text)}" if role == "why" else inline(text)
        case Display():
            yield from _displays([block])
        case Boxed(displays):
            yield _boxed(displays)
        case TableBlock():
            yield _table(block)
        case CheckLines(verdicts):
            items = [
                rf"\item[{words(v.mark)}] {inline(v.what)}" + (f" ({words(v.figure)})" if v.figure else "")
                for v in verdicts
            ]
            yield "\n".join((r"\begin{itemize}\setlength{\itemsep}{0pt}", *items, r"\end{itemize}"))
        case Details(summary, blocks):
            yield inline(summary)
            yield from _blocks(blocks)


def _boxed(displays: tuple[Display, ...]) -> str:
    lines = boxed(PAGE, [(d.sides, d.number) for d in displays])
    body = " \\\\\n".join(lines)
    if len(lines) > MOST_BOXED:
        return f"\\noindent\\hrulefill\n\\begin{{align*}}\n{body}\n\\end{{align*}}\n\\noindent\\hrulefill"
    return f"\\begin{{gather*}}\n\\boxed{{\\begin{{aligned}}\n{body}\n\\end{{aligned}}}}\n\\end{{gather*}}"


def _table(table: TableBlock) -> str:
    """A table; a long one runs over pages and has columns of fixed widths, so that the headings always align with
    them."""
    rows_of = (table.header, *table.rows)
    lengths = [max(_length(row[j]) for row in rows_of) for j in range(len(table.header))]
    head = " & ".join(rf"\textbf{{{inline(h)}}}" for h in table.header) + r" \\ \hline"
    body = [" & ".join(inline(c) for c in row) + r" \\" for row in table.rows]
    if sum(lengths) + 2 * len(lengths) <= WIDTH - 8 and len(table.rows) <= MOST_ROWS:
        spec = "l" * len(lengths)
        return "\n".join((rf"\begin{{tabular}}{{{spec}}}", head, *body, r"\end{tabular}"))
    capped = [min(max(n, 1.6 * _length(h) + 2), 60) for n, h in zip(lengths, table.header, strict=True)]
    share = [f"{min(1.0, WIDTH / sum(capped)) * n / WIDTH:.3f}" for n in capped]
    spec = "".join(rf">{{\raggedright\arraybackslash}}p{{\dimexpr{x}\linewidth-2\tabcolsep}}" for x in share)
    return "\n".join((rf"\begin{{longtable}}[l]{{{spec}}}", head + r" \endhead", *body, r"\end{longtable}"))


def _length(cell: Inline) -> int:
    return sum(columns(x) if isinstance(x, str) else sum(set_columns(t) for t in tokens(x)) for x in cell)
