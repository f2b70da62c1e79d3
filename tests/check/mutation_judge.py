"""Judges by SymPy alone whether what is told of a mutation is true: with the claim undone, the equation holds."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import sympy as sp

from lagrangian.check.verdict import Mistake, Verdict
from mutations import Mutation, Mutator

UNDONE = {
    r"^ (is|are) missing": 1,
    r"^ (is|are) too much|^ does not belong there": -1,
    r"^ counts? twice": -1,
    r"^ counts? half": sp.S.Half,
}
"""What is said of a term of the right equation, and how much of it brings a wrong row back to the right one."""

AGAINST = {
    "drop": r"wrong sign|twice|too much|not belong",
    "sign": r"twice|half",
    "double": r"left out|wrong sign|half",
    "half": r"wrong sign|(?<!½ counts )twice|too much|not belong",
    "not squared": r"wrong sign|too much|not belong|twice",
    "squared": r"wrong sign|twice",
}
"""What would be false to say after an operation, if nothing more can be computed from the words."""


def judged(mutator: Mutator, mutation: Mutation, verdict: Verdict) -> str:
    """What is told of a mutation: "proved", "fits", "false", "nothing", or "two" if two mistakes are told for the one.

    Proved: what is said of a term, undone in the answer, makes the equation right. Fits: the equation, the element and
    the kind of the mistake are those of the mutation.
    """
    told = verdict.mistakes
    if not told:
        return "nothing"
    if len(told) > 1:
        return "two"
    known = list(_proofs(mutator, mutation, told[0]))
    if known:
        return "proved" if any(known) else "false"
    return "fits" if _fits(mutator, mutation, told[0]) else "false"


def _fits(mutator: Mutator, mutation: Mutation, mistake: Mistake) -> bool:
    model, d = mutator.model, mutator.derivation
    whole = isinstance(mutation.old, sp.Add) and mutation.old == mutation.term  # half of one side is twice the other
    if not whole and re.search(AGAINST.get(mutation.operation, "$^"), str(mistake.what)):
        return False
    if mutation.kind != "equation":
        return mistake.coordinate is None
    if mistake.coordinate is not None and mistake.coordinate != model.coordinates[mutation.row].name:
        return False
    of_term = [t for t in d.terms[mutation.row] if t.expr in (mutation.term, -mutation.term)]
    blamed = {e for t in of_term or d.terms[mutation.row] for e in t.elements}
    letters = (mutation.new - mutation.old).free_symbols
    blamed |= {e for row in d.terms for t in row for e in t.elements if t.expr.free_symbols & letters}
    return mistake.element is None or any(e in blamed for e in mistake.element.split(" or "))


def _proofs(mutator: Mutator, mutation: Mutation, mistake: Mistake) -> Iterator[bool]:
    """Whether the answer is right with each claim about a term undone; nothing if the words hold no such claim."""
    if mutation.form == "solved":
        if mistake.name == "denominator":
            yield _is_denominator(mutator, mutation, mistake)
        return
    parts = list(mistake.what.parts)
    if len(parts) < 3 or parts[0] not in ("The term ", "In the term ", "The terms "):
        return
    for change in _corrections(mutator, parts):
        if mutation.kind == "equation":
            yield _right_rows(mutator, mutation, parts, change)
        else:
            right: Any = mutator.derivation.T if mutation.kind == "T" else mutator.derivation.V
            rest = mutator.model.expand(mutation.lines[mutation.kind] + change - right, constants=True)
            yield all(mutator.zero(rest.diff(x)) for c in mutator.model.coordinates for x in (c.symbol, c.rate))


def _is_denominator(mutator: Mutator, mutation: Mutation, mistake: Mistake) -> bool:
    """Whether the numerators of which it speaks are right: (their own) / (true acceleration · det M) is constant."""
    a = [c.acceleration for c in mutator.model.coordinates]
    M, rest = sp.linear_eq_to_matrix([lhs - rhs for lhs, rhs in mutator.sides], a)
    true = M.LUsolve(rest)
    for i, line in enumerate(mutation.lines):
        if not any(part == a[i] for part in mistake.what.parts):
            continue
        numerator = sp.fraction(sp.together(line.rhs))[0]
        ratio = numerator / (true[i] * M.det())
        letters = sorted({*ratio.free_symbols, *(u.symbol for u in mutator.model.inputs)} - {mutator.t}, key=str)
        fixed = {x: sp.Rational(k + 3, 7) for k, x in enumerate(letters)}
        values = []
        for k in range(3):
            moving = {}
            for n, c in enumerate(mutator.model.coordinates):
                moving |= {c.rate: sp.Rational(2 * k + n + 1, 5), c.symbol: sp.Rational(3 * k - n + 1, 4)}
            at_rates = ratio.xreplace({c.rate: moving[c.rate] for c in mutator.model.coordinates})
            values.append(float(at_rates.xreplace(moving).xreplace(fixed).evalf(30)))
        if max(values) - min(values) > 1e-9 * max(map(abs, values)):
            return False
    return True


def _corrections(mutator: Mutator, parts: list[Any]) -> Iterator[sp.Expr]:
    """What must be added to a wrong line, as the words say; several if the words leave open what is meant."""
    t, rest = parts[1], parts[2:]
    words = "".join(x if isinstance(x, str) else "§" for x in rest)
    named = [x for x in rest if not isinstance(x, str)]
    others = [x for x in named if x not in mutator.q] or named  # a factor may be a coordinate
    verbs = "is|are|has|have|counts?|stands?|should|there|does"
    words = re.sub(rf"^ of (the equation of §|[^.,]*?)(?= ({verbs}) )", "", words)
    for pattern, number in UNDONE.items():
        if re.search(pattern, words):
            yield number * t
    if re.search(r"^ (has|have) the wrong sign", words):
        yield from (2 * t, -2 * t)
    if re.search(r"^ (stands where|should be)", words):
        yield others[0] - t
    if re.search(r"factor § too much|divisor § is missing", words):
        yield from (t / others[0] - t, t - t * others[0])
    elif re.search(r"factor § is missing|divisor § too much", words):
        yield from (t * others[0] - t, t - t / others[0])


def _right_rows(mutator: Mutator, mutation: Mutation, parts: list[Any], change: sp.Expr) -> bool:
    """Whether all equations hold with the change in the mutated one, or in the energy of which the words speak."""
    rows = [e.lhs - e.rhs for e in mutation.lines]
    words = "".join(x for x in parts if isinstance(x, str)).partition("A possible reason")[0]
    energy = 1 if "kinetic energy" in words else -1 if re.search(r"weight of|energy of", words) else 0
    for i, c in enumerate(mutator.model.coordinates):
        if energy:
            extra = sp.diff(change.diff(c.rate), mutator.t) - change.diff(c.symbol)
            rows[i] += energy * extra * _scale(mutator, mutation, i)
        elif i == mutation.row:
            rows[i] += change
    return all(mutator.true(row) for row in rows)


def _scale(mutator: Mutator, mutation: Mutation, i: int) -> sp.Expr:
    """By what an equation was multiplied after the mutation."""
    return mutation.scales[i] if mutation.scales else sp.S.One
