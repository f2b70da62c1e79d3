"""Names of exported files and of the functions in them."""

from __future__ import annotations

import keyword
import sys

from lagrangian.errors import ModelError

LONGEST_STEM = 200
"""The largest number of characters before the ending of a source file, so that file systems accept the name."""

MODULES = frozenset((*sys.stdlib_module_names, *keyword.kwlist, "jax", "jaxlib", "casadi", "numpy", "scipy", "np"))
"""Modules that exported ones import, or these again, for which a file of that name would be taken, and words of
Python, after which nothing can be imported."""

HEADERS = frozenset(
    """
    assert complex ctype errno fenv float inttypes limits locale math setjmp signal stdalign stdarg stdatomic stdbool
    stddef stdint stdio stdlib string tgmath threads time uchar wchar wctype
    """.split()  # noqa: SIM905
)
"""Headers of C: one of the same name could be included in their place."""

WORDS_OF_C = frozenset(
    """
    auto break case char const continue default do double else enum extern float for goto if inline int long register
    restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
    """.split()  # noqa: SIM905
)
"""Words of C, which cannot name an S-function."""

WORDS_OF_MODELICA = frozenset(
    """
    algorithm and annotation assert block break class connect connector constant constrainedby der discrete each else
    elseif elsewhen encapsulated end enumeration equation expandable extends external false final flow for function if
    import impure in initial inner input loop model not operator or outer output package parameter partial protected
    public pure record redeclare replaceable return stream then true type when while within
    Boolean Integer Real String abs acos asin atan atan2 ceil cos cosh delay div edge exp floor homotopy integer log
    log10 max min mod noEvent pre reinit rem sample semiLinear sign sin sinh smooth sqrt tan tanh terminal terminate
    time
    """.split()  # noqa: SIM905
)
"""Words and functions of Modelica, which cannot name a model or a variable."""


def check_stem(stem: str, longest: int = LONGEST_STEM, why: str = "") -> None:
    """Raise `ModelError` for a name after which functions cannot be called, or that is longer than ``longest``."""
    if len(stem) > longest:
        raise ModelError(
            f"the name {stem[:20]}… has {len(stem)} characters, and functions are called after it{why}",
            fix=f"use at most {longest}",
            code="E702",
        )
    if not (stem.isascii() and stem.isidentifier()):
        raise ModelError(
            f"'{stem}' cannot begin the name of a function", fix="use letters, digits and underscores", code="E702"
        )
