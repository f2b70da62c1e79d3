"""Built-in examples, derived once in a process for the tests of all files."""

from __future__ import annotations

from functools import cache

import lagrangian as lg
from lagrangian import examples


@cache
def derivation(name: str) -> lg.Derivation:
    return lg.loads(examples.text(name), name=name).derive()
