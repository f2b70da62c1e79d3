"""Mechanisms for `physical`, none of which is among the examples."""

from __future__ import annotations

from typing import Any

import sympy as sp
from physical import Body, Link, Mechanism

import lagrangian as lg


def _begin(name: str, q: str, p: str, u: str = "") -> tuple[Any, Any, Any, Any]:
    s: Any = lg.System(name)
    coordinates = [s.coordinate(x) for x in q.split()]
    parameters = {x: s.parameter(x) for x in p.split()}
    s.parameters_named = list(parameters.values())
    return s, coordinates, parameters, {x: s.input(x) for x in u.split()}


def hoist() -> Mechanism:
    s, (phi, y), p, u = _begin("hoist", "phi y", "J R m k c g", "tau")
    m, R = p["m"], p["R"]
    return Mechanism(
        "hoist",
        (phi, y),
        {"drum": Body(sp.S.Zero + p["m"] * 3, (0, 0), p["J"], phi), "load": Body(m, (0, -y))},
        {"rope": Link(p["k"], y - R * phi)},
        {"bearing": Link(p["c"], phi)},
        {"motor": Link(u["tau"], phi)},
        p["g"],
        s,
    )


def arm() -> Mechanism:
    s, (a, b), p, u = _begin("arm with two rods", "a b", "m1 m2 J1 J2 l1 s1 s2 k c g", "tau")
    A, l1 = a + b, p["l1"]
    at = (l1 * sp.sin(a) + p["s2"] * sp.sin(A), -l1 * sp.cos(a) - p["s2"] * sp.cos(A))
    return Mechanism(
        "arm",
        (a, b),
        {
            "upper": Body(p["m1"], (p["s1"] * sp.sin(a), -p["s1"] * sp.cos(a)), p["J1"], a),
            "fore": Body(p["m2"], at, p["J2"], A),
        },
        {"elbow": Link(p["k"], b)},
        {"oil": Link(p["c"], b)},
        {"motor": Link(u["tau"], a)},
        p["g"],
        s,
    )


def roller() -> Mechanism:
    s, (x, z), p, u = _begin("cylinder on a cart", "x z", "M m R k K d", "F")
    m, R = p["m"], p["R"]
    return Mechanism(
        "roller",
        (x, z),
        {"cart": Body(p["M"], (x, 0)), "cylinder": Body(m, (x + z, R), m * R**2 / 2, -z / R)},
        {"wall": Link(p["K"], x), "axle": Link(p["k"], z)},
        {"oil": Link(p["d"], z)},
        {"push": Link(u["F"], x)},
        None,
        s,
    )


def slider() -> Mechanism:
    s, (r, phi), p, u = _begin("sleeve on a turning rod", "r phi", "m J k r0 c g", "tau")
    at = (r * sp.cos(phi), r * sp.sin(phi))
    return Mechanism(
        "slider",
        (r, phi),
        {"rod": Body(p["m"] / 2, (0, 0), p["J"], phi), "sleeve": Body(p["m"], at)},
        {"coil": Link(p["k"], r - p["r0"])},
        {"friction": Link(p["c"], r)},
        {"motor": Link(u["tau"], phi)},
        p["g"],
        s,
    )


def coupled() -> Mechanism:
    s, (a, b), p, u = _begin("two pendula joined by a spring", "a b", "m1 m2 L1 L2 h k c g", "F")
    return Mechanism(
        "coupled",
        (a, b),
        {
            "left": Body(p["m1"], (p["L1"] * sp.sin(a), -p["L1"] * sp.cos(a))),
            "right": Body(p["m2"], (p["L2"] * sp.sin(b), -p["L2"] * sp.cos(b))),
        },
        {"middle": Link(p["k"], p["h"] * sp.sin(b) - p["h"] * sp.sin(a))},
        {"oil": Link(p["c"], p["h"] * a)},
        {"wind": Link(u["F"], p["L2"] * sp.sin(b))},
        p["g"],
        s,
    )


def car() -> Mechanism:
    s, (z, th, w), p, u = _begin("half a car with its engine", "z theta w", "M J m a b e k1 k2 k3 c1 c2", "F")
    return Mechanism(
        "car",
        (z, th, w),
        {"body": Body(p["M"], (0, z), p["J"], th), "engine": Body(p["m"], (0, w))},
        {
            "front": Link(p["k1"], z - p["a"] * th),
            "rear": Link(p["k2"], z + p["b"] * th),
            "mount": Link(p["k3"], w - z - p["e"] * th),
        },
        {"shock": Link(p["c1"], z - p["a"] * th), "rubber": Link(p["c2"], w - z - p["e"] * th)},
        {"shake": Link(u["F"], w - z)},
        None,
        s,
    )


def incline() -> Mechanism:
    s, (x, th), p, u = _begin("pendulum below a block on a slope", "x theta", "M m l beta k c g", "F")
    X = (x * sp.cos(p["beta"]), x * sp.sin(p["beta"]))
    bob = (X[0] + p["l"] * sp.sin(th), X[1] - p["l"] * sp.cos(th))
    return Mechanism(
        "incline",
        (x, th),
        {"block": Body(p["M"], X), "bob": Body(p["m"], bob)},
        {"coil": Link(p["k"], x)},
        {"pivot": Link(p["c"], th)},
        {"wind": Link(u["F"], x * sp.cos(p["beta"]) + p["l"] * sp.sin(th))},
        p["g"],
        s,
    )


def pulleys() -> Mechanism:
    s, (x, y), p, u = _begin("a stepped pulley and a loose one", "x y", "M1 M2 M3 J R r k d g", "F")
    return Mechanism(
        "pulleys",
        (x, y),
        {
            "wheel": Body(p["M1"], (0, 0), p["J"], x / p["R"]),
            "bucket": Body(p["M2"], (0, -x)),
            "stone": Body(p["M3"], (0, p["r"] / p["R"] * x - y)),
        },
        {"belt": Link(p["k"], y - p["r"] / p["R"] * x)},
        {"brake": Link(p["d"], x / p["R"])},
        {"pull": Link(u["F"], y)},
        p["g"],
        s,
    )


def shaken() -> Mechanism:
    s, (y, th), p, u = _begin("a rod on a shaken table", "y theta", "M m J a L A w k c g", "F")
    from lagrangian.model import time as t

    road = p["A"] * sp.sin(p["w"] * t)
    tip = (p["a"] * sp.sin(th), y + p["a"] * sp.cos(th))
    return Mechanism(
        "shaken",
        (y, th),
        {"table": Body(p["M"], (0, y)), "rod": Body(p["m"], tip, p["J"], -th)},
        {"leg": Link(p["k"], y - road)},
        {"leg damper": Link(p["c"], y - road)},
        {"push": Link(u["F"], p["L"] * sp.sin(th))},
        p["g"],
        s,
    )


def chain() -> Mechanism:
    s, (x, a, b), p, u = _begin("a crane with two ropes", "x a b", "M m1 m2 L1 L2 d g", "F")
    hook = (x + p["L1"] * sp.sin(a), -p["L1"] * sp.cos(a))
    load = (hook[0] + p["L2"] * sp.sin(b), hook[1] - p["L2"] * sp.cos(b))
    return Mechanism(
        "chain",
        (x, a, b),
        {"trolley": Body(p["M"], (x, 0)), "hook": Body(p["m1"], hook), "load": Body(p["m2"], load)},
        {},
        {"track": Link(p["d"], x)},
        {"drive": Link(u["F"], x)},
        p["g"],
        s,
    )


EVERY = (hoist, arm, roller, slider, coupled, car, incline, pulleys, shaken, chain)
