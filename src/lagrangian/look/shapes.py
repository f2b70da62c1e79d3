"""The glyphs of a textbook as shapes in pixels, in their own axes: x to the right, y downward."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, cos, hypot, pi, sin

from lagrangian.page.scene import Command, Pair, Path

INK = 1.6
"""The width of an ordinary line [px]."""

CART, WHEEL = (58.0, 34.0), 7.0
BLOCK = (60.0, 28.0)
BOB = 10.0
BAR = 16.0
"""The width of a rigid link."""
PIN = (15.0, 14.0)
COIL = 7.0
TICK = 9.0


def line(*points: Pair, closed: bool = False) -> Path:
    """Straight lines from point to point."""
    first, *rest = points
    ending: tuple[Command, ...] = (("Z", ()),) if closed else ()
    return Path((("M", first), *(("L", p) for p in rest), *ending))


def lines(*pieces: Sequence[Pair]) -> Path:
    """Several lines in one shape."""
    return Path(tuple(c for piece in pieces for c in line(*piece).commands))


def joined(*paths: Path) -> Path:
    """Several shapes as one."""
    return Path(tuple(c for path in paths for c in path.commands))


def box(width: float, height: float, *, y: float = 0.0, round_by: float = 0.0) -> Path:
    """A rectangle about (0, y), with round corners if wanted."""
    a, b = width / 2, height / 2
    if not round_by:
        return line((-a, y - b), (a, y - b), (a, y + b), (-a, y + b), closed=True)
    r, k = round_by, round_by * 0.45
    commands: list[Command] = [("M", (-a + r, y - b)), ("L", (a - r, y - b))]
    commands += [("C", (a - k, y - b, a, y - b + k, a, y - b + r)), ("L", (a, y + b - r))]
    commands += [("C", (a, y + b - k, a - k, y + b, a - r, y + b)), ("L", (-a + r, y + b))]
    commands += [("C", (-a + k, y + b, -a, y + b - k, -a, y + b - r)), ("L", (-a, y - b + r))]
    commands += [("C", (-a, y - b + k, -a + k, y - b, -a + r, y - b)), ("Z", ())]
    return Path(tuple(commands))


def arc(radius: float, start: float, end: float, *, x: float = 0.0, y: float = 0.0) -> Path:
    """A circular arc about (x, y), by angles on the screen (clockwise, because y points downward)."""
    pieces = max(1, int(abs(end - start) / (pi / 4)) + 1)
    step = (end - start) / pieces
    k = 4 / 3 * _tan_quarter(step) * radius
    commands: list[Command] = [("M", (x + radius * cos(start), y + radius * sin(start)))]
    for n in range(pieces):
        a, b = start + n * step, start + (n + 1) * step
        commands.append(
            (
                "C",
                (
                    x + radius * cos(a) - k * sin(a),
                    y + radius * sin(a) + k * cos(a),
                    x + radius * cos(b) + k * sin(b),
                    y + radius * sin(b) - k * cos(b),
                    x + radius * cos(b),
                    y + radius * sin(b),
                ),
            )
        )
    return Path(tuple(commands))


def _tan_quarter(step: float) -> float:
    return sin(step / 4) / cos(step / 4)


def head(tip: Pair, direction: Pair, *, length: float = 9.0, width: float = 6.5) -> Path:
    """The head of an arrow that ends at ``tip`` in a direction."""
    size = hypot(*direction) or 1.0
    ex, ey = direction[0] / size, direction[1] / size
    bx, by = tip[0] - length * ex, tip[1] - length * ey
    half = width / 2
    return line(tip, (bx - half * ey, by + half * ex), (bx + half * ey, by - half * ex), closed=True)


def arc_end(radius: float, start: float, end: float, *, x: float = 0.0, y: float = 0.0) -> tuple[Pair, Pair]:
    """The end of an arc and the direction in which it arrives there, for an arrow of length 9."""
    sense = 1.0 if end >= start else -1.0
    tip = (x + radius * cos(end), y + radius * sin(end))
    before = end - sense * min(9.0 / max(radius, 1.0), abs(end - start))
    return tip, (tip[0] - x - radius * cos(before), tip[1] - y - radius * sin(before))


def coil(windings: int) -> Path:
    """A zigzag spring along x from 0 to 1; y in pixels."""
    start, end = 0.16, 0.84
    steps = 2 * windings
    points: list[Pair] = [(0.0, 0.0), (start, 0.0)]
    for n in range(steps):
        points.append((start + (end - start) * (n + 0.5) / steps, COIL if n % 2 else -COIL))
    points += [(end, 0.0), (1.0, 0.0)]
    return line(*points)


def dashpot() -> Path:
    """A dashpot along x from 0 to 1; y in pixels: a cylinder that is open on the right, and a piston in it."""
    h = 8.0
    cylinder = ((0.66, -h), (0.36, -h), (0.36, h), (0.66, h))
    return lines(((0.0, 0.0), (0.36, 0.0)), cylinder, ((0.54, -h + 2.5), (0.54, h - 2.5)), ((0.54, 0.0), (1.0, 0.0)))


def spiral(outer: float = 15.0) -> Path:
    """A spiral spring about the origin."""
    turns, inner, steps = 2.0, 4.0, 32
    points: list[Pair] = []
    for n in range(steps + 1):
        angle = 2 * pi * turns * n / steps
        radius = inner + (outer - inner) * n / steps
        points.append((radius * cos(angle), radius * sin(angle)))
    return line(*points)


def floor(left: float, right: float) -> Path:
    """A line along x with hatching below it."""
    count = int((right - left) / TICK)
    ticks = [((left + TICK * (n + 0.7), 0.0), (left + TICK * (n + 0.7) - 6.0, 8.0)) for n in range(count)]
    return lines(((left, 0.0), (right, 0.0)), *ticks)


def pin() -> tuple[Path, Path]:
    """A support that stands below the origin: its triangle, and the hatched ground under it."""
    w, h = PIN
    ground = floor(-w - 3.0, w + 3.0)
    moved = Path(
        tuple((k, tuple(v + (h + 2.0 if i % 2 else 0.0) for i, v in enumerate(x))) for k, x in ground.commands)
    )
    return line((0.0, 0.0), (-w * 0.62, h + 2.0), (w * 0.62, h + 2.0), closed=True), moved


def quarters(radius: float) -> tuple[Path, Path]:
    """The mark of a centre of mass: two opposite quarters of a disc."""
    first = joined(line((0.0, 0.0), (radius, 0.0)), _after(arc(radius, 0.0, pi / 2)), Path((("Z", ()),)))
    second = joined(line((0.0, 0.0), (-radius, 0.0)), _after(arc(radius, pi, 3 * pi / 2)), Path((("Z", ()),)))
    return first, second


def _after(path: Path) -> Path:
    return Path(path.commands[1:])


def turned(path: Path, angle: float, dx: float = 0.0, dy: float = 0.0) -> Path:
    """A shape after a turn (clockwise on the screen) and a shift."""
    c, s = cos(angle), sin(angle)
    commands: list[Command] = []
    for letter, numbers in path.commands:
        pairs = list(zip(numbers[::2], numbers[1::2], strict=True))
        commands.append((letter, tuple(v for x, y in pairs for v in (c * x - s * y + dx, s * x + c * y + dy))))
    return Path(tuple(commands))


def heading(v: Pair) -> float:
    """The angle of a direction on the screen."""
    return atan2(v[1], v[0])
