"""An element is counted twice."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import text

STEP = 3
WHY = text("Every element belongs to exactly one of T*, V and Ξ, once: what is in V is not in Ξ as well.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Count every spring, weight, force and torque twice."""
    for spring, _, V in s.springs():
        yield Variant(
            what=text(f"{spring.title[:1].upper() + spring.title[1:]} is counted twice."), V=V, element=spring
        )
    for gravity, body, V in s.weights():
        yield Variant(what=text(f"The weight of {body.title} is counted twice."), V=V, element=gravity, body=body.title)
    for element in s.acting:
        what = text(f"{element.title[:1].upper() + element.title[1:]} is counted twice.")
        yield Variant(what=what, Xi=s.shares(element), element=element)
        for i, x in s.shares(element).items() if len(s.shares(element)) > 1 else ():
            what = text(
                f"{element.title[:1].upper() + element.title[1:]} is counted twice in the equation of ", s.q[i], "."
            )
            yield Variant(what=what, Xi={i: x}, element=element, coordinate=i)
