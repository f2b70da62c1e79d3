"""What does it look like? From a model to its picture."""

from lagrangian.look.hints import Hints, hints_of
from lagrangian.look.scenes import scene_of

__all__ = ["Hints", "hints_of", "scene_of"]
