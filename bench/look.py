"""CPU time of the schematic and of the live page of every built-in example, the size of the page, and a frame in it.

    python bench/look.py                     print Markdown tables
    python bench/look.py --frames            also the time of a frame, where there is Chromium
    python bench/look.py --append            and append them to bench/RESULTS.md, with the machine

Everything is made in one process from a fresh description, without the cache of machine code, after the picture and the
page of another system: what a program needs only once is not counted. A figure is the least of `--rounds`.
"""

from __future__ import annotations

import os
import shutil
import statistics
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import lagrangian as lg
from record import append, command_line, one_core, this_machine

FIRST = "duffing"
"""The system that is drawn before the others."""

AIMS = {"schematic [ms]": 50.0, "page [s]": 1.5, "page [kB]": 150.0, "frame [ms]": 4.0}
WORST = 5
WATCHED, FEWEST = 3000, 30
"""How long frames are watched [ms], again until there are so many; the first third, in which scripts are compiled, does
not count."""

WATCH = """
globalThis.taken = [];
const ask = globalThis.requestAnimationFrame.bind(globalThis);
globalThis.requestAnimationFrame = (call) => ask((moment) => {
  const begin = performance.now();
  call(moment);
  taken.push(performance.now() - begin);
});
"""


@dataclass
class Figures:
    """The least figures of one example so far."""

    found: dict[str, float] = field(default_factory=dict[str, float])

    def least(self, name: str, value: float) -> None:
        self.found[name] = min(value, self.found.get(name, value))


def examples() -> list[str]:
    """The names of the built-in examples."""
    return sorted(file.stem for file in (Path(lg.__file__).parent / "examples").glob("*.toml"))


def cpu(make: Callable[[], Any]) -> tuple[float, Any]:
    begin = time.process_time()
    made = make()
    return time.process_time() - begin, made


def measured(name: str, rounds: int, folder: Path) -> Figures:
    """The schematic and the page of an example; the page is kept in a folder."""
    figures = Figures()
    for _ in range(rounds):
        system = lg.example(name)
        figures.least("schematic [ms]", 1e3 * cpu(lambda: system.look().to_svg())[0])  # noqa: B023
        system = lg.example(name)
        seconds, page = cpu(lambda: system.look().to_html())  # noqa: B023
        figures.least("page [s]", seconds)
        figures.least("page [kB]", len(page.encode()) / 1e3)
        (folder / f"{name}.html").write_text(page, encoding="utf-8")
    return figures


def frames(pages: list[Path]) -> dict[str, float]:
    """The time [ms] of the scripts of a frame on each page as it plays, in Chromium: what a tenth of them falls below.

    It is the time on the clock, which other work on the machine only makes longer.
    """
    from playwright.sync_api import sync_playwright

    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    found: dict[str, float] = {}
    with sync_playwright() as running:
        browser = running.chromium.launch(executable_path=chromium)
        for path in pages:
            page = browser.new_page()
            page.add_init_script(WATCH)
            page.goto(path.as_uri())
            while page.evaluate("taken.length") < FEWEST:
                page.wait_for_timeout(WATCHED)
            taken = page.evaluate("taken")
            found[path.stem] = sorted(taken[len(taken) // 3 :])[len(taken) // 15]
            page.close()
        browser.close()
    return found


def tables(all_figures: dict[str, Figures]) -> list[str]:
    """The medians of all examples, and those that need most."""
    names = [name for name in AIMS if all(name in x.found for x in all_figures.values())]
    lines = ["| | median | most | above the aim | aim |", "| --- | ---: | ---: | --- | ---: |"]
    for name in names:
        values = {example: x.found[name] for example, x in all_figures.items()}
        above = [example for example, x in sorted(values.items(), key=lambda pair: -pair[1]) if x > AIMS[name]]
        middle, most = statistics.median(values.values()), max(values.values())
        shown = ", ".join(above[:WORST]) + " …" * (len(above) > WORST)
        lines.append(f"| {name} | {middle:.3g} | {most:.3g} | {shown} | {AIMS[name]:g} |")
    lines += ["", f"| the {WORST} longest pages | {' | '.join(names)} |", f"| --- |{' ---: |' * len(names)}"]
    for example, x in sorted(all_figures.items(), key=lambda pair: -pair[1].found["page [s]"])[:WORST]:
        lines.append(f"| {example} | {' | '.join(f'{x.found[name]:.3g}' for name in names)} |")
    return lines


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--frames", action="store_true", help="measure frames in Chromium")
    given = parser.parse_args()
    os.environ["LAGRANGIAN_CACHE_DIR"] = ""
    one_core()
    lg.example(FIRST).look().to_html()
    with tempfile.TemporaryDirectory() as folder:
        found: dict[str, Figures] = {}
        for name in examples():
            try:
                found[name] = measured(name, given.rounds, Path(folder))
            except lg.RunError as error:
                print(f"{name} has no page: {error.what}")
        if given.frames:
            for name, took in frames([Path(folder) / f"{name}.html" for name in found]).items():
                found[name].least("frame [ms]", took)
    head = f"`python bench/look.py`, CPU. {len(found)} examples; {this_machine('sympy', 'numpy', 'llvmlite')}."
    lines = ["## Pictures and pages", "", head, "", *tables(found)]
    print("\n".join(lines))
    if given.append:
        append(lines)


if __name__ == "__main__":
    main()
