"""CPU time until something is there: the package imported, the version printed, a pendulum derived.

    python bench/startup.py                 print a Markdown table
    python bench/startup.py --append        and append it to bench/RESULTS.md, with the machine

Every figure is the user and system time of a fresh interpreter, the median of `--runs` of them; the rows take turns,
so that what else the machine does falls on all of them alike. Python itself is in all rows.
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path

from record import append, command_line, this_machine

HERE = Path(__file__).parent

DESCRIBED = """
import lagrangian as lg
from sympy import cos, sin
pendulum = lg.System("pendulum")
theta = pendulum.coordinates("theta")
m, L = pendulum.parameters("m L")
pendulum.particle(m, at=pendulum.origin + (L*sin(theta), -L*cos(theta)))
pendulum.gravity(direction=(0, -1))
"""
COMMAND = "import sys; from lagrangian.cli import run; sys.argv = ['lagrangian', *{!r}]; run()"

ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
"""Bytecode is kept, as it is where people work: to compile the source every time takes half as long again."""

ROWS = {
    "python": "pass",
    "import numpy": "import numpy",
    "import sympy": "import sympy",
    "import sympy, numpy, add a symbol": "import sympy, numpy; sympy.Symbol('x') + 1",
    "import lagrangian": "import lagrangian",
    "import lagrangian, touch lg.System": "import lagrangian as lg; lg.System, lg.load",
    "describe a pendulum": DESCRIBED,
    "derive a pendulum, to_text()": DESCRIBED + "pendulum.derive().to_text()",
    "compile a pendulum, one call": DESCRIBED + "pendulum.compile().forward([0.1], [0.0], p=[1.0, 1.0, 9.81])",
    "lagrangian version": COMMAND.format(["version"]),
    "lagrangian --help": COMMAND.format(["--help"]),
    "lagrangian derive --help": COMMAND.format(["derive", "--help"]),
    "lagrangian derive -e pendulum": COMMAND.format(["derive", "-e", "pendulum"]),
}
"""What is timed → the program."""

AIMS = {
    "import lagrangian, touch lg.System": "import sympy + 0.15",
    "derive a pendulum, to_text()": "1.2",
    "lagrangian version": "0.3",
    "lagrangian --help": "0.3",
    "lagrangian derive --help": "0.3",
}


def cpu(program: str) -> float:
    """User and system time [s] of an interpreter that runs the program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, "-c", program], check=True, stdout=subprocess.DEVNULL, env=ENVIRONMENT)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def table(runs: int) -> str:
    for program in ROWS.values():  # the bytecode of every module is on disk from here on, and the machine code
        cpu(program)
    taken: dict[str, list[float]] = {name: [] for name in ROWS}
    for _ in range(runs):
        for name, program in ROWS.items():
            taken[name].append(cpu(program))
    sympy = statistics.median(taken["import sympy"])
    lines = ["| | CPU [s] | least | times `import sympy` | aim |", "| --- | ---: | ---: | ---: | ---: |"]
    for name, found in taken.items():
        middle = statistics.median(found)
        lines.append(f"| {name} | {middle:.2f} | {min(found):.2f} | {middle / sympy:.2f} | {AIMS.get(name, '')} |")
    return "\n".join(lines)


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--runs", type=int, default=9)
    given = parser.parse_args()
    where = this_machine("sympy", "numpy", "typer")
    text = f"## Start\n\n`python bench/startup.py`, median of {given.runs}. {where}.\n\n{table(given.runs)}\n"
    print(text)
    if given.append:
        append([text])


if __name__ == "__main__":
    main()
