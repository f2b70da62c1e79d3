"""The pictures of README and manual that the program draws itself: ``python tools/pictures.py`` writes them.

A test compares what is stored with what is drawn today.
"""

import pathlib

import lagrangian as lg

FIGURES = pathlib.Path(__file__).parent.parent / "docs" / "figures"

EXAMPLES = {"cart-pole.svg": "cart-pole"}
"""The file, and the built-in example that it shows."""


def drawn(file: str) -> str:
    """The picture that a file should be."""
    return lg.example(EXAMPLES[file]).look().to_svg()


if __name__ == "__main__":
    for name in EXAMPLES:
        (FIGURES / name).write_text(drawn(name), encoding="utf-8")
