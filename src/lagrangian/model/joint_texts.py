"""What a text asks for of a joint: "B", "B on rod 1" (the other side), "B in axes of rod 2", or both."""

from __future__ import annotations

from collections.abc import Collection

from lagrangian.records import dataclass

ON, AXES = " on ", " in axes of "


@dataclass(frozen=True)
class AskedJoint:
    """A joint by name, the side ``on`` which it acts, and the frame whose ``axes`` its components are in."""

    joint: str
    on: str | None = None
    axes: str | None = None


def asked_joint(text: str, known: Collection[str]) -> AskedJoint:
    """Take a text apart; ``known`` are the names of joints, any of which may contain " on " itself.

    What no name explains stays the name of the joint, so that an error can say what there is.
    """
    if text in known:
        return AskedJoint(text)
    rest, _, axes = text.rpartition(AXES)
    if not rest:
        rest, axes = text, ""
    if rest not in known:
        for cut in (k for k in reversed(range(len(rest))) if rest.startswith(ON, k)):
            if rest[:cut] in known:
                return AskedJoint(rest[:cut], rest[cut + len(ON) :].strip(), axes.strip() or None)
    return AskedJoint(rest.strip(), None, axes.strip() or None)
