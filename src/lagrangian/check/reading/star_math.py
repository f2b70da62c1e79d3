"""Takes the notation of LibreOffice's formula editor off an answer.

{1 over 2} M dot y^2 newline             ((1)/(2)) M y'^2⏎
ddot %varphi sin %varphi                 φ'' sin φ
left ( a + b right ) cdot x_{1}          ( a + b ) * x_1
matrix{a # b ## c # d}                   [a , b ; c , d]
"""

from __future__ import annotations

import re

from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.read.letters import SPELLED

_GREEK = {word: letter for letter, word in SPELLED.items() if letter != "ς"}
_LETTER = re.compile(r"(?<![\w\\])%(?P<variant>var|VAR)?(?P<word>[A-Za-z]{2,7})(?![A-Za-z0-9])")
_NAMED = r"(?:[^\W\d_]|%[A-Za-z]{2,10})\w{0,6}(?:_(?:\{[ ]?\w{1,8}[ ]?\}|\w{1,8}))?"
_DOTTED = re.compile(
    rf"(?<![\w\\])(?P<dots>d{{0,2}})dot[ ]{{0,3}}(?:\{{[ ]{{0,3}}(?P<in>{_NAMED})[ ]{{0,3}}\}}|(?P<of>{_NAMED}))"
)
_OVER = re.compile(r"(?<![\w\\])over(?!\w)")
_SIGNS = re.compile(
    r"(?<![\w\\])(?:over|newline|d{1,2}ot|dot|cdot|left|right|stack|matrix)(?!\w)|%[A-Za-z]{2,10}(?!\w)|[{}]"
)
_OPERANDS = re.compile(r"[\w)}'’′²][ ]{0,3}over[ ]{0,3}[\w({%]")
_MATRIX = re.compile(r"(?<![\w\\])(?P<kind>matrix|stack|binom)[ ]{0,3}\{")
_WORDS: list[tuple[re.Pattern[str], str]] = [
    (re.compile(r'"[^"\n]{0,200}"'), " "),
    (re.compile(r"(?<![\w\\])newline(?!\w)"), "\n"),
    (re.compile(r"(?<![\w\\])(?:left|right)[ ]{0,3}(?=[()\[\]|{}.])"), ""),
    (re.compile(r"(?<![\w\\])(?:cdot|times)(?!\w)"), "*"),
    (re.compile(r"(?<![\w\\])partial[ ]{0,3}"), "∂"),
    (re.compile(r"(?<![\w\\])(?:align[lrc]|n?ital(?:ic)?|n?bold|phantom|func)(?!\w)|[~`]"), " "),
    (_OVER, "/"),
    (re.compile(r"_\{[ ]{0,3}(\w{1,12})[ ]{0,3}\}"), r"_\1"),
    (re.compile(r"\{"), "("),
    (re.compile(r"\}"), ")"),
]
MOST = 40
"""The most matrices that are read."""


def without_star_math(written: TracedText) -> TracedText:
    """Return an answer in this notation in plain text; any other answer as it is."""
    text = written.text
    if "\\" in text or "$" in text:
        return written
    kinds = {m.group() if m.group()[0] != "%" else "%" for m in _SIGNS.finditer(text)}
    fractions = _OPERANDS.search(text) is not None and "{" in kinds
    letters = any(_letter(m) != m.group() for m in _LETTER.finditer(text)) and kinds & {"dot", "ddot", "newline"}
    if not fractions and not letters:
        return written
    written = written.sub(_DOTTED, _primed).sub(_LETTER, _letter)
    written = written.edited(_matrices(written.text))
    for form, made in _WORDS:
        written = written.sub(form, lambda m, made=made: m.expand(made))
    return written


def _letter(match: re.Match[str]) -> str:
    """%varphi as φ, %OMEGA as Ω."""
    word = match["word"]
    word = word[0] + word[1:].lower() if word.isupper() else word
    return _GREEK.get(word, match.group())


def _primed(match: re.Match[str]) -> str:
    """ddot %varphi as %varphi''."""
    name = re.sub(r"[{} ]", "", match["in"] or match["of"])
    primes = "'" * (len(match["dots"]) + 1)
    letter = re.match(r"%[A-Za-z]{2,10}", name)
    return f"{_LETTER.sub(_letter, name) if letter else name}{primes}"


def _matrices(text: str) -> list[Edit]:
    """The edits that write matrix{a # b ## c # d} as [a, b; c, d], and what stands below each other on lines."""
    edits: list[Edit] = []
    for match in list(_MATRIX.finditer(text))[:MOST]:
        depth, at = 1, match.end()
        inside: list[Edit] = []
        while at < len(text) and depth:
            depth += (text[at] == "{") - (text[at] == "}")
            if text[at] == "#" and depth == 1:
                twice = text.startswith("##", at)
                mark = "\n" if match["kind"] == "stack" else ";" if twice else ","
                inside.append((at, at + 1 + twice, mark))
                at += twice
            at += 1
        if not depth:
            own = ("\n", "\n") if match["kind"] == "stack" else ("[", "]")
            edits += [(*match.span(), own[0]), *inside, (at - 1, at, own[1])]
    return edits
