"""Writes the integrator of a system for browsers, as WebAssembly."""

from __future__ import annotations

from collections.abc import Mapping

from lagrangian.model import Model
from lagrangian.simulate.browser import browser_module


def files(model: Model, stem: str) -> Mapping[str, str | bytes]:
    """The integrator of the default method, its layout, and the script that runs it."""
    return browser_module(model).files(stem)
