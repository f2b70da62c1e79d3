"""Holds pictures and animations against the system: what is drawn lies where its bodies are.

The anchors of a picture are compared with the positions that the description gives, evaluated as SymPy expressions. Its
SVG and TikZ, and the SVG of an animation, are read back and played frame by frame; every shape must lie where a
placement of its own, in complex numbers, puts it: z = origin + scale · (view r). The states of the frames are those of
a second run, whose samples are the frames.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.errors import Error
from lagrangian.graph import Program
from lagrangian.model import Model, Point, time
from lagrangian.page.formula import Check, text
from lagrangian.page.motion import SceneMotion, restrained
from lagrangian.page.scene import Disc, Path, Scene, ScenePart, Trace, drawing_order
from lagrangian.picture import Picture, picture
from lagrangian.simulate.animating import animate
from lagrangian.simulate.settings import RunSettings
from lagrangian.simulate.simulation import simulate
from lagrangian.simulate.trajectory import Trajectory
from lagrangian.verify.played import Leaf, frames_of, shapes_of, tikz_shapes
from lagrangian.verify.states import State, evaluated, named_values, relative

Array = NDArray[np.float64]

ROUNDING = 1e-9
"""The allowed relative difference of positions that are computed twice from the same state."""

PIXELS = 0.02
"""The allowed difference of places in a picture [px]: they are written with two decimals."""

MOVING = 0.7
"""That of places in an animation [px]: frames that straight lines come close to are left out."""

DURATION = 0.5
"""The longest run that is animated [s]."""

SAMPLES = 201
"""Its instants."""

FRAMES = 5
"""So many frames are looked at, the first and the last one too."""

BODIES = text("the picture's bodies lie at the positions that the description gives")
STILL = text("the picture's SVG and TikZ have every shape in its place")
FILM = text("an animation's frames, as SVG and HTML play them, are the positions of a run at their times")


def drawn_checks(model: Model, states: Sequence[State]) -> tuple[Check, ...]:
    """Return the checks of the picture and of an animation; ``holds`` is None where there is none."""
    try:
        drawn = picture(model)
        made = _bodies(model, drawn, states[:3]), _still(drawn)
    except Error as error:
        return tuple(Check(what, None, f"not checked: {error.what[:160]}") for what in (BODIES, STILL, FILM))
    try:
        return (*made, _film(model, drawn, states[0]))
    except Error as error:
        return (*made, Check(FILM, None, f"not checked: {error.what[:160]}"))


def _bodies(model: Model, drawn: Picture, states: Sequence[State]) -> Check:
    """Whether the bodies' anchors are the positions of the bodies at random states, and every body has one."""
    hidden = set(drawn.hints.hide)
    bodies = [body for body in model.bodies if body.name not in hidden]
    found = [np.array(_anchors(drawn.program, state), float)[list(drawn.scene.handles)] for state in states]
    wanted = [np.array([_position(model, body.at, state) for body in bodies]) for state in states]
    if not bodies:
        return Check(BODIES, None, "not checked: it shows no bodies")
    here, there = np.stack(found, axis=1), np.stack(wanted, axis=1)  # (bodies, states, d)
    apart = [min((relative(a - b, b, np.ones(1)) for a in here), default=np.inf) for b in there]
    astray = [min((relative(a - b, b, np.ones(1)) for b in there), default=np.inf) for a in here]
    lacking = [body.name for body, off in zip(bodies, apart, strict=True) if not off < ROUNDING]
    if lacking and all(off < ROUNDING for off in astray) and drawn.missing:
        rest = [off for off in apart if off < ROUNDING]
        said = f"{len(rest)} of {len(bodies)} bodies; it says that others are not drawn"
        return Check(BODIES, True if rest else None, said)
    worst = max(*apart, *astray)
    return Check(BODIES, worst < ROUNDING, f"largest relative difference {worst:.1e}, {len(bodies)} bodies")


def _position(model: Model, point: Point, state: State) -> list[float]:
    """The components [m] of the SymPy expressions of a position."""
    values: dict[sp.Basic, float] = {time: state["t"][0]}
    for group, symbols in (
        ("q", (c.symbol for c in model.coordinates)),
        ("u", (u.symbol for u in model.inputs)),
        ("p", (p.symbol for p in model.parameters)),
    ):
        values |= dict(zip(symbols, state[group], strict=True))
    found: list[Any] = [model.expand(x, constants=True).xreplace(values) for x in model.position(point)]
    return [float(x) for x in found]


def _anchors(program: Program, state: Mapping[str, Sequence[float]]) -> object:
    whole = {**state, "x": [*state["q"], *state["v"]]} if "x" not in state else state
    return evaluated(program, {k: list(v) for k, v in whole.items()})["r"]


# -- where shapes belong ----------------------------------------------------------------------------------------------


def _complex(scene: Scene, r: Array) -> NDArray[np.complex128]:
    """The places of anchors at positions (…, anchors, d), right + i down [px]."""
    view = np.asarray(scene.view, float)
    seen = np.einsum("kd,...d->k...", view, r) if r.size else np.zeros((2, *r.shape[:-1]))
    return complex(*scene.origin) + scene.scale * (seen[0] + 1j * seen[1])


def _placed(part: ScenePart, z: NDArray[np.complex128]) -> Leaf:
    """The numbers of a part that is placed at anchors z: all points in order, or the centre and radius of a circle."""
    shape, place = part.shape, part.placement
    if isinstance(shape, Trace):
        moved = [complex(*pair) for pair in shape.shifts] or [0j] * len(shape.anchors)
        return [z[k] + by for k, by in zip(shape.anchors, moved, strict=True)]
    origin = complex(*place.shift) + (0 if place.at is None else z[place.at])
    x, y = 1 + 0j, 1j
    if place.towards is not None:
        along = z[place.towards] + complex(*place.shift_towards) - origin
        unit = along / abs(along) if abs(along) else 1 + 0j
        x = unit if place.scaling == "none" else abs(along) * unit
        y = 1j * (x if place.scaling == "both" else unit)
        if place.across is not None:
            x, y = along, z[place.across] + complex(*place.shift) - origin
    if part.facing and not (x.conjugate() * y).imag < 0:
        return []
    if isinstance(shape, Disc):
        return [origin + shape.centre[0] * x + shape.centre[1] * y, complex(shape.radius * abs(x))]
    numbers = [v for _, listed in shape.commands for v in listed]
    return [origin + a * x + b * y for a, b in zip(numbers[::2], numbers[1::2], strict=True)]


def _apart(parts: Sequence[ScenePart], z: NDArray[np.complex128], found: Sequence[Leaf]) -> float:
    """How far shapes are from where they belong [px]; infinite if there are others, or as many points too few."""
    if len(found) != len(parts):
        return np.inf
    worst = 0.0
    for part, leaf in zip(parts, found, strict=True):
        wanted = _placed(part, z)
        if not wanted and (not leaf or np.ptp(leaf) == 0):  # the side of a plane that is not seen
            continue
        if _is_ellipse(part):
            leaf, wanted = _reach(leaf), _reach(wanted)
        if len(leaf) != len(wanted):
            return np.inf
        worst = max(worst, *(abs(a - b) for a, b in zip(leaf, wanted, strict=True)))
    return worst


def _is_ellipse(part: ScenePart) -> bool:
    """Whether a part is a whole circle in a plane in space, which may begin anywhere and have any number of pieces."""
    if not isinstance(part.shape, Path) or part.placement.across is None or len(part.shape.commands) < 4:
        return False
    ends = [complex(*numbers[-2:]) for letter, numbers in part.shape.commands if letter in "MC"]
    whole = len(ends) == len(part.shape.commands) and abs(ends[0] - ends[-1]) < ROUNDING
    return whole and max(abs(abs(z) - 1.0) for z in ends) < ROUNDING


def _reach(leaf: Leaf) -> Leaf:
    """How far a closed outline of cubic curves reaches in each of many directions [px]."""
    if len(leaf) < 4 or len(leaf) % 3 != 1:
        return leaf
    s, z = np.linspace(0.0, 1.0, 33)[:, None], np.array(leaf)
    a, b, c, d = (z[k : len(z) - 3 + k : 3] for k in range(4))
    spots = a * (1 - s) ** 3 + 3 * b * s * (1 - s) ** 2 + 3 * c * s**2 * (1 - s) + d * s**3
    turns = np.exp(-2j * np.pi * np.arange(16) / 16)
    return [complex(x) for x in (spots.ravel() * turns[:, None]).real.max(axis=1)]


def _still(drawn: Picture) -> Check:
    """The shapes of the picture as SVG and as TikZ."""
    scene = drawn.scene
    parts, z = drawing_order(scene.parts), _complex(scene, np.asarray(scene.positions, float))
    worst = max(_apart(parts, z, shapes_of(drawn.to_svg())), _apart(parts, z, tikz_shapes(drawn.to_tikz())))
    return Check(STILL, worst < PIXELS, f"largest difference {worst:.2g} px, {len(parts)} shapes")


# -- animations -------------------------------------------------------------------------------------------------------


def _film(model: Model, drawn: Picture, state: State) -> Check:
    begin = state["t"][0]
    run = _run(model, state, np.linspace(begin, begin + DURATION, SAMPLES))
    if run.t[-1] <= run.t[0]:
        return Check(FILM, None, f"not checked: {run.message}")
    made = animate(run, look=drawn)
    motion: SceneMotion = made.motion
    chosen = np.unique(np.linspace(0, motion.count - 1, FRAMES).round().astype(int))
    needed = (
        np.arange(motion.count) if drawn.scene.room is not None or drawn.scene.sizeless else chosen
    )  # how much less bodies move, all frames say
    again = _run(model, state, motion.times[needed])
    if len(again.t) != len(needed):
        return Check(FILM, None, f"not checked: {again.message}")
    z = _complex(drawn.scene, np.stack([_anchors_of(model, drawn, again, k) for k in range(len(again.t))]))
    z = _moved_together(drawn.scene, motion, z)[np.isin(needed, chosen)]
    zoom = max(1.0, motion.frame[2] / motion.usual_width)
    worst, page = 0.0, made.to_html()
    svg = page[page.index("<svg") : page.index("</svg>") + len("</svg>")]
    for played in (made.to_svg(), svg):
        for places, frame in zip(z, frames_of(played, chosen / (motion.count - 1), motion.frame[:2]), strict=True):
            worst = max(worst, _apart(motion.parts, places, frame))
    figure = f"largest difference {worst / zoom:.2g} px, {len(chosen)} frames of {run.t[-1] - run.t[0]:.3g} s"
    return Check(FILM, worst < MOVING * zoom, figure)


def _run(model: Model, state: State, times: Array) -> Trajectory:
    at = named_values(model, state)
    settings = RunSettings(times=times, start=state["t"][0])
    return simulate(model, settings, initial=at.initial, params=at.params, inputs=at.inputs, by_name={})


def _anchors_of(model: Model, drawn: Picture, run: Trajectory, k: int) -> Array:
    u = [float(run[u.symbol][k]) for u in model.inputs]
    at = {"x": run.y[:, k].tolist(), "u": u, "p": np.ravel(run.p).tolist(), "t": [float(run.t[k])]}
    return np.array(_anchors(drawn.program, at), float)


def _moved_together(scene: Scene, motion: SceneMotion, z: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """The places (frames, anchors) as the motion shows them: bodies that were moved apart move less, and the frame may
    move with all of them."""
    if scene.room is not None or scene.sizeless:
        at = restrained(scene, np.stack([z.real, z.imag], axis=-1))
        z = at[..., 0] + 1j * at[..., 1]
    if motion.followed:
        middle = z[:, list(scene.handles)].mean(axis=1)
        z = z - (middle - middle[0])[:, None]
    return z
