"""From a run to an animation: the states at the times of the frames, and the places of everything at these states.

Between two samples, the coordinates follow the cubic polynomial with the right values and rates at both ends (Hermite).
The places are computed from these coordinates, so that rods keep their lengths.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.advice import Advice, Argument
from lagrangian.errors import RunError
from lagrangian.look import hints_of, scene_of
from lagrangian.model import Point
from lagrangian.page.motion import motion
from lagrangian.page.placing import places
from lagrangian.simulate.animation import Animation
from lagrangian.simulate.integrating import remembered

if TYPE_CHECKING:
    from lagrangian.graph import Program
    from lagrangian.model import Model
    from lagrangian.page.scene import Scene
    from lagrangian.simulate.recorded import Recorded

Array = NDArray[np.float64]

FPS, MOST_FPS = 25.0, 120.0
SHORTEST, LONGEST = 2.0, 30.0
"""The usual range of how long an animation is [s]."""

MOST_FRAMES = 6000

FINER = 4
"""A path has so many places a frame."""

COARSE = 4.0
"""A point may be this far [px] from where the samples around it predict it to be."""


class Pictured(Protocol):
    """The picture of a system, such as `system.look` returns."""

    @property
    def model(self) -> Model:
        """The system."""
        ...

    @property
    def scene(self) -> Scene:
        """The picture as data."""
        ...

    @property
    def program(self) -> Program:
        """The positions [m] of the scene's anchors."""
        ...


FEWEST = 8
"""A run that stops after fewer samples is not animated, however many were asked for."""

SHARE = 0.98
"""This share of the samples must be close enough; at an impact, one is not."""

WORDS = 90
"""The largest number of characters of the words about an early end."""


def animate(
    run: Recorded,
    *,
    speed: float | None = None,
    trail: Sequence[Any] | None = None,
    fps: float = FPS,
    width: float | None = None,
    look: Pictured | None = None,
) -> Animation:
    """Return a run as moving pictures; see `Trajectory.animate`."""
    for name, value, most in (("speed", speed, 1e9), ("fps", fps, MOST_FPS), ("width", width, 4000.0)):
        if value is not None and not (isinstance(value, (int, float)) and 0 < value <= most):
            what = f"{name} must be a number above 0 and up to {most:g} (got {value!r:.40})"
            raise RunError(what, fix=f"{name}={min(1.0 if name == 'speed' else 25.0, most):g}", code="E406")
    if look is not None and trail is not None:
        raise RunError("trail and look were both given", fix="give the trail to look(trail=…)", code="E404")
    scene, kernel = _drawn(run, (trail,) if isinstance(trail, (str, Point)) else trail, look)
    if not any(part.moves and not part.aside for part in scene.parts):  # charges flow in pages alone
        what = f"nothing moves in the picture of '{run.model.name}': it has no body, only circuits"
        raise RunError(what, fix="run.plot() shows its charges over time", code="E406")
    times, duration = _times(run, speed, float(fps))
    inputs = _inputs(run)
    rates = _rates(run, inputs)
    _check_samples(run, scene, kernel, rates, inputs)
    n, fine = len(run.model.coordinates), FINER * (len(times) - 1) + 1 if scene.trail else len(times)
    at = np.linspace(times[0], times[-1], fine)
    q = hermite(run.t, run.y[:n].T, rates, at)
    r = _anchors(run, kernel, q, _between(run.t, run.y[n:].T, at), _between(run.t, inputs, at), at)
    finer = (fine - 1) // (len(times) - 1)
    made = motion(scene, r, times, duration=duration, finer=finer, ending=_ending(run))
    return Animation(made, float(fps), made.usual_width if width is None else float(width))


def _drawn(run: Recorded, trail: Sequence[Any] | None, look: Pictured | None) -> tuple[Scene, machine.Kernel]:
    """The scene that moves, and the machine code for the positions of its anchors."""
    if look is None:
        hints = hints_of(run.model, trail=trail)

        def make() -> tuple[Scene, machine.Kernel]:
            scene, program = scene_of(run.model, hints)
            return scene, machine.compile(program)

        return remembered(run.model, ("picture", hints.trail), make)
    if look.model is not run.model and _names(look.model) != _names(run.model):
        what = f"the picture is of another system, '{look.model.name}'"
        raise RunError(what, fix="give the picture of the system that was simulated", code="E406")
    return look.scene, machine.compile(look.program)


def _names(model: Model) -> tuple[str, ...]:
    return tuple(x.name for x in (*model.coordinates, *model.velocities, *model.parameters, *model.inputs))


def usual_speed(seconds: float) -> float:
    """Return real time, 1, if a run of so many seconds is then neither too short nor too long; else 2, 5, 10, …, or
    0.5, 0.2, 0.1, …"""
    steps = [m * 10.0**k for k in range(16) for m in (1.0, 2.0, 5.0)]
    if seconds > LONGEST:
        return next((x for x in steps if seconds / x <= LONGEST), steps[-1])
    return next((1 / x for x in steps if seconds * x >= SHORTEST), 1 / steps[-1])


def _times(run: Recorded, given: float | None, fps: float) -> tuple[Array, float]:
    """The times of the frames [s], and how long all of them are shown [s]."""
    if len(run.t) < 2 or run.t[-1] <= run.t[0]:
        what, fix = "the run has no length, so nothing moves", "simulate(10.0).animate()"
        raise RunError(what, fix=fix, code="E406")
    start, end = float(run.t[0]), float(run.t[-1])
    speed = usual_speed(end - start) if given is None else float(given)
    count = max(2, round((end - start) / speed * fps) + 1)
    if count > MOST_FRAMES:
        enough = math.ceil((end - start) * fps / (MOST_FRAMES - 1))
        raise RunError(
            f"the animation would have {count} frames; the limit is {MOST_FRAMES}",
            fix=Advice("show it faster: ", Argument("speed", f"{enough}"), ", or simulate a shorter time"),
            code="E703",
        )
    return np.linspace(start, end, count), (count - 1) / fps


def _ending(run: Recorded) -> str:
    """Why the run stopped before its end; empty if it did not."""
    if run.success:
        return ""
    words = " ".join(f"stopped at t = {run.t[-1]:.4g} s: {run.message}".split())
    return words if len(words) <= WORDS else f"{words[: WORDS - 1]}…"


# -- states -----------------------------------------------------------------------------------------------------------


def _between(t: Array, values: Array, wanted: Array) -> Array:
    """Values (S, k) at other times, on straight lines between samples."""
    columns = [np.interp(wanted, t, column) for column in values.T]
    return np.stack(columns, axis=-1) if columns else np.zeros((len(wanted), 0))


def _anchors(run: Recorded, kernel: machine.Kernel, q: Array, v: Array, u: Array, times: Array) -> Array:
    """The positions [m] of the picture's anchors, (times, anchors, d)."""
    return kernel(np.concatenate([q, v], axis=-1), u, run.p, times)


def _inputs(run: Recorded) -> Array:
    """All inputs at the samples (S, m), also those that a feedback determines."""
    if not run.feedback:
        return run.u
    return np.stack([run[u.symbol] for u in run.model.inputs], axis=-1)


def _rates(run: Recorded, inputs: Array) -> Array:
    """q̇ (S, n) at the samples; it is v but for frames that float."""
    n = len(run.model.coordinates)
    kernel: machine.Kernel = remembered(run.model, "rates", lambda: machine.compile(dynamics.rates(run.model)))
    return kernel(run.y[:n].T, run.y[n:].T, inputs, run.p, run.t)


def hermite(t: Array, q: Array, rates: Array, wanted: Array) -> Array:
    """Return values at the times ``wanted`` of the cubic polynomials between samples (S, n) with given rates.

    With s from 0 to 1 between two samples that are h apart: q = h₀₀ q₀ + h₁₀ h q̇₀ + h₀₁ q₁ + h₁₁ h q̇₁. Samples at the
    same time, before and after an event, are left out but for the last one.
    """
    kept = np.append(np.diff(t) > 0, True)
    t, q, rates = t[kept], q[kept], rates[kept]
    if len(t) == 1:
        return np.repeat(q, len(wanted), axis=0)
    i = np.clip(np.searchsorted(t, wanted, side="right") - 1, 0, len(t) - 2)
    h = (t[i + 1] - t[i])[:, None]
    s = ((wanted - t[i]) / h[:, 0])[:, None]
    return (
        (1 + 2 * s) * (1 - s) ** 2 * q[i]
        + s * (1 - s) ** 2 * h * rates[i]
        + s**2 * (3 - 2 * s) * q[i + 1]
        + s**2 * (s - 1) * h * rates[i + 1]
    )


def _check_samples(run: Recorded, scene: Scene, kernel: machine.Kernel, rates: Array, inputs: Array) -> None:
    """Raise an error if the samples of a run are too far apart to say where things are between them.

    Every second sample is predicted from its neighbours; prediction over half the distance is about 16 times better.
    """
    n = len(run.model.coordinates)
    middle = np.arange(1, len(run.t) - 1, 2)
    if not len(middle):
        raise _too_few(run)
    q = hermite(run.t[::2], run.y[:n, ::2].T, rates[::2], run.t[middle])
    v, u, times = run.y[n:, middle].T, inputs[middle], run.t[middle]
    guessed, true = (_anchors(run, kernel, x, v, u, times) for x in (q, run.y[:n, middle].T))
    off = np.linalg.norm(places(scene, guessed) - places(scene, true), axis=-1).max(axis=-1, initial=0.0)
    if float(np.quantile(off / 16, SHARE)) > COARSE:
        raise _too_few(run)


def _too_few(run: Recorded) -> RunError:
    if not run.success and len(run.t) < FEWEST:
        return RunError(f"the run has only {len(run.t)} samples, as it {run.message}", code="E406")
    what = f"the run has {len(run.t)} samples, which are too far apart for an animation"
    return RunError(what, fix=Advice("simulate with ", Argument("samples", str(4 * len(run.t)))), code="E406")
