"""Displayed formulas as rows of LaTeX's ``aligned``."""

from __future__ import annotations

from lagrangian.write.expression_tree import Math
from lagrangian.write.lines import Line, lines
from lagrangian.write.tex import Tex

WIDTH = 84
"""The width of a page in columns of Unicode text."""


def rows(tex: Tex, sides: tuple[Math, ...]) -> list[str]:
    """Return the rows of a formula, each with its alignment point."""
    return [_row(tex, line) for line in lines(sides, WIDTH)]


def _row(tex: Tex, line: Line) -> str:
    right = tex.join(line.right)
    if line.equals:
        return f"{tex.join(line.left)} &{_indent(line.steps)}= {right}".strip()
    return rf"& \quad {_indent(line.steps)}{{}} {right}" if line.steps else f"& {right}"


def _indent(steps: int) -> str:
    return r"\quad " * steps


def displayed(tex: Tex, sides: tuple[Math, ...]) -> str:
    """Return a formula for display mathematics: one row as it is, several in ``aligned``."""
    cut = rows(tex, sides)
    if len(cut) == 1:
        return cut[0].replace("&", "", 1).strip()
    return "\\begin{aligned}\n" + " \\\\\n".join(cut) + "\n\\end{aligned}"


def boxed(tex: Tex, formulas: list[tuple[tuple[Math, ...], int | None]]) -> list[str]:
    """Return the rows of several results, each with a number on its last row if there are several."""
    made: list[str] = []
    for sides, number in formulas:
        cut = [_flush(tex, line) for line in lines(sides, WIDTH)]
        if number is not None and len(formulas) > 1:
            cut[-1] += f" && ({number})"
        made += cut
    return made


def _flush(tex: Tex, line: Line) -> str:
    inner = tex.join((*line.left,)) + (" = " if line.equals else "") + tex.join(line.right)
    return (rf"& {_indent(line.steps)}{{}} " if line.steps else "& ") + inner
