"""Writes a derivation as one HTML page that works offline, with MathML and without scripts or external files.

A term of the final equations shows the elements that it came from when the pointer is over it, or when it has the
focus. Every step can be folded; in print all steps are open. A formula that is wider than the screen can be scrolled.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from html import escape as _escape
from importlib.resources import files

from lagrangian.page.formula import TermKind
from lagrangian.write.document import (
    Block,
    Boxed,
    CheckLines,
    Details,
    Display,
    Document,
    HeadingBlock,
    Inline,
    Paragraph,
    Section,
    TableBlock,
)
from lagrangian.write.expression_tree import (
    LOOSE,
    Addition,
    Glyph,
    Grid,
    Math,
    Number,
    Tagged,
    fenced,
    is_tall,
    tokens,
)
from lagrangian.write.lines import lines, set_columns
from lagrangian.write.mathml import displayed, row, wide
from lagrangian.write.text import clean
from lagrangian.write.text import display as text_lines
from lagrangian.write.themes import DARK_NOTEBOOK, LIGHT_NOTEBOOK, themed_scenes

WIDTH = 96
"""The width of the page in columns of Unicode text."""

UNBROKEN_COLUMNS = 24
"""A formula of up to this many columns within a text is kept in one piece."""

NARROW_COLUMNS = 12
"""A term of a displayed formula may be broken after this many columns, if a line of the screen cannot hold it."""

SHORT_COLUMNS = 36
"""A term of up to this many columns breaks between its factors rather than in a sum in parentheses."""

BREAKS = ((1, 2), (LOOSE,), (3, LOOSE + 1), (4, LOOSE + 2), (5, LOOSE + 3))
"""The levels of breaks within a term, the best first: in its outer sums, between its factors, then further inside."""

LONGEST_PIECE = 26
"""A piece of a formula with more characters may be wider than a telephone's screen."""

EQUALS = '<span class="sign"><math><mo>=</mo></math></span>&#xa0;'

STRIPPED = (
    "This notebook is not trusted, so that powers, fractions and pictures are missing here. Run its cells, or choose "
    "Trust Notebook in JupyterLab's command palette."
)
"""What a view says where its style, and so its mathematics, was removed."""

KINDS: Mapping[TermKind, str] = {
    "inertia": "inertia: with an acceleration",
    "velocity": "velocity: products of rates",
    "damping": "damping",
    "stiffness": "stiffness",
    "gravity": "gravity",
    "input": "input: from outside",
    "other": "other",
    "constraint": "constraint: with a multiplier λ",
}
"""The kinds of terms, as named in the legend."""


def page(document: Document, subject: str) -> str:
    """Return a document as a self-contained HTML page; its title contains ``subject`` and the title of the document."""
    title = escape(document.title)
    body = "\n".join(section_html(section, brief=document.brief) for section in document.sections)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta name="color-scheme" content="light dark">\n'
        f"<title>{title}: {escape(subject)}</title>\n<style>\n{style_sheet()}{_pointing(document)}</style>\n"
        "</head>\n<body>\n"
        f'<main class="{_kind(document)}">\n<header><h1>{title}</h1></header>\n'
        f"{_picture(document)}{_contents(document)}{body}\n</main>\n</body>\n</html>\n"
    )


def _kind(document: Document) -> str:
    return ("brief" if document.brief else "whole") + (" named" if document.named else "")


def fragment(document: Document) -> str:
    """Return a document as a piece of HTML that contains its own style."""
    body = "\n".join(section_html(section, brief=document.brief, anchors=False) for section in document.sections)
    rules = style_sheet() + _pointing(document)
    nested = rules.replace(":root", "&").replace("body {", "& {")  # restricted to this piece
    themes = f"{_themes()}}}\n" + ("" if document.picture is None else themed_scenes())
    style = f"<style>\n.lagrangian {{\n{nested}{themes}</style>"
    said = f'<p class="stripped">{STRIPPED}</p>\n'
    head = f'<div class="lagrangian" lang="en">{style}\n{said}<div class="{"brief" if document.brief else "whole"}">'
    return f"{head}\n<h3>{escape(document.title)}</h3>\n{_picture(document)}{body}\n</div></div>"


def _themes() -> str:
    """Rules by which a piece follows the theme of its notebook, where that differs from the system's: those of
    JupyterLab, VS Code, Colab and marimo."""
    light, _, rest = style_sheet().partition(":root {")[2].partition("}")
    dark = rest.partition(":root {")[2].partition("}")[0]
    return f"{LIGHT_NOTEBOOK} & {{{light}color-scheme: light; }}\n{DARK_NOTEBOOK} & {{{dark}color-scheme: dark; }}\n"


def pieces(document: Document) -> list[dict[str, str]]:
    """Return the sections of a document as pieces of HTML without style, each with the name of its place."""
    return [
        {"anchor": section.anchor, "html": section_html(section, brief=document.brief, anchors=False)}
        for section in document.sections
    ]


def style_sheet() -> str:
    """Return the style sheet of pages."""
    return files("lagrangian.write").joinpath("page.css").read_text(encoding="utf-8")


def _picture(document: Document) -> str:
    """The picture at the head, in a frame that keeps its place while the picture follows the pointer."""
    if document.picture is None or not document.picture.svg:
        return ""
    w, h = document.picture.size
    frame = f"width: {w:.0f}px; aspect-ratio: {w:.0f}/{h:.0f}"
    return f'<figure class="schematic" style="{frame}">{document.picture.svg}</figure>\n'


def _pointing(document: Document) -> str:
    """The style rules by which a term that is pointed at fades the parts of the picture that it did not come from.

    A part that is pointed at marks its terms. There is one rule for each set of elements that some term came from.
    """
    if document.picture is None or not document.picture.svg:
        return ""
    boxes = [b for s in document.sections for b in s.blocks if isinstance(b, Boxed)]
    sides = [side for box in boxes for formula in box.displays for side in formula.sides]
    origins = dict.fromkeys(term.names for side in sides for term in _tagged(side))
    rules: list[str] = []
    for names in origins:
        others = "".join(f':not([data-element~="{_css(data_element((name,)))}"])' for name in names)
        here = f':is(.whole, .brief):has(.term[data-element="{_css(data_element(names))}"]:is(:hover, :focus))'
        rules.append(f"{here} .glyph[data-element]:not(.role-coordinate){others} {{ opacity: .15; }}")
    for name in dict.fromkeys(name for names in origins for name in names):
        one = f'[data-element~="{_css(data_element((name,)))}"]'
        rules.append(f":is(.whole, .brief):has(.glyph{one}:hover) .term{one} {{ background: var(--line); }}")
    return "".join(rule + "\n" for rule in rules)


def _tagged(side: Math) -> Iterator[Tagged]:
    pairs = side.terms if isinstance(side, Addition) else ((False, side),)
    yield from (term for _, term in pairs if isinstance(term, Tagged) and term.names)


def _css(text: str) -> str:
    """Any text within a string of a style sheet: everything but plain letters and digits by its number."""
    return "".join(c if c.isascii() and c.isalnum() else f"\\{ord(c):x} " for c in text)


def data_element(elements: Iterable[str]) -> str:
    """Return names of elements separated by spaces; white space within a name is a no-break space."""
    return " ".join("\u00a0".join(name.split()) for name in elements)


def escape(words: str) -> str:
    """Escape any text for HTML."""
    return _escape(clean(words), quote=True)


def inline(text: Inline) -> str:
    """Words and mathematics within a line."""
    return "".join(escape(x) if isinstance(x, str) else _flowing(x) for x in text)


def _flowing(formula: Math) -> str:
    """A formula in a line of words; a long formula in pieces between which the line can break."""
    pieces = _pieces(tokens(formula), UNBROKEN_COLUMNS, (0, 1))
    return "<wbr>".join(f"<math>{row(piece)}</math>" for piece in pieces)


def _pieces(listed: Iterable[Glyph], least: int, levels: tuple[int, ...]) -> list[list[Glyph]]:
    """Tokens in pieces of more than ``least`` columns, divided before tokens of these levels."""
    pieces: list[list[Glyph]] = [[]]
    for token in listed:
        if token.level in levels and sum(set_columns(t) for t in pieces[-1]) > least:
            pieces.append([])
        pieces[-1].append(token)
    return pieces


def _breaking(sign: str, term: Math) -> str:
    """A term with its sign, which breaks only where a line of the screen cannot hold it, at the best place there is."""
    listed = list(tokens(term))
    if is_tall(term):
        return wide(sign, term, WIDTH - 12) or f'<math displaystyle="true">{sign}{row(listed)}</math>'
    sums, factors = BREAKS[:2]
    short = sum(set_columns(t) for t in listed) <= SHORT_COLUMNS
    return _parts(sign, listed, (factors, sums, *BREAKS[2:]) if short else BREAKS)


def _parts(sign: str, listed: list[Glyph], breaks: tuple[tuple[int, ...], ...]) -> str:
    """Tokens in parts that a browser divides further only where they are too long for a line of their own."""
    for k, levels in enumerate(breaks):
        pieces = _pieces(listed, NARROW_COLUMNS, levels)
        if len(pieces) > 1:
            made = (_parts("" if i else sign, piece, breaks[k + 1 :]) for i, piece in enumerate(pieces))
            return "".join(f'<span class="span">{part}</span>' for part in made)
    return f'<math displaystyle="true">{sign}{row(listed)}</math>'


def _contents(document: Document) -> str:
    if document.brief:
        return ""
    listed = [s for s in document.sections if not s.minor]
    items = "".join(f'<li><a href="#{s.anchor}">{_number(s)}{inline(s.title)}</a></li>' for s in listed)
    return f'<nav aria-label="Contents"><ol>{items}</ol></nav>\n'


def _number(section: Section) -> str:
    return f'<span class="number">{section.number}</span> ' if section.number is not None else ""


def section_html(section: Section, *, brief: bool = False, anchors: bool = True) -> str:
    """Return a section; a step can be folded."""
    identity = f' id="{section.anchor}"' if anchors else ""
    identity += ' class="minor"' if section.minor else ""
    inner = blocks_html(section, anchors=anchors)
    title = f"<h2>{_number(section)}{inline(section.title)}</h2>"
    if section.number is None or brief:
        return f"<section{identity}>\n{title}\n{inner}\n</section>"
    step = f'<details class="step" open><summary>{title}</summary>\n{inner}\n</details>'
    return f"<section{identity}>\n{step}\n</section>"


def blocks_html(section: Section, *, anchors: bool = True) -> str:
    """Return what a section contains, without its title."""
    return "\n".join(line for block in section.blocks for line in _block(block, anchors))


def _block(block: Block, anchors: bool) -> Iterator[str]:
    match block:
        case HeadingBlock(text):
            yield f"<h3>{inline(text)}</h3>"
        case Paragraph(text, role, link):
            if link and anchors:
                yield f'<p class="{role}"><a href="#{link}">{inline(text)}</a></p>'
                return
            lead = '<span class="lead">Why:</span> ' if role == "why" else ""
            said = inline(text)
            yield f"<p{f' class={role}' if role else ''}{_reached(said, 'Sentence')}>{lead}{said}</p>"
        case Display():
            yield _display(block, anchors)
        case Boxed(displays):
            yield from _boxed(displays, anchors)
        case TableBlock():
            yield _table(block)
        case CheckLines(verdicts):
            items = "".join(
                f'<li class="{v.standing.replace(" ", "-")}"><span aria-hidden="true">{v.mark}</span> '
                f'<span class="unseen">{v.standing}: </span>{inline(v.what)}'
                + (f' <span class="figure">({escape(v.figure)})</span>' if v.figure else "")
                + "</li>"
                for v in verdicts
            )
            yield f'<ul class="checks">{items}</ul>'
        case Details(summary, blocks):
            inner = _preformatted(blocks) if block.vast else "".join(x for b in blocks for x in _block(b, False))
            yield f"<details><summary>{inline(summary)}</summary>{inner}</details>"


def _preformatted(blocks: tuple[Block, ...]) -> str:
    """Formulas as lines of preformatted text, because a browser takes long for mathematics of this length."""
    shown = [line for block in blocks if isinstance(block, Display) for line in text_lines(block, WIDTH)]
    return f'<pre tabindex="0" role="group" aria-label="Long formula">{escape_lines(shown)}</pre>'


def escape_lines(listed: list[str]) -> str:
    """Escape lines of text for HTML."""
    return "\n".join(escape(line) for line in listed)


def _display(block: Display, anchors: bool) -> str:
    identity = f' id="{block.anchor}"' if anchors and block.anchor else ""
    note = f' <span class="note">{inline(block.note)}</span>' if block.note else ""
    chain = _chain(block.sides)
    return f'<div class="formula"{identity}{_reached(chain, "Formula")}>{chain}{note}</div>'


_PIECE, _TAGS = re.compile(r"<math.*?</math>", re.DOTALL), re.compile(r"<[^>]*>")
_UNSEEN = re.compile(r"[\s\u2009\u2061-\u2063]")


def _plain(html: str) -> str:
    """The text within elements."""
    return _TAGS.sub("", html)


def _reached(inner: str, name: str) -> str:
    """Attributes by which a keyboard reaches what slides on a narrow screen: a formula that cannot break."""
    wide = any(len(_UNSEEN.sub("", _plain(piece))) > LONGEST_PIECE for piece in _PIECE.findall(inner))
    return f' tabindex="0" role="group" aria-label="{name}"' if wide else ""


def _chain(sides: tuple[Math, ...]) -> str:
    """A formula term by term, so that its lines break at the width of the screen; a matrix stays in one piece."""
    if any(isinstance(side, Grid) for side in sides):
        return displayed(sides, WIDTH)
    laid = [_terms(side, []) for side in sides]
    if len(lines(sides, WIDTH)) == 1 or len(sides) < 3:
        return f'<div class="terms">{_kept(laid, EQUALS)}</div>'
    blocks = [_kept(laid[:2], EQUALS), *(EQUALS + side for side in laid[2:])]
    return f'<div>{"".join(f"""<div class="terms">{x}</div>""" for x in blocks)}</div>'


def _boxed(displays: tuple[Display, ...], anchors: bool) -> Iterator[str]:
    """The results, term by term; each term shows the elements that it came from."""
    equations: list[str] = []
    kinds: list[str] = []
    for formula in displays:
        sides = [_terms(side, kinds) for side in formula.sides]
        identity = f' id="{formula.anchor}"' if anchors else ""
        number = f'<span class="tag">({formula.number})</span>' if len(displays) > 1 else ""
        equations.append(
            f'<div class="equation"{identity}><div class="terms">{_kept(sides, EQUALS)}</div>{number}</div>'
        )
    joined = "".join(equations)
    reached = ' tabindex="0"' if _reached(joined, "") and "tabindex" not in joined else ""
    yield f'<div class="result" role="group" aria-label="Equations of motion"{reached}>{joined}</div>'
    if kinds:
        shown = "".join(
            f'<li><span class="swatch {_colour(k)}"></span>{escape(KINDS[k])}</li>' for k in KINDS if k in kinds
        )
        yield f'<p class="hint">Point at a term to see the elements it came from.</p><ul class="legend">{shown}</ul>'


def _kept(sides: list[str], equals: str) -> str:
    """The sides with equals signs; a short right-hand side stays on the line of its sign."""
    text = sides[0]
    for side in sides[1:]:
        alone = side.count("<math") == 1
        text += f'<span class="kept">{equals}{side.strip()}</span> ' if alone else equals + side
    return text


def _colour(kind: str) -> str:
    """The classes of a kind: terms of constraints have the colour of what is no other kind."""
    return "other constraint" if kind == "constraint" else kind


def _terms(side: Math, kinds: list[str]) -> str:
    pairs = side.terms if isinstance(side, Addition) else ((False, side),)
    out: list[str] = []
    for i, (minus, term) in enumerate(pairs or ((False, Number("0")),)):
        form = "infix" if i else "prefix"
        sign = f'<mo form="{form}">{"−" if minus else "+"}</mo>' if i or minus else ""
        inner = _breaking(sign, fenced(term, Addition) if minus else term)
        if isinstance(term, Tagged) and term.elements:
            kind = term.kind if term.kind in KINDS else "other"
            if kind not in kinds:
                kinds.append(kind)
            origin, colour = escape(", ".join(term.elements)), _colour(kind)
            said = f'tabindex="0" role="group" aria-label="from {origin}" data-from="{origin}"'
            if term.names:
                said += f' data-element="{escape(data_element(term.names))}"'
            out.append(f'<span class="term {colour}" {said}>{inner}</span>')
        else:
            out.append(f'<span class="sign">{inner}</span>')
    return " ".join(out) + " "


def _table(table: TableBlock) -> str:
    head = "".join(f'<th scope="col">{inline(h)}</th>' for h in table.header)
    rows = "".join(
        "<tr>"
        + "".join(
            f'<th scope="row">{inline(c)}</th>' if j == 0 else f"<td>{inline(c)}</td>" for j, c in enumerate(row_)
        )
        + "</tr>"
        for row_ in table.rows
    )
    said = _plain(head.replace("</th>", ", ")).strip(" ,").replace('"', "&quot;")
    attributes = f'class="table" tabindex="0" role="group" aria-label="Table: {said}"'
    return f"<div {attributes}><table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>"
