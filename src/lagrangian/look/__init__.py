"""What does it look like? From a model to its picture."""

from lagrangian.look.hints import Hints, hints_of
from lagrangian.look.picture import Picture, picture
from lagrangian.look.scenes import scene_of

__all__ = ["Hints", "Picture", "hints_of", "picture", "scene_of"]
