r"""Takes off where a quantity lies: θ = π/2 − ψ ∈ [0, π/2], x \in (0, L), t ∈ [0; 5 s]. An interval is no statement."""

from __future__ import annotations

import re

from lagrangian.check.reading.traced_text import TracedText

_INTERVAL = re.compile(
    r"(?<![ \t])[ \t]*+(?:\\in(?![A-Za-z])|∈)[ \t]*+(?:\\left[ \t]?)?[\[\](][^\[\]=\n;$]{1,60}?[,;][^\[\]=\n$]{1,60}?"
    r"(?:\\right[ \t]?)?[\[\])](?=[ \t]*(?:[$.,;:)]|\\|$|[^\W\d_]{2}))",
    re.MULTILINE,
)


def without_intervals(written: TracedText) -> TracedText:
    """Return an answer without such intervals."""
    return written.sub(_INTERVAL, lambda _: "")
