"""Kinetic energies of several bodies that an answer states together, T_arms = …, or of one under a number, T_2 = …."""

from __future__ import annotations

import re
from itertools import combinations
from unicodedata import normalize

import numpy as np
import sympy as sp

from lagrangian.check.explain.candidates import ingredients_of
from lagrangian.check.explain.meant import kinds_of, owner_of
from lagrangian.check.explain.said_wrongly import NEAR, in_names_of
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.errors import listed

MOST = 7
"""The most energies of which all sums are compared with what is written."""
_NUMBERED = re.compile(r"[TKE]_?\{?\d\}?")
"""A name with the number of a part, which may be no number of a body."""


def energy_of_several(truth: Reference, line: AnsweredLine) -> str | None:
    """The words for the kinetic energy of some of all bodies that a definition has right; None if it has none of them.

    The body that its name, or the words before it, name is one of them.
    """
    name = line.name or ""
    value = in_names_of(truth, line) if kinds_of(name) == ("kinetic",) else None
    if value is None:
        return None
    s = ingredients_of(truth.derivation)
    moving = [(e, T) for e in s.model.elements if (T := truth.put(s.kinetic(e))) != 0]
    if not 1 < len(moving) <= MOST:
        return None
    numbered = _NUMBERED.fullmatch(normalize("NFKC", name)) is not None
    said = owner_of(f" {line.words}", truth.model) or (None if numbered else owner_of(name, truth.model))
    own, *energies = CompiledExpressions([value, *(T for _, T in moving)]).at(truth.states)
    near = NEAR * (1 + np.abs(own).max())
    for count in range(1, len(moving)):
        for chosen in combinations(range(len(moving)), count):
            if np.abs(own - sum(energies[k] for k in chosen)).max() > near:
                continue
            of = [moving[k][0] for k in chosen]
            if (said is None or said in of) and zero_everywhere(truth, value - sp.Add(*(moving[k][1] for k in chosen))):
                return f"kinetic energy of {listed([e.title.removeprefix('kinetic ') for e in of])}"
    return None
