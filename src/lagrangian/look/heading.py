"""The picture at the head of a page: made once for a model, and never the reason why a page fails."""

from __future__ import annotations

import logging

from lagrangian.errors import Error
from lagrangian.look.hints import hints_of
from lagrangian.look.scenes import scene_of
from lagrangian.model import Model
from lagrangian.write.document import HeadPicture
from lagrangian.write.scene_svg import scene_svg
from lagrangian.write.scene_tikz import scene_tikz

_log = logging.getLogger(__name__)

MOST_BODIES = 60
"""A system with more bodies has no picture at the head of its pages: it would say nothing, and take long."""


def head_picture(model: Model) -> HeadPicture | None:
    """The picture of a model for the head of a page; None where there is nothing to draw.

    If it cannot be made, ``trouble`` says so, and the page comes without it.
    """
    return model.remembered("head picture", lambda: _made(model))


def _made(model: Model) -> HeadPicture | None:
    if not model.bodies:
        return None
    if len(model.bodies) > MOST_BODIES:
        return _without(f"{len(model.bodies)} bodies are too many for a picture here; system.look() draws them")
    try:
        scene, _ = scene_of(model, hints_of(model))
        if not any(part.elements for part in scene.parts):
            return None
        return HeadPicture(scene_svg(scene, embedded=True), _bare(scene_tikz(scene)), scene.description, scene.size)
    except Error as error:
        return _without(f"none could be drawn: {error.what}")
    except Exception as error:  # a fault in the rules of pictures must not cost a derivation
        _log.warning("the picture of '%s' could not be made", model.name, exc_info=True)
        return _without(f"none could be drawn, by a fault of this program ({type(error).__name__}); please report it")


def _bare(tikz: str) -> str:
    """TikZ without its comments, so that no name of an element is in the text of an article."""
    return "\n".join(line for line in tikz.splitlines() if not line.startswith("%")) + "\n"


def _without(trouble: str) -> HeadPicture:
    return HeadPicture("", "", "", trouble=trouble)
