"""A plate on three equal cranks, with six coordinates: one of its six rows follows from the others where all hold."""

import numpy as np

import lagrangian as lg

G, CRANK = 9.81, 0.6
START = {"a1": 1.0, "a2": 1.0, "a3": 1.0, "x": CRANK * np.cos(1), "y": CRANK * np.sin(1)}


def plate_on_cranks(lengths=(CRANK, CRANK, CRANK), *, system=None, side=""):
    """The plate and its cranks. ``side`` is put before every name."""
    s = system or lg.System("plate on three cranks")
    before, word = (f"{side}_", f"{side} ") if side else ("", "")
    a1, a2, a3, x, y, th = s.coordinates(" ".join(f"{before}{n}" for n in ("a1", "a2", "a3", "x", "y", "th")))
    plate = s.frame(th, origin=s.point(f"{before}G", (x, y)), name=f"{before}plate")
    s.rigid_body(3.0, 0.4, at=plate.point(0, 0), frame=plate)
    if system is None:
        s.gravity()
    places = (-0.5, 0.0, 0.5)
    for k, (angle, place, length) in enumerate(zip((a1, a2, a3), places, lengths, strict=True)):
        crank = s.frame(angle, origin=s.point(f"{before}O{k}", (place, 0)))
        s.rigid_body(0.5, 0.01, at=crank.point(0.3, 0), frame=crank)
        s.pin((plate.point(place, 0), crank.point(length, 0)), name=f"{word}p{k}")
    return s


INERTIA = 3 * CRANK**2 + 3 * (0.01 + 0.5 * 0.3**2)
WEIGHT = G * (3 * CRANK + 3 * 0.5 * 0.3)


def crank_angle(t):
    """a and a' of the same system with one coordinate, I a″ = −W cos a, released at a = 1."""
    from scipy.integrate import solve_ivp

    found = solve_ivp(
        lambda _, s: [s[1], -WEIGHT / INERTIA * np.cos(s[0])],
        (0.0, t[-1]),
        [1.0, 0.0],
        method="DOP853",
        rtol=1e-13,
        atol=1e-14,
        t_eval=t,
    )
    return found.y
