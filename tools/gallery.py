"""The gallery of the manual: a page for each built-in example, made when the manual is built.

``docs/conf.py`` calls `write` before Sphinx looks for pages; by hand, ``python tools/gallery.py FOLDER``.
"""

import pathlib
import re
import sys

import lagrangian as lg
from lagrangian import examples

LEFT_OUT = "## Verified"

INDEX = """# Gallery

The built-in examples: what each of them teaches, its model file, and what is derived from it. To start from one, write
`lagrangian new NAME > my.toml`; in Python, `lagrangian.example("NAME")` returns it as a `System`.

| example | what it teaches | what it looks like |
| --- | --- | --- |
{rows}

```{{toctree}}
:hidden:
:maxdepth: 1

{names}
```
"""

PAGE = """# {title}

{teaches}.

{picture}

```
lagrangian derive -e {name}                 # every step, with its reasons
{simulate}lagrangian new {name} -o {name}.toml
```

## Model file

```toml
{file}
```

{derived}
"""

SIMULATE = "lagrangian simulate -e {name} --plot run.png\n"


def drawn(system: lg.System) -> tuple[str, str]:
    """The schematic of a system as SVG, and what is seen in it, in words."""
    picture = system.look()
    return picture.to_svg(), picture.description


def derived(system: lg.System) -> str:
    """The checklist of a derivation in Markdown, without its title and what was verified; or why there is none."""
    try:
        _, _, steps = system.derive().to_markdown(brief=True).partition("\n")
    except lg.Error as refused:
        return f"## Result\n\nNo equations are written out:\n\n```\n{refused}\n```"
    return steps.partition(LEFT_OUT)[0].strip()


def alternative(words: str) -> str:
    """Words as the alternative text of a picture in Markdown."""
    return re.sub(r"([\\\[\]<>*_`$])", r"\\\1", words)


def page(name: str, words: str | None = None) -> str:
    """The page of one example; ``words`` say what its picture, the file ``NAME.svg``, shows."""
    file, system = examples.text(name), lg.example(name)
    words = drawn(system)[1] if words is None else words
    return PAGE.format(
        name=name,
        title=system.name[:1].upper() + system.name[1:],
        teaches=examples.describe(name),
        picture=f"![{alternative(words)}]({name}.svg)",
        simulate=SIMULATE.format(name=name) if "[simulate]" in file else "",
        file=file.strip(),
        derived=derived(system),
    )


def index() -> str:
    """The first page of the gallery."""
    names = examples.names()
    picture = '<img src="{0}.svg" alt="" loading="lazy" style="max-width: 14rem; max-height: 9rem">'
    rows = "\n".join(f"| [{name}]({name}.md) | {examples.describe(name)} | {picture.format(name)} |" for name in names)
    return INDEX.format(rows=rows, names="\n".join(names))


def write(folder: pathlib.Path) -> None:
    """Write all pages to a folder; one that is right already is left alone, so that Sphinx need not read it again."""
    pages = {"index.md": index()}
    for name in examples.names():
        svg, words = drawn(lg.example(name))
        pages |= {f"{name}.md": page(name, words), f"{name}.svg": svg}
    folder.mkdir(parents=True, exist_ok=True)
    for old in (*folder.glob("*.md"), *folder.glob("*.svg")):
        if old.name not in pages:
            old.unlink()
    for name, text in pages.items():
        path = folder / name
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write(pathlib.Path(sys.argv[1]))
