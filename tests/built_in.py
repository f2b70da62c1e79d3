"""Built-in examples, derived once in a process for the tests of all files."""

from __future__ import annotations

import tomllib
from functools import cache

import lagrangian as lg
from lagrangian import examples

TABLES = {"constraint", "velocity_constraint", "pin", "ball", "slider", "weld", "rolling", "rope"}
CONSTRAINED = tuple(n for n in examples.names() if TABLES & set(tomllib.loads(examples.text(n))))
LARGE = {"whipple-bicycle", "stewart-platform", "andrews-squeezer"}
"""Examples that take seconds; what they show, smaller ones show too."""
FREE = tuple(n for n in examples.names() if n not in CONSTRAINED)
"""Examples with as many coordinates as degrees of freedom."""


@cache
def derivation(name: str) -> lg.Derivation:
    return lg.loads(examples.text(name), name=name).derive()


@cache
def picture(name: str) -> lg.Picture:
    return lg.example(name).look()
