"""The height is that of another point of the body: of its end instead of its centre of mass, or half the distance."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, letters
from lagrangian.page.formula import text

STEP = 3
TWICE, HALF = "twice", "half"
"""How far a height is taken."""
WHY = text("The height is that of the centre of mass: measure how far from its hinge that is, along the body.")
WHY_FACTOR = text("How far does the body rise when the coordinate grows by 1? An angle counts with its radius or arm.")
"""For a height that lacks its arm."""


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Compute every weight with twice and with half the distance from the parent, and without the arm."""
    for gravity, body, V in s.weights():
        n = [s.expand(x) for x in gravity.direction]
        own = sp.Add(*[-a * (x - p) for a, x, p in zip(n, s.position(body), s.parent(body), strict=True)])
        mg = s.expand(body.mass) * s.expand(gravity.g)
        for times, word in ((1, TWICE), (-sp.S.Half, HALF)):
            what = text(f"The height of {body.title} is taken {word} as far out as its centre of mass.")
            if not s.angles(own):
                continue  # on an incline there is no arm: then the weight counts twice or half
            doubt = 0 if any(x.as_coeff_Mul()[0] not in (1, -1) for x in sp.Add.make_args(bounded.expand(own))) else 1
            if s.moves(own):  # a middle that has a letter of its own is not taken for an end
                yield Variant(what=what, V=times * mg * own, element=gravity, body=body.title, doubt=doubt)
            if mg * own != V:
                yield Variant(what=what, V=times * V, element=gravity, body=body.title, doubt=doubt)
        for p in letters(own):
            if bounded.diff(own, p) != 0 and own.subs(p, 0) == 0 and not bounded.diff(own, p).has(p):
                what = text(f"The weight of {body.title} comes without its arm ", p, ".")
                yield Variant(
                    what=what, V=mg * (bounded.diff(own, p) - own), element=gravity, body=body.title, why=WHY_FACTOR
                )
