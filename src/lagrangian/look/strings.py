"""Strings over pulleys: found where one body gains as much length along its line as another one loses.

A model that uses x for both sides of a string says nothing of the string itself. What it says is that
ℓ_a(q) + ℓ_b(q) = constant, where ℓ is the distance of a body from the pulley along the line on which it moves. That is
asked of the slopes ∂ℓ/∂q at random states with random parameters.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.cast import FLAT, BodyGlyph, Player, direction
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.model import Spring
from lagrangian.records import dataclass

Array = NDArray[np.float64]

SAME = 1e-8
"""Slopes that differ by less than this share are equal."""

HUNG = (BodyGlyph.CART, BodyGlyph.BLOCK, BodyGlyph.WHEEL, BodyGlyph.BALL)
"""What may hang on a string."""


@dataclass(frozen=True, eq=False)
class StringEnd:
    """A point at the end of a string.

    ``along`` (d,) is the unit vector of the line on which it moves, away from the pulley; None for a string that swings
    about the pulley. ``slopes`` (states, n) are ∂ℓ/∂q of its length ℓ.
    """

    point: int
    along: Array | None
    slopes: Array


@dataclass(frozen=True, eq=False)
class PulleyString:
    """A string over a pulley that is at rest as seen from the point ``holder`` (0: fixed).

    ``pulley`` is the body that turns with the string or stands at the holder, if there is one. ``fold`` is 2 where the
    second end hangs in a loop of the string, which lets it move half as far.
    """

    holder: int
    ends: tuple[StringEnd, StringEnd]
    pulley: Player | None = None
    fold: int = 1

    @property
    def parallel(self) -> bool:
        """Whether both ends hang along one direction, as in Atwood's machine."""
        a, b = (end.along for end in self.ends)
        return a is not None and b is not None and float(a @ b) > 1 - 1e-9


def strings_of(motions: Motions, parts: list[Player]) -> list[PulleyString]:
    """The strings over pulleys of a system in the plane with gravity; those on moving pulleys come last."""
    down = down_of(motions)
    if down is None or motions.stage.dimension == 3 or not motions.views.J.size:
        return []
    hung = [part.point for part in parts if part.glyph in HUNG]
    moving: list[PulleyString] = []
    for holder in range(1, len(motions.holds)):
        if motions.coordinates(holder) and motions.holds[holder].how is HoldKind.SLIDE:
            pairs = _pairs(motions, parts, [k for k in hung if k != holder], holder, down)
            moving += [x for x in pairs if x.parallel and _runs(motions, x)]
    lower = {end.point for x in moving for end in x.ends}
    carried = [x.holder for x in moving if x.holder not in hung]
    fixed = _pairs(motions, parts, [k for k in (*hung, *carried) if k not in lower], 0, down)
    used = {end.point for x in fixed for end in x.ends}
    return [*fixed, *(x for x in moving if x.holder in used)]


def cast_strings(motions: Motions, parts: list[Player], strings: list[PulleyString], chosen: set[str]) -> None:
    """Let moving pulleys be pulleys, and what a string pulls over a table a block, except for ``chosen`` names."""
    springs = any(isinstance(e, Spring) for e in motions.stage.model.elements)
    held = {h.holder for k, h in enumerate(motions.holds) if h.holder != k}
    for string in strings:
        for end in string.ends:
            for part in parts:
                if part.point == end.point and part.glyph is BodyGlyph.CART and part.name not in chosen:
                    part.glyph = BodyGlyph.CART if springs or part.point in held else BodyGlyph.BLOCK
        part = string.pulley
        if part is not None and part.glyph is not BodyGlyph.PULLEY and part.name not in chosen:
            part.glyph = BodyGlyph.PULLEY
            part.radius = _radius(motions, part, string)


def carried_string(motions: Motions, parts: list[Player], strings: list[PulleyString]) -> tuple[str, str, str] | None:
    """A body on which a pulley is, with the string around its corner, and the two bodies on that string; not drawn."""
    down = down_of(motions)
    names = {x.point: x.name for x in _unstrung(parts, strings)}
    if down is None or motions.stage.dimension == 3 or len(names) < 3:
        return None
    for k, name in names.items():
        for string in _pairs(motions, parts, [h for h in names if h != k], k, down):
            if _runs(motions, string):
                first, second = (names[end.point] for end in string.ends)
                return name, first, second
    return None


def hidden_pulley(motions: Motions, parts: list[Player], strings: list[PulleyString]) -> tuple[int, int] | None:
    """Two points on a string over a pulley that moves and is no point of the model.

    ℓ₁ + (ℓ₂ + ℓ₃)/2 is constant, where the other string is over a fixed pulley: so the moving one is midway between the
    ends of its string, but for a constant.
    """
    down = down_of(motions)
    free = _unstrung(parts, strings)
    if down is None or motions.stage.dimension == 3 or len(free) < 3:
        return None
    found = {x.point: end for x in free for end in _ends(motions, [x.point], 0, down) if end.along is not None}
    for one, two, three in itertools.permutations(found, 3):
        a, b, c = (found[k].slopes for k in (one, two, three))
        if two < three and np.abs(b + c).max() > SAME and _equal(-a, (b + c) / 2):
            return two, three
    return None


def _unstrung(parts: list[Player], strings: list[PulleyString]) -> list[Player]:
    used = {end.point for x in strings for end in x.ends}
    return [x for x in parts if x.glyph in HUNG and x.point not in used]


# -- rules ------------------------------------------------------------------------------------------------------------


def down_of(motions: Motions) -> Array | None:
    """The direction of gravity, if there is any."""
    for element in motions.stage.model.elements:
        if element.kind == "gravity":
            given: tuple[sp.Expr, ...] = getattr(element, "direction")  # noqa: B009
            if all(sp.sympify(x).is_number for x in given):
                e = np.array([float(x) for x in given])
                return e / np.linalg.norm(e)
    return None


def _ends(motions: Motions, points: list[int], holder: int, down: Array) -> Iterator[StringEnd]:
    """The ends that points may be of strings over a pulley at rest with ``holder``, hanging down if they can."""
    v = motions.views
    for k in points:
        if motions.slides(k, holder):
            J = v.J[:, k] - v.J[:, holder]
            e = direction(J[0])
            e = -e if float(e @ down) < -FLAT else e
            yield StringEnd(k, e, np.einsum("d,sdn->sn", e, J))
        elif not holder and motions.holds[k].how is HoldKind.TELESCOPE and motions.still(motions.holds[k].holder):
            d, D = motions.local(k, motions.holds[k].holder, None)
            yield StringEnd(k, None, np.einsum("sd,sdn->sn", d, D) / np.linalg.norm(d, axis=1)[:, None])


def _pairs(motions: Motions, parts: list[Player], points: list[int], holder: int, down: Array) -> list[PulleyString]:
    """Pairs of ends, those on different lines first; an end is used once on each side."""
    ends = list(_ends(motions, points, holder, down))
    found = [x for a, b in itertools.combinations(ends, 2) if (x := _string(motions, parts, a, b, holder, down))]
    found.sort(key=lambda x: (x.fold, x.parallel))
    used: list[StringEnd] = []
    chosen: list[PulleyString] = []
    for string in found:
        if any(_same_side(end, other) for end in string.ends for other in used):
            continue
        used += string.ends
        chosen.append(string)
    return chosen


def _same_side(a: StringEnd, b: StringEnd) -> bool:
    return a.point == b.point and (a.along is None or b.along is None or float(a.along @ b.along) > 0)


def _string(
    motions: Motions, parts: list[Player], a: StringEnd, b: StringEnd, holder: int, down: Array
) -> PulleyString | None:
    """The string between two ends, if the length that one gains is what the other loses."""
    loaded = [end.along is None or float(end.along @ down) > FLAT for end in (a, b)]
    if not any(loaded) or (a.along is None and b.along is None):
        return None
    if not loaded[0]:
        a, b, loaded = b, a, loaded[::-1]
    if not loaded[1] and _equal(a.slopes, b.slopes):  # a horizontal line has two sides
        assert b.along is not None
        b = StringEnd(b.point, -b.along, -b.slopes)
    upright = b.along is not None and float(b.along @ down) > 1 - FLAT
    if _equal(-a.slopes, b.slopes):
        return PulleyString(holder, (a, b), _pulley(motions, parts, a, holder))
    for one, two in ((a, b), (b, a)):
        if upright and a.along is not None and float(a.along @ down) > 1 - FLAT and _equal(-one.slopes, 2 * two.slopes):
            return PulleyString(holder, (one, two), _pulley(motions, parts, one, holder), 2)
    return None


def _runs(motions: Motions, string: PulleyString) -> bool:
    """Whether a string can run over its moving pulley while that one is at rest."""
    pulley = motions.views.J[0, string.holder]
    own = pulley[int(np.argmax(np.abs(pulley).max(axis=1)))]
    g = string.ends[0].slopes[0]
    return abs(float(own @ g)) < (1 - 1e-9) * float(np.linalg.norm(own) * np.linalg.norm(g))


def _equal(a: Array, b: Array) -> bool:
    return bool(np.abs(a - b).max() < SAME * max(float(np.abs(a).max()), SAME))


def _pulley(motions: Motions, parts: list[Player], end: StringEnd, holder: int) -> Player | None:
    """The body that turns as the string runs, or that stands where the string's pulley moves."""
    g = end.slopes[0]
    for part in parts:
        if part.frame is None or not motions.turns(part.frame):
            continue
        here = motions.still(part.point) if holder == 0 else part.point == holder
        slopes = motions.angle_slopes(part.frame)
        if here and abs(abs(float(slopes @ g)) - float(np.linalg.norm(slopes) * np.linalg.norm(g))) < 1e-9:
            return part
    return next((part for part in parts if holder and part.point == holder), None)


def _radius(motions: Motions, part: Player, string: PulleyString) -> sp.Expr | None:
    """The parameter that is the radius of a moving pulley: what runs over it by what it turns."""
    if part.frame is None:
        return None
    turn = float(np.linalg.norm(motions.angle_slopes(part.frame)))
    return motions.named(float(np.linalg.norm(string.ends[0].slopes[0])) / turn) if turn else None
