"""``lagrangian animate`` as it is typed."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from lagrangian.cli import main


def said(capsys: pytest.CaptureFixture[str], *argv: str) -> tuple[int, str, str]:
    code = main(["animate", *argv])
    out, err = capsys.readouterr()
    return code, out, err


def test_a_file_is_written(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "carts.svg"
    code, out, err = said(capsys, "-e", "double-pendulum", "-d", "3", "--trail", "P2,P1", "-o", str(path))
    assert code == 0 and err == ""
    assert out == f"wrote {path}: t = 0 … 3 s, 76 frames, 3 s\n"
    root = ElementTree.fromstring(path.read_text(encoding="utf-8"))
    strokes = [x for x in root.iter() if x.get("attributeName") == "stroke-dashoffset"]
    assert len(strokes) == 2


def test_data_about_it_is_json(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    argv = ["-e", "pendulum", "-d", "40", "--fps", "10", "--width", "300", "-o", str(tmp_path / "a.html"), "--json"]
    code, out, _ = said(capsys, *argv)
    data = json.loads(out)
    assert code == 0 and data["success"] is True
    assert (data["frames"], data["duration"], data["fps"], data["width"]) == (201, 20.0, 10.0, 300.0)
    assert data["end"] == 40.0 and data["bytes"] == (tmp_path / "a.html").stat().st_size


def test_svg_goes_to_standard_output(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = said(capsys, "-e", "pendulum", "-d", "1", "-o", "-")
    assert code == 0 and ElementTree.fromstring(out.partition("\n")[2]).get("role") == "img"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("argv", "words"),
    [
        (["-e", "pendulum"], "no file was given"),
        (["-e", "pendulum", "-o", "a.avi"], "the ending of 'a.avi' is not supported"),
        (["-e", "pendulum", "-o", "a.bmp"], "use one of .svg, .html, .gif, .mp4, .webm"),
        (["-e", "pendulum", "-o", "a.svg", "--trail", "nowhere"], "there is no point or body 'nowhere'"),
        (["-e", "pendulum", "-o", "a.svg", "--speed", "0"], "speed must be a number above 0"),
        (["-e", "pendulum", "-o", "a.svg", "--fps", "1000"], "fps must be a number above 0 and up to 120"),
        (["-e", "pendulum", "-o", "a.svg", "--width", "-5"], "width must be a number above 0"),
        (["-e", "pendulum", "-o", "a.svg", "-d", "10", "--speed", "1e-3"], "the limit is 6000"),
        (["-e", "duffing", "-o", "a.svg", "-d", "100", "--samples", "8"], "too far apart for an animation"),
        (["-e", "pendulum", "-o", "a.gif", "--fps", "60"], "a GIF shows at most 50 frames a second"),
    ],
)
def test_mistakes_are_said_with_a_remedy(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    argv: list[str],
    words: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    code, out, err = said(capsys, *argv)
    assert code == 2 and out == ""
    assert words in err and "\nFix: " in err
    assert list(tmp_path.iterdir()) == []


def test_a_remedy_names_options(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    argv = ["-e", "duffing", "-o", str(tmp_path / "a.svg"), "-d", "100", "--samples", "8"]
    assert "--samples 32" in said(capsys, *argv)[2]


def test_an_existing_file_is_kept_without_force(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "a.svg"
    path.write_text("mine", encoding="utf-8")
    code, _, err = said(capsys, "-e", "pendulum", "-d", "1", "-o", str(path))
    assert code == 2 and "exists already" in err and path.read_text(encoding="utf-8") == "mine"
    assert said(capsys, "-e", "pendulum", "-d", "1", "-o", str(path), "--force")[0] == 0
    assert path.read_text(encoding="utf-8").startswith("<?xml")


def test_without_pillow_a_gif_says_what_to_install(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "PIL.Image", None)
    code, _, err = said(capsys, "-e", "pendulum", "-d", "1", "-o", str(tmp_path / "a.gif"))
    assert code == 2 and "pip install 'lagrangian[animate]'" in err
    assert list(tmp_path.iterdir()) == []


def test_without_ffmpeg_a_video_says_what_to_install(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    monkeypatch.setattr("shutil.which", lambda name: None)
    code, _, err = said(capsys, "-e", "pendulum", "-d", "1", "-o", str(tmp_path / "a.mp4"))
    assert code == 2 and "pip install imageio-ffmpeg, or write .svg or .gif" in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_a_run_that_stops_early_is_shown_so_far(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "carts.svg"
    argv = ["-e", "two-carts", "-d", "3", "--input", "F=2/(1 - t)^2", "-o", str(path)]
    code, out, err = said(capsys, *argv)
    assert code == 1 and out.startswith("wrote") and err.startswith("error: ")
    text = "".join(ElementTree.fromstring(path.read_text(encoding="utf-8").partition("\n")[2]).itertext())
    assert "stopped at t = " in text
