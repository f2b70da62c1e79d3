"""Advice for users of the command: the argument that Python writes as ``step=0.01`` is ``--step 0.01`` there."""

from __future__ import annotations

from lagrangian.advice import Advice, Argument, Verb

_OPTIONS = {
    "outputs": "--output-of",
    "params": "--set",
    "inputs": "--input",
    "initial": "--init",
    "overwrite": "--force",
    "store": "-o",
}
"""Options that are not called after the argument."""


def in_options(text: str) -> str:
    """Return advice with arguments written as options; other text unchanged."""
    return text.spelled(_spelled) if isinstance(text, Advice) else text


def _spelled(piece: Argument | Verb) -> str:
    if isinstance(piece, Verb):
        return f"`lagrangian {piece.name}`"
    if piece.name == "grid":
        return f"{piece.key or 'k'}=10:100:50"
    option = _OPTIONS.get(piece.name, "--" + piece.name.replace("_", "-"))
    if piece.value is None or piece.value == "True":
        return option
    value = piece.value.strip("'\"")
    given = value if piece.key is None else f"{piece.key}={value}"
    return f"{option} " + (f'"{given}"' if " " in given else given)
