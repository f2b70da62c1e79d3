"""Robots in URDF: kinematics and masses of published arms, rounded, and machines of every kind of joint."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

RIGHT = "1.5707963267948966"


def inertial(mass: float, centre: str = "0 0 0", moments: str = "", rpy: str = "0 0 0") -> str:
    """The text of <inertial>; moments are ixx iyy izz ixy ixz iyz, the last three 0 unless given."""
    values = (moments.split() + ["0"] * 6)[:6] if moments else ["0.01", "0.012", "0.015", "0", "0", "0"]
    written = " ".join(
        f'{key}="{v}"' for key, v in zip(("ixx", "iyy", "izz", "ixy", "ixz", "iyz"), values, strict=True)
    )
    return f'<inertial><origin xyz="{centre}" rpy="{rpy}"/><mass value="{mass}"/><inertia {written}/></inertial>'


def link(name: str, inside: str = "") -> str:
    return f'<link name="{name}">{inside}</link>'


def joint(
    name: str,
    kind: str,
    parent: str,
    child: str,
    xyz: str = "0 0 0",
    rpy: str = "0 0 0",
    axis: str = "0 0 1",
    more: str = "",
) -> str:
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>'
        f'<limit lower="-3" upper="3" effort="50" velocity="2"/>{more}</joint>'
    )


def robot(name: str, *parts: str) -> str:
    return f'<?xml version="1.0"?>\n<robot name="{name}">\n' + "\n".join(parts) + "\n</robot>\n"


def chain(name: str, links: Sequence[tuple[str, ...]], joints: Sequence[Mapping[str, str]]) -> str:
    """Links one after the other from ``base``, each with the arguments of its inertial and of its joint."""
    parts, before = [link("base")], "base"
    for number, (masses, moved) in enumerate(zip(links, joints, strict=True), 1):
        parts.append(link(f"link{number}", inertial(float(masses[0]), *masses[1:])))
        given = {"kind": "revolute", **moved}
        parts.append(joint(f"joint{number}", given.pop("kind"), before, f"link{number}", **given))
        before = f"link{number}"
    return robot(name, *parts)


TWO = chain(
    "two-link arm",
    [("1.5", "0 0 -0.2", "0.02 0.02 0.001"), ("1", "0 0 -0.15", "0.01 0.01 0.0005")],
    [{"axis": "0 1 0", "xyz": "0 0 1"}, {"axis": "0 1 0", "xyz": "0 0 -0.4"}],
)
UR5 = chain(
    "UR5",
    [
        ("3.7", "0 0 0", "0.010267 0.010267 0.00666"),
        ("8.393", "0 0 0.28", "0.22689 0.22689 0.0151074"),
        ("2.275", "0 0 0.25", "0.049443 0.049443 0.004095"),
        ("1.219", "0 0 0", "0.111172 0.111172 0.21942"),
        ("1.219", "0 0 0", "0.111172 0.111172 0.21942"),
        ("0.1879", "0 0.0823 0", "0.0171364 0.0171364 0.033822", f"{RIGHT} 0 0"),
    ],
    [
        {"xyz": "0 0 0.089159"},
        {"xyz": "0 0.13585 0", "rpy": f"0 {RIGHT} 0", "axis": "0 1 0"},
        {"xyz": "0 -0.1197 0.425", "axis": "0 1 0"},
        {"xyz": "0 0 0.39225", "rpy": f"0 {RIGHT} 0", "axis": "0 1 0"},
        {"xyz": "0 0.093 0"},
        {"xyz": "0 0 0.09465", "axis": "0 1 0"},
    ],
)
PANDA = chain(
    "Panda",
    [
        ("4.97", "0.003875 0.002081 -0.04762", "0.70337 0.70661 0.009117 -0.000139 0.006772 0.019169"),
        ("0.646", "-0.003141 -0.02872 0.003495", "0.007962 0.02811 0.025995 -0.003925 0.010254 0.000704"),
        ("3.228", "0.027518 0.039252 -0.066502", "0.037242 0.036155 0.01083 -0.004761 -0.011396 -0.012805"),
        ("3.587", "-0.05317 0.104419 0.027454", "0.025853 0.019552 0.028323 0.007796 -0.001332 0.008641"),
        ("1.225", "-0.011953 0.041065 -0.038437", "0.035549 0.029474 0.008627 -0.002117 -0.004037 0.000229"),
        ("1.666", "0.060149 -0.014117 -0.010517", "0.001964 0.004354 0.005433 0.000109 -0.001158 0.000341"),
        ("0.735", "0.010517 -0.004252 0.061597", "0.012516 0.010027 0.004815 -0.000428 -0.001196 -0.000741"),
    ],
    [
        {"xyz": "0 0 0.333"},
        {"rpy": f"-{RIGHT} 0 0"},
        {"xyz": "0 -0.316 0", "rpy": f"{RIGHT} 0 0"},
        {"xyz": "0.0825 0 0", "rpy": f"{RIGHT} 0 0"},
        {"xyz": "-0.0825 0.384 0", "rpy": f"-{RIGHT} 0 0"},
        {"rpy": f"{RIGHT} 0 0"},
        {"xyz": "0.088 0 0", "rpy": f"{RIGHT} 0 0"},
    ],
)
SCARA = chain(
    "SCARA",
    [("3", "0.15 0 0"), ("2", "0.12 0 0"), ("0.8", "0 0 -0.1"), ("0.3", "0.01 0.02 0")],
    [
        {"xyz": "0 0 0.4"},
        {"xyz": "0.3 0 0"},
        {"xyz": "0.25 0 0", "kind": "prismatic", "axis": "0 0 -1"},
        {"kind": "continuous", "axis": "0 0 -1"},
    ],
)
GANTRY = chain(
    "gantry",
    [("20", "0 0.5 0"), ("8", "0.1 0 0"), ("2", "0 0 -0.3"), ("1", "0 0.03 -0.05", "0.002 0.003 0.004 0.0005 0 0")],
    [
        {"kind": "prismatic", "axis": "1 0 0", "xyz": "0 0 2"},
        {"kind": "prismatic", "axis": "0 1 0"},
        {"kind": "prismatic", "axis": "0 0 1", "rpy": "0 0.3 0"},
        {"kind": "revolute", "axis": "1 0 0", "more": '<dynamics damping="0.4"/>'},
    ],
)
SKEW = chain(
    "skew axes",
    [("2", "0.1 0.2 0.3", "0.03 0.04 0.05 0.002 0.001 -0.003", "0.3 -0.4 0.5")] * 4,
    [
        {"axis": "1 2 2", "rpy": "0.1 0.2 0.3", "xyz": "0.1 0 0.2"},
        {"axis": "0.1 -0.7 0.4", "xyz": "0.2 0.3 0", "kind": "continuous"},
        {"axis": "1 1 0", "rpy": "0 0 -0.7", "kind": "prismatic"},
        {"axis": "0 0 -2", "rpy": "0.9 0 0.4", "xyz": "0 0.1 0.1"},
    ],
)
PARALLEL = chain(
    "parallel axes",
    [("1", "0.2 0 0"), ("0.8", "0.2 0 0"), ("0.6", "0.15 0 0"), ("0.4", "0.1 0.05 0")],
    [
        {"rpy": "0 0 0.4"},
        {"xyz": "0.4 0 0", "rpy": "0 0 -0.9"},
        {"xyz": "0.4 0 0.1"},
        {"xyz": "0.3 0 0", "axis": "0 0 -1"},
    ],
)
PENDULUM = robot(
    "inverted pendulum",
    link("world"),
    link("rail", inertial(5)),
    link("cart", inertial(1)),
    link("bracket", inertial(0.2, "0.01 0 0.02", "0.001 0.002 0.003 0.0001 0 0", "0 0.2 0")),
    link("rod", inertial(0.3, "0 0 0.4", "0.016 0.016 0.0001")),
    link("bob", '<inertial><mass value="0.5"/></inertial>'),
    link("sensor"),
    joint("ground", "fixed", "world", "rail", "0 0 0.5", "0 0 0.1"),
    joint("slide", "prismatic", "rail", "cart", axis="1 0 0"),
    joint("mount", "fixed", "cart", "bracket", "0.1 0.02 0.05", f"0 {RIGHT} 0.3"),
    joint("pin", "continuous", "bracket", "rod", "0.01 0 0", f"0 -{RIGHT} 0", "0 1 0"),
    joint("tip", "fixed", "rod", "bob", "0 0 0.8"),
    joint("camera", "fixed", "bob", "sensor", "0 0.1 0", "0.1 0.2 0.3"),
)
GRIPPER = robot(
    "gripper",
    link("base"),
    link("palm", inertial(0.7, "0 0 0.04")),
    link("left finger", inertial(0.1, "0 0.01 0.02")),
    link("right finger", inertial(0.1, "0 -0.01 0.02")),
    link("tip", inertial(0.02, "0 0 0.01", "0.0001 0.0002 0.00015")),
    joint("lift", "prismatic", "base", "palm"),
    joint("left-slide", "prismatic", "palm", "left finger", "0 0.02 0.05", axis="0 1 0"),
    joint(
        "right-slide",
        "prismatic",
        "palm",
        "right finger",
        "0 -0.02 0.05",
        axis="0 -1 0",
        more='<mimic joint="left-slide" multiplier="0.9" offset="0.01"/>',
    ),
    joint(
        "2nd",
        "revolute",
        "left finger",
        "tip",
        "0 0 0.04",
        axis="1 0 0",
        more='<mimic joint="left-slide" multiplier="-4"/>',
    ),
)


def _limb(root: str, name: str, joints: Sequence[tuple[str, str, float]]) -> list[str]:
    """A limb of (axis, place, mass), each link hanging below its joint."""
    parts, before = [], root
    for number, (axis, xyz, mass) in enumerate(joints, 1):
        own = f"{name}_{number}"
        parts += [link(own, inertial(mass, "0 0.01 -0.1", "0.01 0.012 0.004 0.0003 0 0.0002"))]
        parts += [joint(f"{own}_joint", "revolute", before, own, xyz, axis=axis)]
        before = own
    return parts


QUADRUPED = robot(
    "quadruped",
    link("world"),
    link("trunk", inertial(9, "0.01 0 0.02", "0.07 0.26 0.28 0.001 0 0.002")),
    joint("free", "floating", "world", "trunk"),
    *(
        part
        for x, y, name in ((1, 1, "lf"), (1, -1, "rf"), (-1, 1, "lh"), (-1, -1, "rh"))
        for part in _limb(
            "trunk",
            name,
            [("1 0 0", f"{0.19 * x} {0.05 * y} 0", 0.7), ("0 1 0", f"0 {0.08 * y} 0", 1), ("0 1 0", "0 0 -0.21", 0.2)],
        )
    ),
)
HUMANOID = robot(
    "upper body",
    link("pelvis", inertial(8)),
    *_limb("pelvis", "torso", [("0 0 1", "0 0 0.1", 2), ("0 1 0", "0 0 0.05", 15)]),
    *(
        part
        for y, name in ((0.2, "left"), (-0.2, "right"))
        for part in _limb(
            "torso_2",
            name,
            [
                ("0 1 0", f"0 {y} 0.35", 1),
                ("1 0 0", f"0 {y / 7:.3f} 0", 1),
                ("0 0 1", "0 0 -0.05", 1.5),
                ("0 1 0", "0 0 -0.25", 1.2),
            ],
        )
    ),
    *_limb("torso_2", "head", [("0 0 1", "0 0 0.5", 1), ("0 1 0", "0 0 0.06", 3)]),
)
PLANAR = robot(
    "mobile arm",
    link("floor"),
    link("platform", inertial(12, "0.05 0.02 0.1", "0.4 0.5 0.6 0.01 0.02 0.03")),
    link("arm", inertial(2, "0.2 0 0.1")),
    joint("wheels", "planar", "floor", "platform"),
    joint("shoulder", "revolute", "platform", "arm", "0.1 0 0.3", axis="0 1 0"),
)

ROBOTS = {
    "two-link arm": TWO,
    "UR5": UR5,
    "Panda": PANDA,
    "SCARA": SCARA,
    "gantry": GANTRY,
    "skew axes": SKEW,
    "parallel axes": PARALLEL,
    "inverted pendulum": PENDULUM,
    "gripper": GRIPPER,
    "quadruped": QUADRUPED,
    "upper body": HUMANOID,
    "mobile arm": PLANAR,
}
