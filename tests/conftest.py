"""What all tests share: their size, and a place for what they keep."""

from __future__ import annotations

import os

import pytest

import size


def pytest_configure(config: pytest.Config) -> None:
    os.environ.setdefault("MPLBACKEND", "Agg")  # plots are pyplot's, and no window is to open
    size.FULL = "not slow" not in config.getoption("markexpr")


@pytest.fixture(autouse=True, scope="session")
def machine_code(tmp_path_factory: pytest.TempPathFactory) -> None:
    """A cache of machine code that all tests of a session share, whatever HOME is."""
    shared = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        shared = shared.parent
    os.environ["LAGRANGIAN_CACHE_DIR"] = str(shared / "machine-code")
