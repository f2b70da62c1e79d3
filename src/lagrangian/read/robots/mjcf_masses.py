"""The masses of MJCF's bodies: given, or found from geoms and from the meshes that they name."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.meshes import Meshes
from lagrangian.read.robots.mjcf_tags import Defaults, Orientations, between
from lagrangian.read.robots.robot import Inertial, RobotLink
from lagrangian.read.robots.rotations import FixedPose, Vector, product, turned_tensor
from lagrangian.read.robots.solids import Solid, solid, together, volume
from lagrangian.records import dataclass

DENSITY = 1000.0
"""The density of a geom [kg/m³] unless it is given."""

SIZES = {"sphere": 1, "capsule": 2, "cylinder": 2, "box": 3, "ellipsoid": 3}
WITHOUT_MASS = ("plane", "hfield")


@dataclass
class Masses:
    """Finds the masses of bodies; ``from_geoms`` says whether geoms count: "true", "false", "auto" without others."""

    defaults: Defaults
    orientations: Orientations
    meshes: Meshes
    from_geoms: str

    def inertial(self, body: Tag, inherited: str) -> Inertial | None:
        """The mass of a body, from <inertial> or from its geoms."""
        given = body.one("inertial")
        if given is not None and self.from_geoms != "true":
            return self._given(given)
        geoms = [self.defaults.put_into(tag, inherited) for tag in body.all("geom")]
        solids = [] if self.from_geoms == "false" else list(self._solids(geoms))
        if not solids:
            return None
        all_of_them = together(solids)
        return Inertial(all_of_them.mass, all_of_them.centre, all_of_them.inertia, body.place)

    def _given(self, tag: Tag) -> Inertial:
        at, mass = self.orientations.pose(tag), tag.number("mass")
        if mass <= 0:
            raise tag.error(f"the mass is {mass:g} kg", "give a mass above 0", "E103" if mass == 0 else "E102", "mass")
        xx, yy, zz, xy, xz, yz = (*tag.vector("diaginertia", (0.0, 0.0, 0.0)), 0.0, 0.0, 0.0)
        if tag.get("fullinertia") is not None:
            xx, yy, zz, xy, xz, yz = tag.vector("fullinertia", (), (6,))
        rows = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
        return Inertial(mass, at.offset, turned_tensor(at.matrix, rows), tag.place)

    def _solids(self, geoms: list[Tag]) -> Iterator[Solid]:
        """The geoms with mass, as solids in the axes of their body."""
        for tag in geoms:
            kind = tag.get("type") or ("mesh" if tag.get("mesh") is not None else "sphere")
            mass = None if tag.get("mass") is None else tag.number("mass")
            density = tag.number("density", DENSITY)
            if kind in WITHOUT_MASS or mass == 0 or (mass is None and density == 0):
                continue
            fitted = kind != "mesh" and tag.get("mesh") is not None
            if kind not in (*SIZES, "mesh") or fitted or tag.get("shellinertia") == "true":
                fix = 'give the body an <inertial>, or the geom mass="0"'
                what = f"{kind} fitted to a mesh" if fitted else f"{kind} or a shell"
                raise tag.error(f"the mass of a {what} is not found from its shape", fix, "E405")
            if (mass is not None and mass < 0) or density < 0:
                raise tag.error("the mass is negative", "give a mass above 0", "E102")
            if kind == "mesh":
                at, made = self.orientations.pose(tag), self.meshes.solid(tag)
                yield made.scaled(density if mass is None else mass / made.mass).within(at.offset, at.matrix)
                continue
            size, at = self._size(tag, kind)
            made = solid(kind, size, mass if mass is not None else density * volume(kind, size))
            yield (
                made.placed(at.offset, at.matrix)
                if tag.get("fromto") is None
                else self._stretched(tag, kind, made, size)
            )

    def _size(self, tag: Tag, kind: str) -> tuple[Vector, FixedPose]:
        """Radii and half lengths, of which fromto gives the last."""
        needed = SIZES[kind]
        if tag.get("size") is None:
            raise tag.error("the attribute 'size' is missing", f"give {needed} numbers", "E401")
        values = tag.vector("size", (), (1, 2, 3))
        if tag.get("fromto") is not None:
            ends = tag.vector("fromto", (), (6,))
            half = between(ends[:3], ends[3:])[2]
            values = (values[0], half) if needed == 2 else (values[0], values[min(1, len(values) - 1)], half)
        if len(values) < needed or min(values[:needed]) <= 0:
            raise tag.error(
                f"a {kind} needs {needed} positive sizes", "radii and half lengths, in metres", "E414", "size"
            )
        a, b, c = (*values[:needed], 0.0, 0.0)[:3]
        return (a, b, c), self.orientations.pose(tag)

    def _stretched(self, tag: Tag, kind: str, made: Solid, size: Vector) -> Solid:
        """A geom that leads from one point to another."""
        if kind == "sphere":
            raise tag.error("a sphere leads from nowhere to nowhere", "leave fromto out", "E405", "fromto")
        ends = tag.vector("fromto", (), (6,))
        centre, axes, _ = between(ends[:3], ends[3:])
        if tag.frames:
            moved = self.orientations.moved(tag)
            centre, axes = FixedPose(centre).within(moved).offset, product(moved.matrix, axes)
        return made.placed(centre, axes)


def scaled(links: dict[str, RobotLink], total: float) -> None:
    """Scale all masses and inertias so that the masses add up to ``total``, as 'settotalmass' asks."""
    masses = [link.inertial.mass for link in links.values() if link.inertial is not None]
    for name, link in links.items():
        if link.inertial is not None:
            given = link.inertial
            made = Solid(given.mass, given.centre, given.inertia).scaled(total / sum(masses))
            links[name] = replace(link, inertial=Inertial(made.mass, made.centre, made.inertia, given.place))
