"""Says of a cause that shows as one term of one equation which term that is: the term is certain, the cause is not.

"The term m g sin α of the equation of x is missing" is true whatever was thought; that the height was measured from
the parent is a reason for it, and stands behind it.
"""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import replace
from fractions import Fraction
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import Alignment
from lagrangian.check.explain import say
from lagrangian.check.explain.changes.change import LocalChange, Site, Words
from lagrangian.check.explain.changes.pool import FORGOTTEN, Pool, Possible
from lagrangian.check.explain.changes.ring import scaled
from lagrangian.check.explain.denominators_said import as_it_stands
from lagrangian.check.explain.search import SMALL, Explanation, Told, simple_number
from lagrangian.check.verdict import DERIVED, Mistake
from lagrangian.derive.sampling import Array
from lagrangian.page.formula import Text, text

REASON = " A possible reason: "
PLAIN = (
    *FORGOTTEN,
    "coupling_forgotten",
    "effort_term_forgotten",
    "gravity_sign",
    "spring_sign",
    "damper_sign",
    "force_sign",
    "reaction_sign",
    "element_twice",
    "damper_half",
    "spring_half_forgotten",
)
"""Misconceptions whose words already say what stands in the equation."""

LARGEST = 4
"""The largest number in a factor with which a part of an equation may have been counted."""
MOVING = (sp.Derivative, sp.sin, sp.cos)
"""What the sums of one term do not hold."""
OF_A_SUM = {"sign_in_a_sum": Fraction(-2), "left_out_of_a_sum": Fraction(-1)}
"""The kinds of changes that turn or leave out all terms of a part with one letter, with the multiple of these terms."""


def with_term(pool: Pool, told: Told, under: Alignment | None, mistake: Mistake, kinds: Set[str]) -> Mistake:
    """The mistake, told by the term of an equation that is wrong, if it shows as that alone.

    ``kinds`` are those of the lines of the answer: ℒ = T* + V is no reason where nobody wrote an ℒ.
    """
    if under is None or pool.truth.values or _is_plain(told.mistake) or (found := _term(pool, told)) is None:
        return _without_derivatives(told, mistake, kinds)
    term, times = found
    row = term.site.coordinate
    cancelled = times == -1 and row is not None and not _stands_there(pool, term, row)
    term, factor = as_it_stands(pool.truth, term, under)
    plain = say.mistake(term, times, pool.truth.model, factor)
    if told.mistake.name == "plus_potential" and "L" not in kinds:
        return plain
    said = plain.what.parts
    if cancelled and row is not None:
        left = -next(x for x in said if isinstance(x, sp.Expr))
        of = pool.truth.derivation.coordinates[row]
        said = ("The term ", left, " of the equation of ", of, " is left over: another term cancels it.")
    elif times not in (-1, -2):
        formulas = [x for x in said if isinstance(x, sp.Expr)]
        right = formulas[-1] if any(isinstance(x, str) and " should be " in x for x in said) else formulas[0]
        where = (
            f"T{str(term.site.words[0])[1:]}",
            (1 + sp.Rational(times.numerator, times.denominator)) * right,
            " of the equation of ",
        )
        said = (*where, pool.truth.derivation.coordinates[row or 0], " should be ", right, ".")
    change = told.mistake.change
    if change is not None and change.kind in OF_A_SUM and change.site.rows:
        return replace(mistake, what=text(*said))  # another way to say the same
    if is_of_letter(told.mistake):
        return replace(plain, what=text(*said), element=mistake.element)
    if change is not None and change.kind == "part" and told.times == -2 and times not in (-1, -2):
        return replace(plain, what=text(*said))  # the term has its sign
    if change is not None and change.kind == "part" and _is_odd(told.times):
        return replace(mistake, what=text(*said))  # nobody counts something 17/8 times
    return with_reason(text(*said), mistake)


def _stands_there(pool: Pool, term: LocalChange, row: int) -> bool:
    """Whether a term of a derivative is one of the right equation, and cancels with no other."""
    own, right = pool.truth.form(pool.sites.ring.expr(term.effect.rows[row])), pool.truth.forms[row]
    return own is None or right is None or min((right - own).size, (right + own).size) < right.size + own.size


def is_of_letter(possible: Possible) -> bool:
    """Whether all that is said is that a letter is left out of terms, or has the other sign there: of a length or a
    moment of inertia this is no reason, and nothing beside one."""
    change = possible.change
    return change is not None and change.kind in OF_A_SUM and isinstance(change.right, sp.Symbol)


def beside(best: Explanation, others: Sequence[Explanation]) -> list[Explanation]:
    """The other explanations that say something beside the best one: a letter that is left out of terms does not."""
    alone = is_of_letter(best.told[0].mistake)
    return [e for e in others if alone or not is_of_letter(e.told[0].mistake)]


def _without_derivatives(told: Told, mistake: Mistake, kinds: Set[str]) -> Mistake:
    """The chain rule that was not followed, of which nothing is certain in an answer without derivatives but the factor
    that stands in the equation."""
    change = told.mistake.change
    if change is None or change.kind != "inner_derivative" or not kinds.isdisjoint(DERIVED):
        return mistake
    right, written = cast("tuple[sp.Expr, sp.Expr]", (change.right, change.written))
    row, element, words = change.site.coordinate, change.site.element, change.site.words
    of: Words = ("In ", *words)
    if element is not None and not str(words[0]).startswith("what "):
        of = (f"In what {element.title} adds to the equation of ", words[1])
    times = bounded.cancel(right / written)
    above, below = sp.fraction(times)
    if times == -1:
        said = (*of, ", the sign is wrong.")
    elif below == 1 or written == 1:
        said = (*of, ", the factor ", right if written == 1 else times, " is missing.")
    elif above == 1:
        said = (*of, ", there is the factor ", below, " too much.")
    else:
        said = (*of, ", the factor is ", written, "; it should be ", right, ".")
    return with_reason(text(*said), mistake) if row is not None else mistake


def _is_odd(times: Fraction) -> bool:
    """Whether a part that is counted so many times more has a factor of which no reason is known."""
    return max(abs((1 + times).numerator), (1 + times).denominator) > LARGEST


def with_reason(said: Text, mistake: Mistake) -> Mistake:
    """A mistake, told by what is certain; what it would be caused by stands behind it."""
    return replace(mistake, what=text(*said.parts, REASON, *mistake.what.parts))


def parted(mistake: Mistake) -> tuple[Text, Text] | None:
    """What a mistake says for certain, and the possible reason behind it; None if it gives none."""
    parts = mistake.what.parts
    place = next((k for k, x in enumerate(parts) if isinstance(x, str) and REASON in x), None)
    if place is None:
        return None
    before, _, after = str(parts[place]).partition(REASON)
    return text(*parts[:place], before), text(*([after] if after else []), *parts[place + 1 :])


def _is_plain(possible: Possible) -> bool:
    """Whether the words of a mistake already say what stands in the equation: a part, or something forgotten."""
    if possible.wrong is not None:
        return possible.wrong.name in PLAIN
    change = possible.change
    if change is None or change.kind != "part":
        return False
    site = change.site
    return site.single or site.step in (3, 6) or (len(site.rows) == 1 and site.element is not None and _is_whole(site))


def _is_whole(site: Site) -> bool:
    """Whether a place in an equation is all that an element adds to it: "what gravity adds to the equation of φ"."""
    return isinstance(site.words[0], str) and site.words[0].startswith("what ")


def _term(pool: Pool, told: Told) -> tuple[LocalChange, Fraction] | None:
    """The change of one term of an equation that does the same, with its multiple."""
    place = pool.places[id(told.mistake)]
    if pool.felt[place].sum() != 1:
        return None
    terms: dict[int, list[tuple[int, LocalChange]]] = pool.kept("terms of rows", lambda: _terms(pool))
    made, row = float(told.times) * pool.W[place], int(np.flatnonzero(pool.felt[place])[0])
    for k, term in terms.get(row, ()):
        own = pool.W[k, row]
        times = simple_number(float(own @ made[row]) / float(own @ own))
        if times is not None and np.abs(float(times) * own - made[row]).max() <= SMALL * np.abs(made).max():
            return term, times
    return _product(pool, told, row, made[row])


def _product(pool: Pool, told: Told, row: int, made: Array) -> tuple[LocalChange, Fraction] | None:
    """The same for several terms that are one product with a sum of constants and coordinates, (M h + m r) R Ω² sin θ:
    left out, or with the other sign."""
    change = told.mistake.change
    times = OF_A_SUM.get(change.kind) if change is not None else None
    if change is None or times is None or set(change.effect.rows) != {row}:
        change, times = _part_of(pool, row, made)
    if change is None or times is None:
        return None
    factor = 1 / times if change.kind in OF_A_SUM else Fraction(1)
    above, below = sp.fraction(bounded.together(pool.sites.ring.expr(scaled(change.effect.rows[row], factor))))
    term = (bounded.factored(above) or above) / below
    sums = [f.as_base_exp()[0] for f in sp.Mul.make_args(term)]
    if not isinstance(term, sp.Mul) or any(isinstance(f, sp.Add) and f.has(*MOVING) for f in sums):
        return None
    words: Words = ("the term ", term, " of the equation of ", pool.truth.derivation.coordinates[row])
    site = replace(change.effect, words=words, coordinate=row, rows={row: pool.sites.sum(term)}, single=True)
    return LocalChange(kind="part", cost=change.cost, site=site, effect=site, free=True), times


def _part_of(pool: Pool, row: int, made: Array) -> tuple[LocalChange | None, Fraction | None]:
    """The part of an equation that is left out or has the other sign, and the multiple."""
    for k, possible in enumerate(pool.all):
        change = possible.change
        if change is None or change.kind != "part" or set(change.effect.rows) != {row} or change.site.single:
            continue
        if len({pool.sites.element_of(row, m) for m in change.effect.rows[row]}) > 1:
            continue  # what several bodies add is written as several terms
        own = pool.W[k, row]
        times = simple_number(float(own @ made) / float(own @ own))
        if times is None or times not in OF_A_SUM.values():
            continue
        if np.abs(float(times) * own - made).max() <= SMALL * np.abs(made).max():
            return change, times
    return None, None


def _terms(pool: Pool) -> dict[int, list[tuple[int, LocalChange]]]:
    """The places of the single terms of every equation, and what is changed there."""
    found: dict[int, list[tuple[int, LocalChange]]] = {}
    for k, possible in enumerate(pool.all):
        change = possible.change
        if change is not None and change.kind == "part" and change.site.single and len(change.site.rows) == 1:
            found.setdefault(next(iter(change.site.rows)), []).append((k, change))
    return found
