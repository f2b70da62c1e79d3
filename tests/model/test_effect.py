"""What acts on nothing that a coordinate moves is refused, and what acts on something is not."""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy as sp

import lagrangian as lg


def _cart() -> lg.System:
    s = lg.System("cart")
    x = s.coordinate("x")
    s.particle(s.parameter("m"), at=s.point("P", (x, 0)))
    return s


USELESS: dict[str, tuple[Callable[[lg.System], object], str]] = {
    "torque on a constant angle": (lambda s: s.torque(3, on=s.parameter("alpha")), "turns what it acts on"),
    "torque on a frame that is fixed": (lambda s: s.torque(3, on=s.frame(sp.pi / 3)), "turns what it acts on"),
    "torque on an angle that time alone turns": (lambda s: s.torque(3, on=2 * s.t), "turns what it acts on"),
    "force at the origin": (lambda s: s.force((1, 0), at=s.origin), "moves the point"),
    "force at a fixed point": (lambda s: s.force((1, 0), at=s.origin + (2, 3)), "moves the point"),
    "force at a point that time alone moves": (lambda s: s.force((1, 0), at=s.origin + (s.t, 0)), "moves the point"),
    "spring between two fixed points": (
        lambda s: s.spring(2, between=(s.origin, s.origin + (1, 0))),
        "its two ends apart",
    ),
    "spring between two points of one cart": (
        lambda s: s.spring(2, between=(s["P"] + (1, 0), s["P"] + (0, 2))),
        "its two ends apart",
    ),
    "damper between two fixed points": (
        lambda s: s.damper(2, between=(s.origin, s.origin + (1, 0))),
        "its two ends apart",
    ),
    "force between two fixed points": (
        lambda s: s.force(2, between=(s.origin, s.origin + (1, 0))),
        "its two ends apart",
    ),
    "spring on an input alone": (lambda s: s.spring(2, deflection=s.input("u")), "its deflection"),
}


@pytest.mark.parametrize("case", USELESS)
def test_what_does_nothing_is_refused(case: str) -> None:
    add, words = USELESS[case]
    system = _cart()
    add(system)
    with pytest.raises(lg.ModelError, match=f"E410.*does nothing.*{words}") as caught:
        system.derive()
    assert caught.value.fix
    assert caught.value.element


USEFUL: dict[str, Callable[[lg.System], object]] = {
    "reaction on the cart": lambda s: s.force((1, 0), at=s.origin, reaction=s["P"]),
    "spring to the wall": lambda s: s.spring(2, between=(s.origin + (-3, 0), s["P"])),
    "torque whose reaction turns": lambda s: s.torque(2, on=s.t, reaction=s["x"]),
    "through a definition": lambda s: s.force(2, deflection=s.define("d", 2 * s["x"])),
    "a point moved by a frame": lambda s: s.force((1, 0), at=s.frame(s["x"]).point(1, 0)),
    "a frame in a frame": lambda s: s.torque(1, on=s.frame(1, parent=s.frame(s["x"]))),
    "a force across the motion": lambda s: s.force((0, 1), at=s["P"]),
}


@pytest.mark.parametrize("case", USEFUL)
def test_what_does_something_is_kept(case: str) -> None:
    system = _cart()
    USEFUL[case](system)
    assert len(system.model.elements) == 2
