"""Writes any text as words in LaTeX: the words of users are printed, never executed."""

from __future__ import annotations

import re
import unicodedata

from lagrangian.write.names import SPELLED

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
    "≥": r"\ge", "≈": r"\approx", "∞": r"\infty", "√": r"\surd", "°": r"^{\circ}", "½": r"\tfrac{1}{2}",
    "⇔": r"\Leftrightarrow", "′": "'", "⅓": r"\tfrac{1}{3}", "¼": r"\tfrac{1}{4}",
    "⟨": r"\langle", "⟩": r"\rangle", "ℒ": r"\mathcal{L}", "∈": r"\in", "±": r"\pm",
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
_MAPPED = re.compile(r"<(super|sub)> ([0-9A-Fa-f]+)\Z")
_DOTS = ("", r"\dot", r"\ddot")
_WEB = {
    "\\": r"}\backslash\text{", "{": r"}\lbrace\text{", "}": r"}\rbrace\text{", "<": r"}\lt\text{", ">": r"}\gt\text{",
    "|": r"}\vert\text{", "^": r"}\wedge\text{", "~": r"}\sim\text{", "$": r"\$", "&": r"\&", "%": r"\%", "#": r"\#",
    "_": r"\_", "`": "‘", "*": "∗",
}  # fmt: skip


def web(words: str) -> str:
    r"""Return any text for ``\text{…}`` in a browser: letters as they are, special characters outside the text."""
    shown = unicodedata.normalize("NFC", words)
    return "".join(_WEB.get(c, c if c.isprintable() else " ") for c in shown)


def escape(words: str) -> str:
    r"""Return LaTeX that prints any text: special characters are escaped, mathematical ones set as mathematics.

    A letter that pdfLaTeX cannot print is passed to ``\glyph``, which the document defines for every engine.
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
    return _greek(c) if c in SPELLED or (c.isascii() and c.isalpha()) else rf"\text{{{_character(c)}}}"


def _character(c: str) -> str:
    if c in _SPECIAL:
        return _SPECIAL[c]
    if c in _PLAIN:
        return _PLAIN[c]
    if c in _SYMBOLS:
        return rf"\ensuremath{{{_SYMBOLS[c]}}}"
    if c in SPELLED:
        return rf"\ensuremath{{{_greek(c)}}}"
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


def _greek(c: str) -> str:
    name = SPELLED.get(c, c)
    return name if len(name) == 1 else "o" if name == "omicron" else f"\\{name}"
