"""Finds the definition whose right value puts the lines right that use it: a_x = l θ̈ cos θ + l θ̇² sin θ, then m a_x.

What a name adds to the equations is not known where it stands in the balance of another body. So the answer is read
without its definition, and judged with the right quantity in its place.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias, cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.constraints.eliminated import unknown_in
from lagrangian.check.coordinates.auxiliary import with_auxiliary
from lagrangian.check.explain.at_places import changes, proportional_at_places
from lagrangian.check.explain.bodies_said import Blamed
from lagrangian.check.explain.combined_rows import is_mass
from lagrangian.check.explain.definitions import with_wrong_definitions
from lagrangian.check.explain.its_body import of_its_body
from lagrangian.check.explain.meant import kinds_of
from lagrangian.check.explain.quoted import letters_in
from lagrangian.check.explain.reasoned import says_again
from lagrangian.check.explain.said_wrongly import SaidWrongly, right_quantities, said_of
from lagrangian.check.explain.shorthands import is_shorthand, right_values
from lagrangian.check.explain.slip_in_definition import slips_in_definition
from lagrangian.check.explain.term_said import with_reason
from lagrangian.check.explain.wrong_balance import balances_agree
from lagrangian.check.held import held
from lagrangian.check.lines import filled, lines_of
from lagrangian.check.reading import Answer
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, Verdict, keys_of
from lagrangian.derive.sampling import SETS, CompiledExpressions
from lagrangian.errors import ParseError
from lagrangian.model import time
from lagrangian.read.letters import key

_OF_A_LINE = re.compile(r"\bequations?\b|\b[Ll]ine \d")
"""What words say of a line in which something is wrong."""
MOST_NAMES = 3
"""The most definitions that are left out in turn."""
MOST_VALUES = 8
"""The most right quantities that are put in the place of one."""
HIGHEST = 2
"""The highest derivative of a name that is replaced."""

Judge: TypeAlias = Callable[[Answer], Verdict]
"""The verdict on an answer."""


def with_wrong_name(
    truth: Reference, lines: Sequence[AnsweredLine], answer: Answer, judge: Judge, verdict: Verdict
) -> Verdict:
    """The verdict on a wrong answer, in which a definition of a quantity of the system is the mistake if the first
    wrong line is right with the right quantity in its place."""
    open_ones = _open(verdict)
    if verdict.hint == 0 or not open_ones:
        return verdict
    for line in list(_in_question(truth, lines, open_ones[0].line))[:MOST_NAMES]:
        if not (values := _values(truth, line)) or (again := _without(line, lines, answer)) is None:
            continue
        symbol, others = again
        copied = [x.rhs for x in answer.lines if (x.place.line, x.name) == (line.number, line.name) and x.rhs.is_Add]
        for value, same in values:
            put = _with(others, {symbol: value, **dict.fromkeys(copied, value)})  # what was copied is put right as well
            if _may_mend(truth, open_ones[0].line, put) and (mended := _mended(truth, verdict, judge(put), put)):
                return _blamed(truth, verdict, of_its_body(truth, lines, same), mended)
    found = _with_slip(truth, lines, answer, judge, verdict)
    return _with_wrong_shorthand(truth, lines, answer, judge, verdict) if found is verdict else found


def _with_slip(
    truth: Reference, lines: Sequence[AnsweredLine], answer: Answer, judge: Judge, verdict: Verdict
) -> Verdict:
    """The verdict with a definition in which one term is wrong that the first wrong line cannot have of itself."""
    first = _open(verdict)[0]
    for line in list(_in_question(truth, lines, first.line))[:MOST_NAMES] if len(first.differences) == 1 else ():
        if (again := _without(line, lines, answer)) is None:
            continue
        symbol, others = again
        for own in _as_read(truth, others, first.line, symbol)[:1]:
            for said in slips_in_definition(truth, line, first.differences, symbol, own):
                put = _with(others, {symbol: cast("sp.Expr", said.right)})
                alone = len(_open(verdict)) == 1 and not _is_used_in_right(line, verdict)
                if mended := [first.line] if alone else _mended(truth, verdict, judge(put), put):
                    return _blamed(truth, replace(verdict, mistakes=()), said, mended)
    return verdict


def _is_used_in_right(line: AnsweredLine, verdict: Verdict) -> bool:
    """Whether a right line has the name of a definition, with the value that it has."""
    return any(f.status.right and key(str(line.name)) in f.line.names for f in verdict.findings)


def _as_read(truth: Reference, answer: Answer, first: AnsweredLine, symbol: sp.Expr) -> list[AnsweredLine]:
    """The line that is wrong as another reading has it, with the symbol of a name in it."""
    own = [x for x in filled(truth, lines_of(answer)) if x.number == first.number and x.text == first.text]
    return [x for x in own if (x.kind, x.name) == (first.kind, first.name) and x.expr.has(symbol)]


def _with_wrong_shorthand(
    truth: Reference, lines: Sequence[AnsweredLine], answer: Answer, judge: Judge, verdict: Verdict
) -> Verdict:
    """The verdict with a shorthand of constants that one slip makes wrong, if the lines with it are right without."""
    first = _open(verdict)[0].line
    known = {x.line.number for x in verdict.findings if x.status is Status.WRONG and x.line.kind == "definition"}
    asked = [x for x in _in_question(truth, lines, first) if is_shorthand(truth, x) and x.number not in known]
    for line in asked[:MOST_NAMES]:
        again = _without(line, lines, answer)
        if again is None and line.expr.is_Add:  # Me may be M e without it: its value is replaced
            again = line.expr, answer
        if again is None:
            continue
        symbol, others = again
        own = _as_read(truth, others, first, symbol)
        for value, same in right_values(truth, line, own[0], symbol) if own else ():
            put = _with(others, {symbol: value})
            if mended := _mended(truth, verdict, judge(put), put):
                told = next(iter(verdict.mistakes), None) if len(verdict.mistakes) == 1 else None
                told = None if told is None or told.element is None else told
                return _blamed(truth, replace(verdict, mistakes=()), same[0], mended, told)
    return verdict


def _open(verdict: Verdict) -> list[Finding]:
    """The findings that are wrong and follow from none, but for those of definitions."""
    return [f for f in verdict.open_findings if f.line.kind != "definition"]


def _in_question(truth: Reference, lines: Sequence[AnsweredLine], first: AnsweredLine) -> Iterator[AnsweredLine]:
    """The definitions whose names the first wrong line uses, itself or by others, and that are right for nothing."""
    named = [x for x in lines if x.kind == "definition" and x.name]
    used = set(first.names)
    for _ in named:
        more = set[str]().union(*(x.names for x in named if key(str(x.name)) in used))
        if more <= used:
            break
        used |= more
    for x in named:
        if key(str(x.name)) in used and not right_quantities(truth, x, but=True):
            yield x


def _values(truth: Reference, line: AnsweredLine) -> list[tuple[sp.Expr, list[SaidWrongly]]]:
    """The values that a name may have been meant to have, and of what each is the value; the likeliest first, those
    with the letters that are written. A constant l = R + r that has no mass, and of whose name nothing is known, is
    meant as none of them."""
    alike: dict[sp.Expr, list[SaidWrongly]] = {}
    letters = bounded.letters(truth.expand(line.expr))
    constant = letters <= {p.symbol for p in truth.model.parameters} and kinds_of(str(line.name)) is None
    if constant and not any(is_mass(truth, cast("sp.Symbol", x)) for x in letters):
        return []
    for said in said_of(truth, line):
        if said.right is not None:
            alike.setdefault(said.right, []).append(said)
    written = _parts(truth.expand(line.expr))
    return sorted(alike.items(), key=lambda x: len(_parts(x[0]) ^ written))[:MOST_VALUES]


def _parts(expr: sp.Expr) -> set[sp.Basic]:
    """The letters and rates in an expression."""
    return letters_in(expr) | expr.atoms(sp.Derivative)


def _without(line: AnsweredLine, lines: Sequence[AnsweredLine], answer: Answer) -> tuple[sp.Expr, Answer] | None:
    """The symbol of a name without its definition, and the answer with it; None if it cannot be had."""
    assert answer.read_without is not None
    try:
        again = answer.read_without(frozenset([line.number]))
    except ParseError:
        return None
    symbols = {key(u.name): u.symbol for u in again.unknown}
    own = symbols.get(key(str(line.name)))
    if own is None:
        return None
    beside = [x for x in lines if x.number == line.number and x is not line and x.kind == "definition"]
    said = {symbols[key(str(x.name))]: x.expr for x in beside if key(str(x.name)) in symbols}
    kept = tuple(x for x in answer.lines if x.place.line == line.number and x.kind != "definition")
    unknown = tuple(u for u in again.unknown if u.symbol not in (own, *said))
    return own, replace(_with(again, said), lines=(*kept, *_with(again, said).lines), unknown=unknown)


def _with(answer: Answer, values: Mapping[sp.Expr, sp.Expr]) -> Answer:
    """An answer with values in place of symbols, or of sums."""
    lines = list(answer.lines)
    for symbol, value in values.items():
        lines = [
            replace(x, lhs=None if x.lhs is None else _put(x.lhs, symbol, value), rhs=_put(x.rhs, symbol, value))
            for x in lines
        ]
    return replace(answer, lines=tuple(lines))


def _put(expr: sp.Expr, symbol: sp.Expr, value: sp.Expr) -> sp.Expr:
    """An expression with a value in place of a symbol, and its rates in place of those of the symbol."""
    table: dict[Any, sp.Expr] = {symbol: value}
    if isinstance(symbol, AppliedUndef):
        table |= {sp.Derivative(symbol, (time, k)): bounded.diff(value, *[time] * k) for k in range(1, HIGHEST + 1)}
    return cast("sp.Expr", bounded.replaced(expr, table))


def _may_mend(truth: Reference, first: AnsweredLine, put: Answer) -> bool:
    """Whether the first wrong line may be right: an equation in names of the system holds along the right motion, and
    an energy differs from the right one by a constant."""
    alone = replace(put, lines=tuple(x for x in put.lines if x.place.line == first.number and x.text == first.text))
    exprs = [x.expr for x in filled(truth, lines_of(alone)) if x.kind == first.kind]
    on = held(truth) if truth.derivation.multipliers else truth
    if len(exprs) != 1 or on is None or bounded.letters(exprs[0]) - truth.names - {time}:
        return True
    if first.kind in ("T", "V", "L") and on is truth:
        return _keeps_energy(truth, exprs[0], truth.energies[first.kind])
    if first.kind != "equation":
        return True
    compiled = CompiledExpressions(exprs)
    values, scale = compiled.at(on.states, on.accelerations)[0], np.abs(compiled.at(on.states)[0]).max()
    return not np.isfinite(values).all() or bool(np.abs(values).max() <= 1e-6 * (1 + scale))


def _keeps_energy(truth: Reference, own: sp.Expr, right: sp.Expr) -> bool:
    """Whether an energy differs from the right one by the same at all states of a set of parameters."""
    both = CompiledExpressions([own, right]).at(truth.states)
    if not np.isfinite(both).all():
        return True
    apart = (both[0] - both[1]).reshape(SETS, -1)
    return bool(np.abs(apart - apart[:, :1]).max() <= 1e-6 * (1 + np.abs(both[1]).max()))


def _mended(truth: Reference, verdict: Verdict, found: Verdict, put: Answer) -> list[AnsweredLine]:
    """The wrong lines that are right with another value; none if the first of all is not among them, or more are wrong.

    A balance with forces of the answer's own is right if there are forces with which all balances hold, or if all lines
    are right into which its force was put.
    """
    before, now, right = _at(verdict, right=False), _at(found, right=False), _at(found, right=True)
    lines = filled(truth, with_auxiliary(truth, lines_of(put)))
    agree = balances_agree(truth, lines)
    own = unknown_in(truth, lines) if agree else set()
    balances = {(x.number, x.text) for x in lines if x.expr.has(*own)} if own else set()
    now = {at: x for at, x in now.items() if at[:2] not in balances}
    solved = {(x.number, x.text) for x in lines if x.kind == "definition" and _is_used_rightly(x, found)}
    apart = {at: x for at, x in before.items() if at not in right and at[:2] in balances | solved}
    mended = [x for at, x in before.items() if at in right or at in apart]
    first = _open(verdict)[0].line
    return mended if now.keys() < before.keys() and any(x is first for x in mended) else []


def _is_used_rightly(line: AnsweredLine, verdict: Verdict) -> bool:
    """Whether all lines with the name of a definition are right, and there are some."""
    users = [f for f in verdict.findings if key(str(line.name)) in f.line.names and f.line.kind != "definition"]
    return bool(users) and all(f.status.right for f in users)


def _at(verdict: Verdict, *, right: bool) -> dict[tuple[int, str, int], AnsweredLine]:
    """The lines that are right, or wrong, by what identifies them."""
    lines = [f.line for f in verdict.findings]
    statuses = (f.status.right if right else f.status is Status.WRONG for f in verdict.findings)
    return {at: x for at, x, yes in zip(keys_of(lines), lines, statuses, strict=True) if yes}


def _blamed(
    truth: Reference,
    verdict: Verdict,
    said: SaidWrongly,
    mended: Sequence[AnsweredLine],
    reason: Mistake | None = None,
) -> Verdict:
    """The verdict with a wrong definition, from which the lines follow that its right value mends, and those that are
    wrong as these are; the ``reason`` is one of these."""
    below = [f.line for f in _open(verdict) if not any(f.line is x for x in mended)]
    below = [x for x, follows in zip(below, _wrong_alike(truth, mended, below), strict=True) if follows]
    later = [f.line for f in verdict.findings if f.follows]
    findings = with_wrong_definitions(verdict.findings, Blamed((said,), (*mended, *below, *later)))
    told = verdict.mistakes if _open(replace(verdict, findings=findings)) else ()
    same = [m for m in told if says_again(m, said.mistake)]
    first = next(
        (m for m in same if m.name == said.mistake.name), said.mistake
    )  # of an energy, in which no sense shows
    told = tuple(m for m in told if not any(m is x for x in same))
    if reason is not None and _OF_A_LINE.search(str(reason.what)):
        first = replace(first, step=reason.step, element=reason.element)  # the line is right as it is written
    elif reason is not None:
        first = replace(with_reason(first.what, reason), name=first.name, brief=first.brief)
    return replace(verdict, findings=findings, mistakes=(first, *told), alternatives=(), sure=True)


def _wrong_alike(truth: Reference, mended: Sequence[AnsweredLine], lines: Sequence[AnsweredLine]) -> list[bool]:
    """Whether each of some equations is wrong by a multiple of what one that is mended is, at every position."""
    on = held(truth) if truth.derivation.multipliers else truth
    known = [x for x in mended if x.kind == "equation"]
    if on is None or not known or not lines:
        return [False] * len(lines)
    values = CompiledExpressions([x.expr for x in (*known, *lines)]).at(on.states, on.accelerations)
    if not np.isfinite(values).all():
        return [False] * len(lines)
    blocks = values.reshape(len(values), -1, on.states.motions)
    theirs = [x for x in blocks[: len(known)] if changes(x)]
    own = zip(lines, blocks[len(known) :], strict=True)
    return [x.kind == "equation" and any(proportional_at_places(y, rest) for y in theirs) for x, rest in own]
