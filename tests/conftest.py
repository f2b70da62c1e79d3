"""What all tests share: their size, and a place for what they keep."""

from __future__ import annotations

import gc
import os

import pytest

import size


def pytest_configure(config: pytest.Config) -> None:
    gc.set_threshold(100_000, 20, 20)  # most of what is made lives long: it is seldom looked at
    os.environ.setdefault("MPLBACKEND", "Agg")  # plots are pyplot's, and no window is to open
    size.FULL = "not slow" not in config.getoption("markexpr")


def pytest_collection_finish() -> None:
    gc.collect()
    gc.freeze()  # what was imported is not looked at again


@pytest.fixture(autouse=True, scope="session")
def machine_code(tmp_path_factory: pytest.TempPathFactory) -> None:
    """A cache of machine code that all tests of a session share, whatever HOME is."""
    shared = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        shared = shared.parent
    os.environ["LAGRANGIAN_CACHE_DIR"] = str(shared / "machine-code")
