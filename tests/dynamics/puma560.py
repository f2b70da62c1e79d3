"""The PUMA 560 with measured data, in this package and by recursive Newton–Euler equations.

B. Armstrong, O. Khatib, J. Burdick: The explicit dynamic model and inertial parameters of the PUMA 560 arm,
Proc. IEEE Int. Conf. on Robotics and Automation (1986) 510-518: modified Denavit-Hartenberg axes, masses, centres of
mass, inertias about them, effective motor inertias. Link 3's moments 0.066, 0.0125, 0.086 kg m² are those of no body.
"""

import numpy as np
import sympy as sp

import lagrangian as lg

TWIST = (0, -1, 0, 1, -1, 1)  # quarter turns
ALPHA = np.array(TWIST) * np.pi / 2
A = np.array([0, 0, 0.4318, -0.0203, 0, 0])
D = np.array([0, 0.2435, -0.0934, 0.4331, 0, 0])
MASS = np.array([0, 17.40, 4.80, 0.82, 0.34, 0.09])
CENTRE = np.array(
    [[0, 0, 0], [0.068, 0.006, -0.016], [0, -0.070, 0.014], [0, 0, -0.019], [0, 0, 0], [0, 0, 0.032]],
)
INERTIA = np.array(
    [
        [0, 0, 0.35],
        [0.130, 0.524, 0.539],
        [0.066, 0.0125, 0.086],
        [1.8e-3, 1.8e-3, 1.3e-3],
        [0.3e-3, 0.3e-3, 0.4e-3],
        [0.15e-3, 0.15e-3, 0.04e-3],
    ]
)
MOTOR = np.array([1.14, 4.71, 0.827, 0.200, 0.179, 0.193])
GRAVITY = 9.81


def system() -> lg.System:
    """The arm: each joint turns about the z axis of its own axes; motors add ½ J θ̇²."""
    s = lg.System("PUMA 560")
    q = s.coordinates("q1 q2 q3 q4 q5 q6")
    tau = s.inputs("tau1 tau2 tau3 tau4 tau5 tau6")
    frame, at = None, s.origin
    for k in range(6):
        twisted = s.frame(sp.Rational(TWIST[k], 2) * sp.pi, axis=(1, 0, 0), parent=frame)
        offset = (A[k], 0, 0)
        at = at + offset if frame is None else frame.point(*offset, at=at)
        at = twisted.point(0, 0, D[k], at=at)
        frame = s.frame(q[k], axis=(0, 0, 1), parent=twisted, name=f"axes{k + 1}")
        inertia = tuple(INERTIA[k].tolist())
        s.rigid_body(
            MASS[k].item(), inertia, at=frame.point(*CENTRE[k].tolist(), at=at), frame=frame, name=f"link {k + 1}"
        )
        s.kinetic(sp.Rational(str(MOTOR[k])) * q[k].diff() ** 2 / 2, name=f"motor {k + 1}")
        s.generalized_force(q[k], tau[k])
    s.gravity(direction=(0, 0, -1), g=GRAVITY)
    return s


def transform(k: int, q: float) -> tuple[np.ndarray, np.ndarray]:
    """Rotation and origin of axes k in axes k − 1 (Craig's convention)."""
    ca, sa, c, s = np.cos(ALPHA[k]), np.sin(ALPHA[k]), np.cos(q), np.sin(q)
    R = np.array([[c, -s, 0], [s * ca, c * ca, -sa], [s * sa, c * sa, ca]])
    return R, np.array([A[k], -sa * D[k], ca * D[k]])


def newton_euler(q: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
    """Torques by Luh, Walker and Paul's recursion, outward for motion, inward for forces; motors added."""
    z = np.array([0, 0, 1.0])
    w, dw, acc = np.zeros(3), np.zeros(3), np.array([0, 0, GRAVITY])
    forces, moments, turned, origins = [], [], [], []
    for k in range(6):
        R, p = transform(k, q[k])
        acc = R.T @ (acc + np.cross(dw, p) + np.cross(w, np.cross(w, p)))
        w0 = R.T @ w
        dw = R.T @ dw + np.cross(w0, z * v[k]) + z * a[k]
        w = w0 + z * v[k]
        ac = acc + np.cross(dw, CENTRE[k]) + np.cross(w, np.cross(w, CENTRE[k]))
        forces.append(MASS[k] * ac)
        moments.append(INERTIA[k] * dw + np.cross(w, INERTIA[k] * w))
        turned.append(R)
        origins.append(p)
    torque, f, n = np.zeros(6), np.zeros(3), np.zeros(3)
    for k in reversed(range(6)):
        R, p = (turned[k + 1], origins[k + 1]) if k < 5 else (np.eye(3), np.zeros(3))
        n = moments[k] + R @ n + np.cross(CENTRE[k], forces[k]) + np.cross(p, R @ f)
        f = R @ f + forces[k]
        torque[k] = n[2] + MOTOR[k] * a[k]
    return torque


def accelerations(q: np.ndarray, v: np.ndarray, tau: np.ndarray) -> np.ndarray:
    """q̈ by solving the recursion, which is linear in it."""
    bias = newton_euler(q, v, np.zeros(6))
    M = np.array([newton_euler(q, v, e) - bias for e in np.eye(6)]).T
    return np.linalg.solve(M, tau - bias)
