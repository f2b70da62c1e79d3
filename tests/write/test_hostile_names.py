"""Texts from a model in every output: no escape, no markup, no line of its own, no turned direction gets out."""

import json
import re
import shutil
import subprocess
from html.parser import HTMLParser

import pytest

import built_in
import lagrangian as lg

ATTACK = (
    '\x1b[31mred\x1b]0;title\x07 <script>alert(1)</script> \\input{x} $x$ `x` | */ # """ \' '
    "\u202egnp\u202c \u2066a\u2069"
)
NODE = shutil.which("node")
CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\u200e\u200f]")


@pytest.fixture(scope="module")
def hostile() -> lg.System:
    system = lg.System(ATTACK)
    x = system.coordinate("x", ATTACK)
    m = system.parameter("m", 1.0, description=ATTACK + "\nsecond line")
    k = system.parameter("k", 2.0)
    F = system.input("F", ATTACK)
    system.particle(m, at=system.origin + (x, 0), name="<b>'\"\\body{}$%&#_^~</b>")
    system.spring(k, deflection=x, name='*/ # """ --> ]]> <!--')
    system.force(F, deflection=x, name="`|`\u202e" if "\u202e".isprintable() else "`|`")
    return system


class _Tags(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.tags: set[str] = set()

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self.tags.add(tag)


def test_pages_hold_no_control_characters(hostile: lg.System) -> None:
    derivation = hostile.derive()
    for page in (derivation.to_text(), derivation.to_markdown(), derivation.to_latex(), derivation.to_html()):
        assert not CONTROL.search(page), repr(CONTROL.search(page))


def test_html_has_the_tags_of_an_innocent_page_only(hostile: lg.System) -> None:
    innocent, attacked = _Tags(), _Tags()
    innocent.feed(built_in.derivation("lecture-3a").to_html())
    attacked.feed(hostile.derive().to_html())
    assert attacked.tags <= innocent.tags
    assert "<script>alert" not in hostile.derive().to_html()
    assert "<script>alert" not in hostile.derive().to_markdown()


def test_latex_runs_no_command_of_a_name(hostile: lg.System) -> None:
    page = hostile.derive().to_latex()
    assert "\\input{x}" not in page and "\\body" not in page


@pytest.mark.parametrize("ending", ["c", "py", "js", "wasm"])
def test_sources_hold_no_text_of_a_model_as_code(hostile: lg.System, tmp_path, ending: str) -> None:
    for path in hostile.export(tmp_path / f"s.{ending}"):
        if path.suffix == ".wasm":
            assert b"alert" not in path.read_bytes()
            continue
        code = path.read_text(encoding="utf-8")
        assert not CONTROL.search(code) and code.isascii()
        assert "body" not in code and "<script" not in code
        assert path.suffix == ".json" or "alert" not in code
        if ending == "py":
            compile(code, str(path), "exec")
        if path.suffix == ".js":
            assert "</" not in code and "<!--" not in code
            if NODE:
                subprocess.run([NODE, "--check", str(path)], check=True)


def test_data_come_back_as_they_were(hostile: lg.System) -> None:
    data = json.dumps(hostile.derive().to_dict())
    assert not CONTROL.search(data)
    assert any(value == ATTACK for value in json.loads(data).values())
    text = hostile.to_toml()
    assert not CONTROL.search(text.replace("\n", ""))
    again = lg.loads(text)
    assert again.name == hostile.name and again.to_toml() == text


@pytest.mark.parametrize("kind", ["linearize", "conserved", "equilibria", "compare"])
def test_reports_hold_no_control_characters(hostile: lg.System, kind: str) -> None:
    made = {
        "linearize": hostile.linearize,
        "conserved": hostile.conserved_quantities,
        "equilibria": hostile.equilibria,
        "compare": lambda: hostile.compare(hostile),
    }[kind]()
    for page in (made.to_text(), made.to_html(), made.to_latex(), made.to_markdown()):
        assert not CONTROL.search(page), repr(CONTROL.search(page))
    for page in (made.to_html(), made.to_markdown()):
        assert "<script>alert" not in page
