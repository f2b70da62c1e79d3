"""Formulas of the manual as MathML: browsers set it themselves, so no page needs a script or a network."""

import html
import re
from typing import Any

from docutils import nodes
from latex2mathml.converter import convert

BOXED = re.compile(r"\\boxed\{(.*)\}", re.S)
TAG = re.compile(r"<[^>]*>")
FUNCTION = re.compile(r"<m[io]>(sin|cos|tan|cot|exp|ln|log|arctan)</m[io]>")
ALIGNED = re.compile(r"\\begin\{aligned\}(.*?)\\end\{aligned\}", re.S)


def columns(aligned: re.Match[str]) -> str:
    """An ``aligned``, which the converter does not know, as a column of lines and one of the equations' numbers."""
    return r"\begin{array}{ll}" + r" \\ ".join(map(row, aligned[1].split(r"\\"))) + r"\end{array}"


def row(latex: str) -> str:
    """One line; what goes on with an = is set in."""
    line, _, number = latex.strip().partition("&&")
    line = re.sub(r"^& *=", r"\\quad =", line).replace("&", "", 1)
    return f"{line} & {number}" if number else line


def signs(text: str) -> list[str]:
    """The digits, brackets and signs of a formula, which a conversion keeps."""
    return sorted(c.replace("−", "-") for c in text if c in "0123456789+-−=()")


def mathml(latex: str, display: str) -> str:
    """The MathML of a formula."""
    latex = ALIGNED.sub(columns, latex.strip()).replace(r"\#", "#")
    found = convert(latex, display=display).replace("<mover>", '<mover accent="true">')
    if signs(latex) != signs(html.unescape(TAG.sub("", found))):
        raise ValueError(f"the converter lost a part of the formula {latex}")
    return FUNCTION.sub(r'<mo lspace="0.17em" rspace="0.17em">\1</mo>', found)


def inline(writer: Any, node: nodes.math) -> None:
    """Write a formula within a line."""
    writer.body.append(mathml(node.astext(), "inline"))
    raise nodes.SkipNode


def block(writer: Any, node: nodes.math_block) -> None:
    """Write a formula on lines of its own, in a frame where it is a result."""
    latex = node.astext().strip()
    boxed = BOXED.fullmatch(latex)
    css = "formula result" if boxed else "formula"
    writer.body.append(f'<div class="{css}">{mathml(boxed[1] if boxed else latex, "block")}</div>\n')
    raise nodes.SkipNode


def setup(app: Any) -> dict[str, bool]:
    """Register the renderer."""
    app.add_html_math_renderer("mathml", inline_renderers=(inline, None), block_renderers=(block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
