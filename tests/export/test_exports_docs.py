"""The manual of exports: its table, and its code."""

import pathlib
import re
import subprocess
import sys
from importlib.util import find_spec

import pytest

from lagrangian.export import TARGETS

TEXT = (pathlib.Path(__file__).parents[2] / "docs" / "exports.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```python\n(.*?)^```", TEXT, flags=re.M | re.S)


def test_every_target_has_a_line_and_says_what_it_was_run_with() -> None:
    rows = dict(re.findall(r"^\| `(\w+)` \| `(\.\w+)`.*\|$", TEXT, flags=re.M))
    assert rows == {name: target.ending for name, target in TARGETS.items()}


@pytest.mark.slow
def test_the_code_of_the_manual_runs(tmp_path: pathlib.Path) -> None:
    assert len(BLOCKS) >= 3
    absent = [name for name in ("jax", "casadi", "fmpy", "rumoca") if find_spec(name) is None]
    code = "\n".join(b for b in BLOCKS if not any(f"import {name}" in b for name in absent))
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
