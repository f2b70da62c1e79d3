"""Floating frames in model files: read, written back, and refused with the line."""

import numpy as np
import pytest

import lagrangian as lg
from lagrangian import read

TEXT = """
name = "satellite with a wheel"

[coordinates]
s = "wheel angle"
z = "slider"

[parameters]
m = "2 kg"
k = "3 N/m"

[inputs]
F = "N"
T = "N*m"

[[frame]]
name = "hull"
floating = true

[[frame]]
name = "second"
floating = true
after = "s"

[[frame]]
name = "third"
floating = true
after = "second"

[[frame]]
name = "wheel"
angle = "s"
axis = [0, 0, 1]
parent = "hull"

[define]
height = "hull_z + second_z"

[points]
tip = { frame = "hull", offset = [0.1, 0, 0.2] }

[[rigid_body]]
mass = "m"
inertia = [0.1, 0.2, 0.25]
at = "hull_origin"
frame = "hull"

[[rigid_body]]
mass = 1
inertia = [0.1, 0.1, 0.15]
at = { frame = "wheel", offset = [0, 0.1, 0.1] }
frame = "wheel"

[[rigid_body]]
mass = 1
inertia = [0.1, 0.1, 0.15]
at = "second_origin"
frame = "second"

[[rigid_body]]
mass = 3
inertia = [0.1, 0.1, 0.15]
at = { frame = "third", offset = [0, 0, 0.1] }
frame = "third"

[[particle]]
mass = 1
at = [0, "z", 0]

[[gravity]]
direction = [0, 0, -1]

[[spring]]
k = "k"
between = ["tip", "second_origin"]

[[damper]]
b = 0.3
deflection = "height"

[[dissipation]]
value = "0.1*hull_wx^2"

[[force]]
value = ["F", 0, 0]
at = "tip"
axes = "hull"

[[torque]]
value = ["T", 0, 0]
on = "second"
reaction = "hull"
axes = "hull"

[[generalized_force]]
coordinate = "third_wz"
value = "T"

[simulate]
duration = "1 s"
initial = { hull_qw = 1, hull_wx = "1 rad/s", s = 0.2, "s'" = 1 }
"""


def described() -> lg.System:
    """The same in Python."""
    s = lg.System("satellite with a wheel")
    m, k = s.parameters("m k", m="2 kg", k="3 N/m")
    F, T = s.inputs("F T")
    hull = s.floating_frame("hull")
    angle = s.coordinate("s")
    second, third = s.floating_frame("second"), s.floating_frame("third")
    z = s.coordinate("z")
    wheel = s.frame(angle, axis=(0, 0, 1), parent=hull)
    tip = s.point("tip", (0.1, 0, 0.2), frame=hull)
    s.rigid_body(m, (0.1, 0.2, 0.25), hull.origin, hull)
    s.rigid_body(1, (0.1, 0.1, 0.15), wheel.point(0, 0.1, 0.1), wheel)
    s.rigid_body(1, (0.1, 0.1, 0.15), second.origin, second)
    s.rigid_body(3, (0.1, 0.1, 0.15), third.point(0, 0, 0.1), third)
    s.particle(1, s.origin + (0, z, 0))
    s.gravity((0, 0, -1))
    s.spring(k, between=(tip, second.origin))
    s.damper(0.3, deflection=s["hull_z"] + s["second_z"])
    s.dissipation(0.1 * s["hull_wx"] ** 2)
    s.force((F, 0, 0), at=tip, axes=hull)
    s.torque((T, 0, 0), on=second, reaction=hull, axes=hull)
    s.generalized_force(s["third_wz"], T)
    return s


@pytest.mark.slow
def test_a_file_says_what_python_says_and_back() -> None:
    one, two = lg.loads(TEXT), described()
    assert one.compile().coordinates == two.compile().coordinates
    rng = np.random.default_rng(1)
    q, v, u = rng.normal(size=(5, 23)), rng.normal(size=(5, 20)), rng.normal(size=(5, 2))
    expected = two.compile().forward(q, v, u)
    for system in (one, lg.loads(one.to_toml()), lg.loads(two.to_toml())):
        assert system.compile().velocities == two.compile().velocities
        assert system.compile().forward(q, v, u) == pytest.approx(expected, rel=1e-12)
    assert lg.loads(one.to_toml()).to_toml() == one.to_toml()


def test_coordinates_of_floating_frames_come_first_or_after_what_is_named() -> None:
    names = [c.name for c in lg.loads(TEXT).model.coordinates]
    assert [names.index(n) for n in ("hull_x", "s", "second_x", "third_x", "z")] == [0, 7, 8, 15, 22]


def test_the_schema_wants_an_angle_or_floating() -> None:
    table = read.schema()["$defs"]["FrameTable"]
    assert table["required"] == ["name"]
    assert table["anyOf"][0] == {"required": ["angle"]}


@pytest.mark.parametrize(
    ("before", "after", "message", "line"),
    [
        ('after = "s"', 'after = "ss"', "no coordinate or frame with a quaternion 'ss'", "after"),
        ('angle = "s"\n', "", "the field 'angle' is missing", "[[frame]]"),
        (
            'angle = "s"\n',
            'angle = "s"\nafter = "z"\n',
            "it has no coordinates of its own, so it needs no 'after'",
            "after",
        ),
        ('after = "s"', "angle = 0", "it floats, so it has no 'angle'", "angle"),
        ('after = "s"', 'parent = "hull"', "it floats, so it has no 'parent'", "parent"),
        ('name = "second"', 'name = "hull"', "frame 'hull' is defined twice", "[[frame]]"),
        ('z = "slider"', 'z = "slider"\nhull_x = ""', "'hull_x' is defined twice", "hull_x"),
        ('k = "3 N/m"', 'k = "3 N/m"\nhull_vx = 1', "'hull_vx' is defined twice", "hull_vx"),
        ("hull_wx = ", '"hull_x\'" = ', "no coordinate 'hull_x'", "initial"),
        ('deflection = "height"', 'deflection = "hull_vz"', "holds a velocity, hull_vz", "[[damper]]"),
        ("offset = [0.1, 0, 0.2]", 'offset = [0.1, "hull_wz", 0.2]', "contains a rate, hull_wz", "tip"),
        ('coordinate = "third_wz"', 'coordinate = "third_qz"', "an entry of a quaternion", "[[generalized_force]]"),
        ("floating = true", 'floating = "yes"', "'floating' must be true or false", "floating"),
        ('value = ["T", 0, 0]\non', 'value = "T"\non', r"does not say about which axis", "[[torque]]"),
    ],
)
def test_what_is_wrong_is_told_with_its_line(before: str, after: str, message: str, line: str) -> None:
    assert before in TEXT
    with pytest.raises(lg.ModelError, match=message) as refused:
        lg.loads(TEXT.replace(before, after, 1))
    place = refused.value.place
    assert place is not None
    assert place.text is not None
    assert line in place.text
