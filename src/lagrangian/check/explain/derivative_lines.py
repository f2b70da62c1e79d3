"""What a line that gives a derivative says: which term of it is wrong, and which mistakes were not made if it is right.

∂T*/∂r = m r θ̇²  below  T* = … + m A Ω r θ̇ cos θ        In ∂T*/∂r, the term m A Ω θ̇ cos θ is missing.
d/dt ∂T*/∂ṙ      right                                     What θ̇ adds to it does not count twice.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.changes.pool import Pool, Possible
from lagrangian.check.explain.factors_held import factor_held
from lagrangian.check.explain.misconceptions import product_rule
from lagrangian.check.explain.own_terms import WHY, term_replaced
from lagrangian.check.explain.spoken import in_dissipation, in_lagrangian
from lagrangian.check.explain.term_said import with_reason
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import given, index_of, right_value
from lagrangian.check.verdict import DERIVED, OWN_DERIVATIVES, AnsweredLine, Finding, Mistake
from lagrangian.model import time
from lagrangian.page.formula import Left, Minus, Name, Partial, Text, Total, text

WHY_FUNCTION = text("The derivative of a sine is the cosine, that of a cosine is minus the sine.")
WHY_COUPLED = text("d/dt turns each rate in ∂L/∂ξ̇ into an acceleration: count all of them.")
WHY_SLOPE = text("Every term that contains this coordinate counts, and everything else is held.")
WHY_POWER = text("The derivative of a square is twice what is squared, times the derivative of what is squared.")
PLAIN = (WHY, WHY_FUNCTION, product_rule.WHY, WHY_COUPLED, WHY_SLOPE, WHY_POWER)
"""What is advised where no inner derivative is known that is wrong."""
RATES, SLOPES = ("p-rate", "T-rate"), ("slope", "T-slope")
"""The kinds of lines that give d/dt ∂L/∂ξ̇, and ∂L/∂ξ; of L or of the answer's own T*."""
STEP = 5
"""The step of the derivatives."""
FORCES = 6
"""The step of the generalized forces."""
STEP_OF = {"T": 2, "V": 3}
"""The steps of the energies of which L is made."""
RESTATED = ("left_out_of_a_sum", "lost_in_a_sum", "sign_in_a_sum", "gradient_forgotten", "velocity_terms_forgotten")
"""What a missing or wrong term of a derivative would also be called."""
OF_A_PART = ("left_out", "wrong_number", "wrong_sign")
"""What is wrong in a part of a derivative; no reason for the term of which it is told."""
MOST_TERMS_TOLD = 2
"""The largest number of terms of ∂L/∂ξ̇ that are told to be wrong."""
MOST_ALIKE = 4
"""The most terms of a derivative that are told to be wrong in the same way."""
LONGEST = 200
"""A derivative with more terms is not compared term by term."""


def against_derivatives(pool: Pool, right: Sequence[AnsweredLine]) -> set[int]:
    """The possible mistakes, by their identity, that would be made in a derivative that is right."""
    said = {x for line in right if (x := _given(pool.truth, line)) is not None}
    return {id(p) for p in pool.all if part_of(pool.truth, p) in said} if said else set()


def elsewhere(truth: Reference, line: AnsweredLine, possible: Possible) -> bool:
    """Whether a mistake would be made in another derivative than the one that a line gives."""
    own, of = _given(truth, line), part_of(truth, possible)
    return own is not None and of is not None and own != of


def _given(truth: Reference, line: AnsweredLine) -> tuple[str, int] | None:
    """Which derivative of T* a line gives, and of which coordinate, by its place."""
    i = index_of(truth, line.name)
    if i is None or line.kind not in (*RATES, *SLOPES):
        return None
    return "rate" if line.kind in RATES else "slope", i


def part_of(truth: Reference, possible: Possible) -> tuple[str, int] | None:
    """In which derivative of T*, and of which coordinate, a mistake was made if its words say so."""
    parts: Sequence[object] = ()
    if possible.change is not None:
        parts = possible.change.site.words
    elif possible.wrong is not None:
        parts = possible.wrong.variant.what.parts
    for part in parts:
        whole = part.of if isinstance(part, Minus) else part
        inner = whole.of if isinstance(whole, Total) else whole
        if not isinstance(inner, Partial):
            continue
        of_rate = [i for i, c in enumerate(truth.model.coordinates) if inner.by == c.rate]
        of_place = [i for i, c in enumerate(truth.model.coordinates) if inner.by == c.symbol]
        if isinstance(whole, Total) and of_rate:
            return "rate", of_rate[0]
        return ("slope", of_place[0]) if of_place else None
    return None


def of_derivative_of(
    truth: Reference,
    line: AnsweredLine,
    lines: Sequence[AnsweredLine],
    findings: Sequence[Finding],
    told: Sequence[Mistake],
    others: Sequence[Mistake],
) -> tuple[list[Mistake], tuple[Mistake, ...]]:
    """The mistakes behind the first wrong ``line``, and second choices, in the words for a derivative if it is one.

    The term that is wrong is told; a sine in place of a cosine was differentiated wrongly. L may have its own slip.
    """
    if told and line.kind == "p":
        terms = of_differences(line, findings)
        told = sorted(told, key=lambda m: m.step == FORCES)  # no force changes a momentum
        if terms and told[0].step == FORCES:
            return [terms[0], *told], tuple(others)
        return [*([_with_slip(told[0], terms[0])] if terms else told[:1]), *told[1:]], tuple(others)
    if told and line.kind == "D":
        said = [in_dissipation(m) for m in told]
        return said, tuple(m for m in map(in_dissipation, others) if str(m.what) not in [str(x.what) for x in said])
    if told and line.kind == "L":
        right = {STEP_OF[f.line.kind] for f in findings if f.status.right and f.line.kind in STEP_OF}
        return [in_lagrangian(told[0], line) if told[0].step in right else told[0], *told[1:]], tuple(others)
    if not told or line.kind not in DERIVED:
        return list(told), tuple(others)
    found = [replace(m, why=WHY_FUNCTION) if m.name == "sine_cosine" else m for m in told]
    if (slip := slip_in(truth, line, lines)) is None:
        return found, tuple(others)
    more = [_of_own_line(truth, m, lines, findings) for m in found[1:]]
    return [_with_slip(found[0], slip), *more], tuple(
        m for m in others if m.name not in RESTATED and not _restates(m) and not (m.step == STEP and _is_of_equation(m))
    )


def _of_own_line(
    truth: Reference, mistake: Mistake, lines: Sequence[AnsweredLine], findings: Sequence[Finding]
) -> Mistake:
    """A mistake in the equation of a coordinate, told in the wrong derivative of this coordinate if there is one."""
    wrong = (f.line for f in findings if f.is_open and f.line.kind in DERIVED)
    own = [x for x in wrong if x.name == mistake.coordinate] if mistake.coordinate is not None else []
    here = _is_of_equation(mistake) or _restates(mistake)
    slip = slip_in(truth, own[0], lines) if len(own) == 1 and here else None
    return mistake if slip is None else _with_slip(mistake, slip)


def _with_slip(mistake: Mistake, slip: Mistake) -> Mistake:
    """A mistake in a derivative, told by the term of it that is wrong; the cause is a possible one, if it is any."""
    if mistake.name in RESTATED:
        return slip
    if _restates(mistake):
        return replace(mistake, what=slip.what, why=slip.why, brief=slip.brief)
    if mistake.name == "coriolis_half" and slip.name == "term_forgotten":  # none of it is there
        return replace(slip, element=mistake.element)
    formulas = [x for x in slip.what.parts if isinstance(x, sp.Expr) and not x.is_Symbol]
    if any(x in (y, -y) for x in mistake.what.parts if isinstance(x, sp.Expr) for y in formulas):
        mistake = mistake if slip.why is WHY else replace(mistake, why=slip.why)
        return replace(mistake, what=slip.what, brief=slip.brief) if _is_of_equation(mistake) else mistake
    inner = slip.why not in PLAIN
    return replace(slip, element=mistake.element) if inner else with_reason(slip.what, mistake)


def _restates(mistake: Mistake) -> bool:
    """Whether the words of a mistake say no more of a derivative than which rate's terms are wrong in it."""
    formulas = [x for x in mistake.what.parts if isinstance(x, sp.Expr)]
    return mistake.name in OF_A_PART and mistake.step == STEP and all(isinstance(x, sp.Derivative) for x in formulas)


def _is_of_equation(mistake: Mistake) -> bool:
    """Whether the words of a mistake say that it is in an equation, in which a derivative was put."""
    return any(isinstance(x, str) and x.endswith(" the equation of ") for x in mistake.what.parts)


def slip_in(truth: Reference, line: AnsweredLine, lines: Sequence[AnsweredLine]) -> Mistake | None:
    """The one term of a derivative that is wrong, against what the energies above it give; None if it is more."""
    i = index_of(truth, line.name)
    found = _derivative(truth, line, i, lines) if i is not None else None
    if i is None or found is None:
        return None
    title, own, more = found
    rest, right = ([x for x in sp.Add.make_args(bounded.expand(e)) if x != 0] for e in (more, own))
    if not rest or len(right) > LONGEST:
        return None
    above = given(truth, [x for x in lines if x.number <= line.number])
    T = above.T if above.T is not None else truth.T
    pair = replaced(rest, right) or _of_sides(truth, line, own)
    if pair is None:
        return factor_held(title, bounded.diff(T, truth.model.coordinates[i].rate), more, truth.model.coordinates, i)
    sums = sorted(T.atoms(sp.Add), key=bounded.operations)
    pair = _in_sums(pair[0], sums), _in_sums(pair[1], sums)
    name, said = term_replaced(*pair)
    first, *others = said.parts
    words = str(first)
    brief = text("A term of ", title, " is not right.")
    what = text("In ", title, ": " if words.startswith("In ") else ", ", words[:1].lower() + words[1:], *others)
    return Mistake(name, what, _why(title, *pair), 5, None, truth.model.coordinates[i].name, brief)


def _of_sides(truth: Reference, line: AnsweredLine, own: sp.Expr) -> tuple[sp.Expr, sp.Expr] | None:
    """The one term that was written and the one that belongs there, as both are read: m n d sin((n + 1) φ) for that
    times n + 1, where l = R − r and n = l/r make several terms of each; None if the sides differ in more."""
    if line.kind not in OWN_DERIVATIVES or line.sides is None:
        return None
    if not zero_everywhere(truth, truth.expand(line.sides[0]) - own):
        return None
    right, written = (sp.Add.make_args(x) for x in line.sides)
    pair = [x for x in written if x not in right], [x for x in right if x not in written]
    if not all(len(x) == 1 and not x[0].is_Add for x in pair):
        return None
    quotient = bounded.cancel(cast("sp.Expr", pair[0][0] / pair[1][0]))
    constant = not quotient.has(sp.Function, sp.Derivative) and bounded.operations(quotient) <= LONGEST
    return (cast("sp.Expr", pair[0][0]), cast("sp.Expr", pair[1][0])) if constant else None


def _why(title: Left, written: sp.Expr, right: sp.Expr) -> Text:
    """Why a term of a derivative is wrong: an inner derivative by the time that is missing, or a sine's wrong sign."""
    functions = right.atoms(sp.sin, sp.cos)
    total = isinstance(title, Total)
    if right == 0:
        return WHY
    if written == 0:
        moved = any(d.derivative_count > 1 for d in right.atoms(sp.Derivative))
        return (WHY_COUPLED if moved else product_rule.WHY) if total else WHY_SLOPE
    quotient = bounded.cancel(right / written)
    if (inside := _inside(title, written, quotient)) is not None:
        return text("The chain rule: ", inside, " has the inner derivative ", quotient, ".")
    if not functions:
        return WHY_POWER if quotient.is_number and quotient != -1 else WHY
    rates = {f: bounded.diff(cast("sp.Expr", f.args[0]), time) for f in functions}
    if quotient == -1 and (not total or any(x != 0 and right.has(x) for x in rates.values())):
        return WHY_FUNCTION
    for f in functions:
        inner = rates[f] if total else bounded.diff(cast("sp.Expr", f.args[0]), _by(title))
        if inner not in (0, 1) and bounded.expand(quotient - inner) == 0:
            angle = cast("sp.Expr", f.args[0])
            return text("The chain rule: sine and cosine of ", angle, " have the inner derivative ", inner, ".")
    return WHY


def _by(title: Left) -> sp.Expr:
    """The coordinate by which a derivative is taken; time for a total one."""
    return cast("sp.Expr", title.by) if isinstance(title, Partial) and isinstance(title.by, sp.Expr) else time


def _inside(title: Left, written: sp.Expr, missing: sp.Expr) -> sp.Expr | None:
    """The sum in a derivative by a coordinate, or by time, whose own derivative is the factor that is missing:
    a + l sin θ, or p + ½ s."""
    by = [title.by] if isinstance(title, Partial) else [x.expr for x in written.atoms(sp.Derivative)]
    sums = [f.as_base_exp()[0] for f in sp.Mul.make_args(written)]
    found = [
        x
        for x in sums
        if isinstance(x, sp.Add) and any(bounded.expand(bounded.diff(x, cast("sp.Expr", q)) - missing) == 0 for q in by)
    ]
    return found[0] if found and missing not in (1, -1) else None


def _in_sums(term: sp.Expr, sums: Sequence[sp.Expr]) -> sp.Expr:
    """A product whose sums are those of an energy, p + ½ s and not 2 p + s."""
    factors = [f.as_base_exp() for f in sp.Mul.make_args(term)]
    held = [(x, n) for x, n in factors if isinstance(x, sp.Add)]
    for x, n in held:
        for own in sums:
            if x != own and (number := bounded.cancel(x / own)).is_number:
                rest = sp.Mul(*[b**k for b, k in factors if b != x])
                return _in_sums(cast("sp.Expr", rest * number**n * own**n), [y for y in sums if y != own])
    return term


def of_differences(line: AnsweredLine, findings: Sequence[Finding]) -> list[Mistake]:
    """The terms in which ∂L/∂ξ̇ is wrong, if they are few, as one mistake."""
    finding = next(f for f in findings if f.line is line)
    if line.kind != "p" or not 0 < len(finding.differences) <= MOST_TERMS_TOLD:
        return []
    written = sp.Add(*[d.written for d in finding.differences])
    right = sp.Add(*[d.term for d in finding.differences if d.kind != "extra"])
    name, what = term_replaced(*((written, right) if right == 0 else map(sp.factor_terms, (written, right))))
    first, *more = what.parts
    title = finding.line.title
    said = text(f"In {title}, {str(first)[:1].lower()}{str(first)[1:]}", *more)
    step = 5 if any(f.line.kind in ("T", "L") and f.status.right for f in findings) else 4
    return [Mistake(name, said, WHY, step, None, finding.coordinate, text(f"A term of {title} is not right."))]


def replaced(rest: Sequence[sp.Expr], right: Sequence[sp.Expr]) -> tuple[sp.Expr, sp.Expr] | None:
    """The term that was written (0: none) and the one that belongs there (0: none), where the derivative has the terms
    ``right``, and the line has ``rest`` too much."""
    if len(rest) == 1:
        for t in right:
            if (number := bounded.cancel(rest[0] / t)).is_number:
                return cast("sp.Expr", (1 + number) * t), t
        return rest[0], sp.S.Zero
    written = sp.Add.make_args(sp.Add(*right, *rest)) if len(rest) == 2 else ()
    for more, less in (rest, rest[::-1]) if len(rest) == 2 else ():
        if -less in right and more not in right and more in written:  # two that are missing stand for nothing
            return more, -less
    return _same_number(rest, right) or _same_factor(rest, right)


def _same_factor(rest: Sequence[sp.Expr], right: Sequence[sp.Expr]) -> tuple[sp.Expr, sp.Expr] | None:
    """The same for several terms that all lack one factor, or have it too much, put together: m Ω² (a + l sin θ) for
    m Ω² (a + l sin θ) l cos θ."""
    lost = [-x for x in rest if -x in right]
    there = [x for x in rest if -x not in right]
    if not 1 < len(lost) == len(there) <= MOST_ALIKE:
        return None
    quotients = (_quotient(lost[0] / x) for x in there)
    factors = [f for f in quotients if {*lost} == {bounded.expand(f * y) for y in there}]
    if not factors or sp.Add.make_args(factors[0])[1:]:
        return None
    whole = cast("sp.Expr", sp.factor_terms(sp.Add(*there)))
    return whole, cast("sp.Expr", factors[0] * whole)


def _same_number(rest: Sequence[sp.Expr], right: Sequence[sp.Expr]) -> tuple[sp.Expr, sp.Expr] | None:
    """The same for several terms that are all wrong by one number, put together: A Ω² sin θ cos θ + m l² Ω² …."""
    if len(rest) > MOST_ALIKE:
        return None
    numbers = {n for x in rest for t in right if (n := _quotient(x / t)).is_number}
    whole = sp.factor_terms(sp.Add(*[x / n for n in numbers for x in rest])) if len(numbers) == 1 else None
    if whole is None or any(x / n not in right for n in numbers for x in rest):
        return None
    return cast("sp.Expr", (1 + numbers.pop()) * whole), cast("sp.Expr", whole)


def _quotient(expr: sp.Expr) -> sp.Expr:
    """A quotient without common factors; of products of letters it has none."""
    sums = any(isinstance(f.as_base_exp()[0], sp.Add) for f in sp.Mul.make_args(expr))
    return bounded.cancel(expr) if sums else expr


def _derivative(
    truth: Reference, line: AnsweredLine, i: int, lines: Sequence[AnsweredLine]
) -> tuple[Left, sp.Expr, sp.Expr] | None:
    """The derivative that a line gives, in words; what it is, and what the line has too much."""
    above = given(truth, [x for x in lines if x.number <= line.number])
    c = truth.model.coordinates[i]
    q, v = truth.derivation.coordinates[i], c.rate
    T = above.T if above.T is not None else truth.T
    V = above.V if above.V is not None else truth.V
    if line.kind == "T-rate":
        return Total(Partial(Name("T*"), v)), bounded.diff(T, v, time), line.expr
    if line.kind == "T-p":
        return Partial(Name("T*"), v), bounded.diff(T, v), cast("sp.Expr", -line.expr)
    if line.kind == "T-slope":
        return Partial(Name("T*"), q), bounded.diff(T, c.symbol), cast("sp.Expr", -line.expr)
    if line.kind == "V-slope":
        return Partial(Name("V"), q), bounded.diff(V, c.symbol), line.expr
    right = right_value(truth, line, i) if line.kind in ("p-rate", "slope") else None
    if right is None:
        return None
    L = Name("L")
    return (Total(Partial(L, v)) if line.kind == "p-rate" else Partial(L, q)), right, line.expr - right
