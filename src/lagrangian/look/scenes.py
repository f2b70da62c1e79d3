"""Makes the picture of a model: what is drawn as what, in which pose, where, and what could not be drawn."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import ModelError
from lagrangian.graph import Program
from lagrangian.look.board import Board
from lagrangian.look.bodies import draw_bodies
from lagrangian.look.cast import BodyGlyph, Player, cast
from lagrangian.look.circuit_glyphs import draw_circuits
from lagrangian.look.constraint_glyphs import draw_constraints
from lagrangian.look.couplers import couplers
from lagrangian.look.effort_glyphs import EffortArtist, draw_gravity
from lagrangian.look.freedoms import say_unjoined
from lagrangian.look.gears import arm_gears, draw_arm_gears
from lagrangian.look.hints import Hints
from lagrangian.look.hoists import draw_hoists, hoists_of, lay_hoists
from lagrangian.look.holds import HoldKind, Motions
from lagrangian.look.kinematics import Kinematics
from lagrangian.look.labels import placed_labels
from lagrangian.look.measures import MeasureArtist
from lagrangian.look.outlines import draw_hints
from lagrangian.look.pose import Pose
from lagrangian.look.pulls import draw_pulls
from lagrangian.look.space_scene import draw_in_space
from lagrangian.look.space_supports import draw_fixed_axes
from lagrangian.look.spread import spread
from lagrangian.look.string_glyphs import draw_strings, draw_unwinding, floor_ends
from lagrangian.look.string_layout import extent, lay_strings, show_strings
from lagrangian.look.strings import PulleyString, carried_string, cast_strings, hidden_pulley, strings_of
from lagrangian.look.supports import draw_supports
from lagrangian.look.tie_glyphs import TieArtist
from lagrangian.look.ties import Resolver
from lagrangian.look.turning import turns_of
from lagrangian.look.words import description
from lagrangian.model import Model
from lagrangian.page.placing import placed
from lagrangian.page.scene import SWING, Disc, Flow, Label, Path, Scene, Trace
from lagrangian.page.scene import ScenePart as Shape

Array = NDArray[np.float64]

LARGE, LONGEST = 300.0, 190.0
"""The size of a picture's structure and of its longest rod [px]."""
MANY, ROOMIEST = 9, 2.0
"""From how many coordinates and elements on a picture gets more room for their letters, and how much of it at most."""
ROTOR = 7.0
"""How many times smaller than the longest rod the path of what is moved round on a body is drawn."""
PLAIN = 100.0
"""Pixels a metre in the schematic where nothing has a size."""
SLIDE = 72.0
"""How far a sliding body is drawn from its reference [px]."""
BORDER = 16.0
PLANE = np.array([[1.0, 0.0], [0.0, -1.0]])
"""The projection of the plane onto the screen, where y points downward."""


def scene_of(model: Model, hints: Hints | None = None) -> tuple[Scene, Program]:
    """The picture of a model, and the program x, u, p, t → r of its anchors [m], shape (anchors, d).

    Raises `ModelError` if positions are infinite or have no value.
    """
    with np.errstate(all="ignore"):  # what is not finite is found at the end
        scene, program = _drawn(model, Hints() if hints is None else hints)
    if not np.isfinite([*scene.size, *scene.origin, *(x for r in scene.positions for x in r)]).all():
        raise ModelError(
            f"system '{model.name}' cannot be drawn, because positions in its pose are infinite or have no value",
            fix="choose another pose",
            code="E402",
        )
    return scene, program


def _drawn(model: Model, hints: Hints) -> tuple[Scene, Program]:
    stage = Kinematics(model)
    motions = Motions(stage)
    p = stage.parameters()
    if stage.dimension == 3:
        board, said = draw_in_space(motions, p, hints)
        return _framed(board, model, hints, said, None)
    parts = cast(motions, hints.kinds)
    strings = strings_of(motions, parts)
    ends = hidden_pulley(motions, parts, strings)
    if ends is not None:  # the place of the pulley is found: the rules are asked again with it
        a, b = (model.position(stage.points[k]) for k in ends)
        stage.add(0, [(x + y) / 2 for x, y in zip(a, b, strict=True)])
        motions = Motions(stage)
        parts = cast(motions, hints.kinds)
        strings = strings_of(motions, parts)
    cast_strings(motions, parts, strings, set(hints.kinds))
    hoists, gears = hoists_of(motions, parts, strings), arm_gears(motions, parts)
    pose = Pose(motions, p, hints.pose)
    to_scale = show_strings(pose, strings)
    board = Board(stage, motions, pose.closed(pose.q), p, PLANE, hidden=frozenset(hints.hide))
    size = _scale(board, parts, to_scale)
    board.scale, board.sizeless = size or PLAIN, size is None
    _slide_apart(board, pose, parts)
    board.pinned = frozenset(
        stage.index(point) for e in model.constraints for _, point in e.points() if e.kind in ("pin", "ball", "weld")
    ) | {k for pair in couplers(motions, parts) for k in pair}
    board.pinned |= {h.holder for h in motions.holds if h.how is HoldKind.FIRMLY and motions.coordinates(h.point)}
    turns = turns_of(motions, parts, {})
    resolver = Resolver(motions, parts, turns)
    tied = [e for e in model.elements if getattr(e, "between", None) or getattr(e, "deflection", None) is not None]
    ties = [resolver.resolve(e) for e in tied if e.ledger != "λ"]
    strung = {end.point for x in strings for end in x.ends} | {x.load.point for x in hoists}
    room = spread(board, parts, ties, strung)
    laid = lay_strings(board, parts, strings)
    lay_hoists(board, hoists)
    draw_bodies(board, parts)
    turns = turns_of(motions, parts, board.tips)
    resolver.turns = turns
    ties = [resolver.resolve(e) for e in tied if e.ledger != "λ"]
    TieArtist(board, parts, draw_hoists(board, hoists, ties)).draw()
    draw_supports(board, parts, ties, floor_ends(board, parts, laid))
    draw_strings(board, parts, laid)
    draw_arm_gears(board, gears)
    draw_unwinding(board, parts)
    say_unjoined(board, parts, hints.lines, [*strings, *hoists, *gears], _say_carried(board, parts, strings, hints))
    draw_constraints(board, parts)
    draw_hints(board, parts, hints)
    draw_pulls(board, parts, resolver)
    if board.sizeless and room is None and (board.walled or any(x.kind == "pull" for x in board.parts)):
        room = SWING
    EffortArtist(board, parts, turns, ties, resolver).draw()
    MeasureArtist(board, parts, turns, [x.holder for x in strings if x.holder]).draw()
    return _framed(board, model, hints, description(board, parts, ties, turns, [*strings, *hoists, *gears]), room)


def _say_carried(board: Board, parts: list[Player], strings: list[PulleyString], hints: Hints) -> tuple[str, ...]:
    """Say which string over a pulley on a body is not drawn, unless a hint does; return the bodies that were named."""
    found = carried_string(board.motions, parts, strings)
    if found is None:
        return ()
    on, first, second = found
    ends = {x.point for x in parts if x.name in (first, second)}
    drawn = any(ends <= {board.stage.index(p) for p in line.through} for line in hints.lines)
    if not drawn:
        board.lacks(
            f"the string from {first} over a pulley on {on} to {second} is not drawn",
            "name the place of the pulley in [points], and give a [[look.line]] with "
            f'through = ["{first}", "the pulley", "{second}"] and kind = "string"',
        )
    return found


# -- scale ------------------------------------------------------------------------------------------------------------


def _scale(board: Board, parts: list[Player], strings: list[PulleyString]) -> float | None:
    """Pixels a metre: so that rods, links and wheels fill the picture, whatever their true size.

    None if nothing has a size.
    """
    board.scale = 1.0
    structure: list[Array] = []
    longest = 0.0
    for k, hold in enumerate(board.motions.holds):
        if hold.how in (HoldKind.ROD, HoldKind.TELESCOPE, HoldKind.TRACK) and k != hold.holder:
            a, b = board.view @ board.r[hold.holder], board.view @ board.r[k]
            structure += [a, b]
            longest = max(longest, float(np.linalg.norm(board.r[k] - board.r[hold.holder])))
        elif hold.how is HoldKind.FIRMLY and k:
            structure.append(board.view @ board.r[k])
            if board.motions.coordinates(k):  # it is moved round on a body
                structure.append(board.view @ board.r[hold.holder])
                longest = max(longest, ROTOR * float(np.linalg.norm(board.r[k] - board.r[hold.holder])))
    for part in parts:
        at = board.view @ board.r[part.point]
        if part.radius is not None and part.glyph is not BodyGlyph.SHAFT and part.glyph is not BodyGlyph.BEAM:
            radius = board.stage.value(part.radius, board.q, board.p)
            if radius > 0:
                structure += [at + (radius, radius), at - (radius, radius)]
                longest = max(longest, 3.8 * radius)
        if part.glyph is BodyGlyph.LINK and part.spine is not None and part.point in part.spine:
            joint = part.spine[0] if part.spine[1] == part.point else part.spine[1]
            structure.append(2 * at - board.view @ board.r[joint])
        if part.glyph is BodyGlyph.BEAM:
            runners = [h for h in board.motions.holds if h.frame == part.frame and h.along is not None]
            reach = max((1.6 * abs(float(board.q[h.along or 0])) for h in runners), default=0.0)
            structure += [at + (reach, 0.0), at - (reach, 0.0)]
        if part.glyph is BodyGlyph.BAR or not structure:
            structure.append(at)
    structure += extent(board, strings)
    for a, b in couplers(board.motions, parts):
        structure += [board.view @ board.r[a], board.view @ board.r[b]]
        longest = max(longest, float(np.linalg.norm(board.r[a] - board.r[b])))
    spots = np.array(structure) if structure else np.zeros((1, 2))
    size = float(np.ptp(spots, axis=0).max())
    size = max(size, 1e-9)
    model = board.stage.model
    room = min(ROOMIEST, max(1.0, (len(model.coordinates) + len(model.elements)) / MANY)) ** 0.5
    wanted = room * LARGE / size if size > 1e-6 else PLAIN
    if longest > 1e-9:
        return min(wanted, room * LONGEST / longest)
    return min(max(wanted, 1e-6), 1e6) if size > 1e-6 else None


def _slide_apart(board: Board, pose: Pose, parts: list[Player]) -> None:
    """Give the coordinates of slides values that can be seen."""
    q = board.q.copy()
    for i in pose.slides:
        name = pose.names[i]
        if name in pose.asked or (board.stage.model.constraints and pose.start):
            continue
        speed = max(
            (
                float(np.linalg.norm(board.motions.views.J[0, h.point, :, i]))
                for h in board.motions.holds
                if h.how is HoldKind.SLIDE
            ),
            default=1.0,
        )
        q[i] = SLIDE / board.scale / (speed or 1.0)
    board.posed(pose.closed(q))


# -- the frame of the picture -----------------------------------------------------------------------------------------


def _framed(board: Board, model: Model, hints: Hints, said: str, room: float | None) -> tuple[Scene, Program]:
    """The scene, moved so that everything lies within its frame."""
    low, high = _extent(board, 0)
    drawn = len(board.parts)
    draw_circuits(board, np.array([low[0], (low[1] + high[1]) / 2]))
    board.parts[drawn:] = [replace(x, moves=x.kind != "coordinate", aside=True) for x in board.parts[drawn:]]
    draw_gravity(board, np.array([high[0] + 26.0, low[1] + 8.0]))
    if board.stage.dimension == 3:
        draw_fixed_axes(board, np.array([low[0] - 12.0, high[1] + 10.0]))
    labels = placed_labels(board)
    last = _extent(board, drawn) if len(board.parts) > drawn else (low, high)
    low, high = np.minimum(low, last[0]), np.maximum(high, last[1])
    for label in labels:
        x, y, w, h = label.box
        low, high = np.minimum(low, (x, y)), np.maximum(high, (x + w, y + h))
    origin = BORDER - low
    size = high - low + 2 * BORDER
    trail = tuple(board.anchor(board.stage.index(point)) for point in hints.trail)
    anchors = list(board.anchors)
    scene = Scene(
        model.name,
        (round(float(size[0]), 1), round(float(size[1]), 1)),
        (float(origin[0]), float(origin[1])),
        board.scale,
        (tuple(map(float, board.view[0])), tuple(map(float, board.view[1]))),
        tuple(tuple(map(float, board.r[k])) for k in anchors),
        tuple(_moved(part, origin) for part in sorted(board.parts, key=lambda x: x.layer)),
        tuple(_moved_label(label, origin) for label in labels),
        said,
        tuple(dict.fromkeys(board.missing)),
        trail,
        tuple(dict.fromkeys(board.handles)),
        room,
        {c.name: float(x) for c, x in zip(model.coordinates, board.q, strict=True)},
        tuple(board.solids),
        tuple(_moved_flow(flow, origin) for flow in board.flows),
        board.sizeless,
    )
    return scene, board.stage.program(anchors)


def _extent(board: Board, first: int) -> tuple[Array, Array]:
    """The corners of what is drawn [px], from part number ``first`` on."""
    at = board.scale * (board.r[list(board.anchors)] @ board.view.T)
    spots: list[Array] = []
    reaches: list[float] = []
    for part in board.parts[first:]:
        for letter, numbers in placed(part, at):
            found = numbers[:2] if letter == "O" else numbers
            spots.append(found)
            reaches += [part.outline / 2 + (float(numbers[2]) if letter == "O" else 0.0)] * (len(found) // 2)
    if not reaches:
        return np.zeros(2), np.zeros(2)
    found, reach = np.concatenate(spots).reshape(-1, 2), np.array(reaches)[:, None]
    return (found - reach).min(axis=0), (found + reach).max(axis=0)


def _moved(part: Shape, by: Array) -> Shape:
    """A part in the frame of the picture: only what has no anchor has to be moved."""
    if part.placement.at is not None or isinstance(part.shape, Trace):
        return part
    dx, dy = float(by[0]), float(by[1])
    if isinstance(part.shape, Disc):
        x, y = part.shape.centre
        return replace(part, shape=Disc((x + dx, y + dy), part.shape.radius))
    commands = tuple(
        (letter, tuple(v + (dy if i % 2 else dx) for i, v in enumerate(numbers)))
        for letter, numbers in part.shape.commands
    )
    return replace(part, shape=Path(commands))


def _moved_flow(flow: Flow, by: Array) -> Flow:
    (left, top, right, bottom), (dx, dy) = flow.box, (float(x) for x in by)
    return replace(flow, box=(left + dx, top + dy, right + dx, bottom + dy))


def _moved_label(label: Label, by: Array) -> Label:
    x, y, w, h = label.box
    dx, dy = float(by[0]), float(by[1])
    return replace(label, centre=(label.centre[0] + dx, label.centre[1] + dy), box=(x + dx, y + dy, w, h))
