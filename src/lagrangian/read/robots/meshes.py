"""Volume, centre and inertia of meshes: triangles in STL or OBJ files, or written in the file itself.

By the divergence theorem a closed surface is a sum of tetrahedra from any point to its triangles (A, B, C from it):

    V = Σ v,   v = A·(B × C)/6,      c = Σ v (A + B + C)/4 / V,
    ∫ x xᵀ dV = Σ v/20 (A Aᵀ + B Bᵀ + C Cᵀ + S Sᵀ),   S = A + B + C,      J = tr(P) 1 − P

Source: A. M. Messner, G. Q. Taylor, Algorithm 550: solid polyhedron measures, ACM TOMS 6(1), 1980, 121-130. What MuJoCo
calls "legacy", its default, takes |v|: from the centre of the surface for c, then from c for the mass and the inertia.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import ParseError
from lagrangian.quantities.source import shown
from lagrangian.read.robots.beside import beside
from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.mjcf_tags import Defaults, Orientations
from lagrangian.read.robots.rotations import ZERO, FixedPose
from lagrangian.read.robots.solids import Solid
from lagrangian.records import dataclass, field

Array = NDArray[np.float64]

MAX_BYTES = 16 * 2**20
"""The largest size of a mesh's file."""

MAX_BYTES_TOGETHER = 64 * 2**20
"""The largest size of all of them."""

MAX_TRIANGLES = 200_000
"""The largest number of triangles of a mesh, as in MuJoCo."""

MAX_SIZE = 1e6
"""The largest coordinate of a vertex [m]."""

WAYS = ("legacy", "exact", "convex")


@dataclass
class Meshes:
    """The meshes of one file by name, each read when its mass is asked for; ``folder`` holds the file, if it is one."""

    defaults: Defaults
    folder: Path | None
    directory: str = ""
    base_name_only: bool = False
    exact: bool = False
    tags: dict[str, Tag] = field(default_factory=dict[str, Tag])
    known: dict[str, Solid] = field(default_factory=dict[str, Solid])
    read: int = 0

    def collect(self, root: Tag) -> None:
        """Note the meshes among the assets, without reading any."""
        for tag in (mesh for asset in root.children if asset.name == "asset" for mesh in asset.children):
            if tag.name == "mesh":
                name = tag.attributes.get("name") or Path(tag.attributes.get("file", "")).stem
                self.tags.setdefault(name, tag)

    def solid(self, geom: Tag) -> Solid:
        """The solid that the mesh of a geom fills with the density 1 kg/m³, in the axes of the mesh."""
        name = geom.get("mesh") or ""
        if name not in self.tags:
            geom.unknown("mesh", name, self.tags, "mesh")
        if name not in self.known:
            self.known[name] = self._solid(self.defaults.put_into(self.tags[name], "main"))
        return self.known[name]

    def _solid(self, tag: Tag) -> Solid:
        way = tag.get("inertia") or ("exact" if self.exact else "legacy")
        if way not in WAYS:
            raise tag.error(f"'inertia' is {shown(way)}", f"known: {', '.join(WAYS)}", "E405", "inertia")
        corners = self._corners(tag)
        with np.errstate(all="ignore"):
            scale = np.array(tag.vector("scale", (1.0, 1.0, 1.0)))
            at = FixedPose(ZERO, Orientations().turns(tag, ("refquat",)))
            corners = (corners - np.array(tag.vector("refpos", ZERO))) @ np.array(at.matrix) * scale
            if not np.isfinite(corners).all() or np.abs(corners).max(initial=0.0) > MAX_SIZE:
                said = f"a vertex of {tag.title} is not finite, or farther out than {MAX_SIZE:g} m"
                raise tag.error(said, "give lengths in metres, and a scale if the file has others", "E101")
            if way == "convex":
                corners = hull(corners.reshape(-1, 3), tag)
            elif scale.prod() < 0:
                corners = corners[:, ::-1]
            return filled(corners, legacy=way == "legacy", tag=tag)

    def _corners(self, tag: Tag) -> Array:
        """The corners of the triangles (n, 3, 3), as they are written."""
        if tag.get("file") is not None:
            return self._file(tag)
        vertices = _numbers(tag, "vertex").reshape(-1, 3)
        if tag.get("face") is None:
            return hull(vertices, tag)
        faces = _numbers(tag, "face").reshape(-1, 3).astype(int)
        if faces.size == 0 or faces.min() < 0 or faces.max() >= len(vertices):
            raise tag.error(
                f"'face' names a vertex that does not exist; there are {len(vertices)}", "count from 0", "E414", "face"
            )
        return vertices[faces]

    def _file(self, tag: Tag) -> Array:
        """The corners in the file of a mesh, which must lie in the folder of the robot's file or below."""
        written = tag.word("file", "hand.stl")
        if self.folder is None:
            said = f"the mass of {tag.title} is needed, and there are no files beside a text"
            raise tag.error(said, "load the robot from its file, lagrangian.load(path)", "E702", "file")
        local = Path(written).name if self.base_name_only else str(Path(self.directory) / written)
        reader = READERS.get(Path(local).suffix.lower())
        if reader is None:
            raise tag.error(
                f"the mesh {shown(written)} is neither STL nor OBJ", "convert it, or give an <inertial>", "E405", "file"
            )
        try:
            data = self._bytes(tag, self.folder, local)
        except ParseError:
            raise
        except (OSError, ValueError, RuntimeError) as error:
            said = f"the mesh {shown(written)} cannot be read ({type(error).__name__})"
            raise tag.error(said, "check 'file', and 'meshdir' of <compiler>", "E702", "file") from None
        try:
            return reader(data)
        except (ValueError, IndexError, struct.error, OverflowError) as error:
            said = f"the mesh {shown(written)} is broken: {error}"
            raise tag.error(said, "save it anew as STL or OBJ", "E701", "file") from None

    def _bytes(self, tag: Tag, folder: Path, local: str) -> bytes:
        """What a file in a folder holds, within the limits; raises `OSError` if it is not a file that can be read."""
        with beside(tag, folder, local, "mesh").open("rb") as file:
            data = file.read(min(MAX_BYTES, MAX_BYTES_TOGETHER - self.read) + 1)
        self.read += len(data)
        if len(data) > MAX_BYTES or self.read > MAX_BYTES_TOGETHER:
            fix = f"at most {MAX_BYTES} bytes of one mesh are read, and {MAX_BYTES_TOGETHER} of all"
            raise tag.error(f"the mesh {shown(local)} is too large", fix, "E703", "file")
        return data


def _numbers(tag: Tag, key: str) -> Array:
    """The numbers of an attribute, three for each vertex or triangle."""
    written = (tag.get(key) or "").split()
    if not written or len(written) % 3 or len(written) > 3 * MAX_TRIANGLES:
        raise tag.error(
            f"'{key}' has {len(written)} entries", f"give three for each, at most {3 * MAX_TRIANGLES}", "E414", key
        )
    return np.array(tag.vector(key, (), (len(written),)))


def stl(data: bytes) -> Array:
    """The corners in an STL file, binary or text; raises `ValueError`."""
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= 84 else -1
    if count > 0 and len(data) == 84 + 50 * count:
        _check_count(count)
        rows = np.frombuffer(data, np.dtype([("n", "<f4", 3), ("corners", "<f4", (3, 3)), ("extra", "<u2")]), count, 84)
        return rows["corners"].astype(float)
    if not data.lstrip().startswith(b"solid"):
        raise ValueError("its size is not that of its triangles")
    _check_count(data.count(b"vertex") // 3)
    found = re.findall(rb"\bvertex[ \t]+(\S+)[ \t]+(\S+)[ \t]+(\S+)", data)
    if len(found) % 3:
        raise ValueError("a triangle has no three vertices")
    return np.array([[float(x) for x in row] for row in found]).reshape(-1, 3, 3)


def obj(data: bytes) -> Array:
    """The corners in an OBJ file, faces with more than three as fans; raises `ValueError`."""
    vertices: list[list[float]] = []
    triangles: list[tuple[int, int, int]] = []
    for line in BytesIO(data):
        words = line.split()
        if not words:
            continue
        if words[0] == b"v":
            if len(words) < 4 or len(vertices) >= 3 * MAX_TRIANGLES:
                raise ValueError("a vertex has no three coordinates, or there are too many")
            vertices.append([float(x) for x in words[1:4]])
        elif words[0] == b"f":
            at = [int(word.split(b"/", 1)[0]) for word in words[1:]]
            at = [i - 1 if i > 0 else len(vertices) + i for i in at]
            if len(at) < 3 or min(at) < 0:
                raise ValueError("a face names no three vertices")
            _check_count(len(triangles) + len(at) - 2)
            triangles.extend((at[0], at[k], at[k + 1]) for k in range(1, len(at) - 1))
    _check_count(len(triangles))
    return np.array(vertices)[np.array(triangles)]


READERS: dict[str, Callable[[bytes], Array]] = {".stl": stl, ".obj": obj}


def _check_count(count: int) -> None:
    if not 0 < count <= MAX_TRIANGLES:
        raise ValueError(f"it has {max(count, 0)} triangles; 1 to {MAX_TRIANGLES} are read")


def hull(points: Array, tag: Tag) -> Array:
    """The corners of the convex hull, seen from outside in positive order."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        made = ConvexHull(points)
    except (QhullError, ValueError):
        raise _flat(tag) from None
    corners = points[made.simplices]
    inwards = np.einsum("ij,ij->i", _normals(corners), made.equations[:, :3]) < 0
    corners[inwards] = corners[inwards][:, ::-1]
    return corners


def _normals(corners: Array) -> Array:
    """(B − A) × (C − A) of each triangle: twice its area, along its normal."""
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def _flat(tag: Tag) -> ParseError:
    return tag.error(
        f"{tag.title} encloses no volume", "close it, its triangles counter-clockwise seen from outside", "E103"
    )


def filled(corners: Array, *, legacy: bool, tag: Tag) -> Solid:
    """The solid of density 1 within triangles; `legacy` counts every tetrahedron as positive."""
    twice = _normals(corners)
    area = np.linalg.norm(twice, axis=1)
    if not area.sum() > 0:
        raise _flat(tag)
    middle = corners.mean(axis=1)
    start = area @ middle / area.sum()

    def volumes(apex: Array) -> Array:
        v = np.einsum("ij,ij->i", middle - apex, twice) / 6
        return np.abs(v) if legacy else v

    v = volumes(start)
    total = float(v.sum())
    if not total > 1e-15 * float(area.sum()) ** 1.5:
        raise _flat(tag)
    centre = v @ (0.75 * middle + 0.25 * start) / total
    v, out = volumes(centre), corners - centre
    whole = out.sum(axis=1)
    P = (np.einsum("n,nki,nkj->ij", v, out, out) + np.einsum("n,ni,nj->ij", v, whole, whole)) / 20
    J = np.trace(P) * np.eye(3) - P
    x, y, z = (float(k) for k in centre)
    a, b, c = ((float(row[0]), float(row[1]), float(row[2])) for row in J)
    return Solid(float(v.sum()), (x, y, z), (a, b, c))
