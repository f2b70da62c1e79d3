"""Lines that say what parameters amount to: m g l/2 = 1.5·9.81·0.45 = 6.622, in front of equations in numbers.

Such a line says nothing of the motion. It is right if each of its numbers is what the letters are with the values of
the system, or with those that the answer states, rounded to its last digit; otherwise it is told by its own number.
Nor is a relation of parameters an equation of motion if it holds with these values, m₁ a = m₂ b: lines in numbers need
it, and lines in letters are judged for all values in any case.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import groupby
from typing import cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.decimals import HALF, most_off
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, Verdict, inserted
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import time
from lagrangian.page.formula import Text, text
from lagrangian.records import dataclass

EXACT = 1e-9
"""The relative difference of numbers that are not rounded."""

ROUNDED = 1e-3
"""The relative difference of a number whose digits are not in the text of its line."""

FEWEST_OF_FACTORS, FEWEST, FEWEST_BEFORE_ZEROS = 100, 10, 1000
"""The smallest size, in units of its last digit, of a factor that may be rounded, 0.866 of 2·9.81·0.866; of a number
that may be; and of a whole number before zeros that may stand for other digits, 285500."""

SIGNIFICANT = 3
"""The fewest digits of what letters amount to that are told: 0.0625, not 0.06."""

LONGEST = 80
"""The largest number of operations of such a line."""

MOST_SIDES, MOST = 12, 200
"""The largest number of equations in the chain of such a line, and of such lines in an answer."""

WHY = text("Work this number out once more, and everything that it stands in.")

_NUMBER = re.compile(r"(?<![\w.,])(\d{1,30}+)(?:(?:[.,]|\{,\})(\d{1,30}+))?(?:[eE]([+-]?\d{1,2}+))?")

_PREFIXED = re.compile(r"[ \t]?([kcm])(?:m|N|g|J|s|rad)(?![\w^*²³])")
"""A unit with a prefix behind a number: 29 mm."""

_Values = Mapping[sp.Symbol, float]


@dataclass(frozen=True)
class _Written:
    """A number in the text of a line: its size and the unit of its last digit."""

    size: float
    unit: float


@dataclass(frozen=True)
class _Stated:
    """What letters amount to, ``meant``, of which the largest term is of the size ``scale``, and the number that a side
    of a line gives for it."""

    letters: sp.Expr
    meant: float
    number: float
    scale: float


def judged_with_amounts(
    truth: Reference, lines: Sequence[AnsweredLine], judge: Callable[[Sequence[AnsweredLine]], Verdict]
) -> Verdict:
    """The verdict on an answer in which lines that say what parameters amount to are no equations of motion."""
    own = truth.model.values
    given = {p.symbol: x.expr for x in lines if x.kind == "given" for p in truth.model.parameters if p.name == x.name}
    stated = own | {p: float(x) for p, x in given.items() if x.is_number and x.is_real}
    kept: list[AnsweredLine] = []
    wrong: list[Finding] = []
    off: list[float] = []
    nearly: list[Text] = []
    left = MOST
    lines = [replace(x, expr=sp.S.Zero) if _holds_in_values(truth, x, own, stated) else x for x in lines]
    for _, group in groupby(lines, key=lambda line: (line.number, line.text)):
        same = list(group)
        chain = len(same) > 1 and any(map(_is_number, same))
        few = len(same) <= min(MOST_SIDES, left)
        said = [line for line in same if _says_amount(line, own, chain=chain)] if few else []
        said = [line for line in said if np.isfinite(_amount(truth, line.expr, own))]
        left -= len(said)
        found = [_untrue(truth, same, said, values) for values in (own, stated)] if said else []
        if None not in found and None in (_untrue(truth, same, said, x, slack=True) for x in (own, stated) if found):
            nearly += [text(*x[0].parts, " Only the last digit is off, which was not counted.") for x in found[:1] if x]
            found = [None]
        if None in found:
            kept += [_as_said(line, [*said, *_links(truth, same, own)]) for line in same]
        elif found and (untrue := found[-1]) is not None:
            wrong.append(Finding(said[0], Status.WRONG, untrue[0]))
            off.append(untrue[1])
            kept += [line for line in same if not any(line is x for x in said) and not _is_number(line)]
        else:
            kept += same
    kept, told = _without_relations(truth, kept, own)
    verdict = judge(kept)
    verdict = replace(verdict, notes=(*verdict.notes, *told, *nearly)) if told or nearly else verdict
    if not wrong:
        return verdict
    findings: Sequence[Finding] = [_following(f, wrong, off) for f in verdict.findings]
    followed = any(f is not x for f, x in zip(findings, verdict.findings, strict=True))
    for finding in wrong:
        findings = inserted(findings, finding)
    motion, others = verdict.motion or verdict.right, () if followed else verdict.alternatives
    told = _mistakes(verdict, [f for f in findings if f not in verdict.findings and f.follows], findings, wrong)
    verdict = replace(verdict, mistakes=told, alternatives=others)
    return replace(verdict, status=Status.WRONG, findings=tuple(findings), motion=motion)


def _mistakes(
    verdict: Verdict, following: Sequence[Finding], findings: Sequence[Finding], wrong: Sequence[Finding]
) -> tuple[Mistake, ...]:
    """The mistakes; those that are seen only in lines that follow from wrong amounts are these amounts: nothing says
    that the energy of one of several bodies has a wrong number where a sum of numbers has."""

    def is_seen(mistake: Mistake, f: Finding) -> bool:
        if mistake.element is None:
            return mistake.coordinate is not None and mistake.coordinate == f.coordinate
        return any(o.element in mistake.element for d in f.differences for o in d.origins)

    kept: list[Mistake] = []
    for m in verdict.mistakes:
        above = any(is_seen(m, f) for f in following) and not any(f.is_open and is_seen(m, f) for f in findings)
        notes = [(f.line, f.note) for f in wrong if f.note is not None] if above else []
        said = [text(f"In {line.title}, ", *note.parts) for line, note in notes]
        brief = [text(f"A number in {line.title} is not right.") for line, _ in notes]
        kept += [Mistake("wrong_amount", x, WHY, m.step, brief=y) for x, y in zip(said, brief, strict=True)]
        kept += [] if said else [m]
    return tuple({str(m.what): m for m in kept}.values())


def _following(finding: Finding, wrong: Sequence[Finding], off: Sequence[float]) -> Finding:
    """A finding, as one that follows where the line is wrong by just the amount by which a line above is."""
    if finding.status is not Status.WRONG or len(finding.differences) != 1:
        return finding
    difference = finding.differences[0]
    lacking = bounded.expand(difference.term - difference.written)
    number, _ = lacking.as_independent(AppliedUndef, as_Add=False)
    if isinstance(lacking, sp.Add) or not number.is_number or not number.is_real:
        return finding
    size = abs(float(number))
    above = (x for f, x in zip(wrong, off, strict=True) if f.line.number < finding.line.number)
    return replace(finding, follows=finding.follows or any(abs(size - abs(x)) <= ROUNDED * abs(x) for x in above))


def _holds_in_values(truth: Reference, line: AnsweredLine, *every: _Values) -> bool:
    """Whether a line says what letters and coordinates amount to, A cos² ψ + B sin² ψ = 2 + 12 sin² ψ, and is 0 = 0
    with some of these values."""
    named = bounded.symbols(line.expr) - {time}
    known, moving = every[-1].keys(), {c.symbol for c in truth.model.coordinates}
    if line.kind != "equation" or not named or not named <= known:
        return False
    if (
        not bounded.atoms(line.expr, AppliedUndef)
        or bounded.atoms(line.expr, AppliedUndef) - moving
        or line.expr.has(sp.Derivative)
    ):
        return False
    numeric = [x for x in sp.Add.make_args(line.expr) if not x.free_symbols - {time}]
    if not numeric or truth.derivation.multipliers or bounded.operations(line.expr) > LONGEST:
        return False
    put = ({p: sp.Rational(str(v)) for p, v in values.items()} for values in every if named <= values.keys())
    return any(zero_everywhere(truth, cast("sp.Expr", line.expr.xreplace(x))) for x in put)


def _as_said(line: AnsweredLine, said: Sequence[AnsweredLine]) -> AnsweredLine:
    """A line of a true amount: nothing is left to judge of it."""
    if any(line is x for x in said):
        return replace(line, kind="definition", expr=sp.S.Zero)
    return replace(line, expr=sp.S.Zero) if _is_number(line) else line


def _says_amount(line: AnsweredLine, values: _Values, *, chain: bool) -> bool:
    """Whether a line equates letters of which all values are known with a number, which may be 0 in a ``chain`` with
    numbers: m a - m_c b = 0.016 - 0.016 = 0. Alone, m a - m_c b = 0 is a condition."""
    if not _is_of_letters(line, values):
        return False
    number = _number_in(line.expr)
    counts = number != 0 or (chain and 0 in (line.sides or ()))
    return bool(counts and number.is_real and number.is_finite) and bounded.operations(line.expr) <= LONGEST


def _is_of_letters(line: AnsweredLine, values: _Values) -> bool:
    """Whether a line is an equation of letters alone, of which all values are known."""
    named = bounded.symbols(line.expr)
    return bool(
        line.kind == "equation" and named and named <= values.keys() and not bounded.atoms(line.expr, AppliedUndef)
    )


def _links(truth: Reference, lines: Sequence[AnsweredLine], values: _Values) -> list[AnsweredLine]:
    """The true equations of letters with letters in the chain of such a line: m g l/2 = 1.5·0.45 g = 6.622."""
    found: list[AnsweredLine] = []
    for line in lines:
        if _is_of_letters(line, values):
            terms = [_amount(truth, x, values) for x in sp.Add.make_args(line.expr)]
            found += [line] if abs(sum(terms)) <= EXACT * max(map(abs, terms)) else []
    return found


def _without_relations(
    truth: Reference, lines: Sequence[AnsweredLine], values: _Values
) -> tuple[list[AnsweredLine], tuple[Text, ...]]:
    """The lines, in which relations of several parameters alone that hold with the values of the system are statements,
    and notes that say so."""
    found = [x for x in lines if len(bounded.symbols(x.expr)) > 1 and _is_of_letters(x, values)]
    found = [x for x in found if bounded.operations(x.expr) <= LONGEST]
    held = {id(x): x for x in _links(truth, found, values)}
    kept = [replace(x, kind="statement") if id(x) in held else x for x in lines]
    why = "it is a relation of parameters that holds with the values of the system, and no equation of motion"
    return kept, tuple(text(x) for x in dict.fromkeys(f"'{x.text}' was not judged: {why}." for x in held.values()))


def _number_in(expr: sp.Expr) -> sp.Expr:
    """The sum of the terms without letters."""
    return sp.Add(*(x for x in sp.Add.make_args(expr) if x.is_number))


def _is_number(line: AnsweredLine) -> bool:
    """Whether a line equates two numbers, as the rest of m g l/2 = 1.5·9.81·0.45 = 6.622 does."""
    return line.kind == "equation" and bool(line.expr.is_number and line.expr.is_real and line.expr.is_finite)


def _untrue(
    truth: Reference,
    lines: Sequence[AnsweredLine],
    said: Sequence[AnsweredLine],
    values: _Values,
    *,
    slack: bool = False,
) -> tuple[Text, float] | None:
    """What letters amount to, where the sides of a line say something else, and by how much these are wrong; None if
    they are right, where with ``slack`` the last one of many digits may be off."""
    numbers = list(_written(lines[0].text))
    stated = list(_stated(truth, lines, said, values))
    sizes = {abs(x.number) for x in stated}
    factors = [n for n in numbers if not any(_same(n.size, x) for x in (*sizes, *map(abs, values.values())))]
    loose = sum(n.unit / n.size for n in factors if n.size >= FEWEST_OF_FACTORS * n.unit) / 2
    relative = EXACT + loose if numbers and not _of_angle(said) else ROUNDED
    above: float | None = None
    for x in stated:
        digits = next((n for n in numbers if _same(n.size, abs(x.number))), None)
        near = relative * abs(x.meant)
        if digits is not None:
            rounded = most_off(digits.size, digits.unit, x.meant) if slack else HALF * digits.unit
            near = rounded if digits.size >= FEWEST * digits.unit else EXACT * abs(x.meant)
        near = max(near, EXACT * x.scale) if x.number == 0 else near
        if not abs(x.number - x.meant) <= near and (above is None or not abs(x.number - above) <= near):
            return _told(x, digits), x.number - x.meant
        above = x.number
    return None


def _of_angle(lines: Sequence[AnsweredLine]) -> bool:
    """Whether a number is that of a function of an angle, which may be rounded: tan θ₀ where θ₀ = 21.8°."""
    return any(x.args[0].is_number for line in lines for x in line.expr.atoms(sp.sin, sp.cos, sp.tan))


def _stated(
    truth: Reference, lines: Sequence[AnsweredLine], said: Sequence[AnsweredLine], values: _Values
) -> Iterator[_Stated]:
    """The numbers of the sides of a line, in order from the letters on."""
    sides = [line for line in lines if any(line is x for x in said) or _is_number(line)]
    turn = -1 if _is_number(sides[0]) else 1  # 1.5·9.81·0.45 = 6.622 = m g l/2
    last: _Stated | None = None
    for line in sides[::turn]:
        expr = turn * line.expr
        if _is_number(line):
            if last is not None:
                last = replace(last, number=last.number - float(expr))
                yield last
            continue
        number = _number_in(expr)
        letters = expr - number
        scale = max(abs(_amount(truth, x, values)) for x in sp.Add.make_args(letters))
        last = _Stated(letters, _amount(truth, letters, values), -float(number), scale)
        yield last


def _amount(truth: Reference, expr: sp.Expr, values: _Values) -> float:
    put: dict[sp.Basic, Array] = {p: np.full(truth.states.size, float(v)) for p, v in values.items()}
    return float(CompiledExpressions([expr]).at(truth.states, put)[0, 0])


def _written(line: str) -> Iterator[_Written]:
    """The numbers in the text of a line."""
    for found in _NUMBER.finditer(line):
        whole, fraction, power = found[1], found[2] or "", int(found[3] or 0)
        zeros = len(whole) - len(whole.rstrip("0")) if not fraction else 0
        size, unit = float(f"{whole}.{fraction or 0}e{power}"), 10.0 ** (power - len(fraction))
        unit *= 10**zeros if size >= FEWEST_BEFORE_ZEROS * unit * 10**zeros else 1
        prefix = _PREFIXED.match(line, found.end())
        scale = {"k": 1e3, "c": 1e-2, "m": 1e-3}[prefix[1]] if prefix is not None else 1.0
        yield _Written(size, unit)
        if scale != 1:
            yield _Written(size * scale, unit * scale)


def _same(a: float, b: float) -> bool:
    return abs(a - b) <= 1e-12 * abs(b)


def _told(stated: _Stated, digits: _Written | None) -> Text:
    """What letters amount to, with as many digits as the number that an answer gives: m g l/2 is 6.62, not 7.62."""
    sign = -1 if stated.letters.could_extract_minus_sign() else 1
    meant, number = sign * stated.meant, sign * stated.number + 0.0  # 0, and not -0
    what = sign * stated.letters
    roots = [x for x in what.atoms(sp.Pow) if x.is_number and x.is_positive and abs(x.args[1]) == sp.S.Half]
    if roots:  # sin 12° is one of roots in roots
        rounded = {x: sp.Rational(str(float(x))) for x in roots}
        factor, rest = bounded.expand(cast("sp.Expr", what.xreplace(rounded))).as_coeff_Mul()
        what = sp.Float(f"{float(factor):.4g}") * rest
    if digits is None:
        return text(what, f" is {meant:.6g}, not {number:.6g}.")
    places = max(0, round(-np.log10(digits.unit)))
    given = f"{number:.{places}f}"
    more = next((k for k in range(places, places + 9) if f"{meant:.{k}f}" != given), places)
    long = max(more, SIGNIFICANT - 1 - int(np.floor(np.log10(abs(meant) or 1.0))))
    told = next(x for k in range(more, long + 1) if float(x := f"{meant:.{k}f}") == float(f"{meant:.{long}f}"))
    return text(what, f" is {told}, not {given}.")
