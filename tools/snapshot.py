"""Everything that the product says and computes for its built-in examples, as files that can be compared.

    python tools/snapshot.py take FOLDER [EXAMPLE …]  every page, command and kernel, into a new folder
    python tools/snapshot.py compare BEFORE AFTER     what differs; exit code 1 where anything does

A change of structure is a change of structure alone where two snapshots are equal. A folder holds

    pages/EXAMPLE/NOTATION.txt .md .tex .html       the derivation in every format and notation
    pages/EXAMPLE/checklist.txt, schematic.svg …    the one-page checklist, the picture, and the model file
    commands/EXAMPLE/VERB.txt                       exit code, standard output and standard error of a command line
    kernels/EXAMPLE.txt                             the bits of all compiled functions at fixed states
    runs/EXAMPLE.txt                                the bits of runs by every method

Bits depend on the processor: both snapshots must be taken on one machine. Durations in what commands say are replaced
by ⟨time⟩.
"""

from __future__ import annotations

import argparse
import contextlib
import difflib
import io
import os
import re
import sys
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np

NOTATIONS = ("lecture", "physics", "robotics")
METHODS = ("dop853", "tsit5", "rk4", "gauss4", "taylor", "LSODA", "Radau")
FIXED = ("rk4", "gauss4")
STATES = 3
_TIME = re.compile(r"\d+(\.\d+)? ?(ms|µs|s|min)\b(?= of CPU| of computing|, |\)|$)|\d+(\.\d+)? steps/s")

SHARED = {  # command lines that name no example
    "help": "--help",
    "examples": "examples",
    "examples-json": "examples --json",
    "schema": "schema",
    "version": "version",
    "unknown-verb": "derrive",
    "unknown-example": "derive -e pendulun",
    "missing-file": "derive nowhere.toml",
    "new": "new cart-pole",
    "compare": "compare -e double-pendulum -e double-pendulum-relative",
    "compare-json": "compare -e double-pendulum -e double-pendulum-relative --json",
    "compare-different": "compare -e pendulum -e duffing",
    "set-unknown": "simulate -e pendulum --set length=3",
    "set-bad-unit": "simulate -e pendulum --set l=3kg",
}
EACH = {  # command lines of each example, after `-e EXAMPLE`
    "derive": "derive {e}",
    "derive-brief": "derive {e} --brief",
    "derive-detail": "derive {e} --detail full --width 60",
    "derive-json": "derive {e} --json",
    "derive-why": "derive {e} --why",
    "worksheet": "worksheet {e}",
    "verify": "verify {e}",
    "linearize": "linearize {e}",
    "linearize-latex": "linearize {e} -f latex",
    "equilibria": "equilibria {e}",
    "conserved": "conserved {e}",
    "conserved-json": "conserved {e} --json",
    "simulate": "simulate {e} -d 1",
    "simulate-json": "simulate {e} -d 1 --json",
    "export-c": "export {e} --to c",
    "export-python": "export {e} --to python",
    "check-empty": "check {e} empty.txt",
    "check-wrong": "check {e} wrong.txt",
    "check-energy": "check {e} energy.txt --json",
}


def take(folder: Path, names: tuple[str, ...]) -> None:
    """Write a snapshot of these examples, or of all, into a folder that must not exist yet."""
    from lagrangian import examples

    folder.mkdir(parents=True)
    names = names or examples.names()
    with ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("spawn")) as pool:
        tasks = [pool.submit(_shared, folder), *(pool.submit(_example, folder, name) for name in names)]
        for task in tasks:
            task.result()


def compare(before: Path, after: Path) -> int:
    """Print what differs between two snapshots; return how many files do."""
    files = {p.relative_to(root) for root in (before, after) for p in root.rglob("*") if p.is_file()}
    differing = 0
    for file in sorted(files):
        old, new = before / file, after / file
        if not (old.exists() and new.exists()):
            print(f"{file}: only {'after' if new.exists() else 'before'}")
        elif old.read_bytes() != new.read_bytes():
            lines = [p.read_text(encoding="utf-8").splitlines() for p in (old, new)]
            print("\n".join(list(difflib.unified_diff(*lines, f"before/{file}", f"after/{file}", "", "", 0, ""))[:40]))
        else:
            continue
        differing += 1
    print(f"{len(files)} files, {differing} differ")
    return differing


def _shared(folder: Path) -> None:
    from lagrangian.cli.verbs import VERBS

    for name, line in (SHARED | {f"help-{verb}": f"{verb} --help" for verb in VERBS}).items():
        _write(folder / "commands" / f"{name}.txt", _command(line))


def _example(folder: Path, name: str) -> None:
    import lagrangian as lg
    from lagrangian import examples

    system = lg.loads(examples.text(name))
    for file, text in _pages(system):
        _write(folder / "pages" / name / file, text)
    for verb, line in EACH.items():
        _write(folder / "commands" / name / f"{verb}.txt", _command(line.format(e=f"-e {name}")))
    _write(folder / "kernels" / f"{name}.txt", "\n".join(_kernels(system)))
    _write(folder / "runs" / f"{name}.txt", "\n".join(_runs(system)))


def _pages(system: Any) -> Iterator[tuple[str, str]]:
    """The derivation in every format and notation, as name of a file and text."""
    derivation = system.derive()
    for notation in NOTATIONS:
        yield f"{notation}.txt", derivation.to_text(notation=notation)
        yield f"{notation}.md", derivation.to_markdown(notation=notation)
        yield f"{notation}.tex", derivation.to_latex(notation=notation)
        yield f"{notation}.html", derivation.to_html(notation=notation)
    yield "checklist.txt", derivation.to_text(brief=True)
    yield "everything.txt", derivation.to_text(full=True)
    yield "notebook.html", derivation._repr_html_() + system._repr_html_()
    yield "model.toml", system.to_toml()
    yield "schematic.svg", system.look().to_svg()


def _kernels(system: Any) -> Iterator[str]:
    """The bits of every compiled function at fixed states."""
    try:
        compiled = system.compile()
    except Exception as error:
        yield str(error)
        return
    random = np.random.default_rng(7)
    n, m = len(compiled.coordinates), len(compiled.velocities)
    for _ in range(STATES):
        q, v, a = random.uniform(0.2, 1.2, n), random.uniform(-1, 1, m), random.uniform(-1, 1, m)
        calls: dict[str, Callable[[], Any]] = {
            "forward": lambda q=q, v=v: compiled.forward(q, v),
            "inverse": lambda q=q, v=v, a=a: compiled.inverse(q, v, a),
            "mass_matrix": lambda q=q: compiled.mass_matrix(q),
            "bias": lambda q=q, v=v: compiled.bias(q, v),
            "energy": lambda q=q, v=v: compiled.energy(q, v),
            "many": lambda q=q, v=v: compiled.forward(np.tile(q, (9, 1)), np.tile(v, (9, 1)))[-1],
        }
        for name, call in calls.items():
            yield f"{name}: {_bits(call)}"


def _runs(system: Any) -> Iterator[str]:
    """The bits of the last state of a short run by each method, and of an ensemble."""
    for method in METHODS:
        fixed = {"step": 0.01} if method in FIXED else {}
        bits = _bits(lambda method=method, fixed=fixed: system.simulate(0.5, method=method, **fixed).y[:, -1])
        yield f"{method}: {bits}"
    first = system.compile().coordinates[0]
    yield f"ensemble: {_bits(lambda: _all(system.ensemble(0.5, initial={first: [0.1, 0.2, 0.3]}, times=3)))}"


def _all(ensemble: Any) -> np.ndarray:
    return np.concatenate([np.ravel(ensemble[name]).astype(float) for name in sorted(ensemble)])


def _bits(call: Callable[[], Any]) -> str:
    try:
        return np.asarray(call(), float).tobytes().hex()
    except Exception as error:
        return " ".join(f"{type(error).__name__}: {error}".split())


def _command(line: str) -> str:
    """A command line run in a new folder: its exit code, and what it wrote where."""
    from lagrangian.cli import main

    out, err = io.TextIOWrapper(io.BytesIO(), encoding="utf-8"), io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
    back = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        Path("empty.txt").write_text("", encoding="utf-8")
        Path("wrong.txt").write_text("m*x'' = 0\nT = m*v\n", encoding="utf-8")
        Path("energy.txt").write_text("V = 0\n", encoding="utf-8")
        try:
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                code = main(line.split())
            files = sorted(p for p in Path().rglob("*") if p.is_file() and p.suffix not in (".txt",))
            made = "".join(f"--- {p}\n{p.read_text(encoding='utf-8')}" for p in files)
        finally:
            os.chdir(back)
    said = [x.buffer.getvalue().decode().replace(folder, "⟨folder⟩") for x in (out, err) if not x.flush()]
    return _TIME.sub("⟨time⟩", f"$ lagrangian {line}\nexit {code}\n{said[0]}--- standard error\n{said[1]}{made}")


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    verbs = parser.add_subparsers(dest="verb", required=True)
    taken = verbs.add_parser("take")
    taken.add_argument("folder", type=Path)
    taken.add_argument("examples", nargs="*")
    both = verbs.add_parser("compare")
    both.add_argument("before", type=Path)
    both.add_argument("after", type=Path)
    given = parser.parse_args()
    if given.verb == "compare":
        return 1 if compare(given.before, given.after) else 0
    take(given.folder, tuple(given.examples))
    return 0


if __name__ == "__main__":
    sys.exit(_main())
