"""Runs of browser modules in Node and in Chromium, for the tests."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

from lagrangian.simulate.browser import BrowserModule

NODE = shutil.which("node")
CHROMIUM = shutil.which("chromium")
needs_node = pytest.mark.skipif(NODE is None, reason="node is not installed")

SHOWN = """
const told = (r) => JSON.parse(JSON.stringify(r, (_, x) => (ArrayBuffer.isView(x) ? Array.from(x) : x)));
const show = (x) => console.log(JSON.stringify(told(x)));
const compiled = () => lagrangianSolver.makeSolver(physics.bytes, physics.layout, physics.functions);
const fallback = () => lagrangianSolver.makeFallback(physics.functions, physics.layout);
const refused = (f) => { try { f(); return "nothing"; } catch (e) { return `${e.name}: ${e.message}`; } };
"""


def in_node(module: BrowserModule, text: str, folder: Path) -> list[Any]:
    """The values that a script shows after the module's own."""
    path = folder / "run.js"
    path.write_text(module.script() + SHOWN + text, encoding="utf-8")
    done = subprocess.run([str(NODE), str(path)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    return [json.loads(line) for line in done.stdout.splitlines()]
