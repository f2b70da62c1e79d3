"""Names of exported files and of the functions in them."""

from __future__ import annotations

from lagrangian.errors import ModelError

LONGEST_STEM = 200
"""The largest number of characters before the ending of a source file, so that file systems accept the name."""


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
