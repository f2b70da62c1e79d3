"""What may stand in place of a piece of a position, and of all pieces of one segment of the way to a body."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import partner
from lagrangian.check.explain.misconceptions.base import put as replaced
from lagrangian.model import time

MOST_ANGLES = 6
"""The largest number of angles that are tried in the place of one."""


def instead_of_piece(p: sp.Expr) -> Iterator[tuple[sp.Expr, str, float]]:
    """What may stand in place of a piece of a position: nothing, its negative, sine for cosine, without its number."""
    yield sp.S.Zero, "piece_left_out", 1.4
    yield -p, "piece_sign", 1.6
    for f in sorted(p.atoms(sp.sin, sp.cos), key=sp.default_sort_key):
        yield replaced(p, {f: partner(f)}), "piece_function", 1.8
        yield replaced(p, {f: sp.S.One}), "piece_function", 2.0
    number = p.as_coeff_Mul()[0]
    if number not in (1, -1):
        yield p / abs(number), "piece_number", 1.9
        yield p / abs(number) ** 2, "piece_number", 2.6
    else:
        yield p / 2, "piece_number", 2.0
        yield 2 * p, "piece_number", 2.2


def instead_of_segment(key: sp.Expr, pieces: Sequence[sp.Expr]) -> Iterator[tuple[list[sp.Expr], str, float, Any, Any]]:
    """What may stand in place of the pieces of one segment, with its kind, its cost, and what to call right and
    written: nothing, the other direction, sines for cosines, without its number."""
    if len(pieces) < 2:
        return
    yield [sp.S.Zero for _ in pieces], "segment_left_out", 1.3, key, None
    yield [-p for p in pieces], "segment_sign", 1.9, key, None
    turned = [replaced(p, {f: partner(f) for f in p.atoms(sp.sin, sp.cos)}) for p in pieces]
    if turned != list(pieces):
        yield turned, "segment_turned", 1.9, key, None
    numbers = {abs(p.as_coeff_Mul()[0]) for p in pieces}
    if len(numbers) == 1:
        number = cast("sp.Expr", numbers.pop())
        others = ((1 / number, 1.6),) if number != 1 else ((sp.S.Half, 1.9), (sp.Integer(2), 2.1))
        for times, cost in others:
            written = number * times * key
            yield [cast("sp.Expr", times * p) for p in pieces], "segment_number", cost, number * key, written


def instead_of_angle(
    pieces: Sequence[sp.Expr], turning: Sequence[sp.Expr]
) -> Iterator[tuple[list[sp.Expr], str, float, Any, Any]]:
    """The pieces of a segment with another angle: a relative one taken for an absolute one, or with the wrong sign.

    Given as `instead_of_segment` gives what it finds; ``turning`` are the coordinates that may be taken for angles.
    """
    angles = {cast("sp.Expr", f.args[0]) for p in pieces for f in p.atoms(sp.sin, sp.cos)}
    if len(angles) != 1:
        return
    angle = angles.pop()
    parts = sp.Add.make_args(bounded.expand(angle))
    others = [*(angle - p for p in parts), *(angle - 2 * p for p in parts)] if len(parts) > 1 else []
    for q in [q for q in turning if not angle.has(q)]:
        others += [angle + q, angle - q, q]
    for other in [x for x in dict.fromkeys(others) if x not in (angle, -angle, 0)][:MOST_ANGLES]:
        table: dict[Any, Any] = {sp.sin(angle): sp.sin(other), sp.cos(angle): sp.cos(other)}
        yield [replaced(p, table) for p in pieces], "angle", 1.6, angle, other


def segment(p: sp.Expr) -> sp.Expr:
    """What pieces of one segment have in common: all factors but numbers and sines and cosines."""
    factors = [f for f in sp.Mul.make_args(p) if not f.is_number and not isinstance(f, (sp.sin, sp.cos))]
    return cast("sp.Expr", sp.Mul(*factors))


def along_turning_axes(position: Sequence[sp.Expr], velocity: Sequence[sp.Expr], q: Sequence[Any]) -> list[sp.Expr]:
    """The components of a velocity along axes that turn as prescribed, if the position names one such angle."""
    turns = {cast("sp.Expr", f.args[0]) for x in position for f in x.atoms(sp.sin, sp.cos) if f.has(time)}
    angles = [a for a in turns if not a.has(*q)]
    c, s = (sp.cos(angles[0]), sp.sin(angles[0])) if len(angles) == 1 else (sp.S.One, sp.S.Zero)
    plane = [k for k, x in enumerate(velocity) if x.has(c, s)]
    if len(angles) != 1 or len(plane) != 2:
        return []
    x, y = (velocity[k] for k in plane)
    turned = dict(zip(plane, (c * x + s * y, c * y - s * x), strict=True))
    return [bounded.expand(turned.get(k, x)) for k, x in enumerate(velocity)]
