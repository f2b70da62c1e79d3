"""A process that judges answers, one after another: messages are lines of JSON on its standard input and output.

It first reads ``{"model": …, "judging": …}`` and writes ``{"ready": true}`` or ``{"error": …}``; then it reads
``{"file": …, "content": "<base64>"}`` and writes the record, until the input ends.
"""

from __future__ import annotations

import base64
import json
import os
import sys
from typing import Any, TextIO

from lagrangian import bounded
from lagrangian.check.classes.judge import Judge, Judging
from lagrangian.errors import Error
from lagrangian.read import loads
from lagrangian.structured.choose import derive_in_form


def main() -> None:
    """Judge answers until the input ends."""
    source, sink = _streams()
    begun = json.loads(source.readline())
    try:
        judge = Judge(derive_in_form(loads(begun["model"]).model()), Judging.from_dict(begun["judging"]))
    except Error as error:
        _say(sink, {"error": str(error)})
        return
    _say(sink, {"ready": True})
    with bounded.rarely_collected():  # between answers as well
        for line in source:
            asked = json.loads(line)
            _say(sink, judge.judge(asked["file"], base64.b64decode(asked["content"])))


def _say(sink: TextIO, data: dict[str, Any]) -> None:
    sink.write(json.dumps(data) + "\n")
    sink.flush()


def _streams() -> tuple[TextIO, TextIO]:
    """Take the two streams for messages; what a library prints goes nowhere instead."""
    source = os.fdopen(os.dup(0), "r", encoding="utf-8")
    sink = os.fdopen(os.dup(1), "w", encoding="utf-8")
    nothing = os.open(os.devnull, os.O_RDWR)
    os.dup2(nothing, 0)
    os.dup2(nothing, 1)
    return source, sink


if __name__ == "__main__":
    sys.exit(main())
