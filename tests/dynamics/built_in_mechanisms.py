"""The built-in examples with constraints once more, as `Numbers`; nothing is read from the model files but values."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from closed_loops import Numbers, cos, sin, turn
from mechanisms_in_space import quaternion_rates, quaternion_turn

P = Mapping[str, float]
DOWN, LEVEL = (0.0, -1.0), (0.0, 0.0)
X, Y, Z = np.eye(3)


@dataclass
class Oracle:
    """``forces``: q, v, u → Ξ of everything but weight; ``order``: the rows of the model among those of the numbers."""

    numbers: Any
    forces: Callable[[Any, Any, Any], Any]
    order: list[int] | None = None


def e(a: Any) -> Any:
    """The direction at an angle."""
    return np.array([cos(a), sin(a)])


def across(a: Any) -> Any:
    return np.array([-1 * sin(a), cos(a)])


def at(*r: Any) -> Any:
    return np.array(r, object)


def down(p: P, of: Any = DOWN) -> Any:
    return p["g"] * np.array(of)


def slider_crank(p: P) -> Oracle:
    r, l, a = p["r"], p["l"], p["a"]

    def bodies(q: Any) -> Any:
        rod = (p["m_2"], p["J_2"], r * e(q[0]) + a * e(q[1]), q[1])
        return [(p["m_1"], p["J_1"], at(0, 0), q[0]), rod, (p["m_3"], 0.0, at(q[2], 0), 0.0)]

    def gaps(q: Any) -> Any:
        return r * e(q[0]) + l * e(q[1]) - at(q[2], 0)

    return Oracle(Numbers(3, bodies, LEVEL, gaps), lambda q, v, u: [u[0], 0, -u[1] - p["b"] * v[2]])


def four_bar(p: P) -> Oracle:
    l, m = [p[f"l{k}"] for k in (1, 2, 3)], [p[f"m{k}"] for k in (1, 2, 3)]

    def bodies(q: Any) -> Any:
        starts = at(0, 0), l[0] * e(q[0]), at(p["d"], 0)
        return [(m[k], m[k] * l[k] ** 2 / 12, starts[k] + l[k] / 2 * e(q[k]), q[k]) for k in range(3)]

    def gaps(q: Any) -> Any:
        return l[0] * e(q[0]) + l[1] * e(q[1]) - l[2] * e(q[2]) - at(p["d"], 0)

    return Oracle(Numbers(3, bodies, down(p), gaps), lambda q, v, u: [u[0], 0, 0])


def rod_pendulum(p: P) -> Oracle:
    def gaps(q: Any) -> Any:
        return [(q[0] ** 2 + q[1] ** 2) ** 0.5 - p["l"]]

    return Oracle(Numbers(2, lambda q: [(p["m"], 0.0, at(q[0], q[1]), 0.0)], down(p), gaps), lambda q, v, u: [0, 0])


def ladder(p: P) -> Oracle:
    def bodies(q: Any) -> Any:
        return [(p["m"], p["m"] * p["l"] ** 2 / 12, at(q[0], q[1]), q[2])]

    return Oracle(
        Numbers(3, bodies, down(p), lambda q: at(q[0], q[1]) - p["l"] / 2 * e(q[2])), lambda q, v, u: [0, 0, 0]
    )


def rolling_disc(p: P) -> Oracle:
    def bodies(q: Any) -> Any:
        R = turn(Z, q[2]) @ turn(X, q[3])
        inertia = np.diag([p["I"], p["K"], p["I"]])
        return [(p["m"], inertia, at(q[0], q[1], 0) + R @ (p["r"] * Z), R @ turn(Y, q[4]))]

    def slips(q: Any, w: Any) -> Any:
        return at(w[0], w[1]) - p["r"] * e(q[2]) * w[4]

    return Oracle(Numbers(5, bodies, down(p, -Z), slips=slips), lambda q, v, u: np.zeros(5))


def sleigh(p: P) -> Oracle:
    def bodies(q: Any) -> Any:
        return [(p["m"], p["J"], at(q[0], q[1]) + p["a"] * e(q[2]), q[2])]

    return Oracle(
        Numbers(3, bodies, LEVEL, slips=lambda q, w: [across(q[2]) @ at(w[0], w[1])]), lambda q, v, u: np.zeros(3)
    )


def wheel(p: P) -> Oracle:
    slope = -p["beta"]

    def bodies(q: Any) -> Any:
        return [(p["m"], p["J"], e(slope) * q[0] + p["r"] * across(slope), -1 * q[1])]

    return Oracle(Numbers(2, bodies, down(p), slips=lambda q, w: [w[0] - p["r"] * w[1]]), lambda q, v, u: np.zeros(2))


def car(p: P) -> Oracle:
    """With a trailer where the parameters have one."""
    n, trailer = (5, True) if "h" in p else (4, False)

    def bodies(q: Any) -> Any:
        rear = at(q[0], q[1])
        found = [
            (p["m"], p["J"], rear + p["a"] * e(q[2]), q[2]),
            (p["m_w"], p["J_w"], rear + p["l"] * e(q[2]), q[2] + q[3]),
        ]
        if trailer:
            found.append((p["m_t"], p["J_t"], rear - p["h"] * e(q[2]) - p["c"] * e(q[4]), q[4]))
        return found

    def slips(q: Any, w: Any) -> Any:
        v = at(w[0], w[1])
        found = [across(q[2]) @ v, across(q[2] + q[3]) @ (v + p["l"] * across(q[2]) * w[2])]
        if trailer:
            v = v - p["h"] * across(q[2]) * w[2] - p["l_t"] * across(q[4]) * w[4]
            found.append(across(q[4]) @ v)
        return found

    def forces(q: Any, v: Any, u: Any) -> Any:
        return [*(u[0] * e(q[2])), 0, u[1] - p["b"] * v[3], 0][:n]

    return Oracle(Numbers(n, bodies, LEVEL, slips=slips), forces)


def robot(p: P) -> Oracle:
    def bodies(q: Any) -> Any:
        heading = turn(Z, q[2])
        axle, body = at(q[0], q[1], p["r"]), heading @ turn(Y, q[3])
        wheel = np.diag([p["I_w"], p["K"], p["I_w"]])
        return [
            (p["m"], np.diag([p["I_1"], p["I_2"], p["I_3"]]), axle + body @ (p["h"] * Z), body),
            (p["m_w"], wheel, axle + heading @ (p["w"] * Y), heading @ turn(Y, q[4])),
            (p["m_w"], wheel, axle - heading @ (p["w"] * Y), heading @ turn(Y, q[5])),
        ]

    def slips(q: Any, w: Any) -> Any:
        along, aside = e(q[2]) @ at(w[0], w[1]), across(q[2]) @ at(w[0], w[1])
        return [along - p["w"] * w[2] - p["r"] * w[4], aside, along + p["w"] * w[2] - p["r"] * w[5]]

    return Oracle(Numbers(6, bodies, down(p, -Z), slips=slips), lambda q, v, u: [0, 0, 0, -u[0] - u[1], u[0], u[1]])


def parallelograms(p: P) -> Oracle:
    l, a = p["l"], p["a"]

    def bodies(q: Any) -> Any:
        cranks = [(p["m"], p["m"] * l**2 / 12, at(k * a, 0) + l / 2 * e(q[k]), q[k]) for k in range(3)]
        return [*cranks, (p["M"], p["M"] * a**2 / 3, l * e(q[0]) + a * e(q[3]), q[3])]

    def gaps(q: Any) -> Any:
        return [x for k in (1, 2) for x in l * e(q[0]) + k * a * e(q[3]) - at(k * a, 0) - l * e(q[k])]

    return Oracle(Numbers(4, bodies, down(p), gaps), lambda q, v, u: np.zeros(4))


def squeezer(p: P) -> Oracle:
    """After the positions in Hairer and Wanner, Solving ODEs II, VII.7."""
    A, B, C = (np.array([p[f"x{k}"], p[f"y{k}"]]) for k in "abc")

    def ends(q: Any) -> Any:
        beta, Theta, gamma, Phi, delta, Omega, epsilon = q
        return (
            p["rr"] * e(beta) - p["d"] * e(beta + Theta),
            B - p["ss"] * across(gamma),
            A + p["zt"] * e(delta) - p["e"] * across(Phi + delta),
            A + p["zf"] * e(Omega + epsilon) - p["u"] * across(epsilon),
        )

    def bodies(q: Any) -> Any:
        beta, Theta, gamma, Phi, delta, Omega, epsilon = q
        places = [
            (p["ra"] * e(beta), beta),
            (p["rr"] * e(beta) - p["da"] * e(beta + Theta), beta + Theta),
            (B + p["sb"] * e(gamma) - p["sa"] * across(gamma), gamma),
            (A + p["zt"] * e(delta) - (p["e"] - p["ea"]) * across(Phi + delta), Phi + delta),
            (A + p["ta"] * e(delta) + p["tb"] * across(delta), delta),
            (A + (p["zf"] - p["fa"]) * e(Omega + epsilon) - p["u"] * across(epsilon), Omega + epsilon),
            (A + p["ua"] * e(epsilon) - p["ub"] * across(epsilon), epsilon),
        ]
        return [(p[f"m{k}"], p[f"I{k}"], r, a) for k, (r, a) in enumerate(places, 1)]

    def gaps(q: Any) -> Any:
        first, *others = ends(q)
        return [x for end in others for x in first - end]

    def forces(q: Any, v: Any, u: Any) -> Any:
        D = B + p["sd"] * e(q[2]) - p["sc"] * across(q[2])
        L = np.hypot(*(D - C))
        F = -p["c0"] * (L - p["l0"]) * (D - C) / L
        return [p["mom"], 0, F @ (p["sd"] * across(q[2]) + p["sc"] * e(q[2])), 0, 0, 0, 0]

    return Oracle(Numbers(7, bodies, LEVEL, gaps), forces)


def cross(a: Any, b: Any) -> Any:
    return at(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def bicycle(p: P) -> Oracle:
    """Rolling by ω × r of each body about the axes in turn; the steering axis meets the ground at w + c."""
    tilt, r_f = p["tilt"], p["r_f"]
    foot = np.array([p["w"] + p["c"], 0, -p["r_r"]])  # of the steering axis, from the rear hub, upright

    def chain(q: Any) -> Any:
        L = turn(Z, q[2]) @ turn(X, q[3])
        hub = at(q[0], q[1], 0) + L @ (p["r_r"] * Z)
        F = L @ turn(Y, q[4])
        H = F @ turn(Y, -tilt) @ turn(Z, q[5]) @ turn(Y, tilt)
        return L, hub, F, H, hub + F @ foot

    def front(q: Any) -> Any:
        *_, H, foot = chain(q)
        return foot + H @ np.array([-p["c"], 0, r_f]), H[:, 1]

    def bodies(q: Any) -> Any:
        L, hub, F, H, foot = chain(q)
        B = np.array([[p["B_xx"], 0, p["B_xz"]], [0, p["B_yy"], 0], [p["B_xz"], 0, p["B_zz"]]])
        I = np.array([[p["H_xx"], 0, p["H_xz"]], [0, p["H_yy"], 0], [p["H_xz"], 0, p["H_zz"]]])
        return [
            (p["m_r"], np.diag([p["I_r"], p["K_r"], p["I_r"]]), hub, L @ turn(Y, q[6])),
            (p["m_b"], B, hub + F @ np.array([p["x_b"], 0, p["z_b"] - p["r_r"]]), F),
            (p["m_h"], I, foot + H @ np.array([p["x_h"] - p["w"] - p["c"], 0, p["z_h"]]), H),
            (p["m_f"], np.diag([p["I_f"], p["K_f"], p["I_f"]]), front(q)[0], H @ turn(Y, q[7])),
        ]

    def gaps(q: Any) -> Any:
        axle, n = front(q)
        return [axle[2] - r_f * (1 - n[2] * n[2]) ** 0.5]

    def slips(q: Any, w: Any) -> Any:
        L, hub, F, _, foot = chain(q)
        axle, n = front(q)
        down = (n * n[2] - Z) * (1 - n[2] * n[2]) ** -0.5
        leaning = Z * w[2] + turn(Z, q[2])[:, 0] * w[3]
        body = leaning + L[:, 1] * w[4]
        fork = body + (F @ turn(Y, -tilt))[:, 2] * w[5]
        rear = at(w[0], w[1], 0)
        v = rear + cross(leaning, hub - at(q[0], q[1], 0)) + cross(body, foot - hub) + cross(fork, axle - foot)
        v = v + cross(fork + n * w[7], r_f * down)
        return [*(rear[:2] - p["r_r"] * e(q[2]) * w[6]), *v[:2]]

    oracle = Numbers(8, bodies, down(p, -Z), gaps, slips)
    return Oracle(oracle, lambda q, v, u: [0, 0, 0, 0, 0, u[0], 0, 0], [1, 2, 3, 4, 0])


def stewart(p: P) -> Oracle:
    feet = [p["R"] * np.array([np.cos(a), np.sin(a), 0]) for a in np.deg2rad([15, 105, 135, 225, 255, 345])]
    joints = [p["r"] * np.array([np.cos(a), np.sin(a), 0]) for a in np.deg2rad([45, 75, 165, 195, 285, 315])]

    def leg(q: Any, k: int) -> Any:
        return turn(X, q[7 + 3 * k]) @ turn(Y, q[8 + 3 * k])

    def bodies(q: Any) -> Any:
        found = [(p["M"], np.diag([p["I_1"], p["I_1"], p["I_3"]]), q[:3], quaternion_turn(q[3:7]))]
        for k, foot in enumerate(feet):
            R = leg(q, k)
            for mass, J, K, z in (
                (p["m_c"], p["J_c"], p["K_c"], p["c_c"]),
                (p["m_r"], p["J_r"], p["K_r"], q[9 + 3 * k] - p["c_r"]),
            ):
                found.append((mass, np.diag([J, J, K]), foot + R[:, 2] * z, R))
        return found

    def gaps(q: Any) -> Any:
        R = quaternion_turn(q[3:7])
        ends = [foot + leg(q, k)[:, 2] * q[9 + 3 * k] for k, foot in enumerate(feet)]
        return [x for joint, end in zip(joints, ends, strict=True) for x in R.T @ (q[:3] + R @ joint - end)]

    def rates(q: Any, v: Any) -> Any:
        return np.r_[quaternion_rates(q[:7], v[:6]), v[6:]]

    def forces(q: Any, v: Any, u: Any) -> Any:
        Q = np.zeros(24)
        for k in range(6):
            Q[8 + 3 * k] = u[k] - p["k"] * (q[9 + 3 * k] - p["l_0"]) - p["b"] * v[8 + 3 * k]
        return Q

    return Oracle(Numbers(24, bodies, down(p, -Z), gaps, rates=rates), forces)


ORACLES: dict[str, Callable[[P], Oracle]] = {
    "andrews-squeezer": squeezer,
    "balancing-robot": robot,
    "car": car,
    "car-with-trailer": car,
    "chaplygin-sleigh": sleigh,
    "double-parallelogram": parallelograms,
    "four-bar": four_bar,
    "ladder": ladder,
    "rod-pendulum": rod_pendulum,
    "rolling-disc": rolling_disc,
    "slider-crank": slider_crank,
    "stewart-platform": stewart,
    "wheel-on-incline": wheel,
    "whipple-bicycle": bicycle,
}
