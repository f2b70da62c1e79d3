"""Messages between the server and its processes: four bytes with the length, then JSON. Nothing in them is executed."""

from __future__ import annotations

import json
import struct
from typing import Any, BinaryIO

HEAD = struct.Struct(">I")

MAX_ANSWER = 8 * 2**20
"""The largest size of an answer in bytes."""

MAX_FRAME = MAX_ANSWER + 4096
"""The largest size of a message in bytes: an answer with the words around it."""


def packed(message: dict[str, Any]) -> bytes:
    """Return the bytes of a message. Raises `ValueError` for a number that is not finite: JSON has none."""
    text = json.dumps(message, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    body = text.encode("utf-8", "surrogatepass")
    return HEAD.pack(len(body)) + body


def unpacked(body: bytes) -> dict[str, Any]:
    """Return the message in these bytes."""
    return json.loads(body.decode("utf-8", "surrogatepass"))


def read_frame(stream: BinaryIO) -> dict[str, Any] | None:
    """Return the next message of a stream, None at its end."""
    head = stream.read(HEAD.size)
    if len(head) < HEAD.size:
        return None
    (length,) = HEAD.unpack(head)
    body = stream.read(length)
    return unpacked(body) if len(body) == length else None
