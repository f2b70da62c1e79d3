"""Reports of analyses in every format."""

import json

import pytest

import lagrangian as lg
from lagrangian import write
from lagrangian.errors import ModelError
from lagrangian.page.formula import Check, Name, formula, text
from lagrangian.page.formula import Table as Rows
from lagrangian.page.report import Part, Report


@pytest.fixture
def report() -> Report:
    system = lg.System("swing <b>")
    theta = system.coordinates("theta")
    m, L = system.parameters("m L")
    system.particle(m, at=system.origin + (L * theta, 0))
    p = m * L**2 * theta.diff()
    table = Rows((text("name"), text("value")), ((text("p"), text(p)),))
    parts = (
        Part(text("Momentum of ", theta), (text("It is kept."), formula(Name("p"), p, boxed=True), table)),
        Part(text("Checked"), checks=(Check(text("it holds"), True, "1e-16"), Check(text("it fails"), False, "3"))),
    )
    return Report("What is kept <i>", system.model, parts, {"kept": ["p"], "drift": 1e-16})


def test_text_has_the_parts_in_order(report: Report) -> None:
    lines = write.write_report(report).splitlines()
    assert lines[0] == "What is kept <i>"
    assert "Momentum of θ" in lines
    assert any("p = m L² θ̇" in line for line in lines)
    assert "✓ it holds (10⁻¹⁶)" in lines and "✗ it fails (3)" in lines


def test_markup_is_escaped(report: Report) -> None:
    assert "<i>" not in write.write_report(report, "html")
    assert "<h1>What is kept &lt;i&gt;</h1>" in write.write_report(report, "html")
    assert "&lt;i&gt;" in write.write_report(report, "markdown")


def test_json_is_the_data(report: Report) -> None:
    assert json.loads(write.write_report(report, "json")) == {"kept": ["p"], "drift": 1e-16}


def test_latex_is_a_whole_article(report: Report) -> None:
    made = write.write_report(report, "latex")
    assert made.startswith("\\documentclass") and made.rstrip().endswith("\\end{document}")


def test_a_notebook_gets_a_fragment(report: Report) -> None:
    made = write.report_fragment(report)
    assert made.startswith("<div") and "<html" not in made


def test_an_unknown_format_is_named(report: Report) -> None:
    with pytest.raises(ModelError, match="no format 'pdf'"):
        write.write_report(report, "pdf")  # type: ignore[arg-type]
