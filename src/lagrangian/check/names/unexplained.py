"""Names that neither the system nor the answer explains: no answer is called wrong because of what they might mean.

If one meaning makes an answer right, it is right, and a note says which. If none does, the answer cannot be read, and
the error asks what the name is. A line that is wrong with known names alone is wrong whatever the others mean.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from difflib import get_close_matches
from typing import Any, cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.lines import filled, lines_of
from lagrangian.check.named_accelerations import with_accelerations
from lagrangian.check.names.needless import without_constants
from lagrangian.check.names.results import is_factor_of_forces
from lagrangian.check.names.values_at_rest import values_at_rest
from lagrangian.check.reading import Answer, Unknown
from lagrangian.check.reference import Reference, truth_of
from lagrangian.check.verdict import AnsweredLine, Status, Verdict
from lagrangian.derive import Derived
from lagrangian.derive.sampling import SETS, CompiledExpressions
from lagrangian.errors import ParseError
from lagrangian.model import Gravity, Model, time
from lagrangian.model.elements.raw import Potential
from lagrangian.page.plain import plain
from lagrangian.read.letters import key
from lagrangian.values.dimensions import Mismatch, check_dimensions

MOST_ASKED = 3
"""The largest number of names that are asked about at once."""

FITS, TINY = 1e-7, 1e-300
"""The relative size of what is left where a value fits, and of what is no slope."""

SHORTEST, LONG, NEAR = 2, 4, 0.8
"""The letters of a name that shortens another, and of one that may have a wrong letter, and how similar it must be."""


def unexplained(derivation: Derived, answer: Answer, verdict: Verdict) -> tuple[Unknown, ...]:
    """The names that decide whether a wrong answer is wrong, and that nothing explains; none if a line is wrong without
    them.

    A misspelled name of the system, a name that was read as a coordinate, and a force that the equations determine are
    known.
    """
    renamed = [u for u in answer.renamed if u.name in answer.mentioned]
    if verdict.status is not Status.WRONG or not (answer.unknown or renamed):
        return ()
    lines = without_constants(with_accelerations(lines_of(answer)), [u.symbol for u in answer.unknown])
    given = {key(d.symbol.name) for d in derivation.definitions}
    asked = [u for u in answer.unknown if u.symbol not in verdict.change and key(u.name) not in given] + renamed
    moving = _moving(derivation.model, lines, answer)
    told = answer.mentioned
    asked = [u for u in asked if u not in moving and (u.name in told or not _is_known(u, derivation.model, lines))]
    at_rest = set(values_at_rest(derivation.model, lines).values())
    asked = [u for u in asked if u.symbol not in at_rest and any(x.expr.has(u.symbol) for x in lines)]
    asked = [u for u in asked if not _is_gravity(u, derivation.model)]
    last = not any(u.name in told for u in asked) and _is_last(derivation, lines, asked, answer.described)
    asked = [] if last else asked
    equations = [line for line in lines if line.kind == "equation"]
    forces = [u for u in asked if derivation.multipliers and is_factor_of_forces(u.symbol, lines)]
    if derivation.form == "structured":
        asked = [u for u in asked if u not in forces]
    elif derivation.multipliers or len(equations) >= len(derivation.model.coordinates) + len(asked):
        return ()  # forces of constraints
    own = {(line.number, line.text, line.kind): line for line in lines}
    written = [own.get((f.line.number, f.line.text, f.line.kind), f.line) for f in verdict.findings]
    right = [
        x.expr for x, f in zip(written, verdict.findings, strict=True) if f.status.right and x.kind != "definition"
    ]
    asked = [u for u in asked if not any(expr.has(u.symbol) for expr in right)]  # its meaning makes one equation right
    deciding: dict[str, Unknown] = {}
    for line, finding in zip(written, verdict.findings, strict=True):
        if finding.status is not Status.WRONG or finding.follows:
            continue
        inside = [u for u in asked if line.expr.has(u.symbol)]
        if not inside:
            return ()
        deciding |= {u.name: u for u in inside}
    return tuple(deciding.values())


def _is_gravity(unknown: Unknown, model: Model) -> bool:
    """Whether a name is g, in a system without gravity: everybody knows what it is, and that it is too much there."""
    return unknown.name == "g" and not any(isinstance(e, (Gravity, Potential)) for e in model.elements)


def question(asked: Sequence[Unknown], mentioned: Collection[str] = ()) -> ParseError:
    """The error that asks what names mean, each at its first place; ``mentioned``: those of which the answer says
    something."""
    found = [_asked(u, said=u.name in mentioned) for u in asked[:MOST_ASKED]]
    return found[0].with_others(found[1:])


def _asked(unknown: Unknown, *, said: bool) -> ParseError:
    why = "what the answer says of it was not understood" if said else "the answer does not explain it"
    what = f"cannot be read: what is '{unknown.name}'? The system has no such name, and {why}"
    more = f" {unknown.suggestion}" if unknown.suggestion else ""
    fix = f"add a line such as '{unknown.name} = …' with names of the system, or use its names.{more}"
    return ParseError(what, element="the answer", place=unknown.place, fix=fix, code="E402")


def _moving(model: Model, lines: Sequence[AnsweredLine], answer: Answer) -> list[Unknown]:
    """The names of the answer's own that are coordinates: they accelerate, and the system has as many that the answer
    lacks. No name is one where something that was not read may say more."""
    found = [
        u for u in answer.unknown if any(x.expr.has(sp.Derivative(cast("Any", u.symbol), (time, 2))) for x in lines)
    ]
    lacking = [c for c in model.coordinates if not any(x.expr.has(c.symbol) for x in lines)]
    return [u for u in found if key(u.name) not in answer.unread] if len(found) <= len(lacking) else []


def _is_known(unknown: Unknown, model: Model, lines: Sequence[AnsweredLine]) -> bool:
    """Whether it is certain what a name of the answer means: it is a name of the system that is misspelled, or a line
    without motion says it, 2*zeta*wn = c/m."""
    symbol: Any = unknown.symbol
    related = (x.expr for x in lines if x.kind == "equation" and not bounded.atoms(x.expr, AppliedUndef))
    if any(expr.has(symbol) for expr in related):
        return True
    symbols = [x.symbol for x in (*model.parameters, *model.inputs, *model.coordinates)]
    used = {x for line in lines for x in bounded.letters(line.expr)}  # K beside k is no k
    same = plain(symbol).lower()
    names = [plain(x) for x in symbols if x not in used or plain(x).lower() != same]
    return sum(_resembles(plain(symbol), x) for x in names) == 1


def _is_last(
    derivation: Derived, lines: Sequence[AnsweredLine], asked: Sequence[Unknown], described: Collection[str]
) -> bool:
    """Whether one name is asked about, and it can only be the one quantity of the system that the answer lacks.

    Words say what it is, or the units of the terms agree, and no other value of it would make the answer right.
    """
    used = {x for line in lines for x in bounded.letters(line.expr)}
    free = [x.symbol for x in (*derivation.model.parameters, *derivation.model.inputs) if x.symbol not in used]
    if (
        derivation.form == "structured"
        or not len(asked) == len(free) == 1
        or _some_value_fits(truth_of(derivation), lines, asked[0].symbol)
    ):
        return False
    if asked[0].name in described:
        return True
    dims = check_dimensions(derivation.model)
    if dims is None:
        return False
    put = {asked[0].symbol: free[0]}
    try:
        return all(dims.of(cast("sp.Expr", line.expr.xreplace(put))) for line in lines if line.kind == "equation")
    except Mismatch:
        return False


def _some_value_fits(truth: Reference, lines: Sequence[AnsweredLine], symbol: sp.Expr) -> bool:
    """Whether an equation may be right with a constant in the place of a name: J_A may be J + m l^2."""
    for line in filled(truth, lines):
        if line.kind != "equation" or not line.expr.has(symbol):
            continue
        exprs = [cast("sp.Expr", line.expr.xreplace({symbol: sp.Integer(k)})) for k in range(3)]
        if any(x.has(sp.zoo, sp.nan, sp.oo) for x in exprs):
            return True  # divided by it
        zero, one, two = (CompiledExpressions([x]).at(truth.states, truth.accelerations)[0] for x in exprs)
        slope = one - zero
        scale = np.abs(zero).max() + np.abs(slope).max()
        if not np.isfinite([zero, one, two]).all() or np.abs(two - one - slope).max() > FITS * scale:
            return True  # not linear in the name
        sets = [x.reshape(SETS, -1) for x in (zero, slope)]
        values = [np.sum(a * b) / max(np.sum(a * a), TINY) for b, a in zip(*sets, strict=True)]
        left = [np.abs(b - v * a).max() for b, a, v in zip(*sets, values, strict=True)]
        if max(left) <= FITS * scale:
            return True
    return False


def _resembles(written: str, name: str) -> bool:
    """Whether a name is another one in short, in other capitals, or with one letter wrong."""
    short, long = sorted((x.replace("_", "").lower() for x in (written, name)), key=len)
    begins = len(short) >= SHORTEST and long.startswith(short)
    return short == long or begins or (len(short) >= LONG and bool(get_close_matches(short, [long], 1, NEAR)))
