"""What the Python library advises, in the words of the command line: ``step=0.01`` is ``--step 0.01`` there."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator

from lagrangian.errors import Error

_WORDS = (
    (r"simulate\(10\.0\)|a duration(?=, or duration =)", "--duration 10"),
    (r"params\s*=\s*\{'([^']+)': …\}", r"--set \1=…"),
    (r"inputs=\{'([^']+)': ([^}]*)\}", r"--input \1=\2"),
    (r"samples=\d+ \((--samples \d+)\)", r"\1"),
    (r"\bmax_step=([\d.]+)", r"--max-step \1"),
    (r"\bstep=([\d.]+)", r"--step \1"),
    (r"\bmax_step\b", "--max-step"),
    (r"method='(\w+)'", r"--method \1"),
)


def in_options(text: str) -> str:
    """The text with what is written in Python as options of a command."""
    for pattern, option in _WORDS:
        text = re.sub(pattern, option, text)
    return text


@contextlib.contextmanager
def advising_options() -> Iterator[None]:
    """Errors that come out of the block advise options of a command."""
    try:
        yield
    except Error as trouble:
        if trouble.fix:
            trouble.fix = in_options(trouble.fix)
        raise
