"""Where nothing explains equations of a system with constraints: the special case in which they would be right.

At rest all rates are 0; equations that are right there and wrong in motion are wrong in their terms with rates. In the
same way, those that are right without gravity, an input, a spring or a damper are wrong in what these add.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import sympy as sp

from lagrangian.check.constraints.answer_on_rows import AnswerAt, AnswerOnRows
from lagrangian.check.constraints.constrained import STATES, consistent, expanded, unknown_names
from lagrangian.check.names.results import results_in
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Mistake, Status, Verdict
from lagrangian.model import Damper, Element, Gravity, Spring
from lagrangian.page.formula import Text, text
from lagrangian.records import dataclass

FEWEST = 3
"""The fewest states at which equations have to hold in a special case."""
SAME = 1e-7
"""The relative difference of two quotients that is rounding."""
WHY_RATES = text(
    "A rate that is differentiated gives an acceleration, and so does the direction that turns with it: squares of "
    "rates belong to the accelerations, such as that towards the middle of a circle."
)
WHY_ELEMENT = text("Go through what this element adds to every equation once more, with its arms and its signs.")


@dataclass(frozen=True, eq=False)
class _Case:
    """What is 0 in a special case, the words for it and for what is then wrong, and the element that it concerns."""

    zero: Mapping[Any, float]
    when: tuple[Any, ...]
    terms: tuple[Any, ...]
    why: Text
    step: int
    element: Element | None = None


def with_special_case(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer that nothing explains, with the terms of which a special case shows the mistake."""
    lines = [f.line for f in verdict.findings if f.line.kind == "equation"]
    unknown = unknown_names(expanded(truth), lines) if lines else []
    wrong = [f.line for f in verdict.open_findings]
    nothing = verdict.status is Status.WRONG and not verdict.mistakes and lines and wrong
    if not nothing or len(unknown) > len(truth.derivation.multipliers):
        return verdict
    answer = AnswerOnRows(truth, lines, unknown)
    forces = [unknown.index(s) for s in results_in(truth.model, expanded(truth).known, lines)]
    for case in _cases(truth):
        places = list(_places(answer, case.zero))
        holds = len(places) >= FEWEST and consistent(places, range(len(lines)))
        if holds and all(_is_force(places, k) for k in forces):
            return replace(verdict, mistakes=(_mistake(case, wrong),))
    return verdict


def _is_force(places: Sequence[AnswerAt], k: int) -> bool:
    """Whether an answer's multiplier is the same number times one of the system's at every state."""
    own = np.array([np.linalg.lstsq(p.by_multiplier, -p.value, rcond=1e-10)[0][k] for p in places])
    right = np.array([p.multipliers for p in places])
    with np.errstate(all="ignore"):
        ratios = own[:, None] / right
    spread = np.ptp(ratios, axis=0) <= SAME * np.abs(ratios).max(axis=0)
    return bool((spread & np.isfinite(ratios).all(axis=0) & (np.abs(ratios).max(axis=0) > SAME)).any())


def _places(answer: AnswerOnRows, zero: Mapping[Any, float]) -> Iterator[AnswerAt]:
    """The answer at random states of a special case; nothing where the system has no motion there."""
    for state, _ in answer.states(STATES, given=False):
        found = answer.changed(state, zero)
        if found is not None and all(np.isfinite(x).all() for x in (found.value, found.by_multiplier, found.size)):
            yield found


def _cases(truth: Reference) -> Iterator[_Case]:
    """Rest, and the absence of gravity, of each input, spring and damper that has a letter of its own."""
    model = truth.model
    rest = {c.rate: 0.0 for c in model.coordinates}
    yield _Case(rest, ("at rest, but not in motion",), ("are the velocity terms",), WHY_RATES, 5)
    for u in model.inputs:
        yield _Case({u.symbol: 0.0}, ("with ", u.symbol, " = 0"), ("are the terms with ", u.symbol), WHY_ELEMENT, 6)
    for element in model.elements:
        step = 6 if isinstance(element, Damper) else 3
        for p in _own(model.parameters, element):
            title = "gravity" if isinstance(element, Gravity) else element.title
            terms = (f"is what {title} adds",)
            yield _Case({p.symbol: 0.0}, ("with ", p.symbol, " = 0"), terms, WHY_ELEMENT, step, element)


def _own(parameters: Sequence[Any], element: Element) -> list[Any]:
    """The letter without which an element does nothing: g, k or b."""
    size: Any = None
    if isinstance(element, Gravity):
        size = element.g
    elif isinstance(element, Spring):
        size = element.k
    elif isinstance(element, Damper):
        size = element.b
    return [p for p in parameters if sp.sympify(size) == p.symbol] if size is not None else []


def _mistake(case: _Case, lines: Sequence[AnsweredLine]) -> Mistake:
    many = len(lines) > 1
    begin = "The equations hold " if many else f"{lines[0].opening} holds "
    what = text(begin, *case.when, ": what differs ", *case.terms, ".")
    title = case.element.title if case.element is not None else None
    brief = text("A special case shows in which terms there is something wrong.")
    return Mistake("special_case", what, case.why, case.step, title, None, brief)
