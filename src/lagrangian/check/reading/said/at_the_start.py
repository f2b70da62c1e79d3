r"""Reads accelerations at the start, θ̈(0) = τ/J, s''(0) = e θ''(0), as equations of that moment; a rate is no function.

What such a line says is judged for the values of positions and rates that the answer gives for the start.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.prose.remarks import accelerates_in
from lagrangian.check.reading.traced_text import TracedText, line_end
from lagrangian.read.letters import undotted

_START = r"(?:\\left)?\([ ]?(?:t[ ]?=[ ]?)?0[ ]?(?:\+|⁺|\^[ ]?\+|\^\{[ ]?\+[ ]?\})?[ ]?(?:\\right)?\)"
_VALUE = re.compile(
    r"(?P<of>(?<![\w\\])(?:\\d?dot[ ]?(?:\{[ ]?)?)?\\?(?P<name>[^\W\d_][\w\u0307\u0308]{0,15})(?:[ ]?\})?"
    rf"(?:_\{{\w{{1,8}}\}})?['’′″]{{0,2}})[ ]?{_START}"
)
_ZERO = re.compile(_START)


def with_start_alone(written: TracedText, moves: Callable[[str], bool]) -> TracedText:
    """Return an answer in which coordinates and their rates stand without the time 0, on lines with accelerations;
    ``moves`` says whether a name is a coordinate."""
    text = written.text

    def bare(match: re.Match[str]) -> str:
        line = text[text.rfind("\n", 0, match.start()) + 1 : line_end(text, match.end())]
        starts = moves(undotted(match["name"])[0]) and accelerates_in(line)
        return match["of"].ljust(len(match.group())) if starts else match.group()

    return written.sub(_VALUE, bare) if _ZERO.search(text) is not None else written
