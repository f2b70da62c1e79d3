"""The gallery of the manual has a page for every example, which says what the example is."""

import pathlib
import re
import runpy
import xml.etree.ElementTree as ET

import pytest

from lagrangian import examples

GALLERY = runpy.run_path(str(pathlib.Path(__file__).parents[2] / "tools" / "gallery.py"))


def test_the_first_page_leads_to_every_example() -> None:
    text = GALLERY["index"]()
    assert re.findall(r"^\| \[(.+)\]\(\1\.md\) \|", text, flags=re.M) == list(examples.names())
    assert text.partition("{toctree}")[2].split()[3:-1] == list(examples.names())


@pytest.mark.parametrize("name", ["lecture-3b", "two-carts"])
def test_a_page_has_the_lesson_the_file_and_the_equations(name: str) -> None:
    text = GALLERY["page"](name)
    assert examples.describe(name) in text
    assert examples.text(name).strip() in text
    assert f"]({name}.svg)" in text and "Cart" in text.partition("](")[0]
    assert r"\boxed" in text and "Verified" not in text
    assert "x}_{1}" in text.partition("## Result")[2]


def test_a_page_that_is_right_is_not_written_again(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(examples, "names", lambda: ("pendulum",))
    (tmp_path / "gone.md").touch()
    (tmp_path / "gone.svg").touch()
    GALLERY["write"](tmp_path)
    first = {path.name: path.stat().st_mtime_ns for path in tmp_path.iterdir()}
    GALLERY["write"](tmp_path)
    assert first == {path.name: path.stat().st_mtime_ns for path in tmp_path.iterdir()}
    assert set(first) == {"index.md", "pendulum.md", "pendulum.svg"}


def test_a_picture_is_a_file_beside_its_page(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(examples, "names", lambda: ("pendulum",))
    GALLERY["write"](tmp_path)
    assert 'src="pendulum.svg"' in (tmp_path / "index.md").read_text(encoding="utf-8")
    root = ET.fromstring((tmp_path / "pendulum.svg").read_text(encoding="utf-8"))
    assert {"m", "b"} <= {name for g in root.iter() for name in g.get("data-element", "").split()}
