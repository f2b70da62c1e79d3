"""Mathematics and words as LaTeX; names and words of users are escaped, never trusted."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable

from lagrangian.write.math import (
    GREEK,
    Apply,
    Cases,
    Fence,
    Grid,
    Letter,
    Mark,
    Math,
    Number,
    Power,
    Ratio,
    Root,
    Token,
    Word,
    bare,
    is_word,
    tokens,
)
from lagrangian.write.names import SPELLED

_COMMANDS = {
    "ℒ": r"\mathcal{L}",
    "ℱ": r"\mathcal{F}",
    "ℰ": r"\mathcal{E}",
    "𝒱": r"\mathcal{V}",
    "𝒬": r"\mathcal{Q}",
} | {
    "𝒲": r"\mathcal{W}",
    "omicron": "o",
    "lamda": r"\lambda",
    "Upsilon": r"\Upsilon",
}
_DOTS = ("", r"\dot", r"\ddot", r"\dddot")
_NUMBERS = {"π": r"\pi", "∞": r"\infty", "e": r"\mathrm{e}", "i": r"\mathrm{i}", "undefined": r"\text{undefined}"}
_RELATIONS = {"=": "=", "<": "<", ">": ">", "≤": r"\le", "≥": r"\ge", "≠": r"\ne"}
_MARKS = {"∂": r"\partial ", "d": "d", "δ": r"\delta "}
_KNOWN = {"sin", "cos", "tan", "sinh", "cosh", "tanh", "arcsin", "arccos", "arctan", "ln", "exp", "min", "max"}
_SPECIAL = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "$": r"\$",
    "&": r"\&",
    "%": r"\%",
    "#": r"\#",
    "_": r"\_",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': "''",
    "`": r"\textasciigrave{}",
    "'": "'",
}
_SYMBOLS = {
    "−": "-", "·": r"\cdot", "×": r"\times", "∂": r"\partial", "Σ": r"\Sigma", "→": r"\to", "≠": r"\ne", "≤": r"\le",
    "≥": r"\ge", "≈": r"\approx", "∞": r"\infty", "√": r"\surd", "°": r"^{\circ}", "½": r"\tfrac{1}{2}", "⇔": r"\Leftrightarrow",
    "⟨": r"\langle", "⟩": r"\rangle", "ℒ": r"\mathcal{L}", "∈": r"\in", "±": r"\pm", "⅓": r"\tfrac{1}{3}", "¼": r"\tfrac{1}{4}",
    "✓": r"\checkmark", "✗": r"\times",
}  # fmt: skip
_PLAIN = {
    "–": "--",
    "—": "---",
    "…": r"\ldots{}",
    "“": "``",
    "”": "''",
    "‘": "`",
    "’": "'",
    "\u00a0": "~",
    "\u202f": "~",
}
_COMMAND = re.compile(r"\\[A-Za-z]+\Z")
_MAPPED = re.compile(r"<(super|sub)> ([0-9A-Fa-f]+)\Z")


def latex(math: Math) -> str:
    """Return the formula as LaTeX mathematics."""
    return join(tokens(math))


def join(pieces: Iterable[Token]) -> str:
    """Return tokens as LaTeX."""
    listed = list(pieces)
    text = ""
    for i, piece in enumerate(listed):
        made = token(piece)
        if piece.role == "gap" and any(is_word(p.math) for p in listed[max(i - 1, 0) : i + 2]):
            made = r"\, "
        if _COMMAND.search(text) and made[:1].isalpha():  # a command's name must not run into a letter
            made = " " + made
        text += made
    return text.strip()


def token(piece: Token) -> str:
    """Return one token as LaTeX."""
    match piece.role:
        case "leaf":
            return _leaf(piece.math)  # type: ignore[arg-type]
        case "exponent":
            return f"^{{{latex(piece.math)}}}"  # type: ignore[arg-type]
        case "sign":
            return ", " if piece.text == "," else f" {_RELATIONS[piece.text]} "
        case "open":
            bar = r"\lvert " if piece.text == "|" else piece.text
            return (r"\Bigl" if piece.tall else "") + bar
        case "close":
            bar = r"\rvert" if piece.text == "|" else piece.text
            return (r"\Bigr" if piece.tall else "") + bar
        case role:
            return {"plus": " + ", "minus": " - ", "negative": "-", "gap": " "}[role]


def _leaf(math: Math) -> str:
    match math:
        case Letter():
            return _letter(math)
        case Number(text):
            return _NUMBERS.get(text, text)
        case Word(text):
            if text == "·":
                return r"\cdot"
            return (
                text if text in ("d", "t", "dt", ",") else "\\partial" if text == "∂" else rf"\text{{{escape(text)}}}"
            )
        case Ratio(Number(over), Number(under)):
            return rf"\tfrac{{{over}}}{{{under}}}"
        case Ratio(over, under):
            return rf"\frac{{{latex(over)}}}{{{latex(under)}}}"
        case Power(base, exponent):
            return f"{_grouped(base)}^{{{latex(exponent)}}}"
        case Root(of):
            return rf"\sqrt{{{latex(of)}}}"
        case Apply():
            return _apply(math)
        case Mark(sign, of):
            inner = latex(of)
            return _MARKS[sign] + (inner if isinstance(of, (Letter, Word, Power, Fence)) else f"({inner})")
        case Grid(rows):
            body = r" \\ ".join(" & ".join(latex(x) for x in row) for row in rows)
            return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"
        case Cases(branches):
            lines = [
                rf"{latex(v)} & " + (rf"\text{{if }} {latex(c)}" if c is not None else r"\text{otherwise}")
                for v, c in branches
            ]
            return r"\begin{cases} " + r" \\ ".join(lines) + r" \end{cases}"
    raise TypeError(f"not a leaf: {math!r}")


def _grouped(base: Math) -> str:
    """The base of a power; a letter keeps its own subscript beside the exponent."""
    inner = latex(base)
    return f"{{{inner}}}" if isinstance(base, Letter) and base.star else inner


def _apply(math: Apply) -> str:
    name = rf"\{math.name}" if math.name in _KNOWN else rf"\operatorname{{{escape(math.name)}}}"
    if math.power is not None:
        name += f"^{{{latex(math.power)}}}"
    if bare(math):
        return f"{name} {latex(math.args[0])}"
    if len(math.args) == 1 and isinstance(math.args[0], Fence):
        return name + latex(math.args[0])
    inner = ", ".join(latex(a) for a in math.args)
    tall = any(r"\frac" in latex(a) for a in math.args)
    return name + (rf"\Bigl({inner}\Bigr)" if tall else f"({inner})")


def _letter(math: Letter) -> str:
    if math.literal:
        base = rf"\mathrm{{{_upright(math.base)}}}" if math.base.isascii() else rf"\text{{{escape(math.base)}}}"
    else:
        base = _base(math.base)
        if math.bold:
            base = (
                rf"\mathbf{{{base}}}"
                if base.isalpha() and base.isascii() and base.isupper()
                else rf"\boldsymbol{{{base}}}"
            )
    if math.dots:
        base = rf"{_DOTS[math.dots]}{{{base}}}"
    sub = r",".join(_sub(part) for part in math.sub)
    return base + ("^{*}" if math.star else "") + (f"_{{{sub}}}" if sub else "")


def _base(base: str) -> str:
    if base in _COMMANDS:
        return _COMMANDS[base]
    if base in GREEK:
        return f"\\{base}"
    if len(base) == 1 and base.isascii() and base.isalpha():
        return base
    return rf"\mathrm{{{_upright(base)}}}" if base.isascii() else rf"\text{{{escape(base)}}}"


def _sub(part: str) -> str:
    if part in GREEK or (part.isascii() and (len(part) == 1 or part[0].isdigit()) and part.isalnum()):
        return _base(part) if part in GREEK else part
    if part.isascii() and part.isalnum():
        return rf"\mathrm{{{part}}}"
    return rf"\text{{{escape(part)}}}"


def _upright(name: str) -> str:
    return name.replace("_", r"\_")


# -- words ----------------------------------------------------------------------------------------------------------


def escape(words: str) -> str:
    """Return any text as LaTeX that prints it: special characters escaped, mathematical ones as mathematics.

    A letter that pdfLaTeX has no sign for is left to ``\\glyph``, which the document defines for every engine.
    """
    out: list[str] = []
    letters = unicodedata.normalize("NFC", words)
    for i, c in enumerate(letters):
        if c in ("\u0307", "\u0308"):
            continue
        following = letters[i + 1] if i + 1 < len(letters) else ""
        if following in ("\u0307", "\u0308"):
            dot = r"\dot" if following == "\u0307" else r"\ddot"
            out.append(rf"\ensuremath{{{dot}{{{_mathematical(c)}}}}}")
        else:
            out.append(_character(c))
    return "".join(out)


def _mathematical(c: str) -> str:
    return _base(SPELLED.get(c, c)) if c in SPELLED or (c.isascii() and c.isalpha()) else rf"\text{{{_character(c)}}}"


def _character(c: str) -> str:
    if c in _SPECIAL:
        return _SPECIAL[c]
    if c in _PLAIN:
        return _PLAIN[c]
    if c in _SYMBOLS:
        return rf"\ensuremath{{{_SYMBOLS[c]}}}"
    if c in SPELLED:
        return rf"\ensuremath{{{_base(SPELLED[c])}}}"
    if c in "\n\r\t":
        return " "
    if c.isascii():
        return c if c.isprintable() else ""
    mapped = _MAPPED.match(unicodedata.decomposition(c))
    if mapped:
        inner = _character(chr(int(mapped.group(2), 16)))
        return rf"\textsuperscript{{{inner}}}" if mapped.group(1) == "super" else rf"\textsubscript{{{inner}}}"
    parts = unicodedata.normalize("NFD", c)
    if len(parts) == 2 and parts[1] in ("\u0307", "\u0308") and ord(c) > 0x17F:
        return rf"\ensuremath{{{_DOTS[1 if parts[1] == chr(0x307) else 2]}{{{_mathematical(parts[0])}}}}}"
    if 0xA1 <= ord(c) <= 0x17F and c.isalpha() and c not in "ĸŉſĦħŦŧĿŀªº":
        return c
    return rf"\glyph{{{ord(c):04X}}}"
