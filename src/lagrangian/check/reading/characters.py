"""Characters that look alike or are typed for each other: one form for each, so that answers from anywhere are read."""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache

from lagrangian.read.letters import SPELLED

_SAME = {
    **dict.fromkeys("ʹ´ʼ‘ˈ＇", "'"),
    **dict.fromkeys("“”＂", '"'),
    **dict.fromkeys("‐‑‒—―﹣－", "-"),
    **dict.fromkeys("∗＊✱⁎﹡", "*"),
    **dict.fromkeys("✕⨯╳", "×"),
    **dict.fromkeys("⁄／", "/"),
    **dict.fromkeys("＋﹢", "+"),
    **dict.fromkeys("＝﹦≡", "="),
    **dict.fromkeys("（﹙", "("),
    **dict.fromkeys("）﹚", ")"),
    **dict.fromkeys("［⟦", "["),
    **dict.fromkeys("］⟧", "]"),
    **dict.fromkeys("，", ","),
    **dict.fromkeys("；", ";"),
    **dict.fromkeys("ϑ", "θ"),
    **dict.fromkeys("ϕ", "φ"),
    **dict.fromkeys("ϵ", "ε"),
    **dict.fromkeys("ϱ", "ρ"),
    **dict.fromkeys("‧・･ᐧ", "·"),
    **dict.fromkeys("ˆ＾", "^"),
    **dict.fromkeys("ʺ˝〃", "″"),
    **dict.fromkeys(map(chr, (0xA0, *range(0x2000, 0x200B), 0x202F, 0x205F, 0x3000)), " "),
    "\f": "\n",
    "\v": "\n",
    "\u2223": "|",
    "\u0085": "\n",
    "\u2028": "\n",
    "\u2029": "\n",
}
LATEX = re.compile(r"\\[A-Za-z\[\\]|(?<![\w)\]'])\\\(|\\\((?=[^\n]{0,999}\\\))|\$|[_^]\{")
r"""What only LaTeX has; E\(A*x) is a division."""
_TABLE = str.maketrans(_SAME)
_NOTHING = re.compile("[\u200b\u200c\u200d\u2060\u2063\u2064\ufeff\u00ad\u200e\u200f\ufe00-\ufe0f]")
_UMLAUT = re.compile("(?<=[A-Za-z])[aeiou]\u0308|[AOUaeiou]\u0308(?=[A-Za-zß])")
"""A letter within a word whose dots are a character of their own: für."""
_GAP = re.compile("[\u2061\u2062]")  # the signs of a function and of a product, which are not shown
_TRANSPOSED = re.compile(r"(?<=[\w)\]⎦⎤⎥])ᵀ")
_FREEDOMS = re.compile(r"(?<![\w.])\d[-‑]dof(?!\w)", re.IGNORECASE)
"""A word for the degrees of freedom that begins with a number: for a 1-dof system."""
_SMALL = re.compile(r"(?<![\w)\]}⁰-⁹¹²³₀-₉])(?P<above>[⁰¹²³⁴-⁹]{1,3})[⁄/](?P<below>[₀-₉]{1,3})(?P<glued>(?=\w))?")
"""A fraction of small digits: ³⁄₂, also in front of a letter."""
_DIGITS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹₀₁₂₃₄₅₆₇₈₉", "01234567890123456789")
_BAR = re.compile("[―⎯‾¯⸺⸻]{2,}|[–−]{4,}")
"""A horizontal line of several signs, which may be the bar of a fraction; `drawn` has its form."""
_ASSIGNED = re.compile(r":=|=:|[≔≕]")
_STYLED = re.compile(
    "[\U0001d400-\U0001d7ff\u210e\u2110-\u2112\u211b\u212c\u2130\u2131\u2133\u2145\u2146\uff01-\uff5e]"
)


_COMMAND = re.compile(r"\\([A-Za-z]+|[^A-Za-z])")
_DOTTED = re.compile(
    r"\\(?P<twice>d)?dot(?:[ ]?\{[ ]?(?P<held>\\?[^\W\d_][^\W_]{0,15}(?:_\w{1,12})?)[ ]?\}"
    r"|[ ]?(?P<bare>[^\W\d_](?![^\W\d_])|\\[A-Za-z]{2,10}))(?P<index>_\w{1,12})?"
)
_TYPED = {"cdot": "*", "times": "*"}
_LETTERS = frozenset(f"{var}{word}" for word in SPELLED.values() for var in ("", "var"))
_SPOKEN = re.compile(r"(?<![\w\\{])[^\W\d_]{4,24}(?![\w(^_}'’′])")
FEWEST_WORDS = 2
"""The words that make an answer one in words."""


def _with_typed_dots(text: str) -> str:
    r"""A text in words whose only commands of LaTeX are dots, letters and signs of products, without marks around
    its mathematics, with primes and letters for them: (1) becomes J \ddot θ = M."""
    if "$" in text or ("\\dot" not in text and "\\ddot" not in text):
        return text
    commands = set(_COMMAND.findall(text))
    spoken = [x for x in _SPOKEN.findall(text) if x.lower() not in _LETTERS]
    if not commands & {"dot", "ddot"} or len(spoken) < FEWEST_WORDS:
        return text
    if not all(x in _TYPED or x in ("dot", "ddot") or x in _LETTERS for x in commands):
        return text
    made = _DOTTED.sub(
        lambda m: f"{m['held'] or m['bare']}{m['index'] or ''}{chr(39) * (2 if m['twice'] else 1)}", text
    )
    if "\\dot" in made or "\\ddot" in made or re.search(r"[{}]", made):
        return text
    return _COMMAND.sub(lambda m: _TYPED.get(m[1]) or f" {m[1].removeprefix('var')}", made)


@lru_cache(maxsize=16)
def plainer(text: str) -> str:
    """Return the text with characters that look alike replaced, letters in mathematical styles by plain ones, and
    characters without width left out; kept, as several readers of an answer ask for it."""
    text = _UMLAUT.sub(lambda m: unicodedata.normalize("NFC", m.group()), _SMALL.sub(_fraction, text))
    text = _GAP.sub(" ", _NOTHING.sub("", text.replace("\r\n", "\n").replace("\r", "\n")))
    text = _BAR.sub(lambda m: "─" * len(m.group()), text).translate(_TABLE)
    text = _FREEDOMS.sub(lambda m: " " * len(m.group()), _TRANSPOSED.sub("^T", text))
    return _with_typed_dots(_ASSIGNED.sub(" =", _STYLED.sub(_unstyled, text)))


def _fraction(match: re.Match[str]) -> str:
    made = match.group().translate(_DIGITS)
    return made if match["glued"] is None else f"({made})"


def _unstyled(match: re.Match[str]) -> str:
    plain = unicodedata.normalize("NFKC", match.group())
    return match.group() if match.group() == "ℒ" or len(plain) != 1 else plain
