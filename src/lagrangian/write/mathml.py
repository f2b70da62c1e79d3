"""Writes mathematics as MathML Core, which browsers show without scripts; all text in it is escaped."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from lagrangian.write.expression_tree import (
    GREEK,
    Apply,
    Cases,
    Fence,
    Glyph,
    Grid,
    Letter,
    Mark,
    Math,
    Number,
    Numeral,
    Power,
    Quotient,
    Radical,
    Word,
    bare,
    in_parentheses,
    is_tall,
    numbered,
    tokens,
)
from lagrangian.write.lines import Line, grid_columns, lines
from lagrangian.write.names import phrases
from lagrangian.write.unicode_math import bold

NARROW = 30
"""A matrix of more columns of letters is wider than the screen of a telephone."""

_DOTS = ("", "˙", "¨", "⃛")
_GAP = '<mspace width="0.17em"></mspace>'
_INDENT = '<mspace width="2em"></mspace>'
_IF = "<mtext>if&#xa0;</mtext>"
_APPLY = "<mo>&#x2061;</mo>"


def mathml(math: Math) -> str:
    """Return a formula as a ``math`` element."""
    return f"<math>{row(tokens(math))}</math>"


def displayed(sides: tuple[Math, ...], width: int) -> str:
    """Return a formula for display, broken into aligned lines if it is longer than ``width`` columns."""
    cut = lines(sides, width)
    if len(cut) == 1:
        return f'<math display="block">{row(cut[0].right)}</math>'
    body = "".join(_line(line) for line in cut)
    return f'<math display="block"><mtable displaystyle="true">{body}</mtable></math>'


def wide(sign: str, term: Math, width: int) -> str:
    """Return the lines of a term that is longer than ``width`` columns, after its sign; nothing if it fits."""
    cut = lines((term,), width)
    if len(cut) == 1:
        return ""
    body = "".join(
        f"<mtr><mtd>{'' if i else sign}</mtd><mtd>{_INDENT * line.steps}{row(line.right)}</mtd></mtr>"
        for i, line in enumerate(cut)
    )
    return f'<math displaystyle="true"><mtable displaystyle="true">{body}</mtable></math>'


def _line(line: Line) -> str:
    equals = "<mo>=</mo>" if line.equals else ""
    right = f"<mtd>{_INDENT * line.steps}{equals}{row(line.right)}</mtd>"
    return f"<mtr><mtd>{row(line.left)}</mtd>{right}</mtr>"


def row(pieces: Iterable[Glyph]) -> str:
    """Return tokens as one row."""
    listed = list(pieces)
    out: list[str] = []
    for i, piece in enumerate(listed):
        following = listed[i + 1] if i + 1 < len(listed) else None
        if piece.role == "exponent":
            continue
        made = _token(piece, first=i == 0)
        if following is not None and following.role == "exponent":
            made = f"<msup>{made}<mrow>{_inner(following.math)}</mrow></msup>"  # type: ignore[arg-type]
        out.append(made)
    return f"<mrow>{''.join(out)}</mrow>"


def _token(piece: Glyph, *, first: bool) -> str:
    match piece.role:
        case "leaf":
            return _leaf(piece.math)  # type: ignore[arg-type]
        case "sign":
            return f"<mo>{escape(piece.text)}</mo>"
        case "open" | "close":
            side = "prefix" if piece.role == "open" else "postfix"
            stretchy = "true" if piece.tall else "false"
            return f'<mo form="{side}" stretchy="{stretchy}">{escape(piece.text)}</mo>'
        case "gap":
            return "" if first else _GAP
        case "negative":
            return '<mo form="prefix">−</mo>'
        case role:
            sign = "+" if role == "plus" else "−"
            return f'<mo form="infix">{sign}</mo>'


def _inner(math: Math) -> str:
    return row(tokens(math))


def _leaf(math: Math) -> str:
    match math:
        case Letter():
            return _letter(math)
        case Number(text):
            return f"<mn>{escape(text)}</mn>"
        case Word("d" | "t" | "dt" as text):
            return "".join(f"<mi>{c}</mi>" for c in text)
        case Word("·" | "∂" | "√" | "δ" as text):
            return f"<mo>{text}</mo>"
        case Word(text):
            return f"<mtext>{escape(text)}</mtext>"
        case Quotient(Number(), Number()):
            return f'<mfrac displaystyle="false">{_inner(math.over)}{_inner(math.under)}</mfrac>'
        case Quotient(over, under):
            return f"<mfrac>{_inner(over)}{_inner(under)}</mfrac>"
        case Power(base, exponent):
            return _power(base, exponent)
        case Radical(of):
            return f"<msqrt>{_inner(of)}</msqrt>"
        case Apply():
            return _apply(math)
        case Numeral(of, args):
            inner = '<mo separator="true">,</mo>'.join(_inner(a) for a in args)
            fences = [f'<mo form="{form}" stretchy="false">' for form in ("prefix", "postfix")]
            return f"<mrow>{_inner(of)}{_APPLY}{fences[0]}(</mo>{inner}{fences[1]})</mo></mrow>"
        case Mark(sign, of):
            inner = _inner(of if isinstance(of, (Letter, Word, Power, Fence)) else Fence(of))
            return f'<mrow><mo form="prefix" lspace="0" rspace="0">{sign}</mo>{inner}</mrow>'
        case Grid(rows):
            return f"<mrow><mo>[</mo>{_table(rows, grid_columns(math) > NARROW)}<mo>]</mo></mrow>"
        case Cases(branches):
            shown = [(v, Word("otherwise") if c is None else c) for v, c in branches]
            body = "".join(
                f"<mtr><mtd>{_inner(v)}</mtd><mtd>{'' if isinstance(c, Word) else _IF}{_inner(c)}</mtd></mtr>"
                for v, c in shown
            )
            return f'<mrow><mo form="prefix">{{</mo><mtable>{body}</mtable></mrow>'
    raise TypeError(f"not a leaf: {math!r}")


def _table(rows: tuple[tuple[Math, ...], ...], wide: bool) -> str:
    cells = "".join("<mtr>" + "".join(f"<mtd>{_inner(x)}</mtd>" for x in line) + "</mtr>" for line in rows)
    return f'<mtable class="matrix{" wide" if wide else ""}">{cells}</mtable>'


def _power(base: Math, exponent: Math) -> str:
    raised = _inner(exponent)
    if isinstance(base, Letter) and base.sub and not base.mark and not base.primes:
        return f"<msubsup>{_base(base)}{_sub(base)}{raised}</msubsup>"
    return f"<msup>{_inner(base)}{raised}</msup>"


def _apply(math: Apply) -> str:
    name = f"<mi>{escape(math.name)}</mi>"
    if math.power is not None:
        name = f"<msup>{name}{_inner(math.power)}</msup>"
    if bare(math):
        return f"<mrow>{name}{_APPLY}{_GAP}{_inner(math.args[0])}</mrow>"
    if len(math.args) == 1 and in_parentheses(math.args[0]):
        return f"<mrow>{name}{_APPLY}{_inner(math.args[0])}</mrow>"
    stretchy = "true" if any(is_tall(a) for a in math.args) else "false"
    inner = '<mo separator="true">,</mo>'.join(_inner(a) for a in math.args)
    fences = [f'<mo form="{form}" stretchy="{stretchy}">' for form in ("prefix", "postfix")]
    return f"<mrow>{name}{_APPLY}{fences[0]}(</mo>{inner}{fences[1]})</mo></mrow>"


def _letter(math: Letter) -> str:
    base = _base(math)
    sub = _sub(math) if math.sub else ""
    if math.primes:  # they are raised as they are
        primes = f'<mo form="postfix" lspace="0" rspace="0">{math.primes}</mo>'
        return f"<mrow>{f'<msub>{base}{sub}</msub>' if sub else base}{primes}</mrow>"
    if sub and math.mark:
        return f"<msubsup>{base}{sub}<mo>{math.mark}</mo></msubsup>"
    if sub:
        return f"<msub>{base}{sub}</msub>"
    return f"<msup>{base}<mo>{math.mark}</mo></msup>" if math.mark else base


def _base(math: Letter) -> str:
    text = math.base if math.literal else GREEK.get(math.base, math.base)
    upright = math.literal or math.bold or (len(text) == 1 and text in "ΓΔΘΛΞΠΣΥΦΨΩ")
    if math.bold:
        text = bold(text)
    variant = ' mathvariant="normal"' if upright else ""
    letter = f"<mi{variant}>{escape(text)}</mi>"
    return (
        f'<mover accent="true">{letter}<mo stretchy="false">{_DOTS[math.dots]}</mo></mover>'
        if math.dots and not math.primes
        else letter
    )


def _sub(math: Letter) -> str:
    parts = [_part(part) for part in phrases(math.sub)]
    comma = '<mo separator="true">,</mo>'
    return parts[0] if len(parts) == 1 else f"<mrow>{comma.join(parts)}</mrow>"


def _part(part: str) -> str:
    if part.isdigit():
        return f"<mn>{part}</mn>"
    if found := numbered(part):
        return f"<msub><mi>{GREEK.get(found[0], found[0])}</mi><mn>{found[1]}</mn></msub>"
    if part in GREEK or len(part) == 1:
        return f"<mi>{escape(GREEK.get(part, part))}</mi>"
    digits = len(part) - len(part.lstrip("0123456789"))
    if digits and len(part) - digits == 1:
        return f"<mrow><mn>{part[:digits]}</mn><mi>{escape(part[digits:])}</mi></mrow>"
    return f"<mtext>{escape(part)}</mtext>"
