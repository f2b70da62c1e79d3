"""The pictures in README and manual are those that the program draws today, and what is said of them is true."""

import pathlib
import re
import runpy
import xml.etree.ElementTree as ET

import pytest

import built_in
import lagrangian as lg

ROOT = pathlib.Path(__file__).parent.parent
PICTURES = runpy.run_path(str(ROOT / "tools" / "pictures.py"))


def _rounded(text: str) -> str:
    """The text without the last digits of its numbers, which another machine may round in another way."""
    return re.sub(r"-?\d+\.\d+", lambda m: f"{round(float(m.group()), 0):.0f}".replace("-0", "0"), text)


@pytest.mark.parametrize("file", PICTURES["EXAMPLES"])
def test_the_stored_picture_is_the_one_drawn_today(file: str) -> None:
    stored = (PICTURES["FIGURES"] / file).read_text(encoding="utf-8")
    assert _rounded(stored) == _rounded(PICTURES["drawn"](file)), "run python tools/pictures.py"


def test_the_readme_begins_with_the_picture() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    at = text.index("docs/figures/cart-pole.svg")
    assert text[:at].count("\n") < 12


@pytest.mark.slow
def test_from_a_blank_file_to_a_picture_in_motion(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Equations in 11 lines; a run, a picture and an animation by a line each."""
    text = (ROOT / "docs" / "schematic.md").read_text(encoding="utf-8")
    first, more = re.findall(r"^```python\n(.*?)^```", text, flags=re.M | re.S)[:2]
    assert len([line for line in first.splitlines() if line.strip()]) == 11
    assert len(more.strip().splitlines()) == 3
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    exec(compile(first + more, "schematic.md", "exec"), names)
    for name in ("cart-pole.svg", "motion.svg"):
        ET.fromstring((tmp_path / name).read_text(encoding="utf-8"))


def page(language: str) -> list[str]:
    text = (ROOT / "docs" / "schematic.md").read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```", text, flags=re.M | re.S)


@pytest.mark.slow
def test_what_the_page_says_of_hints_runs(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile("\n".join(page("python")[2:]), "schematic.md", "exec"), {})
    assert "(B)" in (tmp_path / "both.svg").read_text(encoding="utf-8")
    (hints,) = page("toml")
    system = lg.loads(built_in.system("cart-pole").to_toml() + "\n" + hints)
    kinds = {part.kind for part in system.look().scene.parts}
    assert {"string", "shape"} <= kinds


def test_the_words_of_the_page_are_those_that_are_said() -> None:
    (said,) = page("text")
    assert " ".join(said.split()) == built_in.picture("cart-pole").description
