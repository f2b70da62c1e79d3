"""Swing an acrobot up with iLQR: its only motor is in the elbow, and it has to swing before it can stand."""

import numpy as np

import lagrangian as lg

dyn = lg.example("acrobot").compile()
start, goal, dt, steps = np.zeros(4), np.array([np.pi, 0, 0, 0]), 0.05, 120  # it hangs, and is to stand at rest
Q, Qf, R = np.diag([0.1, 0.1, 0.01, 0.01]) * dt, np.diag([200.0, 200.0, 50.0, 50.0]), np.eye(1) * 0.01 * dt


def rolled(X, U, k, K):  # motions with the inputs U + part k + K (x − X) for six parts, the cheapest, and its cost
    new, inputs, parts = np.tile(start, (steps + 1, 6, 1)), np.zeros((steps, 6, 1)), 0.5 ** np.c_[:6]
    for i in range(steps):
        inputs[i] = np.clip(U[i] + parts * k[i] + (new[i] - X[i]) @ K[i].T, -15, 15)
        new[i + 1] = dyn.step(new[i, :, :2], new[i, :, 2:], inputs[i], dt)
    costs = sum(((x @ W) * x).sum((0, 2)) for x, W in ((new[-1:] - goal, Qf), (new[:-1] - goal, Q), (inputs, R)))
    return new[:, costs.argmin()], inputs[:, costs.argmin()], costs.min()


def swing_up(rounds=40):
    k, K, damping = np.zeros((steps, 1)), np.zeros((steps, 1, 4)), 1.0
    X, U, cost = rolled(np.zeros((steps + 1, 4)), np.full((steps, 1), 0.1), k, K)
    for _ in range(rounds):
        _, A, B = dyn.step(X[:-1, :2], X[:-1, 2:], U, dt, derivatives=True)
        s, S = Qf @ (X[-1] - goal), Qf  # slope and curvature of the cost to go
        for i in reversed(range(steps)):
            H = R + B[i].T @ S @ B[i] + damping
            k[i], K[i] = -np.linalg.solve(H, R @ U[i] + B[i].T @ s), -np.linalg.solve(H, B[i].T @ S @ A[i])
            F = A[i] + B[i] @ K[i]  # of the closed loop
            s = Q @ (X[i] - goal) + K[i].T @ R @ (U[i] + k[i]) + F.T @ (s + S @ B[i] @ k[i])
            S = Q + K[i].T @ R @ K[i] + F.T @ S @ F
        best = rolled(X, U, k, K)
        damping, (X, U, cost) = (damping / 3, best) if best[2] < cost else (damping * 10, (X, U, cost))
    return X, U, cost


if __name__ == "__main__":  # a row for every step: both angles, their rates, and the torque
    print(np.array2string(np.hstack([y[-steps:] for y in swing_up()[:2]]), precision=2, suppress_small=True))
