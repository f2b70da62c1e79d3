"""Floating trees as systems of this package, as Pinocchio's models and as MuJoCo's."""

import numpy as np
from dynamics_models import random_links

import lagrangian as lg

GRAVITY = 9.81
QUADRUPED = [-1, 0, 1, -1, 3, 4, -1, 6, 7, -1, 9, 10]
HUMANOID = [-1, 0, 1, 2, 3, 4, 5, 1, 7, 8, 9, 10, -1, 12, 13, 14, 15, 16, -1, 18, 19, 20, 21, 22]


def specification(parents, seed):
    """A trunk (mass, centre, inertia), and (parent, axis number, offset, mass, centre, inertia) of every joint."""
    rng = np.random.default_rng(seed)
    trunk = random_links(1, seed + 1)[0][2:]
    links = random_links(len(parents), seed)
    return trunk, [(p, int(rng.integers(3)), *link[1:]) for p, link in zip(parents, links, strict=True)]


def plain(rows):
    return [[float(x) for x in row] for row in rows]


def system(parents, seed):
    """The tree through `System`; inputs along the base's velocities and on the joints, in order."""
    (mass, centre, inertia), joints = specification(parents, seed)
    s = lg.System("tree")
    base = s.floating_frame("base")
    w = s.inputs([f"w{i}" for i in range(6)])
    s.rigid_body(float(mass), plain(inertia), base.point(*map(float, centre)), base)
    s.force(w[:3], at=base.origin, axes=base)
    s.torque(w[3:], on=base, axes=base)
    made = []
    for i, (parent, axis, offset, mass, centre, inertia) in enumerate(joints):
        above, at = made[parent] if parent >= 0 else (base, None)
        q, u = s.coordinate(f"q{i}"), s.input(f"u{i}")
        joint = above.point(*map(float, offset), at=at)
        frame = s.frame(q, axis=[int(axis == k) for k in range(3)], parent=above, origin=joint)
        s.rigid_body(float(mass), plain(inertia), frame.point(*map(float, centre), at=joint), frame)
        s.torque(u, on=q)
        made.append((frame, joint))
    s.gravity(direction=(0, 0, -1), g=GRAVITY)
    return s


def states(system, count, seed):
    """q with quaternions of length 1, v, u."""
    model = system.model
    rng = np.random.default_rng(seed)
    q = rng.uniform(-1.5, 1.5, (count, len(model.coordinates)))
    q[:, 3:7] = rng.normal(size=(count, 4))
    q[:, 3:7] /= np.linalg.norm(q[:, 3:7], axis=1, keepdims=True)
    return q, rng.uniform(-1, 1, (count, len(model.velocities))), rng.uniform(-1, 1, (count, len(model.inputs)))


def pinocchio_model(pin, parents, seed):
    (mass, centre, inertia), joints = specification(parents, seed)
    model = pin.Model()
    root = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "base")
    model.appendBodyToJoint(root, pin.Inertia(mass, np.array(centre), np.array(inertia)), pin.SE3.Identity())
    kinds, ids = (pin.JointModelRX, pin.JointModelRY, pin.JointModelRZ), []
    for i, (parent, axis, offset, mass, centre, inertia) in enumerate(joints):
        above = ids[parent] if parent >= 0 else root
        ids.append(model.addJoint(above, kinds[axis](), pin.SE3(np.eye(3), np.array(offset)), f"j{i}"))
        model.appendBodyToJoint(ids[-1], pin.Inertia(mass, np.array(centre), np.array(inertia)), pin.SE3.Identity())
    model.gravity.linear = np.array([0, 0, -GRAVITY])
    return model


def mujoco_accelerations(mujoco, parents, seed, q, v, u):
    """v̇ by MuJoCo, whose quaternion begins with w and whose linear motion stands in the fixed axes."""
    (mass, centre, inertia), joints = specification(parents, seed)

    def text(*values):
        return " ".join(repr(float(x)) for x in np.ravel(values))

    def body(mass, centre, inertia):
        J = np.array(inertia)
        full = [J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2]]
        return f'<inertial pos="{text(centre)}" mass="{float(mass)!r}" fullinertia="{text(full)}"/>'

    def below(parent):
        made = ""
        for i, (p, axis, offset, *rest) in enumerate(joints):
            if p == parent:
                joint = f'<joint type="hinge" name="j{i}" axis="{text(np.eye(3)[axis])}"/>'
                made += f'<body pos="{text(offset)}">{body(*rest)}{joint}{below(i)}</body>'
        return made

    world = f"<body>{body(mass, centre, inertia)}<freejoint/>{below(-1)}</body>"
    flags = '<flag contact="disable" constraint="disable"/>'
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option gravity="0 0 -{GRAVITY}">{flags}</option><worldbody>{world}</worldbody></mujoco>'
    )
    data, found = mujoco.MjData(model), np.empty_like(v)
    order = [int(model.joint(f"j{i}").dofadr[0]) for i in range(len(joints))]
    for k in range(len(q)):
        R = turn(q[k, 3:7])
        data.qpos[:3], data.qpos[3:7] = q[k, :3], q[k, [6, 3, 4, 5]]
        data.qvel[:3], data.qvel[3:6] = R @ v[k, :3], v[k, 3:6]
        data.qfrc_applied[:3], data.qfrc_applied[3:6] = R @ u[k, :3], u[k, 3:6]
        for i, place in enumerate(order):
            data.qpos[place + 1], data.qvel[place], data.qfrc_applied[place] = q[k, 7 + i], v[k, 6 + i], u[k, 6 + i]
        mujoco.mj_forward(model, data)
        found[k, :3] = R.T @ data.qacc[:3] - np.cross(v[k, 3:6], v[k, :3])
        found[k, 3:6] = data.qacc[3:6]
        found[k, 6:] = [data.qacc[place] for place in order]
    return found


def turn(e):
    """R of the quaternion (x, y, z, w), by the product of quaternions e ∘ r ∘ e⁻¹."""
    x, y, z, w = e / np.linalg.norm(e)
    columns = []
    for r in np.eye(3):
        t = 2 * np.cross((x, y, z), r)
        columns.append(r + w * t + np.cross((x, y, z), t))
    return np.array(columns).T
