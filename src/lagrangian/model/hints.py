"""The words of ``[look]``: what a body or a line may be drawn as."""

from __future__ import annotations

BODY_KINDS = ("ball", "cart", "box", "wheel", "disk", "disc", "link", "plate", "bar", "none")
"""What a body may be drawn as."""

LINE_KINDS = ("string", "rod", "wire", "wall", "floor")
"""What a line without mass may be drawn as."""
