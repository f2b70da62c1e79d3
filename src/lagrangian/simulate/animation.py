"""The class `Animation`: a run as moving pictures, returned by `run.animate`."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from lagrangian.calls import worded
from lagrangian.errors import RunError
from lagrangian.page.motion import SceneMotion
from lagrangian.page.palette import DARK, LIGHT
from lagrangian.records import dataclass, field
from lagrangian.view.frames import FramePainter
from lagrangian.view.movies import FASTEST, Progress, ffmpeg, write_gif, write_video
from lagrangian.viewed import Brief, cut
from lagrangian.write.files import write_file, write_with
from lagrangian.write.scene_motion import scene_motion
from lagrangian.write.scene_player import player_frame, player_page
from lagrangian.write.tables import check_target

LARGEST_CELL = 150_000
"""The largest number of characters that a notebook is given."""

ATTEMPTS = ((1, 0.15), (2, 0.15), (2, 0.4), (4, 0.4), (4, 0.8), (4, 1.6))
"""Every how many frames, and how far off [px] in between, is tried until an animation fits into a notebook."""

_log = logging.getLogger(__name__)


@worded
@dataclass(eq=False)
class Animation(Brief):
    """A run of a system as moving pictures.

    ``fps`` is the number of frames a second, ``duration`` how long the animation is [s], ``frames`` how many frames it
    has. ``width`` is how wide it is [px]. ``motion`` contains the places of everything in every frame. In a notebook
    the animation shows itself.
    """

    motion: SceneMotion = field(repr=False)
    fps: float
    width: float

    @property
    def frames(self) -> int:
        """The number of frames."""
        return self.motion.count

    @property
    def duration(self) -> float:
        """How long the animation is [s]."""
        return self.motion.duration

    def to_svg(self) -> str:
        """Return animated SVG without script, which plays wherever images do."""
        return scene_motion(self.motion, width=self.width)

    def to_html(self) -> str:
        """Return an HTML page of its own, with a button that holds the motion and a slider of time."""
        return player_page(self.motion, width=self.width)

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        overwrite: bool = False,
        dark: bool = False,
        progress: Progress | None = None,
    ) -> Path:
        """Write the animation to a ``.svg``, ``.html``, ``.gif``, ``.mp4`` or ``.webm`` file, completely or not at all.

        SVG and HTML need no other package and follow the reader's light or dark scheme; ``dark`` chooses for the other
        formats. GIF needs Pillow, videos need ffmpeg or the package imageio-ffmpeg as well. ``progress(done, all)`` is
        called after every frame of these. Raises `Error` if the file exists, unless ``overwrite``, or if it cannot be
        written, and `MissingExtra` for a missing package.
        """
        target = Path(path)
        check_target(target, list(ENDINGS), overwrite=overwrite)
        _log.info("writing %d frames to %s", self.frames, target.name)
        ENDINGS[target.suffix.lower()](self, target, dark, progress)
        return target

    def _painter(self, dark: bool) -> FramePainter:
        return FramePainter(self.motion, self.width, DARK if dark else LIGHT)

    def _repr_html_(self) -> str:
        for every, tolerance in ATTEMPTS:
            motion = self.motion if every == 1 else self.motion.fewer(every)
            cell = player_frame(motion, width=self.width, tolerance=tolerance)
            if len(cell) <= LARGEST_CELL:
                return cell
        return (
            f"<p>The animation has {self.frames} frames, which is too much for a notebook. Animate a shorter run, or "
            "save it: <code>.save('motion.svg')</code>.</p>"
        )

    def __repr__(self) -> str:
        """Return the name, the number of frames, and how long it is."""
        early = f"; {self.motion.ending}" if self.motion.ending else ""
        size = f"{self.frames} frames, {self.duration:.4g} s, {self.width:g} px wide"
        return cut(f"<Animation of {self.motion.scene.name!r}: {size}{early}>")


def _svg(animation: Animation, path: Path, dark: bool, progress: Progress | None) -> None:
    write_file(path, animation.to_svg())


def _html(animation: Animation, path: Path, dark: bool, progress: Progress | None) -> None:
    write_file(path, animation.to_html())


def _gif(animation: Animation, path: Path, dark: bool, progress: Progress | None) -> None:
    if animation.fps > FASTEST:
        what = f"a GIF shows at most {FASTEST:g} frames a second (fps is {animation.fps:g})"
        raise RunError(what, fix="animate with fps=50 or less, or write .svg or .mp4", code="E406")
    painter = animation._painter(dark)
    write_with(path, lambda beside: write_gif(beside, painter, animation.frames, animation.duration, progress))


def _video(kind: str, animation: Animation, path: Path, dark: bool, progress: Progress | None) -> None:
    ffmpeg()
    painter = animation._painter(dark)
    write_with(path, lambda beside: write_video(beside, kind, painter, animation.frames, animation.fps, progress))


ENDINGS: Mapping[str, Callable[[Animation, Path, bool, Progress | None], None]] = {
    ".svg": _svg,
    ".html": _html,
    ".gif": _gif,
    ".mp4": partial(_video, "mp4"),
    ".webm": partial(_video, "webm"),
}
"""The function that writes a file, for each ending of its name."""
