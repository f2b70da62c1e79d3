"""What does it look like? From a model to its picture."""

from lagrangian.look.picture import Picture, picture
from lagrangian.look.scenes import Hints, scene_of

__all__ = ["Hints", "Picture", "picture", "scene_of"]
