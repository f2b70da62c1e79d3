"""A derivation as a LaTeX article that compiles as it is, with any engine."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.derive import Derivation
from lagrangian.write.document import Block, Boxed, Details, Display, Heading, Inline, Paragraph, Table, Verdicts
from lagrangian.write.glyphs import columns, unicode
from lagrangian.write.layout import lay_out
from lagrangian.write.quantities import Notation
from lagrangian.write.tex import escape, latex
from lagrangian.write.tex_lines import boxed, displayed, rows
from lagrangian.write.text import clean

MOST_BOXED = 30
"""Rows of results that one box holds; more of them run over pages between two rules."""
MOST_ALIGNED = 20
"""Rows of a formula that are kept on one page."""

_PREAMBLE = r"""\documentclass[11pt,a4paper]{article}
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
\allowdisplaybreaks
% A letter that pdfLaTeX has no sign for is shown by its number; XeLaTeX and LuaLaTeX show the letter.
\ifdefined\Umathchar
  \newcommand{\glyph}[1]{\symbol{"#1}}
\else
  \newcommand{\glyph}[1]{\texttt{[U+#1]}}
\fi
"""


def to_latex(derivation: Derivation, *, notation: Notation = "lecture", brief: bool = False, full: bool = False) -> str:
    """Return the derivation as a complete LaTeX article. Raises `ModelError` for an unknown notation."""
    document = lay_out(derivation, notation=notation, brief=brief, full=full)
    blocks = [_PREAMBLE + r"\begin{document}", rf"\section*{{\Large {words(document.title)}}}"]
    if brief:
        blocks.append(r"\small\setlength{\parskip}{0.2\baselineskip}")
    for section in document.sections:
        number = f"{section.number}\\quad " if section.number is not None else ""
        level = "subsection*" if brief else "section*"
        blocks.append(rf"\{level}{{{number}{inline(section.title)}}}")
        for block in section.blocks:
            blocks += _block(block)
    blocks.append(r"\end{document}")
    return "\n\n".join(blocks) + "\n"


def words(text: str) -> str:
    """Any text as LaTeX words."""
    return escape(clean(text))


def inline(text: Inline) -> str:
    """Words and mathematics in a line."""
    return "".join(words(x) if isinstance(x, str) else f"${latex(x)}$" for x in text)


def _block(block: Block) -> Iterator[str]:
    match block:
        case Heading(text):
            yield rf"\subsubsection*{{{inline(text)}}}"
        case Paragraph(text, role):
            yield rf"\textit{{Why:}} {inline(text)}" if role == "why" else inline(text)
        case Display():
            yield _display(block)
        case Boxed(displays):
            yield _boxed(displays)
        case Table():
            yield _table(block)
        case Verdicts(verdicts):
            items = [
                rf"\item[{words('✓' if v.holds else '✗')}] {inline(v.what)}"
                + (f" ({words(v.figure)})" if v.figure else "")
                for v in verdicts
            ]
            yield "\n".join((r"\begin{itemize}\setlength{\itemsep}{0pt}", *items, r"\end{itemize}"))
        case Details(summary, blocks):
            yield inline(summary)
            for inner in blocks:
                yield from _block(inner)


def _display(block: Display) -> str:
    lines = rows(block.sides)
    note = rf" \qquad\text{{({inline(block.note)})}}" if block.note else ""
    if len(lines) > MOST_ALIGNED:
        return "\\begin{align*}\n" + " \\\\\n".join(lines) + note + "\n\\end{align*}"
    return f"\\[\n{displayed(block.sides)}{note}\n\\]"


def _boxed(displays: tuple[Display, ...]) -> str:
    lines = boxed([(d.sides, d.number) for d in displays])
    body = " \\\\\n".join(lines)
    if len(lines) > MOST_BOXED:
        return f"\\noindent\\hrulefill\n\\begin{{align*}}\n{body}\n\\end{{align*}}\n\\noindent\\hrulefill"
    return f"\\[\n\\boxed{{\\begin{{aligned}}\n{body}\n\\end{{aligned}}}}\n\\]"


def _table(table: Table) -> str:
    """A table that may run over pages; the columns share the width by what is longest in them."""
    lengths = [
        max((_length(row[j]) for row in (table.header, *table.rows)), default=1) for j in range(len(table.header))
    ]
    capped = [min(max(n, 6), 60) for n in lengths]
    total = sum(capped)
    scale = min(1.0, total / 88)
    spec = "".join(rf"p{{{0.93 * scale * n / total:.3f}\linewidth}}" for n in capped)
    head = " & ".join(rf"\textbf{{{inline(h)}}}" for h in table.header) + r" \\ \hline \endhead"
    body = [" & ".join(inline(c) for c in row) + r" \\" for row in table.rows]
    ragged = r"\raggedright\arraybackslash"
    spec = spec.replace("p{", rf">{{{ragged}}}p{{")
    return "\n".join((rf"\begin{{longtable}}[l]{{{spec}}}", head, *body, r"\end{longtable}"))


def _length(cell: Inline) -> int:
    return sum(columns(x if isinstance(x, str) else unicode(x)) for x in cell)
