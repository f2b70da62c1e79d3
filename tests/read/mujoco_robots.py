"""A robot's file in MuJoCo: mass matrix, bias and accelerations, in our coordinates and with our inputs."""

import numpy as np

FREE, BALL = 0, 1


def turn(e):
    """R of the quaternion (x, y, z, w), by the product of quaternions e ∘ r ∘ e⁻¹."""
    r, w = e[:3], e[3]
    return np.array([x + 2 * w * np.cross(r, x) + 2 * np.cross(r, np.cross(r, x)) for x in np.eye(3)]).T


class MujocoOracle:
    """MuJoCo's model, whose joints are in our order; contacts, limits and ranges are switched off.

    Its velocities are X(q) v: those of a body that floats are along the fixed axes. Its quaternions begin with w.
    """

    def __init__(self, mujoco, model):
        self.mujoco, self.model, self.data = mujoco, model, mujoco.MjData(model)
        model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
        model.actuator_ctrllimited[:] = model.actuator_forcelimited[:] = 0
        model.jnt_actfrclimited[:] = 0

    def states(self, count, inputs, seed=1):
        """Random q with quaternions of length 1, v, u, in our coordinates."""
        rng = np.random.default_rng(seed)
        for _ in range(count):
            q = []
            for kind in self.model.jnt_type:
                e = rng.normal(size=4)
                q += [*rng.uniform(-1, 1, 3)] if kind == FREE else []
                q += [*(e / np.linalg.norm(e))] if kind in (FREE, BALL) else [rng.uniform(-1, 1)]
            yield np.array(q), rng.uniform(-1, 1, self.model.nv), rng.uniform(-2, 2, inputs)

    def at(self, q, v, u):
        """M, bias − Ξ(u) and the accelerations, in our velocities."""
        data, n = self.data, self.model.nv
        X, turning = self.X(q), np.zeros(n)
        for kind, at, dof in zip(self.model.jnt_type, self.model.jnt_qposadr, self.model.jnt_dofadr, strict=True):
            if kind == FREE:
                R, vel, omega = turn(q[at + 3 : at + 7]), v[dof : dof + 3], v[dof + 3 : dof + 6]
                turning[dof : dof + 3] = R @ np.cross(omega, vel)
            place = at + (3 if kind == FREE else 0)
            if kind in (FREE, BALL):
                data.qpos[at:place] = q[at:place]
                data.qpos[place : place + 4] = q[[place + 3, place, place + 1, place + 2]]
            else:
                data.qpos[at] = q[at]
        data.qvel[:] = X @ v
        if self.model.nu:
            data.ctrl[:] = u
        else:
            data.qfrc_applied[:] = self._driven(u)
        self.mujoco.mj_forward(self.model, data)
        whole = np.zeros((n, n))
        self.mujoco.mj_fullM(self.model, data, whole)
        forces = data.qfrc_bias - data.qfrc_passive - data.qfrc_applied - data.qfrc_actuator
        return X.T @ whole @ X, X.T @ (forces + whole @ turning), X.T @ (data.qacc - turning)

    def X(self, q):
        """X of positions: the motion of what floats is turned into the fixed axes."""
        X = np.eye(self.model.nv)
        for kind, at, dof in zip(self.model.jnt_type, self.model.jnt_qposadr, self.model.jnt_dofadr, strict=True):
            if kind == FREE:
                X[dof : dof + 3, dof : dof + 3] = turn(q[at + 3 : at + 7])
        return X

    def acting(self, q):
        """The forces of springs, dampers and actuators at the state last asked for, in our velocities."""
        data = self.data
        return self.X(q).T @ (data.qfrc_passive + data.qfrc_actuator + data.qfrc_applied)

    def _driven(self, u):
        """Our inputs where the file has no actuators: one for every velocity of a joint that does not float."""
        found, k = np.zeros(self.model.nv), 0
        for kind, dof in zip(self.model.jnt_type, self.model.jnt_dofadr, strict=True):
            size = {FREE: 0, BALL: 3}.get(kind, 1)
            found[dof : dof + size] = u[k : k + size]
            k += size
        return found
