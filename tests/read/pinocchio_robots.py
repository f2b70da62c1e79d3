"""A robot's file in Pinocchio: mass matrix, forces at given accelerations and accelerations, in our coordinates."""

import numpy as np

from lagrangian.read.robots.naming import identifier


class Oracle:
    """Pinocchio's model of a text in URDF, with q, v and forces as ``system`` has them.

    Its velocities are J(q) v: those of a planar joint are along the axes of what it moves, ours along those that carry
    it. Joints that follow others have no velocity of their own.
    """

    def __init__(self, pin, text, system):
        self.pin, self.model = pin, pin.buildModelFromXML(text, mimic=True)
        self.model.gravity.linear = np.array([0, 0, -9.81])
        self.data = self.model.createData()
        self.q_names = [c.name for c in system.model.coordinates]
        self.v_names = [v.name.removesuffix("'") for v in system.model.velocities]
        floating = iter(system.model.floating)
        self.joints = []
        for name, joint in zip(self.model.names, self.model.joints, strict=True):
            kind = joint.shortname()
            if name == "universe" or "Mimic" in kind:
                continue
            names = [identifier(name)]
            if "FreeFlyer" in kind:
                names = [next(floating).name]
            self.joints.append((joint, kind, *(self._own(names[0], kind, x) for x in (self.q_names, self.v_names))))

    @staticmethod
    def _own(name, kind, listed):
        if "FreeFlyer" in kind:
            return [i for i, x in enumerate(listed) if x.startswith(f"{name}_") and len(x) <= len(name) + 3]
        if "Planar" in kind:
            return [listed.index(f"{name}_{key}") for key in ("x", "y", "angle")]
        return [listed.index(name)]

    def q(self, q):
        """Pinocchio's q: a turn without limits is (cos, sin) there."""
        found = self.pin.neutral(self.model)
        for joint, kind, mine, _ in self.joints:
            own = q[mine]
            if "Planar" in kind:
                own = [*own[:2], np.cos(own[2]), np.sin(own[2])]
            elif joint.nq == 2:
                own = [np.cos(own[0]), np.sin(own[0])]
            found[joint.idx_q : joint.idx_q + joint.nq] = own
        return found

    def J(self, q, v):
        """J, and dJ/dt · v."""
        J, change = np.zeros((self.model.nv, len(v))), np.zeros(self.model.nv)
        for joint, kind, at, mine in self.joints:
            rows = slice(joint.idx_v, joint.idx_v + joint.nv)
            block = np.eye(joint.nv)
            if "Planar" in kind:
                c, s, rate = np.cos(q[at[2]]), np.sin(q[at[2]]), v[mine[2]]
                block[:2, :2] = [[c, s], [-s, c]]
                change[rows][:2] = rate * np.array([[-s, c], [-c, -s]]) @ v[mine[:2]]
            J[rows, mine] = block
        return J, change

    def mass_matrix(self, q):
        J, _ = self.J(q, np.zeros(len(self.v_names)))
        M = self.pin.crba(self.model, self.data, self.q(q))
        return J.T @ (np.triu(M) + np.triu(M, 1).T) @ J

    def inverse(self, q, v, a):
        J, change = self.J(q, v)
        return J.T @ self.pin.rnea(self.model, self.data, self.q(q), J @ v, J @ a + change)

    def forward(self, q, v, force):
        J, change = self.J(q, v)
        if any("Mimic" in joint.shortname() for joint in self.model.joints):  # its ABA takes no joints that follow
            return np.linalg.solve(self.mass_matrix(q), force - self.inverse(q, v, 0 * v))
        theirs = self.pin.aba(self.model, self.data, self.q(q), J @ v, np.linalg.solve(J.T, force))
        return np.linalg.solve(J, theirs - change)
