"""Rates of a state that a program states without a function: dz = [z(2); …], dydt(1) = y(2), dydt[0] = y[1]."""

from __future__ import annotations

import re

from lagrangian.check.reading.carried_out.values import State
from lagrangian.records import dataclass

_HEADER = re.compile(r"^[ \t]*+(?:function|def)[ \t]|@\(|\blambda\b", re.MULTILINE)
_RATES = re.compile(
    r"^[ \t]*+(?P<out>d(?P<of>[^\W\d_]\w{0,12}?)(?:_?dt)?|(?P<dotted>[^\W\d_]\w{0,12}?)_?(?:dot|prime))"
    r"[ \t]*+(?:(?P<index>[(\[]\d[\d:]{0,3}[)\]])[ \t]*+=(?!=)|=(?!=)[ \t]*+\[)",
    re.MULTILINE,
)
"""What the rates of a state are called, where they are listed or stated by number."""


@dataclass(frozen=True)
class Loose:
    """The names of the rates and of the state, the line of the first rate, and whether indices begin at 0."""

    rates: str
    state: State
    line: int
    from_zero: bool


def loose_rates(text: str) -> Loose | None:
    """Return how a program without functions calls its state and the rates of this; None if it does not state any."""
    match = None if _HEADER.search(text) else _RATES.search(text)
    if match is None:
        return None
    name, line = match["of"] or match["dotted"], text.count("\n", 0, match.start()) + 1
    from_zero = re.search(rf"(?<!\w)(?:{name}|{match['out']})\[\d\]", text) is not None
    return Loose(match["out"], State(name), line, from_zero)
