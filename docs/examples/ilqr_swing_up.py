"""Swing a pole up with iLQR: A and B of all steps of a horizon come from one call."""

import numpy as np

import lagrangian as lg

dyn = lg.example("cart-pole").compile()
start, dt, steps = np.array([0, np.pi, 0, 0]), 0.04, 60  # the pole hangs, and is to stand at x = 0 and at rest
Q, Qf, R = np.diag([0.1, 0.1, 0.01, 0.01]) * dt, np.diag([200.0, 200.0, 50.0, 50.0]), np.eye(1) * 0.01 * dt


def rolled(X, U, k, K, part):  # the motion with the inputs U + part k + K (x − X), and its cost
    X, U, old = np.vstack([start, X[1:]]), U.copy(), X
    for i in range(steps):
        U[i] = np.clip(U[i] + part * k[i] + K[i] @ (X[i] - old[i]), -50, 50)
        X[i + 1] = dyn.step(X[i, :2], X[i, 2:], U[i], dt)
    return X, U, X[-1] @ Qf @ X[-1] + ((X[:-1] @ Q) * X[:-1]).sum() + ((U @ R) * U).sum()


def swing_up(rounds=25):
    k, K, damping = np.zeros((steps, 1)), np.zeros((steps, 1, 4)), 1.0
    X, U, cost = rolled(np.zeros((steps + 1, 4)), np.full((steps, 1), 0.1), k, K, 1.0)
    for _ in range(rounds):
        _, A, B = dyn.step(X[:-1, :2], X[:-1, 2:], U, dt, derivatives=True)
        s, S = Qf @ X[-1], Qf  # slope and curvature of the cost to go
        for i in reversed(range(steps)):
            H = R + B[i].T @ S @ B[i] + damping
            k[i], K[i] = -np.linalg.solve(H, R @ U[i] + B[i].T @ s), -np.linalg.solve(H, B[i].T @ S @ A[i])
            F = A[i] + B[i] @ K[i]  # of the closed loop
            s = Q @ X[i] + K[i].T @ R @ (U[i] + k[i]) + F.T @ (s + S @ B[i] @ k[i])
            S = Q + K[i].T @ R @ K[i] + F.T @ S @ F
        best = min((rolled(X, U, k, K, part) for part in 0.5 ** np.arange(6)), key=lambda found: found[2])
        damping, (X, U, cost) = (damping / 3, best) if best[2] < cost else (damping * 10, (X, U, cost))
    return X, U, cost


if __name__ == "__main__":
    X, U, cost = swing_up()
    print("x, theta, x', theta', F", np.array2string(np.hstack([X[1:], U]), precision=2, suppress_small=True), sep="\n")
