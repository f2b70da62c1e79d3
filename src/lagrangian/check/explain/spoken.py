"""Explanations in words: of one mistake, of two that lead to the same answer, and of a force that stands elsewhere."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lagrangian.check.align import Alignment
from lagrangian.check.explain import say
from lagrangian.check.explain.changes.pool import Pool, Possible, pool_of
from lagrangian.check.explain.denominators_said import as_it_stands
from lagrangian.check.explain.given_said import OF_LETTERS, of_given
from lagrangian.check.explain.search import Explanation, Told
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Mistake
from lagrangian.model import Gravity
from lagrangian.page.formula import Left, Name, Text, Verbatim, text

WHY_COPIED = "The Lagrangian is kinetic minus potential energy: take both as they stand above."
ALIKE = 0.05
"""The largest difference of the costs of one mistake in two elements of which neither is the likelier."""
AS_LIKELY = 1.1
"""The same for a wrong number in ½Jω² and for another moment of inertia, J = m r², that is made of mass and length."""
NUMBERS = ("half_forgotten", "half_in_kinetic_energy", "wrong_number", "counted_twice", "part")
"""The names of mistakes that only change the number of an energy."""

HALVES = {
    "element_twice": "The ½ of {} in D is missing.",
    "damper_half": "Half of what {} adds to D is missing: its ½ counts twice.",
}
"""What mistakes in the size of a damper are in D."""
WHY_HALF = "D = ½ b (rate)² of each damper, so that its force −∂D/∂ξ̇ is b times the rate."


def in_words(truth: Reference, told: Told, under: Alignment | None) -> Mistake:
    """A possible mistake in words."""
    possible: Possible = told.mistake
    if possible.wrong is not None:
        return possible.wrong.mistake(truth)
    assert possible.change is not None
    change = possible.change
    if change.kind in OF_LETTERS:
        change = of_given(change, pool_of(truth).sites)
    change, factor = as_it_stands(truth, change, under)
    return say.mistake(change, told.times, truth.model, factor)


def in_lagrangian(mistake: Mistake, line: AnsweredLine) -> Mistake:
    """A mistake in L where T* or V, in which it would be made, is right: it was made when L was written down."""
    parts: list[str | Left | Verbatim] = []
    for x in mistake.what.parts:
        of_energy = x in (Name("T*"), Name("V")) and bool(parts) and str(parts[-1]).endswith(" in ")
        parts += [] if of_energy else [x]
        parts[-1] = str(parts[-1]).removesuffix(" in ") if of_energy else parts[-1]
    first, *more = parts
    words = f"{str(first)[:1].lower()}{str(first)[1:]}" if isinstance(first, str) else first
    where = f"Not above, where it is right, but in {line.title}: "
    return replace(mistake, what=text(where, words, *more), why=text(WHY_COPIED), step=4)


def in_dissipation(mistake: Mistake) -> Mistake:
    """A mistake in the size of a damper where D is stated: it is the ½ of ½ b δ̇² that is missing, or counts twice."""
    said = HALVES.get(mistake.name)
    if said is None or mistake.element is None or mistake.coordinate is not None:
        return mistake
    return replace(mistake, what=text(said.format(mistake.element)), why=text(WHY_HALF))


def of_one(pool: Pool, told: Told, mistake: Mistake) -> Mistake:
    """The mistake in one of several equal elements, two springs side by side, where no answer tells in which it is."""
    element, times = told.mistake.element, float(told.times)
    if element is None or mistake.element != element.title:
        return mistake
    if isinstance(element, Gravity):
        return _of_one_weight(pool, told, mistake)
    same = {element.title: mistake}
    for other in pool.named(told.mistake.name):
        of = other.element
        if of is None or of.title in same or of.ledger != element.ledger:
            continue
        if other.takes(told.times) and pool.key(other, times) == pool.key(told.mistake, times):
            words = in_words(pool.truth, replace(told, mistake=other), None)
            plain = in_words(pool.truth, told, None)
            if _called(words.what, of.title, "") == _called(plain.what, element.title, ""):
                same[of.title] = words
    if len(same) == 1:
        return mistake
    *some, last = same
    one = f"one of {', '.join(some)} and {last}"
    brief = None if mistake.brief is None else _called(mistake.brief, element.title, one)
    return replace(
        mistake, what=_called(mistake.what, element.title, one), brief=brief, element=" or ".join((*some, last))
    )


def _of_one_weight(pool: Pool, told: Told, mistake: Mistake) -> Mistake:
    """The same for the weight of one of several equal bodies, of which all are elements of one field of gravity."""
    titles = [b.title for b in pool.truth.model.bodies]

    def body_in(words: Text) -> str | None:
        held = [x for x in titles if x in str(words)]
        return held[0] if len(held) == 1 else None

    own, times = body_in(mistake.what), float(told.times)
    if own is None:
        return mistake
    same, plain = [own], in_words(pool.truth, told, None)
    for other in pool.named(told.mistake.name):
        alike = other.element is told.mistake.element and other.takes(told.times)
        if not alike or pool.key(other, times) != pool.key(told.mistake, times):
            continue
        words = in_words(pool.truth, replace(told, mistake=other), None)
        title = body_in(words.what)
        if title is not None and title not in same and _called(words.what, title, "") == _called(plain.what, own, ""):
            same.append(title)
    if len(same) == 1:
        return mistake
    one = f"one of {', '.join(same[:-1])} and {same[-1]}"
    brief = None if mistake.brief is None else _called(mistake.brief, own, one)
    return replace(mistake, what=_called(mistake.what, own, one), brief=brief)


def _called(words: Text, title: str, name: str) -> Text:
    """Words with another name for an element."""
    begins = f"{title[:1].upper()}{title[1:]}"
    parts = [x.replace(title, name).replace(begins, name) if isinstance(x, str) else x for x in words.parts]
    first, *more = parts
    return text(f"{first[:1].upper()}{first[1:]}" if isinstance(first, str) else first, *more)


def of_either(
    pool: Pool, mistake: Mistake, chosen: tuple[Told, Alignment | None], others: Sequence[Explanation]
) -> tuple[Mistake, list[Explanation]]:
    """The mistake in either of two bodies, or springs, … if both lead to the same answer; the others that are left.

    So it is with a number in front of ½Jω² and the moment of inertia of another shape.
    """
    told, under = chosen
    truth = pool.truth
    if (one := of_one(pool, told, mistake)) is not mistake:
        titles = {x.strip() for x in str(one.element).split(" or ")}
        return one, [e for e in others if not (e.told[0].mistake.name == mistake.name and _title(e) in titles)]
    ledgers = {e.title: e.ledger for e in truth.model.elements}
    own = ledgers.get(mistake.element or "")
    for e in others:
        change = e.told[0].mistake.change
        shape = mistake.name in NUMBERS and change is not None and change.kind == "inertia_form"
        if own is None or e.under is not under or e.told[0].cost > told.cost + (AS_LIKELY if shape else ALIKE):
            continue
        rival = in_words(truth, e.told[0], e.under)
        elsewhere = rival.name == mistake.name and rival.element != mistake.element
        if (elsewhere and ledgers.get(rival.element or "") == own) or (shape and rival.element == mistake.element):
            what = text("Either this: ", *mistake.what.parts, " Or this: ", *rival.what.parts)
            element = f"{mistake.element} or {rival.element}" if elsewhere else mistake.element
            brief = None
            if mistake.brief is not None and rival.brief is not None:
                brief = text("Either this: ", *mistake.brief.parts, " Or this: ", *rival.brief.parts)
            either = replace(mistake, what=what, brief=brief, element=element)
            return either, [x for x in others if x is not e]
    return mistake, list(others)


def _title(explanation: Explanation) -> str | None:
    element = explanation.told[0].mistake.element
    return element.title if element is not None else None


def moved_elsewhere(
    pool: Pool, chosen: Sequence[tuple[Told, Alignment | None]], mistakes: Sequence[Mistake]
) -> list[Mistake]:
    """The mistakes, where one says of an element that it is missing and another that it stands where it should not.

    It is missing in one equation then, and not in the answer; that is said behind where it stands.
    """
    coordinates = pool.truth.model.coordinates
    found = [m if k == 0 else of_one(pool, t, m) for k, ((t, _), m) in enumerate(zip(chosen, mistakes, strict=True))]
    mistakes = list(found)
    for (told, _), m in zip(chosen, mistakes, strict=True):
        other = next((x for x in found if x is not m and m.element is not None and x.element == m.element), None)
        rows = np.flatnonzero(pool.felt[pool.places[id(told.mistake)]])
        if m.name != "element_forgotten" or other is None or other.name == m.name or len(rows) != 1 or m not in found:
            continue
        where = text(*other.what.parts, " In the equation of ", coordinates[int(rows[0])].symbol, " it is missing.")
        found = [replace(x, what=where) if x is other else x for x in found if x is not m]
    return found
