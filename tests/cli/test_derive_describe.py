"""``derive --describe``: what the system looks like, in words, before its steps."""

import pytest

from lagrangian.cli import main


@pytest.mark.parametrize("format", ["text", "markdown"])
def test_the_words_come_first(capsys: pytest.CaptureFixture[str], format: str) -> None:
    assert main(["derive", "-e", "cart-pole", "--describe", "--brief", "--format", format]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "What it looks like" in out.partition("Holonomic")[0]
    assert "A cart on a horizontal track; a pole hinged on the cart." in out.partition("Holonomic")[0]


def test_without_it_nothing_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["derive", "-e", "cart-pole", "--brief"]) == 0
    assert "looks like" not in capsys.readouterr().out


@pytest.mark.parametrize("format", ["html", "latex", "json"])
def test_formats_that_show_it_another_way_refuse_it(capsys: pytest.CaptureFixture[str], format: str) -> None:
    assert main(["derive", "-e", "pendulum", "--describe", "--format", format]) != 0
    assert "--describe is for text and Markdown" in capsys.readouterr().err
