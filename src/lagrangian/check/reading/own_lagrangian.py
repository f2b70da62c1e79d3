"""The Lagrangian under a name of the answer's own, where L is a length: L_g = T − V, ∂L_g/∂θ; and under the same L as
the length, L = ½ m L² θ'² + …, if it is differentiated by a rate: ∂L/∂θ' = …."""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.traced_text import TracedText
from lagrangian.model import Model
from lagrangian.read.letters import find

_STATED = re.compile(
    r"(?<![\w\\^{/∂])(?P<name>[Ll](?:\w{1,12}|_\{\w{1,12}\}))[ \t]*+&?[ \t]*+="
    r"[ \t]*+&?[ \t]*+T\*?[ \t]*+[-−–][ \t]*+[VU]"
    r"(?=[ \t]*+(?:[$.,;:\]&)]|\\[\\\])]|$))",
    re.MULTILINE,
)
"""A name with an L in front that is T − V and nothing else."""
_OTHER = re.compile(r"ℒ|\\(?:mathcal|mathscr|cal)\b|(?<![\w\\])(?:L|[Ll]agrangian)[ \t]*+&?=")
"""The Lagrangian by its usual names."""
_ENERGY = re.compile(
    r"(?<![\w\\^{/∂])L(?=[ \t]*+&?[ \t]*+=(?![=>])[^=\n]{0,600}?(?:(?:['’′]\)?|\u0307)[ ]?(?:\^[ ]?\{?2|²)|"
    r"dot[ ]?\{?\\?\w{1,12}\}?[ ]?\^[ ]?\{?2))"
)
"""An L with a value in which a rate is squared."""
_BY_RATE = re.compile(
    r"(?:d|∂|\\partial)[ ]?L[ ]?\}?(?:/|\{)[ ]?(?:d|∂|\\partial)[ ]?(?:[^\W\d_]\w{0,12}['’′\u0307]|\\?dot)"
)
_DERIVED = re.compile(r"(?P<d>(?<![\w\\])d|∂|\\partial)(?P<gap>[ ]?)L(?=[ ]?\}?(?:/|\{)[ ]?(?:d|∂|\\partial))")
_PROGRAM = re.compile(r"\b(?:diff|[Dd]erivative|jacobian|syms|symbols|import)\b")
"""What programs have, which are carried out."""


def with_own_lagrangian(written: TracedText, model: Model, taken: Callable[[str], bool], *, latex: bool) -> TracedText:
    """Return an answer in which such a name is ℒ, if no other name is and the system has no such name."""
    if taken("L") and is_lagrangian_beside_length(written.text):
        return _with_energy_apart(written, latex=latex)
    names = {m["name"] for m in _STATED.finditer(written.text)}
    if len(names) != 1 or _OTHER.search(written.text) or _PROGRAM.search(written.text):
        return written
    (name,) = names
    plain = name.replace("{", "").replace("}", "")
    if taken(plain) or find(plain, model.symbols):
        return written
    letter = "\\mathcal{L}" if latex else "ℒ"
    used = re.compile(rf"(?<![\w\\])(?P<by>[d∂]?){re.escape(name)}(?!\w)")
    return written.sub(used, lambda m: f"{m['by']}{letter}")


def is_lagrangian_beside_length(text: str) -> bool:
    """Whether the L of an answer is a Lagrangian: rates are squared in its value, and it is differentiated by one."""
    return _BY_RATE.search(text) is not None and _ENERGY.search(text) is not None


def _with_energy_apart(written: TracedText, *, latex: bool) -> TracedText:
    """An answer in which the L that is a Lagrangian is ℒ."""
    letter = "\\mathcal{L}" if latex else "ℒ"
    apart = written.sub(_ENERGY, lambda _: letter)
    return apart.sub(_DERIVED, lambda m: f"{m['d']}{m['gap']}{letter}")
