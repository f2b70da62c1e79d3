"""Converts the hints for a picture, ``[look]``, to new coordinates: the pose, and the names that are left out."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from typing import Any

from lagrangian.coordinates.change import Change
from lagrangian.coordinates.initial import solved_pose
from lagrangian.errors import ModelError
from lagrangian.model import Model

_log = logging.getLogger(__name__)


def carried_look(model: Model, change: Change, elements: Sequence[str]) -> dict[str, Any]:
    """Return the hints of the model in the new coordinates; ``elements`` are the names of the new elements.

    A pose that gives all coordinates is converted, ξ = φ(η). Of one that gives only some, the coordinates that stay
    as they were are kept, and a warning is logged for every other one.
    """
    look = dict(model.look)
    if pose := dict(look.get("pose", {})):
        look["pose"] = _pose(model, change, pose)
    if "hide" in look:
        known = {*elements, *(c.name for c in change.new)}
        look["hide"] = [name for name in look["hide"] if name in known]
    return look


def _pose(model: Model, change: Change, pose: dict[str, Any]) -> dict[str, Any]:
    replaced = {c.name for c, _ in change.replaced}
    if not replaced & set(pose):
        return pose
    if all(c.name in pose for c in change.old):
        try:
            return dict(solved_pose(model, change, pose))
        except ModelError as error:
            _log.warning("the pose of [look] has no counterpart in the new coordinates: %s", error.what)
    new = {c.name for c in change.new}
    kept = {name: value for name, value in pose.items() if name not in replaced and name in new}
    for name in pose.keys() - kept.keys():
        _log.warning("[look] pose: the value of '%s' is left out, because it is no coordinate any more", name)
    return kept
