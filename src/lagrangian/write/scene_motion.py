"""Writes a motion as an animated SVG without script: it plays wherever an image is shown, also in a README.

What only moves and turns is a group with a moving transformation; springs, ropes and the like have a moving path. Who
asks for reduced motion sees the first frame and the paths.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from lagrangian.page.motion import THIN, SceneMotion, extent
from lagrangian.page.palette import LIGHT
from lagrangian.page.placing import Drawn, axes, placed
from lagrangian.page.scene import Disc, Path, Placement, ScenePart, Trace
from lagrangian.write.html_page import escape
from lagrangian.write.scene_svg import document, group_opening, number, outline, pair_text, shape
from lagrangian.write.tracks import TOLERANCE, Timing, animate, key_frames, moved, stretched, timed, turned

Array = NDArray[np.float64]

COARSE = 4.0
"""From so many pixels of the drawing for one on the screen on, forms are written in whole ones."""
STILL = 0.04
"""What moves less [px] stands still."""

_STYLE = (
    ".lagrangian-scene .still{display:none}"
    "@media (prefers-reduced-motion:reduce){.lagrangian-scene:not(.playing) .still{display:inline}"
    ".lagrangian-scene:not(.playing) .moving{display:none}}"
)


def scene_motion(
    motion: SceneMotion, *, embedded: bool = False, width: float | None = None, tolerance: float = TOLERANCE
) -> str:
    """Return a motion as animated SVG that repeats for ever; ``embedded`` for use within HTML.

    ``width`` [px] is how wide it is shown; by default, at the scale of the schematic if it is not too large then.
    ``tolerance`` [px] is how far anything may be from its true place between two frames.
    """
    left, top, w, h = motion.frame
    shown = motion.usual_width if width is None else float(width)
    zoom = w / shown
    timing = Timing(motion.duration, tolerance * max(zoom, 1.0), zoom)
    parts = [replace(x, outline=x.outline * max(1.0, THIN * zoom)) for x in motion.parts]
    span = f"t = {motion.times[0]:.4g} … {motion.times[-1]:.4g} s"
    behind = next((i for i, part in enumerate(parts) if not _stands(part, motion.at)), len(parts))
    back, front = parts[:behind], parts[behind:]
    body = [f'<g transform="translate({number(-left)},{number(-top)})">', *_groups(motion, back, None)]
    body += ['<g class="moving">', *_trails(motion, timing, zoom, tolerance), *_groups(motion, front, timing), "</g>"]
    body += [
        '<g class="still">',
        *_trails(motion, None, zoom, tolerance),
        *_groups(motion, front, None),
        "</g>",
        "</g>",
    ]
    body += _footer(motion, zoom, timing)
    scene = replace(motion.scene, description=f"{motion.scene.description or motion.scene.name}; in motion, {span}")
    return document(scene, body, size=(w, h), embedded=embedded, style=_STYLE, width=shown)


# -- parts ------------------------------------------------------------------------------------------------------------


def _groups(motion: SceneMotion, parts: list[ScenePart], timing: Timing | None) -> Iterator[str]:
    """Parts that follow each other and move together share a group; without a timing, they stand in the first frame."""
    for (opening, placement), found in groupby(parts, key=lambda part: (group_opening(part), _common(part))):
        members = list(found)
        if timing is None or placement is None or motion.count < 2:
            inner = "".join(_alone(part, motion.at, timing) for part in members)
        else:
            inner = _together(members, placement, motion.at, timing)
        yield f"{opening}{inner}</g>"


def _stands(part: ScenePart, at: Array) -> bool:
    """Whether a part is the same in all frames."""
    return all(np.ptp(numbers, axis=0).max(initial=0.0) <= STILL for _, numbers in placed(part, at))


def _common(part: ScenePart) -> Placement | None:
    return None if isinstance(part.shape, Trace) else part.placement


def _together(parts: list[ScenePart], placement: Placement, at: Array, timing: Timing) -> str:
    """Parts with one placement: in a group that moves and turns if that is all they do, otherwise one by one."""
    origin, x, y = axes(placement, at)
    oblique = np.abs((x * y).sum(axis=-1)).max() > 1e-6 * np.abs(x).max() * np.abs(y).max()
    if oblique or any(part.facing for part in parts):
        return _in_plane(parts, origin, x, y, timing)
    sizes = [np.hypot(v[..., 0], v[..., 1]) for v in (x, y)]
    if any(np.ptp(size * _reach(part, i)) > STILL for i, size in enumerate(sizes) for part in parts):
        if placement.scaling == "along" and all(_is_long(part) for part in parts):
            return _stretched(parts, origin, x, timing)
        return "".join(_alone(part, at, timing) for part in parts)
    angles = np.unwrap(np.arctan2(x[..., 1], x[..., 0]))
    local = [_local(part, at[0], origin[0], float(angles[0])) for part in parts]
    far = max((_far(drawn) for drawn in local), default=0.0)
    turns = bool(np.ptp(angles) * far > STILL)
    moves = bool(np.ptp(origin, axis=0).max() > STILL)
    if not turns and not moves:
        return "".join(_alone(part, at, None) for part in parts)
    if not turns:  # the shapes as they are turned for good
        local = [[(c, _shifted(c, n[0], -origin[0])) for c, n in placed(part, at)] for part in parts]
    shapes = "".join(shape(part, outline(drawn)) for part, drawn in zip(parts, local, strict=True))
    if not turns:
        return f"<g>{moved(origin, timing)}{shapes}</g>"
    turn = turned(angles, far, timing, added=moves)
    if moves:
        return f"<g>{moved(origin, timing)}{turn}{shapes}</g>"
    ox, oy = (number(v) for v in origin[0])
    return f'<g transform="translate({ox},{oy})"><g>{turn}{shapes}</g></g>'


def _in_plane(parts: list[ScenePart], origin: Array, x: Array, y: Array, timing: Timing) -> str:
    """Parts in a plane in space: moved with its origin, about which their forms change.

    The ellipse as which a circle is seen does not change as the circle turns in its plane: its form begins where it is
    farthest to the right of its middle, at the same height.
    """
    axis = np.where(
        np.abs(x[:, 1]) + np.abs(y[:, 1]) > STILL, np.arctan2(-x[:, 1], y[:, 1]), np.arctan2(y[:, 0], x[:, 0])
    )
    axis += np.where(x[:, 0] * np.cos(axis) + y[:, 0] * np.sin(axis) < 0, np.pi, 0.0)
    c, s = np.cos(axis)[:, None], np.sin(axis)[:, None]
    steady = np.stack([0 * x, c * x + s * y, c * y - s * x], axis=1)
    plain = np.stack([0 * x, x, y], axis=1)
    forms = [
        _alone(replace(part, shape=ROUND, placement=FLAT), steady, timing)
        if _is_round(part)
        else _alone(replace(part, placement=FLAT), plain, timing)
        for part in parts
    ]
    if np.ptp(origin, axis=0).max() <= STILL:
        px, py = (number(v) for v in origin[0])
        return f'<g transform="translate({px},{py})">{"".join(forms)}</g>'
    return f"<g>{moved(origin, timing)}{''.join(forms)}</g>"


def _is_round(part: ScenePart) -> bool:
    """Whether the shape of a part is a circle of radius 1 about the origin of its axes."""
    if not isinstance(part.shape, Path) or len(part.shape.commands) < 5:
        return False
    (first, start), *rest = part.shape.commands
    ends = [numbers[-2:] for letter, numbers in rest if letter == "C"]
    if first != "M" or len(ends) < len(rest) or abs(np.subtract(start, ends[-1])).max() > 1e-9:
        return False
    return bool(abs((np.array(ends) ** 2).sum(axis=1) - 1.0).max() < 1e-9)


QUARTER = 0.5522847498
ROUND = Path(
    (
        ("M", (1.0, 0.0)),
        ("C", (1.0, QUARTER, QUARTER, 1.0, 0.0, 1.0)),
        ("C", (-QUARTER, 1.0, -1.0, QUARTER, -1.0, 0.0)),
        ("C", (-1.0, -QUARTER, -QUARTER, -1.0, 0.0, -1.0)),
        ("C", (QUARTER, -1.0, 1.0, -QUARTER, 1.0, 0.0)),
    )
)
"""A circle of four curves: at most 0.03 % from the true one."""
FLAT = Placement(0, 1, across=2)

LAID = Placement(0, 1, "along")


def _is_long(part: ScenePart) -> bool:
    """Whether the form of a part is too long to be written in every frame."""
    return isinstance(part.shape, Path) and len(part.shape.commands) > 4


def _stretched(parts: list[ScenePart], origin: Array, x: Array, timing: Timing) -> str:
    """Springs and dampers: moved, turned and stretched along their x axis, with lines that keep their width."""
    lengths, angles = np.hypot(x[:, 0], x[:, 1]), np.unwrap(np.arctan2(x[:, 1], x[:, 0]))
    longest = float(lengths.max())
    flat = np.array([[0.0, 0.0], [longest, 0.0]])
    shapes = "".join(
        shape(
            replace(part, outline=part.outline / timing.zoom),
            outline(placed(replace(part, placement=LAID), flat)) + ' vector-effect="non-scaling-stroke"',
        )
        for part in parts
    )
    turn = turned(angles, longest, timing, added=True)
    return f"<g>{moved(origin, timing)}{turn}{stretched(lengths / longest, longest, timing)}{shapes}</g>"


def _reach(part: ScenePart, axis: int) -> float:
    """The largest coordinate of a shape along one of its axes."""
    if isinstance(part.shape, Disc):
        return abs(part.shape.centre[axis]) + part.shape.radius
    assert not isinstance(part.shape, Trace)
    return max((abs(v) for _, numbers in part.shape.commands for v in numbers[axis::2]), default=0.0)


def _local(part: ScenePart, at: Array, origin: Array, angle: float) -> list[Drawn]:
    """A part about the origin of its axes, turned back by their angle."""
    c, s = np.cos(angle), np.sin(angle)
    back = np.array([[c, s], [-s, c]])
    drawn: list[Drawn] = []
    for letter, numbers in placed(part, at):
        pairs = _shifted(letter, numbers, -origin)
        count = 2 * (len(pairs) // 2)
        drawn.append((letter, np.concatenate([(pairs[:count].reshape(-1, 2) @ back.T).ravel(), pairs[count:]])))
    return drawn


def _shifted(letter: str, numbers: Array, by: Array) -> Array:
    found = numbers.copy()
    count = 2 if letter == "O" else len(found)
    found[:count] += np.tile(by, count // 2)
    return found


def _far(drawn: list[Drawn]) -> float:
    """How far the farthest point of a shape is from the origin."""
    box = extent(drawn)
    return 0.0 if box is None else float(np.hypot(max(abs(box[0]), abs(box[2])), max(abs(box[1]), abs(box[3]))))


def _alone(part: ScenePart, at: Array, timing: Timing | None) -> str:
    """A part whose shape changes: its path, or its circle, has a new form in every frame."""
    drawn = placed(part, at)
    first = [(letter, numbers[0]) for letter, numbers in drawn]
    if timing is None or len(at) < 2 or _stands(part, at):
        return shape(part, outline(first))
    digits = 1 if timing.zoom < COARSE else 0
    geometry = outline([(letter, np.round(numbers, digits)) for letter, numbers in first])  # as in the other frames
    if len(drawn) == 1 and drawn[0][0] == "O":
        within = "".join(
            animate(name, drawn[0][1][:, [i]], lambda row: number(float(row[0]), digits), timing)
            for i, name in enumerate(("cx", "cy", "r"))
        )
        return shape(part, geometry, within)
    letters, counts = [letter for letter, _ in drawn], [n.shape[-1] for _, n in drawn]
    ends = np.cumsum([0, *counts]).tolist()

    def write(row: Array) -> str:
        pieces = zip(letters, ends, ends[1:], strict=False)
        return "".join(letter + pair_text(row[a:b].tolist(), digits) for letter, a, b in pieces)

    track = np.concatenate([n for _, n in drawn], axis=-1)
    return shape(part, geometry, animate("d", track, write, timing))


# -- what is not a part of the system ---------------------------------------------------------------------------------


def _trails(motion: SceneMotion, timing: Timing | None, zoom: float, tolerance: float) -> Iterator[str]:
    """Paths of anchors: all of it faint, and stronger as far as the motion has come."""
    for track in motion.paths:
        chosen = key_frames(track, max(TRAIL, tolerance) * max(zoom, 1.0))
        corners = np.round(track[chosen], 1)  # as they are written, so that lengths along the path add up
        steps = np.hypot(*np.diff(corners, axis=0).T)
        length = float(steps.sum())
        if length < 1.0:
            continue
        d = "".join(("L" if i else "M") + pair_text(x.tolist(), 1) for i, x in enumerate(corners))
        width = number(1.4 * max(1.0, THIN * zoom))
        path = f'path class="line" d="{d}" fill="none" stroke="{LIGHT.line("coordinate")}" stroke-width="{width}"'
        yield f'<g class="glyph role-coordinate"><{path} opacity="0.25"/>'
        if timing is not None:
            share = np.concatenate([[0.0], np.cumsum(steps) / length])
            every = np.interp(np.linspace(0, len(track) - 1, motion.count), chosen, share)
            finish = Timing(timing.duration, 0.5 * zoom / length)
            values = timed((1 - every)[:, None], lambda row: number(float(row[0]), 5), finish)
            yield (
                f'<{path} opacity="0.65" pathLength="1" stroke-dasharray="1" stroke-dashoffset="1" '
                f'stroke-linecap="butt"><animate attributeName="stroke-dashoffset" {values}/></path>'
            )
        yield "</g>"


TRAIL = 0.2
"""How far a drawn path may be from the true one [px]."""


def _footer(motion: SceneMotion, zoom: float, timing: Timing) -> Iterator[str]:
    """A thin line that grows with time, why the motion ends early, and how fast it is shown."""
    _, _, w, h = motion.frame
    thick = number(2.0 * zoom)
    y = number(h - 2.0 * zoom)
    if motion.count > 1:
        yield (
            f'<g class="moving role-thin"><rect class="solid" y="{y}" width="{number(w)}" height="{thick}" '
            f'fill="{LIGHT.line("thin")}" opacity="0.5"><animate attributeName="width" from="0" to="{number(w)}" '
            f'dur="{number(timing.duration, 3)}s" repeatCount="indefinite"/></rect></g>'
        )
    place = f'y="{number(h - 8 * zoom)}" font-size="{number(13 * zoom)}"'
    if motion.ending:
        yield (
            f'<g class="glyph role-input"><text class="solid" x="{number(8 * zoom)}" {place} '
            f'fill="{LIGHT.line("input")}">{escape(motion.ending)}</text></g>'
        )
    if motion.pace:
        yield (
            f'<g class="glyph role-thin"><text class="solid" x="{number(w - 8 * zoom)}" {place} '
            f'text-anchor="end" fill="{LIGHT.line("thin")}">{escape(motion.pace)}</text></g>'
        )
