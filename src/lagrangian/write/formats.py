"""Every format and notation by its name."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

from lagrangian.derive import Derivation
from lagrangian.write.data import to_dict
from lagrangian.write.html import to_html
from lagrangian.write.latex import to_latex
from lagrangian.write.markdown import to_markdown
from lagrangian.write.quantities import Notation
from lagrangian.write.text import to_text


def to_json(derivation: Derivation, *, notation: Notation = "lecture", brief: bool = False, full: bool = False) -> str:
    """Return `to_dict` as JSON text."""
    return (
        json.dumps(to_dict(derivation, notation=notation, brief=brief, full=full), ensure_ascii=False, indent=1) + "\n"
    )


FORMATS: Mapping[str, Callable[..., str]] = {
    "text": to_text,
    "markdown": to_markdown,
    "latex": to_latex,
    "html": to_html,
    "json": to_json,
}
"""Every format's writer: ``FORMATS[name](derivation, notation=…, brief=…, full=…) -> str``."""

NOTATIONS: tuple[Any, ...] = ("lecture", "physics", "robotics")
"""The notations that `lay_out` and every writer know."""
