"""The letters of currents and of other rates that the description of a system implies: i, where q is a charge.

An answer may write i for q̇ without a word, as every book does. A coordinate is a charge if a circuit's element has it;
its current has the same number: i1 of q1. A description may name the letter of a rate: "its rate is the speed v".
"""

from __future__ import annotations

import re
from collections.abc import Collection

import sympy as sp

from lagrangian.model import Model
from lagrangian.model.elements.branch import CircuitBranch
from lagrangian.read.letters import key

_NAMED = re.compile(
    r"\b(?:rate|derivative)[ ](?:is[ ])?(?:the[ ])?(?:angular[ ])?(?:(?:current|velocity|speed)[ ])?"
    r"(?P<name>[^\W\d_](?:_?[^\W_]{1,2})?)(?![\w'’′])(?![ ]\w)"
)
"""Its rate is the current i."""
_NUMBERED = re.compile(r"[^\W\d_]{1,8}(?P<number>\d{0,2})")
_INDEXED = re.compile(r"i[A-Za-z]")
"""The armature's current: ia."""


def implied_rates(model: Model, used: Collection[str], moving: Collection[str]) -> dict[str, sp.Expr]:
    """Return the rates that letters of an answer are by the description of the system, by their common forms.

    ``used`` are the common forms of the names in the answer, ``moving`` those of which it forms a rate. In an answer
    that writes q̇ itself, a letter that the description does not name is a current only if it changes with time.
    """
    found: dict[str, sp.Expr] = {}
    elements = [e for e in model.elements if isinstance(e, CircuitBranch)]
    charges = {q for e in elements for x in e.charges for q in sp.sympify(x).atoms(sp.Function)}
    for c in model.coordinates:
        named = _NAMED.search(c.description)
        if named is not None:
            found[key(named["name"])] = c.rate
        number = _NUMBERED.fullmatch(key(c.name))
        if c.symbol not in charges or number is None:
            continue
        letters = [f"{x}{number['number']}" for x in ("i", "I")]
        if len(charges) == 1:
            indexed = [x for x in moving if _INDEXED.fullmatch(x)]
            letters += indexed if len(indexed) == 1 else []
        for letter in letters:
            if letter in moving or key(c.name) not in used:
                found.setdefault(letter, c.rate)
    own = {key(x) for x in model.symbols}
    return {letter: rate for letter, rate in found.items() if letter in used and letter not in own}
