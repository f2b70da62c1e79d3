"""Writes the frames of a motion to files: GIF by Pillow, MP4 and WebM by ffmpeg.

Files are written where the caller says, without regard to what is there.
"""

from __future__ import annotations

import importlib
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from lagrangian.errors import Error, MissingExtra
from lagrangian.view.frames import FramePainter, pillow

if TYPE_CHECKING:
    from PIL.Image import Image

Progress = Callable[[int, int], object]

COLOURS = 96
"""The number of colours of a GIF; there are few colours in a line drawing, and mixtures of them at edges."""

FASTEST = 50.0
"""The largest number of frames a second that browsers show of a GIF."""

CODECS = {
    "mp4": ("-c:v", "libx264", "-crf", "20", "-pix_fmt", "yuv420p", "-movflags", "+faststart"),
    "webm": ("-c:v", "libvpx-vp9", "-crf", "32", "-b:v", "0", "-pix_fmt", "yuv420p"),
}
"""The options of ffmpeg by format."""


def write_gif(path: Path, painter: FramePainter, count: int, duration: float, progress: Progress | None = None) -> None:
    """Write a GIF that repeats for ever; its ``count`` frames last ``duration`` [s] together, to 0.01 s."""
    image = pillow("Image")
    shown = [painter.frame(k) for k in sorted({0, count // 3, 2 * count // 3, count - 1})]
    sheet = image.new("RGB", (painter.width, painter.height * len(shown)))
    for i, frame in enumerate(shown):
        sheet.paste(frame, (0, painter.height * i))
    palette = sheet.quantize(COLOURS, method=image.Quantize.MEDIANCUT)

    def reduced() -> Iterator[Image]:
        for frame in told(painter.frames(), count, progress):
            yield frame.quantize(palette=palette, dither=image.Dither.NONE)

    frames = reduced()
    first = next(frames)
    shown_for = centiseconds(count, duration)
    with path.open("wb") as file:  # Pillow leaves a file open if it is interrupted
        first.save(file, format="GIF", save_all=True, append_images=frames, duration=shown_for, loop=0, disposal=1)


def centiseconds(count: int, duration: float) -> list[int]:
    """Return how long each frame is shown [ms], in steps of 10 ms: rounding errors do not add up.

    Every frame but the last one lasts the same time; the last one lasts as long as those before it.
    """
    ends = np.round(100 * duration * np.arange(1, count + 1) / max(count - 1, 1)).astype(int)
    return [10 * int(x) for x in np.diff(ends, prepend=0)]


def told(frames: Iterator[Any], count: int, progress: Progress | None) -> Iterator[Any]:
    """Return the same frames, and report each of them."""
    for done, frame in enumerate(frames, 1):
        yield frame
        if progress is not None:
            progress(done, count)


def write_video(
    path: Path, kind: str, painter: FramePainter, count: int, fps: float, progress: Progress | None = None
) -> None:
    """Write a video through ffmpeg; ``kind`` is "mp4" or "webm". Raises `MissingExtra` if there is no ffmpeg."""
    command = [ffmpeg(), "-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"]
    command += ["-s", f"{painter.width}x{painter.height}", "-r", f"{fps:g}", "-i", "-", "-an", *CODECS[kind]]
    command += ["-f", kind, f"file:{path}"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        assert process.stdin is not None and process.stderr is not None
        try:
            _feed(process.stdin, told(painter.frames(), count, progress))
        except BaseException:
            process.kill()
            raise
        said = process.stderr.read().decode(errors="replace").strip()
    if process.returncode:
        last = said.splitlines()[-1][:200] if said else f"exit code {process.returncode}"
        fix = f"write .gif or .svg, or use an ffmpeg with the encoder {CODECS[kind][1]}"
        raise Error(f"ffmpeg cannot write the video: {last}", fix=fix, code="E801")


def _feed(pipe: IO[bytes], frames: Iterator[Image]) -> None:
    """Write the frames to ffmpeg; if it ended early, its own message says why."""
    try:
        for frame in frames:
            pipe.write(frame.tobytes())
        pipe.close()
    except BrokenPipeError:
        return


def ffmpeg() -> str:
    """Return the program: the one on the path, or that of the package ``imageio-ffmpeg``."""
    if (found := shutil.which("ffmpeg")) is not None:
        return found
    try:
        return importlib.import_module("imageio_ffmpeg").get_ffmpeg_exe()
    except (ImportError, RuntimeError):
        what = "videos need the program ffmpeg, or the package 'imageio-ffmpeg'"
        raise MissingExtra(what, fix="pip install imageio-ffmpeg, or write .svg or .gif", code="E801") from None
