"""Masses of meshes: those of solids in textbooks and in MuJoCo; files that are broken, hostile or elsewhere."""

import os
import struct

import numpy as np
import pytest
from test_mjcf import compared

import lagrangian as lg
from lagrangian.errors import ParseError
from lagrangian.read.robots import meshes

OUTLINE = [(0, 0), (5, 0), (5, 4), (4, 4), (4, 1), (1, 1), (1, 4), (0, 4)]
HALVES = [(0, 1, 4), (0, 4, 5), (1, 2, 3), (1, 3, 4), (0, 5, 6), (0, 6, 7)]


def channel():
    """The vertices and triangles of a leaning channel, which is not convex: a U along z."""
    n = len(OUTLINE)
    vertices = [(x / 10, y / 10, 0.05) for x, y in OUTLINE]
    vertices += [(x / 10 + 0.01 * y, y / 10, 0.13 + 0.01 * x) for x, y in OUTLINE]
    faces = [(a, c, b) for a, b, c in HALVES] + [(a + n, b + n, c + n) for a, b, c in HALVES]
    for i in range(n):
        j = (i + 1) % n
        faces += [(i, j, j + n), (i, j + n, i + n)]
    return vertices, faces


def stl(vertices, faces):
    rows = (struct.pack("<12fH", 0, 0, 0, *(x for k in face for x in vertices[k]), 0) for face in faces)
    return b" " * 80 + struct.pack("<I", len(faces)) + b"".join(rows)


def written(vertex):
    return " ".join(map(repr, vertex)) + "\n"


def stl_text(vertices, faces):
    rows = ("outer loop\n" + "".join("vertex " + written(vertices[k]) for k in face) + "endloop\n" for face in faces)
    return ("solid u\n" + "".join(rows) + "endsolid u\n").encode()


def obj(vertices, faces):
    lines = ["v " + written(v) for v in vertices] + ["f " + " ".join(f"{k + 1}/1/1" for k in f) + "\n" for f in faces]
    return "".join(lines).encode()


def robot(mesh, geom=""):
    return f"""<mujoco><compiler meshdir="assets"/><asset><mesh name="m" {mesh}/></asset><worldbody><body>
<joint name="j" type="ball" pos=".1 0 0"/>
<geom type="mesh" mesh="m" pos=".1 .2 .3" euler="10 20 30" density="700"/><geom type="mesh" mesh="m" mass=".4"/>{geom}
</body></worldbody></mujoco>"""


def saved(folder, mesh, **files):
    (folder / "assets").mkdir(exist_ok=True)
    for name, data in files.items():
        (folder / "assets" / name.replace("_", ".")).write_bytes(data)
    path = folder / "robot.xml"
    path.write_text(robot(mesh), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("mesh", "rtol"),
    [
        ('file="u.stl"', 1e-10),
        pytest.param('file="u.stl" inertia="convex"', 1e-10, marks=pytest.mark.slow),
        ('file="u.obj" inertia="exact" scale="1 -2 1"', 1e-6),  # MuJoCo keeps seven digits of a vertex
        ('file="u.obj" inertia="exact" refpos=".1 .2 .3" refquat=".5 .1 .2 .8" scale="1 2 3"', 1e-6),
        ('vertex="0 0 0 1 0 0 0 1 0 0 0 1 .5 .5 .5 .1 .1 .1"', 1e-10),
    ],
)
def test_the_same_as_mujoco(tmp_path, mesh, rtol):
    mujoco = pytest.importorskip("mujoco")
    path = saved(tmp_path, mesh, u_stl=stl(*channel()), u_obj=obj(*channel()))
    compared(mujoco, mujoco.MjModel.from_xml_path(str(path)), lg.load(path), rtol)


@pytest.mark.parametrize("write", [stl, stl_text, obj])
def test_a_block_has_its_mass_and_moments(tmp_path, write):
    """m = ρ a b c and J = m (b² + c²)/12 about the centre, as in every textbook."""
    size = np.array([0.5, 0.25, 2.0])
    corners = [
        tuple(float(s * k) for s, k in zip(size, (x, y, z), strict=True))
        for x in (0, 1)
        for y in (0, 1)
        for z in (0, 1)
    ]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))]
    if write is obj:
        faces = quads
    name = "block.obj" if write is obj else "block.stl"
    path = saved(tmp_path, f'file="{name}" inertia="exact"', **{name.replace(".", "_"): write(corners, faces)})
    text = path.read_text(encoding="utf-8").replace(' pos=".1 .2 .3" euler="10 20 30" density="700"', "")
    path.write_text(text.replace('<geom type="mesh" mesh="m" mass=".4"/>', ""), encoding="utf-8")
    (body,) = lg.load(path).model.bodies
    values = lg.load(path).model.values
    m = 1000 * size.prod()
    J = [float(body.inertia[k, k].subs(values)) for k in range(3)]
    assert float(body.mass.subs(values)) == pytest.approx(m, rel=1e-12)
    assert pytest.approx(m / 12 * ((size**2).sum() - size**2), rel=1e-12) == J


def test_meshes_without_need_are_not_read(tmp_path):
    text = robot('file="missing.stl"').replace("<geom", '<inertial pos="0 0 -1" mass="2"/><geom', 1)
    path = tmp_path / "robot.xml"
    path.write_text(text, encoding="utf-8")
    assert len(lg.load(path).model.bodies) == 1


GOOD = stl(*channel())
HOSTILE = [
    ('file="missing.stl"', {}, "[E702] mesh 'm': the mesh 'missing.stl' cannot be read (FileNotFoundError)"),
    ('file="../../u.stl"', {}, "is outside the folder of the robot's file"),
    ('file="/etc/passwd.stl"', {}, "is outside the folder of the robot's file"),
    ('file="u.msh"', {"u_msh": b""}, "[E405] mesh 'm': the mesh 'u.msh' is neither STL nor OBJ"),
    ('file="u.stl"', {"u_stl": b""}, "is broken: its size is not that of its triangles"),
    ('file="u.stl"', {"u_stl": GOOD[:-1]}, "is broken: its size is not that of its triangles"),
    ('file="u.stl"', {"u_stl": GOOD[:80] + b"\xff\xff\xff\xff" + GOOD[84:]}, "is broken: its size is not"),
    ('file="u.stl"', {"u_stl": b"solid\nvertex 1 2 x\nvertex 1 2 3\nvertex 1 2 3"}, "is broken: could not convert"),
    ('file="u.stl"', {"u_stl": b"solid\nvertex 1 2 nan\nvertex 1 2 3\nvertex 1 0 3"}, "[E101] mesh 'm': a vertex of"),
    ('file="u.stl" scale="1e300 1 1"', {"u_stl": GOOD}, "or farther out than 1e+06 m"),
    ('file="u.stl" scale="0 1 1"', {"u_stl": GOOD}, "encloses no volume"),
    ('file="u.stl" inertia="shell"', {"u_stl": GOOD}, "[E405] mesh 'm': 'inertia' is 'shell'"),
    ('file="u.obj"', {"u_obj": b"v 0 0 0\nf 1 2 3\n"}, "is broken: index"),
    ('file="u.obj"', {"u_obj": b"v 0 0 0\nf 1 1 -7\n"}, "is broken: a face names no three vertices"),
    ('file="u.obj"', {"u_obj": b"f 1 1 " + b"9" * 9000}, "is broken: Exceeds the limit"),
    ('file="u.obj"', {"u_obj": b"v 0 0\n"}, "is broken: a vertex has no three coordinates"),
    ('file="u.obj"', {"u_obj": b"v 0 0 0\nf " + b"1 " * 300_000}, "is broken: it has 299998 triangles"),
    ('vertex="0 0 0 1 0 0 0 1 0 1 1 0"', {}, "encloses no volume"),
    ('vertex="0 0 0 1"', {}, "[E414] mesh 'm': 'vertex' has 4 entries"),
    ('vertex="0 0 0 1 0 0 0 1 0" face="0 1 3"', {}, "'face' names a vertex that does not exist; there are 3"),
]


@pytest.mark.parametrize(("mesh", "files", "said"), HOSTILE, ids=[said[:40] for _, _, said in HOSTILE])
def test_the_message_names_what_is_wrong_with_a_mesh(tmp_path, mesh, files, said):
    path = saved(tmp_path, mesh, **files)
    with pytest.raises(ParseError) as caught:
        lg.load(path)
    assert said in str(caught.value) and "robot.xml:1:" in str(caught.value)


def test_links_pipes_large_files_and_texts_without_a_folder_are_refused(tmp_path, monkeypatch):
    inside = tmp_path / "robot"
    inside.mkdir()
    path = saved(inside, 'file="u.stl"')
    outside = tmp_path / "u.stl"
    outside.write_bytes(GOOD)
    link = inside / "assets" / "u.stl"
    for make, said in (
        (lambda: link.symlink_to(outside), "outside the folder"),
        (lambda: os.mkfifo(link), "cannot be"),
    ):
        make()
        with pytest.raises(ParseError, match=said):
            lg.load(path)
        link.unlink()
    link.write_bytes(GOOD)
    with pytest.raises(ParseError, match="there are no files beside a text"):
        lg.loads(path.read_text(encoding="utf-8"))
    lg.load(path)
    monkeypatch.setattr(meshes, "MAX_BYTES", len(GOOD) - 1)
    with pytest.raises(ParseError, match=r"the mesh 'assets.u.stl' is too large"):
        lg.load(path)
