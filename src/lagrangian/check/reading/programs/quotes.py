"""Writes equations that a program has in quotes, and sentences in quotes, without these.

eq1 = "m*xdd + k*x = 0"                     m*xdd + k*x = 0
T = sympify('m*v**2/2')  "T": "m*v**2/2"    T = m*v**2/2
eqs = ["a = 0", "b = 0"]                    a = 0⏎b = 0
diff(diff(L, "v"), 't')                     diff(diff(L, v), t)
"""

from __future__ import annotations

import re
from itertools import islice

from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.traced_text import TracedText

_TEXT = r"(?:[bfru](?=[\"']['\"\w(\[\\]))?(?P<mark>\"|')(?P<said>(?:(?!(?P=mark))[^\n]){1,400}+)(?P=mark)"
"""A text in quotes. A letter before a mark is a prefix only if the text begins at once: r' + l θ' are two rates."""
_QUOTED = re.compile(
    rf"^(?P<indent>[ \t]*+)(?:(?P<quote>['\"]?)(?P<to>{IDENT})(?P=quote)[ \t]*+[=:][ \t]*+)?(?:\[[ \t]*+)?"
    rf"(?P<call>(?:\w{{1,8}}\.)?(?:sympify|parse_expr|str2sym|S|sym|print|disp)\([ \t]*+)?{_TEXT}"
    r"(?(call)[^()\n]{0,60}\))[ \t]*+[;,\]]{0,2}+(?P<end>[ \t]*+(?:[#%][^\n]*+)?$)",
    re.MULTILINE,
)
"""A line that is a text in quotes, perhaps behind a name."""
_LISTED = re.compile(
    rf"^(?P<indent>[ \t]*+)(?:{IDENT}[ \t]*+=[ \t]*+)?[\[({{][ \t]*+(?P<texts>['\"][^\n]{{1,2000}}['\"])"
    r"[ \t]*+[\])}];?[ \t]*+$",
    re.MULTILINE,
)
_ONE = re.compile(_TEXT)
"""Texts in quotes in a list on one line, and one of them."""
_FORMULA = re.compile(r"[\w)\]]\s?(?:\*\*?|/|\^|\+|-|=)\s?[\w(\[-]")
_STATED = re.compile(r"(?<![=<>!:])==?(?![=>])")
_WORD = re.compile(r"[^\W\d_]{2,}[ ][^\W\d_]{2,}[ ][^\W\d_]{2,}")
"""Three words, which are no formula."""

_SPOKEN = re.compile(
    r"^(?P<before>(?:[^\"\n(]{0,400}+(?<=[^\s=,:][ \t]))?[ \t]*+)\"(?P<said>(?=\w)[^\"=\n]{0,400}+=[^\"\n]{1,400}+)\""
    r"(?P<behind>[^\"\n]{0,400}+)$",
    re.MULTILINE,
)
"""The only text in quotes of a line, which says something; no mark in front of it is that of a name: x"."""

_NAME = re.compile(r"(?<=[,\s])(?P<mark>['\"])(?P<name>[^\W\d]\w{0,15})(?P=mark)(?=[ \t]*[,)])")
"""A name in quotes among arguments."""
_DERIVATIVE = re.compile(r"(?<![^\W_])(?:diff|Diff|Derivative|D)\Z")
_MOST, _FARTHEST = 400, 1_000
"""The most names in quotes, and characters between one and the bracket that opens the arguments."""


def _is_derived(text: str, at: int) -> bool:
    """Whether what stands at a place is an argument, and not the first, of a function that differentiates."""
    depth, first = 0, True
    for k in range(at - 1, max(-1, at - _FARTHEST), -1):
        depth += (text[k] in ")]}") - (text[k] in "([{")
        first = first and not (text[k] == "," and depth == 0)
        if depth < 0:
            return text[k] == "(" and not first and _DERIVATIVE.search(text, max(0, k - 12), k) is not None
    return False


def without_quotes(written: TracedText) -> TracedText:
    """Return an answer in which formulas that fill a line in quotes stand without these; the name of an equation is
    left out."""
    if "'" not in written.text and '"' not in written.text:
        return written
    text = written.text
    named = islice(_NAME.finditer(text), _MOST)
    written = written.edited((*m.span(), m["name"]) for m in named if _is_derived(text, m.start()))
    return written.sub(_LISTED, _on_lines).sub(_QUOTED, _unquoted).sub(_SPOKEN, _spoken)


def _on_lines(match: re.Match[str]) -> str:
    """The equations of a list in quotes, one on each line; the list as it is if it holds something else."""
    said = [m["said"].strip() for m in _ONE.finditer(match["texts"])]
    equations = all(_is_formula(x) and _STATED.search(x) for x in said)
    between = re.sub(r"[\s,;]", "", _ONE.sub("", match["texts"]))
    return "\n".join(match["indent"] + x for x in said) if equations and not between else match.group()


def _unquoted(match: re.Match[str]) -> str:
    """The formula of a line in quotes; a text that is no formula as it is."""
    said, states = match["said"].strip(), _STATED.search(match["said"]) is not None
    shows = (match["call"] or "").lstrip().startswith(("print", "disp"))
    if not _is_formula(said) or not (states or (match["to"] and not shows)):
        return match.group()
    return f"{match['indent']}{said if states else match['to'] + ' = ' + said}{match['end']}"


def _spoken(match: re.Match[str]) -> str:
    """A sentence without its quotation marks, of which the second is no mark of an acceleration."""
    line = f"{match['before']} {match['said']} {match['behind']}"
    return line if _WORD.search(line) is not None else match.group()


def _is_formula(said: str) -> bool:
    """Whether a text in quotes is a formula and no sentence, nor one in which a program puts in values."""
    return _FORMULA.search(said) is not None and _WORD.search(said) is None and "{" not in said and "%" not in said
