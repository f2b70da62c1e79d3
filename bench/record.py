"""What all benchmarks share: the machine in words, one core, a table, and the end of RESULTS.md."""

from __future__ import annotations

import argparse
import os
import platform
import time
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

RESULTS = Path(__file__).parent / "RESULTS.md"


def command_line(description: str | None) -> argparse.ArgumentParser:
    """The parser of a benchmark's command line, with ``--append``."""
    parser = argparse.ArgumentParser(description=(description or "").splitlines()[0])
    parser.add_argument("--append", action="store_true", help="append to bench/RESULTS.md")
    return parser


def one_core() -> None:
    """Stay on one core, where the system knows how."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


def this_machine(*packages: str) -> str:
    """The processor, its load, the system, Python, and the packages with their versions or that they are missing."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    processor = models[0] if models else platform.processor() or platform.machine()
    load = f", load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""
    installed, missing = [], []
    for package in packages:
        try:
            installed.append(f"{package} {version(package)}")
        except PackageNotFoundError:
            missing.append(package)
    without = f"; not installed: {', '.join(missing)}" if missing else ""
    return (
        f"{processor}, {os.cpu_count()} cores{load}; {platform.system()}; "
        f"{', '.join([f'Python {platform.python_version()}', *installed])}{without}; {time.strftime('%Y-%m-%d %H:%M')}"
    )


def table(head: list[str], rows: list[list[str]]) -> list[str]:
    """A Markdown table, all columns but the first to the right."""
    return ["| " + " | ".join(row) + " |" for row in (head, ["---", *["---:"] * (len(head) - 1)], *rows)]


def append(lines: list[str]) -> None:
    """Add lines of Markdown to the end of RESULTS.md, after an empty one."""
    before = RESULTS.read_text(encoding="utf-8") if RESULTS.exists() else "# Results\n"
    RESULTS.write_text("\n".join([before.rstrip(), "", *lines]).rstrip() + "\n", encoding="utf-8")
