"""The page of errors is that of the enumerations, and the source uses every code and no other."""

import ast
import pathlib
import pickle
import re
import runpy
import typing

import pytest

from lagrangian.codes import Code, CodeText
from lagrangian.errors import ModelError, Notice
from lagrangian.integrate.status import RunStatus
from lagrangian.page.formula import TermKind
from lagrangian.write import html_page

ROOT = pathlib.Path(__file__).parent.parent
PAGE = ROOT / "docs" / "errors.md"
SOURCE = sorted(p for p in (ROOT / "src" / "lagrangian").rglob("*.py") if p.name != "codes.py")
MANUAL = [*sorted((ROOT / "docs").rglob("*.md")), ROOT / "README.md"]


def test_the_page_of_errors_is_what_the_tool_writes() -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert runpy.run_path(str(ROOT / "tools" / "errors_page.py"))["made"](page) == page


def test_the_types_know_the_codes() -> None:
    assert typing.get_args(CodeText) == tuple(Code)


@pytest.mark.slow
def test_every_code_is_used_and_no_other() -> None:
    """As text, ``"E402"``, as a member, ``Code.E107``, or in a message printed as it is, ``"[E505] gave up"``."""
    used: set[str] = set()
    written = [text for file in SOURCE if re.search(r"E\d{3}|\bCode\b", text := file.read_text(encoding="utf-8"))]
    for text in written:
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                used |= set(re.findall(r"^E\d{3}$|(?<=\[)E\d{3}(?=\])", node.value))
            elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "Code":
                used.add(node.attr)
    assert used == set(Code)


def test_the_manual_names_known_codes() -> None:
    named = {code for file in MANUAL for code in re.findall(r"\bE\d{3}\b", file.read_text(encoding="utf-8"))}
    assert named <= set(Code)


def test_the_manual_names_known_statuses() -> None:
    named = [n for file in MANUAL for n in re.findall(r"status ([−-]?\d+)", file.read_text(encoding="utf-8"))]
    assert len(named) > 4
    assert {int(n.replace("−", "-")) for n in named} <= set(RunStatus)


def test_the_legend_names_every_kind_of_term() -> None:
    assert set(html_page.KINDS) == set(typing.get_args(TermKind))


@pytest.mark.parametrize("code", Code)
def test_a_code_says_what_it_means(code: Code) -> None:
    assert code.what and not code.what.endswith(".")
    assert code.explanation.endswith(".")
    assert "|" not in code.what + code.explanation


def test_an_unknown_code_is_refused() -> None:
    with pytest.raises(ValueError, match="E999"):
        ModelError("something", code="E999")  # type: ignore[arg-type]


def test_the_code_of_an_error_explains_itself() -> None:
    error = ModelError("its mass is negative", code="E102")
    assert error.code == "E102" and str(error) == "[E102] its mass is negative"
    assert error.code is not None and error.code.what == "a negative mass"
    assert pickle.loads(pickle.dumps(error)).code is Code.E102
    assert str(Notice(Code.E107, "system 's'", "no gravity")) == "[E107] system 's': no gravity"
