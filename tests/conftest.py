"""What all tests share: their size, and a place for what they keep."""

from __future__ import annotations

import compileall
import gc
import os
import sys
from collections import Counter

import pytest
from hypothesis import HealthCheck, settings

import size


def pytest_configure(config: pytest.Config) -> None:
    gc.set_threshold(200_000, 50, 100)  # most of what is made lives long: it is seldom looked at
    _keep_bytecode(config)
    os.environ.setdefault("MPLBACKEND", "Agg")  # plots are pyplot's, and no window is to open
    os.environ.setdefault("SYMPY_CACHE_SIZE", "20000")  # as the command sets it
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # every core has its process: more threads wait for each other
    # how long an example takes depends on what else the machine does, and says nothing about the package
    settings.register_profile("untimed", deadline=None, suppress_health_check=[HealthCheck.too_slow])
    settings.load_profile("untimed")
    chosen = config.getoption("markexpr") or ""
    size.FULL = "not slow" not in chosen
    size.EVERY = size.FULL and "not exhaustive" not in chosen


def _keep_bytecode(config: pytest.Config) -> None:
    """Compile the package once: a hundred processes of the tests import it, and each would compile it again."""
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    sys.dont_write_bytecode = False
    if "PYTEST_XDIST_WORKER" not in os.environ:
        compileall.compile_dir(config.rootpath / "src", quiet=2)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the cases that a sample leaves out.

    Of a test marked ``sampled`` only some cases are quick: the rest is run among the tests that take long. Of those, a
    test marked ``thinned`` has only some that are run for every change: the rest is ``exhaustive``.
    """
    for name, others in (("sampled", "slow"), ("thinned", "exhaustive")):
        seen: Counter[str] = Counter()
        for item in items:
            if not isinstance(item, pytest.Function) or not (mark := item.get_closest_marker(name)):
                continue
            if name == "thinned" and not item.get_closest_marker("slow"):
                continue
            test = item.nodeid.partition("[")[0]
            if not size.in_sample(mark.args[0], seen[test], item.callspec.params.values()):
                item.add_marker(others)
            seen[test] += 1


def pytest_collection_finish() -> None:
    gc.collect()
    gc.freeze()  # what was imported is not looked at again


@pytest.fixture(autouse=True, scope="session")
def machine_code(pytestconfig: pytest.Config) -> None:
    """A cache of machine code that all tests of this checkout share, also later ones, whatever HOME is."""
    os.environ["LAGRANGIAN_CACHE_DIR"] = str(pytestconfig.rootpath / ".pytest_cache" / "machine-code")
