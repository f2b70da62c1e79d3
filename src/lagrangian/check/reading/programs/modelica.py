"""Takes off a model in Modelica what states no equation: declarations, headings, texts in quotes.

model Swing "with a bead"
  parameter Real m = 1.2, J = m*r^2;      m = 1.2, J = m*r^2;
  Real x(start = 0.1), beta = phi - Om*time;             beta = phi - Om*t;
equation
  der(x) = v;                             der(x) = v;
end Swing;
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lagrangian.check.reading.programs.session_lists import entries_in
from lagrangian.check.reading.traced_text import Edit, TracedText

_MODEL = re.compile(r"^[ \t]*+(?:partial[ \t]++)?(?:model|block|class)[ \t]++[^\W\d]\w{0,60}+[^\n=]*+$", re.MULTILINE)
_EQUATIONS = re.compile(r"^[ \t]*+(?:initial[ \t]++)?equation\b[ \t]*+", re.MULTILINE)
_ENDS = re.compile(r"^[ \t]*+(?:end[ \t]++\w{1,60}+|annotation[ \t]*+\([^\n]*+)[ \t]*+;?[ \t]*+$", re.MULTILINE)
_DECLARED = re.compile(
    r"^[ \t]*+(?:(?:parameter|constant|input|output|final|discrete)[ \t]++){0,3}+"
    r"(?:Real|Integer|Boolean|(?:\w{1,30}\.){1,5}\w{1,30})[ \t]++(?P<listed>[^;]{1,2000}+);",
    re.MULTILINE,
)
_ENTRY = re.compile(r"[ \t\n]*+(?P<name>[^\W\d]\w*+)(?:\([^()\n]*+\))?[ \t\n]*+(?:=(?P<value>[^=]++))?\Z")
_QUOTED = re.compile(r'"[^"\n]{0,300}+"')
_TIME = re.compile(r"(?<![\w.])time(?![\w(])")
MOST = 200
"""The most declarations that are looked at."""


def without_modelica(written: TracedText) -> TracedText:
    """Return an answer in which a model in Modelica is its equations alone."""
    if _MODEL.search(written.text) is None or _EQUATIONS.search(written.text) is None:
        return written
    written = written.sub(_QUOTED, lambda m: "").sub(_TIME, lambda m: "t")
    for form in (_MODEL, _EQUATIONS, _ENDS):
        written = written.sub(form, lambda m: "")
    return written.edited(_values(written.text))


def _values(text: str) -> Iterator[Edit]:
    """The values that declarations give to names, in the place of these."""
    for match in islice(_DECLARED.finditer(text), MOST):
        entries = (_ENTRY.match(text[a:b]) for a, b in entries_in(text, *match.span("listed")))
        kept = [f"{m['name']} = {m['value'].strip()}" for m in entries if m and m["value"]]
        yield *match.span(), f"{', '.join(kept)};" if kept else ""
