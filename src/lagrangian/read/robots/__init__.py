"""Reads the files of robots (URDF, MJCF) into a `Builder`: markup → links and joints → description of a system."""

from lagrangian.read.robots.reading import is_markup, read_robot

__all__ = ["is_markup", "read_robot"]
