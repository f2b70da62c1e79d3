"""What the first page and the tutorial show is what their Python prints."""

import contextlib
import io
import pathlib
import re

import pytest

DOCS = pathlib.Path(__file__).parents[1] / "docs"
FENCE = re.compile(r"^```(python|text)\n(.*?)^```$", re.M | re.S)


def shown(page: str) -> list[tuple[str, str]]:
    """Every block of Python, with the block of text that follows it and says what it prints."""
    found: list[tuple[str, str]] = []
    for language, body in FENCE.findall((DOCS / page).read_text(encoding="utf-8")):
        if language == "python":
            found.append((body, ""))
        else:
            found[-1] = (found[-1][0], body)
    return found


def printed(code: str, names: dict[str, object]) -> str:
    output = io.StringIO()
    with contextlib.redirect_stdout(output):
        exec(compile(code, "page", "exec"), names)
    lines = output.getvalue().rstrip().splitlines()
    return "".join(f"{line.rstrip()}\n" for line in lines)


@pytest.mark.parametrize("page", ["index.md", pytest.param("tutorial.md", marks=pytest.mark.slow)])
def test_every_block_prints_what_the_page_shows(page: str) -> None:
    names: dict[str, object] = {}
    for code, output in shown(page):
        assert printed(code, names) == output, code
