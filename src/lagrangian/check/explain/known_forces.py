"""Tells which known forces a body's own balance, with forces of the answer's own beside them, has wrongly.

Where all that is known in a line is right, only its own forces can be wrong in it: a sign, an arm.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from dataclasses import replace
from functools import lru_cache
from itertools import product

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.all_forces import letters_of_gravity
from lagrangian.check.explain.combined_rows import MOST_TERMS, WrongTerm, is_mass, own_terms_of, stands_in
from lagrangian.check.explain.free_bodies import Match, free_bodies, proportional
from lagrangian.check.held import held
from lagrangian.check.reference import Reference, terms
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, Verdict, inserted
from lagrangian.derive.sampling import SETS, Array, CompiledExpressions
from lagrangian.model import Damper, Element, Force, Spring, Torque, time
from lagrangian.page.formula import Text, text
from lagrangian.read.letters import key
from lagrangian.records import dataclass

MOST_LETTERS = 12
"""The most letters that may be a factor of a force."""
MOST_LAWS = 6
"""The most springs and dampers of which a name may be the force."""
WHY = text("A spring's force is its stiffness times its own deflection, a damper's its constant times the rate of it.")
WHY_RATES = text(
    "Not only second derivatives accelerate a body: what goes in a circle has a centripetal acceleration, and a body "
    "that turns about several axes has the terms with products of rates of Euler's equations."
)
LONGEST_MOMENT = 12
"""The most operations of a moment that is written out."""
NEAR = 1e-8
"""The relative size of what is rounding."""
NUMBERS = tuple(sign * sp.Rational(p, q) for p in range(1, 9) for q in range(1, 9) for sign in (1, -1))
"""The numbers by which a line may be multiplied, or a force be wrong."""
TIMES: dict[sp.Expr, str] = {sp.Integer(2): "twice", sp.S.Half: "half"}


@dataclass(frozen=True, eq=False)
class KnownPart:
    """Whether all known forces of a line are right, whether it is a moment, what is said of a force that is not, its
    element if it is one, by how much the line is wrong at every state, the elements that act in it, and the term as it
    is written. It is ``tentative``, and no cause unless the other lines agree, where a force may be in one of the
    answer's own or products of rates are missing, ``shared`` where other bodies may have the rest of it;
    ``why`` is what is advised, if it is no force."""

    right: bool
    moment: bool
    said: Text | None = None
    element: Element | None = None
    excess: Array | None = None
    acting: frozenset[Element] = frozenset()
    term: WrongTerm | None = None
    tentative: bool = False
    shared: bool = False
    why: Text | None = None

    def may_lack(self, truth: Reference, term: sp.Expr) -> bool:
        """Whether a line with right known forces may still lack a term: one of an element that is not known to act."""
        others = (e for e in truth.model.elements if e not in self.acting and isinstance(e, (Spring, Damper)))
        sizes = (e.k if isinstance(e, Spring) else e.b for e in others)
        return any(truth.expand(x).free_symbols & term.free_symbols for x in sizes if x is not None)


def known_parts(
    truth: Reference,
    lines: Sequence[AnsweredLine],
    forces: Sequence[sp.Basic],
    named: Set[str] = frozenset(),
) -> dict[int, KnownPart]:
    """What is known in those of some lines that are balances of bodies, by the place of the line.

    ``named`` are the keys of names with accelerations in them: what a line with one of them lacks may be lacking there.
    """
    none = dict.fromkeys(forces, np.zeros(truth.states.size))
    bodies = free_bodies(truth)
    factors, alike = _factors(truth), _alike(truth)
    matches: dict[int, Match] = {}
    for i, x in enumerate(lines):
        found = [m for m in bodies.matches(x.expr, none) if _is_plain(m, _factor(factors, m.scale), alike)]
        if found:
            matches[i] = min(found, key=lambda m: (len(m.wrong), len(m.omitted)))
    explicit = {e for m in matches.values() for e in m.counts if e not in m.omitted and e not in m.wrong}
    own = {i: bool(forces) and lines[i].expr.has(*forces) for i in matches}
    told = {i: _part(truth, factors, lines[i], m, explicit, own=own[i]) for i, m in matches.items()}
    others = {
        i: _without_rates(truth, x, none) for i, x in enumerate(lines) if i not in matches and not named & x.names
    }
    return told | {i: part for i, part in others.items() if part is not None}


def _without_rates(truth: Reference, line: AnsweredLine, none: Mapping[sp.Basic, Array]) -> KnownPart | None:
    """What is known of a line that has the accelerations of some bodies and no term with products of rates: −N = B ω₂′
    for −N = B ω₂′ − (B − A) ω₃ ω₁."""
    bodies = free_bodies(truth)
    if (found := bodies.without_rates(line.expr, none)) is None:
        return None
    balance, scale = found
    factor = plain_scale(truth, scale)
    if factor is None:
        return None
    whole = bounded.expand(factor * balance.of_rates(bodies.accelerations))
    lacking = bounded.factored(whole) or whole
    what = text(f"In {line.title}, the term ", lacking, " is missing.")
    excess = -CompiledExpressions([factor]).at(truth.states)[0] * balance.turned
    term = WrongTerm(lacking, sp.oo)
    return KnownPart(False, balance.moment, what, excess=excess, term=term, tentative=True, why=WHY_RATES)


def _part(
    truth: Reference,
    factors: Mapping[sp.Expr, Array],
    line: AnsweredLine,
    match: Match,
    explicit: set[Element],
    *,
    own: bool,
) -> KnownPart:
    """What is known in one line; a spring that other lines have under its own letter is missing in it."""
    moment = match.balance.moment
    missing = [e for e in match.omitted if e in explicit and isinstance(e, (Spring, Damper))]
    if match.wrong:
        listed = {e: _factor(factors, x) for e, x in match.wrong.items()}
        times = next(iter(listed.values()))
        if times is None or len(set(listed.values())) > 1:
            return KnownPart(False, moment)
        part = _said(line, match, list(listed), _wrong_by(times, several=len(listed) > 1))
        shared = listed.keys() <= match.balance.shared and bool(times.is_number and times.is_positive)
        part = replace(part, shared=shared)
        return replace(part, term=_term(truth, line, match, times)) if len(listed) == 1 else part
    alone = _factor(factors, match.scale) in (1, -1)
    if missing:
        return _said(line, match, missing, _missing(match, missing, alone=alone))
    if match.omitted and own:
        words = _missing(match, match.omitted, alone=alone)
        return replace(_said(line, match, match.omitted, words), tentative=True)
    return KnownPart(not match.omitted, moment, acting=frozenset(match.counts))


def _missing(match: Match, elements: Sequence[Element], *, alone: bool) -> list[str | sp.Expr]:
    """That forces are missing; of one in a balance of moments that is not multiplied, also its moment."""
    if len(elements) > 1:
        return ["are missing"]
    moment = match.balance.formula(elements[0]) if match.balance.moment and alone else sp.S.Zero
    if moment == 0 or moment.is_Atom or bounded.operations(moment) > LONGEST_MOMENT:
        return ["is missing"]
    return ["is missing; its moment is ", -moment if moment.could_extract_minus_sign() else moment]


def plain_scale(truth: Reference, values: Array) -> sp.Expr | None:
    """A plain factor by which a line may be multiplied, from its values for every set of parameters."""
    return _factor(_factors(truth), values)


def _is_plain(match: Match, scale: sp.Expr | None, alike: set[sp.Expr]) -> bool:
    """Whether a line may be such a multiple of a balance: any plain one if its forces are the same multiple, otherwise
    by letters, or that of one of several bodies that are ``alike``."""
    if scale is None:
        return False
    anchored = any(e not in match.wrong and e not in match.omitted for e in match.counts)
    return anchored or abs(scale.as_coeff_Mul()[0]) in alike


def _alike(truth: Reference) -> set[sp.Expr]:
    """1, and 1/4 where the mass of a body is 4 m_w: four wheels."""
    sizes = [x for b in truth.model.bodies for x in (b.mass, *(y for row in b.tensor for y in row))]
    numbers = {abs(sp.sympify(x).as_coeff_Mul()[0]) for x in sizes}
    return {sp.S.One, *(1 / n for n in numbers if n.is_Integer and n > 1)}


def _term(truth: Reference, line: AnsweredLine, match: Match, times: sp.Expr) -> WrongTerm | None:
    """The term of a line that a wrong force is, if it is one and no name stands for it there."""
    (element,) = match.wrong
    own = own_terms_of(line.expr) if terms(line.expr) <= MOST_TERMS else []
    values = CompiledExpressions(own).at(truth.states) if own else []
    share = match.share(element)
    size = NEAR * np.abs(share).max()
    same = [t for t, x in zip(own, values, strict=True) if np.abs(x - share).max() <= size]
    return WrongTerm(same[0], 1 / times) if same and stands_in(same[0], line) else None


# -- definitions ------------------------------------------------------------------------------------------------------


def weighs(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a definition has masses, weights, inputs, or unknown names: a_x = l θ″ and F = k (y − s) have none."""
    model = truth.model
    inert = {p.symbol for p in model.parameters if is_mass(truth, p.symbol)}
    known = {x.symbol for x in (*model.parameters, *model.coordinates)}
    letters = bounded.letters(line.expr)
    return bool(letters & (inert | letters_of_gravity(truth)) or letters - known - {time})


def with_wrong_law(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict | None:
    """The verdict with a name that is meant to be the force of springs and dampers, F = k (y − s) + d ẏ, and is another
    one, and what is wrong by it; None if there is none. Balances are right with the right force alone.

    Where the answer is explained, the law is wrong if other lines are by a multiple of what it is.
    """
    found = [(x, right) for x in lines if (right := _right_law(truth, x)) is not None]
    if not found:
        return None
    line, (titles, effort) = found[0]
    kept = tuple(f for f in verdict.findings if (f.line.number, f.line.text) != (line.number, line.text))
    follow = _wrong_by_law(truth, line.expr - effort, kept)
    if verdict.mistakes and not follow:
        return verdict
    kept = tuple(replace(f, follows=True, differences=()) if f in follow else f for f in kept)
    findings = tuple(inserted(kept, Finding(line, Status.WRONG)))
    if verdict.mistakes:
        return replace(verdict, findings=findings)
    what = text(f"{line.opening} is not right: {titles} is ", effort, ", not ", line.expr, ".")
    brief = text(f"{line.opening}, the force of an element, is not right.")
    mistake = Mistake("wrong_law", what, WHY, 6, brief=brief)
    return replace(verdict, mistakes=(mistake,), alternatives=(), findings=findings)


def _wrong_by_law(truth: Reference, excess: sp.Expr, findings: Sequence[Finding]) -> list[Finding]:
    """The wrong equations without forces of the answer's own that are, along the right motion, wrong by a multiple of
    what a force has too much."""
    known = {x.symbol for x in (*truth.model.parameters, *truth.model.coordinates, *truth.model.inputs)} | {time}
    wrong = [f for f in findings if f.status is Status.WRONG and f.line.kind == "equation"]
    wrong = [f for f in wrong if bounded.letters(f.line.expr) <= known]
    on = held(truth) if truth.derivation.multipliers else truth
    if not wrong or on is None:
        return []
    compiled = CompiledExpressions([excess, *(f.line.expr for f in wrong)])
    values = compiled.at(on.states, on.accelerations)
    if not np.isfinite(values).all():
        return []
    return [f for f, x in zip(wrong, values[1:], strict=True) if proportional(x, values[0])]


def _right_law(truth: Reference, line: AnsweredLine) -> tuple[str, sp.Expr] | None:
    """The elements of which a definition is meant to be the force, in words, and this force; None if it is right."""
    moving = [c.acceleration for c in truth.model.coordinates]
    if line.kind != "definition" or line.expr.has(*moving) or weighs(truth, line):
        return None
    letters = bounded.letters(line.expr)
    used = [(e, effort) for e, own, effort in _laws(truth) if own & letters]
    if not used:
        return None
    values = CompiledExpressions([line.expr, *(effort for _, effort in used)]).at(truth.states)
    size = np.abs(values[0]).max()
    signs = [np.array(s) for s in product((1.0, -1.0), repeat=len(used))]
    apart = [float(np.abs(values[0] - s @ values[1:]).max()) for s in signs]
    if min(apart) <= NEAR * size:
        return None
    nearest = signs[apart.index(min(apart))]
    titles = " and ".join(f"the force of {e.title}" for e, _ in used)
    return titles, sp.Add(*(int(s) * effort for s, (_, effort) in zip(nearest, used, strict=True)))


def right_laws(truth: Reference, lines: Sequence[AnsweredLine]) -> dict[str, sp.Expr]:
    """The names of an answer that are the forces of springs and dampers, with these."""
    laws = _laws(truth)
    named = [x for x in lines if x.kind == "definition" and x.name and not weighs(truth, x)]
    named = [x for x in named if any(own & bounded.letters(x.expr) for _, own, _ in laws)]
    return {key(str(x.name)): x.expr for x in named if _right_law(truth, x) is None}


def _laws(truth: Reference) -> list[tuple[Element, set[sp.Basic], sp.Expr]]:
    """Every linear spring and damper, its letters k or b, and its force."""
    model = truth.model
    found: list[tuple[Element, set[sp.Basic], sp.Expr]] = []
    for e in model.elements:
        if isinstance(e, Spring) and e.k is not None:
            found.append((e, truth.expand(e.k).free_symbols, truth.expand(e.k * e.extension(model))))
        elif isinstance(e, Damper) and e.b is not None:
            found.append((e, truth.expand(e.b).free_symbols, truth.expand(e.b * e.rate(model))))
    return found[:MOST_LAWS]


# -- words and factors ------------------------------------------------------------------------------------------------


def _said(line: AnsweredLine, match: Match, elements: Sequence[Element], what: Sequence[str | sp.Expr]) -> KnownPart:
    titles = " and ".join(map(_title, elements))
    said = text(f"In {line.title}, {titles} ", *what, ".")
    element = elements[0] if len(elements) == 1 else None
    return KnownPart(False, match.balance.moment, said, element, match.excess(elements))


def _title(element: Element) -> str:
    named = element.title
    return named if isinstance(element, (Force, Torque)) else f"the force of {named}"


def _wrong_by(times: sp.Expr, *, several: bool) -> list[str | sp.Expr]:
    """What is wrong with forces that a line has so many times."""
    have, count, lack = ("have", "count", "lack") if several else ("has", "counts", "lacks")
    if times == -1:
        return [f"{have} the wrong sign"]
    if times in TIMES:
        return [f"{count} {TIMES[times]}"]
    above, below = times.as_numer_denom()
    if times.is_number:
        return [f"{count} ", times, " times"]
    if above == 1:
        return [f"{lack} the factor ", below]
    if below == 1:
        return [f"{have} the factor ", above, " too much"]
    return [f"{have} the factor ", above, " in place of ", below]


@lru_cache(maxsize=8)
def _factors(truth: Reference) -> dict[sp.Expr, Array]:
    """What a line may be multiplied by, with its values for every set of parameters."""
    letters = [p.symbol for p in truth.model.parameters if p.symbol not in truth.values][:MOST_LETTERS]
    one = {x: truth.states.of(x).reshape(SETS, -1)[:, 0] for x in letters}
    listed: dict[sp.Expr, Array] = {sp.S.One: np.ones(SETS)}
    listed |= {**one, **{1 / x: 1 / v for x, v in one.items()}}
    for (x, a), (y, b) in product(one.items(), repeat=2):
        listed.setdefault(x * y, a * b)
        listed.setdefault(1 / (x * y), 1 / (a * b))
        listed.setdefault(x / y, a / b)
    return listed


def _factor(factors: Mapping[sp.Expr, Array], values: Array) -> sp.Expr | None:
    """A plain factor with these values, one for every set of parameters; None if it is none."""
    for factor, known in factors.items():
        ratio = values / known
        if np.ptp(ratio) > 1e-7 * np.abs(ratio).max():
            continue
        number = next((n for n in NUMBERS if abs(float(n) - ratio[0]) <= 1e-7 * abs(ratio[0])), None)
        if number is not None:
            return number * factor
    return None
