"""One app for all tests that only ask it kindly: its processes start once."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")

from served_app import Served, served


@pytest.fixture(scope="session")
def kind_app() -> Iterator[Served]:
    """An app with the limits that users have, except that a busy machine may take its time."""
    with served(seconds=600.0, sweep_seconds=3600.0) as found:
        yield found
