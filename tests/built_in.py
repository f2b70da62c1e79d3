"""Built-in examples, derived once in a process for the tests of all files."""

from __future__ import annotations

import tomllib
from functools import cache

import lagrangian as lg
from lagrangian import examples
from lagrangian.model import Model

TABLES = {"constraint", "velocity_constraint", "pin", "ball", "slider", "weld", "rolling", "rope"}
CONSTRAINED = tuple(n for n in examples.names() if TABLES & set(tomllib.loads(examples.text(n))))
LARGE = {"whipple-bicycle", "stewart-platform", "andrews-squeezer"}
"""Examples that take seconds; what they show, smaller ones show too."""
SPACE = (
    "balancing-robot", "bead-on-hoop", "furuta-pendulum", "robot-arm", "rolling-disc", "scara", "spherical-pendulum",
    "spinning-top", "stewart-platform", "whipple-bicycle",
)  # fmt: skip
"""Examples in space, by name: to be listed they are not read in every process. A test of the list is in `look`."""
SOME = (
    "lecture-2", "lecture-3b", "cart-pole", "double-pendulum", "spherical-pendulum", "crane", "bead-on-hoop",
    "kapitza-pendulum", "quarter-car", "four-bar", "rolling-disc", "chaplygin-sleigh", "wheel-on-incline",
)  # fmt: skip
"""Examples of every kind, for tests that ask the same of all: in one and two and three dimensions, driven, prescribed,
with springs, with loops, rolling. The others are asked among the tests that take long."""
CIRCUITS = ("capacitive-actuator", "dc-motor", "loudspeaker", "magnetic-levitation")
"""Examples with coils, whose equations are not all F = ma."""
SATURATED = {"magnetic-levitation"}
"""Examples whose T* is not quadratic in the rates: their momenta cannot be solved for the rates."""
FREE = tuple(n for n in examples.names() if n not in CONSTRAINED)
"""Examples with as many coordinates as degrees of freedom."""


@cache
def _read(name: str) -> tuple[lg.System, Model]:
    found = lg.example(name)
    return found, found.model


def system(name: str) -> lg.System:
    """An example that all tests of a process share, with what was computed of it; a test that adds to one copies it."""
    shared, model = _read(name)
    assert shared.model is model, f"an earlier test added something to {name}"
    return shared


@cache
def derivation(name: str) -> lg.Derivation:
    return system(name).derive()


@cache
def picture(name: str) -> lg.Picture:
    return system(name).look()
