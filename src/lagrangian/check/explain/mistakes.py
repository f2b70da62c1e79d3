"""Chooses the mistakes to report: those that explain the first wrong line and as many other lines as possible."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from dataclasses import replace
from typing import TypeAlias

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.check.align import Alignment, alignments
from lagrangian.check.explain.beside_lengths import by_lengths
from lagrangian.check.explain.beyond_lines import beyond
from lagrangian.check.explain.bodies_said import Blamed, BodiesSaid, agrees, apart_from, blamed_also
from lagrangian.check.explain.changes.pool import Pool, pool_of
from lagrangian.check.explain.derivative_lines import against_derivatives, of_derivative_of, of_differences
from lagrangian.check.explain.energy_theorem import is_energy_theorem, of_energy_theorem
from lagrangian.check.explain.functions_written import in_written_terms
from lagrangian.check.explain.inertia_forms import as_form, cancelled
from lagrangian.check.explain.joined import is_part, joined
from lagrangian.check.explain.known_beside import with_known
from lagrangian.check.explain.line_mistakes import (
    MOST_TOLD,
    UNNATURAL,
    contradicted,
    followed,
    least_opposed,
    of_forces,
    of_line,
    stated,
)
from lagrangian.check.explain.narrowed import narrowed
from lagrangian.check.explain.numerators import by_numerators, said_of
from lagrangian.check.explain.own_denominators import mistake_of
from lagrangian.check.explain.own_rates import of_rate, wrong_rates
from lagrangian.check.explain.own_terms import OwnTerm, foreign_names, own_terms
from lagrangian.check.explain.quoted import is_quotable, letters_of
from lagrangian.check.explain.reasoned import as_defined, reasoned
from lagrangian.check.explain.reduced import of_reduced
from lagrangian.check.explain.relation_slips import of_relation
from lagrangian.check.explain.right_bodies import against_bodies
from lagrangian.check.explain.said_wrongly import SaidWrongly
from lagrangian.check.explain.search import EXOTIC, Explanation, Told, by_rows, first_explained
from lagrangian.check.explain.second_choices import distinct
from lagrangian.check.explain.sheets import sheets
from lagrangian.check.explain.slips import below_right_equations, of_slip
from lagrangian.check.explain.solved import denominator, solved_from_wrong
from lagrangian.check.explain.spoken import in_words, moved_elsewhere, of_either
from lagrangian.check.explain.sums_written import by_sums
from lagrangian.check.explain.taken_as import taken_as
from lagrangian.check.explain.term_said import beside, with_term
from lagrangian.check.explain.undivided import undivided
from lagrangian.check.explain.undone import Undone
from lagrangian.check.explain.without_energies import of_equations
from lagrangian.check.explain.written_pieces import Against, WrittenPieces
from lagrangian.check.prescribed import of_prescribed, with_prescribed
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import DERIVED, AnsweredLine, Finding, Mistake, Status
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.records import dataclass

Lines: TypeAlias = Sequence[AnsweredLine]
SPARED = 1.0
"""What an explanation gains for every other wrong line that it explains as well."""
BEYOND = 0.3
"""What a mistake costs more that would change another equation, too, in which it was not seen."""
LIKELY = 2.4
"""A mistake that costs less is likelier than coordinates that nobody spoke of."""
FAR = 3.6
"""A mistake that costs more is far-fetched: it explains the answer, but what differs is said first."""
FAR_TOGETHER = 2.6
"""The same for several mistakes, a mistake."""


@dataclass(frozen=True)
class NamedMistakes:
    """The mistakes that explain an answer, as the most likely set; ``others`` explain it as well.

    ``certain``: a single likely mistake explains everything. ``sure``: none of them is far-fetched. ``left`` are the
    wrong equations that they leave open; the first wrong line is explained, or they are not ``sure``. ``blamed`` are
    the definitions that are wrong, from which wrong lines follow.
    """

    told: tuple[Mistake, ...] = ()
    others: tuple[Mistake, ...] = ()
    certain: bool = False
    sure: bool = True
    left: tuple[AnsweredLine, ...] = ()
    blamed: Blamed | None = None


def mistakes(truth: Reference, lines: Lines, findings: Sequence[Finding], right: Lines = ()) -> NamedMistakes:
    """Find the mistakes behind the wrong lines; lines that follow from others need no explanation of their own.

    No mistake that would show in a right line is considered; ``right`` are more than the findings have. If nothing
    explains a derivative, the equations that follow from it are explained."""
    findings = [f for f in findings if f.line.kind != "definition"]  # what others follow from is sought among all
    named = _of_lines(truth, lines, findings, right)
    derived = any(f.line.kind in DERIVED and f.status is Status.WRONG for f in findings)
    if named.told or not derived or not any(f.follows for f in findings):
        told = () if named.told else of_relation(truth, findings) or of_rate(truth, findings)
        return replace(named, told=told, left=()) if told else named
    free = [replace(f, follows=f.follows and f.line.kind != "equation") for f in findings]
    return _of_lines(truth, lines, free, right)


def _of_lines(truth: Reference, lines: Lines, findings: Sequence[Finding], right: Lines) -> NamedMistakes:
    """The mistakes behind the wrong lines that do not follow from others."""
    wrong = [f.line for f in findings if f.is_open and not _is_unclear(f, findings)]
    if not wrong or not np.isfinite(truth.W).all():
        return NamedMistakes()
    true = [f.line for f in findings if f.status.right]
    bodies = BodiesSaid(truth, lines, apart_from((*true, *right), wrong), wrong_rates(truth, wrong))
    pool = pool_of(truth)
    pieces = WrittenPieces(pool, lines)
    if (blamed := bodies.of_all(findings, wrong)) is not None:
        return NamedMistakes(_once([reasoned(pool, p, pieces) for p in blamed.said], ()), certain=True, blamed=blamed)
    shown = contradicted(pool, true, lines) | against_derivatives(pool, true) | against_bodies(pool, lines)
    against = Against(frozenset(shown), pieces, Undone(pool, findings))
    groups, own, left = list[list[Explanation]](), list[Mistake](), list[AnsweredLine]()
    quotable = letters_of([*(f.line for f in findings), *(x for x in lines if x.kind == "definition")])
    forces = of_forces(pool, wrong, lines)
    prescribed = {line: said for line in wrong if (said := of_prescribed(truth, line)) is not None}
    for line in wrong:
        if line in prescribed:
            continue
        if line.kind == "Xi" and forces:
            groups += [forces] if forces not in groups else []
        elif line.kind != "equation":
            found, more = of_line(pool, line, lines, against)
            if said := bodies.of_line(line):
                likely = [e for e in found[:MOST_TOLD] if agrees(e, said) and _is_said(truth, e, quotable)]
                found, more, blamed = _with_definitions(pieces, line, said, (found, likely, more), blamed)
            found, more = (found, more) if said else taken_as(truth, line, found, more)
            more = more or (of_differences(line, findings) if not found else [])
            groups.append(least_opposed(pool, found, line, true, lines, against))
            own, left = [*own, *more], [*left, *([] if found or more else [line])]
    powers = [line for line in wrong if line.kind == "equation" and is_energy_theorem(truth, line.expr)]
    groups += [of_energy_theorem(pool, line.expr) for line in powers]
    of_equation = [f for f in findings if f.line.kind == "equation" and not any(f.line is x for x in powers)]
    groups = followed(pool, groups, [f.line for f in of_equation if f.follows or f.status.right]) if not own else groups
    combined = {id(f.line) for f in of_equation if f.status.right and f.coordinate is None}  # sums of right equations
    if any(w.kind == "equation" for w in wrong):
        against = against.also(_changing(pool, [f.line.expr for f in of_equation if id(f.line) in combined]))
    of_sheets: list[tuple[list[Explanation], list[Mistake]]] = []
    rows = {id(f.line): f.coordinate for f in of_equation if f.status.right and f.coordinate is not None}
    below = below_right_equations(truth, findings)
    for sheet in sheets(truth, [f for f in of_equation if id(f.line) not in below]):
        held = [rows[id(line)] for line in sheet if id(line) in rows]
        of_sheets += _of_sheet(pool, sheet, wrong, combined, against, held, left, groups)
    for found, more in _without_partial(of_sheets):
        groups.append(bodies.borne_out(pool, found))
        own += more
    for line in (f.line for f in of_equation if id(f.line) in below and any(f.line is w for w in wrong)):
        slip = of_slip(pool, line)
        own += slip
        left += [] if slip else [line]
    groups = [x for g in groups if (x := _tellable(pool, g, lines, quotable))]
    named = _named(pool, groups, {line.kind for line in lines}) if groups else NamedMistakes()
    lead = next((line for line in wrong if line not in prescribed), wrong[0])
    of_first, others = of_derivative_of(truth, lead, lines, findings, named.told, named.others)
    told = with_prescribed(truth, prescribed, (*in_written_terms(of_first, findings), *_once(own, named.told)))
    open_first = any(x is wrong[0] or foreign_names(truth, x.expr) for x in left) and not truth.derivation.multipliers
    certain, sure = named.certain and not own and not left, named.sure and not open_first
    told, others = of_equations(as_defined(pool, told, blamed, wrong, pieces), lines), of_equations(others, lines)
    return NamedMistakes(told, others, certain, sure, tuple(x for x in left if x.kind == "equation"), blamed)


def _with_definitions(
    pieces: WrittenPieces,
    line: AnsweredLine,
    said: Sequence[SaidWrongly],
    explained: tuple[list[Explanation], list[Explanation], list[Mistake]],
    blamed: Blamed | None,
) -> tuple[list[Explanation], list[Mistake], Blamed | None]:
    """What is told of a line that follows from definitions, and those that are blamed: they are told themselves unless
    they are right for another quantity; then the likely explanations agree with them."""
    found, likely, more = explained
    if any(p.elsewhere for p in said):
        return (likely if likely and likely[0].cost <= EXOTIC else []) or found, more, blamed
    return [], [reasoned(pieces.pool, p, pieces) for p in said], blamed_also(blamed, said, line)


def _is_unclear(finding: Finding, findings: Sequence[Finding]) -> bool:
    """Whether a wrong line may have been meant otherwise: a Ξ that is told elsewhere, or what was not read."""
    line = finding.line
    if any(str(x.func).startswith("⟨") for x in line.expr.atoms(AppliedUndef)):
        return True
    same = [f for f in findings if f.line.kind == line.kind == "Xi" and f.line.name == line.name]
    return any(f.status.right for f in same) or finding in same[1:]


def _tellable(pool: Pool, found: Sequence[Explanation], lines: Lines, quotable: set[sp.Basic]) -> list[Explanation]:
    """The likeliest explanations whose words quote only what was written."""
    likely = by_lengths(pool, by_sums(pool, found, lines), lines)
    return [e for e in likely[:MOST_TOLD] if _is_said(pool.truth, e, quotable)]


def _is_said(truth: Reference, explanation: Explanation, written: set[sp.Basic]) -> bool:
    """Whether the words of an explanation quote only what was written."""
    said = ((t, in_words(truth, t, explanation.under)) for t in explanation.told)
    return all(is_quotable(m, written | cancelled(truth, t.mistake)) for t, m in said)


def _without_partial(
    told: Sequence[tuple[list[Explanation], list[Mistake]]],
) -> Sequence[tuple[list[Explanation], list[Mistake]]]:
    """The explanations of several sets of equations, without those that need more mistakes than another.

    What lacks several things beside an equation that has one mistake is a part of it, such as d/dt ∂T*/∂ξ̇ alone, unless
    that mistake is one of them.
    """
    counts = [len(found[0].told) if found else len(more) for found, more in told]
    fewest = min(counts, default=0)
    first = {id(x[0].told[0].mistake) for (x, _), count in zip(told, counts, strict=True) if x and count == 1}
    return [
        (found, more)
        for (found, more), count in zip(told, counts, strict=True)
        if count == fewest or fewest > 1 or (found and first & {id(t.mistake) for t in found[0].told})
    ]


def _of_sheet(
    pool: Pool,
    sheet: Sequence[AnsweredLine],
    wrong: Sequence[AnsweredLine],
    combined: set[int],
    against: Against,
    right: Sequence[str],
    left: list[AnsweredLine],
    groups: Sequence[Sequence[Explanation]],
) -> Iterator[tuple[list[Explanation], list[Mistake]]]:
    """The explanations of one set of equations together or, where there is none, of each wrong one on its own.

    ``right`` are the coordinates whose equations are right: a mistake that would show there was not made. Wrong
    equations that nothing explains are added to ``left``. ``groups`` explain the lines above.
    """
    own = [line for line in sheet if any(line is w for w in wrong)]
    if not own:
        return
    rows = [line for line in sheet if id(line) not in combined]
    if (seen := beyond(pool, rows, groups, against)) is not None:
        yield from [(seen, [])] if seen else []
        return
    found, more = _of_equations(pool, rows, sheet, against)
    if found or more:
        yield found, more
        return
    felt = against.also(_felt_in(pool, right))
    for line in own if len(sheet) > 1 else ():
        found, more = _of_equations(pool, [line], [line], felt)
        found = _of_rows_alone(pool, found)
        if found or more:
            yield found, more
        else:
            left.append(line)
    left += own if len(sheet) == 1 else []


def _felt_in(pool: Pool, coordinates: Sequence[str]) -> set[int]:
    """The possible mistakes that would change the equations of some coordinates, by their identity."""
    rows = [i for i, c in enumerate(pool.truth.model.coordinates) if c.name in coordinates]
    return {id(pool.all[k]) for i in rows for k in np.flatnonzero(pool.felt[:, i])}


def _of_rows_alone(pool: Pool, found: Sequence[Explanation]) -> list[Explanation]:
    """Explanations of one equation alone, those of which nothing is known to be wrong in the others less likely."""
    more = [e.cost + BEYOND * any(pool.felt[pool.places[id(t.mistake)]].sum() > 1 for t in e.told) for e in found]
    return [replace(e, cost=cost) for cost, e in sorted(zip(more, found, strict=True), key=lambda x: x[0])]


def _changing(pool: Pool, exprs: Sequence[sp.Expr]) -> set[int]:
    """The possible mistakes that would change sums of right equations, by their identity."""
    truth = pool.truth
    found: set[int] = set()
    W = truth.W.reshape(truth.n, -1, truth.states.motions).transpose(1, 2, 0)
    for p in CompiledExpressions(exprs).at(truth.states) if exprs else ():
        blocks = p.reshape(len(W), -1)
        if not np.isfinite(blocks).all():
            continue
        factors = np.array([np.linalg.lstsq(w, b, rcond=None)[0] for w, b in zip(W, blocks, strict=True)])
        if np.abs(np.einsum("bmi,bi->bm", W, factors) - blocks).max() > 1e-7 * np.abs(blocks).max():
            continue
        changed = np.einsum("cis,si->cs", pool.W, np.repeat(factors, truth.states.motions, axis=0))
        found.update(id(pool.all[k]) for k in np.flatnonzero(np.abs(changed).max(axis=1) > 1e-7 * np.abs(p).max()))
    return found


def _of_equations(
    pool: Pool, equations: Sequence[AnsweredLine], every: Sequence[AnsweredLine], against: Against
) -> tuple[list[Explanation], list[Mistake]]:
    """The explanations of all equations together; if there is none, the terms of their own that are wrong.

    ``every`` are all equations of the answer, with those that are sums of right ones; ``against`` are the mistakes that
    a right line speaks against.
    """
    exprs, P = stated(pool.truth, equations)
    found = alignments(pool.truth, exprs, P)
    if any(np.abs(a.rest).max() <= 1e-9 for a in found):
        return [], []  # what is wrong is too small to be seen in doubles
    explained = against.unopposed(first_explained(pool, found)) or against.unopposed(by_rows(pool, found))
    cost = explained[0].cost if explained else np.inf
    forgotten = undivided(pool, found)
    if forgotten is not None and forgotten.cost < cost:
        return [], [forgotten.mistake(pool.truth)]
    if explained and len(explained[0].told) == 1 and cost <= EXOTIC:
        return explained, []
    solved, Q = stated(pool.truth, every)
    more = against.unopposed(solved_from_wrong(pool, solved, Q))
    if more and more[0].cost < cost:
        explained, cost = more, more[0].cost
    if (numerators := by_numerators(pool, solved)) and sum(x.cost + 1 for _, x in numerators) - 1 < cost:
        return [], [_of_numerator(pool.truth, expr, x) for expr, x in numerators]
    own = with_known(pool, own_terms(pool, exprs, P, found), found, against)
    if own and sum(t.cost for t in own) + len(own) - 1 < cost:
        return [], [mistake_of(pool.truth, t, exprs) for t in own]
    explained = [e for e in explained if e.cost <= UNNATURAL]
    if not explained and (under := denominator(pool.truth, solved, Q)) is not None:
        return [], [under]
    return (explained, []) if explained else _of_reduced(pool, exprs)


def _of_reduced(pool: Pool, exprs: Sequence[sp.Expr]) -> tuple[list[Explanation], list[Mistake]]:
    """The explanations of an equation from which a multiplier was eliminated."""
    forces = [m.symbol for m in pool.truth.derivation.multipliers.values()]
    if not forces or len(exprs) != 1 or exprs[0].has(*forces):
        return [], []
    found, slip = of_reduced(pool, exprs[0])
    return found, [slip] if slip is not None else []


def _of_numerator(truth: Reference, expr: sp.Expr, found: Explanation | OwnTerm) -> Mistake:
    """A slip in what a row was solved for, in words."""
    if isinstance(found, OwnTerm):
        return said_of(truth, found.mistake(truth), expr)
    return said_of(truth, in_words(truth, found.told[0], None), expr)


def _named(pool: Pool, groups: Sequence[Sequence[Explanation]], kinds: Set[str]) -> NamedMistakes:
    """One mistake that explains every group, otherwise the best for each group in turn."""

    def key(t: Told) -> tuple[float, ...]:
        return pool.key(t.mistake, float(t.times))

    held = [{key(t) for e in g for t in e.told} for g in groups]

    def reach(e: Explanation) -> float:
        """The cost of an explanation, less what it spares in the other groups."""
        shared = sum(key(e.told[0]) in h for h in held) - 1 if len(e.told) == 1 else 0
        return e.cost - SPARED * shared

    chosen: list[tuple[Told, Alignment | None]] = []
    others: list[Explanation] = []
    for group in groups:
        known = {key(t) for t, _ in chosen}
        if any(len(e.told) == 1 and key(e.told[0]) in known for e in group):
            continue
        holding = [e for e in group if known & {key(t) for t in e.told}]
        best = min(
            holding or group, key=lambda e: (sum(key(t) not in known for t in e.told) if holding else 0, reach(e))
        )
        if not chosen:
            others = [e for e in group if e is not best and len(e.told) == len(best.told) == 1]
            others = beside(best, [e for e in others if reach(e) < reach(best) + SPARED])
        new = [t for t in best.told if key(t) not in known]
        chosen += [(t, best.under) for t in new if not any(is_part(pool, t, of) for of, _ in chosen)]
    wide = joined(pool, chosen)
    chosen = [(narrowed(pool, as_form(pool, t), kinds), under) for t, under in wide]
    if chosen[0][0] is not wide[0][0]:
        others = [e for e in others if e.told[0].mistake.name != chosen[0][0].mistake.name]
    every = [with_term(pool, t, a, in_words(pool.truth, t, a), kinds) for t, a in chosen]
    every[0], others = of_either(pool, every[0], chosen[0], others)
    told = _once(moved_elsewhere(pool, chosen, every), ())
    listed = [in_words(pool.truth, t, e.under) for e in others[:8] for t in e.told]
    ledgers = {e.title: e.ledger for e in pool.truth.model.elements}
    own = ledgers.get(told[0].element or "")  # in which of two bodies, two springs, … it is may be open
    elsewhere = [m for m in listed[:3] if own and m.element != told[0].element and ledgers.get(m.element or "") == own]
    more = distinct(_once([*elsewhere, *listed], told), told)
    single = len(chosen) == 1 and (chosen[0][0].mistake.wrong is not None or chosen[0][0].cost <= LIKELY)
    costs = [t.cost for t, _ in chosen]
    far = max(costs) > FAR or (len(costs) > 1 and sum(costs) > FAR_TOGETHER * len(costs))
    return NamedMistakes(told, more[:5], single, not far)


def _once(mistakes: Sequence[Mistake], told: Sequence[Mistake]) -> tuple[Mistake, ...]:
    """Every mistake once, without those that are already reported."""
    said = {str(m.what) for m in told}
    kept: list[Mistake] = []
    for m in mistakes:
        if str(m.what) not in said:
            said.add(str(m.what))
            kept.append(m)
    return tuple(kept)
