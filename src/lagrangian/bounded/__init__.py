"""SymPy's general routines within bounds: sizes are predicted before anything is expanded, and searches are counted.

Expanded, an expression may be exponentially longer than it was when written: (a + b + c)^50, sixty definitions that
each use another twice, a chain of frames in space. So the size of a result is predicted from the structure of an
expression. Beyond `MAX_OPERATIONS` the expression is left as it is (`expand`) or refused (`diff`, `written_out`). The
cost of a search for a closed form or a common factor cannot be predicted: `searched` counts the calls that it makes and
gives up after `CALLS`, and `answered` counts those of a whole question about a system. All of them count operations, so
the answer does not depend on how fast or how busy a machine is.
"""

from lagrangian.bounded.effort import count_operations, is_counted
from lagrangian.bounded.garbage import rarely_collected
from lagrangian.bounded.irreducible import split
from lagrangian.bounded.operations import operations
from lagrangian.bounded.parts import rebuilt, replaced
from lagrangian.bounded.questions import answered, hard
from lagrangian.bounded.searches import absolute, cancel, factored, is_zero, searched, simplify, together, trigsimp
from lagrangian.bounded.sizes import (
    MAX_OPERATIONS,
    TERMS,
    Budget,
    TooLarge,
    atoms,
    check_size,
    each,
    letters,
    names,
    size,
    symbols,
    terms,
)
from lagrangian.bounded.slopes import diff
from lagrangian.bounded.writing import expand, is_one, written_out

__all__ = [
    "MAX_OPERATIONS",
    "TERMS",
    "Budget",
    "TooLarge",
    "absolute",
    "answered",
    "atoms",
    "cancel",
    "check_size",
    "count_operations",
    "diff",
    "each",
    "expand",
    "factored",
    "hard",
    "is_counted",
    "is_one",
    "is_zero",
    "letters",
    "names",
    "operations",
    "rarely_collected",
    "rebuilt",
    "replaced",
    "searched",
    "simplify",
    "size",
    "split",
    "symbols",
    "terms",
    "together",
    "trigsimp",
    "written_out",
]
