"""Built-in examples: model files to read, derive and start from."""

from __future__ import annotations

from importlib.resources import files

from lagrangian.errors import ModelError, did_you_mean

_SUFFIX = ".toml"
_LECTURE = "lecture-"


def names() -> tuple[str, ...]:
    """Return the names of the examples, the lecture's first, then in alphabetical order."""
    found = [f.name.removesuffix(_SUFFIX) for f in files(__name__).iterdir() if f.name.endswith(_SUFFIX)]
    return tuple(sorted(found, key=lambda name: (not name.startswith(_LECTURE), name)))


def text(name: str) -> str:
    """Return the model file of an example; raise `ModelError` with the nearest name where there is none.

    >>> text("pendulum").splitlines()[1]
    'name = "pendulum"'
    """
    if name not in names():
        near = _near(name[:64])
        fix = f"{near} `lagrangian examples` lists them all" if near else "`lagrangian examples` lists them"
        raise ModelError(f"there is no example '{name[:64]}'", fix=fix, code="E402")
    return (files(__name__) / f"{name}{_SUFFIX}").read_text(encoding="utf-8")


MOST_NEAR = 4
"""Examples that are named where one is asked for by a part of its name."""


def _near(name: str) -> str | None:
    """The examples that have all words of ``name`` in theirs, the shortest first, else the nearest one."""
    asked = name.lower().removesuffix(_SUFFIX).replace("_", "-").replace(" ", "-")
    words = asked.split("-")
    found = sorted((n for n in names() if all(w in n for w in words)), key=len)
    if not found or not asked:
        return did_you_mean(name, names())
    listed = [f"'{n}'" for n in ([asked] if asked in found else found[:MOST_NEAR])]
    return f"Did you mean {' or '.join(listed)}?"


def describe(name: str) -> str:
    """Return an example's one line of description, the comment that its file begins with."""
    first, _, _ = text(name).partition("\n")
    return first.removeprefix("#").strip()


__all__ = ["describe", "names", "text"]
