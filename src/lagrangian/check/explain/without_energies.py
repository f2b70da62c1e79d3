"""Words for mistakes in answers that state no energy: of the equations, not of T* and V, which nobody wrote down.

The weight of the bob has the wrong sign in V: …     The weight of the bob has the wrong sign: …
l is not squared in the energy of the bob, T*.       l is not squared in what the bob adds to the equations.
The energy of the spring has the wrong sign in V.    What the spring adds to the equations has the wrong sign.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.verdict import DERIVED, AnsweredLine, Mistake
from lagrangian.model import time
from lagrangian.page.formula import Left, Name, Text, Verbatim, text

WHY_EQUATION = text("Go through this equation once more, term by term, and mind the signs.")
WHOLE = {"T*": "the terms of the kinetic energy", "V": "the terms of the weights and springs"}
"""What an energy is in equations."""
GIVEN = {
    "The rate of the prescribed motion has the wrong sign: it goes the other way.": (
        "What the prescribed motion adds to the equations has the wrong sign."
    )
}
"""What is said of a rate that no equation holds."""
_ENERGY = {"T*": ("T", "L", "p", *DERIVED), "V": ("V", "L", "slope", "left", "V-slope")}
"""The kinds of lines that speak of an energy."""
_PART = re.compile(r"[TVULE](?:_?\w{1,8})?\*?|[Ee]_?(?:kin|pot)\w{0,4}")
"""The names of energies, and of parts of them."""
_IN = re.compile(r"(?P<link>,| in|^In) (?P<name>T\*|V)(?=[.:,; ]|$)")
_LOST = re.compile(r"(?P<first>[A-Z])(?P<rest>(?:article|igid body|isc|ody|ass)[^.]{0,80}) is missing in T\*\.")
"""A body of which T* has nothing."""
_BARE = re.compile(r"The deflection of (?P<spring>[^.]{1,80}) is not squared in its energy\.")
"""A spring whose deflection is lost in an energy that nobody wrote."""
_PRODUCTS = re.compile(r"(?P<the>[Tt])he products of different rates in (?:the kinetic energy|½mv²) of ")
_OF = re.compile(
    r"(?<![½\w])(?P<the>[Tt])he (?:energy|kinetic energy(?= of the (?:rotation|translation))) of "
    r"(?P<element>(?:the (?:rotation|translation) of )?(?:[a-z ]{3,30}'[^']{1,60}'|[a-z]{3,20} \w{1,20}))"
)


def of_equations(mistakes: Sequence[Mistake], lines: Sequence[AnsweredLine]) -> tuple[Mistake, ...]:
    """The mistakes in the words of equations, as far as the ``lines`` of an answer do not speak of the energy."""
    silent = silent_energies(lines)
    return tuple(replace(m, what=_said(m, silent)) for m in mistakes) if silent else tuple(mistakes)


def silent_energies(lines: Sequence[AnsweredLine]) -> set[str]:
    """The energies of which no line of an answer speaks, neither as a whole nor in parts."""
    named = [
        x for x in lines if x.name is not None and x.kind in ("definition", "statement") and not _is_linear(x.expr)
    ]
    parts = {x.name[0] for x in named if x.name is not None and _PART.fullmatch(x.name)}
    kinds = {line.kind for line in lines}
    return {e for e, own in _ENERGY.items() if kinds.isdisjoint(own) and parts.isdisjoint(set(own) | {"U", "E", "e"})}


def _is_linear(expr: sp.Expr) -> bool:
    """Whether rates stand in an expression and none is multiplied by one: a force or a torque, T_c = k θ + c θ̇."""
    rates = {x for x in expr.atoms(sp.Derivative) if isinstance(x.expr, AppliedUndef) and x.variables == (time,)}
    slopes = [bounded.diff(expr, x) for x in rates]
    return bool(rates) and not any(x.has(*rates) for x in slopes)


def _said(mistake: Mistake, silent: set[str]) -> Text:
    """What was done, without the names of energies that are ``silent``."""
    joined = list(_joined(mistake.what))
    if "T*" in silent and len(joined) == 1 and (lost := _LOST.fullmatch(str(joined[0]))) is not None:
        return text(f"The inertia of {lost['first'].lower()}{lost['rest']} is missing.")  # its weight may be there

    if "V" in silent and len(joined) == 1 and (bare := _BARE.fullmatch(str(joined[0]))) is not None:
        return text(f"In the force of {bare['spring']}, its deflection is missing.")

    def without(match: re.Match[str]) -> str:
        if match["name"] not in silent:
            return match.group()
        if match["link"] == "In":
            return f"In {WHOLE[match['name']]}"
        return "" if mistake.element is not None or match["link"] == "," else f" in {WHOLE[match['name']]}"

    def of_element(match: re.Match[str]) -> str:
        return f"{'W' if match['the'] == 'T' else 'w'}hat {match['element']} adds to the equations"

    whole = len(silent) == len(_ENERGY)
    if whole:
        products = r"\g<the>he terms that couple the equations by the inertia of "
        joined = [_PRODUCTS.sub(products, x) if isinstance(x, str) else x for x in joined]
        joined = [GIVEN.get(x, x) if isinstance(x, str) else x for x in joined]
    found = [
        _IN.sub(without, x).replace(" sign: lower is less, not more", " sign") if isinstance(x, str) else x
        for x in joined
    ]
    halved = any(isinstance(x, str) and "½ in" in x for x in found)
    if not whole or halved:
        return text(*found)
    slopes = {k + 2 for k, x in enumerate(found) if isinstance(x, str) and x.endswith("∂/∂")}  # ∂/∂θ of the energy
    return text(*(_OF.sub(of_element, x) if isinstance(x, str) and k not in slopes else x for k, x in enumerate(found)))


def _joined(said: Text) -> Iterator[str | Left | Verbatim]:
    """The parts of a text, with the names of energies as words."""
    words = ""
    for part in said.parts:
        if isinstance(part, str) or part in (Name("T*"), Name("V")):
            words += part if isinstance(part, str) else str(text(part))
            continue
        if words:
            yield words
        yield part
        words = ""
    if words:
        yield words
