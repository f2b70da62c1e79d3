"""Rates of a state that a program states without a function: dz = [z(2); …], dydt(1) = y(2), dydt[0] = y[1]."""

from __future__ import annotations

import re
from itertools import islice

from lagrangian.check.reading.carried_out.values import State
from lagrangian.check.reading.programs.indexed_coordinates import HEADER
from lagrangian.records import dataclass

_RATES = re.compile(
    r"^[ \t]*+(?P<out>d(?P<of>[^\W\d_]\w{0,12}?)(?:_?dt)?|(?P<dotted>[^\W\d_]\w{0,12}?)_?(?:dot|prime)"
    r"|(?P<short>[^\W\d_]\w{0,12}?)_?d)"
    r"[ \t]*+(?:(?P<index>[(\[]\d[\d:]{0,3}[)\]])[ \t]*+=(?!=)|=(?!=)[ \t]*+\[)",
    re.MULTILINE,
)
"""What the rates of a state are called, where they are listed or stated by number; sd where s(1) is an entry of s."""
MOST = 40
"""The most names that may be called so."""


@dataclass(frozen=True)
class Loose:
    """The names of the rates and of the state, the line of the first rate, and whether indices begin at 0."""

    rates: str
    state: State
    line: int
    from_zero: bool


def loose_rates(text: str) -> Loose | None:
    """Return how a program without functions calls its state and the rates of this; None if it does not state any."""
    found = () if HEADER.search(text) else islice(_RATES.finditer(text), MOST)
    match = next((x for x in found if x["short"] is None or _is_unpacked(x["short"], text)), None)
    if match is None:
        return None
    name, line = match["of"] or match["dotted"] or match["short"], text.count("\n", 0, match.start()) + 1
    from_zero = re.search(rf"(?<!\w)(?:{name}|{match['out']})\[\d\]", text) is not None
    return Loose(match["out"], State(name), line, from_zero)


def _is_unpacked(name: str, text: str) -> bool:
    """Whether names get the values of the first and of another entry of a state: x = s(1); v = s(2)."""
    found = re.findall(rf"=[ \t]*{re.escape(name)}[(\[](\d)[)\]][ \t]*(?:;|,|$|[%#])", text, re.MULTILINE)
    return len(set(found)) > 1
