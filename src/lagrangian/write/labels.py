"""Names of quantities for axes and columns: as LaTeX and as one line of text."""

from __future__ import annotations

from typing import Any

from lagrangian.model import Model
from lagrangian.write.expression import Expressions
from lagrangian.write.tex import PAGE
from lagrangian.write.unicode_math import unicode


class Labels:
    """Writes the names and expressions of one system in the same way as its derivation."""

    def __init__(self, model: Model) -> None:
        self._laid = Expressions(model)

    def tex(self, expr: Any) -> str:
        r"""LaTeX of an expression, such as ``\dot{\theta}_{1}``."""
        return PAGE.latex(self._laid(expr))

    def text(self, expr: Any) -> str:
        """One line of Unicode text, such as ``θ̇₁``."""
        return unicode(self._laid(expr))
