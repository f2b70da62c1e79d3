"""Reads virtual velocities, w* of w = φ', in answers in plain text that speak of these or of virtual power (Jourdain).

w = phi', v = x'; 0 = (F - m v') v* + (M - J w') w*       0 = (F - m v') δx + (M - J w') δphi
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice
from unicodedata import normalize

from lagrangian.check.reading.traced_text import TracedText

_SPEAKS = re.compile(
    r"\bvirtual[ ](?:velocit|speed|power)|\bvirtuelle[rn]?[ ](?:Geschwindigkeit|Leistung)|\bJourdain", re.IGNORECASE
)
_NAME = r"[^\W\d_]\w{0,15}"
_RATE_OF = re.compile(
    rf"(?<![\w.*/^+'’′])(?P<new>{_NAME}+)[ \t]*=[ \t]*(?:d[ ]?(?P<above>{_NAME}?)[ ]?/[ ]?dt(?!\w)"
    rf"|(?P<of>{_NAME}?)(?:_?dot(?!\w)|['’′](?!['’′])|\u0307(?!\w)))(?=[ \t]*(?:[,;.)]|$|and\b|und\b))",
    re.MULTILINE,
)
_STARRED = re.compile(rf"(?<![\w\\*/^])(?P<name>{_NAME}+)\*(?![\w(*\[])")
MOST = 40
"""The most letters of rates that are looked at."""


def with_virtual_velocities(written: TracedText, moves: Callable[[str], bool]) -> TracedText:
    """Return an answer in which such a velocity is the virtual displacement of the coordinate whose rate its letter
    is; ``moves`` says whether a name changes with time."""
    if "*" not in written.text or _SPEAKS.search(written.text) is None:
        return written
    found = ((m["new"], m["of"] or m["above"]) for m in islice(_RATE_OF.finditer(normalize("NFD", written.text)), MOST))
    rates = {new: of for new, of in found if moves(of)}
    return written.sub(_STARRED, lambda m: f"δ{rates[m['name']]}" if m["name"] in rates else m.group())
