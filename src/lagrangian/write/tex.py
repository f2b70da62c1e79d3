"""Writes mathematics and words as LaTeX; names and words of users are escaped."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

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
    is_word,
    numbered,
    tokens,
)
from lagrangian.write.names import phrases
from lagrangian.write.tex_words import escape, web

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
_WORDS = {"d": "d", "t": "t", "dt": "dt", "·": r"\cdot", "∂": r"\partial", "δ": r"\delta", "√": r"\surd"}
_KNOWN = {"sin", "cos", "tan", "sinh", "cosh", "tanh", "arcsin", "arccos", "arctan", "ln", "exp", "min", "max"}
_NAME = re.compile(r"\w+\Z", re.ASCII)
_COMMAND = re.compile(r"\\[A-Za-z]+\Z")


class Tex:
    r"""Writes mathematics as LaTeX; ``words`` converts any text to the content of ``\text{…}``."""

    def __init__(self, words: Callable[[str], str]) -> None:
        self.words = words

    def latex(self, math: Math) -> str:
        """Return the formula as LaTeX mathematics."""
        return self.join(tokens(math))

    def join(self, pieces: Iterable[Glyph]) -> str:
        """Return tokens as LaTeX."""
        listed = list(pieces)
        text = ""
        for i, piece in enumerate(listed):
            made = self.token(piece)
            if piece.role == "gap" and any(is_word(p.math) for p in listed[max(i - 1, 0) : i + 2]):
                made = r"\, "
            if _COMMAND.search(text) and made[:1].isalpha():  # the name of a command must not run into a letter
                made = " " + made
            text += made
        return text.strip()

    def token(self, piece: Glyph) -> str:
        """Return one token as LaTeX."""
        match piece.role:
            case "leaf":
                return self._leaf(piece.math)  # type: ignore[arg-type]
            case "exponent":
                return f"^{{{self.latex(piece.math)}}}"  # type: ignore[arg-type]
            case "sign":
                return ", " if piece.text == "," else f" {_RELATIONS.get(piece.text, piece.text)} "
            case "open":
                bar = r"\lvert " if piece.text == "|" else piece.text
                return (r"\Bigl" if piece.tall else "") + bar
            case "close":
                bar = r"\rvert" if piece.text == "|" else piece.text
                return (r"\Bigr" if piece.tall else "") + bar
            case role:
                return {"plus": " + ", "minus": " - ", "negative": "-", "gap": " "}[role]

    def _leaf(self, math: Math) -> str:
        match math:
            case Letter():
                return self._letter(math)
            case Number(text):
                return _NUMBERS.get(text, text)
            case Word(text):
                if text in _WORDS or text in _KNOWN:
                    return _WORDS.get(text, rf"\{text}")
                return rf"\text{{{self.words(text)}}}" if text else ""
            case Quotient(Number(over), Number(under)):
                return rf"\tfrac{{{over}}}{{{under}}}"
            case Quotient(over, under):
                return rf"\frac{{{self.latex(over)}}}{{{self.latex(under)}}}"
            case Power(base, exponent):
                return f"{self._grouped(base)}^{{{self.latex(exponent)}}}"
            case Radical(of):
                return rf"\sqrt{{{self.latex(of)}}}"
            case Apply():
                return self._apply(math)
            case Numeral(of, args):
                return f"{self.latex(of)}({', '.join(self.latex(a) for a in args)})"
            case Mark(sign, of):
                inner = self.latex(of)
                return _MARKS[sign] + (inner if isinstance(of, (Letter, Word, Power, Fence)) else f"({inner})")
            case Grid(rows):
                body = r" \\ ".join(" & ".join(self.latex(x) for x in row) for row in rows)
                return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"
            case Cases(branches):
                lines = [
                    rf"{self.latex(v)} & "
                    + (rf"\text{{if }} {self.latex(c)}" if c is not None else r"\text{otherwise}")
                    for v, c in branches
                ]
                return r"\begin{cases} " + r" \\ ".join(lines) + r" \end{cases}"
        raise TypeError(f"not a leaf: {math!r}")

    def _grouped(self, base: Math) -> str:
        """The base of a power; a letter keeps its own subscript beside the exponent."""
        inner = self.latex(base)
        return f"{{{inner}}}" if isinstance(base, Letter) and base.mark else inner

    def _apply(self, math: Apply) -> str:
        name = rf"\{math.name}" if math.name in _KNOWN else rf"\operatorname{{{self.words(math.name)}}}"
        if math.power is not None:
            name += f"^{{{self.latex(math.power)}}}"
        if bare(math):
            return f"{name} {self.latex(math.args[0])}"
        if len(math.args) == 1 and in_parentheses(math.args[0]):
            return name + self.latex(math.args[0])
        inner = ", ".join(self.latex(a) for a in math.args)
        tall = any(r"\frac" in self.latex(a) for a in math.args)
        return name + (rf"\Bigl({inner}\Bigr)" if tall else f"({inner})")

    def _letter(self, math: Letter) -> str:
        if math.literal:
            base = self._upright(math.base)
        else:
            base = self.base(math.base)
            if math.bold:
                base = (
                    rf"\mathbf{{{base}}}"
                    if base.isalpha() and base.isascii() and base.isupper()
                    else rf"\boldsymbol{{{base}}}"
                )
        if math.dots and not math.primes:
            base = rf"{_DOTS[math.dots]}{{{base}}}"
        sub = r",".join(self._sub(part) for part in phrases(math.sub))
        return (
            base
            + (f"^{{{math.mark}}}" if math.mark else "")
            + (f"_{{{sub}}}" if sub else "")
            + ("'" * math.dots if math.primes else "")
        )

    def base(self, base: str) -> str:
        """A base letter or word."""
        if base in _COMMANDS:
            return _COMMANDS[base]
        if base in GREEK:
            return f"\\{base}"
        if len(base) == 1 and base.isascii() and base.isalpha():
            return base
        return self._upright(base)

    def _upright(self, name: str) -> str:
        """A name in upright letters; what is no plain name is written as words."""
        if _NAME.match(name):
            escaped = name.replace("_", r"\_")
            return rf"\mathrm{{{escaped}}}"
        return rf"\text{{{self.words(name)}}}"

    def _sub(self, part: str) -> str:
        if found := numbered(part):
            return f"{self.base(found[0])}_{{{found[1]}}}"
        if part in GREEK or (part.isascii() and (len(part) == 1 or part[0].isdigit()) and part.isalnum()):
            return self.base(part) if part in GREEK else part
        if part.isascii() and part.isalnum():
            return rf"\mathrm{{{part}}}"
        return rf"\text{{{self.words(part)}}}"


PAGE = Tex(escape)
"""LaTeX for LaTeX."""

WEB = Tex(web)
"""LaTeX for what browsers show: MathJax, KaTeX."""
