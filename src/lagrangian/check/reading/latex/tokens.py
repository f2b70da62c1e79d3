"""Splits LaTeX mathematics into tokens; layout commands are ignored, and commands for a symbol become one token."""

from __future__ import annotations

import re

from lagrangian.check.reading.parser import AnswerToken
from lagrangian.check.reading.prose.words import function_of
from lagrangian.errors import did_you_mean
from lagrangian.model.names import FUNCTIONS
from lagrangian.quantities.source import Source, shown
from lagrangian.read.letters import GREEK

MATRICES = frozenset(f"{kind}matrix{star}" for kind in ("", "p", "b", "B", "v", "small") for star in ("", "*")) | {
    "array"
}
"""The environments of matrices."""

DETERMINANT = "det"
"""The command of a determinant, which is also that of a matrix between bars."""

SYMMETRIC = "\x01"
"""The mark that replaces the word "sym." in a matrix."""

_TOKEN = re.compile(
    r"""
      (?P<space>\s+|~|\\[,;:!>\s]|_?\{\s*\})
    | (?P<sym>\x01)
    | (?P<rowsep>\\\\(?:\s*\[[^\]\n]{0,20}\])?)
    | (?P<begin>\\begin\s*\{(?P<opens>\w+\*?)\}(?:\s*\{[lcr|@{}\s]{0,40}\})?)
    | (?P<end_>\\end\s*\{\w+\*?\})
    | \\(?:mathrm|mathit|mathsf|operatorname\*?|text|textrm|textup|mathup|mathnormal|rm)\s*\{(?P<upright>[^{}]{0,80})\}
    | \\(?:mathrm|mathsf|mathit|textrm)\s*(?P<letter>[A-Za-z])
    | \\(?:text|textup|mathup)\s+(?P<letter1>[A-Za-z])
    | \\(?:mathbf|boldsymbol|bm|pmb|underline)\s*
      (?:\{\s*\\?(?P<bold>[A-Za-z]+)\s*\}|\\?(?P<bold1>(?<=\\)[A-Za-z]+|[A-Za-z]))
    | \\(?:mathcal|mathscr|mathfrak)\s*(?:\{\s*(?P<script>[A-Za-z])\s*\}|(?P<script1>[A-Za-z]))
    | \\overline\s*\{\s*(?P<segment>(?:[A-Z](?:_(?:\w|\{\w{1,3}\}))?){2})\s*\}
    | (?P<delimiter>\\(?:left|right|middle|[bB]igg?[lrm]?)(?![A-Za-z])\s*\.?)
    | \\(?P<command>[A-Za-z]+\*?)
    | (?P<brace>\\[{}])
    | (?P<number>[0-9]+\{,\}[0-9]+|[0-9]+\.?[0-9]*|\.[0-9]+)
    | (?P<fraction>[¼½¾⅐-⅞])
    | (?P<letters>[A-Za-z]+)
    | (?P<greek>[^\W\d_¹²³¼-¾⁰-₟⅐-⅞][\u0307\u0308\u20db\u20dc]*)
    | (?P<raised>[⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+)
    | (?P<lowered>[₀-₉]+)
    | (?P<primes>['’′″‴]+)
    | (?P<times>[*×·⋅∙])
    | (?P<over>[/÷])
    | (?P<plus>\+)
    | (?P<minus>[-−–])
    | (?P<partial>∂)
    | (?P<mark>[=(){}\[\]^_&|,])
    | (?P<other>.)
    """,
    re.VERBOSE | re.DOTALL,
)
_COLUMN_IN_BARS = re.compile(r"\\begin\{vmatrix\}[^&]*?\\end\{vmatrix\}")
_SKIPPED_LISTED = (
    "displaystyle textstyle scriptstyle limits nolimits nonumber notag quad qquad hfill hspace vspace "
    "thinspace medspace thickspace enspace phantom noindent left right big Big bigg Bigg bigl bigr Bigl Bigr "
    "biggl biggr Biggl Biggr allowbreak relax rm it mathstrut"
)
_SKIPPED = frozenset(_SKIPPED_LISTED.split())
_OPERATORS = {"cdot": "times", "times": "times", "ast": "times", "star": "times", "div": "over", "pm": "other"}
_VARIANTS = {"vartheta": "theta", "varphi": "phi", "varepsilon": "epsilon", "varrho": "rho", "varpi": "pi"}
_VARIANTS |= {
    "varkappa": "kappa",
    "varsigma": "sigma",
    "ell": "l",
    "hslash": "hbar",
    "Varphi": "Phi",
    "imath": "i",
    "jmath": "j",
}
_GREEK = frozenset(GREEK.values()) | {word.capitalize() for word in GREEK.values()}
_ACCENTS = {"dot": "1", "ddot": "2", "dddot": "3", "ddddot": "4"}
_DECORATIONS = frozenset(["hat", "bar", "tilde", "vec", "overline", "underline", "widehat", "widetilde", "check"])
_PAIRS = {"lbrace": "(", "rbrace": ")", "lparen": "(", "rparen": ")", "lbrack": "[", "rbrack": "]"}
_PAIRS |= {"lvert": "abs(", "rvert": ")abs", "vert": "|", "mid": "|", "prime": "prime", "partial": "partial"}
_PAIRS |= {
    "frac": "frac",
    "dfrac": "frac",
    "tfrac": "frac",
    "cfrac": "frac",
    "nicefrac": "frac",
    "sfrac": "frac",
    "sqrt": "sqrt",
    "top": "top",
}
_PAIRS |= {"intercal": "top"}


def tokenize(source: Source) -> list[AnswerToken]:
    """Return the tokens of a statement in LaTeX; kinds with the same meaning as in `PlainParser` have the same name."""
    tokens: list[AnswerToken] = []
    for match in _TOKEN.finditer(source.text):
        kind, start, end = str(match.lastgroup), match.start(), match.end()
        text = match[kind]
        if kind == "command":
            kind, text = _command(text, source, start)
        elif kind in ("upright", "letter", "letter1"):
            kind, text = _word(text, source, start)
        elif kind in ("bold", "bold1"):
            kind, text = "symbol", f"bold {text}"
        elif kind in ("script", "script1"):
            kind, text = "symbol", "ℒ" if text == "L" else text
        elif kind == "segment":  # the length from A to B
            kind, text = "upright", re.sub(r"\W|_", "", text)
        elif kind == "begin":
            if match["opens"] not in MATRICES:
                what = f"the environment {shown(match['opens'])} is not read inside a formula"
                raise source.error(what, start, fix="matrices are bmatrix, pmatrix, matrix or array")
        elif kind == "brace":
            kind = text = "(" if text.endswith("{") else ")"
        elif kind == "mark":
            kind = text
        elif kind == "number":
            text = text.replace("{,}", ".")
        elif kind == "greek":
            kind = "symbol"
        elif kind == "other":
            raise source.error(
                f"found {shown(text)}", start, fix="write LaTeX's mathematics: \\frac{a}{b}, \\ddot{x}, x_1"
            )
        if kind not in ("space", "delimiter", "skipped"):
            tokens.append(AnswerToken(kind, text, start, end))
    tokens.append(AnswerToken("end", "", len(source.text), len(source.text)))
    return tokens


def is_determinant(begin: str, text: str) -> bool:
    """Whether bars around a matrix that ``begin`` so say that its determinant is meant: no column in the text has them
    as brackets."""
    return "{v" in begin and _COLUMN_IN_BARS.search(text) is None


def _command(name: str, source: Source, start: int) -> tuple[str, str]:
    """The kind and the text of a command."""
    name = _VARIANTS.get(name, name)
    function = function_of(name)
    if name in _SKIPPED:
        return "skipped", name
    if name in _OPERATORS and _OPERATORS[name] != "other":
        return _OPERATORS[name], name
    if name in _GREEK or name in ("l", "i", "j", "hbar", "varell"):
        return "symbol", name
    if name in _ACCENTS:
        return "accent", _ACCENTS[name]
    if name in _DECORATIONS:
        return "decoration", name
    if name in _PAIRS:
        return _PAIRS[name], name
    if function is not None or name == DETERMINANT:
        return "function", function or name
    near = did_you_mean(name, [*_GREEK, *_VARIANTS, *_ACCENTS, *_DECORATIONS, *_PAIRS, *_OPERATORS, *FUNCTIONS])
    if near is not None:
        fix = near.replace("'", "'\\", 1)
    else:
        fix = "known: \\frac \\sqrt \\dot \\ddot \\sin \\cos \\left( \\right) \\cdot, Greek letters, bmatrix"
    raise source.error(f"the command {shown(chr(92) + name)} is not supported in an answer", start, fix=fix)


def _word(text: str, source: Source, start: int) -> tuple[str, str]:
    r"""The kind and the text of upright letters: ``\mathrm{rod}``, ``\operatorname{sign}``, ``\text{d}``."""
    plain = text.replace(r"\_", "_").replace(" ", "").replace("~", "")
    if (function := function_of(plain)) is not None or plain == DETERMINANT:
        return "function", function or plain
    if not plain:
        return "skipped", plain
    if not re.fullmatch(r"\w+", plain):
        raise source.error(
            f"the words {shown(text)} stand in a formula", start, fix="put the words outside the formula"
        )
    return "upright", plain
