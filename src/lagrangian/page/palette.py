"""The colours of pictures by role, for light and dark surroundings; text in any of them has a contrast of at least 4.5.

They are the colours of the same kinds of terms in a derivation.
"""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.page.scene import Role
from lagrangian.records import dataclass


@dataclass(frozen=True)
class Palette:
    """Colours as ``#rrggbb``: of what stands behind everything, of bodies' insides, and of the lines of every role."""

    paper: str
    body: str
    lines: Mapping[Role, str]

    def line(self, role: Role) -> str:
        """The colour of the lines and letters of a role."""
        return self.lines[role]

    def inside(self, role: Role) -> str:
        """The colour of the inside of a filled shape: light blue-grey for a body, otherwise that of the paper."""
        return self.body if role == "body" else self.paper


LIGHT = Palette(
    paper="#fdfdfb",
    body="#dce7ef",
    lines={
        "body": "#1d2328",
        "rod": "#1d2328",
        "ground": "#1d2328",
        "stiffness": "#2d7d46",
        "damping": "#b3541e",
        "friction": "#b3541e",
        "gravity": "#8a6d00",
        "input": "#b02a4c",
        "coordinate": "#1f5f8b",
        "constraint": "#6d5a80",
        "thin": "#5a646d",
    },
)

DARK = Palette(
    paper="#16191c",
    body="#2b3c4a",
    lines={
        "body": "#e4e6e3",
        "rod": "#e4e6e3",
        "ground": "#e4e6e3",
        "stiffness": "#83cf9a",
        "damping": "#eba06f",
        "friction": "#eba06f",
        "gravity": "#dcc05c",
        "input": "#f08ba5",
        "coordinate": "#7db9e2",
        "constraint": "#bba9d0",
        "thin": "#a3acb3",
    },
)
