"""Converts the name of a symbol to a letter: theta1 → θ₁, L_a → L with subscript a, x2r → x_2r.

Greek letters may be spelled. A subscript begins with a digit after the first letter, or with an underscore. Any other
name of several letters is a word and stays as it is. Two names of a system never look the same.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping

from lagrangian.write.expression_tree import GREEK, Letter

SPELLED = {letter: name for name, letter in GREEK.items() if name != "lamda"}
_VARIANTS = {"ϑ": "theta", "ϕ": "phi", "ϵ": "epsilon", "ς": "sigma", "µ": "mu"}

_GREEK_HEAD = re.compile(rf"({'|'.join(sorted(GREEK, key=len, reverse=True))})(\d\w*)?\Z")
_LATIN_HEAD = re.compile(r"([^\W\d_])(\d\w*)?\Z")


def letter(name: str) -> Letter:
    """Return the letter for a name."""
    spelled = "".join(_VARIANTS.get(c, SPELLED.get(c, c)) if len(name) == 1 or _greek(c) else c for c in name)
    head, _, tail = spelled.partition("_")
    parts = tuple(p for p in tail.split("_") if p)
    match = _GREEK_HEAD.match(head) or _LATIN_HEAD.match(head)
    if match is None:
        word = name.partition("_")[0]
        return Letter(word, parts) if word else Letter(name, literal=True)
    base, digits = match.group(1), match.group(2)
    if base == "lamda":
        base = "lambda"
    return Letter(base, ((digits,) if digits else ()) + parts)


def _greek(c: str) -> bool:
    return c in SPELLED or c in _VARIANTS


def letters(names: Iterable[str]) -> Mapping[str, Letter]:
    """Return the letters for all names of a system; a name that would look like an earlier one is shown as spelled."""
    table: dict[str, Letter] = {}
    taken: set[tuple[str, str]] = set()
    for name in names:
        made = letter(name)
        look = (made.base, "".join(made.sub))
        if look in taken:
            shown = unicodedata.normalize("NFC", name)
            while (shown, "") in taken or (SPELLED.get(shown, ""), "") in taken:
                shown += "′"
            made, look = Letter(shown, literal=True), (shown, "")
        taken.add(look)
        table[name] = made
    return table


def phrases(parts: Iterable[str]) -> tuple[str, ...]:
    """The parts of a subscript as they are set, words that follow each other as one: ("front wheel", "2")."""
    found = list[str]()
    for part in parts:
        if found and _is_word(part) and _is_word(found[-1].replace(" ", "")):
            found[-1] += f" {part}"
        else:
            found.append(part)
    return tuple(found)


def _is_word(part: str) -> bool:
    return len(part) > 1 and part.isalpha() and part not in GREEK


def natural(name: str) -> tuple[tuple[int, str, int], ...]:
    """A sort key for the order in which people list names: m2 before m10, a before B, M before m."""
    pieces = re.findall(r"\d+|\D+", name)
    return tuple((0, "", int(p)) if p.isdigit() and p.isascii() else (1, p.casefold(), 0) for p in pieces) + (
        (2, name, 0),
    )
