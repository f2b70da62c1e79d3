"""Reads expressions and model files; writes model files."""

from typing import TYPE_CHECKING

from lagrangian.lazily import lazily

if TYPE_CHECKING:
    from lagrangian.read.expression import parse_expression
    from lagrangian.read.file_load import load, loads
    from lagrangian.read.file_save import dumps
    from lagrangian.read.file_schema import schema
    from lagrangian.read.scope import Scope
    from lagrangian.read.validate import MAX_BYTES, decode
else:
    __getattr__ = lazily(
        __name__,
        {
            "expression": "parse_expression",
            "file_load": "load loads",
            "file_save": "dumps",
            "file_schema": "schema",
            "scope": "Scope",
            "validate": "MAX_BYTES decode",
        },
    )

__all__ = [
    "MAX_BYTES",
    "Scope",
    "decode",
    "dumps",
    "load",
    "loads",
    "parse_expression",
    "schema",
]
