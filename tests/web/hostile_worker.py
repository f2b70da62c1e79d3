"""A process of the app whose jobs do what they must not: never end, eat memory, die, write files, say too much."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from lagrangian.errors import ModelError, Place
from lagrangian.web.requests import Part, Task
from lagrangian.web.worker import main


def spin(given: dict[str, Any], part: Part) -> Any:
    while True:
        pass


def eat(given: dict[str, Any], part: Part) -> Any:
    kept = []
    while True:
        kept.append(bytearray(1 << 24))


def die(given: dict[str, Any], part: Part) -> Any:
    os._exit(3)


def babble(given: dict[str, Any], part: Part) -> Any:
    print("not a message")
    sys.stdout.flush()
    os.write(1, b"\xff" * 100)
    return "said"


def write(given: dict[str, Any], part: Part) -> Any:
    try:
        Path(given["path"]).write_text("written")
    except OSError as error:
        return type(error).__name__
    return "written"


def large(given: dict[str, Any], part: Part) -> Any:
    return "x" * (9 << 20)


def fail(given: dict[str, Any], part: Part) -> Any:
    raise LookupError("a mistake of ours")


def refuse(given: dict[str, Any], part: Part) -> Any:
    raise ModelError("wrong", place=Place("model.toml", 3, 7, "text"), fix="right it", code="E402")


def deep(given: dict[str, Any], part: Part) -> Any:
    return deep(given, part)


def nothing(given: dict[str, Any], part: Part) -> Any:
    return "nothing"


def process(given: dict[str, Any], part: Part) -> Any:
    return os.getpid()


def jobs() -> Mapping[str, Task]:
    wrong = (spin, eat, die, babble, write, large, fail, refuse, deep, nothing, process)
    return {job.__name__: job for job in wrong} | {"derive": refuse}


if __name__ == "__main__":
    sys.stderr = open(os.devnull, "w")  # noqa: SIM115, PTH123
    main(jobs)
