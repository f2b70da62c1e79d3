"""Why an energy or a speed that a definition has wrong may have come out so: T_rod = ½ J φ̇², without ½mv²."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import LARGEST
from lagrangian.check.explain.bodies_said import Blamed
from lagrangian.check.explain.changes.pool import Pool, Possible, pool_of
from lagrangian.check.explain.meant import owner_of
from lagrangian.check.explain.said_wrongly import SaidWrongly, said_of
from lagrangian.check.explain.search import singles, without_constant
from lagrangian.check.explain.second_choices import distinct
from lagrangian.check.explain.spoken import in_words
from lagrangian.check.explain.taken_as import taken_in
from lagrangian.check.explain.term_said import with_reason
from lagrangian.check.explain.written_pieces import WrittenPieces
from lagrangian.check.reference import Reference, without_time
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.page.formula import text

KINETIC = "kinetic_of_body"
REASONED = (KINETIC, "speed_of_body", "potential_of_body", "potential_said")
"""What is wrong in the quantities of which it is said why they may have come out so."""
STORED = "potential"
"""The kind of quantities in which a deflection is squared."""
IN_PLACE = " stands in place of "
"""What stands between what is written and what belongs there."""
SHOWN = ("component", "along", "velocity")
"""Quantities whose formulas show at once what is wrong."""
PLACES = ("position", "height", "apart", "place", "component", "along", "velocity")
"""Quantities that say where a body is, or how it moves along an axis."""
OF_A_WAY = (
    "piece_left_out",
    "piece_sign",
    "piece_function",
    "piece_number",
    "segment_left_out",
    "segment_sign",
    "segment_turned",
    "segment_direction",
    "segment_number",
    "velocity_part_left_out",
    "velocity_part_sign",
)
"""Mistakes in the way to a body, or in its velocity."""
STEP = 2
"""The step of the kinetic energy."""
MOST_LIKELY = 2.0
"""A mistake that costs more is no reason that is told."""
ALIKE = 0.1
"""The largest difference of the costs of two reasons of which neither is the likelier."""


def reasoned(pool: Pool, said: SaidWrongly, pieces: WrittenPieces) -> Mistake:
    """What a definition has wrong, in words; with the likely mistake in this body that leads to it, if there is one
    that none of the ``pieces`` contradicts which are written."""
    mistake = said.mistake
    if mistake.name not in REASONED or mistake.element is None or said.words.of.kind in SHOWN:
        return mistake
    of_T = list(dict.fromkeys([said.T, without_time(pool.truth, said.T)]))  # what time alone gives changes no equation
    every = CompiledExpressions([*of_T, said.V]).at(pool.truth.states)
    every[-1] = without_constant(every[-1])
    if not np.isfinite(every).all() or not 1e-12 < np.abs(every).max() < LARGEST:
        return mistake
    V: Array = pool.kept("V but constants", lambda: without_constant(pool.V))
    found = [e for k in range(len(of_T)) for e in singles(pool, [pool.T, V], every[[k, -1]])]
    told = [t for e in pieces.allow(found) for t in e.told if t.cost <= MOST_LIKELY]
    reasons = [(t.cost, in_words(pool.truth, t, None)) for t in told if not _is_term(t.mistake)]
    own = [(cost, x) for cost, x in reasons if _is_of(x, mistake.element)]  # an element of gravity: its weight
    if not own:
        taken = taken_in(pool.truth, said) if said.words.of.kind == STORED and not said.words.apart else None
        return mistake if taken is None else taken.mistake
    cost, first = own[0]
    others = distinct([x for other, x in own[1:] if other <= cost + ALIKE and x.why != first.why], [first])
    either = text(*first.what.parts, " Or: ", *others[0].what.parts) if others else first.what
    return replace(mistake, what=with_reason(mistake.what, replace(first, what=either)).what, why=first.why)


def as_defined(
    pool: Pool,
    told: Sequence[Mistake],
    blamed: Blamed | None,
    wrong: Sequence[AnsweredLine],
    pieces: WrittenPieces,
) -> tuple[Mistake, ...]:
    """The mistakes in the place or the speed of a body in the words of the definition that has it wrong, from which the
    line with this mistake follows: several pieces may have the same effect, and the definition shows which it is.

    Definitions above the first of the ``wrong`` lines that does not follow from them are told first.
    """
    if blamed is not None:
        because = {id(x) for x in blamed.because}
        other = min((x.number for x in wrong if id(x) not in because), default=None)
        above = {str(reasoned(pool, p, pieces).what) for p in blamed.said if other is None or p.number <= other}
        told = sorted(told, key=lambda m: str(m.what) not in above)
    said = [p for p in blamed.said if not p.elsewhere and p.words.of.kind in PLACES] if blamed is not None else []
    own = {p.mistake.element: p for p in said}
    told = [reasoned(pool, own[m.element], pieces) if m.element in own and m.name in OF_A_WAY else m for m in told]
    lines = [p.mistake for p in blamed.said] if blamed is not None else []
    told = [m for m in told if not any(m.name != x.name and says_again(m, x) for x in lines if x in told)]
    return tuple(m for m in told if not any(_is_carried(m, p) for p in said))


def _is_carried(mistake: Mistake, said: SaidWrongly) -> bool:
    """Whether a mistake is the exchange by which a rate is wrong, in what moves with it: cos θ in place of sin θ."""
    parts, (right, written) = mistake.what.parts, (said.words.right[0], said.words.written[0])
    places = [k for k, x in enumerate(parts[1:-1], start=1) if x == IN_PLACE]
    if len(places) != 1 or said.line.kind == "definition" or not isinstance(right, sp.Expr):
        return False
    one, other = parts[places[0] - 1], parts[places[0] + 1]
    ratio = bounded.cancel(right / cast("sp.Expr", written))
    return isinstance(one, sp.Expr) and bounded.cancel(ratio * one / cast("sp.Expr", other)) == 1


def says_again(mistake: Mistake, said: Mistake) -> bool:
    """Whether a mistake in the same element sets the same sum right as a wrong definition, in either sense: R φ − x for
    R φ + x beside x − R φ for it, or that the deflection is taken so."""
    own, theirs = _sums_in(mistake), _sums_in(said)
    return mistake.element == said.element is not None and len(own) > 1 and own <= theirs


def _sums_in(mistake: Mistake) -> set[sp.Expr]:
    """The sums in the words of a mistake, of two signs the same one."""
    sums = (x for x in mistake.what.parts if isinstance(x, sp.Add))
    return {-x if x.could_extract_minus_sign() else x for x in sums}


def _is_of(mistake: Mistake, title: str) -> bool:
    """Whether a mistake is made in an element, or in its weight."""
    return mistake.element == title or title in str(mistake.what)


def with_bodies(truth: Reference, findings: Sequence[Finding], told: Sequence[Mistake]) -> tuple[Mistake, ...]:
    """The mistakes, with those in wrong energies of bodies that nothing else uses in front, in place of what else would
    be said of these energies."""
    wrong = [f.line for f in findings if f.line.kind == "definition" and f.is_open]
    wrong = [x for x in wrong if not any(str(m.what).startswith(f"Line {x.number} is ") for m in told)]
    pairs = [(p, owner) for x in wrong if (owner := owner_of(x.name or "", truth.model)) for p in said_of(truth, x)]
    every = [p for p, owner in pairs if (p.mistake.name, p.mistake.element) == (KINETIC, owner.title)]
    said = list({id(p.line): p for p in reversed(every)}.values())[::-1]
    titles = [p.mistake.element for p in said]
    pool = pool_of(truth)
    pieces = WrittenPieces(pool, [f.line for f in findings] if said else [])
    own = (reasoned(pool, p, pieces) for p in said)
    return (*own, *(m for m in told if m.step != STEP or m.element not in titles))


def _is_term(possible: Possible) -> bool:
    """Whether a mistake is nothing but a wrong term, which the formulas show as well."""
    return possible.change is not None and possible.change.site.single
