"""Systems that the tests of runs share."""

from __future__ import annotations

import built_in
import lagrangian as lg


def example(name: str) -> lg.System:
    return built_in.system(name)


def oscillator(m: float = 2.0, k: float = 8.0, b: float = 0.4) -> lg.System:
    """A mass on a spring with a damper and a force: m q̈ + b q̇ + k q = F."""
    s = lg.System("oscillator")
    q = s.coordinate("q", "elongation", unit="m")
    mass, stiffness, damping = s.parameters("m k b", m=f"{m} kg", k=f"{k} N/m", b=f"{b} N*s/m")
    force = s.input("F", "push", unit="N")
    s.particle(mass, at=s.point("P", (q, 0)))
    s.spring(stiffness, deflection=q)
    s.damper(damping, deflection=q)
    s.force(force, deflection=q)
    return s


def ball(e: float = 0.5) -> lg.System:
    """A ball above a floor."""
    s = lg.System("ball")
    y = s.coordinate("y")
    s.parameter("e", e)
    s.particle(s.parameter("m", 1.0), at=s.origin + (0, y))
    s.gravity()
    return s


def held_values(t: float) -> float:
    """A signal in two steps: 1 N before 0.5 s, −2 N after."""
    return 1.0 if t < 0.5 else -2.0
