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
        raise ModelError(
            f"there is no example '{name[:64]}'",
            fix=did_you_mean(name[:64], names()) or "`lagrangian examples` lists them",
            code="E402",
        )
    return (files(__name__) / f"{name}{_SUFFIX}").read_text(encoding="utf-8")


def describe(name: str) -> str:
    """Return an example's one line of description, the comment that its file begins with."""
    first, _, _ = text(name).partition("\n")
    return first.removeprefix("#").strip()


__all__ = ["describe", "names", "text"]
