"""Formulas of an answer that were not judged, above the first line that is wrong: then this may not be the first."""

from __future__ import annotations

import re

from lagrangian.check.verdict import Verdict
from lagrangian.model import Model
from lagrangian.read.letters import key, undotted

_FORMULA = re.compile(
    r"[²³½¼⅓⅙⅛^*·\u0307\u0308ṙẋẏżṡ]|\\(?:d?dot|[dt]?frac|cdot)|(?<=\w)['’′](?![\w’'′])|\b(?:sin|cos|tan|sqrt)"
    r"|(?<=[\w)])[ ][-+−][ ](?=\w)"
)
"""What no line of words has: a power, a product, a rate, a function, a sum."""
_TOKEN = re.compile(r"[A-Za-z]{1,30}[0-9]{0,3}|[^\x00-\x7f]")
_GOES_ON = re.compile(
    r"[ \t]*+(?!\*\*|[-*•][ \t]+[^\W\d_][\w ]{2,40}:)(?:[-+−*·/=&)\]}]|\\(?:q?quad|end|left|right|cdot)\b|\\\\)"
)
_ENDS_OPEN = re.compile(r"[-+−*·/=&(\[{,][ \t]*$|\\\\?[ \t]*$")
_ROUND = str.maketrans({"[": "(", "]": ")", "δ": "d"})
"""Lists in round brackets are told in square ones, and dx of virtual work as δx."""
MOST_LINES = 400
"""Of longer answers nothing is said."""


def unjudged_above(text: str, verdict: Verdict, model: Model) -> tuple[int, ...]:
    """The numbers of the lines with formulas of coordinates above the first wrong one that have no verdict, and that
    belong to none which has one."""
    first = verdict.first_wrong
    rows = text.split("\n")
    if (
        first is None
        or len(rows) > MOST_LINES
        or not all(_is_at(x.line.number, x.line.text, rows) for x in verdict.findings)
    ):
        return ()
    judged = {f.line.number for f in verdict.findings}
    whole = "".join("".join(f.line.text.split()) for f in verdict.findings).translate(_ROUND)
    moving = {key(c.name) for c in model.coordinates}
    found: list[int] = []
    for number, row in enumerate(rows[: first.line.number - 1], 1):
        goes_on = _GOES_ON.match(row) or (number > 1 and _ENDS_OPEN.search(rows[number - 2]))
        plain = row.replace("**", "")
        heading = row.strip().startswith("**") and row.strip().endswith("**")
        formula = not heading and _FORMULA.search(plain) is not None
        if number in judged or goes_on or "".join(row.split()).translate(_ROUND) in whole or not formula:
            continue
        tokens = {key(undotted(x)[0]) for m in _TOKEN.finditer(row) for x in (m[0], m[0][:1])}
        found += [number] if tokens & moving else []
    return tuple(found)


def _is_at(number: int, written: str, rows: list[str]) -> bool:
    """Whether a statement begins in the line of which it has the number."""
    begins = "".join(written.split("\n")[0].split())[:8].translate(_ROUND)
    return 0 < number <= len(rows) and begins in "".join(rows[number - 1].split()).translate(_ROUND)
