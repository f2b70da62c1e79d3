"""Reads the text of a robot's file: which format it is, the robot in it, and its description as a `Builder`."""

from __future__ import annotations

from pathlib import Path

from lagrangian.model import Builder
from lagrangian.read.robots.assembling import assembled
from lagrangian.read.robots.markup import MarkupFile
from lagrangian.read.robots.mjcf import read_mjcf
from lagrangian.read.robots.urdf import read_urdf


def is_markup(text: str) -> bool:
    """Whether a text is XML rather than TOML, which never begins with ``<``."""
    return text.lstrip().startswith("<")


def read_robot(text: str, name: str, folder: Path | None = None) -> Builder:
    """Return the description of the robot in a text; errors name the file ``name``, with line and column.

    Meshes are read from the ``folder`` of the file and below, and only where their mass is asked for.
    """
    root = MarkupFile(text.lstrip("\ufeff"), name).parse()
    if root.name == "mujoco":
        return assembled(read_mjcf(root, folder))
    if root.name != "robot":
        raise root.error(
            f"the outermost element is <{root.name[:40]}>, which is not a robot's",
            "a file in URDF is <robot> … </robot>, one in MJCF <mujoco> … </mujoco>",
            "E405",
        )
    return assembled(read_urdf(root))
