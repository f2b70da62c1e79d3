"""Every example's schematic on one page, light and dark side by side: ``python tools/every_picture.py PAGE.html``.

With ``--motion``, the animations of their runs. Look at the page after a change to the rules of pictures.
"""

import html
import pathlib
import sys

import lagrangian as lg
from lagrangian import examples

STYLE = "figure{display:inline-block;margin:4px;vertical-align:top}figcaption{font:12px system-ui}img{max-width:46vw}"


def picture(name: str, moving: bool) -> tuple[str, str]:
    """The SVG of an example, and what is missing in it."""
    system = lg.example(name)
    if moving:
        return system.simulate().animate().to_svg(), ""
    found = system.look()
    return found.to_svg(), "; ".join(found.missing)


def write(page: pathlib.Path, *, moving: bool) -> None:
    """Write the page, and the SVG of each example beside it."""
    folder = page.parent / f"{page.stem}-svg"
    folder.mkdir(parents=True, exist_ok=True)
    figures: list[str] = []
    for name in examples.names():
        try:
            svg, missing = picture(name, moving)
        except lg.Error as refused:
            svg, missing = "", str(refused)
        (folder / f"{name}.svg").write_text(svg, encoding="utf-8")
        image = f'<img alt="{name}" src="{folder.name}/{name}.svg">'
        schemes = "".join(f'<span style="color-scheme:{scheme}">{image}</span>' for scheme in ("light", "dark"))
        figures.append(
            f"<figure>{schemes}<figcaption>{name}: {html.escape(missing or 'complete')}</figcaption></figure>"
        )
    head = f'<!DOCTYPE html><meta charset="utf-8"><title>Pictures</title><style>{STYLE}</style>'
    page.write_text(head + "\n".join(figures), encoding="utf-8")


if __name__ == "__main__":
    write(pathlib.Path(sys.argv[1]), moving="--motion" in sys.argv)
