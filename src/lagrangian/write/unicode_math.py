"""Writes mathematics as one line of Unicode text, and computes its width in a terminal."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from functools import lru_cache

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
    Times,
    Word,
    bare,
    in_parentheses,
    numbered,
    tokens,
)

_SUBSCRIPTS = dict(zip("0123456789", "₀₁₂₃₄₅₆₇₈₉", strict=True))
_RUNNING = {"i": "ᵢ", "j": "ⱼ"}
"""Running indices: ξᵢ is any of ξ₁, ξ₂, …"""
_SUPERSCRIPTS = dict(zip("0123456789−+nT", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺ⁿᵀ", strict=True))
_DOTS = ("", "\u0307", "\u0308", "\u20db")
_VULGAR = {(1, 2): "½", (1, 3): "⅓", (2, 3): "⅔", (1, 4): "¼", (3, 4): "¾", (1, 5): "⅕", (1, 6): "⅙", (1, 8): "⅛"}
_SIGNS = {"plus": " + ", "minus": " − ", "negative": "−", "gap": " "}


def columns(text: str) -> int:
    """The width of a text in a terminal: combining marks take no column, wide East Asian letters two."""
    return len(text) if text.isascii() else sum(map(_columns_of, text))


@lru_cache(maxsize=1_024)
def _columns_of(c: str) -> int:
    if unicodedata.combining(c) or unicodedata.category(c) in ("Mn", "Me", "Cf"):
        return 0
    return 2 if unicodedata.east_asian_width(c) in ("W", "F") else 1


def unicode(math: Math) -> str:
    """Return the formula as one line of Unicode text."""
    return join(tokens(math))


def join(pieces: Iterable[Glyph]) -> str:
    """Return tokens as one line; there is no space after a sign at its beginning."""
    text = "".join(token(p) for p in pieces)
    return unicodedata.normalize("NFC", text.removeprefix(" "))


def token(piece: Glyph) -> str:
    """Return one token as Unicode text."""
    match piece.role:
        case "leaf":
            return _leaf(piece.math)  # type: ignore[arg-type]
        case "exponent":
            return _raised(piece.math)  # type: ignore[arg-type]
        case "sign":
            return ", " if piece.text == "," else f" {piece.text} "
        case "open" | "close":
            return piece.text
        case role:
            return _SIGNS[role]


def _leaf(math: Math) -> str:
    match math:
        case Letter():
            return _letter(math)
        case Number(text) | Word(text):
            return text
        case Quotient(over, under):
            return _ratio(over, under)
        case Power(base, exponent):
            return unicode(base) + _raised(exponent)
        case Radical(of):
            inner = unicode(of)
            return f"√{inner}" if isinstance(of, (Letter, Number)) else f"√({inner})"
        case Apply():
            return _apply(math)
        case Numeral(of, args):
            return f"{unicode(of)}({', '.join(unicode(a) for a in args)})"
        case Mark(sign, of):
            return sign + (unicode(of) if isinstance(of, (Letter, Word, Power, Fence)) else f"({unicode(of)})")
        case Grid(rows):
            return "[" + "; ".join(", ".join(unicode(x) for x in row) for row in rows) + "]"
        case Cases(branches):
            shown = [unicode(v) + (f" if {unicode(c)}" if c is not None else " otherwise") for v, c in branches]
            return "{" + "; ".join(shown) + "}"
    raise TypeError(f"not a leaf: {math!r}")


def _letter(math: Letter) -> str:
    base = math.base if math.literal else GREEK.get(math.base, math.base)
    if math.bold and math.apart:
        base = bold(base)
    shown = base[:1] + _DOTS[0 if math.primes else math.dots] + base[1:]
    if math.literal:
        return shown + math.primes
    mark = "⁺" if math.plus else math.mark
    small = [subscript(part) for part in math.sub]
    if len(small) == 1 and small[0] is not None:
        return shown + small[0] + math.primes + mark
    if not math.sub:
        return shown + math.primes + mark
    shown += math.mark if math.star else ""
    parts = [_part(p) for p in math.sub]
    index = "_" + "_".join(parts) if all(p.isidentifier() or p.isalnum() for p in parts) else f"_({', '.join(parts)})"
    return shown + index + math.primes + ("⁺" if math.plus else "")


def _part(part: str) -> str:
    """A part of a subscript after an underscore: φ₁ for phi1."""
    if found := numbered(part):
        return GREEK.get(found[0], found[0]) + "".join(_SUBSCRIPTS[c] for c in found[1])
    return GREEK.get(part, part)


def bold(text: str) -> str:
    """Return the text in the bold mathematical letters of Unicode."""
    return "".join(_bold(c) for c in text)


def _bold(c: str) -> str:
    if "A" <= c <= "Z":
        return chr(0x1D400 + ord(c) - ord("A"))
    if "a" <= c <= "z":
        return chr(0x1D41A + ord(c) - ord("a"))
    if "α" <= c <= "ω":
        return chr(0x1D6C2 + ord(c) - ord("α"))
    if "Α" <= c <= "Ω":
        return chr(0x1D6A8 + ord(c) - ord("Α"))
    return c


def subscript(part: str) -> str | None:
    """Return a part in subscript characters if it is a number or a running index, otherwise None.

    Letters are never set as subscripts, even where Unicode could: it has an ₐ for L_a, but nothing for L_b beside it.
    """
    if part in _RUNNING:
        return _RUNNING[part]
    return "".join(_SUBSCRIPTS[c] for c in part) if part and all(c in _SUBSCRIPTS for c in part) else None


def _raised(exponent: Math) -> str:
    inner = unicode(exponent)
    if all(c in _SUPERSCRIPTS for c in inner):
        return "".join(_SUPERSCRIPTS[c] for c in inner)
    return f"^{inner}" if inner.isalnum() or (inner.startswith("(") and inner.count("(") == 1) else f"^({inner})"


def _ratio(over: Math, under: Math) -> str:
    if isinstance(over, Number) and isinstance(under, Number):
        if over.text.isdigit() and under.text.isdigit():
            pair = (int(over.text), int(under.text))
            return _VULGAR.get(pair, f"({over.text}/{under.text})")
        return f"({over.text}/{under.text})"
    above, below = unicode(_closed(over)), unicode(under)
    flat = (Letter, Number, Word, Mark, Power, Radical, Apply, Fence)
    top = above if isinstance(over, (*flat, Times)) else f"({above})"
    bottom = below if isinstance(under, (Letter, Number, Word, Mark, Power, Radical, Fence)) else f"({below})"
    return f"{top}/{bottom}"


def _closed(over: Math) -> Math:
    """A numerator whose last function has its argument in parentheses: cos(θ)/a is not cos(θ/a)."""
    if isinstance(over, Times):
        return Times((*over.factors[:-1], _closed(over.factors[-1])))
    return Apply(over.name, (Fence(over.args[0]),), over.power) if isinstance(over, Apply) and bare(over) else over


def _apply(math: Apply) -> str:
    name = math.name + (_raised(math.power) if math.power is not None else "")
    if bare(math):
        inner = unicode(math.args[0]).replace(" ", "")
        return f"{name}{'' if math.power is not None else ' '}{inner}"
    if len(math.args) == 1 and in_parentheses(math.args[0]):
        return name + unicode(math.args[0])
    return f"{name}({', '.join(unicode(a) for a in math.args)})"


__all__ = ["bold", "columns", "join", "subscript", "token", "unicode"]
