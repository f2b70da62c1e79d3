"""The sites of MJCF, places of bodies that actuators and equalities name."""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.mjcf_tags import Orientations
from lagrangian.read.robots.robot import RobotSite


def site_named(tag: Tag, key: str, sites: Mapping[str, tuple[Tag, str]], orientations: Orientations) -> RobotSite:
    """The site that an attribute names; ``sites`` has their tags and links by name."""
    name = tag.word(key, "tip")
    if name not in sites:
        tag.unknown("site", name, sites, key)
    found, link = sites[name]
    found.read = True
    if found.get("fromto") is not None:
        raise found.error("'fromto' of a site is not supported", "write pos and quat", "E405", "fromto")
    return RobotSite(link, orientations.pose(found))
