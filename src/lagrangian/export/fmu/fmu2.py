"""Writes a system as an FMU of version 2.0."""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.export.fmu.archive import archive
from lagrangian.model import Model


def files(model: Model, stem: str) -> Mapping[str, bytes]:
    """``stem.fmu``."""
    return {f"{stem}.fmu": archive(model, stem, 2)}
