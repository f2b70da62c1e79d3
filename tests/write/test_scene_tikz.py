"""Pictures for LaTeX: the same places as the SVG, balanced, harmless, and compiled where there is a LaTeX."""

import pathlib
import re
import shutil
import subprocess
from math import cos, sin

import pytest

from hand_scenes import TURN, carts, hostile, pendulum
from lagrangian.write.scene_tikz import scene_tikz

SCENES = {"pendulum": pendulum, "carts": carts, "hostile": hostile}


@pytest.mark.parametrize("name", SCENES)
def test_it_is_balanced_and_uses_only_commands_of_tikz(name: str) -> None:
    text = scene_tikz(SCENES[name]())
    code = "\n".join(line for line in text.splitlines() if not line.startswith("%"))
    bare = code.replace(r"\{", "").replace(r"\}", "")
    assert bare.count("{") == bare.count("}")
    assert code.replace(r"\$", "").count("$") == 2 * code.count(r"\node")
    kept = [line for line in code.splitlines() if not line.startswith((r"\path[", r"\node[", r"\definecolor{"))]
    assert [line.partition("[")[0] for line in kept] == [r"\begin{tikzpicture}", r"\end{tikzpicture}"]


def test_parts_lie_where_the_scene_says() -> None:
    x, y = 115 + 150 * sin(TURN), 62 + 150 * cos(TURN)
    text = scene_tikz(pendulum())
    assert f"({x:.0f},{y:.1f}) circle[radius=11]" in text
    assert f"(115,62) -- ({x:.0f},{y:.1f})" in text
    assert "dash pattern=on" in text and r"{$\theta_{1}$}" in text


def test_a_curve_keeps_its_control_points() -> None:
    pair = r"\((.*?),(.*?)\)"
    found = re.search(rf"{pair} \.\. controls {pair} and {pair} \.\. {pair}", scene_tikz(carts()))
    assert found is not None  # from 185 to 291, a fifth of the way in, 5 px up and down
    assert [float(x) for x in found.groups()] == pytest.approx([185, 100, 206.2, 95, 269.8, 105, 291, 100])


def test_hostile_names_are_printed_and_not_run() -> None:
    text = scene_tikz(hostile())
    assert all(len(line) < 400 for line in text.splitlines())
    assert "\x00" not in text and "\u202e" not in text


@pytest.mark.parametrize("name", SCENES)
def test_latex_compiles_it(name: str, tmp_path: pathlib.Path) -> None:
    program = shutil.which("pdflatex")
    if program is None:
        pytest.skip("no pdflatex")
    document = scene_tikz(SCENES[name](), document=True).replace("[border=2mm]{standalone}", "{article}")
    (tmp_path / "scene.tex").write_text(document, encoding="utf-8")
    command = [program, "-interaction=nonstopmode", "-halt-on-error", "scene.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout.decode(errors="replace")[-3000:]
    assert b"Overfull" not in done.stdout and (tmp_path / "scene.pdf").stat().st_size > 1000
